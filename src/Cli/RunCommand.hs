-- | The subcommand @run@: runs a tape on the model of its controller, and writes times, pulses and
-- feeds, or draws them.
module Cli.RunCommand
  ( run,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.Quantity (Mm)
import Base.Region (Source)
import Base.Region qualified as Region
import Base.Result (Result)
import Base.Result qualified as Result
import Cli.Error (Error (..))
import Cli.Error qualified as Cli
import Cli.InputFile
  ( Input (..),
    descriptionsFor,
    displayName,
    ownFiles,
    readBytes,
    source,
    withInput,
  )
import Cli.Options (RunForm (..), RunOptions (..))
import Cli.Outcome (exitAfterWriting, failWith, failWithReport, whenSound)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Cli.OutputFile (writeText)
import Cli.RunTable qualified as RunTable
import Compile (Compiled, Punched (..))
import Compile qualified
import Data.ByteString.Builder (Builder)
import Data.Maybe (fromMaybe, maybeToList)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Draw.SpeedPlot qualified as SpeedPlot
import Draw.TimeColumn (TimeColumns)
import Draw.TimeColumn qualified as TimeColumn
import Frame.Frame (FrameProgram (plannedFrames))
import Machine.Controller (Controller (..), IntegratorControl (override))
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Project.Error qualified as Project
import Project.Job (Job (verification), Verification (..))
import Project.Job qualified as Job
import Project.LoadedProgram qualified as LoadedProgram
import Project.Target qualified as Target
import Pulse.Controller (Console (..))
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (ControllerRun, StopReason (..))
import Pulse.FrameCompensation (switchRadii)
import Pulse.RunMeasure (RunTotal (stopReason))
import Report.Report (Report)
import System.FilePath (takeExtension, takeFileName)
import Tape.Punch qualified as Tape
import Tape.Tape (Tape (..))

-- | Runs the tape of a program, or a tape.
run :: Reporter -> RunOptions -> IO Exit
run reporter options
  | isProgram = withInput reporter file (maybeToList target) $ \given ->
    whenSound reporter (name given) (source given) (compiled target given) $ \made ->
      let punched = Compile.punched made
          rows = tape punched
       in runTape
            reporter
            options
            Subject
              { tapeName = name given,
                text = source given,
                machine = Compile.machine made,
                rows,
                sources = ownFiles file given,
                known = switchRadii (Compile.machine made) (plannedFrames (program punched))
              }
  | otherwise = case target of
    Nothing -> failWith reporter shown (NoMachineForTape Target.builtInNames)
    Just wanted -> do
      descriptions <- descriptionsFor [wanted] []
      case Target.machineNamed descriptions wanted of
        Left e -> failWithReport reporter shown (Project.toReport e)
        Right machine ->
          readBytes file
            >>= either (failWith reporter shown) (runTape reporter options . onTape wanted machine)
  where
    file = runInput options
    target = runTarget options
    shown = displayName file
    onTape wanted machine bytes =
      Subject
        { tapeName = shown,
          text = Region.fromText shown "",
          machine,
          rows = Tape bytes,
          sources = [file, Text.unpack wanted],
          known = []
        }
    isProgram = takeExtension file == ".part" || LoadedProgram.isInputSheet file

-- | Tape to run: its name and text in reports, its machine, its rows, and the files that no output
-- may replace.
data Subject = Subject
  { tapeName :: Text,
    text :: Source,
    machine :: Machine,
    rows :: Tape,
    sources :: [FilePath],
    -- | radius of the cutter at each switch that the program uses
    known :: [(Int, Mm)]
  }

-- | Compiles a program for the chosen machine, or for the machine that the program names. The tape
-- is not verified.
compiled :: Maybe Text -> Input -> Result Report Report Compiled
compiled target given = do
  made <- Compile.compile job {verification = Unverified} (loaded given)
  case made of
    first : _ -> pure first
    [] -> Result.failed (Project.toReport (Project.NoMachine Target.builtInNames))
  where
    job = Job.forTargets (maybeToList target) (values given) (loaded given)

-- | Runs a tape and writes the chosen form. The cutter starts at 0.
runTape :: Reporter -> RunOptions -> Subject -> IO Exit
runTape reporter options subject = case correctionFor options (machine subject) of
  Left e -> failWith reporter (tapeName subject) e
  Right correction -> case runForm options of
    PulseStream -> withPulses reporter subject (console correction) $ \pulses ->
      written (RunTable.pulseLines (machine subject) isShown pulses) id (const mempty)
    RunAsTable ->
      let after = Encoding.encodeUtf8Builder . totals RunTable.totalLines
       in measured correction RunTable.frameLines after
    RunAsJson -> measured correction RunTable.frameJson (totals RunTable.totalJson)
    SpeedPicture output -> withPulses reporter subject (console correction) $ \pulses ->
      speedPicture
        reporter
        subject
        output
        (SpeedPlot.columns (machine subject) clock isShown pulses)
  where
    clock = clockOf subject
    totals make = make (machine subject) clock
    measured correction lines' after =
      case Controller.measuredWith (machine subject) (console correction) 0 (rows subject) of
        Nothing -> failWith reporter (tapeName subject) (NoController (machineName subject))
        Just list -> written (lines' (machine subject) clock isShown list) stopReason after
    console correction = Console {correction, radii = switchesAt options <> known subject}
    isShown n = all (n >=) (fromFrame options) && all (n <=) (toFrame options)
    written :: LazyList e Builder -> (e -> StopReason) -> (e -> Builder) -> IO Exit
    written parts reasonOf after = do
      done <- Output.resultStream (partsToCollection (runForm options)) parts
      case done of
        Left why -> exitAfterWriting reporter "" "to standard output" (Left why)
        Right Nothing -> pure Done
        Right (Just e) -> do
          _ <- Output.resultStream 1 (LazyList.Next (after e) (LazyList.End ()))
          afterStop reporter subject (reasonOf e)

-- | Frequency of the clock of a controller.
clockOf :: Subject -> Int
clockOf = fromMaybe 1 . Controller.ticksPerSecond . machine

machineName :: Subject -> Text
machineName subject = let MachineName name' = Machine.name (machine subject) in name'

-- | Continues with the pulses of a run. The command fails with a report if the controller makes
-- none.
withPulses :: Reporter -> Subject -> Console -> (ControllerRun -> IO Exit) -> IO Exit
withPulses reporter subject console continue =
  case Controller.runWith (machine subject) console 0 (rows subject) of
    Nothing -> failWith reporter (tapeName subject) (NoPulses (machineName subject))
    Just pulses -> continue pulses

-- | Writes the picture of the feed and the frequencies.
speedPicture :: Reporter -> Subject -> Maybe FilePath -> (TimeColumns, StopReason) -> IO Exit
speedPicture reporter subject output (columns, why)
  | null (TimeColumn.frameStarts columns) =
    failWith reporter (tapeName subject) (NothingInRange "frame" (frameCount subject))
  | otherwise = writePicture reporter subject output picture why
  where
    picture = SpeedPlot.plot (machine subject) axes (clockOf subject) (shortName subject) columns
    axes = RunTable.axisNames (machine subject)

-- | Writes a picture, and reports why the run has stopped before the end of the tape, if it has.
writePicture :: Reporter -> Subject -> Maybe FilePath -> Text -> StopReason -> IO Exit
writePicture reporter subject output picture why = do
  exit <- writeText reporter (tapeName subject) (sources subject) output picture
  if exit == Done then afterStop reporter subject why else pure exit

-- | Name of the tape or program without its folder.
shortName :: Subject -> Text
shortName = Text.pack . takeFileName . Text.unpack . tapeName

-- | Count of the frames that run.
frameCount :: Subject -> Int
frameCount subject =
  maybe 0 (length . LazyList.toList) (Controller.measured (machine subject) 1 0 (rows subject))

-- | Exit status after a run that stops for a reason, which is reported if it is a fault of the
-- tape.
afterStop :: Reporter -> Subject -> StopReason -> IO Exit
afterStop reporter subject why = case why of
  Unreadable damage -> stoppedWith (Tape.toReport damage)
  TooFast n asked most -> stoppedWith (Cli.toReport (FeedTooHigh n asked most))
  TapeEnds -> pure Done
  ProgramEnds -> pure Done
  FeedHeld _ -> pure Done
  SwitchNotSet n k -> stoppedWith (Cli.toReport (SwitchMissing n k))
  NotCompensated n fault -> stoppedWith (Cli.toReport (CompensationFails n fault))
  where
    stoppedWith report =
      Failed <$ Output.showReports reporter (tapeName subject) (text subject) [report]

-- | Count of parts of the output after which garbage is collected. A part is the line of a pulse,
-- or of a frame, which has many pulses.
partsToCollection :: RunForm -> Int
partsToCollection form = case form of
  PulseStream -> 65536
  RunAsTable -> 256
  RunAsJson -> 256
  SpeedPicture _ -> 256

-- | Correction of the feed as a factor, from the position of the switch that the command line
-- names.
correctionFor :: RunOptions -> Machine -> Either Error Double
correctionFor options machine = case overrideAt options of
  Nothing -> Right 1
  Just n
    | n `elem` positions -> Right (fromIntegral n / 100)
    | otherwise -> Left (NoSuchOverride n positions)
  where
    positions = case Machine.controller machine of
      Just (Integrating c) -> override c
      _ -> []
