-- | Velocities at the two ends of a path.
module Pulse.FramePathSpec
  ( spec,
  )
where

import Pulse.FramePath (FramePath (..), velocities)
import Pulse.Steps (Pulses5 (..))
import Test.Hspec

spec :: Spec
spec = describe "the velocities at the ends of a path" $ do
  it "are a line's increments" $
    velocities (Line (Pulses5 7 0 (-2) 5 (-1)))
      `shouldBe` ([7, 0, -2, 5, -1], [7, 0, -2, 5, -1])
  it "are tangents of an arc, as long as the arc (catches a wrong sense)" $ do
    velocities (Arc False (8, 6) (-6, 8)) `isNearly` ([-6, 8, 0, 0, 0], [-8, -6, 0, 0, 0])
    velocities (Arc True (-6, 8) (8, 6)) `isNearly` ([8, 6, 0, 0, 0], [6, -8, 0, 0, 0])
  it "of a full circle are the same at both ends" $
    let (a, b) = velocities (Arc True (10, 0) (10, 0)) in a `shouldBe` b
  where
    -- The arcs are quarters, whose length is π/2 times the radius.
    isNearly :: ([Double], [Double]) -> ([Double], [Double]) -> Expectation
    isNearly (a, b) (c, d) = do
      map rounded a `shouldBe` map (rounded . (* (pi / 2))) c
      map rounded b `shouldBe` map (rounded . (* (pi / 2))) d
    rounded v = round (1e9 * v) :: Int
