-- | The layers of the program, and a reader of imports that holds every module to them.
--
-- The table below is the whole rule. A folder of @src@ is a layer; so is a module that
-- stands alone at the top of @src@. A module may import its own layer, the layers that its
-- row names, and whatever those may import.
module LayersSpec
  ( spec,
  )
where

import Data.ByteString qualified as ByteString
import Data.Char (isAlpha, isAlphaNum, isAscii, isPunctuation, isSpace, isSymbol)
import Data.List (sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import System.Directory (doesDirectoryExist, listDirectory)
import System.FilePath (dropExtension, splitDirectories, takeExtension, (</>))
import Test.Hspec

-- The table ---------------------------------------------------------------------------------

-- | One layer: what it looks like under @src@, its name, what it may import.
data Layer = Layer Shape Text Reach

data Shape
  = -- | A folder of modules.
    Folder
  | -- | A single module at the top.
    Single
  | -- | The folder @app@, beside @src@.
    Program
  deriving stock (Eq, Show)

data Reach
  = -- | The layers named, and what those may import.
    Only [Text]
  | -- | All layers of the rows above.
    Above

-- | Lower layers first: no row names a later one.
table :: [Layer]
table =
  [ Layer Folder "Base" (Only []),
    Layer Folder "Report" (Only ["Base"]),
    Layer Folder "Surface" (Only ["Base", "Report"]),
    Layer Folder "Checked" (Only ["Surface"]),
    Layer Folder "Geometry" (Only ["Base"]),
    Layer Folder "Offset" (Only ["Geometry"]),
    Layer Folder "Part" (Only ["Checked", "Geometry"]),
    Layer Folder "Sheet" (Only ["Base", "Report", "Surface", "Part", "Geometry"]),
    Layer Folder "Toolpath" (Only ["Part", "Offset"]),
    Layer Folder "Machine" (Only ["Base", "Report"]),
    Layer Folder "Frame" (Only ["Toolpath", "Machine"]),
    Layer Folder "Tape" (Only ["Frame", "Machine"]),
    Layer Folder "Control" (Only ["Frame", "Machine"]),
    Layer Folder "Verify" Above,
    Layer Folder "Draw" Above,
    Layer Folder "Project" (Only ["Sheet", "Toolpath", "Machine"]),
    Layer Single "Compile" (Only ["Project", "Tape", "Control", "Verify"]),
    Layer
      Folder
      "Query"
      (Only ["Report", "Surface", "Checked", "Geometry", "Part", "Toolpath", "Compile"]),
    Layer Folder "Lsp" (Only ["Query"]),
    Layer Folder "Cli" Above,
    Layer Program "app" Above
  ]

-- | Layers whose work is input and output.
effectful :: Set Text
effectful = Set.fromList ["Cli", "app"]

-- | The modules of pure layers that may do what pure modules may not, each with the imports it is
-- allowed.
sanctioned :: Map Text [Text]
sanctioned =
  Map.fromList
    [ ("Base.Crash", ["Control.Exception"]),
      ("Lsp.Server", ["System.IO", "System.IO.Error", "Control.Exception"])
    ]

-- | Library modules that bring effects: these, and all below them.
impure :: [Text]
impure =
  [ "Control.Concurrent",
    "Control.Exception",
    "Control.Monad.IO",
    "Data.IORef",
    "Data.Text.IO",
    "Data.Text.Lazy.IO",
    "Debug.Trace",
    "Foreign",
    "GHC.IO",
    "System"
  ]

-- | Library modules that are pure although their names put them below one of 'impure'.
pureAfterAll :: [Text]
pureAfterAll = ["System.Console.ANSI.Codes", "System.Console.ANSI.Types", "System.FilePath"]

-- | The most lines that a module may have.
longest :: Int
longest = 600

-- The check ---------------------------------------------------------------------------------

-- | A file as found: its path from the root of the project, and its text.
data Source = Source FilePath Text

data Fault = Fault FilePath Problem
  deriving stock (Eq, Ord, Show)

data Problem
  = -- | The file lies where no row of the table puts it.
    Unplaced
  | -- | The first layer may not import this module of the second.
    Forbidden Text Text Text
  | -- | A pure module imports an effect.
    Impure Text
  | -- | The module does not say what it exports.
    Unlisted
  | -- | The module has so many lines.
    TooLong Int
  deriving stock (Eq, Ord, Show)

-- | Everything wrong with these files under this table.
check :: [Layer] -> [Source] -> [Fault]
check layers sources = concatMap faults sources
  where
    homes =
      Map.fromList
        [(moduleName path, home) | Source path _ <- sources, Just home <- [layerOf layers path]]
    reaches = reachable layers
    faults (Source path text) =
      Fault path
        <$> concat
          [ [Unlisted | not (listsExports tokens)],
            [TooLong count | let count = length (Text.lines text), count > longest],
            maybe [Unplaced] (edges path (imports tokens)) (layerOf layers path)
          ]
      where
        tokens = tokenise text
    edges path names home = mapMaybe (edge path home) names
    edge path home name = case Map.lookup name homes of
      Just other
        | other == home || other `Set.member` Map.findWithDefault Set.empty home reaches -> Nothing
        | otherwise -> Just (Forbidden home other name)
      Nothing
        | home `Set.member` effectful || not (isImpure name) -> Nothing
        | name `elem` Map.findWithDefault [] (moduleName path) sanctioned -> Nothing
        | otherwise -> Just (Impure name)

-- | The layer that a path belongs to, when the table has one of that name and shape.
layerOf :: [Layer] -> FilePath -> Maybe Text
layerOf layers path = case splitDirectories (dropExtension path) of
  ["src", name] -> placed Single (Text.pack name)
  "src" : folder : _ -> placed Folder (Text.pack folder)
  "app" : _ -> placed Program "app"
  _ -> Nothing
  where
    placed shape name
      | or [shape == shape' && name == name' | Layer shape' name' _ <- layers] = Just name
      | otherwise = Nothing

-- | The name that a file's path gives to its module.
moduleName :: FilePath -> Text
moduleName path =
  Text.intercalate "." (map Text.pack (drop 1 (splitDirectories (dropExtension path))))

-- | For every layer, all it may import, itself left out.
reachable :: [Layer] -> Map Text (Set Text)
reachable = foldl add Map.empty
  where
    add known (Layer _ name reach) = Map.insert name (reached known reach) known
    reached known Above = Map.keysSet known
    reached known (Only names) =
      Set.unions (Set.fromList names : [Map.findWithDefault Set.empty name known | name <- names])

-- | The rows that name a row which is not above them.
upward :: [Layer] -> [(Text, Text)]
upward layers = concat (zipWith bad layers (scanl (flip (Set.insert . layerName)) Set.empty layers))
  where
    bad (Layer _ _ Above) _ = []
    bad (Layer _ name (Only names)) above =
      [(name, other) | other <- names, other `Set.notMember` above]
    layerName (Layer _ name _) = name

isImpure :: Text -> Bool
isImpure name =
  name `notElem` pureAfterAll
    && or [name == root || (root <> ".") `Text.isPrefixOf` name | root <- impure]

-- | One line for a person.
render :: Fault -> String
render (Fault path problem) = path <> ": " <> Text.unpack (say problem)
  where
    say Unplaced = "lies in no layer of the table"
    say (Forbidden home other name) =
      home <> " may not import " <> other <> " (here " <> name <> ")"
    say (Impure name) = "a pure module may not import " <> name
    say Unlisted = "has no export list"
    say (TooLong count) =
      "has " <> Text.pack (show count) <> " lines; at most " <> Text.pack (show longest)

-- The reader --------------------------------------------------------------------------------

-- | As much of Haskell's lexical grammar as finding imports asks for. Comments, pragmas
-- and character literals leave no token.
data Token
  = -- | A keyword, a name or a qualified name; a number too.
    Word Text
  | -- | A string literal, its content dropped.
    Literal
  | -- | An operator, or one bracket, comma or other mark.
    Mark Text
  deriving stock (Eq, Show)

tokenise :: Text -> [Token]
tokenise source = case Text.uncons source of
  Nothing -> []
  Just (c, rest)
    | isSpace c -> tokenise (Text.dropWhile isSpace rest)
    | "{-" `Text.isPrefixOf` source -> tokenise (afterComment (Text.drop 2 source))
    | c == '"' -> Literal : tokenise (afterString rest)
    | c == '\'' -> tokenise (afterQuote rest)
    | isOperatorChar c -> case Text.span isOperatorChar source of
      (operator, next)
        | isDashes operator -> tokenise (Text.dropWhile (/= '\n') next)
        | otherwise -> Mark operator : tokenise next
    | isWordChar c ->
      let word = Text.dropWhileEnd (== '.') (Text.takeWhile isWordChar source)
       in Word word : tokenise (Text.drop (Text.length word) source)
    | otherwise -> Mark (Text.singleton c) : tokenise rest
  where
    isDashes operator = Text.length operator >= 2 && Text.all (== '-') operator

-- | What follows the end of a block comment whose opening has been read. Such comments nest.
afterComment :: Text -> Text
afterComment = go (1 :: Int)
  where
    go 0 text = text
    go depth text
      | Text.null text = text
      | "{-" `Text.isPrefixOf` text = go (depth + 1) (Text.drop 2 text)
      | "-}" `Text.isPrefixOf` text = go (depth - 1) (Text.drop 2 text)
      | otherwise = go depth (Text.drop 1 text)

-- | What follows the end of a string literal whose opening quote has been read.
afterString :: Text -> Text
afterString text = case Text.unpack (Text.take 2 unremarkable) of
  '\\' : '^' : _ -> afterString (Text.drop 3 unremarkable)
  '\\' : c : _
    | isSpace c ->
      afterString (Text.drop 1 (Text.dropWhile isSpace (Text.drop 1 unremarkable)))
  '\\' : _ -> afterString (Text.drop 2 unremarkable)
  _ -> Text.drop 1 unremarkable
  where
    unremarkable = Text.dropWhile (`notElem` ("\\\"" :: String)) text

-- | What follows a character literal whose opening quote has been read. A quote that opens
-- none marks a promoted name and is passed over.
afterQuote :: Text -> Text
afterQuote text = case Text.unpack (Text.take 2 text) of
  '\\' : _ -> Text.drop 1 (Text.dropWhile (/= '\'') (Text.drop 2 text))
  [_, '\''] -> Text.drop 2 text
  _ -> text

isWordChar :: Char -> Bool
isWordChar c = isAlphaNum c || c `elem` ("_'." :: String)

isOperatorChar :: Char -> Bool
isOperatorChar c
  | isAscii c = c `elem` ("!#$%&*+./<=>?@\\^|-~:" :: String)
  | otherwise = isSymbol c || isPunctuation c

-- | The modules that a module imports, in its order.
imports :: [Token] -> [Text]
imports tokens = case tokens of
  Word "foreign" : Word "import" : rest -> imports rest
  Word "import" : rest -> case dropWhile isModifier rest of
    Word name : rest' | isModuleName name -> name : imports rest'
    rest' -> imports rest'
  _ : rest -> imports rest
  [] -> []
  where
    isModifier token = token `elem` [Word "qualified", Word "safe", Literal]
    isModuleName = Text.any isAlpha

-- | Whether the header names the exports one by one.
listsExports :: [Token] -> Bool
listsExports tokens = case dropWhile (/= Word "module") tokens of
  Word "module" : Word _ : Mark "(" : _ -> True
  _ -> False

-- The specification -------------------------------------------------------------------------

spec :: Spec
spec = do
  describe "this program" $ do
    sources <- runIO readSources
    it "has modules to look at" $
      map (\(Source path _) -> path) sources `shouldSatisfy` elem ("app" </> "Main.hs")
    it "keeps to its layers" $
      case check table sources of
        [] -> pure ()
        faults -> expectationFailure (unlines (map render faults))

  describe "the table" $ do
    it "points downwards only" $
      upward table `shouldBe` []
    it "notices a row that points upwards" $
      upward [Layer Folder "A" (Only ["B"]), Layer Folder "B" (Only [])] `shouldBe` [("A", "B")]
    it "lets a layer import what its imports may" $
      Map.lookup "Checked" (reachable table)
        `shouldBe` Just (Set.fromList ["Base", "Report", "Surface"])
    it "gives Compile every stage, and neither Draw nor Cli" $
      Map.lookup "Compile" (reachable table)
        `shouldBe` Just
          ( Set.fromList
              [ "Base",
                "Report",
                "Sheet",
                "Surface",
                "Checked",
                "Geometry",
                "Offset",
                "Part",
                "Toolpath",
                "Machine",
                "Frame",
                "Tape",
                "Control",
                "Verify",
                "Project"
              ]
          )

  describe "check" $ do
    it "passes modules that keep the rules" $
      faultsOf [good "src/Base/Name.hs" [], good "src/Surface/Parser.hs" ["Base.Name", "Data.Text"]]
        `shouldBe` []
    it "finds an edge that points upwards" $
      faultsOf [good "src/Base/Name.hs" ["Surface.Parser"], good "src/Surface/Parser.hs" []]
        `shouldBe` [Fault "src/Base/Name.hs" (Forbidden "Base" "Surface" "Surface.Parser")]
    it "finds an edge between layers that do not know each other" $
      faultsOf [good "src/Geometry/Arc.hs" ["Report.Report"], good "src/Report/Report.hs" []]
        `shouldBe` [Fault "src/Geometry/Arc.hs" (Forbidden "Geometry" "Report" "Report.Report")]
    it "follows the table through several rows" $
      faultsOf [good "src/Frame/Chord.hs" ["Surface.Syntax"], good "src/Surface/Syntax.hs" []]
        `shouldBe` []
    it "keeps Draw and Cli out of Compile" $
      faultsOf
        [ good "src/Compile.hs" ["Draw.Svg", "Cli.Main", "Verify.Gouge"],
          good "src/Draw/Svg.hs" [],
          good "src/Cli/Main.hs" [],
          good "src/Verify/Gouge.hs" []
        ]
        `shouldBe` [ Fault "src/Compile.hs" (Forbidden "Compile" "Draw" "Draw.Svg"),
                     Fault "src/Compile.hs" (Forbidden "Compile" "Cli" "Cli.Main")
                   ]
    it "keeps Compile out of the stages" $
      faultsOf [good "src/Draw/Svg.hs" ["Compile"], good "src/Compile.hs" []]
        `shouldBe` [Fault "src/Draw/Svg.hs" (Forbidden "Draw" "Compile" "Compile")]
    it "tells a library's Control from the layer of that name" $
      faultsOf [good "src/Base/Result.hs" ["Control.Monad"], good "src/Control/Interpolate.hs" []]
        `shouldBe` []
    it "refuses a folder that the table does not know" $
      faultsOf [good "src/Utils/Text.hs" []] `shouldBe` [Fault "src/Utils/Text.hs" Unplaced]
    it "refuses a top-level module that the table does not know" $
      faultsOf [good "src/Prelude2.hs" [], good "src/Base.hs" []]
        `shouldBe` [Fault "src/Prelude2.hs" Unplaced, Fault "src/Base.hs" Unplaced]
    it "finds effects in a pure layer" $
      faultsOf
        [ good
            "src/Part/Evaluate.hs"
            ["System.IO", "Data.IORef", "Control.Exception", "System.Process", "Systematic"]
        ]
        `shouldBe` map
          (Fault "src/Part/Evaluate.hs" . Impure)
          ["System.IO", "Data.IORef", "Control.Exception", "System.Process"]
    it "lets pure modules of an effectful family pass" $
      faultsOf [good "src/Report/Human.hs" ["System.Console.ANSI.Codes", "System.Console.ANSI"]]
        `shouldBe` [Fault "src/Report/Human.hs" (Impure "System.Console.ANSI")]
    it "allows effects to the command line and to the sanctioned crash alone" $
      faultsOf
        [ good "app/Main.hs" ["System.Exit", "Cli.Subcommand"],
          good "src/Cli/Run.hs" ["System.IO"],
          good "src/Base/Crash.hs" ["Control.Exception", "System.IO"]
        ]
        `shouldBe` [Fault "src/Base/Crash.hs" (Impure "System.IO")]
    it "wants an export list" $
      faultsOf [Source "src/Base/Name.hs" "module Base.Name where\n"]
        `shouldBe` [Fault "src/Base/Name.hs" Unlisted]
    it "wants a header" $
      faultsOf [Source "app/Main.hs" "main = pure ()\n"] `shouldBe` [Fault "app/Main.hs" Unlisted]
    it "counts lines" $ do
      faultsOf [long 600] `shouldBe` []
      faultsOf [long 601] `shouldBe` [Fault "src/Base/Name.hs" (TooLong 601)]

  describe "imports" $ do
    it "reads the plain form" $
      importsOf ["import Data.Text", "import Base.Name (Name)"]
        `shouldBe` ["Data.Text", "Base.Name"]
    it "reads qualified before the name" $
      importsOf ["import qualified Data.Map.Strict as Map"] `shouldBe` ["Data.Map.Strict"]
    it "reads qualified after the name" $
      importsOf ["import Data.Map.Strict qualified as Map"] `shouldBe` ["Data.Map.Strict"]
    it "reads package imports, safe imports and pragmas" $
      importsOf
        [ "import \"containers\" Data.Set",
          "import safe qualified \"text\" Data.Text",
          "import {-# SOURCE #-} Base.Name"
        ]
        `shouldBe` ["Data.Set", "Data.Text", "Base.Name"]
    it "reads an import over several lines" $
      importsOf ["import", "  qualified", "  -- why", "  Data.Text", "  as Text"]
        `shouldBe` ["Data.Text"]
    it "reads hiding and nested lists" $
      importsOf ["import Prelude hiding (lookup, (++))", "import A (B (..), (-->))", "import C"]
        `shouldBe` ["Prelude", "A", "C"]
    it "reads imports that share a line" $
      importsOf ["import A; import B"] `shouldBe` ["A", "B"]
    it "passes over line comments" $
      importsOf ["-- import A", "--- import B", "import C -- import D"] `shouldBe` ["C"]
    it "takes an operator with dashes for no comment" $
      importsOf ["x = a --> b; import A", "y = f.--.g; import B", "import C"]
        `shouldBe` ["A", "B", "C"]
    it "passes over block comments, nested ones too" $
      importsOf ["{- import A {- import B -} import C -}", "import D"] `shouldBe` ["D"]
    it "passes over strings" $
      importsOf
        ["x = \"import A \\\" import B\"", "y = \"{-\"", "z = \"\\", "  \\ import C\"", "import D"]
        `shouldBe` ["D"]
    it "passes over character literals and primes" $
      importsOf ["q = ['\"', '\\'', '\\\\', '\\x41']", "f' = foldl' import' 'A", "import D"]
        `shouldBe` ["D"]
    it "passes over foreign imports" $
      importsOf ["foreign import ccall \"math.h sin\" sine :: Double -> Double", "import A"]
        `shouldBe` ["A"]

  describe "listsExports" $ do
    it "sees a list" $
      listed "module A (b) where" `shouldBe` True
    it "sees a list after comments and pragmas" $
      listed
        "{-# LANGUAGE CPP #-}\n-- | module B where\nmodule A\n  ( -- * Section\n    b,\n  )\nwhere"
        `shouldBe` True
    it "sees that there is none" $
      listed "module A where\nf (x) = x" `shouldBe` False
  where
    faultsOf = check table
    importsOf = imports . tokenise . Text.unlines
    listed = listsExports . tokenise
    good path names =
      Source
        path
        ( Text.unlines
            (("module " <> moduleName path <> " (x) where") : ["import " <> name | name <- names])
        )
    long count =
      Source
        "src/Base/Name.hs"
        (Text.unlines ("module Base.Name (x) where" : replicate (count - 1) "--"))

-- Files -------------------------------------------------------------------------------------

-- | All Haskell files of the library and the program. Tests run at the project's root.
readSources :: IO [Source]
readSources = do
  paths <- concat <$> mapM haskellFiles ["src", "app"]
  mapM (\path -> Source path . Encoding.decodeUtf8 <$> ByteString.readFile path) (sort paths)

haskellFiles :: FilePath -> IO [FilePath]
haskellFiles path = do
  isFolder <- doesDirectoryExist path
  if isFolder
    then concat <$> (mapM (haskellFiles . (path </>)) =<< listDirectory path)
    else pure [path | takeExtension path == ".hs"]
