-- | The reports on a program, for tests.
module Reports
  ( onProgram,
  )
where

import Base.Region (Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Compile qualified
import Machines qualified
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (Report)

-- | All errors and warnings of a program up to the frames, for the machine that it names or
-- lkp-01f.
onProgram :: Source -> [Report]
onProgram source = errors outcome <> warnings outcome
  where
    loaded = LoadedProgram.fromText (Region.mainFile source) (Region.text source)
    outcome = Compile.check (Machines.jobForOwnOr Machines.lkp01f [] loaded) loaded
