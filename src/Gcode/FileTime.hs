-- | The time that the frames of a file take at their feeds, with their dwells. It does not contain
-- accelerations, the start of the spindle, changes of the tool and stops.
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
import Frame.TurnFeed qualified as TurnFeed
import Geometry.Segment qualified as Segment
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine

-- | Time of frames. @begin@ is the position before the first frame, in pulses. Feeds for one turn
-- of the spindle count at the speed that the spindle has there.
timeOf :: Machine -> Pulses3 -> [Frame] -> Seconds
timeOf machine begin = snd . foldl' add (begin, Seconds 0) . TurnFeed.perMinute machine begin
  where
    add (at, Seconds t) f =
      let end = at + increment f
          Seconds moving = if Frame.isMoving f then frameTime at end f else Seconds 0
          Seconds still = Machine.dwellIn machine (commands f)
       in at `seq` (end, Seconds (t + moving + still))
    frameTime at end f =
      let Mm flat = Segment.length (Frame.segment machine at f)
          Mm rise = minus (Frame.height machine end) (Frame.height machine at)
          code = if motion f == Rapid then Machine.rapidCode machine else feedCode f
       in travelTime
            (Mm (sqrt (flat * flat + rise * rise)))
            (Feed (fromMaybe 0 (Machine.valueOf machine code)))

-- | Time in minutes and seconds, rounded up to whole seconds.
timeText :: Seconds -> Text
timeText (Seconds t) =
  Decimal.whole (whole `div` 60) <> " min " <> Decimal.whole (whole `mod` 60) <> " s"
  where
    whole = ceiling t :: Int
