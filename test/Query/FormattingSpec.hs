-- | The change from a text to its formatted text.
module Query.FormattingSpec (spec) where

import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Formatting (Change (..))
import Query.Formatting qualified as Formatting
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck

spec :: Spec
spec = do
  prop "the change turns the old text into the new one" . forAll ((,) <$> text' <*> text') $
    \(old, new) ->
      maybe old (applied old) (Formatting.change old new) === new
  prop "there is no change between a text and itself" . forAll text' $ \text ->
    Formatting.change text text === Nothing
  it "only the differing lines change" $
    Formatting.change "a\nb  \nc\n" "a\nb\nc\n"
      `shouldBe` Just Change {region = Region 2 6, newText = "b\n"}

-- | The text after a change.
applied :: Text -> Change -> Text
applied old (Change (Region from to) new) = Text.take from old <> new <> Text.drop to old

text' :: Gen Text
text' = Text.pack <$> listOf (elements "ab🙂\n\r")
