-- | Intersections of lines and circles in closed form.
module Geometry.Construction.Intersection
  ( Intersection (..),
    points,
    carriers,
    common,
    lines,
    lineCircle,
    circles,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Carrier (Carrier (..), Circle (..), Line (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Prelude hiding (lines)

-- | The position of two carriers relative to each other.
data Intersection
  = -- | no common point, and the least distance between the carriers
    Apart Mm
  | -- | a common tangent at one point
    Touching Point
  | -- | two common points
    Crossing Point Point
  | -- | the common point of two lines
    CrossingOnce Point
  | -- | the same carrier, to 'Tolerance.coincident'
    Same
  deriving stock (Eq, Show)

-- | The common points that an intersection has. For 'Same', where all points are common, the list
-- is empty.
points :: Intersection -> [Point]
points intersection = case intersection of
  Apart _ -> []
  Same -> []
  Touching p -> [p]
  CrossingOnce p -> [p]
  Crossing p q -> [p, q]

-- | The intersection of two carriers. Two common points of a line and a circle come in the order in
-- which the line passes them.
carriers :: Carrier -> Carrier -> Intersection
carriers a b = case (a, b) of
  (LineCarrier l, LineCarrier m) -> lines l m
  (LineCarrier l, CircleCarrier c) -> lineCircle l c
  (CircleCarrier c, LineCarrier l) -> lineCircle l c
  (CircleCarrier c, CircleCarrier d) -> circles c d

-- | The common points of two carriers. The list is empty when the carriers are the same.
common :: Carrier -> Carrier -> [Point]
common a b = points (carriers a b)

-- | The intersection of the lines @a@ and @b@. They count as parallel when the sine of the angle
-- between their directions is at most 'Tolerance.parallel'.
lines :: Line -> Line -> Intersection
lines a b
  | abs sine > Tolerance.parallel = CrossingOnce (Vec.shift (Vec.scale t u) (from a))
  | Mm (abs h) <= Tolerance.coincident = Same
  | otherwise = Apart (Mm (abs h))
  where
    u = Carrier.direction a
    v = Carrier.direction b
    sine = Vec.cross u v
    t = Vec.cross (Vec.to (from a) (from b)) v / sine
    Mm h = Carrier.signedDistance a (from b)

-- | The intersection of a line and a circle. Two common points come in the order in which the line
-- passes them. The line touches the circle when the distance of the line from the centre equals the
-- radius, to 'Tolerance.coincident'.
lineCircle :: Line -> Circle -> Intersection
lineCircle l (Circle c (Mm r))
  | abs (abs h - r) <= tolerance = Touching foot
  | abs h > r = Apart (Mm (abs h - r))
  | otherwise = Crossing (along (-half)) (along half)
  where
    Mm h = Carrier.signedDistance l c
    Mm tolerance = Tolerance.coincident
    foot = Carrier.foot l c
    half = sqrt ((r - abs h) * (r + abs h))
    along s = Vec.shift (Vec.scale s (Carrier.direction l)) foot

-- | The intersection of two circles. The first of two common points lies to the left of the
-- direction from the first centre to the second. Concentric circles with different radii are
-- 'Apart' by the difference of the radii.
circles :: Circle -> Circle -> Intersection
circles (Circle c1 (Mm r1)) (Circle c2 (Mm r2))
  | d <= tolerance && abs (r1 - r2) <= tolerance = Same
  | d > r1 + r2 + tolerance = Apart (Mm (d - r1 - r2))
  | d < abs (r1 - r2) - tolerance || d <= tolerance = Apart (Mm (abs (r1 - r2) - d))
  | abs (d - r1 - r2) <= tolerance || abs (d - abs (r1 - r2)) <= tolerance =
    Touching (at (signum a * small) 0)
  | otherwise = Crossing (at a half) (at a (-half))
  where
    Mm tolerance = Tolerance.coincident
    Mm d = Vec.distance c1 c2
    e = Vec.unit (Vec.to c1 c2)
    -- Points are computed from the centre of the smaller circle: the larger one may be almost a
    -- line, with a distant centre.
    (origin, towards, small, large) =
      if r1 <= r2 then (c1, e, r1, r2) else (c2, Vec.scale (-1) e, r2, r1)
    -- The signed distance at which the common chord crosses the line of centres. It is measured
    -- from the smaller circle's centre, positive towards the larger circle's centre.
    a = ((d - large) * (d + large) + small * small) / (2 * d)
    half = sqrt (max 0 ((small - a) * (small + a)))
    at s h = Vec.shift (Vec.add (Vec.scale s towards) (Vec.scale h (Vec.left e))) origin
