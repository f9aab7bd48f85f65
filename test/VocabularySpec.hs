-- | Every function and every unit of the language is in the manual, and Neovim colours it.
module VocabularySpec
  ( spec,
  )
where

import Checked.Builtin qualified as Builtin
import Data.Char (isAlpha)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Surface.Token qualified as Token
import Test.Hspec

spec :: Spec
spec = do
  describe "each function of the language" $ do
    it "is on the page of functions" $ do
      page <- readText "docs/functions.md"
      filter (not . (`elem` inBackquotes page)) Builtin.names `shouldBe` []
    it "is a word of the syntax file of Neovim" $ do
      syntax <- editorWords
      filter (`notElem` syntax) Builtin.names `shouldBe` []
  describe "each unit of the language" $ do
    it "is in the manual" $ do
      page <- readText "docs/language.md"
      filter (not . (`Text.isInfixOf` page) . quoted) units `shouldBe` []
    it "is a word of the syntax file of Neovim" $ do
      syntax <- editorWords
      filter (`notElem` syntax) (concatMap (Text.splitOn "/") units) `shouldBe` []
  where
    units = map Token.unitName [minBound .. maxBound]
    quoted unit = "`" <> unit <> "`"

-- | The names in the code between backquotes of a page.
inBackquotes :: Text -> [Text]
inBackquotes page = concat [namesIn code | (code, True) <- zip (Text.splitOn "`" page) turns]
  where
    turns = cycle [False, True]

-- | The words of the syntax file.
editorWords :: IO [Text]
editorWords = namesIn <$> readText "editors/nvim/syntax/part.vim"

-- | The names in a text: letters, digits and underscores.
namesIn :: Text -> [Text]
namesIn = filter (not . Text.null) . Text.split (not . isNameLetter)
  where
    isNameLetter letter = isAlpha letter || letter == '_' || letter `elem` ['0' .. '9']
