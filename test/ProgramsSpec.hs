-- | The small programs of test/programs: good ones beside their frames, bad ones beside their
-- reports.
--
-- Folders are features. With PARTC_RECORD set, missing and differing expectations are written anew;
-- without it a missing one is a failure.
module ProgramsSpec (spec) where

import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Cli.FrameTable qualified as FrameTable
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Control.Monad (forM_, void)
import Data.List (isInfixOf, nub, sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (expected, readText, walk)
import Frame.Frame qualified as Frame
import Machine.Machine (Machine)
import Machines qualified
import Report.Human qualified as Human
import Report.Report (Report)
import Report.Report qualified as Report
import Surface.Import qualified as Import
import System.Directory (doesFileExist)
import System.FilePath (takeDirectory, takeExtension, takeFileName, (-<.>), (</>))
import Test.Hspec
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  programs <-
    runIO (sort . filter ((`elem` [".part", ".sheet"]) . takeExtension) <$> walk "test/programs")
  let kind k = filter (("/" <> k <> "/") `isInfixOf`) programs
  describe "good programs are proven and give their frames" $
    forM_ (kind "good") $ \file -> it file $ do
      (values, loaded) <- loadedFrom file
      let source = Compile.source loaded
          outcome =
            Compile.analyse values loaded `Result.thenSound` \a ->
              let m =
                    machineFor loaded a
               in Compile.punch m (path a) `Result.thenSound` \p -> pure (a, m, p)
      case Result.settled outcome of
        Nothing -> expectationFailure (Text.unpack (rendered source (errors outcome)))
        Just (a, m, p) -> do
          fs <-
            maybe
              (fail "the tape cannot be read")
              pure
              (output (Compile.readTape m (Frame.start (program p)) (tape p)))
          let proof = Compile.prove m (path a) (program p) fs
          fmap Proof.findings (output proof) `shouldBe` Just []
          expected
            (file -<.> "frames")
            (FrameTable.frames m source (program p) <> rendered source (warnings outcome))
  describe "bad programs give their reports, and no tape" $
    forM_ (kind "bad") $ \file -> it file $ do
      (values, loaded) <- loadedFrom file
      let outcome = reportsOf values loaded
      errors outcome `shouldNotBe` []
      void (Result.settled outcome) `shouldBe` Nothing
      expected
        (file -<.> "report")
        (rendered (Compile.source loaded) (errors outcome <> warnings outcome))
  describe "report codes" $
    it "each code of the language has a bad program, each warning a good one" $ do
      sources <- filter ("Error.hs" `isInfixOf`) <$> walk "src"
      codes <-
        nub . sort . concatMap codesIn
          <$> traverse readText (filter (not . ("Cli" `isInfixOf`)) sources)
      expectations <-
        Text.concat
          <$> ( traverse readText . filter ((`elem` [".report", ".frames"]) . takeExtension)
                  =<< walk "test/programs"
              )
      -- A text that is too long is no small program; Surface.LimitsSpec has one. Descriptions of
      -- machines have texts of their own.
      [c | c <- codes, c /= "E0116", not (Text.isPrefixOf "E10" c), not (Text.isInfixOf ("[" <> c <> "]") expectations)]
        `shouldBe` []

-- | All that the compiler says of a program, up to the machine's limits.
reportsOf :: [(Text, Text)] -> Compile.LoadedProgram -> Result Report Report ()
reportsOf values loaded =
  Compile.analyse values loaded `Result.thenSound` \a ->
    void (Compile.punch (machineFor loaded a) (path a))

-- | The program's own machine, or the usual one.
machineFor :: Compile.LoadedProgram -> Analysis -> Machine
machineFor = Machines.ownOr Machines.lkp01f

rendered :: Region.Source -> [Report] -> Text
rendered source reports = Text.concat (map render (Report.sorted reports))
  where
    render r = Human.render Human.Plain (Region.mainFile source) source r <> "\n"

-- | A program with what it imports, and the values that its lines @-- set: NAME=VALUE@ give to
-- parameters.
loadedFrom :: FilePath -> IO ([(Text, Text)], Compile.LoadedProgram)
loadedFrom file = do
  text <- readText file
  loaded <- Compile.load (Import.byName beside) (takeFileName file) text
  pure
    ( [ (Text.strip n, Text.drop 1 v)
        | line <- Text.lines text,
          Just rest <- [Text.stripPrefix "-- set: " line],
          let (n, v) = Text.breakOn "=" rest
      ],
      loaded
    )
  where
    beside name = do
      let there = takeDirectory file </> name
      exists <- doesFileExist there
      if exists then Right <$> readText there else pure (Left "there is no such file or folder")

-- | Codes in a source text: quotation mark, letter, four digits.
codesIn :: Text -> [Text]
codesIn text =
  [ code
    | piece <- drop 1 (Text.splitOn "\"" text),
      let code = piece,
      Text.length code == 5,
      Text.take 1 code `elem` ["E", "W"],
      Text.all (`elem` ['0' .. '9']) (Text.drop 1 code)
  ]
