{-# LANGUAGE RankNTypes #-}

-- | Timeline of a dispatcher: the overflows, the interpolation cycles and the jobs in a range of
-- ticks.
--
-- The run is read once, up to the first overflow after the range. Only the range is kept, so memory
-- does not grow with the tape.
module Pulse.JobTimeline
  ( JobTimeline (..),
    TickRange (..),
    Tooth (..),
    collect,
  )
where

import Data.Maybe (isNothing)
import Machine.Controller (ControlJob (..), IntegratorControl (..), JobRequest (..))
import Machine.Controller qualified as Controller
import Machine.Machine (Machine)
import Pulse.ControllerRun
  ( ControllerRun (..),
    FrameStart (frameStarted, number, path, startTick, waited),
    JobRun (..),
    Tick,
  )
import Pulse.FramePath (FramePath (..))
import Pulse.RunMeasure qualified as RunMeasure

-- | Range of ticks that is wanted.
data TickRange
  = -- | from the first to the last tick
    Ticks Tick Tick
  | -- | From the start of the first feed move among the frames whose numbers satisfy the predicate:
    -- at least 400 ticks, and two overflows if they come soon. It ends at the latest with the last
    -- of these frames.
    AtFeedMove (Int -> Bool)

-- | Timeline of a range of ticks. All lists are in order, and contain all that touches the range.
data JobTimeline = JobTimeline
  { firstTick :: Tick,
    lastTick :: Tick,
    -- | starts and ends of the interpolation cycles; each begins with an overflow
    cycles :: [(Tick, Tick)],
    jobRuns :: [JobRun],
    -- | starts and numbers of the frames
    frameStarts :: [(Tick, Int)],
    -- | growth of the cell U from 0 to its capacity
    teeth :: [Tooth]
  }

-- | Growth of the cell U: the ticks at which it is 0 and at which it overflows.
data Tooth = Tooth {emptyAt :: Tick, fullAt :: Tick}
  deriving stock (Eq, Show)

-- | State of the collection. The lists of the timeline are in reverse order.
data Collector = Collector
  { wanted :: TickRange,
    -- | first and last tick of the range; Nothing while its start is not known
    range :: Maybe (Tick, Tick),
    found :: JobTimeline,
    -- | last tick at which U was 0; Nothing while the integrator rests
    emptySince :: Maybe Tick,
    -- | ticks between the last two overflows
    interval :: Tick,
    -- | ticks of an interpolation cycle of the frame at work
    cycleTicks :: Tick,
    -- | count of overflows since the start of the range was found
    overflowCount :: Int
  }

-- | Ticks that a range shows before the start of a feed move, and its least and largest length
-- after it.
lead, leastLength, mostLength :: Tick
lead = 30
leastLength = 400
mostLength = 1600

-- | Ticks after the range within which its last overflow is searched.
patience :: Tick
patience = 200000

-- | Timeline of a range; Nothing if the run ends before it.
collect :: Machine -> IntegratorControl -> TickRange -> ControllerRun -> Maybe JobTimeline
collect machine control wanted =
  go
    Collector
      { wanted,
        range = case wanted of
          Ticks a b -> Just (a, b)
          AtFeedMove _ -> Nothing,
        found = JobTimeline 0 0 [] [] [] [],
        emptySince = Nothing,
        interval = maxBound,
        cycleTicks = lineCycle control,
        overflowCount = 0
      }
  where
    go c run = case run of
      FrameBegins s more -> next (startTick s) (frameBegun machine control s c) more
      Stepped t _ more -> next t (overflowed t c) more
      JobDone j more -> next (beganAt j) c {found = withJob j (found c)} more
      FrameEnds _ more -> go c more
      Commanded _ _ _ more -> go c more
      Stopped t _ -> finished t c
    next t c more
      | isComplete t c = finished t c
      | otherwise = let c' = pruned t c in c' `seq` go c' more
    withJob j f = f {jobRuns = j : jobRuns f}

-- | True if nothing that happens after a tick belongs to the range: the tick lies after the range,
-- and U has overflowed since, or rests.
isComplete :: Tick -> Collector -> Bool
isComplete t c = case range c of
  Nothing -> False
  Just (_, b) -> t > b && (t > b + patience || maybe True (> b) (emptySince c))

-- | State without the things that ended before the range, or, while its start is not known, a
-- little before the present tick.
pruned :: Tick -> Collector -> Collector
pruned t c
  | t <= first = counts `seq` c {found = f'}
  | otherwise = c
  where
    first = maybe t fst (range c)
    -- The whole lists are computed, so that they do not keep what they drop.
    counts = length (cycles f') + length (jobRuns f') + length (frameStarts f') + length (teeth f')
    f' = takenWhile takeWhile (first - lead) maxBound (found c)

-- | Timeline without what lies before the first or after the last tick. The first argument selects
-- the elements of a list that satisfy a predicate.
takenWhile :: (forall a. (a -> Bool) -> [a] -> [a]) -> Tick -> Tick -> JobTimeline -> JobTimeline
takenWhile select a b f =
  f
    { cycles = select (uncurry touches) (cycles f),
      jobRuns = select (\j -> touches (min (requestedAt j) (beganAt j)) (endedAt j)) (jobRuns f),
      frameStarts = select (\(t, _) -> touches t t) (frameStarts f),
      teeth = select (\(Tooth from to) -> touches from to) (teeth f)
    }
  where
    touches from to = from <= b && to >= a

-- | Timeline at the end of the collection, at a tick.
finished :: Tick -> Collector -> Maybe JobTimeline
finished t c = case range c of
  Just (a, b)
    | a < t ->
      let f = takenWhile filter a (min b t) (found c)
       in Just
            JobTimeline
              { firstTick = a,
                lastTick = min b t,
                cycles = reverse (cycles f),
                jobRuns = reverse (jobRuns f),
                frameStarts = reverse (frameStarts f),
                teeth = reverse (teeth f)
              }
  _ -> Nothing

-- | State after the start of a frame. If the frame was not read in time, or if the feed is too high
-- for the transfer between two overflows, the integrator has rested since the frame before.
frameBegun :: Machine -> IntegratorControl -> FrameStart -> Collector -> Collector
frameBegun machine control s c =
  c
    { range = rangeAt machine s c,
      found = f {frameStarts = (t, number s) : frameStarts f},
      emptySince = if hasRested then t <$ path s else emptySince c,
      cycleTicks = case path s of
        Just Arc {} -> arcCycle control
        Just (Line _) -> lineCycle control
        Nothing -> lineCycle control
    }
  where
    t = startTick s
    f = found c
    transferTicks = maybe 0 duration (Controller.jobFor (== AtTransfer) control)
    hasRested =
      isNothing (emptySince c) || waited s > 0 || interval c <= cycleTicks c + transferTicks

-- | Range after the start of a frame.
rangeAt :: Machine -> FrameStart -> Collector -> Maybe (Tick, Tick)
rangeAt machine s c = case (wanted c, range c) of
  (Ticks _ _, known) -> known
  (AtFeedMove isShown, Nothing)
    | isShown (number s) && RunMeasure.isAtFeed machine (frameStarted s) ->
      Just (max 0 (t - lead), t + mostLength)
    | otherwise -> Nothing
  (AtFeedMove isShown, Just (a, b))
    | isShown (number s) -> Just (a, b)
    | otherwise -> Just (a, min b t)
  where
    t = startTick s

-- | State after an overflow at a tick.
overflowed :: Tick -> Collector -> Collector
overflowed t c =
  c
    { range = ended <$> range c,
      found =
        f
          { cycles = (t, t + cycleTicks c) : cycles f,
            teeth = [Tooth a t | Just a <- [emptySince c]] <> teeth f
          },
      emptySince = Just t,
      interval = maybe maxBound (t -) (emptySince c),
      overflowCount = maybe 0 (const (overflowCount c + 1)) (range c)
    }
  where
    f = found c
    ended (a, b) = case wanted c of
      AtFeedMove _ | overflowCount c >= 2 -> (a, min b (max (a + leastLength) (t + lead)))
      _ -> (a, b)
