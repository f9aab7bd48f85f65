-- | Dwells of the machine between two feed moves, because the next frame is not read in time.
--
-- A frame is read while the frame before it runs. So the machine stands still before a frame if
-- its reading takes longer than the frame before. This module computes both times without running
-- the pulses.
--
-- /Step controllers./ The time of a line without a ramp is exact: it is that of its cycles. For an
-- arc, and for a frame in a ramp, the time is an upper bound.
--
-- /Feed integrators./ The time of a frame depends on its ramps, and these on when the next frame is
-- read. So the time here is an upper bound: the feed rises from standstill and falls to standstill
-- on every path of a frame. Under cutter compensation a frame may have the arc round a corner too.
--
-- So every dwell that is found is one of the real run. With ramps or arcs a dwell may be missed, if
-- the frame before it is nearly long enough.
module Pulse.ReaderDwell
  ( dwells,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.Quantity (Mm (..), Seconds (..))
import Data.List (foldl')
import Frame.Frame (Frame)
import Machine.Controller
  ( ControlJob (..),
    Controller (..),
    IntegratorControl (..),
    InterpolationMethod (..),
    JobRequest (..),
    SpeedRamp (..),
    StepControl (..),
    TapeReader (..),
  )
import Machine.Machine (Axis (X), Machine)
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (Tick)
import Pulse.FeedIntegrator qualified as FeedIntegrator
import Pulse.FrameCompensation (PreparedFrame (..))
import Pulse.FramePath (FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.IntegratorFeed qualified as Feed
import Pulse.RunMeasure qualified as RunMeasure
import Pulse.StepRun qualified as StepRun
import Tape.Punch (TapeFrame (..))

-- | Numbers of the frames before which the machine stands still, although this frame and the frame
-- before are feed moves. None for a controller that does not read the tape while it runs.
dwells :: Machine -> LazyList e PreparedFrame -> [Int]
dwells machine frames = case Machine.controller machine of
  Just (Stepping c) | Just r <- stepReader c -> found machine (stepTimes machine c r) frames
  Just (Integrating c) -> found machine (integratorTimes machine c) frames
  _ -> []

-- | Times of a controller in ticks.
data Times = Times
  { -- | time of a frame that moves, and the content of the cell U after it, which is the third
    -- argument before it
    moveTicks :: Frame -> FramePath -> Integer -> (Tick, Integer),
    -- | time for reading a count of rows
    readTicks :: Int -> Tick,
    -- | count of frames that are read before the first one begins
    storedFrames :: Int
  }

-- | Frame before the next one: its time, and true if it is a feed move.
data Before = Before {lasts :: Tick, isFeedMove :: Bool}

found :: Machine -> Times -> LazyList e PreparedFrame -> [Int]
found machine times = go 1 0 (Before 0 False)
  where
    along taken (t, u) path = let (t', u') = moveTicks times taken path u in (t + t', u')
    go :: Int -> Integer -> Before -> LazyList e PreparedFrame -> [Int]
    go n u before list = case list of
      LazyList.End _ -> []
      LazyList.Next f more ->
        let taken = frameRead (tapeFrame f)
            (t, u') = foldl' (along taken) (0, u) (paths f)
            isFeed = RunMeasure.isAtFeed machine taken
            needed = readTicks times (rowsRead (tapeFrame f))
            isLate = n > storedFrames times && needed > lasts before
            others = go (n + 1) u' (Before t isFeed) more
         in u' `seq` if isFeed && isFeedMove before && isLate then n : others else others

-- | Ticks for reading a count of rows; the second argument is the frequency of the clock.
ticksToRead :: TapeReader -> Int -> Int -> Tick
ticksToRead TapeReader {rowsPerSecond, startTime = Seconds t} ticks rows =
  ceiling ((t + fromIntegral rows / rowsPerSecond) * fromIntegral ticks)

-- Step controllers --------------------------------------------------------------------------------

stepTimes :: Machine -> StepControl -> TapeReader -> Times
stepTimes machine c r =
  Times
    { moveTicks = stepTicks machine c,
      readTicks = ticksToRead r (stepClock c),
      storedFrames = framesAhead r
    }

-- | Ticks of a frame. The content of the cell U matters only if the time is exact.
stepTicks :: Machine -> StepControl -> Frame -> FramePath -> Integer -> (Tick, Integer)
stepTicks machine c f path u = case (path, ramp c) of
  (Line _, Nothing) ->
    let t = (cycleCount * limit - u + v - 1) `div` v
     in (fromInteger t, u + t * v - cycleCount * limit)
  (_, slope) -> (ceiling ((even' + maybe 0 rising slope) * ticks) + 1, 0)
  where
    (asked, perFeed) = StepRun.rateOf machine c path f
    ticks = fromIntegral (stepClock c)
    limit = toInteger StepRun.cellCapacity
    v =
      toInteger
        (FeedIntegrator.cellFor StepRun.cellCapacity (stepClock c) (asked * perFeed))
    cycleCount = toInteger (cyclesOf machine (interpolation c) path)
    even' = fromInteger cycleCount / (ticks * fromInteger v / fromInteger limit) :: Double
    -- Time that is lost while the feed rises from 0, and two steps of the ramp.
    rising SpeedRamp {acceleration, interval = Seconds t} =
      asked / 60 / acceleration / 2 + 2 * t

-- | Count of cycles on a path; on an arc, a count that is not exceeded. A length l along an arc has
-- at most √2·l pulses.
cyclesOf :: Machine -> InterpolationMethod -> FramePath -> Int
cyclesOf machine method path = case (path, method) of
  (Line d, DifferentialAnalyser) -> FramePath.leadingPulses d
  (Line d, EvaluationFunction) -> FramePath.allPulses d
  (Arc {}, _) -> ceiling (longest machine path / pulseOf machine)

-- | Upper bound for the sum of the travels along both axes of an arc, in mm. A line of a few pulses
-- may lead to its end, and its radii may differ.
longest :: Machine -> FramePath -> Double
longest machine path = case path of
  Line _ -> FramePath.pathLength machine path
  Arc {from, to} ->
    sqrt 2
      * ( FramePath.pathLength machine path
            + pulseOf machine * (abs (radius from - radius to) + 4)
        )
  where
    radius (x, y) = sqrt (fromIntegral (x * x + y * y)) :: Double

pulseOf :: Machine -> Double
pulseOf machine = let Mm pulse = Machine.resolutionOf machine X in pulse

-- Feed integrators --------------------------------------------------------------------------------

integratorTimes :: Machine -> IntegratorControl -> Times
integratorTimes machine c =
  Times
    { moveTicks = \f path u -> (integratorTicks machine c f path, u),
      readTicks = ticksToRead (reader c) (clock c),
      storedFrames = 1
    }

-- | Upper bound for the ticks of a frame from standstill to standstill.
--
-- The feed rises by the acceleration in steps, each at the end of its interval, and falls as
-- √(2·a·l) with the length l that is left. Two more intervals cover that a step comes late. On an
-- arc the feed is computed for a direction some cycles ahead. It is too low by √½ at most, and the
-- end of the arc may be a few pulses further. The cell V is a whole number, so the feed may be too
-- low by half a unit of it.
integratorTicks :: Machine -> IntegratorControl -> Frame -> FramePath -> Tick
integratorTicks machine c f path = ceiling (seconds * fromIntegral (clock c)) + 1
  where
    v = FramePath.feedValue (FramePath.askedFeed machine f) / 60
    a = pathAcceleration c
    intervals = [t | ControlJob {request = AtAcceleration (Seconds t)} <- jobs c]
    long = longest machine path
    lowest = case intervals of
      [] -> v
      t : _ -> min v (a * t)
    rounded =
      1
        + 1
          / (2 * fromIntegral (Feed.cell c (Feed.plan machine c 0 path (60 * v)) (60 * lowest)))
    seconds = case intervals of
      [] -> rounded * long / v
      t : _
        | long >= v * v / a -> rounded * (long / v + v / a) + 2 * t
        | otherwise -> rounded * 2 * sqrt (long / a) + 2 * t
