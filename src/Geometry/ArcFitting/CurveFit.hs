-- | Arc fitting of curves of any kind ("Geometry.Curve"), each by the method that suits it.
module Geometry.ArcFitting.CurveFit
  ( approximate,
    parametric,
  )
where

import Base.Quantity (Mm (..), minus, times)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Semigroup (sconcat)
import Geometry.ArcFitting.CubicFit qualified as CubicFit
import Geometry.ArcFitting.ParametricFit (ParametricCurve (..))
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.ArcFitting.PolyarcFit qualified as PolyarcFit
import Geometry.Curve (Approach (..))
import Geometry.Curve qualified as Exact
import Geometry.MeasuredPolyarc (MeasuredPolyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Tolerance qualified as Tolerance

-- | A polyarc within @tolerance@ of a curve. An unshifted curve of lines and arcs, with at least
-- one arc, is a polyarc already; only small kinks in it are smoothed.
-- "Geometry.ArcFitting.CubicFit" makes arcs of a curve for which 'Exact.cubics' finds cubic spans,
-- such as a spline. For any other curve "Geometry.ArcFitting.ParametricFit" makes the arcs.
approximate :: Mm -> Exact.Curve -> MeasuredPolyarc
approximate tolerance exact =
  case (Exact.toSegments exact, cubics) of
    (Just segments, _) -> MeasuredPolyarc.fromSegments (PolyarcFit.smoothed tolerance segments)
    (Nothing, Just (off, xs, ys)) ->
      MeasuredPolyarc.fromFlatPolyarc (CubicFit.approximate (minus tolerance off) xs ys)
    (Nothing, Nothing) ->
      MeasuredPolyarc.fromSegments
        (sconcat (ParametricFit.approximate tolerance (parametric exact)))
  where
    cubics = Exact.cubics (times (0.5 * Tolerance.deviationShare) tolerance) exact

-- | An exact curve in the form that "Geometry.ArcFitting.ParametricFit" takes: as a function of its
-- parameter.
parametric :: Exact.Curve -> ParametricCurve
parametric c =
  ParametricCurve
    { place = Exact.at c,
      direction =
        \side ->
          Exact.tangentFrom
            (case side of ParametricFit.Arriving -> Before; ParametricFit.Leaving -> After)
            c,
      begin = 0,
      breaks = case drop 1 (Exact.breaks c) of
        [] -> Exact.domain c :| []
        u : us -> u :| us
    }
