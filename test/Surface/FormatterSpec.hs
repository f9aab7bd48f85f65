-- | Laws of printing, parsing and formatting.
module Surface.FormatterSpec (spec) where

import Base.Region (Located (..))
import Base.Result qualified as Result
import Control.Monad (forM_)
import Data.List (sort)
import Data.Maybe (isJust, mapMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import Generate.Program qualified as Generate
import Surface.Error (Error)
import Surface.Formatter qualified as Formatter
import Surface.Parser qualified as Parser
import Surface.PrintProgram qualified as PrintProgram
import Surface.Syntax (Program (..), Statement)
import Surface.Unlocated qualified as Unlocated
import System.FilePath (takeExtension)
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck

spec :: Spec
spec = do
  describe "printing" . modifyMaxSuccess (const 300) $ do
    -- The bug: a missing bracket, a forgotten word, a line break that ends a statement too early.
    prop "parsing a printed program gives the same tree" $
      forAllShow Generate.program shown $ \p ->
        tree (PrintProgram.program p) === Just (Unlocated.statements (statements p))
    -- The bug: a construct that the random programs never contain, so that no law tests it.
    syntax <- runIO ((<>) <$> readText "src/Surface/Syntax.hs" <*> readText "src/Surface/Token.hs")
    it "random programs contain every constructor of the syntax" . withMaxSuccess 1 $
      forAllBlind (infiniteListOf (resize 60 Generate.program)) $ \programs ->
        missing (declared syntax) (map Generate.constructors (take 10000 programs)) === []
  describe "layout" . modifyMaxSuccess (const 300) $ do
    -- The bug: a comment that moves at each formatting, columns that depend on the old spaces.
    prop "formatting twice is formatting once" $
      forAllShow written Text.unpack $ \text ->
        let new = Formatter.layout text in (new >>= Formatter.layout) === new
    -- The bug: a comment that is lost, doubled or moved past another; a dropped bracket that was
    -- needed.
    prop "formatting keeps the tree and the comments" $
      forAllShow written Text.unpack $ \text ->
        let new = Formatter.layout text
         in counterexample (maybe "not read" Text.unpack new) $
              (new >>= meaning)
                === meaning
                  ( Text.replace
                      "\r"
                      "\n"
                      (Text.replace "\r\n" "\n" (Text.dropWhile (== '\xFEFF') text))
                  )
    -- The bug: traces of the old layout in the new one.
    prop "formatting a printed program does not change it" $
      forAllShow Generate.program shown $ \p ->
        Formatter.layout (PrintProgram.program p) === Just (PrintProgram.program p)
    -- The bug: repeated blank lines, trailing spaces, line ends of other systems.
    prop
      "a formatted text has no two blank lines in a row, none at the beginning or the end, no \
      \spaces at the end of a line, no carriage return, and no byte order mark"
      $ forAllShow written Text.unpack $ \text ->
        let new = maybe [] Text.lines (Formatter.layout text)
         in conjoin
              [ filter (\l -> Text.stripEnd l /= l || Text.any (`elem` ['\r', '\xFEFF']) l) new
                  === [],
                counterexample
                  "blank lines"
                  (and (zipWith (\a b -> not (Text.null a && Text.null b)) new (drop 1 new))),
                counterexample
                  "the first or the last line"
                  (not (any Text.null (take 1 new <> take 1 (reverse new))))
              ]
    it "a text with mistakes is not formatted" $
      Formatter.format "part x\nlet a = (1,\n" `shouldBe` Nothing
    it "an empty text stays empty" $
      Formatter.format "\n \n" `shouldBe` Just ""
  describe "programs of this project" $ do
    examples <- runIO (sort . filter ((== ".part") . takeExtension) <$> filesBelow "examples")
    forM_ examples $ \file ->
      it (file <> " is formatted already") $ do
        text <- readText file
        Formatter.format text `shouldBe` Just text
    programs <- runIO (sort . filter ((== ".part") . takeExtension) <$> filesBelow "test/programs")
    forM_ programs $ \file ->
      it ("formatting keeps the tree of " <> file) (readText file >>= keeps)
    documents <-
      runIO (("README.md" :) . sort . filter ((== ".md") . takeExtension) <$> filesBelow "docs")
    forM_ documents $ \file -> do
      blocks <- runIO (fences <$> readText file)
      forM_ (zip [1 :: Int ..] blocks) $ \(n, text) ->
        it ("formatting keeps the tree of program " <> show n <> " in " <> file) (keeps text)
  describe "comments" $ do
    it "break a list into lines; elsewhere they move to the end of their line, or above it" $
      Formatter.format
        "let a = [1, -- one\n -- above\n 2 ] -- end\nlet b = (1 -- c\n + 2)\nlet c = 1 + -- d\n 2 \
        \-- e\n"
        `shouldBe` Just
          ( Text.unlines
              [ "let a = [",
                "  1,                                   -- one",
                "  -- above",
                "  2",
                "]                                      -- end",
                "let b = 1 + 2                          -- c",
                "-- d",
                "let c = 1 + 2                          -- e"
              ]
          )
    it "stay inside an empty block, whose braces are put on two lines" $
      Formatter.format "contour a closed { -- nothing\n-- yet\n}"
        `shouldBe` Just "contour a closed {                     -- nothing\n  -- yet\n}\n"
  where
    shown = Text.unpack . PrintProgram.program

-- | The names that are in none of the sets. The sets after the last name that was found are not
-- evaluated.
missing :: [Text] -> [Set Text] -> [Text]
missing names sets = case (names, sets) of
  (_ : _, set : others) -> missing (filter (`Set.notMember` set) names) others
  _ -> names

-- | The text of a random program with random white space and comments.
written :: Gen Text
written = Generate.program >>= Generate.respaced . PrintProgram.program

tree :: Text -> Maybe [Statement]
tree = fmap fst . meaning

-- | The statements of a text without their regions, and its comments; 'Nothing' if it has mistakes.
meaning :: Text -> Maybe ([Statement], [Text])
meaning text = fmap content (Result.ifSound (Parser.parse 0 text :: Result.Result () Error Program))
  where
    content p = (Unlocated.statements (statements p), map (Text.stripEnd . value) (comments p))

-- | Expects that formatting a text keeps its statements and comments, and that formatting it twice
-- is formatting it once. A text with mistakes must not be formatted.
keeps :: Text -> Expectation
keeps text = case meaning text of
  Nothing -> Formatter.layout text `shouldBe` Nothing
  expected -> do
    (Formatter.layout text >>= meaning) `shouldBe` expected
    (Formatter.layout text >>= Formatter.layout) `shouldBe` Formatter.layout text
    Formatter.layout text `shouldSatisfy` isJust

-- | The part programs of a document: the texts between @```part@ and @```@.
fences :: Text -> [Text]
fences text = [fst (Text.breakOn "```" rest) | rest <- drop 1 (Text.splitOn "```part\n" text)]

-- | The constructors that are declared in the source of a module, which is formatted in the style
-- of this project. Broken nodes and the shapes of tokens are left out.
declared :: Text -> [Text]
declared source =
  Set.toList
    (Set.fromList (concatMap constructors (concatMap sums (Text.splitOn "\ndata " source))))
  where
    -- The alternatives of one declaration, up to its @deriving@.
    sums block =
      [ Text.drop 1 rest
        | let rest = snd (Text.breakOn "=" (fst (Text.breakOn "\n  deriving" block))),
          not (Text.null rest)
      ]
    constructors body = mapMaybe leading (Text.splitOn "|" (withoutComments body))
    leading alternative = case Text.words alternative of
      word : _
        | Text.any (`elem` ['A' .. 'Z']) (Text.take 1 word) && not (ignored word) ->
          Just word
      _ -> Nothing
    withoutComments = Text.unlines . map (fst . Text.breakOn "--") . Text.lines
    ignored word =
      "Broken" `Text.isPrefixOf` word
        || word
          `elem` ["Token", "Word", "Number", "Text", "Symbol", "BadNumber", "OpenText", "Stray"]
