-- | Numbers beside the points of a table, one for every row, interpolated in the same way and on
-- the same parameter as the points: straight between the rows of a polyline, by parabolas where the
-- points are, by splines where they are.
--
-- On pieces that are put together the numbers are a spline by the true length along them, natural
-- or, on a closed base, periodic: the parameter's speed jumps there from piece to piece.
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
import Geometry.Curve.Base (Base, CurveKind (..), SpanPoint (..))
import Geometry.Curve.Base qualified as Base
import Geometry.Curve.Spline (Boundary (..), Cubic (..), Cubics)
import Geometry.Curve.Spline qualified as Spline
import Geometry.Numeric.ArcLength qualified as ArcLength
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion

-- | Row values, in whatever unit, and what they are between the rows.
data Column = Column {values :: Vector Double, course :: Interpolation}
  deriving stock (Eq, Show)

data Interpolation
  = -- | a cubic for every span of the base
    BySpan Cubics
  | -- | the lengths along the base, in mm, where one cubic follows another, the ends included
    ByLength (Unboxed.Vector Double) Cubics
  deriving stock (Eq, Show)

-- | As many values as the base has rows.
column :: Base -> Vector Double -> Column
column base values
  | Vector.length values /= Vector.length (Base.rows base) =
    Crash.bug "a column of another length than its table"
  | otherwise = Column {values, course}
  where
    flat = Unboxed.convert values
    first = Vector.take 1 values
    -- A table that repeats its first point may give that another value the second time.
    round' = Base.unrepeated base || first == Vector.drop (Vector.length values - 1) values
    onceRound = if Base.unrepeated base then Unboxed.convert (values <> first) else flat
    course = case Base.method base of
      Polyline ->
        BySpan
          ( Spline.generate
              (Vector.length values - 1)
              (\i -> Spline.line (values Vector.! i) (values Vector.! (i + 1)))
          )
      Spline Base.Natural -> BySpan (Spline.interpolate Natural (Base.chords base) flat)
      Spline (Base.Clamped _ _) -> BySpan (Spline.interpolate Natural (Base.chords base) flat)
      Spline Base.Periodic ->
        BySpan
          (Spline.interpolate (if round' then Periodic else Natural) (Base.chords base) onceRound)
      Parabola -> BySpan (Spline.parabolas (Base.fractions base) flat)
      Joined -> byLength base values

-- | The spline by the length along the base. Of two values and more; a single one is the same
-- everywhere.
byLength :: Base -> Vector Double -> Interpolation
byLength base values = case Vector.toList values of
  [] -> BySpan (Spline.generate (Base.count base) (const (Cubic 0 0 0 0)))
  [v] -> BySpan (Spline.generate (Base.count base) (const (Cubic v 0 0 0)))
  v : _
    | Base.unrepeated base ->
      spline
        (if Vector.length values >= 3 then Periodic else Natural)
        (Unboxed.snoc stations whole)
        (Vector.snoc values v)
    | Base.closed base && aroundOnce && Vector.length values >= 4 -> spline Periodic stations values
    | otherwise -> spline Natural stations values
  where
    Mm whole = ArcLength.total (Base.ruler base)
    stations =
      Unboxed.convert
        ( Vector.map
            (\row -> let Mm s = ArcLength.lengthTo (Base.ruler base) (Base.at row) in s)
            (Base.rows base)
        )
    aroundOnce =
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

-- | The power series of the value up to an order.
series :: Int -> Base -> Column -> SpanPoint -> PowerSeries
series n base c spot = case course c of
  BySpan cubics -> Spline.series n (Spline.at cubics (number spot)) (local spot)
  ByLength stations cubics
    | here < Unboxed.head stations -> PowerSeries.polynomial (tangentAt 0) fraction
    | here > Unboxed.last stations -> PowerSeries.polynomial (tangentAt 1) fraction
    | otherwise -> PowerSeries.polynomial (Spline.coefficients (Spline.at cubics i)) fraction
    where
      -- Before the first row and behind the last the column goes on straight.
      tangentAt t =
        let ahead = Spline.series 1 (Spline.at cubics i) t
            rise = PowerSeries.coefficient 1 ahead
         in [PowerSeries.value ahead - rise * t, rise]
      Mm here = ArcLength.lengthTo (Base.ruler base) (parameter spot)
      i = stretchAt here stations
      from = stations Unboxed.! i
      width = stations Unboxed.! (i + 1) - from
      run = case n of
        0 -> PowerSeries.constant 0 here
        _ -> PowerSeries.integral here (TaylorExpansion.speed (Base.jet n base spot))
      fraction = PowerSeries.scale (1 / width) (PowerSeries.plusConstant (-from) run)

-- | The parameters of the base at which one cubic follows another, in rising order, but for the
-- ends of its spans.
knots :: Base -> Column -> [Double]
knots base c = case course c of
  BySpan _ -> []
  ByLength _ _ -> map Base.at (Vector.toList (Base.rows base))

-- | The number of the stretch between two of these lengths that a length belongs to, or the outer
-- one on its side.
stretchAt :: Double -> Unboxed.Vector Double -> Int
stretchAt s stations = BinarySearch.lastBelow (Unboxed.length stations - 1) s stations

-- | The values times a factor, on a base that may be another.
scaled :: Base -> Double -> Column -> Column
scaled base k c = column base (Vector.map (k *) (values c))

-- | The column of a reversed base, given the base that it was on and the new one.
reversed :: Base -> Base -> Column -> Column
reversed old new c = column new (Base.backwards old (values c))
