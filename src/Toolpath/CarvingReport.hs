{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Reports on V-carvings: material that a tip leaves because it is too wide, floors that stay, and
-- contours across which a tip goes.
module Toolpath.CarvingReport
  ( nowhere,
    refused,
    allowed,
    floorStays,
    across,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), times)
import Base.Region (Region)
import Data.Text (Text)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (Label (Label), Report (..), ReportPlace (InSource), at, report)
import Report.Report qualified as Report
import Toolpath.CarvingFloor (Floor (..))
import Toolpath.Toolpath (CarvingRest (..))

-- | The report that a tip of some radius fits nowhere into a region.
nowhere :: LengthUnit -> Region -> Mm -> Report
nowhere unit region tip =
  (at region "E0427" "the tip of the tool fits nowhere into this region")
    { message = ["The tip is " <> Decimal.inUnit unit (times 2 tip) <> " wide."],
      hints = ["Take a tool with a smaller tip."]
    }

-- | The report that a tip leaves material where the program does not allow it.
refused :: LengthUnit -> Region -> CarvingRest -> Mm -> Report
refused unit region rest tip =
  (at region "E0427" ("the tip leaves material at " <> places rest))
    { message =
        [ "The tip is " <> Decimal.inUnit unit (times 2 tip) <> " wide. " <> thickestText unit rest
        ],
      hints = ["Take a tool with a smaller tip, or write rest allowed in the braces."]
    }

-- | The warning that a tip leaves material where the program allows it.
allowed :: LengthUnit -> Region -> CarvingRest -> Report
allowed unit region rest =
  (report Report.Warning "W0405" (InSource region) ("the tip leaves material at " <> places rest))
    { message = [thickestText unit rest],
      hints = ["Take a tool with a smaller tip, or leave rest allowed out to have this refused."]
    }

-- | The warning that a floor stays.
floorStays :: LengthUnit -> Floor -> Report
floorStays unit (Floor region p) =
  (report Report.Warning "W0406" (InSource region) "the floor of this V-carving is not cleared")
    { message =
        [ "At " <> Vec.toText unit 3 p
            <> " the region is wider than the tool carves at this depth. The material between the \
               \grooves at its edges stays."
        ],
      hints =
        [ "Give the V-carving a name, vcarve … as sign { … }, change to a mill, and write rest of \
          \sign step 1 { rest allowed }.",
          "Or carve deeper, up to the height of the flank."
        ]
    }

-- | The report that a V-carving goes across an element of a contour, which has a region and a text,
-- and where its axis then is.
across :: LengthUnit -> Region -> (Region, Text) -> Point -> Report
across unit region (crossed, element) p =
  (at region "E0406" "this V-carving goes across a contour that another statement mills")
    { Report.label = "carved here",
      others = [Label crossed ("it goes across " <> element)],
      message = ["The tip is then at " <> Vec.toText unit 3 p <> "."],
      hints = ["Move the region, or make it smaller, so that it stays on one side of the contour."]
    }

places :: CarvingRest -> Text
places rest
  | restCount rest == 1 = "one place"
  | otherwise = Decimal.whole (restCount rest) <> " places"

thickestText :: LengthUnit -> CarvingRest -> Text
thickestText unit rest =
  "It is thickest at "
    <> Vec.toText unit 3 (restAt rest)
    <> ": "
    <> Decimal.inUnit unit (thickest rest)
    <> "."
