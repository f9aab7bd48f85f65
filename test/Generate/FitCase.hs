-- | Curves by formulas, and their tolerances, for the laws of arc fitting.
module Generate.FitCase
  ( FitCase (..),
    Curve (..),
    fitCase,
    large,
    nearCusp,
    smoothCubic,
    isClosed,
    jumps,
    corners,
    hasKinks,
    reversesInX,
    parametricCurve,
    samples,
    parameters,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.IntMap.Lazy ((!))
import Data.IntMap.Lazy qualified as IntMap
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Geometry.ArcFitting.ParametricFit (OneSided (..), ParametricCurve (..))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Test.QuickCheck

-- | A curve and the tolerance in mm of the arcs that approximate it.
data FitCase = FitCase Curve Double
  deriving stock (Show)

-- | Curves in mm, with the parameters at which spans meet.
data Curve
  = -- | amplitude; wavelength divided by 2π
    Sine Double Double [Double]
  | -- | half axes
    Ellipse Double Double [Double]
  | Lissajous Double Double [Double]
  | -- | factor of the fourth power
    Quartic Double [Double]
  | -- | closed or not, and nodes: point, angle of the direction, change of the angle at the node,
    -- and the speeds before and after
    Cubic Bool [Node]
  | -- | lines and arcs in tangent contact: lengths and curvatures
    Bends [(Double, Double)]
  | -- | nearly a cusp: the speed at its tip
    Cusp Double [Double]
  deriving stock (Show)

type Node = (Point, Double, Double, Double, Double)

fitCase :: Gen FitCase
fitCase = FitCase <$> curve 1 <*> ((10 **) <$> choose (-3, 0))

large :: Gen FitCase
large =
  FitCase <$> (Sine <$> choose (100, 1000) <*> choose (300, 800) <*> spanEnds 12) <*> pure 1e-5

nearCusp :: Gen FitCase
nearCusp = FitCase <$> (Cusp <$> choose (0.05, 3) <*> spanEnds 3) <*> ((10 **) <$> choose (-2, 0))

smoothCubic :: Gen FitCase
smoothCubic = FitCase <$> (short <$> cubic 1) <*> ((10 **) <$> choose (-3, -1.5))
  where
    short c = case c of
      Cubic _ nodes -> Cubic False [(p, a, 0, v, w) | (p, a, _, v, w) <- take 3 nodes]
      _ -> c

curve :: Double -> Gen Curve
curve size =
  oneof
    [ Sine <$> choose (size, 30 * size) <*> choose (5 * size, 40 * size) <*> spanEnds 9,
      Ellipse
        <$> choose (10 * size, 80 * size) <*> choose (10 * size, 80 * size) <*> spanEnds (2 * pi),
      Lissajous
        <$> choose (10 * size, 60 * size) <*> choose (10 * size, 60 * size) <*> spanEnds (2 * pi),
      Quartic <$> choose (0.2 * size, 2 * size) <*> spanEnds 3,
      Bends
        <$> resize
          6
          ( listOf1
              ( (,)
                  <$> oneof [choose (1, 60), choose (0.05, 1)]
                    <*> oneof [pure 0, choose (-0.1, 0.1)]
              )
          ),
      cubic size,
      cubic size
    ]

-- | Ends of the spans: the last at a given parameter; some spans are far shorter than others.
spanEnds :: Double -> Gen [Double]
spanEnds end = do
  inner <- resize 5 (listOf (choose (0.01, 0.99)))
  tiny <- elements [[], [0.3, 0.30001, 0.3001]]
  pure (map (* end) (sort (inner <> tiny)) <> [end])

-- | Cubic spans between random points: smooth, with corners, or with kinks too small to count;
-- often closed.
cubic :: Double -> Gen Curve
cubic size = do
  n <- choose (2, 6)
  closed <- arbitrary
  nodes <- vectorOf n $ do
    p <- Vec.point <$> choose (-(60 * size), 60 * size) <*> choose (-(60 * size), 60 * size)
    a <- choose (-pi, pi)
    jump <- frequency [(5, pure 0), (2, choose (0.05, 2)), (1, elements [5e-4, -5e-4])]
    (,,,,) p a jump <$> choose (0.4, 1.2) <*> choose (0.4, 1.2)
  pure (Cubic closed nodes)

isClosed :: Curve -> Bool
isClosed c = case c of
  Sine {} -> False
  Ellipse {} -> True
  Lissajous {} -> True
  Quartic {} -> False
  Cubic closed _ -> closed
  Bends _ -> False
  Cusp _ _ -> False

-- | Jumps of direction inside the curve.
jumps :: Curve -> [Double]
jumps c = case c of
  Cubic closed nodes ->
    [j | (_, _, j, _, _) <- drop 1 (if closed then nodes else take (length nodes - 1) nodes)]
  _ -> []

corners :: Curve -> Int
corners c = length (filter ((> 0.01) . abs) (jumps c))

hasKinks :: Curve -> Bool
hasKinks c = any (\j -> j /= 0 && abs j < 0.01) (jumps c)

-- | True if x both rises and falls.
reversesInX :: Curve -> Bool
reversesInX c = or (zipWith (<=) xs (drop 1 xs)) && or (zipWith (>) xs (drop 1 xs))
  where
    xs = map Vec.x (samples 50 (parametricCurve c))

parametricCurve :: Curve -> ParametricCurve
parametricCurve c = case c of
  Sine a w bs -> analytic bs (\u -> Vec.point (w * u) (a * sin u)) (\u -> Vec.vec w (a * cos u))
  Ellipse a b bs ->
    analytic bs (\u -> Vec.point (a * cos u) (b * sin u)) (\u -> Vec.vec (-(a * sin u)) (b * cos u))
  Lissajous a b bs ->
    analytic
      bs
      (\u -> Vec.point (a * cos (3 * u)) (b * sin (2 * u)))
      (\u -> Vec.vec (-(3 * a * sin (3 * u))) (2 * b * cos (2 * u)))
  Quartic k bs ->
    analytic
      bs
      (\u -> Vec.point (10 * (u - 1.5)) (k * (u - 1.5) ** 4))
      (\u -> Vec.vec 10 (4 * k * (u - 1.5) ^ (3 :: Int)))
  Cusp e bs ->
    analytic
      bs
      (\u -> let v = u - 1.5 in Vec.point (10 * v * v) (5 * v ^ (3 :: Int) + e * v))
      (\u -> let v = u - 1.5 in Vec.vec (20 * v) (15 * v * v + e))
  Cubic closed nodes ->
    let spans = zip nodes (drop 1 nodes <> take 1 nodes)
        n = if closed then length nodes else length nodes - 1
        list = IntMap.fromList (zip [0 ..] spans)
        pick side u =
          let k =
                max 0 (min (n - 1) (case side of Arriving -> ceiling u - 1; Leaving -> floor u))
           in (list ! k, u - fromIntegral k)
     in ParametricCurve
          { place = \u -> let (s, f) = pick Arriving u in fst (hermite s f),
            direction = \side u -> let (s, f) = pick side u in Vec.unit (snd (hermite s f)),
            begin = 0,
            breaks = 1 :| map fromIntegral [2 .. n]
          }
  Bends bends ->
    let poses = scanl (\pose (l, k) -> bend pose l k) (Vec.point 0 0, 0) bends
        spans = IntMap.fromList (zip [0 ..] (zip poses bends))
        at u =
          let k =
                max 0 (min (length bends - 1) (ceiling u - 1))
              (pose, (l, curvature)) = spans ! k
           in bend pose (l * (u - fromIntegral k)) curvature
     in ParametricCurve
          { place = fst . at,
            direction = \_ u -> Vec.polar (Mm 1) (Rad (snd (at u))),
            begin = 0,
            breaks = 1 :| map fromIntegral [2 .. length bends]
          }
  where
    bend (p, a) l k
      | k == 0 = (Vec.shift (Vec.polar (Mm l) (Rad a)) p, a)
      | otherwise =
        (Vec.shift (Vec.polar (Mm (2 / k * sin (k * l / 2))) (Rad (a + k * l / 2))) p, a + k * l)
    analytic bs place d =
      ParametricCurve
        { place,
          direction = \_ u -> Vec.unit (d u),
          begin = 0,
          breaks = fromMaybe (1 :| []) (NonEmpty.nonEmpty bs)
        }

-- | Cubic span between two nodes: point and derivative.
hermite :: (Node, Node) -> Double -> (Point, Vec)
hermite ((p, a, jump, _, out), (q, b, _, into, _)) f =
  (Vec.shift (combined h10 h01 h11) p, combined g10 g01 g11)
  where
    chord = Vec.to p q
    long = Vec.norm chord
    v = Vec.polar (Mm (long * out)) (Rad (a + jump))
    w = Vec.polar (Mm (long * into)) (Rad b)
    combined x y z = Vec.add (Vec.scale x v) (Vec.add (Vec.scale y chord) (Vec.scale z w))
    (h10, h01, h11) = (f * (1 - f) * (1 - f), f * f * (3 - 2 * f), f * f * (f - 1))
    (g10, g01, g11) = ((1 - f) * (1 - 3 * f), 6 * f * (1 - f), f * (3 * f - 2))

samples :: Int -> ParametricCurve -> [Point]
samples n t = map (place t) (parameters n t)

parameters :: Int -> ParametricCurve -> [Double]
parameters n t =
  [begin t + (NonEmpty.last (breaks t) - begin t) * fromIntegral k / fromIntegral n | k <- [0 .. n]]
