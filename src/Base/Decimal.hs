-- | Numbers as a person reads them: fixed decimals, no exponent, no minus zero.
module Base.Decimal
  ( fixed,
    short,
    whole,
    mm,
  )
where

import Base.Quantity (Mm (..))
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

-- | A whole number.
whole :: Int -> Text
whole = Text.pack . show

-- | A length for a message: at most four decimals, with its unit.
mm :: Mm -> Text
mm (Mm x) = short 4 x <> " mm"
