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
      foldr (flip applied) old (Formatting.changes old new) === new
  prop "there is no change between a text and itself" . forAll text' $ \text ->
    Formatting.changes text text === []
  it "only the differing lines change" $ do
    Formatting.changes "a\nb  \nc\n" "a\nb\nc\n"
      `shouldBe` [Change {region = Region 2 6, newText = "b\n"}]
    Formatting.changes "a \nb\nc \n" "a\nb\nc\n"
      `shouldBe` [ Change {region = Region 0 3, newText = "a\n"},
                   Change {region = Region 5 8, newText = "c\n"}
                 ]
  it "a line that is inserted or removed leaves the others alone" $ do
    Formatting.changes "a\nb\n" "a\n\nb\n" `shouldBe` [Change {region = Region 2 2, newText = "\n"}]
    Formatting.changes "a\n\n\nb\n" "a\n\nb\n"
      `shouldBe` [Change {region = Region 3 4, newText = ""}]
  describe "closing" $ do
    it "puts the closing brace below a new line in a block" $ do
      closed "for p in a {\n^\n" `shouldBe` Just "for p in a {\n  \n}\n"
      closed "  for p in a {\n    ^\n" `shouldBe` Just "  for p in a {\n    \n  }\n"
    it "does nothing if the block is closed already, or none has begun" $ do
      closed "for p in a {\n^\n}\n" `shouldBe` Nothing
      closed "let a = 1\n^\n" `shouldBe` Nothing

-- | The text after the closing of a block at the mark.
closed :: Text -> Maybe Text
closed marked = applied text <$> Formatting.closing text offset
  where
    offset = Text.length (fst (Text.breakOn "^" marked))
    text = Text.replace "^" "" marked

-- | The text after a change.
applied :: Text -> Change -> Text
applied old (Change (Region from to) new) = Text.take from old <> new <> Text.drop to old

text' :: Gen Text
text' = Text.pack <$> listOf (elements "ab🙂\n\r")
