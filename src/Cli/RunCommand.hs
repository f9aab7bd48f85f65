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
import Draw.Timeline qualified as Timeline
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
import Pulse.JobTimeline (TickRange (..))
import Pulse.JobTimeline qualified as JobTimeline
import Pulse.RunMeasure (RunTotal (stopReason, totalTicks))
import Pulse.RunMeasure qualified as RunMeasure
import Report.Report (Report)
import System.FilePath (takeExtension, takeFileName)
import Tape.Punch (TapeFrame (frameRead))
import Tape.Punch qualified as Tape
import Tape.Tape (Tape (..))

-- | Runs the tape of a program, or a tape.
run :: Reporter -> RunOptions -> IO Exit
run reporter options
  | isProgram = withInput reporter file (maybeToList target) $ \given ->
    whenSound reporter (name given) (source given) (compiled target given) $ \made ->
      let punched = Compile.punched made
       in runTape
            reporter
            options
            RunSubject
              { tapeName = name given,
                text = source given,
                machine = Compile.machine made,
                known = switchRadii (Compile.machine made) (plannedFrames (program punched)),
                rows = tape punched,
                sources = ownFiles file given
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
      RunSubject
        { tapeName = shown,
          text = Region.fromText shown "",
          machine,
          known = [],
          rows = Tape bytes,
          sources = [file, Text.unpack wanted]
        }
    isProgram = takeExtension file == ".part" || LoadedProgram.isInputSheet file

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

-- | Tape that is run.
data RunSubject = RunSubject
  { -- | name and text in reports
    tapeName :: Text,
    text :: Source,
    machine :: Machine,
    -- | radius of the cutter at each switch that the program uses
    known :: [(Int, Mm)],
    rows :: Tape,
    -- | files that no output may replace
    sources :: [FilePath]
  }

-- | Runs a tape and writes the chosen form. The cutter starts at 0.
runTape :: Reporter -> RunOptions -> RunSubject -> IO Exit
runTape reporter options subject = case correctionFor options (machine subject) of
  Left e -> failWith reporter (tapeName subject) e
  Right correction ->
    let console = Console {correction, radii = switchesAt options <> known subject}
        withRun = withPulses reporter subject console
     in case runForm options of
          PulseStream ->
            withRun $ \pulses ->
              written (RunTable.pulseLines (machine subject) isShown pulses) id (const mempty)
          RunAsTable ->
            let after = Encoding.encodeUtf8Builder . totals RunTable.totalLines
             in measured console RunTable.frameLines after
          RunAsJson -> measured console RunTable.frameJson (totals RunTable.totalJson)
          SpeedPicture output ->
            withRun (speedPicture reporter subject output . speedColumns)
          TimelinePicture ticks output ->
            let range = maybe (AtFeedMove isShown) (uncurry Ticks) ticks
             in withDispatcher reporter subject $ \control ->
                  withRun (timelinePicture reporter subject output range control)
  where
    clock = clockOf subject
    totals make = make (machine subject) clock
    speedColumns = SpeedPlot.columns (machine subject) clock isShown
    measured console lines' after =
      case Controller.measuredWith (machine subject) console 0 (rows subject) of
        Nothing -> failWith reporter (tapeName subject) (NoController (machineName subject))
        Just list -> written (lines' (machine subject) clock isShown list) stopReason after
    isShown n = all (n >=) (fromFrame options) && all (n <=) (toFrame options)
    written :: LazyList e Builder -> (e -> StopReason) -> (e -> Builder) -> IO Exit
    written = writeStream reporter subject (partsToCollection (runForm options))

-- | Writes the parts of an output, and what @after@ makes of the value behind the last one.
-- @toCollection@ is the count of parts after which garbage is collected. @reasonOf@ gives the
-- reason why the run has stopped.
writeStream ::
  Reporter ->
  RunSubject ->
  Int ->
  LazyList e Builder ->
  (e -> StopReason) ->
  (e -> Builder) ->
  IO Exit
writeStream reporter subject toCollection parts reasonOf after = do
  done <- Output.resultStream toCollection parts
  case done of
    Left why -> exitAfterWriting reporter "" "to standard output" (Left why)
    Right Nothing -> pure Done
    Right (Just e) -> do
      _ <- Output.resultStream 1 (LazyList.Next (after e) (LazyList.End ()))
      afterStop reporter subject (reasonOf e)

-- | Frequency of the clock of a controller.
clockOf :: RunSubject -> Int
clockOf = fromMaybe 1 . Controller.ticksPerSecond . machine

machineName :: RunSubject -> Text
machineName subject = let MachineName name' = Machine.name (machine subject) in name'

-- | Continues with the pulses of a run. The command fails with a report if the controller makes
-- none.
withPulses :: Reporter -> RunSubject -> Console -> (ControllerRun -> IO Exit) -> IO Exit
withPulses reporter subject console continue =
  case Controller.runWith (machine subject) console 0 (rows subject) of
    Nothing -> failWith reporter (tapeName subject) (NoPulses (machineName subject))
    Just pulses -> continue pulses

-- | Writes the picture of the feed and the frequencies.
speedPicture :: Reporter -> RunSubject -> Maybe FilePath -> (TimeColumns, StopReason) -> IO Exit
speedPicture reporter subject output (columns, why)
  | null (TimeColumn.frameStarts columns) =
    failWith reporter (tapeName subject) (NothingInRange "frame" (frameCount subject))
  | otherwise = do
    exit <- writeText reporter (tapeName subject) (sources subject) output picture
    if exit == Done then afterStop reporter subject why else pure exit
  where
    picture = SpeedPlot.plot (machine subject) axes (clockOf subject) (shortName subject) columns
    axes = RunTable.axisNames (machine subject)

-- | Continues with the control of a machine that has a dispatcher. The command fails with a report
-- if the machine has none.
withDispatcher :: Reporter -> RunSubject -> (IntegratorControl -> IO Exit) -> IO Exit
withDispatcher reporter subject continue = case Machine.controller (machine subject) of
  Just (Integrating control) -> continue control
  Just (Stepping _) -> refused
  Just (Planning _) -> refused
  Nothing -> refused
  where
    refused = failWith reporter (tapeName subject) (NoDispatcher (machineName subject))

-- | Writes the picture of the dispatcher's jobs in a range of a run.
timelinePicture ::
  Reporter ->
  RunSubject ->
  Maybe FilePath ->
  TickRange ->
  IntegratorControl ->
  ControllerRun ->
  IO Exit
timelinePicture reporter subject output range control pulses =
  case JobTimeline.collect (machine subject) control range pulses of
    Just timeline ->
      writeText
        reporter
        (tapeName subject)
        (sources subject)
        output
        (Timeline.plot (machine subject) control (shortName subject) timeline)
    Nothing -> failWith reporter (tapeName subject) $ case range of
      Ticks _ _ -> NothingInRange "tick" (maybe 0 (totalTicks . LazyList.end) measured)
      AtFeedMove _ -> NothingInRange "feed move" (length (filter isFeedMove frames))
  where
    measured = Controller.measured (machine subject) 1 0 (rows subject)
    frames = LazyList.toList (Tape.readInTurn (machine subject) 0 (rows subject))
    isFeedMove = RunMeasure.isAtFeed (machine subject) . frameRead

-- | Name of the tape or program without its folder.
shortName :: RunSubject -> Text
shortName = Text.pack . takeFileName . Text.unpack . tapeName

-- | Count of the frames on the tape that can be read.
frameCount :: RunSubject -> Int
frameCount subject = length (LazyList.toList (Tape.readInTurn (machine subject) 0 (rows subject)))

-- | Exit status after a run that stops for a reason, which is reported if it is a fault.
afterStop :: Reporter -> RunSubject -> StopReason -> IO Exit
afterStop reporter subject why = case why of
  Unreadable damage -> stoppedWith (Tape.toReport damage)
  TooFast n asked most -> stoppedWith (Cli.toReport (FeedTooHigh n asked most))
  TapeEnds -> pure Done
  ProgramEnds -> pure Done
  FeedHeld _ -> pure Done
  SwitchNotSet n k -> stoppedWith (Cli.toReport (SwitchMissing n k))
  NotCompensated n reason -> stoppedWith (Cli.toReport (CompensationFails n reason))
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
  TimelinePicture _ _ -> 256

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
