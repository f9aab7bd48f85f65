{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The table of a machine's controller: how it interpolates, its clock, its reader and its jobs.
module Cli.ControllerTable
  ( controllerRows,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Seconds (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Controller
import Machine.FrameLayout (CommandName (..))
import Pulse.IntegratorFeed qualified as IntegratorFeed

-- | Rows of two columns: a property of the controller, and its value.
controllerRows :: Controller -> [[Text]]
controllerRows control = case control of
  Stepping c -> stepRows c
  Integrating c -> integratorRows c
  Planning c ->
    [ ["interpolator", "path planner: times only, no pulses"],
      ["acceleration", number (plannedAcceleration c) <> " mm/s²"],
      [ "corners",
        case corners c of
          ExactStop -> "the machine stops at the end of each frame"
          Blending -> "the next frame begins when the present one slows down"
      ]
    ]

stepRows :: StepControl -> [[Text]]
stepRows c =
  [ [ "interpolator",
      case interpolation c of
        DifferentialAnalyser -> "digital differential analyser"
        EvaluationFunction -> "evaluation function"
    ],
    ["clock", Decimal.whole (stepClock c) <> " Hz"],
    [ "rising feed",
      case ramp c of
        Nothing -> "without a ramp"
        Just r ->
          number (acceleration r) <> " mm/s², a step every " <> milliseconds (interval r)
    ]
  ]
    <> maybe
      [["reader", "none: the controller works away from the machine"]]
      readerRows
      (stepReader c)
    <> limitRows (stepLimits c)

integratorRows :: IntegratorControl -> [[Text]]
integratorRows c =
  [ ["interpolator", "feed integrator of " <> Decimal.whole (bits c) <> " bits, with a dispatcher"],
    ["clock", Decimal.whole (clock c) <> " Hz"]
  ]
    <> readerRows (reader c)
    <> [ ["acceleration", number (pathAcceleration c) <> " mm/s²"],
         [ "correction of the feed",
           Text.intercalate ", " (map Decimal.whole (override c)) <> " percent"
         ],
         [ "interpolation cycle",
           Decimal.whole (lineCycle c)
             <> " ticks on a line, "
             <> Decimal.whole (arcCycle c)
             <> " on an arc"
         ],
         ["correction switches", Decimal.whole (switches c)]
       ]
    <> limitRows (driveLimits c)
    <> [ [ "job " <> jobName j,
           Decimal.whole (duration j)
             <> " ticks, priority "
             <> Decimal.whole (priority j)
             <> ", "
             <> requestText (request j)
             <> waitText wait
         ]
         | (j, wait) <- IntegratorFeed.waitBounds c shownFrequency
       ]
  where
    waitText wait = case wait of
      Nothing -> "; has no time at " <> number shownFrequency <> " pulses a second"
      Just t ->
        "; waits at most "
          <> number (1000 * fromIntegral t / fromIntegral (clock c))
          <> " ms at "
          <> number shownFrequency
          <> " pulses a second"

-- | Frequency of the leading axis for which the waits of the jobs are shown.
shownFrequency :: Double
shownFrequency = 1000

limitRows :: FrequencyLimits -> [[Text]]
limitRows l =
  [["highest frequency of an axis", number hz <> " Hz"] | Just hz <- [highestFrequency l]]
    <> [ ["largest jump between two frames", number hz <> " Hz"]
         | Just hz <- [largestJump l]
       ]

readerRows :: TapeReader -> [[Text]]
readerRows r =
  [ ["reader", number (rowsPerSecond r) <> " rows a second"],
    ["start of the tape", milliseconds (startTime r)],
    ["read before the first frame begins", frames (framesAhead r)]
  ]
    <> [["signal at a frame that cannot be read", "‘" <> t <> "’"] | Just t <- [faultSignal r]]
  where
    frames n = Decimal.whole n <> (if n == 1 then " frame" else " frames")

requestText :: JobRequest -> Text
requestText r = case r of
  AtCharacter -> "for each character that is read"
  AtNumber -> "for each word that is read"
  AtTransfer -> "when a frame is finished and the next one is read"
  AtCompensation -> "for each frame with cutter compensation"
  AtDirection every ahead ->
    "every "
      <> Decimal.whole every
      <> " cycles of an arc, for the direction after "
      <> Decimal.whole ahead
      <> " cycles"
  AtAcceleration t -> "to change the feed, every " <> milliseconds t
  Periodic t -> "every " <> milliseconds t
  AfterCommand (CommandName n) t k ->
    Decimal.whole k <> " times after the command " <> n <> ", every " <> milliseconds t

milliseconds :: Seconds -> Text
milliseconds (Seconds t) = number (1000 * t) <> " ms"

number :: Double -> Text
number = Decimal.short 3
