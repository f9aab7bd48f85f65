-- | @pulses@: the speed of the models of controllers, as a table.
--
-- Each row is a tape of equal frames for one machine. The processor time includes reading the
-- frames from the rows of the tape; making the tape is not measured.
module Main (main) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Control.Exception (evaluate)
import Control.Monad (forM)
import Data.List (sort)
import Data.Text (Text)
import Data.Text.IO qualified as Text
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Machine.BuiltIn qualified as BuiltIn
import Machine.Controller (Controller (..), IntegratorControl (..))
import Machine.Machine (FeedCode (..), Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Pulse.Controller (Console (correction))
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (ControllerRun (..))
import Pulse.Steps qualified as Steps
import System.CPUTime (getCPUTime)
import System.Exit (die)
import System.Mem (performGC)
import Table qualified
import Tape.Punch qualified as Punch
import Tape.Tape (Tape)

-- | Tape whose run is measured: the machine, its description in the table, true without jobs of a
-- dispatcher, true for arcs, and the feed code.
data Subject = Subject
  { machineName :: Text,
    label :: Text,
    isBare :: Bool,
    isRound :: Bool,
    code :: Int
  }

subjects :: [Subject]
subjects =
  [ Subject "lkp-01f" "lines" False False 5,
    Subject "kontur-3p" "lines" False False 27,
    Subject "lki-u" "lines" False False 40,
    Subject "lki-u" "arcs" False True 40,
    Subject "n55" "lines at 600 mm/min, without jobs" True False 600,
    Subject "n55" "lines at 600 mm/min" False False 600,
    Subject "n55" "arcs at 600 mm/min, without jobs" True True 600,
    Subject "n55" "arcs at 600 mm/min" False True 600
  ]

main :: IO ()
main = do
  rows <- forM subjects $ \s -> do
    machine <- machineOf s
    small <- measured machine (tape machine s 300)
    large <- measured machine (tape machine s 3000)
    pure
      [ machineName s,
        label s,
        million (pulses small),
        Table.number (rate small),
        million (pulses large),
        Table.number (rate large),
        Table.number (Table.exponent (pulses small, seconds small) (pulses large, seconds large))
      ]
  Text.putStr (Table.table heading rows)
  where
    heading =
      ["machine", "frames", "millions", "a second", "millions", "a second", "growth"]
    million n = Table.number (fromIntegral n / 1e6)
    rate m = fromIntegral (pulses m) / 1e6 / seconds m

-- | Pulses of a run, and the processor time that they take.
data Measured = Measured {pulses :: Int, seconds :: Double}

machineOf :: Subject -> IO Machine
machineOf s = case BuiltIn.find (MachineName (machineName s)) of
  Nothing -> die "a machine is missing"
  Just m
    | isBare s -> pure m {Machine.controller = bare <$> Machine.controller m}
    | otherwise -> pure m
  where
    bare c = case c of
      Integrating i -> Integrating i {jobs = []}
      Stepping _ -> c
      Planning _ -> c

-- | Tape with the given count of frames: lines forth and back, or full circles.
tape :: Machine -> Subject -> Int -> Tape
tape machine s n = Punch.write machine 0 (map frameAt [1 .. n])
  where
    frameAt k
      | isRound s =
        (Frame.commandFrame [])
          { motion = Circular CounterClockwise,
            centre = Pulses2 300 400,
            feedCode = FeedCode (code s)
          }
      | otherwise =
        let sign = if odd k then 1 else -1
         in (Frame.commandFrame [])
              { motion = Linear,
                increment = Pulses3 (Pulses (sign * 3000)) (Pulses (sign * 1234)) 0,
                feedCode = FeedCode (code s)
              }

-- | Median of three runs. Their feeds differ a little, so that none is shared with another.
measured :: Machine -> Tape -> IO Measured
measured machine t = do
  runs <- forM [1, 1.000001, 1.000002] $ \correction -> do
    performGC
    begin <- getCPUTime
    n <- evaluate (maybe 0 countPulses (Controller.run machine Controller.neutral {correction} 0 t))
    end <- getCPUTime
    pure (fromIntegral (end - begin) / 1e12 :: Double, n)
  pure $ case sort runs of
    [_, (time, n), _] -> Measured n time
    _ -> Measured 0 1

countPulses :: ControllerRun -> Int
countPulses = go 0
  where
    go n run = case run of
      FrameBegins _ more -> go n more
      Stepped _ steps more -> let n' = n + Steps.count steps in n' `seq` go n' more
      FrameEnds _ more -> go n more
      Commanded _ _ _ more -> go n more
      JobDone _ more -> go n more
      Stopped _ _ -> n
