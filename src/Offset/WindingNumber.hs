{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Winding numbers of closed polyarcs: around a point, and on the left of a polyarc at its
-- leftmost or rightmost point. These points are called extremes. A polyarc that goes
-- counter-clockwise around a point counts 1, one that goes clockwise −1.
--
-- Polyarcs, segments and vertices are given by their numbers in 'ClosedPolyarcs'. Coordinates are
-- in mm. A run is a group of eight consecutive segments, around which the bounding-box tree has one
-- box.
module Offset.WindingNumber
  ( at,
    contribution,
    Extreme (..),
    Outward (..),
    extreme,
  )
where

import Data.List (foldl')
import Data.Primitive.PrimArray
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Index.SegmentBoxTree (SegmentBoxTree)
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Geometry.Tolerance qualified as Tolerance

-- | The winding number of all polyarcs around the point (@px@, @py@), which lies on none of them.
-- @boxes@ is the bounding-box tree of the polyarcs.
at :: ClosedPolyarcs -> SegmentBoxTree -> Double -> Double -> Int
at c boxes px py =
  SegmentBoxTree.around boxes (-1e300) py px py 0 (\total i -> total + contribution c px py i)

-- | The contribution of segment @i@ to the winding number around the point (@px@, @py@): the sum of
-- two numbers. The first is for the segment's chord: −1 when it crosses the ray from the point to
-- the left upwards, 1 when it crosses this ray downwards, else 0. The second is for a point between
-- an arc and its chord: 1 when the arc is counter-clockwise, −1 when it is clockwise. It is 0 for
-- every other point, and for a line.
contribution :: ClosedPolyarcs -> Double -> Double -> Int -> Int
contribution c px py i = crossed + between
  where
    x0 = indexPrimArray (ClosedPolyarcs.xs c) i
    y0 = indexPrimArray (ClosedPolyarcs.ys c) i
    x1 = indexPrimArray (ClosedPolyarcs.xs c) (i + 1)
    y1 = indexPrimArray (ClosedPolyarcs.ys c) (i + 1)
    b = indexPrimArray (ClosedPolyarcs.bulges c) i
    side = (x1 - x0) * (py - y0) - (y1 - y0) * (px - x0)
    crossed
      | y0 <= py && y1 > py = if side < 0 then -1 else 0
      | y1 <= py && y0 > py = if side > 0 then 1 else 0
      | otherwise = 0
    between =
      if b /= 0 && aside * b < 0 && ClosedPolyarcs.power c i px py < 0
        then (if b > 0 then 1 else -1)
        else 0
    -- A number with the sign of @side@. If @side@ is 0, the point lies on the line of the chord. It
    -- then counts as a point at slightly smaller x, as in the comparisons above. On a horizontal
    -- chord it counts as a point at slightly larger y.
    aside
      | side /= 0 = side
      | y1 /= y0 = y1 - y0
      | otherwise = x1 - x0
{-# INLINE contribution #-}

-- | The leftmost or the rightmost point of a polyarc.
data Extreme = Extreme
  { -- | the number of the segment on which the point lies
    segment :: Int,
    -- | the position of the point along the segment's chord, as a fraction from 0 to 1
    parameter :: Double,
    -- | x of the point in mm
    x :: Double,
    -- | y of the point in mm
    y :: Double,
    -- | the winding number on the left of the polyarc at the point, less the winding number just
    -- beyond the point, on its outer side: 1 or 0. Nothing where the polyarc runs back along
    -- itself, so that left and right cannot be distinguished
    leftExcess :: Maybe Int
  }

-- | The direction in which an extreme is looked for.
data Outward = Leftmost | Rightmost
  deriving stock (Eq)

-- | The leftmost or rightmost point of the polyarc with the number @w@. Runs whose box lies further
-- inside than a known point are skipped.
extreme :: Outward -> ClosedPolyarcs -> SegmentBoxTree -> Int -> Extreme
extreme outward c boxes w = go start start 0 (1e300 :: Double)
  where
    !start = ClosedPolyarcs.firstVertex c w
    !end = ClosedPolyarcs.repeatedVertex c w
    !sign = signOf outward
    !bound = outermostBound outward c boxes w
    go !i !best !t !least
      | i >= end = extremeAt sign c w best t least
      | SegmentBoxTree.runBoxOf boxes i (outermostSide outward) > bound =
        go (SegmentBoxTree.nextRun i) best t least
      | SegmentBoxTree.segmentBoxWithMargin boxes i (outermostSide outward) >= least =
        go (i + 1) best t least
      | otherwise =
        let x0 = sign * indexPrimArray (ClosedPolyarcs.xs c) i
            best1 = if x0 < least then i else best
            t1 = if x0 < least then 0 else t
            least1 = if x0 < least then x0 else least
         in if indexPrimArray (ClosedPolyarcs.bulges c) i == 0
              then go (i + 1) best1 t1 least1
              else outermostOfArc sign c i $ \isBetween t' ex ->
                if isBetween && ex < least1 && t' > endMargin && t' < 1 - endMargin
                  then go (i + 1) i t' ex
                  else go (i + 1) best1 t1 least1
    -- The least distance between an arc's outermost point and an end of the arc, as a fraction of
    -- the chord. Below it the end counts as the outermost point.
    endMargin = Tolerance.negligibleShare

-- | The factor, 1 or −1, by which x is multiplied so that the outermost point has the least
-- product.
signOf :: Outward -> Double
signOf outward = case outward of
  Leftmost -> 1
  Rightmost -> -1

-- | The x of a bounding box's outermost side in mm, multiplied by 'signOf'. The arguments after the
-- direction are the box: least x, least y, largest x, largest y.
outermostSide :: Outward -> Double -> Double -> Double -> Double -> Double
outermostSide outward lx _ hx _ = case outward of
  Leftmost -> lx
  Rightmost -> -hx
{-# INLINE outermostSide #-}

-- | An upper bound of x at the outermost point of polyarc @w@, in mm and multiplied by 'signOf'. It
-- is the x of the outermost vertex of one run, the run whose bounding box reaches furthest out.
-- 'extreme' skips all runs that do not reach this bound.
outermostBound :: Outward -> ClosedPolyarcs -> SegmentBoxTree -> Int -> Double
outermostBound outward c boxes w =
  foldl'
    min
    1e300
    [ signOf outward * indexPrimArray (ClosedPolyarcs.xs c) k
      | k <- [run .. min end (SegmentBoxTree.nextRun run) - 1]
    ]
  where
    start = ClosedPolyarcs.firstVertex c w
    end = ClosedPolyarcs.repeatedVertex c w
    run = furthest start start 1e300
    furthest !i !best !least
      | i >= end = best
      | boxSide < least = furthest (SegmentBoxTree.nextRun i) i boxSide
      | otherwise = furthest (SegmentBoxTree.nextRun i) best least
      where
        boxSide = SegmentBoxTree.runBoxOf boxes i (outermostSide outward)

-- | Passes the outermost point of the circle of arc @i@ to the continuation @k@. Its arguments are:
-- True when the point lies between the ends of the arc; the position of the point along the arc's
-- chord, as a fraction; x of the point in mm, multiplied by @sign@. In this function and those
-- below, @sign@ is 1 for the leftmost point, −1 for the rightmost one.
outermostOfArc :: Double -> ClosedPolyarcs -> Int -> (Bool -> Double -> Double -> r) -> r
outermostOfArc sign c i k = ClosedPolyarcs.chord c i $ \dx dy ->
  let b = indexPrimArray (ClosedPolyarcs.bulges c) i
      co = 1 - b * b
      si = 2 * b
      -- The x components of the arc's directions at its start and its end, multiplied by @sign@.
      -- The first is negative and the second positive when the circle's outermost point lies
      -- between the ends.
      out = sign * (dx * co + dy * si)
      into = sign * (dx * co - dy * si)
      l = sqrt (dx * dx + dy * dy)
      r = l * (1 + b * b) / (4 * abs b)
      cx = indexPrimArray (ClosedPolyarcs.xs c) i + 0.5 * dx - co / (4 * b) * dy
      cy = indexPrimArray (ClosedPolyarcs.ys c) i + 0.5 * dy + co / (4 * b) * dx
      ex = sign * cx - r
      t =
        ( dx * (sign * ex - indexPrimArray (ClosedPolyarcs.xs c) i)
            + dy * (cy - indexPrimArray (ClosedPolyarcs.ys c) i)
        )
          / (l * l)
   in k (out < 0 && into > 0) t ex
{-# INLINE outermostOfArc #-}

-- | The extreme of the polyarc with the number @w@. For @t@ = 0 it is the start of segment @i@. For
-- a fraction @t@ > 0 of the chord it is the outermost point of the segment's circle. @least@ is x
-- of the point in mm, multiplied by @sign@.
extremeAt :: Double -> ClosedPolyarcs -> Int -> Int -> Double -> Double -> Extreme
extremeAt sign c w i t least
  | t > 0 =
    Extreme
      i
      t
      (sign * least)
      (y0 + 0.5 * dyOf + heightOf)
      (Just (if b > 0 then 1 else 0))
  | otherwise = Extreme i 0 (sign * least) y0 (excessAtVertex sign c w i)
  where
    b = indexPrimArray (ClosedPolyarcs.bulges c) i
    y0 = indexPrimArray (ClosedPolyarcs.ys c) i
    dyOf = ClosedPolyarcs.chord c i (\_ dy -> dy)
    heightOf = ClosedPolyarcs.chord c i (\dx _ -> (1 - b * b) / (4 * b) * dx)

-- | The value of 'leftExcess' at the vertex where segment @i@ of polyarc @w@ starts, which is the
-- outermost point of the polyarc: 1 when the polyarc turns left there, else 0. Nothing when the
-- polyarc runs back along itself there.
excessAtVertex :: Double -> ClosedPolyarcs -> Int -> Int -> Maybe Int
excessAtVertex sign c w i
  | abs cross > 1e-9 * size = Just (if cross > 0 then 1 else 0)
  | ix * ox + iy * oy < 0 =
    if abs bent > curvatureTolerance * (abs (bend previous) + abs (bend i))
      then Just (if bent < 0 then 1 else 0)
      else Nothing
  | otherwise = Just (if sign * oy < 0 then 1 else 0)
  where
    previous
      | i == ClosedPolyarcs.firstVertex c w = ClosedPolyarcs.repeatedVertex c w - 1
      | otherwise = i - 1
    bp = indexPrimArray (ClosedPolyarcs.bulges c) previous
    b = indexPrimArray (ClosedPolyarcs.bulges c) i
    ix = ClosedPolyarcs.chord c previous (\dx dy -> dx * (1 - bp * bp) - dy * 2 * bp)
    iy = ClosedPolyarcs.chord c previous (\dx dy -> dy * (1 - bp * bp) + dx * 2 * bp)
    ox = ClosedPolyarcs.chord c i (\dx dy -> dx * (1 - b * b) + dy * 2 * b)
    oy = ClosedPolyarcs.chord c i (\dx dy -> dy * (1 - b * b) - dx * 2 * b)
    cross = ix * oy - iy * ox
    bend = ClosedPolyarcs.curvature c
    -- The curvature of the outgoing segment less that of the reversed incoming one. At a cusp this
    -- is positive when the outgoing segment lies to the left of the reversed incoming one.
    bent = bend previous + bend i
    -- Two segments whose curvatures differ by less than this fraction may be one segment traversed
    -- in both directions.
    curvatureTolerance = 1e-3
    size = sqrt ((ix * ix + iy * iy) * (ox * ox + oy * oy))
