-- | Binary search in sorted vectors, and bisection of predicates on lengths.
module Base.BinarySearch
  ( lastBelow,
    turningPoint,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Data.Vector.Unboxed (Unbox, Vector)
import Data.Vector.Unboxed qualified as Vector

-- | The index of the last of the first @count@ elements that is at most a value; 0 when all of them
-- are above it. The elements rise, and @count@ is at least 1. Binary search.
lastBelow :: (Unbox a, Ord a) => Int -> a -> Vector a -> Int
lastBelow count v sorted = search 0 count
  where
    -- The index is at least low and below high.
    search low high
      | high - low <= 1 = low
      | sorted Vector.! middle <= v = search middle high
      | otherwise = search low middle
      where
        middle = (low + high) `div` 2
{-# INLINE lastBelow #-}

-- | Bisects a predicate that is true at @low@ and false at @high@. Yields two such lengths that
-- differ by at most the resolution.
turningPoint :: Mm -> (Mm -> Bool) -> Mm -> Mm -> (Mm, Mm)
turningPoint resolution holds low high
  | minus high low <= resolution = (low, high)
  | holds middle = turningPoint resolution holds middle high
  | otherwise = turningPoint resolution holds low middle
  where
    middle = times 0.5 (plus low high)
