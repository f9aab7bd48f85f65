-- | Fixes mend: a program to which a fix is applied no longer has the report that offered it, and
-- has no new error.
module FixesSpec (spec) where

import Base.Region (Source)
import Base.Result (Result (..))
import Control.Monad (filterM, forM, forM_)
import Data.List (sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
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
  forM_ mistakes $ \(name, wanted, text) ->
    it ("mend " <> name) $ do
      let file = "mistake.part"
      (_, reports) <- checked file text
      map code reports `shouldContain` [wanted]
      [f | r <- reports, code r == wanted, f <- fixes r] `shouldSatisfy` (not . null)
      mends file text

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
    stage (ReportCode c) = Text.take 3 c

-- | Counts of the errors with each code.
counts :: [Report] -> Map ReportCode Int
counts reports = Map.fromListWith (+) [(code r, 1) | r <- reports]

-- | Source of a text, and its reports.
checked :: FilePath -> Text -> IO (Source, [Report])
checked file text = do
  loaded <- LoadedProgram.load (Import.byName reader) file text
  let result = Snapshot.whole (Snapshot.checkWith [] loaded)
  pure (LoadedProgram.source loaded, Report.sorted (errors result <> warnings result))
  where
    reader name = do
      exists <- doesFileExist name
      if exists then Right <$> readText name else pure (Left "there is no such file")

-- | Programs in a folder and the folders in it.
partsIn :: FilePath -> IO [FilePath]
partsIn folder = do
  names <- map (folder </>) <$> listDirectory folder
  folders <- filterM doesDirectoryExist names
  deeper <- traverse partsIn folders
  pure ([name | name <- names, takeExtension name == ".part"] <> concat deeper)

-- | Mistakes that users make: a name, the code of the report, and the program.
mistakes :: [(String, ReportCode, Text)]
mistakes =
  [ ("a decimal comma", "E0108", program "let a = 1,5 mm"),
    ("a name that is misspelt", "E0201", program "let depth = 3\nlet b = deptth * 2"),
    ("a keyword that is misspelt", "E0106", program "lett a = 3"),
    ("a value that is declared by its type", "E0106", program "point p = (1, 2)"),
    ("a statement that ends in a semicolon", "E0102", program "let a = 3;\nlet b = 4"),
    ("a comment after #", "E0102", program "let a = 3 # three"),
    ("a minus of typography", "E0102", program "let a = −3"),
    ("degrees as °", "E0102", program "let a = 45°"),
    ("a product with ×", "E0102", program "let a = 3 × 4"),
    ("a circle without its sense", "E0211", program "contour k closed { circle((10, 0), 5) }"),
    ("a comparison with ==", "E0101", program "assert 3 == 3")
  ]
  where
    program line = "part a \"test\"\n" <> line <> "\n"
