-- | Measures of a run: times, pulses and feeds of each frame, and of the whole tape.
--
-- The feed is measured from the pulses alone: over each millimetre of a frame's path, between two
-- pulses of the leading axis on a line, and between two cycles on an arc. A frame that is shorter
-- than a millimetre has one measurement. Where only rotary axes move, a degree takes the place of
-- the millimetre. Seconds are computed from whole ticks at the end.
module Pulse.RunMeasure
  ( FrameMeasure (..),
    RunTotal (..),
    JobLoad (..),
    measure,
    pulsesInWindow,
    isAtFeed,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.Quantity (Mm (..))
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isNothing)
import Data.Text (Text)
import Frame.Frame (Frame (feedCode, motion), FrameMotion (..))
import Machine.Controller (ControlJob (jobName))
import Machine.Machine (Axis (X), CommandName, Machine)
import Machine.Machine qualified as Machine
import Pulse.ControllerRun
  ( ControllerRun (..),
    FrameStart (frameStarted, path, startTick, waited),
    JobRun (..),
    StopReason (..),
    Tick,
  )
import Pulse.ControllerRun qualified
import Pulse.FramePath (AskedFeed, FramePath (Arc, Line, clockwise))
import Pulse.FramePath qualified as FramePath
import Pulse.Steps (Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps

-- | Measures of one frame.
data FrameMeasure = FrameMeasure
  { number :: Int,
    frame :: Frame,
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
    -- | mean frequency of the axis with most pulses, in pulses per second
    highestFrequency :: Double,
    -- | largest change of an axis's mean frequency from the frame before, in pulses per second
    frequencyJump :: Double,
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
    loads :: Map Text JobLoad,
    stopReason :: StopReason
  }

-- | Runs of one job: their count, their ticks, and the longest wait between request and start.
data JobLoad = JobLoad {runCount :: Int, runTicks :: Tick, longestWait :: Tick}
  deriving stock (Eq, Show)

-- | State of the measurement between two frames.
data Progress = Progress
  { position :: Pulses5,
    total :: RunTotal,
    -- | mean frequencies of the axes in the last frame that moved
    lastFrequencies :: [Double],
    -- | true if the last frame moved at a feed
    wasFeedMove :: Bool
  }

-- | State of the measurement within a frame.
data Meter = Meter
  { progress :: Progress,
    start :: FrameStart,
    ruler :: Ruler,
    given :: [(Tick, CommandName, Int)],
    counter :: Counter,
    window :: Window
  }

-- | Measures of a path: its length, the length of a window as a count of pulses of the leading
-- axis or of cycles on an arc, the axis whose pulses are counted (−1 for all), and for a line the
-- length of the path for each of these pulses.
data Ruler = Ruler
  { long :: Double,
    windowCount :: Int,
    countedAxis :: Int,
    perCount :: Double,
    pulseLength :: Double
  }

-- | Position relative to the beginning of the frame, and the counts of pulses of each axis.
data Counter = Counter {relative :: Pulses5, made :: Pulses5}

-- | Window over which the feed is measured: the tick and the position at its start, the count that
-- is left up to its end, and the least and the highest feed of the windows before.
data Window = Window
  { since :: Tick,
    from :: Pulses5,
    left :: Int,
    least :: Double,
    most :: Double
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
        total = RunTotal 0 zero 0 0 Nothing Map.empty TapeEnds,
        lastFrequencies = [],
        wasFeedMove = False
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
      ruler,
      given = [],
      counter = Counter zero zero,
      window = Window (startTick s) zero (windowCount ruler) (1 / 0) 0
    }
  where
    ruler = maybe (Ruler 0 1 (-1) 0 0) (rulerOf machine) (path s)

-- | Ruler of a path. A window has at least one millimetre, or the whole of a shorter line.
rulerOf :: Machine -> FramePath -> Ruler
rulerOf machine p = case p of
  Line d ->
    let n = FramePath.leadingPulses d
        each = long / fromIntegral (max 1 n)
        inWindow = max 1 (min n (ceiling (1 / max 1e-9 each)))
     in Ruler long inWindow (FramePath.leadingAxis d) each pulse
  Arc {} -> Ruler long (max 1 (ceiling (4 / pi / pulse))) (-1) 0 pulse
  where
    long = FramePath.pathLength machine p
    Mm pulse = Machine.resolutionOf machine X

-- | Length of a window on a path, as a count of pulses of the leading axis, or of cycles on an arc.
pulsesInWindow :: Machine -> FramePath -> Int
pulsesInWindow machine = windowCount . rulerOf machine

-- | Meter after the pulses of one tick.
stepped :: Int -> Tick -> Steps -> Meter -> Meter
stepped clock t steps m
  | countedAxis (ruler m) >= 0 && Steps.onAxis (countedAxis (ruler m)) steps == 0 = m {counter = c}
  | left w > 1 = m {counter = c, window = w {left = left w - 1}}
  | otherwise =
    let feed = speed clock (windowLength m (relative c)) (t - since w)
     in m
          { counter = c,
            window =
              Window
                { since = t,
                  from = relative c,
                  left = windowCount (ruler m),
                  least = min (least w) feed,
                  most = max (most w) feed
                }
          }
  where
    w = window m
    Counter p n = counter m
    c = Counter (Steps.advance steps p) (Steps.countEach steps n)

-- | Length of the path in the window that ends at the given position.
windowLength :: Meter -> Pulses5 -> Double
windowLength m to = case path (start m) of
  Just (Arc {clockwise, FramePath.from = (i, j)}) ->
    let Pulses5 a b _ _ _ = from (window m)
        Pulses5 c d _ _ _ = to
        (u, v, u', v') = (i + a, j + b, i + c, j + d)
        turn = atan2 (fromIntegral (u * v' - v * u')) (fromIntegral (u * u' + v * v')) :: Double
        angle = if clockwise then negate turn else turn
        radius = sqrt (fromIntegral (i * i + j * j)) * pulseLength (ruler m)
     in radius * (if angle < 0 then angle + 2 * pi else angle)
  Just (Line _) -> perCount (ruler m) * fromIntegral (windowCount (ruler m))
  Nothing -> 0

-- | Feed in mm\/min for a length in mm and a time in ticks.
speed :: Int -> Double -> Tick -> Double
speed clock l t = 60 * l * fromIntegral clock / fromIntegral (max 1 t)

-- | Measures of a frame that ends at a tick, and the state after it.
ended :: Machine -> Int -> Tick -> Meter -> (FrameMeasure, Progress)
ended machine clock t m = (f, p')
  where
    s = start m
    p = progress m
    ticks = t - startTick s
    mean = speed clock (long (ruler m)) ticks
    hasTime = ticks > 0 && long (ruler m) > 0
    hz = map perSecond (Steps.toList (made (counter m)))
    perSecond n = fromIntegral n * fromIntegral clock / fromIntegral ticks
    frequencies = if hasTime then hz else lastFrequencies p
    isFeedMove = isAtFeed machine (frameStarted s)
    inCut = wasFeedMove p && isFeedMove
    f =
      FrameMeasure
        { number = Pulse.ControllerRun.number s,
          frame = frameStarted s,
          beginsAt = startTick s,
          endsAt = t,
          waitedFor = waited s,
          isInCut = inCut,
          positionAfter = Steps.plus (position p) (relative (counter m)),
          pulses = made (counter m),
          asked = FramePath.askedFeed machine (frameStarted s) <$ path s,
          feeds = if hasTime then Just (feedsOf mean (window m)) else Nothing,
          highestFrequency = if hasTime then maximum hz else 0,
          frequencyJump =
            if hasTime && not (null (lastFrequencies p))
              then maximum (zipWith (\a b -> abs (a - b)) hz (lastFrequencies p))
              else 0,
          commands = reverse (given m)
        }
    p' =
      Progress
        { position = positionAfter f,
          total = withFrame f (total p),
          lastFrequencies = frequencies,
          wasFeedMove = isFeedMove
        }

-- | Mean, least and highest feed, from the mean and the last window.
feedsOf :: Double -> Window -> (Double, Double, Double)
feedsOf mean w = if most w > 0 then (mean, least w, most w) else (mean, mean, mean)

-- | Total with one more frame.
withFrame :: FrameMeasure -> RunTotal -> RunTotal
withFrame f r =
  r
    { totalTicks = endsAt f,
      totalPulses = Steps.plus (totalPulses r) (pulses f),
      totalWaited = totalWaited r + waitedFor f,
      starved = if isStarved then starved r + 1 else starved r,
      firstStarved = if isStarved && isNothing (firstStarved r) then Just n else firstStarved r
    }
  where
    FrameMeasure {number = n} = f
    isStarved = isInCut f && waitedFor f > 0

-- | True for a frame that moves at a feed. On a machine without a code for rapid moves, a line at
-- the feed of rapid moves is none.
isAtFeed :: Machine -> Frame -> Bool
isAtFeed machine f = case motion f of
  NoMotion -> False
  Rapid -> False
  Circular _ -> True
  Linear -> Machine.hasRapidMotion machine || feedCode f /= Machine.rapidCode machine
