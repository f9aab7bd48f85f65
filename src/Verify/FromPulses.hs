-- | Proof of the pulses of a tape: the controller of the machine runs the tape, and its pulses are
-- compared with the motions of the frames and with the feeds that the frames ask.
--
-- The controller runs the tape twice: once for the deviations and once for the feeds. Both runs are
-- streams, so memory does not grow with the tape.
module Verify.FromPulses
  ( prove,
    proveRun,
    methodOf,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses3)
import Base.Quantity (Feed (..), Seconds (..))
import Data.Maybe (fromMaybe, isNothing)
import Frame.Frame qualified as Frame
import Machine.Controller
  ( Controller (..),
    FrequencyLimits (..),
    InterpolationMethod (..),
    StepControl (interpolation),
    frequencyLimits,
    noLimits,
  )
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Pulse.Controller (Console)
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun
  ( ControllerRun (..),
    FrameStart (number, path),
    StopReason (..),
  )
import Pulse.ControllerRun qualified as ControllerRun
import Pulse.FeedWindow qualified as FeedWindow
import Pulse.FramePath (FramePath (Arc, Line, from, to))
import Pulse.FramePath qualified as FramePath
import Pulse.PathDeviation (PathTrace)
import Pulse.PathDeviation qualified as PathDeviation
import Pulse.RunMeasure (FrameMeasure, FrequencyPeak (peakHz), RunTotal (..))
import Pulse.RunMeasure qualified as Measure
import Pulse.Steps (Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps
import Tape.Tape (Tape)
import Verify.PulseProof
  ( FeedExtremes (..),
    FeedWitness (..),
    PulseFinding (..),
    PulseProof (..),
    PulseWitness (..),
  )

-- | Proves the pulses of a tape. The third argument is the position of the cutter before the tape,
-- in pulses. 'Nothing' if the model of the controller makes no pulses.
prove :: Machine -> Console -> Pulses3 -> Tape -> Maybe PulseProof
prove machine console start tape = do
  method <- methodOf machine
  ticks <- Controller.ticksPerSecond machine
  run <- Controller.run machine console start tape
  measured' <- Controller.measured machine console start tape
  pure (proveRun machine method ticks run measured')

-- | Interpolation method of a machine; 'Nothing' if its controller makes no pulses.
methodOf :: Machine -> Maybe InterpolationMethod
methodOf machine = case Machine.controller machine of
  Just (Stepping c) -> Just (interpolation c)
  Just (Integrating _) -> Just DifferentialAnalyser
  Just (Planning _) -> Nothing
  Nothing -> Nothing

-- | Proves the pulses of a run. The arguments are the interpolation method, the frequency of the
-- clock, the run, and the measures of the same run.
proveRun ::
  Machine ->
  InterpolationMethod ->
  Int ->
  ControllerRun ->
  LazyList RunTotal FrameMeasure ->
  PulseProof
proveRun machine method ticks run measured' =
  PulseProof
    { pulseCount = made motions,
      onLines = worstLine motions,
      onArcs = worstArc motions,
      feeds = extremes watch,
      total,
      clock = ticks,
      limits,
      formulaTime = Seconds (byFormula watch),
      pulseFindings =
        [OffMotion first worst | Just first <- [firstOff motions], Just worst <- [worstOff motions]]
          <> [EndMissed n d | Just (Miss n d) <- [firstMiss motions]]
          <> [FeedTooHigh first worst | Just (TooHigh first worst) <- [tooHigh watch]]
          <> driveFindings limits total
          <> stopFinding (stopReason total)
    }
  where
    motions = ControllerRun.fold (watched method) unmoved run
    (watch, total) = allFeeds machine method measured'
    limits = maybe noLimits frequencyLimits (Machine.controller machine)

-- | Axes that are faster, or that jump further, than the description of the machine allows.
driveFindings :: FrequencyLimits -> RunTotal -> [PulseFinding]
driveFindings limits total =
  above AxisTooFast highestFrequency (peaks total)
    <> above JumpTooLarge largestJump (largestJumps total)
  where
    above finding limitOf found =
      [ finding k peak limit
        | Just limit <- [limitOf limits],
          (k, peak) <- zip [0 ..] found,
          peakHz peak > limit * (1 + frequencyAllowance)
      ]

-- | Part by which the frequency of an axis may be above its limit: the last pulse of a frame comes
-- at a whole tick.
frequencyAllowance :: Double
frequencyAllowance = 0.01

stopFinding :: StopReason -> [PulseFinding]
stopFinding why = case why of
  TapeEnds -> []
  ProgramEnds -> []
  Unreadable _ -> [StopsEarly why]
  TooFast {} -> [StopsEarly why]
  FeedHeld _ -> [StopsEarly why]
  SwitchNotSet _ _ -> [StopsEarly why]
  NotCompensated _ _ -> [StopsEarly why]

-- Motions -----------------------------------------------------------------------------------------

-- | State of the comparison with the motions.
data Watch = Watch
  { made :: Int,
    current :: Int,
    currentPath :: FramePath,
    trace :: PathTrace,
    worstLine :: Maybe PulseWitness,
    worstArc :: Maybe PulseWitness,
    -- | the first frame that is further from its motion than is promised, and the worst one
    firstOff :: Maybe PulseWitness,
    worstOff :: Maybe PulseWitness,
    firstMiss :: Maybe Miss
  }

-- | Frame whose pulses do not end at its end, and the last position minus this end.
data Miss = Miss Int Pulses5

unmoved :: Watch
unmoved = Watch 0 0 stillness PathDeviation.begin Nothing Nothing Nothing Nothing Nothing

-- | Path of a frame without motion, and of the time between two frames.
stillness :: FramePath
stillness = Line (Pulses5 0 0 0 0 0)

-- | State after an event.
watched :: InterpolationMethod -> Watch -> ControllerRun -> Watch
watched method w event = case event of
  FrameBegins s _ ->
    w
      { current = number s,
        currentPath = fromMaybe stillness (path s),
        trace = PathDeviation.begin
      }
  Stepped _ steps _ -> afterSteps method steps w
  FrameEnds _ _ ->
    let missed = Steps.plus (PathDeviation.reached (trace w)) (opposite (endOf (currentPath w)))
        w' = withDeviation method (PathDeviation.deviationAtEnd method (currentPath w) (trace w)) w
     in w'
          { currentPath = stillness,
            trace = PathDeviation.begin,
            firstMiss =
              if isNothing (firstMiss w) && missed /= Pulses5 0 0 0 0 0
                then Just (Miss (current w) missed)
                else firstMiss w
          }
  Commanded {} -> w
  JobDone _ _ -> w
  Stopped _ _ -> w
  where
    endOf = FramePath.endOf
    opposite (Pulses5 x y z a b) = Pulses5 (-x) (-y) (-z) (-a) (-b)

afterSteps :: InterpolationMethod -> Steps -> Watch -> Watch
afterSteps method steps w =
  withDeviation
    method
    (PathDeviation.deviation method (currentPath w) trace')
    w {made = made w + Steps.count steps, trace = trace'}
  where
    trace' = PathDeviation.stepped (currentPath w) steps (trace w)

-- | State with one more deviation in the current frame.
withDeviation :: InterpolationMethod -> Double -> Watch -> Watch
withDeviation method d w
  | d > most + PathDeviation.roundingOfDeviation =
    larger {firstOff = Just (fromMaybe witness (firstOff w)), worstOff = worse (worstOff w)}
  | otherwise = larger
  where
    most = PathDeviation.promise method (currentPath w)
    witness = PulseWitness {frame = current w, amount = d, promised = most}
    worse old = case old of
      Just o | amount o >= d -> old
      _ -> Just witness
    larger = case currentPath w of
      Line _
        | d <= 0 && currentPath w == stillness -> w
        | otherwise -> w {worstLine = worse (worstLine w)}
      Arc {} -> w {worstArc = worse (worstArc w)}

-- Feeds -------------------------------------------------------------------------------------------

-- | State of the comparison of feeds.
data FeedWatch = FeedWatch
  { extremes :: FeedExtremes,
    tooHigh :: Maybe TooHigh,
    -- | sum of length by feed, in seconds
    byFormula :: Double,
    -- | highest feed that the frame before may have had at its end: the feed that it asks, and if
    -- it brakes also that of the frame before it
    before :: Double
  }

-- | The first frame whose feed is too high, and the worst one.
data TooHigh = TooHigh FeedWitness FeedWitness

-- | Compares the feeds of all frames; the result also has the total.
allFeeds ::
  Machine -> InterpolationMethod -> LazyList RunTotal FrameMeasure -> (FeedWatch, RunTotal)
allFeeds machine method = go (FeedWatch (FeedExtremes Nothing Nothing Nothing) Nothing 0 0)
  where
    go w list = case list of
      LazyList.End total -> (w, total)
      LazyList.Next m more -> let w' = withMeasure machine method m w in w' `seq` go w' more

-- | State with the measures of one more frame.
withMeasure :: Machine -> InterpolationMethod -> FrameMeasure -> FeedWatch -> FeedWatch
withMeasure machine method m w = case (FramePath.fromFrame frame', Measure.asked m) of
  (Just p, Just asked) ->
    let v = fromMaybe 0 (FramePath.feedAlong machine p asked)
        -- A braking frame begins with the feed at the end of the frame before.
        most = if Frame.braking frame' then max v (before w) else v
        asked' = Demand {demandPath = p, along = v, limit = feedLimit machine method p * most}
     in withFeeds machine asked' m w {before = most}
  _ -> w
  where
    frame' = Measure.frame m

-- | Path of a frame, the feed along it that the frame asks, and the highest feed that is allowed.
data Demand = Demand {demandPath :: FramePath, along :: Double, limit :: Double}

-- | State with the feeds of one more frame.
withFeeds :: Machine -> Demand -> FrameMeasure -> FeedWatch -> FeedWatch
withFeeds machine demand m w = case Measure.feeds m of
  Just (average, low, high)
    | v > 0,
      isRound p ->
      w
        { extremes =
            FeedExtremes
              { meanFeed = keepIf (\a b -> abs (a - 1) > abs (b - 1)) average (meanFeed found),
                leastFeed = keepIf (<) low (leastFeed found),
                highestFeed = keepIf (>) high (highestFeed found)
              },
          tooHigh =
            if high > limit demand
              then Just (raised (witness high))
              else tooHigh w,
          byFormula = byFormula w + 60 * FramePath.pathLength machine p / v
        }
  _ -> w
  where
    p = demandPath demand
    v = along demand
    found = extremes w
    witness f = FeedWitness (Measure.number m) (Feed f) (Feed v)
    ratio (FeedWitness _ (Feed f) (Feed asked)) = f / asked
    keepIf better f old = case old of
      Just o | not (better (f / v) (ratio o)) -> old
      _ -> Just (witness f)
    raised new = case tooHigh w of
      Nothing -> TooHigh new new
      Just (TooHigh first worst) -> TooHigh first (if ratio new > ratio worst then new else worst)

-- | True for a line, and for an arc whose radii differ by 2 pulses at most. Others have no feed
-- along the arc, because a line leads to their end; a control refuses them.
isRound :: FramePath -> Bool
isRound p = case p of
  Line _ -> True
  Arc {from = a, to = b} -> abs (radius a - radius b) <= 2
  where
    radius (x, y) = sqrt (fromIntegral (x * x + y * y)) :: Double

-- | Largest feed that the controller may have over a window of a path, as a multiple of the feed
-- that the frame asks.
--
-- On an arc by an evaluation function the pulses come evenly. The feed along the arc is v·4\/π
-- where the arc is parallel to an axis, and least on the diagonals. Elsewhere 2.5 % are allowed.
--
-- A window is a whole number of pulses, so a window of n pulses may be shorter in time by one of
-- them. On a line by an evaluation function, where one axis makes a pulse at a time, the n pulses
-- of the leading axis may lack one pulse of each other axis. If no pulse is left, there is no
-- limit.
feedLimit :: Machine -> InterpolationMethod -> FramePath -> Double
feedLimit machine method p = case (method, p) of
  (EvaluationFunction, Arc {}) -> evaluationSwing * pulseStep 1
  (EvaluationFunction, Line d) ->
    max 1.025 (pulseStep (max 1 (length (filter (/= 0) (Steps.toList d)) - 1)))
  (DifferentialAnalyser, _) -> max 1.025 (pulseStep 1)
  where
    n = FeedWindow.pulsesInWindow machine p
    pulseStep lacking =
      if n <= lacking then 1 / 0 else fromIntegral n / fromIntegral (n - lacking)

-- | Highest feed on an arc by an evaluation function, as a multiple of the mean feed.
evaluationSwing :: Double
evaluationSwing = 4 / pi
