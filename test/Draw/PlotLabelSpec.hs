-- | Labels of drawings.
module Draw.PlotLabelSpec (spec) where

import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Read
import Plotted (drawingOf)
import SvgText qualified
import Test.Hspec

spec :: Spec
spec = describe "labels" $ do
  it "say how deep a descent is, with its symbol in the legend" $ do
    svg <- drawingOf [] (header <> ["rapid (0, 0, 1)", "move (20, 0, -3)", "move (40, 0, -3)"])
    labelsOf svg `shouldBe` ["z −3"]
    SvgText.texts (SvgText.layer "title" svg) `shouldContain` ["ramp"]
    SvgText.texts (SvgText.layer "title" svg) `shouldNotContain` ["plunge"]
  it "give depths in the unit of the program" $ do
    svg <-
      drawingOf
        []
        ["part p", "units in", "feed 5", "from (0, 0, 1)", "move (0, 0, -0.125)", "move (2, 0)"]
    labelsOf svg `shouldBe` ["z −0.125"]
  it "give the reason of rest material (catches red areas without a word)" $ do
    svg <- drawingOf [] (header <> [square, "mill a inside { depth 3 rest allowed }"])
    filter ("inner" `Text.isInfixOf`) (labelsOf svg)
      `shouldBe` replicate 4 "inner corner, cutter r 5"
  it "say which radius is too small for the cutter" $ do
    svg <-
      drawingOf
        []
        ( header
            <> [ "contour a closed {",
                 "  line((0, 0), (40, 0)) fillet -3",
                 "  line((40, 0), (40, 40)) fillet -3",
                 "  line((40, 40), (0, 40)) fillet -3",
                 "  line((0, 40), (0, 0)) fillet -3",
                 "}",
                 "mill a inside { depth 3 rest allowed }"
               ]
        )
    filter ("reach" `Text.isInfixOf`) (labelsOf svg)
      `shouldBe` replicate 4 "r 5 does not reach r 3"
  it "are few where nodes crowd (catches numbers one over the other)" $ do
    svg <- drawingOf [] (header <> [comb, "mill a on { depth 3 }"])
    -- A node with a number has the larger dot.
    let dots =
          [ (x, y)
            | c <- drop 1 (Text.splitOn "<circle" (SvgText.layer "nodes" svg)),
              SvgText.attributes "r" c == ["0.6"],
              [x] <- [map number (SvgText.attributes "cx" c)],
              [y] <- [map number (SvgText.attributes "cy" c)]
          ]
    length dots `shouldSatisfy` (> 10)
    zipWith distance dots (drop 1 dots) `shouldSatisfy` all (> 3.4)
  where
    distance (x, y) (u, v) = sqrt ((x - u) * (x - u) + (y - v) * (y - v))

labelsOf :: Text -> [Text]
labelsOf = SvgText.texts . SvgText.layer "labels"

number :: Text -> Double
number = either error fst . Read.signed Read.double

header :: [Text]
header =
  [ "part p",
    "machine iso6983",
    "tool mill(diameter 10 mm)",
    "feed 100 mm/min",
    "tolerance 0.02 mm",
    "clearance 5 mm",
    "from (20, 20, 2)"
  ]

square :: Text
square = "contour a closed { (0, 0) (0, 40) (40, 40) (40, 0) }"

-- | Open contour of many short steps.
comb :: Text
comb =
  "contour a open {"
    <> Text.concat [" (" <> text (2 * k) <> ", " <> text (k `mod` 2) <> ")" | k <- [0 .. 50]]
    <> " }"
  where
    text k = Text.pack (show (k :: Int))
