-- | Summary of the frames of a tape. It is computed in one traversal, because a tape may have many
-- frames.
module Verify.TapeSummary
  ( TapeSummary (..),
    summarize,
    isNear,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Pulses (..))
import Control.Applicative ((<|>))
import Data.List (foldl')
import Frame.Frame (Frame (..), PlannedFrame)
import Frame.Frame qualified as Frame
import Machine.Machine (RotaryAxis)

-- | Summary of a tape. Frames are numbered from 1.
data TapeSummary = TapeSummary
  { -- | number of frames
    count :: Int,
    -- | position after the last frame
    endPosition :: Pulses3,
    -- | largest increment in one frame, along each axis, without its sign
    largestIncrement :: Pulses3,
    -- | number of the first frame that ends at another height than the start position; Nothing if
    -- the tape stays at that height
    firstRisen :: Maybe Int,
    -- | each rotary axis that the tape turns, with the number of the first frame that does
    firstTurns :: [(RotaryAxis, Int)],
    -- | number of the first frame that differs from the planned frame of the same number, or that
    -- exists only on the tape or only in the plan; Nothing if there is no difference
    firstDifference :: Maybe Int,
    -- | true if the tape has as many frames as planned, and each of them ends where the planned
    -- frame of the same number ends. A difference of two pulses on each axis is due to rounding
    isAligned :: Bool
  }

-- | Summarize the frames of a tape that begins at the position @begin@. The planned frames are
-- those that the compiler made for the program.
summarize :: Pulses3 -> [PlannedFrame] -> [Frame] -> TapeSummary
summarize begin@(Pulses3 _ _ startHeight) planned frames = case missing of
  [] -> summary
  _ ->
    summary
      { firstDifference = firstDifference summary <|> Just (count summary + 1),
        isAligned = False
      }
  where
    Comparison summary _ missing =
      foldl' (withFrame startHeight) (Comparison empty begin planned) frames
    empty = TapeSummary 0 begin 0 Nothing [] Nothing True

-- | Summary of the frames of a tape that are already compared, the position after the planned
-- frames that are already compared, and the planned frames that are not yet compared.
data Comparison = Comparison TapeSummary Pulses3 [PlannedFrame]

-- | Comparison after the next frame @f@ of the tape. @startHeight@ is the height of the start
-- position, in pulses.
withFrame :: Pulses -> Comparison -> Frame -> Comparison
withFrame startHeight (Comparison summary plannedEnd planned) f =
  Comparison
    TapeSummary
      { count = number,
        endPosition = end,
        largestIncrement = Pulses3 (max a (abs dx)) (max b (abs dy)) (max c (abs dz)),
        firstRisen = firstRisen summary <|> if height == startHeight then Nothing else Just number,
        firstTurns = firstTurns summary <> turns,
        firstDifference = firstDifference summary <|> if isPlanned then Nothing else Just number,
        isAligned = isAligned summary && not (null planned) && isNear end plannedEnd'
      }
    plannedEnd'
    (drop 1 planned)
  where
    plannedEnd' = case planned of
      p : _ -> plannedEnd + increment (Frame.frame p)
      [] -> plannedEnd
    end = Pulses3 (x + dx) (y + dy) height
    number = count summary + 1
    Pulses3 x y z = endPosition summary
    Pulses3 dx dy dz = increment f
    Pulses3 a b c = largestIncrement summary
    height = z + dz
    turns =
      [ (axis, number)
        | axis <- Frame.turnedAxes f,
          axis `notElem` map fst (firstTurns summary)
      ]
    isPlanned = case planned of
      p : _ -> Frame.frame p == f
      [] -> False

-- | Test that two positions differ by no more than two pulses on any axis.
isNear :: Pulses3 -> Pulses3 -> Bool
isNear p q = maximum [x, y, z] <= Pulses 2
  where
    Pulses3 x y z = abs (p - q)
