-- | Random frames that the controllers of built-in machines run.
module Generate.RunFrames
  ( runFrames,
    framesOf,
    steppers,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Machine.Machine (FeedCode (..), Machine)
import Machines (kontur3p, lkiU, lkp01f, n55)
import Test.QuickCheck

-- | Machines whose controllers make pulses.
steppers :: [Machine]
steppers = [lkp01f, kontur3p, lkiU, n55]

-- | A machine and one to six frames for it.
runFrames :: Gen (Machine, [Frame])
runFrames = do
  machine <- elements steppers
  count <- choose (1, 6)
  (,) machine <$> vectorOf count (frameOf machine)

-- | The given count of frames for a machine.
framesOf :: Machine -> Int -> Gen [Frame]
framesOf machine count = vectorOf count (frameOf machine)

-- | A straight frame, or on ЛКИ and Н55-2Л also an arc; on Н55-2Л the rotary axes may turn.
frameOf :: Machine -> Gen Frame
frameOf machine = do
  code <- codeFor
  given <- oneof (straight : [round' | hasArcs] <> [turning | machine == n55])
  let f = given {feedCode = FeedCode code}
  if null (Frame.violations machine [f]) then pure f else frameOf machine
  where
    hasArcs = machine == lkiU || machine == n55
    codeFor
      | machine == lkp01f = choose (1, 9)
      | machine == kontur3p = choose (27, 32)
      | machine == lkiU = choose (10, 40)
      | otherwise = choose (60, 300)
    base = Frame.commandFrame []
    coordinate = choose (-900, 900)
    straight = do
      (x, y) <- ((,) <$> coordinate <*> coordinate) `suchThat` (/= (0, 0))
      pure base {motion = Linear, increment = Pulses3 (Pulses x) (Pulses y) 0}
    turning = do
      x <- elements [0, 400]
      a <- choose (1, 900)
      b <- coordinate
      pure
        base
          { motion = Linear,
            increment = Pulses3 (Pulses x) 0 0,
            turn = Pulses2 (Pulses a) (Pulses b)
          }
    round' = do
      r <- choose (100, 500) :: Gen Double
      from <- choose (0, 2 * pi)
      sweep <- choose (0.5, 6)
      sense <- elements [Clockwise, CounterClockwise]
      let at angle = (round (r * cos angle), round (r * sin angle)) :: (Int, Int)
          (i, j) = at from
          (k, l) = at (if sense == Clockwise then from - sweep else from + sweep)
      pure
        base
          { motion = Circular sense,
            increment = Pulses3 (Pulses (k - i)) (Pulses (l - j)) 0,
            centre = Pulses2 (Pulses (-i)) (Pulses (-j))
          }
