-- | Biarcs: two arcs that go over into one another smoothly, with given ends and directions there.
--
-- In the complex plane of the chord (from 0 to 1), let the walk set out at the angle α and arrive at the angle
-- β. An arc's chord halves the angle between its ends' directions, so with the direction γ at the joint and the
-- chords @c@ and @r·c@ of the two arcs, @c·e^{i(α+γ)/2} + r·c·e^{i(γ+β)/2} = 1@. Hence with
-- @w = e^{iα/2} + r·e^{iβ/2}@: @γ = −2·arg w@, @c = 1/|w|@, and the joint is
-- @(1 + r·e^{i(α−β)/2}) / |w|²@. For α and β in (−π, π) there is one for every ratio r; equal chords are the
-- rule. (Equal tangent lengths, the other usual choice, have no answer where the two directions are parallel
-- and square to the chord, and differ from equal chords by terms of the third order in the angles.)
module Geometry.Biarc
  ( -- * Between two ends
    join,
    joinWith,

    -- * Through points
    through,

    -- * Along a curve
    Track (..),
    Side (..),
    approximate,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Control.Monad (guard)
import Data.List (minimumBy, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Ord (comparing)
import Geometry.Contour (Ends (..))
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Shape (Turn (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- Between two ends ------------------------------------------------------------------------------

-- | The biarc from one point and direction (of length 1) to another: two segments, or one where a straight
-- line or a single arc does it. The arcs have equal chords, unless a curve that bends to one side would be given
-- a bend to the other side; then the chord at the end that leans less to the whole chord is up to
-- four times as long. Nothing where the points are one point or an arc would turn by more than half a turn.
join :: (Point, Vec) -> (Point, Vec) -> Maybe (NonEmpty Segment)
join from to = joinWith (uncurry ratio (lean from to)) from to

-- | The biarc whose second arc has a chord so many times as long as the first one's.
joinWith :: Double -> (Point, Vec) -> (Point, Vec) -> Maybe (NonEmpty Segment)
joinWith r from@(p, _) to@(q, _) = do
  guard (not (Vec.near p q))
  guard (most (gamma - alpha) Tolerance.halfTurn && most (beta - gamma) Tolerance.halfTurn)
  guard (Vec.distance p joint <= Tolerance.reach && Vec.distance joint q <= Tolerance.reach)
  pure result
  where
    (alpha, beta) = lean from to
    gamma = -2 * atan2 (sin (alpha / 2) + r * sin (beta / 2)) (cos (alpha / 2) + r * cos (beta / 2))
    opening = (alpha - beta) / 2
    -- w|²
    square = 1 + r * r + 2 * r * cos opening
    chord = Vec.to p q
    joint = Vec.shift (Vec.add (Vec.scale ((1 + r * cos opening) / square) chord) (Vec.scale (r * sin opening / square) (Vec.left chord))) p
    result
      | most alpha Tolerance.straight && most beta Tolerance.straight = Straight p q :| []
      | most (alpha + beta) Tolerance.oneArc && most (beta - alpha) Tolerance.halfTurn = bent p q (beta - alpha) :| []
      | otherwise = bent p joint (gamma - alpha) :| [bent joint q (beta - gamma)]

-- | Whether an angle is no larger than a limit, to either side.
most :: Double -> Rad -> Bool
most a (Rad limit) = abs a <= limit

-- | The angles from the chord to the directions at its ends, in (−π, π].
lean :: (Point, Vec) -> (Point, Vec) -> (Double, Double)
lean (p, s) (q, t) = (a, b)
  where
    Rad a = Vec.turn (Vec.to p q) s
    Rad b = Vec.turn (Vec.to p q) t

-- | The ratio of the chords that keeps a curve bent to one side: the joint's direction stays at least half of either
-- end's angle away from that end's direction.
ratio :: Double -> Double -> Double
ratio alpha beta
  | alpha * beta >= 0 || held == gamma = 1
  | otherwise = max 0.25 (min 4 (-(sin ((alpha + held) / 2) / sin ((held + beta) / 2))))
  where
    gamma = -((alpha + beta) / 2)
    held = max (min alpha beta / 2) (min (max alpha beta / 2) gamma)

-- | The arc between two points that turns by an angle; a straight line where it hardly turns.
bent :: Point -> Point -> Double -> Segment
bent p q sweep
  | most sweep Tolerance.straight = Straight p q
  | otherwise = Segment.arc (if sweep > 0 then CounterClockwise else Clockwise) centre p q
  where
    chord = Vec.to p q
    centre = Vec.shift (Vec.scale (1 / (2 * tan (sweep / 2))) (Vec.left chord)) (Vec.between 0.5 p q)

-- Through points --------------------------------------------------------------------------------

-- | A smooth chain of arcs and lines through points in order; a closed one comes back to the first. The direction
-- at a point is that of the circle through it and its neighbours, at the ends of an open chain that of the
-- circle through the first or last three. Where that circle would turn by more than half a turn between
-- two of them (a sharp turn of the points), it halves the angle instead. Two points are joined by a
-- line, or, closed, by the circle about them. Points that follow at the same place count once; a single one gives a
-- line without length.
through :: Ends -> NonEmpty Point -> NonEmpty Segment
through ends points = case distinct ends points of
  p :| [] -> Straight p p :| []
  p :| [q] | ends == Open -> Straight p q :| []
  ps@(p :| rest) ->
    let list = NonEmpty.toList ps
        directions = case ends of
          Closed -> zipWith3 passing (NonEmpty.last ps : list) list (rest <> [p])
          Open -> openDirections list
        posed = zip list directions
        next = case ends of
          Closed -> drop 1 posed <> take 1 posed
          Open -> drop 1 posed
     in fromMaybe (Straight p p :| []) (NonEmpty.nonEmpty (concat (zipWith joined posed next)))
  where
    joined a b = maybe [Straight (fst a) (fst b)] NonEmpty.toList (join a b)

-- | Without points that follow at the same place.
distinct :: Ends -> NonEmpty Point -> NonEmpty Point
distinct ends (first :| others) = first :| back (onward first others)
  where
    onward before rest = case rest of
      [] -> []
      p : more
        | Vec.near before p -> onward before more
        | otherwise -> p : onward p more
    back ps = case ends of
      Open -> ps
      Closed -> reverse (dropWhile (Vec.near first) (reverse ps))

-- | The directions at three or more points of an open chain; the end's one is the neighbour's in the mirror of
-- the perpendicular bisector, so that the last piece is one arc.
openDirections :: [Point] -> [Vec]
openDirections ps = case (ps, reverse ps) of
  (a : b : _, z : y : _) ->
    let inner = zipWith3 passing ps (drop 1 ps) (drop 2 ps)
     in [mirrored a b t | t <- take 1 inner] <> inner <> [mirrored y z t | t <- take 1 (reverse inner)]
  _ -> []
  where
    mirrored a b t = Vec.rotate (Vec.turn t (Vec.to a b)) (Vec.unit (Vec.to a b))

-- | The direction at the middle one of three points. On the circle, the angles from the first chord to it and from it to
-- the second one are those of the triangle at the far ends.
passing :: Point -> Point -> Point -> Vec
passing a b c
  | not (Vec.near a c) && Vec.dot round' ab >= 0 && Vec.dot round' bc >= 0 = round'
  | Vec.norm halving > Tolerance.parallel = Vec.unit halving
  | otherwise = Vec.left ab
  where
    ab = Vec.unit (Vec.to a b)
    bc = Vec.unit (Vec.to b c)
    round' = Vec.unit (Vec.rotate (Vec.turn (Vec.to a c) bc) ab)
    halving = Vec.add ab bc

-- Along a curve ---------------------------------------------------------------------------------

-- | A curve given by a parameter that rises.
data Track = Track
  { place :: Double -> Point,
    -- | of length 1; the sides differ at most where one span goes over into the next
    direction :: Side -> Double -> Vec,
    -- | the parameter where the curve begins
    begin :: Double,
    -- | where each span ends, rising; within a span the direction does not jump
    breaks :: NonEmpty Double
  }

-- | The direction in which a walk arrives at a point, or in which it leaves.
data Side = Arriving | Leaving
  deriving stock (Eq, Show)

-- | A part of a track without corners: spans that go over into one another.
type Stretch = NonEmpty (Double, Double)

-- | Arcs and lines that stay within a distance of a curve, both ways, in as few biarcs as going as far as possible each
-- time gives. One group for each stretch between corners; within a group the directions agree. The ends of the
-- biarcs lie on the curve and have its direction (the mean of the two at a kink that is no corner). Where a curve has
-- no direction to go by, a straight line of 'Tolerance.finestStep' of a span is put. A biarc costs
-- some dozens of points of the curve, and a few for each span that it passes.
approximate :: Mm -> Track -> NonEmpty (NonEmpty Segment)
approximate (Mm tolerance) track = case concatMap (long . follow track tolerance) (NonEmpty.toList (stretches track)) of
  [] -> (Straight (place track (begin track)) (place track (NonEmpty.last (breaks track))) :| []) :| []
  group : more -> group :| more
  where
    long segments = maybe [] pure (NonEmpty.nonEmpty (filter (\s -> Segment.start s /= Segment.end s) segments))

-- | The spans of a track, in groups between corners.
stretches :: Track -> NonEmpty Stretch
stretches track = case filter (uncurry (<)) (zip (begin track : NonEmpty.toList (breaks track)) (NonEmpty.toList (breaks track))) of
  [] -> pure (pure (begin track, begin track))
  first : rest -> gather (first :| []) rest
  where
    gather (before :| others) spans = case spans of
      [] -> pure (NonEmpty.reverse (before :| others))
      next : more
        | corner (snd before) -> NonEmpty.cons (NonEmpty.reverse (before :| others)) (gather (next :| []) more)
        | otherwise -> gather (next :| before : others) more
    corner u = let Rad jump = Vec.turn (direction track Arriving u) (direction track Leaving u) in not (most jump Tolerance.kink)

-- | A biarc that has been tried: how far it reaches, and the largest distance from the curve.
data Trial = Trial {reached :: Double, pieces :: NonEmpty Segment, off :: Double}

-- | The segments along a stretch. Where the end may be near, the whole rest is tried first: that a shorter biarc does not
-- do it does not mean that a longer one does not either.
follow :: Track -> Double -> Stretch -> [Segment]
follow track tolerance stretch@((start, _) :| _) =
  go start (place track start, direction track Leaving start) (NonEmpty.toList stretch) (final - start)
  where
    final = snd (NonEmpty.last stretch)
    go u pose spans step
      | u < final =
        let Trial {reached, pieces} = furthest track tolerance final u pose spans (if final - u <= 4 * step then final - u else step)
            ahead = dropWhile ((<= reached) . snd) spans
            end = (Segment.end (NonEmpty.last pieces), heading track final spans reached)
         in NonEmpty.toList pieces <> go reached end ahead (reached - u)
      | otherwise = []

-- | The direction at a joint: the mean of both sides where spans meet.
heading :: Track -> Double -> [(Double, Double)] -> Double -> Vec
heading track final spans u
  | u >= final = arriving
  | any ((== u) . snd) (takeWhile ((<= u) . fst) spans) = Vec.unit (Vec.add arriving (direction track Leaving u))
  | otherwise = direction track Leaving u
  where
    arriving = direction track Arriving u

-- | The biarc from a parameter that reaches furthest within the tolerance. The deviation grows with the third power of
-- the step where the curve is smooth; the next step to try is taken from that, between the longest that held and the shortest
-- that did not.
furthest :: Track -> Double -> Double -> Double -> (Point, Vec) -> [(Double, Double)] -> Double -> Trial
furthest track tolerance final u pose spans = search (24 :: Int) Nothing Nothing
  where
    aim = tolerance * (1 - Tolerance.deviationShare)
    floor' = case spans of
      (lo, hi) : _ -> (hi - lo) * Tolerance.finestStep
      [] -> final - u
    search left held missed step
      | step <= floor' = fromMaybe forced held
      | off found <= aim = if good then found else search (left - 1) (Just found) missed (next found)
      | otherwise = case held of
        Just best | left <= 0 || narrow best (reached found) -> best
        _ -> search (left - 1) held (Just (reached found)) (next' found)
      where
        found = try track aim u final pose spans (min final (u + step))
        good = left <= 0 || reached found >= final || off found >= 0.93 * aim || maybe False (narrow found) missed
        next t = within t (fromMaybe (u + 4 * step) missed) (step * grown t)
        next' t = case held of
          Just best -> within best (reached t) (step * grown t)
          Nothing -> step * max 0.1 (min 0.9 (grown t))
    -- By how much the step can grow.
    grown t = if off t > 0 then (0.97 * aim / off t) ** (1 / 3) else 4
    narrow best missed = missed - reached best <= 0.02 * (reached best - u)
    -- A step between two others.
    within best limit s = let a = reached best - u; gap = limit - reached best in max (a + 0.15 * gap) (min (a + 0.85 * gap) s)
    forced = let v = min final (u + floor') in Trial v (Straight (fst pose) (place track v) :| []) 0

-- | The biarc to a parameter, measured; where the usual ratio of the chords misses, the best of some others.
try :: Track -> Double -> Double -> Double -> (Point, Vec) -> [(Double, Double)] -> Double -> Trial
try track aim u final' pose spans v = case candidates of
  first : others
    | roughly first <= aim || null others -> measured first
    | otherwise -> let (_, found) = minimumBy (comparing fst) [(roughly c, c) | c <- candidates] in measured found
  [] -> Trial v (Straight p q :| []) (8 * aim)
  where
    p = fst pose
    q = place track v
    end = (q, heading track final' spans v)
    usual = uncurry ratio (lean pose end)
    candidates
      | Vec.near p q = [Straight p q :| []]
      | otherwise = [pieces | k <- [1, 0.7, 1.4, 0.5, 2], Just pieces <- [joinWith (k * usual) pose end]]
    parts = [(max u lo, min v hi) | (lo, hi) <- takeWhile ((< v) . fst) spans, hi > u]
    -- As many as its share of the parameter or of the length asks for.
    chords = [let Mm d = Vec.distance (place track a) (place track b) in d | (a, b) <- parts]
    counts = [max 3 (ceiling (8 * max ((b - a) / (v - u)) (d / sum chords))) | ((a, b), d) <- zip parts chords] :: [Int]
    stations shift (a, b) n = [let w = a + (b - a) * uneven ((fromIntegral k - shift) / fromIntegral n) in (w, place track w) | k <- [1 .. n]]
    -- So that a wave does not pass for its samples.
    uneven f = f + 0.2 * f * (1 - f)
    middles = concat (zipWith (stations 0.5) parts counts)
    roughly pieces = maximum (map (apart pieces . snd) middles)
    measured pieces
      | roughly pieces > aim = Trial v pieces (roughly pieces)
      | otherwise = Trial v pieces (deviation (place track) aim pieces ((u, p) : interleaved middles (concat (zipWith (stations 0) parts counts))))
    interleaved as bs = concat (zipWith (\a b -> [a, b]) as bs)

-- | The distance of a point from the nearest of some segments.
apart :: NonEmpty Segment -> Point -> Double
apart pieces p = let Mm d = minimum (fmap (Distance.toPoint p) pieces) in d

-- | The largest distance between segments and a curve given by points along it: at these points, near the segments'
-- joint, and at each maximum between them. Infinite where the feet on the segments jump or go back: then not
-- every point of the segments is near the curve.
deviation :: (Double -> Point) -> Double -> NonEmpty Segment -> [(Double, Point)] -> Double
deviation point aim pieces points
  | largest > aim || covered point aim pieces feet = largest
  | otherwise = 1 / 0
  where
    feet = [(w, p, progress pieces p) | (w, p) <- points]
    Mm half = Segment.length (NonEmpty.head pieces)
    atJoint = [let w = a + (b - a) * (half - s) / (t - s) in (w, off w) | length pieces > 1, ((a, _, s), (b, _, t)) <- zip feet (drop 1 feet), s < half, half < t]
    known = sort ([(w, apart pieces p) | (w, p) <- points] <> atJoint)
    off w = apart pieces (point w)
    largest = maximum (map snd known <> zipWith3 (\a b c -> snd (highest off aim (6 :: Int) a b c)) known (drop 1 known) (drop 2 known))

-- | The maximum about the middle one of three neighbouring values, if that is the largest and matters: the vertex of the
-- parabola through them, again and again until it says nothing new.
highest :: (Double -> Double) -> Double -> Int -> (Double, Double) -> (Double, Double) -> (Double, Double) -> (Double, Double)
highest off aim left one@(a, da) two@(b, db) three@(c, dc)
  | left <= 0 || db < da || db < dc || db < 0.3 * aim || not (below > 0 && w > a && w < c && w /= b) = two
  | abs (dw - db) < 0.002 * aim = max' new two
  | dw > db = if w < b then again one new two else again two new three
  | w < b = again new two three
  | otherwise = again one two new
  where
    below = (b - a) * (db - dc) + (c - b) * (db - da)
    w = b - ((b - a) * (b - a) * (db - dc) - (c - b) * (c - b) * (db - da)) / (2 * below)
    dw = off w
    new = (w, dw)
    again = highest off aim (left - 1)
    max' x y = if snd x > snd y then x else y

-- | Whether the feet of a curve's points move along the segments without a jump. Where a foot moves much further than
-- its point, the curve between is looked at more closely.
covered :: (Double -> Point) -> Double -> NonEmpty Segment -> [(Double, Point, Double)] -> Bool
covered point aim pieces feet = and (zipWith (steady (20 :: Int)) feet (drop 1 feet))
  where
    steady left one@(a, p, s) two@(b, q, t)
      | t < s - grain = False
      | t - s <= 1.5 * far + grain = True
      | far <= grain || left <= 0 = False
      | otherwise = let middle = at ((a + b) / 2) in steady (left - 1) one middle && steady (left - 1) middle two
      where
        Mm far = Vec.distance p q
    at w = let p = point w in (w, p, progress pieces p)
    grain = 0.1 * aim

-- | How far along segments the foot of a point lies.
progress :: NonEmpty Segment -> Point -> Double
progress pieces p = go 0 (NonEmpty.toList pieces) (1 / 0, 0)
  where
    go before list best@(nearest, _) = case list of
      [] -> snd best
      s : more ->
        let Mm d = Distance.toPoint p s
            Mm long = Segment.length s
         in go (before + long) more (if d < nearest then (d, before + long * footAt s) else best)
    footAt s
      | Segment.spans s p = Segment.fraction s p
      | Vec.distance p (Segment.start s) <= Vec.distance p (Segment.end s) = 0
      | otherwise = 1
