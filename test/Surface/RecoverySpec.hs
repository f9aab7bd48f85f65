-- | One mistake gives one report: the text around it is parsed or skipped without reports.
module Surface.RecoverySpec (spec) where

import Base.Result qualified as Result
import Control.Monad (forM_)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report qualified as Report
import Surface.Error (Error)
import Surface.Error qualified as Error
import Surface.Parser qualified as Parser
import Surface.Syntax (Program)
import Test.Hspec

spec :: Spec
spec =
  describe "one mistake gives one report" $
    forM_ cases $ \(what, text, title) ->
      it what $
        map
          (Report.title . Error.toReport)
          (Result.errors (Parser.parse 0 (Text.unlines text) :: Result.Result () Error Program))
          `shouldBe` [title]

-- | Descriptions, the lines of texts with one mistake each, and the titles of the reports.
cases :: [(String, [Text], Text)]
cases =
  [ ( "before settings of two words",
      ["mill f(1 2) right {", "  start near p", "  lead in arc 5", "  plunge slowly", "}", "aux 3"],
      "‘)’ or ‘,’ is needed here, not the number 2"
    ),
    ( "before settings whose brace is missing",
      ["mill a outside", "  lead in arc 5", "  plunge slowly", "}", "aux 3"],
      "‘{’ is needed after ‘outside’, but the line ends"
    ),
    ( "before elements of two words",
      ["contour c clsed {", "  a tangent", "  b tangent", "}", "aux 3"],
      "‘closed’, ‘from’ or ‘open’ is needed here, not ‘clsed’"
    ),
    ( "before a block of statements",
      ["if f(a, ) {", "  aux 1", "} else {", "  aux 2", "}", "aux 3"],
      "a value is needed here, not ‘)’"
    ),
    ( "before a line that continues with a reserved word",
      ["assert (1 2) and", "  not a", "aux 3"],
      "‘)’ or ‘,’ is needed here, not the number 2"
    )
  ]
