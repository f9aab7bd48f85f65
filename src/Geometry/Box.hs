-- | Boxes parallel to the axes, and an index of things by their boxes.
module Geometry.Box
  ( Box (..),
    ofSegment,
    ofPoints,
    union,
    inflate,
    meets,
    Index,
    index,
    within,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The points between two corners.
data Box = Box {left :: Double, bottom :: Double, right :: Double, top :: Double}
  deriving stock (Eq, Show)

-- | The smallest box that holds some points, of which there is at least the first.
ofPoints :: Point -> [Point] -> Box
ofPoints p ps = foldl (\box q -> box `union` single q) (single p) ps
  where
    single q = Box (Vec.x q) (Vec.y q) (Vec.x q) (Vec.y q)

-- | A box that holds a segment; for an arc its chord's box grown by the sagitta, or the circle's.
ofSegment :: Segment -> Box
ofSegment segment = case segment of
  Straight a b -> ofPoints a [b]
  Arc {start, end, centre, sweep = Rad s}
    | abs s < pi -> inflate (Segment.bulge segment) (ofPoints start [end])
    | otherwise -> inflate (Segment.radius centre start) (ofPoints centre [])

union :: Box -> Box -> Box
union (Box l b r t) (Box l' b' r' t') = Box (min l l') (min b b') (max r r') (max t t')

-- | Grown on all sides.
inflate :: Mm -> Box -> Box
inflate (Mm d) (Box l b r t) = Box (l - d) (b - d) (r + d) (t + d)

-- | Whether two boxes have a point in common.
meets :: Box -> Box -> Bool
meets (Box l b r t) (Box l' b' r' t') = l <= r' && l' <= r && b <= t' && b' <= t

-- | Things in the order in which they were given, with the boxes of their groups: the order of a
-- contour is a good order in space.
data Index a = Empty | Leaf Box a | Node Box (Index a) (Index a)

-- | Build an index, n·log n.
index :: (a -> Box) -> [a] -> Index a
index box things = build (length things) things
  where
    build n ts = case ts of
      [] -> Empty
      [a] -> Leaf (box a) a
      _ ->
        let half = n `div` 2
            (first, second) = splitAt half ts
         in node (build half first) (build (n - half) second)
    node a b = case (extent a, extent b) of
      (Just p, Just q) -> Node (p `union` q) a b
      (Nothing, _) -> b
      (_, Nothing) -> a
    extent i = case i of
      Empty -> Nothing
      Leaf p _ -> Just p
      Node p _ _ -> Just p

-- | All things whose boxes meet a box, in order.
within :: Box -> Index a -> [a]
within box i = go i []
  where
    go i' rest = case i' of
      Empty -> rest
      Leaf p a -> if meets box p then a : rest else rest
      Node p a b -> if meets box p then go a (go b rest) else rest
