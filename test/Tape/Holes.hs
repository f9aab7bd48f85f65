-- | Tapes with one hole more or less, and the share of them that reading finds.
module Tape.Holes (Share (..), share, changes) where

import Base.PulseVector (Pulses3)
import Data.Bits (complementBit)
import Data.ByteString qualified as ByteString
import Frame.Frame (Frame)
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))

-- | Number of single holes tried, number of those found, and those that are read as other frames,
-- by their row from 1 and their track. The remaining ones change nothing.
data Share = Share {tried :: Int, found :: Int, unseen :: [(Int, Int)]}
  deriving stock (Eq, Show)

-- | Share of single holes in the tape of some frames that reading finds.
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

-- | All tapes that differ in one hole, with its row from 1 and its track.
changes :: Machine -> Tape -> [((Int, Int), Tape)]
changes machine (Tape rows) =
  [ ((k + 1, track), Tape (before <> ByteString.cons (complementBit w (track - 1)) after))
    | k <- [0 .. ByteString.length rows - 1],
      let (before, rest) = ByteString.splitAt k rows,
      Just (w, after) <- [ByteString.uncons rest],
      track <- [1 .. Machine.tracks (Machine.medium machine)]
  ]
