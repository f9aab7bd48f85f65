{-# OPTIONS_GHC -O2 #-}

-- | Feed integrator: it makes the ticks at which interpolation cycles begin.
--
-- In each tick the cell U grows by the cell V. If U reaches the capacity C, it overflows: it loses
-- C and keeps the rest. So the frequency of overflows is V·f\/C for a clock of f ticks per second,
-- and no rounding adds up. Between two overflows the model jumps: the next overflow is after the
-- least count n of ticks for which U + n·V reaches C.
module Pulse.FeedIntegrator
  ( FeedIntegrator (..),
    start,
    ticksToOverflow,
    overflow,
    pass,
    cellFor,
  )
where

-- | Integrator: its cells U and V and its capacity C. V is at most C.
data FeedIntegrator = FeedIntegrator {cellU :: Int, cellV :: Int, limit :: Int}
  deriving stock (Eq, Show)

-- | Integrator whose cells are 0, with the given capacity.
start :: Int -> FeedIntegrator
start = FeedIntegrator 0 0

-- | Count of ticks up to the next overflow. V must not be 0.
ticksToOverflow :: FeedIntegrator -> Int
ticksToOverflow c = (limit c - cellU c + cellV c - 1) `quot` cellV c

-- | Integrator after the given count of ticks, at the end of which U overflows.
overflow :: Int -> FeedIntegrator -> FeedIntegrator
overflow n c = c {cellU = cellU c + n * cellV c - limit c}

-- | Integrator after the given count of ticks, in which U does not overflow.
pass :: Int -> FeedIntegrator -> FeedIntegrator
pass n c = c {cellU = cellU c + n * cellV c}

-- | Content of the cell V for a frequency of overflows: the nearest whole number, at least 1. The
-- arguments are the capacity, the ticks per second, and the overflows per second.
cellFor :: Int -> Int -> Double -> Int
cellFor capacity ticks frequency =
  max 1 (round (frequency / fromIntegral ticks * fromIntegral capacity))
