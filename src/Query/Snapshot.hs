-- | A program at one moment, with all results that are needed to answer an editor.
module Query.Snapshot
  ( Snapshot (..),
    Check,
    Stages (..),
    checkWith,
    unanalysed,
    take,
    inStages,
    ofDescription,
    force,
    unit,
    isGood,
    hasFacts,
    hasFrames,
    importOf,
    identityOf,
    reloaded,
    loadedWith,
  )
where

import Base.Quantity (LengthUnit)
import Base.Region (Region, Source)
import Base.Region qualified as Region
import Base.Result (Result (..), mapErrors)
import Checked.Syntax qualified as Checked
import Compile (Analysis)
import Compile qualified
import Data.Bifunctor (first)
import Data.ByteString.Char8 qualified as Char8
import Data.Functor.Identity (Identity (..))
import Data.List qualified as List
import Data.Map.Strict qualified as Map
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Error qualified as Machine
import Machine.FromText qualified as Machine
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
import Surface.FileUnit qualified as FileUnit
import Surface.Import qualified as Import
import Surface.Syntax (Program (..), Statement)
import Toolpath.Toolpath (Toolpath)
import Prelude hiding (take)

-- | A function that checks a loaded program in two stages. Editors and the command line use the
-- same function.
type Check = LoadedProgram -> Stages

-- | The two stages of a check, each with its reports.
data Stages = Stages
  { -- | form, names, types and geometry
    evaluated :: Result Report Report (Checked.Program, Part),
    -- | the same, continued with the toolpath and the frames; it is computed on demand
    whole :: ~(Result Report Report (Analysis, [MachineSummary]))
  }

-- | Checks a program with all compiler passes up to the frames. The frames are those for the
-- machine that the program names. Each pair in @values@ has the name of a parameter and the text of
-- a value, which replaces the value of the parameter in the program.
checkWith :: [(Text, Text)] -> Check
checkWith values loaded =
  Stages
    { evaluated,
      whole = summarised <$> Compile.checkEvaluated (Job.forOwnMachine values loaded) evaluated
    }
  where
    evaluated = Compile.evaluate values loaded
    summarised (analysis, made) =
      (analysis, [Machining.summary (Compile.path analysis) m program | (m, program) <- made])

-- | A program at one moment, with the results of its check.
data Snapshot = Snapshot
  { -- | the text of the program, and the texts that it imports
    source :: Source,
    -- | errors and warnings, in the order of the text
    reports :: [Report],
    -- | those among the reports that come from the toolpath and the frames
    laterReports :: [Report],
    -- | the syntax tree of the program's own text, without the definitions that it imports
    program :: Program,
    -- | the mentions of names in the program, and the values of its definitions
    facts :: Mentions,
    -- | the file names in imports and table statements: the region of each name, and the path of
    -- the file
    imports :: [(Region, Text)],
    -- | the glyphs of the texts in fonts
    glyphRuns :: Import.GlyphRuns,
    -- | the statements that come from imported files
    imported :: [Statement],
    -- | the paths of all files on which the results depend, apart from the program's own
    dependencies :: [Text],
    -- | the paths of the program, its imports and its table files, each with the identity of the
    -- file: the same path for all paths that lead to the same file
    identities :: [(Text, Text)],
    -- | the evaluated part; absent if nothing of the program could be checked
    part :: Maybe Part,
    -- | the toolpath; absent if the program has an error before this stage
    path :: Maybe Toolpath,
    -- | the program on the machine that it names; empty if it names none, or has an error
    machines :: [MachineSummary]
  }

-- | The snapshot of a text that is not analysed: it has no results.
unanalysed :: Source -> Snapshot
unanalysed source =
  Snapshot
    { source,
      reports = [],
      laterReports = [],
      program = FileUnit.program 0 [] [],
      facts = Mention.none,
      imports = [],
      glyphRuns = Map.empty,
      imported = [],
      dependencies = [],
      identities = [(Region.mainFile source, Region.mainFile source)],
      part = Nothing,
      path = Nothing,
      machines = []
    }

-- | Checks a program, and keeps the results of all passes as a snapshot.
take :: Check -> LoadedProgram -> Snapshot
take check = snd . inStages check

-- | Checks a program, and keeps its results as two snapshots. The first one has the results of
-- evaluation: form, names, types and geometry. The second one has all results; it is computed on
-- demand.
inStages :: Check -> LoadedProgram -> (Snapshot, Snapshot)
inStages check loaded = (early, complete)
  where
    Stages {evaluated, whole} = check loaded
    early =
      Snapshot
        { source,
          reports = Report.sorted (both evaluated),
          laterReports = [],
          program = written {statements = own},
          facts = Mention.facts (first Checked.mentions <$> output evaluated),
          imports = LoadedProgram.imports loaded,
          glyphRuns = LoadedProgram.glyphRuns loaded,
          imported,
          dependencies = LoadedProgram.files loaded,
          identities = LoadedProgram.identities loaded,
          part = snd <$> output evaluated,
          path = Nothing,
          machines = []
        }
    complete =
      early
        { reports = Report.sorted (both whole),
          laterReports = Report.sorted later,
          path = Compile.path . fst <$> output whole,
          machines = foldMap (\(_, made) -> foldr seq made made) (output whole)
        }
    later =
      drop (length (errors evaluated)) (errors whole)
        <> drop (length (warnings evaluated)) (warnings whole)
    both result = errors result <> warnings result
    source = LoadedProgram.source loaded
    (own, imported) = List.partition isOwn (statements written)
    written = Maybe.fromMaybe (FileUnit.program 0 [] []) (output (LoadedProgram.surface loaded))
    isOwn s = Region.start (Region.region s) <= Text.length (Region.text source)

-- | The snapshot of a machine description, from the path of its file and its text.
ofDescription :: Text -> Text -> Snapshot
ofDescription path text =
  (unanalysed (Region.fromText path text)) {reports = Report.sorted (errors result)}
  where
    result = mapErrors id Machine.toReport (Machine.read text)

-- | Evaluates the first @most@ reports of a snapshot and the mentions of names.
force :: Int -> Snapshot -> ()
force most Snapshot {reports, facts} =
  foldr (seq . Report.force) () (List.take most reports)
    `seq` length (Mention.mentions facts)
    `seq` ()

-- | The unit in which results of the program are shown.
unit :: Snapshot -> LengthUnit
unit = FileUnit.ofProgram . program

-- | True if the program has no errors. It may have warnings.
isGood :: Snapshot -> Bool
isGood = not . any Report.isError . reports

-- | True if the names of the program have known meanings.
hasFacts :: Snapshot -> Bool
hasFacts = not . null . Mention.mentions . facts

-- | True if the program has frames for the machine that it names.
hasFrames :: Snapshot -> Bool
hasFrames = any ((> 0) . Machining.frames) . machines

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

-- | The identity of the file with this path, see 'identities'. A path that the program does not
-- name is its own identity.
identityOf :: Snapshot -> Text -> Text
identityOf Snapshot {identities} path = Maybe.fromMaybe path (lookup path identities)

-- | Loads another text of the program. The files that it imports have the texts that they have in
-- the snapshot, except those in @changed@: pairs of a path and a new text.
reloaded :: Snapshot -> [(Text, Text)] -> Text -> LoadedProgram
reloaded now changed = loadedWith now changed (Region.mainFile (source now))

-- | Loads a program with the path @path@ and the text @text@. It may import the files of the
-- snapshot, which have the texts that they have there, except those in @changed@: pairs of a path
-- and a new text.
loadedWith :: Snapshot -> [(Text, Text)] -> Text -> Text -> LoadedProgram
loadedWith now changed path text =
  runIdentity (LoadedProgram.load reader (Text.unpack path) text)
  where
    reader =
      Import.Reader
        { Import.contents = Identity . textAt,
          -- The texts of drawings have a character for each byte.
          Import.bytes = Identity . fmap (Char8.pack . Text.unpack) . textAt,
          Import.glyphs = \file -> Identity . glyphsAt file,
          Import.identity = Identity . Text.unpack . fileOf,
          Import.listing = const (Identity [])
        }
    fileOf = identityOf now . Text.pack
    textAt file = known (Map.lookup (fileOf file) texts)
    glyphsAt file written = known (Map.lookup (fileOf file, written) runs)
    runs = Map.mapKeys (first fileOf) (glyphRuns now)
    known = maybe (Left "it is not part of the program") Right
    -- The first of several texts with the same identity counts.
    texts =
      Map.fromListWith
        (\_ first' -> first')
        [(identityOf now file, t) | (file, t) <- changed <> Region.files (source now)]
