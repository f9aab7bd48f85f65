-- | Faults of the stock, of the solids that a program avoids, and of the bodies of tools.
module Part.BodyError
  ( BodyMistake (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Region)
import Data.Text (Text)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at)

-- | A fault of a body. The first field of every constructor is the region that the report points
-- at. The comment of a constructor names the other fields in order.
data BodyMistake
  = -- | a top that is not above the bottom: the top, the bottom and its region
    NoHeight Region Mm (Region, Mm)
  | -- | a size that is given twice: its word, and the region where it comes first
    SizeTwice Region Text Region
  | -- | cutting edges that are longer than the stick-out: their length, the stick-out and its
    -- region
    FlutesTooLong Region Mm (Region, Mm)
  | -- | a holder of a tool without a stick-out
    HolderWithoutStickOut Region
  | -- | a cylinder of a holder that has no height, but is not the last one
    EndlessCylinder Region
  | -- | a safe height below the top of an avoided solid: the safe height, the region of the solid's
    -- statement and its top
    SafeBelowSolid Region Mm Region Mm
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> BodyMistake -> Report
toReport unit mistake = case mistake of
  NoHeight region top (lower, bottom) ->
    (at region "E0371" "the top is not above the bottom")
      { message = ["It is " <> inUnit top <> ", and the bottom is " <> inUnit bottom <> "."],
        others = [Label lower "this is the bottom"],
        fixes = [Fix.proposed (Fix.swap "Exchange the two heights." lower region) | top /= bottom],
        hints = ["The first height is that of the bottom, the second one that of the top."]
      }
  SizeTwice region word first ->
    (at region "E0372" ("this tool has " <> word <> " twice"))
      { others = [Label first "here it comes first"],
        hints = ["Leave one of them out."]
      }
  FlutesTooLong region flutes (there, out) ->
    (at region "E0372" "the flutes are longer than the tool sticks out")
      { message =
          [ "They are " <> inUnit flutes <> " long, and the tool ends in its holder "
              <> inUnit out
              <> " above the tip."
          ],
        others = [Label there "the stick-out"],
        hints = ["Give the length from the tip to the holder as the stick-out."]
      }
  HolderWithoutStickOut region ->
    (at region "E0372" "a holder needs the stick-out of the tool")
      { hints = ["Write for example stickout 30 mm: the length from the tip to the holder."]
      }
  EndlessCylinder region ->
    (at region "E0372" "another cylinder of the holder follows, so this one needs a height")
      { hints = ["Write for example holder 32 mm height 25 mm."]
      }
  SafeBelowSolid region safe there top ->
    (at region "E0373" "the safe height is below the top of a solid that the program avoids")
      { message = ["It is " <> inUnit safe <> ", and this top is " <> inUnit top <> "."],
        others = [Label there ("it reaches up to " <> inUnit top)],
        hints = ["At the safe height, the tool moves across everything."]
      }
  where
    inUnit = Decimal.inUnit unit
