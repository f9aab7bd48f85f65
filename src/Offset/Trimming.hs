{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | What of a chain in general position bounds the places with the wanted winding number: walk
-- along it once from where the winding number is known, add what the crossings say, keep the slices
-- that have the wanted number on their left, and join them at the crossings.
module Offset.Trimming
  ( clip,
  )
where

import Control.Monad (foldM, forM_, unless, when, zipWithM_)
import Control.Monad.ST (ST, runST)
import Data.Int (Int32)
import Data.List (sortOn)
import Data.Primitive.PrimArray
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Index.SegmentTree (SegmentTree)
import Offset.Loop (OffsetLoops (OffsetLoops))
import Offset.SelfIntersection (SelfIntersections)
import Offset.SelfIntersection qualified as SelfIntersection
import Offset.WindingNumber (Extreme (..), Outward (..))
import Offset.WindingNumber qualified as WindingNumber

-- | The loops that have the wanted winding number on their left. Nothing when the chain turns out
-- not to be in general position: two crossings fall together within the tolerance (in mm), a walk
-- folds back where it is outermost, or the sums do not agree.
clip :: Double -> Int -> ClosedPolyarcs -> SegmentTree -> SelfIntersections -> Maybe OffsetLoops
clip !tolerance !wanted !c !bs !xs = do
  -- On the left of each walk at its leftmost place, and at its rightmost.
  known <- traverse outside [0 .. ClosedPolyarcs.walks c - 1]
  if total == 0
    then uncut wanted c known
    else runST $ do
      let n = sizeofPrimArray (ClosedPolyarcs.xs c)
      begins <- newPrimArray (n + 2)
      order <- newPrimArray (max 1 total)
      sorted c xs begins order
      starts <- unsafeFreezePrimArray begins
      inOrder <- unsafeFreezePrimArray order
      if not (distinct tolerance xs starts inOrder n)
        then pure Nothing
        else do
          lefts <- newPrimArray (max 1 total)
          sound <- and <$> traverse (sums c xs starts inOrder lefts) (zip [0 ..] known)
          if not sound then pure Nothing else gather wanted c xs starts inOrder lefts known
  where
    total = 2 * SelfIntersection.count xs
    outside w = do
      let leftmost = WindingNumber.extreme Leftmost c bs w
          rightmost = WindingNumber.extreme Rightmost c bs w
          single = ClosedPolyarcs.walks c == 1
          base =
            if single then 0 else WindingNumber.at c bs (x leftmost - 4 * tolerance) (y leftmost)
      a <- leftMore leftmost
      b <- leftMore rightmost
      pure (leftmost, base + a, if single then Just (rightmost, b) else Nothing)

-- | The walks of a chain that does not cross itself, as they are; one that is all there is, without
-- a copy.
uncut :: Int -> ClosedPolyarcs -> [(Extreme, Int, Maybe (Extreme, Int))] -> Maybe OffsetLoops
uncut wanted c known
  | any (\(_, left, rightmost) -> maybe False ((/= left) . snd) rightmost) known = Nothing
  | kept == [0] && ClosedPolyarcs.walks c == 1 =
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
    kept = [w | (w, (_, left, _)) <- zip [0 ..] known, left == wanted]
    size w = ClosedPolyarcs.behind c w - ClosedPolyarcs.first c w
    starts = primArrayFromList (scanl (+) 0 (map size kept))
    gathered a = mconcat [clonePrimArray a (ClosedPolyarcs.first c w) (size w) | w <- kept]
    raws =
      mconcat
        [generatePrimArray (size w) (\i -> fromIntegral (ClosedPolyarcs.first c w + i)) | w <- kept]

-- | Fill the occurrences of every segment, in the order of the walk; and where those of each
-- segment begin (there is room for two more).
sorted ::
  ClosedPolyarcs ->
  SelfIntersections ->
  MutablePrimArray s Int32 ->
  MutablePrimArray s Int32 ->
  ST s ()
sorted c xs begins order = do
  let n = sizeofPrimArray (ClosedPolyarcs.xs c)
      total = 2 * SelfIntersection.count xs
      segmentOf o = fromIntegral (indexPrimArray (SelfIntersection.segments xs) o) `quot` 2 :: Int
  setPrimArray begins 0 (n + 2) 0
  setPrimArray order 0 total (-1)
  forM' total $ \o ->
    readPrimArray begins (segmentOf o + 2) >>= writePrimArray begins (segmentOf o + 2) . (+ 1)
  let add !i !a
        | i > n + 1 = pure ()
        | otherwise = do
          v <- readPrimArray begins i
          writePrimArray begins i (a + v)
          add (i + 1) (a + v)
  add 2 0
  -- Behind every segment stands where its next occurrence goes, and at last where those of the one
  -- behind it begin.
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
    -- So many on each that to put them in their places one by one takes too long, as where all
    -- segments meet in the middle of a circle.
    isMany = 2 * SelfIntersection.count xs > 32 * sizeofPrimArray (ClosedPolyarcs.xs c)

-- | How far along its segment's chord an occurrence lies.
parameterOf :: SelfIntersections -> Int -> Double
parameterOf xs o = indexPrimArray (SelfIntersection.reals xs) (2 * o + 2 - (if odd o then 1 else 0))
{-# INLINE parameterOf #-}

forM' :: Int -> (Int -> ST s ()) -> ST s ()
forM' n f = go 0
  where
    go !i
      | i >= n = pure ()
      | otherwise = f i >> go (i + 1)
{-# INLINE forM' #-}

-- | Whether no two crossings on a segment fall together.
distinct :: Double -> SelfIntersections -> PrimArray Int32 -> PrimArray Int32 -> Int -> Bool
distinct tolerance xs begins order n = go 0 1
  where
    total = 2 * SelfIntersection.count xs
    at o k = indexPrimArray (SelfIntersection.reals xs) (4 * (fromIntegral o `quot` 2) + k)
    -- The segment of the occurrence q − 1, or one before it.
    go !i !q
      | q >= total = True
      | i < n && fromIntegral (indexPrimArray begins (i + 1)) <= q - 1 = go (i + 1) q
      | fromIntegral (indexPrimArray begins (i + 1)) == q = go i (q + 1)
      | otherwise =
        let a = indexPrimArray order (q - 1)
            b = indexPrimArray order q
         in (abs (at a 0 - at b 0) > tolerance || abs (at a 1 - at b 1) > tolerance) && go i (q + 1)

-- | The winding number on the left behind every occurrence of a walk; whether they come out right
-- at the rightmost place.
sums ::
  ClosedPolyarcs ->
  SelfIntersections ->
  PrimArray Int32 ->
  PrimArray Int32 ->
  MutablePrimArray s Int32 ->
  (Int, (Extreme, Int, Maybe (Extreme, Int))) ->
  ST s Bool
sums c xs begins order lefts (w, (leftmost, left, rightmost)) = do
  go q0 0 left
  case rightmost of
    Just (e, expected) | z > a -> do
      let q = behindPlace e
          before = if q == a then z - 1 else q - 1
      v <- readPrimArray lefts before
      pure (fromIntegral v == expected)
    Just (_, expected) -> pure (left == expected)
    Nothing -> pure True
  where
    a = fromIntegral (indexPrimArray begins (ClosedPolyarcs.first c w)) :: Int
    z = fromIntegral (indexPrimArray begins (ClosedPolyarcs.behind c w)) :: Int
    q0 = let q = behindPlace leftmost in if q == z then a else q
    behindPlace e = search (fromIntegral (indexPrimArray begins (segment e)))
      where
        end = fromIntegral (indexPrimArray begins (segment e + 1))
        search !q
          | q >= end = q
          | parameterOf xs (fromIntegral (indexPrimArray order q)) < place e = search (q + 1)
          | otherwise = q
    go !q !k !v
      | k >= z - a = pure ()
      | otherwise = do
        let o = fromIntegral (indexPrimArray order q)
            v' = if SelfIntersection.decreases xs o then v - 1 else v + 1 :: Int
        writePrimArray lefts q (fromIntegral v')
        go (if q + 1 == z then a else q + 1) (k + 1 :: Int) v'

-- | The loops from the slices that are kept. A slice goes from one occurrence to the next on its
-- walk.
gather ::
  Int ->
  ClosedPolyarcs ->
  SelfIntersections ->
  PrimArray Int32 ->
  PrimArray Int32 ->
  MutablePrimArray s Int32 ->
  [(Extreme, Int, Maybe (Extreme, Int))] ->
  ST s (Maybe OffsetLoops)
gather wanted c xs begins order lefts known = do
  let n = sizeofPrimArray (ClosedPolyarcs.xs c)
      total = 2 * SelfIntersection.count xs
      room = n + total + 1
  ox <- newPrimArray room
  oy <- newPrimArray room
  ob <- newPrimArray room
  os <- newPrimArray room
  starts <- newPrimArray (total + ClosedPolyarcs.walks c + 1)
  position <- newPrimArray (max 1 total)
  forM' total $ \q ->
    writePrimArray position (fromIntegral (indexPrimArray order q)) (fromIntegral q :: Int32)
  -- Of one walk all is on that.
  walkOf <- newPrimArray (if single then 0 else max 1 total)
  unless single $
    forM_ [0 .. ClosedPolyarcs.walks c - 1] $ \w ->
      forM' (rangeEnd w - rangeBegin w) $ \q ->
        writePrimArray walkOf (rangeBegin w + q) (fromIntegral w :: Int32)
  let emit !k !x !y !b !s = do
        writePrimArray ox k x
        writePrimArray oy k y
        writePrimArray ob k b
        writePrimArray os k (fromIntegral (s :: Int) :: Int32)
      whole w k (l, made)
        | rangeBegin w == rangeEnd w && k == wanted = do
          writePrimArray starts made l
          let copy !i !o
                | i >= ClosedPolyarcs.behind c w = pure o
                | otherwise =
                  emit
                    o
                    (indexPrimArray (ClosedPolyarcs.xs c) i)
                    (indexPrimArray (ClosedPolyarcs.ys c) i)
                    (indexPrimArray (ClosedPolyarcs.bulges c) i)
                    i
                    >> copy (i + 1) (o + 1)
          l' <- copy (ClosedPolyarcs.first c w) l
          pure (l', made + 1)
        | otherwise = pure (l, made)
      -- From occurrence q on along the walk, and over to the partner at the end.
      follow !q0 !q !l = do
        writePrimArray lefts q passed
        w <- if single then pure 0 else fromIntegral <$> readPrimArray walkOf q
        let next = if q + 1 == rangeEnd w then rangeBegin w else q + 1
            o = fromIntegral (indexPrimArray order q) :: Int
            o' = fromIntegral (indexPrimArray order next) :: Int
            (px, py) = (pointOf o 0, pointOf o 1)
            (px', py') = (pointOf o' 0, pointOf o' 1)
            s = segmentOf o
            s' = segmentOf o'
        l' <-
          if s == s' && next > q
            then emit l px py (part s px py px' py') s >> pure (l + 1)
            else do
              emit
                l
                px
                py
                ( part
                    s
                    px
                    py
                    (indexPrimArray (ClosedPolyarcs.xs c) (s + 1))
                    (indexPrimArray (ClosedPolyarcs.ys c) (s + 1))
                )
                s
              let middle !i !k
                    | i == s' = pure k
                    | otherwise =
                      emit
                        k
                        (indexPrimArray (ClosedPolyarcs.xs c) i)
                        (indexPrimArray (ClosedPolyarcs.ys c) i)
                        (indexPrimArray (ClosedPolyarcs.bulges c) i)
                        i
                        >> middle (after w i) (k + 1)
              k <- middle (after w s) (l + 1)
              emit
                k
                (indexPrimArray (ClosedPolyarcs.xs c) s')
                (indexPrimArray (ClosedPolyarcs.ys c) s')
                ( part
                    s'
                    (indexPrimArray (ClosedPolyarcs.xs c) s')
                    (indexPrimArray (ClosedPolyarcs.ys c) s')
                    px'
                    py'
                )
                s'
              pure (k + 1)
        partner <- fromIntegral <$> readPrimArray position (if even o' then o' + 1 else o' - 1)
        v <- readPrimArray lefts partner
        if partner == q0
          then pure (Just l')
          else if fromIntegral v /= wanted then pure Nothing else follow q0 partner l'
      loops !q !l !made
        | q >= total = pure (Just (l, made))
        | otherwise = do
          v <- readPrimArray lefts q
          if fromIntegral v /= wanted
            then loops (q + 1) l made
            else do
              writePrimArray starts made l
              follow q q l >>= \case
                Nothing -> pure Nothing
                Just l' -> loops (q + 1) l' (made + 1)
  (l0, made0) <- foldM (\acc (w, (_, v, _)) -> whole w v acc) (0, 0) (zip [0 ..] known)
  loops 0 l0 made0 >>= \case
    Nothing -> pure Nothing
    Just (l, made) -> do
      writePrimArray starts made l
      shrinkMutablePrimArray ox l
      shrinkMutablePrimArray oy l
      shrinkMutablePrimArray ob l
      shrinkMutablePrimArray os l
      shrinkMutablePrimArray starts (made + 1)
      Just
        <$> ( OffsetLoops
                <$> unsafeFreezePrimArray starts
                  <*> unsafeFreezePrimArray ox
                  <*> unsafeFreezePrimArray oy
                  <*> unsafeFreezePrimArray ob
                  <*> unsafeFreezePrimArray os
            )
  where
    single = ClosedPolyarcs.walks c == 1
    -- What is on the left of a slice that was walked; no number of a free place.
    passed = minBound :: Int32
    rangeBegin w = fromIntegral (indexPrimArray begins (ClosedPolyarcs.first c w)) :: Int
    rangeEnd w = fromIntegral (indexPrimArray begins (ClosedPolyarcs.behind c w)) :: Int
    segmentOf o = fromIntegral (indexPrimArray (SelfIntersection.segments xs) o) `quot` 2 :: Int
    pointOf o k = indexPrimArray (SelfIntersection.reals xs) (4 * (o `quot` 2) + k)
    after w i = if i + 1 == ClosedPolyarcs.behind c w then ClosedPolyarcs.first c w else i + 1
    part s = ClosedPolyarcs.part c s
