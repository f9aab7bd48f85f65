-- | The time that the frames of a file take at their feeds, without dwells and accelerations.
module Gcode.FileTime
  ( timeOf,
    timeText,
  )
where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses3)
import Base.Quantity (Feed (..), Mm (..), Seconds (..), minus, travelTime)
import Data.List (foldl')
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Frame.Frame (Frame (..), FrameMotion (Rapid))
import Frame.Frame qualified as Frame
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine
  ( CommandValue (..),
    CommandWord (..),
    CommandWords (..),
    FeedCode (..),
    Machine,
    TurnFeeds (turnDecimals),
  )
import Machine.Machine qualified as Machine
import Part.CutFeed (SpindleRate (..))
import Part.CutFeed qualified as CutFeed

-- | State between two frames: the position in pulses, how fast the spindle turns, and the time so
-- far.
data Timing = Timing {at :: Pulses3, turns :: SpindleRate, passed :: Double}

-- | Time of frames. @begin@ is the position before the first frame, in pulses.
timeOf :: Machine -> Pulses3 -> [Frame] -> Seconds
timeOf machine begin frames = Seconds (passed (foldl' add (Timing begin NoRate 0) frames))
  where
    add now f =
      let end = at now + increment f
          rate = fromMaybe (turns now) (rateIn machine f)
          Seconds more = if Frame.isMoving f then frameTime end rate now f else Seconds 0
       in Timing {at = end, turns = rate, passed = passed now + more}
    frameTime end rate now f =
      let Mm flat = Segment.length (Frame.segment machine (at now) f)
          Mm rise = minus (Frame.height machine end) (Frame.height machine (at now))
          l = Mm (sqrt (flat * flat + rise * rise))
       in case feedAt machine (CutFeed.turnsAt (meanRadius end now) rate) f of
            Feed v | v > 0 -> travelTime l (Feed v)
            _ -> Seconds 0

    -- On a lathe y is the radius.
    meanRadius end now =
      let begin' = Frame.position machine (at now)
          end' = Frame.position machine end
       in Mm (abs (Vec.y begin' + Vec.y end') / 2)

-- | Feed of a frame in mm\/min while the spindle turns so often in a minute; 0 if it is not known.
feedAt :: Machine -> Double -> Frame -> Feed
feedAt machine rate f = case (code, Machine.turnFeeds (Machine.feeds machine)) of
  (TurnCode n, Just t) -> Feed (rate * fromIntegral n / 10 ^ turnDecimals t)
  _ -> Feed (fromMaybe 0 (Machine.valueOf machine code))
  where
    code = if motion f == Rapid then Machine.rapidCode machine else feedCode f

-- | Rate at which the spindle turns after the commands of a frame.
rateIn :: Machine -> Frame -> Maybe SpindleRate
rateIn machine f = case (given InMetres surfaces, given SpeedLimit surfaces, turns) of
  (v : _, limit : _, _) -> Just (CuttingSpeed (1000 * fromIntegral v) (fromIntegral limit))
  (_, _, n : _) -> Just (TurnsPerMinute (fromIntegral n))
  _ -> Nothing
  where
    turns = given Argument plain
    table = Machine.commandWords machine
    plain = spindleClockwise table <> spindleCounterClockwise table
    surfaces = surfaceClockwise table <> surfaceCounterClockwise table
    given :: CommandValue -> [CommandWord] -> [Int]
    given source ws =
      [n | w <- ws, value w == source, Just n <- [lookup (commandName w) (commands f)]]

-- | Time in minutes and seconds, rounded up to whole seconds.
timeText :: Seconds -> Text
timeText (Seconds t) =
  Decimal.whole (whole `div` 60) <> " min " <> Decimal.whole (whole `mod` 60) <> " s"
  where
    whole = ceiling t :: Int
