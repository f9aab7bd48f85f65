-- | Where a shift does not fit: towards the centre of curvature a curve can be shifted by its
-- radius at most; beyond that the outcome runs backwards between two cusps.
module Geometry.Curve.Cusp
  ( Cusp (..),
    fold,
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

-- | The tightest place of the innermost shift that does not fit.
data Cusp = Cusp
  { -- | which shift, from 1, the innermost first
    layer :: Int,
    parameter :: Double,
    -- | on the curve that is shifted
    place :: Point,
    -- | the distance there, above zero
    asked :: Mm,
    -- | the radius of curvature there
    largest :: Mm
  }
  deriving stock (Eq, Show)

-- | Nothing when every shift stays within the radius of curvature: @1 − d·κ > 0@ with d to the
-- left. Corners are not looked at, only the smooth stretches between them.
fold :: Curve -> Maybe Cusp
fold curve = case curve of
  Plain _ -> Nothing
  Shifted top lower _ -> case fold lower of
    Just found -> Just found
    Nothing -> folded top lower curve

folded :: Layer -> Curve -> Curve -> Maybe Cusp
folded top lower whole
  | tight >= 1 =
    Just
      Cusp
        { layer = length (ShiftedCurve.layers whole),
          parameter,
          place = TaylorExpansion.place near,
          asked = Mm (abs d),
          largest = Mm (if tight > fromIntegral (maxBound :: Int) then 0 else abs d / tight)
        }
  | otherwise = Nothing
  where
    (stretch, parameter, tight) =
      maximumBy (comparing (\(_, _, g) -> g)) (concatMap tightest (PointSearch.stretches whole))
    near = ShiftedCurve.jetAt 1 lower (PointSearch.within stretch whole parameter)
    d =
      PowerSeries.value
        (ShiftedCurve.distanceAt 0 top lower near (PointSearch.within stretch whole parameter))
    -- Samples, what lies highest between them, and where the curve is slowest: there it bends most.
    tightest s = [(s, u, share s u) | u <- PointSearch.samples s <> peaks s <> slowest s]
    share s u = let (g, _) = tightness s 0 u in g
    tightness s n u =
      let (g, moving) =
            tightnessAt n top lower whole s u
       in (if moving then PowerSeries.value g else standing g, g)
    standing g = if PowerSeries.value g == 0 then 0 else 1 / 0
    peaks s =
      RootFinding.falling
        (\u -> slopes (snd (tightness s 2 u)))
        [(u, fst (slopes (snd (tightness s 1 u)))) | u <- PointSearch.samples s]
    slopes g = (PowerSeries.coefficient 1 g, 2 * PowerSeries.coefficient 2 g)
    slowest s =
      RootFinding.rising (quickening s) [(u, fst (quickening s u)) | u <- PointSearch.samples s]
    quickening s u =
      let V2 a b = ShiftedCurve.jetAt 3 lower (PointSearch.within s whole u)
          w =
            PowerSeries.add
              (squared (PowerSeries.derivative a))
              (squared (PowerSeries.derivative b))
       in slopes w
    squared a = PowerSeries.multiply a a

-- | The product @d·κ@ near a place up to an order, and whether the curve that is shifted moves
-- there; when it does not, the distance instead.
tightnessAt :: Int -> Layer -> Curve -> Curve -> (Double, Double) -> Double -> (PowerSeries, Bool)
tightnessAt n top lower whole stretch u
  | Mm (Vec.norm (TaylorExpansion.velocity near)) > Tolerance.still =
    (PowerSeries.multiply d (TaylorExpansion.bending near), True)
  | otherwise = (d, False)
  where
    s = PointSearch.within stretch whole u
    near = ShiftedCurve.jetAt (n + 2) lower s
    d = ShiftedCurve.distanceAt n top lower near s
