{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Distances of segments and bounds of them, computed on unpacked coordinates: a faster
-- counterpart of "Geometry.Distance".
--
-- The proof of a tape compares motions with elements of the part: some must be near enough to each
-- other, some far enough apart. For nearly every pair a bound decides this.
--
-- A comment "True only if" means that a result True is certain, in spite of rounding errors. A
-- result False then proves nothing, and the caller compares exactly by "Geometry.Distance". "False
-- only if" means that a result False is certain. Then a result True proves nothing.
--
-- The foot of a point on a segment is where the perpendicular from the point meets the segment's
-- carrier.
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
    doubtful,
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
import Geometry.Distance.Fast.Estimate
import Geometry.Segment (Segment)
import Geometry.Segment.Fast

-- | Upper bound, in mm, of the distances of all points of the segment @e@ from every one of the
-- segments @ts@. It is infinite if an end of @e@ is further than @most@ from one of @ts@. For each
-- of @ts@, 'beside' gives a first bound. The bound by 'furthest' takes more time and is computed
-- only if the first bound exceeds @most@.
furthestFrom :: Double -> Segment -> [Segment] -> Double
furthestFrom most e ts
  | all endsNear ts = foldl' (\far t -> max far (enough t)) 0 ts
  | otherwise = never
  where
    enough t = let far = beside e t in if far <= most then far else furthest e t
    endsNear t = case coordinates e of
      LineAt ax ay bx by -> distance t ax ay <= most && distance t bx by <= most
      ArcAt ax ay bx by _ _ _ _ -> distance t ax ay <= most && distance t bx by <= most

-- | True only if every point of the segment @e@ lies within @reach@, in mm, of one of the things
-- @others@. See 'doubtful'.
isCovered :: Double -> (a -> [Segment]) -> (a -> Bool) -> [a] -> Segment -> Bool
isCovered reach segmentsOf counts others e = null (doubtful reach segmentsOf counts others e)
{-# INLINE isCovered #-}

-- | Parts of the segment @e@ outside of which every point surely lies within @reach@, in mm, of one
-- of the things @others@. A thing consists of the segments that @segmentsOf@ gives. A point lies
-- within @reach@ of a thing if it lies within @reach@ of every one of the thing's segments. Only
-- things for which @counts@ is true are used; this condition is tested last.
doubtful :: Double -> (a -> [Segment]) -> (a -> Bool) -> [a] -> Segment -> [Segment]
doubtful reach segmentsOf counts others e
  | any (covers e) others = []
  | otherwise = case parts e (concatMap segmentsOf others) of
    [] -> [e]
    some -> go others some
  where
    covers part other = all (isWithin (reach - 2 * unsure) part) (segmentsOf other) && counts other
    -- The things @others@ usually come in the order of the parts of @e@. So the search for each
    -- part begins where the search for the previous part succeeded.
    go ahead ps = case ps of
      [] -> []
      part : more -> case dropWhile (not . covers part) ahead of
        [] | any (covers part) others -> go ahead more
        [] -> part : go ahead more
        found -> go found more
{-# INLINE doubtful #-}

-- | True only if every point of the segment @t@ lies within @most@, in mm, of one of the segments
-- @others@. Always false for an arc with a sweep above 'largestSweep'.
--
-- The result is true if @others@ contains a suitable run. A run consists of consecutive segments,
-- each of which begins where the one before ends. One end of the run must lie before the start of
-- @t@, and the other after the end of @t@. Positions are compared along the line @t@, or by the
-- angle at the centre of the arc @t@. Such a run crosses the normal at every point of @t@. This
-- point of @t@ is as far from the crossing as the crossing is from the carrier of @t@. So no point
-- of the run may be further than @most@ from this carrier. For an arc, the run must also be too
-- short to go around the far side of the centre.
isAccompanied :: Double -> [Segment] -> Segment -> Bool
isAccompanied most others t
  | isLine t = lineIsAccompanied (most - 2 * unsure) others t
  | otherwise = arcIsAccompanied (most - 2 * unsure) others t

-- | 'isAccompanied' for a line @t@. The distance @most@, in mm, is already reduced by the allowance
-- for rounding errors.
lineIsAccompanied :: Double -> [Segment] -> Segment -> Bool
lineIsAccompanied most others t = case coordinates t of
  LineAt px py qx qy
    | l <- hypotenuse (qx - px) (qy - py),
      l > 0 ->
      let ix = (qx - px) / l
          iy = (qy - py) / l
          positionOf x y =
            let f = ix * (x - px) + iy * (y - py)
             in if f <= 0 then Before else if f >= l then After else Between
       in chain
            positionOf
            (across px py qx qy)
            (\(DistanceRange low high) _ -> low >= negate most && high <= most)
            others
  _ -> False

-- | 'isAccompanied' for an arc @t@. The distance @most@, in mm, is already reduced by the allowance
-- for rounding errors.
arcIsAccompanied :: Double -> [Segment] -> Segment -> Bool
arcIsAccompanied most others t = case coordinates t of
  ArcAt ax ay bx by cx cy r s
    | abs s <= largestSweep ->
      let alongEnd x y = (bx - cx) * (x - cx) + (by - cy) * (y - cy)
          positionOf x y = bearing ax ay bx by cx cy s x y $ \pastStart beforeEnd alongStart ->
            if pastStart <= 0 && alongStart > 0
              then Before
              else if beforeEnd <= 0 && alongEnd x y > 0 then After else Between
       in chain
            positionOf
            (spanFrom cx cy)
            (\(DistanceRange low high) long -> long < low && r - low <= most && high - r <= most)
            others
  _ -> False

-- | True if a list contains a run that passes along a whole segment t and satisfies the condition
-- @fits@. A run consists of consecutive segments, each of which begins where the one before ends.
-- One end of the run must lie before the start of t, the other after the end of t. @positionOf@
-- gives the position of a point (x, y) relative to the ends of t. @spanOf@ gives the range of a
-- segment's distances: from the carrier of a line t, with a sign; or from the centre of an arc t.
-- @fits@ has two arguments: the range of these distances for the whole run, and the run's length in
-- mm.
chain ::
  (Double -> Double -> Position) ->
  (Segment -> DistanceRange) ->
  (DistanceRange -> Double -> Bool) ->
  [Segment] ->
  Bool
chain positionOf spanOf fits = start
  where
    start es = case es of
      [] -> False
      e : _ -> let (x, y) = begin e in go (positionOf x y) never (negate never) 0 x y es
    -- @from@ is the position of the run's last joint that lies past an end of t, or 'Between' if
    -- there is none. @low@ and @high@ are the range of distances since that joint, and @long@ is
    -- the length since then. The next segment must begin at the point (@x@, @y@).
    go :: Position -> Double -> Double -> Double -> Double -> Double -> [Segment] -> Bool
    go from !low !high !long !x !y es = case es of
      [] -> False
      e : more -> case (begin e, finish e) of
        ((bx, by), (fx, fy))
          | not (bx == x && by == y) -> start es
          | from == Between -> go there never (negate never) 0 fx fy more
          | there == from -> go there never (negate never) 0 fx fy more
          | there == Between -> go from low' high' long' fx fy more
          | fits (DistanceRange low' high') long' -> True
          | otherwise -> go there never (negate never) 0 fx fy more
          where
            there = positionOf fx fy
            DistanceRange a b = spanOf e
            low' = min low a
            high' = max high b
            long' = long + lengthOf e
{-# INLINE chain #-}

-- | Position of a point relative to the two ends of a segment: before the start, between the ends,
-- or after the end.
data Position = Before | Between | After
  deriving stock (Eq)

-- | Largest sweep, in radians, of an arc for which 'isAccompanied' can be true.
largestSweep :: Double
largestSweep = 1

-- | Lower and upper bound, in mm, of the greatest distance of a point of the segment @e@ from the
-- nearest of the things @others@. A thing is a list of segments. Its distance from a point is the
-- greatest distance of one of its segments from this point.
range :: [[Segment]] -> Segment -> (Double, Double)
range others e = (maximum (map from points) - unsure, maximum (map to divisions) + 2 * unsure)
  where
    divisions = case parts e (concat others) of
      [] -> [e]
      some -> some
    to part = least [most [furthest part t | t <- ts] | ts <- others]
    points =
      begin e :
        [ p
          | part <- divisions,
            p <- at part 0.5 : finish part : concatMap (concatMap (summits part)) others
        ]
    from (x, y) = least [most [distance t x y | t <- ts] | ts <- others]
    least = foldl' min never
    most = foldl' max 0

-- | Points of the segment @e@, other than its ends, at which its distance from the segment @t@ may
-- be greatest; as x and y in mm. For two arcs they lie on the line through both centres. For a line
-- and an arc they lie on the perpendicular from the arc's centre to the line.
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

-- | Parts of the segment @e@, divided at the feet of the ends of the segments @others@. At these
-- feet, another of these segments may become the nearest. The list is empty if no foot lies inside
-- @e@, or if there are more than 'mostParts' feet.
parts :: Segment -> [Segment] -> [Segment]
parts e others = case marks of
  [] -> []
  _ -> if null (drop mostParts marks) then zipWith (between e) (0 : marks) (marks <> [1]) else []
  where
    marks = rising (sort (feet others))
    -- If a segment begins at the end of the previous one, this point counts once.
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

-- | Largest number of feet at which 'parts' divides a segment.
mostParts :: Int
mostParts = 64
