-- | Looking up in sorted numbers, and for where something ceases to hold.
module Base.BinarySearch
  ( lastBelow,
    turningPoint,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Data.Vector.Unboxed (Unbox, Vector)
import Data.Vector.Unboxed qualified as Vector

-- | The number of the last of the first so many, in rising order, that is not above a value; 0 when
-- all are above it. The time grows with the logarithm of their number, which is one at least.
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

-- | Between a length for which something holds and a larger one for which it does not, two such
-- lengths that are no further apart than a resolution.
turningPoint :: Mm -> (Mm -> Bool) -> Mm -> Mm -> (Mm, Mm)
turningPoint resolution holds low high
  | minus high low <= resolution = (low, high)
  | holds middle = turningPoint resolution holds middle high
  | otherwise = turningPoint resolution holds low middle
  where
    middle = times 0.5 (plus low high)
