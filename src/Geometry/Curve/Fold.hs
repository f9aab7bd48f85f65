-- | Where a shift does not fit: towards the centre of curvature a curve can be shifted by its radius at most; beyond
-- that the outcome runs backwards between two cusps.
module Geometry.Curve.Fold
  ( Fold (..),
    fold,
  )
where

import Base.Quantity (Mm (..))
import Data.List (maximumBy)
import Data.Ord (comparing)
import Geometry.Curve.Layered (Curve (..), Layer)
import Geometry.Curve.Layered qualified as Layered
import Geometry.Curve.Search qualified as Search
import Geometry.Jet (Jet (..))
import Geometry.Jet qualified as Jet
import Geometry.Root qualified as Root
import Geometry.Series (Series)
import Geometry.Series qualified as Series
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The tightest place of the innermost shift that does not fit.
data Fold = Fold
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

-- | Nothing when every shift stays within the radius of curvature: @1 − d·κ > 0@ with d to the left. Corners are not
-- looked at, only the smooth stretches between them.
fold :: Curve -> Maybe Fold
fold curve = case curve of
  Plain _ -> Nothing
  Shifted top lower _ -> case fold lower of
    Just found -> Just found
    Nothing -> folded top lower curve

folded :: Layer -> Curve -> Curve -> Maybe Fold
folded top lower whole
  | tight >= 1 = Just Fold {layer = length (Layered.layers whole), parameter, place = Jet.place near, asked = Mm (abs d), largest = Mm (if tight > fromIntegral (maxBound :: Int) then 0 else abs d / tight)}
  | otherwise = Nothing
  where
    (stretch, parameter, tight) = maximumBy (comparing (\(_, _, g) -> g)) (concatMap tightest (Search.stretches whole))
    near = Layered.jetAt 1 lower (Search.within stretch whole parameter)
    d = Series.value (Layered.distanceAt 0 top lower near (Search.within stretch whole parameter))
    -- Samples, what lies highest between them, and where the curve is slowest: there it bends most.
    tightest s = [(s, u, share s u) | u <- Search.samples s <> peaks s <> slowest s]
    share s u = let (g, _) = tightness s 0 u in g
    tightness s n u = let (g, moving) = tightnessAt n top lower whole s u in (if moving then Series.value g else standing g, g)
    standing g = if Series.value g == 0 then 0 else 1 / 0
    peaks s = Root.falling (\u -> slopes (snd (tightness s 2 u))) [(u, fst (slopes (snd (tightness s 1 u)))) | u <- Search.samples s]
    slopes g = (Series.coefficient 1 g, 2 * Series.coefficient 2 g)
    slowest s = Root.rising (quickening s) [(u, fst (quickening s u)) | u <- Search.samples s]
    quickening s u =
      let Jet a b = Layered.jetAt 3 lower (Search.within s whole u)
          w = Series.add (squared (Series.derivative a)) (squared (Series.derivative b))
       in slopes w
    squared a = Series.multiply a a

-- | The product @d·κ@ near a place up to an order, and whether the curve that is shifted moves there; when it does
-- not, the distance instead.
tightnessAt :: Int -> Layer -> Curve -> Curve -> (Double, Double) -> Double -> (Series, Bool)
tightnessAt n top lower whole stretch u
  | Mm (Vec.norm (Jet.velocity near)) > Tolerance.still = (Series.multiply d (Jet.bending near), True)
  | otherwise = (d, False)
  where
    s = Search.within stretch whole u
    near = Layered.jetAt (n + 2) lower s
    d = Layered.distanceAt n top lower near s
