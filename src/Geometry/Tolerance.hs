-- | Every small number that the geometry compares with, by name.
module Geometry.Tolerance
  ( coincident,
    smoothAngle,
    parallel,
    clearance,
    sameLength,
    smallestFillet,
    equal,
    resolution,
    curve,
    reach,
  )
where

import Base.Quantity (Mm (..), Rad (..))

-- | Points no further apart are one point. A part 20 m long is held in doubles to 4·10⁻¹² mm;
-- the square roots of the constructions cost half of the digits at worst.
coincident :: Mm
coincident = Mm 1e-6

-- | Two elements whose directions differ by no more go over into one another smoothly.
smoothAngle :: Rad
smoothAngle = Rad 1e-7

-- | Two lines whose directions have no larger sine between them are parallel.
parallel :: Double
parallel = 1e-12

-- | How much nearer than its radius the cutter's centre may come to the part by rounding of doubles.
-- It is above what 'smoothAngle' opens at the radius of a large cutter (50 mm).
clearance :: Mm
clearance = Mm 1e-5

-- | Two contours whose lengths differ by no more are equally long: the choice between them is a tie.
sameLength :: Mm
sameLength = Mm 1e-6

-- | A fillet that has to be smaller than this does not fit.
smallestFillet :: Mm
smallestFillet = Mm 1e-3

-- | Numbers of a program that differ by no more are equal, in the units in which they are held (mm, radians,
-- minutes, none).
equal :: Double
equal = 1e-9

-- | Coordinates and radii up to 1 km; anything more is a slip of the pen, and beyond what the other
-- tolerances are meant for.
reach :: Mm
reach = Mm 1e6

-- | How finely a largest cutter or a largest excess is determined.
resolution :: Mm
resolution = Mm 1e-6

-- | A curve is replaced by arcs that stay so near to it.
curve :: Mm
curve = Mm 1e-5
