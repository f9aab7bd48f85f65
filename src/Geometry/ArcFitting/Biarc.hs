-- | Biarcs: two arcs that go over into one another smoothly, with given ends and directions there.
--
-- In the complex plane of the chord (from 0 to 1), let the walk set out at the angle α and arrive
-- at the angle β. An arc's chord halves the angle between its ends' directions, so with the
-- direction γ at the joint and the chords @c@ and @r·c@ of the two arcs, @c·e^{i(α+γ)/2} +
-- r·c·e^{i(γ+β)/2} = 1@. Hence with
-- @w = e^{iα/2} + r·e^{iβ/2}@: @γ = −2·arg w@, @c = 1/|w|@, and the joint is
-- @(1 + r·e^{i(α−β)/2}) / |w|²@. For α and β in (−π, π) there is one for every ratio r; equal
--  chords are the
-- rule. (Equal tangent lengths, the other usual choice, have no answer where the two directions are
-- parallel and square to the chord, and differ from equal chords by terms of the third order in the
-- angles.)
module Geometry.ArcFitting.Biarc
  ( -- * Between two ends
    join,
    joinWith,
    ratio,

    -- * Through points
    through,
  )
where

import Base.Quantity (Rad (..))
import Control.Monad (guard)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Geometry.Carrier (Sense (..))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- Between two ends ------------------------------------------------------------------------------

-- | The biarc from one point and direction (of length 1) to another: two segments, or one where a
-- straight line or a single arc does it. The arcs have equal chords, unless a curve that bends to
-- one side would be given a bend to the other side; then the chord at the end that leans less to
-- the whole chord is up to four times as long. Nothing where the points are one point or an arc
-- would turn by more than half a turn.
join :: (Point, Vec) -> (Point, Vec) -> Maybe (NonEmpty Segment)
join from to = joinWith (ratio from to) from to

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
    joint =
      Vec.shift
        ( Vec.add
            (Vec.scale ((1 + r * cos opening) / square) chord)
            (Vec.scale (r * sin opening / square) (Vec.left chord))
        )
        p
    result
      | most alpha Tolerance.straight && most beta Tolerance.straight = Straight p q :| []
      | most (alpha + beta) Tolerance.oneArc && most (beta - alpha) Tolerance.halfTurn =
        bent p q (beta - alpha) :| []
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

-- | The ratio of the chords that 'join' takes: 1, or what keeps a curve bent to one side: the
-- joint's direction stays at least half of either end's angle away from that end's direction.
ratio :: (Point, Vec) -> (Point, Vec) -> Double
ratio from to
  | alpha * beta >= 0 || held == gamma = 1
  | otherwise = max 0.25 (min 4 (-(sin ((alpha + held) / 2) / sin ((held + beta) / 2))))
  where
    (alpha, beta) = lean from to
    gamma = -((alpha + beta) / 2)
    held = max (min alpha beta / 2) (min (max alpha beta / 2) gamma)

-- | The arc between two points that turns by an angle; a straight line where it hardly turns.
bent :: Point -> Point -> Double -> Segment
bent p q sweep
  | most sweep Tolerance.straight = Straight p q
  | otherwise = Segment.arc (if sweep > 0 then CounterClockwise else Clockwise) centre p q
  where
    chord = Vec.to p q
    centre =
      Vec.shift (Vec.scale (1 / (2 * tan (sweep / 2))) (Vec.left chord)) (Vec.between 0.5 p q)

-- Through points --------------------------------------------------------------------------------

-- | A smooth chain of arcs and lines through points in order; a closed one comes back to the first.
-- The direction at a point is that of the circle through it and its neighbours, at the ends of an
-- open chain that of the circle through the first or last three. Where that circle would turn by
-- more than half a turn between two of them (a sharp turn of the points), it halves the angle
-- instead. Two points are joined by a line, or, closed, by the circle about them. Points that
-- follow at the same place count once; a single one gives a line without length.
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

-- | The directions at three or more points of an open chain; the end's one is the neighbour's in
-- the mirror of the perpendicular bisector, so that the last piece is one arc.
openDirections :: [Point] -> [Vec]
openDirections ps = case (ps, reverse ps) of
  (a : b : _, z : y : _) ->
    let inner = zipWith3 passing ps (drop 1 ps) (drop 2 ps)
     in [mirrored a b t | t <- take 1 inner]
          <> inner
          <> [mirrored y z t | t <- take 1 (reverse inner)]
  _ -> []
  where
    mirrored a b t = Vec.rotate (Vec.turn t (Vec.to a b)) (Vec.unit (Vec.to a b))

-- | The direction at the middle one of three points. On the circle, the angles from the first chord
-- to it and from it to the second one are those of the triangle at the far ends.
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
