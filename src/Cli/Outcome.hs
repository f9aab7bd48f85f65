-- | The last steps of subcommands: report an error, print a result, or continue with a result that
-- has no errors. A 'Reporter' writes the reports of one run of partc.
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

-- | Reports an error that concerns a whole file; the exit status is 'Failed'. @name@ is the file's
-- name in the report. It is empty for an error that concerns no file.
failWith :: Reporter -> Text -> Error -> IO Exit
failWith reporter name = failWithReport reporter name . Cli.toReport

-- | Writes a report that concerns the whole file @name@; the exit status is 'Failed'.
failWithReport :: Reporter -> Text -> Report -> IO Exit
failWithReport reporter name report =
  Failed <$ Output.showReports reporter name (Region.fromText name "") [report]

-- | Computes @result@ and writes its reports. It continues with the output if no report stops the
-- command. A report stops it if it is an error, or a warning and warnings count as errors. @name@
-- is the program's name in reports, @source@ its text.
whenSound :: Reporter -> Text -> Source -> Result Report Report a -> (a -> IO Exit) -> IO Exit
whenSound reporter name source result continue = do
  Progress.during ("working on " <> name) (evaluated result)
  isStopped <- Output.showReports reporter name source (errors result <> warnings result)
  case output result of
    Just a | not isStopped -> continue a
    Nothing | not isStopped -> bug "a stage gave neither an output nor a report"
    _ -> pure Failed

-- | Evaluates a result until all its errors and warnings are known. 'Progress.during' runs this
-- action, so that the progress message is shown as long as the computation lasts.
evaluated :: Result w e a -> IO ()
evaluated result = void (evaluate (length (errors result) + length (warnings result)))

-- | Prints the result of a command on standard output. The exit status is 'Failed' if that fails.
printResult :: Reporter -> Text -> IO Exit
printResult reporter text =
  Output.result text >>= exitAfterWriting reporter "" "to standard output"

-- | The exit status of a command after its attempt to write a result. If @written@ is 'Left', the
-- attempt has failed for the given reason. The report of this failure begins "cannot write
-- @destination@". Its heading names the file @name@, or no file if @name@ is empty.
exitAfterWriting :: Reporter -> Text -> Text -> Either Text () -> IO Exit
exitAfterWriting reporter name destination written = case written of
  Left why -> failWith reporter name (CannotWrite destination why)
  Right () -> pure Done
