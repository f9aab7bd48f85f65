-- | What holds for frames whatever the part: the control takes them, and they command what the program does.
module Verify.Rules
  ( refused,
    wrongCommands,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Control.Walk (Stroke (..))
import Control.Walk qualified as Control
import Data.List (nub)
import Frame.Frame (Frame, Motion (..), Program)
import Frame.Frame qualified as Frame
import Geometry.Tolerance qualified as Tolerance
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Verify.Proof (Finding (..), Refusal (..))

-- | Frames that the control would refuse: those that break a rule of the frames, and arcs that are none. The radii of
-- an arc may differ by 2 pulses.
refused :: Machine -> [Stroke] -> [Frame] -> [Finding]
refused machine strokes frames =
  [Refused (ByRule broken) | broken <- Frame.invariants machine frames]
    <> [Refused (UnequalRadii (number s) (minus b a)) | s <- strokes, Just (a, b) <- [Control.radii machine s], max (minus a b) (minus b a) > plus mostApart Tolerance.coincident]
    <> [Refused (NoSweep n) | (n, f) <- zip [1 ..] frames, Frame.centre f /= 0, not (Control.isRound f) || Frame.increment f /= 0 && Control.endsAbreast f, Round _ <- [Frame.motion f]]
  where
    mostApart = times 2 (Machine.pulse machine)

-- | Frames with other commands than the program's own frame in the same place.
wrongCommands :: Program -> [Frame] -> [Finding]
wrongCommands program frames =
  [ WrongCommand n name (lookup name found) (lookup name wanted)
    | (n, (wanted, found)) <- zip [1 ..] (together (map (Frame.orders . Frame.frame) (Frame.planned program)) (map Frame.orders frames)),
      name <- nub (map fst (wanted <> found)),
      lookup name wanted /= lookup name found
  ]
  where
    together own read' = take (max (length own) (length read')) (zip (own <> repeat []) (read' <> repeat []))
