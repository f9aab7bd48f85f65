-- | Binary search in sorted vectors, and bisection of predicates on lengths.
module Base.BinarySearch
  ( lastAtMost,
    bisect,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Data.Vector.Unboxed (Unbox, Vector)
import Data.Vector.Unboxed qualified as Vector

-- | The index of the last of the first @count@ elements that is at most a value; 0 when all of them
-- are above it. The elements rise, and @count@ is at least 1. Binary search.
lastAtMost :: (Unbox a, Ord a) => Int -> a -> Vector a -> Int
lastAtMost count v sorted = search 0 count
  where
    -- The index is at least low and below high.
    search low high
      | high - low <= 1 = low
      | sorted Vector.! middle <= v = search middle high
      | otherwise = search low middle
      where
        middle = (low + high) `div` 2
{-# INLINE lastAtMost #-}

-- | Bisects a predicate that is true at @low@ and false at @high@. Yields two such lengths that
-- differ by at most the resolution.
bisect :: Mm -> (Mm -> Bool) -> Mm -> Mm -> (Mm, Mm)
bisect resolution holds low high
  | minus high low <= resolution = (low, high)
  | holds middle = bisect resolution holds middle high
  | otherwise = bisect resolution holds low middle
  where
    middle = times 0.5 (plus low high)
