-- | Cusps of shifted curves. A shift towards the centre of curvature is limited by the radius of
-- curvature. Beyond it, the shifted curve runs backwards between two cusps.
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

-- | Point of the largest overshoot in the innermost shift that does not fit.
data Cusp = Cusp
  { -- | number of the shift, counted from 1 at the innermost
    layer :: Int,
    parameter :: Double,
    -- | point on the curve that is shifted
    place :: Point,
    -- | absolute value of the requested distance at this point
    requested :: Mm,
    -- | radius of curvature at this point
    curvatureRadius :: Mm
  }
  deriving stock (Eq, Show)

-- | Finds the cusp of a curve. Nothing if every shift d to the left satisfies @1 − d·κ > 0@. Only
-- smooth stretches are tested, not the corners between them.
firstCusp :: Curve -> Maybe Cusp
firstCusp curve = case curve of
  Plain _ -> Nothing
  Shifted top lower _ -> case firstCusp lower of
    Just found -> Just found
    Nothing -> cuspOfLayer top lower curve

-- | Cusp of the outermost shift alone: the layer, the curve below it, and the whole curve.
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
    expansion =
      ShiftedCurve.expansionAt 1 lower (PointSearch.positionWithin stretch whole parameter)
    d =
      PowerSeries.value
        ( ShiftedCurve.distanceAt
            0
            top
            lower
            expansion
            (PointSearch.positionWithin stretch whole parameter)
        )
    -- Candidates for the maximum: the samples, maxima between them, and local minima of the speed,
    -- where the curve bends most.
    candidates s =
      [ (s, u, shareAt s u)
        | u <- PointSearch.samples s <> maxima s <> speedMinima lower whole s
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
        [(u, fst (slopes (snd (productAt s 1 u)))) | u <- PointSearch.samples s]

-- | Parameters of the local minima of a curve's speed within a stretch of its shift.
speedMinima :: Curve -> Curve -> (Double, Double) -> [Double]
speedMinima lower whole stretch =
  RootFinding.rising slope [(u, fst (slope u)) | u <- PointSearch.samples stretch]
  where
    slope u =
      let V2 a b =
            ShiftedCurve.expansionAt 3 lower (PointSearch.positionWithin stretch whole u)
       in slopes
            ( PowerSeries.add
                (square (PowerSeries.derivative a))
                (square (PowerSeries.derivative b))
            )
    square a = PowerSeries.multiply a a

-- | First and second derivative of a power series.
slopes :: PowerSeries -> (Double, Double)
slopes g = (PowerSeries.coefficient 1 g, 2 * PowerSeries.coefficient 2 g)

-- | Power series of @d·κ@ about a parameter, up to the given order, and True; or, where the curve
-- that is shifted has no speed, the series of d alone, and False.
productSeries :: Int -> Layer -> Curve -> Curve -> (Double, Double) -> Double -> (PowerSeries, Bool)
productSeries n top lower whole stretch u
  | Mm (Vec.norm (TaylorExpansion.velocity expansion)) > Tolerance.stationary =
    (PowerSeries.multiply d (TaylorExpansion.curvatureSeries expansion), True)
  | otherwise = (d, False)
  where
    s = PointSearch.positionWithin stretch whole u
    expansion = ShiftedCurve.expansionAt (n + 2) lower s
    d = ShiftedCurve.distanceAt n top lower expansion s
