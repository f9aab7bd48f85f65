-- | Columns of a drawing over time. Each column covers the same count of ticks and keeps the least,
-- the mean and the highest value of every kind of sample, so a run of any length needs little
-- memory.
--
-- At first a column is one tick wide. When the columns are used up, each pair of neighbours becomes
-- one column. So the run is read only once, although its length is not known at the beginning.
module Draw.TimeColumn
  ( TimeColumns,
    empty,
    add,
    width,
    origin,
    finish,
    Band (..),
    mean,
    bands,
    frameStarts,
  )
where

import Control.Applicative ((<|>))
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.List (foldl')
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, mapMaybe)
import Pulse.ControllerRun (Tick)
import Pulse.RunSample (RunSample (..), SampleKind (..))

-- | All columns.
data TimeColumns = TimeColumns
  { -- | largest count of columns
    most :: Int,
    -- | ticks of one column
    width :: Int,
    -- | first tick; Nothing before the first sample
    firstTick :: Maybe Tick,
    -- | last tick of all samples
    lastTick :: Tick,
    columns :: IntMap TimeColumn
  }

-- | One column: the tick and the number of the first frame that begins in it, and the band of each
-- kind of sample.
data TimeColumn = TimeColumn (Maybe (Tick, Int)) (Map SampleKind Band)

-- | Values of one kind in a column: the least, the highest, the sum of value times ticks, and the
-- ticks.
data Band = Band {least :: Double, highest :: Double, weighted :: Double, ticks :: Tick}
  deriving stock (Eq, Show)

-- | Mean of a band.
mean :: Band -> Double
mean b = max (least b) (min (highest b) (weighted b / fromIntegral (max 1 (ticks b))))

-- | No columns yet, and later at most the given count, which is even.
empty :: Int -> TimeColumns
empty n = TimeColumns n 1 Nothing 0 IntMap.empty

-- | First tick; 0 without samples.
origin :: TimeColumns -> Tick
origin = fromMaybe 0 . firstTick

-- | Last tick of all samples.
finish :: TimeColumns -> Tick
finish = lastTick

-- | Columns with one more sample. No sample begins before the first one.
add :: RunSample -> TimeColumns -> TimeColumns
add s c
  | lastIndex >= most c = add s (widened c')
  | kind s == FrameNumber =
    c' {columns = IntMap.insertWith earlier (indexOf (from s)) (TimeColumn begins Map.empty) old}
  | to s <= from s = c'
  | otherwise = c' {columns = foldl' put old [indexOf (from s) .. lastIndex]}
  where
    c' = c {firstTick = Just start, lastTick = max (lastTick c) (to s)}
    old = columns c
    start = fromMaybe (from s) (firstTick c)
    indexOf t = (t - start) `quot` width c
    lastIndex = indexOf (max (from s) (to s - 1))
    begins = Just (from s, round (value s))
    put known i =
      let a = max (from s) (start + i * width c)
          b = min (to s) (start + (i + 1) * width c)
          band = Band (value s) (value s) (value s * fromIntegral (b - a)) (b - a)
       in IntMap.insertWith earlier i (TimeColumn Nothing (Map.singleton (kind s) band)) known
    -- The arguments of insertWith are the new and the old column.
    earlier new known = joined known new

-- | Columns of twice the width.
widened :: TimeColumns -> TimeColumns
widened c =
  c
    { width = 2 * width c,
      columns =
        IntMap.fromAscListWith
          (\later earlier -> joined earlier later)
          [(i `quot` 2, column) | (i, column) <- IntMap.toAscList (columns c)]
    }

-- | Column of two columns, of which the first is the earlier one.
joined :: TimeColumn -> TimeColumn -> TimeColumn
joined (TimeColumn f a) (TimeColumn g b) =
  TimeColumn (f <|> g) (Map.unionWith together a b)
  where
    together (Band l h s t) (Band l' h' s' t') = Band (min l l') (max h h') (s + s') (t + t')

-- | Bands of one kind, with the first tick of each column, in order.
bands :: SampleKind -> TimeColumns -> [(Tick, Band)]
bands k c = mapMaybe found (IntMap.toAscList (columns c))
  where
    found (i, TimeColumn _ values) = (,) (origin c + i * width c) <$> Map.lookup k values

-- | Ticks and numbers of the frames that begin, in order; of several in one column, the first.
frameStarts :: TimeColumns -> [(Tick, Int)]
frameStarts c = mapMaybe (\(TimeColumn f _) -> f) (IntMap.elems (columns c))
