-- | Feed of a control with a feed integrator: the content of its cell V while a frame runs.
--
-- Feeds are in mm\/min along x, y and z, or in degrees a minute if only rotary axes move; lengths
-- are in mm or in degrees.
module Pulse.IntegratorFeed
  ( FeedPlan (..),
    plan,
    largestFeed,
    cell,
    turnedTo,
    accelerated,
    lengthLeft,
    stoppable,
    initial,
    waitBounds,
  )
where

import Base.Quantity (Mm (..), Seconds (..))
import Data.Maybe (fromMaybe)
import Machine.Controller
  ( ControlJob (..),
    IntegratorControl (..),
    InterpolationMethod (..),
    JobRequest (..),
  )
import Machine.Controller qualified as Controller
import Machine.Machine (Axis (X), Machine)
import Machine.Machine qualified as Machine
import Pulse.Dispatcher qualified as Dispatcher
import Pulse.EvaluationArc qualified as EvaluationArc
import Pulse.FeedIntegrator qualified as FeedIntegrator
import Pulse.FramePath (FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.Interpolator (Interpolator)
import Pulse.Interpolator qualified as Interpolator

-- | Frame at work.
data FeedPlan = FeedPlan
  { interpolator :: Interpolator,
    -- | feed that the frame asks, corrected
    target :: Double,
    -- | overflows per second for each unit of the feed
    perFeed :: Double,
    -- | length of the path for each cycle of a line
    perCycle :: Double,
    -- | radius of an arc at its start; 0 for a line
    arcRadius :: Double,
    -- | length of one pulse in the plane
    pulse :: Double,
    -- | ticks of an interpolation cycle
    cycleTicks :: Int,
    -- | cycles on the arc since the direction was last requested
    cyclesDone :: Int
  }

-- | Plan of a frame with the given path, which asks the feed @asked@ in mm\/min. @ahead@ is the
-- count of cycles after which an arc has the direction for which its feed is computed.
plan :: Machine -> IntegratorControl -> Int -> FramePath -> Double -> FeedPlan
plan machine control ahead path asked =
  turnedTo
    ahead
    FeedPlan
      { interpolator = Interpolator.start DifferentialAnalyser path,
        target = asked,
        perFeed = largestShare / 60,
        perCycle,
        arcRadius,
        pulse,
        cycleTicks,
        cyclesDone = 0
      }
  where
    Mm pulse = Machine.resolutionOf machine X
    (largestShare, perCycle, arcRadius, cycleTicks) = case path of
      Line d ->
        let long = FramePath.pathLength machine path
            n = fromIntegral (FramePath.leadingPulses d)
         in (n / long, long / n, 0, lineCycle control)
      Arc {from = (x, y)} ->
        (1 / pulse, pulse, pulse * sqrt (fromIntegral (x * x + y * y)), arcCycle control)

-- | Largest feed that the control can run in a frame: the interpolation cycle ends before the next
-- overflow, and a job that changes the feed fits between two overflows. The plan must be new.
largestFeed :: IntegratorControl -> FramePath -> FeedPlan -> Double
largestFeed control path p = fromIntegral (clock control) / fromIntegral ticks / share
  where
    isArc = case path of
      Arc {} -> True
      Line _ -> False
    share = if isArc then 1 / pulse p / 60 else perFeed p
    ticks = maximum (cycleTicks p : [withJob j | j <- jobs control, changesFeed (request j)])
    withJob j = cycleTicks p + duration j + 1
    changesFeed r = case r of
      AtAcceleration _ -> True
      AtDirection _ _ -> isArc
      AtCharacter -> False
      AtNumber -> False
      AtTransfer -> False
      AtCompensation -> False
      Periodic _ -> False
      AfterCommand {} -> False

-- | Content of the cell V for the feed @v@.
cell :: IntegratorControl -> FeedPlan -> Double -> Int
cell control p v =
  FeedIntegrator.cellFor (Controller.capacity control) (clock control) (v * perFeed p)

-- | Plan with the share of the leading axis that an arc has after the given count of cycles.
turnedTo :: Int -> FeedPlan -> FeedPlan
turnedTo ahead p = case Interpolator.evaluationArc (interpolator p) of
  Nothing -> p
  Just w -> p {perFeed = EvaluationArc.leadingShare ahead w / pulse p / 60, cyclesDone = 0}

-- | Feed after one step of the acceleration in the time @t@. The arguments are also the feed
-- before, and the feed at the end of the frame. The feed is at least that of one step, so that
-- every frame ends.
accelerated :: IntegratorControl -> Seconds -> FeedPlan -> Double -> Double -> Double
accelerated control (Seconds t) p endFeed v =
  min (target p) (max step (min (v + step) (sqrt (endFeed * endFeed + 2 * a * lengthLeft p))))
  where
    a = pathAcceleration control * 3600
    step = pathAcceleration control * t * 60

-- | Length of the path up to the end of the frame.
lengthLeft :: FeedPlan -> Double
lengthLeft p = case Interpolator.evaluationArc (interpolator p) of
  Just w -> arcRadius p * EvaluationArc.angleLeft w
  Nothing -> perCycle p * maybe 0 fromIntegral (Interpolator.cycles (interpolator p))

-- | Largest feed from which the control stops within the given length.
stoppable :: IntegratorControl -> Double -> Double
stoppable control long = sqrt (2 * pathAcceleration control * 3600 * long)

-- | Feed at the beginning of a frame that asks the feed @asked@, after a frame that ended with the
-- feed @before@: that feed, but at least one step of the acceleration, and at most @asked@.
-- Without a job for the acceleration it is @asked@.
initial :: IntegratorControl -> Double -> Double -> Double
initial control asked before = case [t | ControlJob {request = AtAcceleration t} <- jobs control] of
  [] -> asked
  Seconds t : _ -> min asked (max before (pathAcceleration control * t * 60))

-- | Bound for the ticks that each job waits between its request and its start, while the feed makes
-- at most @frequency@ overflows per second. 'Nothing' for a job that may have no time at this feed.
--
-- A frame has two rows at least, and a word one. Between two requests of the other jobs lies the
-- time or the count of cycles in their description.
waitBounds :: IntegratorControl -> Double -> [(ControlJob, Maybe Int)]
waitBounds control frequency =
  [(j, bound j (take n (jobs control))) | (n, j) <- zip [1 ..] (jobs control)]
  where
    bound j upToIt =
      Dispatcher.longestWait
        (max (lineCycle control) (arcCycle control))
        (Controller.capacity control)
        v
        (duration j)
        (maximum (map duration (jobs control)))
        [(duration k, leastInterval (request k)) | k <- upToIt]
    v = FeedIntegrator.cellFor (Controller.capacity control) (clock control) frequency
    timed = fromMaybe 1 . Controller.requestInterval control
    row = timed AtCharacter
    leastInterval r = case r of
      AtCharacter -> row
      AtNumber -> row
      AtTransfer -> 2 * row
      AtCompensation -> 2 * row
      AtDirection n _ -> n * (Controller.capacity control `quot` v)
      AtAcceleration _ -> timed r
      Periodic _ -> timed r
      AfterCommand _ t _ -> Controller.ticksIn (clock control) t
