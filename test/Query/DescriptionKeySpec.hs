-- | Keys of machine descriptions at the cursor.
module Query.DescriptionKeySpec (spec) where

import Data.Maybe (isNothing)
import Data.Text qualified as Text
import Machine.BuiltIn qualified as BuiltIn
import Query.DescriptionKey (DescriptionKeys (..))
import Query.DescriptionKey qualified as DescriptionKey
import Test.Hspec

spec :: Spec
spec = do
  it "on an empty line are those of the section" $
    fmap keys (keysAfter "axis x {\n  " "\n  pulse 0.01 mm\n}\n") `shouldSatisfy` \case
      Just found -> "pulse" `elem` found && "tape" `notElem` found
      Nothing -> False
  it "outside of all sections are the names of the sections" $
    fmap (take 3 . keys) (keysAfter "" "\n") `shouldBe` Just ["machine", "tape", "code"]
  it "are not offered for an argument" $
    keysAfter "axis x {\n  pulse 0.01 m" "m\n}\n" `shouldBe` Nothing
  it "are known at the beginning of every statement of the built-in descriptions" $
    [ (name, line)
      | name <- BuiltIn.names,
        Just text <- [BuiltIn.text name],
        (line, at) <- statementsOf text,
        isNothing (DescriptionKey.keysAt text at)
    ]
      `shouldBe` []
  where
    keysAfter front back =
      DescriptionKey.keysAt (front <> back) (Text.length front)
    -- The lines that begin with the key of a section, with the offset of this key.
    statementsOf text =
      [ (line, at + Text.length (Text.takeWhile (== ' ') line))
        | (line, at) <- zip (Text.lines text) (scanl beyond 0 (Text.lines text)),
          any (`Text.isPrefixOf` line) ["  pulse ", "  leader ", "  numbers ", "  tracks "]
      ]
    beyond at line = at + Text.length line + 1
