{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Closed loops of lines and arcs as the offset kernel ("Offset.Kernel") works on them: one after
-- the other in the same flat arrays. After the last segment of a loop its first vertex is repeated,
-- so that every segment ends at the next vertex. No arc sweeps more than a half circle. Loops,
-- vertices and segments have indices from 0; a segment has the index of the vertex at which it
-- starts.
--
-- The loops are made from several "Geometry.FlatPolyarc"s, each of which is normalised: tiny
-- segments are omitted, and flat arcs become lines. Since all loops share one set of arrays, a
-- single bounding-box tree ("Geometry.Index.SegmentBoxTree") covers them.
--
-- Arcs are handled by chord and bulge alone. The power of a point @p@ with respect to the circle of
-- an arc from @a@ to @b@ with the bulge β is @(p − a)·(p − b) + κ·(b − a)×(p − a)@ with
-- @κ = (β² − 1)/2β@. This formula stays exact for an almost straight arc, whose distant centre
-- would lose digits.
--
-- Some functions pass their result to a continuation, a function that is their last argument. So no
-- pair of numbers is built in memory.
module Geometry.ClosedPolyarcs
  ( ClosedPolyarcs (..),
    fromFlatPolyarcs,
    twoSided,
    loopCount,
    firstVertex,
    repeatedVertex,
    largestCoordinate,
    restrictTo,
    toFlatPolyarc,
    fromSeparateSegments,

    -- * Marks of segments
    smoothMark,
    repeatedMark,
    aroundMark,
    connectingMark,
    firstMark,
    lastMark,
    hasMark,

    -- * Segments
    chord,
    power,
    gradient,
    diameter,
    curvature,
    partialBulge,
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

-- | Closed loops. The arrays of vertices are equally long; segment @i@ leads from vertex @i@ to
-- vertex @i + 1@. No segment starts at the repeated first vertex of a loop.
data ClosedPolyarcs = ClosedPolyarcs
  { -- | x of the segments' starts, in mm
    xs :: PrimArray Double,
    -- | y of the segments' starts, in mm
    ys :: PrimArray Double,
    -- | @tan(sweep/4)@ of the segments, in [−1, 1]
    bulges :: PrimArray Double,
    -- | the marks of the segments, a sum of constants such as 'smoothMark'
    marks :: PrimArray Word8,
    -- | the index of the input segment from which each segment comes
    sources :: PrimArray Int32,
    -- | the index of the first vertex of each loop, then the number of all vertices
    loopHeads :: PrimArray Int
  }

-- | The number of loops in the arrays.
loopCount :: ClosedPolyarcs -> Int
loopCount c = sizeofPrimArray (loopHeads c) - 1

-- | The index of the first vertex of a loop, by the index of the loop.
firstVertex :: ClosedPolyarcs -> Int -> Int
firstVertex c = indexPrimArray (loopHeads c)
{-# INLINE firstVertex #-}

-- | The index of the vertex after the last segment of loop @w@: the copy of the loop's first
-- vertex.
repeatedVertex :: ClosedPolyarcs -> Int -> Int
repeatedVertex c w = indexPrimArray (loopHeads c) (w + 1) - 1
{-# INLINE repeatedVertex #-}

-- | The mark of a segment that starts in the direction in which the previous one ends.
smoothMark :: Word8
smoothMark = 1

-- | The mark of a loop's repeated first vertex, at which no segment starts.
repeatedMark :: Word8
repeatedMark = 2

-- | The mark of a raw offset's segment that goes round a vertex of the source contour. At an outer
-- corner such a segment is an arc about the vertex, or one of the two lines of a sharp corner. At a
-- vertex where the distance of the offset changes, it is a line square to the contour.
aroundMark :: Word8
aroundMark = 4

-- | The mark of a raw offset's line at an inner corner of the source contour. It connects the
-- offsets of the corner's two sides: directly, or as one of two lines that meet at the vertex.
connectingMark :: Word8
connectingMark = 8

-- | The mark of the first segment of a loop.
firstMark :: Word8
firstMark = 16

-- | The mark of the last segment of a loop.
lastMark :: Word8
lastMark = 32

-- | True when the marks @w@ of a segment include the mark @m@.
hasMark :: Word8 -> Word8 -> Bool
hasMark m w = w .&. m /= 0
{-# INLINE hasMark #-}

-- Construction ------------------------------------------------------------------------------

-- | The loops of closed polyarcs. An arc that sweeps more than a half circle is divided into two.
-- Segments whose chord and sagitta are at most @tolerance@, in mm, are omitted; other arcs with
-- such a sagitta become lines. A loop of fewer than two segments is omitted. The indices in
-- 'sources' count the segments of all polyarcs from 0, the omitted ones included.
fromFlatPolyarcs :: Double -> [FlatPolyarc] -> ClosedPolyarcs
fromFlatPolyarcs tolerance polyarcs = runST $ do
  let room = sum (map vertexBound polyarcs)
  out <-
    Arrays
      <$> newPrimArray room
      <*> newPrimArray room
      <*> newPrimArray room
      <*> newPrimArray room
      <*> newPrimArray room
      <*> newPrimArray (length polyarcs + 1)
  let fill !loop !k !source rest = case rest of
        [] -> writePrimArray (loopStarts out) loop k >> pure (loop, k)
        polyarc : more -> do
          let source' = source + sizeofPrimArray (FlatPolyarc.xs polyarc)
          k' <- writeSegments tolerance out k source polyarc
          if k' - k < 2
            then fill loop k source' more
            else closeLoop out loop k k' source' >> fill (loop + 1) (k' + 1) source' more
  (count, used) <- fill 0 0 0 polyarcs
  when (count == 0) (writePrimArray (loopStarts out) 0 0)
  freeze out used count

-- | An upper bound of the number of vertices that the loop of a polyarc has: two for each arc that
-- sweeps more than a half circle, one for each other segment, and the repeated first one.
vertexBound :: FlatPolyarc -> Int
vertexBound o =
  foldlPrimArray'
    (\m b -> if abs b > 1 then m + 1 else m)
    (sizeofPrimArray (FlatPolyarc.bulges o) + 1)
    (FlatPolyarc.bulges o)

-- | The arrays of 'ClosedPolyarcs' while they are written, in the same order.
data Arrays s = Arrays
  { vertexXs :: MutablePrimArray s Double,
    vertexYs :: MutablePrimArray s Double,
    vertexBulges :: MutablePrimArray s Double,
    segmentMarks :: MutablePrimArray s Word8,
    segmentSources :: MutablePrimArray s Int32,
    loopStarts :: MutablePrimArray s Int
  }

-- | Writes the vertex with the index @k@: x and y in mm, the bulge @b@ of the segment that starts
-- there, and @source@, the index of the input segment from which that segment comes.
writeVertex :: Arrays s -> Int -> Double -> Double -> Double -> Int -> ST s ()
writeVertex out !k !x !y !b !source = do
  writePrimArray (vertexXs out) k x
  writePrimArray (vertexYs out) k y
  writePrimArray (vertexBulges out) k b
  writePrimArray (segmentMarks out) k 0
  writePrimArray (segmentSources out) k (fromIntegral source)
{-# INLINE writeVertex #-}

-- | Write the normalised segments of a polyarc from vertex @k@ on, and return the index of the next
-- free vertex. The entry of the polyarc's first segment in 'sources' is @source@. Segments whose
-- chord and sagitta are at most @tolerance@, in mm, are omitted.
writeSegments :: Double -> Arrays s -> Int -> Int -> FlatPolyarc -> ST s Int
writeSegments tolerance out k source polyarc@(FlatPolyarc _ px py pb)
  | sizeofPrimArray px == 0 = pure k
  | isNormalised tolerance px py pb = copySegments out k source polyarc
  | otherwise = normaliseSegments tolerance out k source polyarc

-- | 'writeSegments' for a polyarc that is normalised already, as most are.
copySegments :: Arrays s -> Int -> Int -> FlatPolyarc -> ST s Int
copySegments out !k !source (FlatPolyarc _ px py pb) = do
  copyPrimArray (vertexXs out) k px 0 n
  copyPrimArray (vertexYs out) k py 0 n
  copyPrimArray (vertexBulges out) k pb 0 n
  setPrimArray (segmentMarks out) k n 0
  number 0
  pure (k + n)
  where
    n = sizeofPrimArray px
    number !i
      | i >= n = pure ()
      | otherwise =
        writePrimArray (segmentSources out) (k + i) (fromIntegral (source + i)) >> number (i + 1)

-- | 'writeSegments' for a polyarc with tiny segments, flat arcs, or arcs that sweep more than a
-- half circle. The first vertex has the index @start@. Each segment starts at the end of the last
-- segment that was not omitted.
normaliseSegments :: Double -> Arrays s -> Int -> Int -> FlatPolyarc -> ST s Int
normaliseSegments !tolerance out start !source (FlatPolyarc _ px py pb) =
  go 0 start (indexPrimArray px 0) (indexPrimArray py 0)
  where
    !n = sizeofPrimArray px
    !least = tolerance * tolerance
    go !i !k !x !y
      | i >= n = pure k
      | c2 <= least && sagitta2 <= least = go (i + 1) k x y
      | abs b > 1 = do
        -- The arc is cut at the point furthest from its chord. On a counter-clockwise arc this
        -- point lies to the right of the chord.
        let half = b / (1 + sqrt (1 + b * b))
        writeVertex out k x y half (source + i)
        writeVertex
          out
          (k + 1)
          (x + 0.5 * (dx + b * dy))
          (y + 0.5 * (dy - b * dx))
          half
          (source + i)
        go (i + 1) (k + 2) x1 y1
      | otherwise = do
        writeVertex out k x y (if sagitta2 <= least then 0 else b) (source + i)
        go (i + 1) (k + 1) x1 y1
      where
        j = if i + 1 == n then 0 else i + 1
        !x1 = indexPrimArray px j
        !y1 = indexPrimArray py j
        !dx = x1 - x
        !dy = y1 - y
        !c2 = dx * dx + dy * dy
        !b = indexPrimArray pb i
        !sagitta2 = b * b * c2 / 4

-- | Finish the loop with the index @loop@, whose segments start at the vertices from @k@ to
-- @end − 1@. Repeat its first vertex at the index @end@, with the entry @source@ in 'sources'. Mark
-- the first segment, the last segment and the repeated vertex.
closeLoop :: Arrays s -> Int -> Int -> Int -> Int -> ST s ()
closeLoop out loop k end source = do
  x <- readPrimArray (vertexXs out) k
  y <- readPrimArray (vertexYs out) k
  writeVertex out end x y 0 source
  writePrimArray (segmentMarks out) k firstMark
  writePrimArray (segmentMarks out) (end - 1) lastMark
  writePrimArray (segmentMarks out) end repeatedMark
  writePrimArray (loopStarts out) loop k

-- | True when a polyarc, given by its arrays, can be copied unchanged. Every chord is then longer
-- than @tolerance@, in mm, and the sagitta of every arc is larger than it. No arc sweeps more than
-- a half circle.
isNormalised :: Double -> PrimArray Double -> PrimArray Double -> PrimArray Double -> Bool
isNormalised !tolerance !px !py !pb =
  go 0 (indexPrimArray px (n - 1)) (indexPrimArray py (n - 1)) (indexPrimArray pb (n - 1))
  where
    !n = sizeofPrimArray px
    !least = tolerance * tolerance
    -- The arguments are a segment's start (x, y), its bulge b, and the index i of the vertex at its
    -- end.
    go !i !x !y !b
      | i >= n = True
      | otherwise =
        let !x1 = indexPrimArray px i
            !y1 = indexPrimArray py i
            !c2 = (x1 - x) * (x1 - x) + (y1 - y) * (y1 - y)
         in c2 > least
              && (b == 0 || abs b <= 1 && b * b * c2 / 4 > least)
              && go (i + 1) x1 y1 (indexPrimArray pb i)

-- | Freeze the arrays, cut to @used@ vertices and @count@ loops.
freeze :: Arrays s -> Int -> Int -> ST s ClosedPolyarcs
freeze out used count = do
  mapM_ (`shrinkMutablePrimArray` used) [vertexXs out, vertexYs out, vertexBulges out]
  shrinkMutablePrimArray (segmentMarks out) used
  shrinkMutablePrimArray (segmentSources out) used
  shrinkMutablePrimArray (loopStarts out) (count + 1)
  ClosedPolyarcs
    <$> unsafeFreezePrimArray (vertexXs out)
      <*> unsafeFreezePrimArray (vertexYs out)
      <*> unsafeFreezePrimArray (vertexBulges out)
      <*> unsafeFreezePrimArray (segmentMarks out)
      <*> unsafeFreezePrimArray (segmentSources out)
      <*> unsafeFreezePrimArray (loopStarts out)

-- | An open polyarc as a closed one that runs to the end of the open one and back. If the open
-- polyarc has n segments, segment n + i of the closed one is segment n − 1 − i in the opposite
-- direction.
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

-- | The largest absolute value of a coordinate, in mm; rounding errors are proportional to it.
largestCoordinate :: [FlatPolyarc] -> Double
largestCoordinate = foldl (\m o -> largest (largest m (FlatPolyarc.xs o)) (FlatPolyarc.ys o)) 0
  where
    largest = foldlPrimArray' (\m a -> if abs a > m then abs a else m)

-- | The loops with the given indices, in that order.
restrictTo :: [Int] -> ClosedPolyarcs -> ClosedPolyarcs
restrictTo loops c =
  ClosedPolyarcs
    { xs = gathered (xs c),
      ys = gathered (ys c),
      bulges = gathered (bulges c),
      marks = gathered (marks c),
      sources = gathered (sources c),
      loopHeads = primArrayFromList (scanl (+) 0 (map size loops))
    }
  where
    size w = repeatedVertex c w + 1 - firstVertex c w
    gathered :: Prim a => PrimArray a -> PrimArray a
    gathered a = mconcat [clonePrimArray a (firstVertex c w) (size w) | w <- loops]

-- | The loop with the index @w@ as a closed polyarc.
toFlatPolyarc :: ClosedPolyarcs -> Int -> FlatPolyarc
toFlatPolyarc c w = FlatPolyarc Closed (cut (xs c)) (cut (ys c)) (cut (bulges c))
  where
    cut a = clonePrimArray a (firstVertex c w) (repeatedVertex c w - firstVertex c w)

-- | Separate segments in the arrays of 'ClosedPolyarcs', for the functions of this module and the
-- bounding-box tree. Each segment counts as a loop of its own, although it is not closed: the
-- vertex after it is its end. So the segments have the indices 0, 2, 4 and so on. A segment is
-- given by x and y of its start, x and y of its end, and its bulge.
fromSeparateSegments :: [(Double, Double, Double, Double, Double)] -> ClosedPolyarcs
fromSeparateSegments ss =
  ClosedPolyarcs
    { xs = primArrayFromList (concat [[x, x'] | (x, _, x', _, _) <- ss]),
      ys = primArrayFromList (concat [[y, y'] | (_, y, _, y', _) <- ss]),
      bulges = primArrayFromList (concat [[b, 0] | (_, _, _, _, b) <- ss]),
      marks = primArrayFromList (concat [[firstMark + lastMark, repeatedMark] | _ <- ss]),
      sources = primArrayFromList (concat (zipWith (\k _ -> [k, k]) [0 ..] ss)),
      loopHeads = primArrayFromList [2 * k | k <- [0 .. length ss]]
    }

-- Segments ----------------------------------------------------------------------------------

-- | The x and y, in mm, of the vector from the start of segment @i@ to its end, passed to the
-- continuation @k@.
chord :: ClosedPolyarcs -> Int -> (Double -> Double -> r) -> r
chord c i k =
  let x0 = indexPrimArray (xs c) i
      y0 = indexPrimArray (ys c) i
   in k (indexPrimArray (xs c) (i + 1) - x0) (indexPrimArray (ys c) (i + 1) - y0)
{-# INLINE chord #-}

-- | The power of the point (@px@, @py@) with respect to the circle of the arc with the index @i@,
-- in mm²: the squared distance from the centre less the squared radius. It is negative inside the
-- circle.
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

-- | The x and y, in mm, of the gradient of 'power' at the point (@px@, @py@), passed to the
-- continuation @k@. The gradient is twice the vector from the centre of arc @i@ to the point.
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

-- | The curvature of segment @i@ in 1/mm, positive for a counter-clockwise arc:
-- @4·b / ((1 + b²)·c)@ for a chord of length c and a bulge b.
curvature :: ClosedPolyarcs -> Int -> Double
curvature c i =
  chord c i $ \dx dy ->
    let b = indexPrimArray (bulges c) i
     in 4 * b / ((1 + b * b) * sqrt (dx * dx + dy * dy))
{-# INLINE curvature #-}

-- | The diameter of the circle of arc @i@, in mm.
diameter :: ClosedPolyarcs -> Int -> Double
diameter c i =
  chord c i $ \dx dy ->
    let b = indexPrimArray (bulges c) i
     in sqrt (dx * dx + dy * dy) * (1 + b * b) / (2 * abs b)
{-# INLINE diameter #-}

-- | The bulge of the part of segment @i@ between the points (@px@, @py@) and (@qx@, @qy@) on it.
--
-- Let u and v be the vectors from the arc's centre to the points, and θ the absolute value of the
-- part's sweep, at most a half circle. Then @tan(θ/2) = |u×v| / (|u||v| + u·v)@. Where @u·v@ is
-- negative, the equal form @(|u||v| − u·v) / |u×v|@ is more exact. From @tan(θ/2) = p/q@ follows
-- @tan(θ/4) = p / (q + √(p² + q²))@. The bulge is this number with the sign of the segment's bulge.
partialBulge :: ClosedPolyarcs -> Int -> Double -> Double -> Double -> Double -> Double
partialBulge c i px py qx qy
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
