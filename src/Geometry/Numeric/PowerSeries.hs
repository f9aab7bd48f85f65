-- | Truncated power series: what a function of a parameter is near one place, as the coefficients
-- of
-- @f(u₀ + t) = c₀ + c₁·t + c₂·t² + …@ up to some order. Sums, products, roots and sines of
--  functions are worked
-- out on the coefficients, so that derivatives of whatever is composed of them are exact but for
-- rounding.
--
-- The k-th coefficient is the k-th derivative divided by k!. What comes of two series is as long as
-- the shorter one.
module Geometry.Numeric.PowerSeries
  ( PowerSeries,
    constant,
    ofFour,
    fromList,
    coefficients,
    order,
    value,
    coefficient,
    add,
    subtract,
    scale,
    plusConstant,
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

-- | At least one coefficient.
newtype PowerSeries = PowerSeries (Vector Double)
  deriving stock (Eq, Show)

-- | The same everywhere, up to an order.
constant :: Int -> Double -> PowerSeries
constant n c = PowerSeries (Unboxed.generate (n + 1) (\k -> if k == 0 then c else 0))

-- | Four coefficients, up to an order; those behind them are zero.
ofFour :: Int -> Double -> Double -> Double -> Double -> PowerSeries
ofFour n a b c d =
  PowerSeries (Unboxed.generate (n + 1) (\case 0 -> a; 1 -> b; 2 -> c; 3 -> d; _ -> 0))

-- | The first coefficients, up to an order; those that are not named are zero.
fromList :: Int -> [Double] -> PowerSeries
fromList n cs = PowerSeries (Unboxed.fromListN (n + 1) (take (n + 1) (cs <> repeat 0)))

coefficients :: PowerSeries -> [Double]
coefficients (PowerSeries a) = Unboxed.toList a

-- | The number of the last coefficient.
order :: PowerSeries -> Int
order (PowerSeries a) = Unboxed.length a - 1

-- | The value at the place itself.
value :: PowerSeries -> Double
value = coefficient 0

-- | A coefficient by its number from 0; zero beyond the order.
coefficient :: Int -> PowerSeries -> Double
coefficient k (PowerSeries a)
  | k < Unboxed.length a = Unboxed.unsafeIndex a k
  | otherwise = 0

add :: PowerSeries -> PowerSeries -> PowerSeries
add (PowerSeries a) (PowerSeries b) = PowerSeries (Unboxed.zipWith (+) a b)

subtract :: PowerSeries -> PowerSeries -> PowerSeries
subtract (PowerSeries a) (PowerSeries b) = PowerSeries (Unboxed.zipWith (-) a b)

scale :: Double -> PowerSeries -> PowerSeries
scale k (PowerSeries a) = PowerSeries (Unboxed.map (k *) a)

-- | A constant added.
plusConstant :: Double -> PowerSeries -> PowerSeries
plusConstant c (PowerSeries a) = PowerSeries (Unboxed.imap (\k v -> if k == 0 then c + v else v) a)

multiply :: PowerSeries -> PowerSeries -> PowerSeries
multiply (PowerSeries a) (PowerSeries b) =
  PowerSeries (Unboxed.generate n (\k -> summed 0 k (\j -> at a j * at b (k - j))))
  where
    n = min (Unboxed.length a) (Unboxed.length b)

-- | The quotient: @q_k = (a_k − Σ_{j≥1} b_j·q_{k−j}) / b_0@. The divisor is not zero at the place.
divide :: PowerSeries -> PowerSeries -> PowerSeries
divide (PowerSeries a) (PowerSeries b) = PowerSeries (Unboxed.constructN n next)
  where
    n = min (Unboxed.length a) (Unboxed.length b)
    next q =
      let k = Unboxed.length q in (at a k - summed 1 k (\j -> at b j * at q (k - j))) / at b 0

-- | A real power of a series that is above zero at the place. From @w·p′ = α·w′·p@ for @p = w^α@:
-- @p_k = Σ_{j≥1} (α·j − (k − j))·w_j·p_{k−j} / (k·w_0)@.
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

sine :: PowerSeries -> PowerSeries
sine a = let (s, _) = circular a in s

cosine :: PowerSeries -> PowerSeries
cosine a = let (_, c) = circular a in c

-- | The tangent, where the cosine is not zero.
tangent :: PowerSeries -> PowerSeries
tangent a = let (s, c) = circular a in divide s c

-- | Sine and cosine together: @s_k = Σ_{j≥1} j·a_j·c_{k−j} / k@, @c_k = −Σ_{j≥1} j·a_j·s_{k−j} /
-- k@.
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

-- | The derivative, one order less. Of a series of order 0 nothing is known; that has the
-- derivative 0.
derivative :: PowerSeries -> PowerSeries
derivative (PowerSeries a)
  | Unboxed.length a <= 1 = PowerSeries (Unboxed.singleton 0)
  | otherwise = PowerSeries (Unboxed.imap (\k v -> fromIntegral (k + 1) * v) (Unboxed.drop 1 a))

-- | The integral that has this value at the place, one order more.
integral :: Double -> PowerSeries -> PowerSeries
integral c (PowerSeries a) =
  PowerSeries (Unboxed.cons c (Unboxed.imap (\k v -> v / fromIntegral (k + 1)) a))

-- | A polynomial, its coefficients from the constant on, of a series.
polynomial :: [Double] -> PowerSeries -> PowerSeries
polynomial cs a = foldr (\c rest -> plusConstant c (multiply rest a)) (constant (order a) 0) cs

-- | A sum over the numbers from the first to the last.
summed :: Int -> Int -> (Int -> Double) -> Double
summed from to f = go 0 from
  where
    go acc j
      | j > to = acc
      | otherwise = go (acc + f j) (j + 1)
{-# INLINE summed #-}

-- Every index in this module is below both lengths by the bounds of its loop.
at :: Vector Double -> Int -> Double
at = Unboxed.unsafeIndex
{-# INLINE at #-}
