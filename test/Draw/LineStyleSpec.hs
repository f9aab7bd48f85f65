-- | Appearances of drawings.
module Draw.LineStyleSpec (spec) where

import Data.List (nub, sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Plotted (drawing)
import SvgText qualified
import Test.Hspec

spec :: Spec
spec = describe "appearances" $ do
  it "print is black and white (catches a colour that a printer makes grey)" $ do
    svg <- drawing ["examples/cnc/bearing.part", "--style", "print", "--by", "depth"]
    coloursOf svg
      `shouldBe` ["#000000", "none", "url(#swept-hatching)", "white"]
  it "print has the hatchings that it uses (catches a hatching without its definition)" $ do
    svg <- drawing ["examples/cnc/bearing.part", "--style", "print"]
    Text.count "<pattern id=\"swept-hatching\"" svg `shouldBe` 1
    nub (SvgText.attributes "stroke" (SvgText.layer "swept" svg))
      `shouldBe` ["url(#swept-hatching)"]
  it "print keeps the lines apart by their widths and dashes" $ do
    svg <- drawing ["examples/cnc/bearing.part", "--style", "print"]
    let stylesOf layer = nub (SvgText.attributes "stroke-dasharray" (SvgText.layer layer svg))
        widthOf layer = take 1 (SvgText.attributes "stroke-width" (SvgText.layer layer svg))
    stylesOf "linking-moves" `shouldBe` ["4 0.8", "1.4 1.2"]
    stylesOf "path" `shouldBe` []
    widthOf "contours" `shouldBe` ["0.7"]
    widthOf "path" `shouldBe` ["0.25"]
  it "dark has light lines on a dark ground (catches white paper)" $ do
    svg <- drawing ["examples/cnc/bearing.part", "--style", "dark"]
    SvgText.attributes "fill" (SvgText.layer "page" svg) `shouldBe` ["#14181d"]
    coloursOf svg `shouldNotContain` ["white"]
    coloursOf svg `shouldNotContain` ["#000000"]
  it "screen has hatchings nowhere" $ do
    svg <- drawing ["examples/cnc/bearing.part"]
    filter ("url" `Text.isPrefixOf`) (coloursOf svg) `shouldBe` []

-- | All colours of a drawing.
coloursOf :: Text -> [Text]
coloursOf svg =
  sort (nub (concat [SvgText.attributes name svg | name <- ["fill", "stroke"]]))
