{-# LANGUAGE BangPatterns #-}
{-# LANGUAGE MagicHash #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | A cache of the boxes of single segments, for the pair search of
-- "Geometry.Index.SegmentBoxTree".
--
-- The tree divides the segments into runs of eight. The cache contains the boxes of a few runs,
-- each run in one slot. Their coordinates are whole steps of a grid, so that integer operations
-- without a branch compare two boxes. A query finds the overlapping boxes of one or two slots, as a
-- set of bits.
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

-- | True when a segment starts at the vertex with an index. None starts at the repeated first
-- vertex of a loop.
isSegment :: ClosedPolyarcs -> Int -> Bool
isSegment c i =
  not
    (ClosedPolyarcs.hasMark ClosedPolyarcs.repeatedMark (indexPrimArray (ClosedPolyarcs.marks c) i))
{-# INLINE isSegment #-}

-- The cache ---------------------------------------------------------------------------------

-- | The cache of the boxes of some segments.
data BoundingBoxCache s = BoundingBoxCache
  { chain :: ClosedPolyarcs,
    -- | in mm; every box is enlarged by it
    margin :: Double,
    grid :: Grid,
    slots :: Slots s,
    -- | the run in each slot, or −1
    held :: MutablePrimArray s Int
  }

-- | A grid of 2²⁹ steps over the box of all segments: half the number of steps in 1 mm, and half of
-- the numbers that are added to x and y in steps.
--
-- A corner of a box is one machine word that contains both coordinates in steps. Above each
-- coordinate is one further bit, which is set in upper corners only. When a lower corner is
-- subtracted from an upper one, the bit of a coordinate remains set exactly where the lower
-- coordinate is not the larger one.
data Grid = Grid {halfSteps :: Double, addX :: Double, addY :: Double}

-- | The lower corners of boxes and the upper ones, in slots of eight boxes. After the lower corners
-- comes the answer of the last query: a set of boxes or pairs, as bits.
data Slots s = Slots (MutablePrimArray s Int) (MutablePrimArray s Int)

-- | A cache of no boxes yet: the segments, the margin, and the box around all segments by its least
-- x, least y, largest x and largest y.
new :: ClosedPolyarcs -> Double -> Double -> Double -> Double -> Double -> ST s (BoundingBoxCache s)
new c m lx ly hx hy = do
  slots <- Slots <$> newPrimArray (answer + 1) <*> newPrimArray answer
  held <- newPrimArray (runLength + 1)
  setPrimArray held 0 (runLength + 1) (-1)
  pure BoundingBoxCache {chain = c, margin = m, grid = gridOf lx ly hx hy, slots, held}
{-# INLINE new #-}

-- | The slot into which a run is usually loaded.
slotOf :: Int -> Int
slotOf r = r .&. (runLength - 1)
{-# INLINE slotOf #-}

-- | The slot for a run whose own slot is in use.
spareSlot :: Int
spareSlot = runLength

-- | The index of the answer in the lower corners.
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

-- | The grid over a box. Coordinates are far enough above 0 for rounding not to make one negative.
gridOf :: Double -> Double -> Double -> Double -> Grid
gridOf lx ly hx hy = Grid {halfSteps, addX = addend lx, addY = addend ly}
  where
    addend least = 134217728 - halfSteps * least
    halfSteps = if w > 0 then 268435456 / w else 0
    w = if hx - lx > hy - ly then hx - lx else hy - ly

-- | The word of a lower and of an upper corner, from coordinates in steps. The corners are rounded
-- outwards.
lowerCorner, upperCorner :: Double -> Double -> Int
lowerCorner x y = truncate x .|. truncate y `unsafeShiftL` 32
upperCorner x y = truncate (x + 2147483649) .|. truncate (y + 2147483649) `unsafeShiftL` 32
{-# INLINE lowerCorner #-}
{-# INLINE upperCorner #-}

-- | Write the corners of the boxes of run @r@ into slot @s@. A vertex at which no segment starts
-- gets a box that overlaps no other.
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
    -- No segment starts at the last vertex.
    rest !k
      | k >= runLength * s + runLength = pure ()
      | otherwise = none k >> rest (k + 1)
    none k = put k 0x7fffffff7fffffff (-0x7fffffff80000000)
    put !k !low !high = do
      writePrimArray lows k low
      writePrimArray highs k high
{-# NOINLINE fill #-}

-- Queries -----------------------------------------------------------------------------------

-- | The set of those boxes of slot @s@ that overlap a box, given by its least x, least y, largest x
-- and largest y in mm. Bit @i@ is box @i@ of the slot.
overlappingBox :: BoundingBoxCache s -> Int -> Double -> Double -> Double -> Double -> ST s Int
overlappingBox BoundingBoxCache {grid, slots} !s !lx !ly !hx !hy = do
  against slots s (lowerCorner (stepX lx) (stepY ly)) (upperCorner (stepX hx) (stepY hy))
  found slots
  where
    stepX x = 2 * (x * halfSteps grid + addX grid)
    stepY y = 2 * (y * halfSteps grid + addY grid)
{-# INLINE overlappingBox #-}

-- | The set of overlapping pairs of boxes in slot @s@. Bit @8·i + j@ is the pair of boxes @i@ and
-- @j@ of the slot, with @i < j@.
overlappingPairs :: BoundingBoxCache s -> Int -> ST s Int
overlappingPairs BoundingBoxCache {slots} !s = amongThem slots s >> found slots
{-# INLINE overlappingPairs #-}

-- | The set of overlapping pairs of a box of slot @s@ and one of slot @other@. Of slot @s@, only
-- the boxes in the set @some@ are tested. Bit @8·i + j@ is the pair of boxes @i@ and @j@.
overlappingBetween :: BoundingBoxCache s -> Int -> Int -> Int -> ST s Int
overlappingBetween BoundingBoxCache {slots} !s !some !other =
  between slots s some other >> found slots
{-# INLINE overlappingBetween #-}

-- | The answer of the last query.
found :: Slots s -> ST s Int
found (Slots lows _) = readPrimArray lows answer
{-# INLINE found #-}

-- | True when two boxes overlap by more than the rounding to the grid. Box @i@ of slot @s@ has the
-- index @8·s + i@.
clearlyOverlap :: BoundingBoxCache s -> Int -> Int -> ST s Bool
clearlyOverlap BoundingBoxCache {slots = Slots lows highs} !p !q = do
  low <- readPrimArray lows p
  high <- readPrimArray highs p
  hit <- touches lows highs q (low + apart) (high - apart)
  pure (hit /= 0)
  where
    apart = 0x0000000300000003
{-# INLINE clearlyOverlap #-}

-- | True when the boxes of two segments, enlarged by the margin @m@, overlap. Rounding errors are a
-- few units in the last place, far less than the margin. All coordinates are doubled.
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

-- | Write the answer of 'overlappingBox' for the box with the corners @low@ and @high@.
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

-- | Write the answer of 'overlappingPairs'.
amongThem :: Slots s -> Int -> ST s ()
amongThem (Slots !lows !highs) !s = first (runLength * s + runLength - 2) 0
  where
    -- The loop uses few variables, so that all stay in registers. Slots start at multiples of 8.
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

-- | Write the answer of 'overlappingBetween'.
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
