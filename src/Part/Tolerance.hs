-- | The tolerances of parts: of links between elements, choices between solutions, and bevels.
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

-- | The largest difference of the lengths of two contours that makes the choice of the shorter one
-- a tie.
sameLength :: Mm
sameLength = Mm 1e-6

-- | The smallest radius of a fillet. One that would have to be smaller does not fit.
smallestFillet :: Mm
smallestFillet = Mm 1e-3

-- | The largest difference of the distances of two points from a third that makes the choice of the
-- nearer one a tie. Points on curves are exact to 'Geometry.Tolerance.curve' at best.
nearTie :: Mm
nearTie = Mm 1e-4

-- | The largest error of a bevel that is interpolated linearly between two points.
bevel :: Rad
bevel = Rad 5e-5

-- | The largest gap between the ends of curves of measured points that join smoothly.
smoothGap :: Mm
smoothGap = Mm 1e-3

-- | The largest angle between the directions of curves of measured points that join smoothly: 0.1°.
smoothTurn :: Rad
smoothTurn = Rad 1.75e-3
