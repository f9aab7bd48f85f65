-- | Planar curves given by point tables, span shapes or segments, and the shifts of such curves.
--
-- A span is a part of a curve on which one formula gives the points: an arc, a pair of cubic
-- polynomials of the parameter, one for x and one for y, or a Bézier curve of another kind. A curve
-- maps a parameter, from 0 to the count of its spans, to a point. The rows of a curve are the
-- points of the table from which it was made; each row has a parameter.
--
-- A shift adds a layer: it moves every point of the curve below along its normal, by a distance
-- that is a function of the parameter. Points, directions and curvatures are computed by power
-- series through all layers, so rounding is the only error. A shift of a curve with a corner leaves
-- a gap or an overlap at the corner. Only slight corners are closed, see
-- "Geometry.Curve.ShiftedCurve"; "Part.Piece" refuses a shift at any other corner.
--
-- This module is the interface of the folder "Geometry.Curve". It does not export the fields of
-- 'BasisCurve', 'Knot', 'Column' and 'Cusp'; these are read through the modules of the types.
module Geometry.Curve
  ( -- * Types
    Curve,
    base,
    layers,
    BasisCurve,
    CurveKind (..),
    EndCondition (..),
    Knot,
    Span (..),
    CurveFault (..),

    -- * Construction
    polyline,
    spline,
    parabola,
    SpanShape (..),
    fromShapes,
    fromSegments,
    fromSegmentsAt,
    Segment,
    Weights,
    WeightFault (..),
    weightsFor,
    bezier,
    KnotVector,
    KnotFault (..),
    knotVector,
    bspline,
    ellipse,

    -- * Shifts
    Column,
    column,
    columnAt,
    rowCount,
    inReverseOrder,
    Distance (..),
    Growth (..),
    Joggle (..),
    fitJoggle,
    ramp,
    shifted,
    unshifted,
    Side (..),

    -- * Evaluation and measurement
    toSegments,
    cubics,
    domain,
    spans,
    breaks,
    at,
    tangent,
    normal,
    curvature,
    expansion,
    Approach (..),
    pointFrom,
    tangentFrom,
    start,
    end,
    isClosed,
    length,
    lengthAt,
    parameterAtLength,
    shiftDistance,
    nearest,
    atX,
    corners,
    joinedCorners,
    Cusp,
    firstCusp,

    -- * Reversal and transformation
    reversed,
    transformed,
  )
where

import Base.Quantity (Mm (..), Rad, minus, times)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Curve.BasisCurve
  ( BasisCurve,
    CurveFault (..),
    CurveKind (..),
    EndCondition (..),
    Knot,
  )
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.Bezier (WeightFault (..), Weights, weightsFor)
import Geometry.Curve.Bezier qualified as Bezier
import Geometry.Curve.Column (Column)
import Geometry.Curve.Column qualified as Column
import Geometry.Curve.CubicSpans qualified as CubicSpans
import Geometry.Curve.Cusp (Cusp, firstCusp)
import Geometry.Curve.KnotVector (KnotFault (..), KnotVector, knotVector)
import Geometry.Curve.KnotVector qualified as KnotVector
import Geometry.Curve.PointSearch (atX, corners, nearest)
import Geometry.Curve.PointSearch qualified as PointSearch
import Geometry.Curve.ShiftDistance (Distance (..), Growth (..), Joggle (..), ramp)
import Geometry.Curve.ShiftDistance qualified as ShiftDistance
import Geometry.Curve.ShiftedCurve
  ( Curve (..),
    Layer (..),
    base,
    breaks,
    domain,
    joinedCorners,
    layers,
    shifted,
  )
import Geometry.Curve.ShiftedCurve qualified as ShiftedCurve
import Geometry.Curve.Span (Span (..), SpanShape (..))
import Geometry.Curve.Spline (Cubics)
import Geometry.Numeric.ArcLength qualified as ArcLength
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (Approach (..), TaylorExpansion)
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Prelude hiding (length)

-- | Polyline through the points. It is closed when the last point equals the first. It is a fault
-- if there are fewer than two points or if two neighbours coincide.
polyline :: Vector Point -> Either CurveFault Curve
polyline points = Unshifted <$> BasisCurve.polyline points

-- | Cubic spline through the points. Its first and second derivatives with respect to the
-- accumulated chord length, the sum of the distances between consecutive points, are continuous.
spline :: EndCondition -> Vector Point -> Either CurveFault Curve
spline ends points = Unshifted <$> BasisCurve.spline ends points

-- | Chain of parabolas @y(x)@: the first through points 1 to 3, the next through points 3 to 5, and
-- so on. The count of points is odd. Over all points, x must rise throughout or fall throughout.
parabola :: Vector Point -> Either CurveFault Curve
parabola points = Unshifted <$> BasisCurve.parabola points

-- | Curve of consecutive spans with the given shapes. @parameters@ are the parameters of the
-- curve's rows, in ascending order.
fromShapes :: NonEmpty SpanShape -> Vector Double -> Either CurveFault Curve
fromShapes shapes parameters = Unshifted <$> BasisCurve.fromShapes shapes parameters

-- | Curve of consecutive lines and arcs. Its rows are the ends of the segments; a closed curve has
-- only one row for its start and end.
fromSegments :: NonEmpty Segment -> Either CurveFault Curve
fromSegments segments = Unshifted <$> BasisCurve.fromSegments segments

-- | Curve of consecutive lines and arcs whose rows are the given points, in order. Each point is an
-- end of a segment. On a closed curve the first point need not be repeated at the end.
fromSegmentsAt :: NonEmpty Segment -> Vector Point -> Either CurveFault Curve
fromSegmentsAt segments points = Unshifted <$> BasisCurve.fromSegmentsAt segments parameters
  where
    -- Finds the parameter of each row. It is that of the next segment start that coincides with the
    -- row's point. If there is none, it is the parameter of the end of the last segment.
    parameters =
      Vector.unfoldrN
        (Vector.length points)
        next
        (0, NonEmpty.toList segments, Vector.toList points)
    next (u, ss, ps) = case (ss, ps) of
      (s : rest, p : more)
        | Vec.isNear (Segment.start s) p -> u `seq` Just (u, (u, ss, more))
        | otherwise -> next (u + 1, rest, ps)
      ([], _ : _) -> Just (u, (u, [], []))
      (_, []) -> Nothing

-- | Bézier curve by its control points. The fault is 'NoLength' if all of them coincide.
bezier :: Vector Point -> Maybe Weights -> Either CurveFault Curve
bezier points weights
  | Vector.length points < 2 = Left (TooFew 2)
  | otherwise = Unshifted <$> BasisCurve.fromBeziers (Bezier.fromPoints points weights)

-- | B-spline by its knots and control points, of which there are as many as the knots need. Its
-- spans are Bézier curves; those without length are left out.
bspline :: KnotVector -> Vector Point -> Maybe Weights -> Either CurveFault Curve
bspline knots points weights =
  Unshifted
    <$> BasisCurve.fromBeziers
      (Bezier.fromCoordinates (KnotVector.bezierSpans knots) points weights)

-- | Part of an ellipse about a centre with two semi-axes; the first one has an angle to the x axis.
-- It goes from the first parameter angle to the last, counter-clockwise if the last is larger. The
-- fault is 'NoLength' if both are equal.
ellipse :: Point -> Mm -> Mm -> Rad -> Rad -> Rad -> Either CurveFault Curve
ellipse centre a b turn from to =
  Unshifted
    <$> BasisCurve.fromBeziers (NonEmpty.toList (Bezier.ellipse centre a b turn from to))

-- | Curve below all shifts.
unshifted :: Curve -> Curve
unshifted = Unshifted . base

-- | Column: a function of the curve's parameter that has the given values at the rows, one for each
-- row. Between the rows it is interpolated by the same method as the points; see
-- "Geometry.Curve.Column". Another count of values than 'rowCount' is a bug of the caller.
column :: Curve -> Vector Double -> Column
column curve = Column.column (base curve)

-- | Count of the curve's rows.
rowCount :: Curve -> Int
rowCount = Vector.length . BasisCurve.rows . base

-- | Value of the column @c@ of the curve at the parameter @u@, in the unit of the column's values.
columnAt :: Curve -> Column -> Double -> Double
columnAt curve c u =
  PowerSeries.value (Column.series 0 (base curve) c foot)
  where
    (foot, _) = ShiftedCurve.footing curve s
    s = ShiftedCurve.position After u curve

-- | Reorders values, one for each row of a curve: the result has the order of the rows of the
-- reversed curve.
inReverseOrder :: Curve -> Vector Double -> Vector Double
inReverseOrder curve = BasisCurve.inReverseOrder (base curve)

-- | Shift distance of a joggle on a curve. A joggle is a local step of the curve, with a ramp at
-- each end. The result is the fault 'DeepJoggle' if the joggle's radius is at most half of its
-- depth. It is 'LongJoggle' if both ramps together are longer than the curve between the parameters
-- @begins@ and @ends@.
fitJoggle :: Joggle -> Curve -> Either CurveFault Distance
fitJoggle joggle@Joggle {begins, ends, depth = Mm depth, radius = Mm r} curve
  | r <= 0 || abs depth >= 2 * r = Left DeepJoggle
  | needed > available = Left (LongJoggle needed available)
  | otherwise = Right (Joggled joggle)
  where
    needed = times 2 (ramp joggle)
    available = minus (lengthAt curve ends) (lengthAt curve begins)

-- | Segments of an unshifted curve that consists of lines and arcs only and has at least one arc.
-- Each segment starts exactly where the previous one ends. Nothing for any other curve, even for a
-- polyline: its lines are among the spans of 'cubics'.
toSegments :: Curve -> Maybe (NonEmpty Segment)
toSegments curve = case curve of
  Unshifted b -> BasisCurve.asSegments b
  Shifted {} -> Nothing

-- | Cubic spans within a tolerance of the curve: first a bound of their error in mm, then the
-- cubics for x, then those for y. An unshifted curve without arcs consists of cubic spans already,
-- so the bound is 0. Nothing for an unshifted curve with arcs, and for a shifted curve if no such
-- spans are found.
cubics :: Mm -> Curve -> Maybe (Mm, Cubics, Cubics)
cubics = CubicSpans.along

-- | Count of the curve's spans.
spans :: Curve -> Int
spans curve = BasisCurve.count (base curve)

-- | Point at a parameter. A parameter outside of the domain gives the nearer end. At a corner that
-- a shift has opened, it is the point after the gap.
at :: Curve -> Double -> Point
at = pointFrom After

-- | Point at the parameter @u@, as the limit from smaller or from larger parameters. The two limits
-- differ where a shift has opened a corner.
pointFrom :: Approach -> Curve -> Double -> Point
pointFrom approach curve u = TaylorExpansion.position (expansion approach 0 curve u)

-- | Direction of travel, of length 1, at the point that 'at' gives for a parameter.
tangent :: Curve -> Double -> Vec
tangent = PointSearch.unitTangent After

-- | Direction of travel, of length 1, just before or just after a parameter. On a closed curve, the
-- tangent before the start is that at the end, and the tangent after the end is that at the start.
tangentFrom :: Approach -> Curve -> Double -> Vec
tangentFrom = PointSearch.unitTangentAcrossSeam

-- | Normal, of length 1, to the left of the direction of travel at the parameter @u@.
normal :: Curve -> Double -> Vec
normal curve u = Vec.left (tangent curve u)

-- | Curvature at the parameter @u@ in 1/mm, positive where the curve bends to the left.
curvature :: Curve -> Double -> Double
curvature curve u = TaylorExpansion.curvature (expansion After 2 curve u)

-- | Taylor expansion of the curve's point about the parameter @u@, up to the order @n@. At a joint
-- of two spans it is that of the span before or after the joint, as @approach@ says.
expansion :: Approach -> Int -> Curve -> Double -> TaylorExpansion
expansion approach n curve u =
  ShiftedCurve.expansionAt n curve (ShiftedCurve.position approach u curve)

-- | First point of the curve.
start :: Curve -> Point
start curve = pointFrom After curve 0

-- | Last point of the curve.
end :: Curve -> Point
end curve = pointFrom Before curve (domain curve)

-- | True if the curve ends where it begins.
isClosed :: Curve -> Bool
isClosed = PointSearch.isClosed

-- | Arc length of the whole curve. Gaps that a shift opens at corners do not add to it.
length :: Curve -> Mm
length curve = ArcLength.total (ShiftedCurve.arcLength curve)

-- | Arc length from the start of the curve to a parameter.
lengthAt :: Curve -> Double -> Mm
lengthAt curve = ArcLength.lengthAt (ShiftedCurve.arcLength curve)

-- | Parameter of the point at a given arc length from the start; the inverse of 'lengthAt'.
parameterAtLength :: Curve -> Mm -> Double
parameterAtLength curve = ArcLength.parameterAt (ShiftedCurve.arcLength curve)

-- | Distance by which the outermost shift moves the point at the parameter @u@, positive to the
-- left; 0 for a curve without shifts.
shiftDistance :: Curve -> Double -> Mm
shiftDistance curve u = case curve of
  Unshifted _ -> Mm 0
  Shifted layer lower _ ->
    let (_, d) = ShiftedCurve.shiftAt 0 layer lower (ShiftedCurve.position After u curve)
     in Mm (PowerSeries.value d)

-- | Curve in the opposite direction.
reversed :: Curve -> Curve
reversed curve = case curve of
  Unshifted b -> Unshifted (BasisCurve.reversed b)
  Shifted layer lower _ ->
    let lower' = reversed lower
     in shifted
          (Carrier.oppositeSide (side layer))
          (ShiftDistance.reversed (base lower) (base lower') (distance layer))
          lower'

-- | Image of a curve under a similarity. Shift distances are scaled with the curve. A reflection
-- exchanges the sides of the shifts.
transformed :: Transformation -> Curve -> Curve
transformed s curve = case curve of
  Unshifted b -> Unshifted (BasisCurve.transformed s b)
  Shifted layer lower _ ->
    let lower' = transformed s lower
        side' = if Transformation.mirrors s then Carrier.oppositeSide (side layer) else side layer
     in shifted side' (ShiftDistance.scaled (base lower') (factor s) (distance layer)) lower'

-- | Scale factor of a similarity, above 0.
factor :: Transformation -> Double
factor s =
  let Mm k =
        Vec.distance
          (Transformation.point s (Vec.point 0 0))
          (Transformation.point s (Vec.point reach 0))
   in k / reach
  where
    -- The distance in mm of the two points that are transformed. It is long, so that the rounding
    -- of large coordinates has little effect on the ratio.
    reach = 1024
