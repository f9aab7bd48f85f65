-- | Laws of the area that closed outlines fill.
module Drawing.FillingSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..))
import Data.List (foldl')
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing)
import Drawing.Drawing (Entity (..), PathPart (..), Shape (..))
import Drawing.Filling qualified as Filling
import Drawing.Outline (DrawnPart (..), Outline (..))
import Drawing.PathPart qualified as PathPart
import Geometry.Carrier (Circle (..), Sense (..))
import Geometry.Polyarc (Ends (Closed), Polyarc (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it
    "a point is filled where the outlines wind around it in one sense more often (catches outlines \
    \of one sense that make holes)"
    $ property $
      forAll (vectorOf 5 (elements [Clockwise, CounterClockwise])) $ \senses ->
        forAll (sublistOf places) $ \chosen ->
          let -- Circles within one another, and others beside them, which cross their neighbours in
              -- the same sense.
              nested = [circle (0, 0) (10 * k) s | (k, s) <- zip [1 ..] senses]
              beside = [circle p 7 Clockwise | p <- chosen]
              outlines = nested <> beside
           in case Filling.filled outlines of
                Nothing -> counterexample "crossings" False
                Just kept ->
                  conjoin
                    [ counterexample (show p) $
                        isFilled kept (uncurry Vec.point p) === (windingAt outlines p /= 0)
                      | p <- [(5, 1), (15, 1), (25, 1), (35, 1), (45, 1), (55, 1)] <> places
                    ]
  it "outlines that cross in opposite senses, or within an area, are refused" $ do
    let refused = isNothing . Filling.filled
    refused [circle (0, 0) 5 Clockwise, circle (6, 0) 5 CounterClockwise] `shouldBe` True
    refused [circle (0, 0) 5 Clockwise, circle (6, 0) 5 Clockwise] `shouldBe` False
    refused
      [ circle (0, 0) 50 Clockwise,
        circle (0, 0) 5 CounterClockwise,
        circle (6, 0) 5 CounterClockwise
      ]
      `shouldBe` True
    refused
      [circle (0, 0) 50 Clockwise, circle (0, 0) 5 Clockwise, circle (6, 0) 5 Clockwise]
      `shouldBe` False
    map snd <$> Filling.filled [circle (0, 0) 50 Clockwise, circle (0, 0) 5 CounterClockwise]
      `shouldBe` Just [0, 1]
  where
    places = [(x, y) | x <- [80, 92, 104, 130], y <- [0, 11 :: Double]]

-- | True for a point that the kept outlines fill by their depths.
isFilled :: [(Outline, Int)] -> Vec.Point -> Bool
isFilled kept p = foldl' level False [0 .. maximum (0 : map snd kept)]
  where
    level inside k
      | not (or [WindingNumber.encloses (polyarc o) p | (o, d) <- kept, d == k]) = inside
      | otherwise = even k

-- | The winding number of all outlines about a point.
windingAt :: [Outline] -> (Double, Double) -> Int
windingAt outlines (x, y) =
  sum [WindingNumber.about (Vec.point x y) (segmentsOf (polyarc o)) | o <- outlines]
  where
    segmentsOf (Polyarc _ ss) = ss

polyarc :: Outline -> Polyarc
polyarc o = Polyarc Closed (NonEmpty.fromList (concatMap along (parts o)))
  where
    along = NonEmpty.toList . PathPart.segments . part

-- | A circle in a sense.
circle :: (Double, Double) -> Double -> Sense -> Outline
circle (x, y) r sense = Outline Closed (pure (DrawnPart entity whole))
  where
    entity = Entity 1 "CIRCLE" "" [] [] (Path Closed (pure whole))
    whole =
      Plain
        (Segment.fullCircle sense (Circle (Vec.point x y) (Mm r)) (Vec.point (x + r) y))
