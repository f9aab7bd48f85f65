-- | Path of one frame in pulses, with its length and the feed that the frame asks.
--
-- Lengths and feeds are floating-point numbers. A controller rounds them once, to the whole number
-- in its cell V; the pulses themselves do not depend on them.
module Pulse.FramePath
  ( FramePath (..),
    fromFrame,
    pathLength,
    sweep,
    angleBetween,
    leadingPulses,
    leadingAxis,
    allPulses,
    endOf,
    velocities,
    AskedFeed (..),
    askedFeed,
    feedOn,
    feedValue,
    feedAlong,
    feedText,
    roundedDown,
  )
where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), degrees)
import Control.Motion qualified as Motion
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Frame.Frame (Frame (..), FrameMotion (..))
import Geometry.Carrier (Sense (..))
import Machine.Machine
  ( Axis (..),
    FeedMeasure (..),
    Machine,
    RotaryAxis (..),
    RotaryForm (pulseAngle),
  )
import Machine.Machine qualified as Machine
import Pulse.Steps (Pulses5 (..))
import Pulse.Steps qualified as Steps

-- | Path of a frame.
data FramePath
  = -- | straight, with these increments
    Line Pulses5
  | -- | Arc in the plane of x and y. Its start and its end are relative to the centre.
    Arc {clockwise :: Bool, from :: (Int, Int), to :: (Int, Int)}
  deriving stock (Eq, Show)

-- | Path of a frame; 'Nothing' for a frame without motion. An arc whose centre is its start or its
-- end is a line, as in "Control.Motion".
fromFrame :: Frame -> Maybe FramePath
fromFrame f = case motion f of
  NoMotion -> Nothing
  Rapid -> Just straight
  Linear -> Just straight
  Circular sense
    | Motion.isRound f ->
      Just Arc {clockwise = sense == Clockwise, from = (-i, -j), to = (x - i, y - j)}
    | otherwise -> Just straight
  where
    Pulses3 (Pulses x) (Pulses y) (Pulses z) = increment f
    Pulses2 (Pulses i) (Pulses j) = centre f
    Pulses2 (Pulses a) (Pulses b) = turn f
    straight = Line (Pulses5 x y z a b)

-- | Length of a path: in mm along x, y and z, or in degrees if only rotary axes move. An arc is
-- measured on the circle through its start.
pathLength :: Machine -> FramePath -> Double
pathLength machine path = case path of
  Line (Pulses5 0 0 0 a b) -> norm [fromIntegral a * angle A, fromIntegral b * angle B]
  Line (Pulses5 x y z _ _) ->
    norm [fromIntegral x * pulse X, fromIntegral y * pulse Y, fromIntegral z * pulse Z]
  Arc {from = (a, b)} -> sqrt (fromIntegral (a * a + b * b)) * sweep path * pulse X
  where
    norm ls = sqrt (sum (map (\l -> l * l) ls))
    pulse a = let Mm l = Machine.resolutionOf machine a in l
    angle a = maybe 0 (degrees . pulseAngle) (Machine.rotaryForm machine a)

-- | Sweep of an arc in radians, above 0 and up to 2π; 0 for a line.
sweep :: FramePath -> Double
sweep path = case path of
  Line _ -> 0
  Arc {clockwise, from, to} ->
    let turn = angleBetween clockwise from to in if turn <= 0 then turn + 2 * pi else turn

-- | Angle from one direction to another in the sense of an arc, between −π and π. The first
-- argument is true for a clockwise arc.
angleBetween :: Bool -> (Int, Int) -> (Int, Int) -> Double
angleBetween clockwise (a, b) (c, d) = if clockwise then negate turn else turn
  where
    turn = atan2 (fromIntegral (a * d - b * c)) (fromIntegral (a * c + b * d))

-- | Pulses of the axis with most pulses, on a line.
leadingPulses :: Pulses5 -> Int
leadingPulses (Pulses5 x y z a b) = maximum (map abs [x, y, z, a, b])

-- | Index of the axis with most pulses on a line; the first one if there are several.
leadingAxis :: Pulses5 -> Int
leadingAxis d = length (takeWhile ((< leadingPulses d) . abs) (Steps.toList d))

-- | Pulses of all axes, on a line.
allPulses :: Pulses5 -> Int
allPulses (Pulses5 x y z a b) = sum (map abs [x, y, z, a, b])

-- | Position at the end of a path, relative to its beginning.
endOf :: FramePath -> Pulses5
endOf path = case path of
  Line d -> d
  Arc {from = (a, b), to = (c, d)} -> Pulses5 (c - a) (d - b) 0 0 0

-- | Velocities of the five axes at the start and at the end of a path, if it is run at an even
-- feed: the signed pulses that an axis would make if it kept its velocity over the whole path.
velocities :: FramePath -> ([Double], [Double])
velocities path = case path of
  Line d -> let v = map fromIntegral (Steps.toList d) in (v, v)
  Arc {clockwise, from, to} -> (alongTangent from, alongTangent to)
    where
      turn = if clockwise then negate (sweep path) else sweep path
      alongTangent (a, b) = [-turn * fromIntegral b, turn * fromIntegral a, 0, 0, 0]

-- | Feed that a frame asks.
data AskedFeed
  = -- | in mm\/min along the path
    Along Double
  | -- | in degrees a minute, because only rotary axes move
    Turning Double
  | -- | in pulses per second of the leading axis
    OfLeadingAxis Double
  deriving stock (Eq, Show)

-- | Feed that a frame asks. A rapid move asks the feed of the machine's rapid moves.
askedFeed :: Machine -> Frame -> AskedFeed
askedFeed machine f = feedOn machine (fromMaybe (Line (Pulses5 0 0 0 0 0)) (fromFrame f)) value
  where
    code = case motion f of
      Rapid -> Machine.rapidCode machine
      NoMotion -> feedCode f
      Linear -> feedCode f
      Circular _ -> feedCode f
    value = fromMaybe 0 (Machine.valueOf machine code)

-- | Feed on a path, in the unit in which the machine measures it.
feedOn :: Machine -> FramePath -> Double -> AskedFeed
feedOn machine path = case Machine.feedMeasure (Machine.feeds machine) of
  LeadingAxis -> OfLeadingAxis
  AlongPath -> case path of
    Line (Pulses5 0 0 0 a b) | a /= 0 || b /= 0 -> Turning
    Line _ -> Along
    Arc {} -> Along

-- | Feed as a number in its own unit.
feedValue :: AskedFeed -> Double
feedValue asked = case asked of
  Along v -> v
  Turning v -> v
  OfLeadingAxis v -> v

-- | Feed along a path in mm\/min, or in degrees a minute if only rotary axes move. 'Nothing' for a
-- frequency on an arc or on a line without pulses.
feedAlong :: Machine -> FramePath -> AskedFeed -> Maybe Double
feedAlong machine path asked = case asked of
  Along v -> Just v
  Turning v -> Just v
  OfLeadingAxis hz -> case path of
    Line d
      | n > 0 -> Just (60 * hz * pathLength machine path / fromIntegral n)
      where
        n = leadingPulses d
    Line _ -> Nothing
    Arc {} -> Nothing

-- | Feed rounded down to a hundredth of its unit, so that it is not above a limit.
roundedDown :: AskedFeed -> AskedFeed
roundedDown asked = case asked of
  Along v -> Along (down v)
  Turning v -> Turning (down v)
  OfLeadingAxis v -> OfLeadingAxis (down v)
  where
    down v = fromIntegral (floor (100 * v) :: Int) / 100

-- | Feed with its unit, as reports show it.
feedText :: AskedFeed -> Text
feedText asked =
  Decimal.short 2 (feedValue asked) <> case asked of
    Along _ -> " mm/min"
    Turning _ -> "°/min"
    OfLeadingAxis _ -> " Hz"
