-- | The sheet of a drawing: an A4 page lying on its side, its scale, and where on it the part lies.
--
-- On paper x runs to the right and y down, in mm from the upper left corner of the page.
module Draw.Page
  ( Page,
    lay,
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
    page,
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

-- | A scale, and the point of the part in the middle of the field.
data Page = Page {scale :: Scale, middle :: Point}
  deriving stock (Eq, Show)

-- | So many mm on paper for so many of the part.
data Scale = Scale {paper :: Double, real :: Double}
  deriving stock (Eq, Show)

-- | A rectangle on paper.
data Area = Area {leftmost :: Double, upper :: Double, rightmost :: Double, lower :: Double}
  deriving stock (Eq, Show)

-- | The whole page, 297 × 210 mm.
page :: Area
page = Area 0 0 297 210

-- | Where the part is drawn: what a margin of 10 mm leaves above the strip.
field :: Area
field = Area 10 10 287 184

-- | The strip below it for the legend and the title.
strip :: Area
strip = Area 10 184 287 200

-- | What is kept free along the edges of the field, for the labels.
padding :: Double
padding = 6

-- | A sheet that shows everything in a box of the part, and the origin where the scale allows it.
lay :: BoundingBox -> Page
lay box = Page {scale = chosen, middle = Vec.point ((left + right) / 2) ((bottom + top) / 2)}
  where
    chosen = scaleFor box
    wider = BoundingBox.union box (BoundingBox.ofPoints (Vec.point 0 0) [])
    BoundingBox {left, bottom, right, top} = if fits wider chosen then wider else box

-- | Full size where that fits and is not tiny, else the largest standard scale that fits.
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

fits :: BoundingBox -> Scale -> Bool
fits box s = filled box s <= 1

-- | How much of the field's width or height a box takes, the larger of the two.
filled :: BoundingBox -> Scale -> Double
filled BoundingBox {left, bottom, right, top} s =
  factor s * max ((right - left) / width) ((top - bottom) / height)
  where
    width = rightmost field - leftmost field - 2 * padding
    height = lower field - upper field - 2 * padding

factor :: Scale -> Double
factor s = paper s / real s

-- | A scale as it is written: 1:2.5.
ratio :: Scale -> Text
ratio s = Decimal.short 4 (paper s) <> ":" <> Decimal.short 4 (real s)

-- | The largest of … 1, 2, 5, 10, 20 … that is not above a positive number.
round125 :: Double -> Double
round125 limit = maximum (decade : [d | d <- map (decade *) [2, 5, 10], d <= limit])
  where
    decade = 10 ^^ (floor (logBase 10 limit) :: Int)

-- | Where a point of the part lies on paper.
place :: Page -> Point -> Point
place Page {scale, middle} p =
  Vec.point
    ((leftmost field + rightmost field) / 2 + factor scale * (Vec.x p - Vec.x middle))
    ((upper field + lower field) / 2 - factor scale * (Vec.y p - Vec.y middle))

-- | The point of the part that lies at a place on paper.
unplace :: Page -> Point -> Point
unplace Page {scale, middle} p =
  Vec.point
    (Vec.x middle + (Vec.x p - (leftmost field + rightmost field) / 2) / factor scale)
    (Vec.y middle - (Vec.y p - (upper field + lower field) / 2) / factor scale)

-- | A segment on paper. What is walked counter-clockwise still looks so; its sweep is negative
-- there, because y points down.
segment :: Page -> Segment -> Segment
segment sheet s = case s of
  Straight a b -> Straight (place sheet a) (place sheet b)
  Arc {start, end, centre, sweep = Rad a} ->
    Arc
      { start = place sheet start,
        end = place sheet end,
        centre = place sheet centre,
        sweep = Rad (-a)
      }

-- | How long a length of the part is on paper.
onPaper :: Page -> Mm -> Double
onPaper sheet (Mm l) = factor (scale sheet) * l

-- | The smallest box around a segment.
extent :: Segment -> BoundingBox
extent s = case s of
  Straight a b -> BoundingBox.ofPoints a [b]
  Arc {start, end, centre} ->
    let Mm r = Segment.radius centre start
        quarters =
          [Vec.shift v centre | v <- [Vec.vec r 0, Vec.vec 0 r, Vec.vec (-r) 0, Vec.vec 0 (-r)]]
     in BoundingBox.ofPoints start (end : filter (Segment.spans s) quarters)

-- | Whether a point on paper lies in an area.
holds :: Area -> Point -> Bool
holds area p =
  Vec.x p >= leftmost area
    && Vec.x p <= rightmost area
    && Vec.y p >= upper area
    && Vec.y p <= lower area
