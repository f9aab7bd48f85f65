-- | Words of a file for a modern control, with their numbers.
module Gcode.WordText
  ( xFactor,
    feedNumber,
    component,
    axisText,
    heightText,
    lengthText,
    scaledText,
    numbered,
    dwellLine,
    waitText,
  )
where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), Seconds (..))
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.Dialect qualified as Dialect
import Machine.Machine
  ( Axis (..),
    Content (..),
    FeedCode (..),
    Machine,
    NumberForm (decimals, digits),
    ProgramForm (..),
    Word' (address),
  )
import Machine.Machine qualified as Machine
import Machine.ProgramForm (Dialect (..), Lathe (..), XMeaning (..))

-- | Factor of the words of X: 2 on a lathe whose words are diameters.
xFactor :: Num a => ProgramForm -> a
xFactor form = if (meaningOfX <$> lathe form) == Just XDiameter then 2 else 1

-- | Number of a height or of a depth in pulses, in the form of the words of z.
heightText :: Machine -> Pulses -> Text
heightText machine (Pulses n) = case Machine.wordFor machine (Along Z) of
  Nothing -> ""
  Just word -> decimalText (decimals (Machine.form word)) n

-- | Number of a length that is no position, such as a pitch.
lengthText :: ProgramForm -> Mm -> Text
lengthText form = Decimal.shortIn (fileUnit form) 6

-- | Number of a feed word. Some controls want a point in it.
feedNumber :: Machine -> ProgramForm -> FeedCode -> Text
feedNumber machine form code = case code of
  FeedCode n -> decimalText places n <> (if dialect form == Fanuc && places == 0 then "." else "")
  TurnCode _ -> maybe "" (Decimal.shortIn (fileUnit form) 6 . Mm) (Machine.forTurn machine code)
  where
    places = maybe 0 (decimals . Machine.form) (Machine.wordFor machine FeedWord)

-- | Component of a position along an axis.
component :: Axis -> Pulses3 -> Pulses
component axis (Pulses3 x y z) = case axis of
  X -> x
  Y -> y
  Z -> z

-- | Word of an axis at a position in pulses; Nothing if the machine lacks the axis.
axisText :: Machine -> ProgramForm -> Pulses3 -> Axis -> Maybe Text
axisText machine form position axis
  | isJust (Machine.wordFor machine (Along axis)) =
    Just (scaledText machine (Along axis) (factor * component axis position))
  | otherwise = Nothing
  where
    factor = if axis == Y then xFactor form else 1

-- | Word with its number in pulses, the last decimal of which is a pulse.
scaledText :: Machine -> Content -> Pulses -> Text
scaledText machine content' (Pulses n) = case Machine.wordFor machine content' of
  Nothing -> ""
  Just word
    -- The address is the whole command.
    | digits (Machine.form word) == 0 -> address word
    | otherwise -> address word <> decimalText (decimals (Machine.form word)) n

-- | Number with a count of decimals, from its value in units of the last decimal.
decimalText :: Int -> Int -> Text
decimalText count n
  | count == 0 = sign <> Decimal.whole (abs n)
  | otherwise = Text.concat [sign, Decimal.whole whole, ".", fraction]
  where
    sign = if n < 0 then "-" else ""
    (whole, behind) = abs n `quotRem` (10 ^ count)
    fraction = Text.justifyRight count '0' (Decimal.whole behind)

-- | Lines with the numbers that the description asks for.
numbered :: ProgramForm -> [Text] -> [Text]
numbered form body = case numberStep form of
  Nothing -> body
  Just step -> zipWith number [step, 2 * step ..] body
  where
    number n text = "N" <> Decimal.whole n <> " " <> text

-- | Line that waits for a time.
dwellLine :: ProgramForm -> Seconds -> Text
dwellLine form t = "G4 P" <> waitText form t

-- | Number of a time.
waitText :: ProgramForm -> Seconds -> Text
waitText form (Seconds t) = Decimal.short 3 (t / Dialect.dwellPerUnit (dialect form))
