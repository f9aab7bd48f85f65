-- | Arcs in whole pulses: the frames of an exact arc on a machine with circular interpolation.
--
-- A grid point is a position in whole pulses. A step is a line or an arc that becomes one frame.
-- The ends of an arc are rounded to the nearest grid points. Its centre becomes the grid point
-- about which the rounded arc deviates least from the exact one. Candidates are the grid points
-- near the exact centre, and those near a second point. The second point is equally far from both
-- rounded ends, and of all such points it is nearest to the exact centre. If these candidates do
-- not suffice, more remote grid points are tried. When no candidate gives frames within the
-- tolerance, the arc is halved. When halving does not help, or the centre does not fit its field,
-- the arc is divided into chords.
--
-- Read "Frame.Arc.Context" first. "Frame.Arc.Centre" lists the grid points, "Frame.Arc.Attempt"
-- chooses among them. "Frame.Arc.Deviation" measures how far the rounded arc is from the exact one.
-- "Frame.Arc.Quadrant" cuts an arc at the axes.
module Frame.Arc
  ( ArcStep (..),
    ArcTolerance (..),
    Grid,
    gridOf,
    steps,
  )
where

import Base.PulseVector (Pulses3 (..), xy)
import Base.Quantity (Mm (..), Pulses (..), Rad (..))
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Frame.Arc.Attempt qualified as Attempt
import Frame.Arc.Centre qualified as Centre
import Frame.Arc.Context
  ( ArcContext (..),
    ArcStep (..),
    ArcTolerance (..),
    Grid (..),
    RoundedArc (..),
    gridOf,
  )
import Frame.Arc.Context qualified as Context
import Frame.Rounding qualified as Rounding
import Geometry.Carrier qualified as Carrier
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)

-- | Steps along a segment at the constant height @height@ in mm. They begin at the segment's
-- rounded start, the given position in pulses, and end at its rounded end. The function @chordsOf@
-- divides parts that cannot be arcs into chords. It takes the rounded start of a part, and returns
-- the ends of the chords in pulses.
steps ::
  Grid ->
  ArcTolerance ->
  (Pulses3 -> Segment -> [Pulses3]) ->
  Mm ->
  Pulses3 ->
  Segment ->
  [ArcStep]
steps grid tolerance chordsOf height =
  halved mostHalvings ArcContext {grid, tolerance, chordsOf, height}

-- | Greatest number of times that an arc is halved. After that, its parts are divided into chords.
mostHalvings :: Int
mostHalvings = 5

-- | Steps along the segment @s@, from its rounded start @begin@. The segment may be halved at most
-- @halvings@ times.
halved :: Int -> ArcContext -> Pulses3 -> Segment -> [ArcStep]
halved halvings context begin s = case s of
  Straight _ _ -> asLine
  Segment.Arc {Segment.centre, Segment.sweep = Rad sweep}
    | Attempt.isNearlyStraight context s
        && Attempt.isStraightEnough context s (xy begin : map (xy . target) asLine) ->
      asLine
    | halvings <= 0 || not (isCentreFitting context begin centre radius) ->
      map straightTo (chordsOf context begin s)
    | otherwise ->
      let arc = RoundedArc {begin, finish, exact = s, centre, radius, sweep, sense}
       in fromMaybe halves (asArcs context arc)
    where
      radius = Segment.radius centre (Segment.start s)
      sense = Carrier.senseOf (Rad sweep)
  where
    finish = Context.roundedPoint context (Segment.end s)
    straightTo p = ArcStep {target = p, turnsAbout = Nothing}
    asLine = map straightTo (Rounding.split (machine (grid context)) begin (from, to))
    from = (Segment.start s, height context)
    to = (Segment.end s, height context)
    halves =
      let (front, back) = Segment.cutAt 0.5 s
          middle = Context.roundedPoint context (Segment.end front)
       in halved (halvings - 1) context begin front <> halved (halvings - 1) context middle back

-- | Steps of a rounded arc about the best grid point. The grid points of 'Centre.remoteCentres' are
-- tried only if those of 'Centre.nearCentres' give no steps within the tolerance. Nothing if both
-- give none; then the arc is halved.
asArcs :: ArcContext -> RoundedArc -> Maybe [ArcStep]
asArcs context arc =
  listToMaybe
    ( mapMaybe
        (Attempt.bestAbout context arc)
        [Centre.nearCentres context arc, Centre.remoteCentres context arc]
    )

-- | True for an arc whose centre fits its field in a frame, measured from the rounded start of the
-- arc and from every point of its circle. Any other arc becomes chords, even if parts of it fit.
-- @centre@ and @r@ are the exact centre and radius in mm. The second argument is the rounded start.
isCentreFitting :: ArcContext -> Pulses3 -> Point -> Mm -> Bool
isCentreFitting context (Pulses3 x y _) centre (Mm r) =
  abs (i - x) < largest
    && abs (j - y) < largest
    && Pulses (ceiling (r / min (pulseX (grid context)) (pulseY (grid context)))) < largest
  where
    Pulses3 i j _ = Context.roundedPoint context centre
    largest = largestCentre (grid context)
