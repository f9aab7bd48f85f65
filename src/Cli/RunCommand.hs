-- | The subcommand @run@: runs a tape on the model of its controller, and writes times, pulses and
-- feeds.
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
    readBytes,
    source,
    withInput,
  )
import Cli.Options (RunForm (..), RunOptions (..))
import Cli.Outcome (exitAfterWriting, failWith, failWithReport, whenSound)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Cli.RunTable qualified as RunTable
import Compile (Compiled, Punched (..))
import Compile qualified
import Data.ByteString.Builder (Builder)
import Data.Maybe (fromMaybe, maybeToList)
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
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
import Pulse.ControllerRun (StopReason (..))
import Pulse.FrameCompensation (switchRadii)
import Pulse.RunMeasure (RunTotal (stopReason))
import Report.Report (Report)
import System.FilePath (takeExtension)
import Tape.Punch qualified as Tape
import Tape.Tape (Tape (..))

-- | Runs the tape of a program, or a tape.
run :: Reporter -> RunOptions -> IO Exit
run reporter options
  | isProgram = withInput reporter file (maybeToList target) $ \given ->
    whenSound reporter (name given) (source given) (compiled target given) $ \made ->
      let punched = Compile.punched made
          known = switchRadii (Compile.machine made) (plannedFrames (program punched))
          subject = RunSubject (name given) (source given) (Compile.machine made) known
       in runTape reporter options subject (tape punched)
  | otherwise = case target of
    Nothing -> failWith reporter tapeName (NoMachineForTape Target.builtInNames)
    Just wanted -> do
      descriptions <- descriptionsFor [wanted] []
      case Target.machineNamed descriptions wanted of
        Left e -> failWithReport reporter tapeName (Project.toReport e)
        Right machine ->
          readBytes file
            >>= either
              (failWith reporter tapeName)
              (runTape reporter options (fromTape machine) . Tape)
  where
    file = runInput options
    target = runTarget options
    tapeName = displayName file
    fromTape machine = RunSubject tapeName (Region.fromText tapeName "") machine []
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

-- | Tape that is run: its name and its text in reports, its machine, and the radius of the cutter
-- at each switch that the program uses.
data RunSubject = RunSubject Text Source Machine [(Int, Mm)]

-- | Runs a tape and writes the chosen form. The cutter starts at 0.
runTape :: Reporter -> RunOptions -> RunSubject -> Tape -> IO Exit
runTape reporter options subject rows = case correctionFor options machine of
  Left e -> failWith reporter tapeName e
  Right correction -> case runForm options of
    PulseStream -> case Controller.runWith machine console 0 rows of
      Nothing -> failWith reporter tapeName (NoPulses machineName)
      Just pulses -> written (RunTable.pulseLines machine isShown pulses) id (const mempty)
    RunAsTable ->
      measured RunTable.frameLines (Encoding.encodeUtf8Builder . totals RunTable.totalLines)
    RunAsJson -> measured RunTable.frameJson (totals RunTable.totalJson)
    where
      console = Console {correction, radii = switchesAt options <> known}
      clock = fromMaybe 1 (Controller.ticksPerSecond machine)
      totals make = make machine clock
      measured lines' after = case Controller.measuredWith machine console 0 rows of
        Nothing -> failWith reporter tapeName (NoController machineName)
        Just list -> written (lines' machine clock isShown list) stopReason after
  where
    RunSubject tapeName text machine known = subject
    MachineName machineName = Machine.name machine
    isShown n = all (n >=) (fromFrame options) && all (n <=) (toFrame options)
    written :: LazyList e Builder -> (e -> StopReason) -> (e -> Builder) -> IO Exit
    written parts reasonOf after = do
      done <- Output.resultStream (partsToCollection (runForm options)) parts
      case done of
        Left why -> exitAfterWriting reporter "" "to standard output" (Left why)
        Right Nothing -> pure Done
        Right (Just e) -> do
          _ <- Output.resultStream 1 (LazyList.Next (after e) (LazyList.End ()))
          case reasonOf e of
            Unreadable damage -> stoppedWith (Tape.toReport damage)
            TooFast n asked most -> stoppedWith (Cli.toReport (FeedTooHigh n asked most))
            TapeEnds -> pure Done
            ProgramEnds -> pure Done
            FeedHeld _ -> pure Done
            SwitchNotSet n k -> stoppedWith (Cli.toReport (SwitchMissing n k))
            NotCompensated n why -> stoppedWith (Cli.toReport (CompensationFails n why))
    stoppedWith report = Failed <$ Output.showReports reporter tapeName text [report]

-- | Count of parts of the output after which garbage is collected. A part is the line of a pulse,
-- or of a frame, which has many pulses.
partsToCollection :: RunForm -> Int
partsToCollection form = case form of
  PulseStream -> 65536
  RunAsTable -> 256
  RunAsJson -> 256

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
