-- | Pseudo-random numbers, the same on every machine: the finaliser of splitmix64 (Steele, Lea,
-- Flood 2014) of a seed and an index.
module Noise
  ( bits,
    uniform,
  )
where

import Data.Bits (shiftR, xor)
import Data.Word (Word64)

-- | 64 bits of the stream of a seed, by the index from 0.
bits :: Word64 -> Word64 -> Word64
bits seed index = z2 `xor` (z2 `shiftR` 31)
  where
    z0 = seed * 0x9E3779B97F4A7C15 + (index + 1) * 0xD1342543DE82EF95
    z1 = (z0 `xor` (z0 `shiftR` 30)) * 0xBF58476D1CE4E5B9
    z2 = (z1 `xor` (z1 `shiftR` 27)) * 0x94D049BB133111EB

-- | A number from 0, below 1.
uniform :: Word64 -> Word64 -> Double
uniform seed index = fromIntegral (bits seed index `shiftR` 11) / 9007199254740992
