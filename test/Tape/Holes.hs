-- | Tapes with one hole added or removed, and the share of them that the reader refuses.
module Tape.Holes (Share (..), share, changes) where

import Base.PulseVector (Pulses3)
import Data.Bits (complementBit)
import Data.ByteString qualified as ByteString
import Frame.Frame (Frame)
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))

-- | Result for all tapes with one hole added or removed: the count of these tapes; the count of
-- those that the reader refuses; the changed holes that it reads as other frames, each by row and
-- track, both from 1. All other tapes are read as the right frames.
data Share = Share {tried :: Int, found :: Int, unseen :: [(Int, Int)]}
  deriving stock (Eq, Show)

-- | Tries all tapes that differ in one hole from the tape of some frames. The cutter begins at the
-- given position.
share :: Machine -> Pulses3 -> [Frame] -> Share
share machine start frames =
  Share
    { tried = length results,
      found = length [() | (_, Left _) <- results],
      unseen = [position | (position, Right fs) <- results, fs /= frames]
    }
  where
    results =
      [ (position, Punch.read machine start t)
        | (position, t) <- changes machine (Punch.write machine start frames)
      ]

-- | All tapes that differ from a tape in one hole, each with the row and the track of the hole,
-- both from 1.
changes :: Machine -> Tape -> [((Int, Int), Tape)]
changes machine (Tape rows) =
  [ ((k + 1, track), Tape (before <> ByteString.cons (complementBit w (track - 1)) after))
    | k <- [0 .. ByteString.length rows - 1],
      let (before, rest) = ByteString.splitAt k rows,
      Just (w, after) <- [ByteString.uncons rest],
      track <- [1 .. Machine.tracks (Machine.medium machine)]
  ]
