-- | A point that moves with a parameter, near one place of it: a power series for each coordinate.
module Geometry.Jet
  ( Jet (..),
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
import Geometry.Series (Series)
import Geometry.Series qualified as Series
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | The coordinates, in mm, by the parameter.
data Jet = Jet {across :: Series, up :: Series}
  deriving stock (Eq, Show)

-- | From which side a place on a curve is reached: at a corner that makes a difference.
data Approach = Before | After
  deriving stock (Eq, Show, Enum, Bounded)

-- | The point itself.
place :: Jet -> Point
place (Jet a b) = Vec.point (Series.value a) (Series.value b)

-- | The first derivative of the place, in mm for 1 of the parameter.
velocity :: Jet -> Vec
velocity (Jet a b) = Vec.vec (Series.coefficient 1 a) (Series.coefficient 1 b)

-- | The length of the velocity, one order less. The point does not stand still.
speed :: Jet -> Series
speed jet = Series.power 0.5 (squaredSpeed jet)

squaredSpeed :: Jet -> Series
squaredSpeed (Jet a b) = Series.add (Series.multiply a' a') (Series.multiply b' b')
  where
    a' = Series.derivative a
    b' = Series.derivative b

-- | The point moved along the left normal by a distance (mm, to the right when negative), one order less:
-- @P = C + d·N@, @N = (−y′, x′)/√(x′² + y′²)@. The point does not stand still.
moved :: Series -> Jet -> Jet
moved d (Jet a b) = Jet (Series.subtract a (Series.multiply e b')) (Series.add b (Series.multiply e a'))
  where
    a' = Series.derivative a
    b' = Series.derivative b
    e = Series.multiply d (Series.power (-0.5) (Series.add (Series.multiply a' a') (Series.multiply b' b')))

-- | The direction of the motion, of length 1. Where the point stands still it is the limit from the side asked for,
-- by the first derivative that does not vanish.
direction :: Approach -> Jet -> Maybe Vec
direction approach (Jet a b) = case find moves (zip [1 :: Int ..] derivatives) of
  Just (k, v) -> Just (Vec.unit (if even k && approach == Before then Vec.negate v else v))
  Nothing -> Nothing
  where
    derivatives = drop 1 (zipWith Vec.vec (Series.coefficients a) (Series.coefficients b))
    moves (_, v) = Mm (Vec.norm v) > Tolerance.still

-- | The curvature, in 1/mm, positive when the way bends to the left. The order is at least 2.
curvature :: Jet -> Double
curvature (Jet a b) = 2 * (a1 * Series.coefficient 2 b - b1 * Series.coefficient 2 a) / (w * sqrt w)
  where
    a1 = Series.coefficient 1 a
    b1 = Series.coefficient 1 b
    w = a1 * a1 + b1 * b1

-- | The curvature as a series, two orders less: @(x′·y″ − y′·x″) / (x′² + y′²)^(3/2)@.
bending :: Jet -> Series
bending jet@(Jet a b) = Series.multiply turning (Series.multiply slow (Series.multiply slow slow))
  where
    a' = Series.derivative a
    b' = Series.derivative b
    turning = Series.subtract (Series.multiply a' (Series.derivative b')) (Series.multiply b' (Series.derivative a'))
    slow = Series.power (-0.5) (squaredSpeed jet)
