-- | Drawings of whole programs, read back from their SVG documents.
module Draw.PlotSpec (spec) where

import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Read
import Plotted (drawing, withProgram)
import SvgText qualified
import Test.Hspec

spec :: Spec
spec = describe "drawings" $ do
  it "sweep the diameter of the cutter along its path" $ do
    svg <- drawing ["examples/flange.part"]
    SvgText.attributes "stroke-width" (SvgText.layer "swept" svg) `shouldBe` ["20"]
    SvgText.attributes "stroke-linecap" (SvgText.layer "swept" svg) `shouldBe` ["round"]
    SvgText.attributes "d" (SvgText.layer "swept" svg)
      `shouldBe` take 1 (SvgText.attributes "d" (SvgText.layer "path" svg))
  it "sweep the leads too, but not the traverses" $ do
    svg <- drawing ["examples/cnc/cover.part"]
    let leads = SvgText.layer "swept-leads" svg
    SvgText.attributes "stroke-width" leads `shouldBe` ["8"]
    -- Two quarter circles: one to the contour and one away from it.
    map (Text.count "A") (SvgText.attributes "d" leads) `shouldBe` [2]
    map (Text.count "L") (SvgText.attributes "d" leads) `shouldBe` [0]
  it "number the nodes of the last pass only" $ do
    svg <- drawing ["examples/cnc/cover.part"]
    length (filter (== "0") (SvgText.texts (SvgText.layer "labels" svg))) `shouldBe` 1
  describe "name the tools in the title" $ do
    it "with their sizes, feeds and times (catches the feed of one tool at all)" $ do
      svg <- drawing ["examples/cnc/bearing.part"]
      let title = SvgText.texts (SvgText.layer "title" svg)
      filter ("T" `Text.isPrefixOf`) title
        `shouldBe` [ "T1 cutter Ø 12 mm, 320 mm/min, 19 min 07 s",
                     "T2 cutter Ø 16 mm, 180 mm/min, 49 s",
                     "T3 drill Ø 6.8 mm, 110 mm/min, 29 s"
                   ]
      title `shouldContain` ["scale 1:1 · A4 · machining 20 min 25 s"]
    it "in inches if the program is in inches (catches millimetres in its title)" $ do
      svg <- drawing ["examples/cnc/bore-inches.part"]
      let title = SvgText.texts (SvgText.layer "title" svg)
      filter (" mm" `Text.isInfixOf`) title `shouldBe` []
      filter ("in/" `Text.isInfixOf`) title `shouldSatisfy` (not . null)
  describe "choose the paper" $ do
    it "in landscape, if a larger scale does not fit upright" $ do
      svg <- drawing ["examples/flange.part"]
      pageOf svg `shouldBe` ["297mm", "210mm"]
    it "upright, if a larger scale fits so (catches a page that is always in landscape)" $
      withProgram (plate 150 240) $ \file -> do
        svg <- drawing [file]
        pageOf svg `shouldBe` ["210mm", "297mm"]
        scaleOf svg `shouldBe` "1:1"
    it "of the format that is asked for" $
      withProgram (plate 240 150) $ \file -> do
        sizes <- traverse (\f -> pageOf <$> drawing [file, "--sheet", f]) ["a3", "a2", "a1", "a0"]
        sizes
          `shouldBe` [ ["420mm", "297mm"],
                       ["594mm", "420mm"],
                       ["841mm", "594mm"],
                       ["1189mm", "841mm"]
                     ]
    it "with the largest standard scale that fits (catches a page that is half empty)" $ do
      scales <-
        traverse
          (\(w, h) -> withProgram (plate w h) (fmap scaleOf . drawing . pure))
          [(240, 130), (110, 60), (270, 160), (20, 10), (2000, 1000)]
      scales `shouldBe` ["1:1", "2:1", "1:2", "10:1", "1:10"]
  it "mirror a turned part in the axis of the spindle" $ do
    svg <- drawing ["examples/cnc/shaft-stepped.part"]
    -- The profile begins on the same height above the axis as its mirror image lies below it.
    let heights name = concatMap heightOf (SvgText.attributes "d" (SvgText.layer name svg))
        heightOf p = [number y | y : _ <- [drop 1 (Text.split (`elem` [' ', 'L', 'A']) p)]]
    case (heights "contours", heights "mirrored-half") of
      (above : _, below@(image : _)) ->
        above + image `shouldSatisfy` near (2 * last below)
      _ -> expectationFailure "a layer is missing"
  it "have no mirrored half for a milled part" $ do
    svg <- drawing ["examples/flange.part"]
    SvgText.layer "mirrored-half" svg `shouldBe` ""

near :: Double -> Double -> Bool
near a b = abs (a - b) < 0.03

number :: Text -> Double
number = either error fst . Read.signed Read.double

-- | A rectangular plate of a width and a height in mm, without machining.
plate :: Int -> Int -> Text
plate w h =
  Text.unlines
    [ "part p",
      "from (0, 0)",
      "contour c closed { (0, 0) (0, " <> number' h <> ") (" <> number' w <> ", " <> number' h
        <> ") ("
        <> number' w
        <> ", 0) }"
    ]
  where
    number' = Text.pack . show

-- | Width and height of a drawing.
pageOf :: Text -> [Text]
pageOf svg = concatMap (\name -> take 1 (SvgText.attributes name svg)) ["width", "height"]

-- | Scale of a drawing in its title block.
scaleOf :: Text -> Text
scaleOf svg = case mapMaybe (Text.stripPrefix "scale ") (SvgText.texts svg) of
  words' : _ -> Text.takeWhile (/= ' ') words'
  [] -> ""
