-- | Binary search in sorted vectors, and bisection of predicates on lengths.
module Base.BinarySearch
  ( lastAtMost,
    bisect,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Data.Vector.Unboxed (Unbox, Vector)
import Data.Vector.Unboxed qualified as Vector

-- | Binary search among the first @count@ elements of the vector @sorted@, which is in ascending
-- order. Yields the index, from 0, of the last element that is at most @v@, or 0 when every element
-- is larger. @count@ is at least 1.
lastAtMost :: (Unbox a, Ord a) => Int -> a -> Vector a -> Int
lastAtMost count v sorted = search 0 count
  where
    -- The wanted index is at least @low@ and less than @high@.
    search low high
      | high - low <= 1 = low
      | sorted Vector.! middle <= v = search middle high
      | otherwise = search low middle
      where
        middle = (low + high) `div` 2
{-# INLINE lastAtMost #-}

-- | Bisects the predicate @holds@, which is true at @low@ and false at the larger length @high@.
-- Yields two lengths between them, the smaller one first, that differ by at most @resolution@. The
-- predicate is true at the first and false at the second.
bisect :: Mm -> (Mm -> Bool) -> Mm -> Mm -> (Mm, Mm)
bisect resolution holds low high
  | minus high low <= resolution = (low, high)
  | holds middle = bisect resolution holds middle high
  | otherwise = bisect resolution holds low middle
  where
    middle = times 0.5 (plus low high)
