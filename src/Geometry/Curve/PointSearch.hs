-- | Search for points on a curve: the nearest to a given point, those with a given x, and the
-- corners.
--
-- A smooth stretch is the part of the curve between two neighbouring parameters of
-- 'ShiftedCurve.breaks'. Every smooth stretch is sampled at equal steps of the parameter. The
-- search for the nearest point adds samples where the curve bends. Where neighbouring samples
-- enclose a solution, Newton's method with bisection finds it. Two solutions between neighbouring
-- samples may both be missed.
module Geometry.Curve.PointSearch
  ( nearest,
    atX,
    corners,
    unitTangentAcrossSeam,
    unitTangent,
    isClosed,
    stretches,
    samples,
    positionWithin,
  )
where

import Base.Crash qualified as Crash
import Base.Quantity (Mm (..), Rad (..), plus, times)
import Data.List (minimumBy)
import Data.Maybe (fromMaybe)
import Data.Ord (comparing)
import Geometry.Curve.BasisCurve (CurvePosition (approach))
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.ShiftedCurve (Curve (..))
import Geometry.Curve.ShiftedCurve qualified as ShiftedCurve
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.RootFinding qualified as RootFinding
import Geometry.Numeric.TaylorExpansion (Approach (..), TaylorExpansion)
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))

-- | Smooth stretches of the curve as pairs of first and last parameter.
stretches :: Curve -> [(Double, Double)]
stretches curve = let bs = ShiftedCurve.breaks curve in zip bs (drop 1 bs)

-- | Equally spaced parameters over a stretch, both ends included. A coordinate of a span of degree
-- p, which may be rational, has up to 2p − 2 extrema, so a stretch on it has 4p steps, at least 8.
samples :: Curve -> (Double, Double) -> [Double]
samples curve (a, b) =
  [ if k == steps then b else a + (b - a) * fromIntegral k / fromIntegral steps
    | k <- [0 .. steps]
  ]
  where
    degree = BasisCurve.degreeAt base (BasisCurve.spanPoint After a base)
    base = ShiftedCurve.base curve
    steps = if degree > 3 then 4 * degree else sampleSteps

-- | Least count of equal steps in which a smooth stretch is sampled.
sampleSteps :: Int
sampleSteps = 8

-- | Position at parameter @u@ of a stretch, approached from within the stretch. At a corner, the
-- direction is therefore that of this stretch.
positionWithin :: (Double, Double) -> Curve -> Double -> CurvePosition
positionWithin (_, b) curve u = ShiftedCurve.position (if u >= b then Before else After) u curve

-- | Parameter of the curve's point that is nearest to point @p@. If several points are equally
-- near, samples are preferred to other points, then smaller parameters to larger ones.
nearest :: Point -> Curve -> Double
nearest p curve =
  fst
    ( minimumBy
        (comparing snd)
        ( map (\(u, q, _) -> (u, Vec.distance p q)) (concatMap snd sampled)
            <> concatMap feet sampled
        )
    )
  where
    sampled =
      map
        ( \stretch ->
            (stretch, refineSamples (sample stretch) (map (sample stretch) (samples curve stretch)))
        )
        (stretches curve)
    sample stretch u =
      let jet = ShiftedCurve.expansionAt 1 curve (positionWithin stretch curve u)
       in (u, TaylorExpansion.position jet, forwards stretch curve u jet)
    best = minimum [Vec.distance p q | (_, found) <- sampled, (_, q, _) <- found]
    -- Finds each minimum of the distance from @p@ that two neighbouring samples enclose. Skips a
    -- minimum that is certainly larger than the distance of the best sample.
    feet (stretch, found) =
      [ ( u,
          Vec.distance
            p
            ( TaylorExpansion.position
                (ShiftedCurve.expansionAt 0 curve (positionWithin stretch curve u))
            )
        )
        | ((a, q, v), (b, r, w)) <- zip found (drop 1 found),
          Vec.dot (Vec.to p q) v < 0,
          Vec.dot (Vec.to p r) w > 0,
          min (Vec.distance p q) (Vec.distance p r) <= plus best (times 2 (Vec.distance q r)),
          let u = RootFinding.zero (distanceSlope p curve stretch) a b
      ]

-- | Half of the derivative of the squared distance from point @p@ at a parameter of a stretch, and
-- the derivative of this number. Where the speed is 0, both are by a parameter with another
-- speed, and the second counts as 0.
distanceSlope :: Point -> Curve -> (Double, Double) -> Double -> (Double, Double)
distanceSlope p curve stretch u
  | Mm (Vec.norm v) > Tolerance.stationary =
    (Vec.dot out v, Vec.dot v v + Vec.dot out acceleration)
  | otherwise = (Vec.dot out (forwards stretch curve u jet), 0)
  where
    jet@(V2 x y) = ShiftedCurve.expansionAt 2 curve (positionWithin stretch curve u)
    out = Vec.to p (TaylorExpansion.position jet)
    v = TaylorExpansion.velocity jet
    acceleration = Vec.vec (2 * PowerSeries.coefficient 2 x) (2 * PowerSeries.coefficient 2 y)

-- | Velocity at the parameter @u@ of a stretch, in mm per unit of the parameter, by the expansion
-- of the curve there. Where it is 0, as at the end of a span with two equal control points, the
-- result is a vector of the same direction.
forwards :: (Double, Double) -> Curve -> Double -> TaylorExpansion -> Vec
forwards stretch curve u expansion
  | Mm (Vec.norm v) > Tolerance.stationary = v
  | otherwise = unitTangent (approach (positionWithin stretch curve u)) curve u
  where
    v = TaylorExpansion.velocity expansion

-- | Samples of a stretch, with further ones inserted by bisection. They are inserted between
-- neighbours whose directions differ by more than 'largestChange'. A sample is a parameter, the
-- point there, and the velocity there (mm per unit of the parameter). @sample@ gives the sample at
-- a parameter.
refineSamples ::
  (Double -> (Double, Point, Vec)) ->
  [(Double, Point, Vec)] ->
  [(Double, Point, Vec)]
refineSamples sample = go
  where
    go found = case found of
      a : rest@(b : _) -> a : (between halvings a b <> go rest)
      _ -> found
    between n a@(u, _, v) b@(w, _, v')
      | n > 0,
        Rad change <- Vec.signedAngle v v',
        abs change > largestChange =
        let m = sample ((u + w) / 2) in between (n - 1) a m <> [m] <> between (n - 1) m b
      | otherwise = []
    -- Largest change of direction between neighbouring samples, in radians. The interval between
    -- two neighbours of the given list is halved at most @halvings@ times.
    largestChange = 0.3
    halvings = 6 :: Int

-- | Parameters, in ascending order, at which the curve's x is @abscissa@ (mm). A part of the curve
-- on which x is constantly @abscissa@ contributes its two ends, even if it has several stretches.
atX :: Double -> Curve -> [Double]
atX abscissa curve = distinct (concatMap found (stretches curve))
  where
    x order stretch u =
      let V2 a _ = ShiftedCurve.expansionAt order curve (positionWithin stretch curve u) in a
    found stretch =
      roots
        ( map
            (\u -> (u, deviation (PowerSeries.value (x 0 stretch u))))
            (merge (samples curve stretch) extrema)
        )
      where
        slopes = map (\u -> (u, PowerSeries.coefficient 1 (x 1 stretch u))) (samples curve stretch)
        slope u =
          let a = x 2 stretch u in (PowerSeries.coefficient 1 a, 2 * PowerSeries.coefficient 2 a)
        extrema = merge (RootFinding.rising slope slopes) (RootFinding.falling slope slopes)
        crossing u =
          let a = x 1 stretch u in (PowerSeries.value a - abscissa, PowerSeries.coefficient 1 a)
        roots ((a, v) : rest@((b, w) : _))
          | v == 0 = a : roots rest
          | v * w < 0 = RootFinding.zero crossing a b : roots rest
          | otherwise = roots rest
        roots [(a, 0)] = [a]
        roots _ = []
    -- Differences up to 'Tolerance.equal' count as 0.
    deviation v = if abs (v - abscissa) <= Tolerance.equal then 0 else v - abscissa
    -- Merges consecutive parameters between which x is constantly @abscissa@. Only the first and
    -- the last of them remain; if these two are nearly equal, only the first.
    distinct us = case us of
      [] -> []
      a : rest ->
        let (lastOfRun, others) =
              endOfRun a rest
         in [a] <> [lastOfRun | lastOfRun - a > resolution] <> distinct others
    endOfRun a us = case us of
      b : rest | isThere ((a + b) / 2) -> endOfRun b rest
      _ -> (a, us)
    resolution = 1e-3 / fromIntegral sampleSteps
    isThere u =
      let V2 a _ =
            ShiftedCurve.expansionAt 0 curve (ShiftedCurve.position After u curve)
       in deviation (PowerSeries.value a) == 0

-- | Merge of two ascending lists.
merge :: [Double] -> [Double] -> [Double]
merge as bs = case (as, bs) of
  ([], _) -> bs
  (_, []) -> as
  (a : as', b : bs') -> if a <= b then a : merge as' bs else b : merge as bs'

-- | Parameters, in ascending order, at which the direction jumps by more than
-- 'Tolerance.smoothAngle'. A corner at the common start and end of a closed curve has the
-- parameter 0.
corners :: Curve -> [Double]
corners curve =
  [0 | isClosed curve, isCorner 0] <> filter isCorner (drop 1 (init (ShiftedCurve.breaks curve)))
  where
    isCorner u =
      let Rad a =
            Vec.signedAngle
              (unitTangentAcrossSeam Before curve u)
              (unitTangentAcrossSeam After curve u)
       in Rad (abs a) > Tolerance.smoothAngle

-- | True if the curve ends where it begins.
isClosed :: Curve -> Bool
isClosed curve = Vec.isNear (end After 0) (end Before (ShiftedCurve.domain curve))
  where
    end approach u =
      TaylorExpansion.position
        (ShiftedCurve.expansionAt 0 curve (ShiftedCurve.position approach u curve))

-- | Unit tangent just before or just after parameter @u@. The start and the end of a closed curve
-- are one point: 'Before' the start gives the tangent at the end, and 'After' the end gives that at
-- the start.
unitTangentAcrossSeam :: Approach -> Curve -> Double -> Vec
unitTangentAcrossSeam approach curve u
  | approach == Before && u <= 0 && isClosed curve =
    unitTangent Before curve (ShiftedCurve.domain curve)
  | approach == After && u >= ShiftedCurve.domain curve && isClosed curve =
    unitTangent After curve 0
  | otherwise = unitTangent approach curve u

-- | Unit tangent just before or just after parameter @u@. The curve counts as continued beyond its
-- ends, so that there is a tangent before the start and after the end. The tangent is the limit
-- from the given side if the speed is 0, as at the end of a span with two equal control points. It
-- is the tangent of the curve below the shift if a shift has collapsed a stretch to a point.
unitTangent :: Approach -> Curve -> Double -> Vec
unitTangent approach curve u = case TaylorExpansion.direction approach (expansion 1) of
  Just d -> d
  Nothing -> case TaylorExpansion.direction approach (expansion 4) of
    Just d -> d
    Nothing -> case curve of
      Shifted _ lower _ -> unitTangent approach lower u
      Unshifted base ->
        fromMaybe
          (Crash.bug "a span that is a point")
          (BasisCurve.direction approach base (BasisCurve.spanPointAt position base))
  where
    position = ShiftedCurve.position approach u curve
    expansion n = ShiftedCurve.expansionAt n curve position
