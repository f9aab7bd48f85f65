-- | Nodes of the toolpath along a contour, numbered from the entry, as dots and labels.
module Draw.NodeLabel
  ( dots,
    labels,
    most,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), total)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Draw.Label (PointLabel (PointLabel))
import Draw.LineStyle qualified as LineStyle
import Draw.Page qualified as Page
import Draw.Scene (Cut (..))
import Draw.Scene qualified as Scene
import Draw.Svg (Svg)
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | Node: its position on paper, the direction away from the contour (a unit vector), and its
-- number from 0 at the entry.
data Node = Node {place :: Point, outward :: Vec, number :: Int}

-- | Points between the moves of a cut, both ends included. Arcs of one curve have no nodes
-- between them.
nodes :: Cut -> NonEmpty Node
nodes Cut {course, away} =
  entry
    :| zipWith3 node [1 ..] (map NonEmpty.last runs) (map NonEmpty.head (drop 1 runs) <> [after])
  where
    runs = NonEmpty.toList course
    first = NonEmpty.head (NonEmpty.head course)
    final = NonEmpty.last (NonEmpty.last course)
    closed = Vec.isNear (Segment.start first) (Segment.end final)
    -- A closed cut continues at its end with its first move; an open one continues straight on.
    (before, after) = if closed then (final, first) else (first, final)
    entry =
      Node
        { place = Segment.start first,
          outward = ending Segment.startDirection before first,
          number = 0
        }
    node number s next =
      Node {place = Segment.end s, outward = ending Segment.endDirection s next, number}
    ending alone s next
      | s == next && not closed = outwardAt away (heading alone s) (heading alone s)
      | otherwise =
        outwardAt away (heading Segment.endDirection s) (heading Segment.startDirection next)

-- | Direction of a segment, or the zero vector if the segment has no length.
heading :: (Segment -> Vec) -> Segment -> Vec
heading direction s = if Segment.length s > Mm 1e-9 then direction s else Vec.vec 0 0

-- | Direction away from the contour at a node, square to the mean of the arriving and the leaving
-- direction. The factor is +1 or -1 for the side.
outwardAt :: Double -> Vec -> Vec -> Vec
outwardAt away arriving leaving
  | Vec.norm along > 1e-3 = Vec.scale away (Vec.left (Vec.unit along))
  | otherwise = Vec.vec 0 (-1)
  where
    along = Vec.add arriving leaving

-- | Dots of the nodes. If there are many, only numbered nodes have dots.
dots :: Cut -> [Svg]
dots cut = [LineStyle.node (marked n) (place n) | n <- NonEmpty.toList numbered, marked n || roomy]
  where
    numbered = nodes cut
    marked n = isMarked (NonEmpty.length (course cut)) n
    Mm whole = total (map Segment.length (NonEmpty.toList (Scene.lines cut)))
    roomy = whole / fromIntegral (NonEmpty.length numbered) > 1.5

-- | Labels with the numbers of the nodes. The last node of a closed cut has two numbers.
labels :: Cut -> [PointLabel]
labels cut
  | Vec.isNear (place first) (place final) = entry "0" first : map plain between
  | otherwise = entry "0" first : plain final : map plain between
  where
    numbered = nodes cut
    first = NonEmpty.head numbered
    final = NonEmpty.last numbered
    between = filter (isMarked (number final)) (drop 1 (NonEmpty.init numbered))
    plain n = PointLabel (Decimal.whole (number n)) (place n) (outward n) near
    -- The entry needs more room, because the cutter is drawn there.
    entry words' n = PointLabel words' (place n) (outward n) (near <> [5.5, 7.5, 10])
    near = [1.2, 2, 3, 4]

-- | True of a node that has a label; the first argument is the number of the last node. Both ends
-- have labels, and as many nodes between them as 'most' allows.
isMarked :: Int -> Node -> Bool
isMarked final n = number n `mod` every == 0 || number n == final
  where
    every =
      if final <= most
        then 1
        else round (1 / Page.round125 (fromIntegral most / fromIntegral final)) :: Int

-- | Greatest count of numbers, or of distinguishable lines, that stay legible on one drawing.
most :: Int
most = 60
