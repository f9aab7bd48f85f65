-- | The tolerances of offsets.
module Offset.Tolerance
  ( clearance,
    ignoredSlot,
    smallestRest,
    thinnestRest,
    reachedCentre,
    shortestPath,
    resolution,
    rounding,
    tangential,
    smallestDisc,
    finestShare,
    crossingShare,
  )
where

import Base.Quantity (Mm (..))

-- | The amount in mm by which rounding may bring the cutter's centre closer to the part than the
-- cutter's radius. Two elements that join at an angle of 'Geometry.Tolerance.smoothAngle' have
-- offsets with a gap between them, which grows with the radius. The amount is chosen so that it
-- exceeds this gap for every cutter with a radius of up to 50 mm.
clearance :: Mm
clearance = Mm 1e-5

-- | The limit in mm up to which slots exactly as wide as the cutter are ignored. It applies to the
-- total length of the paths in all such slots. A path goes into a slot and out again, so it is
-- twice as long as the slot.
ignoredSlot :: Mm
ignoredSlot = Mm 0.01

-- | The largest gap in mm between the vertex of an inner corner and the cutter's edge that does not
-- count as rest material: the cutter then counts as reaching the corner.
smallestRest :: Mm
smallestRest = Mm 1e-5

-- | The thickness in mm up to which a layer that a larger cutter has left is not cleared by an
-- operation that clears its rest.
thinnestRest :: Mm
thinnestRest = Mm 0.01

-- | The largest distance in mm between the path and the centre of an arc as large as the cutter, at
-- which the cutter counts as reaching the arc. The material left in the arc is not thicker.
reachedCentre :: Mm
reachedCentre = Mm 1e-3

-- | The length in mm of the shortest path beside an open contour. A shorter one touches the contour
-- in a point only, such as the tip of a crevice.
shortestPath :: Mm
shortestPath = Mm 1e-3

-- | The length in mm of the interval at which a bisection ends. The bisections look for the largest
-- cutter radius that fits, or for the largest excess material.
resolution :: Mm
resolution = Mm 1e-6

-- | The rounding error of a point that the offset kernel computes, as a fraction of the largest
-- coordinate: about fifty units in the last place.
rounding :: Double
rounding = 1e-14

-- | The sine of the largest angle between two directions that the offset kernel treats as equal.
-- This moves offset points by at most the product of the sine and the offset's distance.
tangential :: Double
tangential = 1e-9

-- | The radius in mm of the smallest disc that touches the boundary of an area at two points.
-- Smaller ones lie in a corner.
smallestDisc :: Mm
smallestDisc = Mm 1e-9

-- | The share of an element of a boundary below which the medial axis is not divided further.
finestShare :: Double
finestShare = 1e-12

-- | The share of an element of a boundary within which the place is computed where the medial axis
-- passes from one bound of its discs to the next.
crossingShare :: Double
crossingShare = 1e-8
