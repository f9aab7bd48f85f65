-- | The layers of the program, and the form of its code.
--
-- The table below is the whole rule on imports. A folder of @src@ is a layer; so is a module at
-- the top of @src@. A module may import its own layer, the layers that its row names, and whatever
-- those may import. The rules on form are in "Form".
module LayersSpec
  ( spec,
  )
where

import Control.Monad (filterM)
import Data.ByteString qualified as ByteString
import Data.List (sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Form (Source (..), exceptions, moduleName, problems, sentence, sharedTypes)
import HaskellSource
import System.Directory (doesDirectoryExist, doesFileExist, listDirectory)
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
    Layer Folder "Geometry" (Only ["Base"]),
    Layer Folder "Drawing" (Only ["Base", "Report", "Geometry"]),
    Layer Folder "Font" (Only ["Geometry", "Drawing"]),
    Layer Folder "Surface" (Only ["Base", "Report", "Drawing", "Font"]),
    Layer Folder "Checked" (Only ["Surface"]),
    Layer Folder "Offset" (Only ["Geometry"]),
    Layer Folder "Part" (Only ["Checked", "Geometry", "Offset", "Font"]),
    Layer Folder "Sheet" (Only ["Base", "Report", "Surface", "Part", "Geometry"]),
    Layer Folder "Toolpath" (Only ["Part", "Offset"]),
    Layer Folder "Machine" (Only ["Base", "Report"]),
    Layer Folder "Frame" (Only ["Toolpath", "Machine"]),
    Layer Folder "Tape" (Only ["Frame", "Machine"]),
    Layer Folder "Gcode" (Only ["Frame", "Machine"]),
    Layer Folder "Control" (Only ["Frame", "Machine"]),
    Layer Folder "Pulse" (Only ["Control", "Tape"]),
    Layer Folder "Verify" Above,
    Layer Folder "Draw" Above,
    Layer
      Folder
      "Export"
      (Only ["Base", "Geometry", "Part", "Toolpath", "Draw"]),
    Layer Folder "Project" (Only ["Sheet", "Toolpath", "Machine"]),
    Layer Single "Compile" (Only ["Project", "Tape", "Gcode", "Control", "Verify"]),
    Layer
      Folder
      "Query"
      (Only ["Report", "Surface", "Checked", "Geometry", "Part", "Toolpath", "Compile", "Draw"]),
    Layer Folder "Preview" (Only ["Query", "Pulse"]),
    Layer Folder "Lsp" (Only ["Preview"]),
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
      -- the type of the errors that the parser of XML gives as a value
      ("Drawing.XmlElement", ["Control.Exception"]),
      -- the call of FreeType, which runs in IO
      ("Font.TrueType", ["Foreign", "Foreign.C.Types"]),
      ( "Preview.Server",
        [ "Control.Concurrent",
          "Control.Concurrent.MVar",
          "Control.Concurrent.STM",
          "Control.Exception",
          "System.IO"
        ]
      ),
      ("Lsp.PreviewPages", ["Control.Concurrent"]),
      ( "Lsp.Server",
        [ "Control.Concurrent",
          "Control.Exception",
          "System.Exit",
          "System.IO",
          "System.Posix.Process",
          "System.Timeout"
        ]
      )
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

-- | The modules that hold the data of a stage, each with the modules of its own folder that it may
-- import: further data, and no pass.
stageData :: Map Text [Text]
stageData =
  Map.fromList
    [ ("Report.Fix", []),
      ("Report.Report", ["Report.Fix"]),
      ("Drawing.Drawing", []),
      ("Surface.Syntax", ["Surface.Token"]),
      ("Checked.Syntax", ["Checked.Dimension", "Checked.Type"]),
      ("Part.Contour", ["Part.Curve", "Part.CutFeed", "Part.Link"]),
      ("Part.Part", ["Part.Contour", "Part.Curve", "Part.CutFeed", "Part.Cutter"]),
      ("Sheet.Sheet", []),
      ("Toolpath.Toolpath", []),
      ( "Machine.Machine",
        [ "Machine.Axis",
          "Machine.Commands",
          "Machine.Controller",
          "Machine.Feeds",
          "Machine.FrameLayout",
          "Machine.ProgramForm",
          "Machine.TapeCode"
        ]
      ),
      ("Frame.Frame", []),
      ("Tape.Tape", []),
      ("Verify.Proof", ["Verify.CollisionFinding", "Verify.ControlFault"])
    ]

-- The check ---------------------------------------------------------------------------------

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
        <$> [Unlisted | not (listsExports tokens)]
        <> maybe [Unplaced] (edges path (imports tokens)) (layerOf layers path)
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

-- | The imports by which a stage's data would depend on a module of its own folder that is not in
-- the table: the data, the module.
passesOfData :: Map Text [Text] -> [Source] -> [(Text, Text)]
passesOfData table' sources =
  [ (name, other)
    | Source path text <- sources,
      let name = moduleName path,
      Just allowed <- [Map.lookup name table'],
      other <- imports (tokenise text),
      Text.takeWhile (/= '.') other == Text.takeWhile (/= '.') name,
      other `notElem` allowed
  ]

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

-- The specification -------------------------------------------------------------------------

spec :: Spec
spec = do
  describe "this program" $ do
    sources <- runIO (readSources ["src", "app"])
    it "has modules to look at" $
      map (\(Source path _) -> path) sources `shouldSatisfy` elem ("app" </> "Main.hs")
    it "keeps to its layers" $
      case check table sources of
        [] -> pure ()
        faults -> expectationFailure (unlines (map render faults))
    it "keeps the rules on form" $ do
      everything <- readSources ["src", "app", "test", "bench"]
      let found = [(path, p) | s@(Source path _) <- everything, p <- problems exceptions s]
      unlines [path <> ": " <> Text.unpack (sentence p) | (path, p) <- found] `shouldBe` ""
    it "gives one name to one type" $
      sharedTypes exceptions sources `shouldBe` []
    it "keeps the data of every stage free of its passes" $
      passesOfData stageData sources `shouldBe` []
    it "explains every folder of src in a README" $ do
      folders <- filterM doesDirectoryExist . map ("src" </>) =<< listDirectory "src"
      lacking <- filterM (fmap not . doesFileExist . (</> "README.md")) folders
      sort lacking `shouldBe` []

  describe "the table" $ do
    it "points downwards only" $
      upward table `shouldBe` []
    it "notices a row that points upwards" $
      upward [Layer Folder "A" (Only ["B"]), Layer Folder "B" (Only [])] `shouldBe` [("A", "B")]
    it "lets a layer import what its imports may" $
      Map.lookup "Checked" (reachable table)
        `shouldBe` Just (Set.fromList ["Base", "Report", "Geometry", "Drawing", "Font", "Surface"])
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
                "Drawing",
                "Offset",
                "Font",
                "Part",
                "Toolpath",
                "Machine",
                "Frame",
                "Tape",
                "Gcode",
                "Control",
                "Pulse",
                "Verify",
                "Project"
              ]
          )

  describe "the data of a stage" $
    it "notices an import of a pass" $
      passesOfData
        (Map.fromList [("A.Data", ["A.More"])])
        [good "src/A/Data.hs" ["A.More", "A.FromB", "B.Data"]]
        `shouldBe` [("A.Data", "A.FromB")]

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
  where
    faultsOf = check table
    good path names =
      Source
        path
        ( Text.unlines
            (("module " <> moduleName path <> " (x) where") : ["import " <> name | name <- names])
        )

-- Files -------------------------------------------------------------------------------------

-- | All Haskell files below some folders of the project. Tests run at its root.
readSources :: [FilePath] -> IO [Source]
readSources folders = do
  paths <- concat <$> mapM haskellFiles folders
  mapM (\path -> Source path . Encoding.decodeUtf8 <$> ByteString.readFile path) (sort paths)

haskellFiles :: FilePath -> IO [FilePath]
haskellFiles path = do
  isFolder <- doesDirectoryExist path
  if isFolder
    then concat <$> (mapM (haskellFiles . (path </>)) =<< listDirectory path)
    else pure [path | takeExtension path == ".hs"]
