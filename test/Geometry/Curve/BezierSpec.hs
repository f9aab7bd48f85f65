-- | Laws of Bézier curves and parts of ellipses, and of the arcs in their place.
module Geometry.Curve.BezierSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector qualified as Vector
import GHC.Exts qualified as Exts
import Generate.Curve qualified as Generate
import Geometry.Curve (Approach (..), Curve)
import Geometry.Curve qualified as Curve
import Geometry.Curve.Bezier (Bezier)
import Geometry.Curve.Bezier qualified as Bezier
import Geometry.Distance qualified as Distance
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.Curve qualified as Part
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "Bézier curves" $ do
    it
      "have the points of de Casteljau's algorithm on points and weights (catches weights that do \
      \not move with the points)"
      $ property $
        forAll ((,) <$> anyBezier <*> choose (0, 1)) $ \(c, t) ->
          close 1e-12 (pointAt c t) (casteljau (zip (Bezier.controlPoints c) (Bezier.weights c)) t)
    it
      "their expansions have the derivatives of their points (catches a quotient that is not one \
      \of series)"
      $ property $
        forAll ((,) <$> anyBezier <*> choose (0.01, 0.99)) derivativeLaw
    it "a higher degree changes no point (catches control points of another degree)" $
      property $
        forAll ((,) <$> (anyBezier `suchThat` ((< 20) . Bezier.degree)) <*> choose (0, 1)) $
          \(c, t) -> close 1e-12 (pointAt c t) (pointAt (elevated c) t)
    it "a similarity maps every point (catches images without their weights)" $
      property $
        forAll ((,,) <$> anyBezier <*> Generate.similarity <*> choose (0, 1)) $ \(c, s, t) ->
          close
            1e-11
            (pointAt (Bezier.transformed s c) t)
            (Transformation.point s (pointAt c t))
    it "the reversed curve has the same points (catches weights in the old order)" $
      property $
        forAll ((,) <$> anyBezier <*> choose (0, 1)) $ \(c, t) ->
          close 1e-12 (pointAt (Bezier.reversed c) t) (pointAt c (1 - t))
    it
      "equal control points at the ends leave the directions at the ends (catches a direction \
      \before the end that points back)"
      $ property $
        forAll stationary $ \(c, begin, end) ->
          alike (Bezier.direction After c 0) begin
            .&&. alike (Bezier.direction Before c 1) end
    it "a table of control points that coincide makes no curve" $
      Curve.bezier (Vector.replicate 5 (Vec.point 3 4)) Nothing `shouldBe` Left (Curve.NoLength 1)

  describe "parts of ellipses" $ do
    it "lie on the ellipse to 1e-12 of its size (catches an inner control point of weight 1)" $
      property $
        forAll ((,) <$> ellipse <*> choose (0, 1)) $ \(e@(a, b, _, _), t) ->
          let p = alignedPoint e (Curve.at (ellipseOf e) (t * Curve.domain (ellipseOf e)))
              q = (Vec.x p / a) ^ (2 :: Int) + (Vec.y p / b) ^ (2 :: Int)
           in counterexample (show q) (abs (q - 1) < 1e-12 * 4)
    it "begin and end at their angles, with spans of equal angles (catches half of a step)" $
      property $
        forAll ellipse $ \e@(a, b, from, to) ->
          let c = ellipseOf e
              n = Curve.domain c
           in conjoin
                [ close
                    1e-10
                    (alignedPoint e (Curve.at c k))
                    (Vec.point (a * cos w) (b * sin w))
                  | k <- [0 .. n],
                    let w = from + (to - from) * k / n
                ]
                .&&. counterexample (show n) (abs (to - from) <= n * (pi / 2 + 1e-6))

  describe "arcs in place of Bézier curves" $ do
    it
      "are within the tolerance of a curve of any kind, in both directions (catches Bézier curves \
      \whose spans are not halved)"
      $ property $
        forAll (oneof [Generate.bezier, Generate.bspline]) arcsLaw
    it
      "are within the tolerance where control points at the ends are equal (catches a speed of 0 \
      \at an end that is not seen)"
      $ property $
        forAll stationary $ \(c, _, _) ->
          forAll (Generate.weights (Bezier.degree c + 1)) $ \ws ->
            arcsLaw (Generate.ok (Curve.bezier (Exts.fromList (Bezier.controlPoints c)) ws))

-- | A Bézier curve of any degree from 1 on, also of 3 or less.
anyBezier :: Gen Bezier
anyBezier = do
  n <- choose (2, 21)
  points <- Generate.controlPoints n
  ws <- Generate.weights n
  pure (only (Bezier.fromPoints (Exts.fromList points) ws))

only :: [a] -> a
only list = case list of
  [a] -> a
  _ -> error "not one curve"

-- | A curve with up to five equal control points at each end, and its directions there.
stationary :: Gen (Bezier, Vec, Vec)
stationary = do
  n <- choose (2, 6)
  points <- Generate.controlPoints n
  first <- choose (0, 4)
  final <- choose (0, 4)
  let controls =
        replicate first (head points) <> points <> replicate final (last points)
      towards a b = Vec.unit (Vec.to a b)
  pure
    ( only (Bezier.fromPoints (Exts.fromList controls) Nothing),
      towards (head points) (points !! 1),
      towards (points !! (n - 2)) (last points)
    )

-- | Semi-axes, and the first and the last parameter angle.
ellipse :: Gen (Double, Double, Double, Double)
ellipse = do
  a <- choose (5, 80)
  b <- oneof [choose (5, 80), pure a]
  from <- choose (-7, 7)
  sweep <- oneof [choose (0.1, 6.28), elements [pi / 2, pi, 2 * pi]]
  sense <- elements [1, -1]
  pure (a, b, from, from + sense * sweep)

ellipseOf :: (Double, Double, Double, Double) -> Curve
ellipseOf (a, b, from, to) =
  Generate.ok (Curve.ellipse (Vec.point 3 (-4)) (Mm a) (Mm b) (Rad 0.4) (Rad from) (Rad to))

-- | A point in the axes of the ellipses.
alignedPoint :: (Double, Double, Double, Double) -> Point -> Point
alignedPoint _ p = Vec.shift (Vec.rotate (Rad (-0.4)) (Vec.to (Vec.point 3 (-4)) p)) (Vec.point 0 0)

pointAt :: Bezier -> Double -> Point
pointAt c t = TaylorExpansion.position (Bezier.expansion 0 c t)

-- | De Casteljau's algorithm on points with weights: each step mixes two neighbours by the shares
-- of their weights.
casteljau :: [(Point, Double)] -> Double -> Point
casteljau points t = case points of
  [] -> Vec.point 0 0
  [(p, _)] -> p
  _ -> casteljau (zipWith mixed points (drop 1 points)) t
  where
    mixed (p, v) (q, w) =
      let weight = (1 - t) * v + t * w in (Vec.interpolate (t * w / weight) p q, weight)

-- | Bézier curve of the next higher degree with the points of a given one.
elevated :: Bezier -> Bezier
elevated c =
  only (Bezier.fromPoints (Exts.fromList (map fst new)) (Just weights))
  where
    p = fromIntegral (Bezier.degree c)
    old = zip (Bezier.controlPoints c) (Bezier.weights c)
    new = [head old] <> zipWith3 mixed [1 ..] old (drop 1 old) <> [last old]
    mixed i (a, v) (b, w) =
      let share = i / (p + 1)
          weight = share * v + (1 - share) * w
       in (Vec.interpolate ((1 - share) * w / weight) a b, weight)
    weights = Generate.ok (Curve.weightsFor (length new) (map snd new))

-- | Compares the first three derivatives with differences of the points.
derivativeLaw :: (Bezier, Double) -> Property
derivativeLaw (c, t) = conjoin (map agrees [-1, -0.5, 0.5, 1])
  where
    h = 0.03 / fromIntegral (Bezier.degree c ^ (2 :: Int))
    jet = Bezier.expansion 8 c t
    agrees k =
      let d = k * h
       in close 1e-9 (TaylorExpansion.position (fmap (sumAt d) jet)) (pointAt c (t + d))
    sumAt d s = PowerSeries.constant 0 (foldr (\a v -> a + d * v) 0 (PowerSeries.coefficients s))

-- | Arcs and curve are within the tolerance of each other.
arcsLaw :: Curve -> Property
arcsLaw c = conjoin (map nearArcs curvePoints <> map nearCurve arcPoints)
  where
    segments = NonEmpty.toList (MeasuredPolyarc.segments polyarc)
    polyarc = Part.approximation (Part.plain c)
    Mm whole = MeasuredPolyarc.length polyarc
    curvePoints = [Curve.at c (Curve.domain c * k / 211) | k <- [0 .. 211]]
    arcPoints = [MeasuredPolyarc.at polyarc (Mm (whole * k / 211)) | k <- [0 .. 211]]
    Mm tolerance = Tolerance.curve
    nearArcs p =
      let Mm d = minimum (map (Distance.toPoint p) segments)
       in counterexample (show ("from the curve" :: String, p, d)) (d <= tolerance + 1e-9)
    nearCurve p =
      let Mm d = Vec.distance p (Curve.at c (Curve.nearest p c))
       in counterexample (show ("from the arcs" :: String, p, d)) (d <= tolerance + 1e-9)

close :: Double -> Point -> Point -> Property
close slack p q =
  let Mm d = Vec.distance p q
   in counterexample (show (p, q, d)) (d <= slack * (100 + abs (Vec.x p) + abs (Vec.y p)))

alike :: Vec -> Vec -> Property
alike v w = counterexample (show (v, w)) (Vec.norm (Vec.add v (Vec.negate w)) < 1e-9)
