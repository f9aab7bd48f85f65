{-# LANGUAGE BangPatterns #-}
{-# LANGUAGE MagicHash #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | The bounding-box tree of the offset kernel, over the segments of 'ClosedPolyarcs'.
--
-- It is a packed R-tree in flat arrays: a box around each run of eight consecutive segments, one
-- around each eight such boxes, and so on. Consecutive segments are close in space, so nothing is
-- sorted. Boxes of single segments are computed when needed, which costs less than storing them.
--
-- A chain whose segments all advance in one direction does not meet itself. For each box the tree
-- stores in which of eight directions all of its segments advance. The search for pairs skips the
-- inside of a box with such a direction, and two neighbouring boxes with a direction in common.
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
import Data.Bits (countTrailingZeros, shiftL, shiftR, unsafeShiftL, unsafeShiftR, (.&.), (.|.))
import Data.Primitive.PrimArray
import Data.Word (Word8)
import GHC.Exts (Double (D#), Int (I#), uncheckedIShiftRL#, (>=##))
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs

-- | The tree. Its arrays contain the boxes of all levels one after the other, the lowest level
-- first.
data SegmentBoxTree = SegmentBoxTree
  { chain :: ClosedPolyarcs,
    -- | in mm; every box is enlarged by it
    margin :: Double,
    -- | of each box: least x, least y, largest x, largest y
    sides :: PrimArray Double,
    -- | of each box: the directions in which all of its segments advance, as bits
    directions :: PrimArray Word8,
    -- | the first box of each level
    begins :: PrimArray Int,
    -- | the number of boxes of each level
    counts :: PrimArray Int,
    -- | the level that consists of one box
    highest :: Int
  }

-- | The number of segments in a box of the lowest level, and of lower boxes in any other box.
fan :: Int
fan = 8

-- Boxes -------------------------------------------------------------------------------------

-- | The box of the segment with an index, enlarged by the margin and passed to a continuation:
-- least x, least y, largest x, largest y.
segmentBoxWithMargin :: SegmentBoxTree -> Int -> (Double -> Double -> Double -> Double -> r) -> r
segmentBoxWithMargin bs i k =
  segmentBox (chain bs) i (\lx ly hx hy -> k (lx - m) (ly - m) (hx + m) (hy + m))
  where
    m = margin bs
{-# INLINE segmentBoxWithMargin #-}

-- | The box of a segment without the margin. An arc up to a half circle lies in the parallelogram
-- on its chord whose other side is tangent to it.
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

-- | 1 when the first number is at least the second, else 0; without a branch.
reaches :: Double -> Double -> Int
reaches (D# a) (D# b) = I# (a >=## b)
{-# INLINE reaches #-}

-- | True when a segment starts at the vertex with an index. None starts at the repeated first
-- vertex of a loop.
present :: ClosedPolyarcs -> Int -> Bool
present c i =
  not
    (ClosedPolyarcs.hasMark ClosedPolyarcs.repeatedMark (indexPrimArray (ClosedPolyarcs.marks c) i))
{-# INLINE present #-}

-- | The box of the run of eight segments to which a segment belongs, passed to a continuation.
runBoxOf :: SegmentBoxTree -> Int -> (Double -> Double -> Double -> Double -> r) -> r
runBoxOf bs i = boxAt (sides bs) (i `shiftR` 3)
{-# INLINE runBoxOf #-}

-- | The index of the first segment of the run after the one to which a segment belongs.
nextRun :: Int -> Int
nextRun i = (i `shiftR` 3 + 1) `shiftL` 3
{-# INLINE nextRun #-}

-- | The box around all segments, passed to a continuation.
boundingBox :: SegmentBoxTree -> (Double -> Double -> Double -> Double -> r) -> r
boundingBox bs = boxAt (sides bs) (indexPrimArray (begins bs) (highest bs))

-- | The stored box with an index, passed to a continuation.
boxAt :: PrimArray Double -> Int -> (Double -> Double -> Double -> Double -> r) -> r
boxAt a k next =
  next
    (indexPrimArray a (4 * k))
    (indexPrimArray a (4 * k + 1))
    (indexPrimArray a (4 * k + 2))
    (indexPrimArray a (4 * k + 3))
{-# INLINE boxAt #-}

-- Construction ------------------------------------------------------------------------------

-- | Build the tree of all segments, with boxes enlarged by a margin in mm.
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

-- | The numbers of boxes of all levels from the lowest on, given that of the lowest.
levelSizes :: Int -> [Int]
levelSizes count
  | count == 1 = [1]
  | otherwise = count : levelSizes ((count + fan - 1) `quot` fan)

-- | The sides and directions of boxes while they are written.
data Boxes s = Boxes (MutablePrimArray s Double) (MutablePrimArray s Word8)

-- | Write the box with an index: least x, least y, largest x, largest y, and its directions.
putBox :: Boxes s -> Int -> Double -> Double -> Double -> Double -> Int -> ST s ()
putBox (Boxes sides directions) !k !lx !ly !hx !hy !w = do
  writePrimArray sides (4 * k) lx
  writePrimArray sides (4 * k + 1) ly
  writePrimArray sides (4 * k + 2) hx
  writePrimArray sides (4 * k + 3) hy
  writePrimArray directions k (fromIntegral w)
{-# INLINE putBox #-}

-- | Write the lowest level: the boxes of the runs.
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

-- | Write all levels above the one that starts at box @start@ and has @count@ boxes.
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

-- | Larger than any coordinate.
far :: Double
far = 1e300

least, most :: Double -> Double -> Double
least a b = if a < b then a else b
most a b = if a > b then a else b
{-# INLINE least #-}
{-# INLINE most #-}

-- | A box extended by the segments from @a@ to @e − 1@, passed to a continuation.
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

-- | Those of the eight directions in which all segments from @a@ to @e − 1@ advance, as bits. Only
-- two are tested: the axis and the diagonal that are nearest to the direction from the first vertex
-- to the last. Every segment must advance by 32 times the margin @m@, so that the enlarged boxes of
-- its predecessors and successors cannot meet it.
headings :: Double -> ClosedPolyarcs -> Int -> Int -> Int
headings !m !c !a !e = go a (2 * enough) (2 * enough)
  where
    !ux = indexPrimArray (ClosedPolyarcs.xs c) e - indexPrimArray (ClosedPolyarcs.xs c) a
    !uy = indexPrimArray (ClosedPolyarcs.ys c) e - indexPrimArray (ClosedPolyarcs.ys c) a
    -- The nearest diagonal and the nearest axis.
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
        -- The lesser advance of the tangents at both ends, at least as long as the chord.
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

-- | Visit all pairs of segments that may meet and whose boxes overlap. Each pair is visited once,
-- the earlier segment first. The search ends early if @continues@, which is run now and then, is
-- false.
pairs :: SegmentBoxTree -> ST s Bool -> (Int -> Int -> ST s ()) -> ST s ()
pairs bs@SegmentBoxTree {chain = c, margin = m, sides, directions, highest} continues visit = do
  -- A cache of the boxes of single segments, with one run in each slot. A run belongs into the slot
  -- with its index modulo 'fan', or into the spare slot 'fan'. @held@ has the run of each slot, or
  -- −1.
  near <- Near <$> newPrimArray (answer + 1) <*> newPrimArray answer
  held <- newPrimArray (fan + 1)
  setPrimArray held 0 (fan + 1) (-1)
  let !grid = gridOf bs
      -- 'within' visits the pairs inside box @a@ of level @l@, 'between' those of a segment in box
      -- @a@ with one in box @b@ of this level.
      within !l !a
        | direction (at l + a) /= 0 = pure ()
        | l == 0 =
          load (slot a) a >> amongThem near (slot a) >> found near
            >>= visits (fan * a) (fan * slot a) (fan * a) (fan * slot a)
        | otherwise = do
          more <- continues
          when more (among (l - 1) a)
      between !l !a !b
        | b == a + 1 && direction (at l + a) .&. direction (at l + b) /= 0 = pure ()
        | l == 0 = do
          load (slot a) a
          boxAt
            sides
            b
            ( \lx ly hx hy ->
                against
                  near
                  (slot a)
                  (least' (stepX grid lx) (stepY grid ly))
                  (largest' (stepX grid hx) (stepY grid hy))
            )
          some <- found near
          when (some /= 0) $ do
            let other = if slot a == slot b then fan else slot b
            load other b
            overlapping near (slot a) some other
            found near >>= visits (fan * a) (fan * slot a) (fan * b) (fan * other)
        | otherwise =
          boxAt sides (at l + b) (across (l - 1) (fan * a) (min (size (l - 1)) (fan * a + fan)) b)
      -- 'among' visits the pairs among the boxes of level @l@ that belong to box @a@ of the next
      -- level. 'across' visits the pairs of boxes @i@ to @e − 1@ of level @l@ with those that
      -- belong to box @b@ of the next level. 'follow' pairs box @i@ with boxes @j@ to @e − 1@.
      among !l !a = go (fan * a)
        where
          !e = min (size l) (fan * a + fan)
          !o = at l
          go !i
            | i >= e = pure ()
            | otherwise = within l i >> boxAt sides (o + i) (follow l i (i + 1) e) >> go (i + 1)
      across !l !i !e !b !lx !ly !hx !hy
        | i >= e = pure ()
        | otherwise = do
          when (overlaps sides (at l + i) lx ly hx hy) $
            boxAt sides (at l + i) (follow l i (fan * b) (min (size l) (fan * b + fan)))
          across l (i + 1) e b lx ly hx hy
      follow !l !i !j !e !lx !ly !hx !hy
        | j >= e = pure ()
        | otherwise =
          when (overlaps sides (at l + j) lx ly hx hy) (between l i j)
            >> follow l i (j + 1) e lx ly hx hy
      -- Fill slot @s@ with the boxes of run @r@, unless it holds them already.
      load !s !r = do
        r' <- readPrimArray held s
        when (r' /= r) $ do
          writePrimArray held s r
          fill bs grid near s r
      -- Visit the pairs in a set, as 'amongThem' numbers them. The segments of the first run count
      -- from @a@, those of the second from @b@; their boxes in the slots count from @p@ and @q@.
      visits !a !p !b !q !set
        | set == 0 = pure ()
        | otherwise = do
          let !k = countTrailingZeros set
              !i = k `unsafeShiftR` 3
              !j = k .&. (fan - 1)
          sure <- if b + j == a + i + 1 then pure True else surely near (p + i) (q + j)
          when (sure || exactly m c (a + i) (b + j)) $ visit (a + i) (b + j)
          visits a p b q (set .&. (set - 1))
  within highest 0
  where
    at l = indexPrimArray (begins bs) l
    size l = indexPrimArray (counts bs) l
    direction k = indexPrimArray directions k
    slot r = r .&. (fan - 1)
{-# INLINE pairs #-}

-- | A grid of 2²⁹ steps over the box of all segments: half the number of steps in 1 mm, and half of
-- the numbers that are added to x and y in steps.
--
-- A corner of a box is one machine word that contains both coordinates in steps. Above each
-- coordinate is one further bit, which is set in upper corners only. When a lower corner is
-- subtracted from an upper one, the bit of a coordinate remains set exactly where the lower
-- coordinate is not the larger one.
data Grid = Grid {halfSteps :: Double, addX :: Double, addY :: Double}

-- | The grid of a tree. Coordinates are far enough above 0 for rounding not to make one negative.
gridOf :: SegmentBoxTree -> Grid
gridOf bs = boundingBox bs $ \lx ly hx hy ->
  let w = most (hx - lx) (hy - ly)
      steps = if w > 0 then 268435456 / w else 0
   in Grid {halfSteps = steps, addX = 134217728 - steps * lx, addY = 134217728 - steps * ly}

-- | A coordinate x or y, converted from mm to steps.
stepX, stepY :: Grid -> Double -> Double
stepX g x = 2 * (x * halfSteps g + addX g)
stepY g y = 2 * (y * halfSteps g + addY g)
{-# INLINE stepX #-}
{-# INLINE stepY #-}

-- | The word of a lower and of an upper corner, from coordinates in steps. The corners are rounded
-- outwards.
least', largest' :: Double -> Double -> Int
least' x y = truncate x .|. truncate y `unsafeShiftL` 32
largest' x y = truncate (x + 2147483649) .|. truncate (y + 2147483649) `unsafeShiftL` 32
{-# INLINE least' #-}
{-# INLINE largest' #-}

-- | The lower corners of boxes and the upper ones, in slots of eight boxes. After the lower corners
-- comes the answer of the last query: a set of boxes or pairs, as bits.
data Near s = Near (MutablePrimArray s Int) (MutablePrimArray s Int)

-- | The answer of the last query.
found :: Near s -> ST s Int
found (Near lows _) = readPrimArray lows answer
{-# INLINE found #-}

-- | The index of the answer in the lower corners.
answer :: Int
answer = fan * (fan + 1)

-- | True when two boxes, by their indices in the slots, overlap by more than the rounding to the
-- grid.
surely :: Near s -> Int -> Int -> ST s Bool
surely (Near lows highs) !p !q = do
  low <- readPrimArray lows p
  high <- readPrimArray highs p
  hit <- touches lows highs q (low + apart) (high - apart)
  pure (hit /= 0)
  where
    apart = 0x0000000300000003
{-# INLINE surely #-}

-- | True when the boxes of two segments, enlarged by the margin @m@, overlap. Rounding errors are a
-- few units in the last place, far less than the margin. All coordinates are doubled.
exactly :: Double -> ClosedPolyarcs -> Int -> Int -> Bool
exactly !m !c !i !j =
  twice i $ \lx ly hx hy -> twice j $ \px py qx qy -> px <= hx && lx <= qx && py <= hy && ly <= qy
  where
    twice k next =
      let !x0 = indexPrimArray (ClosedPolyarcs.xs c) k
          !y0 = indexPrimArray (ClosedPolyarcs.ys c) k
          !x1 = indexPrimArray (ClosedPolyarcs.xs c) (k + 1)
          !y1 = indexPrimArray (ClosedPolyarcs.ys c) (k + 1)
          !b = 0.5 * indexPrimArray (ClosedPolyarcs.bulges c) k
          !dx = x1 - x0
          !dy = y1 - y0
          !ox = b * dy
          !oy = b * dx
          !cx = x0 + x1 + ox
          !cy = y0 + y1 - oy
          !wx = abs dx + abs ox + 2 * m
          !wy = abs dy + abs oy + 2 * m
       in next (cx - wx) (cy - wy) (cx + wx) (cy + wy)
    {-# INLINE twice #-}
{-# NOINLINE exactly #-}

-- | Write the corners of the boxes of run @r@ into slot @s@. A vertex at which no segment starts
-- gets a box that overlaps no other.
fill :: SegmentBoxTree -> Grid -> Near s -> Int -> Int -> ST s ()
fill SegmentBoxTree {chain = c, margin = m} Grid {halfSteps, addX, addY} (Near !lows !highs) !s !r =
  go (fan * s) begin (stepsX begin) (stepsY begin)
  where
    !begin = fan * r
    !e = min (begin + fan) (sizeofPrimArray (ClosedPolyarcs.xs c) - 1)
    !twice = 2 * m * halfSteps
    stepsX i = indexPrimArray (ClosedPolyarcs.xs c) i * halfSteps + addX
    stepsY i = indexPrimArray (ClosedPolyarcs.ys c) i * halfSteps + addY
    go !k !i !x !y
      | i >= e = rest k
      | otherwise = do
        let !x' = stepsX (i + 1)
            !y' = stepsY (i + 1)
            !b = 0.5 * indexPrimArray (ClosedPolyarcs.bulges c) i
            !dx = x' - x
            !dy = y' - y
            !ox = b * dy
            !oy = b * dx
            !cx = x + x' + ox
            !cy = y + y' - oy
            !wx = abs dx + abs ox + twice
            !wy = abs dy + abs oy + twice
        if present c i
          then put k (least' (cx - wx) (cy - wy)) (largest' (cx + wx) (cy + wy))
          else none k
        go (k + 1) (i + 1) x' y'
    -- No segment starts at the last vertex.
    rest !k
      | k >= fan * s + fan = pure ()
      | otherwise = none k >> rest (k + 1)
    none k = put k 0x7fffffff7fffffff (-0x7fffffff80000000)
    put !k !low !high = do
      writePrimArray lows k low
      writePrimArray highs k high
{-# NOINLINE fill #-}

-- | 1 when box @k@ of the slots overlaps the box with the corners @low@ and @high@, else 0; without
-- a branch.
touches :: MutablePrimArray s Int -> MutablePrimArray s Int -> Int -> Int -> Int -> ST s Int
touches lows highs !k !low !high = do
  low' <- readPrimArray lows k
  high' <- readPrimArray highs k
  let !both = (high - low') .&. (high' - low)
  pure $! (both `shiftRL` 63) .&. (both `shiftRL` 31)
{-# INLINE touches #-}

-- | The logical shift of a word to the right.
shiftRL :: Int -> Int -> Int
shiftRL (I# a) (I# k) = I# (uncheckedIShiftRL# a k)
{-# INLINE shiftRL #-}

-- | Find the boxes of slot @s@ that overlap the box with the corners @low@ and @high@. Bit @i@ of
-- the answer is box @i@ of the slot.
against :: Near s -> Int -> Int -> Int -> ST s ()
against (Near !lows !highs) !s !low !high = go (begin + fan - 1) 0
  where
    !begin = fan * s
    go !k !set
      | k < begin = writePrimArray lows answer set
      | otherwise = do
        hit <- touches lows highs k low high
        go (k - 1) (set + set + hit)
{-# NOINLINE against #-}

-- | Find the overlapping pairs of boxes in slot @s@. Bit @8·i + j@ of the answer is the pair of
-- boxes @i@ and @j@ of the slot, with @i < j@.
amongThem :: Near s -> Int -> ST s ()
amongThem (Near !lows !highs) !s = first (fan * s + fan - 2) 0
  where
    -- The loop uses few variables, so that all stay in registers. Slots start at multiples of 8.
    first !k !set = do
      low <- readPrimArray lows k
      high <- readPrimArray highs k
      let second !q !hits
            | q > k = do
              hit <- touches lows highs q low high
              second (q - 1) (hits + hits + hit)
            | k .&. (fan - 1) == 0 =
              writePrimArray lows answer (set `unsafeShiftL` fan + hits + hits)
            | otherwise =
              first (k - 1) (set `unsafeShiftL` fan + hits `unsafeShiftL` ((k .&. (fan - 1)) + 1))
      second (k .|. (fan - 1)) 0
{-# NOINLINE amongThem #-}

-- | Find the overlapping pairs of a box of slot @s@ and one of slot @other@. Of slot @s@, only the
-- boxes in the set @some@ are tested. Bit @8·i + j@ of the answer is the pair of boxes @i@ and @j@.
overlapping :: Near s -> Int -> Int -> Int -> ST s ()
overlapping (Near !lows !highs) !s !some !other = first some 0
  where
    !begin = fan * other
    !end = begin + fan - 1
    first !left !set
      | left == 0 = writePrimArray lows answer set
      | otherwise = do
        let !i = countTrailingZeros left
            !k = fan * s + i
        low <- readPrimArray lows k
        high <- readPrimArray highs k
        let second !q !hits
              | q < begin = first (left .&. (left - 1)) (set .|. hits `unsafeShiftL` (fan * i))
              | otherwise = do
                hit <- touches lows highs q low high
                second (q - 1) (hits + hits + hit)
        second end 0
{-# NOINLINE overlapping #-}

-- | True when stored box @k@ overlaps a box. The comparison has no branch before its result.
overlaps :: PrimArray Double -> Int -> Double -> Double -> Double -> Double -> Bool
overlaps a k lx ly hx hy =
  boxAt
    a
    k
    (\px py qx qy -> reaches hx px .&. reaches qx lx .&. reaches hy py .&. reaches qy ly /= 0)
{-# INLINE overlaps #-}

-- Segments in a box -------------------------------------------------------------------------

-- | A strict left fold over the segments whose enlarged boxes overlap a box, in order. The box is
-- given by its least x, least y, largest x and largest y.
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
      | present c i
          && segmentBox
            c
            i
            (\a b a' b' -> a - m <= hx && lx <= a' + m && b - m <= hy && ly <= b' + m) =
        let acc' = f acc i in acc' `seq` segments (i + 1) e acc'
      | otherwise = segments (i + 1) e acc
{-# INLINE around #-}
