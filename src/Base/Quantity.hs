{-# LANGUAGE FlexibleContexts #-}

-- | Quantities: lengths, angles, feeds, times and pulses are different types.
--
-- The sum of two lengths is a length, but their product is not. Lengths, angles, feeds and times
-- therefore have no 'Num' instance; 'Pulses' have one, because they are counts. Formulas with the
-- other quantities unwrap the numbers, compute, and wrap the result.
module Base.Quantity
  ( Mm (..),
    Rad (..),
    Feed (..),
    Seconds (..),
    Pulses (..),
    LengthUnit (..),
    millimetresIn,
    plus,
    minus,
    times,
    over,
    total,
    radians,
    degrees,
    travelTime,
  )
where

import Data.Coerce (Coercible, coerce)

-- | A length in millimetres.
newtype Mm = Mm Double
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | An angle in radians, counter-clockwise positive.
newtype Rad = Rad Double
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | A feed in millimetres per minute.
newtype Feed = Feed Double
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | A time in seconds.
newtype Seconds = Seconds Double
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | A whole number of pulses, the unit in which a controller counts.
newtype Pulses = Pulses Int
  deriving newtype (Eq, Ord, Num, Enum, Real, Integral)
  deriving stock (Show)

-- | A unit in which people write and read lengths.
data LengthUnit = Millimetres | Inches
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | The length of a unit in millimetres. An inch is exactly 25.4 mm.
millimetresIn :: LengthUnit -> Double
millimetresIn unit = case unit of
  Millimetres -> 1
  Inches -> 25.4

-- | The sum of two quantities.
plus :: Coercible q Double => q -> q -> q
plus a b = coerce (coerce a + coerce b :: Double)

-- | The difference of two quantities: the first minus the second.
minus :: Coercible q Double => q -> q -> q
minus a b = coerce (coerce a - coerce b :: Double)

-- | The product of the plain number @k@ and a quantity.
times :: Coercible q Double => Double -> q -> q
times k a = coerce (k * coerce a :: Double)

-- | The quotient of two quantities, a plain number: the first divided by the second.
over :: Coercible q Double => q -> q -> Double
over a b = coerce a / coerce b

-- | The sum of a list of quantities; 0 for an empty list.
total :: Coercible q Double => [q] -> q
total = foldl plus (coerce (0 :: Double))

-- | The angle of @deg@ degrees.
radians :: Double -> Rad
radians deg = Rad (deg * pi / 180)

-- | The size of an angle in degrees.
degrees :: Rad -> Double
degrees (Rad r) = r * 180 / pi

-- | The time of a move with the length @l@ mm and the feed @s@ mm\/min: @60·l/s@ seconds. The
-- formula is that of the paper on the Ural-1 computer.
travelTime :: Mm -> Feed -> Seconds
travelTime (Mm l) (Feed s) = Seconds (60 * l / s)
