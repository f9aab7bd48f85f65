{-# LANGUAGE BangPatterns #-}
{-# LANGUAGE MagicHash #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | A cache of the boxes of single segments. "Geometry.Index.SegmentBoxTree" uses it to find the
-- pairs of segments whose boxes overlap.
--
-- That tree divides the segments into runs: run @r@ consists of the eight segments from index @8·r@
-- on. A slot is a part of the cache with room for the eight boxes of one run. The cache has nine
-- slots, with the indices 0 to 8. Box @i@ of slot @s@, with @i@ from 0 to 7, has the index
-- @8·s + i@ in the cache.
--
-- The coordinates of boxes are whole steps of a grid, so that integer operations without a branch
-- compare two boxes. A /corner word/ is one integer that holds x and y of a corner; each box has
-- two, for its lower and its upper corner. A query finds the overlapping boxes of one or two slots,
-- as a set of bits.
module Geometry.Index.BoundingBoxCache
  ( runLength,
    isSegment,

    -- * The cache
    BoundingBoxCache,
    new,
    load,
    slotOf,
    spareSlot,

    -- * Queries
    overlappingBox,
    overlappingPairs,
    overlappingBetween,
    clearlyOverlap,
    boxesOverlap,
  )
where

import Control.Monad (when)
import Control.Monad.ST (ST)
import Data.Bits (countTrailingZeros, unsafeShiftL, (.&.), (.|.))
import Data.Primitive.PrimArray
import GHC.Exts (Int (I#), uncheckedIShiftRL#)
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs

-- | The number of segments in a run.
runLength :: Int
runLength = 8

-- | True when a segment starts at the vertex with the index @i@. After its last segment, a loop
-- repeats its first vertex, and no segment starts there.
isSegment :: ClosedPolyarcs -> Int -> Bool
isSegment c i =
  not
    (ClosedPolyarcs.hasMark ClosedPolyarcs.repeatedMark (indexPrimArray (ClosedPolyarcs.marks c) i))
{-# INLINE isSegment #-}

-- The cache ---------------------------------------------------------------------------------

-- | The cache of the boxes of some segments of @chain@.
data BoundingBoxCache s = BoundingBoxCache
  { chain :: ClosedPolyarcs,
    -- | the distance in mm by which every box is enlarged on each side
    margin :: Double,
    grid :: Grid,
    slots :: Slots s,
    -- | for each slot, the run whose boxes it contains, or −1 if it is empty
    held :: MutablePrimArray s Int
  }

-- | A grid with 2²⁹ steps over the longer side of the box of all segments. A point with x and y in
-- mm has the coordinates @2·(halfSteps·x + addX)@ and @2·(halfSteps·y + addY)@ in steps, which are
-- never negative. The fields are halves of the scale and of the shift, for the use in 'fill'. It
-- adds @halfSteps·x + addX@ for both ends of a segment. This sum is the coordinate of their
-- midpoint.
--
-- A corner of a box is one machine word: x in steps in the lower half, y in steps in the upper
-- half. The highest bit of each half is set in upper corners only. 'touches' subtracts the lower
-- corner of one box from the upper corner of another. The highest bit of a half remains set exactly
-- if the coordinate of the lower corner is at most that of the upper corner.
data Grid = Grid {halfSteps :: Double, addX :: Double, addY :: Double}

-- | Two arrays: the lower corners of all boxes in the cache, and their upper corners. A box has the
-- same index in both. The first array has one more element, after the lower corners: the answer of
-- the last query, a set of boxes or pairs as bits.
data Slots s = Slots (MutablePrimArray s Int) (MutablePrimArray s Int)

-- | An empty cache for the segments of @c@, whose boxes are enlarged by the margin @m@ in mm. The
-- box around all segments has its lower left corner at (@lx@, @ly@) and its upper right corner at
-- (@hx@, @hy@), in mm.
new :: ClosedPolyarcs -> Double -> Double -> Double -> Double -> Double -> ST s (BoundingBoxCache s)
new c m lx ly hx hy = do
  slots <- Slots <$> newPrimArray (answer + 1) <*> newPrimArray answer
  held <- newPrimArray (runLength + 1)
  setPrimArray held 0 (runLength + 1) (-1)
  pure BoundingBoxCache {chain = c, margin = m, grid = gridOf lx ly hx hy, slots, held}
{-# INLINE new #-}

-- | The slot, from 0 to 7, into which run @r@ is loaded unless another run occupies it for the same
-- query.
slotOf :: Int -> Int
slotOf r = r .&. (runLength - 1)
{-# INLINE slotOf #-}

-- | The ninth slot, for a run whose own slot is used by the other run of a query.
spareSlot :: Int
spareSlot = runLength

-- | The index of the last query's answer in the array of lower corners.
answer :: Int
answer = runLength * (runLength + 1)

-- | Fill slot @s@ with the boxes of run @r@, unless it contains them already.
load :: BoundingBoxCache s -> Int -> Int -> ST s ()
load BoundingBoxCache {chain, margin, grid, slots, held} !s !r = do
  r' <- readPrimArray held s
  when (r' /= r) $ do
    writePrimArray held s r
    fill chain margin grid slots s r
{-# INLINE load #-}

-- | The grid over the box with the lower left corner (@lx@, @ly@) and the upper right corner
-- (@hx@, @hy@), in mm. The coordinates of this box in steps are far above 0, so that rounding does
-- not make any coordinate negative.
gridOf :: Double -> Double -> Double -> Double -> Grid
gridOf lx ly hx hy = Grid {halfSteps, addX = addend lx, addY = addend ly}
  where
    addend least = 134217728 - halfSteps * least
    halfSteps = if w > 0 then 268435456 / w else 0
    w = if hx - lx > hy - ly then hx - lx else hy - ly

-- | The word of a box's lower corner, or of its upper corner, from @x@ and @y@ in steps of the
-- grid. Both corners are rounded outwards, so that the box does not become smaller.
lowerCorner, upperCorner :: Double -> Double -> Int
lowerCorner x y = truncate x .|. truncate y `unsafeShiftL` 32
upperCorner x y = truncate (x + 2147483649) .|. truncate (y + 2147483649) `unsafeShiftL` 32
{-# INLINE lowerCorner #-}
{-# INLINE upperCorner #-}

-- | Write the corners of the boxes of run @r@ into slot @s@. A vertex at which no segment starts
-- gets a box that overlaps no other box.
fill :: ClosedPolyarcs -> Double -> Grid -> Slots s -> Int -> Int -> ST s ()
fill c m Grid {halfSteps, addX, addY} (Slots !lows !highs) !s !r =
  go (runLength * s) begin (stepsX begin) (stepsY begin)
  where
    !begin = runLength * r
    !e = min (begin + runLength) (sizeofPrimArray (ClosedPolyarcs.xs c) - 1)
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
        if isSegment c i
          then put k (lowerCorner (cx - wx) (cy - wy)) (upperCorner (cx + wx) (cy + wy))
          else none k
        go (k + 1) (i + 1) x' y'
    -- Fills the slot from box @k@ on with boxes that overlap no other box. Only the last run needs
    -- this, since it may have fewer than eight vertices. The last vertex of all is not counted,
    -- because no segment starts there.
    rest !k
      | k >= runLength * s + runLength = pure ()
      | otherwise = none k >> rest (k + 1)
    none k = put k 0x7fffffff7fffffff (-0x7fffffff80000000)
    put !k !low !high = do
      writePrimArray lows k low
      writePrimArray highs k high
{-# NOINLINE fill #-}

-- Queries -----------------------------------------------------------------------------------

-- | The set of the boxes of slot @s@ that overlap a given box. The given box has the lower left
-- corner (@lx@, @ly@) and the upper right corner (@hx@, @hy@), in mm. Bit @i@ means box @i@ of the
-- slot.
overlappingBox :: BoundingBoxCache s -> Int -> Double -> Double -> Double -> Double -> ST s Int
overlappingBox BoundingBoxCache {grid, slots} !s !lx !ly !hx !hy = do
  against slots s (lowerCorner (stepX lx) (stepY ly)) (upperCorner (stepX hx) (stepY hy))
  found slots
  where
    stepX x = 2 * (x * halfSteps grid + addX grid)
    stepY y = 2 * (y * halfSteps grid + addY grid)
{-# INLINE overlappingBox #-}

-- | The set of overlapping pairs of boxes in slot @s@. Bit @8·i + j@ means the pair of boxes @i@
-- and @j@ of the slot, with @i < j@.
overlappingPairs :: BoundingBoxCache s -> Int -> ST s Int
overlappingPairs BoundingBoxCache {slots} !s = amongThem slots s >> found slots
{-# INLINE overlappingPairs #-}

-- | The set of overlapping pairs of a box of slot @s@ and a box of slot @other@. Of slot @s@, only
-- the boxes in the set @some@ are tested. Bit @8·i + j@ means box @i@ of slot @s@ and box @j@ of
-- slot @other@.
overlappingBetween :: BoundingBoxCache s -> Int -> Int -> Int -> ST s Int
overlappingBetween BoundingBoxCache {slots} !s !some !other =
  between slots s some other >> found slots
{-# INLINE overlappingBetween #-}

-- | The answer of the last query, a set of boxes or pairs as bits.
found :: Slots s -> ST s Int
found (Slots lows _) = readPrimArray lows answer
{-# INLINE found #-}

-- | True when the boxes with the indices @p@ and @q@ in the cache overlap by at least three steps
-- of the grid. Then they also overlap without the rounding to the grid. If it is false, the caller
-- compares the boxes with 'boxesOverlap'.
clearlyOverlap :: BoundingBoxCache s -> Int -> Int -> ST s Bool
clearlyOverlap BoundingBoxCache {slots = Slots lows highs} !p !q = do
  low <- readPrimArray lows p
  high <- readPrimArray highs p
  hit <- touches lows highs q (low + apart) (high - apart)
  pure (hit /= 0)
  where
    apart = 0x0000000300000003
{-# INLINE clearlyOverlap #-}

-- | True when the boxes of the segments @i@ and @j@, enlarged by the margin @m@ in mm, overlap.
-- Rounding errors are a few units in the last place, far less than the margin. All coordinates in
-- the computation are doubled, which saves the halving of sums.
boxesOverlap :: Double -> ClosedPolyarcs -> Int -> Int -> Bool
boxesOverlap !m !c !i !j =
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
{-# NOINLINE boxesOverlap #-}

-- | 1 when the box with the index @k@ in the cache overlaps the box with the corner words @low@ and
-- @high@, else 0. The function has no branch.
touches :: MutablePrimArray s Int -> MutablePrimArray s Int -> Int -> Int -> Int -> ST s Int
touches lows highs !k !low !high = do
  low' <- readPrimArray lows k
  high' <- readPrimArray highs k
  let !both = (high - low') .&. (high' - low)
  pure $! (both `shiftRL` 63) .&. (both `shiftRL` 31)
{-# INLINE touches #-}

-- | The first number, as a word of bits, shifted to the right by the second number; zeros enter on
-- the left.
shiftRL :: Int -> Int -> Int
shiftRL (I# a) (I# k) = I# (uncheckedIShiftRL# a k)
{-# INLINE shiftRL #-}

-- | Compute the answer of 'overlappingBox' for slot @s@ and the box with the corner words @low@ and
-- @high@. Write it into the array of lower corners, at the index 'answer'.
against :: Slots s -> Int -> Int -> Int -> ST s ()
against (Slots !lows !highs) !s !low !high = go (begin + runLength - 1) 0
  where
    !begin = runLength * s
    go !k !set
      | k < begin = writePrimArray lows answer set
      | otherwise = do
        hit <- touches lows highs k low high
        go (k - 1) (set + set + hit)
{-# NOINLINE against #-}

-- | Compute the answer of 'overlappingPairs' for slot @s@. Write it into the array of lower
-- corners, at the index 'answer'.
amongThem :: Slots s -> Int -> ST s ()
amongThem (Slots !lows !highs) !s = first (runLength * s + runLength - 2) 0
  where
    -- The loop uses few variables, so that all stay in registers. Slots start at multiples of 8. So
    -- the lowest three bits of a box's index in the cache are its index in the slot, from 0 to 7.
    first !k !set = do
      low <- readPrimArray lows k
      high <- readPrimArray highs k
      let second !q !hits
            | q > k = do
              hit <- touches lows highs q low high
              second (q - 1) (hits + hits + hit)
            | k .&. (runLength - 1) == 0 =
              writePrimArray lows answer (set `unsafeShiftL` runLength + hits + hits)
            | otherwise =
              first
                (k - 1)
                (set `unsafeShiftL` runLength + hits `unsafeShiftL` ((k .&. (runLength - 1)) + 1))
      second (k .|. (runLength - 1)) 0
{-# NOINLINE amongThem #-}

-- | Compute the answer of 'overlappingBetween' for the slots @s@ and @other@, and for the boxes of
-- slot @s@ in the set @some@. Write it into the array of lower corners, at the index 'answer'.
between :: Slots s -> Int -> Int -> Int -> ST s ()
between (Slots !lows !highs) !s !some !other = first some 0
  where
    !begin = runLength * other
    !end = begin + runLength - 1
    first !left !set
      | left == 0 = writePrimArray lows answer set
      | otherwise = do
        let !i = countTrailingZeros left
            !k = runLength * s + i
        low <- readPrimArray lows k
        high <- readPrimArray highs k
        let second !q !hits
              | q < begin =
                first (left .&. (left - 1)) (set .|. hits `unsafeShiftL` (runLength * i))
              | otherwise = do
                hit <- touches lows highs q low high
                second (q - 1) (hits + hits + hit)
        second end 0
{-# NOINLINE between #-}
