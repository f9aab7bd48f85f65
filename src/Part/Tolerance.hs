-- | The tolerances of evaluation: for links between elements, for choices among several solutions,
-- and for bevels.
module Part.Tolerance
  ( sameLength,
    smallestFillet,
    nearTie,
    bevel,
    smoothGap,
    smoothTurn,
    shape,
    joint,
    floorRoom,
  )
where

import Base.Quantity (Mm (..), Rad (..))

-- | The largest difference between the lengths of two solutions of a contour that count as equally
-- long. If the links of a contour have several solutions, the shortest one is chosen. Two equally
-- long shortest solutions are a fault.
sameLength :: Mm
sameLength = Mm 1e-6

-- | The smallest fillet radius that a report suggests in place of one that does not fit.
smallestFillet :: Mm
smallestFillet = Mm 1e-3

-- | The largest difference between the distances of two answers from a point that count as equally
-- near to the point. If the nearest answer has to be chosen, two equally near ones are a fault. The
-- tolerance allows for points on curves, which have errors of up to 'Geometry.Tolerance.curve'.
nearTie :: Mm
nearTie = Mm 1e-4

-- | The largest error of a bevel that is interpolated linearly between two points of an element.
bevel :: Rad
bevel = Rad 5e-5

-- | The largest gap between the two elements of a smooth link. The elements may be curves through
-- measured points, and such curves do not meet exactly.
smoothGap :: Mm
smoothGap = Mm 1e-3

-- | The largest angle between the directions of the two elements of a smooth link, 0.1°. Curves
-- through measured points do not meet with exactly the same direction.
smoothTurn :: Rad
smoothTurn = Rad 1.75e-3

-- | The largest distance of the arcs of an ellipse or of an involute from the exact curve.
shape :: Mm
shape = Mm 1e-6

-- | The largest distance between two lines or arcs of a region that become one.
joint :: Mm
joint = Mm 1e-9

-- | The largest amount by which half the width of a floor may be below the radius of a mill that
-- fits into it. A floor exactly as wide as the mill is wide enough, whatever the rounding.
floorRoom :: Mm
floorRoom = Mm 1e-6
