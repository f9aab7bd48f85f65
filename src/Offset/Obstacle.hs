{-# LANGUAGE BangPatterns #-}

-- | The reasons why a cutter does not fit beside a contour. Elements of the contour are numbered
-- from 0. An inner corner turns towards the cutter. It is slight when the cutter comes so near to
-- its vertex that no material counts as left there.
--
-- A concave arc or an inner corner is an obstacle by itself, so it is found without the other
-- elements. A collision with a distant element is found by the distance between the raw offset
-- ("Offset.RawOffset") and the contour. This search takes longer. Therefore it is made only after
-- the kernel has found that the cutter does not reach every element.
module Offset.Obstacle
  ( Obstacle (..),
    Cause (..),
    localCauses,
    collision,
    gouges,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Offset.SourceOffset
import Offset.Tolerance qualified as Tolerance

-- | A reason why a cutter does not fit, and the largest cutter radius that fits; Nothing when no
-- cutter fits.
data Obstacle = Obstacle {cause :: Cause, largest :: Maybe Mm}
  deriving stock (Eq, Show)

-- | A reason why a cutter does not fit. Elements of the contour are given by their numbers from 0.
data Cause
  = -- | an arc whose centre is on the cutter's side: its number, and its radius, which is smaller
    -- than the distance between the cutter's centre and the arc
    Concave Int Mm
  | -- | a corner that turns towards the cutter: the numbers of the elements before and after it,
    -- and its vertex. If an element is too short between slight corners ('localCauses'), the point
    -- is the end of the element's offset
    InnerCorner Int Int Point
  | -- | a collision: the cutter moves beside the first element, and meets the second one when its
    -- centre is at the given point
    Collision Int Int Point
  deriving stock (Eq, Show)

-- | The obstacles at single elements and corners: first concave arcs, then inner corners, then
-- elements that are too short between slight inner corners. 'Offset.SourceOffset.Corner' explains
-- the kinds of corners.
localCauses :: OffsetSource -> [Cause]
localCauses source =
  [Concave i r | i <- numbers, Just r <- [tooTight source i]]
    <> [ InnerCorner i (next source i) (Segment.end (elements source Vector.! i))
         | i <- numbers,
           Blocked <- [cornerAt source i]
       ]
    <> tooShort source
  where
    numbers = [0 .. elementCount source - 1]

-- | The radius of element @i@ if it is an arc whose centre is on the cutter's side and whose radius
-- is smaller than the offset's distance. Such an arc is too tight for the cutter. Nothing for every
-- other element.
tooTight :: OffsetSource -> Int -> Maybe Mm
tooTight source i = case elements source Vector.! i of
  Arc {start, centre, sweep = Rad angle}
    | signum angle == Carrier.sideSign (side source),
      old <- Segment.radius centre start,
      minus old (distanceAt source i) < times (-1) Tolerance.coincident ->
      Just old
  _ -> Nothing

-- | An obstacle for each element that is too short for the slight corners at its ends. It names one
-- of these corners, but its point is the end of the element's offset, not the vertex. Each slight
-- corner cuts a length off the two offsets that meet there. An element is too short when its offset
-- is not longer than the lengths cut off at its start and its end together.
tooShort :: OffsetSource -> [Cause]
tooShort source = go 0 frontOfFirst (movedElement source 0)
  where
    count = elementCount source
    final = count - 1
    Cuts _ frontOfFirst = cutsAt source final (movedElement source final) (movedElement source 0)
    go !i !front s
      | i == count = []
      | front + back > 0, Mm (front + back) >= Segment.length s = corner : others
      | otherwise = others
      where
        s' = movedElement source (next source i)
        Cuts back front' = cutsAt source i s s'
        others = go (i + 1) front' s'
        corner = InnerCorner a (next source a) (Segment.end s)
        a = if front > 0 && (i > 0 || back <= 0) then (i - 1) `mod` count else i

-- | The collision of a cutter whose centre moves along @path@, the offset of all elements. It is at
-- the point where the centre is nearest to an element that the cutter would cut. When the cutter
-- cuts nowhere, the path only intersects itself. Then the result has the start of the path as its
-- point, and the element of the first segment twice.
collision :: OffsetSource -> NonEmpty OffsetSegment -> Cause
collision source path
  | null found =
    let OffsetSegment o s = NonEmpty.head path
     in Collision (numberOf o) (numberOf o) (Segment.start s)
  | otherwise = case minimumBy (comparing (\(d, _, _, _) -> d)) found of
    (_, i, j, p) -> Collision i j p
  where
    found = gouges source (NonEmpty.toList path)

-- | The points at which a cutter on segments of an offset would cut the contour. Each result has
-- four parts: the distance of the cutter's centre from the element that it cuts; the number of the
-- element beside which the cutter moves; the number of the element that it cuts; the position of
-- the centre.
gouges :: OffsetSource -> [OffsetSegment] -> [(Mm, Int, Int, Point)]
gouges source = concatMap gougesOf
  where
    count = elementCount source
    index =
      BoxTree.index
        (BoundingBox.ofSegment . snd)
        (Vector.toList (Vector.indexed (elements source)))
    gougesOf (OffsetSegment o s) =
      [ (d, numberOf o, j, p)
        | (j, other) <- BoxTree.select (isNear s) index,
          let ClosestPoint d p = Distance.segments s other,
          plus d Tolerance.clearance < distanceAt source j
      ]
    isNear s box =
      BoundingBox.meets (BoundingBox.inflate widest (BoundingBox.ofSegment s)) box
        && BoundingBox.lowerBound (`Distance.toPoint` s) box < widest
    widest = maximum (map (distanceAt source) [0 .. count - 1])
