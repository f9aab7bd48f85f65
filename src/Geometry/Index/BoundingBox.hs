-- | Bounding boxes: rectangles parallel to the axes. "Geometry.Index.BoxTree" is an index of things
-- by their boxes.
module Geometry.Index.BoundingBox
  ( BoundingBox (..),
    ofSegment,
    around,
    ofPoints,
    union,
    inflate,
    meets,
    distance,
    gapBetween,
    lowerBound,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The rectangle from (@left@, @bottom@) to (@right@, @top@), edges included; in mm.
data BoundingBox = BoundingBox {left :: Double, bottom :: Double, right :: Double, top :: Double}
  deriving stock (Eq, Show)

-- | The smallest box that contains the point @p@ and the points @ps@.
ofPoints :: Point -> [Point] -> BoundingBox
ofPoints p ps = foldl (\box q -> box `union` single q) (single p) ps
  where
    single q = BoundingBox (Vec.x q) (Vec.y q) (Vec.x q) (Vec.y q)

-- | A box that contains a segment; for an arc it is not always the smallest. For an arc that sweeps
-- less than a half circle it is the box of the ends, enlarged by the sagitta. For other arcs it is
-- the box of the full circle.
ofSegment :: Segment -> BoundingBox
ofSegment segment = case segment of
  Straight a b ->
    BoundingBox
      (min (Vec.x a) (Vec.x b))
      (min (Vec.y a) (Vec.y b))
      (max (Vec.x a) (Vec.x b))
      (max (Vec.y a) (Vec.y b))
  Arc {start, end, centre, sweep = Rad s}
    | abs s < pi -> inflate (Segment.sagitta segment) (ofPoints start [end])
    | otherwise -> inflate (Segment.radius centre start) (ofPoints centre [])

-- | The smallest box that contains a segment.
around :: Segment -> BoundingBox
around segment = case segment of
  Straight a b -> ofPoints a [b]
  Arc {start, end, centre} ->
    let Mm r = Segment.radius centre start
        extremes =
          [Vec.shift v centre | v <- [Vec.vec r 0, Vec.vec 0 r, Vec.vec (-r) 0, Vec.vec 0 (-r)]]
     in ofPoints start (end : filter (Segment.hasFootOf segment) extremes)

-- | The smallest box that contains two boxes.
union :: BoundingBox -> BoundingBox -> BoundingBox
union (BoundingBox l b r t) (BoundingBox l' b' r' t') =
  BoundingBox (min l l') (min b b') (max r r') (max t t')

-- | The box enlarged by the margin @d@ on all four sides.
inflate :: Mm -> BoundingBox -> BoundingBox
inflate (Mm d) (BoundingBox l b r t) = BoundingBox (l - d) (b - d) (r + d) (t + d)

-- | True when two boxes have a point in common.
meets :: BoundingBox -> BoundingBox -> Bool
meets (BoundingBox l b r t) (BoundingBox l' b' r' t') = l <= r' && l' <= r && b <= t' && b' <= t

-- | A lower bound of @distanceTo@ over all points of a box, by which a search decides to skip the
-- box. @distanceTo@ gives the distance of a point from some fixed figure. The bound is the value of
-- @distanceTo@ at the box's middle, less half of the box's diagonal. The bound may be negative.
lowerBound :: (Point -> Mm) -> BoundingBox -> Mm
lowerBound distanceTo (BoundingBox l b r t) =
  minus
    (distanceTo (Vec.point ((l + r) / 2) ((b + t) / 2)))
    (Mm (Vec.norm (Vec.vec (r - l) (t - b)) / 2))

-- | The least distance between two boxes; 0 when they meet.
gapBetween :: BoundingBox -> BoundingBox -> Mm
gapBetween (BoundingBox l b r t) (BoundingBox l' b' r' t') =
  Mm (Vec.norm (Vec.vec (gap l r l' r') (gap b t b' t')))
  where
    gap low high low' high' = max 0 (max (low' - high) (low - high'))

-- | The distance of the point @p@ from a box; 0 inside the box.
distance :: Point -> BoundingBox -> Mm
distance p (BoundingBox l b r t) =
  Mm (Vec.norm (Vec.vec (outside l (Vec.x p) r) (outside b (Vec.y p) t)))
  where
    outside low c high = max 0 (max (low - c) (c - high))
