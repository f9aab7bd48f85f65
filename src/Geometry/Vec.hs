-- | Points and vectors of the plane, in millimetres.
--
-- A point is a place, a vector a displacement; only the differences of points are
-- vectors. The components come from @linear@.
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
import Linear.Metric qualified as Linear
import Linear.V2 (V2 (..))
import Linear.V2 qualified as Linear (crossZ, perp)
import Linear.Vector qualified as Linear ((*^), (^+^), (^-^))
import Prelude hiding (negate)

-- | A place; components in mm.
newtype Point = Point (V2 Double)
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | A displacement; components in mm, or without a dimension for a direction.
newtype Vec = Vec (V2 Double)
  deriving newtype (Eq, Ord)
  deriving stock (Show)

point :: Double -> Double -> Point
point px py = Point (V2 px py)

vec :: Double -> Double -> Vec
vec vx vy = Vec (V2 vx vy)

x :: Point -> Double
x (Point (V2 px _)) = px

y :: Point -> Double
y (Point (V2 _ py)) = py

-- | The displacement from one point to another.
to :: Point -> Point -> Vec
to (Point a) (Point b) = Vec (b Linear.^-^ a)

-- | A point displaced.
shift :: Vec -> Point -> Point
shift (Vec v) (Point p) = Point (p Linear.^+^ v)

add :: Vec -> Vec -> Vec
add (Vec a) (Vec b) = Vec (a Linear.^+^ b)

scale :: Double -> Vec -> Vec
scale k (Vec a) = Vec (k Linear.*^ a)

negate :: Vec -> Vec
negate = scale (-1)

dot :: Vec -> Vec -> Double
dot (Vec a) (Vec b) = Linear.dot a b

-- | Positive when the second vector points to the left of the first.
cross :: Vec -> Vec -> Double
cross (Vec a) (Vec b) = Linear.crossZ a b

norm :: Vec -> Double
norm (Vec a) = Linear.norm a

-- | The direction of a vector that is not zero.
unit :: Vec -> Vec
unit v = scale (1 / norm v) v

-- | The vector turned by 90° counter-clockwise.
left :: Vec -> Vec
left (Vec a) = Vec (Linear.perp a)

-- | The vector turned counter-clockwise.
rotate :: Rad -> Vec -> Vec
rotate (Rad a) v = add (scale (cos a) v) (scale (sin a) (left v))

-- | The vector of a length in a direction, the angle counter-clockwise from the x axis.
polar :: Mm -> Rad -> Vec
polar (Mm r) (Rad a) = vec (r * cos a) (r * sin a)

-- | The direction of a vector, in (−π, π].
angle :: Vec -> Rad
angle (Vec (V2 vx vy)) = Rad (atan2 vy vx)

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
written decimals p = "(" <> Decimal.short decimals (x p) <> ", " <> Decimal.short decimals (y p) <> ")"
