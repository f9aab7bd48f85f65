-- | Decimal numbers as the files of drawings have them: with a sign, and with an exponent.
module Drawing.Number
  ( number,
    leading,
  )
where

import Data.Char (isDigit)
import Data.Ratio ((%))
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Tolerance qualified as Tolerance

-- | The double nearest to the number that a whole text is. Blanks around it are allowed. Nothing
-- for any other text, for a number beyond the largest double, and for one of too many digits.
number :: Text -> Maybe Double
number text = case leading (Text.strip text) of
  Just (x, rest) | Text.null rest -> Just x
  _ -> Nothing

-- | The number at the beginning of a text and the text after it. The number is as long as possible:
-- @1-2.5.5e3@ begins with 1, then −2.5, then 500. An @e@ without digits after it does not belong to
-- the number.
leading :: Text -> Maybe (Double, Text)
leading text
  | count == 0 || count > Tolerance.mostDigits = Nothing
  | otherwise = do
    size <- value (whole <> places) (power - Text.length places)
    Just (if isNegative then negate size else size, rest)
  where
    (isNegative, unsigned) = signed text
    (whole, afterWhole) = Text.span isAsciiDigit unsigned
    (places, afterPlaces) = case Text.uncons afterWhole of
      Just ('.', more) -> Text.span isAsciiDigit more
      _ -> ("", afterWhole)
    count = Text.length whole + Text.length places
    (power, rest) = exponentOf afterPlaces

-- | The exponent at the beginning of a text, 0 if there is none, and the text after it.
exponentOf :: Text -> (Int, Text)
exponentOf text = case Text.uncons text of
  Just (e, more)
    | e == 'e' || e == 'E',
      (isNegative, unsigned) <- signed more,
      (digits, rest) <- Text.span isAsciiDigit unsigned,
      not (Text.null digits) ->
      ((if isNegative then negate else id) (bounded (Text.dropWhile (== '0') digits)), rest)
  _ -> (0, text)
  where
    bounded digits
      | Text.length digits > 5 = hugePower
      | otherwise = fromInteger (natural digits)

-- | An exponent that no double has, whatever the digits before it.
hugePower :: Int
hugePower = 100000

signed :: Text -> (Bool, Text)
signed text = case Text.uncons text of
  Just ('-', rest) -> (True, rest)
  Just ('+', rest) -> (False, rest)
  _ -> (False, text)

isAsciiDigit :: Char -> Bool
isAsciiDigit = isDigit

natural :: Text -> Integer
natural = Text.foldl' (\n c -> 10 * n + toInteger (fromEnum c - fromEnum '0')) 0

-- | The double nearest to the digits times a power of ten. A mantissa below 2⁵³ and a power up to
-- 10²² are doubles, and their product or quotient is rounded once. Nothing beyond the largest
-- double.
value :: Text -> Int -> Maybe Double
value digits power
  | mantissa == 0 = Just 0
  | magnitude > largestPower = Nothing
  | magnitude < negate smallestPower = Just 0
  | mantissa < 2 ^ (53 :: Int) && abs power <= 22 =
    Just (if power < 0 then fromInteger mantissa / ten else fromInteger mantissa * ten)
  | isInfinite rounded = Nothing
  | otherwise = Just rounded
  where
    mantissa = natural digits
    magnitude = Text.length (Text.dropWhile (== '0') digits) + power
    ten = 10 ^ abs power
    rounded
      | power < 0 = fromRational (mantissa % (10 ^ negate power))
      | otherwise = fromInteger (mantissa * 10 ^ power)

-- | The count of digits before the point above which a number has no double.
largestPower :: Int
largestPower = 310

-- | The count of zeros after the point from which the nearest double is 0.
smallestPower :: Int
smallestPower = 330
