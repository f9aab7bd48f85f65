-- | Each picture of the documents is the drawing of the program above it, or of the run of a tape.
--
-- With PARTC_RECORD set, the pictures are drawn again (@make pictures@); without it a missing
-- picture is a failure.
module PicturesSpec (spec) where

import Base.Result qualified as Result
import Blocks (Block (..))
import Blocks qualified
import Command (inFolder, partc)
import Compile (Analysis (..))
import Compile qualified
import Control.Monad (forM_)
import Data.ByteString qualified as ByteString
import Data.List (isPrefixOf, sort)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Draw.Plot qualified as Plot
import Draw.PlotSettings qualified as PlotSettings
import Files (readText)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report qualified as Report
import System.Directory (createDirectoryIfMissing, listDirectory)
import System.Environment (lookupEnv)
import System.Exit (ExitCode (..))
import System.FilePath (takeFileName, (<.>), (</>))
import Test.Hspec

spec :: Spec
spec = describe "pictures are what partc plot draws" $ do
  files <- runIO Blocks.documents
  shown <- runIO (concat <$> traverse withPictures files)
  recording <- runIO (lookupEnv "PARTC_RECORD")
  runIO (createDirectoryIfMissing True folder)
  forM_ shown $ \(file, block, name) -> it (file <> ": " <> Text.unpack name) $ do
    texts <- Blocks.load file block
    drawn recording (folder </> Text.unpack name <.> "svg") texts
  it "docs/flange.svg: the flange" $ do
    text <- readText "examples/flange.part"
    drawn recording "docs/flange.svg" (LoadedProgram.fromText "flange.part" text)
  forM_ runs $ \(name, options) -> it ("partc " <> unwords options) $ do
    (code, svg, _) <- partc options
    code `shouldBe` ExitSuccess
    compared recording (folder </> name <.> "svg") (Text.pack svg)
  inGallery <- runIO (map words . filter isCommand . lines <$> readFile gallery)
  forM_ inGallery $ \command -> it (unwords command) $
    inFolder $ \temporary -> do
      (code, _, _) <- partc (drop 1 (init command) <> [temporary </> "picture.svg"])
      code `shouldBe` ExitSuccess
      readText (temporary </> "picture.svg") >>= compared recording (last command)
  it "no picture is left over" $ do
    present <- listDirectory folder
    sort present
      `shouldBe` sort
        ( map (<.> "svg") ([Text.unpack name | (_, _, name) <- shown] <> map fst runs)
            <> map (takeFileName . last) inGallery
        )
  where
    gallery = "docs/gallery.md"
    isCommand = ("    partc " `isPrefixOf`)
    folder = "docs/pictures"
    cone = ["run", "examples/cone.n55.tape", "-t", "n55"]
    runs =
      [ ("speed", cone <> ["--speed"]),
        ("dispatcher", cone <> ["--timeline", "--ticks", "3479900..3480400"])
      ]
    drawn recording target program = do
      let result = Compile.analyse [] program
      map Report.title (Result.errors result) `shouldBe` []
      forM_ (Result.output result) $ \a ->
        compared recording target (Plot.plot PlotSettings.standard (part a) (path a))
    compared recording target svg = case recording of
      Just _ -> ByteString.writeFile target (Encoding.encodeUtf8 svg)
      -- Only the comparison: a failure would print both texts.
      Nothing -> readText target >>= \old -> (old == svg) `shouldBe` True
    withPictures file = do
      text <- readText file
      pure [(file, b, name) | b <- Blocks.blocks text, Just name <- [picture b]]
