-- | Numbers as a person reads them: fixed decimals, no exponent, no minus zero.
module Base.Decimal
  ( fixed,
    short,
    exact,
    amount,
    Leading (..),
    leading,
    whole,
    mm,
    some,
    unlike,
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

-- | With exactly so many decimals; numbers that are no lengths of this world with an exponent.
fixed :: Int -> Double -> Text
fixed decimals x
  | abs x >= 1e15 = Text.pack (show x)
  | otherwise =
    if Text.all (`elem` ("-0." :: String)) written then Text.dropWhile (== '-') written else written
  where
    written = Text.pack (showFFloat (Just decimals) x "")

-- | With at most so many decimals, trailing zeros dropped.
short :: Int -> Double -> Text
short decimals x
  | Text.any (== '.') written && not (Text.any (== 'e') written) =
    Text.dropWhileEnd (== '.') (Text.dropWhileEnd (== '0') written)
  | otherwise = written
  where
    written = fixed decimals x

-- | The fewest decimals that give the same number again when they are read by 'amount'. What needs
-- more than 'mostDigits', such as a length far below that of an atom, is rounded.
exact :: Double -> Text
exact x
  | x == 0 = "0"
  | Text.length (Text.filter isDigit plain) <= mostDigits = plain
  | otherwise = short (mostDigits - 16) x
  where
    written = Text.pack (showFFloat Nothing x "")
    plain = fromMaybe written (Text.stripSuffix ".0" written)

-- | The double nearest to a number as it is written: digits, and, if wanted, a point and more
-- digits.
amount :: Text -> Maybe Double
amount text = case leading text of
  Leading {size, worth, behind} | size > 0 && Text.null behind -> worth
  _ -> Nothing

-- | The number that a text begins with: how many characters it takes, none when no digit stands
-- there; the double nearest to it, unless it has too many digits; what stands behind it.
data Leading = Leading {size :: Int, worth :: Maybe Double, behind :: {-# UNPACK #-} Text}

leading :: Text -> Leading
leading text = case digits 0 text of
  Digits front count behind -> case Text.uncons behind of
    Just ('.', more)
      | count > 0,
        Digits n places further <- digits front more,
        places > 0 ->
        Leading (count + 1 + places) (fraction n places (count + 1 + places)) further
    _ ->
      Leading
        count
        (if count <= fewDigits then Just (fromIntegral front) else longer (Text.take count text) "")
        behind
  where
    fraction n places size
      | size <= fewDigits && n < 2 ^ (53 :: Int) =
        Just (fromIntegral n / powersOfTen Vector.! places)
      | otherwise =
        let (before, rest) =
              Text.breakOn "." (Text.take size text)
         in longer before (Text.drop 1 rest)

-- | The digits that a text begins with, behind those of a number: the number, as far as an 'Int'
-- holds it; how many there are; what stands behind them.
data Digits = Digits Int Int {-# UNPACK #-} Text

digits :: Int -> Text -> Digits
digits = go 0
  where
    go count n text = case Text.uncons text of
      Just (c, rest) | isDigit c -> go (count + 1) (10 * n + (fromEnum c - fromEnum '0')) rest
      _ -> Digits n count text

-- | 1, 10, 100 …, each of which is a double exactly.
powersOfTen :: Vector Double
powersOfTen = Vector.iterateN fewDigits (10 *) 1

-- | So many characters are digits of an 'Int'.
fewDigits :: Int
fewDigits = 18

-- | The double nearest to a number of as many digits as may be: those before and those behind its
-- point.
longer :: Text -> Text -> Maybe Double
longer before fraction
  | Text.length before + places > mostDigits = Nothing
  | ciphers < 2 ^ (53 :: Int) && places <= 22 =
    Just (fromInteger ciphers / fromInteger (10 ^ places))
  | otherwise = Just (fromRational (ciphers % (10 ^ places)))
  where
    places = Text.length fraction
    ciphers = Text.foldl' (\n c -> 10 * n + toInteger (digitToInt c)) 0 (before <> fraction)

-- | No number is written with more digits.
mostDigits :: Int
mostDigits = 40

-- | A whole number.
whole :: Int -> Text
whole = Text.pack . show

-- | A length for a message: at most four decimals, with its unit.
mm :: Mm -> Text
mm (Mm x) = short 4 x <> " mm"

-- | The same of a length, with as many more decimals as tell it from another one.
unlike :: Mm -> Mm -> Text
unlike (Mm other) (Mm x) =
  case [ written
         | decimals <- [4 .. 9],
           let written = short decimals x,
           written /= short decimals other
       ] of
    written : _ -> written <> " mm"
    [] -> mm (Mm x)

-- | The same of a length that is not 0, with as many more decimals as show it.
some :: Mm -> Text
some (Mm x)
  | abs x >= 0.0001 = mm (Mm x)
  | otherwise = short 9 x <> " mm"
