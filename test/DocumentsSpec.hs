-- | Checks of the documents: their programs compile, and their table of report codes is complete.
module DocumentsSpec (spec) where

import Base.Result qualified as Result
import Blocks qualified
import Codes qualified
import Compile qualified
import Control.Monad (forM_)
import Data.Set qualified as Set
import Data.Text qualified as Text
import Files (readText)
import Report.Report qualified as Report
import Test.Hspec

spec :: Spec
spec = do
  documents <- runIO Blocks.documents
  forM_ documents $ \file -> do
    text <- runIO (readText file)
    forM_ (zip [1 :: Int ..] (Blocks.blocks text)) $ \(n, block) ->
      it (file <> ": program " <> show n <> " compiles") $ do
        texts <- Blocks.load file block
        map Report.title (Result.errors (Compile.analyse [] texts)) `shouldBe` []
  it "README.md and docs/tour-cnc.md show the program of examples/cnc/cover.part" $ do
    cover <- Text.strip . snd . Text.breakOn "part cover" <$> readText "examples/cnc/cover.part"
    Text.length cover `shouldSatisfy` (> 0)
    forM_ ["README.md", "docs/tour-cnc.md"] $ \file -> do
      programs <- map Blocks.program . Blocks.blocks <$> readText file
      map Text.strip programs `shouldContain` [cover]
  it "docs/language.md lists every report code, and no other" $ do
    codes <- Codes.inSources
    manual <- readText "docs/language.md"
    let listed =
          Set.fromList
            [ c
              | line <- Text.lines manual,
                c <- take 1 (drop 1 (map Text.strip (Text.splitOn "|" line))),
                Codes.isCode c
            ]
    listed `shouldBe` codes
