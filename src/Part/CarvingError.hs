{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Faults of V-carvings and of V-bits.
module Part.CarvingError
  ( CarvingMistake (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm, Rad, degrees)
import Base.Region (Region (..))
import Data.Text qualified as Text
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (Label (..), Report (..), at)

-- | A fault of a V-carving or of a V-bit. The first field of every constructor is the region that
-- the report points at. The comment of a constructor names the other fields in order.
data CarvingMistake
  = -- | a statement without a depth. The region is that of the whole statement
    NothingDeep Region
  | -- | a depth that is larger than the height of the flank: the depth, and this height
    DeeperThanFlank Region Mm Mm
  | -- | contours of one area that touch: a point that they have in common
    ContoursMeet Region Point
  | -- | a V-bit with an angle that no flank has: the angle
    NoFlank Region Rad
  | -- | a V-bit that is not wider above its tip: its diameter, and the diameter of its tip with the
    -- region of this diameter
    NotPointed Region Mm (Region, Mm)
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> CarvingMistake -> Report
toReport unit fault = case fault of
  NothingDeep region ->
    (at (keyword region) "E0384" "this carving has no depth")
      { message = ["The depth limits how deep the tip goes where the region is wide."],
        hints = ["Give the depth in the braces, for example depth 2 mm."]
      }
  DeeperThanFlank region depth flank ->
    (at region "E0389" "this depth is larger than the height of the flank")
      { message =
          [ "The depth is "
              <> inUnit depth
              <> ", and the conical flank of the tool is "
              <> inUnit flank
              <> " high."
          ],
        hints = ["Give a smaller depth, or take a tool with a larger diameter."]
      }
  ContoursMeet region p ->
    (at region "E0379" "contours of this region touch one another")
      { message = ["They touch at " <> Vec.toText unit 4 p <> "."],
        hints = ["Move one of them, or make the region larger or smaller with offset_of."]
      }
  NoFlank region angle ->
    (at region "E0398" ("a V-bit cannot have an angle of " <> inDegrees angle))
      { message = ["The angle of a V-bit is measured from flank to flank."],
        hints = ["Write an angle above 0 deg and below 180 deg."]
      }
  NotPointed region diameter (there, tip) ->
    (at region "E0399" "this V-bit is not wider above its tip")
      { message =
          [ "Its diameter is " <> inUnit diameter <> ", that of its tip " <> inUnit tip <> "."
          ],
        others = [Label there "the diameter of the tip"],
        hints = ["Write a diameter that is larger than that of the tip."]
      }
  where
    inUnit = Decimal.inUnit unit
    inDegrees a = Decimal.short 3 (degrees a) <> " deg"
    keyword (Region begin _) = Region begin (begin + Text.length "vcarve")
