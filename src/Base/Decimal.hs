-- | Decimal numbers: writing them as text, and parsing them. Zero is written without a minus sign.
-- A number with an absolute value below 10¹⁵ is written without an exponent.
module Base.Decimal
  ( fixed,
    short,
    exact,
    parse,
    Leading (..),
    leading,
    whole,
    unitText,
    shortIn,
    fixedIn,
    inUnit,
    nonZeroIn,
    distinctIn,
    fixedInUnit,
    feedIn,
    exactFeedIn,
    areaIn,
    shortAreaIn,
    roundedDown,
    stepsPerMm,
    mm,
  )
where

import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), millimetresIn)
import Data.Char (digitToInt, isDigit)
import Data.Maybe (fromMaybe)
import Data.Ratio ((%))
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Vector
import Numeric (showFFloat)

-- | The text of the number @x@, rounded to exactly @decimals@ digits after the point. For an
-- absolute value from 10¹⁵ on, the text has an exponent instead.
fixed :: Int -> Double -> Text
fixed decimals x
  | abs x >= 1e15 = Text.pack (show x)
  | otherwise =
    if Text.all (`elem` ("-0." :: String)) written then Text.dropWhile (== '-') written else written
  where
    written = Text.pack (showFFloat (Just decimals) x "")

-- | The text of the number @x@, rounded to @decimals@ digits after the point, without trailing
-- zeros.
short :: Int -> Double -> Text
short decimals x
  | Text.any (== '.') written && not (Text.any (== 'e') written) =
    Text.dropWhileEnd (== '.') (Text.dropWhileEnd (== '0') written)
  | otherwise = written
  where
    written = fixed decimals x

-- | The shortest decimal text that gives exactly the number @x@ when it is read back. 'parse' reads
-- it back unless @x@ is negative: the text then begins with a minus sign.
--
-- An exception is a number whose text would have more than 'mostDigits' digits. If its absolute
-- value is below 10¹⁵, it is rounded to 24 decimals. This error is smaller than any length of a
-- part. Otherwise its text has an exponent, which 'parse' does not accept.
exact :: Double -> Text
exact x
  | x == 0 = "0"
  | Text.length (Text.filter isDigit plain) <= mostDigits = plain
  | otherwise = short (mostDigits - 16) x
  where
    written = Text.pack (showFFloat Nothing x "")
    plain = fromMaybe written (Text.stripSuffix ".0" written)

-- | Parses a text that is one unsigned decimal number: digits, and optionally a point and more
-- digits. Yields the double nearest to the number. Nothing for any other text, such as one with a
-- sign or an exponent, and for a number with more than 'mostDigits' digits.
parse :: Text -> Maybe Double
parse text = case leading text of
  Leading {consumed, parsed, remainder} | consumed > 0 && Text.null remainder -> parsed
  _ -> Nothing

-- | A text divided into the unsigned number at its start and the text after that.
data Leading = Leading
  { -- | the count of the number's characters; 0 for a text that does not begin with a digit
    consumed :: Int,
    -- | the double nearest to the number; nothing for a number with more than 'mostDigits' digits,
    -- and 0 for a text that does not begin with a digit
    parsed :: Maybe Double,
    -- | the text after the number
    remainder :: {-# UNPACK #-} Text
  }

-- | Parses the unsigned number at the start of a text. A point belongs to the number only if digits
-- come before and after it.
leading :: Text -> Leading
leading text = case digits 0 text of
  Digits front count remainder -> case Text.uncons remainder of
    Just ('.', more)
      | count > 0,
        Digits n places further <- digits front more,
        places > 0 ->
        Leading (count + 1 + places) (fraction n places (count + 1 + places)) further
    _ ->
      Leading
        count
        (if count <= fewDigits then Just (fromIntegral front) else longer (Text.take count text) "")
        remainder
  where
    fraction n places width
      | width <= fewDigits && n < 2 ^ (53 :: Int) =
        Just (fromIntegral n / powersOfTen Vector.! places)
      | otherwise =
        let (before, rest) = Text.breakOn "." (Text.take width text)
         in longer before (Text.drop 1 rest)

-- | The result of 'digits': the number with the digits appended, the count of the appended digits,
-- and the text after them. A number of more than 'fewDigits' digits may have overflowed; 'leading'
-- then does not use it.
data Digits = Digits Int Int {-# UNPACK #-} Text

-- | Appends the decimal digits at the start of a text to the digits of a number: 12 and the text
-- @34 mm@ give 1234.
digits :: Int -> Text -> Digits
digits = go 0
  where
    go count n text = case Text.uncons text of
      Just (c, rest) | isDigit c -> go (count + 1) (10 * n + (fromEnum c - fromEnum '0')) rest
      _ -> Digits n count text

-- | The powers of ten from 10⁰ to 10¹⁷; the index is the exponent. Doubles represent them exactly.
powersOfTen :: Vector Double
powersOfTen = Vector.iterateN fewDigits (10 *) 1

-- | The largest count of decimal digits with which every number fits into an 'Int'.
fewDigits :: Int
fewDigits = 18

-- | The double nearest to a number of many digits. The text @before@ contains the digits before the
-- point, and @fraction@ those after it. 'leading' uses this function for numbers that are too long
-- for its faster method. Nothing for more than 'mostDigits' digits in all.
longer :: Text -> Text -> Maybe Double
longer before fraction
  | Text.length before + places > mostDigits = Nothing
  | digits' < 2 ^ (53 :: Int) && places <= 22 =
    Just (fromInteger digits' / fromInteger (10 ^ places))
  | otherwise = Just (fromRational (digits' % (10 ^ places)))
  where
    places = Text.length fraction
    digits' = Text.foldl' (\n c -> 10 * n + toInteger (digitToInt c)) 0 (before <> fraction)

-- | The largest count of digits, before and after the point together, of a number that 'parse'
-- accepts.
mostDigits :: Int
mostDigits = 40

-- | A whole number as text.
whole :: Int -> Text
whole = Text.pack . show

-- | The name of a unit in programs and reports.
unitText :: LengthUnit -> Text
unitText unit = case unit of
  Millimetres -> "mm"
  Inches -> "in"

-- | The number of a length in a unit, without the name of the unit, rounded without trailing zeros:
-- to @decimals@ digits after the point in mm, and to one more in inches.
shortIn :: LengthUnit -> Int -> Mm -> Text
shortIn unit decimals (Mm x) = short (decimals + furtherDecimals unit) (x / millimetresIn unit)

-- | The same, with exactly these digits after the point.
fixedIn :: LengthUnit -> Int -> Mm -> Text
fixedIn unit decimals (Mm x) = fixed (decimals + furtherDecimals unit) (x / millimetresIn unit)

-- | The count of decimals that a length in this unit has beyond that of one in mm.
furtherDecimals :: LengthUnit -> Int
furtherDecimals unit = case unit of
  Millimetres -> 0
  Inches -> 1

-- | The text of a length for a report, with its unit: at most four decimals in mm, five in inches.
inUnit :: LengthUnit -> Mm -> Text
inUnit unit x = withUnit unit (shortIn unit 4 x)

-- | The text of a length in mm for a report: at most four decimals, and the unit.
mm :: Mm -> Text
mm = inUnit Millimetres

-- | The text of the length @x@ for a report that also names the length @other@. Both are rounded
-- like those of 'inUnit' or, if their texts are then equal, to the fewest decimals that distinguish
-- them. If even five more decimals do not distinguish them, the text is that of 'inUnit'.
distinctIn :: LengthUnit -> Mm -> Mm -> Text
distinctIn unit other x =
  case [ written
         | decimals <- [4 .. 9],
           let written = shortIn unit decimals x,
           written /= shortIn unit decimals other
       ] of
    written : _ -> withUnit unit written
    [] -> inUnit unit x

-- | The text of a length that is not 0, for a report. It is that of 'inUnit', but has five more
-- decimals if that one could show 0.
nonZeroIn :: LengthUnit -> Mm -> Text
nonZeroIn unit length'@(Mm x)
  | abs x >= 0.0001 = inUnit unit length'
  | otherwise = withUnit unit (shortIn unit 9 length')

-- | The text of a feed for a report, with its unit: at most @decimals@ digits after the point in
-- mm\/min, and one more in inches per minute.
feedIn :: LengthUnit -> Int -> Feed -> Text
feedIn unit decimals (Feed v) = withUnit unit (shortIn unit decimals (Mm v)) <> "/min"

withUnit :: LengthUnit -> Text -> Text
withUnit unit number = number <> " " <> unitText unit

-- | The text of a feed with its unit and all its decimals, for a fix that writes the feed.
exactFeedIn :: LengthUnit -> Feed -> Text
exactFeedIn unit (Feed v) = withUnit unit (exact (v / millimetresIn unit)) <> "/min"

-- | The text of a length with its unit and a fixed count of digits, see 'fixedIn'.
fixedInUnit :: LengthUnit -> Int -> Mm -> Text
fixedInUnit unit decimals x = withUnit unit (fixedIn unit decimals x)

-- | The number of an area in mm² in the square of a unit, with exactly @decimals@ digits after the
-- point in mm², and two more in square inches.
areaIn :: LengthUnit -> Int -> Double -> Text
areaIn unit decimals = fixed (decimals + 2 * furtherDecimals unit) . inSquares unit

-- | The same, without trailing zeros.
shortAreaIn :: LengthUnit -> Int -> Double -> Text
shortAreaIn unit decimals = short (decimals + 2 * furtherDecimals unit) . inSquares unit

inSquares :: LengthUnit -> Double -> Double
inSquares unit area = area / (millimetresIn unit * millimetresIn unit)

-- | The largest length that is not above @x@ and is a whole number of the steps of 'stepsPerMm'.
roundedDown :: LengthUnit -> Mm -> Mm
roundedDown unit (Mm x) = Mm (fromInteger (floor (x * steps)) / steps)
  where
    steps = stepsPerMm unit

-- | The count of the steps in 1 mm to which reports round a limit: steps of 0.001 mm or of
-- 0.0001 in.
stepsPerMm :: LengthUnit -> Double
stepsPerMm unit = 10 ^ (3 + furtherDecimals unit) / millimetresIn unit
