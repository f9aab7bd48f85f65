-- | Every function and every unit of the language is in the manual, and Neovim and VS Code colour
-- them and the reserved words.
module VocabularySpec
  ( spec,
  )
where

import Checked.Builtin qualified as Builtin
import Control.Monad (forM_)
import Data.Char (isAlpha)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Surface.Keyword qualified as Keyword
import Surface.Token qualified as Token
import Test.Hspec

spec :: Spec
spec = do
  describe "each function of the language" $ do
    it "is on the page of functions" $ do
      page <- readText "docs/functions.md"
      filter (not . (`elem` inBackquotes page)) Builtin.names `shouldBe` []
    isInEverySyntaxFile Builtin.names
  describe "each unit of the language" $ do
    it "is in the manual" $ do
      page <- readText "docs/language.md"
      filter (not . (`Text.isInfixOf` page) . quoted) units `shouldBe` []
    isInEverySyntaxFile (concatMap (Text.splitOn "/") units)
  describe "each reserved word of the language" $
    isInEverySyntaxFile (concatMap (Text.splitOn "/") Keyword.reservedWords)
  where
    units = map Token.unitName [minBound .. maxBound]
    quoted unit = "`" <> unit <> "`"

-- | The names in the code between backquotes of a page.
inBackquotes :: Text -> [Text]
inBackquotes page = concat [namesIn code | (code, True) <- zip (Text.splitOn "`" page) turns]
  where
    turns = cycle [False, True]

-- | For each editor, a test that each of these words is a word of its syntax file.
isInEverySyntaxFile :: [Text] -> Spec
isInEverySyntaxFile wanted =
  forM_ syntaxFiles $ \(editor, file) ->
    it ("is a word of the syntax file of " <> editor) $ do
      syntax <- namesIn <$> readText file
      filter (`notElem` syntax) wanted `shouldBe` []

-- | The editors, each with its syntax file for part programs.
syntaxFiles :: [(String, FilePath)]
syntaxFiles =
  [ ("Neovim", "editors/nvim/syntax/part.vim"),
    ("VS Code", "editors/vscode/syntaxes/part.tmLanguage.json")
  ]

-- | The names in a text: letters, digits and underscores.
namesIn :: Text -> [Text]
namesIn = filter (not . Text.null) . Text.split (not . isNameLetter)
  where
    isNameLetter letter = isAlpha letter || letter == '_' || letter `elem` ['0' .. '9']
