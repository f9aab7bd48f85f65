-- | The table of what a cutter leaves.
module Cli.RestTableSpec (spec) where

import Base.Result qualified as Result
import Cli.RestTable qualified as RestTable
import Compile (Analysis (path))
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Test.Hspec

spec :: Spec
spec = do
  it "a right corner keeps r²(1 − π/4) (catches an area on the wrong side of the cutter's edge)" $
    rows "mill window inside { approach (20, 3)  rest allowed  retract (20, 15) }"
      `shouldBe` [[x, y, "1.931", "inner", "corner"] | (x, y) <- [("40.000", "0.000"), ("40.000", "30.000"), ("0.000", "30.000"), ("0.000", "0.000")]]
  it "into a slot of 5 goes a cutter of 4 that leaves 0.5 (catches a diameter without what is left)" $
    map (take 3 . drop 3) (rows "mill notched outside { approach (-20, 20) rapid  allowance 0.5  rest allowed  retract (-20, -20) rapid }") `shouldBe` [["3.999", "mm", "narrow"]]

-- | The words of the table's rows.
rows :: Text -> [[Text]]
rows milling = case Result.output (Compile.analyse [] (Compile.alone "p.part" text)) of
  Just found -> [Text.words l | t <- RestTable.places (path found), l <- drop 3 (Text.lines t)]
  Nothing -> [["no path"]]
  where
    text =
      Text.unlines
        [ "part p",
          "tool mill(diameter 6 mm)",
          "feed 60 mm/min",
          "tolerance 0.02 mm",
          "from " <> if "inside" `Text.isInfixOf` milling then "(20, 15)" else "(-20, -20)",
          "contour window closed { (0, 0) (40, 0) (40, 30) (0, 30) }",
          "contour notched closed { (0, 0) (0, 40) (40, 40) (40, 0) (25, 0) (25, 20) (20, 20) (20, 0) }",
          milling
        ]
