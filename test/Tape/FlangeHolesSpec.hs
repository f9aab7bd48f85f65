-- | Table in docs/machines.md: of all tapes of the flange with one hole added or removed, the share
-- that the reader refuses. If PARTC_RECORD is set, the test writes the table into the page.
module Tape.FlangeHolesSpec (spec) where

import Base.Decimal qualified as Decimal
import Compile (Punched (program), path)
import Compile qualified
import Data.ByteString qualified as ByteString
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Files (readText)
import Flange qualified
import Frame.Frame qualified as Frame
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Machines qualified
import System.Environment (lookupEnv)
import Tape.Holes (Share (..))
import Tape.Holes qualified as Holes
import Test.Hspec

spec :: Spec
spec = describe "docs/machines.md" $
  it
    "states the share of single wrong holes that the reader finds, for the flange on every machine \
    \(catches a reader that finds fewer)"
    $ do
      let rows = map row Machines.known
      page <- Text.lines <$> readText file
      let now = replaced (concat rows) page
      recording <- lookupEnv "PARTC_RECORD"
      case recording of
        Just _ -> ByteString.writeFile file (Encoding.encodeUtf8 (Text.unlines now))
        Nothing -> page `shouldBe` now
  where
    file = "docs/machines.md"
    replaced rows page =
      let (above, rest) =
            break (== heading) page
       in above
            <> (if null rest then [] else [heading, rule])
            <> rows
            <> dropWhile (Text.isPrefixOf "|") rest
    heading = "| machine | single holes | found by reading | read as other frames |"
    rule = "|---|--:|--:|--:|"

-- | Line of the table for a machine; none for a machine whose tape is a text.
row :: Machine -> [Text]
row machine = case Machine.pitch (Machine.medium machine) of
  Nothing -> []
  Just _ ->
    [ "| `"
        <> name
        <> "` | "
        <> Decimal.whole (tried s)
        <> " | "
        <> Decimal.fixed 2 (100 * fromIntegral (found s) / fromIntegral (tried s))
        <> " % | "
        <> Decimal.whole (length (unseen s))
        <> " |"
    ]
  where
    MachineName name = Machine.name machine
    punched = Flange.expect (Compile.punch machine (path Flange.analysis))
    s =
      Holes.share
        machine
        (Frame.start (program punched))
        (map Frame.frame (Frame.plannedFrames (program punched)))
