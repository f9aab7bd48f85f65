-- | Places on a curve: the nearest to a point, those at an abscissa, those where its direction
-- jumps.
--
-- Every smooth stretch of the curve is sampled at equal steps of the parameter, more closely where
-- it bends for the nearest place, and places are made exact between the samples. What a curve does
-- twice between neighbouring samples may be overlooked.
module Geometry.Curve.PointSearch
  ( nearest,
    atX,
    corners,
    directionAt,
    heading,
    closed,
    stretches,
    samples,
    within,
  )
where

import Base.Crash qualified as Crash
import Base.Quantity (Mm (..), Rad (..), plus, times)
import Data.List (minimumBy)
import Data.Ord (comparing)
import Geometry.Curve.Base (SpanPoint)
import Geometry.Curve.ShiftedCurve (Curve (..))
import Geometry.Curve.ShiftedCurve qualified as ShiftedCurve
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.RootFinding qualified as RootFinding
import Geometry.Numeric.TaylorExpansion (Approach (..))
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))

-- | The smooth stretches, each from one parameter to another.
stretches :: Curve -> [(Double, Double)]
stretches curve = let bs = ShiftedCurve.breaks curve in zip bs (drop 1 bs)

-- | Parameters across a stretch, its ends included.
samples :: (Double, Double) -> [Double]
samples (a, b) =
  [if k == steps then b else a + (b - a) * fromIntegral k / fromIntegral steps | k <- [0 .. steps]]

-- | How many steps a smooth stretch is sampled in.
steps :: Int
steps = 8

-- | The place with a parameter, seen from within a stretch.
within :: (Double, Double) -> Curve -> Double -> SpanPoint
within (_, b) curve u = ShiftedCurve.spot (if u >= b then Before else After) u curve

-- | The parameter of the place that is nearest to a point. Of several the first.
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
        (\stretch -> (stretch, closely (sample stretch) (map (sample stretch) (samples stretch))))
        (stretches curve)
    sample stretch u =
      let jet = ShiftedCurve.jetAt 1 curve (within stretch curve u)
       in (u, TaylorExpansion.place jet, TaylorExpansion.velocity jet)
    best = minimum [Vec.distance p q | (_, found) <- sampled, (_, q, _) <- found]
    -- Where the way turns from towards the point to away from it, unless that is certainly further
    -- than a sample.
    feet (stretch, found) =
      [ ( u,
          Vec.distance
            p
            (TaylorExpansion.place (ShiftedCurve.jetAt 0 curve (within stretch curve u)))
        )
        | ((a, q, v), (b, r, w)) <- zip found (drop 1 found),
          Vec.dot (Vec.to p q) v < 0,
          Vec.dot (Vec.to p r) w > 0,
          min (Vec.distance p q) (Vec.distance p r) <= plus best (times 2 (Vec.distance q r)),
          let u = RootFinding.zero (approaching stretch) a b
      ]
    approaching stretch u = (Vec.dot out v, Vec.dot v v + Vec.dot out bend)
      where
        jet@(V2 x y) = ShiftedCurve.jetAt 2 curve (within stretch curve u)
        out = Vec.to p (TaylorExpansion.place jet)
        v = TaylorExpansion.velocity jet
        bend = Vec.vec (2 * PowerSeries.coefficient 2 x) (2 * PowerSeries.coefficient 2 y)

-- | Samples, with more of them where the way turns much from one to the next.
closely :: (Double -> (Double, Point, Vec)) -> [(Double, Point, Vec)] -> [(Double, Point, Vec)]
closely sample = go
  where
    go found = case found of
      a : rest@(b : _) -> a : (between halvings a b <> go rest)
      _ -> found
    between n a@(u, _, v) b@(w, _, v')
      | n > 0,
        Rad turned <- Vec.turn v v',
        abs turned > most =
        let m = sample ((u + w) / 2) in between (n - 1) a m <> [m] <> between (n - 1) m b
      | otherwise = []
    -- In radians, and how often a step is halved at most.
    most = 0.3
    halvings = 6 :: Int

-- | The parameters at which the curve has an abscissa (mm), in rising order; of a stretch that runs
-- straight up there, its ends.
atX :: Double -> Curve -> [Double]
atX abscissa curve = distinct (concatMap found (stretches curve))
  where
    x order stretch u =
      let V2 a _ = ShiftedCurve.jetAt order curve (within stretch curve u) in a
    found stretch =
      roots
        (map (\u -> (u, off (PowerSeries.value (x 0 stretch u)))) (merged (samples stretch) turns))
      where
        slopes = map (\u -> (u, PowerSeries.coefficient 1 (x 1 stretch u))) (samples stretch)
        slope u =
          let a = x 2 stretch u in (PowerSeries.coefficient 1 a, 2 * PowerSeries.coefficient 2 a)
        turns = merged (RootFinding.rising slope slopes) (RootFinding.falling slope slopes)
        crossing u =
          let a = x 1 stretch u in (PowerSeries.value a - abscissa, PowerSeries.coefficient 1 a)
        roots ((a, v) : rest@((b, w) : _))
          | v == 0 = a : roots rest
          | v * w < 0 = RootFinding.zero crossing a b : roots rest
          | otherwise = roots rest
        roots [(a, 0)] = [a]
        roots _ = []
    -- What is as near as doubles can tell is there.
    off v = if abs (v - abscissa) <= Tolerance.equal then 0 else v - abscissa
    -- Touching samples that follow one another are one place, or the ends of a stretch, but not
    -- crossings between which the curve goes away and comes back.
    distinct us = case us of
      [] -> []
      a : rest ->
        let (final, others) =
              onwards a rest
         in [a] <> [final | final - a > same] <> distinct others
    onwards a us = case us of
      b : rest | isThere ((a + b) / 2) -> onwards b rest
      _ -> (a, us)
    same = 1e-3 / fromIntegral steps
    isThere u =
      let V2 a _ =
            ShiftedCurve.jetAt 0 curve (ShiftedCurve.spot After u curve)
       in off (PowerSeries.value a) == 0

merged :: [Double] -> [Double] -> [Double]
merged as bs = case (as, bs) of
  ([], _) -> bs
  (_, []) -> as
  (a : as', b : bs') -> if a <= b then a : merged as' bs else b : merged as bs'

-- | The parameters at which the direction jumps by more than 'Tolerance.smoothAngle', in rising
-- order; that of a closed curve's joint is 0.
corners :: Curve -> [Double]
corners curve =
  [0 | closed curve, jumps 0] <> filter jumps (drop 1 (init (ShiftedCurve.breaks curve)))
  where
    jumps u =
      let Rad a =
            Vec.turn (directionAt Before curve u) (directionAt After curve u)
       in Rad (abs a) > Tolerance.smoothAngle

-- | Whether the curve ends where it begins.
closed :: Curve -> Bool
closed curve = Vec.near (end After 0) (end Before (ShiftedCurve.domain curve))
  where
    end approach u =
      TaylorExpansion.place (ShiftedCurve.jetAt 0 curve (ShiftedCurve.spot approach u curve))

-- | The direction before or behind a place. On a closed curve the way goes on over the joint.
directionAt :: Approach -> Curve -> Double -> Vec
directionAt approach curve u
  | approach == Before && u <= 0 && closed curve = heading Before curve (ShiftedCurve.domain curve)
  | approach == After && u >= ShiftedCurve.domain curve && closed curve = heading After curve 0
  | otherwise = heading approach curve u

-- | The direction before or behind a place; at an end, of what there is. Where the curve stands
-- still it is the limit; where a shift has made a point of a whole stretch it is that of the curve
-- below.
heading :: Approach -> Curve -> Double -> Vec
heading approach curve u = case TaylorExpansion.direction approach (near 1) of
  Just d -> d
  Nothing -> case TaylorExpansion.direction approach (near 4) of
    Just d -> d
    Nothing -> case curve of
      Shifted _ lower _ -> heading approach lower u
      Plain _ -> Crash.bug "a span that is a point"
  where
    near n = ShiftedCurve.jetAt n curve (ShiftedCurve.spot approach u curve)
