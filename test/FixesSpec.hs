-- | Fixes mend: a program to which a fix is applied no longer has the report that offered it, and
-- has no new error.
module FixesSpec (spec) where

import Base.Region (Source)
import Base.Region qualified as Region
import Base.Result (Result (..), mapErrors)
import Control.Monad (filterM, forM, forM_)
import Data.ByteString qualified as ByteString
import Data.List (sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Font.TrueType qualified as TrueType
import Machine.Error qualified as Machine
import Machine.FromText qualified as Machine
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot qualified as Snapshot
import Report.Fix (Fix (..))
import Report.Fix qualified as Fix
import Report.Report (Report (code, fixes), ReportCode (..))
import Report.Report qualified as Report
import Surface.Import qualified as Import
import System.Directory (doesDirectoryExist, doesFileExist, listDirectory)
import System.FilePath (takeExtension, (</>))
import Test.Hspec

spec :: Spec
spec = describe "fixes" $ do
  files <- runIO (sort . concat <$> traverse partsIn ["test/programs", "test/unfit"])
  forM_ files $ \file ->
    it file (readText file >>= mends file)
  lists <- runIO (sort . filter ((== ".txt") . takeExtension) <$> listDirectory wrongPrograms)
  forM_ lists $ \list -> do
    text <- runIO (readText (wrongPrograms </> list))
    describe list . forM_ (wrongIn text) $ \Wrong {name, reported, program} ->
      it name $ do
        (_, reports) <- checked (checkedAs list) program
        sort (map code reports) `shouldBe` sort (map fst reported)
        [code r | r <- reports, null (fixes r), (code r, True) `elem` reported] `shouldBe` []
        mends (checkedAs list) program

-- | Folder with lists of wrong programs.
wrongPrograms :: FilePath
wrongPrograms = "test/data/wrong"

-- | Name under which the programs of a list are checked: that of an input sheet, of a machine
-- description or of a part program.
checkedAs :: FilePath -> FilePath
checkedAs list = case list of
  "sheet.txt" -> "wrong.sheet"
  "machine.txt" -> "wrong.machine"
  _ -> "wrong.part"

-- | Program with a mistake, and the codes of its reports. The flag of a code is true if its reports
-- must have fixes.
data Wrong = Wrong {name :: String, reported :: [(ReportCode, Bool)], program :: Text}

-- | Wrong programs of a list. A line that begins with == has the name of a mistake and, after the
-- last colon, the codes of the reports. The program follows. Text before the first of these lines
-- is a comment.
wrongIn :: Text -> [Wrong]
wrongIn text = map one (drop 1 (Text.splitOn "\n== " ("\n" <> text)))
  where
    one block =
      let (heading, rest) = Text.breakOn "\n" block
          (named, listed) = Text.breakOnEnd ":" heading
       in Wrong
            { name = Text.unpack (Text.dropEnd 1 named),
              reported = codesOf (Text.words listed),
              program = Text.drop 1 rest <> "\n"
            }
    codesOf ws = case ws of
      c : "unfixed" : more -> (ReportCode c, False) : codesOf more
      c : more -> (ReportCode c, True) : codesOf more
      [] -> []

-- | Expects that every fix of every report on a text mends it: the report is gone, and no new error
-- came. Of several fixes of one report, among which the user has to choose, one has to bring no new
-- error.
mends :: FilePath -> Text -> Expectation
mends file text = do
  (source, reports) <- checked file text
  forM_ reports $ \r -> do
    let own = filter (Fix.isWithin source) (fixes r)
        was = counts reports
        occurs = Map.findWithDefault 0
    results <- forM own $ \f -> do
      (_, left) <- checked file (Fix.applied source (edits f))
      let now = counts left
          new = [c | (c, n) <- Map.toList now, c /= code r, n > occurs c was]
      (title f, occurs (code r) now) `shouldSatisfy` ((< occurs (code r) was) . snd)
      pure (title f, code r, filter (not . isLater (code r)) new)
    case results of
      [] -> pure ()
      _ -> results `shouldSatisfy` any (\(_, _, new) -> null new)

-- | True for a code of a later stage. Its errors show only when those of earlier stages are gone.
isLater :: ReportCode -> ReportCode -> Bool
isLater earlier later = stage later > stage earlier
  where
    -- Moves are compared with all contours only if every statement has its toolpath. Of the moves
    -- of one statement, only the one that cuts deepest is reported.
    stage (ReportCode c)
      | c `elem` ["E0405", "E0413"] = Text.take 3 c <> "later"
      | c == "E0406" = Text.take 3 c <> "latest"
      | otherwise = Text.take 3 c

-- | Counts of the errors with each code.
counts :: [Report] -> Map ReportCode Int
counts reports = Map.fromListWith (+) [(code r, 1) | r <- reports]

-- | Source of a text, and its reports.
checked :: FilePath -> Text -> IO (Source, [Report])
checked file text = case takeExtension file of
  ".machine" -> do
    let result = mapErrors id Machine.toReport (Machine.read text)
    pure (Region.fromText (Text.pack file) text, sortedReports result)
  _ -> do
    loaded <- LoadedProgram.load reader file text
    let result = Snapshot.whole (Snapshot.checkWith [] loaded)
    pure (LoadedProgram.source loaded, sortedReports result)
  where
    sortedReports result = Report.sorted (errors result <> warnings result)
    reader =
      (Import.byName (read' readText))
        { Import.bytes = read' ByteString.readFile,
          Import.glyphs = \font written ->
            read' ByteString.readFile font >>= traverse (`TrueType.glyphs` written),
          Import.listing = listDirectory
        }
    read' :: (FilePath -> IO a) -> FilePath -> IO (Either Text a)
    read' readAs name = do
      exists <- doesFileExist name
      if exists then Right <$> readAs name else pure (Left "there is no such file")

-- | Programs in a folder and the folders in it.
partsIn :: FilePath -> IO [FilePath]
partsIn folder = do
  names <- map (folder </>) <$> listDirectory folder
  folders <- filterM doesDirectoryExist names
  deeper <- traverse partsIn folders
  pure ([name | name <- names, takeExtension name == ".part"] <> concat deeper)
