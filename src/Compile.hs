-- | The whole pipeline on one page. Read this module first.
--
-- > text ─▶ Surface ─▶ Checked ─▶ Part ─▶ Toolpath ─▶ Frame ─▶ Tape
-- >           load      check   evaluate    plan     quantise  write
-- >                                ▲                             │
-- >                                └────── Verify ◀── Control ◀──┘
-- >                                        compare     run       read back
--
-- 'compile' runs all of it; 'evaluate', 'analyse' and 'check' stop earlier. "Project.LoadedProgram"
-- finds the texts and "Project.Target" the machines.
--
-- Every stage is a pure function to a 'Result': warnings, errors, and the part of the output that
-- is right. The stages up to the toolpath continue after errors, so that one run reports all
-- independent mistakes. A tape is made only from a program without errors.
module Compile
  ( compile,
    Compiled (..),
    evaluate,
    analyse,
    Analysis (..),
    check,
    checkedFrames,
    checkEvaluated,
    makeTape,
    punch,
    Punched (..),
    prove,
    proveTape,
    proveGcode,
    gcodeReports,
    provePulses,
  )
where

import Base.Quantity (LengthUnit)
import Base.Region (Position (..), Region (Region), Source)
import Base.Region qualified as Region
import Base.Result
  ( Result (..),
    failed,
    failing,
    fromEither,
    ifSound,
    mapErrors,
    thenSound,
    warned,
  )
import Checked.BareNumber qualified as BareNumber
import Checked.Error qualified as Checked
import Checked.FromSurface qualified as Checked
import Checked.Syntax qualified as Checked
import Control.CompensationCheck qualified as CompensationCheck
import Control.Monad (when)
import Data.Set qualified as Set
import Data.Text (Text)
import Frame.Error qualified as Frame
import Frame.Frame (FrameProgram)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as Frame
import Frame.TurnFeed qualified as TurnFeed
import Gcode.FaultReport qualified as FaultReport
import Gcode.Heading qualified as Heading
import Gcode.Requirement qualified as Requirement
import Gcode.ToFrames (GcodeReading)
import Gcode.Writer (ToolFile)
import Gcode.Writer qualified as Writer
import Machine.Machine (Machine, ProgramForm)
import Machine.Machine qualified as Machine
import Part.ContourStart qualified as ContourStart
import Part.Error qualified as Part
import Part.FromChecked qualified as Part
import Part.Part (Part)
import Part.Part qualified as Part
import Project.Error qualified as Project
import Project.Job (Job (..), Verification (..))
import Project.LoadedProgram (LoadedProgram (isSheet, source, surface))
import Pulse.Controller (Console (..))
import Pulse.Controller qualified as Controller
import Pulse.FrameCompensation qualified as FrameCompensation
import Pulse.ReaderDwell qualified as ReaderDwell
import Report.Report (Report (code, others, place), ReportPlace (..))
import Report.Report qualified as Report
import Surface.Error qualified as Surface
import Surface.FileUnit qualified as FileUnit
import Surface.Parameter qualified as Surface
import Tape.Punch qualified as Tape
import Tape.Tape (Tape)
import Toolpath.Error qualified as Toolpath
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath, isCompensated, withoutCuts)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Collision qualified as Collision
import Verify.ControlFault qualified as ControlFault
import Verify.FromGcode qualified as FromGcode
import Verify.FromPulses qualified as FromPulses
import Verify.FromTape qualified as Verify
import Verify.Proof (Proof)
import Verify.Proof qualified as Proof
import Verify.PulseProof (PulseProof)
import Verify.PulseProof qualified as PulseProof

-- | Compiles a program to one tape for each machine of the job. If the program has an error, no
-- tape is made.
compile :: Job -> LoadedProgram -> Result Report Report [Compiled]
compile Job {values, machinesFor, verification} loaded =
  forced analysed `thenSound` uncurry (makeTapes verification)
  where
    analysed =
      analyse values loaded `thenSound` \Analysis {part, path} -> (path,) <$> machinesFor part path
    -- Evaluates all reports: unevaluated ones would keep the program in memory during 'makeTapes'.
    forced result = length (errors result) `seq` length (warnings result) `seq` result

-- | Checks and evaluates a program (Surface → Checked → Part). @values@ has the names of the
-- parameters that the command line sets, with the texts of their new values.
evaluate :: [(Text, Text)] -> LoadedProgram -> Result Report Report (Checked.Program, Part)
evaluate values loaded = do
  written <- surface loaded
  assigned <- mapErrors id Surface.toReport (Surface.assign values written)
  let located = Surface.inAssignment values written
  checked <-
    withoutEchoes (source loaded) (errors (surface loaded)) $
      mapErrors
        id
        (located . Checked.toReport (FileUnit.ofProgram written))
        (Checked.check assigned)
  warned
    ( BareNumber.besideInches
        fileOf
        (BareNumber.typesOfNames (Checked.mentions checked))
        written
    )
  (checked,) <$> mapErrors id (located . partReport (Checked.unit checked)) (Part.evaluate checked)
  where
    fileOf at = file (Region.position (source loaded) (Region.start at))
    -- Only users of input sheets know the control stops of the Minsk-22 system.
    partReport unit
      | isSheet loaded = Report.withControlStop . Part.toReport unit
      | otherwise = Part.toReport unit

-- | A result without the errors on lines of the program that cannot be parsed, of which the given
-- reports are: on such a line, words are taken for names that are none.
withoutEchoes :: Source -> [Report] -> Result w Report a -> Result w Report a
withoutEchoes source before result
  | null before = result
  | otherwise = result {errors = filter (not . isEcho) (errors result)}
  where
    -- A missing setting does not depend on the words of the line.
    isEcho r =
      code r /= "E0217"
        && or [Set.member (lineOf region) unread | InSource region <- [Report.place r]]
    unread =
      Set.fromList
        [ lineOf region
          | r <- before,
            region <- [region | InSource region <- [Report.place r]] <> map Report.region (others r)
        ]
    lineOf region = let p = Region.position source (Region.start region) in (file p, line p)

-- | The results that do not depend on a machine: the mentions of names in the program (for
-- editors), the part, and the toolpath.
data Analysis = Analysis {mentions :: [Checked.Mention], part :: Part, path :: Toolpath}

-- | Computes the part and the toolpath of a program (Surface → Checked → Part → Toolpath). @values@
-- has the names of the parameters that the command line sets, with the texts of their new values.
analyse :: [(Text, Text)] -> LoadedProgram -> Result Report Report Analysis
analyse values loaded = evaluate values loaded >>= plan

-- | Computes the toolpath of an evaluated program (Part → Toolpath).
plan :: (Checked.Program, Part) -> Result Report Report Analysis
plan (checked, part) = do
  -- @mentions@ is evaluated now. So the checked program is freed before the toolpath is computed.
  mentions <- pure $! Checked.mentions checked
  path <-
    mapErrors (Toolpath.warningReport unit) (Toolpath.toReport unit) (Toolpath.toToolpath part)
  pure Analysis {mentions, part, path}
  where
    unit = Part.unit part

-- | Runs all compiler passes up to the frames, for every machine of the job, and gives their errors
-- and warnings. Makes no tape.
check :: Job -> LoadedProgram -> Result Report Report Analysis
check job loaded = fst <$> checkedFrames job loaded

-- | Does the same as 'check', and gives the frames for each machine of the job too.
checkedFrames ::
  Job ->
  LoadedProgram ->
  Result Report Report (Analysis, [(Machine, Frame.FrameProgram)])
checkedFrames job loaded = checkEvaluated job (evaluate (values job) loaded)

-- | Continues 'checkedFrames' after 'evaluate'. The result includes the errors and warnings of
-- evaluation, and the collisions of the tools with stock and clamps.
checkEvaluated ::
  Job ->
  Result Report Report (Checked.Program, Part) ->
  Result Report Report (Analysis, [(Machine, Frame.FrameProgram)])
checkEvaluated Job {machinesFor} evaluated =
  (evaluated >>= plan) `thenSound` \analysis@Analysis {part, path} ->
    (analysis,) <$> (machinesFor part path >>= traverse (made path))
  where
    made path machine = do
      Punched {program} <- punch machine path
      failing (collisions path machine program) (machine, program)
    collisions path machine program =
      Proof.findingReports
        (Toolpath.unit path)
        machine
        (Collision.inProgram machine path program)

-- | Makes the tapes one after the other. The toolpath is freed before the last tape is verified.
makeTapes :: Verification -> Toolpath -> [Machine] -> Result Report Report [Compiled]
makeTapes verification path machines = case machines of
  [] -> pure []
  [machine] -> (: []) <$> makeTape verification path machine
  machine : more -> (:) <$> makeTape verification path machine <*> makeTapes verification path more

-- | A tape for one machine. Its proof is present if the job asks for verification.
data Compiled = Compiled
  { machine :: Machine,
    -- | the toolpath without the moves that 'withoutCuts' leaves out, which 'prove' does not need
    toolpath :: Toolpath,
    punched :: Punched,
    proof :: Maybe Proof
  }

-- | Makes the tape for one machine (Toolpath → Frame → Tape). If the job asks for verification,
-- reads the tape back and proves it (Control → Verify).
makeTape :: Verification -> Toolpath -> Machine -> Result Report Report Compiled
makeTape verification path machine
  | Just form <- Machine.programForm machine = makeFiles form verification path machine
  | otherwise = makePunched verification path machine

-- | Makes the files for a modern control (Toolpath → Frame → Gcode). If the job asks for
-- verification, the proof of the frames shows how far the control may leave the path at corners;
-- the files are then read back, and have to give the same frames in a safe state.
makeFiles :: ProgramForm -> Verification -> Toolpath -> Machine -> Result Report Report Compiled
makeFiles form verification path machine =
  toolpath `seq` do
    punched <- punch machine path
    when
      (null (Frame.plannedFrames (program punched)))
      (failed (Project.toReport Project.NothingToPunch))
    case verification of
      Unverified -> pure Compiled {machine, toolpath, punched, proof = Nothing}
      Verified -> do
        let frames = map Frame.frame (Frame.plannedFrames (program punched))
        onPath <- prove machine toolpath (program punched) frames
        let bound = FromGcode.blendingBound machine onPath
            texts = Writer.write machine form heading bound (program punched)
            written = withFiles machine texts (program punched)
        proof <- proveFiles machine form toolpath (program punched) onPath texts
        pure Compiled {machine, toolpath, punched = written, proof = Just proof}
  where
    toolpath = withoutCuts path
    heading = Heading.fromToolpath path

-- | Proof of files that the compiler has written. @onPath@ is the proof of their frames.
proveFiles ::
  Machine ->
  ProgramForm ->
  Toolpath ->
  FrameProgram ->
  Proof ->
  [ToolFile] ->
  Result Report Report Proof
proveFiles machine form toolpath program onPath texts =
  case FromGcode.readTexts machine form heading program (map Writer.fileText texts) of
    Left fault -> failed (inFile (FaultReport.toReport (\_ _ -> Region 0 0) fault))
    Right reading
      | FromGcode.framesRead reading /= map Frame.frame (Frame.plannedFrames program) ->
        failed (Tape.toReport (Tape.Damage 1 Nothing Nothing Tape.Misread))
      | otherwise ->
        let proof = FromGcode.judged machine form heading program reading onPath
            lineRegion = const (Region 0 0)
            -- The findings of the frames are already reported.
            further =
              proof
                { Proof.findings =
                    filter (`notElem` Proof.findings onPath) (Proof.findings proof)
                }
            reports = gcodeReports (Toolpath.unit toolpath) machine form lineRegion further
         in failing (map inFile reports) proof
  where
    heading = Heading.fromToolpath toolpath
    inFile r = r {place = InFile, others = []}

-- | Makes the tape that a machine without such a form reads.
makePunched :: Verification -> Toolpath -> Machine -> Result Report Report Compiled
makePunched verification path machine =
  -- @toolpath@ is evaluated before the frames are made. Unevaluated, it would keep all cutting
  -- moves in memory; now each of them is freed as soon as its frames are made.
  toolpath `seq` do
    punched@Punched {program, tape} <- punch machine path
    let punchedFrames = map Frame.frame (Frame.plannedFrames program)
        readBack = Tape.readPunched machine (Frame.start program) punchedFrames tape
    when (null punchedFrames) (failed (Project.toReport Project.NothingToPunch))
    proof <- case verification of
      Unverified -> pure Nothing
      Verified -> do
        frames <- mapErrors id Tape.toReport (fromEither readBack)
        Just <$> prove machine toolpath program frames
    warned (readerWarning unit machine punched)
    pure Compiled {machine, toolpath, punched, proof}
  where
    toolpath = withoutCuts path
    unit = Toolpath.unit toolpath

-- | Warning of frames within a cut that the machine does not read in time (Tape → Pulse).
readerWarning :: LengthUnit -> Machine -> Punched -> [Report]
readerWarning unit machine Punched {program, tape} =
  [ Frame.warningReport unit machine (Frame.ReaderTooSlow (Frame.origin planned) n (length late))
    | n : _ <- [late],
      planned <- take 1 (drop (n - 1) (Frame.plannedFrames program))
  ]
  where
    late = ReaderDwell.dwells machine (FrameCompensation.prepared machine radii begin frames)
    Console {radii} = Controller.consoleFor machine (Frame.plannedFrames program)
    begin = Frame.start program
    frames = Tape.readInTurn machine begin tape

-- | The frames of a toolpath for one machine, and the tape that contains these frames.
data Punched = Punched
  { program :: FrameProgram,
    -- | the tape; for a modern control the frames alone, as its description lays them out, which
    -- serve the model of the controller
    tape :: ~Tape,
    -- | the files for a modern control; empty for other machines
    files :: [ToolFile]
  }

-- | Makes the frames and the tape of a toolpath (Toolpath → Frame → Tape). The tape is lazy, so no
-- row of it is made before it is needed. Refuses frames with cutter compensation that a control
-- would refuse.
punch :: Machine -> Toolpath -> Result Report Report Punched
punch machine path =
  -- Evaluated before the frames are made, so that the cutting moves do not stay in memory.
  compensated `seq` do
    program <-
      mapErrors
        (Frame.warningReport unit machine)
        (Frame.toReport unit machine)
        (Frame.quantise machine path)
    let frames = map Frame.frame (Frame.plannedFrames program)
    -- The frames of a program without compensation need not be in memory as a whole.
    when compensated (noneOf (CompensationCheck.reports machine program))
    case Machine.programForm machine of
      Nothing ->
        let tape = Tape.write machine (Frame.start program) frames
         in tape `seq` pure Punched {program, tape, files = []}
      Just form -> do
        noneOf (Requirement.refusals machine form heading path program)
        pure (withFiles machine (Writer.write machine form heading Nothing program) program)
  where
    heading = Heading.fromToolpath path
    unit = Toolpath.unit path
    compensated = isCompensated path
    noneOf refused = if null refused then pure () else Result [] refused Nothing

-- | Frames with the files that contain them.
withFiles :: Machine -> [ToolFile] -> FrameProgram -> Punched
withFiles machine files program =
  Punched
    { program,
      tape =
        Tape.write
          machine
          (Frame.start program)
          ( TurnFeed.perMinute
              machine
              (Frame.start program)
              (map Frame.frame (Frame.plannedFrames program))
          ),
      files
    }

-- | Runs the frames of a tape on the controller model and compares the motions with the part (Frame
-- → Control → Verify). The errors of the result are the findings: all that the proof has found
-- wrong. If there are none, the tape is proven. @toolpath@ may be reduced by 'withoutCuts'.
prove :: Machine -> Toolpath -> FrameProgram -> [Frame.Frame] -> Result Report Report Proof
prove machine toolpath program frames =
  failing (Proof.toReports (Toolpath.unit toolpath) machine proof) proof
  where
    proof = Verify.prove machine toolpath program frames

-- | Proves a tape that may come from elsewhere, as 'prove' does. A closed contour whose start the
-- program leaves open may begin anywhere on it ('ContourStart.isFree'). @part@ is the evaluated
-- program. It is needed only if the tape begins a contour elsewhere than the compiler would.
proveTape :: Maybe Part -> Compiled -> [Frame.Frame] -> Result Report Report Proof
proveTape part compiled@Compiled {machine, toolpath} frames =
  failing (Proof.toReports (Toolpath.unit toolpath) machine proof) proof
  where
    proof = fromAnyStart part compiled frames

fromAnyStart :: Maybe Part -> Compiled -> [Frame.Frame] -> Proof
fromAnyStart part Compiled {machine, toolpath, punched} =
  Verify.proveFromAnyStart replanned machine toolpath (program punched)
  where
    replanned starts = do
      path <- ifSound . Toolpath.toToolpath =<< ContourStart.moved starts =<< part
      Punched {program} <- ifSound (punch machine path)
      pure (withoutCuts path, program)

-- | Proves files of G-code that may come from elsewhere, as 'proveTape' does, and judges the state
-- of the control in them.
proveGcode :: ProgramForm -> Maybe Part -> Compiled -> GcodeReading -> Proof
proveGcode form part compiled@Compiled {machine, toolpath} reading =
  FromGcode.judged
    machine
    form
    (Heading.fromToolpath toolpath)
    (program (punched compiled))
    reading
    (fromAnyStart part compiled frames)
  where
    frames = FromGcode.framesRead reading

-- | Reports of the proof of a file. @lineRegion@ gives the region of a line of the file.
gcodeReports :: LengthUnit -> Machine -> ProgramForm -> (Int -> Region) -> Proof -> [Report]
gcodeReports unit machine form lineRegion proof =
  map (ControlFault.toReport form lineRegion) (Proof.controlFindings proof)
    <> Proof.toReports unit machine proof

-- | Runs a tape on the controller of the machine and compares its pulses with the motions of the
-- frames (Tape → Pulse → Verify). The errors of the result are the findings. 'Nothing' if the
-- machine's controller is not described, or if its model makes no pulses.
provePulses :: Compiled -> Tape -> Maybe (Result Report Report PulseProof)
provePulses Compiled {machine, toolpath, punched} tape =
  judged <$> FromPulses.prove machine console begin tape
  where
    console = Controller.consoleFor machine (Frame.plannedFrames (program punched))
    begin = Frame.start (program punched)
    judged proof = failing (PulseProof.toReports (Toolpath.unit toolpath) machine proof) proof
