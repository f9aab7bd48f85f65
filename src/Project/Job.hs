-- | The choices of one run of the compiler: parameter values, machines, verification.
module Project.Job
  ( Job (..),
    Verification (..),
    forTargets,
    forOwnMachine,
  )
where

import Base.Result (Result)
import Data.Text (Text)
import Machine.Machine (Machine)
import Part.Part (Part)
import Project.LoadedProgram (LoadedProgram (descriptions))
import Project.Target qualified as Target
import Report.Report (Report)
import Toolpath.Toolpath (Toolpath)

-- | The choices of one run.
data Job = Job
  { -- | values for parameters of the program, by their names
    values :: [(Text, Text)],
    -- | chooses the machines for a part and its toolpath; without machines no tape is made
    machinesFor :: Part -> Toolpath -> Result Report Report [Machine],
    verification :: Verification
  }

-- | The check of a tape. A verified tape is read back and its motions are compared with the part;
-- an unverified one is only written.
data Verification = Verified | Unverified
  deriving stock (Eq, Show)

-- | A job that makes a verified tape for each of the named machines. Without names the machine is
-- the one that the program names; it is an error if the program names none.
forTargets :: [Text] -> [(Text, Text)] -> LoadedProgram -> Job
forTargets names values loaded =
  Job {values, machinesFor = Target.targets (descriptions loaded) names, verification = Verified}

-- | A job that makes a verified tape for the machine that the program names, or no tape if the
-- program names none.
forOwnMachine :: [(Text, Text)] -> LoadedProgram -> Job
forOwnMachine values loaded =
  Job {values, machinesFor = Target.ownMachines (descriptions loaded), verification = Verified}
