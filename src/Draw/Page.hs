-- | Page of a drawing: an A4 page in landscape, its scale, and the position of the part on it.
--
-- On paper, x points right and y points down, in mm from the upper left corner of the page. On the
-- part, y points up. The field is the area for the part; the strip below it has legend and title
-- block.
module Draw.Page
  ( Page,
    choose,
    Scale (..),
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
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | Scale of a drawing, and the point of the part that is drawn at the centre of the field.
data Page = Page {scale :: Scale, middle :: Point}
  deriving stock (Eq, Show)

-- | Scale: @paper@ mm on paper show @real@ mm of the part.
data Scale = Scale {paper :: Double, real :: Double}
  deriving stock (Eq, Show)

-- | Rectangle on paper, in mm. As y points down, @upper@ is less than @lower@.
data Area = Area {leftmost :: Double, upper :: Double, rightmost :: Double, lower :: Double}
  deriving stock (Eq, Show)

-- | Whole page, 297 × 210 mm.
wholePage :: Area
wholePage = Area 0 0 297 210

-- | Field in which the part is drawn: the page without a margin of 10 mm and without the 'strip'.
field :: Area
field = Area 10 10 287 184

-- | Strip below the field, for the legend and the title block.
strip :: Area
strip = Area 10 184 287 200

-- | Width in mm that is kept free along each edge of the field, for labels.
padding :: Double
padding = 6

-- | Page for a part with the given bounding box. The scale fits the box, and the centre of the box
-- is at the centre of the field. If the box still fits at this scale when it is extended to the
-- origin of the part, the centre of the extended box is taken instead.
choose :: BoundingBox -> Page
choose box = Page {scale = chosen, middle = Vec.point ((left + right) / 2) ((bottom + top) / 2)}
  where
    chosen = scaleFor box
    wider = BoundingBox.union box (BoundingBox.ofPoints (Vec.point 0 0) [])
    BoundingBox {left, bottom, right, top} = if fits wider chosen then wider else box

-- | Chooses the scale for a bounding box. The scale is 1:1 if the box then fits into the field and
-- fills at least 0.4 of the field's width or height. Otherwise it is the largest standard scale at
-- which the box fits. The standard scales are those of ISO 5455, and 1:2.5. A box without width and
-- height gets 1:1.
scaleFor :: BoundingBox -> Scale
scaleFor box
  | not (fits box (Scale 1 1)) = fromMaybe (Scale 1 1) (find (fits box) reductions)
  | tiny = fromMaybe (Scale 1 1) (find (fits box) (reverse enlargements))
  | otherwise = Scale 1 1
  where
    tiny = filled box (Scale 1 1) < 0.4 && right box + top box > left box + bottom box
    reductions =
      [Scale 1 m | m <- 2 : 2.5 : 5 : [d * 10 ^ e | e <- [1 .. 12 :: Int], d <- [1, 2, 5]]]
    enlargements = [Scale m 1 | m <- 2 : 5 : [d * 10 ^ e | e <- [1 .. 6 :: Int], d <- [1, 2, 5]]]

-- | True if a bounding box on the part fits into the field at a scale.
fits :: BoundingBox -> Scale -> Bool
fits box s = filled box s <= 1

-- | Fraction of the field that a bounding box takes at a scale, in width or in height, whichever is
-- larger; above 1 if the box does not fit. The field is taken without its 'padding'.
filled :: BoundingBox -> Scale -> Double
filled BoundingBox {left, bottom, right, top} s =
  factor s * max ((right - left) / width) ((top - bottom) / height)
  where
    width = rightmost field - leftmost field - 2 * padding
    height = lower field - upper field - 2 * padding

-- | Length on paper divided by the length on the part: 0.5 at the scale 1:2.
factor :: Scale -> Double
factor s = paper s / real s

-- | Scale in the notation 1:2.5, with at most four decimals.
ratio :: Scale -> Text
ratio s = Decimal.short 4 (paper s) <> ":" <> Decimal.short 4 (real s)

-- | Largest number of the series … 0.5, 1, 2, 5, 10, 20 … that does not exceed @limit@, which is
-- positive.
round125 :: Double -> Double
round125 limit = maximum (decade : [d | d <- map (decade *) [2, 5, 10], d <= limit])
  where
    decade = 10 ^^ (floor (logBase 10 limit) :: Int)

-- | Converts a point of the part to paper.
place :: Page -> Point -> Point
place Page {scale, middle} p =
  Vec.point
    ((leftmost field + rightmost field) / 2 + factor scale * (Vec.x p - Vec.x middle))
    ((upper field + lower field) / 2 - factor scale * (Vec.y p - Vec.y middle))

-- | Converts a point on paper to a point of the part.
unplace :: Page -> Point -> Point
unplace Page {scale, middle} p =
  Vec.point
    (Vec.x middle + (Vec.x p - (leftmost field + rightmost field) / 2) / factor scale)
    (Vec.y middle - (Vec.y p - (upper field + lower field) / 2) / factor scale)

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
extent s = case s of
  Straight a b -> BoundingBox.ofPoints a [b]
  Arc {start, end, centre} ->
    let Mm r = Segment.radius centre start
        quarters =
          [Vec.shift v centre | v <- [Vec.vec r 0, Vec.vec 0 r, Vec.vec (-r) 0, Vec.vec 0 (-r)]]
     in BoundingBox.ofPoints start (end : filter (Segment.hasFootOf s) quarters)

-- | True if the area contains point @p@ of the paper; its edges belong to it.
holds :: Area -> Point -> Bool
holds area p =
  Vec.x p >= leftmost area
    && Vec.x p <= rightmost area
    && Vec.y p >= upper area
    && Vec.y p <= lower area
