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
import Machine.Lkp01f (lkp01f)
import Report.Report (Report)

-- | All errors and warnings, up to the limits of the machine.
onProgram :: Source -> [Report]
onProgram source = errors outcome <> warnings outcome
  where
    outcome = Compile.analyse [] (Compile.alone (Region.mainFile source) (Region.text source)) `Result.thenSound` \a -> void (Compile.punch lkp01f (path a))
