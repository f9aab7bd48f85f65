{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Lines and arcs as bare numbers in mm, and what can be said of two of them at once.
--
-- The proof is about whole strokes and whole elements. Of nearly all of them a few products tell
-- that they are far enough from one another, or near enough; what is not told here, to 'unsure', is
-- left to the exact comparison.
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

import Base.Quantity (Mm (..), Rad (..))
import Data.List (foldl', sort)
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point (Point))

-- | A segment as bare numbers: a line by its ends, or an arc by its ends, its centre, its radius
-- and its sweep in radians. Nothing of it is ever made: whoever asks takes the numbers that are
-- needed from the segment.
data Bare
  = Line Double Double Double Double
  | Bow Double Double Double Double Double Double Double Double

bare :: Segment -> Bare
bare s = case s of
  Straight (Point ax ay) (Point bx by) -> Line ax ay bx by
  Arc (Point ax ay) (Point bx by) (Point cx cy) (Rad angle) ->
    Bow ax ay bx by cx cy (hypotenuse (cx - ax) (cy - ay)) angle
{-# INLINE bare #-}

-- | What is nearer to a bound than this is not decided here, in mm. Products of coordinates are
-- exact to less than a hundredth of it.
unsure :: Double
unsure = 1e-8

-- | More than any distance.
never :: Double
never = 1 / 0

-- | A single point.
spot :: Double -> Double -> Segment
spot x y = Straight (Point x y) (Point x y)

isLine :: Segment -> Bool
isLine course = case bare course of
  Line {} -> True
  Bow {} -> False

-- | From a point.
distance :: Segment -> Double -> Double -> Double
distance course !px !py = case bare course of
  Line ax ay bx by ->
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
  Bow ax ay bx by cx cy r _
    | inSector course px py -> abs (hypotenuse (px - cx) (py - cy) - r)
    | otherwise -> min (hypotenuse (px - ax) (py - ay)) (hypotenuse (px - bx) (py - by))

-- | Whether a point may lie within a distance of a course of such a length, or a little more: no
-- point of it is further from its beginning.
mayLieWithin :: Double -> Double -> Segment -> Double -> Double -> Bool
mayLieWithin most long course !px !py = case bare course of
  Line ax ay _ _ -> about (px - ax) (py - ay)
  Bow ax ay _ _ _ _ _ _ -> about (px - ax) (py - ay)
  where
    about vx vy = let d = most + long + unsure in vx * vx + vy * vy <= d * d
    {-# INLINE about #-}
{-# INLINE mayLieWithin #-}

-- | A box about it, that of its ends grown by the most that an arc may bulge: @r·(1 − cos(φ/2)) ≤
-- r·φ²/8@.
box :: Segment -> BoundingBox
box course = case bare course of
  Line ax ay bx by -> BoundingBox (min ax bx) (min ay by) (max ax bx) (max ay by)
  Bow ax ay bx by cx cy r s
    | abs s < pi ->
      BoundingBox.inflate
        (Mm (r * s * s / 8))
        (BoundingBox (min ax bx) (min ay by) (max ax bx) (max ay by))
    | otherwise -> BoundingBox (cx - r) (cy - r) (cx + r) (cy + r)

-- | By how much the radii of an arc differ at its ends.
uneven :: Segment -> Double
uneven course = case bare course of
  Line {} -> 0
  Bow _ _ bx by cx cy r _ -> abs (hypotenuse (bx - cx) (by - cy) - r)

-- | Whether a course of such a length may come within a distance of what carries the second one, a
-- line or a circle: no point of it is further from its beginning than that length.
mayComeWithin :: Double -> Double -> Segment -> Segment -> Bool
mayComeWithin most long e t = case bare t of
  Line px py qx qy ->
    let ux = qx - px
        uy = qy - py
        side = ux * (y - py) - uy * (x - px)
     in side * side <= far * far * (ux * ux + uy * uy)
  Bow _ _ _ _ cx cy r _ ->
    let vv = (x - cx) * (x - cx) + (y - cy) * (y - cy)
     in vv <= (r + far) * (r + far) && (r <= far || vv >= (r - far) * (r - far))
  where
    far = most + long + unsure
    (x, y) = begin e
{-# INLINE mayComeWithin #-}

hypotenuse :: Double -> Double -> Double
hypotenuse a b = sqrt (a * a + b * b)
{-# INLINE hypotenuse #-}

-- | How a point lies as seen from an arc's centre, each times the radius: how far behind its
-- beginning in the sense of the walk, how far before its end, and how far out towards the
-- beginning. In mm².
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

-- | Whether a point lies in the sector of an arc.
inSector :: Segment -> Double -> Double -> Bool
inSector course !px !py = case bare course of
  Line {} -> False
  Bow ax ay bx by cx cy _ s ->
    bearing ax ay bx by cx cy s px py $ \behind before along ->
      if abs s > pi
        then behind >= 0 || before >= 0 || abs s > 3 / 2 * pi && along <= 0
        else behind >= 0 && before >= 0 && (abs s > pi / 2 || along >= 0)

-- | The least distance of two, or less than that by no more than rounding. Those that cross have
-- none.
apart :: Segment -> Segment -> Double
apart a b
  | cross a b = 0
  | otherwise = min (ends a b) (min (ends b a) (min (normals a b) (normals b a)))
  where
    ends c other = case bare c of
      Line ax ay bx by -> min (distance other ax ay) (distance other bx by)
      Bow ax ay bx by _ _ _ _ -> min (distance other ax ay) (distance other bx by)

-- | No points of two courses are nearer to one another than this; it is exact where the second lies
-- beside the first, and found sooner. What carries the first is nowhere further from a point than
-- the first itself.
apartAtLeast :: Segment -> Segment -> Double
apartAtLeast t e = case bare t of
  Line px py qx qy -> case across px py qx qy e of
    Span low high
      | low > 0 -> low
      | high < 0 -> negate high
      | otherwise -> 0
  Bow _ _ _ _ cx cy r _ -> case spanFrom cx cy e of
    Span low high
      | low > r -> low - r
      | high < r -> r - high
      | otherwise -> 0

-- | From one number to another.
data Span = Span Double Double

-- | How far a course is from a point at least and at most.
spanFrom :: Double -> Double -> Segment -> Span
spanFrom !px !py e = case bare e of
  Line ax ay bx by ->
    Span (distance e px py) (max (hypotenuse (ax - px) (ay - py)) (hypotenuse (bx - px) (by - py)))
  Bow ax ay bx by cx cy r _ ->
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

-- | How far to the left of a line a course lies at least and at most; 0 where the line has no
-- length.
across :: Double -> Double -> Double -> Double -> Segment -> Span
across px py qx qy e
  | l <= 0 = Span 0 0
  | otherwise = case bare e of
    Line ax ay bx by -> let a = height ax ay; b = height bx by in Span (min a b) (max a b)
    Bow ax ay bx by cx cy r _ ->
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

-- | From where a normal of the first course meets the second, an arc, at a right angle, too.
normals :: Segment -> Segment -> Double
normals a b = case (bare a, bare b) of
  (Line ax ay bx by, Bow _ _ _ _ cx cy _ _) ->
    let t = shareOf ax ay bx by cx cy
     in if t > 0 && t < 1 then distance b (ax + t * (bx - ax)) (ay + t * (by - ay)) else never
  (Bow _ _ _ _ cx cy r _, Bow _ _ _ _ dx dy _ _) ->
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

-- | Where the foot of a point lies on a line, as a share of its length.
shareOf :: Double -> Double -> Double -> Double -> Double -> Double -> Double
shareOf ax ay bx by px py =
  let ux =
        bx - ax
      uy = by - ay
      uu = ux * ux + uy * uy
   in if uu > 0 then (ux * (px - ax) + uy * (py - ay)) / uu else 0
{-# INLINE shareOf #-}

-- | Whether two cross. What only touches has an end or a normal there.
cross :: Segment -> Segment -> Bool
cross a b = case (bare a, bare b) of
  (Line ax ay bx by, Line cx cy dx dy) ->
    let side x y = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        side' x y = (dx - cx) * (y - cy) - (dy - cy) * (x - cx)
     in side cx cy * side dx dy <= 0 && side' ax ay * side' bx by <= 0 && boxesMeet
    where
      boxesMeet =
        max (min ax bx) (min cx dx) <= min (max ax bx) (max cx dx)
          && max (min ay by) (min cy dy) <= min (max ay by) (max cy dy)
  (Line ax ay bx by, Bow _ _ _ _ cx cy r _) ->
    let ux = bx - ax
        uy = by - ay
        l = hypotenuse ux uy
        along = (ux * (cx - ax) + uy * (cy - ay)) / l
        off = (ux * (cy - ay) - uy * (cx - ax)) / l
        half = sqrt (r * r - off * off)
        meets t = t >= 0 && t <= l && inSector b (ax + t * ux / l) (ay + t * uy / l)
     in l > 0 && abs off <= r && (meets (along - half) || meets (along + half))
  (Bow {}, Line {}) -> cross b a
  (Bow _ _ _ _ cx cy r _, Bow _ _ _ _ dx dy q _) ->
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

-- | No point of the first course is further than this from the second. That is exact where the one
-- runs beside the other, or about one of its ends.
furthest :: Segment -> Segment -> Double
furthest e t =
  min
    (beside e t)
    ( case bare t of
        Line ax ay bx by ->
          fromEnds ax ay bx by
        Bow ax ay bx by _ _ _ _ -> fromEnds ax ay bx by
    )
  where
    fromEnds ax ay bx by = min (fromPoint e ax ay) (fromPoint e bx by)

-- | No point of a course is further than this from any of some others; 'never' where an end of it
-- is further from one of them than so much.
furthestFrom :: Double -> Segment -> [Segment] -> Double
furthestFrom most e ts
  | all endsNear ts = foldl' (\far t -> max far (enough t)) 0 ts
  | otherwise = never
  where
    enough t = let far = beside e t in if far <= most then far else furthest e t
    endsNear t = case bare e of
      Line ax ay bx by -> distance t ax ay <= most && distance t bx by <= most
      Bow ax ay bx by _ _ _ _ -> distance t ax ay <= most && distance t bx by <= most

-- | Whether no point of the first course is further from the second than so much. Mostly its
-- beginning tells that it is.
isWithin :: Double -> Segment -> Segment -> Bool
isWithin most e t = atBegin && (beside e t <= most || fromEnds)
  where
    fromEnds = case bare t of
      Line ax ay bx by -> fromPoint e ax ay <= most || fromPoint e bx by <= most
      Bow ax ay bx by _ _ _ _ -> fromPoint e ax ay <= most || fromPoint e bx by <= most
    atBegin = case bare e of
      Line ax ay _ _ -> distance t ax ay <= most
      Bow ax ay _ _ _ _ _ _ -> distance t ax ay <= most

-- | Whether every point of a line or of an arc of no more than 'aCorner' surely has a point of some
-- others within a distance: those of them that follow one another without a gap are one curve. As
-- seen from the line, or from the arc's centre, that comes past its beginning and past its end, so
-- it comes past all between, and nowhere is it further above it, or out from it, or less so, than
-- the distance. It is so short that it does not go round the centre.
isAccompanied :: Double -> [Segment] -> Segment -> Bool
isAccompanied most others t = case bare t of
  Line px py qx qy
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
  Bow ax ay bx by cx cy r s
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

-- | Whether of curves one behind the other some follow one another without a gap from past one end
-- to past the other, and keep to what is asked.
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

-- | Past which end a point lies.
data Stand = Before | Amidst | Behind
  deriving stock (Eq)

-- | A turn by no more than this, in radians, goes round no centre.
aCorner :: Double
aCorner = 1

-- | How long it is.
lengthOf :: Segment -> Double
lengthOf e = case bare e of
  Line ax ay bx by -> hypotenuse (bx - ax) (by - ay)
  Bow _ _ _ _ _ _ r s -> r * abs s

-- | How far the furthest point of a course is from a point.
fromPoint :: Segment -> Double -> Double -> Double
fromPoint e px py = case bare e of
  Line ax ay bx by -> max (hypotenuse (ax - px) (ay - py)) (hypotenuse (bx - px) (by - py))
  Bow ax ay bx by cx cy r _ ->
    let d = hypotenuse (cx - px) (cy - py)
        ends = max (hypotenuse (ax - px) (ay - py)) (hypotenuse (bx - px) (by - py))
     in if d > 0 && inSector e (cx + (cx - px)) (cy + (cy - py))
          then d + r
          else
            if d > 0
              then ends
              else max ends r

-- | The same, where every point of the first course has its foot on the second, or beyond an end of
-- it by no more than 'overlap'; else 'never'.
beside :: Segment -> Segment -> Double
beside e t = case (bare e, bare t) of
  (Line ax ay bx by, Line {}) -> max (distance t ax ay) (distance t bx by)
  (Line ax ay bx by, Bow _ _ _ _ cx cy r s)
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
  (Bow ax ay bx by cx cy r _, Line px py qx qy) ->
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
  (Bow ax ay bx by cx cy r _, Bow px py qx qy dx dy q z)
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
          -- What is furthest past an end of the other is an end, too, or lies square to the line to
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

-- | How far something is at most that is so far beside a course, and past an end of it by so much.
-- Past the end of an arc its centre tells, how near that comes, and its radius: the square of the
-- distance from the end is @(ρ − r)² + 4·ρ·r·sin²(φ/2)@, and where @sin φ@ is no more than a
-- hundredth that is less than @(ρ − r)² + 1.001·(r/ρ)·(ρ·sin φ)²@.
aside :: Double -> Double -> Double -> Double -> Double
aside high past near r
  | past <= 0 = high
  | past > overlap = never
  | r <= 0 = sqrt (high * high + past * past)
  | near > 100 * past = sqrt (high * high + past * past * 1.001 * r / near)
  | otherwise = never
{-# INLINE aside #-}

-- | Beyond the end of one course by no more than this another one follows, in mm.
overlap :: Double
overlap = 0.1

-- | How far a point lies beside the sector of an arc of at most half a turn, or of a whole turn;
-- 'never' far away.
pastArc :: Segment -> Double -> Double -> Double
pastArc t !px !py = case bare t of
  Line {} -> never
  Bow ax ay bx by cx cy r s
    | isWhole s -> 0
    | otherwise -> bearing ax ay bx by cx cy s px py $ \behind before along ->
      if abs s <= pi / 2 && along < 0
        then never
        else max 0 (max (negate behind) (negate before) / r)

-- | Whether an arc goes all the way round.
isWhole :: Double -> Bool
isWhole s = abs s >= 2 * pi

-- | The point at a share of the length.
at :: Segment -> Double -> (Double, Double)
at e !t = case bare e of
  Line ax ay bx by -> (ax + t * (bx - ax), ay + t * (by - ay))
  Bow ax ay _ _ cx cy _ s ->
    let c =
          cos (t * s)
        n = sin (t * s)
        vx = ax - cx
        vy = ay - cy
     in (cx + c * vx - n * vy, cy + n * vx + c * vy)
{-# INLINE at #-}

-- | Whether every point of a course surely has one of some others within a distance, all courses of
-- that other; whether it counts is asked last.
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

-- | How far the point of a course is that is furthest from all of some others, of each from that of
-- its courses from which it is furthest: surely further than the one, surely no further than the
-- other.
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

-- | Where a course may be furthest from another one, beside its ends: on the line of their centres,
-- square above a line.
summits :: Segment -> Segment -> [(Double, Double)]
summits e t = case (bare e, bare t) of
  (Bow _ _ _ _ cx cy r _, Bow _ _ _ _ dx dy _ _) ->
    let d =
          hypotenuse (cx - dx) (cy - dy)
     in if d > 0 then both cx cy (r * (cx - dx) / d) (r * (cy - dy) / d) else []
  (Bow _ _ _ _ cx cy r _, Line ax ay bx by) ->
    let l =
          hypotenuse (bx - ax) (by - ay)
     in if l > 0 then both cx cy (r * (ay - by) / l) (r * (bx - ax) / l) else []
  (Line ax ay bx by, Bow _ _ _ _ dx dy _ _) ->
    let k =
          shareOf ax ay bx by dx dy
     in [at e k | k > 0, k < 1]
  (Line {}, Line {}) -> []
  where
    both cx cy ux uy =
      [(x, y) | sense <- [1, -1], let x = cx + sense * ux; y = cy + sense * uy, inSector e x y]

-- | The parts of a course between the places where what is nearest changes: there is an end of one
-- of the others. None when it is not cut, or cut into more than 'mostParts'.
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
    isAbout x y = case bare e of
      Line {} -> True
      Bow {} -> inSector e x y
    rising ms = case ms of
      a : b : more | a == b -> rising (b : more)
      a : more -> a : rising more
      [] -> []

-- | So many parts are looked at by themselves.
mostParts :: Int
mostParts = 64

-- | Its ends.
begin, finish :: Segment -> (Double, Double)
begin t = case bare t of
  Line ax ay _ _ -> (ax, ay)
  Bow ax ay _ _ _ _ _ _ -> (ax, ay)
finish t = case bare t of
  Line _ _ bx by -> (bx, by)
  Bow _ _ bx by _ _ _ _ -> (bx, by)
{-# INLINE begin #-}
{-# INLINE finish #-}

-- | Where the foot of a point lies on a course, as a share of its length; of an arc in its sense
-- from its beginning on.
foot :: Segment -> Double -> Double -> Double
foot e !x !y = case bare e of
  Line ax ay bx by -> shareOf ax ay bx by x y
  Bow ax ay _ _ cx cy _ s ->
    let vx = ax - cx
        vy = ay - cy
        turned = atan2 (vx * (y - cy) - vy * (x - cx)) (vx * (x - cx) + vy * (y - cy)) / s
     in if turned < 0 then turned + 2 * pi / abs s else turned

-- | The two parts of a course before and behind the foot of a point, if that lies on it.
divided :: Double -> Double -> Segment -> Maybe (Segment, Segment)
divided x y e
  | isAbout, m > 0, m < 1 = Just (between e 0 m, between e m 1)
  | otherwise = Nothing
  where
    m = foot e x y
    isAbout = isLine e || inSector e x y

-- | The part of a course between two shares of its length.
between :: Segment -> Double -> Double -> Segment
between e a b = case bare e of
  Line {} -> Straight p q
  Bow _ _ _ _ cx cy _ s -> Arc p q (Point cx cy) (Rad (s * (b - a)))
  where
    p = pointAt a
    q = pointAt b
    pointAt t = let (x, y) = at e t in Point x y

-- | Whether all of a course surely lies to the left of an element, or of the circle or line that
-- carries it.
isLeftOf :: Segment -> Segment -> Bool
isLeftOf t e = case bare e of
  Line ax ay bx by -> case across ax ay bx by t of Span low _ -> low > unsure
  Bow _ _ _ _ cx cy r s ->
    if s > 0 then isInside cx cy (r - unsure) t else isOutside cx cy (r + unsure) t

isRightOf :: Segment -> Segment -> Bool
isRightOf t e = case bare e of
  Line ax ay bx by -> case across ax ay bx by t of Span _ high -> high < -unsure
  Bow _ _ _ _ cx cy r s ->
    if s > 0 then isOutside cx cy (r + unsure) t else isInside cx cy (r - unsure) t

-- | Whether all of a course lies within a distance of a point, or all of it beyond.
isInside, isOutside :: Double -> Double -> Double -> Segment -> Bool
isInside cx cy r t = case spanFrom cx cy t of Span _ high -> high < r
isOutside cx cy r t = case spanFrom cx cy t of Span low _ -> low > r

-- | Whether the foot of a point may fall on a course rather than before or behind it.
spansAbout :: Segment -> Double -> Double -> Bool
spansAbout e !px !py = case bare e of
  Line ax ay bx by -> let t = shareOf ax ay bx by px py in t >= -1e-9 && t <= 1 + 1e-9
  Bow _ _ _ _ _ _ _ s -> abs s > pi || pastArc e px py <= unsure

-- | Where the foot of a point lies on a course, as a share of its length; of one before or behind
-- it the nearer end.
footOn :: Segment -> Double -> Double -> Double
footOn e !px !py = case bare e of
  Line ax ay bx by -> max 0 (min 1 (shareOf ax ay bx by px py))
  Bow ax ay bx by _ _ _ _
    | inSector e px py -> max 0 (min 1 (foot e px py))
    | hypotenuse (px - ax) (py - ay) <= hypotenuse (px - bx) (py - by) -> 0
    | otherwise -> 1
