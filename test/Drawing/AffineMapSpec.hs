module Drawing.AffineMapSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Drawing.AffineMap qualified as AffineMap
import Drawing.Drawing
import Drawing.ShapePoint (isOn, shapeAt)
import Generate.DrawingShape qualified as Generate
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "affine maps of drawings" $ do
  it "map every point of a shape to the shape's image (catches an arc kept under a stretch)" $
    withMaxSuccess 2000 $
      forAll ((,,) <$> Generate.affineMap <*> Generate.shape <*> choose (0, 1)) $ \(m, s, t) ->
        let image = AffineMap.shape m s
            p = AffineMap.point m (shapeAt t s)
         in counterexample (show (image, p, shapeAt t image)) (isOn t p image)
  it "keep arcs and circles under similarities (catches rounding errors that make an ellipse)" $
    forAll ((,) <$> Generate.similarity <*> Generate.shape) $ \(m, s) ->
      kinds (AffineMap.shape m s) === kinds s
  it "apply the second map after the first (catches the other order)" $
    forAll ((,,) <$> Generate.affineMap <*> Generate.affineMap <*> Generate.point) $ \(m, n, p) ->
      let q = AffineMap.point (m `AffineMap.after` n) p
          r = AffineMap.point m (AffineMap.point n p)
       in counterexample (show (q, r)) (Vec.distance q r <= Mm 1e-9)
  it "make an ellipse of a circle under a stretch, with exact semi-axes" $
    AffineMap.shape (AffineMap.scaling 3 0.5) (FullCircle (Circle (Vec.point 1 2) (Mm 4)))
      `shouldBe` FullEllipse (Ellipse (Vec.point 3 1) (Mm 12) (Mm 2) (Rad 0))
  it "mirror an arc" $
    AffineMap.shape (AffineMap.scaling (-1) 1) (Path Open (Plain quarter :| []))
      `shouldBe` Path
        Open
        ( Plain (Arc (Vec.point (-2) 0) (Vec.point 0 2) (Vec.point 0 0) (Rad (negate (pi / 2))))
            :| []
        )
  where
    quarter = Arc (Vec.point 2 0) (Vec.point 0 2) (Vec.point 0 0) (Rad (pi / 2))

-- | The kind of a shape and of its parts.
kinds :: Shape -> [String]
kinds s = case s of
  Path _ parts -> foldMap (pure . ofPiece) parts
  FullCircle _ -> ["circle"]
  FullEllipse _ -> ["ellipse"]
  Dot _ -> ["point"]
  where
    ofPiece part = case part of
      Plain Straight {} -> "line"
      Plain Arc {} -> "arc"
      EllipseArc {} -> "part of an ellipse"
      Bezier _ _ -> "Bézier curve"
      BSpline _ -> "spline"
