-- | The sentences about the words of the language.
module Query.ManualSpec (spec) where

import Checked.Builtin qualified as Builtin
import Data.Char (isAlphaNum, toLower)
import Data.List (nub)
import Data.Maybe (isNothing, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Query.Manual (ManualEntry (..))
import Query.Manual qualified as Manual
import Surface.Keyword qualified as Keyword
import Test.Hspec

spec :: Spec
spec = do
  it "every function has an entry" $
    filter (isNothing . Manual.function) Builtin.names `shouldBe` []
  it "every keyword, unit and setting has an entry" $
    filter (isNothing . Manual.word) (Keyword.reservedWords <> Keyword.softStatements <> options)
      `shouldBe` []
  it "every section is in the manual" $ do
    known <- concat <$> mapM headings ["language.md", "functions.md"]
    let named = mapMaybe Manual.function Builtin.names <> mapMaybe Manual.word Keyword.reservedWords
    filter (`notElem` known) (nub (map section (named <> mapMaybe Manual.word options)))
      `shouldBe` []
  it "the title of a section is made of its name" $
    fmap Manual.sectionTitle (Manual.word "rest allowed") `shouldBe` Just "Rest material"
  where
    options = concatMap Keyword.settingsOf ["mill", "pocket", "turn", "drill"]

-- | The sections of a page, as links name them.
headings :: Text -> IO [Text]
headings page = do
  text <- readText (Text.unpack ("docs/" <> page))
  pure
    [ page <> "#" <> Text.map dashed (Text.filter isKept (Text.map toLower title))
      | line <- Text.lines text,
        "#" `Text.isPrefixOf` line,
        let title = Text.strip (Text.dropWhile (== '#') line)
    ]
  where
    isKept c = isAlphaNum c || c `elem` (" -" :: String)
    dashed c = if c == ' ' then '-' else c
