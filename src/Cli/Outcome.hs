-- | The last steps of subcommands: report an error, print a result, or continue with a result that
-- has no errors.
module Cli.Outcome
  ( failWith,
    failWithReport,
    whenSound,
    evaluated,
    printResult,
    exitAfterWriting,
  )
where

import Base.Crash (bug)
import Base.Region (Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Cli.Error (Error (CannotWrite))
import Cli.Error qualified as Cli
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Cli.Progress qualified as Progress
import Control.Exception (evaluate)
import Control.Monad (void)
import Data.Text (Text)
import Report.Report (Report)

-- | Fails with an error that concerns a whole file. The text is the file's name in the report; it
-- is empty for an error that concerns no file.
failWith :: Reporter -> Text -> Error -> IO Exit
failWith reporter name = failWithReport reporter name . Cli.toReport

-- | Fails with a report that concerns a whole file.
failWithReport :: Reporter -> Text -> Report -> IO Exit
failWithReport reporter name report =
  Failed <$ Output.showReports reporter name (Region.fromText name "") [report]

-- | Computes a result, writes its reports, and continues with its output if no report stops the
-- command, see 'Output.showReports'. The name and the source are those of the program.
whenSound :: Reporter -> Text -> Source -> Result Report Report a -> (a -> IO Exit) -> IO Exit
whenSound reporter name source result continue = do
  Progress.during ("working on " <> name) (evaluated result)
  isStopped <- Output.showReports reporter name source (errors result <> warnings result)
  case output result of
    Just a | not isStopped -> continue a
    Nothing | not isStopped -> bug "a stage gave neither an output nor a report"
    _ -> pure Failed

-- | Evaluates a result until all its errors and warnings are known.
evaluated :: Result w e a -> IO ()
evaluated result = void (evaluate (length (errors result) + length (warnings result)))

-- | Prints the result of a command on standard output.
printResult :: Reporter -> Text -> IO Exit
printResult reporter text =
  Output.result text >>= exitAfterWriting reporter "" "to standard output"

-- | The exit status after writing. The arguments: the name of the file in the report, the
-- destination as the report calls it, and the result of writing, with the reason of a failure.
exitAfterWriting :: Reporter -> Text -> Text -> Either Text () -> IO Exit
exitAfterWriting reporter name destination written = case written of
  Left why -> failWith reporter name (CannotWrite destination why)
  Right () -> pure Done
