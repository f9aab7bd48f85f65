-- | The table of rest material.
module Cli.RestMaterialTableSpec (spec) where

import Base.Result qualified as Result
import Cli.RestMaterialTable qualified as RestMaterialTable
import Compile (Analysis (path))
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec

spec :: Spec
spec = do
  it
    "in a right-angled corner the area r²(1 − π/4) remains (catches an area on the wrong side of \
    \the cutter)"
    $ rows "mill window inside { approach (20, 3)  rest allowed  retract (20, 15) }"
      `shouldBe` [ [x, y, "1.931", "inner", "corner"]
                   | (x, y) <-
                       [ ("40.000", "0.000"),
                         ("40.000", "30.000"),
                         ("0.000", "30.000"),
                         ("0.000", "0.000")
                       ]
                 ]
  it
    "the largest cutter for a slot of 5 mm with an allowance of 0.5 mm has 4 mm (catches a \
    \diameter without the allowance)"
    $ map
      (take 3 . drop 3)
      ( rows
          "mill notched outside { approach (-20, 20) rapid  allowance 0.5  rest allowed  retract \
          \(-20, -20) rapid }"
      )
      `shouldBe` [["3.999", "mm", "narrow"]]
  it
    "no cutter reaches the corner between a line and a curve (catches a cutter that touches only \
    \the first arc of the curve)"
    $ map
      (\r -> (take 2 r, drop 3 r))
      (rows "mill wavy left { approach (-10, 20) rapid  rest allowed  retract (90, 40) rapid }")
      `shouldBe` [(["20.000", "0.000"], ["inner", "corner"])]
  it
    "no cutter reaches the corner at which a closed contour begins (catches a search that goes \
    \back along the contour instead of past its end)"
    $ map
      (\r -> (take 2 r, drop 3 r))
      ( rows
          "mill ridge outside { approach (-10, 20) rapid  rest allowed  retract (-10, 20) rapid }"
      )
      `shouldBe` [(["20.000", "0.000"], ["inner", "corner"])]
  it
    "the largest cutter for a hollow fits through its opening (catches an outer corner that is \
    \taken for an inner one)"
    $ map
      (drop 3)
      (rows "mill hollow left { approach (-10, 20) rapid  rest allowed  retract (60, 20) rapid }")
      `shouldBe` [["3.999", "mm", "narrow", "place,", "with", "the", "cutter's", "centre", "here"]]

-- | The words of the rows of the table.
rows :: Text -> [[Text]]
rows milling = case Result.output (Compile.analyse [] (LoadedProgram.fromText "p.part" text)) of
  Just found ->
    [Text.words l | t <- RestMaterialTable.tables (path found), l <- drop 3 (Text.lines t)]
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
          "contour notched closed { (0, 0) (0, 40) (40, 40) (40, 0) (25, 0) (25, 20) (20, 20) (20, \
          \0) }",
          "table crests { x y",
          "20 0",
          "40 10",
          "60 6",
          "80 12",
          "}",
          "curve crest = spline(crests)",
          "contour wavy open { line((0, 0), (20, 0)) crest }",
          "contour ridge closed { crest line((80, 12), (80, -20)) line((80, -20), (0, -20)) \
          \line((0, -20), (0, 0)) line((0, 0), (20, 0)) }",
          "contour hollow open { line((0, 0), (20, 0)) ccw circle((22, 0), 2) line((24, 0), (40, \
          \0)) }",
          milling
        ]
