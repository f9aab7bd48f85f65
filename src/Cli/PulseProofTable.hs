-- | The proof of the pulses of a tape as a table and a verdict.
module Cli.PulseProofTable
  ( pulseProof,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), Seconds (..))
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.List (sortOn)
import Data.Ord (Down (..))
import Data.Text (Text)
import Machine.Controller (FrequencyLimits (..), noLimits)
import Pulse.RunMeasure (FrequencyPeak (..), RunTotal (..))
import Verify.PulseProof (FeedWitness (..), PulseProof, PulseWitness (..))
import Verify.PulseProof qualified as Proof

-- | The proof as text. Each row has a measure, the value that is allowed or asked beside it, and
-- the number of the frame where it occurs. Deviations are in pulses, feeds in mm/min, frequencies
-- in pulses per second, times in seconds.
pulseProof :: PulseProof -> Text
pulseProof p =
  Table.columns
    [ToLeft, ToRight, ToRight, ToRight]
    ( ["pulses", "", "allowed", "frame"] :
      [ deviationRow "furthest from a line" (Proof.onLines p),
        deviationRow "furthest from an arc" (Proof.onArcs p)
      ]
        <> [["feed mm/min", "", "asked", ""]]
        <> [ feedRow "mean of a frame, furthest off" (Proof.meanFeed (Proof.feeds p)),
             feedRow "furthest below, over 1 mm" (Proof.leastFeed (Proof.feeds p)),
             feedRow "furthest above, over 1 mm" (Proof.highestFeed (Proof.feeds p))
           ]
        <> [["axes, pulses a second", "", if limits == noLimits then "" else "allowed", ""]]
        <> [ frequencyRow "highest mean in a frame" (highestFrequency limits) (peaks total),
             frequencyRow "largest jump between frames" (largestJump limits) (largestJumps total)
           ]
    )
    <> "\n"
    <> Table.columns
      [ToLeft, ToRight, ToLeft]
      [ ["pulses on all axes", Decimal.whole (Proof.pulseCount p), ""],
        [ "waits between two feed moves",
          Decimal.whole (starved total),
          maybe "" (("the first before frame " <>) . Decimal.whole) (firstStarved total)
        ],
        ["all waits for the reader", ticks (totalWaited total), "s"],
        ["time of the controller", ticks (totalTicks total), "s"],
        ["length by feed", seconds (Proof.formulaTime p), "s"]
      ]
    <> "\n"
    <> Table.columns
      [ToLeft, ToLeft]
      [["verdict on the pulses", if Proof.isSound p then "proven" else "WRONG"]]
  where
    total = Proof.total p
    limits = Proof.limits p
    seconds (Seconds s) = Decimal.fixed 3 s
    ticks t = Decimal.fixed 3 (fromIntegral t / fromIntegral (Proof.clock p))

deviationRow :: Text -> Maybe PulseWitness -> [Text]
deviationRow name found = case found of
  Nothing -> [name, "", "", ""]
  Just w ->
    [name, Decimal.fixed 4 (amount w), Decimal.fixed 4 (promised w), Decimal.whole (frame w)]

feedRow :: Text -> Maybe FeedWitness -> [Text]
feedRow name found = case found of
  Nothing -> [name, "", "", ""]
  Just w -> [name, feed (measured w), feed (wanted w), Decimal.whole (feedFrame w)]
  where
    feed (Feed v) = Decimal.fixed 2 v

-- | Row of the highest of the axes' frequencies, with the limit that the description gives.
frequencyRow :: Text -> Maybe Double -> [FrequencyPeak] -> [Text]
frequencyRow name limit found = case sortOn (Down . peakHz) (filter ((> 0) . peakFrame) found) of
  [] -> [name, "", allowed, ""]
  peak : _ -> [name, Decimal.fixed 1 (peakHz peak), allowed, Decimal.whole (peakFrame peak)]
  where
    allowed = maybe "" (Decimal.fixed 1) limit
