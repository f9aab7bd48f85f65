{-# LANGUAGE BangPatterns #-}
{-# LANGUAGE MagicHash #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | The bounding-box tree of the offset kernel ("Offset.Kernel"), over the segments of
-- 'ClosedPolyarcs'.
--
-- It is a packed R-tree in flat arrays. A run is a group of eight consecutive segments: run @r@
-- starts at the segment with the index @8·r@. The lowest level, with the index 0, has a box around
-- each run; the next level has one around each eight such boxes, and so on. Consecutive segments
-- are close in space, so nothing is sorted. Boxes of single segments are computed when needed,
-- which costs less than storing them.
--
-- A segment advances in a direction if every point of it is further in this direction than the
-- points before. A chain whose segments all advance in one direction does not meet itself. For each
-- box the tree stores in which of eight directions (those of the axes and of the diagonals) all of
-- its segments advance. The search for pairs of segments that meet skips the pairs inside a box
-- that has such a direction. It also skips the pairs between two neighbouring boxes that have a
-- direction in common.
--
-- A box is given by its least x, least y, largest x and largest y, in mm and in this order. A
-- function whose result is a box passes these numbers to a continuation. A continuation is a
-- function, given as the last argument. So the box is never built in memory.
--
-- "Geometry.Index.BoxTree" is the tree for things of any type. It stores the boxes of single things
-- and no directions.
module Geometry.Index.SegmentBoxTree
  ( SegmentBoxTree,
    build,

    -- * Boxes
    segmentBoxWithMargin,
    boundingBox,
    runBoxOf,
    nextRun,

    -- * Queries
    pairs,
    around,
  )
where

import Control.Monad (when)
import Control.Monad.ST (ST, runST)
import Data.Bits (countTrailingZeros, shiftL, shiftR, unsafeShiftR, (.&.), (.|.))
import Data.Primitive.PrimArray
import Data.Word (Word8)
import GHC.Exts (Double (D#), Int (I#), (>=##))
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Index.BoundingBoxCache qualified as BoundingBoxCache

-- | The tree of the segments of @chain@. The arrays @sides@ and @directions@ contain the boxes of
-- all levels one after the other, the lowest level first.
data SegmentBoxTree = SegmentBoxTree
  { chain :: ClosedPolyarcs,
    -- | the distance in mm by which every box is enlarged on each side
    margin :: Double,
    -- | four numbers for each box, in mm: least x, least y, largest x, largest y
    sides :: PrimArray Double,
    -- | for each box, the directions in which all of its segments advance, as bits
    directions :: PrimArray Word8,
    -- | for each level, the index of its first box in the arrays
    begins :: PrimArray Int,
    -- | the number of boxes of each level
    counts :: PrimArray Int,
    -- | the index of the level that consists of one box
    highest :: Int
  }

-- | The number of segments in a box of the lowest level. Any other box contains as many boxes of
-- the next lower level.
fan :: Int
fan = BoundingBoxCache.runLength

-- Boxes -------------------------------------------------------------------------------------

-- | The box of the segment with the index @i@, enlarged by the tree's margin and passed to the
-- continuation @k@.
segmentBoxWithMargin :: SegmentBoxTree -> Int -> (Double -> Double -> Double -> Double -> r) -> r
segmentBoxWithMargin bs i k =
  segmentBox (chain bs) i (\lx ly hx hy -> k (lx - m) (ly - m) (hx + m) (hy + m))
  where
    m = margin bs
{-# INLINE segmentBoxWithMargin #-}

-- | The box of the segment with the index @i@, without a margin, passed to the continuation @k@. An
-- arc up to a half circle lies in the rectangle that has the chord as one side and the sagitta as
-- its height. The box is that of this rectangle.
segmentBox :: ClosedPolyarcs -> Int -> (Double -> Double -> Double -> Double -> r) -> r
segmentBox c i k = k lx ly hx hy
  where
    !x0 = indexPrimArray (ClosedPolyarcs.xs c) i
    !y0 = indexPrimArray (ClosedPolyarcs.ys c) i
    !x1 = indexPrimArray (ClosedPolyarcs.xs c) (i + 1)
    !y1 = indexPrimArray (ClosedPolyarcs.ys c) (i + 1)
    !b = indexPrimArray (ClosedPolyarcs.bulges c) i
    !ox = 0.5 * b * (y1 - y0)
    !oy = 0.5 * b * (x0 - x1)
    !lx = least x0 x1 + least 0 ox
    !ly = least y0 y1 + least 0 oy
    !hx = most x0 x1 + most 0 ox
    !hy = most y0 y1 + most 0 oy
{-# INLINE segmentBox #-}

-- | 1 when the first number is at least the second, else 0. The function has no branch.
reaches :: Double -> Double -> Int
reaches (D# a) (D# b) = I# (a >=## b)
{-# INLINE reaches #-}

-- | The box, with the tree's margin, of the run to which the segment with the index @i@ belongs. It
-- is passed to a continuation.
runBoxOf :: SegmentBoxTree -> Int -> (Double -> Double -> Double -> Double -> r) -> r
runBoxOf bs i = boxAt (sides bs) (i `shiftR` 3)
{-# INLINE runBoxOf #-}

-- | The index of the first segment of the run after the one that contains segment @i@.
nextRun :: Int -> Int
nextRun i = (i `shiftR` 3 + 1) `shiftL` 3
{-# INLINE nextRun #-}

-- | The box, with the margin, around all segments of a tree, passed to a continuation.
boundingBox :: SegmentBoxTree -> (Double -> Double -> Double -> Double -> r) -> r
boundingBox bs = boxAt (sides bs) (indexPrimArray (begins bs) (highest bs))

-- | The box with the index @k@ in the array @a@, passed to the continuation @next@. @a@ is the
-- array 'sides' of a tree.
boxAt :: PrimArray Double -> Int -> (Double -> Double -> Double -> Double -> r) -> r
boxAt a k next =
  next
    (indexPrimArray a (4 * k))
    (indexPrimArray a (4 * k + 1))
    (indexPrimArray a (4 * k + 2))
    (indexPrimArray a (4 * k + 3))
{-# INLINE boxAt #-}

-- Construction ------------------------------------------------------------------------------

-- | Build the tree of all segments of @c@, with boxes enlarged by the margin @m@ in mm.
build :: Double -> ClosedPolyarcs -> SegmentBoxTree
build !m !c = runST $ do
  let n = sizeofPrimArray (ClosedPolyarcs.xs c)
      lowest = max 1 ((n + fan - 1) `quot` fan)
      levels = levelSizes lowest
  out <- Boxes <$> newPrimArray (4 * sum levels) <*> newPrimArray (sum levels)
  when (n == 0) $ putBox out 0 far far (-far) (-far) 0
  writeRuns m c out
  writeLevels out 0 lowest
  let Boxes sides directions = out
  SegmentBoxTree c m
    <$> unsafeFreezePrimArray sides
      <*> unsafeFreezePrimArray directions
      <*> pure (primArrayFromList (scanl (+) 0 levels))
      <*> pure (primArrayFromList levels)
      <*> pure (length levels - 1)

-- | The numbers of boxes of all levels from the lowest on; @count@ is that of the lowest level.
levelSizes :: Int -> [Int]
levelSizes count
  | count == 1 = [1]
  | otherwise = count : levelSizes ((count + fan - 1) `quot` fan)

-- | The arrays @sides@ and @directions@ of a tree while they are written.
data Boxes s = Boxes (MutablePrimArray s Double) (MutablePrimArray s Word8)

-- | Write the box with the index @k@: its least x, least y, largest x and largest y, and the set
-- @w@ of its directions as bits.
putBox :: Boxes s -> Int -> Double -> Double -> Double -> Double -> Int -> ST s ()
putBox (Boxes sides directions) !k !lx !ly !hx !hy !w = do
  writePrimArray sides (4 * k) lx
  writePrimArray sides (4 * k + 1) ly
  writePrimArray sides (4 * k + 2) hx
  writePrimArray sides (4 * k + 3) hy
  writePrimArray directions k (fromIntegral w)
{-# INLINE putBox #-}

-- | Write the lowest level: the box of each run, enlarged by the margin @m@ in mm, and its
-- directions.
writeRuns :: Double -> ClosedPolyarcs -> Boxes s -> ST s ()
writeRuns !m !c !out = go 0
  where
    !n = sizeofPrimArray (ClosedPolyarcs.xs c)
    go !k
      | fan * k >= n = pure ()
      | otherwise = do
        let a = fan * k
            e = min (n - 1) (a + fan)
            x = indexPrimArray (ClosedPolyarcs.xs c) a
            y = indexPrimArray (ClosedPolyarcs.ys c) a
            w = if a + fan < n then headings m c a e else 0
        runBox c a e x y x y $ \lx ly hx hy -> putBox out k (lx - m) (ly - m) (hx + m) (hy + m) w
        go (k + 1)

-- | Write all levels above a level that has @count@ boxes, the first of which has the index @start@
-- in the arrays.
writeLevels :: Boxes s -> Int -> Int -> ST s ()
writeLevels out@(Boxes sides directions) !start !count
  | count == 1 = pure ()
  | otherwise = node 0
  where
    !higher = (count + fan - 1) `quot` fan
    node !k
      | k >= higher = writeLevels out (start + count) higher
      | otherwise = do
        let first = start + fan * k
            end = start + min count (fan * k + fan)
        gather k end first far far (-far) (-far) allDirections
        node (k + 1)
    gather !k !e !i !lx !ly !hx !hy !w
      | i >= e = putBox out (start + count + k) lx ly hx hy w
      | otherwise = do
        lx' <- readPrimArray sides (4 * i)
        ly' <- readPrimArray sides (4 * i + 1)
        hx' <- readPrimArray sides (4 * i + 2)
        hy' <- readPrimArray sides (4 * i + 3)
        w' <- readPrimArray directions i
        gather
          k
          e
          (i + 1)
          (least lx lx')
          (least ly ly')
          (most hx hx')
          (most hy hy')
          (w .&. fromIntegral w')

-- | A number in mm that is larger than any coordinate. A box with @far@ as least x and least y, and
-- @−far@ as largest x and largest y, contains nothing.
far :: Double
far = 1e300

-- | The lesser of two numbers, and the greater one.
least, most :: Double -> Double -> Double
least a b = if a < b then a else b
most a b = if a > b then a else b
{-# INLINE least #-}
{-# INLINE most #-}

-- | The smallest box that contains a given box and the boxes of the segments from @a@ to @e − 1@,
-- passed to the continuation @k@. The given box has the lower left corner (@lx0@, @ly0@) and the
-- upper right corner (@hx0@, @hy0@).
runBox ::
  ClosedPolyarcs ->
  Int ->
  Int ->
  Double ->
  Double ->
  Double ->
  Double ->
  (Double -> Double -> Double -> Double -> r) ->
  r
runBox c a e lx0 ly0 hx0 hy0 k = go a lx0 ly0 hx0 hy0
  where
    go !i !lx !ly !hx !hy
      | i >= e = k lx ly hx hy
      | b == 0 = go (i + 1) (least lx x) (least ly y) (most hx x) (most hy y)
      | otherwise =
        segmentBox
          c
          i
          (\px py qx qy -> go (i + 1) (least lx px) (least ly py) (most hx qx) (most hy qy))
      where
        b = indexPrimArray (ClosedPolyarcs.bulges c) i
        x = indexPrimArray (ClosedPolyarcs.xs c) (i + 1)
        y = indexPrimArray (ClosedPolyarcs.ys c) (i + 1)
{-# INLINE runBox #-}

-- | The set, as bits, of those of the eight directions in which all segments from @a@ to @e − 1@
-- advance. Only two are tested: the axis and the diagonal that are nearest to the direction from
-- vertex @a@ to vertex @e@. A segment counts as advancing only if it advances by more than ten
-- times the margin @m@. So the segments before it are further than this from the segments after it.
headings :: Double -> ClosedPolyarcs -> Int -> Int -> Int
headings !m !c !a !e = go a (2 * enough) (2 * enough)
  where
    !ux = indexPrimArray (ClosedPolyarcs.xs c) e - indexPrimArray (ClosedPolyarcs.xs c) a
    !uy = indexPrimArray (ClosedPolyarcs.ys c) e - indexPrimArray (ClosedPolyarcs.ys c) a
    -- The nearest diagonal is (sx, sy), and the nearest axis is (ax, ay).
    !sx = if ux > 0 then 1 else -1
    !sy = if uy > 0 then 1 else -1
    !level = abs ux > abs uy
    !ax = if level then sx else 0
    !ay = if level then 0 else sy
    !enough = 32 * m
    go !i !axis !diagonal
      | axis <= enough && diagonal <= enough = 0
      | i >= e =
        (if axis > enough then axisBit else 0) .|. (if diagonal > enough then diagonalBit else 0)
      | ClosedPolyarcs.hasMark
          ClosedPolyarcs.repeatedMark
          (indexPrimArray (ClosedPolyarcs.marks c) i) =
        0
      | b == 0 =
        ClosedPolyarcs.chord c i $ \dx dy ->
          go (i + 1) (least axis (ax * dx + ay * dy)) (least diagonal (sx * dx + sy * dy))
      | otherwise = ClosedPolyarcs.chord c i $ \dx dy ->
        -- The advance of an arc is estimated from its tangents at both ends, as the lesser of
        -- their two components in the direction. Each tangent is a vector of @1 + b²@ times the
        -- chord's length.
        let co = 1 - b * b
            si = 2 * b
            forward px py = co * (px * dx + py * dy) - abs (si * (px * dy - py * dx))
         in go (i + 1) (least axis (forward ax ay)) (least diagonal (forward sx sy))
      where
        b = indexPrimArray (ClosedPolyarcs.bulges c) i
    axisBit
      | level = if ux > 0 then 1 else 2
      | otherwise = if uy > 0 then 4 else 8
    diagonalBit
      | ux > 0 = if uy > 0 then 16 else 32
      | otherwise = if uy > 0 then 64 else 128

-- | The bits of all eight directions.
allDirections :: Int
allDirections = 255

-- Pairs -------------------------------------------------------------------------------------

-- | Visit all pairs of segments that may meet and whose boxes overlap, by their indices. Each pair
-- is visited once, the earlier segment first. The action @continues@ is run before the search
-- enters a box above the lowest level. If it returns false, the pairs inside this box are skipped.
pairs :: SegmentBoxTree -> ST s Bool -> (Int -> Int -> ST s ()) -> ST s ()
pairs bs@SegmentBoxTree {chain = c, margin = m, sides} continues visit = do
  cache <- boundingBox bs (BoundingBoxCache.new c m)
  let -- Visits the pairs of two segments of run @a@.
      inside !a = do
        let !s = BoundingBoxCache.slotOf a
        BoundingBoxCache.load cache s a
        BoundingBoxCache.overlappingPairs cache s >>= visits (fan * a) (fan * s) (fan * a) (fan * s)
      -- Visits the pairs of a segment of run @a@ and one of run @b@.
      between !a !b = do
        let !s = BoundingBoxCache.slotOf a
        BoundingBoxCache.load cache s a
        some <- boxAt sides b (BoundingBoxCache.overlappingBox cache s)
        when (some /= 0) $ do
          let !own = BoundingBoxCache.slotOf b
              !other = if s == own then BoundingBoxCache.spareSlot else own
          BoundingBoxCache.load cache other b
          BoundingBoxCache.overlappingBetween cache s some other
            >>= visits (fan * a) (fan * s) (fan * b) (fan * other)
      -- Visits the pairs in a set: bit @8·i + j@ is the pair of segments @a + i@ and @b + j@, whose
      -- boxes have the indices @p + i@ and @q + j@ in the cache.
      visits !a !p !b !q !set
        | set == 0 = pure ()
        | otherwise = do
          let !k = countTrailingZeros set
              !i = k `unsafeShiftR` 3
              !j = k .&. (fan - 1)
          isClear <-
            if b + j == a + i + 1
              then pure True
              else BoundingBoxCache.clearlyOverlap cache (p + i) (q + j)
          when (isClear || BoundingBoxCache.boxesOverlap m c (a + i) (b + j)) $
            visit (a + i) (b + j)
          visits a p b q (set .&. (set - 1))
  runPairs bs continues inside between
{-# INLINE pairs #-}

-- | Run the action @inRun@ for the index of each run that may contain two segments that meet. Run
-- the action @betweenRuns@ for each pair of runs whose boxes overlap and whose segments may meet;
-- its first argument is the earlier run. The action @continues@ is run before a box above the
-- lowest level is entered. If it returns false, the runs inside this box are skipped.
runPairs ::
  SegmentBoxTree -> ST s Bool -> (Int -> ST s ()) -> (Int -> Int -> ST s ()) -> ST s ()
runPairs SegmentBoxTree {sides, directions, begins, counts, highest} continues inRun betweenRuns =
  within highest 0
  where
    -- Finds the pairs inside box @a@ of level @l@.
    within !l !a
      | direction (at l + a) /= 0 = pure ()
      | l == 0 = inRun a
      | otherwise = do
        more <- continues
        when more (among (l - 1) a)
    -- Finds the pairs of a run in box @a@ and a run in box @b@ of level @l@.
    between !l !a !b
      | b == a + 1 && direction (at l + a) .&. direction (at l + b) /= 0 = pure ()
      | l == 0 = betweenRuns a b
      | otherwise =
        boxAt sides (at l + b) (across (l - 1) (fan * a) (min (size (l - 1)) (fan * a + fan)) b)
    -- Finds the pairs among the boxes of level @l@ that lie in box @a@ of the next higher level.
    among !l !a = go (fan * a)
      where
        !e = min (size l) (fan * a + fan)
        !o = at l
        go !i
          | i >= e = pure ()
          | otherwise = within l i >> boxAt sides (o + i) (follow l i (i + 1) e) >> go (i + 1)
    -- Finds the pairs of boxes @i@ to @e − 1@ of level @l@ with those that lie in box @b@ of the
    -- next higher level. The last four arguments are the sides of box @b@.
    across !l !i !e !b !lx !ly !hx !hy
      | i >= e = pure ()
      | otherwise = do
        when (overlaps sides (at l + i) lx ly hx hy) $
          boxAt sides (at l + i) (follow l i (fan * b) (min (size l) (fan * b + fan)))
        across l (i + 1) e b lx ly hx hy
    -- Finds the pairs of box @i@ of level @l@, whose sides are the last four arguments, with boxes
    -- @j@ to @e − 1@ of that level.
    follow !l !i !j !e !lx !ly !hx !hy
      | j >= e = pure ()
      | otherwise =
        when (overlaps sides (at l + j) lx ly hx hy) (between l i j)
          >> follow l i (j + 1) e lx ly hx hy
    at l = indexPrimArray begins l
    size l = indexPrimArray counts l
    direction k = indexPrimArray directions k
{-# INLINE runPairs #-}

-- | True when the box with the index @k@ in the array @a@, the array 'sides' of a tree, overlaps
-- the box given by the other arguments. The four comparisons are combined without a branch.
overlaps :: PrimArray Double -> Int -> Double -> Double -> Double -> Double -> Bool
overlaps a k lx ly hx hy =
  boxAt
    a
    k
    (\px py qx qy -> reaches hx px .&. reaches qx lx .&. reaches hy py .&. reaches qy ly /= 0)
{-# INLINE overlaps #-}

-- Segments in a box -------------------------------------------------------------------------

-- | A strict left fold with the function @f@ over the indices, in ascending order, of the segments
-- whose enlarged boxes overlap a given box. The given box has the lower left corner (@lx@, @ly@)
-- and the upper right corner (@hx@, @hy@). The fold begins with the value @start@.
around :: SegmentBoxTree -> Double -> Double -> Double -> Double -> a -> (a -> Int -> a) -> a
around SegmentBoxTree {chain = c, margin = m, sides, begins, counts, highest} lx ly hx hy start f =
  go highest 0 start
  where
    n = sizeofPrimArray (ClosedPolyarcs.xs c)
    go !l !k acc
      | not (overlaps sides (indexPrimArray begins l + k) lx ly hx hy) = acc
      | l == 0 = segments (fan * k) (min n (fan * k + fan)) acc
      | otherwise =
        children (l - 1) (fan * k) (min (indexPrimArray counts (l - 1)) (fan * k + fan)) acc
    children !l !k !e acc
      | k >= e = acc
      | otherwise = let acc' = go l k acc in acc' `seq` children l (k + 1) e acc'
    segments !i !e acc
      | i >= e = acc
      | BoundingBoxCache.isSegment c i
          && segmentBox
            c
            i
            (\a b a' b' -> a - m <= hx && lx <= a' + m && b - m <= hy && ly <= b' + m) =
        let acc' = f acc i in acc' `seq` segments (i + 1) e acc'
      | otherwise = segments (i + 1) e acc
{-# INLINE around #-}
