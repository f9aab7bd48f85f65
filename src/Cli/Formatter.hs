-- | The subcommand @fmt@, which brings programs into the canonical layout.
module Cli.Formatter
  ( fmt,
  )
where

import Base.Region qualified as Region
import Base.Result (Result (..))
import Cli.Error (Error (..))
import Cli.Outcome (exitAfterWriting, failWith, printResult)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (Report)
import Surface.Error qualified as Surface
import Surface.Formatter qualified as Formatter
import Surface.Parser qualified as Parser
import Surface.Syntax (Program)

-- | Formats one program in place, or from standard input to standard output if the file is @-@. If
-- @checkOnly@ is true, it changes nothing: it prints the program's name and fails if the program
-- is not in the canonical layout.
fmt :: Reporter -> Bool -> FilePath -> IO Exit
fmt reporter checkOnly file
  | LoadedProgram.isInputSheet file = failWith reporter (Text.pack file) SheetLaidOut
  | otherwise = do
    bytes <- Output.readBytes file
    case fmap Encoding.decodeUtf8' bytes of
      Left why -> failWith reporter name (CannotRead why)
      Right (Left _) -> failWith reporter name NotUtf8
      Right (Right text) -> case Formatter.format text of
        Nothing -> Failed <$ reportMistakes reporter name text
        Just formatted -> replaceText reporter checkOnly file name text formatted
  where
    name = if file == "-" then "<stdin>" else Text.pack file

-- | Replaces the program @text@ in @file@ by the text @formatted@; @-@ is standard output. If
-- @checkOnly@ is true, nothing is replaced. The command then fails if the two texts differ, and
-- prints @name@, the file's name in reports.
replaceText :: Reporter -> Bool -> FilePath -> Text -> Text -> Text -> IO Exit
replaceText reporter checkOnly file name text formatted
  | checkOnly, formatted == text = pure Done
  | checkOnly = Failed <$ printResult reporter (name <> "\n")
  | file == "-" = printResult reporter formatted
  | formatted == text = pure Done
  | otherwise =
    Output.writeFileWhole file (Encoding.encodeUtf8 formatted)
      >>= exitAfterWriting reporter "" name

-- | Reports the syntax errors of a program, and returns True if there are any. @name@ is the name
-- of the file in reports, @text@ the program.
reportMistakes :: Reporter -> Text -> Text -> IO Bool
reportMistakes reporter name text =
  Output.showReports reporter name source (map Surface.toReport (errors parsed))
  where
    source = Region.fromText name program
    -- Columns in reports are counted without a byte order mark.
    program = Text.dropWhile (== '\xFEFF') (Text.take 1 text) <> Text.drop 1 text
    parsed = Parser.parse 0 program :: Result Report Surface.Error Program
