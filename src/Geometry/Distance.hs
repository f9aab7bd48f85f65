-- | Distances and intersections of points, lines and arcs in closed form.
--
-- "Geometry.Distance.Fast" computes the distances faster, on unpacked coordinates, for the proof of
-- a tape.
--
-- The foot of a point on a segment, as in "Geometry.Segment", is where the perpendicular from the
-- point meets the segment's carrier.
module Geometry.Distance
  ( toPoint,
    nearest,
    nearestFraction,
    ClosestPoint (..),
    segments,
    intersections,
    uncovered,
    neighbourhood,
  )
where

import Base.Quantity (Mm (..))
import Data.List (minimumBy, sort)
import Data.Maybe (mapMaybe)
import Data.Ord (comparing)
import Geometry.Carrier (Circle (Circle), Sense (..), Side (..))
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The distance from a point to a segment.
toPoint :: Point -> Segment -> Mm
toPoint p segment = fst (nearest p segment)

-- | The distance from the point @p@ to a segment, and the point of the segment that is nearest to
-- @p@.
nearest :: Point -> Segment -> (Mm, Point)
nearest p segment
  | hasFoot && Segment.hasFootOf segment p = (Vec.distance p foot, foot)
  | toStart <= toEnd = (toStart, Segment.start segment)
  | otherwise = (toEnd, Segment.end segment)
  where
    toStart = Vec.distance p (Segment.start segment)
    toEnd = Vec.distance p (Segment.end segment)
    -- No foot exists on a line between equal points. Nor does the centre of an arc have a foot on
    -- this arc.
    (hasFoot, foot) = case segment of
      Straight a b -> (a /= b, Vec.interpolate (Segment.fraction segment p) a b)
      Arc {start, centre} ->
        let Mm r = Segment.radius centre start
            out = Vec.to centre p
         in (Vec.norm out > 0, Vec.shift (Vec.scale (r / Vec.norm out) out) centre)

-- | The position of the segment's point that is nearest to the point @p@, as a fraction of the
-- segment's length from 0 to 1.
nearestFraction :: Point -> Segment -> Double
nearestFraction p segment
  | Segment.hasFootOf segment p = Segment.fraction segment p
  | Vec.distance p (Segment.start segment) <= Vec.distance p (Segment.end segment) = 0
  | otherwise = 1

-- | The least distance between two segments, and the point of the first segment at which it occurs.
data ClosestPoint = ClosestPoint {distance :: Mm, nearestPoint :: Point}
  deriving stock (Eq, Show)

-- | The least distance between the segments @a@ and @b@, with the point of @a@ at which it occurs.
-- This point is an end of @a@, the point nearest to an end of @b@, an intersection, or the foot of
-- a common normal of both. A common normal of an arc and another segment passes through the arc's
-- centre.
segments :: Segment -> Segment -> ClosestPoint
segments a b = minimumBy (comparing distance) (map fromA onA <> map fromB onB)
  where
    fromA p = ClosestPoint (toPoint p b) p
    fromB q = let (d, p) = nearest q a in ClosestPoint d p
    onA = Segment.start a : Segment.end a : filter (Segment.hasFootOf a) (normals a b <> common a b)
    onB = Segment.start b : Segment.end b : filter (Segment.hasFootOf b) (normals b a)

-- | The points of the carrier of @a@ at which the normal of @a@ passes through the centre of @b@.
-- There are none if @b@ is a line, if @a@ is a line between equal points, or if both segments are
-- arcs about the same centre.
normals :: Segment -> Segment -> [Point]
normals a b = case (a, b) of
  (Straight p q, Arc {centre}) | p /= q -> [Vec.interpolate (Segment.fraction a centre) p q]
  (Arc {start, centre}, Arc {centre = other})
    | centre /= other ->
      let Mm r = Segment.radius centre start
          e = Vec.unit (Vec.to centre other)
       in [Vec.shift (Vec.scale r e) centre, Vec.shift (Vec.scale (-r) e) centre]
  _ -> []

-- | The points at which two segments cross or touch: the common points of their carriers that lie
-- within 'Tolerance.coincident' of both segments. If both have the same carrier, these are the ends
-- of each that lie on the other segment.
intersections :: Segment -> Segment -> [Point]
intersections a b = filter (\p -> reaches a p && reaches b p) (common a b)
  where
    reaches s p = toPoint p s <= Tolerance.coincident

-- | The common points of two segments' carriers. When both segments have the same carrier, their
-- four ends are returned: the ends of an overlap are among them.
common :: Segment -> Segment -> [Point]
common a b = case Intersection.carriers <$> Segment.carrier a <*> Segment.carrier b of
  Nothing -> []
  Just Same -> [Segment.start a, Segment.end a, Segment.start b, Segment.end b]
  Just intersection -> Intersection.points intersection

-- | The parts of @segment@ that are further than @reach@ from every one of the segments @others@.
-- Each part is given by the fractions of the segment's length, from 0 to 1, at which it starts and
-- ends. The fractions are exact: each is computed from an intersection of @segment@ with the
-- boundary of the region within @reach@ of one of @others@.
uncovered :: Mm -> [Segment] -> Segment -> [(Double, Double)]
uncovered reach others segment = gaps 0 (sort (concatMap covered others))
  where
    gaps from sections = case sections of
      [] -> [(from, 1) | from < 1]
      (a, b) : rest
        | a > from -> (from, a) : gaps (max from b) rest
        | otherwise -> gaps (max from b) rest
    covered other =
      [ (a, b)
        | (a, b) <- zip marks (drop 1 marks),
          toPoint (Segment.at ((a + b) / 2) segment) other <= reach
      ]
      where
        marks = sort (0 : 1 : filter isInside (map (Segment.fraction segment) boundary))
        isInside t = t > 0 && t < 1
        boundary = ends <> concatMap (common segment) (neighbourhood reach other)
        -- With a reach of 0, the circles about the ends of @other@ are points, for which 'common'
        -- finds no intersections. So these ends are added.
        ends = [p | reach <= Mm 0, p <- [Segment.start other, Segment.end other]]

-- | Segments that together contain the boundary of the region within @reach@ of @segment@. They are
-- two circles about the ends of @segment@, and the offsets of @segment@ to both sides. The offsets
-- of an arc are full circles.
neighbourhood :: Mm -> Segment -> [Segment]
neighbourhood reach@(Mm d) segment =
  disc (Segment.start segment) <> disc (Segment.end segment) <> beside
  where
    disc p = [circleAbout p reach]
    beside = case segment of
      Straight _ _ -> mapMaybe (\side -> Segment.offset side reach segment) [LeftOf, RightOf]
      Arc {start, centre} ->
        let Mm r = Segment.radius centre start
         in [circleAbout centre (Mm rho) | rho <- [r + d, abs (r - d)], rho > 0]
    circleAbout p radius@(Mm r) =
      Segment.fullCircle CounterClockwise (Circle p radius) (Vec.shift (Vec.vec r 0) p)
