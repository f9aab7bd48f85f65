-- | Distances and intersections of points, lines and arcs in closed form.
--
-- This module owns the distance from a point to a segment and between two segments.
-- "Geometry.Distance.Fast" computes the same on unpacked data for loops over frames.
module Geometry.Distance
  ( toPoint,
    nearest,
    nearestFraction,
    ClosestPoint (..),
    segments,
    intersections,
    uncovered,
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

-- | The distance from a point to a segment, and the point of the segment that is nearest.
nearest :: Point -> Segment -> (Mm, Point)
nearest p segment
  | hasFoot && Segment.hasFootOf segment p = (Vec.distance p foot, foot)
  | toStart <= toEnd = (toStart, Segment.start segment)
  | otherwise = (toEnd, Segment.end segment)
  where
    toStart = Vec.distance p (Segment.start segment)
    toEnd = Vec.distance p (Segment.end segment)
    -- No point has a foot on a line without a length, nor the centre of an arc on that arc.
    (hasFoot, foot) = case segment of
      Straight a b -> (a /= b, Vec.interpolate (Segment.fraction segment p) a b)
      Arc {start, centre} ->
        let Mm r = Segment.radius centre start
            out = Vec.to centre p
         in (Vec.norm out > 0, Vec.shift (Vec.scale (r / Vec.norm out) out) centre)

-- | The fraction of a segment's length, from 0 to 1, at which the segment is nearest to a point.
nearestFraction :: Point -> Segment -> Double
nearestFraction p segment
  | Segment.hasFootOf segment p = Segment.fraction segment p
  | Vec.distance p (Segment.start segment) <= Vec.distance p (Segment.end segment) = 0
  | otherwise = 1

-- | The least distance from one segment to another, and the point of the first at which it occurs.
data ClosestPoint = ClosestPoint {distance :: Mm, nearestPoint :: Point}
  deriving stock (Eq, Show)

-- | The least distance between two segments. It occurs at an end of one of them, at an
-- intersection, or on a common normal. Such a normal passes through the foot of an arc's centre on
-- a line, or through the centres of two arcs.
segments :: Segment -> Segment -> ClosestPoint
segments a b = minimumBy (comparing distance) (map fromA onA <> map fromB onB)
  where
    fromA p = ClosestPoint (toPoint p b) p
    fromB q = let (d, p) = nearest q a in ClosestPoint d p
    onA = Segment.start a : Segment.end a : filter (Segment.hasFootOf a) (normals a b <> common a b)
    onB = Segment.start b : Segment.end b : filter (Segment.hasFootOf b) (normals b a)

-- | The points on the first segment's carrier at which its normal passes through the centre of the
-- second segment, an arc.
normals :: Segment -> Segment -> [Point]
normals a b = case (a, b) of
  (Straight p q, Arc {centre}) | p /= q -> [Vec.interpolate (Segment.fraction a centre) p q]
  (Arc {start, centre}, Arc {centre = other})
    | centre /= other ->
      let Mm r = Segment.radius centre start
          e = Vec.unit (Vec.to centre other)
       in [Vec.shift (Vec.scale r e) centre, Vec.shift (Vec.scale (-r) e) centre]
  _ -> []

-- | The points at which two segments cross or touch, to 'Tolerance.coincident'. Segments that
-- overlap on one carrier give those of their ends that lie on the other segment.
intersections :: Segment -> Segment -> [Point]
intersections a b = filter (\p -> reaches a p && reaches b p) (common a b)
  where
    reaches s p = toPoint p s <= Tolerance.coincident

-- | The common points of two segments' carriers. When both segments have the same carrier, their
-- four ends are returned, which include the ends of an overlap.
common :: Segment -> Segment -> [Point]
common a b = case Intersection.carriers <$> Segment.carrier a <*> Segment.carrier b of
  Nothing -> []
  Just Same -> [Segment.start a, Segment.end a, Segment.start b, Segment.end b]
  Just intersection -> Intersection.points intersection

-- | The parts of a segment that are further than @reach@ from all other segments, as ranges of
-- fractions of its length. They are exact: each ends where the segment meets the boundary of the
-- neighbourhood of another segment.
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
        -- For a reach of 0, the circles about the ends of the other segment are points. Points have
        -- no intersections, so the ends are added.
        ends = [p | reach <= Mm 0, p <- [Segment.start other, Segment.end other]]

-- | Segments that contain the boundary of a segment's neighbourhood, the region within @reach@ of
-- it. They are circles about its ends and its offsets to both sides; the offsets of an arc are full
-- circles.
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
