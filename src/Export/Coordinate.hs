-- | Numbers of exported drawings as text.
module Export.Coordinate
  ( text,
    inUnit,
  )
where

import Base.Crash qualified as Crash
import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, millimetresIn)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Numeric (showFFloat)

-- | The shortest decimal text without an exponent that gives exactly the number @x@ when it is read
-- back. A number below 10⁻²⁴, for which this text would be very long, is rounded to 24 decimals. A
-- number that is infinite or not a number is a bug of the caller.
text :: Double -> Text
text x
  | isNaN x || isInfinite x = Crash.bug "a coordinate of a drawing is not a number"
  | abs x < 1e15 = Decimal.exact x
  | otherwise = fromMaybe plain (Text.stripSuffix ".0" plain)
  where
    plain = Text.pack (showFFloat Nothing x "")

-- | A length in mm, converted to the unit.
inUnit :: LengthUnit -> Double -> Double
inUnit unit x = x / millimetresIn unit
