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
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
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
distinct ends (first :| others) = first :| back (apart first others)
  where
    apart before rest = case rest of
      [] -> []
      p : more
        | Vec.near before p -> apart before more
        | otherwise -> p : apart p more
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
  | Vec.norm halving > 0 = Vec.unit halving
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

-- | The segments along a stretch.
follow :: Track -> Double -> Stretch -> [Segment]
follow track tolerance stretch@((start, firstEnd) :| _) =
  go start (place track start, direction track Leaving start) (NonEmpty.toList stretch) ((firstEnd - start) / 8)
  where
    final = snd (NonEmpty.last stretch)
    go u pose spans step
      | u < final =
        let Trial {reached, pieces} = furthest track tolerance final u pose spans step
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
        found = try track aim final u pose spans (min final (u + step))
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

-- | The biarc to a parameter, measured.
try :: Track -> Double -> Double -> Double -> (Point, Vec) -> [(Double, Double)] -> Double -> Trial
try track aim final u pose@(p, _) spans v = case join pose (q, heading track final spans v) of
  Just pieces -> Trial v pieces (deviation (place track) aim u v spans pieces)
  Nothing
    | Vec.distance p q <= Mm aim -> let pieces = Straight p q :| [] in Trial v pieces (deviation (place track) aim u v spans pieces)
    | otherwise -> Trial v (Straight p q :| []) (8 * aim)
  where
    q = place track v

-- | The largest distance from a curve between two parameters to segments: at points all along each span, if these are near
-- enough at more of them, and at the vertices of the parabolas through three neighbours about each maximum.
-- Infinite where the feet on the segments go back by more than the tolerance: then not every point of the
-- segments is near the curve.
deviation :: (Double -> Point) -> Double -> Double -> Double -> [(Double, Double)] -> NonEmpty Segment -> Double
deviation point aim u v spans pieces
  | coarse > aim = coarse
  | backwards = 1 / 0
  | otherwise = maximum (0 : map snd dense <> refined)
  where
    parts = [(max u lo, min v hi) | (lo, hi) <- takeWhile ((< v) . fst) spans, hi > u]
    count (a, b) = max 3 (ceiling (8 * (b - a) / (v - u))) :: Int
    stations shift part@(a, b) = [a + (b - a) * (fromIntegral k - shift) / fromIntegral (count part) | k <- [1 .. count part]]
    measured w = let p = point w in (w, p, distance p)
    distance p = let Mm d = minimum (fmap (Distance.toPoint p) pieces) in d
    middles = [map measured (stations 0.5 part) | part <- parts]
    coarse = maximum (0 : [d | (_, _, d) <- concat middles])
    ends = [map measured (stations 0 part) | part <- parts]
    all' = concat (zipWith (\ms es -> concat (zipWith (\m e -> [m, e]) ms es)) middles ends)
    dense = (u, 0) : [(w, d) | (w, _, d) <- all']
    refined = [d | (a, b, c) <- zip3 dense (drop 1 dense) (drop 2 dense), Just w <- [peak a b c], let (_, _, d) = measured w]
    peak (a, da) (b, db) (c, dc)
      | db >= da && db >= dc && db > 0.5 * aim && below > 0 && w > a && w < c = Just w
      | otherwise = Nothing
      where
        below = (b - a) * (db - dc) + (c - b) * (db - da)
        w = b - ((b - a) * (b - a) * (db - dc) - (c - b) * (c - b) * (db - da)) / (2 * below)
    feet = [progress pieces p | (_, p, _) <- all']
    backwards = or (zipWith (\a b -> b < a - aim) feet (drop 1 feet))

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
