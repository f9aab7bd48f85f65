module Drawing.ClampedSplineSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty (NonEmpty (..))
import Drawing.ClampedSpline qualified as ClampedSpline
import Drawing.Drawing
import Drawing.ShapePoint (pieceAt, splinePoint)
import Generate.DrawingShape qualified as Generate
import Geometry.Polyarc (Ends (..))
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "clamped splines" $ do
  it "keep the points of a spline with any knots (catches a control point of the wrong span)" $
    withMaxSuccess 2000 $
      forAll (loose `suchThat` isCurve) $ \(degree, knots, points, weights) ->
        forAll (choose (0, 1)) $ \t ->
          case ClampedSpline.fromKnots False degree knots points weights of
            Right (Path _ (BSpline s :| [])) ->
              let count = length points
                  u = knots !! degree + t * (knots !! count - knots !! degree)
                  p = splinePoint degree knots points weights u
                  q = pieceAt t (BSpline s)
               in counterexample (show (s, p, q)) (isClamped s && Vec.distance p q <= Mm 1e-7)
            other -> counterexample (show other) False
  it "close a periodic spline exactly" $
    case ClampedSpline.fromKnots True 2 [0 .. 8] (square <> take 2 square) Nothing of
      Right (Path ends (BSpline Spline {controls} :| [])) -> do
        ends `shouldBe` Closed
        controls
          `shouldBe` Vec.point 5 0
            :| map (uncurry Vec.point) [(10, 0), (10, 10), (0, 10), (0, 0), (5, 0)]
      other -> expectationFailure (show other)
  it "refuse numbers that make no spline" $
    [ refused (ClampedSpline.fromKnots False 3 [0, 0, 0, 0, 1, 1, 1, 1] (take 3 square) Nothing),
      refused (ClampedSpline.fromKnots False 3 [0, 0, 0, 1, 1, 1] square Nothing),
      refused (ClampedSpline.fromKnots False 3 [0, 0, 0, 0, 1, 1, 1, 0] square Nothing),
      refused (ClampedSpline.fromKnots False 3 [1, 1, 1, 1, 1, 1, 1, 1] square Nothing),
      refused (ClampedSpline.fromKnots False 3 clamped square (Just [1, 1, 0, 1])),
      refused (ClampedSpline.fromKnots False 3 clamped square (Just [1, 1, 1])),
      refused (ClampedSpline.fromKnots False 0 [0, 1, 2, 3, 4] square Nothing),
      refused (ClampedSpline.fromKnots False 1 [0, 0, 1, 1, 2, 2] square Nothing)
    ]
      `shouldBe` [ Just "it has too few control points",
                   Just "the count of its knots does not fit the count of its control points",
                   Just "its knots do not ascend",
                   Just "all its knots are equal",
                   Just "a weight is not positive",
                   Just "the count of its weights does not fit the count of its control points",
                   Just "its degree is not 1 to 20",
                   Just "it has a gap"
                 ]
  where
    square = map (uncurry Vec.point) [(0, 0), (10, 0), (10, 10), (0, 10)]
    clamped = [0, 0, 0, 0, 1, 1, 1, 1]
    refused = either Just (const Nothing)
    isCurve (degree, knots, points, _) = knots !! degree < knots !! length points
    isClamped Spline {degree, knots} =
      all (== head knots) (take (degree + 1) knots)
        && all (== last knots) (take (degree + 1) (reverse knots))
    -- knots that need not be clamped; none occurs more than the degree inside
    loose = do
      degree <- choose (1, 4)
      count <- choose (degree + 1, degree + 6)
      steps <- vectorOf (count + degree + 1) (elements [0.5, 1, 1.25])
      doubled <- if degree == 1 then pure [] else sublistOf [2, 4 .. count + degree]
      let lengths = zip [1 ..] steps
          knots = scanl1 (+) [if i `elem` doubled then 0 else step | (i, step) <- lengths]
      points <- vectorOf count Generate.point
      weights <- oneof [pure Nothing, Just <$> vectorOf count (choose (0.2, 5))]
      pure (degree, knots, points, weights)
