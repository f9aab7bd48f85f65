-- | Elements of a contour, in a bounding-box tree, for the comparison with a tape. Each element is
-- stored with the numbers that every comparison needs.
module Verify.Edge
  ( Edge (..),
    edgesOf,
    isCurved,
    largestAllowance,
    leastExcess,
    leftwardness,
    isCusp,
    turning,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (foldl')
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance
import Part.Part (Contour, Element)
import Part.Part qualified as Part

-- | Element of a contour, with its numbers, so that they are not computed again for each motion.
data Edge = Edge
  { element :: Element,
    -- | number of the element in the contour, from 0
    rank :: Int,
    -- | arc length from the start of the contour to the start of the element, in mm
    startsAt :: Double,
    -- | length of the element, in mm
    long :: Double,
    -- | allowance of the element itself, in addition to that of the pass
    ownAllowance :: Mm,
    -- | true if this element and the one before it replace the same curve of the part
    continues :: Bool,
    -- | segment of the element
    shape :: Segment
  }

-- | Bounding-box tree of the elements of a contour.
edgesOf :: Contour -> BoxTree Edge
edgesOf contour =
  BoxTree.indexFirst
    (NonEmpty.length elements)
    (FastDistance.box . shape)
    (go 0 0 (NonEmpty.toList elements))
  where
    elements = Part.elements contour
    -- Strict in the sum of lengths, so that no thunk keeps the earlier elements in memory.
    go :: Int -> Double -> [Element] -> [Edge]
    go rank startsAt rest = case rest of
      [] -> []
      element : more ->
        let Mm long = Segment.length (Part.segment element)
            endsAt = startsAt + long
            edge =
              Edge
                { element,
                  rank,
                  startsAt,
                  long,
                  ownAllowance = Part.allowance (Part.finish element),
                  continues = Part.continues element,
                  shape = Part.segment element
                }
         in edge `seq` endsAt `seq` (edge : go (rank + 1) endsAt more)

-- | Test that a contour has curves. It has one if an element and the element before it replace the
-- same curve.
isCurved :: BoxTree Edge -> Bool
isCurved = BoxTree.foldl' (\is e -> is || continues e) False

-- | Largest allowance of a single element, in mm; -∞ without elements.
largestAllowance :: BoxTree Edge -> Mm
largestAllowance = BoxTree.foldl' (\most e -> max most (ownAllowance e)) (Mm (-1 / 0))

-- | Least excess distance in mm of the elements @near@, but at most @limit@. The excess distance of
-- an element is its distance from the point @p@ minus its allowance, which @allowanceOf@ gives. A
-- cutter with its centre at @p@ touches the elements whose excess distance is about the least one.
leastExcess :: (Edge -> Mm) -> Double -> [Edge] -> Point -> Double
leastExcess allowanceOf limit near p = foldl' lesser limit near
  where
    lesser least e
      | Mm a <- allowanceOf e,
        far <- min limit (least + a),
        FastDistance.mayLieWithin far (long e) (shape e) (Vec.x p) (Vec.y p) =
        min least (FastDistance.distance (shape e) (Vec.x p) (Vec.y p) - a)
      | otherwise = least

-- | Signed distance in mm of the point @p@ from a contour: positive on the left of the direction of
-- travel. @foot@ is the point of the contour that is nearest to @p@. If @foot@ is a corner, the
-- result is the sum of the signed distances from the tangents of both elements; then only its sign
-- has a meaning. At a cusp both tangents are nearly one line. Then the sign is opposite to that of
-- the turning: @p@ lies outside of the wedge between both elements.
leftwardness :: BoxTree Edge -> Point -> Point -> Double
leftwardness edges foot p = case touching of
  [a, b]
    | Vec.distance foot (Segment.end a) < Vec.distance foot (Segment.end b),
      isCusp a b ->
      besideCusp a b
    | isCusp b a -> besideCusp b a
  _ -> sum (map crossProduct touching)
  where
    besideCusp before after = let Rad angle = turning before after in -angle
    crossProduct s = Vec.cross (directionAt foot s) (Vec.to foot p)
    touching =
      filter
        (\s -> Distance.toPoint foot s <= Tolerance.coincident)
        ( map
            shape
            ( BoxTree.within
                (BoundingBox.inflate Tolerance.coincident (BoundingBox.ofPoints foot []))
                edges
            )
        )

-- | Test that the contour turns back between two elements: its direction changes by half a turn, to
-- 'Tolerance.cuspAngle'.
isCusp :: Segment -> Segment -> Bool
isCusp before after =
  Vec.isNear (Segment.end before) (Segment.start after)
    && Vec.dot v w < 0
    && Rad (abs (Vec.cross v w)) <= Tolerance.cuspAngle
  where
    v = Segment.endDirection before
    w = Segment.startDirection after

-- | Angle in radians by which the contour turns between two elements, counter-clockwise positive.
-- At a cusp the angle between the tangents does not show the sense. There the elements are compared
-- at 'Tolerance.cuspDepth' from the vertex: the contour turns to the side on which the second
-- element lies.
turning :: Segment -> Segment -> Rad
turning before after
  | isCusp before after =
    let lead = Vec.cross v w - Tolerance.cuspDepth / 2 * (curvature before + curvature after)
     in Rad (if lead > 0 then abs angle else -(abs angle))
  | otherwise = Rad angle
  where
    v = Segment.endDirection before
    w = Segment.startDirection after
    Rad angle = Vec.signedAngle v w

-- | Curvature of a segment in 1/mm, positive for a counter-clockwise arc.
curvature :: Segment -> Double
curvature segment = case segment of
  Straight _ _ -> 0
  Arc {start, centre, sweep = Rad sweep} ->
    let Mm radius = Segment.radius centre start in signum sweep / radius

-- | Direction of travel on a segment at its point @p@.
directionAt :: Point -> Segment -> Vec
directionAt p s
  | Vec.isNear p (Segment.start s) = Segment.startDirection s
  | Vec.isNear p (Segment.end s) = Segment.endDirection s
  | otherwise = Segment.directionAt (Segment.fraction s p) s
