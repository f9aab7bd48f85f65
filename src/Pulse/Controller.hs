-- | The controller of a machine: rows of a tape go in, pulses with their times come out.
--
-- A controller is driven by the tape and the machine description alone. It does not know the part
-- program, the toolpath or the planned frames.
module Pulse.Controller
  ( Console (..),
    neutral,
    consoleFor,
    run,
    measured,
    ticksPerSecond,
  )
where

import Base.LazyList (LazyList)
import Base.PulseVector (Pulses3)
import Base.Quantity (Mm)
import Data.List.NonEmpty qualified as NonEmpty
import Frame.Frame (PlannedFrame)
import Machine.Controller (Controller (..), IntegratorControl (..), StepControl (..))
import Machine.Machine
  ( CommandName,
    CommandValue (..),
    CommandWord (..),
    CommandWords (..),
    Machine,
  )
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (ControllerRun)
import Pulse.FrameCompensation (prepared, switchRadii)
import Pulse.IntegratorRun qualified as IntegratorRun
import Pulse.PathPlanner qualified as PathPlanner
import Pulse.RunMeasure (FrameMeasure, RunTotal)
import Pulse.RunMeasure qualified as RunMeasure
import Pulse.StepRun qualified as StepRun
import Tape.Punch qualified as Punch
import Tape.Tape (Tape)

-- | Settings at the console of a control: the correction of the feed as a factor, and the radius of
-- the cutter at each switch that is set.
data Console = Console {correction :: Double, radii :: [(Int, Mm)]}

-- | Console that corrects no feed and has no switch set.
neutral :: Console
neutral = Console {correction = 1, radii = []}

-- | Console with the switches set for the cutters of planned frames.
consoleFor :: Machine -> [PlannedFrame] -> Console
consoleFor machine planned = neutral {radii = switchRadii machine planned}

-- | Run of a tape. The third argument is the position of the cutter before the tape, in pulses.
-- 'Nothing' if the model of the controller makes no pulses.
run :: Machine -> Console -> Pulses3 -> Tape -> Maybe ControllerRun
run machine Console {correction, radii} start tape = case Machine.controller machine of
  Nothing -> Nothing
  Just (Stepping c) -> Just (StepRun.run machine c correction final frames)
  Just (Integrating c) ->
    Just (IntegratorRun.run machine c correction final (prepared machine radii start frames))
  Just (Planning _) -> Nothing
  where
    final = lastCommands machine
    frames = Punch.readInTurn machine start tape

-- | Measures of the frames of a tape. The arguments are those of 'run'. 'Nothing' if the
-- description of the machine has no controller.
measured :: Machine -> Console -> Pulses3 -> Tape -> Maybe (LazyList RunTotal FrameMeasure)
measured machine console start tape = case Machine.controller machine of
  Nothing -> Nothing
  Just (Planning c) ->
    Just (PathPlanner.measure machine c (lastCommands machine) frames)
  Just (Stepping c) -> RunMeasure.measure machine (stepClock c) <$> pulses
  Just (Integrating c) -> RunMeasure.measure machine (clock c) <$> pulses
  where
    frames = Punch.readInTurn machine start tape
    pulses = run machine console start tape

-- | Frequency of the clock whose ticks 'measured' counts; 'Nothing' if the description of the
-- machine has no controller.
ticksPerSecond :: Machine -> Maybe Int
ticksPerSecond machine = case Machine.controller machine of
  Nothing -> Nothing
  Just (Stepping c) -> Just (stepClock c)
  Just (Integrating c) -> Just (clock c)
  Just (Planning _) -> Just PathPlanner.clock

-- | Commands of the last frame of a program; none if the machine's tapes have no such frame.
lastCommands :: Machine -> [(CommandName, Int)]
lastCommands machine = case reverse (finish (Machine.commandWords machine)) of
  [] -> []
  final : _ -> [(commandName w, v) | w@CommandWord {value = Fixed v} <- NonEmpty.toList final]
