-- | The tolerances of offsets.
module Offset.Tolerance
  ( clearance,
    ignoredSlot,
    smallestRest,
    resolution,
    rounding,
    tangential,
  )
where

import Base.Quantity (Mm (..))

-- | The amount by which rounding may bring the cutter's centre closer to the part than the cutter's
-- radius. It is larger than the gap between two offsets of 50 mm, a large cutter's radius, whose
-- elements join at an angle of 'Geometry.Tolerance.smoothAngle'.
clearance :: Mm
clearance = Mm 1e-5

-- | Slots as wide as the cutter are ignored when the cutter's path in and out of them, twice their
-- length, is no longer than this.
ignoredSlot :: Mm
ignoredSlot = Mm 0.01

-- | A corner that turns towards the cutter is no obstacle when the gap between its vertex and the
-- cutter's edge is no larger than this.
smallestRest :: Mm
smallestRest = Mm 1e-5

-- | The interval at which a bisection for the largest cutter or the largest excess ends.
resolution :: Mm
resolution = Mm 1e-6

-- | The rounding error of a point that the offset kernel computes, as a share of the largest
-- coordinate: about fifty units in the last place.
rounding :: Double
rounding = 1e-14

-- | The sine of the largest angle between two directions that the offset kernel treats as equal.
-- Offset points move by no more than this share of the distance.
tangential :: Double
tangential = 1e-9
