-- | Dimension lines of the sizes that programs assert.
module Draw.DimensionLineSpec (spec) where

import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Read
import Plotted (drawingOf)
import SvgText qualified
import Test.Hspec

spec :: Spec
spec = describe "dimension lines" $ do
  it "show the distances and radii that the program asserts, with the asserted values" $ do
    svg <-
      plate
        [ "assert distance(a, b) = 50 within 0.001",
          "assert 8 = radius_of(c) within 0.001"
        ]
    textsOf svg `shouldBe` ["50", "R 8"]
  it "are as long as the distance at its scale, 2:1 (catches the scale left out)" $ do
    svg <- plate ["assert distance(a, b) = 50"]
    -- The last line is the dimension line itself.
    let lines' = Text.concat (take 1 (SvgText.attributes "d" (layerOf svg)))
    map numbers (take 1 (reverse (drop 1 (Text.splitOn "M" lines'))))
      `shouldSatisfy` all (\ends -> length ends == 4 && abs (lengthOf ends - 100) < 0.02)
  it "have arrows at both ends" $ do
    svg <- plate ["assert distance(a, b) = 50"]
    Text.count "Z\"" (layerOf svg) `shouldBe` 2
  it "are in inches if the program is in inches" $ do
    svg <-
      drawingOf
        []
        [ "part p",
          "units in",
          "from (0, 0)",
          "contour k closed { (0, 0) (0, 2) (3, 2) (3, 0) }",
          "assert distance((0, 0), (3, 0)) = 3"
        ]
    textsOf svg `shouldBe` ["3"]
  it "are drawn once for an assertion in a loop" $ do
    svg <- plate ["for i in 1..3 { assert distance(a, b) = 50 }"]
    textsOf svg `shouldBe` ["50"]
  it "are not drawn for limits, for computed sizes and for circles that are not drawn" $ do
    svg <-
      plate
        [ "assert distance(a, b) < 60",
          "assert distance(a, b) + 1 = 51",
          "assert radius_of(circle(a, 3)) = 3"
        ]
    layerOf svg `shouldBe` ""
  where
    layerOf = SvgText.layer "dimensions"
    textsOf = SvgText.texts . layerOf
    lengthOf ends = case ends of
      [x, y, u, v] -> sqrt ((x - u) * (x - u) + (y - v) * (y - v))
      _ -> 0

-- | Drawing of a plate between two points, with an arc and with assertions.
plate :: [Text] -> IO Text
plate assertions =
  drawingOf
    []
    ( [ "part p",
        "from (0, 0)",
        "let a = (0, 0)",
        "let b = (50, 0)",
        "let c = circle((25, 30), 8)",
        "contour k closed { b tangent ccw c tangent a }"
      ]
        <> assertions
    )

-- | Numbers of path data without arcs.
numbers :: Text -> [Double]
numbers =
  map (either error fst . Read.signed Read.double)
    . filter (/= "")
    . Text.split (`elem` (" LM" :: String))
