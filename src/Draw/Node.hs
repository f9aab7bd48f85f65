-- | The nodes of the way along a contour, numbered from the entry.
module Draw.Node
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

-- | A node of the path, the direction away from the contour there, and its number from the entry.
data Node = Node {place :: Point, outward :: Vec, number :: Int}

-- | The points between the moves, both ends included; a curve has none between its arcs.
nodes :: Cut -> NonEmpty Node
nodes Cut {course, away} =
  entry
    :| zipWith3 node [1 ..] (map NonEmpty.last runs) (map NonEmpty.head (drop 1 runs) <> [after])
  where
    runs = NonEmpty.toList course
    first = NonEmpty.head (NonEmpty.head course)
    final = NonEmpty.last (NonEmpty.last course)
    closed = Vec.near (Segment.start first) (Segment.end final)
    -- A closed way goes round, an open one straight on at its ends.
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

-- | A direction of a segment, nowhere when it has no length.
heading :: (Segment -> Vec) -> Segment -> Vec
heading direction s = if Segment.length s > Mm 1e-9 then direction s else Vec.vec 0 0

-- | Square to the path, where it arrives in one direction and leaves in another.
outwardAt :: Double -> Vec -> Vec -> Vec
outwardAt away arriving leaving
  | Vec.norm along > 1e-3 = Vec.scale away (Vec.left (Vec.unit along))
  | otherwise = Vec.vec 0 (-1)
  where
    along = Vec.add arriving leaving

-- | The points of the nodes. Where they are crowded only those with a number are drawn.
dots :: Cut -> [Svg]
dots cut = [LineStyle.node (marked n) (place n) | n <- NonEmpty.toList numbered, marked n || roomy]
  where
    numbered = nodes cut
    marked n = isMarked (NonEmpty.length (course cut)) n
    Mm whole = total (map Segment.length (NonEmpty.toList (Scene.lines cut)))
    roomy = whole / fromIntegral (NonEmpty.length numbered) > 1.5

-- | The numbers of the nodes; where a closed way ends, it has both its numbers.
labels :: Cut -> [PointLabel]
labels cut
  | Vec.near (place first) (place final) = entry "0" first : map plain between
  | otherwise = entry "0" first : plain final : map plain between
  where
    numbered = nodes cut
    first = NonEmpty.head numbered
    final = NonEmpty.last numbered
    between = filter (isMarked (number final)) (drop 1 (NonEmpty.init numbered))
    plain n = PointLabel (Decimal.whole (number n)) (place n) (outward n) near
    -- The entry is crowded, but is found by the cutter that stands there.
    entry words' n = PointLabel words' (place n) (outward n) (near <> [5.5, 7.5, 10])
    near = [1.2, 2, 3, 4]

-- | Whether a node has its number drawn, by the number of the last node: both ends, and of those
-- between as many as can be read.
isMarked :: Int -> Node -> Bool
isMarked final n = number n `mod` every == 0 || number n == final
  where
    every =
      if final <= most
        then 1
        else round (1 / Page.round125 (fromIntegral most / fromIntegral final)) :: Int

-- | About so many numbers can be read on a drawing, or things told from one another by them.
most :: Int
most = 60
