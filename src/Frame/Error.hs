{-# OPTIONS_GHC -O0 #-}

-- | What a machine can not do, or does otherwise than asked.
module Frame.Error
  ( Error (..),
    Warning (..),
    CommandKind (..),
    toReport,
    warningReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Region)
import Data.Text (Text)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis, Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Report.Report (Place (..), Report (..), report)
import Report.Report qualified as Report

data Error
  = -- | the feed asked, and the lowest and highest that there are
    FeedMissing Region Feed Feed Feed
  | -- | the feed asked, the pulses a second that it needs, the lowest and highest number that there are with the feeds
    -- that they give along an axis
    FrequencyMissing Region Feed Double (Double, Feed) (Double, Feed)
  | -- | a place that no machine reaches
    OutOfReach Region Point Mm
  | -- | a milling statement whose tolerance is not small against its cutter's radius: tolerance, radius
    ToleranceTooLarge Region Mm Mm
  | -- | a number of a command, and the highest that the machine has; 0 if it has none
    NoSuchCommand Region CommandKind Int Int
  | -- | more frames than a tape may have
    TooManyFrames Region Int
  | -- | one contour more than there may be begins here
    TooManyContours Region Int
  | -- | a move along an axis that the machine lacks
    NoSuchAxis Region Axis
  | -- | a place on an axis that the field of its positions does not hold, and the furthest that it does
    BeyondField Region Axis Mm Mm
  | -- | a control that does not keep the cutter beside the contour
    NoCompensation Region
  | -- | a diameter that the control cannot be told
    DiameterBeyond Region Mm
  deriving stock (Eq, Ord, Show)

data Warning
  = -- | the feed asked, and the lowest and the highest that are obtained
    FeedDiffers Region Feed Feed Feed
  | -- | where the program starts, and where the machine can stand
    StartRounded Region Point Point
  | -- | a move in z of a machine that is not known to have one
    HeightUnsure Region
  | -- | a command that the tape can not give
    ByHand Region CommandKind
  | -- | the turns a minute asked, and those obtained
    SpeedDiffers Region Double Double
  | -- | a spindle whose speed the tape has to say, and the program does not
    SpeedUnsaid Region
  deriving stock (Eq, Ord, Show)

-- | What a command is about.
data CommandKind = SpindleCommand | CoolantCommand | ToolCommand | AuxiliaryCommand
  deriving stock (Eq, Ord, Show)

-- | The words for an error on a machine.
toReport :: Machine -> Error -> Report
toReport machine err = case err of
  FeedMissing region asked lowest highest ->
    (report Report.Error "E0501" (InSource region) (machineName machine <> " has no feed of " <> feed asked))
      { message = ["Its feeds go from " <> feed lowest <> " to " <> feed highest <> "."]
      }
  FrequencyMissing region asked needed (low, slow) (high, quick) ->
    (report Report.Error "E0501" (InSource region) (machineName machine <> " cannot run " <> feed asked <> " here"))
      { message =
          [ "The axis that leads would take " <> Decimal.short 2 needed <> " pulses a second; there are " <> Decimal.short 2 low <> " to " <> Decimal.short 2 high <> ".",
            "Along an axis that is " <> feed slow <> " to " <> feed quick <> "."
          ]
      }
  OutOfReach region p limit ->
    (report Report.Error "E0502" (InSource region) ("the cutter would go to " <> Vec.written 4 p <> ", further than any machine reaches"))
      { message = ["Coordinates may be up to " <> Decimal.mm limit <> "."]
      }
  ToleranceTooLarge region tolerance radius ->
    (report Report.Error "E0504" (InSource region) ("a tolerance of " <> Decimal.mm tolerance <> " is too large for a cutter of radius " <> Decimal.mm radius))
      { message = ["The tolerance and one pulse (" <> Decimal.mm (Machine.pulse machine) <> ") have to stay below the cutter's radius: a cutter that may be off by its own size proves nothing."],
        hints = ["Give a smaller tolerance."]
      }
  NoSuchCommand region kind n highest ->
    (report Report.Error "E0505" (InSource region) (machineName machine <> " has no " <> numbered kind <> " " <> Decimal.whole n))
      { message = [if highest == 0 then "It has none at all." else "Its tape holds the numbers up to " <> Decimal.whole highest <> "."]
      }
  TooManyContours region limit ->
    (report Report.Error "E0506" (InSource region) ("more than " <> Decimal.whole limit <> " contours"))
      { message = ["A program for " <> machineName machine <> " may have so many contours that are machined. The Minsk-22 system stopped here with 10746."],
        hints = ["Make two programs of it."]
      }
  NoSuchAxis region axis ->
    (report Report.Error "E0507" (InSource region) (machineName machine <> " has no axis " <> axisName axis))
      { message = ["The cutter would move in " <> axisName axis <> " here."]
      }
  BeyondField region axis place limit ->
    (report Report.Error "E0508" (InSource region) (axisName axis <> " = " <> Decimal.mm place <> " does not fit the field of " <> machineName machine))
      { message = ["It holds positions up to " <> Decimal.mm limit <> "."]
      }
  NoCompensation region ->
    (report Report.Error "E0509" (InSource region) (machineName machine <> " cannot keep the cutter beside the contour"))
      { message = ["Its tape has no word for it."],
        hints = ["Leave this out: the compiler works out the path of the cutter's centre."]
      }
  DiameterBeyond region diameter ->
    (report Report.Error "E0509" (InSource region) (machineName machine <> " cannot be told a cutter of diameter " <> Decimal.mm diameter))
      { message = ["The number does not fit the word, or the word holds it to more than a pulse (" <> Decimal.mm (Machine.pulse machine) <> ") only."],
        hints = ["Leave this out: the compiler works out the path of the cutter's centre."]
      }
  TooManyFrames region limit ->
    (report Report.Error "E0503" (InSource region) ("the tape would have more than " <> Decimal.whole limit <> " frames"))
      { hints = ["Look for a coordinate in a wrong unit or a loop that runs too often; allow a larger tolerance; or make several programs of it."]
      }

-- | The words for a warning on a machine.
warningReport :: Machine -> Warning -> Report
warningReport machine warning = case warning of
  FeedDiffers region asked lowest highest ->
    (report Report.Warning "W0501" (InSource region) (machineName machine <> " runs this feed at " <> (if feed lowest == feed highest then feed lowest else feed lowest <> " to " <> feed highest)))
      { message = ["Asked is " <> feed asked <> "; " <> reason <> "."]
      }
  StartRounded region asked given ->
    (report Report.Warning "W0502" (InSource region) ("the cutter cannot start at " <> Vec.written 4 asked <> ": it is between two pulses"))
      { message = ["The tape is computed for a start at " <> Vec.written 4 given <> " (a pulse is " <> Decimal.mm (Machine.pulse machine) <> ")."]
      }
  HeightUnsure region ->
    (report Report.Warning "W0503" (InSource region) ("the source of " <> machineName machine <> " tells of no moves in z"))
      { message = ["Its frame has a field for z, and the tape holds the moves there; whether the machine at hand follows them is for you to know."]
      }
  ByHand region kind ->
    (report Report.Warning "W0504" (InSource region) (machineName machine <> " cannot be told " <> what kind <> " by its tape"))
      { message = ["It has to be done by hand here." <> (if kind == ToolCommand then " The tape does not wait for it: stop the machine, or give the next tool a tape of its own." else "")],
        hints = ["A free auxiliary command may serve: aux 1" | kind /= ToolCommand, not (null (Machine.auxiliary (Machine.orders machine)))]
      }
  SpeedDiffers region asked given ->
    (report Report.Warning "W0505" (InSource region) (machineName machine <> " turns the spindle at " <> turns given))
      { message = ["Asked is " <> turns asked <> "; the machine can be told none nearer to it."]
      }
  SpeedUnsaid region ->
    (report Report.Warning "W0506" (InSource region) (machineName machine <> " is told of the spindle by its speed, and none is given"))
      { message = ["The tape says nothing of the spindle here."],
        hints = ["Give the turns a minute."]
      }
  where
    what kind = case kind of
      SpindleCommand -> "about the spindle"
      CoolantCommand -> "about the coolant"
      ToolCommand -> "to change its tool"
      AuxiliaryCommand -> "this command"
    reason = case (Machine.feedMeasure (Machine.feeds machine), Machine.rule (Machine.feeds machine)) of
      (Machine.AlongPath, Machine.NotAbove) -> "the machine has no feed nearer to it that does not exceed it"
      (Machine.AlongPath, Machine.Nearest) -> "the machine has no feed nearer to it"
      (Machine.LeadingAxis, _) -> "the machine's feeds are steps along the axis that leads"
    turns n = Decimal.short 1 n <> " turns a minute"

-- | What a number of a command is.
numbered :: CommandKind -> Text
numbered kind = case kind of
  SpindleCommand -> "spindle speed"
  CoolantCommand -> "coolant command"
  ToolCommand -> "tool"
  AuxiliaryCommand -> "auxiliary command"

axisName :: Axis -> Text
axisName axis = Machine.contentWord (Machine.Along axis)

machineName :: Machine -> Text
machineName machine = let MachineName name = Machine.name machine in name

feed :: Feed -> Text
feed (Feed f) = Decimal.short 2 f <> " mm/min"
