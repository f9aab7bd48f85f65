-- | The programs and sheets of examples/: each is proven and gives the frames that are kept beside
-- it.
--
-- The name of an expectation tells the values of the parameters: @spacer,bolt=12,holes=6.frames@.
-- With PARTC_RECORD set, expectations are written anew; without it a missing one is a failure.
module ExamplesSpec (spec) where

import Base.Result (Result (..))
import Base.Result qualified as Result
import Cli.FrameTable qualified as FrameTable
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Control.Exception (IOException, try)
import Control.Monad (forM_)
import Data.Bifunctor (first)
import Data.List (nub, sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (expected, readText)
import Frame.Frame qualified as Frame
import Machines qualified
import Report.Human qualified as Human
import Report.Report (Report)
import Report.Report qualified as Report
import Surface.Import qualified as Import
import System.Directory (listDirectory)
import System.FilePath (dropExtension, takeExtension, (<.>), (</>))
import Test.Hspec

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
    texts <- Compile.load (Import.byName reader) file =<< readText file
    let outcome =
          Compile.analyse values texts `Result.thenSound` \a ->
            let m =
                  Machines.ownOr Machines.lkp01f texts a
             in Compile.punch m (path a) `Result.thenSound` \p -> pure (a, m, p)
        rendered reports = Text.concat [render r <> "\n" | r <- Report.sorted reports]
        render = Human.render Human.Plain (Text.pack file) (Compile.source texts) :: Report -> Text
    case Result.settled outcome of
      Nothing -> expectationFailure (Text.unpack (rendered (errors outcome)))
      Just (a, m, p) -> do
        fs <-
          maybe
            (fail "the tape cannot be read")
            pure
            (output (Compile.readTape m (Frame.start (program p)) (tape p)))
        map Report.title (errors (Compile.prove m (path a) (program p) fs)) `shouldBe` []
        expected
          (expectations </> run <.> "frames")
          (FrameTable.frames m (Compile.source texts) (program p) <> rendered (warnings outcome))
  where
    expectations = "examples/expected"

-- | The names of the files of a kind in a folder, without their endings.
named :: String -> FilePath -> IO [FilePath]
named ending folder =
  sort . map dropExtension . filter ((== ending) . takeExtension) <$> listDirectory folder

-- | Imported files are read as they stand.
reader :: FilePath -> IO (Either Text Text)
reader file = first why <$> try (readText file)
  where
    why :: IOException -> Text
    why = Text.pack . show
