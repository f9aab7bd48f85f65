-- | Vectors of whole pulses along the axes of the part: positions and increments of a cutter. A
-- pulse is one step of an axis of the machine.
--
-- Sums, products and all other operations work on each component separately.
module Base.PulseVector
  ( Pulses2 (..),
    Pulses3 (..),
    xy,
  )
where

import Base.Quantity (Pulses (..))

-- | A vector of pulses in the plane: its components x and y.
data Pulses2 = Pulses2 Pulses Pulses
  deriving stock (Eq, Show)

-- | A vector of pulses in space: its components x, y and z.
data Pulses3 = Pulses3 Pulses Pulses Pulses
  deriving stock (Eq, Show)

instance Num Pulses2 where
  Pulses2 a b + Pulses2 c d = Pulses2 (a + c) (b + d)
  Pulses2 a b - Pulses2 c d = Pulses2 (a - c) (b - d)
  Pulses2 a b * Pulses2 c d = Pulses2 (a * c) (b * d)
  negate (Pulses2 a b) = Pulses2 (negate a) (negate b)
  abs (Pulses2 a b) = Pulses2 (abs a) (abs b)
  signum (Pulses2 a b) = Pulses2 (signum a) (signum b)
  fromInteger n = let a = fromInteger n in Pulses2 a a

instance Num Pulses3 where
  Pulses3 a b c + Pulses3 d e f = Pulses3 (a + d) (b + e) (c + f)
  Pulses3 a b c - Pulses3 d e f = Pulses3 (a - d) (b - e) (c - f)
  Pulses3 a b c * Pulses3 d e f = Pulses3 (a * d) (b * e) (c * f)
  negate (Pulses3 a b c) = Pulses3 (negate a) (negate b) (negate c)
  abs (Pulses3 a b c) = Pulses3 (abs a) (abs b) (abs c)
  signum (Pulses3 a b c) = Pulses3 (signum a) (signum b) (signum c)
  fromInteger n = let a = fromInteger n in Pulses3 a a a

-- | The components x and y of a vector of pulses in space.
xy :: Pulses3 -> Pulses2
xy (Pulses3 x y _) = Pulses2 x y
