-- | Distances of a curve from an arc, by a bound in closed form.
--
-- Take coordinates with the origin at an arc's start, x along its direction and y to its left. The
-- circle with the curvature k is the zero set of @F = y − k·(x² + y²)/2@. Where @|k·F|@ is well
-- below 1, a point is at most @|F|·(1 + |k·F|)@ away from the circle. The largest value of |F|
-- along a curve therefore bounds the distance from the curve to the arc.
--
-- The foot of a point is the point of the arc that is nearest to it. A curve runs forwards if its
-- direction makes an angle of less than a quarter turn with the arc's directions at both ends. Then
-- the feet of the curve's points cover the whole arc, and the same bound holds from the arc to the
-- curve. A pose is a position in mm with a direction of length 1.
module Geometry.ArcFitting.ArcDistance
  ( -- * Arcs
    FastArc (..),
    fastArc,
    isForwards,
    beyond,
    runsForwards,
    isForwardsBy,

    -- * The function F
    level,
    above,
    slope,
    distanceOfLevel,
  )
where

import Geometry.ArcFitting.Biarc.Fast (Pose (..))

-- | Arc with the poses at its start (@origin@) and at its end (@limit@). @bend@ is its curvature in
-- 1/mm, positive to the left; @cosine@ and @sine@ are those of its sweep.
data FastArc = FastArc
  { origin :: {-# UNPACK #-} Pose,
    bend :: Double,
    limit :: {-# UNPACK #-} Pose,
    cosine :: Double,
    sine :: Double
  }

-- | Arc from the pose at its start, its curvature in 1/mm, positive to the left, and the pose at
-- its end.
fastArc :: Pose -> Double -> Pose -> FastArc
fastArc origin bend limit =
  FastArc
    { origin,
      bend,
      limit,
      cosine = dx origin * dx limit + dy origin * dy limit,
      sine = dx origin * dy limit - dy origin * dx limit
    }
{-# INLINE fastArc #-}

-- | True if an arc sweeps less than a quarter turn, as the bound of the distance requires.
isForwards :: FastArc -> Bool
isForwards f = cosine f > 0
{-# INLINE isForwards #-}

-- | Signed distance in mm of the position (@x@, @y@) from the normal at the end of arc @f@. It is
-- positive beyond the end.
beyond :: FastArc -> Double -> Double -> Double
beyond f x y = (x - px (limit f)) * dx (limit f) + (y - py (limit f)) * dy (limit f)
{-# INLINE beyond #-}

-- | True if a curve with the direction of pose @p@ runs forwards, that is, if this direction makes
-- an angle of less than a quarter turn with the directions of arc @f@ at both ends.
runsForwards :: FastArc -> Pose -> Bool
runsForwards f p =
  isForwardsBy
    f
    (dx p * dx (origin f) + dy p * dy (origin f))
    (dy p * dx (origin f) - dx p * dy (origin f))
{-# INLINE runsForwards #-}

-- | True if a direction makes an angle of less than a quarter turn with an arc's directions at both
-- ends. The direction is given by its component @along@ the arc's direction at the start, and by
-- its component @across@, to the left of the former.
isForwardsBy :: FastArc -> Double -> Double -> Bool
isForwardsBy f along across = along > 0 && along * cosine f + across * sine f > 0
{-# INLINE isForwardsBy #-}

-- | The function F of the module header, in mm, for the circle of an arc, at the position of a
-- pose.
level :: FastArc -> Pose -> Double
level f = above (bend f) (origin f)
{-# INLINE level #-}

-- | F, in mm, at the position of the second pose. The circle has the curvature @k@ (1/mm) and
-- passes the pose @from@ in its direction.
above :: Double -> Pose -> Pose -> Double
above k from p = uy * dx from - ux * dy from - 0.5 * k * (ux * ux + uy * uy)
  where
    ux = px p - px from
    uy = py p - py from
{-# INLINE above #-}

-- | Derivative at pose @p@ of the function F of arc @f@, by the arc length of a curve that passes
-- this pose in its direction.
slope :: FastArc -> Pose -> Double
slope f p =
  (dy p * dx (origin f) - dx p * dy (origin f))
    - bend f * ((px p - px (origin f)) * dx p + (py p - py (origin f)) * dy p)
{-# INLINE slope #-}

-- | Bound in mm of the distance of a point from an arc, if |F| at the point is @d@ mm. The bound is
-- infinite if @d@ is too large for it to hold.
distanceOfLevel :: FastArc -> Double -> Double
distanceOfLevel f d = if k * d < 0.2 then d * (1 + k * d) else 1 / 0
  where
    k = abs (bend f)
{-# INLINE distanceOfLevel #-}
