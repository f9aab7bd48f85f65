-- | The tolerances of geometry: every small number with which "Geometry" compares, by name.
--
-- Tolerances of a stage that serve a purpose of its own are in that stage: "Offset.Tolerance",
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

-- | The largest distance of points that count as one. Coordinates of a part 20 m long are exact to
-- 4·10⁻¹² mm as doubles; the square roots of constructions lose half of the digits at worst.
coincident :: Mm
coincident = Mm 1e-6

-- | The largest difference of numbers that count as equal, in the units in which they are held: mm,
-- radians, minutes or none.
equal :: Double
equal = 1e-9

-- | The largest coordinate or radius: 1 km. More is a slip of the pen, and more than the other
-- tolerances are made for.
reach :: Mm
reach = Mm 1e6

-- | The share of a segment's length that is negligible.
negligibleShare :: Double
negligibleShare = 1e-9

-- | The largest angle between the directions of two elements that join smoothly.
smoothAngle :: Rad
smoothAngle = Rad 1e-7

-- | The largest sine between the directions of parallel lines.
parallel :: Double
parallel = 1e-12

-- | The largest change of direction of a smooth curve at a joint of its spans. A larger one is a
-- corner.
kink :: Rad
kink = Rad 1e-3

-- | The largest distance between the centres of fillets that count as one. Two are found where a
-- fillet touches a curve at a joint of its segments.
sameFillet :: Mm
sameFillet = Mm 1e-5

-- | The largest distance between the feet of an intersection on two curves.
crossing :: Mm
crossing = Mm 1e-8

-- | The largest deviation of the arcs that represent a curve.
curve :: Mm
curve = Mm 1e-5

-- | The largest error of the arc length of each panel, where doubles hold as many digits.
arcLength :: Mm
arcLength = Mm 1e-9

-- | The share of a panel's length below which its error is lost in the rounding of the speed.
arcLengthShare :: Double
arcLengthShare = 1e-12

-- | The largest error of a parameter; a span has a parameter interval of 1.
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

-- | The share of a tolerance that is reserved because a deviation is measured at finitely many
-- points.
deviationShare :: Double
deviationShare = 0.02

-- | The share of a tolerance that is reserved for rounding where the deviation has a bound.
roundingShare :: Double
roundingShare = 1e-3

-- | The smallest step along a curve, as a share of a span.
finestStep :: Double
finestStep = 1e-6
