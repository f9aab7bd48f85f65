-- | Cusps of shifted curves, which are an error of the part program. Where a curve is shifted
-- towards its centre of curvature by more than the radius of curvature, the shifted curve runs
-- backwards between two cusps.
--
-- The letter d is the distance of a shift, positive to the left. The letter κ is the curvature of
-- the curve before the shift. A stretch is a part of a curve on which the curve is smooth, given by
-- its first and last parameter.
module Geometry.Curve.Cusp
  ( Cusp (..),
    firstCusp,
  )
where

import Base.Quantity (Mm (..))
import Data.List (maximumBy)
import Data.Ord (comparing)
import Geometry.Curve.PointSearch qualified as PointSearch
import Geometry.Curve.ShiftedCurve (Curve (..), Layer)
import Geometry.Curve.ShiftedCurve qualified as ShiftedCurve
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.RootFinding qualified as RootFinding
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))

-- | Cusps of a shift, described by one point between them: the point at which the ratio of the
-- distance to the radius of curvature is largest. The ratio is at least 1 there, so the shifted
-- curve runs backwards or its speed is 0.
data Cusp = Cusp
  { -- | number of the shift; the innermost one has number 1
    layer :: Int,
    -- | parameter of the point on the curve
    parameter :: Double,
    -- | point on the curve before this shift
    place :: Point,
    -- | absolute value of the shift distance at this point
    requested :: Mm,
    -- | radius of curvature, at this point, of the curve before this shift
    curvatureRadius :: Mm
  }
  deriving stock (Eq, Show)

-- | Cusp of the innermost shift that has one. Nothing if no shift has a cusp, which means that
-- @d·κ@ is below 1 everywhere. Only smooth stretches are tested, not the corners between them.
firstCusp :: Curve -> Maybe Cusp
firstCusp curve = case curve of
  Unshifted _ -> Nothing
  Shifted top lower _ -> case firstCusp lower of
    Just found -> Just found
    Nothing -> cuspOfLayer top lower curve

-- | Cusp of the outermost shift; Nothing if it has none. @top@ is this shift, @lower@ the curve
-- that it shifts, and @whole@ the shifted curve.
cuspOfLayer :: Layer -> Curve -> Curve -> Maybe Cusp
cuspOfLayer top lower whole
  | overshoot >= 1 =
    Just
      Cusp
        { layer = length (ShiftedCurve.layers whole),
          parameter,
          place = TaylorExpansion.position expansion,
          requested = Mm (abs d),
          curvatureRadius =
            Mm (if overshoot > fromIntegral (maxBound :: Int) then 0 else abs d / overshoot)
        }
  | otherwise = Nothing
  where
    (stretch, parameter, overshoot) =
      maximumBy (comparing (\(_, _, g) -> g)) (concatMap candidates (PointSearch.stretches whole))
    (expansion, distance) =
      ShiftedCurve.shiftAt 0 top lower (PointSearch.positionWithin stretch whole parameter)
    d = PowerSeries.value distance
    -- Candidates for the maximum of @d·κ@ on a stretch: the samples, the maxima between them, and
    -- the minima of the speed of @lower@, near which the curvature is large. Each has the stretch,
    -- the parameter, and the value of @d·κ@ at this parameter. The value is infinite where that
    -- speed is 0, unless d is 0 there.
    candidates s =
      [ (s, u, shareAt s u)
        | u <- PointSearch.samples whole s <> maxima s <> speedMinima top lower whole s
      ]
    shareAt s u = let (g, _) = productAt s 0 u in g
    productAt s n u =
      let (g, isMoving) =
            productSeries n top lower whole s u
       in (if isMoving then PowerSeries.value g else unlessZero g, g)
    unlessZero g = if PowerSeries.value g == 0 then 0 else 1 / 0
    maxima s =
      RootFinding.falling
        (\u -> slopes (snd (productAt s 2 u)))
        [(u, fst (slopes (snd (productAt s 1 u)))) | u <- PointSearch.samples whole s]

-- | Parameters, within a stretch of @whole@, of the local minima of the speed of @lower@. @whole@
-- is the curve that results from the shift @top@ of @lower@.
speedMinima :: Layer -> Curve -> Curve -> (Double, Double) -> [Double]
speedMinima top lower whole stretch =
  RootFinding.rising slope [(u, fst (slope u)) | u <- PointSearch.samples whole stretch]
  where
    slope u =
      let (V2 a b, _) =
            ShiftedCurve.shiftAt 2 top lower (PointSearch.positionWithin stretch whole u)
       in slopes
            ( PowerSeries.add
                (square (PowerSeries.derivative a))
                (square (PowerSeries.derivative b))
            )
    square a = PowerSeries.multiply a a

-- | First and second derivative of a power series at the parameter about which it is taken.
slopes :: PowerSeries -> (Double, Double)
slopes g = (PowerSeries.coefficient 1 g, 2 * PowerSeries.coefficient 2 g)

-- | Power series of @d·κ@ about the parameter @u@ of a stretch, up to the power @n@, and True. If
-- the speed of @lower@ is 0 at @u@, κ is not defined. In this case the result is the power series
-- of d in mm, and False. The shift @top@ of the curve @lower@ gives the curve @whole@.
productSeries :: Int -> Layer -> Curve -> Curve -> (Double, Double) -> Double -> (PowerSeries, Bool)
productSeries n top lower whole stretch u
  | Mm (Vec.norm (TaylorExpansion.velocity expansion)) > Tolerance.stationary =
    (PowerSeries.multiply d (TaylorExpansion.curvatureSeries expansion), True)
  | otherwise = (d, False)
  where
    s = PointSearch.positionWithin stretch whole u
    (expansion, d) = ShiftedCurve.shiftAt (n + 1) top lower s
