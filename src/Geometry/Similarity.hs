-- | Similarities of the plane: motions, mirrors, scalings, and what comes of several of them.
module Geometry.Similarity
  ( Similarity,
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
import Geometry.Contour (Contour (..))
import Geometry.Segment (Segment (..))
import Geometry.Shape (Circle (Circle), Line (Line))
import Geometry.Shape qualified as Shape
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | @p ↦ k·R·M·p + t@: a mirror in the x axis or none, a rotation, a factor above zero, a displacement.
data Similarity = Similarity {mirrored :: Bool, turned :: Rad, factor :: Double, displaced :: Vec}
  deriving stock (Eq, Show)

identity :: Similarity
identity = Similarity False (Rad 0) 1 (Vec.vec 0 0)

translation :: Vec -> Similarity
translation v = identity {displaced = v}

-- | Counter-clockwise about a point.
rotation :: Rad -> Point -> Similarity
rotation a = about identity {turned = a}

-- | In a line.
reflection :: Line -> Similarity
reflection axis = about identity {mirrored = True, turned = Rad (2 * direction)} (Shape.from axis)
  where
    Rad direction = Vec.angle (Shape.direction axis)

-- | By a factor above zero, a point staying where it is.
scaling :: Double -> Point -> Similarity
scaling k = about identity {factor = k}

-- | A similarity that leaves a point where it is.
about :: Similarity -> Point -> Similarity
about s p = s {displaced = Vec.to (point s p) p}

-- | The first one behind the second.
after :: Similarity -> Similarity -> Similarity
after b a =
  Similarity
    { mirrored = mirrored a /= mirrored b,
      turned = Rad (if mirrored b then angleB - angleA else angleB + angleA),
      factor = factor a * factor b,
      displaced = Vec.add (vector b (displaced a)) (displaced b)
    }
  where
    Rad angleA = turned a
    Rad angleB = turned b

-- | Whether left becomes right.
mirrors :: Similarity -> Bool
mirrors = mirrored

vector :: Similarity -> Vec -> Vec
vector s v = Vec.scale (factor s) (Vec.rotate (turned s) (if mirrored s then flipped v else v))
  where
    flipped u = Vec.vec (Vec.dot u (Vec.vec 1 0)) (-Vec.dot u (Vec.vec 0 1))

point :: Similarity -> Point -> Point
point s p = Vec.shift (displaced s) (Vec.shift (vector s (Vec.to origin p)) origin)
  where
    origin = Vec.point 0 0

line :: Similarity -> Line -> Line
line s (Line p q) = Line (point s p) (point s q)

circle :: Similarity -> Circle -> Circle
circle s (Circle c (Mm r)) = Circle (point s c) (Mm (factor s * r))

-- | A mirrored arc changes its sense.
segment :: Similarity -> Segment -> Segment
segment s g = case g of
  Straight a b -> Straight (point s a) (point s b)
  Arc {start, end, centre, sweep = Rad sweep} ->
    Arc {start = point s start, end = point s end, centre = point s centre, sweep = Rad (if mirrored s then -sweep else sweep)}

contour :: Similarity -> Contour -> Contour
contour s (Contour ends segments) = Contour ends (fmap (segment s) segments)
