-- | Answer to the request @pulses@: the pulses, the samples and the jobs of a run. The README of
-- this folder describes it.
module Preview.PulseColumns
  ( container,
    nothing,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Data.Aeson ((.=))
import Data.ByteString.Lazy (ByteString)
import Data.List qualified as List
import Data.Maybe (fromMaybe)
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Vector
import Machine.Controller (ControlJob)
import Preview.Container (Numbers (..))
import Preview.Container qualified as Container
import Preview.Playback qualified as Playback
import Preview.TapeRun (TapeRun (..))
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (ControllerRun (..), JobRun (..), StopReason (TapeEnds), Tick)
import Pulse.RunSample (RunSample (..), SampleKind (..))
import Pulse.RunSample qualified as RunSample
import Pulse.Steps qualified as Steps

-- | Bytes of the answer for the version of a text and a tape that is given twice: a run that is
-- read twice would stay in memory. Without pulses for the page, the arrays are empty.
container :: Int -> TapeRun -> TapeRun -> ByteString
container version once again = case (Playback.isPulsed once, runOf once, runOf again) of
  (True, Just run, Just another) ->
    encoded version (Playback.dispatcherJobs machine) run (samplesOf another)
  _ -> nothing version
  where
    TapeRun {machine} = once
    runOf TapeRun {machine = m, console, start, rows} = Controller.run m console start rows
    samplesOf = RunSample.samples machine clock (const True)
    clock = fromMaybe 1 (Controller.ticksPerSecond machine)

-- | Bytes of an answer without pulses.
nothing :: Int -> ByteString
nothing version = encoded version [] (Stopped 0 TapeEnds) (LazyList.End ())

encoded :: Int -> [ControlJob] -> ControllerRun -> LazyList e RunSample -> ByteString
encoded version jobs run samples =
  Container.encode
    ["version" .= version]
    [ ("pulseTick", Reals (map (fromIntegral . snd) (Vector.toList groups))),
      ("pulseSteps", Wholes (map fst (Vector.toList groups))),
      ("framePulse", Wholes (Vector.toList firstGroups)),
      ("sample", Reals (concatMap sampleNumbers (LazyList.toList samples))),
      ("job", Reals (jobNumbers (Vector.toList (Vector.filter ((<= firstJob) . fst) events))))
    ]
  where
    events = eventsOf jobs run
    groups = Vector.filter ((>= 0) . fst) events
    firstGroups =
      Vector.snoc
        (Vector.map snd (Vector.filter ((== frameBegin) . fst) (numbered events)))
        (Vector.length groups)

-- | Events of a run as pairs of a code and a tick. The code of a group of pulses is its bits, which
-- are not negative. A job is three events with the same code: its request, its begin and its end.
eventsOf :: [ControlJob] -> ControllerRun -> Vector (Int, Tick)
eventsOf jobs run = Vector.unfoldr next ([], run)
  where
    next (pending, more) = case pending of
      e : others -> Just (e, (others, more))
      [] -> event more
    event list = case list of
      FrameBegins _ more -> Just ((frameBegin, 0), ([], more))
      Stepped t steps more -> Just ((Steps.bitPattern steps, t), ([], more))
      JobDone j more ->
        let code = firstJob - fromMaybe 0 (List.elemIndex (job j) jobs)
         in Just ((code, requestedAt j), ([(code, beganAt j), (code, endedAt j)], more))
      FrameEnds _ more -> event more
      Commanded _ _ _ more -> event more
      Stopped _ _ -> Nothing

-- | Codes of the begin of a frame, and of the first job; the codes of further jobs are lower.
frameBegin, firstJob :: Int
frameBegin = -1
firstJob = -2

-- | Events in which the tick of the begin of a frame is replaced by the count of groups before it.
numbered :: Vector (Int, Tick) -> Vector (Int, Int)
numbered events = Vector.zipWith place events (Vector.prescanl' count 0 events)
  where
    count n (code, _) = if code >= 0 then n + 1 else n :: Int
    place (code, t) n = (code, if code == frameBegin then n else t)

-- | Four numbers for each job, from its three events.
jobNumbers :: [(Int, Tick)] -> [Double]
jobNumbers events = case events of
  (code, requested) : (_, began) : (_, ended) : more ->
    map fromIntegral [firstJob - code, requested, began, ended] <> jobNumbers more
  _ -> []

-- | Kind, first and last tick, and value of a sample; nothing for other kinds.
sampleNumbers :: RunSample -> [Double]
sampleNumbers RunSample {kind, from, to, value} = case kind of
  FeedMeasured -> numbers 0
  TurningMeasured -> numbers 0
  AxisFrequency k -> numbers (1 + k)
  FrameNumber -> []
  ReaderWait -> []
  FeedAsked -> []
  where
    numbers :: Int -> [Double]
    numbers k = [fromIntegral k, fromIntegral from, fromIntegral to, value]
