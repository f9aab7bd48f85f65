-- | Drawings of whole programs, read back from their SVG documents.
module Draw.PlotSpec (spec) where

import Command (partc)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Read
import Test.Hspec

spec :: Spec
spec = describe "drawings" $ do
  it "sweep the diameter of the cutter along its path" $ do
    svg <- drawing "examples/flange.part"
    let sweeps = Text.splitOn "<path" (layerOf "swept" svg)
    map (attribute "stroke-width") (drop 1 sweeps) `shouldBe` ["20"]
    map (attribute "stroke-linecap") (drop 1 sweeps) `shouldBe` ["round"]
    attribute "d" (Text.concat (drop 1 sweeps)) `shouldBe` attribute "d" (layerOf "path" svg)
  it "number the nodes of the last pass only" $ do
    svg <- drawing "examples/cnc/cover.part"
    length (filter (== "0") (textsOf (layerOf "numbers" svg))) `shouldBe` 1
  it "name all tools in the title" $ do
    svg <- drawing "examples/cnc/bearing.part"
    textsOf (layerOf "title" svg) `shouldContain` ["cutter Ø 12, 16; drill Ø 6.8 mm"]
  it "mirror a turned part in the axis of the spindle" $ do
    svg <- drawing "examples/cnc/shaft-stepped.part"
    -- The profile begins on the same height above the axis as its mirror image lies below it.
    let heights name = [y | p <- drop 1 (Text.splitOn " d=\"M" (layerOf name svg)), y <- heightOf p]
        heightOf p = [number y | y : _ <- [drop 1 (Text.split (`elem` [' ', 'L', 'A']) p)]]
    case (heights "contours", heights "mirrored-half") of
      (above : _, below@(image : _)) ->
        above + image `shouldSatisfy` near (2 * last below)
      _ -> expectationFailure "a layer is missing"
  it "have no mirrored half for a milled part" $ do
    svg <- drawing "examples/flange.part"
    layerOf "mirrored-half" svg `shouldBe` ""

near :: Double -> Double -> Bool
near a b = abs (a - b) < 1.0e-3

number :: Text -> Double
number = either error fst . Read.signed Read.double

drawing :: FilePath -> IO Text
drawing program = do
  (_, svg, _) <- partc ["plot", program]
  pure (Text.pack svg)

-- | The content of the layer with a name; empty if there is none.
layerOf :: Text -> Text -> Text
layerOf name svg = fst (Text.breakOn "</g>" (behind ("id=\"" <> name <> "\"") svg))

-- | The value of the first attribute with a name.
attribute :: Text -> Text -> Text
attribute name = Text.takeWhile (/= '"') . behind (" " <> name <> "=\"")

textsOf :: Text -> [Text]
textsOf part =
  [ Text.takeWhile (/= '<') (Text.drop 1 (Text.dropWhile (/= '>') t))
    | t <- drop 1 (Text.splitOn "<text" part)
  ]

behind :: Text -> Text -> Text
behind key text = Text.drop (Text.length key) (snd (Text.breakOn key text))
