-- | Laws of positions in UTF-16 code units.
module Lsp.PositionSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Position (LspPosition (..))
import Lsp.Position qualified as Position
import Lsp.Talk (positionIn, units)
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck

spec :: Spec
spec = do
  describe "position" $ do
    prop "counts UTF-16 units from 0, in lines that end with LF, CR or CR LF" . forAll text' $
      \text ->
        forAll (offsetIn text) $ \at ->
          let LspPosition {line, character} = Position.position (Region.fromText "a" text) at
           in (line, character) === positionIn text at
    prop "grows by the UTF-16 length of a text that is inserted before it in the line"
      . forAll ((,,) <$> text' <*> oneLine <*> oneLine)
      $ \(above, put, text) ->
        let front = above <> "\n"
            place content = Position.position (Region.fromText "a" content)
            plain = place (front <> text) (Text.length front)
            moved = place (front <> put <> text) (Text.length front + Text.length put)
         in moved === plain {character = character plain + units put}
  describe "offset" $ do
    prop "undoes position" . forAll text' $ \text ->
      forAll (offsetIn text) $ \at ->
        let source =
              Region.fromText "a" text
         in Position.offset source (Position.position source at) === at
    prop "lies within the text for every position"
      . forAll ((,,) <$> text' <*> chooseInt (-3, 20) <*> chooseInt (-3, 20))
      $ \(text, line, character) ->
        let at =
              Position.offset (Region.fromText "a" text) LspPosition {line, character}
         in at >= 0 && at <= Text.length text
    it "of a position within a surrogate pair is the beginning of the character" $
      Position.offset (Region.fromText "a" "ж🙂b") LspPosition {line = 0, character = 2} `shouldBe` 1
    it "of a position beyond the end of its line is the end of the line" $
      Position.offset (Region.fromText "a" "ab\r\nc") LspPosition {line = 0, character = 9}
        `shouldBe` 2
    it "of a line beyond the end of the text is the end of the text, even for the largest numbers" $
      [ Position.offset (Region.fromText "a" "ab\nc") LspPosition {line, character}
        | (line, character) <- [(7, 0), (maxBound, 0), (maxBound, maxBound), (1, maxBound)]
      ]
        `shouldBe` [4, 4, 4, 4]
  it "finds the file of a region" $
    let source = Region.addFile "b" "cd" (Region.fromText "a" "xy\n")
     in map
          (\r -> (Position.fileOf source r, Position.position source (start r)))
          [Region 1 2, Region 5 6]
          `shouldBe` [("a", LspPosition 0 1), ("b", LspPosition 0 1)]

-- | Texts with characters of one, two, three and four bytes, and with all line ends.
text' :: Gen Text
text' = Text.pack <$> listOf (elements "ab 1ж€🙂𝔸\n\r\t")

oneLine :: Gen Text
oneLine = Text.pack <$> listOf (elements "ab 1ж€🙂𝔸\t")

-- | An offset that has a position of its own, so none between CR and LF.
offsetIn :: Text -> Gen Int
offsetIn text =
  chooseInt (0, Text.length text) `suchThat` \at ->
    Text.take 2 (Text.drop (at - 1) text) /= "\r\n" || at == 0
