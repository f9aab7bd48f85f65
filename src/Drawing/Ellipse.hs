-- | Ellipses from two conjugate semi-diameters.
--
-- The points @c + u·cos t + v·sin t@ lie on an ellipse with the centre c and the conjugate
-- semi-diameters u and v. An affine map of an ellipse or a circle gives one in this form.
module Drawing.Ellipse
  ( whole,
    part,
    semiDiameters,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Drawing.Drawing (Ellipse (..), PathPart (..), Shape (..))
import Drawing.Tolerance qualified as Tolerance
import Geometry.Carrier (Circle (Circle))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | The whole ellipse with a centre and two conjugate semi-diameters; a circle if both axes are
-- equal.
whole :: Point -> Vec -> Vec -> Shape
whole c u v
  | isRound axes = FullCircle (Circle c (major (ellipse axes)))
  | otherwise = FullEllipse (ellipse axes)
  where
    axes = principal c u v

-- | The part of the ellipse from one parameter t to another; an arc if both axes are equal.
part :: Point -> Vec -> Vec -> Double -> Double -> PathPart
part c u v from to
  | isRound axes =
    Plain Arc {start = at from, end = at to, centre = c, sweep = Rad (turn * (to - from))}
  | otherwise = EllipseArc (ellipse axes) (turn * (from - phase)) (turn * (to - phase))
  where
    axes@Axes {phase, turn} = principal c u v
    at t = Vec.shift (Vec.add (Vec.scale (cos t) u) (Vec.scale (sin t) v)) c

-- | The semi-axes of an ellipse as vectors: the larger one, and the smaller one a quarter turn
-- counter-clockwise from it. They are its semi-diameters for the parameters of
-- 'Drawing.Drawing.ellipsePoint'.
semiDiameters :: Ellipse -> (Vec, Vec)
semiDiameters Ellipse {major = Mm a, minor = Mm b, direction} =
  (Vec.rotate direction (Vec.vec a 0), Vec.rotate direction (Vec.vec 0 b))

-- | An ellipse, and how its parameter follows from t: @turn·(t − phase)@, with a turn of 1 or −1.
data Axes = Axes {ellipse :: Ellipse, phase :: Double, turn :: Double}

isRound :: Axes -> Bool
isRound Axes {ellipse = Ellipse {major = Mm a, minor = Mm b}} = a - b <= Tolerance.sameAxes * a

-- | The principal axes from conjugate semi-diameters. The derivative of the distance from the
-- centre is 0 at the parameter t with @tan 2t = 2·u·v \/ (u·u − v·v)@. The product of the semi-axes
-- is the vector product of u and v.
principal :: Point -> Vec -> Vec -> Axes
principal c u v =
  Axes
    { ellipse =
        Ellipse
          { middle = c,
            major = Mm larger,
            minor = Mm (if larger > 0 then min larger (abs area / larger) else 0),
            direction = Vec.angle axis
          },
      phase,
      turn = if area < 0 then -1 else 1
    }
  where
    phase = atan2 (2 * Vec.dot u v) (Vec.dot u u - Vec.dot v v) / 2
    axis = Vec.add (Vec.scale (cos phase) u) (Vec.scale (sin phase) v)
    larger = Vec.norm axis
    area = Vec.cross u v
