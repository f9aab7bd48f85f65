{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Trims a raw offset in general position, and returns the loops that have the wanted winding
-- number on their left.
--
-- Each polyarc is traversed once from a point where the winding number is known. The winding number
-- is updated at each self-intersection. Slices are the parts of a polyarc between consecutive
-- intersections. They are kept when the winding number on their left is the wanted one, and joined
-- at the intersections. An occurrence is an intersection seen on one of its two segments
-- ("Offset.SelfIntersection"). The sorted occurrences are in the order in which the polyarcs pass
-- them.
module Offset.Trimming
  ( trim,
  )
where

import Control.Monad (foldM, forM_, when, zipWithM_)
import Control.Monad.ST (ST, runST)
import Data.Int (Int32)
import Data.List (sortOn)
import Data.Primitive.PrimArray
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Index.SegmentBoxTree (SegmentBoxTree)
import Offset.Loop (OffsetLoops (OffsetLoops))
import Offset.SelfIntersection (SelfIntersections)
import Offset.SelfIntersection qualified as SelfIntersection
import Offset.WindingNumber (Extreme (..), Outward (..))
import Offset.WindingNumber qualified as WindingNumber

-- | The loops that have the winding number @wanted@ on their left. @boxes@ is the bounding-box tree
-- of the polyarcs @c@; @xs@ are their self-intersections; @tolerance@ is in mm. The result is
-- Nothing, so that the caller tries an arrangement, in three cases: two intersections coincide
-- within the tolerance, a polyarc runs back along itself at its leftmost or rightmost point, or the
-- winding numbers contradict each other.
trim :: Double -> Int -> ClosedPolyarcs -> SegmentBoxTree -> SelfIntersections -> Maybe OffsetLoops
trim !tolerance !wanted !c !boxes !xs = do
  -- For each polyarc its leftmost point with the winding number on the polyarc's left there. A
  -- single polyarc also has its rightmost point, by which the traversal is checked.
  outermost <- traverse outside [0 .. ClosedPolyarcs.loopCount c - 1]
  if total == 0
    then uncut wanted c outermost
    else runST $ do
      let n = sizeofPrimArray (ClosedPolyarcs.xs c)
      begins <- newPrimArray (n + 2)
      order <- newPrimArray (max 1 total)
      sortOccurrences c xs begins order
      slices <- Slices c xs <$> unsafeFreezePrimArray begins <*> unsafeFreezePrimArray order
      if not (areDistinct tolerance slices)
        then pure Nothing
        else do
          lefts <- newPrimArray (max 1 total)
          isSound <- and <$> traverse (propagate slices lefts) (zip [0 ..] outermost)
          if isSound then joinSlices wanted slices lefts outermost else pure Nothing
  where
    total = 2 * SelfIntersection.count xs
    outside w = do
      let leftmost = WindingNumber.extreme Leftmost c boxes w
          rightmost = WindingNumber.extreme Rightmost c boxes w
          single = ClosedPolyarcs.loopCount c == 1
          base =
            if single then 0 else WindingNumber.at c boxes (x leftmost - 4 * tolerance) (y leftmost)
      a <- leftExcess leftmost
      b <- leftExcess rightmost
      pure (leftmost, base + a, if single then Just (rightmost, b) else Nothing)

-- | The loops when there are no self-intersections: the polyarcs that have the winding number
-- @wanted@ on their left. @outermost@ has for each polyarc its leftmost point and the winding
-- number on its left there. A single polyarc also has its rightmost point with the winding number
-- there; the result is Nothing when both numbers differ. A single polyarc is not copied.
uncut :: Int -> ClosedPolyarcs -> [(Extreme, Int, Maybe (Extreme, Int))] -> Maybe OffsetLoops
uncut wanted c outermost
  | any (\(_, left, rightmost) -> maybe False ((/= left) . snd) rightmost) outermost = Nothing
  | kept == [0] && ClosedPolyarcs.loopCount c == 1 =
    Just
      ( OffsetLoops
          starts
          (ClosedPolyarcs.xs c)
          (ClosedPolyarcs.ys c)
          (ClosedPolyarcs.bulges c)
          raws
      )
  | otherwise =
    Just
      ( OffsetLoops
          starts
          (gathered (ClosedPolyarcs.xs c))
          (gathered (ClosedPolyarcs.ys c))
          (gathered (ClosedPolyarcs.bulges c))
          raws
      )
  where
    kept = [w | (w, (_, left, _)) <- zip [0 ..] outermost, left == wanted]
    size w = ClosedPolyarcs.repeatedVertex c w - ClosedPolyarcs.firstVertex c w
    starts = primArrayFromList (scanl (+) 0 (map size kept))
    gathered a = mconcat [clonePrimArray a (ClosedPolyarcs.firstVertex c w) (size w) | w <- kept]
    raws =
      mconcat
        [ generatePrimArray (size w) (\i -> fromIntegral (ClosedPolyarcs.firstVertex c w + i))
          | w <- kept
        ]

-- | Sorts the occurrences by segment (counting sort) and by position on the segment (insertion
-- sort). Fills @order@ with the numbers of the sorted occurrences, and @begins@ with the index in
-- @order@ of each segment's first occurrence. @begins@ needs two entries more than there are
-- vertices.
sortOccurrences ::
  ClosedPolyarcs ->
  SelfIntersections ->
  MutablePrimArray s Int32 ->
  MutablePrimArray s Int32 ->
  ST s ()
sortOccurrences c xs begins order = do
  let n = sizeofPrimArray (ClosedPolyarcs.xs c)
      total = 2 * SelfIntersection.count xs
      segmentOf o = fromIntegral (indexPrimArray (SelfIntersection.segments xs) o) `quot` 2 :: Int
  setPrimArray begins 0 (n + 2) 0
  setPrimArray order 0 total (-1)
  forM' total $ \o ->
    readPrimArray begins (segmentOf o + 2) >>= writePrimArray begins (segmentOf o + 2) . (+ 1)
  let accumulate !i !a
        | i > n + 1 = pure ()
        | otherwise = do
          v <- readPrimArray begins i
          writePrimArray begins i (a + v)
          accumulate (i + 1) (a + v)
  accumulate 2 0
  -- While occurrences are placed, entry s + 1 of @begins@ is the index in @order@ for the next
  -- occurrence of segment s. In the end it is the index of the first occurrence of segment s + 1.
  forM' total $ \o -> do
    let s = segmentOf o
        t = parameterOf xs o
        sink !q
          | q == 0 || isMany = writePrimArray order q (fromIntegral o)
          | otherwise = do
            o' <- fromIntegral <$> readPrimArray order (q - 1)
            if o' >= 0 && segmentOf o' == s && parameterOf xs o' > t
              then writePrimArray order q (fromIntegral o') >> sink (q - 1)
              else writePrimArray order q (fromIntegral o)
    e <- readPrimArray begins (s + 1)
    writePrimArray begins (s + 1) (e + 1)
    sink (fromIntegral (e :: Int32))
  when isMany $
    forM' n $ \s -> do
      from <- fromIntegral <$> readPrimArray begins s
      to <- fromIntegral <$> readPrimArray begins (s + 1)
      found <- traverse (readPrimArray order) [from .. to - 1]
      zipWithM_ (writePrimArray order) [from ..] (sortOn (parameterOf xs . fromIntegral) found)
  where
    -- True when the segments have so many occurrences that insertion would take too long, for
    -- example where all segments meet in the centre of a circle.
    isMany = 2 * SelfIntersection.count xs > 32 * sizeofPrimArray (ClosedPolyarcs.xs c)

-- | The position of occurrence @o@ along its segment's chord, as a fraction from 0 to 1.
parameterOf :: SelfIntersections -> Int -> Double
parameterOf xs o = indexPrimArray (SelfIntersection.reals xs) (2 * o + 2 - (if odd o then 1 else 0))
{-# INLINE parameterOf #-}

-- | The polyarcs, their self-intersections, and the arrays @begins@ and @order@ that
-- 'sortOccurrences' fills.
data Slices = Slices ClosedPolyarcs SelfIntersections (PrimArray Int32) (PrimArray Int32)

-- | The index of the first occurrence of polyarc @w@ among the sorted ones.
rangeBegin :: Slices -> Int -> Int
rangeBegin (Slices c _ begins _) w =
  fromIntegral (indexPrimArray begins (ClosedPolyarcs.firstVertex c w))
{-# INLINE rangeBegin #-}

-- | The index after the last occurrence of polyarc @w@ among the sorted ones.
rangeEnd :: Slices -> Int -> Int
rangeEnd (Slices c _ begins _) w =
  fromIntegral (indexPrimArray begins (ClosedPolyarcs.repeatedVertex c w))
{-# INLINE rangeEnd #-}

-- | Runs the action @f@ for every index from 0 to @n − 1@. Unlike 'forM_' it allocates no list.
forM' :: Int -> (Int -> ST s ()) -> ST s ()
forM' n f = go 0
  where
    go !i
      | i >= n = pure ()
      | otherwise = f i >> go (i + 1)
{-# INLINE forM' #-}

-- | True when no two intersections that follow each other on a segment coincide within the
-- tolerance (mm).
areDistinct :: Double -> Slices -> Bool
areDistinct tolerance (Slices c xs begins order) = go 0 1
  where
    n = sizeofPrimArray (ClosedPolyarcs.xs c)
    total = 2 * SelfIntersection.count xs
    at o k = indexPrimArray (SelfIntersection.reals xs) (4 * (fromIntegral o `quot` 2) + k)
    -- Compares the sorted occurrences at the indices @q − 1@ and @q@ if they are on one segment.
    -- @i@ is at most the number of the segment on which the occurrence at @q − 1@ lies.
    go !i !q
      | q >= total = True
      | i < n && fromIntegral (indexPrimArray begins (i + 1)) <= q - 1 = go (i + 1) q
      | fromIntegral (indexPrimArray begins (i + 1)) == q = go i (q + 1)
      | otherwise =
        let a = indexPrimArray order (q - 1)
            b = indexPrimArray order q
         in (abs (at a 0 - at b 0) > tolerance || abs (at a 1 - at b 1) > tolerance) && go i (q + 1)

-- | Fills @lefts@ with the winding number on the left of polyarc @w@ after each of its occurrences,
-- in the order of the sorted occurrences. The last argument has the number @w@, the leftmost point
-- of the polyarc, the winding number on its left there, and perhaps its rightmost point with the
-- expected winding number. The result is False when the number computed at the rightmost point
-- differs from the expected one.
propagate ::
  Slices ->
  MutablePrimArray s Int32 ->
  (Int, (Extreme, Int, Maybe (Extreme, Int))) ->
  ST s Bool
propagate slices@(Slices _ xs begins order) lefts (w, (leftmost, left, rightmost)) = do
  go q0 0 left
  case rightmost of
    Just (e, expected) | z > a -> do
      let q = firstAfter e
          before = if q == a then z - 1 else q - 1
      v <- readPrimArray lefts before
      pure (fromIntegral v == expected)
    Just (_, expected) -> pure (left == expected)
    Nothing -> pure True
  where
    a = rangeBegin slices w
    z = rangeEnd slices w
    q0 = let q = firstAfter leftmost in if q == z then a else q
    firstAfter e = advance (fromIntegral (indexPrimArray begins (segment e)))
      where
        end = fromIntegral (indexPrimArray begins (segment e + 1))
        advance !q
          | q >= end = q
          | parameterOf xs (fromIntegral (indexPrimArray order q)) < parameter e = advance (q + 1)
          | otherwise = q
    go !q !k !v
      | k >= z - a = pure ()
      | otherwise = do
        let o = fromIntegral (indexPrimArray order q)
            v' = if SelfIntersection.decreases xs o then v - 1 else v + 1 :: Int
        writePrimArray lefts q (fromIntegral v')
        go (if q + 1 == z then a else q + 1) (k + 1 :: Int) v'

-- | Joins slices with the winding number @wanted@ on their left into loops. A slice runs from one
-- occurrence to the next along its polyarc. @lefts@ has the winding number on the left of each
-- slice, in the order of the sorted occurrences at which the slices begin. The function replaces
-- the numbers of the slices that it has visited by a mark. @outermost@ has for each polyarc its
-- leftmost point, the winding number on its left there, and perhaps the same for its rightmost
-- point. The result is Nothing when a kept slice leads to a slice with another winding number.
joinSlices ::
  Int ->
  Slices ->
  MutablePrimArray s Int32 ->
  [(Extreme, Int, Maybe (Extreme, Int))] ->
  ST s (Maybe OffsetLoops)
joinSlices !wanted slices@(Slices !c !xs _ !order) lefts outermost = do
  out <- newOutput (sizeofPrimArray (ClosedPolyarcs.xs c) + total + 1)
  starts <- newPrimArray (total + ClosedPolyarcs.loopCount c + 1)
  let copyUncut (l, made) (w, (_, left, _))
        | rangeBegin slices w == rangeEnd slices w && left == wanted = do
          writePrimArray starts made l
          let (from, to) = (ClosedPolyarcs.firstVertex c w, ClosedPolyarcs.repeatedVertex c w)
          copySegments out c from to l
          pure (l + to - from, made + 1)
        | otherwise = pure (l, made)
      -- Follows the polyarc from the sorted occurrence at q to the next one. Then it continues at
      -- the same intersection on the other segment, until it returns to the occurrence at q0.
      follow !q0 !q !l = do
        writePrimArray lefts q visited
        let w = if single then 0 else fromIntegral (indexPrimArray polyarcOf q)
            next = if q + 1 == rangeEnd slices w then rangeBegin slices w else q + 1
            o = fromIntegral (indexPrimArray order next) :: Int
            partner = fromIntegral (indexPrimArray position (if even o then o + 1 else o - 1))
        l' <- writeSlice out slices w q next l
        left <- readPrimArray lefts partner
        if partner == q0
          then pure (Just l')
          else if fromIntegral left /= wanted then pure Nothing else follow q0 partner l'
      loops !q !l !made
        | q >= total = Just <$> frozen out starts l made
        | otherwise = do
          left <- readPrimArray lefts q
          if fromIntegral left /= wanted
            then loops (q + 1) l made
            else do
              writePrimArray starts made l
              follow q q l >>= \case
                Nothing -> pure Nothing
                Just l' -> loops (q + 1) l' (made + 1)
  uncurry (loops 0) =<< foldM copyUncut (0, 0) (zip [0 ..] outermost)
  where
    single = ClosedPolyarcs.loopCount c == 1
    total = 2 * SelfIntersection.count xs
    !position = positions slices
    -- A single polyarc needs no lookup.
    !polyarcOf = if single then mempty else polyarcNumbers slices
    -- The mark of a visited slice, which no winding number equals.
    visited = minBound :: Int32

-- | The index of each occurrence among the sorted ones.
positions :: Slices -> PrimArray Int32
positions (Slices _ xs _ order) = runPrimArray $ do
  position <- newPrimArray (max 1 total)
  forM' total $ \q ->
    writePrimArray position (fromIntegral (indexPrimArray order q)) (fromIntegral q)
  pure position
  where
    total = 2 * SelfIntersection.count xs

-- | The number of the polyarc of each of the sorted occurrences.
polyarcNumbers :: Slices -> PrimArray Int32
polyarcNumbers slices@(Slices c xs _ _) = runPrimArray $ do
  numbers <- newPrimArray (max 1 (2 * SelfIntersection.count xs))
  forM_ [0 .. ClosedPolyarcs.loopCount c - 1] $ \w ->
    forM' (rangeEnd slices w - rangeBegin slices w) $ \q ->
      writePrimArray numbers (rangeBegin slices w + q) (fromIntegral w)
  pure numbers

-- | The arrays of loops while they are written: x and y of the vertices, the bulges of the
-- segments, and the numbers of the segments from which they were cut.
data Output s
  = Output
      (MutablePrimArray s Double)
      (MutablePrimArray s Double)
      (MutablePrimArray s Double)
      (MutablePrimArray s Int32)

-- | Arrays with room for @capacity@ vertices.
newOutput :: Int -> ST s (Output s)
newOutput capacity =
  Output
    <$> newPrimArray capacity
      <*> newPrimArray capacity
      <*> newPrimArray capacity
      <*> newPrimArray capacity

-- | The loops in the filled arrays. @starts@ has the index of each loop's first vertex; @used@ is
-- the number of vertices, and @made@ the number of loops.
frozen :: Output s -> MutablePrimArray s Int -> Int -> Int -> ST s OffsetLoops
frozen (Output xs ys bulges raws) starts used made = do
  writePrimArray starts made used
  mapM_ (`shrinkMutablePrimArray` used) [xs, ys, bulges]
  shrinkMutablePrimArray raws used
  shrinkMutablePrimArray starts (made + 1)
  OffsetLoops
    <$> unsafeFreezePrimArray starts
      <*> unsafeFreezePrimArray xs
      <*> unsafeFreezePrimArray ys
      <*> unsafeFreezePrimArray bulges
      <*> unsafeFreezePrimArray raws

-- | Writes a segment of a loop at index @k@: x and y of its start in mm, its bulge @b@, and the
-- number @s@ of the raw segment from which it was cut.
emit :: Output s -> Int -> Double -> Double -> Double -> Int -> ST s ()
emit (Output xs ys bulges raws) !k !x !y !b !s = do
  writePrimArray xs k x
  writePrimArray ys k y
  writePrimArray bulges k b
  writePrimArray raws k (fromIntegral s)
{-# INLINE emit #-}

-- | Copies the segments of the polyarcs from number @from@ to @to − 1@. The first one goes to the
-- index that is the last argument.
copySegments :: Output s -> ClosedPolyarcs -> Int -> Int -> Int -> ST s ()
copySegments out c from to = copy from
  where
    copy !i !k
      | i >= to = pure ()
      | otherwise = do
        emit
          out
          k
          (indexPrimArray (ClosedPolyarcs.xs c) i)
          (indexPrimArray (ClosedPolyarcs.ys c) i)
          (indexPrimArray (ClosedPolyarcs.bulges c) i)
          i
        copy (i + 1) (k + 1)
{-# INLINE copySegments #-}

-- | Writes the slice of polyarc @w@ between the sorted occurrences at @q@ and at @next@, from index
-- @l@ on. The result is the next free index.
writeSlice :: Output s -> Slices -> Int -> Int -> Int -> Int -> ST s Int
writeSlice out (Slices c xs _ order) !w !q !next !l
  | s == s' && next > q =
    emit out l px py (part s px py px' py') s >> pure (l + 1)
  | otherwise = do
    emit out l px py (part s px py (x (s + 1)) (y (s + 1))) s
    let (first, end) = (ClosedPolyarcs.firstVertex c w, ClosedPolyarcs.repeatedVertex c w)
        from = if s + 1 == end then first else s + 1
        count = if from <= s' then s' - from else end - from + s' - first
        k = l + 1 + count
    if from <= s'
      then copySegments out c from s' (l + 1)
      else do
        copySegments out c from end (l + 1)
        copySegments out c first s' (k - (s' - first))
    emit out k (x s') (y s') (part s' (x s') (y s') px' py') s'
    pure (k + 1)
  where
    o = fromIntegral (indexPrimArray order q) :: Int
    o' = fromIntegral (indexPrimArray order next) :: Int
    s = segmentOf o
    s' = segmentOf o'
    (px, py) = (pointOf o 0, pointOf o 1)
    (px', py') = (pointOf o' 0, pointOf o' 1)
    segmentOf h = fromIntegral (indexPrimArray (SelfIntersection.segments xs) h) `quot` 2 :: Int
    pointOf h k = indexPrimArray (SelfIntersection.reals xs) (4 * (h `quot` 2) + k)
    x = indexPrimArray (ClosedPolyarcs.xs c)
    y = indexPrimArray (ClosedPolyarcs.ys c)
    part = ClosedPolyarcs.partialBulge c
{-# INLINE writeSlice #-}
