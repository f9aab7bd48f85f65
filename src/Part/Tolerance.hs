-- | The tolerances for evaluating a part: for links between elements, for choices between
-- solutions, and for bevels.
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

-- | Two contours whose lengths differ by at most this are equally long: the choice of the shorter
-- one is a tie.
sameLength :: Mm
sameLength = Mm 1e-6

-- | The smallest radius that is suggested for a fillet that does not fit.
smallestFillet :: Mm
smallestFillet = Mm 1e-3

-- | Two points whose distances from a third point differ by at most this are equally near: the
-- choice of the nearer one is a tie. Points on curves have errors up to 'Geometry.Tolerance.curve'.
nearTie :: Mm
nearTie = Mm 1e-4

-- | The largest error of linear interpolation between two bevels of an element.
bevel :: Rad
bevel = Rad 5e-5

-- | The largest gap at a smooth link. The link may join curves through measured points.
smoothGap :: Mm
smoothGap = Mm 1e-3

-- | The largest angle between the directions at a smooth link, 0.1°. The link may join curves
-- through measured points.
smoothTurn :: Rad
smoothTurn = Rad 1.75e-3
