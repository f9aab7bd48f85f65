-- | The laws of labels.
module Draw.LabelSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..))
import Data.Text (Text)
import Draw.Label (PointLabel (PointLabel))
import Draw.Label qualified as Label
import Draw.Page qualified as Page
import Draw.Svg qualified as Svg
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck hiding (label, labels)

spec :: Spec
spec =
  describe "labels" $ do
    it "no two cover one another (catches a long one that is looked for only where it begins)" $
      property $
        forAll labels $ \ls ->
          let placed = map covered (settled ls)
           in cover
                50
                (length placed > 30)
                "many"
                ( and
                    [ not (BoundingBox.meets (BoundingBox.inflate (Mm 0.599) a) b)
                      | (k, a) <- zip [0 :: Int ..] placed,
                        (l, b) <- zip [0 ..] placed,
                        k < l
                    ]
                )
    it "none is left out where there is room (catches places that are taken twice)" $
      property $
        forAll (choose (1, 8)) $ \n ->
          length
            ( settled
                [ PointLabel "12345" (Vec.point (30 * fromIntegral k) 60) (Vec.vec 0 1) [2]
                  | k <- [1 .. n :: Int]
                ]
            )
            === n

settled :: [PointLabel] -> [(Point, Text)]
settled = Label.settle Page.field (BoxTree.index id' [])
  where
    id' = const (BoundingBox 0 0 0 0)

-- | So many on so little paper that they are in one another's way.
labels :: Gen [PointLabel]
labels = do
  n <- choose (20, 120)
  vectorOf
    n
    ( label
        <$> choose (0, 10 ^ (8 :: Int)) <*> choose (0, 6) <*> choose (30, 110) <*> choose (30, 90)
    )
  where
    label :: Int -> Double -> Double -> Double -> PointLabel
    label number a x y =
      PointLabel (Decimal.whole number) (Vec.point x y) (Vec.polar (Mm 1) (Rad a)) [1.2, 2, 3, 4]

-- | What a text covers about its middle.
covered :: (Point, Text) -> BoundingBox
covered (p, caption) = BoundingBox (Vec.x p - w) (Vec.y p - h) (Vec.x p + w) (Vec.y p + h)
  where
    w = max h (Svg.textWidth Label.size caption / 2)
    h = 0.36 * Label.size
