-- | Interpolation of a table of numbers by piecewise cubics that are continuous up to the second derivative.
--
-- The system for the second derivatives is tridiagonal and solved in one pass forwards and one backwards.
module Geometry.Spline
  ( Cubic (..),
    coefficients,
    line,
    value,
    series,
    reversed,
    Boundary (..),
    interpolate,
    parabolas,
  )
where

import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Series (Series)
import Geometry.Series qualified as Series

-- | @c₀ + c₁·t + c₂·t² + c₃·t³@ for t from 0 to 1.
data Cubic = Cubic Double Double Double Double
  deriving stock (Eq, Show)

-- | From the constant on.
coefficients :: Cubic -> [Double]
coefficients (Cubic a b c d) = [a, b, c, d]

-- | From one value to another.
line :: Double -> Double -> Cubic
line p q = Cubic p (q - p) 0 0

value :: Cubic -> Double -> Double
value (Cubic a b c d) t = a + t * (b + t * (c + t * d))

-- | The power series about a place, up to an order.
series :: Int -> Cubic -> Double -> Series
series n (Cubic a b c d) t =
  Series.fromList n [a + t * (b + t * (c + t * d)), b + t * (2 * c + 3 * t * d), c + 3 * t * d, d]

-- | The same walked from 1 to 0.
reversed :: Cubic -> Cubic
reversed (Cubic a b c d) = Cubic (a + b + c + d) (-(b + 2 * c + 3 * d)) (c + 3 * d) (-d)

-- | What holds at the ends of a spline.
data Boundary
  = -- | the second derivative is zero
    Natural
  | -- | these first derivatives, by the parameter
    Clamped Double Double
  | -- | the end goes over into the beginning; the last value is the first
    Periodic
  deriving stock (Eq, Show)

-- | The cubics between neighbouring values, given the steps of the parameter between them (above zero, one fewer
-- than values, at least one; at least three for a periodic one). Each cubic's own parameter runs from 0 to 1.
interpolate :: Boundary -> Unboxed.Vector Double -> Unboxed.Vector Double -> Vector Cubic
interpolate boundary steps values = Vector.generate spans cubic
  where
    spans = Unboxed.length steps
    second = secondDerivatives boundary steps values
    -- With h the step and M the second derivatives at its ends.
    cubic i = Cubic p (q - p - h * h * (2 * m + m') / 6) (h * h * m / 2) (h * h * (m' - m) / 6)
      where
        h = steps Unboxed.! i
        p = values Unboxed.! i
        q = values Unboxed.! (i + 1)
        m = second Unboxed.! i
        m' = second Unboxed.! (i + 1)

-- | The second derivatives M at all values. With steps h and slopes Δ between neighbours, what makes the first
-- derivative continuous is @h_{i−1}·M_{i−1} + 2·(h_{i−1} + h_i)·M_i + h_i·M_{i+1} = 6·(Δ_i − Δ_{i−1})@.
secondDerivatives :: Boundary -> Unboxed.Vector Double -> Unboxed.Vector Double -> Unboxed.Vector Double
secondDerivatives boundary steps values = case boundary of
  Natural -> Unboxed.concat [Unboxed.singleton 0, tridiagonal inner, Unboxed.singleton 0]
  Clamped from to -> tridiagonal (Unboxed.concat [Unboxed.singleton (first from), inner, Unboxed.singleton (last' to)])
  Periodic -> let m = cyclic (Unboxed.cons joint inner) in Unboxed.snoc m (m Unboxed.! 0)
  where
    slopes = Unboxed.izipWith (\i h p -> (values Unboxed.! (i + 1) - p) / h) steps values
    inner = Unboxed.zipWith4 row steps (Unboxed.drop 1 steps) slopes (Unboxed.drop 1 slopes)
    row h h' slope slope' = (h, 2 * (h + h'), h', 6 * (slope' - slope))
    joint = row (Unboxed.last steps) (Unboxed.head steps) (Unboxed.last slopes) (Unboxed.head slopes)
    first direction = let h = Unboxed.head steps in (0, 2 * h, h, 6 * (Unboxed.head slopes - direction))
    last' direction = let h = Unboxed.last steps in (h, 2 * h, 0, 6 * (direction - Unboxed.last slopes))

-- | One equation: the factors of the unknown before, its own and the one behind, and the right side.
type Row = (Double, Double, Double, Double)

-- | Elimination without pivoting; the diagonal of a spline's system outweighs the rest of its row.
tridiagonal :: Unboxed.Vector Row -> Unboxed.Vector Double
tridiagonal rows = Unboxed.postscanr' back 0 (Unboxed.postscanl' forward (0, 0) rows)
  where
    forward (c', d') (a, b, c, d) = let pivot = b - a * c' in (c / pivot, (d - a * d') / pivot)
    back (c', d') next = d' - c' * next

-- | The same where the first row's unknown before is the last one and the last row's unknown behind the first: the
-- two corners are taken out as a matrix of rank one (Sherman and Morrison).
cyclic :: Unboxed.Vector Row -> Unboxed.Vector Double
cyclic rows = Unboxed.zipWith (\x z -> x - factor * z) plain corner
  where
    n = Unboxed.length rows
    (beta, firstDiagonal, _, _) = Unboxed.head rows
    (_, _, alpha, _) = Unboxed.last rows
    gamma = -firstDiagonal
    altered = Unboxed.imap alter rows
    alter i (a, b, c, d)
      | i == 0 = (0, b - gamma, c, d)
      | i == n - 1 = (a, b - alpha * beta / gamma, 0, d)
      | otherwise = (a, b, c, d)
    plain = tridiagonal altered
    corner = tridiagonal (Unboxed.imap column altered)
    column i (a, b, c, _)
      | i == 0 = (a, b, c, gamma)
      | i == n - 1 = (a, b, c, alpha)
      | otherwise = (a, b, c, 0)
    weighed v = Unboxed.head v + beta * Unboxed.last v / gamma
    factor = weighed plain / (1 + weighed corner)

-- | Parabolas (Lagrange) through values 1–3, 3–5, …, given where between its neighbours each middle value lies, as a
-- fraction of the parameter. The values are odd in number.
parabolas :: Vector Double -> Unboxed.Vector Double -> Vector Cubic
parabolas fractions values = Vector.imap parabola fractions
  where
    parabola i f = Cubic p (first - f * second) second 0
      where
        p = values Unboxed.! (2 * i)
        q = values Unboxed.! (2 * i + 1)
        r = values Unboxed.! (2 * i + 2)
        first = (q - p) / f
        second = (r - q) / (1 - f) - first
