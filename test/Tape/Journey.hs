-- | Example frames for every machine: lines, and arcs, rapid moves and commands if the machine has
-- them.
module Tape.Journey (machines, start, journey) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Data.List (sortOn)
import Data.Map.Strict qualified as Map
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Machine.Machine
  ( Arcs (..),
    Axis (..),
    Content (..),
    FeedCode (..),
    FeedCodes (..),
    Machine,
    Service (..),
  )
import Machine.Machine qualified as Machine
import Machines qualified

-- | Machines on which the tapes are tested.
machines :: [Machine]
machines = Machines.known

-- | Position of the cutter before the journey.
start :: Pulses3
start = Pulses3 500 (-200) 100

-- | Frames that keep the rules of a machine. The increments are the same for all machines; frames
-- that a machine does not allow are left out.
journey :: Machine -> [Frame]
journey machine =
  filter
    (null . Frame.violations machine . pure)
    ( concat
        [ commands,
          concat (zipWith3 framesAlong feeds slowFlags increments),
          [Frame.commandFrame o | o <- take 1 commandFrames]
        ]
    )
  where
    increments =
      [ (1200, -340),
        (2075, 0),
        (0, 3100),
        (-17, 1),
        (-2058, 440),
        (-1200, -3201),
        (100, 100),
        (-6, -90),
        (1, 0),
        (905, -777)
      ]
    feeds = cycle (twice (feedCodes machine))
    twice cs = concat [[c, c] | c <- cs]
    slowFlags = cycle [False, False, True]
    commandFrames = [[(o, v)] | o <- commandNames, v <- [1, 3], Machine.canEncode machine o v]
    commandNames =
      [ o
        | w <- Machine.wordsOf machine,
          o <-
            [o | Command o <- [Machine.content w]]
              <> take 1 [o | CommandBit o _ <- Machine.service (Machine.form w)]
      ]
    commands = map Frame.commandFrame commandFrames
    framesAlong code slow (x, y) =
      [rapid x y | Machine.hasRapidMotion machine, x > 1000]
        <> [ Frame
               { motion = Linear,
                 increment = Pulses3 (Pulses x) (Pulses y) (if hasZ && x > 0 then 5 else 0),
                 turn = 0,
                 centre = 0,
                 feedCode = code,
                 braking = slow && hasBrakingHole,
                 commands = if y == 0 then concat (take 1 commandFrames) else []
               }
           ]
        <> [ (Frame.commandFrame [])
               { motion = Linear,
                 increment = Pulses3 (Pulses x) 0 0 * Pulses3 moved 0 0,
                 turn,
                 feedCode = code
               }
             | turn <- [Pulses2 (Pulses (-x)) (Pulses y), Pulses2 0 (Pulses x)],
               moved <- [0, 1]
           ]
        <> [ Frame
               { motion = Circular sense,
                 increment = Pulses3 (Pulses x) (Pulses y) 0,
                 turn = 0,
                 centre = c,
                 feedCode = code,
                 braking = slow && hasBrakingHole,
                 commands = []
               }
             | Machine.arcs machine /= NoArcs,
               (sense, c) <- arcs x y
           ]
    rapid x y =
      Frame
        { motion = Rapid,
          increment = Pulses3 (Pulses x) (Pulses y) 0,
          turn = 0,
          centre = 0,
          feedCode = FeedCode 0,
          braking = False,
          commands = []
        }
    arcs x y =
      [(sense, Pulses2 (Pulses x) 0) | abs x == abs y, sense <- [Clockwise, CounterClockwise]]
        <> [(Clockwise, Pulses2 (Pulses x) 0) | x > 0, y > 0]
        <> [(CounterClockwise, Pulses2 0 (Pulses y)) | x < 0, y < 0]
    hasBrakingHole =
      or [s == BrakingHole | w <- Machine.wordsOf machine, s <- Machine.service (Machine.form w)]
    hasZ = Machine.capacity machine Z > 0

-- | Some feed codes of a machine, from the lowest feed to the highest.
feedCodes :: Machine -> [FeedCode]
feedCodes machine = case Machine.codes (Machine.feeds machine) of
  Direct a b -> [FeedCode (max a (min b n)) | n <- [60, 240, 900]]
  Listed table -> every 4 (map fst (sortOn snd (Map.toList table)))
  where
    every n cs = case cs of
      [] -> []
      c : rest -> c : every n (drop (n - 1 :: Int) rest)
