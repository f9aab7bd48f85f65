-- | Taylor expansions of a point that moves with a parameter: a vector of two power series, of x
-- and of y. The point is expanded about the value u₀ of the parameter. The velocity is the first
-- derivative of the point by the parameter.
module Geometry.Numeric.TaylorExpansion
  ( TaylorExpansion,
    position,
    velocity,
    speed,
    offset,
    direction,
    curvature,
    curvatureSeries,
    Approach (..),
  )
where

import Base.Quantity (Mm (..))
import Data.List (find)
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))

-- | The coordinates x and y of a point, in mm, as power series in the parameter.
type TaylorExpansion = V2 PowerSeries

-- | The direction from which a point of a curve is approached: from smaller parameters (before it),
-- or from larger ones (after it). The two give different results at a corner.
data Approach = Before | After
  deriving stock (Eq, Show, Enum, Bounded)

-- | The point at u₀.
position :: TaylorExpansion -> Point
position expansion = Vec.point x y
  where
    V2 x y = fmap PowerSeries.value expansion

-- | The velocity at u₀, in mm per unit of the parameter.
velocity :: TaylorExpansion -> Vec
velocity expansion = Vec.vec x y
  where
    V2 x y = fmap (PowerSeries.coefficient 1) expansion

-- | The speed, which is the length of the velocity, as a power series. It has one order less than
-- the expansion. The velocity at u₀ must not be 0.
speed :: TaylorExpansion -> PowerSeries
speed expansion = PowerSeries.power 0.5 (squared (fmap PowerSeries.derivative expansion))

-- | The scalar product of a vector with itself.
squared :: V2 PowerSeries -> PowerSeries
squared v = dot v v

-- | The scalar product of two vectors.
dot :: V2 PowerSeries -> V2 PowerSeries -> PowerSeries
dot v w = foldr1 PowerSeries.add (PowerSeries.multiply <$> v <*> w)

-- | The z component of the vector product of two vectors.
cross :: V2 PowerSeries -> V2 PowerSeries -> PowerSeries
cross (V2 x y) (V2 x' y') =
  PowerSeries.subtract (PowerSeries.multiply x y') (PowerSeries.multiply y x')

-- | The expansion of a moving point C, offset by the distance @d@ in mm to the left of its
-- direction of travel, or to the right when @d@ is negative. The distance may change with the
-- parameter, so it is a power series too. The offset is turned from the left normal by the angle
-- @turn@ in radians, counter-clockwise, which may change as well.
--
-- Without a turn the result is @C + d·N@ with @N = (−y′, x′)/√(x′² + y′²)@. It has one order less
-- than the expansion of C, or the order of @d@ if this is still lower. The velocity at u₀ must not
-- be 0.
offset :: Maybe PowerSeries -> PowerSeries -> TaylorExpansion -> TaylorExpansion
offset turn d expansion@(V2 x y) = case turn of
  Nothing -> V2 (PowerSeries.subtract x (left y')) (PowerSeries.add y (left x'))
  Just angle ->
    let aside = PowerSeries.multiply (PowerSeries.cosine angle)
        back = PowerSeries.multiply (PowerSeries.sine angle)
     in V2
          (PowerSeries.subtract x (PowerSeries.add (aside (left y')) (back (left x'))))
          (PowerSeries.add y (PowerSeries.subtract (aside (left x')) (back (left y'))))
  where
    velocities@(V2 x' y') = fmap PowerSeries.derivative expansion
    left = PowerSeries.multiply share
    share = PowerSeries.multiply d (PowerSeries.power (-0.5) (squared velocities))

-- | The direction of travel at u₀, of length 1. If the velocity is 0, the result is the limit of
-- the direction on the side @approach@ of u₀. This limit follows from the lowest derivative that is
-- not 0. A derivative counts as 0 if the length of its coefficient in the expansion is at most
-- 'Tolerance.stationary'. Nothing if all derivatives in the expansion count as 0.
direction :: Approach -> TaylorExpansion -> Maybe Vec
direction approach expansion = case find moves (zip [1 :: Int ..] derivatives) of
  Just (k, v) -> Just (Vec.unit (if even k && approach == Before then Vec.negate v else v))
  Nothing -> Nothing
  where
    derivatives = drop 1 (zipWith Vec.vec xs ys)
    V2 xs ys = fmap PowerSeries.coefficients expansion
    moves (_, v) = Mm (Vec.norm v) > Tolerance.stationary

-- | The curvature at u₀ in 1/mm, positive where the curve bends to the left. The order of the
-- expansion must be at least 2, and the velocity must not be 0.
curvature :: TaylorExpansion -> Double
curvature expansion = 2 * (x' * y'' - y' * x'') / (w * sqrt w)
  where
    V2 x' y' = fmap (PowerSeries.coefficient 1) expansion
    V2 x'' y'' = fmap (PowerSeries.coefficient 2) expansion
    w = x' * x' + y' * y'

-- | The curvature @(x′·y″ − y′·x″) / (x′² + y′²)^(3/2)@ as a power series, in 1/mm. It has two
-- orders less than the expansion. The velocity at u₀ must not be 0.
curvatureSeries :: TaylorExpansion -> PowerSeries
curvatureSeries expansion =
  PowerSeries.multiply
    (cross velocities accelerations)
    (PowerSeries.multiply inverseSpeed (PowerSeries.multiply inverseSpeed inverseSpeed))
  where
    velocities = fmap PowerSeries.derivative expansion
    accelerations = fmap PowerSeries.derivative velocities
    inverseSpeed = PowerSeries.power (-0.5) (squared velocities)
