-- | Objects of drawings.
module Draw.FromPartSpec (spec) where

import Data.Text (Text)
import Data.Text qualified as Text
import Plotted (drawing, drawingOf)
import SvgText qualified
import Test.Hspec

spec :: Spec
spec = do
  describe "contours are drawn" $ do
    it "only where they are milled (catches a contour that is drawn beside its images)" $ do
      svg <- drawingOf [] (copies [1, 2, 3] <> ["contour idle closed { (0, 0) (0, 4) (4, 4) }"])
      -- Three images, and the contour that nothing mills.
      contoursOf svg `shouldBe` 4
    it "at their own position, if they are milled there too" $ do
      svg <- drawingOf [] (copies [0, 1, 2, 3])
      contoursOf svg `shouldBe` 4
    it "if nothing mills them (catches a part without machining that has an empty drawing)" $ do
      svg <- drawingOf [] ["part p", "from (0, 0)", square]
      contoursOf svg `shouldBe` 1
  it "passes that differ in their depth are one path (catches a path for each pass)" $ do
    svg <- drawingOf [] (header <> [square, "mill a outside { depth 4 step 1 " <> stops <> " }"])
    Text.count "M" (Text.concat (take 1 (SvgText.attributes "d" (SvgText.layer "path" svg))))
      `shouldBe` 1
  it "a thousand holes are few elements (catches an element for each of them)" $ do
    svg <-
      drawingOf
        []
        ( take 2 header
            <> ["tool drill(diameter 2 mm)"]
            <> drop 3 header
            <> ["drill at grid((0, 0), (3, 0), 40, (0, 3), 25) depth 3"]
        )
    sum [Text.count "<path" (SvgText.layer l svg) | l <- ["material", "contours", "holes"]]
      `shouldBe` 4
    -- Per hole: its area, its contour, its mark, a move to it and the arrow of the move.
    Text.length svg `shouldSatisfy` (< 300 * 1000)
  it "drilled holes have marks at their centres" $ do
    svg <- drawing ["examples/cnc/cover.part"]
    -- Two lines for each of the four holes.
    Text.count "M" (Text.concat (SvgText.attributes "d" (SvgText.layer "holes" svg))) `shouldBe` 8
  where
    contoursOf svg =
      Text.count "M" (Text.concat (SvgText.attributes "d" (SvgText.layer "contours" svg)))

-- | A square that is milled in positions, each of which is turned by quarter turns.
copies :: [Int] -> [Text]
copies turns =
  header
    <> [square]
    <> [ "with rotated(" <> Text.pack (show (90 * k)) <> " deg) { mill a outside { depth 2 "
           <> stops
           <> " } }"
         | k <- turns
       ]

header :: [Text]
header =
  [ "part p",
    "machine iso6983",
    "tool mill(diameter 6 mm)",
    "feed 100 mm/min",
    "tolerance 0.02 mm",
    "clearance 5 mm",
    "from (0, 0, 10)"
  ]

square :: Text
square = "contour a closed { (40, -5) (40, 5) (50, 5) (50, -5) }"

stops :: Text
stops = "start near (50, 0) approach (60, 0) rapid retract (60, 0)"
