-- | Taps, reamers and thread mills that run into stock, and their report.
module Verify.CoreHoleFinding
  ( CoreHoleFault (..),
    CoreTool (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), times)
import Base.Region (Region)
import Data.Text (Text)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (Report (hints, message), ReportPlace (..), report)
import Report.Report qualified as Report

-- | Tool that needs a hole, and finds stock.
data CoreHoleFault = CoreHoleFault
  { -- | number of the frame, from 1
    frameOfFault :: Int,
    -- | text in the program that asks for the frame; Nothing if the tape has other frames than
    -- planned
    asked :: Maybe Region,
    work :: CoreTool,
    -- | radius that has to be free
    needed :: Mm,
    -- | lowest height of the tip
    tipHeight :: Mm,
    -- | point at which stock is left above this height
    stockAt :: Point
  }
  deriving stock (Eq, Show)

-- | Work that needs a hole, or a stud, that is there before.
data CoreTool = Tapping | Reaming | ThreadMilling
  deriving stock (Eq, Show)

-- | Report of a tool that finds stock where it needs a hole.
toReport :: LengthUnit -> CoreHoleFault -> Report
toReport unit f =
  ( report
      Report.Error
      "E0746"
      (maybe InFile InSource (asked f))
      (toolWord (work f) <> " in frame " <> Decimal.whole (frameOfFault f) <> " runs into stock")
  )
    { message =
        [ "At " <> Vec.toText unit 3 (stockAt f) <> " there is stock above the height "
            <> Decimal.inUnit unit (tipHeight f)
            <> ", to which the tip comes down."
        ],
      hints = advice
    }
  where
    diameter = Decimal.inUnit unit (times 2 (needed f))
    advice = case work f of
      ThreadMilling -> ["Make the hole or the stud before, at least as deep as the thread."]
      _ ->
        [ "Make a hole of at least " <> diameter
            <> " before. A drill has its full diameter only above its point, so drill deeper."
        ]

-- | Words for a tool.
toolWord :: CoreTool -> Text
toolWord w = case w of
  Tapping -> "the tap"
  Reaming -> "the reamer"
  ThreadMilling -> "the thread mill"
