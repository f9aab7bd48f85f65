-- | Points and vectors of the plane, in millimetres, and their operations.
--
-- A point is a position and a vector a displacement; only differences of points are vectors. Both
-- are flat records of two doubles, not @V2 Double@ of the library @linear@: a program has millions
-- of them, and a flat record is unpacked into the data that contains it (docs/dependencies.md has
-- the figures). Vectors of other element types or of three components are those of @linear@.
module Geometry.Vec
  ( Point (..),
    Vec (..),
    point,
    vec,
    x,
    y,
    to,
    shift,
    add,
    scale,
    negate,
    dot,
    cross,
    norm,
    unit,
    left,
    rotate,
    polar,
    angle,
    signedAngle,
    distance,
    interpolate,
    isNear,
    toText,
    toExactText,
    coordinates,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad (..), millimetresIn)
import Data.Text (Text)
import Geometry.Tolerance qualified as Tolerance
import Prelude hiding (negate)
import Prelude qualified

-- | A position; coordinates in mm.
data Point = Point Double Double
  deriving stock (Eq, Ord, Show)

-- | A displacement; components in mm, or without a dimension for a direction.
data Vec = Vec Double Double
  deriving stock (Eq, Ord, Show)

-- | The point with the given x and y, in mm.
point :: Double -> Double -> Point
point = Point

-- | The vector with the given components along the x axis and the y axis.
vec :: Double -> Double -> Vec
vec = Vec

-- | The first coordinate of a point, in mm.
x :: Point -> Double
x (Point px _) = px

-- | The second coordinate of a point, in mm.
y :: Point -> Double
y (Point _ py) = py

-- | The displacement from one point to another.
to :: Point -> Point -> Vec
to (Point ax ay) (Point bx by) = Vec (bx - ax) (by - ay)

-- | The point that lies at a displacement from a given point.
shift :: Vec -> Point -> Point
shift (Vec vx vy) (Point px py) = Point (px + vx) (py + vy)

-- | The sum of two vectors.
add :: Vec -> Vec -> Vec
add (Vec ax ay) (Vec bx by) = Vec (ax + bx) (ay + by)

-- | The product of the number @k@ and a vector.
scale :: Double -> Vec -> Vec
scale k (Vec ax ay) = Vec (k * ax) (k * ay)

-- | The vector of the same length in the opposite direction.
negate :: Vec -> Vec
negate = scale (-1)

-- | The scalar product, in mm² for two displacements.
dot :: Vec -> Vec -> Double
dot (Vec ax ay) (Vec bx by) = ax * bx + ay * by

-- | The z component of the vector product, in mm² for two displacements. It is positive when the
-- second vector points to the left of the first.
cross :: Vec -> Vec -> Double
cross (Vec ax ay) (Vec bx by) = ax * by - ay * bx

-- | The length of a vector, in mm for a displacement.
norm :: Vec -> Double
norm v = sqrt (dot v v)

-- | The vector of length 1 in the direction of a vector. For the zero vector the components are
-- NaN.
unit :: Vec -> Vec
unit v = scale (1 / norm v) v

-- | The vector rotated by 90° counter-clockwise: the left normal, of the same length.
left :: Vec -> Vec
left (Vec ax ay) = Vec (Prelude.negate ay) ax

-- | The vector rotated by an angle, counter-clockwise when the angle is positive.
rotate :: Rad -> Vec -> Vec
rotate (Rad a) v = add (scale (cos a) v) (scale (sin a) (left v))

-- | The vector with a given length and a given angle from the x axis, counter-clockwise positive.
polar :: Mm -> Rad -> Vec
polar (Mm r) (Rad a) = vec (r * cos a) (r * sin a)

-- | The angle of a vector from the x axis, in [−π, π].
angle :: Vec -> Rad
angle (Vec vx vy) = Rad (atan2 vy vx)

-- | The angle from the direction of the vector @a@ to that of @b@, in [−π, π], counter-clockwise
-- positive.
signedAngle :: Vec -> Vec -> Rad
signedAngle a b = Rad (atan2 (cross a b) (dot a b))

-- | The distance between two points.
distance :: Point -> Point -> Mm
distance a b = Mm (norm (to a b))

-- | The point at the fraction @t@ of the line from @a@ to @b@: @a@ for 0, @b@ for 1.
interpolate :: Double -> Point -> Point -> Point
interpolate t a b = shift (scale t (to a b)) a

-- | True when two points are no further apart than 'Tolerance.coincident'.
isNear :: Point -> Point -> Bool
isNear a b = distance a b <= Tolerance.coincident

-- | A point in the notation of a part program whose lengths are in a unit: with at most @decimals@
-- digits after each decimal point in mm, and one more in inches.
toText :: LengthUnit -> Int -> Point -> Text
toText inUnit decimals p = "(" <> coordinate (x p) <> ", " <> coordinate (y p) <> ")"
  where
    coordinate = Decimal.shortIn inUnit decimals . Mm

-- | A point in the notation of a part program whose lengths are in a unit, with all decimals.
toExactText :: LengthUnit -> Point -> Text
toExactText inUnit p = "(" <> coordinates inUnit p <> ")"

-- | The coordinates of a point with all decimals, separated by a comma.
coordinates :: LengthUnit -> Point -> Text
coordinates inUnit p = coordinate (x p) <> ", " <> coordinate (y p)
  where
    coordinate c = Decimal.exact (c / millimetresIn inUnit)
