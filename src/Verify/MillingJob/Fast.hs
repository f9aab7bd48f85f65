{-# LANGUAGE BangPatterns #-}

-- | Loops over the elements near a point, for every motion of a tape. They compute the same as
-- "Verify.MillingJob" and "Verify.Edge", but without lists and intermediate records.
module Verify.MillingJob.Fast
  ( foldContacts,
    leastDistance,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Verify.Edge (Edge (..))
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob

-- | Strict left fold over the contact points of a cutter with its centre at @p@. @near@ has to
-- contain all elements within 'MillingJob.contactLimit' of @p@. The function @with@ gets the result
-- so far, the number of the element from 0, and the arc length in mm from the start of the contour
-- to the contact point.
foldContacts :: MillingJob -> [Edge] -> Point -> (b -> Int -> Double -> b) -> b -> b
foldContacts job near p with = go near
  where
    go es !b = case es of
      [] -> b
      e : more
        | far <- farthest e,
          FastDistance.mayLieWithin far (long e) (shape e) x y,
          FastDistance.distance (shape e) x y <= far ->
          go more (with b (rank e) (startsAt e + FastDistance.footOn (shape e) x y * long e))
        | otherwise -> go more b
    !x = Vec.x p
    !y = Vec.y p
    !(Mm limit) = MillingJob.contactLimit job
    !(Mm deviation) = allowance job
    !least = leastExcess (MillingJob.allowanceTowards job p) limit near x y
    farthest e =
      let Mm own = MillingJob.allowanceTowards job p e in min limit (least + own + 2 * deviation)
{-# INLINE foldContacts #-}

-- | Distance in mm from a point to the nearest of some elements, or the limit in mm if no element
-- is nearer. The arguments are the limit, the elements, and the coordinates x and y of the point.
leastDistance :: Double -> [Edge] -> Double -> Double -> Double
leastDistance = leastExcess (const (Mm 0))

-- | Least excess distance in mm of the elements @near@, but at most @limit@. The excess distance of
-- an element is its distance from the point @(x, y)@ minus its allowance, given by @allowanceOf@.
leastExcess :: (Edge -> Mm) -> Double -> [Edge] -> Double -> Double -> Double
leastExcess allowanceOf limit near !x !y = go limit near
  where
    go !d es = case es of
      [] -> d
      e : more
        | Mm a <- allowanceOf e,
          far <- min limit (d + a),
          FastDistance.mayLieWithin far (long e) (shape e) x y ->
          go (min d (FastDistance.distance (shape e) x y - a)) more
        | otherwise -> go d more
{-# INLINE leastExcess #-}
