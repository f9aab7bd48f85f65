-- | Programs that the subcommand @import@ writes from drawings.
module Surface.DrawingProgramSpec
  ( spec,
  )
where

import Base.Region qualified as Region
import Base.Result (Result (..))
import Data.ByteString (ByteString)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Drawing.OutlineTolerance qualified as Tolerance
import Generate.RelativePath (RelativePath (..), relativePath)
import Report.Report qualified as Report
import Reports qualified
import Surface.DrawingError (DrawingMistake)
import Surface.DrawingProgram qualified as DrawingProgram
import Test.Hspec
import Test.QuickCheck hiding (Result (..))

spec :: Spec
spec = describe "programs from drawings" $
  it
    "have no mistake and all steps of a relative path (catches a point that is written twice)"
    $ property $
      forAll relativePath $ \RelativePath {steps, svgOfPath} ->
        case imported "path.svg" svgOfPath of
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

-- | The program of a drawing in a file with a name.
imported :: Text -> ByteString -> Result DrawingMistake DrawingMistake Text
imported name content =
  DrawingProgram.convert name Nothing Tolerance.joining (Encoding.decodeLatin1 content) content
