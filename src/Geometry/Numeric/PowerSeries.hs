-- | Truncated power series: the Taylor coefficients of a function about the value u₀ of its
-- parameter, @f(u₀ + t) = c₀ + c₁·t + c₂·t² + …@ up to some order.
--
-- Sums, products, quotients, powers and sines are computed on the coefficients
-- (Knuth, TAOCP 2, section 4.7). All derivatives of such a combination are therefore exact but for
-- rounding. Coefficient k is the k-th derivative divided by k!. The order of a series is the index
-- of its last coefficient. An operation on two series gives a series of the lower of both orders.
--
-- There is no 'Num' instance. A literal has no order of its own; as a series of order 0 it would
-- truncate every series with which it is combined.
module Geometry.Numeric.PowerSeries
  ( PowerSeries,
    constant,
    cubic,
    fromList,
    fromVector,
    coefficients,
    order,
    value,
    coefficient,
    add,
    subtract,
    scale,
    plusConstant,
    stretched,
    multiply,
    divide,
    power,
    sine,
    cosine,
    tangent,
    derivative,
    integral,
    polynomial,
  )
where

import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Unboxed
import Prelude hiding (subtract)

-- | The coefficients from c₀ on; there is at least one.
newtype PowerSeries = PowerSeries (Vector Double)
  deriving stock (Eq, Show)

-- | The series of order @n@ of the constant @c@.
constant :: Int -> Double -> PowerSeries
constant n c = PowerSeries (Unboxed.generate (n + 1) (\k -> if k == 0 then c else 0))

-- | The series of order @n@ of the cubic polynomial @a + b·t + c·t² + d·t³@.
cubic :: Int -> Double -> Double -> Double -> Double -> PowerSeries
cubic n a b c d =
  PowerSeries (Unboxed.generate (n + 1) (\case 0 -> a; 1 -> b; 2 -> c; 3 -> d; _ -> 0))

-- | The series of order @n@ whose first coefficients are those of the list @cs@; the others are 0.
fromList :: Int -> [Double] -> PowerSeries
fromList n cs = PowerSeries (Unboxed.fromListN (n + 1) (take (n + 1) (cs <> repeat 0)))

-- | The series of order @n@ whose first coefficients are those of the vector @cs@; the others are
-- 0.
fromVector :: Int -> Vector Double -> PowerSeries
fromVector n cs
  | Unboxed.length cs > n = PowerSeries (Unboxed.take (n + 1) cs)
  | otherwise = PowerSeries (cs <> Unboxed.replicate (n + 1 - Unboxed.length cs) 0)

-- | The coefficients from c₀ on.
coefficients :: PowerSeries -> [Double]
coefficients (PowerSeries a) = Unboxed.toList a

-- | The order of a series, from 0: the index of its last coefficient.
order :: PowerSeries -> Int
order (PowerSeries a) = Unboxed.length a - 1

-- | The value of the function at u₀, which is the coefficient c₀.
value :: PowerSeries -> Double
value = coefficient 0

-- | The coefficient with the index @k@, from 0. It is 0 for an index above the order of the series.
coefficient :: Int -> PowerSeries -> Double
coefficient k (PowerSeries a)
  | k < Unboxed.length a = Unboxed.unsafeIndex a k
  | otherwise = 0

-- | The sum of two series.
add :: PowerSeries -> PowerSeries -> PowerSeries
add (PowerSeries a) (PowerSeries b) = PowerSeries (Unboxed.zipWith (+) a b)

-- | The first series less the second.
subtract :: PowerSeries -> PowerSeries -> PowerSeries
subtract (PowerSeries a) (PowerSeries b) = PowerSeries (Unboxed.zipWith (-) a b)

-- | The product of the number @k@ and a series.
scale :: Double -> PowerSeries -> PowerSeries
scale k (PowerSeries a) = PowerSeries (Unboxed.map (k *) a)

-- | The sum of the number @c@ and a series.
plusConstant :: Double -> PowerSeries -> PowerSeries
plusConstant c (PowerSeries a) = PowerSeries (Unboxed.imap (\k v -> if k == 0 then c + v else v) a)

-- | The series in the parameter @t@ of @f(u₀ + k·t)@, given that of @f(u₀ + t)@.
stretched :: Double -> PowerSeries -> PowerSeries
stretched k (PowerSeries a) =
  PowerSeries (Unboxed.zipWith (*) a (Unboxed.iterateN (Unboxed.length a) (k *) 1))

-- | The product of two series: the Cauchy product of their coefficients.
multiply :: PowerSeries -> PowerSeries -> PowerSeries
multiply (PowerSeries a) (PowerSeries b) =
  PowerSeries (Unboxed.generate n (\k -> summed 0 k (\j -> at a j * at b (k - j))))
  where
    n = min (Unboxed.length a) (Unboxed.length b)

-- | The quotient of two series: @q_k = (a_k − Σ_{j≥1} b_j·q_{k−j}) / b_0@. The value @b_0@ of the
-- divisor must not be 0.
divide :: PowerSeries -> PowerSeries -> PowerSeries
divide (PowerSeries a) (PowerSeries b) = PowerSeries (Unboxed.constructN n next)
  where
    n = min (Unboxed.length a) (Unboxed.length b)
    next q =
      let k = Unboxed.length q in (at a k - summed 1 k (\j -> at b j * at q (k - j))) / at b 0

-- | The power @p = w^α@ of a series w whose value is positive; @alpha@ is the real exponent α. The
-- equation @w·p′ = α·w′·p@ gives @p_k = Σ_{j≥1} (α·j − (k − j))·w_j·p_{k−j} / (k·w_0)@.
power :: Double -> PowerSeries -> PowerSeries
power alpha (PowerSeries w) = PowerSeries (Unboxed.constructN (Unboxed.length w) next)
  where
    first = root (at w 0)
    next p = case Unboxed.length p of
      0 -> first
      k ->
        summed 1 k (\j -> (alpha * fromIntegral j - fromIntegral (k - j)) * at w j * at p (k - j))
          / (fromIntegral k * at w 0)
    root v
      | alpha == 0.5 = sqrt v
      | alpha == -0.5 = 1 / sqrt v
      | otherwise = v ** alpha

-- | The sine of a series whose value is an angle in radians.
sine :: PowerSeries -> PowerSeries
sine a = let (s, _) = circular a in s

-- | The cosine of a series whose value is an angle in radians.
cosine :: PowerSeries -> PowerSeries
cosine a = let (_, c) = circular a in c

-- | The tangent of a series whose value is an angle in radians. The cosine of this angle is not 0.
tangent :: PowerSeries -> PowerSeries
tangent a = let (s, c) = circular a in divide s c

-- | The sine and the cosine of a series: @s_k = Σ_{j≥1} j·a_j·c_{k−j} / k@ and
-- @c_k = −Σ_{j≥1} j·a_j·s_{k−j} / k@.
circular :: PowerSeries -> (PowerSeries, PowerSeries)
circular (PowerSeries a) = (PowerSeries (Unboxed.map fst both), PowerSeries (Unboxed.map snd both))
  where
    both = Unboxed.constructN (Unboxed.length a) next
    next found = case Unboxed.length found of
      0 -> (sin (at a 0), cos (at a 0))
      k ->
        let weighted part =
              summed 1 k (\j -> fromIntegral j * at a j * part (Unboxed.unsafeIndex found (k - j)))
                / fromIntegral k
         in (weighted snd, negate (weighted fst))

-- | The derivative of a series, of one order less. A series of order 0 does not determine its
-- derivative; the result is then 0.
derivative :: PowerSeries -> PowerSeries
derivative (PowerSeries a)
  | Unboxed.length a <= 1 = PowerSeries (Unboxed.singleton 0)
  | otherwise = PowerSeries (Unboxed.imap (\k v -> fromIntegral (k + 1) * v) (Unboxed.drop 1 a))

-- | The integral that has the value @c@ at u₀. Its order is higher by one.
integral :: Double -> PowerSeries -> PowerSeries
integral c (PowerSeries a) =
  PowerSeries (Unboxed.cons c (Unboxed.imap (\k v -> v / fromIntegral (k + 1)) a))

-- | The value of a polynomial for a series as its argument, by Horner's method. @cs@ are the
-- coefficients of the polynomial, the constant first.
polynomial :: [Double] -> PowerSeries -> PowerSeries
polynomial cs a = foldr (\c rest -> plusConstant c (multiply rest a)) (constant (order a) 0) cs

-- | The sum of @f@ over the integers from @from@ to @to@; 0 if @to@ is less than @from@.
summed :: Int -> Int -> (Int -> Double) -> Double
summed from to f = go 0 from
  where
    go acc j
      | j > to = acc
      | otherwise = go (acc + f j) (j + 1)
{-# INLINE summed #-}

-- | The element at an index, unchecked. The loops of this module keep the index in range.
at :: Vector Double -> Int -> Double
at = Unboxed.unsafeIndex
{-# INLINE at #-}
