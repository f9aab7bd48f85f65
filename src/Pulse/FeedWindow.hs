-- | Window over which the feed of a frame is measured, from the pulses alone.
--
-- A window is a millimetre of a frame's path or a little more, between two pulses of the leading
-- axis on a line, and between two cycles on an arc. A line that is shorter than a millimetre is one
-- window. Where only rotary axes move, a degree takes the place of the millimetre.
module Pulse.FeedWindow
  ( FeedWindow,
    begin,
    step,
    pathLength,
    relative,
    made,
    since,
    latest,
    range,
    speed,
    pulsesInWindow,
  )
where

import Base.Quantity (Mm (..))
import Machine.Machine (Axis (X), Machine)
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (Tick)
import Pulse.FramePath (FramePath (Arc, Line, clockwise))
import Pulse.FramePath qualified as FramePath
import Pulse.Steps (Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps

-- | Window that is open, and the results of the windows of the same frame before it.
data FeedWindow = FeedWindow
  { ruler :: Ruler,
    path :: Maybe FramePath,
    -- | position relative to the beginning of the frame
    relative :: Pulses5,
    -- | counts of the frame's pulses on each axis
    made :: Pulses5,
    -- | tick at the start of the window
    since :: Tick,
    -- | position at the start of the window
    from :: Pulses5,
    -- | count that is left up to the end of the window
    left :: Int,
    -- | feed of the window before; 0 in the first one
    latest :: Double,
    least :: Double,
    most :: Double
  }

-- | Measures of a path: its length, the length of a window as a count of pulses of the leading
-- axis or of cycles on an arc, the axis whose pulses are counted (−1 for all), and for a line the
-- length of the path for each of these pulses.
data Ruler = Ruler
  { long :: Double,
    windowCount :: Int,
    countedAxis :: Int,
    perCount :: Double,
    pulseLength :: Double
  }

-- | Length of a window on a path, as a count of pulses of the leading axis, or of cycles on an arc.
pulsesInWindow :: Machine -> FramePath -> Int
pulsesInWindow machine = windowCount . rulerOf machine

-- | First window of a frame that begins at a tick, with the path of the frame.
begin :: Machine -> Tick -> Maybe FramePath -> FeedWindow
begin machine t path =
  FeedWindow
    { ruler,
      path,
      relative = zero,
      made = zero,
      since = t,
      from = zero,
      left = windowCount ruler,
      latest = 0,
      least = 1 / 0,
      most = 0
    }
  where
    ruler = maybe (Ruler 0 1 (-1) 0 0) (rulerOf machine) path
    zero = Pulses5 0 0 0 0 0

-- | Length of the frame's path in mm or in degrees; 0 without a path.
pathLength :: FeedWindow -> Double
pathLength = long . ruler

-- | Least and highest feed of the windows that are closed; Nothing if there is none.
range :: FeedWindow -> Maybe (Double, Double)
range w = if most w > 0 then Just (least w, most w) else Nothing

-- | Ruler of a path. A window has at least one millimetre, or the whole of a shorter line.
rulerOf :: Machine -> FramePath -> Ruler
rulerOf machine p = case p of
  Line d ->
    let n = FramePath.leadingPulses d
        each = long / fromIntegral (max 1 n)
        inWindow = max 1 (min n (ceiling (1 / max 1e-9 each)))
     in Ruler long inWindow (FramePath.leadingAxis d) each pulse
  Arc {} -> Ruler long (max 1 (ceiling (4 / pi / pulse))) (-1) 0 pulse
  where
    long = FramePath.pathLength machine p
    Mm pulse = Machine.resolutionOf machine X

-- | Window after the pulses of one tick. If they close the window, the next one is open. The first
-- argument is the frequency of the clock.
step :: Int -> Tick -> Steps -> FeedWindow -> FeedWindow
step clock t steps w
  | countedAxis r >= 0 && Steps.onAxis (countedAxis r) steps == 0 = moved
  | left w > 1 = moved {left = left w - 1}
  | otherwise =
    let feed = speed clock (windowLength w there) (t - since w)
     in moved
          { since = t,
            from = there,
            left = windowCount r,
            latest = feed,
            least = min (least w) feed,
            most = max (most w) feed
          }
  where
    r = ruler w
    there = Steps.advance steps (relative w)
    moved = w {relative = there, made = Steps.countEach steps (made w)}

-- | Length of the path in the window that ends at the given position.
windowLength :: FeedWindow -> Pulses5 -> Double
windowLength w to = case path w of
  Just (Arc {clockwise, FramePath.from = (i, j)}) ->
    let Pulses5 a b _ _ _ = from w
        Pulses5 c d _ _ _ = to
        angle = FramePath.angleBetween clockwise (i + a, j + b) (i + c, j + d)
        radius = sqrt (fromIntegral (i * i + j * j)) * pulseLength (ruler w)
     in radius * (if angle < 0 then angle + 2 * pi else angle)
  Just (Line _) -> perCount (ruler w) * fromIntegral (windowCount (ruler w))
  Nothing -> 0

-- | Feed in mm\/min for a length in mm and a time in ticks. The first argument is the frequency of
-- the clock.
speed :: Int -> Double -> Tick -> Double
speed clock l t = 60 * l * fromIntegral clock / fromIntegral (max 1 t)
