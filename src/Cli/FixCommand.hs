-- | The subcommand @fix@, which mends the mistakes whose reports leave no choice.
module Cli.FixCommand
  ( fix,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Position (..), Source)
import Base.Result (Result (..))
import Cli.Error (Error (..))
import Cli.InputFile (displayName, loadText, readProgram)
import Cli.Outcome (exitAfterWriting, failWith, printResult)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Project.FixRun (AppliedFix (..), Mended (..))
import Project.FixRun qualified as FixRun
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot qualified as Snapshot
import Report.Report (Report)
import Report.Report qualified as Report

-- | Mends one program in place, or from standard input to standard output if the file is @-@, and
-- prints what it changes. If @isDry@ is true, it writes no program. The reports that are left
-- follow; the command fails if errors are among them.
fix :: Reporter -> Bool -> FilePath -> IO Exit
fix reporter isDry file
  | LoadedProgram.isInputSheet file = failWith reporter name SheetLaidOut
  | otherwise = do
    content <- readProgram file
    case content of
      Left e -> failWith reporter name e
      Right text -> do
        mended <- FixRun.mend (checked reporter name) text
        written <- write reporter isDry file mended
        -- Warnings have nothing to do with the repair; partc check shows them.
        isStopped <-
          Output.showReports reporter name (source mended) (filter Report.isError (left mended))
        pure (max written (if isStopped then Failed else Done))
  where
    name = displayName file

-- | Source of a text, and the reports on it.
checked :: Reporter -> Text -> Text -> IO (Source, [Report])
checked reporter name text = do
  loaded <- loadText [] name text
  let result = Snapshot.whole (Snapshot.checkWith values loaded)
  pure (LoadedProgram.source loaded, Report.sorted (errors result <> warnings result))
  where
    values = Output.values (Output.settings reporter)

-- | Writes the mended program, and prints the changes.
write :: Reporter -> Bool -> FilePath -> Mended -> IO Exit
write reporter isDry file mended
  | file == "-" = printResult reporter (if isDry then shown else newText mended)
  | null (changes mended) = pure Done
  | isDry = printResult reporter shown
  | otherwise = do
    exit <-
      Output.writeFileWhole file (Encoding.encodeUtf8 (newText mended))
        >>= exitAfterWriting reporter "" (Text.pack file)
    if exit == Done then printResult reporter shown else pure exit
  where
    shown = Text.concat (map line' (changes mended))
    line' c =
      let Position {file = path, line, column} = place c
       in path
            <> ":"
            <> Decimal.whole line
            <> ":"
            <> Decimal.whole column
            <> ": "
            <> summary c
            <> "\n"
