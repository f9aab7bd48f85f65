module Drawing.SvgDamageSpec
  ( spec,
  )
where

import CaseCount (askedCount)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Char8 qualified as Bytes
import Data.List (isSuffixOf, sort)
import Data.Maybe (fromMaybe)
import Drawing.BoundedAnswer (answers)
import Drawing.Svg (fromSvg)
import Files (filesBelow)
import Generate.Damage (damaged)
import Generate.Svg (SvgText (..), svgText)
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "the reader of SVG files" $ do
  count <- runIO (fromMaybe 600 <$> askedCount "PARTC_DRAWINGS")
  files <- runIO (sort . filter (".svg" `isSuffixOf`) <$> filesBelow "test/data/drawings")
  texts <- runIO (traverse ByteString.readFile files)
  it "answers to uses of uses within bounds (catches nodes that are not counted)" $
    withMaxSuccess 15 $
      forAll uses (answers (fromSvg Nothing))
  it "answers to damaged SVG files within bounds (catches a line that is not there)" $
    withMaxSuccess count $
      forAll (oneof [svgBytes <$> svgText, elements texts] >>= damaged) (answers (fromSvg Nothing))

-- | A file with groups of which each uses the one before it several times, or uses any one.
uses :: Gen ByteString
uses = do
  depth <- choose (1, 40 :: Int)
  copies <- choose (1, 4)
  groups <- traverse (group copies) [1 .. depth]
  inner <- elements ["<circle r='1'/>", "", "<path d='M0 0h1v1z'/>"]
  pure $
    "<svg><defs><g id='u0'>" <> inner <> "</g>" <> Bytes.concat groups <> "</defs><use href='#u"
      <> shown depth
      <> "'/></svg>"
  where
    group copies i = do
      wanted <- frequency [(30, pure (i - 1)), (1, choose (0, 40))]
      let row = "<use href='#u" <> shown wanted <> "'/>"
      pure ("<g id='u" <> shown i <> "'>" <> Bytes.concat (replicate copies row) <> "</g>")
    shown = Bytes.pack . show :: Int -> ByteString
