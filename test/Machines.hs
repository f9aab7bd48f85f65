-- | The built-in machines, and the jobs that tests run.
module Machines
  ( named,
    lkp01f,
    lkiFm,
    lkiU,
    lkiUn,
    kontur2p,
    kontur3p,
    n55,
    iso6983,
    known,
    jobFor,
    jobForOwnOr,
  )
where

import Base.Crash (bug)
import Base.Result qualified as Result
import Data.Maybe (fromMaybe, isNothing)
import Data.Text (Text)
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Project.Job (Job (..), Verification (..))
import Project.LoadedProgram (LoadedProgram (descriptions))
import Project.Target qualified as Target

-- | A built-in machine by its name.
named :: Text -> Machine
named n = fromMaybe (bug ("there is no machine " <> n)) (BuiltIn.find (MachineName n))

lkp01f, lkiFm, lkiU, lkiUn, kontur2p, kontur3p, n55, iso6983 :: Machine
lkp01f = named "lkp-01f"
lkiFm = named "lki-fm"
lkiU = named "lki-u"
lkiUn = named "lki-un"
kontur2p = named "kontur-2p"
kontur3p = named "kontur-3p"
n55 = named "n55"
iso6983 = named "iso6983"

-- | All built-in machines whose tapes consist of their frames only.
known :: [Machine]
known = filter (isNothing . Machine.programForm) BuiltIn.machines

-- | A job that makes a verified tape for this machine, whichever machine the program names.
jobFor :: Machine -> [(Text, Text)] -> Job
jobFor machine values =
  Job
    { values,
      machinesFor = \_ path -> pure [Target.setUpFor path machine],
      verification = Verified
    }

-- | A job that makes a verified tape for the machine that the program names. If it names none, or
-- none that can be found, the tape is for the given machine.
jobForOwnOr :: Machine -> [(Text, Text)] -> LoadedProgram -> Job
jobForOwnOr other values loaded = (jobFor other values) {machinesFor}
  where
    machinesFor part path =
      case Result.ifSound (Target.targets (descriptions loaded) [] part path) of
        Just machines -> pure machines
        Nothing -> pure [Target.setUpFor path other]
