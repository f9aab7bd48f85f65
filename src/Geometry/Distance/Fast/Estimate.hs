{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Distances of two segments and bounds of these, computed on unpacked coordinates.
--
-- "Geometry.Distance.Fast" uses them to compare one segment with several others.
--
-- A comment "True only if" means that a result True is certain, in spite of rounding errors. A
-- result False then proves nothing, and the caller compares exactly by "Geometry.Distance". "False
-- only if" means that a result False is certain. Then a result True proves nothing.
--
-- A point is given by the numbers x and y in mm. The foot of a point on a segment is where the
-- perpendicular from the point meets the segment's carrier.
module Geometry.Distance.Fast.Estimate
  ( unsure,
    never,

    -- * Points
    distance,
    mayLieWithin,
    spansAbout,

    -- * Lower bounds
    mayComeWithin,
    apart,
    apartAtLeast,

    -- * Upper bounds
    beside,
    furthest,
    isWithin,

    -- * Sides and carriers
    isLeftOf,
    isRightOf,
    DistanceRange (..),
    spanFrom,
    across,
  )
where

import Geometry.Segment (Segment (..))
import Geometry.Segment.Fast
import Geometry.Vec (Point (Point))

-- | Allowance for rounding errors in comparisons of distances, in mm. In a part 20 m long, rounding
-- changes a distance by less than a hundredth of this allowance.
unsure :: Double
unsure = 1e-8

-- | Infinite distance, in mm. It replaces a distance from a point that does not exist, or a bound
-- that was not found.
never :: Double
never = 1 / 0

-- | Distance, in mm, of the point (@px@, @py@) from a segment.
distance :: Segment -> Double -> Double -> Double
distance segment !px !py = case coordinates segment of
  LineAt ax ay bx by ->
    let ux = bx - ax
        uy = by - ay
        vx = px - ax
        vy = py - ay
        uu = ux * ux + uy * uy
        along = ux * vx + uy * vy
     in if along <= 0 || uu <= 0
          then hypotenuse vx vy
          else
            if along >= uu
              then hypotenuse (px - bx) (py - by)
              else abs (ux * vy - uy * vx) / sqrt uu
  ArcAt ax ay bx by cx cy r _
    | inSector segment px py -> abs (hypotenuse (px - cx) (py - cy) - r)
    | otherwise -> min (hypotenuse (px - ax) (py - ay)) (hypotenuse (px - bx) (py - by))

-- | False only if the point (@px@, @py@) is further than @most@ from a segment whose length is
-- @long@; both are in mm. If it is false, the caller need not compute the exact distance. Only the
-- distance from the segment's start is computed: no point of the segment is further than @long@
-- from its start.
mayLieWithin :: Double -> Double -> Segment -> Double -> Double -> Bool
mayLieWithin most long segment !px !py = case coordinates segment of
  LineAt ax ay _ _ -> about (px - ax) (py - ay)
  ArcAt ax ay _ _ _ _ _ _ -> about (px - ax) (py - ay)
  where
    about vx vy = let d = most + long + unsure in vx * vx + vy * vy <= d * d
    {-# INLINE about #-}
{-# INLINE mayLieWithin #-}

-- | False only if the foot of the point (@px@, @py@) lies before the start of a segment or after
-- its end. Always true for an arc of more than half a turn.
spansAbout :: Segment -> Double -> Double -> Bool
spansAbout e !px !py = case coordinates e of
  LineAt ax ay bx by -> let t = shareOf ax ay bx by px py in t >= -1e-9 && t <= 1 + 1e-9
  ArcAt _ _ _ _ _ _ _ s -> abs s > pi || pastArc e px py <= unsure

-- | False only if every point of the segment @e@, whose length is @long@, is further than @most@
-- from the carrier of the segment @t@; both lengths are in mm. If it is false, the caller need not
-- compute the exact distance. Only the distance of the start of @e@ is computed.
mayComeWithin :: Double -> Double -> Segment -> Segment -> Bool
mayComeWithin most long e t = case coordinates t of
  LineAt px py qx qy ->
    let ux = qx - px
        uy = qy - py
        side = ux * (y - py) - uy * (x - px)
     in side * side <= far * far * (ux * ux + uy * uy)
  ArcAt _ _ _ _ cx cy r _ ->
    let vv = (x - cx) * (x - cx) + (y - cy) * (y - cy)
     in vv <= (r + far) * (r + far) && (r <= far || vv >= (r - far) * (r - far))
  where
    far = most + long + unsure
    (x, y) = begin e
{-# INLINE mayComeWithin #-}

-- | Least distance, in mm, between two segments, exact but for rounding errors; 0 if they
-- intersect.
apart :: Segment -> Segment -> Double
apart a b
  | cross a b = 0
  | otherwise = min (ends a b) (min (ends b a) (min (normals a b) (normals b a)))
  where
    ends c other = case coordinates c of
      LineAt ax ay bx by -> min (distance other ax ay) (distance other bx by)
      ArcAt ax ay bx by _ _ _ _ -> min (distance other ax ay) (distance other bx by)

-- | True if two segments intersect. If they touch with a common tangent, rounding may make it
-- false; 'apart' then finds the point of contact at an end or on a common normal.
cross :: Segment -> Segment -> Bool
cross a b = case (coordinates a, coordinates b) of
  (LineAt ax ay bx by, LineAt cx cy dx dy) ->
    let side x y = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        side' x y = (dx - cx) * (y - cy) - (dy - cy) * (x - cx)
     in side cx cy * side dx dy <= 0 && side' ax ay * side' bx by <= 0 && boxesMeet
    where
      boxesMeet =
        max (min ax bx) (min cx dx) <= min (max ax bx) (max cx dx)
          && max (min ay by) (min cy dy) <= min (max ay by) (max cy dy)
  (LineAt ax ay bx by, ArcAt _ _ _ _ cx cy r _) ->
    let ux = bx - ax
        uy = by - ay
        l = hypotenuse ux uy
        along = (ux * (cx - ax) + uy * (cy - ay)) / l
        off = (ux * (cy - ay) - uy * (cx - ax)) / l
        half = sqrt (r * r - off * off)
        meets t = t >= 0 && t <= l && inSector b (ax + t * ux / l) (ay + t * uy / l)
     in l > 0 && abs off <= r && (meets (along - half) || meets (along + half))
  (ArcAt {}, LineAt {}) -> cross b a
  (ArcAt _ _ _ _ cx cy r _, ArcAt _ _ _ _ dx dy q _) ->
    let ex = dx - cx
        ey = dy - cy
        ee = ex * ex + ey * ey
        e = sqrt ee
        along = (ee + r * r - q * q) / (2 * e)
        half = sqrt (r * r - along * along)
        meets sense =
          let x = cx + (along * ex - sense * half * ey) / e
              y = cy + (along * ey + sense * half * ex) / e
           in inSector a x y && inSector b x y
     in e > 0 && abs along <= r && (meets 1 || meets (-1))

-- | Distance, in mm, of the segment @b@ from a point of @a@ at which the normal of @a@ passes
-- through the centre of @b@. If there are two such points, it is the smaller distance. It is
-- infinite if there is no such point, or if @b@ is a line.
normals :: Segment -> Segment -> Double
normals a b = case (coordinates a, coordinates b) of
  (LineAt ax ay bx by, ArcAt _ _ _ _ cx cy _ _) ->
    let t = shareOf ax ay bx by cx cy
     in if t > 0 && t < 1 then distance b (ax + t * (bx - ax)) (ay + t * (by - ay)) else never
  (ArcAt _ _ _ _ cx cy r _, ArcAt _ _ _ _ dx dy _ _) ->
    let ex = dx - cx
        ey = dy - cy
        e = hypotenuse ex ey
        from sense =
          let x =
                cx + sense * r * ex / e
              y = cy + sense * r * ey / e
           in if inSector a x y then distance b x y else never
     in if e > 0 then min (from 1) (from (-1)) else never
  _ -> never

-- | Lower bound of the distance, in mm, between two segments: the distance of the segment @e@ from
-- the carrier of the segment @t@. It is exact if the point of @e@ nearest to that carrier has its
-- foot on @t@.
apartAtLeast :: Segment -> Segment -> Double
apartAtLeast t e = case coordinates t of
  LineAt px py qx qy -> case across px py qx qy e of
    DistanceRange low high
      | low > 0 -> low
      | high < 0 -> negate high
      | otherwise -> 0
  ArcAt _ _ _ _ cx cy r _ -> case spanFrom cx cy e of
    DistanceRange low high
      | low > r -> low - r
      | high < r -> r - high
      | otherwise -> 0

-- | Upper bound, in mm, of the distance of any point of the segment @e@ from the segment @t@. It is
-- exact if the same end of @t@ is nearest to all points of @e@. It is also exact if every point of
-- @e@ has its foot on @t@, unless @t@ is an arc of more than half a turn and not a full circle.
furthest :: Segment -> Segment -> Double
furthest e t =
  min
    (beside e t)
    ( case coordinates t of
        LineAt ax ay bx by ->
          fromEnds ax ay bx by
        ArcAt ax ay bx by _ _ _ _ -> fromEnds ax ay bx by
    )
  where
    fromEnds ax ay bx by = min (fromPoint e ax ay) (fromPoint e bx by)

-- | True only if every point of the segment @e@ lies within @most@, in mm, of the segment @t@. The
-- caller must first reduce @most@ by an allowance for rounding errors, such as @2·unsure@. The
-- start of @e@ is tested before everything else, since it decides most cases.
isWithin :: Double -> Segment -> Segment -> Bool
isWithin most e t = atBegin && (beside e t <= most || fromEnds)
  where
    fromEnds = case coordinates t of
      LineAt ax ay bx by -> fromPoint e ax ay <= most || fromPoint e bx by <= most
      ArcAt ax ay bx by _ _ _ _ -> fromPoint e ax ay <= most || fromPoint e bx by <= most
    atBegin = case coordinates e of
      LineAt ax ay _ _ -> distance t ax ay <= most
      ArcAt ax ay _ _ _ _ _ _ -> distance t ax ay <= most

-- | Greatest distance, in mm, of a segment's points from the point (@px@, @py@).
fromPoint :: Segment -> Double -> Double -> Double
fromPoint e px py = case coordinates e of
  LineAt ax ay bx by -> max (hypotenuse (ax - px) (ay - py)) (hypotenuse (bx - px) (by - py))
  ArcAt ax ay bx by cx cy r _ ->
    let d = hypotenuse (cx - px) (cy - py)
        ends = max (hypotenuse (ax - px) (ay - py)) (hypotenuse (bx - px) (by - py))
     in if d > 0 && inSector e (cx + (cx - px)) (cy + (cy - py))
          then d + r
          else
            if d > 0
              then ends
              else max ends r

-- | Upper bound, in mm, of the distance of any point of the segment @e@ from the segment @t@. For
-- two lines it is exact. For other segments it is infinite if a point of @e@ lies past an end of
-- @t@ by more than 'overlap', or if @t@ is an arc of more than half a turn and not a full circle.
-- It may also be infinite if a point of @e@ lies past an end of an arc @t@ by less.
beside :: Segment -> Segment -> Double
beside e t = case (e, t) of
  (Straight (Point ax ay) (Point bx by), Straight {}) -> max (distance t ax ay) (distance t bx by)
  (Straight {}, Arc {}) -> lineBesideArc e t
  (Arc {}, Straight {}) -> arcBesideLine e t
  (Arc {}, Arc {}) -> arcBesideArc e t

-- | The upper bound that 'beside' gives, for a line @e@ and an arc @t@.
lineBesideArc :: Segment -> Segment -> Double
lineBesideArc e t = case (coordinates e, coordinates t) of
  (LineAt ax ay bx by, ArcAt _ _ _ _ cx cy r s)
    | abs s <= pi || isWhole s ->
      let !near = distance e cx cy
          !high =
            max
              (abs (near - r))
              ( max
                  (abs (hypotenuse (ax - cx) (ay - cy) - r))
                  (abs (hypotenuse (bx - cx) (by - cy) - r))
              )
       in aside high (max (pastArc t ax ay) (pastArc t bx by)) near r
  _ -> never

-- | The upper bound that 'beside' gives, for an arc @e@ and a line @t@.
arcBesideLine :: Segment -> Segment -> Double
arcBesideLine e t = case (coordinates e, coordinates t) of
  (ArcAt ax ay bx by cx cy r _, LineAt px py qx qy) ->
    let ux = qx - px
        uy = qy - py
        l = hypotenuse ux uy
        (ix, iy) = (ux / l, uy / l)
        height x y = abs (ix * (y - py) - iy * (x - px))
        past x y = let f = ix * (x - px) + iy * (y - py) in max 0 (max (negate f) (f - l))
        outermost x y = if inSector e x y then height x y else 0
        furthestPast x y = if inSector e x y then past x y else 0
        !high =
          max
            (max (height ax ay) (height bx by))
            (max (outermost (cx - r * iy) (cy + r * ix)) (outermost (cx + r * iy) (cy - r * ix)))
        furthestEnd =
          max
            (max (past ax ay) (past bx by))
            ( max
                (furthestPast (cx + r * ix) (cy + r * iy))
                (furthestPast (cx - r * ix) (cy - r * iy))
            )
     in if l > 0 then aside high furthestEnd l 0 else never
  _ -> never

-- | 'beside' for two arcs.
arcBesideArc :: Segment -> Segment -> Double
arcBesideArc e t = case (coordinates e, coordinates t) of
  (ArcAt ax ay bx by cx cy r _, ArcAt px py qx qy dx dy q z)
    | q > 0 && (abs z <= pi || isWhole z) ->
      let off = hypotenuse (cx - dx) (cy - dy)
          away x y = hypotenuse (x - dx) (y - dy)
          -- The distance from the centre of the arc @t@ to points of the arc @e@ is extreme at the
          -- ends of @e@ and on the line through both centres.
          onLine sense =
            let f = sense * r / off
             in off > 0 && inSector e (cx + f * (cx - dx)) (cy + f * (cy - dy))
          !hasFarPoint = onLine 1
          !hasNearPoint = onLine (-1)
          !high =
            max
              (max (abs (away ax ay - q)) (abs (away bx by - q)))
              ( max
                  (if hasFarPoint then abs (off + r - q) else 0)
                  (if hasNearPoint then abs (abs (off - r) - q) else 0)
              )
          farPoint = if hasFarPoint then off + r else never
          nearPoint = if hasNearPoint then abs (off - r) else never
          near = min (min (away ax ay) (away bx by)) (min farPoint nearPoint)
          -- Let P be the point of the arc @e@ that is furthest past the end Q of the arc @t@. Then
          -- P is an end of @e@, or the radius of @e@ to P is perpendicular to the radius of @t@ to
          -- Q.
          squarePast x y sense =
            let f = sense * r / q
                u = cx - f * (y - dy)
                v = cy + f * (x - dx)
             in if inSector e u v then pastArc t u v else 0
          !past =
            max
              (max (pastArc t ax ay) (pastArc t bx by))
              ( max
                  (max (squarePast px py 1) (squarePast px py (-1)))
                  (max (squarePast qx qy 1) (squarePast qx qy (-1)))
              )
          {-# INLINE away #-}
          {-# INLINE onLine #-}
          {-# INLINE squarePast #-}
       in aside high past near q
  _ -> never

-- | Upper bound, in mm, of the distances of several points from a segment. It follows from four
-- lengths in mm. @high@ is the points' largest distance from the segment's carrier. @past@ is their
-- largest distance past an end. For an arc, @near@ is their least distance from its centre and @r@
-- its radius; for a line, @r@ is 0. The bound is infinite if @past@ exceeds 'overlap' or, for an
-- arc, if @past@ is at least a hundredth of @near@.
--
-- Let a point have the distance ρ from the centre of an arc with the radius r, and lie past its end
-- by the angle φ. The square of its distance from the end is @(ρ − r)² + 4·ρ·r·sin²(φ/2)@. If
-- @sin φ@ is at most a hundredth, this is less than @(ρ − r)² + 1.001·(r/ρ)·(ρ·sin φ)²@.
aside :: Double -> Double -> Double -> Double -> Double
aside high past near r
  | past <= 0 = high
  | past > overlap = never
  | r <= 0 = sqrt (high * high + past * past)
  | near > 100 * past = sqrt (high * high + past * past * 1.001 * r / near)
  | otherwise = never
{-# INLINE aside #-}

-- | Greatest distance past the end of a segment, in mm, for which 'aside' gives a bound.
overlap :: Double
overlap = 0.1

-- | Distance, in mm, of the point (@px@, @py@) past an end of an arc: its distance from the line
-- through the arc's centre and this end. If the point lies past both ends, it is the larger of both
-- distances; if the point lies in the arc's sector, it is 0. The arc must sweep at most half a
-- turn, or be a full circle. For an arc of at most a quarter turn, the distance is infinite if the
-- angle at the centre between the point and the arc's start is obtuse. It is infinite for a line.
pastArc :: Segment -> Double -> Double -> Double
pastArc t !px !py = case coordinates t of
  LineAt {} -> never
  ArcAt ax ay bx by cx cy r s
    | isWhole s -> 0
    | otherwise -> bearing ax ay bx by cx cy s px py $ \pastStart beforeEnd along ->
      if abs s <= pi / 2 && along < 0
        then never
        else max 0 (max (negate pastStart) (negate beforeEnd) / r)

-- | True only if every point of the segment @t@ lies to the left of the carrier of the segment @e@.
-- The left of a counter-clockwise arc is the inside of its circle.
isLeftOf :: Segment -> Segment -> Bool
isLeftOf t e = case coordinates e of
  LineAt ax ay bx by -> case across ax ay bx by t of DistanceRange low _ -> low > unsure
  ArcAt _ _ _ _ cx cy r s ->
    if s > 0 then isInside cx cy (r - unsure) t else isOutside cx cy (r + unsure) t

-- | True only if every point of the segment @t@ lies to the right of the carrier of the segment
-- @e@. The right of a counter-clockwise arc is the outside of its circle.
isRightOf :: Segment -> Segment -> Bool
isRightOf t e = case coordinates e of
  LineAt ax ay bx by -> case across ax ay bx by t of DistanceRange _ high -> high < -unsure
  ArcAt _ _ _ _ cx cy r s ->
    if s > 0 then isOutside cx cy (r + unsure) t else isInside cx cy (r - unsure) t

-- | 'isInside' is true if all points of the segment @t@ lie inside a circle, 'isOutside' if all lie
-- outside of it. The circle has the centre (@cx@, @cy@) and the radius @r@, in mm.
isInside, isOutside :: Double -> Double -> Double -> Segment -> Bool
isInside cx cy r t = case spanFrom cx cy t of DistanceRange _ high -> high < r
isOutside cx cy r t = case spanFrom cx cy t of DistanceRange low _ -> low > r

-- | Least and greatest value of a distance in mm.
data DistanceRange = DistanceRange Double Double

-- | Least and greatest distance of the segment @e@ from the point (@px@, @py@).
spanFrom :: Double -> Double -> Segment -> DistanceRange
spanFrom !px !py e = case coordinates e of
  LineAt ax ay bx by ->
    DistanceRange
      (distance e px py)
      (max (hypotenuse (ax - px) (ay - py)) (hypotenuse (bx - px) (by - py)))
  ArcAt ax ay bx by cx cy r _ ->
    let a = hypotenuse (ax - px) (ay - py)
        b = hypotenuse (bx - px) (by - py)
        ux = cx - px
        uy = cy - py
        off = hypotenuse ux uy
        onLine f = inSector e (cx + f * ux) (cy + f * uy)
     in if off > 0
          then
            DistanceRange
              (if onLine (negate r / off) then abs (off - r) else min a b)
              (if onLine (r / off) then off + r else max a b)
          else DistanceRange r r

-- | Least and greatest signed distance of the segment @e@ from the line through two points,
-- positive to the left of the line. Both are 0 if the points coincide. The line leads from the
-- point (@px@, @py@) to the point (@qx@, @qy@).
across :: Double -> Double -> Double -> Double -> Segment -> DistanceRange
across px py qx qy e
  | l <= 0 = DistanceRange 0 0
  | otherwise = case coordinates e of
    LineAt ax ay bx by ->
      let a = height ax ay
          b = height bx by
       in DistanceRange (min a b) (max a b)
    ArcAt ax ay bx by cx cy r _ ->
      let a = height ax ay
          b = height bx by
          c = height cx cy
          sx = negate iy * r
          sy = ix * r
       in DistanceRange
            (if inSector e (cx - sx) (cy - sy) then c - r else min a b)
            (if inSector e (cx + sx) (cy + sy) then c + r else max a b)
  where
    l = hypotenuse (qx - px) (qy - py)
    ix = (qx - px) / l
    iy = (qy - py) / l
    height x y = ix * (y - py) - iy * (x - px)
