-- | The whole pipeline, to be read first.
--
-- > text ─▶ Surface ─▶ Checked ─▶ Part ─▶ Path ─▶ Frame ─▶ Tape
-- >          parse      check     evaluate  lay    quantise  write
-- >                                  ▲                        │
-- >                                  └── Verify ◀── Control ◀─┘  read, run, compare
--
-- Every stage is a pure function to a 'Result': the warnings, the errors, and the output as far as
-- it is sound. Stages up to the path go on beside errors, so that one run reports all independent
-- mistakes; nothing is punched unless there are none.
module Compile
  ( Analysis (..),
    LoadedProgram (..),
    load,
    alone,
    withoutSurface,
    isSheet,
    analyse,
    evaluated,
    Punched (..),
    punch,
    readTape,
    readBack,
    readOwn,
    prove,

    -- * Machines
    Descriptions,
    described,
    isDescription,
    machineFor,
    machineIn,
    machineNamed,
    Unknown (..),
    onMachine,
  )
where

import Base.PulseVector (Pulses3)
import Base.Region (Located (..), Region, Source)
import Base.Region qualified as Region
import Base.Result (Result (..), mapErrors)
import Base.Result qualified as Result
import Checked.Error qualified as Checked
import Checked.FromSurface qualified as Checked
import Checked.Syntax (Mention)
import Checked.Syntax qualified as Checked
import Data.Functor.Identity (runIdentity)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Error qualified as Frame
import Frame.Frame (Frame, FrameProgram)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as Frame
import Machine.BuiltIn qualified as BuiltIn
import Machine.Error qualified as Machine
import Machine.FromText qualified as Machine
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Part.Error qualified as Part
import Part.FromChecked qualified as Part
import Part.Part (Part)
import Report.Report (Report)
import Sheet.Error qualified as Sheet
import Sheet.FromText qualified as Sheet
import Sheet.ToSurface qualified as Sheet
import Surface.Error qualified as Surface
import Surface.Import qualified as Surface
import Surface.Parameter qualified as Surface
import Surface.Syntax qualified as Surface
import System.FilePath (takeDirectory, takeExtension, (</>))
import Tape.Punch qualified as Tape
import Tape.Tape (Tape)
import Toolpath.Error qualified as Toolpath
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof (Proof)
import Verify.Proof qualified as Verify

-- | All texts, and one program of them; where each import stands, and the file that it names; the
-- descriptions of machines that it names.
data LoadedProgram = LoadedProgram
  { source :: Source,
    surface :: Result Report Report Surface.Program,
    imports :: [(Region, Text)],
    descriptions :: Descriptions
  }

-- | Read a program and what it imports, or an input sheet: the name of its file, for reports and
-- for the places of the others; its text.
load :: Monad m => Surface.Reader m -> FilePath -> Text -> m LoadedProgram
load reader path text
  | isSheet path =
    pure
      LoadedProgram
        { source = Region.fromText (Text.pack path) text,
          surface = Sheet.program <$> mapErrors id Sheet.toReport (Sheet.read text),
          imports = [],
          descriptions = []
        }
  | otherwise = do
    loaded <- Surface.load reader path text
    descriptions <-
      traverse
        (described (Surface.contents reader) (takeDirectory path))
        (maybe [] filesNamed (output (Surface.surface loaded)))
    pure
      LoadedProgram
        { source = Surface.source loaded,
          surface = mapErrors Surface.toReport Surface.toReport (Surface.surface loaded),
          imports = Surface.imports loaded,
          descriptions
        }
  where
    filesNamed written =
      [ file
        | Located _ (Surface.Machine (Located _ (Surface.Described file))) <-
            Surface.statements written
      ]

-- | A program of one text that can import nothing.
alone :: Text -> Text -> LoadedProgram
alone path text =
  runIdentity
    ( load
        (Surface.byName (const (pure (Left "only one text is looked at"))))
        (Text.unpack path)
        text
    )

-- | Without the program itself, when only its places are asked for any more.
withoutSurface :: LoadedProgram -> LoadedProgram
withoutSurface loaded = loaded {surface = Result [] [] Nothing}

-- | Whether a file is an input sheet, by its name.
isSheet :: FilePath -> Bool
isSheet = (== ".sheet") . takeExtension

-- | What a program says, whatever the machine.
data Analysis = Analysis
  { -- | every place at which a name stands
    mentions :: [Mention],
    part :: Part,
    path :: Toolpath
  }

-- | From the texts to the path; the values are given to the program's parameters, by their names.
analyse :: [(Text, Text)] -> LoadedProgram -> Result Report Report Analysis
analyse values loaded = do
  -- Of the checked program only the mentions are held while the path is laid.
  (mentions, part) <-
    (\(checked, part) -> let found = Checked.mentions checked in found `seq` (found, part))
      <$> evaluated values loaded
  path <- mapErrors Toolpath.warningReport Toolpath.toReport (Toolpath.lay part)
  pure Analysis {mentions, part, path}

-- | From the texts to the exact geometry.
evaluated :: [(Text, Text)] -> LoadedProgram -> Result Report Report (Checked.Program, Part)
evaluated values loaded = do
  written <- surface loaded
  assigned <- mapErrors id Surface.toReport (Surface.assign values written)
  checked <- mapErrors id Checked.toReport (Checked.check assigned)
  part <- mapErrors id Part.toReport (Part.evaluate checked)
  pure (checked, part)

-- | The frames of a path on a machine, and the tape that holds them.
data Punched = Punched {program :: FrameProgram, tape :: Tape}

-- | From the path to the tape.
punch :: Machine -> Toolpath -> Result Report Report Punched
punch machine path = do
  program <-
    mapErrors (Frame.warningReport machine) (Frame.toReport machine) (Frame.quantise machine path)
  pure
    Punched
      { program,
        tape = Tape.write machine (Frame.start program) (map Frame.frame (Frame.planned program))
      }

-- | From a tape back to its frames; where the cutter stands before the first.
readTape :: Machine -> Pulses3 -> Tape -> Result Report Report [Frame]
readTape machine begin tape =
  mapErrors id Tape.toReport (Result.fromEither (Tape.read machine begin tape))

-- | The same of a tape on which the frames of a program should stand.
readBack :: Machine -> FrameProgram -> Tape -> Result Report Report [Frame]
readBack machine program tape =
  mapErrors
    id
    Tape.toReport
    ( Result.fromEither
        (Tape.readBack machine (Frame.start program) (map Frame.frame (Frame.planned program)) tape)
    )

-- | The same of a tape that was punched just now: it has to hold the frames of the program, one by
-- one.
readOwn :: Machine -> FrameProgram -> Tape -> Result Report Report [Frame]
readOwn machine program tape =
  mapErrors
    id
    Tape.toReport
    ( Result.fromEither
        (Tape.readOwn machine (Frame.start program) (map Frame.frame (Frame.planned program)) tape)
    )

-- | Compare a tape's frames with the part; errors when it is not proven.
prove :: Machine -> Toolpath -> FrameProgram -> [Frame] -> Result Report Report Proof
prove machine path program frames =
  asked `seq` Result.failing (Verify.toReports machine proof) proof
  where
    -- The moves along the contours are not held while the tape is compared.
    asked = Toolpath.withoutCuts path
    proof = Verify.prove machine asked program frames

-- Machines ----------------------------------------------------------------------------------------

-- | Description files by the names that were asked for: their texts, or why they cannot be read.
type Descriptions = [(Text, Either Text Text)]

-- | Read a description beside a folder.
described ::
  Monad m =>
  (FilePath -> m (Either Text Text)) ->
  FilePath ->
  Text ->
  m (Text, Either Text Text)
described contents folder file = (file,) <$> contents (folder </> Text.unpack file)

-- | Whether a name is that of a description file rather than of a machine that is built in.
isDescription :: Text -> Bool
isDescription name = Text.any (== '/') name || Text.isSuffixOf ".machine" name

-- | Why there is no such machine.
data Unknown
  = -- | none has this name
    NoSuchMachine
  | -- | its description cannot be read
    NoDescription Text
  | -- | its description has mistakes: its text, and the reports
    BadDescription Text [Report]

-- | A machine by its name, or by the name of its description.
machineFor :: Descriptions -> Text -> Either Unknown Machine
machineFor descriptions name
  | isDescription name = machineIn descriptions name
  | otherwise = machineNamed name

-- | The machine of a name that is built in.
machineNamed :: Text -> Either Unknown Machine
machineNamed name = maybe (Left NoSuchMachine) Right (BuiltIn.find (MachineName name))

-- | The machine of a description.
machineIn :: Descriptions -> Text -> Either Unknown Machine
machineIn descriptions file = case lookup file descriptions of
  Nothing -> Left (NoDescription "it was not looked for")
  Just (Left why) -> Left (NoDescription why)
  Just (Right text) -> case mapErrors id Machine.toReport (Machine.read text) of
    Result {errors = [], output = Just machine} -> Right machine
    Result {errors} -> Left (BadDescription text errors)

-- | A machine set up for a path: on a lathe its axes may point the other way.
onMachine :: Toolpath -> Machine -> Machine
onMachine path machine = if Toolpath.isTurned path then Machine.forTurning machine else machine
