-- | Curves given by tables, pieces or chains, and their shifts (ciphers), exactly.
--
-- A curve gives its place for a parameter from 0 to the number of its spans. A shift is one more
-- layer: it moves what is below along the left normal by a distance that is itself a function of
-- the parameter. Places, directions and curvatures come from power series through all layers;
-- nothing is sampled in between, so the only error is that of doubles. Behind a corner that a shift
-- opens, the curve goes on at another place: links are left to others.
--
-- The fields of bases, rows, columns and folds are read through the modules of those types below
-- this one.
module Geometry.Curve
  ( -- * What curves are
    Curve,
    base,
    layers,
    Base,
    CurveKind (..),
    EndCondition (..),
    Knot,
    Span (..),
    CurveFault (..),

    -- * Making them
    polyline,
    spline,
    parabola,
    SpanShape (..),
    ofPieces,
    ofSegments,
    ofChain,
    Segment,

    -- * Shifting them
    Column,
    column,
    columnAt,
    rowCount,
    backwards,
    Distance (..),
    Growth (..),
    Joggle (..),
    joggled,
    ramp,
    shifted,
    Side (..),

    -- * Looking at them
    chain,
    cubics,
    domain,
    spans,
    breaks,
    at,
    tangent,
    normal,
    curvature,
    jet,
    Approach (..),
    placeFrom,
    tangentFrom,
    start,
    end,
    isClosed,
    length,
    lengthTo,
    alongTo,
    distanceOf,
    nearest,
    atX,
    corners,
    Cusp,
    fold,

    -- * Turning them
    reversed,
    transformed,
  )
where

import Base.Quantity (Mm (..), minus, times)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side (..))
import Geometry.Curve.Base (Base, CurveFault (..), CurveKind (..), EndCondition (..), Knot)
import Geometry.Curve.Base qualified as Base
import Geometry.Curve.Column (Column)
import Geometry.Curve.Column qualified as Column
import Geometry.Curve.CubicSpans qualified as CubicSpans
import Geometry.Curve.Cusp (Cusp, fold)
import Geometry.Curve.PointSearch (atX, corners, nearest)
import Geometry.Curve.PointSearch qualified as PointSearch
import Geometry.Curve.ShiftDistance (Distance (..), Growth (..), Joggle (..), ramp)
import Geometry.Curve.ShiftDistance qualified as ShiftDistance
import Geometry.Curve.ShiftedCurve (Curve (..), Layer (..), base, breaks, domain, layers, shifted)
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

-- | Straight from point to point; closed when the last is the first.
polyline :: Vector Point -> Either CurveFault Curve
polyline points = Plain <$> Base.polyline points

-- | A cubic spline by the chord length from point to point.
spline :: EndCondition -> Vector Point -> Either CurveFault Curve
spline ends points = Plain <$> Base.spline ends points

-- | Parabolas y(x) through points 1–3, 3–5, …
parabola :: Vector Point -> Either CurveFault Curve
parabola points = Plain <$> Base.parabola points

-- | Pieces one behind the other, and the parameter of every row of a table on them, rising.
ofPieces :: NonEmpty SpanShape -> Vector Double -> Either CurveFault Curve
ofPieces pieces parameters = Plain <$> Base.ofPieces pieces parameters

-- | A chain of lines and arcs; its rows are the ends of the segments.
ofSegments :: NonEmpty Segment -> Either CurveFault Curve
ofSegments segments = Plain <$> Base.ofSegments segments

-- | A chain of lines and arcs through the points of a table, in order; a closed one may leave out
-- the first point at its end.
ofChain :: NonEmpty Segment -> Vector Point -> Either CurveFault Curve
ofChain segments points = Plain <$> Base.ofChain segments parameters
  where
    -- Every point is the beginning of a segment, or the end of the last one.
    parameters =
      Vector.unfoldrN
        (Vector.length points)
        next
        (0, NonEmpty.toList segments, Vector.toList points)
    next (u, ss, ps) = case (ss, ps) of
      (s : rest, p : more)
        | Vec.near (Segment.start s) p -> u `seq` Just (u, (u, ss, more))
        | otherwise -> next (u + 1, rest, ps)
      ([], _ : _) -> Just (u, (u, [], []))
      (_, []) -> Nothing

-- | Numbers at the rows of the curve's table, as many as there are, interpolated as the points are.
column :: Curve -> Vector Double -> Column
column curve = Column.column (base curve)

-- | How many rows the curve's table has.
rowCount :: Curve -> Int
rowCount = Vector.length . Base.rows . base

-- | What a column is at a parameter.
columnAt :: Curve -> Column -> Double -> Double
columnAt curve c u =
  PowerSeries.value (Column.series 0 (base curve) c (ShiftedCurve.spot After u curve))

-- | The values at the rows of a curve in the order of its reverse.
backwards :: Curve -> Vector Double -> Vector Double
backwards curve = Base.backwards (base curve)

-- | The distance of a joggle that fits between two parameters of the curve that it is to shift.
joggled :: Joggle -> Curve -> Either CurveFault Distance
joggled joggle@Joggle {begins, ends, depth = Mm depth, radius = Mm r} curve
  | r <= 0 || abs depth >= 2 * r = Left DeepJoggle
  | needed > there = Left (LongJoggle needed there)
  | otherwise = Right (Joggled joggle)
  where
    needed = times 2 (ramp joggle)
    there = minus (lengthTo curve ends) (lengthTo curve begins)

-- | The arcs and lines of a curve that consists of them, some of them arcs, and is not shifted. Of
-- neighbours, one ends where the next begins.
chain :: Curve -> Maybe (NonEmpty Segment)
chain curve = case curve of
  Plain b -> Base.asSegments b
  Shifted {} -> Nothing

-- | Spans in x and y that stay so near to a curve, and how near; see 'Cubics.along'.
cubics :: Mm -> Curve -> Maybe (Mm, Cubics, Cubics)
cubics = CubicSpans.along

-- | How many spans there are.
spans :: Curve -> Int
spans curve = Base.count (base curve)

-- | The place with a parameter; beyond the ends, the end.
at :: Curve -> Double -> Point
at = placeFrom After

-- | The place that the curve comes to before a parameter, or goes on from behind it: they differ
-- where a shift has opened a corner.
placeFrom :: Approach -> Curve -> Double -> Point
placeFrom approach curve u = TaylorExpansion.place (jet approach 0 curve u)

-- | The direction, of length 1, at the place that 'at' gives.
tangent :: Curve -> Double -> Vec
tangent = PointSearch.heading After

-- | The direction before or behind a parameter. On a closed curve the way goes on over the joint.
tangentFrom :: Approach -> Curve -> Double -> Vec
tangentFrom = PointSearch.directionAt

-- | The left normal, of length 1.
normal :: Curve -> Double -> Vec
normal curve u = Vec.left (tangent curve u)

-- | In 1/mm, positive where the curve bends to the left.
curvature :: Curve -> Double -> Double
curvature curve u = TaylorExpansion.curvature (jet After 2 curve u)

-- | The power series of the place up to an order.
jet :: Approach -> Int -> Curve -> Double -> TaylorExpansion
jet approach n curve u = ShiftedCurve.jetAt n curve (ShiftedCurve.spot approach u curve)

start :: Curve -> Point
start curve = placeFrom After curve 0

end :: Curve -> Point
end curve = placeFrom Before curve (domain curve)

-- | Whether the curve ends where it begins.
isClosed :: Curve -> Bool
isClosed = PointSearch.closed

-- | The true length; what a shift opens at corners is no part of it.
length :: Curve -> Mm
length curve = ArcLength.total (ShiftedCurve.ruler curve)

-- | The true length up to a parameter.
lengthTo :: Curve -> Double -> Mm
lengthTo curve = ArcLength.lengthTo (ShiftedCurve.ruler curve)

-- | The parameter up to which the curve has a length.
alongTo :: Curve -> Mm -> Double
alongTo curve = ArcLength.parameterAt (ShiftedCurve.ruler curve)

-- | How far to the left the outermost shift moves the place with a parameter; nothing without a
-- shift.
distanceOf :: Curve -> Double -> Mm
distanceOf curve u = case curve of
  Plain _ -> Mm 0
  Shifted layer lower _ ->
    let s = ShiftedCurve.spot After u curve
     in Mm
          ( PowerSeries.value
              (ShiftedCurve.distanceAt 0 layer lower (ShiftedCurve.jetAt 1 lower s) s)
          )

-- | The same curve walked from its end.
reversed :: Curve -> Curve
reversed curve = case curve of
  Plain b -> Plain (Base.reversed b)
  Shifted layer lower _ ->
    let lower' = reversed lower
     in shifted
          (otherSide (side layer))
          (ShiftDistance.reversed (base lower) (base lower') (distance layer))
          lower'

-- | The curve moved, turned, scaled, mirrored: distances grow with it and change sides in a mirror.
transformed :: Transformation -> Curve -> Curve
transformed s curve = case curve of
  Plain b -> Plain (Base.transformed s b)
  Shifted layer lower _ ->
    let lower' = transformed s lower
        side' = if Transformation.mirrors s then otherSide (side layer) else side layer
     in shifted side' (ShiftDistance.scaled (base lower') (factor s) (distance layer)) lower'

-- | How much longer everything becomes.
factor :: Transformation -> Double
factor s =
  let Mm k =
        Vec.distance
          (Transformation.point s (Vec.point 0 0))
          (Transformation.point s (Vec.point far 0))
   in k / far
  where
    -- So far that the rounding of large displacements does not tell.
    far = 1024

otherSide :: Side -> Side
otherSide s = case s of
  LeftOf -> RightOf
  RightOf -> LeftOf
