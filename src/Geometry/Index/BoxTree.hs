{-# OPTIONS_GHC -O2 #-}

-- | Things by their boxes in flat arrays: a box for each, for each eight of them, for each eight of
-- those, and so on. The order in which they are given is the order of a contour or of a walk, and
-- that is a good order in space as a rule: nothing is sorted unless it is asked for.
module Geometry.Index.BoxTree
  ( BoxTree,
    index,
    indexOf,
    byPlace,
    within,
    each,
    select,
    closest,
    toList,
    foldl',
    size,
  )
where

import Base.Quantity (Mm (..), minus)
import Control.Monad (forM_)
import Control.Monad.Primitive (PrimMonad, PrimState)
import Data.List (sortOn)
import Data.List qualified as List
import Data.Primitive.PrimArray (MutablePrimArray, PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)

-- | The things in order; four numbers for each box: left, bottom, right, top.
data BoxTree a = BoxTree
  { things :: Vector a,
    -- | the boxes of the things
    lowest :: PrimArray Double,
    -- | all levels, the highest one first
    levels :: [PrimArray Double]
  }

-- | So many boxes have one about them.
fan :: Int
fan = 8

-- | Build an index, in a time that grows with the number of things.
index :: (a -> BoundingBox) -> [a] -> BoxTree a
index box list = indexed box (Vector.fromList list)

-- | The same, where it is known how many they are: their array is made at once instead of growing.
-- Of more things the first ones count.
indexOf :: Int -> (a -> BoundingBox) -> [a] -> BoxTree a
indexOf most box list = indexed box (Vector.fromListN most list)

-- | The same for things whose order is none in space, such as the rounds of a pocket, each of which
-- lies about the next: sorted by the middles of their boxes, in columns of as many things as a
-- column is wide in boxes. The time has a logarithm more.
byPlace :: (a -> BoundingBox) -> [a] -> BoxTree a
byPlace box list =
  index box (concatMap (sortOn (middleY . box)) (columns (sortOn (middleX . box) list)))
  where
    columns things = case splitAt (fan * perColumn) things of
      (column, []) -> [column]
      (column, rest) -> column : columns rest
    perColumn = max 1 (ceiling (sqrt (fromIntegral (length list) / fromIntegral fan :: Double)))
    middleX (BoundingBox l _ r _) = l + r
    middleY (BoundingBox _ b _ t) = b + t

indexed :: (a -> BoundingBox) -> Vector a -> BoxTree a
indexed box things = BoxTree {things, lowest, levels = reverse (grow lowest)}
  where
    lowest = PrimArray.runPrimArray $ do
      numbers <- PrimArray.newPrimArray (4 * Vector.length things)
      Vector.iforM_ things (\i a -> put numbers i (box a))
      pure numbers
    grow level
      | count level <= 1 = [level]
      | otherwise = level : grow (above level)

-- | How many boxes a level has.
count :: PrimArray Double -> Int
count level = PrimArray.sizeofPrimArray level `quot` 4

-- | The boxes about those of a level.
above :: PrimArray Double -> PrimArray Double
above level = PrimArray.runPrimArray $ do
  let higher = (count level + fan - 1) `quot` fan
  numbers <- PrimArray.newPrimArray (4 * higher)
  forM_
    [0 .. higher - 1]
    ( \i ->
        put
          numbers
          i
          (about (fan * i + 1) (min (count level) (fan * (i + 1))) (boxAt level (fan * i)))
    )
  pure numbers
  where
    about k end b
      | k >= end = b
      | otherwise = about (k + 1) end (BoundingBox.union b (boxAt level k))

put :: PrimMonad m => MutablePrimArray (PrimState m) Double -> Int -> BoundingBox -> m ()
put numbers i (BoundingBox l b r t) = do
  PrimArray.writePrimArray numbers (4 * i) l
  PrimArray.writePrimArray numbers (4 * i + 1) b
  PrimArray.writePrimArray numbers (4 * i + 2) r
  PrimArray.writePrimArray numbers (4 * i + 3) t
{-# INLINE put #-}

boxAt :: PrimArray Double -> Int -> BoundingBox
boxAt level i = BoundingBox (at 0) (at 1) (at 2) (at 3)
  where
    at j = PrimArray.indexPrimArray level (4 * i + j)
{-# INLINE boxAt #-}

-- | All things whose boxes meet a box, in order.
within :: BoundingBox -> BoxTree a -> [a]
within (BoundingBox l b r t) =
  select (\(BoundingBox l' b' r' t') -> l' <= r && l <= r' && b' <= t && b <= t')
{-# INLINE within #-}

-- | For each of some others, by its box, all things whose boxes meet that and for which something
-- holds of both, in order. Others that lie beside one another are asked for together: the boxes of
-- a few things are looked at one by one.
each :: (b -> BoundingBox) -> (b -> a -> Bool) -> BoxTree a -> [b] -> [[a]]
each boxOf holds n = start
  where
    start others = case others of
      [] -> []
      b : rest -> let box = boxOf b in gather (1 :: Int) (sizeOf box) box [box] [b] rest
    -- So many lie within a box, the last one first; the smallest has so much size.
    gather known least all' boxes found rest = case rest of
      b : more
        | known < together,
          box <- boxOf b,
          both <- BoundingBox.union all' box,
          smaller <- min least (sizeOf box),
          sizeOf both <= widest * smaller ->
          gather (known + 1) smaller both (box : boxes) (b : found) more
      _ ->
        let ranks =
              ranksWithin all' n
         in answer
              ( if null (drop fewAtMost ranks)
                  then \box b ->
                    among box b ranks
                  else \box b -> filter (holds b) (within box n)
              )
              boxes
              found
              (start rest)
    answer ask boxes found behind = case (boxes, found) of
      (box : boxes', b : found') ->
        let a =
              ask box b
         in a `seq` answer ask boxes' found' (a : behind)
      _ -> behind
    among box b ranks = case ranks of
      [] -> []
      i : more
        | BoundingBox.meets box (boxAt (lowest n) i),
          a <- Vector.unsafeIndex (things n) i,
          holds b a ->
          let as =
                among box b more
           in as `seq` (a : as)
        | otherwise -> among box b more
    sizeOf (BoundingBox l b r t) = (r - l) + (t - b)
{-# INLINE each #-}

-- | So many boxes are asked for together, if the box about them is no larger than so many times
-- each.
together :: Int
together = 8

widest :: Double
widest = 8

-- | No more than so many things are looked at one by one.
fewAtMost :: Int
fewAtMost = 128

-- | The places of all things whose boxes meet a box, in order.
ranksWithin :: BoundingBox -> BoxTree a -> [Int]
ranksWithin (BoundingBox l b r t) =
  selectRanks (\(BoundingBox l' b' r' t') -> l' <= r && l <= r' && b' <= t && b <= t')

-- | All things for whose boxes something holds, in order. It holds for a box that holds one for
-- which it does.
select :: (BoundingBox -> Bool) -> BoxTree a -> [a]
select holds n = selectWith (Vector.unsafeIndex (things n)) holds n
{-# INLINE select #-}

selectRanks :: (BoundingBox -> Bool) -> BoxTree a -> [Int]
selectRanks = selectWith id
{-# INLINE selectRanks #-}

-- | What is made of the places of those things.
selectWith :: (Int -> b) -> (BoundingBox -> Bool) -> BoxTree a -> [b]
selectWith make holds n = case levels n of
  [] -> []
  top : below -> go top below 0 (count top - 1) []
  where
    -- Those of a level from one down to another, before the rest: nothing is put off.
    go level below begin i rest
      | i < begin = rest
      | holds (boxAt level i) = case below of
        [] -> go level below begin (i - 1) (make i : rest)
        next : lower ->
          go
            level
            below
            begin
            (i - 1)
            (go next lower (fan * i) (min (count next) (fan * (i + 1)) - 1) rest)
      | otherwise = go level below begin (i - 1) rest
{-# INLINE selectWith #-}

-- | The thing nearest to a point; of several the first. Its distance is that of its box or more,
-- but for 'Tolerance.coincident': distances of lines, arcs and boxes are computed in different
-- ways, and each is rounded.
closest :: (a -> Mm) -> Point -> BoxTree a -> Maybe (Mm, a)
closest distanceTo p n = case levels n of
  [] -> Nothing
  top : below -> go top below 0 (count top) Nothing
    where
      -- Among those of a level from one up to another, if better than the best so far. No more is
      -- looked at than has to be: first comes what is behind the nearest box.
      bound0 = guess top below 0 (count top)
      go level below' i end best
        | i >= end = best
        | away level i > maybe bound0 fst best = go level below' (i + 1) end best
        | otherwise = case below' of
          [] ->
            let a =
                  Vector.unsafeIndex (things n) i
             in go level below' (i + 1) end (better a (distanceTo a) best)
          next : lower ->
            go
              level
              below'
              (i + 1)
              end
              (go next lower (fan * i) (min (count next) (fan * (i + 1))) best)
      better a d best = case best of
        Nothing -> if d <= bound0 then Just (d, a) else Nothing
        Just (e, _) -> if d < e then Just (d, a) else best
      guess level below' i end
        | i >= end = Mm (1 / 0)
        | otherwise =
          let k = nearestBox level i end
           in case below' of
                [] -> distanceTo (Vector.unsafeIndex (things n) k)
                next : lower -> guess next lower (fan * k) (min (count next) (fan * (k + 1)))
      nearestBox level i end =
        fst
          ( List.foldl'
              (\(k, d) j -> let e = away level j in if e < d then (j, e) else (k, d))
              (i, away level i)
              [i + 1 .. end - 1]
          )
      away level i = minus (BoundingBox.distance p (boxAt level i)) Tolerance.coincident

-- | All things in order.
toList :: BoxTree a -> [a]
toList = Vector.toList . things

-- | All things in order, one after the other; there is no list of them.
foldl' :: (b -> a -> b) -> b -> BoxTree a -> b
foldl' with b = Vector.foldl' with b . things
{-# INLINE foldl' #-}

-- | How many there are.
size :: BoxTree a -> Int
size = Vector.length . things
