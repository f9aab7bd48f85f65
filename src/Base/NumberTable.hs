-- | Tables of numbers, with the region of the source text of every row. They are kept in flat
-- arrays, since a table from a file may have a hundred thousand rows.
module Base.NumberTable
  ( NumberTable (..),
    fromList,
    count,
    regionOf,
    cell,
    cells,
    concatenated,
    selectColumns,
    mapPairs,
    selectRows,
  )
where

import Base.Region (Region (Region))
import Control.Monad.ST (runST)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray

-- | A table whose rows have @width@ numbers each. @numbers@ contains the rows one after the other.
-- @places@ contains two offsets for each row: the start and the end of its region. They are offsets
-- in the source of a program, as in "Base.Region".
data NumberTable = NumberTable {width :: Int, places :: PrimArray Int, numbers :: PrimArray Double}
  deriving stock (Eq, Show)

-- | Makes a table of rows of equal length, each given by its region and its numbers.
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

-- | The count of the rows of a table.
count :: NumberTable -> Int
count rows = PrimArray.sizeofPrimArray (places rows) `quot` 2

-- | The region of a row, by the row's index from 0.
regionOf :: NumberTable -> Int -> Region
regionOf rows k =
  Region
    (PrimArray.indexPrimArray (places rows) (2 * k))
    (PrimArray.indexPrimArray (places rows) (2 * k + 1))

-- | The number at the index of a row and the index of a column, both from 0.
cell :: NumberTable -> Int -> Int -> Double
cell rows k i = PrimArray.indexPrimArray (numbers rows) (k * width rows + i)
{-# INLINE cell #-}

-- | The numbers of a row, by the row's index from 0.
cells :: NumberTable -> Int -> [Double]
cells rows k = map (cell rows k) [0 .. width rows - 1]

-- | Concatenates the rows of tables that all have the given width.
concatenated :: Int -> [NumberTable] -> NumberTable
concatenated width parts = case parts of
  [one] -> one
  _ ->
    NumberTable {width, places = mconcat (map places parts), numbers = mconcat (map numbers parts)}

-- | Makes a table of some columns of @rows@, in the order of the list @columns@. The list contains
-- the index of each column, from 0, and a factor by which its numbers are multiplied.
selectColumns :: [(Int, Double)] -> NumberTable -> NumberTable
selectColumns columns rows =
  rows {width = wide, numbers = PrimArray.generatePrimArray (wide * count rows) number}
  where
    wide = length columns
    sources = PrimArray.primArrayFromListN wide (map fst columns)
    factors = PrimArray.primArrayFromListN wide (map snd columns)
    number n = case n `quotRem` wide of
      (k, i) ->
        cell rows k (PrimArray.indexPrimArray sources i) * PrimArray.indexPrimArray factors i

-- | Applies a function to the first two numbers of each row. The table has at least two columns.
mapPairs :: (Double -> Double -> (Double, Double)) -> NumberTable -> NumberTable
mapPairs f rows =
  rows {numbers = PrimArray.generatePrimArray (width rows * count rows) number}
  where
    number n = case n `quotRem` width rows of
      (k, 0) -> fst (pair k)
      (k, 1) -> snd (pair k)
      (k, i) -> cell rows k i
    pair k = f (cell rows k 0) (cell rows k 1)

-- | Makes a table of some rows, given by their indices from 0, in the order of the list.
selectRows :: [Int] -> NumberTable -> NumberTable
selectRows ks rows = selected {width = width rows}
  where
    selected = fromList [(regionOf rows k, PrimArray.primArrayFromList (cells rows k)) | k <- ks]
