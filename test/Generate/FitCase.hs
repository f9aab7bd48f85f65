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

-- | A curve, and the tolerance in mm for the arcs that approximate it.
data FitCase = FitCase Curve Double
  deriving stock (Show)

-- | A curve. Lengths are in mm. The lists of numbers are the parameters at which spans end.
data Curve
  = -- | a sine: its amplitude, and its wavelength divided by 2π
    Sine Double Double [Double]
  | -- | an ellipse by its semi-axes in x and y
    Ellipse Double Double [Double]
  | -- | the Lissajous curve x = a·cos 3u, y = b·sin 2u, by a and b
    Lissajous Double Double [Double]
  | -- | a polynomial of degree four, by the factor of the fourth power
    Quartic Double [Double]
  | -- | cubic spans between nodes. The flag tells if the curve is closed
    Cubic Bool [Node]
  | -- | lines and arcs, each tangent to the next: their lengths, and their curvatures in 1/mm
    Bends [(Double, Double)]
  | -- | a curve that is nearly a cusp: the derivative at its tip, in mm
    Cusp Double [Double]
  deriving stock (Show)

-- | A node between cubic spans: the point, the angle of the arriving direction in rad, the change
-- of the angle at the node, and the lengths of the derivatives before and after the node, as
-- multiples of the chord.
type Node = (Point, Double, Double, Double, Double)

-- | A curve of any kind but 'Cusp', with a tolerance from 1 µm to 1 mm.
fitCase :: Gen FitCase
fitCase = FitCase <$> curve 1 <*> ((10 **) <$> choose (-3, 0))

-- | A large sine with the tolerance 0.01 µm, whose approximation needs many arcs.
large :: Gen FitCase
large =
  FitCase <$> (Sine <$> choose (100, 1000) <*> choose (300, 800) <*> spanEnds 12) <*> pure 1e-5

-- | A curve that is nearly a cusp.
nearCusp :: Gen FitCase
nearCusp = FitCase <$> (Cusp <$> choose (0.05, 3) <*> spanEnds 3) <*> ((10 **) <$> choose (-2, 0))

-- | An open curve of at most two cubic spans without corners.
smoothCubic :: Gen FitCase
smoothCubic = FitCase <$> (short <$> cubic 1) <*> ((10 **) <$> choose (-3, -1.5))
  where
    short c = case c of
      Cubic _ nodes -> Cubic False [(p, a, 0, v, w) | (p, a, _, v, w) <- take 3 nodes]
      _ -> c

-- | A curve of any kind but 'Cusp', with lengths in proportion to @size@ mm.
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

-- | Parameters at which spans end, the last one at @end@. Some spans are much shorter than others.
spanEnds :: Double -> Gen [Double]
spanEnds end = do
  inner <- resize 5 (listOf (choose (0.01, 0.99)))
  tiny <- elements [[], [0.3, 0.30001, 0.3001]]
  pure (map (* end) (sort (inner <> tiny)) <> [end])

-- | Cubic spans between random points, often closed. At a node the curve is smooth, or has a
-- corner, or has a kink that is smaller than any corner.
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

-- | The changes of direction at the nodes inside a curve, in rad.
jumps :: Curve -> [Double]
jumps c = case c of
  Cubic closed nodes ->
    [j | (_, _, j, _, _) <- drop 1 (if closed then nodes else take (length nodes - 1) nodes)]
  _ -> []

-- | The number of corners: changes of direction by more than 0.01 rad.
corners :: Curve -> Int
corners c = length (filter ((> 0.01) . abs) (jumps c))

-- | True of a curve with changes of direction that are too small for corners.
hasKinks :: Curve -> Bool
hasKinks c = any (\j -> j /= 0 && abs j < 0.01) (jumps c)

-- | True of a curve along which x both increases and decreases.
reversesInX :: Curve -> Bool
reversesInX c = or (zipWith (<=) xs (drop 1 xs)) && or (zipWith (>) xs (drop 1 xs))
  where
    xs = map Vec.x (samples 50 (parametricCurve c))

-- | The curve in the form that arc fitting takes.
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

-- | The point and the derivative of the cubic Hermite span between two nodes, at a parameter from
-- 0 to 1.
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

-- | The points of a curve at 'parameters'.
samples :: Int -> ParametricCurve -> [Point]
samples n t = map (place t) (parameters n t)

-- | The parameters that divide the domain of a curve into @n@ equal parts, with both ends.
parameters :: Int -> ParametricCurve -> [Double]
parameters n t =
  [begin t + (NonEmpty.last (breaks t) - begin t) * fromIntegral k / fromIntegral n | k <- [0 .. n]]
