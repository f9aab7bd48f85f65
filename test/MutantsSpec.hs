-- | The mutants of test/mutants: each has all its fields, and docs/laws.md lists it.
module MutantsSpec
  ( spec,
  )
where

import Data.ByteString qualified as ByteString
import Data.List (sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Files (filesBelow, readText)
import System.Environment (lookupEnv)
import System.FilePath (takeBaseName, takeExtension)
import Test.Hspec hiding (after, before)

-- | The fields at the head of a mutant, by their names.
fields :: Text -> Map Text Text
fields text =
  Map.fromList
    [ (key, Text.drop 2 value)
      | line <- Text.lines (fst (Text.breakOn "--- instead of" text)),
        let (key, value) = Text.breakOn ": " line
    ]

-- | The rows of the table: law, bug, mutant, in the order of the laws.
table :: [(Text, Map Text Text)] -> Text
table mutants = Text.unlines (["| law | bug | mutant |", "|---|---|---|"] <> map row inOrder)
  where
    inOrder = sort [(field "law" m, field "bug" m, name) | (name, m) <- mutants]
    row (law, bug, name) = "| " <> cell law <> " | " <> cell bug <> " | `" <> name <> "` |"
    field = Map.findWithDefault ""
    cell = Text.replace "|" "\\|"

-- | The text between two marks of a page, and the texts before and after it with the marks.
between :: Text -> Text -> Text -> (Text, Text, Text)
between begin end page = (before <> begin, inside, after)
  where
    (before, rest) = Text.breakOn begin page
    (inside, after) = Text.breakOn end (Text.drop (Text.length begin) rest)

spec :: Spec
spec = describe "test/mutants" $ do
  files <- runIO (filter ((== ".mutant") . takeExtension) <$> filesBelow "test/mutants")
  texts <- runIO (mapM readText (sort files))
  let mutants = zip (map (Text.pack . takeBaseName) (sort files)) (map fields texts)
  it "name the law, the bug that it must notice, and the place of the bug" $
    [ name
      | (name, m) <- mutants,
        any (`Map.notMember` m) ["law", "bug"]
          || not (Map.member "file" m || all (`Map.member` m) ["module", "definition"])
    ]
      `shouldBe` []
  it "are listed in docs/laws.md" $ do
    page <- readText "docs/laws.md"
    let (before, inside, after) = between "<!-- mutants -->\n" "<!-- end of mutants -->" page
        wanted = "\n" <> table mutants <> "\n"
    recording <- lookupEnv "PARTC_RECORD"
    case recording of
      Just _ ->
        ByteString.writeFile "docs/laws.md" (Encoding.encodeUtf8 (before <> wanted <> after))
      Nothing -> inside `shouldBe` wanted
