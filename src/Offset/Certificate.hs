{-# OPTIONS_GHC -O2 #-}

-- | Independent check of the offset kernel: one point of every loop keeps the requested distance
-- from the source. The source is the contours that were offset. The point is the midpoint of the
-- loop's first segment.
--
-- The check uses the source and the finished loops only. It does not depend on the algorithm that
-- made the loops (McConnell et al., "Certifying algorithms"). Loops and segments are given by
-- number from 0; coordinates and distances are in mm.
module Offset.Certificate
  ( Clearance (..),
    isClear,
    coversSource,
  )
where

import Data.Primitive.PrimArray
import Geometry.Carrier (Sense (..))
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Index.SegmentBoxTree (SegmentBoxTree)
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Offset.Loop (OffsetLoops)
import Offset.Loop qualified as Loop

-- | The distances that the cutter's centre has to keep from the source. All are in mm.
data Clearance = Clearance
  { -- | rounding error that each comparison of distances allows
    slack :: Double,
    -- | distance required from every segment of the source; no result of 'distance' is smaller
    leastDistance :: Double,
    -- | the largest result of 'distance'
    largestDistance :: Double,
    -- | distance required from a segment of the source, by the number of the input segment from
    -- which it comes ('ClosedPolyarcs.sources'). It is required only where the cutter's centre is
    -- on the cutter's side of the segment, and an end of the segment is not its nearest point.
    -- Elsewhere 'leastDistance' is required
    distance :: Int -> Double,
    -- | sense of a contour around the cutter: counter-clockwise when the cutter is on the left of
    -- the source
    sense :: Sense
  }

-- | True when the midpoint of the first segment of loop @k@ keeps the distances @measure@ from
-- every segment of the source. @boxes@ is the bounding-box tree of the source.
isClear :: Clearance -> ClosedPolyarcs -> SegmentBoxTree -> OffsetLoops -> Int -> Bool
isClear measure source boxes l k = uncurry (isFarFrom measure source boxes) (witness l k)

-- | True when a cutter whose centre is at the midpoint of the first segment of loop @k@ reaches
-- every segment of the source: its distance from each is at most the required one. If the source is
-- a single contour, the kernel may discard a loop for which this is True and 'isClear' is False.
coversSource :: Clearance -> ClosedPolyarcs -> OffsetLoops -> Int -> Bool
coversSource measure source l k =
  and
    [ fromPoint source i x y (\d _ -> d <= required measure source i + slack measure)
      | i <- [0 .. sizeofPrimArray (ClosedPolyarcs.xs source) - 1],
        not
          ( ClosedPolyarcs.hasMark
              ClosedPolyarcs.repeatedMark
              (indexPrimArray (ClosedPolyarcs.marks source) i)
          )
    ]
  where
    (x, y) = witness l k

-- | The distance in mm that the cutter's centre has to keep from segment @i@ of the source, given
-- by 'distance'.
required :: Clearance -> ClosedPolyarcs -> Int -> Double
required measure source i =
  distance measure (fromIntegral (indexPrimArray (ClosedPolyarcs.sources source) i))

-- | The midpoint, x and y in mm, of the first segment of loop @k@.
witness :: OffsetLoops -> Int -> (Double, Double)
witness l k = (x0 + 0.5 * (dx + b * dy), y0 + 0.5 * (dy - b * dx))
  where
    i = indexPrimArray (Loop.starts l) k
    j = if i + 1 == indexPrimArray (Loop.starts l) (k + 1) then i else i + 1
    (x0, y0) = (indexPrimArray (Loop.xs l) i, indexPrimArray (Loop.ys l) i)
    (dx, dy) = (indexPrimArray (Loop.xs l) j - x0, indexPrimArray (Loop.ys l) j - y0)
    b = indexPrimArray (Loop.bulges l) i

-- | True when the point (@x@, @y@) keeps the distances @measure@ from every segment of the source.
isFarFrom :: Clearance -> ClosedPolyarcs -> SegmentBoxTree -> Double -> Double -> Bool
isFarFrom measure source boxes x y =
  SegmentBoxTree.around boxes (x - widest) (y - widest) (x + widest) (y + widest) True $ \isFar i ->
    isFar
      && fromPoint
        source
        i
        x
        y
        ( \d footDepth ->
            d
              >= ( if footDepth > slack measure && isFacing i
                     then required measure source i
                     else leastDistance measure
                 )
                - slack measure
        )
  where
    widest = largestDistance measure
    isFacing i = case sense measure of
      CounterClockwise -> isLeftOf source i x y
      Clockwise -> not (isLeftOf source i x y)

-- | True when the point (@x@, @y@) lies on the left of segment @i@: on the left of a line, inside
-- the circle of a counter-clockwise arc, or outside the circle of a clockwise one.
isLeftOf :: ClosedPolyarcs -> Int -> Double -> Double -> Bool
isLeftOf c i x y
  | b == 0 =
    ClosedPolyarcs.chord c i $ \ux uy ->
      ux * (y - indexPrimArray (ClosedPolyarcs.ys c) i)
        - uy * (x - indexPrimArray (ClosedPolyarcs.xs c) i)
        > 0
  | otherwise = ClosedPolyarcs.power c i x y * b < 0
  where
    b = indexPrimArray (ClosedPolyarcs.bulges c) i

-- | Passes two lengths in mm to the continuation @k@: the distance of the point (@x@, @y@) from
-- segment @i@, and the depth of the foot. The foot is the point of the segment that is nearest to
-- (@x@, @y@). On a line its depth is its distance from the nearer end. On an arc its depth is its
-- distance from the nearer one of the two radii that lead to the ends. The depth is zero or
-- negative when the foot is an end.
fromPoint :: ClosedPolyarcs -> Int -> Double -> Double -> (Double -> Double -> r) -> r
fromPoint c i x y k
  | b == 0 = ClosedPolyarcs.chord c i $ \ux uy ->
    let square = ux * ux + uy * uy
        along = (ux * ax + uy * ay) / square
        t = max 0 (min 1 along)
     in k (hypotenuse (ax - t * ux) (ay - t * uy)) (min along (1 - along) * sqrt square)
  | inSector > 0 =
    k
      ( abs (ClosedPolyarcs.power c i x y)
          / (0.5 * hypotenuse gx gy + 0.5 * ClosedPolyarcs.diameter c i)
      )
      inSector
  | otherwise = k (min (hypotenuse ax ay) (hypotenuse bx by)) inSector
  where
    b = indexPrimArray (ClosedPolyarcs.bulges c) i
    x0 = indexPrimArray (ClosedPolyarcs.xs c) i
    y0 = indexPrimArray (ClosedPolyarcs.ys c) i
    x1 = indexPrimArray (ClosedPolyarcs.xs c) (i + 1)
    y1 = indexPrimArray (ClosedPolyarcs.ys c) (i + 1)
    (ax, ay) = (x - x0, y - y0)
    (bx, by) = (x - x1, y - y1)
    (gx, gy) = ClosedPolyarcs.gradient c i x y (,)
    (px, py) = ClosedPolyarcs.gradient c i x0 y0 (,)
    (qx, qy) = ClosedPolyarcs.gradient c i x1 y1 (,)
    -- The depth of the foot on an arc, in mm: the smaller one of its distances from the radii to
    -- both ends. It is negative when the point (@x@, @y@) is outside the sector between them.
    inSector =
      0.5
        * min (signum b * (px * gy - py * gx)) (signum b * (gx * qy - gy * qx))
          / max 1e-300 (hypotenuse gx gy)
    hypotenuse u v = sqrt (u * u + v * v)
{-# INLINE fromPoint #-}
