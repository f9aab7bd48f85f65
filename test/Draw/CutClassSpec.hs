-- | Classes of cuts in drawings and their legends.
module Draw.CutClassSpec (spec) where

import Data.List (nub)
import Data.Text (Text)
import Data.Text qualified as Text
import Plotted (drawingOf)
import SvgText qualified
import Test.Hspec

spec :: Spec
spec = describe "classes of cuts" $ do
  it "are the depths that occur, the deepest at each place (catches a depth that is cut away)" $ do
    svg <- drawingOf ["--by", "depth"] plates
    legendOf ["z −2", "z −5", "z −2.5"] svg `shouldBe` ["z −2", "z −5"]
    length (pensOf svg) `shouldBe` 2
  it "are the tools that cut, with their sizes" $ do
    svg <- drawingOf ["--by", "tool"] plates
    legendOf ["T1 cutter Ø 6", "T2 cutter Ø 8"] svg
      `shouldBe` ["T1 cutter Ø 6", "T2 cutter Ø 8"]
  it "are the feeds, also of single elements (catches a cut that has one feed)" $ do
    svg <- drawingOf ["--by", "feed"] plates
    legendOf ["100 mm/min", "50 mm/min"] svg `shouldBe` ["50 mm/min", "100 mm/min"]
    length (pensOf svg) `shouldBe` 2
  it "differ in colour and in dashes (catches classes that a printer makes equal)" $ do
    svg <- drawingOf ["--by", "depth"] stairs
    let pens = pensOf svg
    length pens `shouldBe` 6
    length (nub (map fst pens)) `shouldBe` 6
    length (nub (map snd pens)) `shouldBe` 6
  it "have the pens of the legend" $ do
    svg <- drawingOf ["--by", "depth"] stairs
    [pen | pen <- pensOf svg, pen `notElem` pensIn "title" svg] `shouldBe` []
  it "are ranges if there are many depths (catches a legend that is larger than the page)" $ do
    svg <- drawingOf ["--by", "depth"] stairs
    filter ("z " `Text.isPrefixOf`) (SvgText.texts (SvgText.layer "title" svg))
      `shouldBe` ["z −1 … −2", "z −3 … −4", "z −5 … −6", "z −7 … −8", "z −9 … −10", "z −11"]
  it "are in the unit of the program" $ do
    svg <- drawingOf ["--by", "feed"] ("part p" : "units in" : drop 1 plates')
    legendOf ["4 in/min"] svg `shouldBe` ["4 in/min"]
  it "are one if nothing is asked for" $ do
    svg <- drawingOf [] plates
    legendOf ["cutter path"] svg `shouldBe` ["cutter path"]
  where
    plates' =
      ["part p", "machine iso6983", "tool mill(diameter 0.25)", "feed 4", "tolerance 0.001"]
        <> ["from (-1, -1)", "contour c closed { (0, 0) (0, 2) (3, 2) (3, 0) }"]
        <> ["mill c outside { approach (-1, 1) retract (-1, 1) }"]

-- | Those of the texts of the legend and the title block that are in a list.
legendOf :: [Text] -> Text -> [Text]
legendOf wanted = filter (`elem` wanted) . SvgText.texts . SvgText.layer "title"

-- | Colours and dashes of the paths.
pensOf :: Text -> [(Text, Text)]
pensOf = nub . pensIn "path"

pensIn :: Text -> Text -> [(Text, Text)]
pensIn layer svg =
  [ (valueOf "stroke" p, valueOf "stroke-dasharray" p)
    | p <- drop 1 (Text.splitOn "<path" (SvgText.layer layer svg)),
      take 1 (SvgText.attributes "stroke-width" p) == ["0.3"]
  ]
  where
    valueOf name = Text.concat . take 1 . SvgText.attributes name

-- | Two plates, one of which is milled in two passes and has an element with a feed of its own.
plates :: [Text]
plates =
  [ "part p",
    "machine iso6983",
    "tool 1 mill(diameter 6 mm)",
    "feed 100 mm/min",
    "tolerance 0.02 mm",
    "clearance 5 mm",
    "from (-20, -20, 10)",
    "contour a closed { (0, 0) (0, 40) (40, 40) (40, 0) }",
    "contour b closed {",
    "  line((60, 0), (60, 40)) feed 50",
    "  line((60, 40), (100, 40))",
    "  line((100, 40), (100, 0))",
    "  line((100, 0), (60, 0))",
    "}",
    "mill a outside { start near (0, 20) depth 2 approach (-10, 20) rapid retract (-10, 20) }",
    "change 2 mill(diameter 8 mm)",
    "mill b outside {",
    "  start near (60, 20) depth 5 step 2.5 approach (50, 20) rapid retract (50, 20)",
    "}"
  ]

-- | Eleven grooves, each deeper than the one before.
stairs :: [Text]
stairs =
  [ "part p",
    "machine iso6983",
    "tool mill(diameter 6 mm)",
    "feed 100 mm/min",
    "tolerance 0.02 mm",
    "clearance 5 mm",
    "from (0, 0, 10)"
  ]
    <> concat
      [ [ "contour " <> name <> " open { (0, " <> y <> ") (50, " <> y <> ") }",
          "mill " <> name <> " on { depth " <> depth <> " }"
        ]
        | k <- [1 .. 11 :: Int],
          let depth = Text.pack (show k)
              y = Text.pack (show (10 * k))
              name = "c" <> depth
      ]
