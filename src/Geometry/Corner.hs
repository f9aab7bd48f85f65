-- | Corners of a contour: the angle by which it turns there, and the side on which a point lies.
--
-- At a cusp the contour turns back: its direction changes by half a turn. There the tangents do not
-- show to which side it turns. The elements at the cusp are therefore compared at some distance
-- from the vertex.
module Geometry.Corner
  ( isCusp,
    turning,
    leftwardness,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | True when the direction changes by half a turn, to 'Tolerance.cuspAngle', between two segments
-- that meet.
isCusp :: Segment -> Segment -> Bool
isCusp before after =
  Vec.isNear (Segment.end before) (Segment.start after)
    && Vec.dot v w < 0
    && Rad (abs (Vec.cross v w)) <= Tolerance.cuspAngle
  where
    v = Segment.endDirection before
    w = Segment.startDirection after

-- | The angle in radians by which the direction changes between two segments that meet,
-- counter-clockwise positive. At a cusp its sign shows on which side of the first segment the
-- second one lies, 'Tolerance.cuspDepth' away from the vertex.
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

-- | The signed distance in mm of the point @p@ from a contour: positive on the left of the
-- direction of travel. @foot@ is the point of the contour that is nearest to @p@; @segments@
-- contains all segments of the contour on which @foot@ lies. If @foot@ is a corner, the result is
-- the sum of the signed distances from the tangents of both segments; then only its sign has a
-- meaning. At a cusp the sign is opposite to that of 'turning', because @p@ lies outside of the
-- wedge between both segments.
leftwardness :: [Segment] -> Point -> Point -> Double
leftwardness segments foot p = case filter isTouching segments of
  [a, b]
    | Vec.distance foot (Segment.end a) < Vec.distance foot (Segment.end b),
      isCusp a b ->
      besideCusp a b
    | isCusp b a -> besideCusp b a
  touching -> sum (map crossProduct touching)
  where
    isTouching s = Distance.toPoint foot s <= Tolerance.coincident
    besideCusp before after = let Rad angle = turning before after in -angle
    crossProduct s = Vec.cross (directionAt foot s) (Vec.to foot p)

-- | The curvature of a segment in 1/mm, positive for a counter-clockwise arc.
curvature :: Segment -> Double
curvature segment = case segment of
  Straight _ _ -> 0
  Arc {start, centre, sweep = Rad sweep} ->
    let Mm radius = Segment.radius centre start in signum sweep / radius

-- | The direction of travel on a segment at its point @p@.
directionAt :: Point -> Segment -> Vec
directionAt p s
  | Vec.isNear p (Segment.start s) = Segment.startDirection s
  | Vec.isNear p (Segment.end s) = Segment.endDirection s
  | otherwise = Segment.directionAt (Segment.fraction s p) s
