-- | Programs that the subcommand @import@ writes from drawings.
module Surface.DrawingProgramSpec
  ( spec,
  )
where

import Base.Quantity (LengthUnit (..))
import Base.Region qualified as Region
import Base.Result (Result (..))
import Control.Monad (forM_)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.List (isInfixOf, sort)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Vector qualified as Vector
import Drawing.OutlineTolerance qualified as Tolerance
import Files (filesBelow)
import Generate.RelativePath (RelativePath (..), relativePath)
import Report.Report qualified as Report
import Reports qualified
import Surface.DrawingError (DrawingMistake)
import Surface.DrawingError qualified as DrawingError
import Surface.DrawingProgram qualified as DrawingProgram
import System.FilePath (takeExtension, takeFileName)
import Test.Hspec
import Test.QuickCheck hiding (Result (..))

spec :: Spec
spec = describe "programs from drawings" $ do
  files <- runIO (sort <$> filesBelow "test/data/drawings")
  forM_ [f | f <- files, takeExtension f `elem` [".dxf", ".svg"]] $ \file ->
    it ("name the lines of the entities of " <> takeFileName file) $ do
      content <- ByteString.readFile file
      -- Files of R12 have no unit.
      let stated = if "_r12" `isInfixOf` file then Just Millimetres else Nothing
          program = fromMaybe "" (output (imported stated (Text.pack file) content))
          rows = Vector.fromList (Text.lines (Encoding.decodeLatin1 content))
          told =
            [ (word, number)
              | (_, comment) <- map (Text.breakOn "-- ") (Text.lines program),
                [word, "line", number] <- [Text.words (Text.replace "," "" (Text.drop 3 comment))]
            ]
          hasWord (word, number) =
            maybe False (Text.isInfixOf word) (rows Vector.!? (read (Text.unpack number) - 1))
      filter (not . hasWord) told `shouldBe` []
      told `shouldNotBe` []
  it "take only the layers that are named, and refuse others (catches all layers)" $ do
    content <- ByteString.readFile "test/programs/drawing/bad/centres.dxf"
    let from layers = importedLayers layers Nothing "centres.dxf" content
        layersIn = filter ("-- Layer " `Text.isPrefixOf`) . Text.lines . fromMaybe "" . output
    layersIn (from ["twice", "MARK", "Twice"]) `shouldBe` ["-- Layer TWICE", "-- Layer MARK"]
    length (layersIn (from [])) `shouldBe` 4
    let refused = from ["MARK", "none"]
    (map (Report.code . DrawingError.toReport) (errors refused), output refused)
      `shouldBe` (["E0124"], Nothing)
  it "make no table of circles on one centre (catches holes that are drilled twice)" $ do
    content <- ByteString.readFile "test/programs/drawing/bad/centres.dxf"
    let tablesIn layer =
          length . filter ("table " `Text.isPrefixOf`) . Text.lines . fromMaybe "" . output $
            importedLayers [layer] Nothing "centres.dxf" content
    map tablesIn ["SINK", "MARK"] `shouldBe` [0, 1]
  it
    "have no mistake and all steps of a relative path (catches a point that is written twice)"
    $ property $
      forAll relativePath $ \RelativePath {steps, svgOfPath} ->
        case imported Nothing "path.svg" svgOfPath of
          Result {errors = [], warnings = [], output = Just text} ->
            counterexample (Text.unpack text) $
              let isElement l = any (`Text.isPrefixOf` Text.strip l) starts
                  arcs = [s | s@('a' : _) <- steps]
               in conjoin
                    [ length (filter isElement (Text.lines text)) === length steps + length arcs,
                      map Report.title (filter Report.isError (reportsOn text)) === []
                    ]
          found -> counterexample (show found) False
  where
    reportsOn = Reports.onProgram . Region.fromText "path.part"
    starts = ["(", "cw ", "ccw "]

-- | The program of a drawing in a file with a name, with the unit that the command states.
imported ::
  Maybe LengthUnit -> Text -> ByteString -> Result DrawingMistake DrawingMistake Text
imported stated name content =
  importedLayers [] stated name content

-- | The program of some layers of a drawing, or of all if none is named.
importedLayers ::
  [Text] -> Maybe LengthUnit -> Text -> ByteString -> Result DrawingMistake DrawingMistake Text
importedLayers layers stated name content =
  DrawingProgram.convert name stated Tolerance.joining layers shown content
  where
    shown = Encoding.decodeLatin1 content
