-- | Addresses of files.
module Lsp.UriSpec (spec) where

import Data.Text qualified as Text
import Lsp.Uri (Uri (..))
import Lsp.Uri qualified as Uri
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck

spec :: Spec
spec = do
  prop "a path is the same after it is converted to an address and back"
    . forAll (listOf (elements "aж🙂 %+#?/."))
    $ \path ->
      let full = "/" <> Text.pack path in Uri.toPath (Uri.fromPath full) === full
  it "decodes upper-case and lower-case percent-encoding" $
    map
      (Uri.toPath . Uri)
      ["file:///tmp/%D1%84%20a.part", "file:///tmp/%d1%84 a.part", "file://localhost/tmp/ф a.part"]
      `shouldBe` replicate 3 "/tmp/ф a.part"
  it "keeps addresses of other kinds, and percent signs that encode nothing" $
    map (Uri.toPath . Uri) ["untitled:Untitled-1", "file:///a%", "file:///a%4"]
      `shouldBe` ["untitled:Untitled-1", "/a%", "/a%4"]
  it "encodes characters that have a meaning in addresses" $
    Uri.fromPath "/a b/ф%#.part" `shouldBe` Uri "file:///a%20b/%D1%84%25%23.part"
