{-# OPTIONS_GHC -O2 #-}

-- | Run of Н55-2Л: a feed integrator, a dispatcher, a buffer for the next frame, and the frame at
-- work.
--
-- /Frames./ The rows of the next frame arrive from the reader while a frame is at work. When the
-- frame is finished and the next one is read, a job transfers it, and the next frame begins at the
-- last tick of that job. If the transfer fits before the next overflow, the integrator runs on.
-- Otherwise both its cells are set to 0, and the machine stands still until the frame begins.
--
-- /Feed./ V is the feed along the path times the share of the leading axis. On a line the share is
-- constant. On an arc a job computes it for the direction that the arc has some cycles later. The
-- acceleration job changes the feed towards the feed that the frame asks, and down to the feed at
-- the end of the frame in time. That feed is one from which the next frame can still stop; it is 0
-- while the next frame is not read. Without an acceleration job the feed jumps.
--
-- Feeds here are in mm\/min along x, y and z, or in degrees a minute if only rotary axes move.
module Pulse.IntegratorRun
  ( run,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.Quantity (Seconds (..))
import Data.List (foldl')
import Data.Maybe (isJust)
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Machine.Controller
  ( ControlJob (..),
    IntegratorControl (..),
    JobRequest (..),
    TapeReader (..),
  )
import Machine.Controller qualified as Controller
import Machine.FrameLayout (CommandName)
import Machine.Machine (Machine)
import Pulse.ControllerRun
  ( ControllerRun (..),
    FrameStart (FrameStart),
    JobRun (JobRun),
    StopReason (..),
    Tick,
  )
import Pulse.Dispatcher
  ( Dispatcher (arrivals, integrator, tick, waiting),
    Happening (..),
    Waiting (..),
  )
import Pulse.Dispatcher qualified as Dispatcher
import Pulse.FeedIntegrator (FeedIntegrator (..))
import Pulse.FeedIntegrator qualified as FeedIntegrator
import Pulse.FrameCompensation (PreparedFrame (..))
import Pulse.FramePath (FramePath)
import Pulse.FramePath qualified as FramePath
import Pulse.IntegratorFeed (FeedPlan (..))
import Pulse.IntegratorFeed qualified as Feed
import Pulse.Interpolator qualified as Interpolator
import Pulse.Steps (Cycle (..))
import Tape.Punch (TapeFrame (..))

-- | State of the control.
data Control = Control
  { setup :: Setup,
    dispatcher :: Dispatcher Arrival Work,
    buffer :: Buffer,
    stage :: Stage,
    -- | number of the frame at work, or of the last one; 0 before the first
    number :: Int,
    -- | frame at work, or the last one
    working :: Frame,
    -- | feed at this moment
    feed :: Double,
    -- | frames that are still on the tape
    onTape :: LazyList StopReason PreparedFrame
  }

-- | Constants of a run: the machine, its control, the correction of the feed as a factor, and the
-- commands that end a program.
data Setup = Setup
  { machine :: Machine,
    control :: IntegratorControl,
    correction :: Double,
    lastCommands :: [(CommandName, Int)]
  }

-- | Frame at work.
data Stage
  = -- | No frame is at work. The tick is the end of the last one; the flag is true if the transfer
    -- of the next frame is requested.
    Resting Tick Bool
  | -- | The list has the paths that follow in the same frame.
    Moving FeedPlan [FramePath]

-- | Buffer for the next frame.
data Buffer
  = -- | The frame is read: the rows that have not arrived, each with a flag for the last row of a
    -- word; the count of jobs that are still to be done for rows that have arrived.
    Filling PreparedFrame Reading Int
  | -- | The frame is read, since this tick.
    Filled PreparedFrame Tick
  | -- | The control runs no further frame.
    Exhausted StopReason

-- | Rows of a frame that have not arrived: the tick at which the reading began, the index of the
-- next row from 1, and for each row, true for the last row of a word.
data Reading = Reading Tick Int [Bool]

-- | Arrival at a tick.
data Arrival
  = -- | the next row of the tape
    Row
  | -- | the request of a job, and how many more requests follow; 'Nothing' for no end
    Due ControlJob (Maybe Int)

-- | Work of a job. A character has a flag for the last row of a word.
data Work = Work ControlJob Bool

-- | Run of the frames of a tape. The third argument is the correction of the feed, a factor; the
-- fourth lists the commands that end a program.
run ::
  Machine ->
  IntegratorControl ->
  Double ->
  [(CommandName, Int)] ->
  LazyList StopReason PreparedFrame ->
  ControllerRun
run machine control correction lastCommands frames =
  proceed
    ( reading
        0
        Control
          { setup = Setup {machine, control, correction, lastCommands},
            dispatcher = foldl' armed unarmed (jobs control),
            buffer = Exhausted TapeEnds,
            stage = Resting 0 False,
            number = 0,
            working = Frame.commandFrame [],
            feed = 0,
            onTape = frames
          }
    )
  where
    unarmed = Dispatcher.start (Controller.capacity control)
    armed d j = case request j of
      Periodic t -> Dispatcher.arrive (ticksOf control t) (Due j Nothing) d
      AtAcceleration t -> Dispatcher.arrive (ticksOf control t) (Due j Nothing) d
      _ -> d

ticksOf :: IntegratorControl -> Seconds -> Tick
ticksOf control = Controller.ticksIn (clock control)

-- | Events from a state on, in which the unit is free.
proceed :: Control -> ControllerRun
proceed s = case stage s of
  Resting t isRequested -> case buffer s of
    Exhausted why -> Stopped t why
    Filled _ _ | not isRequested -> case jobWith AtTransfer s of
      Just j -> proceed (transferring t j s)
      Nothing -> begin s
    _ -> happening s
  Moving p later
    | null (waiting (dispatcher s)) -> coasting s p later
    | otherwise -> happening s

-- | Events from a state on in which no job waits: interpolation cycles up to the next arrival. It
-- gives the same events as 'happening', without a new state for each cycle.
coasting :: Control -> FeedPlan -> [FramePath] -> ControllerRun
coasting s p later = go (interpolator p) (tick d) (cellU c) (cyclesDone p)
  where
    d = dispatcher s
    c = integrator d
    k = cycleTicks p
    v = cellV c
    arrival = case arrivals d of
      (t, _) : _ -> t
      [] -> maxBound
    mostCycles = case [n | ControlJob {request = AtDirection n _} <- jobs (control (setup s))] of
      n : _ | isJust (Interpolator.evaluationArc (interpolator p)) -> n
      _ -> maxBound
    go walk t u done
      | u >= limit c = cycleAt t u
      | arrival <= t = happening (stateAt walk t u done)
      | t + n <= arrival = cycleAt (t + n) (u + n * v)
      | otherwise = happening (stateAt walk t u done)
      where
        n = FeedIntegrator.ticksToOverflow c {cellU = u}
        cycleAt t' u' = case Interpolator.next walk of
          Finished -> pathEnded t' p later (after walk t' u' done)
          Cycle steps rest
            | Interpolator.isFinished rest ->
              Stepped t' steps (pathEnded t' p later (after rest t' u' done))
            | done + 1 >= mostCycles ->
              let s' = after rest t' u' done
               in Stepped t' steps (proceed (counted t' (planAt rest done) later s'))
            | otherwise -> Stepped t' steps (go rest (t' + k) (u' - limit c + k * v) (done + 1))
        -- State after an overflow and its interpolation cycle.
        after rest t' u' = stateAt rest (t' + k) (u' - limit c + k * v)
    planAt walk done = p {interpolator = walk, cyclesDone = done}
    stateAt walk t u done =
      s
        { dispatcher = d {tick = t, integrator = c {cellU = u}},
          stage = Moving (planAt walk done) later
        }

happening :: Control -> ControllerRun
happening s = case Dispatcher.next (cycleOf (stage s)) (dispatcher s) of
  Overflowed t d -> interpolate t s {dispatcher = d}
  Worked t w d ->
    JobDone
      (JobRun (jobOf (work w)) (requested w) t (tick d))
      (worked (work w) s {dispatcher = d})
  Arrived t a d -> proceed (arrived t a s {dispatcher = d})
  -- V is above 0 while a frame is at work, and rows arrive while a frame is read.
  Idle -> Stopped (tick (dispatcher s)) TapeEnds
  where
    jobOf (Work j _) = j
    cycleOf st = case st of
      Resting _ _ -> 0
      Moving p _ -> cycleTicks p

-- Reading -----------------------------------------------------------------------------------------

-- | Begins to read the next frame of the tape into the buffer at tick @t@.
reading :: Tick -> Control -> Control
reading t s = case onTape s of
  LazyList.End why -> s {buffer = Exhausted why}
  LazyList.Next f more ->
    let ends = wordEnds (tapeFrame f)
        flags = replicate (rowsRead (tapeFrame f) - length ends) False <> ends
     in awaitRow s {buffer = Filling f (Reading t 1 flags) 0, onTape = more}

-- | Lets the next row of the frame in the buffer arrive at its tick.
awaitRow :: Control -> Control
awaitRow s = case buffer s of
  Filling _ (Reading since k (_ : _)) _ ->
    let TapeReader {rowsPerSecond, startTime = Seconds t0} = reader (control (setup s))
        ticksPerSecond = fromIntegral (clock (control (setup s)))
        t = since + ceiling ((t0 + fromIntegral k / rowsPerSecond) * ticksPerSecond)
     in s {dispatcher = Dispatcher.arrive t Row (dispatcher s)}
  _ -> s

-- | State after an arrival at tick @t@.
arrived :: Tick -> Arrival -> Control -> Control
arrived t a s = case a of
  Due j count ->
    let s' = requestJob t j False s
        next = t + intervalOf (control (setup s)) j
        again left = s' {dispatcher = Dispatcher.arrive next (Due j left) (dispatcher s')}
     in case count of
          Nothing -> again Nothing
          Just n | n > 1 -> again (Just (n - 1))
          Just _ -> s'
  Row -> case buffer s of
    Filling f (Reading since k (isWordEnd : flags)) pending ->
      let rows = Reading since (k + 1) flags
          s' = withEquidistant t f flags (awaitRow s {buffer = Filling f rows pending})
       in case jobWith AtCharacter s of
            Just j -> requestJob t j isWordEnd (pendingBy 1 s')
            Nothing -> characterRead t isWordEnd s'
    _ -> s

-- | State after the last row of a frame under compensation: a job computes the projections of the
-- offset. @flags@ are those of the rows that have not arrived.
withEquidistant :: Tick -> PreparedFrame -> [Bool] -> Control -> Control
withEquidistant t f flags s = case (flags, jobWith AtCompensation s) of
  ([], Just j) | isCompensated f -> requestJob t j False (pendingBy 1 s)
  _ -> s

intervalOf :: IntegratorControl -> ControlJob -> Tick
intervalOf control j = case request j of
  Periodic t -> ticksOf control t
  AtAcceleration t -> ticksOf control t
  AfterCommand _ t _ -> ticksOf control t
  AtCharacter -> 1
  AtNumber -> 1
  AtTransfer -> 1
  AtCompensation -> 1
  AtDirection _ _ -> 1

-- | State after a character is in the buffer; the flag is true for the last one of a word.
characterRead :: Tick -> Bool -> Control -> Control
characterRead t isWordEnd s = case jobWith AtNumber s of
  Just j | isWordEnd -> requestJob t j False (pendingBy 1 s)
  _ -> filledIfRead t s

-- | State with the frame marked as read if all its rows have arrived and all jobs for them are
-- done.
filledIfRead :: Tick -> Control -> Control
filledIfRead t s = case buffer s of
  Filling f (Reading _ _ []) 0 -> s {buffer = Filled f t}
  _ -> s

-- | Adds to the count of jobs that are still to be done for the frame in the buffer.
pendingBy :: Int -> Control -> Control
pendingBy n s = case buffer s of
  Filling f rows pending -> s {buffer = Filling f rows (pending + n)}
  Filled _ _ -> s
  Exhausted _ -> s

-- Jobs --------------------------------------------------------------------------------------------

-- | First job of the control with the given request.
jobWith :: JobRequest -> Control -> Maybe ControlJob
jobWith r s = Controller.jobFor (== r) (control (setup s))

-- | Requests a job at tick @t@.
requestJob :: Tick -> ControlJob -> Bool -> Control -> Control
requestJob t j flag s =
  s
    { dispatcher =
        Dispatcher.request
          Waiting {urgency = priority j, ticks = duration j, requested = t, work = Work j flag}
          (dispatcher s)
    }

-- | Events after a job, at its last tick.
worked :: Work -> Control -> ControllerRun
worked (Work j flag) s = case request j of
  AtCharacter -> proceed (characterRead t flag (pendingBy (-1) s))
  AtNumber -> proceed (filledIfRead t (pendingBy (-1) s))
  AtTransfer -> begin s
  AtCompensation -> proceed (filledIfRead t (pendingBy (-1) s))
  AtDirection _ ahead -> proceed (onPlan (Feed.turnedTo ahead) s)
  AtAcceleration time -> proceed (accelerate time s)
  Periodic _ -> proceed s
  AfterCommand {} -> proceed s
  where
    t = tick (dispatcher s)

-- | Changes the plan of the frame at work, and sets the cell V for it.
onPlan :: (FeedPlan -> FeedPlan) -> Control -> Control
onPlan change s = case stage s of
  Resting _ _ -> s
  Moving p later ->
    let p' = change p
        v = Feed.cell (control (setup s)) p' (feed s)
     in s
          { stage = Moving p' later,
            dispatcher = Dispatcher.withFeed v (dispatcher s)
          }

-- | Changes the feed by one step of the acceleration in the given time.
accelerate :: Seconds -> Control -> Control
accelerate time s = case stage s of
  Resting _ _ -> s
  Moving p _ ->
    let v = Feed.accelerated (control (setup s)) time p (endFeed s) (feed s)
     in onPlan id s {feed = v}

-- | Feed at the end of the path at work: one that the next path asks at most, and from which it
-- can still stop. 0 if the next frame is not read, or does not move.
endFeed :: Control -> Double
endFeed s = case (stage s, buffer s) of
  (Moving p (path : _), _) -> safe (target p) path
  (_, Filled f _) | path : _ <- paths f -> safe (askedFeed (setup s) f) path
  _ -> 0
  where
    safe v path =
      min v (Feed.stoppable (control (setup s)) (FramePath.pathLength (machine (setup s)) path))

-- | Corrected feed that a frame asks.
askedFeed :: Setup -> PreparedFrame -> Double
askedFeed k f =
  correction k * FramePath.feedValue (FramePath.askedFeed (machine k) (rowFrame f))

-- | Frame as it is on the tape.
rowFrame :: PreparedFrame -> Frame
rowFrame = frameRead . tapeFrame

-- Frames ------------------------------------------------------------------------------------------

-- | Requests the job that transfers the frame in the buffer. @t@ is the end of the frame before.
transferring :: Tick -> ControlJob -> Control -> Control
transferring t j s = requestJob (max t (filledAt s)) j False s {stage = Resting t True}

-- | Tick at which the frame in the buffer was read.
filledAt :: Control -> Tick
filledAt s = case buffer s of
  Filled _ t -> t
  Filling {} -> 0
  Exhausted _ -> 0

-- | Events from the beginning of the frame in the buffer on.
begin :: Control -> ControllerRun
begin s = case (buffer s, stage s) of
  (Filled f since, Resting ended _) ->
    let given = Frame.commands (rowFrame f)
        n = number s + 1
        s' = reading t (afterCommands t given s {number = n, working = rowFrame f})
        waited = max 0 (since - ended)
        started path = FrameBegins (FrameStart t n (rowFrame f) path waited)
        withCommands run' = foldr (uncurry (Commanded t)) run' given
     in case paths f of
          [] -> started Nothing (withCommands (resting' f s'))
          path : later ->
            let motion = moving (askedFeed (setup s) f) path later s'
             in started (Just path) (withCommands motion)
  _ -> proceed s
  where
    t = tick (dispatcher s)
    -- A frame without motion ends at once, and may end the program.
    resting' f s'
      | not (null final) && all (`elem` Frame.commands (rowFrame f)) final = Stopped t ProgramEnds
      | otherwise = FrameEnds t (proceed (resting t s'))
    final = lastCommands (setup s)

-- | Lets the jobs arrive that follow the given commands of tick @t@.
afterCommands :: Tick -> [(CommandName, Int)] -> Control -> Control
afterCommands t given s = s {dispatcher = foldl' armed (dispatcher s) (jobs control')}
  where
    control' = control (setup s)
    armed d j = case request j of
      AfterCommand c time n
        | isJust (lookup c given) ->
          Dispatcher.arrive (t + ticksOf control' time) (Due j (Just n)) d
      _ -> d

-- | Events of the motion on a path that begins now, with the corrected feed @asked@. @later@ are
-- the paths that follow in the same frame.
moving :: Double -> FramePath -> [FramePath] -> Control -> ControllerRun
moving asked path later s
  | asked <= 0 = Stopped t (FeedHeld (number s))
  | reachable > largest =
    Stopped t (TooFast (number s) (beforeOverride asked) (beforeOverride largest))
  | otherwise = proceed (onPlan id s {stage = Moving started later, feed = first})
  where
    t = tick (dispatcher s)
    k = setup s
    beforeOverride v = FramePath.feedOn (machine k) path (v / correction k)
    started = Feed.plan (machine k) (control k) cyclesAhead path reachable
    largest = Feed.largestFeed (control k) path (Feed.plan (machine k) (control k) 0 path asked)
    first = Feed.initial (control k) reachable (feed s)
    -- A rapid move asks no feed of its own: it runs as fast as the control can.
    reachable = if Frame.motion (working s) == Frame.Rapid then min asked largest else asked
    cyclesAhead = sum [ahead | ControlJob {request = AtDirection _ ahead} <- jobs (control k)]

-- | Events from the end of a path on, at tick @t@: the next path of the frame, or the next frame.
pathEnded :: Tick -> FeedPlan -> [FramePath] -> Control -> ControllerRun
pathEnded t p later s = case later of
  [] -> FrameEnds t (proceed (resting t s))
  path : others ->
    FrameEnds
      t
      ( FrameBegins
          (FrameStart t (number s) (working s) (Just path) 0)
          (moving (target p) path others s)
      )

-- | State at the end of a frame, at tick @t@. If the next frame is read, and its transfer ends
-- before the next overflow, the integrator runs on.
resting :: Tick -> Control -> Control
resting t s
  | runsOn = s'
  | otherwise = s' {dispatcher = d {integrator = c {cellU = 0, cellV = 0}}, feed = 0}
  where
    s' = s {stage = Resting t False}
    d = dispatcher s
    c = integrator d
    transferTicks = maybe 0 duration (jobWith AtTransfer s)
    runsOn = case buffer s of
      Filled _ _ -> cellU c + transferTicks * cellV c < limit c
      Filling {} -> False
      Exhausted _ -> False

-- | Events of an interpolation cycle that begins at tick @t@.
interpolate :: Tick -> Control -> ControllerRun
interpolate t s = case stage s of
  Resting _ _ -> proceed s
  Moving p later -> case Interpolator.next (interpolator p) of
    Finished -> pathEnded t p later s
    Cycle steps rest
      | Interpolator.isFinished rest -> Stepped t steps (pathEnded t p later s)
      | otherwise -> Stepped t steps (proceed (counted t p {interpolator = rest} later s))

-- | State after a cycle: on an arc, the job for its direction is requested after its count of
-- cycles.
counted :: Tick -> FeedPlan -> [FramePath] -> Control -> Control
counted t p later s = case Interpolator.evaluationArc (interpolator p) of
  Nothing -> s {stage = Moving p later}
  Just _ -> case [(j, n) | j@ControlJob {request = AtDirection n _} <- jobs (control (setup s))] of
    (j, n) : _
      | cyclesDone p + 1 >= n -> requestJob t j False s {stage = Moving p {cyclesDone = 0} later}
    _ -> s {stage = Moving p {cyclesDone = cyclesDone p + 1} later}
