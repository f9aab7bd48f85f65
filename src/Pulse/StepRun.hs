-- | Run of a controller that makes pulses of one frame after the other: ЛКП-01Ф, Контур, ЛКИ.
--
-- /Cycles./ One cycle of the interpolator runs at each overflow of a feed clock. For a digital
-- differential analyser a cycle is a pulse of the leading axis, and its frequency is that of the
-- feed code, or v·n\/L for a path speed v, n pulses of the leading axis and the length L. For
-- evaluation functions a cycle is one pulse of any axis: v·n\/L with the pulses n of all axes, and
-- 4\/π·v\/pulse on an arc, which is right in the mean over a quadrant.
--
-- /Ramps./ If the controller has a ramp, a rising feed grows by the acceleration in equal steps of
-- time. A falling feed does so only in a braking frame, which then keeps its feed.
--
-- /Reading./ Frame n + 1 is read while frame n runs. If the next frame is not read at the end of a
-- frame, the controller waits. A controller without a reader never waits.
module Pulse.StepRun
  ( run,
    rateOf,
    cellCapacity,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.Quantity (Mm (..), Seconds (..))
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Machine.Controller
  ( InterpolationMethod (..),
    SpeedRamp (..),
    StepControl (..),
    TapeReader (..),
  )
import Machine.Controller qualified as Controller
import Machine.FrameLayout (CommandName)
import Machine.Machine (Axis (X), Machine)
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (ControllerRun (..), FrameStart (FrameStart), StopReason (..), Tick)
import Pulse.FeedIntegrator (FeedIntegrator (..))
import Pulse.FeedIntegrator qualified as FeedIntegrator
import Pulse.FramePath (AskedFeed (..), FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.Interpolator (Interpolator)
import Pulse.Interpolator qualified as Interpolator
import Pulse.Steps (Cycle (..))
import Tape.Damage (Damage)
import Tape.Punch (TapeFrame (..))

-- | State between two frames.
data Rest = Rest
  { number :: Int,
    -- | end of the frame before
    now :: Tick,
    -- | tick at which the next frame is read
    readAt :: Tick,
    -- | count of frames that were read before the first one began, and that have not begun
    stored :: Int,
    clock :: FeedIntegrator,
    -- | feed along the path at the end of the frame before, in mm\/min
    feed :: Double
  }

-- | Constants of a run: the machine, its controller, the correction of the feed as a factor, and
-- the commands that end a program.
data Setup = Setup
  { machine :: Machine,
    control :: StepControl,
    correction :: Double,
    lastCommands :: [(CommandName, Int)]
  }

-- | Run of the frames of a tape. The third argument is the correction of the feed, a factor; the
-- fourth lists the commands that end a program.
run ::
  Machine ->
  StepControl ->
  Double ->
  [(CommandName, Int)] ->
  LazyList (Maybe Damage) TapeFrame ->
  ControllerRun
run machine control correction lastCommands frames = between setup rest frames
  where
    setup = Setup {machine, control, correction, lastCommands}
    (rows, count) = maybe (0, 0) (\r -> firstFrames (framesAhead r) frames) (stepReader control)
    rest =
      Rest
        { number = 1,
          now = 0,
          readAt = readingTime control rows,
          stored = count,
          clock = FeedIntegrator.start cellCapacity,
          feed = 0
        }

-- | Capacity of the cell U: with this capacity the frequency of a feed clock of 1 MHz is exact to
-- 10⁻⁶ pulses per second.
cellCapacity :: Int
cellCapacity = 2 ^ (40 :: Int)

-- | Count of the rows of the first frames, at most the given count of frames, and how many frames
-- these are.
firstFrames :: Int -> LazyList e TapeFrame -> (Int, Int)
firstFrames n frames = case frames of
  LazyList.Next f more
    | n > 0 -> let (rows, k) = firstFrames (n - 1) more in (rows + rowsRead f, k + 1)
  _ -> (0, 0)

-- | Ticks in which the tape starts and the given count of rows is read; 0 without a reader.
readingTime :: StepControl -> Int -> Tick
readingTime control rows = case stepReader control of
  Nothing -> 0
  Just TapeReader {rowsPerSecond, startTime = Seconds t} ->
    ceiling ((t + fromIntegral rows / rowsPerSecond) * fromIntegral (stepClock control))

-- | Events from the end of a frame on.
between :: Setup -> Rest -> LazyList (Maybe Damage) TapeFrame -> ControllerRun
between setup rest frames = case frames of
  LazyList.End damage -> Stopped (now rest) (maybe TapeEnds Unreadable damage)
  LazyList.Next TapeFrame {frameRead = f} more ->
    let begin = max (now rest) (readAt rest)
        stored' = stored rest - 1
        -- The next frame is stored already, or its reading starts as this frame begins.
        readAt' = case more of
          LazyList.Next next _ | stored' <= 0 -> begin + readingTime (control setup) (rowsRead next)
          _ -> begin
        -- While the controller waits for the reader, the axes stand.
        feed' = if begin > now rest then 0 else feed rest
        rest' = rest {now = begin, readAt = readAt', stored = stored', feed = feed'}
        path = FramePath.fromFrame f
        motion = inFrame setup rest' f path more
     in FrameBegins
          (FrameStart begin (number rest) f path (begin - now rest))
          (foldr (uncurry (Commanded begin)) motion (Frame.commands f))

-- | Events of a frame after its commands.
inFrame ::
  Setup -> Rest -> Frame -> Maybe FramePath -> LazyList (Maybe Damage) TapeFrame -> ControllerRun
inFrame setup rest f path more = case path of
  Nothing
    | not (null (lastCommands setup)) && all (`elem` Frame.commands f) (lastCommands setup) ->
      Stopped (now rest) ProgramEnds
    | otherwise -> FrameEnds (now rest) (after here)
  Just p
    | correction setup <= 0 -> Stopped (now rest) (FeedHeld (number rest))
    | frequency > fromIntegral ticks ->
      Stopped (now rest) (TooFast (number rest) (withUnit value) (withUnit largest))
    | otherwise ->
      moving
        Profile
          { cyclesPerFeed = perFeed,
            target = value * correction setup,
            change = changeOf setup f rest (value * correction setup),
            ticksPerSecond = ticks
          }
        after
        (Interpolator.start (interpolation (control setup)) p)
        here
    where
      (value, perFeed) = rateOf (machine setup) (control setup) p f
      withUnit = FramePath.feedOn (machine setup) p
      frequency = value * correction setup * perFeed
      largest = fromIntegral ticks / perFeed / correction setup
  where
    ticks = stepClock (control setup)
    here = Moment (now rest) (clock rest) (feed rest)
    after (Moment t c v) =
      between setup rest {number = number rest + 1, now = t, clock = c, feed = v} more

-- | Feed that a frame asks, and the count of cycles per second for each unit of it.
rateOf :: Machine -> StepControl -> FramePath -> Frame -> (Double, Double)
rateOf machine control path f = case FramePath.askedFeed machine f of
  OfLeadingAxis hz -> (hz, 1)
  Along v -> (v, 1 / 60 * cyclesPerLength)
  Turning v -> (v, 1 / 60 * cyclesPerLength)
  where
    cyclesPerLength = case (path, interpolation control) of
      (Line d, DifferentialAnalyser) -> fromIntegral (FramePath.leadingPulses d) / long
      (Line d, EvaluationFunction) -> fromIntegral (FramePath.allPulses d) / long
      (Arc {}, _) -> 4 / pi / pulse
    long = FramePath.pathLength machine path
    Mm pulse = Machine.resolutionOf machine X

-- | Change of the feed within a frame: the feed at its beginning, and the change per step of the
-- ramp, with the ticks of a step. The change is 0 if the feed jumps at once.
data Change = Change {initialFeed :: Double, feedStep :: Double, stepTicks :: Int}

-- | Change of the feed in a frame that asks the feed @asked@.
changeOf :: Setup -> Frame -> Rest -> Double -> Change
changeOf setup f rest asked = case ramp (control setup) of
  Just SpeedRamp {acceleration, interval = interval@(Seconds t)}
    | asked > feed rest || Frame.braking f ->
      let step = acceleration * t * 60
          first = if asked > feed rest then min asked (feed rest + step) else feed rest
       in Change first step (Controller.ticksIn (stepClock (control setup)) interval)
  _ -> Change asked 0 0

-- | Feed within a frame.
data Profile = Profile
  { -- | cycles per second for each unit of the feed
    cyclesPerFeed :: Double,
    -- | feed at the end of a ramp
    target :: Double,
    change :: Change,
    ticksPerSecond :: Int
  }

-- | Moment of a motion: the tick, the integrator and the feed.
data Moment = Moment {at :: Tick, integrator :: FeedIntegrator, feedNow :: Double}

-- | Events of the motion of a frame, which begins at a moment. @after@ gives the events after it.
moving :: Profile -> (Moment -> ControllerRun) -> Interpolator -> Moment -> ControllerRun
moving profile after interpolator moment =
  ramping profile after interpolator first (at moment + stepTicks (change profile))
  where
    first = withFeed profile (initialFeed (change profile)) moment

-- | Moment with another feed.
withFeed :: Profile -> Double -> Moment -> Moment
withFeed profile v m =
  m {feedNow = v, integrator = (integrator m) {cellV = FeedIntegrator.cellFor cellCapacity f hz}}
  where
    f = ticksPerSecond profile
    hz = v * cyclesPerFeed profile

-- | Events of a motion while the feed changes. The last argument is the tick at which it changes
-- next.
ramping ::
  Profile -> (Moment -> ControllerRun) -> Interpolator -> Moment -> Tick -> ControllerRun
ramping profile after interpolator m changeAt
  | feedNow m == target profile = steady after (feedNow m) interpolator (at m) (integrator m)
  | Interpolator.isFinished interpolator = FrameEnds (at m) (after m)
  | changeAt < at m + n =
    let c = FeedIntegrator.pass (changeAt - at m) (integrator m)
        passed = m {at = changeAt, integrator = c}
        later = changeAt + stepTicks (change profile)
     in ramping profile after interpolator (withFeed profile changed passed) later
  | otherwise = case Interpolator.next interpolator of
    Cycle steps rest ->
      let m' = m {at = at m + n, integrator = FeedIntegrator.overflow n (integrator m)}
       in Stepped (at m') steps (ramping profile after rest m' changeAt)
    Finished -> FrameEnds (at m) (after m)
  where
    n = FeedIntegrator.ticksToOverflow (integrator m)
    dv = feedStep (change profile)
    changed
      | feedNow m < target profile = min (target profile) (feedNow m + dv)
      | otherwise = max (target profile) (feedNow m - dv)

-- | Events of a motion with the constant feed @v@.
steady ::
  (Moment -> ControllerRun) -> Double -> Interpolator -> Tick -> FeedIntegrator -> ControllerRun
steady after v = go
  where
    go interpolator t c = case Interpolator.next interpolator of
      Cycle steps rest ->
        let n = FeedIntegrator.ticksToOverflow c
         in Stepped (t + n) steps (go rest (t + n) (FeedIntegrator.overflow n c))
      Finished -> FrameEnds t (after (Moment t c v))
