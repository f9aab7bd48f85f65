-- | The subcommand @run@: runs a tape on the model of its controller, and writes times, pulses and
-- feeds, or draws them.
module Cli.RunCommand
  ( run,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses3)
import Base.Quantity (Mm)
import Base.Region (Source)
import Base.Region qualified as Region
import Cli.DrawingFile (writeDrawing)
import Cli.Error (Error (..))
import Cli.Error qualified as Cli
import Cli.GcodeFile qualified as GcodeFile
import Cli.InputFile
  ( Input (..),
    displayName,
    ownFiles,
    source,
    withInput,
  )
import Cli.Options (RunForm (..), RunOptions (..))
import Cli.Outcome (exitAfterWriting, failWith, whenSound)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Cli.RunTable qualified as RunTable
import Cli.TapeDifference qualified as TapeDifference
import Cli.TapeInput (onFirstMachine, withTapeFile)
import Compile (Punched (..))
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
import Frame.Frame (Frame, FrameProgram (plannedFrames))
import Frame.Frame qualified as Frame
import Machine.Controller (Controller (..), IntegratorControl (override, switches))
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Project.LoadedProgram qualified as LoadedProgram
import Pulse.Controller (Console (..))
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (ControllerRun, StopReason (..))
import Pulse.JobTimeline (TickRange (..))
import Pulse.JobTimeline qualified as JobTimeline
import Pulse.RunMeasure (FrameMeasure, RunTotal (stopReason, totalTicks))
import Pulse.RunMeasure qualified as RunMeasure
import Report.Report (Report)
import System.FilePath (takeFileName)
import Tape.Punch (TapeFrame (frameRead))
import Tape.Punch qualified as Tape
import Tape.Tape (Tape)

-- | Runs the tape of a program, or a tape.
run :: Reporter -> RunOptions -> IO Exit
run reporter options
  | LoadedProgram.isProgram file = withInput reporter file (maybeToList target) $ \given ->
    whenSound reporter (name given) (source given) (onFirstMachine target given) $ \made ->
      let Punched {program, tape} = Compile.punched made
       in runTape
            reporter
            options
            RunSubject
              { tapeName = name given,
                text = source given,
                machine = Compile.machine made,
                console = Controller.consoleFor (Compile.machine made) (plannedFrames program),
                start = Frame.start program,
                rows = tape,
                sources = ownFiles file given
              }
  | otherwise = withTapeFile reporter target file $ \machine rows ->
    case inFrames file machine rows of
      Left (described, fault) ->
        Failed <$ Output.showReports reporter (Region.mainFile described) described [fault]
      Right tape -> runTape reporter options (alone machine tape)
  where
    file = runInput options
    target = runTarget options
    alone machine rows =
      RunSubject
        { tapeName = displayName file,
          text = Region.fromText (displayName file) "",
          machine,
          console = Controller.neutral,
          start = 0,
          rows,
          sources = file : map Text.unpack (maybeToList target)
        }

-- | The tape that is run for a file: a file of G-code is run as the tape that has its frames alone.
inFrames :: FilePath -> Machine -> Tape -> Either (Source, Report) Tape
inFrames file machine rows = case Machine.programForm machine of
  Nothing -> Right rows
  Just form ->
    fst
      <$> GcodeFile.tapeAlone
        machine
        form
        (GcodeFile.GcodeFile (displayName file) (TapeDifference.textOf rows))

-- | Tape that is run.
data RunSubject = RunSubject
  { -- | name and text in reports
    tapeName :: Text,
    text :: Source,
    machine :: Machine,
    -- | switches that the program sets
    console :: Console,
    -- | position of the cutter before the tape; 0 for a tape without its program
    start :: Pulses3,
    rows :: Tape,
    -- | files that no output may replace
    sources :: [FilePath]
  }

-- | Runs a tape and writes the chosen form.
runTape :: Reporter -> RunOptions -> RunSubject -> IO Exit
runTape reporter options given = case corrected of
  Left e -> failWith reporter (tapeName given) e
  Right console' -> Output.collectingOften (runSubject reporter options given {console = console'})
  where
    corrected = do
      correction <- correctionFor options (machine given)
      checkSwitches (switchesAt options) (machine given)
      checkRange options given
      pure (console given) {correction, radii = switchesAt options <> radii (console given)}

-- | Writes a run in the chosen form.
runSubject :: Reporter -> RunOptions -> RunSubject -> IO Exit
runSubject reporter options subject = case runForm options of
  PulseStream ->
    withRun $ \pulses ->
      written (RunTable.pulseLines (machine subject) isShown pulses) id (const mempty)
  RunAsTable ->
    measured RunTable.frameLines (Encoding.encodeUtf8Builder . totals RunTable.totalLines)
  RunAsJson -> measured RunTable.frameJson (totals RunTable.totalJson)
  SpeedPicture output ->
    withRun $
      speedPicture reporter subject output . SpeedPlot.columns (machine subject) clock isShown
  TimelinePicture ticks output ->
    let range = maybe (AtFeedMove isShown) (uncurry Ticks) ticks
     in withDispatcher reporter subject $ \control ->
          withRun (timelinePicture reporter subject output range control)
  where
    withRun = withPulses reporter subject
    clock = clockOf subject
    totals make = make (machine subject) clock
    measured lines' after = case measuresOf subject of
      Nothing -> failWith reporter (tapeName subject) (NoController (machineName subject))
      Just list -> written (lines' (machine subject) clock isShown list) stopReason after
    isShown n = all (n >=) (fromFrame options) && all (n <=) (toFrame options)
    written :: LazyList e Builder -> (e -> StopReason) -> (e -> Builder) -> IO Exit
    written parts reasonOf after = do
      done <- Output.resultStream parts
      case done of
        Left why -> exitAfterWriting reporter "" "to standard output" (Left why)
        Right Nothing -> pure Done
        Right (Just e) -> do
          _ <- Output.resultStream (LazyList.Next (after e) (LazyList.End ()))
          afterStop reporter subject (reasonOf e)

-- | Measures of the frames that run; 'Nothing' without a controller.
measuresOf :: RunSubject -> Maybe (LazyList RunTotal FrameMeasure)
measuresOf subject =
  Controller.measured (machine subject) (console subject) (start subject) (rows subject)

-- | Frequency of the clock of a controller.
clockOf :: RunSubject -> Int
clockOf = fromMaybe 1 . Controller.ticksPerSecond . machine

machineName :: RunSubject -> Text
machineName subject = let MachineName name' = Machine.name (machine subject) in name'

-- | Continues with the pulses of a run. The command fails with a report if the controller makes
-- none.
withPulses :: Reporter -> RunSubject -> (ControllerRun -> IO Exit) -> IO Exit
withPulses reporter subject continue =
  case Controller.run (machine subject) (console subject) (start subject) (rows subject) of
    Nothing -> failWith reporter (tapeName subject) (NoPulses (machineName subject))
    Just pulses -> continue pulses

-- | Writes the picture of the feed and the frequencies.
speedPicture :: Reporter -> RunSubject -> Maybe FilePath -> (TimeColumns, StopReason) -> IO Exit
speedPicture reporter subject output (columns, why)
  | null (TimeColumn.frameStarts columns) =
    failWith reporter (tapeName subject) (NothingInRange "frame" (frameCount subject))
  | not (SpeedPlot.hasMotion columns) =
    failWith reporter (tapeName subject) (NothingInRange "motion" (motionCount subject))
  | otherwise = do
    -- A run that stops at a fault gives no picture.
    exit <- afterStop reporter subject why
    if exit == Done
      then writeDrawing reporter (tapeName subject) (sources subject) output picture
      else pure exit
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
      writeDrawing
        reporter
        (tapeName subject)
        (sources subject)
        output
        (Timeline.plot (machine subject) control (shortName subject) timeline)
    Nothing -> failWith reporter (tapeName subject) $ case range of
      Ticks _ _ -> NothingInRange "tick" (maybe 0 (totalTicks . LazyList.end) (measuresOf subject))
      AtFeedMove _ -> NothingInRange "feed move" (length (filter isFeedMove (framesOf subject)))
  where
    isFeedMove = RunMeasure.isAtFeed (machine subject)

-- | Name of the tape or program without its folder.
shortName :: RunSubject -> Text
shortName = Text.pack . takeFileName . Text.unpack . tapeName

-- | Count of the frames on the tape that can be read.
frameCount :: RunSubject -> Int
frameCount = length . framesOf

-- | Count of these frames that move.
motionCount :: RunSubject -> Int
motionCount = length . filter Frame.isMoving . framesOf

-- | Frames on the tape that can be read.
framesOf :: RunSubject -> [Frame]
framesOf subject =
  map
    frameRead
    (LazyList.toList (Tape.readInTurn (machine subject) (start subject) (rows subject)))

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

-- | Fails if the command line sets a switch twice, or one that the control does not have.
checkSwitches :: [(Int, Mm)] -> Machine -> Either Error ()
checkSwitches set machine = case [n | (n, _) <- set, n < 1 || n > count] of
  n : _ -> Left (NoSuchSwitch n count)
  [] -> case [n | (k, (n, _)) <- zip [0 ..] set, n `elem` map fst (take k set)] of
    n : _ -> Left (SwitchSetTwice n)
    [] -> Right ()
  where
    count = case Machine.controller machine of
      Just (Integrating c) -> switches c
      _ -> 0

-- | Fails if the tape has none of the frames that the command line selects.
checkRange :: RunOptions -> RunSubject -> Either Error ()
checkRange options subject = case (fromFrame options, toFrame options) of
  (Nothing, Nothing) -> Right ()
  (from, to)
    | first > min count (fromMaybe count to) ->
      Left (NothingInRange "frame" count)
    | otherwise -> Right ()
    where
      first = maybe 1 (max 1) from
      count = frameCount subject

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
