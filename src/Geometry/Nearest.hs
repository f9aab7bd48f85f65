-- | Things by their boxes in flat arrays: a box for each, for each eight of them, for each eight of those, and so on. The
-- order in which they are given is the order of a contour or of a walk, and that is a good order in space: nothing is sorted.
module Geometry.Nearest
  ( Nearest,
    index,
    within,
    select,
    closest,
    toList,
  )
where

import Base.Quantity (Mm (..), minus)
import Control.Monad (forM_)
import Control.Monad.Primitive (PrimMonad, PrimState)
import Data.List (foldl')
import Data.Primitive.PrimArray (MutablePrimArray, PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Box (Box (..))
import Geometry.Box qualified as Box
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)

-- | The things in order; four numbers for each box: left, bottom, right, top.
data Nearest a = Nearest {things :: Vector a, levels :: [PrimArray Double]}

-- | So many boxes have one about them.
fan :: Int
fan = 8

-- | Build an index, in a time that grows with the number of things.
index :: (a -> Box) -> [a] -> Nearest a
index box list = Nearest {things, levels = reverse (grow lowest)}
  where
    things = Vector.fromList list
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
  forM_ [0 .. higher - 1] (\i -> put numbers i (about (fan * i + 1) (min (count level) (fan * (i + 1))) (boxAt level (fan * i))))
  pure numbers
  where
    about k end b
      | k >= end = b
      | otherwise = about (k + 1) end (Box.union b (boxAt level k))

put :: PrimMonad m => MutablePrimArray (PrimState m) Double -> Int -> Box -> m ()
put numbers i (Box l b r t) = do
  PrimArray.writePrimArray numbers (4 * i) l
  PrimArray.writePrimArray numbers (4 * i + 1) b
  PrimArray.writePrimArray numbers (4 * i + 2) r
  PrimArray.writePrimArray numbers (4 * i + 3) t
{-# INLINE put #-}

boxAt :: PrimArray Double -> Int -> Box
boxAt level i = Box (at 0) (at 1) (at 2) (at 3)
  where
    at j = PrimArray.indexPrimArray level (4 * i + j)
{-# INLINE boxAt #-}

-- | All things whose boxes meet a box, in order.
within :: Box -> Nearest a -> [a]
within (Box l b r t) = select (\(Box l' b' r' t') -> l' <= r && l <= r' && b' <= t && b <= t')
{-# INLINE within #-}

-- | All things for whose boxes something holds, in order. It holds for a box that holds one for which it does.
select :: (Box -> Bool) -> Nearest a -> [a]
select holds n = case levels n of
  [] -> []
  top : below -> go top below 0 (count top - 1) []
  where
    -- Those of a level from one down to another, before the rest: nothing is put off.
    go level below begin i rest
      | i < begin = rest
      | holds (boxAt level i) = case below of
        [] -> go level below begin (i - 1) (Vector.unsafeIndex (things n) i : rest)
        next : lower -> go level below begin (i - 1) (go next lower (fan * i) (min (count next) (fan * (i + 1)) - 1) rest)
      | otherwise = go level below begin (i - 1) rest
{-# INLINE select #-}

-- | The thing nearest to a point; of several the first. Its distance is that of its box or more, but for 'Tolerance.coincident':
-- distances of lines, arcs and boxes are computed in different ways, and each is rounded.
closest :: (a -> Mm) -> Point -> Nearest a -> Maybe (Mm, a)
closest distanceTo p n = case levels n of
  [] -> Nothing
  top : below -> go top below 0 (count top) Nothing
    where
      -- Among those of a level from one up to another, if better than the best so far. No more is looked at than has to be:
      -- first comes what is behind the nearest box.
      bound0 = guess top below 0 (count top)
      go level below' i end best
        | i >= end = best
        | away level i > maybe bound0 fst best = go level below' (i + 1) end best
        | otherwise = case below' of
          [] -> let a = Vector.unsafeIndex (things n) i in go level below' (i + 1) end (better a (distanceTo a) best)
          next : lower -> go level below' (i + 1) end (go next lower (fan * i) (min (count next) (fan * (i + 1))) best)
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
      nearestBox level i end = fst (foldl' (\(k, d) j -> let e = away level j in if e < d then (j, e) else (k, d)) (i, away level i) [i + 1 .. end - 1])
      away level i = minus (Box.distance p (boxAt level i)) Tolerance.coincident

-- | All things in order.
toList :: Nearest a -> [a]
toList = Vector.toList . things
