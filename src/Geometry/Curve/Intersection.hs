-- | Refinement of intersections of curves, lines and circles from a nearby starting point.
--
-- The starting point is an intersection of the polyarcs that approximate the curves to
-- 'Tolerance.curve'. A polyarc is a chain of lines and arcs. The foot of a point P on a curve is
-- the point at which the perpendicular from P meets the curve. Newton's method leads from the
-- starting point to the exact intersection of the curves. Each of its steps takes the feet of the
-- current point on both curves, and goes to the intersection of the tangents at these feet.
module Geometry.Curve.Intersection
  ( Foot,
    onLine,
    onCircle,
    onCurve,
    refine,
  )
where

import Base.Quantity (Mm (..), times)
import Geometry.Carrier (Circle (..), Line)
import Geometry.Carrier qualified as Carrier
import Geometry.Curve (Curve)
import Geometry.Curve qualified as Curve
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | Function that maps a point to its foot on a curve and to the unit tangent of the curve at the
-- foot.
type Foot = Point -> (Point, Vec)

-- | Foot function of a line, for its intersection with a curve.
onLine :: Line -> Foot
onLine l p = (Carrier.foot l p, Carrier.direction l)

-- | Foot function of a circle, for its intersection with a curve.
onCircle :: Circle -> Foot
onCircle (Circle c (Mm r)) p = (Vec.shift (Vec.scale r out) c, Vec.left out)
  where
    out = Vec.unit (Vec.to c p)

-- | Foot function of a curve. It takes the nearest point of the curve, which may be an end, as the
-- foot.
onCurve :: Curve -> Foot
onCurve c p = let u = Curve.nearest p c in (Curve.at c u, Curve.tangent c u)

-- | Intersection of two curves with the foot functions @footA@ and @footB@. It is near the point
-- @initial@, which is within 'Tolerance.curve' of both curves. The point is returned unchanged if
-- there is no intersection nearby, for example because a curve ends, or if the curves are nearly
-- parallel.
refine :: Foot -> Foot -> Point -> Point
refine footA footB initial = newton (8 :: Int) initial
  where
    newton remaining p
      | Vec.distance a b <= Tolerance.crossing =
        if Vec.distance initial a <= reach then a else initial
      | remaining <= 0 || abs sine < smallestSine = initial
      | otherwise =
        newton (remaining - 1) (Vec.shift (Vec.scale (Vec.cross (Vec.to a b) v / sine) u) a)
      where
        (a, u) = footA p
        (b, v) = footB p
        sine = Vec.cross u v
        -- Bound of the distance from @initial@ to the exact intersection, by the angle at which the
        -- curves meet. The factor 8 allows for their curvature.
        reach = times (8 / abs sine) Tolerance.curve
    -- Curves that meet at an angle with a smaller sine count as parallel.
    smallestSine = 1e-5
