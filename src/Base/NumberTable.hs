-- | Rows of numbers, each with its place in the source, in flat arrays: tables from files have a
-- hundred thousand of them.
module Base.NumberTable
  ( NumberTable (..),
    fromList,
    count,
    place,
    cell,
    cells,
    joined,
    arranged,
    selectRows,
  )
where

import Base.Region (Region (Region))
import Control.Monad.ST (runST)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray

-- | Rows of so many numbers, one row behind the other. A place is the offsets of its beginning and
-- its end.
data NumberTable = NumberTable {width :: Int, places :: PrimArray Int, numbers :: PrimArray Double}
  deriving stock (Eq, Show)

-- | Rows with their places, all of them equally long.
fromList :: [(Region, PrimArray Double)] -> NumberTable
fromList rows = runST $ do
  ends <- PrimArray.newPrimArray (2 * n)
  found <- PrimArray.newPrimArray (width * n)
  let fill k rest = case rest of
        [] -> pure ()
        (Region from to, xs) : more -> do
          PrimArray.writePrimArray ends (2 * k) from
          PrimArray.writePrimArray ends (2 * k + 1) to
          PrimArray.copyPrimArray found (width * k) xs 0 width
          fill (k + 1 :: Int) more
  fill 0 rows
  NumberTable width
    <$> PrimArray.unsafeFreezePrimArray ends <*> PrimArray.unsafeFreezePrimArray found
  where
    n = length rows
    width = case rows of
      (_, first) : _ -> PrimArray.sizeofPrimArray first
      [] -> 0

-- | How many rows there are.
count :: NumberTable -> Int
count rows = PrimArray.sizeofPrimArray (places rows) `quot` 2

-- | Where a row stands, by its number from 0.
place :: NumberTable -> Int -> Region
place rows k =
  Region
    (PrimArray.indexPrimArray (places rows) (2 * k))
    (PrimArray.indexPrimArray (places rows) (2 * k + 1))

-- | A number, by those of its row and its column, both from 0.
cell :: NumberTable -> Int -> Int -> Double
cell rows k i = PrimArray.indexPrimArray (numbers rows) (k * width rows + i)
{-# INLINE cell #-}

-- | The numbers of a row, by its number from 0.
cells :: NumberTable -> Int -> [Double]
cells rows k = map (cell rows k) [0 .. width rows - 1]

-- | Rows of so many numbers one behind the other.
joined :: Int -> [NumberTable] -> NumberTable
joined width parts = case parts of
  [one] -> one
  _ ->
    NumberTable {width, places = mconcat (map places parts), numbers = mconcat (map numbers parts)}

-- | Columns by their numbers from 0, each times a factor.
arranged :: [(Int, Double)] -> NumberTable -> NumberTable
arranged columns rows =
  rows {width = wide, numbers = PrimArray.generatePrimArray (wide * count rows) number}
  where
    wide = length columns
    sources = PrimArray.primArrayFromListN wide (map fst columns)
    factors = PrimArray.primArrayFromListN wide (map snd columns)
    number n = case n `quotRem` wide of
      (k, i) ->
        cell rows k (PrimArray.indexPrimArray sources i) * PrimArray.indexPrimArray factors i

-- | Some of the rows, by their numbers from 0.
selectRows :: [Int] -> NumberTable -> NumberTable
selectRows ks rows =
  (fromList [(place rows k, PrimArray.primArrayFromList (cells rows k)) | k <- ks])
    { width =
        width rows
    }
