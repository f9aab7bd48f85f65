-- | Samples of a run: what the frames ask, and what is measured from the pulses, each with the time
-- over which it holds.
--
-- The feed is measured over the windows of "Pulse.FeedWindow"; the rest of a frame that is shorter
-- than a window keeps the feed of the last one. The frequency of an axis is measured between two of
-- its own pulses. The first of them is the axis's first pulse in the frame; the second is the first
-- pulse after the end of a window. Before its first and after its last pulse in a frame an axis has
-- the frequency of its nearest measurement, for one period at most. Where an axis turns back, its
-- frequency is 0 between the last pulse in one direction and the first in the other.
module Pulse.RunSample
  ( RunSample (..),
    SampleKind (..),
    samples,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Data.List (mapAccumL)
import Machine.Machine (Machine)
import Pulse.ControllerRun
  ( ControllerRun (..),
    FrameStart (frameStarted, number, path, startTick, waited),
    StopReason,
    Tick,
  )
import Pulse.FeedWindow (FeedWindow)
import Pulse.FeedWindow qualified as FeedWindow
import Pulse.FramePath (FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.Steps (Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps

-- | Value that holds from one tick to another.
data RunSample = RunSample {kind :: SampleKind, from :: Tick, to :: Tick, value :: Double}
  deriving stock (Eq, Show)

-- | Meaning of a sample's value.
data SampleKind
  = -- | number of a frame that begins; the sample has no duration
    FrameNumber
  | -- | 1 while the controller waits for the reader
    ReaderWait
  | -- | feed that a frame asks, in mm\/min
    FeedAsked
  | -- | feed measured, in mm\/min
    FeedMeasured
  | -- | feed measured in degrees a minute, in a frame in which only rotary axes move
    TurningMeasured
  | -- | pulses per second of the axis with this index, with the sign of its direction
    AxisFrequency Int
  deriving stock (Eq, Ord, Show)

-- | State between two frames: the end of the frame before.
type PreviousEnd = Tick

-- | State within a frame.
data FrameSampler = FrameSampler
  { start :: FrameStart,
    window :: FeedWindow,
    axes :: [AxisSampler]
  }

-- | State of the measurement on one axis within a frame.
data AxisSampler
  = -- | the axis has not moved
    Still
  | Moved
      { -- | start of the next sample: the start of the frame for the first one
        begins :: Tick,
        -- | tick of the pulse from which the pulses are counted, and their count
        base :: Tick,
        counted :: Int,
        -- | last pulse: its direction and its tick
        direction :: Int,
        lastPulse :: Tick,
        -- | true if the next pulse ends the sample
        isDue :: Bool,
        -- | frequency of the sample before
        before :: Maybe Double
      }

-- | Samples of the frames whose numbers satisfy the predicate. The second argument is the frequency
-- of the clock. No sample begins before the first one.
samples :: Machine -> Int -> (Int -> Bool) -> ControllerRun -> LazyList StopReason RunSample
samples machine clock isShown = between 0
  where
    between :: PreviousEnd -> ControllerRun -> LazyList StopReason RunSample
    between ended run = case run of
      FrameBegins s more
        | isShown (number s) -> prepend (opening ended s) (within (begun s) more)
        | otherwise -> between ended more
      FrameEnds t more -> between t more
      Stepped _ _ more -> between ended more
      Commanded _ _ _ more -> between ended more
      JobDone _ more -> between ended more
      Stopped _ why -> LazyList.End why
    within f run = case run of
      Stepped t steps more ->
        let (f', found) = stepped clock t steps f in f' `seq` prepend found (within f' more)
      FrameEnds t more -> prepend (closing machine clock t f) (between t more)
      Stopped t _ -> prepend (closing machine clock t f) (between t run)
      FrameBegins _ _ -> between (startTick (start f)) run
      Commanded _ _ _ more -> within f more
      JobDone _ more -> within f more
    begun s =
      FrameSampler s (FeedWindow.begin machine (startTick s) (path s)) [Still | _ <- axisIndices]
    prepend found list = foldr (\x rest -> LazyList.Next x rest) list found

-- | Samples at the beginning of a frame: the wait before it, and its number.
opening :: PreviousEnd -> FrameStart -> [RunSample]
opening ended s =
  ( if waited s > 0
      then
        RunSample ReaderWait ended (ended + waited s) 1 :
          [RunSample k ended (startTick s) 0 | k <- FeedMeasured : map AxisFrequency axisIndices]
      else []
  )
    <> [RunSample FrameNumber (startTick s) (startTick s) (fromIntegral (number s))]

-- | Indices of all axes in 'Steps'.
axisIndices :: [Int]
axisIndices = [0 .. 4]

-- | State after the pulses of one tick, and the samples that they end.
stepped :: Int -> Tick -> Steps -> FrameSampler -> (FrameSampler, [RunSample])
stepped clock t steps f = (FrameSampler (start f) w' axes', feedSample <> concat axisSamples)
  where
    w = window f
    w' = FeedWindow.step clock t steps w
    isClosed = FeedWindow.since w' /= FeedWindow.since w
    feedSample =
      [ RunSample (feedKind f) (FeedWindow.since w) t (FeedWindow.latest w')
        | isClosed
      ]
    (_, moved) = mapAccumL onAxis 0 (axes f)
    (axes', axisSamples) = unzip moved
    onAxis k a =
      let due = if isClosed then asDue a else a
       in ( k + 1,
            case Steps.onAxis k steps of
              0 -> (due, [])
              d ->
                let (a', found) = pulsed clock (startTick (start f)) t d due
                 in (a', [RunSample (AxisFrequency k) from' to' v | (from', to', v) <- found])
          )

asDue :: AxisSampler -> AxisSampler
asDue a = case a of
  Still -> Still
  Moved {} -> a {isDue = True}

-- | State of an axis after a pulse at tick @t@ in the direction @d@, and the samples that the pulse
-- ends. @begin@ is the start of the frame.
pulsed :: Int -> Tick -> Tick -> Int -> AxisSampler -> (AxisSampler, [(Tick, Tick, Double)])
pulsed clock begin t d a = case a of
  Still -> (Moved begin t 0 d t False Nothing, [])
  Moved {begins, base, counted, direction, lastPulse, isDue, before}
    | d /= direction ->
      let (found, still) = if counted > 0 then (upTo clock lastPulse a, lastPulse) else ([], begins)
       in (Moved t t 0 d t False (Just 0), found <> [(still, t, 0)])
    | isDue -> (Moved t t 0 d t False (Just (rateOf clock after)), upTo clock t after)
    | otherwise -> (after, [])
    where
      after = Moved begins base (counted + 1) direction t isDue before

-- | Samples of an axis up to a tick. The time before the first pulse of a frame belongs to its
-- first sample, if it is at most one period; otherwise, as in a ramp, it is a sample of one pulse.
upTo :: Int -> Tick -> AxisSampler -> [(Tick, Tick, Double)]
upTo clock t a = case a of
  Still -> []
  Moved {begins, base, direction}
    | abs (rateOf clock a) * fromIntegral (base - begins) > fromIntegral clock ->
      [(begins, base, perSecond clock direction (base - begins)), (base, t, rateOf clock a)]
    | otherwise -> [(begins, t, rateOf clock a)]

-- | Frequency of an axis between the first and the last pulse of a sample.
rateOf :: Int -> AxisSampler -> Double
rateOf clock a = case a of
  Still -> 0
  Moved {direction, counted, lastPulse, base} ->
    perSecond clock (direction * counted) (lastPulse - base)

-- | Pulses per second, from a count of pulses and a time in ticks.
perSecond :: Int -> Int -> Tick -> Double
perSecond clock n t = fromIntegral n * fromIntegral clock / fromIntegral (max 1 t)

-- | Samples at the end of a frame.
closing :: Machine -> Int -> Tick -> FrameSampler -> [RunSample]
closing machine clock t f
  | t <= begin = []
  | otherwise =
    [ RunSample FeedAsked begin t v
      | Just p <- [path s],
        Just v <- [FramePath.feedAlong machine p (FramePath.askedFeed machine (frameStarted s))]
    ]
      <> [RunSample (feedKind f) (FeedWindow.since w) t lastFeed | FeedWindow.since w < t]
      <> [ RunSample (AxisFrequency k) from' to' v
           | (k, a) <- zip [0 ..] (axes f),
             (from', to', v) <- atEnd a,
             from' < to'
         ]
  where
    s = start f
    begin = startTick s
    w = window f
    lastFeed = case FeedWindow.range w of
      Just _ -> FeedWindow.latest w
      Nothing -> FeedWindow.speed clock (FeedWindow.pathLength w) (t - begin)
    atEnd a = case a of
      Still -> [(begin, t, 0)]
      Moved {begins, counted, before, direction, lastPulse}
        | counted > 0,
          isPause lastPulse (rateOf clock a) ->
          upTo clock lastPulse a <> [(lastPulse, t, 0)]
        | counted > 0 -> upTo clock t a
        | Just v <- before -> [(begins, t, if isPause begins v then 0 else v)]
        | otherwise -> [(begin, t, perSecond clock direction (t - begin))]
    -- An axis rests that makes no pulse for longer than a period.
    isPause since rate = abs rate * fromIntegral (t - since) > fromIntegral clock

-- | Kind of the feed in a frame.
feedKind :: FrameSampler -> SampleKind
feedKind f = case path (start f) of
  Just (Line (Pulses5 0 0 0 _ _)) -> TurningMeasured
  _ -> FeedMeasured
