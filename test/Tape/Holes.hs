-- | Tapes with one hole more or less, and how many of them a machine's tape gives away.
module Tape.Holes (Share (..), share, changes) where

import Base.PulseVector (Pulses3)
import Data.Bits (complementBit)
import Data.ByteString qualified as ByteString
import Frame.Frame (Frame)
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))

-- | Of so many single holes so many are found, and these are read as other frames: row from 1 and
-- track. The rest changes nothing.
data Share = Share {tried :: Int, found :: Int, unseen :: [(Int, Int)]}
  deriving stock (Eq, Show)

-- | What reading finds of all single holes in the tape of some frames.
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

-- | Every tape that differs in one hole on one of its tracks, with its row from 1 and the track.
changes :: Machine -> Tape -> [((Int, Int), Tape)]
changes machine (Tape rows) =
  [ ((k + 1, track), Tape (before <> ByteString.cons (complementBit w (track - 1)) after))
    | k <- [0 .. ByteString.length rows - 1],
      let (before, rest) = ByteString.splitAt k rows,
      Just (w, after) <- [ByteString.uncons rest],
      track <- [1 .. Machine.tracks (Machine.medium machine)]
  ]
