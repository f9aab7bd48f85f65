-- | Directions at the two ends of a path.
module Pulse.FramePathSpec
  ( spec,
  )
where

import Pulse.FramePath (FramePath (..), directions)
import Pulse.Steps (Pulses5 (..))
import Test.Hspec

spec :: Spec
spec = describe "the directions at the ends of a path" $ do
  it "are those of a line's increments" $
    directions (Line (Pulses5 7 0 (-2) 5 (-1)))
      `shouldBe` (Pulses5 1 0 (-1) 1 (-1), Pulses5 1 0 (-1) 1 (-1))
  it "are those of the tangents of an arc (catches a wrong sense)" $ do
    directions (Arc False (8, 6) (-6, 8)) `shouldBe` (both (-1) 1, both (-1) (-1))
    directions (Arc True (-6, 8) (8, 6)) `shouldBe` (both 1 1, both 1 (-1))
  it "include an axis that is about to turn back, or that has just come to rest" $ do
    directions (Arc False (10, 0) (0, 10)) `shouldBe` (both (-1) 1, both (-1) 1)
    directions (Arc True (0, 10) (10, 0)) `shouldBe` (both 1 (-1), both 1 (-1))
    directions (Arc False (10, 0) (10, 0)) `shouldBe` (both (-1) 1, both 1 1)
  where
    both x y = Pulses5 x y 0 0 0
