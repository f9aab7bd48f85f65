-- | Pulses that a controller emits at one tick: at most one on each axis.
--
-- The axes have the indices 0 to 4, in the order x, y, z, a, b.
module Pulse.Steps
  ( Steps,
    none,
    together,
    count,
    onAxis,
    bitPattern,
    towards,
    Pulses5 (..),
    advance,
    countEach,
    plus,
    toList,
    component,

    -- * Interpolation cycles
    Cycle (..),
  )
where

import Data.Bits (popCount, shiftL, shiftR, (.&.), (.|.))

-- | Pulses of one tick. The bit 2k is set for a pulse in the positive direction of the axis k, the
-- bit 2k + 1 for a pulse in its negative direction.
newtype Steps = Steps Int
  deriving newtype (Eq)
  deriving stock (Show)

-- | No pulse on any axis.
none :: Steps
none = Steps 0

-- | One pulse in the positive or in the negative direction of the axis with this index.
forward, backward :: Int -> Steps
forward k = Steps (1 `shiftL` (2 * k))
backward k = Steps (2 `shiftL` (2 * k))

-- | One pulse on the axis with this index in the direction of a number; none if the number is 0.
towards :: Int -> Int -> Steps
towards k n = case compare n 0 of
  LT -> backward k
  EQ -> none
  GT -> forward k

-- | Pulses of both arguments, which have no axis in common.
together :: Steps -> Steps -> Steps
together (Steps a) (Steps b) = Steps (a .|. b)

-- | Count of pulses.
count :: Steps -> Int
count (Steps a) = popCount a

-- | Bits of the pulses, as the type describes them.
bitPattern :: Steps -> Int
bitPattern (Steps a) = a

-- | Pulse on the axis with this index: 1, −1 or 0.
onAxis :: Int -> Steps -> Int
onAxis k (Steps a) = (bits .&. 1) - (bits `shiftR` 1)
  where
    bits = (a `shiftR` (2 * k)) .&. 3

-- | Counts of pulses along x, y, z, a and b: a position, or the increments of a frame.
data Pulses5 = Pulses5 Int Int Int Int Int
  deriving stock (Eq, Show)

-- | Position after pulses.
advance :: Steps -> Pulses5 -> Pulses5
advance s (Pulses5 x y z a b) =
  Pulses5 (x + onAxis 0 s) (y + onAxis 1 s) (z + onAxis 2 s) (a + onAxis 3 s) (b + onAxis 4 s)

-- | Counts of pulses on each axis, after further pulses.
countEach :: Steps -> Pulses5 -> Pulses5
countEach s (Pulses5 x y z a b) =
  Pulses5 (x + on 0) (y + on 1) (z + on 2) (a + on 3) (b + on 4)
  where
    on k = abs (onAxis k s)

-- | Sum of two vectors.
plus :: Pulses5 -> Pulses5 -> Pulses5
plus (Pulses5 x y z a b) (Pulses5 x' y' z' a' b') =
  Pulses5 (x + x') (y + y') (z + z') (a + a') (b + b')

-- | Components in the order of the axes.
toList :: Pulses5 -> [Int]
toList (Pulses5 x y z a b) = [x, y, z, a, b]

-- | Component along the axis with this index.
component :: Int -> Pulses5 -> Int
component k (Pulses5 x y z a b) = case k of
  0 -> x
  1 -> y
  2 -> z
  3 -> a
  _ -> b

-- | Result of one step of an interpolator.
data Cycle interpolator
  = -- | pulses, and the interpolator after them
    Cycle Steps interpolator
  | -- | The end is reached; no pulse is left.
    Finished
