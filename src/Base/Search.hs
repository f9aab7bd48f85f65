-- | Looking up in sorted numbers.
module Base.Search
  ( lastBelow,
  )
where

import Data.Vector.Unboxed (Unbox, Vector)
import Data.Vector.Unboxed qualified as Vector

-- | The number of the last of the first so many, in rising order, that is not above a value; 0 when all are above it. The time
-- grows with the logarithm of their number, which is one at least.
lastBelow :: (Unbox a, Ord a) => Int -> a -> Vector a -> Int
lastBelow count v sorted = search 0 count
  where
    -- What is sought is low or behind it, and before high.
    search low high
      | high - low <= 1 = low
      | sorted Vector.! middle <= v = search middle high
      | otherwise = search low middle
      where
        middle = (low + high) `div` 2
{-# INLINE lastBelow #-}
