-- | Laws of the timeline of a dispatcher.
module Pulse.JobTimelineSpec
  ( spec,
  )
where

import Data.List (sortOn)
import Frame.Frame (Frame)
import Generate.RunFrames qualified as Generate
import Machine.Controller (Controller (..), IntegratorControl)
import Machine.Machine qualified as Machine
import Machines (n55)
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (ControllerRun (..), JobRun (..))
import Pulse.ControllerRun qualified as ControllerRun
import Pulse.JobTimeline (JobTimeline (..), TickRange (..), Tooth (..))
import Pulse.JobTimeline qualified as JobTimeline
import Tape.Punch qualified as Punch
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "the timeline of a dispatcher" $ do
  it "has all jobs and overflows of its range (catches jobs that are dropped too early)" $
    forAll cases $ \(fs, a, b) ->
      let run = runOf fs
          touches from to = from <= b && to >= a
          jobs' = [j | JobEvent j <- eventsOf run, touches (requestedAt j) (endedAt j)]
          overflows = [t | Overflow t <- eventsOf run, t >= a, t <= b]
          key j = (beganAt j, endedAt j, requestedAt j)
       in case JobTimeline.collect n55 control (Ticks a b) run of
            Nothing -> counterexample "no timeline" (a >= endOf run)
            Just found ->
              map key (filter ((<= b) . beganAt) (jobRuns found))
                === map key (filter ((<= b) . beganAt) jobs')
                .&&. [t | (t, _) <- cycles found, t >= a, t <= b]
                === overflows
  it "has one thing at a time, since there is one arithmetic unit (catches a cycle too long)" $
    forAll cases $ \(fs, a, b) ->
      case JobTimeline.collect n55 control (Ticks a b) (runOf fs) of
        Nothing -> property True
        Just found ->
          let spans = sortOn fst (cycles found <> [(beganAt j, endedAt j) | j <- jobRuns found])
              isApart (_, e) (s, _) = e <= s
           in counterexample (show spans) (and (zipWith isApart spans (drop 1 spans)))
  it "has teeth that end with an overflow, and do not overlap" $
    forAll cases $ \(fs, a, b) ->
      case JobTimeline.collect n55 control (Ticks a b) (runOf fs) of
        Nothing -> property True
        Just found ->
          let ts = teeth found
           in counterexample (show ts) $
                and (zipWith (\t u -> fullAt t <= emptyAt u) ts (drop 1 ts))
                  && all (\t -> fullAt t > b || fullAt t `elem` map fst (cycles found)) ts
  it "begins at a feed move by itself, and is short" $
    forAll (Generate.framesOf n55 5) $ \fs ->
      case JobTimeline.collect n55 control (AtFeedMove (>= 2)) (runOf fs) of
        Nothing -> counterexample "no timeline" False
        Just found ->
          (2 `elem` map snd (frameStarts found)) === True
            .&&. counterexample
              (show (firstTick found, lastTick found))
              (lastTick found - firstTick found <= 1700)

-- | Events that the timeline shows.
data Event = JobEvent JobRun | Overflow Int

eventsOf :: ControllerRun -> [Event]
eventsOf = reverse . ControllerRun.fold add []
  where
    add found run = case run of
      JobDone j _ -> JobEvent j : found
      Stepped t _ _ -> Overflow t : found
      _ -> found

endOf :: ControllerRun -> Int
endOf = ControllerRun.fold (\t run -> case run of Stopped t' _ -> t'; _ -> t) 0

-- | Frames, and a range of ticks.
cases :: Gen ([Frame], Int, Int)
cases = do
  fs <- Generate.framesOf n55 3
  a <- choose (0, max 1 (endOf (runOf fs)))
  l <- choose (1, 5000)
  pure (fs, a, a + l)

runOf :: [Frame] -> ControllerRun
runOf fs = case Controller.run n55 Controller.neutral 0 (Punch.write n55 0 fs) of
  Just run -> run
  Nothing -> error "n55 has no controller"

control :: IntegratorControl
control = case Machine.controller n55 of
  Just (Integrating c) -> c
  _ -> error "n55 has no feed integrator"
