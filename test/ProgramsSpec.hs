-- | The small programs of test/programs. A program in a folder @good@ has its frames in a file
-- beside it; a program in a folder @bad@ has its reports there.
--
-- Each folder of test/programs is a feature of the language. With PARTC_RECORD set, the files of
-- frames and reports are written; without it a missing file is a failure.
module ProgramsSpec (spec) where

import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Cli.FrameTable qualified as FrameTable
import Compile (Compiled (..), Punched (..))
import Compile qualified
import Control.Monad (forM_, void)
import Data.ByteString qualified as ByteString
import Data.List (isInfixOf, nub, sort)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (expected, filesBelow, readText)
import Font.TrueType qualified as TrueType
import Machines qualified
import Project.Job (Job)
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Human qualified as Human
import Report.Report (Report, ReportPlace (..))
import Report.Report qualified as Report
import Surface.Import qualified as Import
import System.Directory (doesFileExist, listDirectory)
import System.FilePath (takeDirectory, takeExtension, takeFileName, (-<.>), (</>))
import Test.Hspec
import Toolpath.Toolpath qualified as Toolpath
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  programs <-
    runIO
      (sort . filter ((`elem` [".part", ".sheet"]) . takeExtension) <$> filesBelow "test/programs")
  let kind k = filter (("/" <> k <> "/") `isInfixOf`) programs
  describe "good programs are proven and give their frames" $
    forM_ (kind "good") $ \file -> it file $ do
      (values, loaded) <- loadedFrom file
      let source = LoadedProgram.source loaded
          outcome = Compile.compile (job values loaded) loaded
      case Result.ifSound outcome of
        Just [Compiled {machine, toolpath, punched, proof}] -> do
          fmap Proof.findings proof `shouldBe` Just []
          expected
            (file -<.> "frames")
            ( FrameTable.frames (Toolpath.unit toolpath) machine source (program punched)
                <> rendered source (warnings outcome)
            )
        _ -> expectationFailure (Text.unpack (rendered source (errors outcome)))
  describe "good programs on every machine are proven or refused at a place of the program" $
    forM_ (kind "good") $ \file -> it file $ do
      (values, loaded) <- loadedFrom file
      forM_ Machines.known $ \machine -> do
        let outcome = Compile.compile (Machines.jobFor machine values) loaded
            found = concatMap (maybe [] Proof.findings . Compile.proof) <$> Result.output outcome
        fromMaybe [] found `shouldBe` []
        [Report.title r | r <- errors outcome, not (isPlaced r)] `shouldBe` []
  describe "bad programs give their reports, and no tape" $
    forM_ (kind "bad") $ \file -> it file $ do
      (values, loaded) <- loadedFrom file
      let outcome = Compile.check (job values loaded) loaded
      errors outcome `shouldNotBe` []
      void (Result.ifSound outcome) `shouldBe` Nothing
      expected
        (file -<.> "report")
        (rendered (LoadedProgram.source loaded) (errors outcome <> warnings outcome))
  describe "report codes" $
    it "each code of the language has a bad program, each warning a good one" $ do
      sources <- filter ("Error.hs" `isInfixOf`) <$> filesBelow "src"
      codes <-
        nub . sort . concatMap codesIn
          <$> traverse readText (filter (not . ofCommandLine) sources)
      expectations <-
        Text.concat
          <$> ( traverse readText . filter ((`elem` [".report", ".frames"]) . takeExtension)
                  =<< filesBelow "test/programs"
              )
      -- Surface.LimitsSpec tests the length of a text, and test/machines the machine descriptions.
      -- No program is known about which rounding decides.
      let isTested c =
            c `elem` ["E0116", "E0368"]
              || Text.isPrefixOf "E10" c
              || Text.isInfixOf ("[" <> c <> "]") expectations
      filter (not . isTested) codes `shouldBe` []

-- | True for a report that points at a region of the program.
isPlaced :: Report -> Bool
isPlaced r = case Report.place r of
  InSource _ -> True
  InTape _ -> False
  InFile -> False
  InCommandLine -> False

-- | A job for the machine that the program names, or for lkp-01f if it names none.
job :: [(Text, Text)] -> LoadedProgram -> Job
job = Machines.jobForOwnOr Machines.lkp01f

rendered :: Region.Source -> [Report] -> Text
rendered source reports = Text.concat (map render (Report.sorted reports))
  where
    render r = Human.render Human.Plain (Region.mainFile source) source r <> "\n"

-- | Do the errors of this module belong to the command line rather than to the language?
ofCommandLine :: FilePath -> Bool
ofCommandLine file = any (`isInfixOf` file) ["Cli", "Project"]

-- | A program with its imports, and values for its parameters. A line @-- set: NAME=VALUE@ of the
-- program sets such a value.
loadedFrom :: FilePath -> IO ([(Text, Text)], LoadedProgram)
loadedFrom file = do
  text <- readText file
  loaded <- LoadedProgram.load reader (takeFileName file) text
  pure
    ( [ (Text.strip n, Text.drop 1 v)
        | line <- Text.lines text,
          Just rest <- [Text.stripPrefix "-- set: " line],
          let (n, v) = Text.breakOn "=" rest
      ],
      loaded
    )
  where
    reader =
      (Import.byName (beside readText))
        { Import.bytes = beside ByteString.readFile,
          Import.glyphs = \font text ->
            beside ByteString.readFile font >>= traverse (`TrueType.glyphs` text),
          Import.listing = listDirectory . (takeDirectory file </>)
        }
    beside :: (FilePath -> IO a) -> FilePath -> IO (Either Text a)
    beside readAs name = do
      let path = takeDirectory file </> name
      exists <- doesFileExist path
      if exists then Right <$> readAs path else pure (Left "there is no such file or folder")

-- | The report codes that are string literals of a source: E or W and four digits.
codesIn :: Text -> [Text]
codesIn text =
  [ code
    | code <- drop 1 (Text.splitOn "\"" text),
      Text.length code == 5,
      Text.take 1 code `elem` ["E", "W"],
      Text.all (`elem` ['0' .. '9']) (Text.drop 1 code)
  ]
