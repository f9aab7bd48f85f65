{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Closed walks of lines and arcs as the kernel works on them: one after the other in the same
-- flat arrays, each with its first vertex once more behind its last, so that every segment ends at
-- the next vertex. An arc turns by half a circle at most.
--
-- Arcs are handled by their chord and bulge alone. The power of a point @p@ with respect to the
-- circle of an arc from @a@ to @b@ is @(p − a)·(p − b) + κ·(b − a)×(p − a)@ with @κ = (β² − 1)/2β@,
-- which keeps its digits for arcs that are nearly straight, where a centre would lose them.
module Geometry.ClosedPolyarcs
  ( ClosedPolyarcs (..),
    fromOutlines,
    twoSided,
    walks,
    first,
    behind,
    extent,
    only,
    closed,
    apart,

    -- * Marks of segments
    smooth,
    copied,
    around,
    connecting,
    opening,
    closing,
    marked,

    -- * Segments
    chord,
    power,
    gradient,
    diameter,
    curvature,
    part,
  )
where

import Control.Monad (when)
import Control.Monad.ST (ST, runST)
import Data.Bits ((.&.))
import Data.Int (Int32)
import Data.Primitive.PrimArray
import Data.Primitive.Types (Prim)
import Data.Word (Word8)
import Geometry.FlatPolyarc (FlatPolyarc (FlatPolyarc))
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..))

data ClosedPolyarcs = ClosedPolyarcs
  { -- | where segments begin, in mm
    xs :: PrimArray Double,
    ys :: PrimArray Double,
    -- | @tan(sweep/4)@; at most 1 in size
    bulges :: PrimArray Double,
    marks :: PrimArray Word8,
    -- | the number of the segment that it stems from
    sources :: PrimArray Int32,
    -- | where the walks begin, and where one more would
    heads :: PrimArray Int
  }

-- | How many walks there are.
walks :: ClosedPolyarcs -> Int
walks c = sizeofPrimArray (heads c) - 1

-- | The first vertex of a walk.
first :: ClosedPolyarcs -> Int -> Int
first c = indexPrimArray (heads c)
{-# INLINE first #-}

-- | The vertex behind a walk's last segment: the copy of its first.
behind :: ClosedPolyarcs -> Int -> Int
behind c w = indexPrimArray (heads c) (w + 1) - 1
{-# INLINE behind #-}

-- | The segment begins where the one before ends, and with its tangent.
smooth :: Word8
smooth = 1

-- | No segment: the copy of the first vertex.
copied :: Word8
copied = 2

-- | Goes round a corner.
around :: Word8
around = 4

-- | Leads from the end of one segment over a corner of the source to the next.
connecting :: Word8
connecting = 8

-- | The first segment of a walk …
opening :: Word8
opening = 16

-- | … and its last.
closing :: Word8
closing = 32

marked :: Word8 -> Word8 -> Bool
marked m w = w .&. m /= 0
{-# INLINE marked #-}

-- | The chain of closed outlines. Arcs over half a turn become two; segments shorter than a
-- tolerance in mm are left out, and arcs that rise by no more over their chords are lines. Segments
-- are numbered through all outlines.
fromOutlines :: Double -> [FlatPolyarc] -> ClosedPolyarcs
fromOutlines tolerance outlines = runST $ do
  let room = sum (map most outlines)
  rx <- newPrimArray room
  ry <- newPrimArray room
  rb <- newPrimArray room
  rm <- newPrimArray room
  rs <- newPrimArray room
  rh <- newPrimArray (length outlines + 1)
  let emit !k !x !y !b !source = do
        writePrimArray rx k x
        writePrimArray ry k y
        writePrimArray rb k b
        writePrimArray rm k 0
        writePrimArray rs k (fromIntegral (source :: Int) :: Int32)
      walk !w !k !base rest = case rest of
        [] -> writePrimArray rh w k >> pure (w, k)
        FlatPolyarc _ px py pb : more -> do
          let n = sizeofPrimArray px
              -- The place from which the next segment begins is the end of the last one that was
              -- long enough.
              go !i !k' !x !y
                | i >= n = pure k'
                | otherwise = do
                  let j = if i + 1 == n then 0 else i + 1
                      x1 = indexPrimArray px j
                      y1 = indexPrimArray py j
                      dx = x1 - x
                      dy = y1 - y
                      c2 = dx * dx + dy * dy
                      b = indexPrimArray pb i
                      rise2 = b * b * c2 / 4
                  if c2 <= tolerance * tolerance && rise2 <= tolerance * tolerance
                    then go (i + 1) k' x y
                    else do
                      if abs b > 1
                        then do
                          -- The highest point of an arc lies to the right of its chord when it goes
                          -- counter-clockwise.
                          let half = b / (1 + sqrt (1 + b * b))
                          emit k' x y half (base + i)
                          emit
                            (k' + 1)
                            (x + 0.5 * (dx + b * dy))
                            (y + 0.5 * (dy - b * dx))
                            half
                            (base + i)
                          go (i + 1) (k' + 2) x1 y1
                        else do
                          emit k' x y (if rise2 <= tolerance * tolerance then 0 else b) (base + i)
                          go (i + 1) (k' + 1) x1 y1
              -- Most outlines are taken as they are.
              asIs = do
                copyPrimArray rx k px 0 n
                copyPrimArray ry k py 0 n
                copyPrimArray rb k pb 0 n
                setPrimArray rm k n 0
                number 0
                pure (k + n)
              number !i
                | i >= n = pure ()
                | otherwise = writePrimArray rs (k + i) (fromIntegral (base + i)) >> number (i + 1)
          k1 <-
            if n == 0
              then pure k
              else
                if isPlain tolerance px py pb
                  then asIs
                  else go 0 k (indexPrimArray px 0) (indexPrimArray py 0)
          if k1 - k < 2
            then walk w k (base + n) more
            else do
              x <- readPrimArray rx k
              y <- readPrimArray ry k
              emit k1 x y 0 (base + n)
              writePrimArray rm k opening
              writePrimArray rm (k1 - 1) closing
              writePrimArray rm k1 copied
              writePrimArray rh w k
              walk (w + 1) (k1 + 1) (base + n) more
  (count, used) <- walk 0 0 0 outlines
  when (count == 0) (writePrimArray rh 0 0)
  finish rx ry rb rm rs rh used count
  where
    -- The most that an outline may take: an arc over half a turn counts twice.
    most o =
      foldlPrimArray'
        (\m b -> if abs b > 1 then m + 1 else m)
        (sizeofPrimArray (FlatPolyarc.bulges o) + 1)
        (FlatPolyarc.bulges o)

-- | Whether no segment is shorter than a tolerance, no arc flatter, and none over half a turn.
isPlain :: Double -> PrimArray Double -> PrimArray Double -> PrimArray Double -> Bool
isPlain !tolerance !px !py !pb =
  go 0 (indexPrimArray px (n - 1)) (indexPrimArray py (n - 1)) (indexPrimArray pb (n - 1))
  where
    !n = sizeofPrimArray px
    !least = tolerance * tolerance
    -- The segment that ends at a vertex.
    go !i !x !y !b
      | i >= n = True
      | otherwise =
        let !x1 = indexPrimArray px i
            !y1 = indexPrimArray py i
            !c2 = (x1 - x) * (x1 - x) + (y1 - y) * (y1 - y)
         in c2 > least
              && (b == 0 || abs b <= 1 && b * b * c2 / 4 > least)
              && go (i + 1) x1 y1 (indexPrimArray pb i)

-- | The arrays cut to what is used of them.
finish ::
  MutablePrimArray s Double ->
  MutablePrimArray s Double ->
  MutablePrimArray s Double ->
  MutablePrimArray s Word8 ->
  MutablePrimArray s Int32 ->
  MutablePrimArray s Int ->
  Int ->
  Int ->
  ST s ClosedPolyarcs
finish rx ry rb rm rs rh used count = do
  shrinkMutablePrimArray rx used
  shrinkMutablePrimArray ry used
  shrinkMutablePrimArray rb used
  shrinkMutablePrimArray rm used
  shrinkMutablePrimArray rs used
  shrinkMutablePrimArray rh (count + 1)
  ClosedPolyarcs
    <$> unsafeFreezePrimArray rx
      <*> unsafeFreezePrimArray ry
      <*> unsafeFreezePrimArray rb
      <*> unsafeFreezePrimArray rm
      <*> unsafeFreezePrimArray rs
      <*> unsafeFreezePrimArray rh

-- | An open outline there and back, as a closed one. Its segments keep their numbers on the way
-- there; on the way back, the one that was last of @n@ has the number @n@.
twoSided :: FlatPolyarc -> FlatPolyarc
twoSided o@(FlatPolyarc _ px py pb) =
  FlatPolyarc
    Closed
    (joined px (FlatPolyarc.xs back))
    (joined py (FlatPolyarc.ys back))
    (joined pb (FlatPolyarc.bulges back))
  where
    n = FlatPolyarc.size o
    back = FlatPolyarc.reverse o
    joined a b =
      generatePrimArray
        (2 * n)
        (\i -> if i < n then indexPrimArray a i else indexPrimArray b (i - n))

-- | The largest coordinate in size: what rounding is measured by.
extent :: [FlatPolyarc] -> Double
extent = foldl (\m o -> largest (largest m (FlatPolyarc.xs o)) (FlatPolyarc.ys o)) 0
  where
    largest = foldlPrimArray' (\m a -> if abs a > m then abs a else m)

-- | Some of the walks.
only :: [Int] -> ClosedPolyarcs -> ClosedPolyarcs
only ws c =
  ClosedPolyarcs
    { xs = gathered (xs c),
      ys = gathered (ys c),
      bulges = gathered (bulges c),
      marks = gathered (marks c),
      sources = gathered (sources c),
      heads = primArrayFromList (scanl (+) 0 (map size ws))
    }
  where
    size w = behind c w + 1 - first c w
    gathered :: Prim a => PrimArray a -> PrimArray a
    gathered a = mconcat [clonePrimArray a (first c w) (size w) | w <- ws]

-- | A walk as an outline.
closed :: ClosedPolyarcs -> Int -> FlatPolyarc
closed c w = FlatPolyarc Closed (cut (xs c)) (cut (ys c)) (cut (bulges c))
  where
    cut a = clonePrimArray a (first c w) (behind c w - first c w)

-- | Segments that do not hang together, from x, y to x, y with a bulge: the first has the number 0,
-- the next one 2, and so on.
apart :: [(Double, Double, Double, Double, Double)] -> ClosedPolyarcs
apart ss =
  ClosedPolyarcs
    { xs = primArrayFromList (concat [[x, x'] | (x, _, x', _, _) <- ss]),
      ys = primArrayFromList (concat [[y, y'] | (_, y, _, y', _) <- ss]),
      bulges = primArrayFromList (concat [[b, 0] | (_, _, _, _, b) <- ss]),
      marks = primArrayFromList (concat [[opening + closing, copied] | _ <- ss]),
      sources = primArrayFromList (concat (zipWith (\k _ -> [k, k]) [0 ..] ss)),
      heads = primArrayFromList [2 * k | k <- [0 .. length ss]]
    }

-- | The vector from the beginning of a segment to its end.
chord :: ClosedPolyarcs -> Int -> (Double -> Double -> r) -> r
chord c i k =
  let x0 = indexPrimArray (xs c) i
      y0 = indexPrimArray (ys c) i
   in k (indexPrimArray (xs c) (i + 1) - x0) (indexPrimArray (ys c) (i + 1) - y0)
{-# INLINE chord #-}

-- | The power of a point with respect to an arc's circle: the square of its distance from the
-- centre less that of the radius. In mm².
power :: ClosedPolyarcs -> Int -> Double -> Double -> Double
power c i px py = ax * bx + ay * by + (b * b - 1) / (2 * b) * ((x1 - x0) * ay - (y1 - y0) * ax)
  where
    x0 = indexPrimArray (xs c) i
    y0 = indexPrimArray (ys c) i
    x1 = indexPrimArray (xs c) (i + 1)
    y1 = indexPrimArray (ys c) (i + 1)
    b = indexPrimArray (bulges c) i
    ax = px - x0
    ay = py - y0
    bx = px - x1
    by = py - y1
{-# INLINE power #-}

-- | How the power grows at a point: twice the vector from the centre.
gradient :: ClosedPolyarcs -> Int -> Double -> Double -> (Double -> Double -> r) -> r
gradient c i px py k =
  k (px - x0 + px - x1 - kappa * (y1 - y0)) (py - y0 + py - y1 + kappa * (x1 - x0))
  where
    x0 = indexPrimArray (xs c) i
    y0 = indexPrimArray (ys c) i
    x1 = indexPrimArray (xs c) (i + 1)
    y1 = indexPrimArray (ys c) (i + 1)
    b = indexPrimArray (bulges c) i
    kappa = (b * b - 1) / (2 * b)
{-# INLINE gradient #-}

-- | The curvature of a segment, to the left, in 1/mm: with a chord c and a bulge b it is @4·b / ((1
-- + b²)·c)@.
curvature :: ClosedPolyarcs -> Int -> Double
curvature c i =
  chord c i $ \dx dy ->
    let b =
          indexPrimArray (bulges c) i
     in 4 * b / ((1 + b * b) * sqrt (dx * dx + dy * dy))
{-# INLINE curvature #-}

-- | The diameter of an arc's circle.
diameter :: ClosedPolyarcs -> Int -> Double
diameter c i =
  chord c i $ \dx dy ->
    let b =
          indexPrimArray (bulges c) i
     in sqrt (dx * dx + dy * dy) * (1 + b * b) / (2 * abs b)
{-# INLINE diameter #-}

-- | The bulge of the part of a segment between two points on it: for an arc about a centre from
-- which they are seen at
-- @a@ and @b@, @tan(θ/2)@ is @|a×b| / (|a||b| + a·b)@, or @(|a||b| − a·b) / |a×b|@, which keeps its
--  digits up to half a turn;
-- and @tan(θ/4) = p / (q + √(p² + q²))@ when @tan(θ/2) = p/q@.
part :: ClosedPolyarcs -> Int -> Double -> Double -> Double -> Double -> Double
part c i px py qx qy
  | b == 0 = 0
  | otherwise = gradient c i px py $ \ax ay -> gradient c i qx qy $ \cx cy ->
    let cross = abs (ax * cy - ay * cx)
        dot = ax * cx + ay * cy
        product' = sqrt ((ax * ax + ay * ay) * (cx * cx + cy * cy))
        t
          | dot < 0 = quarter (product' - dot) cross
          | otherwise = quarter cross (product' + dot)
     in if b > 0 then t else -t
  where
    b = indexPrimArray (bulges c) i
    quarter p q = p / (q + sqrt (p * p + q * q))
