-- | Times of the frames of a control of which only the path is modelled, after LinuxCNC.
--
-- On a path of length L with the feed v and the acceleration a, the speed grows to u = min(v,
-- √(a·L)) and falls again. With an exact stop the frame takes L\/u + u\/a. With blending, the next
-- frame begins when the present one starts to decelerate, u\/a earlier. A frame without motion
-- ends the blending. A dwell takes its time.
--
-- On an arc of radius r, half of the acceleration is kept for the change of direction: the feed is
-- at most √(a·r\/2), and the acceleration along the path is then √¾·a. At a lower feed it is
-- √(a² − (v²\/r)²). Source: LinuxCNC, trajectory planner. What blending does to the path is not
-- modelled.
module Pulse.PathPlanner
  ( measure,
    clock,
    travelTime,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.Quantity (Mm (..), Seconds (..))
import Data.Maybe (fromMaybe)
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Machine.Controller (CornerPolicy (..), PathControl (..))
import Machine.Machine (Axis (X), CommandName, Machine)
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (StopReason (..))
import Pulse.FramePath (FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.RunMeasure (FrameMeasure (..), RunTotal (..))
import Pulse.RunMeasure qualified as RunMeasure
import Pulse.Steps (Pulses5 (..))
import Pulse.Steps qualified as Steps
import Tape.Damage (Damage)
import Tape.Punch (TapeFrame (..))

-- | Frequency of the ticks in which the times are given.
clock :: Int
clock = 1000000

-- | State before a frame: its number, its start in seconds, the position, and the sum of pulses.
data Place = Place {next :: Int, startsAt :: Double, at :: Pulses5, sumOfPulses :: Pulses5}

-- | Times of the frames of a tape. The third argument lists the commands that end a program.
measure ::
  Machine ->
  PathControl ->
  [(CommandName, Int)] ->
  LazyList (Maybe Damage) TapeFrame ->
  LazyList RunTotal FrameMeasure
measure machine control lastCommands = go (Place 1 0 zero zero)
  where
    zero = Pulses5 0 0 0 0 0
    go place frames = case frames of
      LazyList.End damage -> stopped place (maybe TapeEnds Unreadable damage)
      LazyList.Next f more ->
        let (m, place') = timed machine control place (frameRead f) (follows more)
            final = if isFinal (frameRead f) then stopped place' ProgramEnds else go place' more
         in LazyList.Next m final
    isFinal f = not (null lastCommands) && all (`elem` Frame.commands f) lastCommands
    stopped place why =
      LazyList.End
        RunMeasure.emptyTotal
          { totalTicks = ticks (startsAt place),
            totalPulses = sumOfPulses place,
            stopReason = why
          }
    follows more = case more of
      LazyList.Next f _ -> Frame.isMoving (frameRead f)
      LazyList.End _ -> False

ticks :: Double -> Int
ticks t = round (t * fromIntegral clock)

-- | Times of one frame, and the state after it. The flag is true if the next frame moves.
timed :: Machine -> PathControl -> Place -> Frame -> Bool -> (FrameMeasure, Place)
timed machine control place f isFollowed = (m, place')
  where
    path = FramePath.fromFrame f
    long = maybe 0 (FramePath.pathLength machine) path
    asked' = FramePath.askedFeed machine f
    v = fromMaybe 0 (path >>= \p -> FramePath.feedAlong machine p asked') / 60
    (whole, braking) = maybe (0, 0) (\p -> travelTime machine control p long v) path
    lasts
      | corners control == Blending && isFollowed = whole - braking
      | otherwise = whole
    end = startsAt place + lasts + dwelt
    Seconds dwelt = Machine.dwellIn machine (Frame.commands f)
    d = maybe (Pulses5 0 0 0 0 0) FramePath.endOf path
    place' =
      Place
        { next = next place + 1,
          startsAt = end,
          at = Steps.plus (at place) d,
          sumOfPulses = Steps.plus (sumOfPulses place) (magnitude d)
        }
    mean = 60 * long / whole
    m =
      FrameMeasure
        { number = next place,
          frame = f,
          centrePath = path,
          beginsAt = ticks (startsAt place),
          endsAt = ticks end,
          waitedFor = 0,
          isInCut = False,
          positionAfter = at place',
          pulses = magnitude d,
          asked = asked' <$ path,
          feeds = if whole > 0 then Just (mean, 0, 60 * highest) else Nothing,
          frequencies = [],
          jumps = [],
          commands = [(ticks (startsAt place), c, n) | (c, n) <- Frame.commands f]
        }
    highest = maybe 0 (\p -> let (u, _) = reached machine control p long v in u) path
    magnitude (Pulses5 x y z a b) = Pulses5 (abs x) (abs y) (abs z) (abs a) (abs b)

-- | Time in seconds of a path with a stop at both ends, and the part of it in which the machine
-- decelerates. The arguments are also the length in mm and the feed in mm\/s.
travelTime :: Machine -> PathControl -> FramePath -> Double -> Double -> (Double, Double)
travelTime machine control path long v
  | long <= 0 || v <= 0 = (0, 0)
  | otherwise = (long / u + u / a, u / a)
  where
    (u, a) = reached machine control path long v

-- | Highest speed on a path in mm\/s, and the acceleration along it in mm\/s².
reached :: Machine -> PathControl -> FramePath -> Double -> Double -> (Double, Double)
reached machine control path long v = (min limit (sqrt (along * long)), along)
  where
    a = plannedAcceleration control
    (limit, along) = case path of
      Line _ -> (v, a)
      Arc {from = (x, y)} ->
        let Mm pulse = Machine.resolutionOf machine X
            r = pulse * sqrt (fromIntegral (x * x + y * y))
            most = sqrt (a * r / 2)
         in if v >= most
              then (most, sqrt 0.75 * a)
              else (v, a * sqrt (1 - (v * v / r / a) * (v * v / r / a)))
