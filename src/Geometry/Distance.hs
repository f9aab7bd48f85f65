-- | Distances between points, lines and arcs in closed form, and how far one chain of
-- segments is covered by the neighbourhood of another.
module Geometry.Distance
  ( toPoint,
    nearest,
    ClosestPoint (..),
    segments,
    crossings,
    uncovered,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (minimumBy, sort)
import Data.Ord (comparing)
import Geometry.Carrier (Circle (Circle), Line (Line))
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

-- | The distance from a point to a segment, and the nearest point on it.
nearest :: Point -> Segment -> (Mm, Point)
nearest p segment
  | proper && Segment.spans segment p = (Vec.distance p foot, foot)
  | toStart <= toEnd = (toStart, Segment.start segment)
  | otherwise = (toEnd, Segment.end segment)
  where
    toStart = Vec.distance p (Segment.start segment)
    toEnd = Vec.distance p (Segment.end segment)
    (proper, foot) = case segment of
      Straight a b -> (a /= b, Vec.between (Segment.fraction segment p) a b)
      Arc {start, centre} ->
        let Mm r = Segment.radius centre start
            out = Vec.to centre p
         in (Vec.norm out > 0, Vec.shift (Vec.scale (r / Vec.norm out) out) centre)

-- | The least distance of two segments, and the point of the first where it is taken.
data ClosestPoint = ClosestPoint {distance :: Mm, place :: Point}
  deriving stock (Eq, Show)

-- | The least distance of two segments. It is taken at an end of one of them, at a crossing, or
-- where the normal is common: at the foot of an arc's centre on a straight line, or on the
-- line of two centres.
segments :: Segment -> Segment -> ClosestPoint
segments a b = minimumBy (comparing distance) (map fromA onA <> map fromB onB)
  where
    fromA p = ClosestPoint (toPoint p b) p
    fromB q = let (d, p) = nearest q a in ClosestPoint d p
    onA = Segment.start a : Segment.end a : filter (Segment.spans a) (normals a b <> common a b)
    onB = Segment.start b : Segment.end b : filter (Segment.spans b) (normals b a)

-- | The points of the first segment's carrier at which its normal is also one of the second, an
-- arc.
normals :: Segment -> Segment -> [Point]
normals a b = case (a, b) of
  (Straight p q, Arc {centre}) | p /= q -> [Vec.between (Segment.fraction a centre) p q]
  (Arc {start, centre}, Arc {centre = other})
    | centre /= other ->
      let Mm r = Segment.radius centre start
          e = Vec.unit (Vec.to centre other)
       in [Vec.shift (Vec.scale r e) centre, Vec.shift (Vec.scale (-r) e) centre]
  _ -> []

-- | Where two segments cross or touch.
crossings :: Segment -> Segment -> [Point]
crossings a b = filter (\p -> reaches a p && reaches b p) (common a b)
  where
    reaches s p = toPoint p s <= Tolerance.coincident

-- | The points that the carriers of two segments have in common. Of a common carrier, the ends
-- of each segment stand for the stretch in common.
common :: Segment -> Segment -> [Point]
common a b = case (carrier a, carrier b) of
  (Just (LineCarrier l), Just (LineCarrier m)) -> points (Intersection.lines l m)
  (Just (LineCarrier l), Just (CircleCarrier c)) -> points (Intersection.lineCircle l c)
  (Just (CircleCarrier c), Just (LineCarrier l)) -> points (Intersection.lineCircle l c)
  (Just (CircleCarrier c), Just (CircleCarrier d)) -> points (Intersection.circles c d)
  _ -> []
  where
    points meeting = case meeting of
      Apart _ -> []
      Touching p -> [p]
      CrossingOnce p -> [p]
      Crossing p q -> [p, q]
      Same -> [Segment.start a, Segment.end a, Segment.start b, Segment.end b]

data Carrier = LineCarrier Line | CircleCarrier Circle

-- | The carrier of a segment that has a length.
carrier :: Segment -> Maybe Carrier
carrier segment = case segment of
  Straight a b -> if a == b then Nothing else Just (LineCarrier (Line a b))
  Arc {start, centre} ->
    let r = Segment.radius centre start
     in if r > Mm 0 then Just (CircleCarrier (Circle centre r)) else Nothing

-- | The stretches of a segment, as fractions of its length, that lie further than a distance from
-- all the others. Exact: the ends of the stretches are where the segment meets the boundary of
-- the others' neighbourhoods, two lines or arcs beside each and a circle about each end.
uncovered :: Mm -> [Segment] -> Segment -> [(Double, Double)]
uncovered reach others segment = gaps 0 (sort (concatMap covered others))
  where
    gaps from stretches = case stretches of
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
        marks =
          sort (0 : 1 : filter (\t -> t > 0 && t < 1) (map (Segment.fraction segment) boundary))
        boundary = ends <> concatMap (common segment) (neighbourhood reach other)
        -- A circle about an end bounds nothing when it is a point.
        ends = [p | reach <= Mm 0, p <- [Segment.start other, Segment.end other]]

-- | The curves that bound the points within a distance of a segment, possibly with more.
neighbourhood :: Mm -> Segment -> [Segment]
neighbourhood reach@(Mm d) segment =
  disc (Segment.start segment) <> disc (Segment.end segment) <> beside
  where
    disc p = [circleAbout p reach]
    beside = case segment of
      Straight a b
        | a == b -> []
        | otherwise ->
          let n = Vec.scale d (Vec.left (Vec.unit (Vec.to a b)))
           in [Straight (Vec.shift v a) (Vec.shift v b) | v <- [n, Vec.negate n]]
      Arc {start, centre} ->
        let Mm r = Segment.radius centre start
         in [circleAbout centre (Mm rho) | rho <- [r + d, abs (r - d)], rho > 0]
    circleAbout p (Mm r) =
      let begin = Vec.shift (Vec.vec r 0) p
       in Arc {start = begin, end = begin, centre = p, sweep = Rad (2 * pi)}
