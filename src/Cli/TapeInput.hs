-- | The tape that a command works on: that of a program, or a file.
module Cli.TapeInput
  ( onFirstMachine,
    withTapeFile,
  )
where

import Base.Result (Result)
import Base.Result qualified as Result
import Cli.Error (Error (NoMachineForTape))
import Cli.InputFile (Input (..), descriptionsFor, displayName, readBytes)
import Cli.Outcome (failWith, failWithReport)
import Cli.Output (Exit, Reporter)
import Compile (Compiled)
import Compile qualified
import Data.Maybe (maybeToList)
import Data.Text (Text)
import Machine.Machine (Machine)
import Project.Error qualified as Project
import Project.Job (Job (verification), Verification (..))
import Project.Job qualified as Job
import Project.Target qualified as Target
import Report.Report (Report)
import Tape.Tape (Tape (..))

-- | Compiles a program for the machine @target@; if this is nothing, for the machine that the
-- program names. The tape is not verified.
onFirstMachine :: Maybe Text -> Input -> Result Report Report Compiled
onFirstMachine target given = do
  tapes <- Compile.compile job {verification = Unverified} (loaded given)
  case tapes of
    first : _ -> pure first
    [] -> Result.failed (Project.toReport (Project.NoMachine Target.builtInNames Nothing))
  where
    job = Job.forTargets (maybeToList target) (values given) (loaded given)

-- | Continues with a tape for which there is no program, and with its machine. Without @target@,
-- the name or the file of a machine, the command fails.
withTapeFile :: Reporter -> Maybe Text -> FilePath -> (Machine -> Tape -> IO Exit) -> IO Exit
withTapeFile reporter target tapeFile continue = case target of
  Nothing -> failWith reporter tapeName (NoMachineForTape Target.builtInNames)
  Just wanted -> do
    descriptions <- descriptionsFor [wanted] []
    case Target.machineNamed descriptions wanted of
      Left e -> failWithReport reporter tapeName (Project.toReport e)
      Right machine ->
        readBytes tapeFile >>= either (failWith reporter tapeName) (continue machine . Tape)
  where
    tapeName = displayName tapeFile
