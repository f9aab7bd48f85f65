-- | A point that moves with a parameter, near one place of it: a power series for each coordinate.
module Geometry.Numeric.TaylorExpansion
  ( TaylorExpansion (..),
    place,
    velocity,
    speed,
    moved,
    direction,
    curvature,
    bending,
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

-- | The coordinates, in mm, by the parameter.
data TaylorExpansion = TaylorExpansion {across :: PowerSeries, up :: PowerSeries}
  deriving stock (Eq, Show)

-- | From which side a place on a curve is reached: at a corner that makes a difference.
data Approach = Before | After
  deriving stock (Eq, Show, Enum, Bounded)

-- | The point itself.
place :: TaylorExpansion -> Point
place (TaylorExpansion a b) = Vec.point (PowerSeries.value a) (PowerSeries.value b)

-- | The first derivative of the place, in mm for 1 of the parameter.
velocity :: TaylorExpansion -> Vec
velocity (TaylorExpansion a b) = Vec.vec (PowerSeries.coefficient 1 a) (PowerSeries.coefficient 1 b)

-- | The length of the velocity, one order less. The point does not stand still.
speed :: TaylorExpansion -> PowerSeries
speed jet = PowerSeries.power 0.5 (squaredSpeed jet)

squaredSpeed :: TaylorExpansion -> PowerSeries
squaredSpeed (TaylorExpansion a b) =
  PowerSeries.add (PowerSeries.multiply a' a') (PowerSeries.multiply b' b')
  where
    a' = PowerSeries.derivative a
    b' = PowerSeries.derivative b

-- | The point moved along the left normal by a distance (mm, to the right when negative), one order
-- less:
-- @P = C + d·N@, @N = (−y′, x′)/√(x′² + y′²)@. The point does not stand still.
moved :: PowerSeries -> TaylorExpansion -> TaylorExpansion
moved d (TaylorExpansion a b) =
  TaylorExpansion
    (PowerSeries.subtract a (PowerSeries.multiply e b'))
    (PowerSeries.add b (PowerSeries.multiply e a'))
  where
    a' = PowerSeries.derivative a
    b' = PowerSeries.derivative b
    e =
      PowerSeries.multiply
        d
        ( PowerSeries.power
            (-0.5)
            (PowerSeries.add (PowerSeries.multiply a' a') (PowerSeries.multiply b' b'))
        )

-- | The direction of the motion, of length 1. Where the point stands still it is the limit from the
-- side asked for, by the first derivative that does not vanish.
direction :: Approach -> TaylorExpansion -> Maybe Vec
direction approach (TaylorExpansion a b) = case find moves (zip [1 :: Int ..] derivatives) of
  Just (k, v) -> Just (Vec.unit (if even k && approach == Before then Vec.negate v else v))
  Nothing -> Nothing
  where
    derivatives = drop 1 (zipWith Vec.vec (PowerSeries.coefficients a) (PowerSeries.coefficients b))
    moves (_, v) = Mm (Vec.norm v) > Tolerance.still

-- | The curvature, in 1/mm, positive when the way bends to the left. The order is at least 2.
curvature :: TaylorExpansion -> Double
curvature (TaylorExpansion a b) =
  2 * (a1 * PowerSeries.coefficient 2 b - b1 * PowerSeries.coefficient 2 a) / (w * sqrt w)
  where
    a1 = PowerSeries.coefficient 1 a
    b1 = PowerSeries.coefficient 1 b
    w = a1 * a1 + b1 * b1

-- | The curvature as a series, two orders less: @(x′·y″ − y′·x″) / (x′² + y′²)^(3/2)@.
bending :: TaylorExpansion -> PowerSeries
bending jet@(TaylorExpansion a b) =
  PowerSeries.multiply turning (PowerSeries.multiply slow (PowerSeries.multiply slow slow))
  where
    a' = PowerSeries.derivative a
    b' = PowerSeries.derivative b
    turning =
      PowerSeries.subtract
        (PowerSeries.multiply a' (PowerSeries.derivative b'))
        (PowerSeries.multiply b' (PowerSeries.derivative a'))
    slow = PowerSeries.power (-0.5) (squaredSpeed jet)
