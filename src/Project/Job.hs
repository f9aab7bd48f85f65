-- | The choices of one run of the compiler: parameter values, machines, and verification of tapes.
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

-- | The choices of one run of the compiler.
data Job = Job
  { -- | values for parameters of the program: the name of each parameter and the text of its value
    values :: [(Text, Text)],
    -- | chooses the machines for a part and its toolpath; if it chooses none, no tape is made
    machinesFor :: Part -> Toolpath -> Result Report Report [Machine],
    verification :: Verification
  }

-- | The choice between a verified and an unverified tape. A verified tape is read back, and its
-- motions are compared with the part. An unverified tape is only written.
data Verification = Verified | Unverified
  deriving stock (Eq, Show)

-- | A job that makes a verified tape for each of the machines @names@. If there are no names, it
-- uses the machine that the program names. It is an error if the program names none either.
-- @values@ contains pairs of a parameter's name and the text of its value.
forTargets :: [Text] -> [(Text, Text)] -> LoadedProgram -> Job
forTargets names values loaded =
  Job {values, machinesFor = Target.targets (descriptions loaded) names, verification = Verified}

-- | A job that makes a verified tape for the machine that the program names. It makes no tape if
-- the program names none. @values@ contains pairs of a parameter's name and the text of its value.
forOwnMachine :: [(Text, Text)] -> LoadedProgram -> Job
forOwnMachine values loaded =
  Job {values, machinesFor = Target.ownMachines (descriptions loaded), verification = Verified}
