-- | Laws of the self-intersections of a polyarc.
module Geometry.SelfIntersectionSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust)
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.SelfIntersection qualified as SelfIntersection
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "a contour" $ do
  it
    "intersects itself where two segments meet that are not neighbours (catches bounding boxes \
    \without the sagitta, and a closing segment of an open contour)"
    $ property $
      forAll contour $ \c ->
        let found = SelfIntersection.firstSelfIntersection c
            meet = meetings c
         in checkCoverage
              . cover 20 (isJust found) "crosses"
              . cover 20 (null meet) "apart"
              . counterexample (show (found, take 3 meet))
              $ null meet || isJust found
  it "intersects itself nowhere else (catches neighbours that meet at their joint)" $
    property $
      forAll contour $ \c -> case SelfIntersection.firstSelfIntersection c of
        Just (i, j, p) ->
          counterexample
            (show (i, j, p))
            (i < j && all (\k -> Distance.toPoint p (segments c NonEmpty.!! k) <= Mm 1e-6) [i, j])
        Nothing -> property True
  it
    "of two lines intersects itself only if the second runs back along the first (catches a \
    \reversal that is taken for a corner)"
    $ property $
      forAll
        ( (,,,)
            <$> choose (-3, 3)
              <*> choose (0.01, 10)
              <*> choose (0.01, 10)
              <*> elements [0, 0.001, 0.05, 0.09, 0.11, 0.2, 1, 1.5, 1.6, 2, 3.1]
        )
        $ \(a, l, m, away) ->
          let q = Vec.point 300 (-20)
              p = Vec.shift (Vec.polar (Mm l) (Rad a)) q
              r = Vec.shift (Vec.polar (Mm m) (Rad (a + away))) q
           in isJust
                ( SelfIntersection.firstSelfIntersection
                    (Polyarc Open (Straight p q :| [Straight q r]))
                )
                === (away == 0)

-- | The pairs of segments, not neighbours, that meet, with the points at which they do.
meetings :: Polyarc -> [Point]
meetings (Polyarc ends ss) =
  [ p
    | (i, s) <- numbered,
      (j, other) <- drop (i + 2) numbered,
      not (ends == Closed && i == 0 && j == length ss - 1),
      p <- Distance.intersections s other
  ]
  where
    numbered = zip [0 ..] (NonEmpty.toList ss)

-- | Lines and arcs through points, most of which lie a little further to the right each time.
contour :: Gen Polyarc
contour = do
  n <- choose (3, 60)
  ps <-
    scanl (flip Vec.shift) (Vec.point 0 0)
      <$> vectorOf n (Vec.vec <$> choose (-0.1, 1) <*> choose (-1, 1))
  closed <- arbitrary
  let q = last ps
  ss <- mapM (uncurry bent) (zip ps (drop 1 ps) <> [(q, Vec.point 0 0) | closed])
  pure (Polyarc (if closed then Closed else Open) (NonEmpty.fromList ss))

-- | A line, or an arc with a sweep up to 254°.
bent :: Point -> Point -> Gen Segment
bent p q =
  Segment.fromBulge p q <$> frequency [(1, pure 0), (3, choose (-0.5, 0.5)), (1, choose (-2, 2))]
