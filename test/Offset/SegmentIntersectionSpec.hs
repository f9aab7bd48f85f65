-- | Examples and laws of the intersections of two segments.
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
data Meeting
  = -- | x, y, and the side to which the second segment crosses: 1 left, −1 right
    Crosses Double Double Double
  | -- | the vertex that lies on the other segment: 0 and 1 are the ends of the first segment, 2 and
    -- 3 those of the second
    Rests Int
  | -- | x and y of the point of contact
    Touches Double Double
  deriving stock (Eq, Ord, Show)

spec :: Spec
spec = describe "two segments" $ do
  it "that cross are reported with the point and the side to which the second crosses" $
    met (0, 0, 4, 0, 0) (1, -1, 1, 1, 0) `shouldBe` [Crosses 1 0 1]
  it "that cross in the opposite direction are reported with the opposite side" $
    met (0, 0, 4, 0, 0) (1, 1, 1, -1, 0) `shouldBe` [Crosses 1 0 (-1)]
  it "that are apart are not reported" $
    met (0, 0, 4, 0, 0) (5, -1, 5, 1, 0) `shouldBe` []
  it "of which one ends on the other are reported with this end" $
    met (0, 0, 4, 0, 0) (1, 0, 1, 1, 0) `shouldBe` [Rests 2]
  it "that partly coincide are reported with the ends that lie on the other" $
    met (0, 0, 4, 0, 0) (6, 0, 2, 0, 0) `shouldBe` [Rests 1, Rests 3]
  it "do not intersect where a line meets only the missing half of a circle" $
    met (0, -3, 0, 3, 0) (1, -1, 1, 1, 1) `shouldBe` []
  it "intersect twice where a line passes through half a circle" $
    map rough (met (1.5, -3, 1.5, 3, 0) (1, -1, 1, 1, 1))
      `shouldBe` sort [Crosses 1.5 (-0.866) (-1), Crosses 1.5 0.866 1]
  it "touch where a line is tangent to half a circle" $
    met (2, -3, 2, 3, 0) (1, -1, 1, 1, 1) `shouldBe` [Touches 2 0]
  it "intersect twice where two half circles overlap" $
    map rough (met (0, -1, 0, 1, 1) (1, 1, 1, -1, 1))
      `shouldBe` sort [Crosses 0.5 (-0.866) (-1), Crosses 0.5 0.866 1]
  it "touch where two half circles touch" $
    met (0, -1, 0, 1, 1) (2, 1, 2, -1, 1) `shouldBe` [Touches 1 0]
  it
    "cross where a line crosses a nearly straight arc (catches a centre without exact digits)"
    $ property . forAll (elements [1e-3, 1e-6, 1e-9, 1e-11]) $ \b ->
      forAll (choose (0.1, 9.9)) $ \x ->
        case met (x, -1, x, 1, 0) (0, 0, 10, 0, b) of
          [Crosses px py to] ->
            counterexample
              (show (px, py))
              (px == x && abs (py + 2 * b * x * (10 - x) / 10) < 1e-5 * b + 1e-14 && to < 0)
          other -> counterexample (show other) False
  it
    "cross where a line crosses a nearly straight arc near its end (catches a side of the chord \
    \that rounding decides)"
    $ length (met (39.99999, 31, 39.99999, 29, 0) (40, 30, 30, 30, 1e-10)) `shouldBe` 1
  describe "the bulge of a part of an arc (catches a half circle without exact digits)" $ do
    it "of half a circle from end to end is 1" $
      ClosedPolyarcs.partialBulge (pair (0, 0, 0, 0, 0) (1, -1, 1, 1, 1)) 2 1 (-1) 1 1 `shouldBe` 1
    it "of any arc from end to end is that of the arc" $
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

-- | A segment: x and y of its start, x and y of its end, and its bulge.
type Ends = (Double, Double, Double, Double, Double)

-- | Two disjoint segments, numbered 0 and 2.
pair :: Ends -> Ends -> ClosedPolyarcs
pair a b = ClosedPolyarcs.fromSeparateSegments [a, b]

-- | The reports on two segments, sorted.
met :: Ends -> Ends -> [Meeting]
met a b = sort $
  runST $ do
    meetings <- newMutVar []
    let record t = modifyMutVar' meetings (t :)
    SegmentIntersection.meet
      1e-13
      (pair a b)
      Visitor
        { crossing = \_ _ _ _ x y cross -> record (Crosses x y (signum cross)),
          resting = \_ k -> record (Rests k),
          touching = \_ _ x y -> record (Touches x y)
        }
      0
      2
    readMutVar meetings
