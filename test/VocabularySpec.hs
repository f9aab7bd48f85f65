-- | Every function and every unit of the language is in the manual. The editors know these and all
-- keywords.
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
import Surface.HoleForm qualified as HoleForm
import Surface.Keyword qualified as Keyword
import Surface.Token qualified as Token
import Test.Hspec

spec :: Spec
spec = do
  describe "each function of the language" $ do
    it "is on the page of functions" $ do
      page <- readText "docs/functions.md"
      filter (not . (`elem` inBackquotes page)) Builtin.names `shouldBe` []
    forM_ withFunctions $ \file ->
      it ("is a word of " <> file) $ file `hasAll` Builtin.names
  describe "each unit of the language" $ do
    it "is in the manual" $ do
      page <- readText "docs/language.md"
      filter (not . (`Text.isInfixOf` page) . quoted) units `shouldBe` []
    forM_ (grammar : withFunctions) $ \file ->
      it ("is a word of " <> file) $ file `hasAll` concatMap (Text.splitOn "/") units
  describe "each keyword of the language" $
    forM_ (grammar : colours : withFunctions) $ \file ->
      it ("is a word of " <> file) $ file `hasAll` keywords
  where
    units = map Token.unitName [minBound .. maxBound]
    quoted unit = "`" <> unit <> "`"
    keywords =
      filter (`notElem` units) Keyword.reservedWords
        <> Keyword.softStatements
        <> concatMap
          (concatMap Text.words . Keyword.settingsOf)
          ( ["mill", "pocket", "rest", "face", "engrave", "vcarve", "turn", "drill"]
              <> HoleForm.words'
          )
    grammar = "editors/tree-sitter-part/grammar.js"
    colours = "editors/tree-sitter-part/queries/highlights.scm"

-- | The files of editors that list the functions of the language as well as its other words.
withFunctions :: [FilePath]
withFunctions =
  [ "editors/nvim/syntax/part.vim",
    "editors/emacs/part-mode.el",
    "editors/kakoune/part.kak",
    "editors/vscode/syntaxes/part.tmLanguage.json"
  ]

-- | Fails if words are missing in a file, and names them.
hasAll :: FilePath -> [Text] -> Expectation
hasAll file wanted = do
  known <- namesIn <$> readText file
  filter (`notElem` known) wanted `shouldBe` []

-- | The names in the code between backquotes of a page.
inBackquotes :: Text -> [Text]
inBackquotes page = concat [namesIn code | (code, True) <- zip (Text.splitOn "`" page) turns]
  where
    turns = cycle [False, True]

-- | The names in a text: letters, digits and underscores.
namesIn :: Text -> [Text]
namesIn = filter (not . Text.null) . Text.split (not . isNameLetter)
  where
    isNameLetter letter = isAlpha letter || letter == '_' || letter `elem` ['0' .. '9']
