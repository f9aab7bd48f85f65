-- | Decimal numbers as text: fixed decimals, no exponent, no minus zero; and their parser.
module Base.Decimal
  ( fixed,
    short,
    exact,
    parse,
    Leading (..),
    leading,
    whole,
    mm,
    nonZeroMm,
    distinctMm,
  )
where

import Base.Quantity (Mm (..))
import Data.Char (digitToInt, isDigit)
import Data.Maybe (fromMaybe)
import Data.Ratio ((%))
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Vector
import Numeric (showFFloat)

-- | A number with a count of decimals. Numbers from 10¹⁵ on have an exponent.
fixed :: Int -> Double -> Text
fixed decimals x
  | abs x >= 1e15 = Text.pack (show x)
  | otherwise =
    if Text.all (`elem` ("-0." :: String)) written then Text.dropWhile (== '-') written else written
  where
    written = Text.pack (showFFloat (Just decimals) x "")

-- | A number with at most a count of decimals, without trailing zeros.
short :: Int -> Double -> Text
short decimals x
  | Text.any (== '.') written && not (Text.any (== 'e') written) =
    Text.dropWhileEnd (== '.') (Text.dropWhileEnd (== '0') written)
  | otherwise = written
  where
    written = fixed decimals x

-- | The shortest text that 'parse' reads as the same number. A number that needs more than
-- 'mostDigits' is rounded: it is far smaller than any length of a part.
exact :: Double -> Text
exact x
  | x == 0 = "0"
  | Text.length (Text.filter isDigit plain) <= mostDigits = plain
  | otherwise = short (mostDigits - 16) x
  where
    written = Text.pack (showFFloat Nothing x "")
    plain = fromMaybe written (Text.stripSuffix ".0" written)

-- | Parses digits, and optionally a point and more digits, into the nearest double.
parse :: Text -> Maybe Double
parse text = case leading text of
  Leading {consumed, parsed, remainder} | consumed > 0 && Text.null remainder -> parsed
  _ -> Nothing

-- | The number at the start of a text.
data Leading = Leading
  { -- | the count of its characters; 0 without a number
    consumed :: Int,
    -- | the nearest double; nothing with more than 'mostDigits' digits
    parsed :: Maybe Double,
    -- | the text after it
    remainder :: {-# UNPACK #-} Text
  }

-- | Parses the number at the start of a text.
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

-- | The result of reading the digits at the start of a text: the given number with these digits
-- appended (it may overflow), the count of these digits, and the rest of the text.
data Digits = Digits Int Int {-# UNPACK #-} Text

digits :: Int -> Text -> Digits
digits = go 0
  where
    go count n text = case Text.uncons text of
      Just (c, rest) | isDigit c -> go (count + 1) (10 * n + (fromEnum c - fromEnum '0')) rest
      _ -> Digits n count text

-- | The powers of ten from 1 on that are below 10 to the power 'fewDigits'. Doubles hold them
-- exactly.
powersOfTen :: Vector Double
powersOfTen = Vector.iterateN fewDigits (10 *) 1

-- | The count of decimal digits that an 'Int' always holds.
fewDigits :: Int
fewDigits = 18

-- | The double nearest to a number with up to 'mostDigits' digits, given its digits before and
-- after the point.
longer :: Text -> Text -> Maybe Double
longer before fraction
  | Text.length before + places > mostDigits = Nothing
  | digits' < 2 ^ (53 :: Int) && places <= 22 =
    Just (fromInteger digits' / fromInteger (10 ^ places))
  | otherwise = Just (fromRational (digits' % (10 ^ places)))
  where
    places = Text.length fraction
    digits' = Text.foldl' (\n c -> 10 * n + toInteger (digitToInt c)) 0 (before <> fraction)

-- | The largest count of digits of a number.
mostDigits :: Int
mostDigits = 40

-- | A whole number.
whole :: Int -> Text
whole = Text.pack . show

-- | A length for a report: at most four decimals, with its unit.
mm :: Mm -> Text
mm (Mm x) = short 4 x <> " mm"

-- | A length for a report with enough decimals, up to nine, to differ from another length: the
-- first argument. Four decimals when nine are not enough.
distinctMm :: Mm -> Mm -> Text
distinctMm (Mm other) (Mm x) =
  case [ written
         | decimals <- [4 .. 9],
           let written = short decimals x,
           written /= short decimals other
       ] of
    written : _ -> written <> " mm"
    [] -> mm (Mm x)

-- | A length that is not 0 for a report: with nine decimals when four are not enough to show it.
nonZeroMm :: Mm -> Text
nonZeroMm (Mm x)
  | abs x >= 0.0001 = mm (Mm x)
  | otherwise = short 9 x <> " mm"
