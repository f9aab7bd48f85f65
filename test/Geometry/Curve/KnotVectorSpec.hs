-- | Laws of B-splines: their Bézier spans against the basis functions.
module Geometry.Curve.KnotVectorSpec (spec) where

import Base.Quantity (Mm (..))
import Data.List (nub)
import GHC.Exts qualified as Exts
import Generate.Curve qualified as Generate
import Geometry.Curve (KnotFault (..))
import Geometry.Curve qualified as Curve
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  describe "B-splines" $ do
    it
      "have the points of the Cox-de Boor basis functions (catches a blossom whose last argument \
      \is the lower knot)"
      $ property $
        forAll anySpline $ \(degree, n, knots, points, ws) ->
          forAll (choose (0, 1)) $ \share ->
            let c = splineOf degree n knots points (Just ws)
                spans = zip interior (drop 1 interior)
                interior = nub (take (n - degree + 1) (drop degree knots))
                at i = (fromIntegral i + share, a + share * (b - a))
                  where
                    (a, b) = spans !! i
             in conjoin
                  [ closeTo (Curve.at c u) (byBasis degree knots points ws v)
                    | i <- [0 .. length spans - 1],
                      let (u, v) = at i
                  ]
    it "knots that differ by rounding are one knot (catches a span of no width)" $
      property $
        forAll anySpline $ \(degree, n, knots, points, _) ->
          forAll (vectorOf (length knots) (choose (0, 1e-11))) $ \noise ->
            let noisy = scanl1 max (zipWith (+) knots noise)
                c = splineOf degree n knots points Nothing
                c' = splineOf degree n noisy points Nothing
             in Curve.spans c === Curve.spans c'
    it "need knots of their count, in ascending order" $ do
      faultOf 2 4 [0, 0, 0, 1, 1, 1] `shouldBe` Just (KnotCount 6 7)
      faultOf 2 4 [0, 0, 0, 1, 0.5, 1, 1] `shouldBe` Just (FallingKnot 5)
      faultOf 2 2 [0, 0, 0, 1, 1] `shouldBe` Just (FewControlPoints 2)
      faultOf 2 4 [0, 0, 0, 0, 1, 1, 1] `shouldBe` Just (RepeatedKnot 1 0 4 3)
      faultOf 2 6 [0, 0, 0, 1, 1, 1, 2, 2, 2] `shouldBe` Just (RepeatedKnot 4 1 3 2)
      faultOf 3 4 [0, 1, 2, 3, 3, 4, 5, 6] `shouldBe` Just (NoInterval 4 5)
      faultOf 2 4 [0, 0, 0, 1, 2, 2, 2] `shouldBe` Nothing
  where
    anySpline = do
      degree <- choose (1, 7)
      n <- choose (degree + 1, degree + 7)
      knots <- Generate.knotsFor degree n
      points <- Generate.controlPoints n
      ws <- vectorOf n (choose (0.5, 2))
      pure (degree, n, knots, points, ws)
    splineOf degree n knots points ws =
      Generate.ok
        ( Curve.bspline
            (Generate.ok (Curve.knotVector degree n knots))
            (Exts.fromList points)
            (fmap (Generate.ok . Curve.weightsFor n) ws)
        )
    faultOf degree n = either Just (const Nothing) . Curve.knotVector degree n
    closeTo p q =
      let Mm d = Vec.distance p q
       in counterexample (show (p, q)) (d <= 1e-10 * (100 + abs (Vec.x p)))

-- | The point by the recurrence of the basis functions.
byBasis :: Int -> [Double] -> [Vec.Point] -> [Double] -> Double -> Vec.Point
byBasis degree knots points ws v = Vec.point (summed Vec.x / sum shares) (summed Vec.y / sum shares)
  where
    shares = [w * basis degree i | (i, w) <- zip [0 ..] ws]
    summed part = sum (zipWith (*) shares (map part points))
    u = (knots !!)
    basis :: Int -> Int -> Double
    basis p i
      | p == 0 = if u i <= v && v < u (i + 1) then 1 else 0
      | otherwise =
        share (v - u i) (u (i + p) - u i) * basis (p - 1) i
          + share (u (i + p + 1) - v) (u (i + p + 1) - u (i + 1)) * basis (p - 1) (i + 1)
    share a b = if b > 0 then a / b else 0
