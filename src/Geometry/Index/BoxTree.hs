{-# OPTIONS_GHC -O2 #-}

-- | A bounding-box tree: an index of things by their bounding boxes.
--
-- It is a packed R-tree in flat arrays. One array, the lowest level, contains the boxes of the
-- things. The next level has a box around each eight of these, and so on up to a single box. The
-- things usually come in the order of a contour or toolpath, where neighbours are close in space.
-- So they are not sorted, except by 'sortedIndex'.
--
-- This is the tree for things of any type. "Geometry.Index.SegmentBoxTree" is the one for the
-- segments of 'Geometry.ClosedPolyarcs.ClosedPolyarcs'. That tree computes the boxes of single
-- segments when they are needed. It skips consecutive segments that all advance in one direction,
-- since such segments do not meet except at their joints.
--
-- Things and the boxes of a level have indices from 0. Two boxes meet when they have a point in
-- common.
module Geometry.Index.BoxTree
  ( BoxTree,

    -- * Construction
    index,
    indexFirst,
    sortedIndex,

    -- * Contents
    toList,
    foldl',
    size,
    boundingBox,

    -- * Queries
    within,
    each,
    select,
    closest,
    leastBy,
    closestPair,
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

-- | Things in order, and the levels of boxes. A level has four numbers for each box, in mm: left,
-- bottom, right, top.
data BoxTree a = BoxTree
  { things :: Vector a,
    -- | the level of the things' own boxes
    lowest :: PrimArray Double,
    -- | all levels, the highest first
    levels :: [PrimArray Double]
  }

-- | The number of boxes that one box of the next higher level contains.
fan :: Int
fan = 8

-- Construction ------------------------------------------------------------------------------

-- | Build a tree of the things in a list; @box@ gives the box of each. The time is linear in the
-- number of things.
index :: (a -> BoundingBox) -> [a] -> BoxTree a
index box list = indexed box (Vector.fromList list)

-- | Build a tree of the first @count@ things of a list; @box@ gives the box of each. It is faster
-- than 'index', because the array is allocated once.
indexFirst :: Int -> (a -> BoundingBox) -> [a] -> BoxTree a
indexFirst count box list = indexed box (Vector.fromListN count list)

-- | Build a tree of things whose neighbours in the list are not close in space. An example is the
-- loops of a pocket, each of which surrounds the next. The things are sorted by sort-tile-recursive
-- packing: they are sorted by x of their boxes' middles and divided into columns, and each column
-- is sorted by y. For n things there are about @√(n/8)@ columns. Each has about @√(n/8)@ groups of
-- eight things. The time is proportional to @n·log n@.
sortedIndex :: (a -> BoundingBox) -> [a] -> BoxTree a
sortedIndex box list =
  index box (concatMap (sortOn (middleY . box)) (columns (sortOn (middleX . box) list)))
  where
    columns things = case splitAt (fan * perColumn) things of
      (column, []) -> [column]
      (column, rest) -> column : columns rest
    perColumn = max 1 (ceiling (sqrt (fromIntegral (length list) / fromIntegral fan :: Double)))
    middleX (BoundingBox l _ r _) = l + r
    middleY (BoundingBox _ b _ t) = b + t

-- | Build a tree of a vector of things; @box@ gives the box of each.
indexed :: (a -> BoundingBox) -> Vector a -> BoxTree a
indexed box things = BoxTree {things, lowest, levels = reverse (grow lowest)}
  where
    lowest = PrimArray.runPrimArray $ do
      numbers <- PrimArray.newPrimArray (4 * Vector.length things)
      Vector.iforM_ things (\i a -> put numbers i (box a))
      pure numbers
    grow level
      | boxCount level <= 1 = [level]
      | otherwise = level : grow (above level)

-- | The number of boxes of a level.
boxCount :: PrimArray Double -> Int
boxCount level = PrimArray.sizeofPrimArray level `quot` 4

-- | The next higher level: a box around each eight boxes of a level.
above :: PrimArray Double -> PrimArray Double
above level = PrimArray.runPrimArray $ do
  numbers <- PrimArray.newPrimArray (4 * higher)
  forM_ [0 .. higher - 1] (\i -> put numbers i (boxAbove i))
  pure numbers
  where
    higher = (boxCount level + fan - 1) `quot` fan
    boxAbove i = unions (fan * i + 1) (childrenEnd level i) (boxAt level (fan * i))
    unions k end b
      | k >= end = b
      | otherwise = unions (k + 1) end (BoundingBox.union b (boxAt level k))

-- | The index after the last box of @level@ that lies in box @i@ of the next higher level. The
-- first box that lies in it has the index @fan·i@.
childrenEnd :: PrimArray Double -> Int -> Int
childrenEnd level i = min (boxCount level) (fan * (i + 1))
{-# INLINE childrenEnd #-}

-- | Write a box at the index @i@ of a level that is being built.
put :: PrimMonad m => MutablePrimArray (PrimState m) Double -> Int -> BoundingBox -> m ()
put numbers i (BoundingBox l b r t) = do
  PrimArray.writePrimArray numbers (4 * i) l
  PrimArray.writePrimArray numbers (4 * i + 1) b
  PrimArray.writePrimArray numbers (4 * i + 2) r
  PrimArray.writePrimArray numbers (4 * i + 3) t
{-# INLINE put #-}

-- | The box of @level@ with the index @i@.
boxAt :: PrimArray Double -> Int -> BoundingBox
boxAt level i = BoundingBox (at 0) (at 1) (at 2) (at 3)
  where
    at j = PrimArray.indexPrimArray level (4 * i + j)
{-# INLINE boxAt #-}

-- Contents ----------------------------------------------------------------------------------

-- | All things of a tree in order.
toList :: BoxTree a -> [a]
toList = Vector.toList . things

-- | A strict left fold over all things of a tree in order, with the function @with@ and the initial
-- value @b@.
foldl' :: (b -> a -> b) -> b -> BoxTree a -> b
foldl' with b = Vector.foldl' with b . things
{-# INLINE foldl' #-}

-- | The number of things in a tree.
size :: BoxTree a -> Int
size = Vector.length . things

-- | The box around all things of a tree. The box of an empty tree is inverted, so that it meets no
-- other box.
boundingBox :: BoxTree a -> BoundingBox
boundingBox tree = case levels tree of
  top : _ | boxCount top > 0 -> boxAt top 0
  _ -> BoundingBox (1 / 0) (1 / 0) (-1 / 0) (-1 / 0)

-- | The thing with the index @i@.
thing :: BoxTree a -> Int -> a
thing tree = Vector.unsafeIndex (things tree)
{-# INLINE thing #-}

-- Boxes that meet a box ---------------------------------------------------------------------

-- | All things whose boxes meet a box, in order.
within :: BoundingBox -> BoxTree a -> [a]
within (BoundingBox l b r t) =
  select (\(BoundingBox l' b' r' t') -> l' <= r && l <= r' && b' <= t && b <= t')
{-# INLINE within #-}

-- | All things whose boxes satisfy the predicate @holds@, in order. If a box satisfies it, so must
-- every box that contains this box: the search skips the contents of a box that does not satisfy
-- it.
select :: (BoundingBox -> Bool) -> BoxTree a -> [a]
select holds tree = selectWith (thing tree) holds tree
{-# INLINE select #-}

-- | The indices of all things whose boxes meet a box, in order.
indicesWithin :: BoundingBox -> BoxTree a -> [Int]
indicesWithin (BoundingBox l b r t) =
  selectWith id (\(BoundingBox l' b' r' t') -> l' <= r && l <= r' && b' <= t && b <= t')

-- | The values of @make@ for the indices of all things whose boxes satisfy the predicate @holds@,
-- in order.
selectWith :: (Int -> b) -> (BoundingBox -> Bool) -> BoxTree a -> [b]
selectWith make holds tree = case levels tree of
  [] -> []
  top : below -> go top below 0 (boxCount top - 1) []
  where
    -- Puts the results for the boxes of @level@ from @i@ down to @first@ in front of @rest@. The
    -- search inside a box of a higher level waits until the list is read as far as its results.
    go level below first i rest
      | i < first = rest
      | holds (boxAt level i) = case below of
        [] -> go level below first (i - 1) (make i : rest)
        next : lower ->
          let found = go next lower (fan * i) (childrenEnd next i - 1) rest
           in go level below first (i - 1) found
      | otherwise = go level below first (i - 1) rest
{-# INLINE selectWith #-}

-- Many boxes at once ------------------------------------------------------------------------

-- | Finds, for each element b of a list, all things whose boxes meet the box @boxOf b@ and which
-- satisfy the predicate @holds b@. The results are in the order of the list; the things of each are
-- in the order of the tree.
--
-- Consecutive elements whose boxes are close form a group, which shares one descent of the tree.
-- The descent finds the things that meet the box around the whole group. These things are then
-- tested for each element of the group. If there are more than 'groupLimit' of them, the tree is
-- searched for each element instead.
each :: (b -> BoundingBox) -> (b -> a -> Bool) -> BoxTree a -> [b] -> [[a]]
each boxOf holds tree = start
  where
    start others = case others of
      [] -> []
      b : rest -> let box = boxOf b in gather (1 :: Int) (halfPerimeter box) box [box] [b] rest
    -- Extends a group of @count@ elements. @boxes@ and @members@ are their boxes and the elements,
    -- both in reverse order. @whole@ is the box around all of @boxes@, and @least@ the least half
    -- perimeter of one of @boxes@.
    gather count least whole boxes members rest = case rest of
      b : more
        | count < groupSize,
          box <- boxOf b,
          both <- BoundingBox.union whole box,
          smaller <- min least (halfPerimeter box),
          halfPerimeter both <= groupExtent * smaller ->
          gather (count + 1) smaller both (box : boxes) (b : members) more
      _ -> answers (query (indicesWithin whole tree)) boxes members (start rest)
    query indices
      | null (drop groupLimit indices) = \box b -> among tree (holds b) box indices
      | otherwise = \box b -> filter (holds b) (within box tree)
{-# INLINE each #-}

-- | The results of @query@ for the elements of a group, in order, and then the results @rest@ for
-- the elements after the group. @members@ are the elements of the group and @boxes@ their boxes,
-- both in reverse order.
answers :: (BoundingBox -> b -> [a]) -> [BoundingBox] -> [b] -> [[a]] -> [[a]]
answers query boxes members rest = case (boxes, members) of
  (box : boxes', b : members') ->
    let found = query box b in found `seq` answers query boxes' members' (found : rest)
  _ -> rest
{-# INLINEABLE answers #-}

-- | The things with the given indices, in order, that satisfy @holds@ and whose boxes meet @box@.
among :: BoxTree a -> (a -> Bool) -> BoundingBox -> [Int] -> [a]
among tree holds box = go
  where
    go indices = case indices of
      [] -> []
      i : more
        | BoundingBox.meets box (boxAt (lowest tree) i),
          a <- thing tree i,
          holds a ->
          let rest = go more in rest `seq` (a : rest)
        | otherwise -> go more
{-# INLINE among #-}

-- | Half of a box's perimeter, in mm.
halfPerimeter :: BoundingBox -> Double
halfPerimeter (BoundingBox l b r t) = (r - l) + (t - b)

-- | The largest number of elements in a group of 'each'.
groupSize :: Int
groupSize = 8

-- | The largest extent of a group of 'each': the half perimeter of the box around the group,
-- divided by the least half perimeter of an element's box.
groupExtent :: Double
groupExtent = 8

-- | The largest number of things that 'each' tests one by one for every element of a group. If the
-- box around the group meets more things, the tree is searched for every element.
groupLimit :: Int
groupLimit = 128

-- Nearest things ----------------------------------------------------------------------------

-- | The thing nearest to the point @p@, preceded by its distance; the first one if several are
-- equally near. Nothing for an empty tree. @distanceTo@ gives the distance of a thing from @p@.
-- Because of rounding, this distance may be less than that of the thing's box, by at most
-- 'Tolerance.coincident'.
--
-- This is branch and bound. Of the boxes in a box it visits the nearest one first.
closest :: (a -> Mm) -> Point -> BoxTree a -> Maybe (Mm, a)
closest distanceTo p tree = case levels tree of
  [] -> Nothing
  top : below -> case inside top below 0 (boxCount top) (Nearest (Mm (1 / 0)) (-1)) of
    Nearest d i
      | i < 0 -> Nothing
      | otherwise -> Just (d, thing tree i)
    where
      -- Visits the boxes of @level@ from @i@ to @end − 1@. @best@ is the nearest thing so far.
      inside level below' i end best = case below' of
        [] -> nearest level i end best
        next : lower ->
          let first = nearestBox level (i + 1) end i (away level i)
           in others next lower level first i end (visit next lower first (away level first) best)
      others next lower level first i end best
        | i >= end = best
        | i == first = others next lower level first (i + 1) end best
        | otherwise =
          others next lower level first (i + 1) end (visit next lower i (away level i) best)
      visit next lower k d best
        | isFurther d best = best
        | otherwise = inside next lower (fan * k) (childrenEnd next k) best
      nearestBox level i end k d
        | i >= end = k
        | away level i < d = nearestBox level (i + 1) end i (away level i)
        | otherwise = nearestBox level (i + 1) end k d
      nearest level i end best
        | i >= end = best
        | isFurther (away level i) best = nearest level (i + 1) end best
        | otherwise = nearest level (i + 1) end (better i (distanceTo (thing tree i)) best)
      isFurther d (Nearest e _) = d > e
      better i d best@(Nearest e j)
        | j < 0 || d < e || (d == e && i < j) = Nearest d i
        | otherwise = best
      away level i = minus (BoundingBox.distance p (boxAt level i)) Tolerance.coincident

-- | Index of the nearest thing so far, preceded by its distance; a negative index if there is none.
data Nearest = Nearest Mm Int

-- | A subtree: its box, and either the one thing in it or its own subtrees.
data Node a = Leaf BoundingBox a | Branch BoundingBox ~[Node a]

-- | A list with the topmost node of a tree as its only element. It is empty if the tree is empty.
roots :: BoxTree a -> [Node a]
roots tree = case levels tree of
  [] -> []
  top : below -> nodes top below 0 (boxCount top)
  where
    nodes level below i end = map (node level below) [i .. end - 1]
    node level below i = case below of
      [] -> Leaf (boxAt level i) (thing tree i)
      next : lower -> Branch (boxAt level i) (nodes next lower (fan * i) (childrenEnd next i))

-- | The box of a node.
nodeBox :: Node a -> BoundingBox
nodeBox node = case node of
  Leaf box _ -> box
  Branch box _ -> box

-- | The thing with the least measure, preceded by this measure; Nothing if no thing has a measure.
-- @measure@ gives the measure of a thing, or Nothing if it has none. @atLeast@ gives a lower bound
-- of the measures of all things in a box, or Nothing if no such thing has a measure.
--
-- This is branch and bound. Of several boxes it visits the one with the least lower bound first.
leastBy :: Ord m => (BoundingBox -> Maybe m) -> (a -> Maybe m) -> BoxTree a -> Maybe (m, a)
leastBy atLeast measure tree = go Nothing (roots tree)
  where
    go best nodes =
      List.foldl' visit best (sortOn fst [(low, n) | n <- nodes, Just low <- [atLeast (nodeBox n)]])
    visit best (low, node)
      | Just (m, _) <- best, m <= low = best
      | otherwise = case node of
        Branch _ below -> go best below
        Leaf _ a -> case (best, measure a) of
          (_, Nothing) -> best
          (Just (m, _), Just m') | m <= m' -> best
          (_, Just m') -> Just (m', a)

-- | The result of @measure@ for the two things, one of each tree, that have the least distance from
-- each other. If several pairs have this distance, it is the result for one of them. Nothing if a
-- tree is empty.
-- @distanceOf@ reads the distance from a result of @measure@. Because of rounding, this distance
-- may be less than that of the things' boxes, by at most 'Tolerance.coincident'.
--
-- This is branch and bound on pairs of nodes. It divides the node with the larger box and visits
-- nearer pairs first.
closestPair :: (a -> b -> c) -> (c -> Mm) -> BoxTree a -> BoxTree b -> Maybe c
closestPair measure distanceOf one other =
  List.foldl' (\best (a, b) -> go best a b) Nothing [(a, b) | a <- roots one, b <- roots other]
  where
    go best a b
      | Just c <- best,
        minus (BoundingBox.gapBetween (nodeBox a) (nodeBox b)) Tolerance.coincident > distanceOf c =
        best
      | otherwise = case (a, b) of
        (Leaf _ s, Leaf _ t) -> better best (measure s t)
        (Branch p as, Branch q bs)
          | halfPerimeter p > halfPerimeter q -> nearestFirst best [(a', b) | a' <- as]
          | otherwise -> nearestFirst best [(a, b') | b' <- bs]
        (Branch _ as, Leaf _ _) -> nearestFirst best [(a', b) | a' <- as]
        (Leaf _ _, Branch _ bs) -> nearestFirst best [(a, b') | b' <- bs]
    nearestFirst best = List.foldl' (\best' (a, b) -> go best' a b) best . sortOn boxDistance
    boxDistance (a, b) = BoundingBox.gapBetween (nodeBox a) (nodeBox b)
    better best c = case best of
      Just b | distanceOf b <= distanceOf c -> best
      _ -> Just c
