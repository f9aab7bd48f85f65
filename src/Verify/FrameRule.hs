{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | What holds for frames whatever the part: the control takes them, and they command what the
-- program does.
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

-- | Frames that the control would refuse: those that break a rule of the frames, and arcs that are
-- none. The radii of an arc may differ by 2 pulses.
refused :: Machine -> Pulses3 -> [Frame] -> [Finding]
refused machine = go 1
  where
    go :: Int -> Pulses3 -> [Frame] -> [Finding]
    go !n !at frames = case frames of
      [] -> []
      f : more -> case inFrame n at f of
        [] -> go (n + 1) (at + Frame.increment f) more
        why -> map Refused why <> go (n + 1) (at + Frame.increment f) more
    inFrame n at f =
      map ByRule (Frame.broken machine n f) <> case Frame.motion f of
        Round _ -> aboutCentre n at f
        Still -> []
        Rapid -> []
        Straightway -> []
    -- What can be wrong with an arc alone.
    aboutCentre n at f =
      [ UnequalRadii n (minus b a)
        | Just (a, b) <-
            [ Control.radii
                machine
                (Motion {number = n, from = at, to = at + Frame.increment f, frame = f})
            ],
          max (minus a b) (minus b a) > plus mostApart Tolerance.coincident
      ]
        <> [ NoSweep n
             | Frame.centre f /= 0,
               not (Control.isRound f) || Frame.increment f /= 0 && Control.endsAbreast f
           ]
    mostApart = times 2 (Machine.pulse machine)

-- | Frames with other commands than the program's own frame in the same place. On a tape with
-- another number of frames commands are compared one after the other, each where the cutter stands
-- then.
wrongCommands :: FrameProgram -> [Frame] -> [Finding]
wrongCommands program frames =
  [ WrongCommand n name (lookup name found) (lookup name wanted)
    | (n, wanted, found) <-
        if length frames == length commanded
          then differing 1 commanded told
          else inOrder (standing (map Frame.frame (Frame.planned program))) (standing frames),
      name <- nub (map fst (wanted <> found)),
      lookup name wanted /= lookup name found
  ]
  where
    commanded = map (Frame.orders . Frame.frame) (Frame.planned program)
    told = map Frame.orders frames
    inOrder own found = case (own, found) of
      ((_, p, a) : as, (n, q, b) : bs) ->
        [(n, if isNear p q then a else [], b) | a /= b || not (isNear p q)] <> inOrder as bs
      -- Nothing is left in which it might stand.
      (_, []) -> [(max k (length frames), a, []) | (k, _, a) <- own]
      ([], _) -> [(n, [], b) | (n, _, b) <- found]
    -- Frames that command something, by their numbers, and where they begin.
    standing fs =
      [ (n, at, Frame.orders f)
        | (n, at, f) <- zip3 [1 ..] (scanl (+) 0 (map Frame.increment fs)) fs,
          not (null (Frame.orders f))
      ]
    isNear p q = let Pulses3 x y z = abs (p - q) in maximum [x, y, z] <= Pulses 2
    differing ::
      Int ->
      [[(CommandName, Int)]] ->
      [[(CommandName, Int)]] ->
      [(Int, [(CommandName, Int)], [(CommandName, Int)])]
    differing n own read' = case (own, read') of
      (a : as, b : bs) | a == b -> differing (n + 1) as bs
      (a : as, b : bs) -> (n, a, b) : differing (n + 1) as bs
      (_, []) -> zipWith (\k a -> (k, a, [])) [n ..] own
      ([], _) -> zipWith (\k b -> (k, [], b)) [n ..] read'
