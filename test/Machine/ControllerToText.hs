-- | Writes a controller as a section of a description with all its values.
module Machine.ControllerToText
  ( controllerLines,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Seconds (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Controller
import Machine.FrameLayout (CommandName (..))

-- | The lines within the section @controller@.
controllerLines :: Controller -> [Text]
controllerLines control = case control of
  Stepping c ->
    [ "interpolator " <> case interpolation c of
        DifferentialAnalyser -> "differential-analyser"
        EvaluationFunction -> "evaluation-function",
      "clock " <> Decimal.whole (stepClock c) <> " Hz"
    ]
      <> [ "ramp " <> Decimal.exact (acceleration r) <> " mm/s2 every " <> seconds (interval r)
           | Just r <- [ramp c]
         ]
      <> maybe ["reader none"] readerLines (stepReader c)
      <> limitLines (stepLimits c)
  Planning c ->
    [ "interpolator path-planner",
      "acceleration " <> Decimal.exact (plannedAcceleration c) <> " mm/s2",
      "corners " <> case corners c of
        ExactStop -> "exact-stop"
        Blending -> "blended"
    ]
  Integrating c ->
    [ "interpolator feed-integrator",
      "clock " <> Decimal.whole (clock c) <> " Hz",
      "capacity " <> Decimal.whole (bits c) <> " bits",
      "acceleration " <> Decimal.exact (pathAcceleration c) <> " mm/s2",
      "override " <> Text.unwords (map Decimal.whole (override c)),
      "cycle-line " <> Decimal.whole (lineCycle c) <> " ticks",
      "cycle-arc " <> Decimal.whole (arcCycle c) <> " ticks",
      "switches " <> Decimal.whole (switches c)
    ]
      <> readerLines (reader c)
      <> limitLines (driveLimits c)
      <> concatMap jobLines (jobs c)

limitLines :: FrequencyLimits -> [Text]
limitLines l =
  ["highest-frequency " <> Decimal.exact hz <> " Hz" | Just hz <- [highestFrequency l]]
    <> ["largest-jump " <> Decimal.exact hz <> " Hz" | Just hz <- [largestJump l]]

readerLines :: TapeReader -> [Text]
readerLines r =
  [ "reader " <> Decimal.exact (rowsPerSecond r) <> " rows/s",
    "start-time " <> seconds (startTime r)
  ]
    <> ["frames-ahead " <> Decimal.whole (framesAhead r) | framesAhead r > 1]
    <> ["fault-signal \"" <> t <> "\"" | Just t <- [faultSignal r]]

jobLines :: ControlJob -> [Text]
jobLines j =
  [ "job " <> jobName j <> " {",
    "length " <> Decimal.whole (duration j) <> " ticks",
    "priority " <> Decimal.whole (priority j),
    "request " <> case request j of
      AtCharacter -> "character"
      AtNumber -> "number"
      AtTransfer -> "transfer"
      AtCompensation -> "compensation"
      AtDirection a b -> "direction " <> Decimal.whole a <> " " <> Decimal.whole b <> " cycles"
      AtAcceleration t -> "acceleration " <> seconds t
      Periodic t -> "every " <> seconds t
      AfterCommand (CommandName n) t k ->
        "command \"" <> n <> "\" " <> seconds t <> " " <> Decimal.whole k <> " times",
    "}"
  ]

seconds :: Seconds -> Text
seconds (Seconds t) = Decimal.exact t <> " s"
