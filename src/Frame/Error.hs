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
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Report.Report (Place (..), Report (..), report)
import Report.Report qualified as Report

data Error
  = -- | the feed asked, and the lowest and highest that there are
    FeedMissing Region Feed Feed Feed
  | -- | a place that no machine reaches
    OutOfReach Region Point Mm
  | -- | a milling statement whose tolerance is not small against its cutter's radius: tolerance, radius
    ToleranceTooLarge Region Mm Mm
  | -- | an auxiliary command, and the highest that the machine has
    NoSuchCommand Region Int Int
  | -- | more frames than a tape may have
    TooManyFrames Region Int
  deriving stock (Eq, Ord, Show)

data Warning
  = -- | the feed asked and the feed obtained
    FeedDiffers Region Feed Feed
  | -- | where the program starts, and where the machine can stand
    StartRounded Region Point Point
  | -- | a move in z of a machine that is not known to have one
    HeightUnsure Region
  | -- | a command that the tape can not give
    ByHand Region CommandKind
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
  OutOfReach region p limit ->
    (report Report.Error "E0502" (InSource region) ("the cutter would go to " <> Vec.written 4 p <> ", further than any machine reaches"))
      { message = ["Coordinates may be up to " <> Decimal.mm limit <> "."]
      }
  ToleranceTooLarge region tolerance radius ->
    (report Report.Error "E0504" (InSource region) ("a tolerance of " <> Decimal.mm tolerance <> " is too large for a cutter of radius " <> Decimal.mm radius))
      { message = ["The tolerance and one pulse (" <> Decimal.mm (Machine.pulse machine) <> ") have to stay below the cutter's radius: a cutter that may be off by its own size proves nothing."],
        hints = ["Give a smaller tolerance."]
      }
  NoSuchCommand region n highest ->
    (report Report.Error "E0505" (InSource region) (machineName machine <> " has no auxiliary command " <> Decimal.whole n))
      { message = [if highest == 0 then "It has none at all." else "It has the commands 1 to " <> Decimal.whole highest <> "."]
      }
  TooManyFrames region limit ->
    (report Report.Error "E0503" (InSource region) ("the tape would have more than " <> Decimal.whole limit <> " frames"))
      { hints = ["Allow a larger tolerance."]
      }

-- | The words for a warning on a machine.
warningReport :: Machine -> Warning -> Report
warningReport machine warning = case warning of
  FeedDiffers region asked given ->
    (report Report.Warning "W0501" (InSource region) (machineName machine <> " runs this feed at " <> feed given))
      { message = ["Asked is " <> feed asked <> "; the machine has no feed nearer to it that does not exceed it."]
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
        hints = ["A free auxiliary command may serve: aux 1" | kind /= ToolCommand]
      }
  where
    what kind = case kind of
      SpindleCommand -> "about the spindle"
      CoolantCommand -> "about the coolant"
      ToolCommand -> "to change its tool"
      AuxiliaryCommand -> "this command"

machineName :: Machine -> Text
machineName machine = let MachineName name = Machine.name machine in name

feed :: Feed -> Text
feed (Feed f) = Decimal.short 2 f <> " mm/min"
