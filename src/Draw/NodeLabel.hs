-- | Dots and numbers for the nodes of a cut. A cut is the toolpath of one pass along a contour. A
-- section of a cut is one line, one arc, or the arcs of one curve. The nodes are the ends of the
-- sections. The node at the entry, where the cut begins, has the number 0.
module Draw.NodeLabel
  ( dots,
    labels,
    shown,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), total)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Draw.Label (PointLabel (PointLabel))
import Draw.Label qualified as Label
import Draw.LineStyle (LineStyles)
import Draw.LineStyle qualified as LineStyle
import Draw.Page qualified as Page
import Draw.Scene (Cut (..))
import Draw.Scene qualified as Scene
import Draw.Svg (Svg)
import Draw.Svg qualified as Svg
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | Node: position on paper, direction in which its label is best placed, and number. The direction
-- is a unit vector that points away from the contour. The number is 0 at the entry.
data Node = Node {place :: Point, outward :: Vec, number :: Int}

-- | Nodes of a cut, from the entry on: its two ends and the points between its sections.
nodes :: Cut -> NonEmpty Node
nodes Cut {sections, away} =
  entry
    :| zipWith3 node [1 ..] (map NonEmpty.last runs) (map NonEmpty.head (drop 1 runs) <> [after])
  where
    runs = NonEmpty.toList sections
    first = NonEmpty.head (NonEmpty.head sections)
    final = NonEmpty.last (NonEmpty.last sections)
    closed = Vec.isNear (Segment.start first) (Segment.end final)
    -- The segments before the start and after the end of the cut. In a closed cut they are its last
    -- and its first segment. An open cut has no such segments; its first and its last segment are
    -- taken in their place.
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

-- | Direction of segment @s@ at one of its ends. The function @direction@ computes it, for example
-- 'Segment.startDirection'. The result is the zero vector if the segment has no length.
heading :: (Segment -> Vec) -> Segment -> Vec
heading direction s = if Segment.length s > Mm 1e-9 then direction s else Vec.vec 0 0

-- | Direction in which a label is best placed at a node: away from the contour, and square to the
-- mean of the directions @arriving@ and @leaving@ of the cut before and after the node. @away@ is
-- +1 if the side away from the contour is on the right of the cut, -1 if it is on the left. At a
-- point where the cut reverses, the result points to the upper edge of the paper.
outwardAt :: Double -> Vec -> Vec -> Vec
outwardAt away arriving leaving
  | Vec.norm along > 1e-3 = Vec.scale away (Vec.left (Vec.unit along))
  | otherwise = Vec.vec 0 (-1)
  where
    along = Vec.add arriving leaving

-- | The cuts of a drawing whose nodes are shown. In a drawing with more than 'mostCuts' numbered
-- cuts, these are the large ones: numbers would hide small ones, such as the strokes of a text.
shown :: [Cut] -> [Cut]
shown cuts = if length marked' > mostCuts then filter isLarge marked' else marked'
  where
    marked' = filter numbered cuts
    isLarge cut =
      let BoundingBox {left, bottom, right, top} =
            foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (Scene.lines cut))
       in max (right - left) (top - bottom) > 6 * Label.size

-- | Dots of the nodes. If the nodes are closer than 1.5 mm of paper on average, only a node whose
-- number is shown has a dot.
dots :: LineStyles -> Cut -> [Svg]
dots styles cut =
  [LineStyle.node styles isMarked (place n) | (n, isMarked) <- marked cut, isMarked || roomy]
  where
    Mm whole = total (map Segment.length (NonEmpty.toList (Scene.lines cut)))
    roomy = whole / fromIntegral (NonEmpty.length (sections cut) + 1) > 1.5

-- | Labels with the numbers of the nodes. The last node of a closed cut is the entry, and has only
-- the label 0 of the entry.
labels :: LineStyles -> Cut -> [PointLabel]
labels styles cut
  | Vec.isNear (place first) (place final) = entry "0" first : map plain between
  | otherwise = entry "0" first : plain final : map plain between
  where
    ends = nodes cut
    first = NonEmpty.head ends
    final = NonEmpty.last ends
    between = [n | (n, True) <- marked cut, number n > 0, number n < number final]
    plain n = PointLabel (Decimal.whole (number n)) (place n) (outward n) near letters
    -- The label of the entry may be further away, because the cutter is drawn at the entry.
    entry words' n = PointLabel words' (place n) (outward n) (near <> [5.5, 7.5, 10]) letters
    near = [1.2, 2, 3, 4]
    letters = (LineStyle.lettering styles Label.size) {Svg.ink = LineStyle.pathColour styles}

-- | Nodes of a cut, each with True if it has a label. Both ends of the cut have labels. A node
-- between them has one if it is at least 'apart' away from the node with a label before it and from
-- the end. If there are more than 'most' nodes, the number of such a node is also a multiple of the
-- smallest of 2, 5, 10, 20 and so on that has at most 'most' multiples among the numbers.
marked :: Cut -> [(Node, Bool)]
marked cut = (first, True) : go first more
  where
    first :| more = nodes cut
    final = NonEmpty.last (nodes cut)
    go before rest = case rest of
      [] -> []
      n : others
        | number n == number final -> (n, True) : go n others
        | number n `mod` every == 0 && isApart before n && isApart final n ->
          (n, True) : go n others
        | otherwise -> (n, False) : go before others
    isApart a b = let Mm d = Vec.distance (place a) (place b) in d >= apart
    every =
      if number final <= most
        then 1
        else round (1 / Page.round125 (fromIntegral most / fromIntegral (number final))) :: Int

-- | Least distance between nodes with labels, in mm of paper: the height of a digit and a gap.
apart :: Double
apart = 3.5

-- | Greatest count of cuts with numbers on a drawing. If there are more, small ones have none.
mostCuts :: Int
mostCuts = 20

-- | Greatest legible count of node numbers on one cut.
most :: Int
most = 60
