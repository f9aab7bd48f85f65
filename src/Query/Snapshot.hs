-- | A program at one moment, with all that its text says: what editors are answered from.
module Query.Snapshot
  ( Snapshot (..),
    Check,
    take,
    isGood,
  )
where

import Base.Region (Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Compile (Analysis)
import Data.Maybe qualified as Maybe
import Query.Facts (Facts)
import Query.Facts qualified as Facts
import Report.Report (Report)
import Report.Report qualified as Report
import Surface.Parser qualified as Surface
import Surface.Syntax (Program (..))
import Prelude hiding (take)

-- | What looks for the mistakes of a program: the same for editors as for the command line.
type Check = Source -> Result Report Report Analysis

-- | The texts, what is wrong with them, the syntax tree, what is known of the names.
data Snapshot = Snapshot {source :: Source, reports :: [Report], program :: Program, facts :: Facts}

-- | Look at a program.
take :: Check -> Source -> Snapshot
take check source = Snapshot {source, reports, program, facts = Facts.facts source program (output result)}
  where
    result = check source
    reports = Report.sorted (errors result <> warnings result)
    program = Maybe.fromMaybe (Program [] []) (output (Surface.parse (Region.text source)))

-- | Whether the program has no errors.
isGood :: Snapshot -> Bool
isGood = not . any Report.isError . reports
