-- | The tolerances of geometry, by name: small numbers with which the modules of the folder
-- @Geometry@ and later stages compare.
--
-- Tolerances for the purposes of a single stage are in the folder of that stage:
-- "Offset.Tolerance", "Part.Tolerance" and "Toolpath.Tolerance".
--
-- A span is one of the consecutive parts of a curve, on which one formula gives its points. A biarc
-- consists of two arcs that join with a common tangent.
module Geometry.Tolerance
  ( -- * Points and numbers
    coincident,
    sameCopy,
    equal,
    reach,
    negligibleShare,

    -- * Directions
    smoothAngle,
    parallel,
    kink,
    joinedCorner,
    cuspAngle,
    cuspDepth,

    -- * Constructions
    sameFillet,
    crossing,

    -- * Curves
    curve,
    arcLength,
    arcLengthShare,
    parameter,
    sameParameter,
    stationary,
    knotShare,
    largestDegree,
    weightRatio,

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

-- | The largest distance between points that count as one. Rounding changes a coordinate by much
-- less: at most 4·10⁻¹² mm in a part 20 m long. But constructions take square roots, and these can
-- lose half of the digits.
coincident :: Mm
coincident = Mm 1e-6

-- | The resolution at which contours are compared that may be translated copies of each other.
-- Sweeps of arcs are compared at as many radians. Rounding changes a coordinate by much less, but
-- for centres of very flat arcs; contours with such arcs are then no copies.
sameCopy :: Mm
sameCopy = Mm 1e-8

-- | The largest difference of numbers that count as equal, in the unit of the numbers: mm, radians,
-- minutes or none.
equal :: Double
equal = 1e-9

-- | The largest coordinate or radius: 1 km. A larger one is taken for a mistake of the user; its
-- rounding errors would also be too large for the other tolerances.
reach :: Mm
reach = Mm 1e6

-- | A part of a segment is negligible when its length, as a share of the whole segment's length, is
-- below this value.
negligibleShare :: Double
negligibleShare = 1e-9

-- | The largest angle between the directions of two elements that join smoothly.
smoothAngle :: Rad
smoothAngle = Rad 1e-7

-- | The largest sine of the angle between lines that count as parallel. Also the largest length, in
-- the unit of the vector, of a vector that counts as having no direction.
parallel :: Double
parallel = 1e-12

-- | The largest change of direction at a point where two spans of a curve join smoothly. A larger
-- one is a corner.
kink :: Rad
kink = Rad 1e-3

-- | The largest change of direction at a corner that one shift of a curve has made and at which the
-- next shift joins both sides. A distance that changes by 1 mm over 1 mm makes such a corner. On a
-- larger one, the sides would have to be continued too far.
joinedCorner :: Rad
joinedCorner = Rad (pi / 4)

-- | The largest angle between the two elements at a cusp. Where it is so small, rounding of the
-- vertex and the curvature of the elements may give it either sign, so the sign does not show on
-- which side the contour turns back.
cuspAngle :: Rad
cuspAngle = Rad 1e-3

-- | The distance in mm from the vertex of a cusp at which both elements are compared, to find the
-- side on which the contour turns back. It is so small that both are near the vertex, and so large
-- that rounding of the vertex does not decide.
cuspDepth :: Double
cuspDepth = 0.01

-- | The largest distance between the centres of fillets that count as one. A fillet that touches a
-- curve at a joint of two segments is found twice, once from each segment.
sameFillet :: Mm
sameFillet = Mm 1e-5

-- | The largest distance between a point of one curve and a point of another at which the two
-- points count as one intersection.
crossing :: Mm
crossing = Mm 1e-8

-- | The largest deviation of a polyarc from the curve that it represents.
curve :: Mm
curve = Mm 1e-5

-- | The largest error of a curve's arc length on one panel of "Geometry.Numeric.ArcLength". A panel
-- is an interval of the curve's parameter on which one polynomial represents the speed.
arcLength :: Mm
arcLength = Mm 1e-9

-- | The share of the mean speed on a panel that is always accepted as the error of the speed,
-- because its rounding errors can be as large.
arcLengthShare :: Double
arcLengthShare = 1e-12

-- | The largest error of a curve's parameter, which rises by 1 over each span.
parameter :: Double
parameter = 1e-12

-- | The largest difference of two parameters of a curve that count as one. Where a shift stretches
-- the parameters of a curve beside a corner, rounding changes them by less.
sameParameter :: Double
sameParameter = 1e-11

-- | The largest velocity of a point of a curve, in mm per unit of the curve's parameter, that
-- counts as 0.
stationary :: Mm
stationary = Mm 1e-9

-- | The largest difference of two knots of a B-spline that count as one, as a share of the interval
-- of the parameter on which the curve is defined. Programs for design write knots with 9 digits or
-- more; a curve changes by about as small a share of its size.
knotShare :: Double
knotShare = 1e-9

-- | The largest degree of a Bézier curve or a B-spline. Programs for design use degrees up to about
-- 10; the time of an evaluation grows with the square of the degree.
largestDegree :: Int
largestDegree = 20

-- | The largest quotient of two weights of a rational curve. With a larger one the curve passes
-- nearly all of its length within so small a part of its parameter that its arc length would not
-- be exact. The weights of drawings differ by less than a factor of 10.
weightRatio :: Double
weightRatio = 1e4

-- | The largest sweep of an arc that counts as a line. The centre of such an arc is so distant that
-- the rounding error of distances from it (@c·5·10⁷·10⁻¹⁶@ for a chord c) is larger than the arc's
-- sagitta (@c·2.5·10⁻⁹@).
straight :: Rad
straight = Rad 2e-8

-- | The largest difference between the angles at the two ends of a biarc that becomes a single arc.
-- At each end the angle lies between the chord and the tangent. On a single arc both angles are
-- equal.
oneArc :: Rad
oneArc = Rad 1e-9

-- | The largest sweep of an arc in a biarc: π, and an allowance for rounding.
halfTurn :: Rad
halfTurn = Rad (pi + 1e-9)

-- | The share of a tolerance that is reserved where a deviation is measured at sample points. The
-- deviation may be larger between these points.
deviationShare :: Double
deviationShare = 0.02

-- | The share of a tolerance that is reserved for rounding errors where a formula bounds the
-- deviation.
roundingShare :: Double
roundingShare = 1e-3

-- | The smallest step of arc fitting along a curve, as a share of the parameter interval of one
-- span.
finestStep :: Double
finestStep = 1e-6
