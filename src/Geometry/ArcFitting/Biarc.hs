-- | Biarcs: two arcs with a common tangent at their joint, between given end points and end
-- directions.
--
-- Derivation, in the complex plane in which the chord runs from 0 to 1. Let the start direction
-- have the angle α and the end direction the angle β. The chord of an arc bisects the angle between
-- its end directions. With the direction γ at the joint and the chords @c@ and @r·c@ of the two
-- arcs, @c·e^{i(α+γ)/2} + r·c·e^{i(γ+β)/2} = 1@. With @w = e^{iα/2} + r·e^{iβ/2}@ it follows that
-- @γ = −2·arg w@, @c = 1/|w|@, and the joint is @(1 + r·e^{i(α−β)/2}) / |w|²@.
--
-- For α and β in (−π, π) each chord ratio r gives one biarc; equal chords are the default. The
-- other usual choice is equal tangent lengths. It has no solution where the end directions are
-- parallel to each other and perpendicular to the chord. The two choices differ by third-order
-- terms of the angles.
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
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- Between two ends ------------------------------------------------------------------------------

-- | Biarc from one point and unit direction to another: two segments, or one if a line or a single
-- arc suffices. The chords of both arcs are equal, except where they would give an S-shape to a
-- curve that bends to one side. In this case one arc gets a chord up to four times as long as the
-- other: the arc at the end whose direction is nearer to that of the whole chord. Nothing if the
-- points coincide, if an arc would sweep more than half a turn, or if the joint is farther than
-- 'Tolerance.reach' from an end.
join :: (Point, Vec) -> (Point, Vec) -> Maybe (NonEmpty Segment)
join from to = joinWith (ratio from to) from to

-- | Biarc from one point and unit direction to another, like that of 'join', but with @r@ as the
-- ratio of the second arc's chord to the first arc's chord.
joinWith :: Double -> (Point, Vec) -> (Point, Vec) -> Maybe (NonEmpty Segment)
joinWith r from@(p, _) to@(q, _) = do
  guard (not (Vec.isNear p q))
  guard (isWithin (gamma - alpha) Tolerance.halfTurn && isWithin (beta - gamma) Tolerance.halfTurn)
  guard (Vec.distance p joint <= Tolerance.reach && Vec.distance joint q <= Tolerance.reach)
  pure result
  where
    (alpha, beta) = chordAngles from to
    gamma = -2 * atan2 (sin (alpha / 2) + r * sin (beta / 2)) (cos (alpha / 2) + r * cos (beta / 2))
    halfDifference = (alpha - beta) / 2
    -- The square of the absolute value of w, in the derivation of the module's header.
    square = 1 + r * r + 2 * r * cos halfDifference
    chord = Vec.to p q
    joint =
      Vec.shift
        ( Vec.add
            (Vec.scale ((1 + r * cos halfDifference) / square) chord)
            (Vec.scale (r * sin halfDifference / square) (Vec.left chord))
        )
        p
    result
      | isWithin alpha Tolerance.straight && isWithin beta Tolerance.straight = Straight p q :| []
      | isWithin (alpha + beta) Tolerance.oneArc && isWithin (beta - alpha) Tolerance.halfTurn =
        arcBySweep p q (beta - alpha) :| []
      | otherwise = arcBySweep p joint (gamma - alpha) :| [arcBySweep joint q (beta - gamma)]

-- | True if the absolute value of angle @a@ (rad) does not exceed a limit.
isWithin :: Double -> Rad -> Bool
isWithin a (Rad limit) = abs a <= limit

-- | Angles, in radians and in (−π, π], from the chord to the direction at the start and at the end.
chordAngles :: (Point, Vec) -> (Point, Vec) -> (Double, Double)
chordAngles (p, s) (q, t) = (a, b)
  where
    Rad a = Vec.signedAngle (Vec.to p q) s
    Rad b = Vec.signedAngle (Vec.to p q) t

-- | Chord ratio of the biarc that 'join' makes: the length of the second arc's chord divided by
-- that of the first. Let α and β be the angles from the whole chord to the directions at the start
-- and at the end. If they have opposite signs, the curve bends to one side. Then the first arc
-- should sweep at least |α|/2, and the second at least |β|/2, so that both bend to this side. The
-- ratio is 1 if this gives such arcs. Otherwise it is the ratio nearest to 1 that does, but at
-- least 1/4 and at most 4. If α and β have the same sign, the ratio is 1.
ratio :: (Point, Vec) -> (Point, Vec) -> Double
ratio from to
  | alpha * beta >= 0 || limited == gamma = 1
  | otherwise = max 0.25 (min 4 (-(sin ((alpha + limited) / 2) / sin ((limited + beta) / 2))))
  where
    (alpha, beta) = chordAngles from to
    gamma = -((alpha + beta) / 2)
    limited = max (min alpha beta / 2) (min (max alpha beta / 2) gamma)

-- | Arc between two points with the sweep @sweep@ (rad, positive counter-clockwise). It is a line
-- if the sweep is negligible.
arcBySweep :: Point -> Point -> Double -> Segment
arcBySweep p q sweep
  | isWithin sweep Tolerance.straight = Straight p q
  | otherwise = Segment.arc (Carrier.senseOf (Rad sweep)) centre p q
  where
    chord = Vec.to p q
    centre =
      Vec.shift (Vec.scale (1 / (2 * tan (sweep / 2))) (Vec.left chord)) (Vec.interpolate 0.5 p q)

-- Through points --------------------------------------------------------------------------------

-- | Smooth chain of arcs and lines through points in order. A closed chain returns to the first
-- point.
--
-- The direction at a point is that of the circle through the point and its two neighbours. At an
-- end of an open chain it is that of the circle through the first or the last three points. At a
-- sharp corner, this circle would sweep more than half a turn from the point to a neighbour. There
-- the direction is the mean of those from the previous point and to the next one.
--
-- Two points give a line or, in a closed chain, the circle that has this line as a diameter.
-- Consecutive points that coincide count once. A single point gives a line of length 0.
through :: Ends -> NonEmpty Point -> NonEmpty Segment
through ends points = case distinctPoints ends points of
  p :| [] -> Straight p p :| []
  p :| [q] | ends == Open -> Straight p q :| []
  ps@(p :| rest) ->
    let list = NonEmpty.toList ps
        directions = case ends of
          Closed -> zipWith3 tangentAt (NonEmpty.last ps : list) list (rest <> [p])
          Open -> openDirections list
        poses = zip list directions
        next = case ends of
          Closed -> drop 1 poses <> take 1 poses
          Open -> drop 1 poses
     in fromMaybe
          (Straight p p :| [])
          (NonEmpty.nonEmpty (concat (zipWith segmentsBetween poses next)))
  where
    segmentsBetween a b = maybe [Straight (fst a) (fst b)] NonEmpty.toList (join a b)

-- | Drops each point that coincides with the previous one. In a closed chain it also drops last
-- points that coincide with the first.
distinctPoints :: Ends -> NonEmpty Point -> NonEmpty Point
distinctPoints ends (first :| others) = first :| withoutLast (withoutRepeats first others)
  where
    withoutRepeats before rest = case rest of
      [] -> []
      p : more
        | Vec.isNear before p -> withoutRepeats before more
        | otherwise -> p : withoutRepeats p more
    withoutLast ps = case ends of
      Open -> ps
      Closed -> reverse (dropWhile (Vec.isNear first) (reverse ps))

-- | Directions, as unit vectors, at three or more points of an open chain. The direction at an end
-- point is that of its neighbour, mirrored in the perpendicular bisector of the two points. So the
-- segment between them is a single arc.
openDirections :: [Point] -> [Vec]
openDirections ps = case (ps, reverse ps) of
  (a : b : _, z : y : _) ->
    let inner = zipWith3 tangentAt ps (drop 1 ps) (drop 2 ps)
     in [mirrored a b t | t <- take 1 inner]
          <> inner
          <> [mirrored y z t | t <- take 1 (reverse inner)]
  _ -> []
  where
    mirrored a b t = Vec.rotate (Vec.signedAngle t (Vec.to a b)) (Vec.unit (Vec.to a b))

-- | Unit direction at point @b@ of a chain with the neighbours @a@ and @c@; see 'through'. It is
-- computed by the theorem that the angle between a tangent and a chord of a circle equals the
-- opposite angle of the triangle.
tangentAt :: Point -> Point -> Point -> Vec
tangentAt a b c
  | not (Vec.isNear a c) && Vec.dot circleTangent ab >= 0 && Vec.dot circleTangent bc >= 0 =
    circleTangent
  | Vec.norm bisector > Tolerance.parallel = Vec.unit bisector
  | otherwise = Vec.left ab
  where
    ab = Vec.unit (Vec.to a b)
    bc = Vec.unit (Vec.to b c)
    circleTangent = Vec.unit (Vec.rotate (Vec.signedAngle (Vec.to a c) bc) ab)
    bisector = Vec.add ab bc
