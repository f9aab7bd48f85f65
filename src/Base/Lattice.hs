-- | Places and ways in whole pulses, along the axes of the part: the lattice on which a cutter stands.
module Base.Lattice
  ( V2 (..),
    V3 (..),
    flat,
  )
where

import Base.Quantity (Pulses (..))

-- | In the plane.
data V2 = V2 Pulses Pulses
  deriving stock (Eq, Show)

-- | In space.
data V3 = V3 Pulses Pulses Pulses
  deriving stock (Eq, Show)

instance Num V2 where
  V2 a b + V2 c d = V2 (a + c) (b + d)
  V2 a b - V2 c d = V2 (a - c) (b - d)
  V2 a b * V2 c d = V2 (a * c) (b * d)
  negate (V2 a b) = V2 (negate a) (negate b)
  abs (V2 a b) = V2 (abs a) (abs b)
  signum (V2 a b) = V2 (signum a) (signum b)
  fromInteger n = let a = fromInteger n in V2 a a

instance Num V3 where
  V3 a b c + V3 d e f = V3 (a + d) (b + e) (c + f)
  V3 a b c - V3 d e f = V3 (a - d) (b - e) (c - f)
  V3 a b c * V3 d e f = V3 (a * d) (b * e) (c * f)
  negate (V3 a b c) = V3 (negate a) (negate b) (negate c)
  abs (V3 a b c) = V3 (abs a) (abs b) (abs c)
  signum (V3 a b c) = V3 (signum a) (signum b) (signum c)
  fromInteger n = let a = fromInteger n in V3 a a a

-- | Without the height.
flat :: V3 -> V2
flat (V3 x y _) = V2 x y
