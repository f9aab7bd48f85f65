-- | Dimension lines, after ISO 129-1: the distances and radii that a program asserts, with their
-- values. All lengths are in mm of paper.
module Draw.DimensionLine
  ( DimensionLine (..),
    ofSize,
    onPage,
    drawn,
    segments,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad (..))
import Data.List (find)
import Data.Text (Text)
import Draw.LineStyle (LineStyles (..))
import Draw.LineStyle qualified as LineStyle
import Draw.Page (Area (..), Page)
import Draw.Page qualified as Page
import Draw.Svg (Anchor (..), Pen (..), Svg)
import Draw.Svg qualified as Svg
import Geometry.Carrier (Circle (Circle))
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.Part (AssertedSize (..))

-- | Size that is drawn, with its text.
data DimensionLine
  = -- | the distance of two points
    BetweenPoints Point Point Text
  | -- | the radius of a circle, given by its centre and radius
    AtCircle Point Double Text
  deriving stock (Eq, Ord, Show)

-- | Dimension line of a size, in mm of the part. The text is in the given unit.
ofSize :: LengthUnit -> AssertedSize -> DimensionLine
ofSize unit size = case size of
  AssertedDistance p q value -> BetweenPoints p q (Decimal.shortIn unit 4 value)
  AssertedRadius (Circle c (Mm r)) value -> AtCircle c r ("R " <> Decimal.shortIn unit 4 value)

-- | Places a dimension line on a page.
onPage :: Page -> DimensionLine -> DimensionLine
onPage page line = case line of
  BetweenPoints p q text -> BetweenPoints (Page.place page p) (Page.place page q) text
  AtCircle c r text -> AtCircle (Page.place page c) (Page.onPaper page (Mm r)) text

-- | Lines, arrows and text of a dimension line.
data Layout = Layout
  { lines' :: [Segment],
    -- | directions and tips of the arrows
    arrows :: [(Vec, Point)],
    textAt :: Point,
    text' :: Text
  }

-- | Layout within a field, at the first distance from the points at which it has room; none if it
-- has room nowhere. The preferred side of a distance is the one that faces away from the middle of
-- the field.
layout :: Area -> DimensionLine -> Maybe Layout
layout field line = case line of
  BetweenPoints p q text ->
    choice (map (distance p q text . (* side p q)) [9, 14, -9, -14, 5, -5])
  AtCircle c r text -> choice [radius c r text (Rad (a * pi / 180)) | a <- [-45, -135, 135, 45]]
  where
    choice = find (isWithin field)
    middle =
      Vec.point ((leftmost field + rightmost field) / 2) ((upper field + lower field) / 2)
    side p q =
      let outwards = Vec.dot (Vec.left (Vec.to p q)) (Vec.to middle (between p q))
       in if outwards < 0 then -1 else 1

-- | True if the text and the lines of a layout are in a field.
isWithin :: Area -> Layout -> Bool
isWithin field Layout {lines', textAt, text'} =
  all (Page.holds field) (concat [[a, b] | Straight a b <- lines'] <> corners)
  where
    w = Svg.textWidth letterSize text' / 2
    corners = [Vec.shift (Vec.vec x y) textAt | x <- [-w, w], y <- [-letterSize, letterSize]]

-- | Letter size of the values in mm.
letterSize :: Double
letterSize = 2.8

-- | Layout of the distance of two points, at an offset to the left of the line from the first to
-- the second. If the points are too close for arrows between them, the arrows are outside.
distance :: Point -> Point -> Text -> Double -> Layout
distance p q text offset =
  Layout
    { lines' = [extension p, extension q] <> line,
      arrows = [(turned (Vec.negate along), a), (turned along, b)],
      textAt = if isWide then between a b else Vec.shift (Vec.scale (9 + wide / 2) along) b,
      text' = text
    }
  where
    Mm long = Vec.distance p q
    along = if long > 1e-6 then Vec.unit (Vec.to p q) else Vec.vec 1 0
    across = Vec.left along
    (a, b) = (Vec.shift (Vec.scale offset across) p, Vec.shift (Vec.scale offset across) q)
    wide = Svg.textWidth letterSize text
    isWide = long > wide + 9
    turned v = if isWide then v else Vec.negate v
    extension from =
      Straight
        (Vec.shift (Vec.scale (signum offset) across) from)
        (Vec.shift (Vec.scale (offset + 1.5 * signum offset) across) from)
    line
      | isWide = [Straight a b]
      | otherwise =
        [Straight (Vec.shift (Vec.scale (-7) along) a) (Vec.shift (Vec.scale 8 along) b)]

-- | Layout of a radius, on a line through the centre at an angle. The line leads from the centre to
-- the text outside of the circle.
radius :: Point -> Double -> Text -> Rad -> Layout
radius c r text (Rad angle) =
  Layout
    { lines' = [Straight c (at (r + 6))],
      arrows = [(if r > 5 then outwards else Vec.negate outwards, at r)],
      textAt = Vec.shift (Vec.vec (signum (cos angle) * (1 + wide / 2)) 0) (at (r + 6)),
      text' = text
    }
  where
    outwards = Vec.vec (cos angle) (sin angle)
    wide = Svg.textWidth letterSize text
    at x = Vec.shift (Vec.scale x outwards) c

between :: Point -> Point -> Point
between a b = Vec.point ((Vec.x a + Vec.x b) / 2) ((Vec.y a + Vec.y b) / 2)

-- | Drawing of a dimension line in a field; empty if it has no room there.
drawn :: LineStyles -> Area -> DimensionLine -> [Svg]
drawn styles field line = foldMap drawing (layout field line)
  where
    drawing Layout {lines', arrows, textAt, text'} =
      [Svg.strokes (cutterPen styles) {width = 0.15} (map pure lines')]
        <> [Svg.arrow (inkColour styles) 2.4 v p | (v, p) <- arrows]
        <> [ Svg.rectangle (Pen "none" 0 []) (background styles) (ground textAt text'),
             Svg.text (LineStyle.lettering styles letterSize) Centred textAt text'
           ]
    ground p text =
      let w = Svg.textWidth letterSize text / 2 + 0.3
          h = 0.5 * letterSize
       in Area (Vec.x p - w) (Vec.y p - h) (Vec.x p + w) (Vec.y p + h)

-- | Segments of a dimension line in a field that labels must not cover: its lines, and a line
-- through its text.
segments :: Area -> DimensionLine -> [Segment]
segments field line = foldMap covered (layout field line)
  where
    covered Layout {lines', textAt, text'} =
      let w = Svg.textWidth letterSize text' / 2
          beside s = Vec.shift (Vec.vec (s * w) 0) textAt
       in Straight (beside (-1)) (beside 1) : lines'
