-- | The tolerances of evaluation: for links between elements, for choices among several solutions,
-- and for bevels.
module Part.Tolerance
  ( sameLength,
    smallestFillet,
    nearTie,
    bevel,
    smoothGap,
    smoothTurn,
  )
where

import Base.Quantity (Mm (..), Rad (..))

-- | Two contours are equally long if their lengths differ by at most this. The shorter of two
-- contours has to be chosen, so two equally long ones are a fault.
sameLength :: Mm
sameLength = Mm 1e-6

-- | The smallest fillet radius that a report suggests in place of one that does not fit.
smallestFillet :: Mm
smallestFillet = Mm 1e-3

-- | Two points are equally near to a third one if their distances from it differ by at most this.
-- The nearer of two points has to be chosen, so two equally near ones are a fault. Points on curves
-- have errors of up to 'Geometry.Tolerance.curve'.
nearTie :: Mm
nearTie = Mm 1e-4

-- | The largest error of linear interpolation between the bevels of two points of an element.
bevel :: Rad
bevel = Rad 5e-5

-- | The largest gap between the elements of a smooth link. They may be curves through measured
-- points, which do not meet exactly.
smoothGap :: Mm
smoothGap = Mm 1e-3

-- | The largest angle between the elements of a smooth link, 0.1°. They may be curves through
-- measured points, whose directions differ a little.
smoothTurn :: Rad
smoothTurn = Rad 1.75e-3
