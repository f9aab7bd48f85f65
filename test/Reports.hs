-- | What the compiler says of a program, for tests.
module Reports
  ( onProgram,
  )
where

import Base.Region (Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Control.Monad (void)
import Machines qualified
import Report.Report (Report)

-- | All errors and warnings, up to the limits of the machine.
onProgram :: Source -> [Report]
onProgram source = errors outcome <> warnings outcome
  where
    loaded = Compile.alone (Region.mainFile source) (Region.text source)
    outcome =
      Compile.analyse [] loaded `Result.thenSound` \a ->
        void (Compile.punch (Machines.ownOr Machines.lkp01f loaded a) (path a))
