-- | The programs and input sheets of examples/: the tape of each is proven and has its recorded
-- frames.
--
-- The frames are in examples/expected. The name of such a file contains the values of the
-- parameters: @spacer,bolt=12,holes=6.frames@. With PARTC_RECORD set, the files are written;
-- without it a missing file is a failure.
module ExamplesSpec (spec) where

import Base.Quantity (LengthUnit (..))
import Base.Result (Result (..))
import Base.Result qualified as Result
import Cli.FrameTable qualified as FrameTable
import Compile (Compiled (..), Punched (..))
import Compile qualified
import Control.Exception (IOException, try)
import Control.Monad (forM_)
import Data.Bifunctor (first)
import Data.List (nub, sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (expected, readText)
import Machines qualified
import Project.LoadedProgram qualified as LoadedProgram
import Report.Human qualified as Human
import Report.Report (Report)
import Report.Report qualified as Report
import Surface.Import qualified as Import
import System.Directory (listDirectory)
import System.FilePath (dropExtension, takeExtension, (<.>), (</>))
import Test.Hspec
import Verify.Proof qualified as Proof

spec :: Spec
spec = describe "examples are proven and give their frames" $ do
  sheets <- runIO (named ".sheet" "examples")
  programs <- runIO ((sheets <>) <$> named ".part" "examples")
  kept <- runIO (named ".frames" expectations)
  forM_ (nub (programs <> kept)) $ \run -> it run $ do
    let (file, values) = case Text.splitOn "," (Text.pack run) of
          [] -> (run, [])
          name : assigned ->
            ( "examples"
                </> Text.unpack name
                  <.> (if Text.unpack name `elem` sheets then "sheet" else "part"),
              map (fmap (Text.drop 1) . Text.breakOn "=") assigned
            )
    loaded <- LoadedProgram.load (Import.byName reader) file =<< readText file
    let source = LoadedProgram.source loaded
        outcome = Compile.compile (Machines.jobForOwnOr Machines.lkp01f values loaded) loaded
        rendered reports = Text.concat [render r <> "\n" | r <- Report.sorted reports]
        render = Human.render Human.Plain (Text.pack file) source :: Report -> Text
    case Result.ifSound outcome of
      Just [Compiled {machine, punched, proof}] -> do
        fmap Proof.findings proof `shouldBe` Just []
        expected
          (expectations </> run <.> "frames")
          ( FrameTable.frames Millimetres machine source (program punched)
              <> rendered (warnings outcome)
          )
      _ -> expectationFailure (Text.unpack (rendered (errors outcome)))
  where
    expectations = "examples/expected"

-- | The names of the files with this ending in a folder, without the ending.
named :: String -> FilePath -> IO [FilePath]
named ending folder =
  sort . map dropExtension . filter ((== ending) . takeExtension) <$> listDirectory folder

-- | Reads an imported file.
reader :: FilePath -> IO (Either Text Text)
reader file = first why <$> try (readText file)
  where
    why :: IOException -> Text
    why = Text.pack . show
