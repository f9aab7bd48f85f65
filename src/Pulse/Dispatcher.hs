-- | Dispatcher of Н55-2Л: one arithmetic unit serves a feed integrator and all other jobs.
--
-- The unit adds the cell V to the cell U in every tick, unless a job occupies it. An overflow of U
-- is served at once: an interpolation cycle of k ticks runs, and k·V is added to U at its start,
-- because the unit cannot add meanwhile. This is called booking. Among the waiting jobs, the one
-- with the lowest priority number is tried first. It starts only if U + k·V stays below the
-- capacity C; k·V is booked then too. Otherwise the next job is tried. If none fits, V is added
-- tick by tick, up to the overflow or the next arrival.
--
-- /Law./ The cycles begin at exactly the ticks at which an integrator that does nothing else
-- overflows, if k·V ≤ C for the interpolation cycle. A job never books an overflow. A cycle begins
-- with U < V, so after k − 1 of its ticks U is below k·V ≤ C: an overflow can fall on the last
-- tick of the booking only, and is served there. If k·V > C, an overflow may fall on an earlier
-- tick, and is served late. V changes only between bookings, and counts for both integrators from
-- the same tick on.
--
-- /Waiting./ 'longestWait' is a bound for the time between request and start of a job.
--
-- Source: N55. It prints k where k·V is meant, which is corrected here. That waiting jobs are
-- tried again at every arrival is reconstructed.
module Pulse.Dispatcher
  ( Dispatcher (..),
    Waiting (..),
    Happening (..),
    start,
    arrive,
    request,
    withFeed,
    next,
    longestWait,
  )
where

import Pulse.FeedIntegrator (FeedIntegrator (..))
import Pulse.FeedIntegrator qualified as FeedIntegrator

-- | State while the unit is free. The type @a@ says what arrives, the type @j@ what a job does.
data Dispatcher a j = Dispatcher
  { tick :: Int,
    integrator :: FeedIntegrator,
    -- | waiting jobs, the most urgent first; of two with one priority, the earlier request first
    waiting :: [Waiting j],
    -- | ticks of later arrivals, the earliest first
    arrivals :: [(Int, a)]
  }

-- | Job that waits: its priority, its length in ticks, the tick of its request, and what it does.
data Waiting j = Waiting {urgency :: Int, ticks :: Int, requested :: Int, work :: j}

-- | Event of the dispatcher, with the state after it.
data Happening a j
  = -- | U overflows at this tick, and an interpolation cycle runs.
    Overflowed Int (Dispatcher a j)
  | -- | A job begins at this tick. The tick of the state is the job's end.
    Worked Int (Waiting j) (Dispatcher a j)
  | -- | Something arrives at this tick. The tick of the state may be later.
    Arrived Int a (Dispatcher a j)
  | -- | V is 0, and nothing waits or arrives.
    Idle

-- | Dispatcher at tick 0 with the given capacity, without jobs.
start :: Int -> Dispatcher a j
start c = Dispatcher {tick = 0, integrator = FeedIntegrator.start c, waiting = [], arrivals = []}

-- | Adds an arrival at the given tick.
arrive :: Int -> a -> Dispatcher a j -> Dispatcher a j
arrive t a d = d {arrivals = insertBy' (\(s, _) -> s <= t) (t, a) (arrivals d)}

-- | Adds a job to the waiting ones.
request :: Waiting j -> Dispatcher a j -> Dispatcher a j
request w d = d {waiting = insertBy' (\v -> urgency v <= urgency w) w (waiting d)}

-- | Inserts an item after all leading items that satisfy the predicate.
insertBy' :: (b -> Bool) -> b -> [b] -> [b]
insertBy' before item items = case items of
  first : more | before first -> first : insertBy' before item more
  _ -> item : items

-- | Sets the cell V.
withFeed :: Int -> Dispatcher a j -> Dispatcher a j
withFeed v d = d {integrator = (integrator d) {cellV = v}}

-- | Next event. The first argument is the length of an interpolation cycle in ticks.
next :: Int -> Dispatcher a j -> Happening a j
next cycleTicks d
  | cellU c >= limit c = overflowed (tick d) 0
  | (t, a) : later <- arrivals d, t <= tick d = Arrived t a d {arrivals = later}
  | Just (w, others) <- fitting (waiting d) =
    Worked
      (tick d)
      w
      d {tick = tick d + ticks w, integrator = FeedIntegrator.pass (ticks w) c, waiting = others}
  | cellV c > 0, n <- FeedIntegrator.ticksToOverflow c, isFirst n = overflowed (tick d + n) n
  | (t, a) : later <- arrivals d =
    Arrived t a d {tick = t, integrator = FeedIntegrator.pass (t - tick d) c, arrivals = later}
  | otherwise = Idle
  where
    c = integrator d
    isFirst n = case arrivals d of
      [] -> True
      (t, _) : _ -> tick d + n <= t
    overflowed t n =
      Overflowed
        t
        d
          { tick = t + cycleTicks,
            integrator = FeedIntegrator.pass cycleTicks (FeedIntegrator.overflow n c)
          }
    fitting ws = case ws of
      [] -> Nothing
      w : more
        | cellU c + ticks w * cellV c < limit c -> Just (w, more)
        | otherwise -> (\(chosen, others) -> (chosen, w : others)) <$> fitting more

-- | Bound for the ticks between the request of a job and its start. The arguments are the length
-- of an interpolation cycle, the capacity, the feed V, the ticks of the job, the longest job of
-- any kind, and the lengths and least intervals of the jobs that are tried before this one.
-- 'Nothing' if the job does not fit between two overflows, or if the jobs take all the time.
--
-- In a time w there are at most w·V\/C + 2 overflows. Each takes the length of a cycle, and the
-- ticks before it are lost in which the job does not fit, fewer than its length. A job of each
-- other kind runs at most w\/interval + 1 times. A later job may just have started. The bound is
-- the least w that covers all this.
longestWait :: Int -> Int -> Int -> Int -> Int -> [(Int, Int)] -> Maybe Int
longestWait cycleTicks c v own longest before
  | (cycleTicks + own + 1) * v > c = Nothing
  | otherwise = go longest
  where
    go w
      | w > 100000000 = Nothing
      | demand w <= w = Just w
      | otherwise = go (demand w)
    demand w =
      longest
        + ((w * v) `quot` c + 2) * (cycleTicks + own)
        + sum [(w `quot` interval + 1) * k | (k, interval) <- before]
