-- | Faults of regions and of shapes.
module Part.RegionError
  ( RegionMistake (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), Rad, degrees)
import Base.Region (Region)
import Part.Shape (ShapeFault (..))
import Report.Report (Label (..), Report (..), at, quote)

-- | A fault of a region or of a shape. The first field of every constructor is the region of the
-- call or of the statement. The comment of a constructor names the other fields in order.
data RegionMistake
  = -- | a region inside an open contour: its name, and the region of its definition
    OpenOperand Region Name Region
  | -- | a region inside a contour that crosses itself: its name, and the regions of two elements
    CrossingOperand Region Name Region Region
  | -- | rounding decides between different results
    UndecidedRegion Region
  | -- | a statement or a measure that needs a region with area
    EmptyRegion Region
  | -- | an offset towards the inside of an open contour
    InsideOfOpen Region Mm
  | -- | a shape that does not exist
    NoSuchShape Region ShapeFault
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> RegionMistake -> Report
toReport unit mistake = case mistake of
  OpenOperand region (Name name) there ->
    (at region "E0366" ("the contour " <> quote name <> " is open and has no inside"))
      { others = [Label there "this contour is open"],
        hints =
          [ "Write closed, and the element that leads back to its beginning. Or make a region \
            \around it: offset_of("
              <> name
              <> ", 3)."
          ]
      }
  CrossingOperand region (Name name) first second ->
    (at region "E0367" ("the contour " <> quote name <> " crosses itself"))
      { others = [Label first "this element", Label second "crosses this one"],
        message = ["So it is not known where its inside is."],
        hints = ["Correct one of the two elements."]
      }
  UndecidedRegion region ->
    (at region "E0368" "rounding decides what this region is")
      { message =
          [ "Elements of its contours nearly touch: some of them are closer than the error of a \
            \computed coordinate, others a little farther apart."
          ],
        hints = ["Move one of the contours by 0.001 mm, or build both on the same points."]
      }
  EmptyRegion region ->
    (at region "E0369" "this region is empty")
      { hints = ["Check the contours of which it is made: they may not overlap as intended."]
      }
  InsideOfOpen region d ->
    (at region "E0366" "an open contour has no inside")
      { message = ["An offset of " <> Decimal.inUnit unit d <> " would lie inside."],
        hints = ["Give a distance above 0: the region within this distance of the contour."]
      }
  NoSuchShape region fault -> shapeReport unit region fault

-- | The report of a shape that does not exist.
shapeReport :: LengthUnit -> Region -> ShapeFault -> Report
shapeReport unit region fault = case fault of
  NoExtent ->
    (report "this shape has no area")
      { hints = ["Give it two points that differ: of a rectangle, in x and in y."]
      }
  CornersTooRound most ->
    (report "the corners are rounder than the rectangle is wide")
      { message =
          ["Their radius is at most half of the shorter side, " <> Decimal.inUnit unit most <> "."],
        hints = ["Write a smaller radius."]
      }
  TooFewCorners ->
    (report "a polygon needs three corners that are not on one line")
      { hints = ["Give it more points."]
      }
  WrongPressureAngle angle ->
    (report ("a gear cannot have a pressure angle of " <> Decimal.short 3 (degrees angle) <> "°"))
      { hints = ["Write an angle between 0 and 60 deg. The usual one is 20 deg."]
      }
  WrongSweep angle -> sweepReport region angle
  NoRootCircle ->
    (report "a gear of so few teeth has no root circle") {hints = ["Give the gear more teeth."]}
  PointedTeeth ->
    (report "the teeth of this gear end in points")
      { message = ["Their flanks meet below the tip circle."],
        hints = ["Give the gear more teeth, or a smaller pressure angle."]
      }
  NoRoot ->
    (report "the teeth of this gear leave no room between them")
      { message = ["Their flanks meet above the root circle."],
        hints = ["Give it another count of teeth, or a smaller pressure angle."]
      }
  where
    report = at region "E0370"

-- | The report of a part of an ellipse that turns by the given angle.
sweepReport :: Region -> Rad -> Report
sweepReport region angle =
  (at region "E0370" title)
    { hints = ["The angles FROM and TO of a part of an ellipse differ by at most 360 deg."]
    }
  where
    title
      | abs (degrees angle) < 1e-3 = "this part of an ellipse has no length"
      | otherwise =
        "this part of an ellipse turns by "
          <> Decimal.short 3 (abs (degrees angle))
          <> " deg, more than once around"
