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
  DrawingProgram.convert name stated Tolerance.joining (Encoding.decodeLatin1 content) content
