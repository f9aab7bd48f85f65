-- | The documents say what is true: their programs compile, their table of codes is complete.
module DocumentsSpec (spec) where

import Base.Result qualified as Result
import Codes qualified
import Compile qualified
import Control.Monad (forM_)
import Data.List (sort)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Report.Report qualified as Report
import System.Directory (listDirectory)
import System.FilePath (takeExtension, (</>))
import Test.Hspec

spec :: Spec
spec = do
  documents <- runIO (("README.md" :) . map ("docs" </>) . sort . filter ((== ".md") . takeExtension) <$> listDirectory "docs")
  forM_ documents $ \file -> do
    text <- runIO (readText file)
    forM_ (zip [1 :: Int ..] (programs text)) $ \(n, program) ->
      it (file <> ": program " <> show n <> " compiles") $
        map Report.title (Result.errors (Compile.analyse [] (Compile.alone "document" (whole program)))) `shouldBe` []
  it "docs/language.md lists every report code that there is, and no other" $ do
    codes <- Codes.inSources
    manual <- readText "docs/language.md"
    let listed = Set.fromList [c | line <- Text.lines manual, c <- take 1 (drop 1 (map Text.strip (Text.splitOn "|" line))), Codes.isCode c]
    listed `shouldBe` codes

-- | What stands between @```part@ and @```@.
programs :: Text -> [Text]
programs text = [fst (Text.breakOn "```" rest) | rest <- drop 1 (Text.splitOn "```part\n" text)]

-- | A piece of a program, made whole.
whole :: Text -> Text
whole program
  | "part " `elem` map (Text.take 5) (Text.lines program) = program
  | otherwise = "part p\nmachine lkp-01f\ntool mill(diameter 2 mm)\nfeed 60\ntolerance 0.02\nfrom (-200, -200)\n" <> program
