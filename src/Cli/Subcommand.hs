-- | The subcommands of @partc@, one function each. Arguments of these functions: @target@ is the
-- name or the file of a machine, nothing for the machine that the program names. @wanted@ is the
-- output path, nothing for standard output. The comments say where this differs.
module Cli.Subcommand
  ( run,
    showHelp,
  )
where

import Base.Quantity (LengthUnit)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Cli.DrawingFile (writeDrawing, writeExport, writePages)
import Cli.Error (Error (..), Warning (..))
import Cli.Error qualified as Cli
import Cli.FixCommand qualified as FixCommand
import Cli.ForeignTape qualified as ForeignTape
import Cli.Formatter qualified as Formatter
import Cli.FrameTable qualified as FrameTable
import Cli.GcodeFile (GcodeFile (GcodeFile))
import Cli.GcodeFile qualified as GcodeFile
import Cli.ImportCommand (importFile)
import Cli.InputFile
  ( Input (..),
    descriptionsFor,
    displayName,
    ownFiles,
    readBytes,
    source,
    withInput,
    withoutSurface,
  )
import Cli.LanguageServer qualified as LanguageServer
import Cli.MachineTable qualified as MachineTable
import Cli.NodeTable qualified as NodeTable
import Cli.Options (CompileOptions (..), FrameForm (..), Invocation (..), Subcommand (..))
import Cli.Outcome (evaluated, failWith, failWithReport, printResult, whenSound)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Cli.OutputFile (writeTapes, writeText)
import Cli.OutputFile qualified as OutputFile
import Cli.PreviewCommand qualified as PreviewCommand
import Cli.Progress qualified as Progress
import Cli.ProofTable qualified as ProofTable
import Cli.PulseProofTable qualified as PulseProofTable
import Cli.RunCommand qualified as RunCommand
import Cli.TapeDifference qualified as TapeDifference
import Cli.TapeInput (onFirstMachine, withTapeFile)
import Compile (Compiled (Compiled), Punched (..))
import Compile qualified
import Control.Exception (evaluate)
import Data.ByteString (ByteString)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, isNothing, maybeToList)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Draw.Plot qualified as Plot
import Draw.PlotSettings (PlotSettings)
import Draw.TapeRows qualified as TapeRows
import Draw.TapeSheet (TapeMaterial (..))
import Draw.TapeSheet qualified as TapeSheet
import Export.FromPart qualified as Export
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Gcode.ToFrames (GcodeReading)
import Gcode.Writer qualified as Writer
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..), ProgramForm)
import Machine.Machine qualified as Machine
import Project.Error qualified as Project
import Project.Job (Job (verification), Verification (..))
import Project.Job qualified as Job
import Project.MachineDescription (DescriptionText (text))
import Project.Target qualified as Target
import Query.Snapshot qualified as Snapshot
import Report.Explanation qualified as Explanation
import Report.Report (Report)
import Sheet.FromPart qualified as Sheet
import Sheet.ToText qualified as Sheet
import Sheet.Unsupported qualified as Unsupported
import System.FilePath (takeFileName)
import Tape.Damage (Damage)
import Tape.FrameRecord qualified as FrameRecord
import Tape.Punch qualified as Tape
import Tape.Tape (Tape (..))
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromGcode qualified as FromGcode
import Verify.PulseProof (PulseProof)

-- | Runs a subcommand. @version@ is that of partc.
run :: String -> Invocation -> IO Exit
run version (Invocation settings command) =
  Output.reporting (Text.pack version) settings (`perform` command)

-- | Prints the text of the help or of the version, which is given without its last line end.
showHelp :: String -> IO Exit
showHelp text =
  Output.reporting "" Output.defaultSettings (`printResult` (Text.pack text <> "\n"))

perform :: Reporter -> Subcommand -> IO Exit
perform reporter command = case command of
  Compile options -> compile reporter options
  Check targets files -> maximum <$> traverse (check reporter targets) (NonEmpty.toList files)
  Verify file target tape withPulses -> verify reporter file target tape withPulses
  Frames file target form -> frames reporter file target form
  Report file target withPoints -> report reporter file target withPoints
  Import options -> importFile reporter options
  ExportSheet file output -> exportSheet reporter file output
  Decode target tape -> decode reporter target tape
  Run options -> RunCommand.run reporter options
  Plot file output chosen -> plot reporter file output chosen
  Export file output -> export reporter file output
  Preview options -> PreviewCommand.preview reporter options
  Machines name asText -> machines reporter name asText
  DrawTape target range Nothing tape -> drawTape reporter target range tape
  DrawTape target range (Just (path, isFilm)) tape ->
    drawSheet reporter target range (if isFilm then Film else PaperTape) path tape
  Explain code -> explain reporter code
  LanguageServer -> LanguageServer.serve reporter
  Fmt checkOnly files ->
    maximum <$> traverse (Formatter.fmt reporter checkOnly) (NonEmpty.toList files)
  Mend isDry files ->
    maximum <$> traverse (FixCommand.fix reporter isDry) (NonEmpty.toList files)

-- Programs ----------------------------------------------------------------------------------------

-- | Writes the tapes of a program, one for each machine that the command line names. If it names
-- none, the tape is for the machine that the program names.
compile :: Reporter -> CompileOptions -> IO Exit
compile reporter options = withInput reporter (file options) (targets options) $ \given -> do
  -- An unevaluated @kept@ would hold the syntax tree in memory while the tapes are made.
  kept <- evaluate (withoutSurface given)
  let job = (jobFor (targets options) kept) {verification = chosen}
  settled reporter kept (withWarning =<< Compile.compile job (loaded given)) $ \tapes ->
    writeTapes
      reporter
      (name kept)
      (file options)
      (ownFiles (file options) kept)
      (place options)
      (concatMap tapeFilesOf tapes)
  where
    tapeFilesOf Compiled {Compile.machine, Compile.punched = Punched {tape, files}} = case files of
      [] -> [OutputFile.TapeOutput machine Nothing tape]
      _ -> zipWith (outputFile machine) (OutputFile.numbered (map Writer.toolOfFile files)) files
    outputFile machine part written =
      OutputFile.TapeOutput machine part (Tape (Encoding.encodeUtf8 (Writer.fileText written)))
    chosen = if unproven options then Unverified else Verified
    withWarning tapes =
      tapes
        <$ Result.warned
          ( [Cli.warningReport Unproven | unproven options, _ <- tapes]
              <> [beginningWarning tape | not (unproven options), tape <- tapes, isBare tape]
          )
    -- A text for a modern control whose description has no form of programs.
    isBare tape =
      TapeDifference.isTextFile (Compile.machine tape)
        && isNothing (Machine.programForm (Compile.machine tape))
    beginningWarning tape =
      let MachineName machineName = Machine.name (Compile.machine tape)
       in Cli.warningReport (BeginningUnproven machineName)

-- | Reports the mistakes of a program, including frames that a machine cannot execute. The machines
-- are those of the names or files @targets@, or else the one that the program names, if it names
-- one. It makes no tape.
check :: Reporter -> [Text] -> FilePath -> IO Exit
check reporter targets file = withInput reporter file targets $ \given ->
  settled reporter given (checked given) (const (pure Done))
  where
    checked given = case targets of
      [] -> fst <$> Snapshot.whole (Snapshot.checkWith (values given) (loaded given))
      _ -> Compile.check (jobFor targets given) (loaded given)

-- | Proves the tape in @tapeFile@ against the program in @file@. Without @tapeFile@ it proves the
-- tape that the compiler makes of the program. If @withPulses@ is true, it also proves the pulses
-- of the machine's controller.
verify :: Reporter -> FilePath -> Maybe Text -> [FilePath] -> Bool -> IO Exit
verify reporter file target tapeFiles withPulses =
  withInput reporter file (maybeToList target) $ \given -> do
    foreignTapes <- traverse readBytes tapeFiles
    settled reporter given (withContents foreignTapes (onFirstMachine target given)) $
      \(compiled, found) -> case found of
        Left e -> failWith reporter (tapeName given) e
        Right (rows, contents) -> case Machine.programForm (Compile.machine compiled) of
          _ | not (isCountRight compiled) -> failWith reporter (name given) (wrongCount compiled)
          Just form
            | not withPulses ->
              let read' = [(path, bytes) | (path, Right bytes) <- zip tapeFiles foreignTapes]
               in verifyGcode reporter given form (gcodeFiles given compiled read') compiled
          _ ->
            withPulseProof reporter given withPulses compiled rows $
              verifyTape
                reporter
                given
                (ForeignTape.TapeFile (tapeName given) rows contents)
                compiled
  where
    tapeName given = case tapeFiles of
      [] -> name given
      first : _ -> displayName first
    fileNames = OutputFile.tapeNames file . Compile.machine <*> toolsOfFiles
    toolsOfFiles = map Writer.toolOfFile . files . Compile.punched
    wrongCount compiled = WrongFileCount (length tapeFiles) (map Text.pack (fileNames compiled))
    isCountRight compiled =
      null tapeFiles || length tapeFiles == max 1 (length (files (Compile.punched compiled)))

-- | Program with the rows and the frames of its first foreign tape, or of its own tape if there is
-- no foreign one. The warnings about the program are left out if the tape cannot be read.
withContents ::
  [Either Error ByteString] ->
  Result Report Report Compiled ->
  Result Report Report (Compiled, Either Error (Tape, Either Damage [Frame]))
withContents foreignTapes result = case (foreignTapes, found) of
  (_ : _, Just (_, Left _)) -> both {warnings = []}
  (_ : _, Just (_, Right (_, Left _))) -> both {warnings = []}
  _ -> both
  where
    both = result {output = found}
    found = contentsOf <$> output result
    contentsOf compiled = (compiled, withFrames <$> rowsOf compiled)
      where
        withFrames rows = (rows, readTape compiled rows)
    rowsOf compiled = case sequence foreignTapes of
      Left e -> Left e
      Right [] -> Right (tape (Compile.punched compiled))
      Right (first : _) -> Right (Tape first)

-- | Continues with the proof of the pulses if it is asked for, and else with 'Nothing'.
withPulseProof ::
  Reporter ->
  Input ->
  Bool ->
  Compiled ->
  Tape ->
  (Maybe (Result Report Report PulseProof) -> IO Exit) ->
  IO Exit
withPulseProof reporter given withPulses compiled rows continue
  | not withPulses = continue Nothing
  | otherwise = case Compile.provePulses compiled rows of
    Just pulses -> continue (Just pulses)
    Nothing ->
      let machine = Compile.machine compiled
          MachineName machineName = Machine.name machine
          noPulses = maybe NoController (const NoPulses) (Machine.controller machine)
       in failWith reporter (name given) (noPulses machineName)

-- | The frames of a tape that should be the one of a program.
readTape :: Compiled -> Tape -> Either Damage [Frame]
readTape Compiled {Compile.machine, Compile.punched}
  -- A file of G-code is read by 'verifyGcode'.
  | isJust (Machine.programForm machine) = const (Right [])
  | otherwise = Tape.readExpected machine (Frame.start (program punched)) (framesOf punched)

-- | Files of G-code: those of the command line, with their contents, or the files of the program if
-- the command line names none.
gcodeFiles :: Input -> Compiled -> [(FilePath, ByteString)] -> [GcodeFile]
gcodeFiles given compiled foreignFiles = case foreignFiles of
  [] -> [GcodeFile (name given) (Writer.fileText f) | f <- files (Compile.punched compiled)]
  _ ->
    [ GcodeFile (displayName path) (TapeDifference.textOf (Tape bytes))
      | (path, bytes) <- foreignFiles
    ]

-- | Reads the files of a program for a modern control, compares their motions with the part, judges
-- the state of the control, and prints the proof.
verifyGcode :: Reporter -> Input -> ProgramForm -> [GcodeFile] -> Compiled -> IO Exit
verifyGcode reporter given form gcode compiled = case GcodeFile.read form compiled gcode of
  Left (text, fault) -> Failed <$ Output.showReports reporter (Region.mainFile text) text [fault]
  Right reading -> do
    let proof = Compile.proveGcode form part compiled reading
        (texts, wrong) = GcodeFile.reports form compiled gcode (source given) reading proof
    Progress.during ("proving " <> name given) (evaluated (Result.failing wrong proof))
    let table = ProofTable.proof (unitOf compiled) (Compile.machine compiled) proof
    exit <- printResult reporter table
    _ <- Output.showReports reporter (name given) texts wrong
    pure (if null wrong then exit else Disproven)
  where
    part = snd <$> output (Compile.evaluate (values given) (loaded given))

-- | Compares the frames that are read from a tape with the part and prints the proof, and the proof
-- of the pulses if there is one. @compiled@ has the toolpath and the frames that the tape should
-- have.
verifyTape ::
  Reporter ->
  Input ->
  ForeignTape.TapeFile ->
  Compiled ->
  Maybe (Result Report Report PulseProof) ->
  IO Exit
verifyTape reporter given tapeFile compiled pulses =
  case ForeignTape.contents tapeFile of
    Left damage -> do
      let (text, damaged) = ForeignTape.otherDamaged compiled tapeFile damage
      Failed <$ Output.showReports reporter tapeName text [damaged]
    Right read' -> do
      let result = Compile.proveTape part compiled read'
      Progress.during ("proving " <> tapeName) (evaluated result)
      let table = ProofTable.proof (unitOf compiled) machine
      exit <- maybe (pure Done) (printResult reporter . table) (output result)
      exitOfPulses <- maybe (pure Done) printPulses pulses
      let (texts, wrong) =
            maybe
              (source given, errors result)
              (ForeignTape.disproven compiled tapeFile read' (source given))
              (output result)
          findings = wrong <> maybe [] errors pulses
      _ <- Output.showReports reporter (name given) texts findings
      pure (if null findings then max exit exitOfPulses else Disproven)
  where
    tapeName = ForeignTape.fileName tapeFile
    machine = Compile.machine compiled
    part = snd <$> output (Compile.evaluate (values given) (loaded given))
    printPulses result = do
      Progress.during ("running " <> tapeName) (evaluated result)
      maybe
        (pure Done)
        (printResult reporter . ("\n" <>) . PulseProofTable.pulseProof)
        (output result)

-- | Prints the frames of a program in the given form. The record of the frames is an error on a
-- machine whose frames have none.
frames :: Reporter -> FilePath -> Maybe Text -> FrameForm -> IO Exit
frames reporter file target form = withInput reporter file (maybeToList target) $ \given ->
  settled reporter given (onFirstMachine target given) $
    \compiled@Compiled {Compile.machine, Compile.punched} -> case form of
      FramesAsTable ->
        listed (FrameTable.frames (unitOf compiled) machine (source given) (program punched))
      FramesAsJson -> listed (FrameTable.framesJson machine (source given) (program punched))
      FrameRecords -> case FrameRecord.obstacle machine of
        Nothing ->
          let start = Frame.start (program punched)
           in listed (Text.unlines (FrameRecord.records machine start (framesOf punched)))
        Just obstacle ->
          let MachineName machineName = Machine.name machine
           in failWith reporter (name given) (NoRecord machineName obstacle)
  where
    listed = printResult reporter

-- | The unit in which the results of a compiled program are printed.
unitOf :: Compiled -> LengthUnit
unitOf = Toolpath.unit . Compile.toolpath

-- | Prints the tables of nodes, lengths and times of a program. If the program or the command line
-- names a machine, the tables use its feeds and have the length of its tape. If @withPoints@ is
-- true, the reference points of pieces are listed, too.
report :: Reporter -> FilePath -> Maybe Text -> Bool -> IO Exit
report reporter file target withPoints = withInput reporter file (maybeToList target) $ \given ->
  settled reporter given (analysed given) $ \(analysis, punched) ->
    printResult reporter (NodeTable.nodes (pointsSource given) punched analysis)
  where
    pointsSource given = if withPoints then Just (source given) else Nothing
    analysed given =
      Compile.analyse (values given) (loaded given) `Result.thenSound` \analysis -> do
        let path = Compile.path analysis
        chosen <- Job.machinesFor (job given) (Compile.part analysis) path
        case chosen of
          machine : _ -> do
            punched <- Compile.punch machine path
            pure (analysis, Just (machine, punched))
          [] -> pure (analysis, Nothing)
    job given = case target of
      Just wanted -> jobFor [wanted] given
      Nothing -> Job.forOwnMachine (values given) (loaded given)

-- | Writes the drawing of a program.
plot :: Reporter -> FilePath -> Maybe FilePath -> PlotSettings -> IO Exit
plot reporter file wanted chosen = withInput reporter file [] $ \given ->
  settled reporter given (Compile.analyse (values given) (loaded given)) $ \analysis ->
    writeDrawing
      reporter
      (displayName file)
      (ownFiles file given)
      wanted
      (Plot.plot chosen (Compile.part analysis) (Compile.path analysis))

-- | Writes the drawing of a program for CAD programs. Without an output path it is DXF.
export :: Reporter -> FilePath -> Maybe FilePath -> IO Exit
export reporter file wanted = withInput reporter file [] $ \given ->
  settled reporter given (Compile.analyse (values given) (loaded given)) $ \analysis ->
    writeExport
      reporter
      (displayName file)
      (ownFiles file given)
      wanted
      (Export.drawing (Compile.part analysis) (Compile.path analysis))

-- | Calls 'whenSound' with the name and the source of the program @given@: writes the reports of
-- the result, and continues with its output if no report stops the command.
settled :: Reporter -> Input -> Result Report Report a -> (a -> IO Exit) -> IO Exit
settled reporter given = whenSound reporter (name given) (source given)

-- | The job of compiling a program for the machines of these names or files. If @names@ is empty,
-- the program is compiled for the machine that it names.
jobFor :: [Text] -> Input -> Job
jobFor names given = Job.forTargets names (values given) (loaded given)

framesOf :: Punched -> [Frame]
framesOf = map Frame.frame . Frame.plannedFrames . program

-- Input sheets ------------------------------------------------------------------------------------

-- | Converts a part program to an input sheet.
exportSheet :: Reporter -> FilePath -> Maybe FilePath -> IO Exit
exportSheet reporter file wanted = withInput reporter file [] $ \given ->
  settled reporter given (asSheet given) $
    writeText reporter (displayName file) (ownFiles file given) wanted . Sheet.write
  where
    asSheet given =
      Compile.evaluate (values given) (loaded given)
        `Result.thenSound` (Result.mapErrors id Unsupported.toReport . uncurry Sheet.fromPart)

-- Tapes -------------------------------------------------------------------------------------------

-- | Prints the frames of a tape.
decode :: Reporter -> Maybe Text -> FilePath -> IO Exit
decode reporter target tapeFile =
  withTape reporter target tapeFile $ \machine read' ->
    printResult reporter (FrameTable.decoded machine read')

-- | Prints a picture of those rows of a tape that are in @range@: their holes and their meaning.
-- If the tape is a text without holes, prints its lines. The rows are made again from the frames
-- that were read. A range outside of the tape is an error.
drawTape :: Reporter -> Maybe Text -> TapeRows.RowRange -> FilePath -> IO Exit
drawTape reporter target range tapeFile =
  withTapeFile reporter target tapeFile $ \machine rows -> case Machine.programForm machine of
    Just form -> withGcode reporter machine form (gcodeFile tapeFile rows) $ \reading ->
      case GcodeFile.listing range (gcodeFile tapeFile rows) reading of
        ([], (counted, count)) ->
          failWith reporter (displayName tapeFile) (NothingInRange counted count)
        (lines', _) -> printResult reporter (Text.unlines lines')
    Nothing -> framesOfTape reporter tapeFile machine rows $ \read' -> do
      let drawn = Tape.rows machine 0 read'
          (counted, count) = TapeRows.extent machine range drawn
      case TapeRows.picture machine range drawn of
        Nothing -> failWith reporter (displayName tapeFile) (NothingInRange counted count)
        Just picture -> printResult reporter picture

-- | Writes a drawing of those rows of a tape that are in @range@, at their true size, to @path@. A
-- range outside of the tape is an error, and so is a tape that is a text.
drawSheet ::
  Reporter -> Maybe Text -> TapeRows.RowRange -> TapeMaterial -> FilePath -> FilePath -> IO Exit
drawSheet reporter target range material path tapeFile =
  withTapeFile reporter target tapeFile $ \machine rows ->
    if isNothing (Machine.pitch (Machine.medium machine))
      then failWith reporter (displayName tapeFile) (NotPunched (nameOf machine))
      else framesOfTape reporter tapeFile machine rows $ \read' -> do
        let numbered = zip [1 ..] (Tape.rows machine 0 read')
            (counted, count) = TapeRows.extent machine range (map snd numbered)
            title = Text.pack (takeFileName (Text.unpack (displayName tapeFile)))
            chosen = TapeRows.chosen range numbered
        case TapeSheet.sheet material machine title chosen of
          Nothing -> failWith reporter (displayName tapeFile) (NothingInRange counted count)
          Just drawing ->
            writePages
              reporter
              (displayName tapeFile)
              [tapeFile]
              (Just path)
              drawing
              (TapeSheet.pages material machine title chosen)
  where
    nameOf machine = let MachineName n = Machine.name machine in n

-- | Reads a tape for which there is no program, and continues with its machine and its frames. The
-- tape does not contain the position from which the cutter starts, so this is assumed to be 0.
-- Without @target@ the command fails.
withTape :: Reporter -> Maybe Text -> FilePath -> (Machine -> [Frame] -> IO Exit) -> IO Exit
withTape reporter target tapeFile continue =
  withTapeFile reporter target tapeFile $ \machine rows -> case Machine.programForm machine of
    Just form ->
      withGcode
        reporter
        machine
        form
        (gcodeFile tapeFile rows)
        (continue machine . FromGcode.framesRead)
    Nothing -> framesOfTape reporter tapeFile machine rows (continue machine)

-- | Continues with the frames of a tape.
framesOfTape :: Reporter -> FilePath -> Machine -> Tape -> ([Frame] -> IO Exit) -> IO Exit
framesOfTape reporter tapeFile machine rows continue = case Tape.read machine 0 rows of
  Left damage -> do
    let (text, damaged) = ForeignTape.damaged machine (displayName tapeFile) rows damage
    Failed <$ Output.showReports reporter (displayName tapeFile) text [damaged]
  Right read' -> continue read'

-- | Continues with what is read from a file of G-code without its program.
withGcode ::
  Reporter -> Machine -> ProgramForm -> GcodeFile -> (GcodeReading -> IO Exit) -> IO Exit
withGcode reporter machine form gcode continue = case GcodeFile.readAlone machine form gcode of
  Left (text, fault) -> Failed <$ Output.showReports reporter (Region.mainFile text) text [fault]
  Right reading -> continue reading

gcodeFile :: FilePath -> Tape -> GcodeFile
gcodeFile tapeFile rows = GcodeFile (displayName tapeFile) (TapeDifference.textOf rows)

-- Machines, explanations, editors -----------------------------------------------------------------

-- | Lists the built-in machines, or shows the machine @wanted@. If @asText@ is true, it shows the
-- text of the machine's description, otherwise tables of its data. Errors in a description are
-- reported with their positions.
machines :: Reporter -> Maybe Text -> Bool -> IO Exit
machines reporter wanted asText = case wanted of
  Nothing -> printResult reporter (MachineTable.machineList BuiltIn.machines)
  Just machineName -> do
    descriptions <- descriptionsFor [machineName] []
    case (Target.machineNamed descriptions machineName, lookup machineName descriptions) of
      (Left (Project.DescriptionWrong _ file described reports), _) ->
        Failed
          <$ Output.showReports reporter file (Region.fromText file (text described)) reports
      (Left e, _) -> failWithReport reporter "" (Project.argumentReport e)
      (Right _, Just (Right described)) | asText -> printResult reporter (text described)
      (Right machine, _)
        | asText ->
          maybe (pure Failed) (printResult reporter) (BuiltIn.text (Machine.name machine))
        | otherwise -> printResult reporter (MachineTable.machineDetails machine)

-- | Prints the explanation of the report code @wanted@, or the list of all codes if this is
-- nothing.
explain :: Reporter -> Maybe Text -> IO Exit
explain reporter wanted = case wanted of
  Nothing -> printResult reporter Explanation.list
  Just word -> case Explanation.find word of
    [] -> failWith reporter "" (UnknownCode word (Explanation.near word))
    found -> printResult reporter (Text.intercalate "\n" (map Explanation.render found))
