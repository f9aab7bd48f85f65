-- | Meetings of two segments, one pair at a time.
module Offset.SegmentIntersectionSpec (spec) where

import Control.Monad.ST (runST)
import Data.List (sort)
import Data.Primitive.MutVar (modifyMutVar', newMutVar, readMutVar)
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Offset.SegmentIntersection (Visitor (..))
import Offset.SegmentIntersection qualified as SegmentIntersection
import Test.Hspec
import Test.QuickCheck

-- | A report to the visitor.
data Meeting = Crosses Double Double Double | Rests Int | Touches Double Double
  deriving stock (Eq, Ord, Show)

spec :: Spec
spec = describe "two segments" $ do
  it "that cross, do so at one place, with the sign of the side" $
    met (0, 0, 4, 0, 0) (1, -1, 1, 1, 0) `shouldBe` [Crosses 1 0 1]
  it "that cross in the other direction" $
    met (0, 0, 4, 0, 0) (1, 1, 1, -1, 0) `shouldBe` [Crosses 1 0 (-1)]
  it "that are apart, do not meet" $
    met (0, 0, 4, 0, 0) (5, -1, 5, 1, 0) `shouldBe` []
  it "of which one ends on the other, rest there" $
    met (0, 0, 4, 0, 0) (1, 0, 1, 1, 0) `shouldBe` [Rests 2]
  it "along one another rest with the ends that lie on the other" $
    met (0, 0, 4, 0, 0) (6, 0, 2, 0, 0) `shouldBe` [Rests 1, Rests 3]
  it "a line and half a circle, twice" $
    met (0, -3, 0, 3, 0) (1, -1, 1, 1, 1) `shouldBe` []
  it "a line through half a circle" $
    map rough (met (1.5, -3, 1.5, 3, 0) (1, -1, 1, 1, 1))
      `shouldBe` sort [Crosses 1.5 (-0.866) (-1), Crosses 1.5 0.866 1]
  it "a line that touches half a circle" $
    met (2, -3, 2, 3, 0) (1, -1, 1, 1, 1) `shouldBe` [Touches 2 0]
  it "two circles in two points" $
    map rough (met (0, -1, 0, 1, 1) (1, 1, 1, -1, 1))
      `shouldBe` sort [Crosses 0.5 (-0.866) (-1), Crosses 0.5 0.866 1]
  it "two circles that touch" $
    met (0, -1, 0, 1, 1) (2, 1, 2, -1, 1) `shouldBe` [Touches 1 0]
  it
    "an arc that is flatter than anything, crossed by a line (catches a centre that has no digits)"
    $ property . forAll (elements [1e-3, 1e-6, 1e-9, 1e-11]) $ \b ->
      forAll (choose (0.1, 9.9)) $ \x ->
        case met (x, -1, x, 1, 0) (0, 0, 10, 0, b) of
          [Crosses px py turn] ->
            counterexample
              (show (px, py))
              (px == x && abs (py + 2 * b * x * (10 - x) / 10) < 1e-5 * b + 1e-14 && turn < 0)
          other -> counterexample (show other) False
  it
    "an arc that is flatter than anything, crossed near its end (catches a side of the chord that \
    \rounding decides)"
    $ length (met (39.99999, 31, 39.99999, 29, 0) (40, 30, 30, 30, 1e-10)) `shouldBe` 1
  describe "a part of an arc (catches half a turn without digits)" $ do
    it "of half a circle is half a circle" $
      ClosedPolyarcs.partialBulge (pair (0, 0, 0, 0, 0) (1, -1, 1, 1, 1)) 2 1 (-1) 1 1 `shouldBe` 1
    it "of any arc from end to end has its bulge" $
      property . forAll (choose (-1, 1)) $ \b -> forAll (choose (0.1, 10)) $ \l ->
        let c =
              pair (0, 0, 0, 0, 0) (0, 0, l, l / 2, b)
         in counterexample
              (show (ClosedPolyarcs.partialBulge c 2 0 0 l (l / 2)))
              (abs (ClosedPolyarcs.partialBulge c 2 0 0 l (l / 2) - b) < 1e-12)
  where
    rough t = case t of
      Crosses x y s -> Crosses (round3 x) (round3 y) s
      Rests k -> Rests k
      Touches x y -> Touches (round3 x) (round3 y)
    round3 :: Double -> Double
    round3 v = fromIntegral (round (v * 1000) :: Int) / 1000

type Ends = (Double, Double, Double, Double, Double)

-- | Two disjoint segments, numbered 0 and 2.
pair :: Ends -> Ends -> ClosedPolyarcs
pair a b = ClosedPolyarcs.fromSeparateSegments [a, b]

met :: Ends -> Ends -> [Meeting]
met a b = sort $
  runST $ do
    meetings <- newMutVar []
    let record t = modifyMutVar' meetings (t :)
    SegmentIntersection.meet
      1e-13
      (pair a b)
      Visitor
        { crossing = \_ _ _ _ x y turn -> record (Crosses x y (signum turn)),
          resting = \_ k -> record (Rests k),
          touching = \_ _ x y -> record (Touches x y)
        }
      0
      2
    readMutVar meetings
