-- | A program at one moment, with all results that are needed to answer an editor.
module Query.Snapshot
  ( Snapshot (..),
    Check,
    checkWith,
    take,
    isGood,
    importOf,
    reloaded,
  )
where

import Base.Region (Region, Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Checked.Syntax qualified as Checked
import Compile (Analysis)
import Compile qualified
import Data.Bifunctor (first)
import Data.Functor.Identity (Identity (..))
import Data.List (partition)
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Part.Part (Part)
import Project.Job qualified as Job
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Query.Machining (MachineSummary)
import Query.Machining qualified as Machining
import Query.Mention (Mentions)
import Query.Mention qualified as Mention
import Report.Report (Report)
import Report.Report qualified as Report
import Surface.Import qualified as Import
import Surface.Syntax (Program (..), Statement)
import Toolpath.Toolpath (Toolpath)
import Prelude hiding (take)

-- | A function that checks a loaded program and gives its mistakes and its results. Editors and the
-- command line use the same function.
type Check = LoadedProgram -> Result Report Report (Analysis, [MachineSummary])

-- | Checks a program with all compiler passes up to the frames. The frames are those for the
-- machine that the program names. Each pair in @values@ has the name of a parameter and the text of
-- a value, which replaces the value of the parameter in the program.
checkWith :: [(Text, Text)] -> Check
checkWith values loaded =
  summarised <$> Compile.checkedFrames (Job.forOwnMachine values loaded) loaded
  where
    summarised (analysis, made) =
      (analysis, [Machining.summary (Compile.path analysis) m program | (m, program) <- made])

-- | A program at one moment, with the results of its check.
data Snapshot = Snapshot
  { -- | the text of the program, and the texts that it imports
    source :: Source,
    -- | errors and warnings, in the order of the text
    reports :: [Report],
    -- | the syntax tree of the program's own text, without the definitions that it imports
    program :: Program,
    -- | the mentions of names in the program, and the values of its definitions
    facts :: Mentions,
    -- | the file names in imports and table statements: the region of each name, and the path of
    -- the file
    imports :: [(Region, Text)],
    -- | the statements that come from imported files
    imported :: [Statement],
    -- | the evaluated part; absent if nothing of the program could be checked
    part :: Maybe Part,
    -- | the toolpath; absent if the program has an error before this stage
    path :: Maybe Toolpath,
    -- | the program on the machine that it names; empty if it names none, or has an error
    machines :: [MachineSummary]
  }

-- | Checks a program, and keeps its results as a snapshot.
take :: Check -> LoadedProgram -> Snapshot
take check loaded =
  Snapshot
    { source,
      reports,
      program,
      facts = Mention.facts known,
      imports = LoadedProgram.imports loaded,
      imported,
      part = snd <$> known,
      path = Compile.path . fst <$> output result,
      machines = maybe [] (\(_, made) -> foldr seq made made) (output result)
    }
  where
    source = LoadedProgram.source loaded
    result = check loaded
    reports = Report.sorted (errors result <> warnings result)
    whole = Maybe.fromMaybe (Program [] []) (output (LoadedProgram.surface loaded))
    (own, imported) = partition (isOwn . Region.start . Region.region) (statements whole)
    program = whole {statements = own}
    isOwn offset = offset <= Text.length (Region.text source)
    known = case output result of
      Just (analysis, _) -> Just (Compile.mentions analysis, Compile.part analysis)
      Nothing -> first Checked.mentions <$> output (Compile.evaluate [] loaded)

-- | True if the program has no errors. It may have warnings.
isGood :: Snapshot -> Bool
isGood = not . any Report.isError . reports

-- | Maps a region of an imported file or of a table file to the program's own text. The result is
-- the region of the file name in an import or a table statement of the program. This statement
-- reads the file that contains the given region, directly or through further imports. 'Nothing' if
-- the given region lies in the program itself.
importOf :: Snapshot -> Region -> Maybe Region
importOf Snapshot {source, imports} = go (length imports)
  where
    go steps region = case Region.file (Region.position source (Region.start region)) of
      file
        | file == Region.mainFile source || steps < 0 -> Nothing
        | otherwise -> case [at | (at, named) <- imports, named == file] of
          at : _ -> Just (Maybe.fromMaybe at (go (steps - 1) at))
          [] -> Nothing

-- | Loads another text of the program. The files that it imports have the texts that they have in
-- the snapshot, except those in @changed@: pairs of a path and a new text.
reloaded :: Snapshot -> [(Text, Text)] -> Text -> LoadedProgram
reloaded Snapshot {source} changed text =
  runIdentity (LoadedProgram.load (Import.byName reader) main text)
  where
    main = Text.unpack (Region.mainFile source)
    reader path =
      Identity
        ( maybe
            (Left "it is not part of the program")
            Right
            (lookup (Text.pack path) (changed <> drop 1 (Region.files source)))
        )
