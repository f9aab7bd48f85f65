-- | Intersections of lines and circles in closed form.
module Geometry.Construction.Intersection
  ( Intersection (..),
    lines,
    lineCircle,
    circles,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Prelude hiding (lines)

-- | How two curves lie to one another.
data Intersection
  = -- | they miss one another by this much
    Apart Mm
  | Touching Point
  | Crossing Point Point
  | CrossingOnce Point
  | -- | they are the same curve
    Same
  deriving stock (Eq, Show)

-- | Two lines. Parallel ones are apart by their distance.
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

-- | A line and a circle. The first of two points comes first along the line.
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

-- | Two circles. The first of two points lies to the left of the way from centre to centre.
-- Of concentric circles the difference of the radii is the gap.
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
    -- From the centre of the smaller circle: the other one may be as good as a line, and its centre
    -- far away.
    (from, onwards, small, large) =
      if r1 <= r2 then (c1, e, r1, r2) else (c2, Vec.scale (-1) e, r2, r1)
    -- Where the common chord meets the line of centres.
    a = ((d - large) * (d + large) + small * small) / (2 * d)
    half = sqrt (max 0 ((small - a) * (small + a)))
    at s h = Vec.shift (Vec.add (Vec.scale s onwards) (Vec.scale h (Vec.left e))) from
