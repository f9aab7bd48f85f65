-- | The machines that are built in, for tests.
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
    ownOr,
    known,
  )
where

import Base.Crash (bug)
import Base.Result qualified as Result
import Cli.Target qualified as Target
import Compile (Analysis (path))
import Compile qualified
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))

-- | By its name.
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

-- | The machine that a program names, set up for it; for one that names none another one.
ownOr :: Machine -> Compile.LoadedProgram -> Analysis -> Machine
ownOr other loaded analysis =
  case Result.settled (Target.chosen (Compile.descriptions loaded) [] analysis) of
    Just (machine : _) -> machine
    _ -> Compile.onMachine (path analysis) other

known :: [Machine]
known = BuiltIn.machines
