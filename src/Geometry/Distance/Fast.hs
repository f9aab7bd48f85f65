{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Distances of segments in plain numbers, as bounds: a faster twin of "Geometry.Distance".
--
-- The proof compares whole motions with whole elements. For nearly all pairs a few products decide
-- that they are far enough apart, or near enough. An answer that depends on less than 'unsure' is
-- left to the exact comparison of "Geometry.Distance".
module Geometry.Distance.Fast
  ( spot,
    isLine,
    distance,
    mayLieWithin,
    box,
    uneven,
    mayComeWithin,
    apart,
    apartAtLeast,
    furthest,
    furthestFrom,
    divided,
    begin,
    isWithin,
    isCovered,
    isAccompanied,
    range,
    isLeftOf,
    isRightOf,
    spansAbout,
    footOn,
    at,
    unsure,
  )
where

import Data.List (foldl', sort)
import Geometry.Segment (Segment)
import Geometry.Segment.Fast

-- | Uncertainty of all decisions in this module in mm. Products of coordinates are exact to less
-- than a hundredth of it.
unsure :: Double
unsure = 1e-8

-- | Distance larger than all others.
never :: Double
never = 1 / 0

-- | Distance of a point from a segment in mm.
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

-- | False only if a point is further than @most@ from a segment whose length is @long@. Compares
-- the distance from the segment's start, from which no point of the segment is further than
-- @long@.
mayLieWithin :: Double -> Double -> Segment -> Double -> Double -> Bool
mayLieWithin most long segment !px !py = case coordinates segment of
  LineAt ax ay _ _ -> about (px - ax) (py - ay)
  ArcAt ax ay _ _ _ _ _ _ -> about (px - ax) (py - ay)
  where
    about vx vy = let d = most + long + unsure in vx * vx + vy * vy <= d * d
    {-# INLINE about #-}
{-# INLINE mayLieWithin #-}

-- | False only if every point of the first segment, whose length is @long@, is further than @most@
-- from the carrier of the second. Compares the distance of the first segment's start.
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

-- | Least distance of two segments in mm, or less by no more than rounding; 0 if they intersect.
apart :: Segment -> Segment -> Double
apart a b
  | cross a b = 0
  | otherwise = min (ends a b) (min (ends b a) (min (normals a b) (normals b a)))
  where
    ends c other = case coordinates c of
      LineAt ax ay bx by -> min (distance other ax ay) (distance other bx by)
      ArcAt ax ay bx by _ _ _ _ -> min (distance other ax ay) (distance other bx by)

-- | Lower bound of the distance of two segments: the distance of the second from the carrier of
-- the first. It is exact if the second lies beside the first.
apartAtLeast :: Segment -> Segment -> Double
apartAtLeast t e = case coordinates t of
  LineAt px py qx qy -> case across px py qx qy e of
    Span low high
      | low > 0 -> low
      | high < 0 -> negate high
      | otherwise -> 0
  ArcAt _ _ _ _ cx cy r _ -> case spanFrom cx cy e of
    Span low high
      | low > r -> low - r
      | high < r -> r - high
      | otherwise -> 0

-- | Closed interval.
data Span = Span Double Double

-- | Least and greatest distance of a segment from a point.
spanFrom :: Double -> Double -> Segment -> Span
spanFrom !px !py e = case coordinates e of
  LineAt ax ay bx by ->
    Span (distance e px py) (max (hypotenuse (ax - px) (ay - py)) (hypotenuse (bx - px) (by - py)))
  ArcAt ax ay bx by cx cy r _ ->
    let a = hypotenuse (ax - px) (ay - py)
        b = hypotenuse (bx - px) (by - py)
        ux = cx - px
        uy = cy - py
        off = hypotenuse ux uy
        onLine f = inSector e (cx + f * ux) (cy + f * uy)
     in if off > 0
          then
            Span
              (if onLine (negate r / off) then abs (off - r) else min a b)
              (if onLine (r / off) then off + r else max a b)
          else Span r r

-- | Least and greatest signed distance of a segment from a line through two points, positive on
-- its left; 0 if the points coincide.
across :: Double -> Double -> Double -> Double -> Segment -> Span
across px py qx qy e
  | l <= 0 = Span 0 0
  | otherwise = case coordinates e of
    LineAt ax ay bx by -> let a = height ax ay; b = height bx by in Span (min a b) (max a b)
    ArcAt ax ay bx by cx cy r _ ->
      let a = height ax ay
          b = height bx by
          c = height cx cy
          sx = negate iy * r
          sy = ix * r
       in Span
            (if inSector e (cx - sx) (cy - sy) then c - r else min a b)
            (if inSector e (cx + sx) (cy + sy) then c + r else max a b)
  where
    l = hypotenuse (qx - px) (qy - py)
    ix = (qx - px) / l
    iy = (qy - py) / l
    height x y = ix * (y - py) - iy * (x - px)

-- | Least distance at a common normal of the first segment and the second, which is an arc;
-- 'never' without one.
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

-- | True of segments that intersect. At a mere contact there is an end or a common normal, which
-- 'apart' also compares.
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

-- | Upper bound of the distance of any point of the first segment from the second. It is exact if
-- the first runs beside the second, or around one of its ends.
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

-- | Upper bound of the distance of any point of a segment from any of several others; 'never' if
-- an end of the segment is further than @most@ from one of them.
furthestFrom :: Double -> Segment -> [Segment] -> Double
furthestFrom most e ts
  | all endsNear ts = foldl' (\far t -> max far (enough t)) 0 ts
  | otherwise = never
  where
    enough t = let far = beside e t in if far <= most then far else furthest e t
    endsNear t = case coordinates e of
      LineAt ax ay bx by -> distance t ax ay <= most && distance t bx by <= most
      ArcAt ax ay bx by _ _ _ _ -> distance t ax ay <= most && distance t bx by <= most

-- | True only if every point of the first segment lies within a distance of the second. The start
-- of the first is compared before all else, since it decides most cases.
isWithin :: Double -> Segment -> Segment -> Bool
isWithin most e t = atBegin && (beside e t <= most || fromEnds)
  where
    fromEnds = case coordinates t of
      LineAt ax ay bx by -> fromPoint e ax ay <= most || fromPoint e bx by <= most
      ArcAt ax ay bx by _ _ _ _ -> fromPoint e ax ay <= most || fromPoint e bx by <= most
    atBegin = case coordinates e of
      LineAt ax ay _ _ -> distance t ax ay <= most
      ArcAt ax ay _ _ _ _ _ _ -> distance t ax ay <= most

-- | True only if every point of a line, or of an arc of at most 'aCorner', surely lies within a
-- distance of some others.
--
-- Others that join without a gap are one curve. As seen along the line, or from the arc's
-- centre, that curve begins before the segment's start and ends after its end, so it passes
-- every point between. Its distance from the segment's carrier never exceeds the distance asked.
-- The curve is too short to go round the arc's centre.
isAccompanied :: Double -> [Segment] -> Segment -> Bool
isAccompanied most others t = case coordinates t of
  LineAt px py qx qy
    | l <- hypotenuse (qx - px) (qy - py),
      l > 0 ->
      let ix = (qx - px) / l
          iy = (qy - py) / l
          along x y = ix * (x - px) + iy * (y - py)
       in chain
            ( \x y ->
                let f =
                      along x y
                 in if f <= 0 then Before else if f >= l then Behind else Amidst
            )
            (across px py qx qy)
            (\(Span low high) _ -> low >= negate most' && high <= most')
            others
  ArcAt ax ay bx by cx cy r s
    | abs s <= aCorner ->
      let place x y =
            bearing
              ax
              ay
              bx
              by
              cx
              cy
              s
              x
              y
              ( \behind before alongBegin ->
                  if behind <= 0 && alongBegin > 0
                    then Before
                    else
                      if before <= 0 && (bx - cx) * (x - cx) + (by - cy) * (y - cy) > 0
                        then Behind
                        else Amidst
              )
       in chain
            place
            (spanFrom cx cy)
            (\(Span low high) long -> long < low && r - low <= most' && high - r <= most')
            others
  _ -> False
  where
    most' = most - 2 * unsure

-- | True if some of the curves, each beginning where the one before ends, lead without a gap from
-- before one end to after the other, and satisfy a condition on their interval of distances and
-- their length.
chain ::
  (Double -> Double -> Stand) ->
  (Segment -> Span) ->
  (Span -> Double -> Bool) ->
  [Segment] ->
  Bool
chain place spanOf fits = start
  where
    start es = case es of
      [] -> False
      e : _ -> let (x, y) = begin e in go (place x y) never (negate never) 0 x y es
    -- From where the curve is past one end, what it has kept to and how far it has gone since it
    -- was there.
    go :: Stand -> Double -> Double -> Double -> Double -> Double -> [Segment] -> Bool
    go from !low !high !long !x !y es = case es of
      [] -> False
      e : more -> case (begin e, finish e) of
        ((bx, by), (fx, fy))
          | not (bx == x && by == y) -> start es
          | from == Amidst -> go there never (negate never) 0 fx fy more
          | there == from -> go there never (negate never) 0 fx fy more
          | there == Amidst -> go from low' high' long' fx fy more
          | otherwise -> fits (Span low' high') long' || go there never (negate never) 0 fx fy more
          where
            there = place fx fy
            Span a b = spanOf e
            low' = min low a
            high' = max high b
            long' = long + lengthOf e
{-# INLINE chain #-}

-- | Position of a point relative to the two ends of a segment.
data Stand = Before | Amidst | Behind
  deriving stock (Eq)

-- | Largest sweep in radians of an arc that 'isAccompanied' treats.
aCorner :: Double
aCorner = 1

-- | Greatest distance of a point of a segment from a point.
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

-- | Same bound as 'furthest', if every point of the first segment has its foot on the second, or
-- lies past an end of it by no more than 'overlap'; otherwise 'never'.
beside :: Segment -> Segment -> Double
beside e t = case (coordinates e, coordinates t) of
  (LineAt ax ay bx by, LineAt {}) -> max (distance t ax ay) (distance t bx by)
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
     in if l > 0
          then
            aside
              high
              ( max
                  (max (past ax ay) (past bx by))
                  ( max
                      (furthestPast (cx + r * ix) (cy + r * iy))
                      (furthestPast (cx - r * ix) (cy - r * iy))
                  )
              )
              l
              0
          else never
  (ArcAt ax ay bx by cx cy r _, ArcAt px py qx qy dx dy q z)
    | abs z <= pi || isWhole z ->
      let off = hypotenuse (cx - dx) (cy - dy)
          away x y = hypotenuse (x - dx) (y - dy)
          -- From the centre of the other its range has its extremes at its ends and on the line of
          -- both centres.
          onLine sense =
            let f =
                  sense * r / off
             in off > 0 && inSector e (cx + f * (cx - dx)) (cy + f * (cy - dy))
          !behind = onLine 1
          !before = onLine (-1)
          !high =
            max
              (max (abs (away ax ay - q)) (abs (away bx by - q)))
              ( max
                  (if behind then abs (off + r - q) else 0)
                  (if before then abs (abs (off - r) - q) else 0)
              )
          near =
            min
              (min (away ax ay) (away bx by))
              (min (if behind then off + r else never) (if before then abs (off - r) else never))
          -- The point furthest past an end of the other is an end or lies square to the line to
          -- that end.
          squarePast x y sense =
            let f =
                  sense * r / q
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
       in if q > 0 then aside high past near q else never
  _ -> never

-- | Upper bound of a point's distance from a segment, by its distance from the carrier and its
-- distance past the end.
--
-- For an arc, the distance from the end is known from the distance ρ of the point from the
-- centre and the radius r: its square is @(ρ − r)² + 4·ρ·r·sin²(φ/2)@. If @sin φ@ is at most a
-- hundredth, that is less than @(ρ − r)² + 1.001·(r/ρ)·(ρ·sin φ)²@.
aside :: Double -> Double -> Double -> Double -> Double
aside high past near r
  | past <= 0 = high
  | past > overlap = never
  | r <= 0 = sqrt (high * high + past * past)
  | near > 100 * past = sqrt (high * high + past * past * 1.001 * r / near)
  | otherwise = never
{-# INLINE aside #-}

-- | Greatest distance past the end of a segment, in mm, for which 'beside' gives a bound.
overlap :: Double
overlap = 0.1

-- | Distance of a point past the ends of an arc of at most half a turn, or of a full circle; 0
-- inside the sector, 'never' on the opposite side.
pastArc :: Segment -> Double -> Double -> Double
pastArc t !px !py = case coordinates t of
  LineAt {} -> never
  ArcAt ax ay bx by cx cy r s
    | isWhole s -> 0
    | otherwise -> bearing ax ay bx by cx cy s px py $ \behind before along ->
      if abs s <= pi / 2 && along < 0
        then never
        else max 0 (max (negate behind) (negate before) / r)

-- | True only if every point of a segment surely lies within a distance of one of several others.
-- Each other consists of segments and counts only if a test says so; the test is evaluated last.
isCovered :: Double -> (a -> [Segment]) -> (a -> Bool) -> [a] -> Segment -> Bool
isCovered reach coursesOf counts others e =
  any (covers e) others || go others (parts e (concatMap coursesOf others))
  where
    covers part other = all (isWithin (reach - 2 * unsure) part) (coursesOf other) && counts other
    -- The others lie in the order of the parts, as a rule.
    go ahead ps = case ps of
      [] -> False
      [part] -> covered ahead part
      part : more -> case dropWhile (not . covers part) ahead of
        [] -> any (covers part) others && go ahead more
        found -> go found more
    covered ahead part = any (covers part) ahead || any (covers part) others
{-# INLINE isCovered #-}

-- | Bounds of the greatest distance of a segment's points from several others. The distance from
-- one of them is the greatest distance from its segments; the least over all others counts.
range :: [[Segment]] -> Segment -> (Double, Double)
range others e = (maximum (map from points) - unsure, maximum (map to pieces) + 2 * unsure)
  where
    pieces = case parts e (concat others) of
      [] -> [e]
      some -> some
    to part = least [most [furthest part t | t <- ts] | ts <- others]
    points =
      begin e :
        [ p
          | part <- pieces,
            p <- at part 0.5 : finish part : concatMap (concatMap (summits part)) others
        ]
    from (x, y) = least [most [distance t x y | t <- ts] | ts <- others]
    least = foldl' min never
    most = foldl' max 0

-- | Points of the first segment, beside its ends, at which its distance from the second may be
-- greatest: on the line of both centres, or square to a line.
summits :: Segment -> Segment -> [(Double, Double)]
summits e t = case (coordinates e, coordinates t) of
  (ArcAt _ _ _ _ cx cy r _, ArcAt _ _ _ _ dx dy _ _) ->
    let d =
          hypotenuse (cx - dx) (cy - dy)
     in if d > 0 then both cx cy (r * (cx - dx) / d) (r * (cy - dy) / d) else []
  (ArcAt _ _ _ _ cx cy r _, LineAt ax ay bx by) ->
    let l =
          hypotenuse (bx - ax) (by - ay)
     in if l > 0 then both cx cy (r * (ay - by) / l) (r * (bx - ax) / l) else []
  (LineAt ax ay bx by, ArcAt _ _ _ _ dx dy _ _) ->
    let k =
          shareOf ax ay bx by dx dy
     in [at e k | k > 0, k < 1]
  (LineAt {}, LineAt {}) -> []
  where
    both cx cy ux uy =
      [(x, y) | sense <- [1, -1], let x = cx + sense * ux; y = cy + sense * uy, inSector e x y]

-- | Parts of a segment between the points at which the nearest of several others may change: the
-- feet of their ends. Empty if there is no such point, or if there would be more than
-- 'mostParts' parts.
parts :: Segment -> [Segment] -> [Segment]
parts e others = case marks of
  [] -> []
  _ -> if null (drop mostParts marks) then zipWith (between e) (0 : marks) (marks <> [1]) else []
  where
    marks = rising (sort (feet others))
    -- Those one behind the other have an end in common.
    feet ts = case ts of
      [] -> []
      t : u : more
        | (bx, by) <- finish t,
          (cx, cy) <- begin u,
          bx == cx && by == cy ->
          uncurry footInside (begin t) <> feet (u : more)
      t : more -> uncurry footInside (begin t) <> uncurry footInside (finish t) <> feet more
    footInside x y = [m | isAbout x y, let m = foot e x y, m > 0, m < 1]
    isAbout x y = case coordinates e of
      LineAt {} -> True
      ArcAt {} -> inSector e x y
    rising ms = case ms of
      a : b : more | a == b -> rising (b : more)
      a : more -> a : rising more
      [] -> []

-- | Greatest count of parts that are examined one by one.
mostParts :: Int
mostParts = 64

-- | True only if a segment surely lies to the left of the carrier of an element (second argument),
-- or to its right.
isLeftOf :: Segment -> Segment -> Bool
isLeftOf t e = case coordinates e of
  LineAt ax ay bx by -> case across ax ay bx by t of Span low _ -> low > unsure
  ArcAt _ _ _ _ cx cy r s ->
    if s > 0 then isInside cx cy (r - unsure) t else isOutside cx cy (r + unsure) t

-- | True only if a segment surely lies to the right of the carrier of an element, its second
-- argument.
isRightOf :: Segment -> Segment -> Bool
isRightOf t e = case coordinates e of
  LineAt ax ay bx by -> case across ax ay bx by t of Span _ high -> high < -unsure
  ArcAt _ _ _ _ cx cy r s ->
    if s > 0 then isOutside cx cy (r + unsure) t else isInside cx cy (r - unsure) t

-- | True if all points of a segment are nearer to a point than a distance, or further.
isInside, isOutside :: Double -> Double -> Double -> Segment -> Bool
isInside cx cy r t = case spanFrom cx cy t of Span _ high -> high < r
isOutside cx cy r t = case spanFrom cx cy t of Span low _ -> low > r

-- | False only if the foot of a point lies before the start of a segment or after its end.
spansAbout :: Segment -> Double -> Double -> Bool
spansAbout e !px !py = case coordinates e of
  LineAt ax ay bx by -> let t = shareOf ax ay bx by px py in t >= -1e-9 && t <= 1 + 1e-9
  ArcAt _ _ _ _ _ _ _ s -> abs s > pi || pastArc e px py <= unsure
