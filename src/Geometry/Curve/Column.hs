-- | Columns: numbers given for every row of a curve's table and interpolated between the rows. The
-- interpolation is that of the points: linear on a polyline, by parabolas on a chain of parabolas,
-- by a spline on a spline.
--
-- The base is the unshifted curve to which the table belongs. If the spans of the base were given
-- one by one, its speed, in mm per unit of the parameter, jumps from span to span. In this case the
-- column is a cubic spline by arc length.
module Geometry.Curve.Column
  ( Column (..),
    Interpolation (..),
    column,
    knots,
    series,
    scaled,
    reversed,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Crash qualified as Crash
import Base.Quantity (Mm (..))
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Curve.BasisCurve (BasisCurve, CurveKind (..), SpanPoint (..))
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.Spline (Boundary (..), Cubic (..), Cubics)
import Geometry.Curve.Spline qualified as Spline
import Geometry.Numeric.ArcLength qualified as ArcLength
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion

-- | Row values, in any unit and one for each row, and their interpolation.
data Column = Column {values :: Vector Double, interpolation :: Interpolation}
  deriving stock (Eq, Show)

-- | Interpolation of a column between the rows.
data Interpolation
  = -- | a cubic for every span of the base, over the span's local parameter from 0 to 1
    BySpan Cubics
  | -- | the arc lengths (mm) at the rows, in ascending order; and a cubic for each interval between
    -- neighbouring rows, over a local parameter from 0 to 1. On a closed base whose last row does
    -- not repeat the start, the end of the base counts as another row.
    ByLength (Unboxed.Vector Double) Cubics
  deriving stock (Eq, Show)

-- | Column with one value for each row of the base. Any other count is a bug of the caller.
column :: BasisCurve -> Vector Double -> Column
column base values
  | Vector.length values /= Vector.length (BasisCurve.rows base) =
    Crash.bug "a column of another length than its table"
  | otherwise = Column {values, interpolation}
  where
    flat = Unboxed.convert values
    first = Vector.take 1 values
    -- The first point may occur again as the last row, with another value. Then the column jumps at
    -- this point and is not periodic.
    isPeriodic =
      BasisCurve.lacksRepeatedStart base || first == Vector.drop (Vector.length values - 1) values
    periodicValues =
      if BasisCurve.lacksRepeatedStart base then Unboxed.convert (values <> first) else flat
    interpolation = case BasisCurve.method base of
      Polyline ->
        BySpan
          ( Spline.generate
              (Vector.length values - 1)
              (\i -> Spline.line (values Vector.! i) (values Vector.! (i + 1)))
          )
      Spline BasisCurve.Natural -> BySpan (Spline.interpolate Natural (BasisCurve.chords base) flat)
      Spline (BasisCurve.Clamped _ _) ->
        BySpan (Spline.interpolate Natural (BasisCurve.chords base) flat)
      Spline BasisCurve.Periodic ->
        BySpan
          ( Spline.interpolate
              (if isPeriodic then Periodic else Natural)
              (BasisCurve.chords base)
              periodicValues
          )
      Parabola -> BySpan (Spline.parabolas (BasisCurve.fractions base) flat)
      Joined -> byLength base values

-- | Interpolation of the values by a spline in arc length along the base. The spline is periodic if
-- the base is closed, has a row at its start, and has at least three different rows. It is natural
-- on any other base, and if the last row repeats the start with another value. A single value gives
-- a constant; an empty vector gives 0.
byLength :: BasisCurve -> Vector Double -> Interpolation
byLength base values = case Vector.toList values of
  [] -> BySpan (Spline.generate (BasisCurve.count base) (const (Cubic 0 0 0 0)))
  [v] -> BySpan (Spline.generate (BasisCurve.count base) (const (Cubic v 0 0 0)))
  v : _
    | BasisCurve.lacksRepeatedStart base ->
      spline
        (if Vector.length values >= 3 then Periodic else Natural)
        (Unboxed.snoc stations whole)
        (Vector.snoc values v)
    | BasisCurve.closed base && isFullTurn && Vector.length values >= 4 ->
      spline Periodic stations values
    | otherwise -> spline Natural stations values
  where
    Mm whole = ArcLength.total (BasisCurve.arcLength base)
    stations =
      Unboxed.convert
        ( Vector.map
            ( \row ->
                let Mm s =
                      ArcLength.lengthAt (BasisCurve.arcLength base) (BasisCurve.at row)
                 in s
            )
            (BasisCurve.rows base)
        )
    isFullTurn =
      Unboxed.take 1 stations == Unboxed.singleton 0
        && Unboxed.last stations == whole
        && Vector.take 1 values == Vector.drop (Vector.length values - 1) values
    spline boundary at vs =
      ByLength
        at
        ( Spline.interpolate
            boundary
            (Unboxed.zipWith (-) (Unboxed.drop 1 at) at)
            (Unboxed.fromList (Vector.toList vs))
        )

-- | Power series of the value of column @c@ about the position @spanPoint@, up to the power @n@ of
-- the parameter.
series :: Int -> BasisCurve -> Column -> SpanPoint -> PowerSeries
series n base c spanPoint = case interpolation c of
  BySpan cubics -> Spline.series n (Spline.at cubics (number spanPoint)) (local spanPoint)
  ByLength stations cubics
    | currentLength < Unboxed.head stations -> PowerSeries.polynomial (tangentAt 0) fraction
    | currentLength > Unboxed.last stations -> PowerSeries.polynomial (tangentAt 1) fraction
    | otherwise -> PowerSeries.polynomial (Spline.coefficients (Spline.at cubics i)) fraction
    where
      -- Before the first row and after the last, the column continues linearly.
      tangentAt t =
        let ahead = Spline.series 1 (Spline.at cubics i) t
            rise = PowerSeries.coefficient 1 ahead
         in [PowerSeries.value ahead - rise * t, rise]
      currentLength = BasisCurve.lengthTo base spanPoint
      i = intervalAt currentLength stations
      from = stations Unboxed.! i
      width = stations Unboxed.! (i + 1) - from
      lengthSeries = case n of
        0 -> PowerSeries.constant 0 currentLength
        _ ->
          PowerSeries.integral
            currentLength
            (TaylorExpansion.speed (BasisCurve.expansion n base spanPoint))
      fraction = PowerSeries.scale (1 / width) (PowerSeries.plusConstant (-from) lengthSeries)

-- | Parameters of the rows, in ascending order, if the column is a spline by arc length: there the
-- column changes from one cubic to the next. For any other column the list is empty, because its
-- cubics change only at the ends of the base's spans.
knots :: BasisCurve -> Column -> [Double]
knots base c = case interpolation c of
  BySpan _ -> []
  ByLength _ _ -> map BasisCurve.at (Vector.toList (BasisCurve.rows base))

-- | Index, from 0, of the interval that contains the arc length @s@ (mm). @stations@ are the arc
-- lengths at the ends of the intervals, in ascending order. A length outside of all intervals gives
-- the first or the last index.
intervalAt :: Double -> Unboxed.Vector Double -> Int
intervalAt s stations = BinarySearch.lastAtMost (Unboxed.length stations - 1) s stations

-- | Column @c@ with its values multiplied by the factor @k@, as a column of @base@, which the
-- caller has scaled already.
scaled :: BasisCurve -> Double -> Column -> Column
scaled base k c = column base (Vector.map (k *) (values c))

-- | Column @c@ of the base @old@, as a column of the reversed base @new@.
reversed :: BasisCurve -> BasisCurve -> Column -> Column
reversed old new c = column new (BasisCurve.inReverseOrder old (values c))
