{-# LANGUAGE BangPatterns #-}
{-# LANGUAGE MagicHash #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | Boxes around segments in the order of the walk: a box round each run of eight consecutive ones, one round eight such
-- boxes, and so on. A walk's own order is a good order in the plane, so nothing is sorted. Single segments have their boxes
-- computed when they are asked for, which costs less than to keep them.
--
-- A run that goes forward in some direction all along its way does not meet itself. So every box knows in which of eight
-- directions all that it holds goes forward.
module Geometry.Offset.Boxes
  ( Boxes,
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
import Data.Bits (shiftL, shiftR, (.&.), (.|.))
import Data.Primitive.PrimArray
import Data.Word (Word8)
import GHC.Exts (Double (D#), Int (I#), (>=##))
import Geometry.Offset.Chain (Chain)
import Geometry.Offset.Chain qualified as Chain

-- | The chain and the margin of its boxes in mm. Of the boxes, level after level: least x, least y, largest x, largest y; the
-- directions; and where each level begins and how many boxes it has.
data Boxes = Boxes {chain :: Chain, margin :: Double, sides :: PrimArray Double, ways :: PrimArray Word8, begins :: PrimArray Int, counts :: PrimArray Int, highest :: Int}

-- | So many segments, or boxes, are in a box.
fan :: Int
fan = 8

-- | The box of a segment: least x, least y, largest x, largest y.
leaf :: Boxes -> Int -> (Double -> Double -> Double -> Double -> r) -> r
leaf bs i k = segmentBox (chain bs) i (\lx ly hx hy -> k (lx - m) (ly - m) (hx + m) (hy + m))
  where
    m = margin bs
{-# INLINE leaf #-}

-- | The box of a segment without a margin. An arc of half a turn or less lies in the parallelogram over its chord that its
-- highest point touches.
segmentBox :: Chain -> Int -> (Double -> Double -> Double -> Double -> r) -> r
segmentBox c i k = k lx ly hx hy
  where
    !x0 = indexPrimArray (Chain.xs c) i
    !y0 = indexPrimArray (Chain.ys c) i
    !x1 = indexPrimArray (Chain.xs c) (i + 1)
    !y1 = indexPrimArray (Chain.ys c) (i + 1)
    !b = indexPrimArray (Chain.bulges c) i
    !ox = 0.5 * b * (y1 - y0)
    !oy = 0.5 * b * (x0 - x1)
    !lx = least x0 x1 + least 0 ox
    !ly = least y0 y1 + least 0 oy
    !hx = most x0 x1 + most 0 ox
    !hy = most y0 y1 + most 0 oy
{-# INLINE segmentBox #-}

-- | The same with a margin, twice as large in all its numbers, and without a branch, from middle and width: good to a few
-- units in the last place, which are much less than the margins of 'pairs'.
twiceBox :: Double -> Chain -> Int -> (Double -> Double -> Double -> Double -> r) -> r
twiceBox !m c i k = k (cx - wx) (cy - wy) (cx + wx) (cy + wy)
  where
    !x0 = indexPrimArray (Chain.xs c) i
    !y0 = indexPrimArray (Chain.ys c) i
    !x1 = indexPrimArray (Chain.xs c) (i + 1)
    !y1 = indexPrimArray (Chain.ys c) (i + 1)
    !b = 0.5 * indexPrimArray (Chain.bulges c) i
    !dx = x1 - x0
    !dy = y1 - y0
    !ox = b * dy
    !oy = b * dx
    !cx = x0 + x1 + ox
    !cy = y0 + y1 - oy
    !wx = abs dx + abs ox + 2 * m
    !wy = abs dy + abs oy + 2 * m
{-# INLINE twiceBox #-}

-- | 1 where the first number is no smaller, 0 else, without a branch.
reaches :: Double -> Double -> Int
reaches (D# a) (D# b) = I# (a >=## b)
{-# INLINE reaches #-}

-- | Whether there is a segment of this number, and not the copy of a first vertex.
present :: Chain -> Int -> Bool
present c i = not (Chain.marked Chain.copied (indexPrimArray (Chain.marks c) i))
{-# INLINE present #-}

-- | The box of the run of eight to which a segment belongs.
run :: Boxes -> Int -> (Double -> Double -> Double -> Double -> r) -> r
run bs i = boxAt (sides bs) (i `shiftR` 3)
{-# INLINE run #-}

-- | The segment that begins the next run.
behind :: Int -> Int
behind i = (i `shiftR` 3 + 1) `shiftL` 3
{-# INLINE behind #-}

-- | The box of everything.
whole :: Boxes -> (Double -> Double -> Double -> Double -> r) -> r
whole bs = boxAt (sides bs) (indexPrimArray (begins bs) (highest bs))

boxAt :: PrimArray Double -> Int -> (Double -> Double -> Double -> Double -> r) -> r
boxAt a k next = next (indexPrimArray a (4 * k)) (indexPrimArray a (4 * k + 1)) (indexPrimArray a (4 * k + 2)) (indexPrimArray a (4 * k + 3))
{-# INLINE boxAt #-}

-- | The boxes of a chain, each wider by a margin in mm on every side.
boxes :: Double -> Chain -> Boxes
boxes !m !c = runST $ do
  let n = sizeofPrimArray (Chain.xs c)
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
              x = indexPrimArray (Chain.xs c) a
              y = indexPrimArray (Chain.ys c) a
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
                          gather (i + 1) (least lx a) (least ly b) (most hx a') (most hy b') (w .&. fromIntegral w')
                  gather (o + fan * k) far far (-far) (-far) everyWay
                  node (k + 1)
          node 0
          up (o + count) count'
  when (n == 0) $ put 0 far far (-far) (-far) 0
  runs 0
  up 0 lowest
  Boxes c m <$> unsafeFreezePrimArray cs <*> unsafeFreezePrimArray ws <*> pure (primArrayFromList (scanl (+) 0 levels)) <*> pure (primArrayFromList levels) <*> pure (length levels - 1)
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
runBox :: Chain -> Int -> Int -> Double -> Double -> Double -> Double -> (Double -> Double -> Double -> Double -> r) -> r
runBox c a e lx0 ly0 hx0 hy0 k = go a lx0 ly0 hx0 hy0
  where
    go !i !lx !ly !hx !hy
      | i >= e = k lx ly hx hy
      | b == 0 = go (i + 1) (least lx x) (least ly y) (most hx x) (most hy y)
      | otherwise = segmentBox c i (\px py qx qy -> go (i + 1) (least lx px) (least ly py) (most hx qx) (most hy qy))
      where
        b = indexPrimArray (Chain.bulges c) i
        x = indexPrimArray (Chain.xs c) (i + 1)
        y = indexPrimArray (Chain.ys c) (i + 1)
{-# INLINE runBox #-}

-- | Of eight directions those in which all segments from one to before another one go forward, of the two that are next to
-- the way from the first vertex to the last. As a set of bits. Each segment goes forward by so much more than the margin
-- that those before and behind it cannot meet.
headings :: Double -> Chain -> Int -> Int -> Int
headings !m !c !a !e = go a (2 * enough) (2 * enough)
  where
    !ux = indexPrimArray (Chain.xs c) e - indexPrimArray (Chain.xs c) a
    !uy = indexPrimArray (Chain.ys c) e - indexPrimArray (Chain.ys c) a
    -- The nearest diagonal, and the nearest axis.
    !sx = if ux > 0 then 1 else -1
    !sy = if uy > 0 then 1 else -1
    !level = abs ux > abs uy
    !ax = if level then sx else 0
    !ay = if level then 0 else sy
    !enough = 32 * m
    go !i !axis !diagonal
      | axis <= enough && diagonal <= enough = 0
      | i >= e = (if axis > enough then axisBit else 0) .|. (if diagonal > enough then diagonalBit else 0)
      | Chain.marked Chain.copied (indexPrimArray (Chain.marks c) i) = 0
      | b == 0 = Chain.chord c i $ \dx dy -> go (i + 1) (least axis (ax * dx + ay * dy)) (least diagonal (sx * dx + sy * dy))
      | otherwise = Chain.chord c i $ \dx dy ->
        -- The directions at both ends of an arc, as long as the chord or longer, on either side of it.
        let co = 1 - b * b
            si = 2 * b
            forward px py = co * (px * dx + py * dy) - abs (si * (px * dy - py * dx))
         in go (i + 1) (least axis (forward ax ay)) (least diagonal (forward sx sy))
      where
        b = indexPrimArray (Chain.bulges c) i
    axisBit
      | level = if ux > 0 then 1 else 2
      | otherwise = if uy > 0 then 4 else 8
    diagonalBit
      | ux > 0 = if uy > 0 then 16 else 32
      | otherwise = if uy > 0 then 64 else 128

everyWay :: Int
everyWay = 255

-- | Visit every two segments whose boxes overlap and that may meet, the earlier one first, as long as the test allows.
pairs :: Boxes -> ST s Bool -> (Int -> Int -> ST s ()) -> ST s ()
pairs Boxes {chain = c, margin = m, sides, ways, begins, counts, highest} goesOn visit = do
  -- Twice the boxes of the segments of some runs, each run in the slot of its number's last digit or in a spare one; and
  -- the runs.
  near <- newPrimArray (4 * fan * (fan + 1))
  held <- newPrimArray (fan + 1)
  setPrimArray held 0 (fan + 1) (-1)
  let n = sizeofPrimArray (Chain.xs c)
      -- What is in a box of a level, and in two different boxes of one.
      within !l !a
        | way (at l + a) /= 0 = pure ()
        | l == 0 = load (slot a) a >> inRun (fan * a) (begin (slot a)) (begin (slot a) + 4 * fan)
        | otherwise = do
          more <- goesOn
          when more (among (l - 1) a)
      between !l !a !b
        | b == a + 1 && way (at l + a) .&. way (at l + b) /= 0 = pure ()
        | l == 0 = do
          let own = slot a
              other = if own == slot b then fan else slot b
          load own a
          boxAt sides b (\lx ly hx hy -> acrossRuns (fan * a) (begin own) (begin own + 4 * fan) b other (2 * lx) (2 * ly) (2 * hx) (2 * hy))
        | otherwise = boxAt sides (at l + b) (across (l - 1) (fan * a) (min (size (l - 1)) (fan * a + fan)) b)
      -- The boxes of a level that are in one above; those from i to e, and those that are in another one above.
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
          when (overlaps sides (at l + i) lx ly hx hy) $ boxAt sides (at l + i) (follow l i (fan * b) (min (size l) (fan * b + fan)))
          across l (i + 1) e b lx ly hx hy
      follow !l !i !j !e !lx !ly !hx !hy
        | j >= e = pure ()
        | otherwise = when (overlaps sides (at l + j) lx ly hx hy) (between l i j) >> follow l i (j + 1) e lx ly hx hy
      -- Have the boxes of a run's segments in a slot.
      load !s !r = do
        r' <- readPrimArray held s
        when (r' /= r) $ do
          writePrimArray held s r
          fill (begin s) (fan * r) (fan * r + fan)
      fill !k !i !e
        | i >= e = pure ()
        | i < n && present c i = twiceBox m c i (put k) >> fill (k + 4) (i + 1) e
        | otherwise = put k far far (-far) (-far) >> fill (k + 4) (i + 1) e
      put !k !lx !ly !hx !hy = do
        writePrimArray near k lx
        writePrimArray near (k + 1) ly
        writePrimArray near (k + 2) hx
        writePrimArray near (k + 3) hy
      -- The segments of a run among themselves, and those of a run that overlap the box of another one against that one's.
      inRun !i !k !e
        | k >= e = pure ()
        | otherwise = against i k (i + 1) (k + 4) e >> inRun (i + 1) (k + 4) e
      acrossRuns !i !k !e !b !other !lx !ly !hx !hy
        | k >= e = pure ()
        | otherwise = do
          hit <- overlapNear k lx ly hx hy
          when (hit /= 0) $ load other b >> against i k (fan * b) (begin other) (begin other + 4 * fan)
          acrossRuns (i + 1) (k + 4) e b other lx ly hx hy
      -- The segment i, whose box is at p, and the segments from j on, whose boxes are from q to e.
      against !i !p !j !q !e = do
        lx <- readPrimArray near p
        ly <- readPrimArray near (p + 1)
        hx <- readPrimArray near (p + 2)
        hy <- readPrimArray near (p + 3)
        let go !k
              | k >= e = pure ()
              | otherwise = do
                hit <- overlapNear k lx ly hx hy
                when (hit /= 0) $ visit i (j + (k - q) `shiftR` 2)
                go (k + 4)
        go q
      overlapNear !k !lx !ly !hx !hy = do
        a <- readPrimArray near k
        b <- readPrimArray near (k + 1)
        a' <- readPrimArray near (k + 2)
        b' <- readPrimArray near (k + 3)
        pure $! overlap a b a' b' lx ly hx hy
      {-# INLINE overlapNear #-}
  within highest 0
  where
    at l = indexPrimArray begins l
    size l = indexPrimArray counts l
    way k = indexPrimArray ways k
    slot r = r .&. (fan - 1)
    begin s = 4 * fan * s
{-# INLINE pairs #-}

-- | Whether a box overlaps another one.
overlaps :: PrimArray Double -> Int -> Double -> Double -> Double -> Double -> Bool
overlaps a k lx ly hx hy = boxAt a k (\px py qx qy -> overlap px py qx qy lx ly hx hy /= 0)
{-# INLINE overlaps #-}

-- | 1 where two boxes overlap, 0 else, without a branch.
overlap :: Double -> Double -> Double -> Double -> Double -> Double -> Double -> Double -> Int
overlap px py qx qy lx ly hx hy = reaches hx px .&. reaches qx lx .&. reaches hy py .&. reaches qy ly
{-# INLINE overlap #-}

-- | Gather over the segments whose boxes overlap a box, in order.
around :: Boxes -> Double -> Double -> Double -> Double -> a -> (a -> Int -> a) -> a
around Boxes {chain = c, margin = m, sides, begins, counts, highest} lx ly hx hy start f = go highest 0 start
  where
    n = sizeofPrimArray (Chain.xs c)
    go !l !k acc
      | not (overlaps sides (indexPrimArray begins l + k) lx ly hx hy) = acc
      | l == 0 = segments (fan * k) (min n (fan * k + fan)) acc
      | otherwise = children (l - 1) (fan * k) (min (indexPrimArray counts (l - 1)) (fan * k + fan)) acc
    children !l !k !e acc
      | k >= e = acc
      | otherwise = let acc' = go l k acc in acc' `seq` children l (k + 1) e acc'
    segments !i !e acc
      | i >= e = acc
      | present c i && segmentBox c i (\a b a' b' -> a - m <= hx && lx <= a' + m && b - m <= hy && ly <= b' + m) = let acc' = f acc i in acc' `seq` segments (i + 1) e acc'
      | otherwise = segments (i + 1) e acc
{-# INLINE around #-}
