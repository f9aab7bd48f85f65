-- | The tolerances of geometry: every small number with which "Geometry" compares, by name.
--
-- Tolerances for the purposes of a single stage are in its folder: "Offset.Tolerance",
-- "Part.Tolerance" and "Toolpath.Tolerance".
module Geometry.Tolerance
  ( -- * Points and numbers
    coincident,
    equal,
    reach,
    negligibleShare,

    -- * Directions
    smoothAngle,
    parallel,
    kink,

    -- * Constructions
    sameFillet,
    crossing,

    -- * Curves
    curve,
    arcLength,
    arcLengthShare,
    parameter,
    stationary,

    -- * Arc fitting
    straight,
    oneArc,
    halfTurn,
    deviationShare,
    roundingShare,
    finestStep,
  )
where

import Base.Quantity (Mm (..), Rad (..))

-- | The largest distance between points that count as one. As doubles, the coordinates of a part
-- 20 m long are exact to 4·10⁻¹² mm. The square roots of constructions lose half of the digits at
-- worst.
coincident :: Mm
coincident = Mm 1e-6

-- | The largest difference of numbers that count as equal, in the unit of the numbers: mm, radians,
-- minutes or none.
equal :: Double
equal = 1e-9

-- | The largest coordinate or radius: 1 km. A larger one is taken for a mistake of the user; it
-- would also be too large for the other tolerances.
reach :: Mm
reach = Mm 1e6

-- | The share of a segment's length below which a part of the segment is negligible.
negligibleShare :: Double
negligibleShare = 1e-9

-- | The largest angle between the directions of two elements that join smoothly.
smoothAngle :: Rad
smoothAngle = Rad 1e-7

-- | The largest sine of the angle between lines that count as parallel.
parallel :: Double
parallel = 1e-12

-- | The largest change of direction of a smooth curve at a joint of its spans. A larger one is a
-- corner.
kink :: Rad
kink = Rad 1e-3

-- | The largest distance between the centres of fillets that count as one. A fillet that touches a
-- curve at a joint of two segments is found from both.
sameFillet :: Mm
sameFillet = Mm 1e-5

-- | The largest distance between a point's feet on two curves for which the point counts as an
-- intersection of the curves.
crossing :: Mm
crossing = Mm 1e-8

-- | The largest deviation of a polyarc from the curve that it represents.
curve :: Mm
curve = Mm 1e-5

-- | The largest error of the arc length of one panel in "Geometry.Numeric.ArcLength".
arcLength :: Mm
arcLength = Mm 1e-9

-- | The share of a panel's arc length that is always accepted as its error, because the rounding
-- errors of the speed can be as large.
arcLengthShare :: Double
arcLengthShare = 1e-12

-- | The largest error of a curve's parameter, which rises by 1 from one end of a span to the other.
parameter :: Double
parameter = 1e-12

-- | The largest velocity, in mm per unit of the parameter, that counts as 0.
stationary :: Mm
stationary = Mm 1e-9

-- | The largest sweep of an arc that counts as a line. The centre of such an arc is so distant that
-- distances from it lose more digits (@c·5·10⁷·10⁻¹⁶@ for a chord c) than the sagitta amounts to
-- (@c·2.5·10⁻⁹@).
straight :: Rad
straight = Rad 2e-8

-- | The largest difference of the angles between a biarc's end tangents and its chord for which the
-- biarc is one arc.
oneArc :: Rad
oneArc = Rad 1e-9

-- | The largest sweep of an arc of a biarc: π and an allowance for rounding.
halfTurn :: Rad
halfTurn = Rad (pi + 1e-9)

-- | The share of a tolerance that is reserved where a deviation is measured at sample points, since
-- it may be larger between them.
deviationShare :: Double
deviationShare = 0.02

-- | The share of a tolerance that is reserved for rounding errors where a formula bounds the
-- deviation.
roundingShare :: Double
roundingShare = 1e-3

-- | The smallest step of arc fitting along a curve, as a share of a span's parameter interval.
finestStep :: Double
finestStep = 1e-6
