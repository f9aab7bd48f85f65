-- | Dwells that are computed without pulses, compared with those of the whole run.
module Pulse.ReaderDwellSpec (spec) where

import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), Seconds (..))
import Control.Monad (forM_)
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Machine.Controller (Controller (..), SpeedRamp (..), StepControl (..), TapeReader (..))
import Machine.Machine (CommandName (..), Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Machines (kontur2p, kontur3p, lkiU, lkp01f, n55)
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (ControllerRun (..), FrameStart (startTick), StopReason (..))
import Pulse.FrameCompensation (PreparedFrame, prepared)
import Pulse.ReaderDwell qualified as ReaderDwell
import Pulse.RunMeasure (FrameMeasure (..), RunTotal (..))
import Tape.Punch qualified as Punch
import Tape.Tape (Tape)
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  forM_ [kontur2p, kontur3p] $ \machine ->
    it
      ( "finds exactly the dwells of the run on "
          <> nameOf machine
          <> " (catches a frame whose reading begins too early)"
      )
      $ law machine (\found real -> found === real)
  forM_ [n55, withReader Nothing lkiU, withReader slope lkiU] $ \machine ->
    it
      ( "finds only dwells of the run on "
          <> nameOf machine
          <> " with its ramps (catches a frame whose ramp is left out)"
      )
      $ law machine $ \found real ->
        counterexample (show (found, real)) (all (`elem` real) found)
  it "a frame in a ramp ends with its last pulse (catches an end that waits for one more cycle)" $
    forAll (shortFrames lkiU) $ \fs ->
      fmap lateEnds (Controller.run lkiU Controller.neutral 0 (tapeOf lkiU fs)) === Just []
  it "finds the dwell after a frame of one pulse on n55" $
    let fs = [line n55 2000 0, line n55 1 0, quarter n55 2000]
     in ReaderDwell.dwells n55 (inTurn n55 (tapeOf n55 fs)) `shouldBe` [3]
  it "counts the arc round a corner under compensation (catches a path that is left out)" $
    let on = Frame.commandFrame [(CommandName "left", 0), (CommandName "switch", 1)]
        bend = (line n55 5000 (-5000)) {motion = Circular CounterClockwise, centre = Pulses2 5000 0}
        dwellsOf fs = ReaderDwell.dwells n55 (inTurn n55 (tapeOf n55 fs))
        edge = [line n55 3000 0, line n55 0 (-1), bend]
     in (dwellsOf edge, dwellsOf (on : edge)) `shouldBe` ([3], [])
  it "finds none on a controller that does not read the tape while it runs" $
    ReaderDwell.dwells lkp01f (inTurn lkp01f (tapeOf lkp01f (replicate 4 (line lkp01f 1 0))))
      `shouldBe` []
  where
    slope = Just (SpeedRamp 5 (Seconds 0.001))
    law machine holds =
      forAll (shortFrames machine) $ \fs ->
        let tape = tapeOf machine fs
            (measures, end) = allOf (Controller.measured machine Controller.neutral 0 tape)
            real = [number m | m <- measures, isInCut m, waitedFor m > 0]
            found = ReaderDwell.dwells machine (inTurn machine tape)
         in fmap (isWhole . stopReason) end === Just True
              .&&. cover 2 (not (null found)) "dwells" (property (holds found real))
    allOf list = case list of
      Nothing -> ([], Nothing)
      Just l -> (LazyList.toList l, Just (LazyList.end l))
    isWhole why = why == TapeEnds || why == ProgramEnds

-- | Ticks of the ends of frames that are later than the last pulse of their frame.
lateEnds :: ControllerRun -> [Int]
lateEnds = go 0
  where
    go pulse run = case run of
      FrameBegins f more -> go (startTick f) more
      Stepped t _ more -> go t more
      FrameEnds t more -> [t | t > pulse] <> go t more
      Commanded _ _ _ more -> go pulse more
      JobDone _ more -> go pulse more
      Stopped _ _ -> []

nameOf :: Machine -> String
nameOf machine = let MachineName n = Machine.name machine in show n

-- | Machine whose step controller reads the tape while it runs, with another ramp.
withReader :: Maybe SpeedRamp -> Machine -> Machine
withReader slope machine = case Machine.controller machine of
  Just (Stepping c) ->
    machine
      { Machine.controller =
          Just (Stepping c {ramp = slope, stepReader = Just slowReader})
      }
  _ -> machine
  where
    slowReader = TapeReader 300 (Seconds 0.01) 1 Nothing

tapeOf :: Machine -> [Frame] -> Tape
tapeOf machine = Punch.write machine 0

inTurn :: Machine -> Tape -> LazyList.LazyList StopReason PreparedFrame
inTurn machine tape = prepared machine [(1, Mm 20)] 0 (Punch.readInTurn machine 0 tape)

line :: Machine -> Int -> Int -> Frame
line machine x y =
  (Frame.commandFrame [])
    { motion = Linear,
      increment = Pulses3 (Pulses x) (Pulses y) 0,
      feedCode = head (feedsOf machine)
    }

-- | Feed codes between 30 and 300 mm/min or pulses per second.
feedsOf :: Machine -> [Machine.FeedCode]
feedsOf machine =
  [ code
    | code <- map Machine.FeedCode [0 .. 100],
      Just v <- [Machine.valueOf machine code],
      v >= 30,
      v <= 300
  ]

-- | Frames of a few pulses, some longer ones, and arcs if the machine has them.
shortFrames :: Machine -> Gen [Frame]
shortFrames machine =
  filter (null . Frame.violations machine . pure) <$> (choose (1, 12) >>= (`vectorOf` aFrame))
  where
    aFrame = do
      code <- elements (feedsOf machine)
      f <- frequency [(5, straight), (2, arc), (1, pure (Frame.commandFrame []))]
      pure (if motion f == NoMotion then f else f {feedCode = code})
    straight = line machine <$> size <*> size
    size = do
      most <- elements [1, 5, 20, 100, 600]
      choose (-most, most)
    arc = do
      r <- elements [1, 2, 5, 20, 100] >>= \most -> choose (1, most)
      pure (quarter machine r)

-- | A quarter of a circle.
quarter :: Machine -> Int -> Frame
quarter machine r =
  (line machine r r) {motion = Circular CounterClockwise, centre = Pulses2 0 (Pulses r)}
