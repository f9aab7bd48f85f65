-- | Bounding boxes: rectangles parallel to the axes. "Geometry.Index.BoxTree" is an index of things
-- by their boxes.
module Geometry.Index.BoundingBox
  ( BoundingBox (..),
    ofSegment,
    ofPoints,
    union,
    inflate,
    meets,
    distance,
    apart,
    atLeast,
    Index,
    index,
    around,
    within,
    select,
    pairs,
    closest,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The rectangle between two corners, edges included; in mm.
data BoundingBox = BoundingBox {left :: Double, bottom :: Double, right :: Double, top :: Double}
  deriving stock (Eq, Show)

-- | The smallest box that contains a point and a list of further points.
ofPoints :: Point -> [Point] -> BoundingBox
ofPoints p ps = foldl (\box q -> box `union` single q) (single p) ps
  where
    single q = BoundingBox (Vec.x q) (Vec.y q) (Vec.x q) (Vec.y q)

-- | A box that contains a segment. For an arc below half a circle it is the box of the chord,
-- enlarged by the sagitta, else that of the full circle: neither is the smallest.
ofSegment :: Segment -> BoundingBox
ofSegment segment = case segment of
  Straight a b ->
    BoundingBox
      (min (Vec.x a) (Vec.x b))
      (min (Vec.y a) (Vec.y b))
      (max (Vec.x a) (Vec.x b))
      (max (Vec.y a) (Vec.y b))
  Arc {start, end, centre, sweep = Rad s}
    | abs s < pi -> inflate (Segment.bulge segment) (ofPoints start [end])
    | otherwise -> inflate (Segment.radius centre start) (ofPoints centre [])

-- | The smallest box that contains two boxes.
union :: BoundingBox -> BoundingBox -> BoundingBox
union (BoundingBox l b r t) (BoundingBox l' b' r' t') =
  BoundingBox (min l l') (min b b') (max r r') (max t t')

-- | The box enlarged by a margin on all four sides.
inflate :: Mm -> BoundingBox -> BoundingBox
inflate (Mm d) (BoundingBox l b r t) = BoundingBox (l - d) (b - d) (r + d) (t + d)

-- | True when two boxes have a point in common.
meets :: BoundingBox -> BoundingBox -> Bool
meets (BoundingBox l b r t) (BoundingBox l' b' r' t') = l <= r' && l' <= r && b <= t' && b' <= t

-- | A lower bound of a distance over all points of a box: the distance at the box's middle less
-- half of its diagonal. @distanceTo@ is the distance of a point from some fixed set.
atLeast :: (Point -> Mm) -> BoundingBox -> Mm
atLeast distanceTo (BoundingBox l b r t) =
  minus
    (distanceTo (Vec.point ((l + r) / 2) ((b + t) / 2)))
    (Mm (Vec.norm (Vec.vec (r - l) (t - b)) / 2))

-- | The distance between two boxes, 0 when they meet.
apart :: BoundingBox -> BoundingBox -> Mm
apart (BoundingBox l b r t) (BoundingBox l' b' r' t') =
  Mm (Vec.norm (Vec.vec (gap l r l' r') (gap b t b' t')))
  where
    gap low high low' high' = max 0 (max (low' - high) (low - high'))

-- | The distance of a point from a box, 0 inside it.
distance :: Point -> BoundingBox -> Mm
distance p (BoundingBox l b r t) =
  Mm (Vec.norm (Vec.vec (outside l (Vec.x p) r) (outside b (Vec.y p) t)))
  where
    outside low c high = max 0 (max (low - c) (c - high))

-- Replaced by Geometry.Index.BoxTree -----------------------------------------------------------

-- | Things in the order in which they were given, with the boxes of their groups: the order of a
-- contour is a good order in space.
data Index a
  = Empty
  | Leaf {-# UNPACK #-} BoundingBox a
  | Node {-# UNPACK #-} BoundingBox (Index a) (Index a)

-- | Build an index of things by their boxes; linear.
index :: (a -> BoundingBox) -> [a] -> Index a
index box things = fst (build (length things) things)
  where
    -- Of so many things at the front of a list; and what is behind them.
    build n ts = case ts of
      [] -> (Empty, [])
      t : rest
        | n == 1 -> (Leaf (box t) t, rest)
        | otherwise ->
          let half = n `div` 2
              (a, behind) = build half ts
              (b, left') = build (n - half) behind
           in (node a b, left')
    node a b = case (a, b) of
      (Leaf p _, Leaf q _) -> Node (p `union` q) a b
      (Leaf p _, Node q _ _) -> Node (p `union` q) a b
      (Node p _ _, Leaf q _) -> Node (p `union` q) a b
      (Node p _ _, Node q _ _) -> Node (p `union` q) a b
      (Empty, _) -> b
      (_, Empty) -> a
{-# INLINE index #-}

-- | A box around everything in an index; of nothing, one that meets no other.
around :: Index a -> BoundingBox
around i = case i of
  Empty -> BoundingBox (1 / 0) (1 / 0) (-1 / 0) (-1 / 0)
  Leaf p _ -> p
  Node p _ _ -> p

-- | All things whose boxes meet a box, in order.
within :: BoundingBox -> Index a -> [a]
within box = select (meets box)

-- | All things for whose boxes something holds, in order. It holds for a box that holds one for
-- which it does.
select :: (BoundingBox -> Bool) -> Index a -> [a]
select holds i = go i []
  where
    go i' rest = case i' of
      Empty -> rest
      Leaf p a -> if holds p then a : rest else rest
      Node p a b -> if holds p then go a (go b rest) else rest

-- | All pairs of things whose boxes meet, in no order; of each pair the earlier thing is the first.
pairs :: Index a -> [(a, a)]
pairs i = inside i []
  where
    inside one rest = case one of
      Empty -> rest
      Leaf _ _ -> rest
      Node _ a b -> inside a (across a b (inside b rest))
    across one other rest = case (one, other) of
      (Leaf p a, Leaf q b) -> if meets p q then (a, b) : rest else rest
      (Leaf p _, Node q b b') -> if meets p q then across one b (across one b' rest) else rest
      (Node p a a', Leaf q _) -> if meets p q then across a other (across a' other rest) else rest
      (Node p a a', Node q b b') ->
        if meets p q then across a b (across a b' (across a' b (across a' b' rest))) else rest
      (Empty, _) -> rest
      (_, Empty) -> rest

-- | What a measure makes of two things, one of each index, that are nearest to one another; of
-- several it is one of them. The distance that the measure tells is no less than that of their
-- boxes, but for 'Tolerance.coincident': both are rounded.
closest :: (a -> b -> c) -> (c -> Mm) -> Index a -> Index b -> Maybe c
closest measure distanceOf = go Nothing
  where
    go best one other
      | Just c <- best,
        minus (apart (around one) (around other)) Tolerance.coincident > distanceOf c =
        best
      | otherwise = case (one, other) of
        (Leaf _ a, Leaf _ b) -> better best (measure a b)
        (Leaf _ _, Node _ b b') -> nearer best (one, b) (one, b')
        (Node _ a a', Leaf _ _) -> nearer best (a, other) (a', other)
        (Node p a a', Node q b b')
          | size p > size q -> nearer best (a, other) (a', other)
          | otherwise -> nearer best (one, b) (one, b')
        (Empty, _) -> best
        (_, Empty) -> best
    better best c = case best of
      Just b | distanceOf b <= distanceOf c -> best
      _ -> Just c
    nearer best (a, b) (a', b')
      | apart (around a) (around b) <= apart (around a') (around b') = go (go best a b) a' b'
      | otherwise = go (go best a' b') a b
    size (BoundingBox l b r t) = (r - l) + (t - b)
