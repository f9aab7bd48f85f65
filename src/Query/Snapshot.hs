-- | A program at one moment, with everything that the answers to an editor need.
module Query.Snapshot
  ( Snapshot (..),
    Check,
    checkWith,
    take,
    isGood,
    importOf,
  )
where

import Base.Region (Region, Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Checked.Syntax qualified as Checked
import Compile (Analysis)
import Compile qualified
import Data.Bifunctor (first)
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Project.Job qualified as Job
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Query.Mention (Mentions)
import Query.Mention qualified as Mention
import Report.Report (Report)
import Report.Report qualified as Report
import Surface.Syntax (Program (..))
import Prelude hiding (take)

-- | A function that finds the mistakes of a program. Editors and the command line use the same one.
type Check = LoadedProgram -> Result Report Report Analysis

-- | Checks a program up to the frames for the machine that it names. The values are those of the
-- program's parameters, by their names.
checkWith :: [(Text, Text)] -> Check
checkWith values loaded = Compile.check (Job.forOwnMachine values loaded) loaded

-- | A program at one moment.
data Snapshot = Snapshot
  { -- | the text of the program, and the texts that it imports
    source :: Source,
    -- | errors and warnings, in the order of the text
    reports :: [Report],
    -- | the syntax tree of the text itself, without what it imports
    program :: Program,
    -- | the mentions of names, and the values of the definitions
    facts :: Mentions,
    -- | the region of each import, and the path of the file that it names
    imports :: [(Region, Text)]
  }

-- | Takes a snapshot of a program.
take :: Check -> LoadedProgram -> Snapshot
take check loaded =
  Snapshot
    { source,
      reports,
      program,
      facts = Mention.facts known,
      imports = LoadedProgram.imports loaded
    }
  where
    source = LoadedProgram.source loaded
    result = check loaded
    reports = Report.sorted (errors result <> warnings result)
    whole = Maybe.fromMaybe (Program [] []) (output (LoadedProgram.surface loaded))
    program = whole {statements = filter (isOwn . Region.start . Region.region) (statements whole)}
    isOwn offset = offset <= Text.length (Region.text source)
    known = case output result of
      Just analysis -> Just (Compile.mentions analysis, Compile.part analysis)
      Nothing -> first Checked.mentions <$> output (Compile.evaluate [] loaded)

-- | Has the program no errors? Warnings are allowed.
isGood :: Snapshot -> Bool
isGood = not . any Report.isError . reports

-- | The import statement of the program that includes the file of a region, directly or through
-- other imports. Nothing for a region of the program itself.
importOf :: Snapshot -> Region -> Maybe Region
importOf Snapshot {source, imports} = go (length imports)
  where
    go steps region = case Region.file (Region.position source (Region.start region)) of
      file
        | file == Region.mainFile source || steps < 0 -> Nothing
        | otherwise -> case [at | (at, named) <- imports, named == file] of
          at : _ -> Just (Maybe.fromMaybe at (go (steps - 1) at))
          [] -> Nothing
