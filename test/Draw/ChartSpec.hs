-- | Laws of charts.
module Draw.ChartSpec (spec) where

import Draw.Chart qualified as Chart
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "charts" $ do
  it "simplify a line within the tolerance (catches a cone that is too wide)" $
    forAll line $ \points ->
      let kept = Chart.simplified 0.05 points
       in counterexample (show kept) $
            cover 50 (length kept < length points) "some points are left out" $
              all (\p -> abs (Vec.y p - heightAt kept (Vec.x p)) <= 0.05 + 1e-9) points
  it "choose round steps that are far enough apart" $
    forAll ((,) <$> choose (1, 20) <*> choose (-6, 6)) $ \(apart, e) ->
      forAll (choose (1, 10)) $ \m ->
        let size = m * 10 ** e :: Double
            step = Chart.stepFor apart 100 size
            distance = step * 100 / size
         in counterexample (show step) (distance >= apart * 0.999 && distance <= apart * 2.6)

-- | Points from left to right, nearly on a line or not.
line :: Gen [Point]
line = do
  count <- choose (2, 60 :: Int)
  noise <- elements [0.01, 0.05, 0.2, 2]
  slope <- choose (-1, 1)
  ys <- vectorOf count (choose (-noise, noise))
  pure [Vec.point x (slope * x + y) | (x, y) <- zip [0, 0.2 ..] ys]

-- | Height of a line at a horizontal position.
heightAt :: [Point] -> Double -> Double
heightAt points x = case points of
  p : q : more
    | x <= Vec.x q || null more ->
      Vec.y p + (Vec.y q - Vec.y p) * (x - Vec.x p) / (Vec.x q - Vec.x p)
    | otherwise -> heightAt (q : more) x
  [p] -> Vec.y p
  [] -> 0
