-- | Laws of the placement of labels.
module Draw.LabelSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..))
import Data.Text (Text)
import Draw.Label (PointLabel (PointLabel))
import Draw.Label qualified as Label
import Draw.Page (Area (Area))
import Draw.Svg (TextStyle (TextStyle))
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
    it "do not cover each other (catches a long label that is known in one square of paper only)" $
      property $
        forAll labels $ \ls ->
          let placed = map covered (placements ls)
           in cover
                50
                (length placed > 30)
                "more than 30 labels"
                ( and
                    [ not (BoundingBox.meets (BoundingBox.inflate (Mm 0.599) a) b)
                      | (k, a) <- zip [0 :: Int ..] placed,
                        (l, b) <- zip [0 ..] placed,
                        k < l
                    ]
                )
    it "are all placed if there is room (catches a position that counts as taken without a label)" $
      property $
        forAll (choose (1, 8)) $ \n ->
          length
            ( placements
                [ PointLabel "12345" (Vec.point (30 * fromIntegral k) 60) (Vec.vec 0 1) [2] letters
                  | k <- [1 .. n :: Int]
                ]
            )
            === n

-- | Centres and texts of the labels that are placed on an empty drawing.
placements :: [PointLabel] -> [(Point, Text)]
placements given =
  [ (p, Label.caption label)
    | (p, label) <- Label.place (Area 10 10 287 184) (BoxTree.index id' []) given
  ]
  where
    id' = const (BoundingBox 0 0 0 0)

-- | Labels that are so close together that not all of them have room.
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
      PointLabel
        (Decimal.whole number)
        (Vec.point x y)
        (Vec.polar (Mm 1) (Rad a))
        [1.2, 2, 3, 4]
        letters

-- | Style of all labels.
letters :: TextStyle
letters = TextStyle {Svg.size = Label.size, Svg.ink = "black", Svg.bold = False}

-- | Box that the text of a label covers, about its centre.
covered :: (Point, Text) -> BoundingBox
covered (p, caption) = BoundingBox (Vec.x p - w) (Vec.y p - h) (Vec.x p + w) (Vec.y p + h)
  where
    w = max h (Svg.textWidth Label.size caption / 2)
    h = 0.36 * Label.size
