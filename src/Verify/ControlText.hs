-- | Words of the reports on the state of a modern control, and those for taps.
module Verify.ControlText
  ( Wording (..),
    tapUnguided,
    otherTapPitch,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Data.Text (Text)

-- | Words of a report: its title, the label at the motion, the label at the line that set the wrong
-- value, the reason and the remedy.
data Wording = Wording
  { title :: Text,
    here :: Text,
    there :: Text,
    reason :: Text,
    remedy :: Text
  }

-- | Words for a tap that is moved without a tapping cycle.
tapUnguided :: Wording
tapUnguided =
  Wording
    { title = "the tap moves without a tapping cycle",
      here = "this motion cuts",
      there = "",
      reason = "Only in such a cycle does the tap follow the turns of the spindle.",
      remedy = "Write G33.1 or G84, whichever the control has."
    }

-- | Words for a tap that is moved by another pitch than that of the program.
otherTapPitch :: Mm -> Mm -> Wording
otherTapPitch given wanted =
  Wording
    { title = "the tap moves by " <> Decimal.mm given <> " for each turn",
      here = "this motion cuts",
      there = "",
      reason = "The program asks for a pitch of " <> Decimal.mm wanted <> ".",
      remedy = "Write K" <> Decimal.short 6 pitch <> " in mm."
    }
  where
    Mm pitch = wanted
