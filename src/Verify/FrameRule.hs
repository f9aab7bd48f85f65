{-# LANGUAGE BangPatterns #-}

-- | Rules that the frames of a tape have to keep whatever the part is: the control accepts them,
-- and their commands are those of the program.
module Verify.FrameRule
  ( refused,
    wrongCommands,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), minus, plus, times)
import Control.Motion (Motion (..))
import Control.Motion qualified as Control
import Data.List (nub)
import Frame.Frame (Frame, FrameMotion (..), FrameProgram)
import Frame.Frame qualified as Frame
import Geometry.Tolerance qualified as Tolerance
import Machine.Machine (CommandName, Machine)
import Machine.Machine qualified as Machine
import Verify.Proof (Finding (..), Refusal (..))

-- Frames that a control refuses -------------------------------------------------------------------

-- | Findings for frames that break a rule of the machine or are impossible arcs, from a start
-- position.
refused :: Machine -> Pulses3 -> [Frame] -> [Finding]
refused machine = go 1
  where
    go :: Int -> Pulses3 -> [Frame] -> [Finding]
    go !n !at frames = case frames of
      [] -> []
      f : more -> case refusals machine n at f of
        [] -> go (n + 1) (at + Frame.increment f) more
        reasons -> map Refused reasons <> go (n + 1) (at + Frame.increment f) more

-- | Reasons to refuse one frame, by its number and its start position.
refusals :: Machine -> Int -> Pulses3 -> Frame -> [Refusal]
refusals machine n at f =
  map ByRule (Frame.frameViolations machine n f) <> case Frame.motion f of
    Circular _ -> impossibleArc machine n at f
    NoMotion -> []
    Rapid -> []
    Linear -> []

-- | Faults of an arc. Its radii may differ by two pulses.
impossibleArc :: Machine -> Int -> Pulses3 -> Frame -> [Refusal]
impossibleArc machine n at f =
  [ UnequalRadii n (minus b a)
    | Just (a, b) <- [Control.radii machine motion],
      max (minus a b) (minus b a) > plus largestDifference Tolerance.coincident
  ]
    <> [ NoSweep n
         | Frame.centre f /= 0,
           not (Control.isRound f) || Frame.increment f /= 0 && Control.endsInStartDirection f
       ]
  where
    motion = Motion {number = n, from = at, to = at + Frame.increment f, frame = f}
    largestDifference = times 2 (Machine.planeResolution machine)

-- Commands ----------------------------------------------------------------------------------------

-- | Commands of a frame by their names and numbers.
type Commands = [(CommandName, Int)]

-- | Findings for frames whose commands differ from those of the program's own frame. If the numbers
-- of frames differ, frames with commands are compared in order; the positions of the cutter have to
-- agree to two pulses.
wrongCommands :: FrameProgram -> [Frame] -> [Finding]
wrongCommands program frames =
  [ WrongCommand n name (lookup name found) (lookup name wanted)
    | (n, wanted, found) <- differences,
      name <- nub (map fst (wanted <> found)),
      lookup name wanted /= lookup name found
  ]
  where
    ownFrames = map Frame.frame (Frame.plannedFrames program)
    commanded = map Frame.commands ownFrames
    differences
      | length frames == length commanded = frameByFrame 1 commanded (map Frame.commands frames)
      | otherwise = inOrder (length frames) (positioned ownFrames) (positioned frames)

-- | Frames with different commands: the number, the program's commands, the tape's.
frameByFrame :: Int -> [Commands] -> [Commands] -> [(Int, Commands, Commands)]
frameByFrame n own found = case (own, found) of
  (a : as, b : bs) | a == b -> frameByFrame (n + 1) as bs
  (a : as, b : bs) -> (n, a, b) : frameByFrame (n + 1) as bs
  (_, []) -> zipWith (\k a -> (k, a, [])) [n ..] own
  ([], _) -> zipWith (\k b -> (k, [], b)) [n ..] found

-- | Frames with commands: the number, the position where the frame starts, the commands.
positioned :: [Frame] -> [(Int, Pulses3, Commands)]
positioned fs =
  [ (n, at, Frame.commands f)
    | (n, at, f) <- zip3 [1 ..] (scanl (+) 0 (map Frame.increment fs)) fs,
      not (null (Frame.commands f))
  ]

-- | Differences between frames with commands, taken in pairs. Commands that are missing at the end
-- of the tape are reported at its last frame or later.
inOrder ::
  Int ->
  [(Int, Pulses3, Commands)] ->
  [(Int, Pulses3, Commands)] ->
  [(Int, Commands, Commands)]
inOrder frameCount = go
  where
    go own found = case (own, found) of
      ((_, p, a) : as, (n, q, b) : bs) ->
        [(n, if isNear p q then a else [], b) | a /= b || not (isNear p q)] <> go as bs
      (_, []) -> [(max k frameCount, a, []) | (k, _, a) <- own]
      ([], _) -> [(n, [], b) | (n, _, b) <- found]

-- | Test that two positions differ by no more than two pulses on any axis.
isNear :: Pulses3 -> Pulses3 -> Bool
isNear p q = maximum [x, y, z] <= Pulses 2
  where
    Pulses3 x y z = abs (p - q)
