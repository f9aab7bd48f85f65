-- | Numbers as a person reads them: fixed decimals, no exponent, no minus zero.
module Base.Decimal
  ( fixed,
    short,
    exact,
    amount,
    whole,
    mm,
  )
where

import Base.Quantity (Mm (..))
import Data.Char (digitToInt, isDigit)
import Data.Maybe (fromMaybe)
import Data.Ratio ((%))
import Data.Text (Text)
import Data.Text qualified as Text
import Numeric (showFFloat)

-- | With exactly so many decimals; numbers that are no lengths of this world with an exponent.
fixed :: Int -> Double -> Text
fixed decimals x
  | abs x >= 1e15 = Text.pack (show x)
  | otherwise = if Text.all (`elem` ("-0." :: String)) digits then Text.dropWhile (== '-') digits else digits
  where
    digits = Text.pack (showFFloat (Just decimals) x "")

-- | With at most so many decimals, trailing zeros dropped.
short :: Int -> Double -> Text
short decimals x
  | Text.any (== '.') digits && not (Text.any (== 'e') digits) = Text.dropWhileEnd (== '.') (Text.dropWhileEnd (== '0') digits)
  | otherwise = digits
  where
    digits = fixed decimals x

-- | The fewest decimals that give the same number again when they are read by 'amount'. What needs more than
-- 'mostDigits', such as a length far below that of an atom, is rounded.
exact :: Double -> Text
exact x
  | x == 0 = "0"
  | Text.length (Text.filter isDigit digits) <= mostDigits = digits
  | otherwise = short (mostDigits - 16) x
  where
    written = Text.pack (showFFloat Nothing x "")
    digits = fromMaybe written (Text.stripSuffix ".0" written)

-- | The double nearest to a number as it is written: digits, and, if wanted, a point and more digits.
amount :: Text -> Maybe Double
amount text
  | Text.compareLength text fewDigits == GT = manyDigits text
  | otherwise = case Text.foldl' further (Read 0 0 0) text of
    Read n 0 size | size > 0 -> Just (fromIntegral n)
    Read n point size
      | point > 1 && size > point && n < 2 ^ (53 :: Int) -> Just (fromIntegral n / 10 ^ (size - point))
      | point > 1 && size > point -> manyDigits text
    _ -> Nothing
  where
    further (Read n point size) c
      | isDigit c = Read (10 * n + digitToInt c) point (size + 1)
      | c == '.' && point == 0 = Read n (size + 1) (size + 1)
      | otherwise = Read n (-1) (size + 1)

-- | What is read of a number: its digits as a whole number; behind how many characters the point stood, the point counted,
-- 0 without a point, less with something else; how many characters there are.
data Read = Read Int Int Int

-- | So many characters are digits of an 'Int'.
fewDigits :: Int
fewDigits = 18

-- | The same of as many digits as may be.
manyDigits :: Text -> Maybe Double
manyDigits text
  | Text.null before || Text.any (not . isDigit) (before <> fraction) = Nothing
  | Text.isPrefixOf "." rest && Text.null fraction = Nothing
  | Text.length before + places > mostDigits = Nothing
  | digits < 2 ^ (53 :: Int) && places <= 22 = Just (fromInteger digits / fromInteger (10 ^ places))
  | otherwise = Just (fromRational (digits % (10 ^ places)))
  where
    (before, rest) = Text.breakOn "." text
    fraction = Text.drop 1 rest
    places = Text.length fraction
    digits = Text.foldl' (\n c -> 10 * n + toInteger (digitToInt c)) 0 (before <> fraction)

-- | No number is written with more digits.
mostDigits :: Int
mostDigits = 40

-- | A whole number.
whole :: Int -> Text
whole = Text.pack . show

-- | A length for a message: at most four decimals, with its unit.
mm :: Mm -> Text
mm (Mm x) = short 4 x <> " mm"
