-- | Run of a tape on a controller: a list of events.
--
-- A run is a lazy list: its next event is computed when it is asked for, from the state of the
-- controller, so a run of any length needs little memory. Ticks are those of the controller's
-- clock, counted from the start of the tape.
module Pulse.ControllerRun
  ( ControllerRun (..),
    Tick,
    FrameStart (..),
    JobRun (..),
    StopReason (..),
    fold,
  )
where

import Data.Text (Text)
import Frame.Frame (Frame)
import Machine.Controller (ControlJob)
import Machine.FrameLayout (CommandName)
import Pulse.FramePath (AskedFeed, FramePath)
import Pulse.Steps (Steps)
import Tape.Damage (Damage)

-- | Count of ticks since the start of the tape.
type Tick = Int

-- | Events of a run. Each constructor but the last has the rest of the run.
data ControllerRun
  = -- | A frame begins.
    FrameBegins FrameStart ~ControllerRun
  | -- | Pulses at one tick.
    Stepped Tick Steps ~ControllerRun
  | -- | The motion of the frame ends.
    FrameEnds Tick ~ControllerRun
  | -- | A command with its number goes to the machine.
    Commanded Tick CommandName Int ~ControllerRun
  | -- | The dispatcher has run a job.
    JobDone JobRun ~ControllerRun
  | -- | The controller stops.
    Stopped Tick StopReason

-- | Start of a frame.
data FrameStart = FrameStart
  { startTick :: Tick,
    -- | number of the frame, from 1
    number :: Int,
    frameStarted :: Frame,
    -- | 'Nothing' for a frame without motion
    path :: Maybe FramePath,
    -- | ticks for which the controller has waited until the frame was read
    waited :: Tick
  }

-- | Job that the dispatcher has run: the ticks at which it was requested, began and ended.
data JobRun = JobRun {job :: ControlJob, requestedAt :: Tick, beganAt :: Tick, endedAt :: Tick}

-- | Reason why a controller stops.
data StopReason
  = -- | The tape is at its end.
    TapeEnds
  | -- | A frame has given the last commands of a program.
    ProgramEnds
  | -- | A frame cannot be read.
    Unreadable Damage
  | -- | The controller cannot run the feed of this frame: the number of the frame, its feed, and
    -- the largest feed that it can run in this frame.
    TooFast Int AskedFeed AskedFeed
  | -- | The switch that corrects the feed is at 0: the number of the frame.
    FeedHeld Int
  | -- | A frame switches cutter compensation on, but the switch for the cutter's radius is not set:
    -- the number of the frame, and that of the switch.
    SwitchNotSet Int Int
  | -- | A frame and its neighbour do not fit under cutter compensation: the number of the frame,
    -- and the reason, which completes a sentence that begins with the frame.
    NotCompensated Int Text
  deriving stock (Eq, Show)

-- | Strict left fold over the events of a run. The function also gets the last event.
fold :: (s -> ControllerRun -> s) -> s -> ControllerRun -> s
fold f = go
  where
    go s run =
      let s' = f s run
       in s' `seq` case run of
            FrameBegins _ more -> go s' more
            Stepped _ _ more -> go s' more
            FrameEnds _ more -> go s' more
            Commanded _ _ _ more -> go s' more
            JobDone _ more -> go s' more
            Stopped _ _ -> s'
