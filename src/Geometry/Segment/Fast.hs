{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Elementary operations on segments, computed on unpacked coordinates, for loops over many
-- segments. Their results are those of "Geometry.Segment", but for rounding errors. No intermediate
-- points and vectors are built.
--
-- A point is given by the numbers x and y in mm. The foot of a point on a segment is where the
-- perpendicular from the point meets the segment's line or circle. The sector of an arc is the
-- region between the rays from its centre through its ends, on the side of the arc.
module Geometry.Segment.Fast
  ( Coordinates (..),
    coordinates,
    spot,
    isLine,
    begin,
    finish,
    lengthOf,
    at,
    uneven,
    hypotenuse,
    bearing,
    inSector,
    isWhole,
    box,
    shareOf,
    foot,
    footOn,
    divided,
    between,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point (Point))

-- | Coordinates of a segment in mm. A line has x and y of its start and of its end. An arc has x
-- and y of its start, of its end and of its centre, then its radius in mm and its sweep in radians.
-- Since 'coordinates' is inlined, no value of this type is built at run time.
data Coordinates
  = LineAt Double Double Double Double
  | ArcAt Double Double Double Double Double Double Double Double

-- | Coordinates of a segment. An arc's radius is the distance of its centre from its start.
coordinates :: Segment -> Coordinates
coordinates s = case s of
  Straight (Point ax ay) (Point bx by) -> LineAt ax ay bx by
  Arc (Point ax ay) (Point bx by) (Point cx cy) (Rad angle) ->
    ArcAt ax ay bx by cx cy (hypotenuse (cx - ax) (cy - ay)) angle
{-# INLINE coordinates #-}

-- | Segment of length 0 at the point (@x@, @y@).
spot :: Double -> Double -> Segment
spot x y = Straight (Point x y) (Point x y)

-- | True for a line, false for an arc.
isLine :: Segment -> Bool
isLine segment = case coordinates segment of
  LineAt {} -> True
  ArcAt {} -> False

-- | Start of a segment, or its end, as x and y in mm.
begin, finish :: Segment -> (Double, Double)
begin t = case coordinates t of
  LineAt ax ay _ _ -> (ax, ay)
  ArcAt ax ay _ _ _ _ _ _ -> (ax, ay)
finish t = case coordinates t of
  LineAt _ _ bx by -> (bx, by)
  ArcAt _ _ bx by _ _ _ _ -> (bx, by)
{-# INLINE begin #-}
{-# INLINE finish #-}

-- | Length of a segment in mm.
lengthOf :: Segment -> Double
lengthOf e = case coordinates e of
  LineAt ax ay bx by -> hypotenuse (bx - ax) (by - ay)
  ArcAt _ _ _ _ _ _ r s -> r * abs s

-- | Point at the fraction @t@ of a segment's length from its start, as x and y in mm.
at :: Segment -> Double -> (Double, Double)
at e !t = case coordinates e of
  LineAt ax ay bx by -> (ax + t * (bx - ax), ay + t * (by - ay))
  ArcAt ax ay _ _ cx cy _ s ->
    let c =
          cos (t * s)
        n = sin (t * s)
        vx = ax - cx
        vy = ay - cy
     in (cx + c * vx - n * vy, cy + n * vx + c * vy)
{-# INLINE at #-}

-- | Absolute difference, in mm, between the distances of an arc's two ends from its centre; 0 for a
-- line. An arc whose ends are rounded to whole pulses has such a difference.
uneven :: Segment -> Double
uneven segment = case coordinates segment of
  LineAt {} -> 0
  ArcAt _ _ bx by cx cy r _ -> abs (hypotenuse (bx - cx) (by - cy) - r)

-- | Length of the vector with the components @a@ and @b@.
hypotenuse :: Double -> Double -> Double
hypotenuse a b = sqrt (a * a + b * b)
{-# INLINE hypotenuse #-}

-- | Position of the point (@px@, @py@) relative to the sector of an arc. The arc has the start
-- (@ax@, @ay@), the end (@bx@, @by@) and the centre (@cx@, @cy@) in mm, and the sweep @s@ in
-- radians. The result is passed to the continuation @k@, a function of three numbers. Each number
-- is a length times the arc's radius, in mm²:
--
-- 1. the distance of the point from the line through the centre and the start; it is positive past
--    the start in the arc's sense
--
-- 2. the distance of the point from the line through the centre and the end; it is positive before
--    the end in the arc's sense
--
-- 3. the distance from the centre to the foot of the point on the first line; it is positive on the
--    side of the start
bearing ::
  Double ->
  Double ->
  Double ->
  Double ->
  Double ->
  Double ->
  Double ->
  Double ->
  Double ->
  (Double -> Double -> Double -> r) ->
  r
bearing ax ay bx by cx cy s px py k =
  k
    (sense * ((ax - cx) * vy - (ay - cy) * vx))
    (sense * (vx * (by - cy) - vy * (bx - cx)))
    ((ax - cx) * vx + (ay - cy) * vy)
  where
    sense = if s > 0 then 1 else -1
    vx = px - cx
    vy = py - cy
{-# INLINE bearing #-}

-- | True if the point (@px@, @py@) lies in the sector of an arc. False for a line.
inSector :: Segment -> Double -> Double -> Bool
inSector segment !px !py = case coordinates segment of
  LineAt {} -> False
  ArcAt ax ay bx by cx cy _ s ->
    bearing ax ay bx by cx cy s px py $ \pastStart beforeEnd along ->
      if abs s > pi
        then pastStart >= 0 || beforeEnd >= 0 || abs s > 3 / 2 * pi && along <= 0
        else pastStart >= 0 && beforeEnd >= 0 && (abs s > pi / 2 || along >= 0)

-- | True if the sweep @s@, in radians, is that of a full circle.
isWhole :: Double -> Bool
isWhole s = abs s >= 2 * pi

-- | Box that contains a segment. For an arc of radius r with a sweep φ of less than a half circle,
-- it is the box of the arc's ends, inflated by @r·φ²/8@. This is an upper bound of the sagitta
-- @r·(1 − cos(φ/2))@. For other arcs it is the box of the full circle.
box :: Segment -> BoundingBox
box segment = case coordinates segment of
  LineAt ax ay bx by -> BoundingBox (min ax bx) (min ay by) (max ax bx) (max ay by)
  ArcAt ax ay bx by cx cy r s
    | abs s < pi ->
      BoundingBox.inflate
        (Mm (r * s * s / 8))
        (BoundingBox (min ax bx) (min ay by) (max ax bx) (max ay by))
    | otherwise -> BoundingBox (cx - r) (cy - r) (cx + r) (cy + r)

-- | Foot of the point (@px@, @py@) on the line from the point (@ax@, @ay@) to the point
-- (@bx@, @by@). The result is a fraction of the distance between these two: 0 at the first, 1 at
-- the second. It is 0 if they coincide.
shareOf :: Double -> Double -> Double -> Double -> Double -> Double -> Double
shareOf ax ay bx by px py =
  let ux =
        bx - ax
      uy = by - ay
      uu = ux * ux + uy * uy
   in if uu > 0 then (ux * (px - ax) + uy * (py - ay)) / uu else 0
{-# INLINE shareOf #-}

-- | Foot of the point (@x@, @y@) on a segment, as a fraction of the segment's length. For a line it
-- is negative before the start and above 1 after the end; for an arc of sweep φ it lies in
-- [0, 2π/|φ|).
foot :: Segment -> Double -> Double -> Double
foot e !x !y = case coordinates e of
  LineAt ax ay bx by -> shareOf ax ay bx by x y
  ArcAt ax ay _ _ cx cy _ s ->
    let vx = ax - cx
        vy = ay - cy
        turned = atan2 (vx * (y - cy) - vy * (x - cx)) (vx * (x - cx) + vy * (y - cy)) / s
     in if turned < 0 then turned + 2 * pi / abs s else turned

-- | Position of the segment's point that is nearest to the point (@px@, @py@), as a fraction of the
-- segment's length from 0 to 1.
footOn :: Segment -> Double -> Double -> Double
footOn e !px !py = case coordinates e of
  LineAt ax ay bx by -> max 0 (min 1 (shareOf ax ay bx by px py))
  ArcAt ax ay bx by _ _ _ _
    | inSector e px py -> max 0 (min 1 (foot e px py))
    | hypotenuse (px - ax) (py - ay) <= hypotenuse (px - bx) (py - by) -> 0
    | otherwise -> 1

-- | The parts of a segment before and after the foot of the point (@x@, @y@) on it. Nothing if the
-- foot does not lie between the ends.
divided :: Double -> Double -> Segment -> Maybe (Segment, Segment)
divided x y e
  | isAbout, m > 0, m < 1 = Just (between e 0 m, between e m 1)
  | otherwise = Nothing
  where
    m = foot e x y
    isAbout = isLine e || inSector e x y

-- | Part of a segment from the fraction @a@ of its length to the fraction @b@.
between :: Segment -> Double -> Double -> Segment
between e a b = case coordinates e of
  LineAt {} -> Straight p q
  ArcAt _ _ _ _ cx cy _ s -> Arc p q (Point cx cy) (Rad (s * (b - a)))
  where
    p = pointAt a
    q = pointAt b
    pointAt t = let (x, y) = at e t in Point x y
