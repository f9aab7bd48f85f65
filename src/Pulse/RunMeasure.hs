-- | Measures of a run: times, pulses and feeds of each frame, and of the whole tape.
--
-- The feed is measured from the pulses alone, over the windows of "Pulse.FeedWindow". Seconds are
-- computed from whole ticks at the end.
module Pulse.RunMeasure
  ( FrameMeasure (..),
    RunTotal (..),
    FrequencyPeak (..),
    JobLoad (..),
    emptyTotal,
    measure,
    isAtFeed,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isNothing)
import Data.Text (Text)
import Frame.Frame (Frame (feedCode, motion), FrameMotion (..))
import Machine.Controller (ControlJob (jobName))
import Machine.Machine (CommandName, Machine)
import Machine.Machine qualified as Machine
import Pulse.ControllerRun
  ( ControllerRun (..),
    FrameStart (frameStarted, path, startTick, waited),
    JobRun (..),
    StopReason (..),
    Tick,
  )
import Pulse.ControllerRun qualified
import Pulse.FeedWindow (FeedWindow)
import Pulse.FeedWindow qualified as FeedWindow
import Pulse.FramePath (AskedFeed, FramePath)
import Pulse.FramePath qualified as FramePath
import Pulse.Steps (Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps

-- | Measures of one frame.
data FrameMeasure = FrameMeasure
  { number :: Int,
    frame :: Frame,
    -- | path of the cutter's centre; Nothing without motion
    centrePath :: Maybe FramePath,
    beginsAt :: Tick,
    endsAt :: Tick,
    -- | ticks for which the controller waited before the frame, because it was not read
    waitedFor :: Tick,
    -- | true if the frame before and this frame both move at a feed
    isInCut :: Bool,
    -- | position at the end, in pulses from the start of the tape
    positionAfter :: Pulses5,
    -- | counts of pulses on each axis, without their signs
    pulses :: Pulses5,
    -- | feed that the frame asks; Nothing without motion
    asked :: Maybe AskedFeed,
    -- | mean feed, and the least and the highest of all measurements, in mm\/min or in degrees a
    -- minute; Nothing if the frame takes no time
    feeds :: Maybe (Double, Double, Double),
    -- | mean frequencies of the five axes, in pulses per second; empty if the frame takes no time
    frequencies :: [Double],
    -- | jumps of the frequencies of the axes at the joint with the frame before, if both frames run
    -- at their mean feeds; empty without such a frame. An axis that turns back jumps by the sum.
    jumps :: [Double],
    -- | commands with the ticks at which they go out
    commands :: [(Tick, CommandName, Int)]
  }

-- | Measures of a whole run.
data RunTotal = RunTotal
  { totalTicks :: Tick,
    totalPulses :: Pulses5,
    totalWaited :: Tick,
    -- | numbers of the frames between two feed moves for which the controller waited: how many,
    -- and the first of them
    starved :: Int,
    firstStarved :: Maybe Int,
    -- | for each axis, the highest mean frequency in a frame, and the largest change from frame to
    -- frame
    peaks :: [FrequencyPeak],
    largestJumps :: [FrequencyPeak],
    loads :: Map Text JobLoad,
    stopReason :: StopReason
  }
  deriving stock (Eq, Show)

-- | Frequency of an axis in pulses per second, and the number of the frame that has it; both are 0
-- if the axis makes no pulse.
data FrequencyPeak = FrequencyPeak {peakHz :: Double, peakFrame :: Int}
  deriving stock (Eq, Show)

-- | Runs of one job: their count, their ticks, and the longest wait between request and start.
data JobLoad = JobLoad {runCount :: Int, runTicks :: Tick, longestWait :: Tick}
  deriving stock (Eq, Show)

-- | State of the measurement between two frames.
data Progress = Progress
  { position :: Pulses5,
    total :: RunTotal,
    -- | signed frequencies of the axes at the end of the last frame that moved
    lastFrequencies :: [Double],
    -- | true if the last frame moved at a feed
    wasFeedMove :: Bool
  }

-- | State of the measurement within a frame.
data Meter = Meter
  { progress :: Progress,
    start :: FrameStart,
    given :: [(Tick, CommandName, Int)],
    window :: FeedWindow
  }

-- | Measures the frames of a run, one after the other. The second argument is the frequency of the
-- clock whose ticks the run counts.
measure :: Machine -> Int -> ControllerRun -> LazyList RunTotal FrameMeasure
measure machine clock =
  between
    machine
    clock
    Progress
      { position = zero,
        total = emptyTotal,
        lastFrequencies = [],
        wasFeedMove = False
      }

-- | Total of no frames.
emptyTotal :: RunTotal
emptyTotal =
  RunTotal
    { totalTicks = 0,
      totalPulses = zero,
      totalWaited = 0,
      starved = 0,
      firstStarved = Nothing,
      peaks = replicate 5 (FrequencyPeak 0 0),
      largestJumps = replicate 5 (FrequencyPeak 0 0),
      loads = Map.empty,
      stopReason = TapeEnds
    }

zero :: Pulses5
zero = Pulses5 0 0 0 0 0

-- | Measures from the end of a frame on.
between :: Machine -> Int -> Progress -> ControllerRun -> LazyList RunTotal FrameMeasure
between machine clock p run = case run of
  FrameBegins s more -> within machine clock (begun machine p s) more
  Stopped t why -> LazyList.End (total p) {totalTicks = t, stopReason = why}
  JobDone job more -> between machine clock (afterJob job p) more
  Stepped _ _ more -> between machine clock p more
  FrameEnds _ more -> between machine clock p more
  Commanded _ _ _ more -> between machine clock p more

-- | Measures from an event within a frame on.
within :: Machine -> Int -> Meter -> ControllerRun -> LazyList RunTotal FrameMeasure
within machine clock m run = case run of
  Stepped t steps more -> let m' = stepped clock t steps m in m' `seq` within machine clock m' more
  JobDone job more -> within machine clock m {progress = afterJob job (progress m)} more
  Commanded t c n more -> within machine clock m {given = (t, c, n) : given m} more
  FrameEnds t more ->
    let (f, p) = ended machine clock t m in LazyList.Next f (between machine clock p more)
  Stopped t _ ->
    let (f, p) = ended machine clock t m in LazyList.Next f (between machine clock p run)
  FrameBegins _ _ -> between machine clock (progress m) run

afterJob :: JobRun -> Progress -> Progress
afterJob done p = p {total = (total p) {loads = Map.alter (Just . add) name (loads (total p))}}
  where
    name = jobName (job done)
    ticks = endedAt done - beganAt done
    waited' = beganAt done - requestedAt done
    add known = case known of
      Nothing -> JobLoad 1 ticks waited'
      Just (JobLoad n t w) -> JobLoad (n + 1) (t + ticks) (max w waited')

-- | Meter at the beginning of a frame.
begun :: Machine -> Progress -> FrameStart -> Meter
begun machine p s =
  Meter
    { progress = p,
      start = s,
      given = [],
      window = FeedWindow.begin machine (startTick s) (path s)
    }

-- | Meter after the pulses of one tick.
stepped :: Int -> Tick -> Steps -> Meter -> Meter
stepped clock t steps m = m {window = FeedWindow.step clock t steps (window m)}

-- | Measures of a frame that ends at a tick, and the state after it.
ended :: Machine -> Int -> Tick -> Meter -> (FrameMeasure, Progress)
ended machine clock t m = (f, p')
  where
    s = start m
    p = progress m
    ticks = t - startTick s
    w = window m
    long = FeedWindow.pathLength w
    mean = FeedWindow.speed clock long ticks
    hasTime = ticks > 0 && long > 0
    hz = map (perSecond . fromIntegral) (Steps.toList (FeedWindow.made w))
    (atStart, atEnd) = maybe ([], []) FramePath.velocities (path s)
    jump a b = abs (a - b)
    perSecond n = n * fromIntegral clock / fromIntegral ticks
    isFeedMove = isAtFeed machine (frameStarted s)
    inCut = wasFeedMove p && isFeedMove
    f =
      FrameMeasure
        { number = Pulse.ControllerRun.number s,
          frame = frameStarted s,
          centrePath = path s,
          beginsAt = startTick s,
          endsAt = t,
          waitedFor = waited s,
          isInCut = inCut,
          positionAfter = Steps.plus (position p) (FeedWindow.relative w),
          pulses = FeedWindow.made w,
          asked = FramePath.askedFeed machine (frameStarted s) <$ path s,
          feeds = if hasTime then Just (feedsOf mean w) else Nothing,
          frequencies = if hasTime then hz else [],
          jumps = if hasTime then zipWith jump (map perSecond atStart) (lastFrequencies p) else [],
          commands = reverse (given m)
        }
    p' =
      Progress
        { position = positionAfter f,
          total = withFrame f (total p),
          lastFrequencies = if hasTime then map perSecond atEnd else lastFrequencies p,
          wasFeedMove = isFeedMove
        }

-- | Mean, least and highest feed, from the mean and the windows.
feedsOf :: Double -> FeedWindow -> (Double, Double, Double)
feedsOf mean w = case FeedWindow.range w of
  Just (least, most) -> (mean, least, most)
  Nothing -> (mean, mean, mean)

-- | Total with one more frame.
withFrame :: FrameMeasure -> RunTotal -> RunTotal
withFrame f r =
  r
    { totalTicks = endsAt f,
      totalPulses = Steps.plus (totalPulses r) (pulses f),
      totalWaited = totalWaited r + waitedFor f,
      starved = if isStarved then starved r + 1 else starved r,
      firstStarved = if isStarved && isNothing (firstStarved r) then Just n else firstStarved r,
      peaks = raisedBy (frequencies f) (peaks r),
      largestJumps = raisedBy (jumps f) (largestJumps r)
    }
  where
    FrameMeasure {number = n} = f
    isStarved = isInCut f && waitedFor f > 0
    raisedBy found known = if null found then known else evaluated (zipWith higher found known)
    -- Peaks that were not evaluated would keep every frame before them.
    evaluated known = foldr seq known known
    higher hz peak = if hz > peakHz peak then FrequencyPeak hz n else peak

-- | True for a frame that moves at a feed. On a machine without a code for rapid moves, a line at
-- the feed of rapid moves is none.
isAtFeed :: Machine -> Frame -> Bool
isAtFeed machine f = case motion f of
  NoMotion -> False
  Rapid -> False
  Circular _ -> True
  Linear -> Machine.hasRapidMotion machine || feedCode f /= Machine.rapidCode machine
