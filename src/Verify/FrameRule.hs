-- | Rules for the frames of a tape that do not depend on the shape of the part: the control accepts
-- every frame, and the commands are those of the program.
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

-- | Findings for frames that the control refuses, on a tape that begins at a start position: frames
-- that break a rule of the machine, and impossible arcs.
refused :: Machine -> Pulses3 -> [Frame] -> [Finding]
refused machine begin = go (Start 1 begin)
  where
    go :: Start -> [Frame] -> [Finding]
    go start@(Start n at) frames = case frames of
      [] -> []
      f : more -> case refusals machine n at f of
        [] -> go (startAfter f start) more
        reasons -> map Refused reasons <> go (startAfter f start) more

-- | Number of a frame, counted from 1, and the position at which it starts.
data Start = Start Int Pulses3

-- | Number and start position of the frame after another one.
startAfter :: Frame -> Start -> Start
startAfter f (Start n at) = Start (n + 1) (at + Frame.increment f)

-- | Reasons to refuse one frame, by its number and its start position.
refusals :: Machine -> Int -> Pulses3 -> Frame -> [Refusal]
refusals machine n at f =
  map ByRule (Frame.frameViolations machine n f) <> case Frame.motion f of
    Circular _ -> impossibleArc machine n at f
    NoMotion -> []
    Rapid -> []
    Linear -> []

-- | Reasons to refuse an arc: its two radii differ by more than two pulses, or it has no sweep.
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

-- | Commands of a frame: their names and numbers.
type Commands = [(CommandName, Int)]

-- | Findings for frames whose commands differ from those of the planned frames. A tape with as many
-- frames as planned is compared frame by frame. On any other tape, the frames with commands are
-- compared in order; two of them correspond if they begin at the same position, to two pulses.
wrongCommands :: FrameProgram -> [Frame] -> [Finding]
wrongCommands program frames =
  [ WrongCommand n name (lookup name found) (lookup name wanted)
    | (n, wanted, found) <- differences,
      name <- nub (map fst (wanted <> found)),
      lookup name wanted /= lookup name found
  ]
  where
    planned = map Frame.frame (Frame.plannedFrames program)
    commanded = map Frame.commands planned
    differences
      | length frames == length commanded = frameByFrame 1 commanded (map Frame.commands frames)
      | otherwise = inOrder (length frames) (positioned planned) (positioned frames)

-- | Frames with different commands, numbered from @n@: the number, the planned commands, those of
-- the tape. A frame that is missing on one side counts as one without commands.
frameByFrame :: Int -> [Commands] -> [Commands] -> [(Int, Commands, Commands)]
frameByFrame n own found = case (own, found) of
  (a : as, b : bs) | a == b -> frameByFrame (n + 1) as bs
  (a : as, b : bs) -> (n, a, b) : frameByFrame (n + 1) as bs
  (_, []) -> zipWith (\k a -> (k, a, [])) [n ..] own
  ([], _) -> zipWith (\k b -> (k, [], b)) [n ..] found

-- | Frames with commands: the number, the position where the frame begins, the commands. Positions
-- are measured from the start of the tape.
positioned :: [Frame] -> [(Int, Pulses3, Commands)]
positioned fs =
  [ (n, at, Frame.commands f)
    | (n, at, f) <- zip3 [1 ..] (scanl (+) 0 (map Frame.increment fs)) fs,
      not (null (Frame.commands f))
  ]

-- | Differences between the planned frames with commands and those on the tape, taken in pairs. If
-- two positions differ, the planned commands of the pair count as none. Planned commands that are
-- missing at the end of the tape get their planned number, but at least the number of the last
-- frame on the tape.
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
