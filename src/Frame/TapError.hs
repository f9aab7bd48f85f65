-- | Faults of taps that a machine cannot drive.
module Frame.TapError
  ( TapFault (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm)
import Base.Region (Region)
import Data.Text (Text)
import Report.Report (Report (..), ReportPlace (..), report)
import Report.Report qualified as Report

-- | Reason why a machine cannot drive a tap.
data TapFault
  = -- | the machine has no cycle for it
    NoTapCycle
  | -- | the feed does not follow the spindle, so the tap needs a floating holder
    NeedsFloatingHolder
  | -- | the cycle turns clockwise on the way down
    OnlyRightHand
  | -- | the feed word cannot hold the feed that this pitch needs
    UnevenFeed Mm
  deriving stock (Eq, Ord, Show)

-- | Report of a tap in a region, for the machine with this name.
toReport :: LengthUnit -> Text -> Region -> TapFault -> Report
toReport unit machine region fault = case fault of
  NoTapCycle ->
    (tap (machine <> " cannot tap"))
      { message = ["Its axes do not follow the spindle, and it does not turn the spindle back."],
        hints = ["Mill the thread instead: thread at … diameter … pitch … depth … inside."]
      }
  NeedsFloatingHolder ->
    (tap (machine <> " taps with a floating holder only"))
      { message = ["Its feed does not follow the spindle."],
        hints = ["If the tap is in such a holder, write floating in the braces of tap."]
      }
  OnlyRightHand ->
    (tap (machine <> " taps right-hand threads only"))
      { message = ["Its cycle G84 turns the spindle clockwise on the way down."],
        hints = ["Mill the thread instead: thread at … { hand left }."]
      }
  UnevenFeed pitch ->
    (tap ("the feed word of " <> machine <> " cannot hold the feed of this tap"))
      { message =
          [ "The feed is the pitch, " <> Decimal.inUnit unit pitch
              <> ", times the speed of the spindle. Rounded, it would not give this pitch."
          ],
        hints = ["Choose a speed for which the product is a feed that the word can hold."]
      }
  where
    tap = report Report.Error "E0530" (InSource region)
