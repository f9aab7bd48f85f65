-- | Positions in UTF-16 code units.
module Lsp.PositionSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Position (LspPosition (..))
import Lsp.Position qualified as Position
import Lsp.Talk (placeIn, units)
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
           in (line, character) === placeIn text at
    prop "what is put before a line's text shifts it by its UTF-16 length"
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
    prop "is total, and never outside the text"
      . forAll ((,,) <$> text' <*> chooseInt (-3, 20) <*> chooseInt (-3, 20))
      $ \(text, line, character) ->
        let at =
              Position.offset (Region.fromText "a" text) LspPosition {line, character}
         in at >= 0 && at <= Text.length text
    it "takes a position within a surrogate pair as the beginning of the character" $
      Position.offset (Region.fromText "a" "ж🙂b") LspPosition {line = 0, character = 2} `shouldBe` 1
    it "takes a position after its line as the end of the line" $
      Position.offset (Region.fromText "a" "ab\r\nc") LspPosition {line = 0, character = 9}
        `shouldBe` 2
    it "takes a line after the text as its end, however large its number" $
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

-- | An offset that a position can express: not between CR and LF.
offsetIn :: Text -> Gen Int
offsetIn text =
  chooseInt (0, Text.length text) `suchThat` \at ->
    Text.take 2 (Text.drop (at - 1) text) /= "\r\n" || at == 0
