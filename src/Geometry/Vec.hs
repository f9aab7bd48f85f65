-- | Points and vectors of the plane, in millimetres.
--
-- A point is a place, a vector a displacement; only the differences of points are
-- vectors. Both are two bare numbers: there are millions of them.
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
    turn,
    distance,
    between,
    near,
    written,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..))
import Data.Text (Text)
import Geometry.Tolerance qualified as Tolerance
import Prelude hiding (negate)
import Prelude qualified

-- | A place; components in mm.
data Point = Point Double Double
  deriving stock (Eq, Ord, Show)

-- | A displacement; components in mm, or without a dimension for a direction.
data Vec = Vec Double Double
  deriving stock (Eq, Ord, Show)

point :: Double -> Double -> Point
point = Point

vec :: Double -> Double -> Vec
vec = Vec

x :: Point -> Double
x (Point px _) = px

y :: Point -> Double
y (Point _ py) = py

-- | The displacement from one point to another.
to :: Point -> Point -> Vec
to (Point ax ay) (Point bx by) = Vec (bx - ax) (by - ay)

-- | A point displaced.
shift :: Vec -> Point -> Point
shift (Vec vx vy) (Point px py) = Point (px + vx) (py + vy)

add :: Vec -> Vec -> Vec
add (Vec ax ay) (Vec bx by) = Vec (ax + bx) (ay + by)

scale :: Double -> Vec -> Vec
scale k (Vec ax ay) = Vec (k * ax) (k * ay)

negate :: Vec -> Vec
negate = scale (-1)

dot :: Vec -> Vec -> Double
dot (Vec ax ay) (Vec bx by) = ax * bx + ay * by

-- | Positive when the second vector points to the left of the first.
cross :: Vec -> Vec -> Double
cross (Vec ax ay) (Vec bx by) = ax * by - ay * bx

norm :: Vec -> Double
norm v = sqrt (dot v v)

-- | The direction of a vector that is not zero.
unit :: Vec -> Vec
unit v = scale (1 / norm v) v

-- | The vector turned by 90° counter-clockwise.
left :: Vec -> Vec
left (Vec ax ay) = Vec (Prelude.negate ay) ax

-- | The vector turned counter-clockwise.
rotate :: Rad -> Vec -> Vec
rotate (Rad a) v = add (scale (cos a) v) (scale (sin a) (left v))

-- | The vector of a length in a direction, the angle counter-clockwise from the x axis.
polar :: Mm -> Rad -> Vec
polar (Mm r) (Rad a) = vec (r * cos a) (r * sin a)

-- | The direction of a vector, in (−π, π].
angle :: Vec -> Rad
angle (Vec vx vy) = Rad (atan2 vy vx)

-- | The angle from the first vector to the second, in (−π, π], counter-clockwise positive.
turn :: Vec -> Vec -> Rad
turn a b = Rad (atan2 (cross a b) (dot a b))

distance :: Point -> Point -> Mm
distance a b = Mm (norm (to a b))

-- | The point at a fraction of the way.
between :: Double -> Point -> Point -> Point
between t a b = shift (scale t (to a b)) a

-- | Whether two points are one point.
near :: Point -> Point -> Bool
near a b = distance a b <= Tolerance.coincident

-- | A point as a person writes it, with at most so many decimals.
written :: Int -> Point -> Text
written decimals p =
  "(" <> Decimal.short decimals (x p) <> ", " <> Decimal.short decimals (y p) <> ")"
