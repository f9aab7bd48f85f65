-- | Page of a drawing: a page of a standard format, its scale, and the position of the part on it.
--
-- On paper, x points right and y points down, in mm from the upper left corner of the page. On the
-- part, y points up. The field is the area for the part; the strip below it has legend and title
-- block.
module Draw.Page
  ( Page,
    PageFormat (..),
    formatName,
    choose,
    paper,
    Scale,
    scale,
    ratio,
    round125,
    place,
    unplace,
    segment,
    onPaper,
    extent,
    Area (..),
    wholePage,
    field,
    strip,
    fieldWidth,
    holds,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..))
import Data.List (find)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | Page: its area, the height of its strip, the scale, and the point of the part that is drawn at
-- the centre of the field.
data Page = Page {paper :: Area, stripHeight :: Double, scale :: Scale, middle :: Point}
  deriving stock (Eq, Show)

-- | Standard formats of paper, after ISO 216 and ISO 5457.
data PageFormat = A4 | A3 | A2 | A1 | A0
  deriving stock (Eq, Show, Enum, Bounded)

-- | Name of a format, as it is printed on the page.
formatName :: PageFormat -> Text
formatName format = case format of
  A4 -> "A4"
  A3 -> "A3"
  A2 -> "A2"
  A1 -> "A1"
  A0 -> "A0"

-- | Shorter and longer side of a format, in mm.
sides :: PageFormat -> (Double, Double)
sides format = case format of
  A4 -> (210, 297)
  A3 -> (297, 420)
  A2 -> (420, 594)
  A1 -> (594, 841)
  A0 -> (841, 1189)

-- | Scale: @onPage@ mm on paper show @real@ mm of the part.
data Scale = Scale {onPage :: Double, real :: Double}
  deriving stock (Eq, Show)

-- | Rectangle on paper, in mm. As y points down, @upper@ is less than @lower@.
data Area = Area {leftmost :: Double, upper :: Double, rightmost :: Double, lower :: Double}
  deriving stock (Eq, Show)

-- | A whole page of A4 in landscape, 297 × 210 mm.
wholePage :: Area
wholePage = Area 0 0 297 210

-- | Field in which the part is drawn: the page without a 'margin' and without the 'strip'.
field :: Page -> Area
field Page {paper, stripHeight} = fieldOf paper stripHeight

fieldOf :: Area -> Double -> Area
fieldOf paper high =
  Area margin margin (rightmost paper - margin) (lower paper - margin - high)

-- | Strip below the field, for the legend and the title block.
strip :: Page -> Area
strip page@Page {paper} = (field page) {upper = lower (field page), lower = lower paper - margin}

-- | Width in mm of field and strip on a paper.
fieldWidth :: Area -> Double
fieldWidth paper = rightmost paper - leftmost paper - 2 * margin

-- | Width in mm of the edge of the paper that is left free.
margin :: Double
margin = 10

-- | Width in mm that is kept free along each edge of the field, for labels.
padding :: Double
padding = 6

-- | Page of a format for a part with the given bounding box. The function yields the height of the
-- strip on a paper. The page has the orientation with the larger scale; if both have the same, it
-- is in landscape.
--
-- The centre of the box is at the centre of the field. If the box still fits at this scale when it
-- is extended to the origin of the part, the centre of the extended box is taken instead.
choose :: PageFormat -> (Area -> Double) -> BoundingBox -> Page
choose format heightOn box =
  if factor (scale upright) > factor (scale landscape) * (1 + 1e-9) then upright else landscape
  where
    (short, long) = sides format
    landscape = onPaperOf (Area 0 0 long short)
    upright = onPaperOf (Area 0 0 short long)
    onPaperOf paper =
      let high = heightOn paper
          room = fieldOf paper high
          chosen = scaleFor room box
          wider = BoundingBox.union box (BoundingBox.ofPoints (Vec.point 0 0) [])
          BoundingBox {left, bottom, right, top} = if fits room wider chosen then wider else box
       in Page
            { paper,
              stripHeight = high,
              scale = chosen,
              middle = Vec.point ((left + right) / 2) ((bottom + top) / 2)
            }

-- | Largest standard scale of ISO 5455 at which a bounding box fits into a field. A box without
-- width and height gets 1:1.
scaleFor :: Area -> BoundingBox -> Scale
scaleFor room box
  | right box + top box <= left box + bottom box = Scale 1 1
  | otherwise = fromMaybe (Scale 1 1) (find (fits room box) standard)
  where
    standard =
      reverse [Scale m 1 | m <- series 6] <> [Scale 1 1] <> [Scale 1 m | m <- series 12]
    series :: Int -> [Double]
    series decades = 2 : 5 : [d * 10 ^ e | e <- [1 .. decades], d <- [1, 2, 5]]

-- | True if a bounding box on the part fits into a field without its 'padding' at a scale.
fits :: Area -> BoundingBox -> Scale -> Bool
fits room BoundingBox {left, bottom, right, top} s =
  factor s * (right - left) <= rightmost room - leftmost room - 2 * padding
    && factor s * (top - bottom) <= lower room - upper room - 2 * padding

-- | Length on paper divided by the length on the part: 0.5 at the scale 1:2.
factor :: Scale -> Double
factor s = onPage s / real s

-- | Scale in the notation 1:2.
ratio :: Scale -> Text
ratio s = Decimal.short 4 (onPage s) <> ":" <> Decimal.short 4 (real s)

-- | Largest number of the series … 0.5, 1, 2, 5, 10, 20 … that does not exceed @limit@, which is
-- positive.
round125 :: Double -> Double
round125 limit = maximum (decade : [d | d <- map (decade *) [2, 5, 10], d <= limit])
  where
    decade = 10 ^^ (floor (logBase 10 limit) :: Int)

-- | Converts a point of the part to paper.
place :: Page -> Point -> Point
place page@Page {scale, middle} p =
  Vec.point
    (Vec.x centre + factor scale * (Vec.x p - Vec.x middle))
    (Vec.y centre - factor scale * (Vec.y p - Vec.y middle))
  where
    centre = centreOf (field page)

-- | Converts a point on paper to a point of the part.
unplace :: Page -> Point -> Point
unplace page@Page {scale, middle} p =
  Vec.point
    (Vec.x middle + (Vec.x p - Vec.x centre) / factor scale)
    (Vec.y middle - (Vec.y p - Vec.y centre) / factor scale)
  where
    centre = centreOf (field page)

-- | Centre of an area.
centreOf :: Area -> Point
centreOf a = Vec.point ((leftmost a + rightmost a) / 2) ((upper a + lower a) / 2)

-- | Converts a segment of the part to paper. An arc looks the same on paper, but its sweep changes
-- sign, because y points down.
segment :: Page -> Segment -> Segment
segment page s = case s of
  Straight a b -> Straight (place page a) (place page b)
  Arc {start, end, centre, sweep = Rad a} ->
    Arc
      { start = place page start,
        end = place page end,
        centre = place page centre,
        sweep = Rad (-a)
      }

-- | Converts a length of the part to mm on paper.
onPaper :: Page -> Mm -> Double
onPaper page (Mm l) = factor (scale page) * l

-- | Smallest bounding box of a segment. It contains the whole arc, also where the arc bulges beyond
-- the box of its two ends.
extent :: Segment -> BoundingBox
extent = BoundingBox.around

-- | True if the area contains point @p@ of the paper; its edges belong to it.
holds :: Area -> Point -> Bool
holds area p =
  Vec.x p >= leftmost area
    && Vec.x p <= rightmost area
    && Vec.y p >= upper area
    && Vec.y p <= lower area
