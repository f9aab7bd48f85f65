-- | A program at one moment, with all that its text says: what editors are answered from.
module Query.Snapshot
  ( Snapshot (..),
    Check,
    take,
    isGood,
    broughtBy,
  )
where

import Base.Region (Region, Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Checked.Syntax qualified as Checked
import Compile (Analysis, LoadedProgram)
import Compile qualified
import Data.Bifunctor (first)
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Mention (Mentions)
import Query.Mention qualified as Mention
import Report.Report (Report)
import Report.Report qualified as Report
import Surface.Syntax (Program (..))
import Prelude hiding (take)

-- | What looks for the mistakes of a program: the same for editors as for the command line.
type Check = LoadedProgram -> Result Report Report Analysis

-- | The texts, what is wrong with them, the syntax tree, what is known of the names, where each
-- import stands and the file that it names.
data Snapshot = Snapshot
  { source :: Source,
    reports :: [Report],
    program :: Program,
    facts :: Mentions,
    imports :: [(Region, Text)]
  }

-- | Look at a program.
take :: Check -> LoadedProgram -> Snapshot
take check loaded =
  Snapshot {source, reports, program, facts = Mention.facts known, imports = Compile.imports loaded}
  where
    source = Compile.source loaded
    result = check loaded
    reports = Report.sorted (errors result <> warnings result)
    whole = Maybe.fromMaybe (Program [] []) (output (Compile.surface loaded))
    -- What the text itself says, without what it imports.
    program =
      whole
        { statements =
            filter
              ((<= Text.length (Region.text source)) . Region.start . Region.region)
              (statements whole)
        }
    known = case output result of
      Just analysis -> Just (Compile.mentions analysis, Compile.part analysis)
      Nothing -> first Checked.mentions <$> output (Compile.evaluated [] loaded)

-- | Whether the program has no errors.
isGood :: Snapshot -> Bool
isGood = not . any Report.isError . reports

-- | Where a program shows what lies in a file that it imports: at the import that brings it,
-- directly or by way of others. Nothing for a place in the program itself.
broughtBy :: Snapshot -> Region -> Maybe Region
broughtBy Snapshot {source, imports} = go (length imports)
  where
    go steps region = case Region.file (Region.position source (Region.start region)) of
      file
        | file == Region.mainFile source || steps < 0 -> Nothing
        | otherwise -> case [at | (at, named) <- imports, named == file] of
          at : _ -> Just (Maybe.fromMaybe at (go (steps - 1) at))
          [] -> Nothing
