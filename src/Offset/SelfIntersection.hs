{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | Self-intersections of closed polyarcs in general position: segments may cross between their
-- ends, but they do not touch or coincide. Segments are given by their numbers in 'ClosedPolyarcs'.
module Offset.SelfIntersection
  ( SelfIntersections (..),
    SearchResult (..),
    find,
    segmentPair,
    properCrossing,
    decreases,
  )
where

import Control.Monad (when)
import Control.Monad.ST (ST, runST)
import Data.Int (Int32)
import Data.Primitive.MutVar
import Data.Primitive.PrimArray
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Index.SegmentBoxTree (SegmentBoxTree)
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Offset.SegmentIntersection (Visitor (..))
import Offset.SegmentIntersection qualified as SegmentIntersection

-- | The self-intersections, numbered from 0. An occurrence is an intersection seen on one of its
-- two segments. Intersection @h@ has occurrence @2h@ on its first segment, and @2h + 1@ on its
-- second one.
data SelfIntersections = SelfIntersections
  { -- | number of intersections
    count :: Int,
    -- | four numbers for each intersection: x and y in mm, then its positions along the chords of
    -- its first and its second segment, as fractions from 0 to 1
    reals :: PrimArray Double,
    -- | for each occurrence: twice the number of its segment, plus 1 if the winding number on the
    -- segment's left decreases at the intersection
    segments :: PrimArray Int32
  }

-- | The result of 'find'.
data SearchResult
  = -- | all intersections
    SearchResult SelfIntersections
  | -- | not in general position: a segment ends on another one or touches it. This is also the
    -- result when rounding hides whether a segment does so
    NotGeneral

-- | Finds all self-intersections of the polyarcs @c@. @tolerance@ (mm) covers rounding; the boxes
-- of the bounding-box tree @boxes@ are inflated by it.
find :: Double -> ClosedPolyarcs -> SegmentBoxTree -> SearchResult
find !tolerance !c !boxes = runST $ do
  state <- newPrimArray 2
  writePrimArray state 0 (0 :: Int)
  writePrimArray state 1 0
  rs <- newPrimArray 0 >>= newMutVar
  ss <- newPrimArray 0 >>= newMutVar
  let markUnclear = writePrimArray state 1 1
      record !i !s !j !t !x !y !cross = do
        k <- readPrimArray state 0
        grow (sizeofPrimArray (ClosedPolyarcs.xs c) `quot` 2) rs ss k
        r <- readMutVar rs
        writePrimArray r (4 * k) x
        writePrimArray r (4 * k + 1) y
        writePrimArray r (4 * k + 2) s
        writePrimArray r (4 * k + 3) t
        g <- readMutVar ss
        -- When the second segment crosses to the left of the first, the winding number on the left
        -- of the first decreases by one, and that on the left of the second increases by one.
        writePrimArray g (2 * k) (fromIntegral (2 * i + (if cross > 0 then 1 else 0)))
        writePrimArray g (2 * k + 1) (fromIntegral (2 * j + (if cross > 0 then 0 else 1)))
        writePrimArray state 0 (k + 1)
        when (cross == 0) markUnclear
      visitor =
        Visitor
          { crossing = record,
            resting = \_ _ -> markUnclear,
            touching = \_ _ _ _ -> markUnclear
          }
  SegmentBoxTree.pairs
    boxes
    ((== 0) <$> readPrimArray state 1)
    (SegmentIntersection.meet tolerance c visitor)
  k <- readPrimArray state 0
  unclearFlag <- readPrimArray state 1
  if unclearFlag /= 0
    then pure NotGeneral
    else do
      r <- readMutVar rs >>= unsafeFreezePrimArray
      g <- readMutVar ss >>= unsafeFreezePrimArray
      pure (SearchResult (SelfIntersections k r g))

-- | The numbers of two segments that cross between their ends. Nothing when there is no such pair.
-- A segment that only ends on another one or touches it does not count. @tolerance@ (mm) covers
-- rounding.
properCrossing :: Double -> ClosedPolyarcs -> SegmentBoxTree -> Maybe (Int, Int)
properCrossing tolerance c boxes = runST $ do
  found <- newMutVar Nothing
  let visitor =
        Visitor
          { crossing = \i _ j _ _ _ _ -> writeMutVar found (Just (i, j)),
            resting = \_ _ -> pure (),
            touching = \_ _ _ _ -> pure ()
          }
  SegmentBoxTree.pairs
    boxes
    ((== Nothing) <$> readMutVar found)
    (SegmentIntersection.meet tolerance c visitor)
  readMutVar found

-- | Makes room for intersection @k@ in the arrays @rs@ of reals and @ss@ of segments. The first
-- allocation has room for @capacity@ intersections, but at least 16; each later one quadruples the
-- room. A large first allocation costs little, since untouched memory is not used; copying costs
-- time.
grow ::
  Int ->
  MutVar s (MutablePrimArray s Double) ->
  MutVar s (MutablePrimArray s Int32) ->
  Int ->
  ST s ()
grow capacity rs ss k = do
  g <- readMutVar ss
  room <- getSizeofMutablePrimArray g
  when (2 * k + 2 > room) $ do
    r <- readMutVar rs
    let more = if room == 0 then max 16 capacity else 2 * room
    resizeMutablePrimArray r (4 * more) >>= writeMutVar rs
    resizeMutablePrimArray g (2 * more) >>= writeMutVar ss

-- | The numbers of the two segments of intersection @h@.
segmentPair :: SelfIntersections -> Int -> (Int, Int)
segmentPair c h = (half (2 * h), half (2 * h + 1))
  where
    half k = fromIntegral (indexPrimArray (segments c) k) `quot` 2

-- | True when the winding number on the left of a segment decreases by one at the occurrence @o@ on
-- this segment. Otherwise it increases by one.
decreases :: SelfIntersections -> Int -> Bool
decreases c o = odd (indexPrimArray (segments c) o)
{-# INLINE decreases #-}
