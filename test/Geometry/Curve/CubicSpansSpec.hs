-- | Laws of the cubic approximation of shifted curves.
module Geometry.Curve.CubicSpansSpec (spec) where

import Base.Quantity (Mm (..))
import Data.List (sort)
import Data.Maybe (isNothing)
import GHC.Exts qualified as Exts
import Generate.Curve qualified as Generate
import Geometry.Curve (Curve, Distance (..), EndCondition (..), Side (..))
import Geometry.Curve qualified as Curve
import Geometry.Curve.Cusp qualified as Cusp
import Geometry.Curve.Spline qualified as Spline
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  describe "cubic approximation of curves" $ do
    it
      "their points are within the tolerance of a shifted curve (catches an interval that is \
      \tested at its middle only)"
      $ property $
        forAll ((,) <$> shifted <*> ((10 **) <$> choose (-7, -3))) (uncurry nearLaw)
    it
      "their points are within the tolerance of a long shallow bevel (catches halves that are not \
      \measured)"
      $ once (nearAt [k / 400 | k <- [0 .. 400]] shallow 2.05934e-4)
    it
      "they join without gaps from the start of the curve to its end (catches a half that is left \
      \out)"
      $ property $
        forAll shifted joinedLaw
    it "those of an unshifted spline are its own cubics, exactly" $
      property $
        forAll Generate.smooth $ \c ->
          fmap (\(Mm d, _, _) -> d) (Curve.cubics (Mm 1e-7) c) === Just 0

shifted :: Gen Curve
shifted = Generate.layered 2 Generate.smooth `suchThat` (isNothing . Cusp.firstCusp)

-- | Curve on which the halves of an interval deviate by more than the deviation of the whole
-- interval suggests.
shallow :: Curve
shallow =
  Curve.shifted
    RightOf
    (Bevelled (column [-0.0883, -0.0247, -0.1041]) (column [3.0449, 3.6712, 3.4022]) (Mm 1.426))
    spline
  where
    spline =
      Generate.ok
        ( Curve.spline
            (Clamped (Vec.vec 1 (-0.0061)) (Vec.vec 1 0.0061))
            (Exts.fromList [Vec.point x 0 | x <- [0, 15.8045, 28.7877]])
        )
    column = Curve.column spline . Exts.fromList

nearLaw :: Curve -> Double -> Property
nearLaw c tolerance = forAll (vectorOf 30 (choose (0, 1))) $ \fs -> nearAt fs c tolerance

nearAt :: [Double] -> Curve -> Double -> Property
nearAt fs c tolerance = case pointsOf tolerance c of
  Nothing -> classify True "speed near 0" True
  Just (n, pointAt) ->
    -- Each span is searched by itself: where a shift has opened a corner, samples of one span could
    -- hide the nearest point of the other.
    let known =
          [ [(w, pointAt i w) | k <- [0 .. 16 :: Int], let w = fromIntegral i + fromIntegral k / 16]
            | i <- [0 .. n - 1]
          ]
        closer :: Point -> Int -> Int -> Double -> Double -> Double
        closer p i k h w
          | k == 0 = apart p (pointAt i w)
          | otherwise =
            let (_, v) =
                  minimum
                    [ (apart p (pointAt i x), x)
                      | x <- map (clamped i) [w - h, w - h / 2, w, w + h / 2, w + h]
                    ]
             in closer p i (k - 1) (h / 2) v
        clamped i = max (fromIntegral i) . min (fromIntegral i + 1)
        minima ds =
          take 1 ds
            <> [b | (a, b, d) <- zip3 ds (drop 1 ds) (drop 2 ds), b <= a, b <= d]
            <> take 1 (reverse ds)
        nearest p =
          minimum
            [ closer p i 44 (1 / 16) w
              | (_, w, i) <-
                  take
                    6
                    ( sort
                        ( concat
                            [ [(d, w, i) | (d, w) <- minima [(apart p q, w) | (w, q) <- ws]]
                              | (i, ws) <- zip [0 ..] known
                            ]
                        )
                    )
            ]
     in conjoin
          [ counterexample (show (u, d)) (d <= tolerance + 1e-9)
            | f <- fs,
              let u = f * Curve.domain c,
              let d = nearest (Curve.at c u)
          ]

joinedLaw :: Curve -> Property
joinedLaw c = case pointsOf 1e-6 c of
  Nothing -> property True
  -- A shift opens corners, which cannot join.
  _ | any isOpen (Curve.breaks c) -> classify True "open corners" True
  Just (n, pointAt) ->
    conjoin
      [ counterexample
          (show k)
          (apart (pointAt (k - 1) (fromIntegral k)) (pointAt k (fromIntegral k)) < 1e-4)
        | k <- [1 .. n - 1]
      ]
      .&&. counterexample
        "ends"
        ( apart (pointAt 0 0) (Curve.start c) < 1e-9
            && apart (pointAt (n - 1) (fromIntegral n)) (Curve.end c) < 1e-9
        )
  where
    isOpen u = apart (Curve.pointFrom Curve.Before c u) (Curve.pointFrom Curve.After c u) > 1e-6

-- | Count of spans, and the point on one of them by the cubics.
pointsOf :: Double -> Curve -> Maybe (Int, Int -> Double -> Point)
pointsOf tolerance c = case Curve.cubics (Mm tolerance) c of
  Nothing -> Nothing
  Just (_, xs, ys) ->
    let n = Spline.count xs
        pointAt i w =
          let t =
                w - fromIntegral i
           in Vec.point (Spline.value (Spline.at xs i) t) (Spline.value (Spline.at ys i) t)
     in Just (n, pointAt)

apart :: Point -> Point -> Double
apart a b = let Mm d = Vec.distance a b in d
