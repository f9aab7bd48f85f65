-- | Similarities of the plane: translations, rotations, reflections, scalings and their products.
module Geometry.Transformation
  ( Transformation,

    -- * Construction
    identity,
    translation,
    rotation,
    reflection,
    scaling,
    after,

    -- * Application
    factor,
    mirrors,
    point,
    line,
    circle,
    segment,
    polyarc,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Carrier (Circle (Circle), Line (Line))
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc (Polyarc (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point, Vec (Vec))
import Geometry.Vec qualified as Vec
import Linear.Matrix (M22, (!*), (!*!), (*!!))
import Linear.V2 (V2 (..))
import Linear.Vector ((^+^), (^-^))

-- | The map @p ↦ M·p + t@, where the matrix M is a multiple of an orthogonal one, and t is the
-- displacement. The scale factor and the reflection also follow from the determinant of M, but it
-- has rounding errors. Both must be exact, so they are stored.
data Transformation = Transformation
  { matrix :: M22 Double,
    -- | the vector t, in mm
    displacement :: V2 Double,
    -- | the scale factor, above 0
    factor :: Double,
    -- | True when M includes a reflection
    mirrored :: Bool
  }
  deriving stock (Eq, Show)

-- | The transformation that changes nothing.
identity :: Transformation
identity = aboutOrigin False (Rad 0) 1

-- | The translation by a vector.
translation :: Vec -> Transformation
translation v = identity {displacement = fromVec v}

-- | The rotation about a point by an angle, counter-clockwise positive.
rotation :: Rad -> Point -> Transformation
rotation a = about (aboutOrigin False a 1)

-- | The reflection in a line.
reflection :: Line -> Transformation
reflection axis = about (aboutOrigin True (Rad (2 * direction)) 1) (Carrier.from axis)
  where
    Rad direction = Vec.angle (Carrier.direction axis)

-- | The scaling by the positive factor @k@ that leaves the given point in its position.
scaling :: Double -> Point -> Transformation
scaling k = about (aboutOrigin False (Rad 0) k)

-- | The product of up to three transformations: first a reflection in the x axis if @mirrored@ is
-- true, then a rotation about the origin by @a@ radians, then a scaling by @factor@.
aboutOrigin :: Bool -> Rad -> Double -> Transformation
aboutOrigin mirrored (Rad a) factor =
  Transformation {matrix = factor *!! orthogonal, displacement = V2 0 0, factor, mirrored}
  where
    (c, s) = (cos a, sin a)
    orthogonal
      | mirrored = V2 (V2 c s) (V2 s (-c))
      | otherwise = V2 (V2 c (-s)) (V2 s c)

-- | The transformation that has the matrix of @t@ and leaves the point @p@ in its position.
about :: Transformation -> Point -> Transformation
about t p = t {displacement = fromPoint p ^-^ (matrix t !* fromPoint p)}

-- | The transformation that applies @a@ first and then @b@.
after :: Transformation -> Transformation -> Transformation
after b a =
  Transformation
    { matrix = matrix b !*! matrix a,
      displacement = apply b (displacement a),
      factor = factor b * factor a,
      mirrored = mirrored b /= mirrored a
    }

-- | True when the transformation includes a reflection, which exchanges left and right.
mirrors :: Transformation -> Bool
mirrors = mirrored

-- | The image of a position, given as a vector from the origin in mm.
apply :: Transformation -> V2 Double -> V2 Double
apply t v = (matrix t !* v) ^+^ displacement t

-- | The vector from the origin to a point.
fromPoint :: Point -> V2 Double
fromPoint p = V2 (Vec.x p) (Vec.y p)

-- | A vector of "Geometry.Vec" as one of the library @linear@.
fromVec :: Vec -> V2 Double
fromVec (Vec x y) = V2 x y

-- | The image of a point.
point :: Transformation -> Point -> Point
point t p = Vec.point (a * Vec.x p + b * Vec.y p + dx) (c * Vec.x p + d * Vec.y p + dy)
  where
    V2 (V2 a b) (V2 c d) = matrix t
    V2 dx dy = displacement t

-- | The image of a line. It leads from the image of the line's first point to that of the second.
line :: Transformation -> Line -> Line
line t (Line p q) = Line (point t p) (point t q)

-- | The image of a circle.
circle :: Transformation -> Circle -> Circle
circle t (Circle c (Mm r)) = Circle (point t c) (Mm (factor t * r))

-- | The image of a segment. A reflection reverses the sense of an arc.
segment :: Transformation -> Segment -> Segment
segment t s = case s of
  Straight a b -> Straight (point t a) (point t b)
  Arc {start, end, centre, sweep = Rad sweep} ->
    Arc
      { start = point t start,
        end = point t end,
        centre = point t centre,
        sweep = Rad (if mirrored t then -sweep else sweep)
      }

-- | The image of a polyarc.
polyarc :: Transformation -> Polyarc -> Polyarc
polyarc t (Polyarc ends segments) = Polyarc ends (fmap (segment t) segments)
