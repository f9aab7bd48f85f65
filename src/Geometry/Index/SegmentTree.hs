{-# LANGUAGE BangPatterns #-}
{-# LANGUAGE MagicHash #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | Boxes around segments in the order of the walk: a box round each run of eight consecutive ones,
-- one round eight such boxes, and so on. A walk's own order is a good order in the plane, so
-- nothing is sorted. Single segments have their boxes computed when they are asked for, which costs
-- less than to keep them.
--
-- A run that goes forward in some direction all along its way does not meet itself. So every box
-- knows in which of eight directions all that it holds goes forward.
module Geometry.Index.SegmentTree
  ( SegmentTree,
    boxes,
    leaf,
    whole,
    run,
    behind,
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

-- | The chain and the margin of its boxes in mm. Of the boxes, level after level: least x, least y,
-- largest x, largest y; the directions; and where each level begins and how many boxes it has.
data SegmentTree = SegmentTree
  { chain :: ClosedPolyarcs,
    margin :: Double,
    sides :: PrimArray Double,
    ways :: PrimArray Word8,
    begins :: PrimArray Int,
    counts :: PrimArray Int,
    highest :: Int
  }

-- | So many segments, or boxes, are in a box.
fan :: Int
fan = 8

-- | The box of a segment: least x, least y, largest x, largest y.
leaf :: SegmentTree -> Int -> (Double -> Double -> Double -> Double -> r) -> r
leaf bs i k = segmentBox (chain bs) i (\lx ly hx hy -> k (lx - m) (ly - m) (hx + m) (hy + m))
  where
    m = margin bs
{-# INLINE leaf #-}

-- | The box of a segment without a margin. An arc of half a turn or less lies in the parallelogram
-- over its chord that its highest point touches.
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

-- | 1 where the first number is no smaller, 0 else, without a branch.
reaches :: Double -> Double -> Int
reaches (D# a) (D# b) = I# (a >=## b)
{-# INLINE reaches #-}

-- | Whether there is a segment of this number, and not the copy of a first vertex.
present :: ClosedPolyarcs -> Int -> Bool
present c i =
  not (ClosedPolyarcs.marked ClosedPolyarcs.copied (indexPrimArray (ClosedPolyarcs.marks c) i))
{-# INLINE present #-}

-- | The box of the run of eight to which a segment belongs.
run :: SegmentTree -> Int -> (Double -> Double -> Double -> Double -> r) -> r
run bs i = boxAt (sides bs) (i `shiftR` 3)
{-# INLINE run #-}

-- | The segment that begins the next run.
behind :: Int -> Int
behind i = (i `shiftR` 3 + 1) `shiftL` 3
{-# INLINE behind #-}

-- | The box of everything.
whole :: SegmentTree -> (Double -> Double -> Double -> Double -> r) -> r
whole bs = boxAt (sides bs) (indexPrimArray (begins bs) (highest bs))

boxAt :: PrimArray Double -> Int -> (Double -> Double -> Double -> Double -> r) -> r
boxAt a k next =
  next
    (indexPrimArray a (4 * k))
    (indexPrimArray a (4 * k + 1))
    (indexPrimArray a (4 * k + 2))
    (indexPrimArray a (4 * k + 3))
{-# INLINE boxAt #-}

-- | The boxes of a chain, each wider by a margin in mm on every side.
boxes :: Double -> ClosedPolyarcs -> SegmentTree
boxes !m !c = runST $ do
  let n = sizeofPrimArray (ClosedPolyarcs.xs c)
      lowest = max 1 ((n + fan - 1) `quot` fan)
      levels = sizes lowest
      total = sum levels
  cs <- newPrimArray (4 * total)
  ws <- newPrimArray total
  let put !k !lx !ly !hx !hy !w = do
        writePrimArray cs (4 * k) lx
        writePrimArray cs (4 * k + 1) ly
        writePrimArray cs (4 * k + 2) hx
        writePrimArray cs (4 * k + 3) hy
        writePrimArray ws k (fromIntegral (w :: Int))
      runs !k
        | fan * k >= n = pure ()
        | otherwise = do
          let a = fan * k
              e = min (n - 1) (a + fan)
              x = indexPrimArray (ClosedPolyarcs.xs c) a
              y = indexPrimArray (ClosedPolyarcs.ys c) a
              w = if a + fan < n then headings m c a e else 0
          runBox c a e x y x y $ \lx ly hx hy -> put k (lx - m) (ly - m) (hx + m) (hy + m) w
          runs (k + 1)
      -- From one level, where it begins and how many boxes it has, to the next.
      up !o !count
        | count == 1 = pure ()
        | otherwise = do
          let count' = (count + fan - 1) `quot` fan
              node !k
                | k >= count' = pure ()
                | otherwise = do
                  let e = o + min count (fan * k + fan)
                      gather !i !lx !ly !hx !hy !w
                        | i >= e = put (o + count + k) lx ly hx hy w
                        | otherwise = do
                          a <- readPrimArray cs (4 * i)
                          b <- readPrimArray cs (4 * i + 1)
                          a' <- readPrimArray cs (4 * i + 2)
                          b' <- readPrimArray cs (4 * i + 3)
                          w' <- readPrimArray ws i
                          gather
                            (i + 1)
                            (least lx a)
                            (least ly b)
                            (most hx a')
                            (most hy b')
                            (w .&. fromIntegral w')
                  gather (o + fan * k) far far (-far) (-far) everyWay
                  node (k + 1)
          node 0
          up (o + count) count'
  when (n == 0) $ put 0 far far (-far) (-far) 0
  runs 0
  up 0 lowest
  SegmentTree c m
    <$> unsafeFreezePrimArray cs
      <*> unsafeFreezePrimArray ws
      <*> pure (primArrayFromList (scanl (+) 0 levels))
      <*> pure (primArrayFromList levels)
      <*> pure (length levels - 1)
  where
    sizes count = if count == 1 then [1] else count : sizes ((count + fan - 1) `quot` fan)

far :: Double
far = 1e300

least, most :: Double -> Double -> Double
least a b = if a < b then a else b
most a b = if a > b then a else b
{-# INLINE least #-}
{-# INLINE most #-}

-- | Extend a box over the vertices and arcs of the segments from one to before another one.
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

-- | Of eight directions those in which all segments from one to before another one go forward, of
-- the two that are next to the way from the first vertex to the last. As a set of bits. Each
-- segment goes forward by so much more than the margin that those before and behind it cannot meet.
headings :: Double -> ClosedPolyarcs -> Int -> Int -> Int
headings !m !c !a !e = go a (2 * enough) (2 * enough)
  where
    !ux = indexPrimArray (ClosedPolyarcs.xs c) e - indexPrimArray (ClosedPolyarcs.xs c) a
    !uy = indexPrimArray (ClosedPolyarcs.ys c) e - indexPrimArray (ClosedPolyarcs.ys c) a
    -- The nearest diagonal, and the nearest axis.
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
      | ClosedPolyarcs.marked ClosedPolyarcs.copied (indexPrimArray (ClosedPolyarcs.marks c) i) = 0
      | b == 0 =
        ClosedPolyarcs.chord c i $ \dx dy ->
          go (i + 1) (least axis (ax * dx + ay * dy)) (least diagonal (sx * dx + sy * dy))
      | otherwise = ClosedPolyarcs.chord c i $ \dx dy ->
        -- The directions at both ends of an arc, as long as the chord or longer, on either side of
        -- it.
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

everyWay :: Int
everyWay = 255

-- | Visit every two segments whose boxes overlap and that may meet, the earlier one first, as long
-- as the test allows.
pairs :: SegmentTree -> ST s Bool -> (Int -> Int -> ST s ()) -> ST s ()
pairs bs@SegmentTree {chain = c, margin = m, sides, ways, begins, counts, highest} goesOn visit = do
  -- Of some runs the boxes of the segments, each run in the slot of its number's last digit or in a
  -- spare one; and the runs.
  near <- Near <$> newPrimArray (answer + 1) <*> newPrimArray answer
  held <- newPrimArray (fan + 1)
  setPrimArray held 0 (fan + 1) (-1)
  let !grid = gridOf bs
      -- What is in a box of a level, and in two different boxes of one.
      within !l !a
        | way (at l + a) /= 0 = pure ()
        | l == 0 =
          load (slot a) a >> amongThem near (slot a) >> found near
            >>= visits (fan * a) (fan * slot a) (fan * a) (fan * slot a)
        | otherwise = do
          more <- goesOn
          when more (among (l - 1) a)
      between !l !a !b
        | b == a + 1 && way (at l + a) .&. way (at l + b) /= 0 = pure ()
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
      -- The boxes of a level that are in one above; those from i to e, and those that are in
      -- another one above.
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
      -- Have the boxes of a run's segments in a slot.
      load !s !r = do
        r' <- readPrimArray held s
        when (r' /= r) $ do
          writePrimArray held s r
          fill bs grid near s r
      -- Of the segments of two runs, from those on whose boxes are in these places, the ones that a
      -- set says.
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
    at l = indexPrimArray begins l
    size l = indexPrimArray counts l
    way k = indexPrimArray ways k
    slot r = r .&. (fan - 1)
{-# INLINE pairs #-}

-- | A grid of 2²⁹ steps over the box of everything: half the steps in a mm, and half of what is
-- added to coordinates in steps. Both coordinates of a corner go into one word. The bits above both
-- of them are set in a largest corner: where a least corner is taken from it, those stay that
-- belong to coordinates in which it is no larger.
data Grid = Grid {halfSteps :: Double, addX :: Double, addY :: Double}

-- | Coordinates begin so far above 0 that no rounding takes one below it.
gridOf :: SegmentTree -> Grid
gridOf bs = whole bs $ \lx ly hx hy ->
  let w = most (hx - lx) (hy - ly)
      steps = if w > 0 then 268435456 / w else 0
   in Grid {halfSteps = steps, addX = 134217728 - steps * lx, addY = 134217728 - steps * ly}

-- | A coordinate in steps.
stepX, stepY :: Grid -> Double -> Double
stepX g x = 2 * (x * halfSteps g + addX g)
stepY g y = 2 * (y * halfSteps g + addY g)
{-# INLINE stepX #-}
{-# INLINE stepY #-}

-- | The corners of a box from its sides in steps, rounded away from its middle.
least', largest' :: Double -> Double -> Int
least' x y = truncate x .|. truncate y `unsafeShiftL` 32
largest' x y = truncate (x + 2147483649) .|. truncate (y + 2147483649) `unsafeShiftL` 32
{-# INLINE least' #-}
{-# INLINE largest' #-}

-- | The least and the largest corners of boxes, in slots of eight; behind the least ones a set of
-- them, as bits.
data Near s = Near (MutablePrimArray s Int) (MutablePrimArray s Int)

-- | The set that was found last, and where it is.
found :: Near s -> ST s Int
found (Near lows _) = readPrimArray lows answer
{-# INLINE found #-}

answer :: Int
answer = fan * (fan + 1)

-- | Whether two boxes overlap by more than a step of the grid.
surely :: Near s -> Int -> Int -> ST s Bool
surely (Near lows highs) !p !q = do
  low <- readPrimArray lows p
  high <- readPrimArray highs p
  hit <- touches lows highs q (low + apart) (high - apart)
  pure (hit /= 0)
  where
    apart = 0x0000000300000003
{-# INLINE surely #-}

-- | The same of the boxes of two segments to within rounding: twice the boxes, from middle and
-- width, good to a few units in the last place, which are much less than the margin.
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

-- | Write the corners of the boxes of a run's segments into a slot. What is no segment overlaps
-- nothing.
fill :: SegmentTree -> Grid -> Near s -> Int -> Int -> ST s ()
fill SegmentTree {chain = c, margin = m} Grid {halfSteps, addX, addY} (Near !lows !highs) !s !r =
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
    -- A chain ends with no segment.
    rest !k
      | k >= fan * s + fan = pure ()
      | otherwise = none k >> rest (k + 1)
    none k = put k 0x7fffffff7fffffff (-0x7fffffff80000000)
    put !k !low !high = do
      writePrimArray lows k low
      writePrimArray highs k high
{-# NOINLINE fill #-}

-- | 1 where the box at a place overlaps one that has these corners, 0 else, without a branch.
touches :: MutablePrimArray s Int -> MutablePrimArray s Int -> Int -> Int -> Int -> ST s Int
touches lows highs !k !low !high = do
  low' <- readPrimArray lows k
  high' <- readPrimArray highs k
  let !both = (high - low') .&. (high' - low)
  pure $! (both `shiftRL` 63) .&. (both `shiftRL` 31)
{-# INLINE touches #-}

shiftRL :: Int -> Int -> Int
shiftRL (I# a) (I# k) = I# (uncheckedIShiftRL# a k)
{-# INLINE shiftRL #-}

-- | Which boxes of a slot overlap a box: a bit for each of them.
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

-- | Which two boxes of a slot overlap, as a set of bits: eight times the first one's number and the
-- second one's.
amongThem :: Near s -> Int -> ST s ()
amongThem (Near !lows !highs) !s = first (fan * s + fan - 2) 0
  where
    -- Few numbers are at hand in the loop, so that all of them stay in the processor: slots begin
    -- at multiples of eight.
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

-- | The same of two slots, for some of the boxes of the first one.
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

-- | Whether a box overlaps another one. Without a branch up to the answer.
overlaps :: PrimArray Double -> Int -> Double -> Double -> Double -> Double -> Bool
overlaps a k lx ly hx hy =
  boxAt
    a
    k
    (\px py qx qy -> reaches hx px .&. reaches qx lx .&. reaches hy py .&. reaches qy ly /= 0)
{-# INLINE overlaps #-}

-- | Gather over the segments whose boxes overlap a box, in order.
around :: SegmentTree -> Double -> Double -> Double -> Double -> a -> (a -> Int -> a) -> a
around SegmentTree {chain = c, margin = m, sides, begins, counts, highest} lx ly hx hy start f =
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
