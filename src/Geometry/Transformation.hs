-- | Similarities of the plane: motions, mirrors, scalings, and what comes of several of them.
module Geometry.Transformation
  ( Transformation,
    identity,
    translation,
    rotation,
    reflection,
    scaling,
    after,
    mirrors,
    point,
    line,
    circle,
    segment,
    contour,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Carrier (Circle (Circle), Line (Line))
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc (Polyarc (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | @p ↦ k·R·M·p + t@: a mirror in the x axis or none, a rotation, a factor above zero, a
-- displacement.
data Transformation = Transformation
  { mirrored :: Bool,
    turned :: Rad,
    factor :: Double,
    displaced :: Vec
  }
  deriving stock (Eq, Show)

identity :: Transformation
identity = Transformation False (Rad 0) 1 (Vec.vec 0 0)

translation :: Vec -> Transformation
translation v = identity {displaced = v}

-- | Counter-clockwise about a point.
rotation :: Rad -> Point -> Transformation
rotation a = about identity {turned = a}

-- | In a line.
reflection :: Line -> Transformation
reflection axis = about identity {mirrored = True, turned = Rad (2 * direction)} (Carrier.from axis)
  where
    Rad direction = Vec.angle (Carrier.direction axis)

-- | By a factor above zero, a point staying where it is.
scaling :: Double -> Point -> Transformation
scaling k = about identity {factor = k}

-- | A similarity that leaves a point where it is.
about :: Transformation -> Point -> Transformation
about s p = s {displaced = Vec.to (point s p) p}

-- | The first one behind the second.
after :: Transformation -> Transformation -> Transformation
after b a =
  Transformation
    { mirrored = mirrored a /= mirrored b,
      turned = Rad (if mirrored b then angleB - angleA else angleB + angleA),
      factor = factor a * factor b,
      displaced = Vec.add (vector b (displaced a)) (displaced b)
    }
  where
    Rad angleA = turned a
    Rad angleB = turned b

-- | Whether left becomes right.
mirrors :: Transformation -> Bool
mirrors = mirrored

vector :: Transformation -> Vec -> Vec
vector s v = Vec.scale (factor s) (Vec.rotate (turned s) (if mirrored s then flipped v else v))
  where
    flipped u = Vec.vec (Vec.dot u (Vec.vec 1 0)) (-Vec.dot u (Vec.vec 0 1))

point :: Transformation -> Point -> Point
point s p = Vec.shift (displaced s) (Vec.shift (vector s (Vec.to origin p)) origin)
  where
    origin = Vec.point 0 0

line :: Transformation -> Line -> Line
line s (Line p q) = Line (point s p) (point s q)

circle :: Transformation -> Circle -> Circle
circle s (Circle c (Mm r)) = Circle (point s c) (Mm (factor s * r))

-- | A mirrored arc changes its sense.
segment :: Transformation -> Segment -> Segment
segment s g = case g of
  Straight a b -> Straight (point s a) (point s b)
  Arc {start, end, centre, sweep = Rad sweep} ->
    Arc
      { start = point s start,
        end = point s end,
        centre = point s centre,
        sweep = Rad (if mirrored s then -sweep else sweep)
      }

contour :: Transformation -> Polyarc -> Polyarc
contour s (Polyarc ends segments) = Polyarc ends (fmap (segment s) segments)
