-- | Compares the names of the modules with docs/glossary.md: every word of a name is an entry
-- there, with a meaning and a source.
module GlossarySpec
  ( spec,
  )
where

import Data.Char (isUpper)
import Data.List (minimumBy, sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Ord (comparing)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import System.FilePath (dropExtension, splitDirectories, takeExtension)
import Test.Hspec

-- The glossary ------------------------------------------------------------------------------

-- | One row of a table of the glossary.
data Entry = Entry
  { group :: Text,
    -- | the cell as it is written: the term, then other forms of it after commas
    term :: Text,
    meaning :: Text,
    source :: Text,
    -- | the modules and types that the last cell names
    carriers :: [Text]
  }
  deriving stock (Eq, Show)

-- | The rows of all tables that have the glossary's five columns.
entries :: Text -> [Entry]
entries = go "" . Text.lines
  where
    go heading rows = case rows of
      [] -> []
      row : others
        | Just title <- Text.stripPrefix "## " row -> go title others
        | Just entry <- entryOf heading row -> entry : go heading others
        | otherwise -> go heading others

-- | The entry of a table row; none for the head of a table and for rows of another width.
entryOf :: Text -> Text -> Maybe Entry
entryOf group row = case map Text.strip (Text.splitOn "|" row) of
  ["", term, meaning, source, _, code, ""]
    | term /= "term" && Text.any (/= '-') term ->
      Just Entry {group, term, meaning, source, carriers = quoted code}
  _ -> Nothing

-- | The texts between backquotes.
quoted :: Text -> [Text]
quoted text = case Text.splitOn "`" text of
  _ : inside : rest -> inside : quoted (Text.intercalate "`" rest)
  _ -> []

-- | The forms of a term, each as its words: @\"trimming, trimmed\"@ has two of one word.
forms :: Entry -> [[Text]]
forms = map (map normal . Text.words . Text.replace "-" " ") . Text.splitOn "," . term

-- | A word in lower case and, roughly, in the singular.
normal :: Text -> Text
normal word = if isPlural then Text.dropEnd 1 lower else lower
  where
    lower = Text.toLower word
    isPlural = "s" `Text.isSuffixOf` lower && not ("ss" `Text.isSuffixOf` lower)

-- The check ---------------------------------------------------------------------------------

data Problem
  = -- | a module, and a word of its name that no entry has
    UnknownWord Text Text
  | NoMeaning Text
  | NoSource Text
  | -- | an entry, and the one before it in its table, which belongs after it
    OutOfOrder Text Text
  | -- | an entry, and a module or type that it names and that does not exist
    UnknownCarrier Text Text
  deriving stock (Eq, Show)

-- | Everything wrong with a glossary for modules, given by their names and texts.
check :: Map Text Text -> [Entry] -> [Problem]
check modules glossary =
  concat
    [ [UnknownWord name word | name <- Map.keys modules, word <- unknownWords terms name],
      concatMap empties glossary,
      [OutOfOrder (term e) (term previous) | (previous, e) <- neighbours, key e < key previous],
      [UnknownCarrier (term e) name | e <- glossary, name <- carriers e, not (exists modules name)]
    ]
  where
    terms = Set.fromList (concatMap forms glossary)
    empties e =
      [NoMeaning (term e) | Text.null (meaning e)] <> [NoSource (term e) | Text.null (source e)]
    neighbours = [(a, b) | (a, b) <- zip glossary (drop 1 glossary), group a == group b]
    key = Text.toLower . Text.replace "-" " " . term

-- | The first word of each component of a module's name that no term covers.
unknownWords :: Set [Text] -> Text -> [Text]
unknownWords terms name =
  [word | part <- Text.splitOn "." name, word : _ <- [uncovered terms (camelWords part)]]

-- | The words left over when terms, of one word or of several, cover as many as they can from
-- the beginning.
uncovered :: Set [Text] -> [Text] -> [Text]
uncovered terms name = minimumBy (comparing length) (name : map rest (filter isTerm prefixes))
  where
    prefixes = [1 .. length name]
    isTerm count = map normal (take count name) `Set.member` terms
    rest count = uncovered terms (drop count name)

-- | The words of a name in camel case.
camelWords :: Text -> [Text]
camelWords name = case Text.uncons name of
  Nothing -> []
  Just (first, rest) ->
    let word = Text.cons first (Text.takeWhile (not . isUpper) rest)
     in word : camelWords (Text.drop (Text.length word) name)

-- | True of the name of a module, of a folder of modules, and of a type after its module's name.
exists :: Map Text Text -> Text -> Bool
exists modules name = isModule || isFolder || isType
  where
    isModule = name `Map.member` modules
    isFolder = any ((name <> ".") `Text.isPrefixOf`) (Map.keys modules)
    isType = maybe False (declares type') (Map.lookup (Text.dropEnd 1 qualifier) modules)
    (qualifier, type') = Text.breakOnEnd "." name

-- | True when the text of a module declares a type.
declares :: Text -> Text -> Bool
declares type' text = or [isDeclaration (Text.words line) | line <- Text.lines text]
  where
    isDeclaration line = case line of
      keyword : name : _ -> keyword `elem` ["data", "newtype", "type"] && name == type'
      _ -> False

-- | One line for a person.
render :: Problem -> String
render problem = Text.unpack $ case problem of
  UnknownWord name word -> name <> ": the glossary has no entry for \"" <> word <> "\""
  NoMeaning entry -> "the entry \"" <> entry <> "\" has no meaning"
  NoSource entry -> "the entry \"" <> entry <> "\" has no source"
  OutOfOrder entry previous ->
    "the entry \"" <> entry <> "\" belongs before \"" <> previous <> "\""
  UnknownCarrier entry name ->
    "the entry \"" <> entry <> "\" names " <> name <> ", which is not there"

-- | The modules below @src@, by their names.
readModules :: IO (Map Text Text)
readModules = do
  files <- filter ((== ".hs") . takeExtension) . sort <$> filesBelow "src"
  Map.fromList <$> traverse (\file -> (moduleName file,) <$> readText file) files
  where
    moduleName = Text.intercalate "." . map Text.pack . drop 1 . splitDirectories . dropExtension

-- The specification -------------------------------------------------------------------------

spec :: Spec
spec = do
  describe "docs/glossary.md" $ do
    modules <- runIO readModules
    glossary <- runIO (entries <$> readText "docs/glossary.md")
    it "is read, and so are the modules" $ do
      length glossary `shouldSatisfy` (> 200)
      Map.keys modules `shouldSatisfy` elem "Geometry.Index.BoundingBox"
    it "has every word of a module's name, whole entries in order, and existing modules" $
      case check modules glossary of
        [] -> pure ()
        problems -> expectationFailure (unlines (map render problems))
  describe "docs/architecture.md" $ do
    modules <- runIO readModules
    page <- runIO (readText "docs/architecture.md")
    let names = filter isQualified (quoted page)
    it "names modules and types" $
      length names `shouldSatisfy` (> 10)
    it "names only modules and types that exist" $
      filter (not . exists modules) names `shouldBe` []
  describe "entries" entriesSpec
  describe "check" checkSpec

-- | True of names with at least one dot whose components all begin with a capital letter.
isQualified :: Text -> Bool
isQualified name = length components > 1 && all (isUpper . fst) (mapMaybe Text.uncons components)
  where
    components = Text.splitOn "." name

entriesSpec :: Spec
entriesSpec = do
  it "reads the rows of a table under their heading" $
    entries (Text.unlines ("## Tools" : table [cutter]))
      `shouldBe` [Entry "Tools" "cutter" "it cuts" "ISO 3855" ["A.B", "C"]]
  it "passes over tables of other widths" $
    entries "| name | source |\n|---|---|\n| Ural | a paper |\n" `shouldBe` []
  it "splits forms at commas and words at hyphens, in the singular" $
    map forms (entries (whole "bounding-box tree, Box trees"))
      `shouldBe` [[["bounding", "box", "tree"], ["box", "tree"]]]
  where
    cutter = "| cutter | it cuts | ISO 3855 | фреза | `A.B`, `C` |"

checkSpec :: Spec
checkSpec = do
  it "accepts words, plurals, and terms of several words" $
    problems ["Index.BoundingBoxTree", "Segments"] ["bounding box", "index", "segment", "tree"]
      `shouldBe` []
  it "notices a module name whose word is no entry" $
    problems ["Index.FooTree"] ["index", "tree"] `shouldBe` [UnknownWord "Index.FooTree" "Foo"]
  it "notices a folder whose word is no entry" $
    problems ["Foo.Tree"] ["tree"] `shouldBe` [UnknownWord "Foo.Tree" "Foo"]
  it "notices a word that is only a part of a term" $
    problems ["Box"] ["bounding box"] `shouldBe` [UnknownWord "Box" "Box"]
  it "notices a word that ends like an entry" $
    problems ["Subtree"] ["tree"] `shouldBe` [UnknownWord "Subtree" "Subtree"]
  it "prefers the cover that leaves fewer words" $
    problems ["ArcLengthTable"] ["arc", "arc length", "table"] `shouldBe` []
  it "notices an entry without a meaning" $
    check Map.empty (entries "| tree | | a book | | |\n") `shouldBe` [NoMeaning "tree"]
  it "notices an entry without a source" $
    check Map.empty (entries "| tree | a hierarchy | | | |\n") `shouldBe` [NoSource "tree"]
  it "notices entries out of alphabetical order" $
    problems [] ["tree", "index"] `shouldBe` [OutOfOrder "index" "tree"]
  it "lets each heading begin its order anew" $
    check Map.empty (entries (whole "tree" <> "## Next\n" <> whole "index")) `shouldBe` []
  it "notices a module or a type that does not exist" $
    check
      (Map.fromList [("Tree", "-- Leaf\ndata Node = Leaf")])
      (entries "| tree | a hierarchy | a book | | `Tree`, `Tree.Node`, `Tree.Leaf`, `Forest` |\n")
      `shouldBe` [UnknownCarrier "tree" "Tree.Leaf", UnknownCarrier "tree" "Forest"]
  where
    problems names terms = check (Map.fromList (map (,"") names)) (entries (foldMap whole terms))

-- | A table with rows.
table :: [Text] -> [Text]
table rows = "| term | meaning | source | Russian | code |" : "|---|---|---|---|---|" : rows

-- | The row of a whole entry for a term.
whole :: Text -> Text
whole term = "| " <> term <> " | a meaning | a source | | |\n"
