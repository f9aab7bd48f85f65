-- | Proof of the pulses of a tape: how far the pulses that the controller makes are from the
-- motions of the frames, the feeds and frequencies that they have, the waits, and the time.
module Verify.PulseProof
  ( PulseProof (..),
    PulseWitness (..),
    FeedWitness (..),
    FeedExtremes (..),
    PulseFinding (..),
    isSound,
    toReports,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), LengthUnit (..), Seconds (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Controller (FrequencyLimits)
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (StopReason (..))
import Pulse.FramePath (feedText, roundedDown)
import Pulse.RunMeasure (FrequencyPeak (..), RunTotal)
import Pulse.Steps (Pulses5)
import Pulse.Steps qualified as Steps
import Report.Report (Report (hints, message), ReportCode, ReportPlace (..), report)
import Report.Report qualified as Report
import Tape.Damage qualified as Damage

-- | Largest deviation of the pulses from a motion, in pulses: the frame, the deviation, and the
-- promise of the interpolator for this motion.
data PulseWitness = PulseWitness {frame :: Int, amount :: Double, promised :: Double}
  deriving stock (Eq, Show)

-- | Measured feed of a frame beside the feed that the frame asks, both along the path, in mm\/min
-- or in degrees a minute.
data FeedWitness = FeedWitness {feedFrame :: Int, measured :: Feed, wanted :: Feed}
  deriving stock (Eq, Show)

-- | Feeds that differ most from what is asked, in proportion: the mean feed of a frame, the least
-- feed over a millimetre, and the highest feed over a millimetre.
data FeedExtremes = FeedExtremes
  { meanFeed :: Maybe FeedWitness,
    leastFeed :: Maybe FeedWitness,
    highestFeed :: Maybe FeedWitness
  }
  deriving stock (Eq, Show)

-- | Proof of the pulses of a tape. Frames are given by their numbers, from 1.
data PulseProof = PulseProof
  { -- | count of pulses on all axes
    pulseCount :: Int,
    -- | largest deviations on lines and on arcs; Nothing without a pulse
    onLines :: Maybe PulseWitness,
    onArcs :: Maybe PulseWitness,
    feeds :: FeedExtremes,
    -- | measures of the whole run, and the frequency of its clock
    total :: RunTotal,
    clock :: Int,
    -- | what the drives of the axes can follow
    limits :: FrequencyLimits,
    -- | sum of length by feed over all frames
    formulaTime :: Seconds,
    pulseFindings :: [PulseFinding]
  }
  deriving stock (Eq, Show)

-- | Fault of the pulses. For each kind of fault the first frame with it is given.
data PulseFinding
  = -- | Pulses are further from the motion than is promised: the first frame, and the frame with
    -- the largest deviation.
    OffMotion PulseWitness PulseWitness
  | -- | The pulses of a frame do not end at its end: the last position minus the end of the frame.
    EndMissed Int Pulses5
  | -- | The feed is higher than asked, by more than the controller's swing: the first frame, and
    -- the frame in which it is highest in proportion.
    FeedTooHigh FeedWitness FeedWitness
  | -- | An axis is faster than its drive can follow: the index of the axis, its highest
    -- frequency, and the limit in pulses per second.
    AxisTooFast Int FrequencyPeak Double
  | -- | The frequency of an axis jumps further than its drive can follow: the index of the axis,
    -- its largest jump, and the limit in pulses per second.
    JumpTooLarge Int FrequencyPeak Double
  | -- | The controller stops before the end of the tape.
    StopsEarly StopReason
  deriving stock (Eq, Show)

-- | True without findings.
isSound :: PulseProof -> Bool
isSound = null . pulseFindings

-- | Reports of all findings.
toReports :: LengthUnit -> Machine -> PulseProof -> [Report]
toReports unit machine = map (toReport unit machine) . pulseFindings

toReport :: LengthUnit -> Machine -> PulseFinding -> Report
toReport unit machine finding = case finding of
  OffMotion first worst -> offReport machine first worst
  EndMissed n missed ->
    wrong "E0719" ("the pulses of " <> frameWord n <> " miss its end by " <> vector missed)
  FeedTooHigh first worst -> feedReport unit first worst
  AxisTooFast k peak limit ->
    driveReport
      ("axis " <> axis k <> " makes " <> hz (peakHz peak) <> " in " <> frameWord (peakFrame peak))
      limit
  JumpTooLarge k peak limit ->
    driveReport
      ( "the frequency of axis "
          <> axis k
          <> " jumps by "
          <> hz (peakHz peak)
          <> " at the start of "
          <> frameWord (peakFrame peak)
      )
      limit
  StopsEarly why -> stopReport why
  where
    vector v =
      Text.intercalate
        ", "
        [Decimal.whole d <> " in " <> axis k | (k, d) <- zip [0 ..] (Steps.toList v), d /= 0]
    axis k = Text.take 1 (Text.drop k "xyzab")
    hz v = Decimal.fixed 1 v <> " Hz"
    driveReport fault limit =
      (wrong "E0722" (fault <> ", too much for its drive"))
        { message = ["The description of the machine allows " <> hz limit <> "."],
          hints = ["Write a lower feed there, or round the corner by an arc."]
        }

offReport :: Machine -> PulseWitness -> PulseWitness -> Report
offReport machine first worst =
  ( wrong
      "E0719"
      ( "the pulses of "
          <> frameWord (frame first)
          <> " are up to "
          <> off first
          <> " away from its motion"
      )
  )
    { message =
        ["The interpolator of " <> machineName <> " allows " <> pulses (promised first) <> "."]
          <> [ "It is worst in " <> frameWord (frame worst) <> ": " <> off worst <> "."
               | frame worst /= frame first
             ]
    }
  where
    MachineName machineName = Machine.name machine
    off w = pulses (amount w)
    pulses x = Decimal.fixed 4 x <> " pulses"

feedReport :: LengthUnit -> FeedWitness -> FeedWitness -> Report
feedReport unit first worst =
  ( wrong
      "E0720"
      ( frameWord (feedFrame first)
          <> " runs at up to "
          <> feed (measured first)
          <> ", more than asked"
      )
  )
    { message =
        ["The frame asks for " <> feed (wanted first) <> "."]
          <> [ "It is worst in "
                 <> frameWord (feedFrame worst)
                 <> ": "
                 <> feed (measured worst)
                 <> " instead of "
                 <> feed (wanted worst)
                 <> "."
               | feedFrame worst /= feedFrame first
             ]
    }
  where
    feed v = Decimal.feedIn unit 2 v

stopReport :: StopReason -> Report
stopReport why = case why of
  TooFast n asked most ->
    (wrong "E0721" ("the controller stops before " <> frameWord n <> ": its feed is too high"))
      { message =
          [ "It asks for "
              <> feedText asked
              <> "; the controller can run at most "
              <> feedText (roundedDown most)
              <> " there."
          ]
      }
  FeedHeld n -> wrong "E0721" ("the controller stops before " <> frameWord n <> ": its feed is 0")
  SwitchNotSet n k ->
    wrong
      "E0721"
      ( "the controller stops before "
          <> frameWord n
          <> ": switch "
          <> Decimal.whole k
          <> " is not set"
      )
  NotCompensated n fault ->
    wrong "E0721" ("the controller stops before " <> frameWord n <> ", which " <> fault)
  Unreadable damage ->
    (wrong "E0721" "the controller stops before a frame that it cannot read")
      { message = ["The reason: " <> Report.title (Damage.toReport damage) <> "."]
      }
  TapeEnds -> wrong "E0721" "the controller stops at the end of the tape"
  ProgramEnds -> wrong "E0721" "the controller stops at the end of the program"

wrong :: ReportCode -> Text -> Report
wrong code = report Report.Error code InFile

frameWord :: Int -> Text
frameWord n = "frame " <> Decimal.whole n
