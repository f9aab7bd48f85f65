module Drawing.DxfDamageSpec
  ( spec,
  )
where

import Base.Quantity (LengthUnit (..))
import CaseCount (askedCount)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Char8 qualified as Bytes
import Data.List (isSuffixOf, sort)
import Data.Maybe (fromMaybe)
import Drawing.BoundedAnswer (answers)
import Drawing.Dxf (fromDxf)
import Files (filesBelow)
import Generate.Damage (damaged)
import Generate.Dxf (DxfText (..), dxfText)
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "the reader of DXF files" $ do
  count <- runIO (fromMaybe 600 <$> askedCount "PARTC_DRAWINGS")
  files <- runIO (sort . filter (".dxf" `isSuffixOf`) <$> filesBelow "test/data/drawings")
  texts <- runIO (traverse ByteString.readFile files)
  it "answers to arrays of arrays of blocks within bounds (catches an array that counts once)" $
    forAll arrays (answers (fromDxf (Just Millimetres)))
  it "answers to damaged DXF files within bounds (catches a line after the last one)" $
    withMaxSuccess count $
      forAll (oneof [bytes <$> dxfText, elements texts] >>= damaged) $
        answers (fromDxf (Just Millimetres))

-- | A file with blocks of which each inserts the one before it, as an array.
arrays :: Gen ByteString
arrays = do
  depth <- choose (1, 6 :: Int)
  members <- traverse member [1 .. depth]
  inner <- elements [circle, []]
  pure . Bytes.unlines $
    ["0", "SECTION", "2", "BLOCKS"]
      <> concat [block (shown i) body | (i, body) <- zip [0 ..] (inner : take (depth - 1) members)]
      <> ["0", "ENDSEC", "0", "SECTION", "2", "ENTITIES"]
      <> last members
      <> ["0", "ENDSEC", "0", "EOF"]
  where
    block name body = ["0", "BLOCK", "2", name] <> body <> ["0", "ENDBLK"]
    circle = ["0", "CIRCLE", "10", "0", "20", "0", "40", "1"]
    member i = do
      columns <- elements ["1", "2", "10", "100", "30000", "2000000000"]
      rows <- elements ["0", "1", "3", "1000"]
      pure
        ( ["0", "INSERT", "2", shown (i - 1), "10", "0", "20", "0", "44", "1e-5", "45", "1e-5"]
            <> ["70", columns, "71", rows]
        )
    shown = Bytes.pack . show :: Int -> ByteString
