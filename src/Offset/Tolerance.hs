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

-- | The largest amount by which rounding may bring the cutter's centre closer to the part than the
-- cutter's radius. It is above the gap that 'Geometry.Tolerance.smoothAngle' opens at the radius of
-- a large cutter, 50 mm.
clearance :: Mm
clearance = Mm 1e-5

-- | Twice the length of the longest slot, as wide as the cutter, that is ignored.
ignoredSlot :: Mm
ignoredSlot = Mm 0.01

-- | The largest rest material in a corner towards the cutter that counts as no corner.
smallestRest :: Mm
smallestRest = Mm 1e-5

-- | The resolution of bisections for the largest cutter and the largest excess.
resolution :: Mm
resolution = Mm 1e-6

-- | The rounding error of a point of the offset kernel, as a share of the largest coordinate: about
-- fifty units in the last place.
rounding :: Double
rounding = 1e-14

-- | The largest sine between directions that the offset kernel takes for one. Points move by this
-- share of the offset distance.
tangential :: Double
tangential = 1e-9
