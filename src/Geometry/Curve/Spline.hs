-- | Cubic splines through a table of numbers, with continuous second derivatives.
--
-- The second derivatives solve a tridiagonal system by the Thomas algorithm (Gaussian elimination
-- without pivoting). The numbers have any unit; in this product they are mm or radians.
module Geometry.Curve.Spline
  ( -- * One cubic
    Cubic (..),
    coefficients,
    controls,
    line,
    value,
    rate,
    series,
    reversed,

    -- * Vectors of cubics
    Cubics,
    generate,
    count,
    at,

    -- * Interpolation
    Boundary (..),
    interpolate,
    parabolas,
  )
where

import Control.Monad.ST (ST)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Data.Vector.Unboxed qualified as Unboxed
import Data.Vector.Unboxed.Mutable qualified as Mutable
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries

-- | Cubic @c₀ + c₁·t + c₂·t² + c₃·t³@ by its coefficients; t is the local parameter from 0 to 1.
data Cubic = Cubic Double Double Double Double
  deriving stock (Eq, Show)

-- | The four coefficients of a cubic in the order of ascending powers.
coefficients :: Cubic -> [Double]
coefficients (Cubic a b c d) = [a, b, c, d]

-- | The four Bernstein coefficients of a cubic: those of its control points.
controls :: Cubic -> [Double]
controls (Cubic a b c d) = [a, a + b / 3, a + (2 * b + c) / 3, a + b + c + d]

-- | Cubic that is a linear function with the value @p@ at 0 and @q@ at 1.
line :: Double -> Double -> Cubic
line p q = Cubic p (q - p) 0 0

-- | Value of a cubic at the local parameter @t@.
value :: Cubic -> Double -> Double
value (Cubic a b c d) t = a + t * (b + t * (c + t * d))

-- | First derivative of a cubic at the local parameter @t@.
rate :: Cubic -> Double -> Double
rate (Cubic _ b c d) t = b + t * (2 * c + 3 * t * d)

-- | Power series of a cubic about the local parameter @t@, up to the power @n@.
series :: Int -> Cubic -> Double -> PowerSeries
series n (Cubic a b c d) t =
  PowerSeries.cubic
    n
    (a + t * (b + t * (c + t * d)))
    (b + t * (2 * c + 3 * t * d))
    (c + 3 * t * d)
    d

-- | Cubic c(1 − t) for a cubic c(t), for a curve in the opposite direction.
reversed :: Cubic -> Cubic
reversed (Cubic a b c d) = Cubic (a + b + c + d) (-(b + 2 * c + 3 * d)) (c + 3 * d) (-d)

-- | Vector of cubics, stored as four coefficients for each one.
newtype Cubics = Cubics (Unboxed.Vector Double)
  deriving newtype (Eq, Show)

-- | Vector of @n@ cubics, each made from its index, which is counted from 0.
generate :: Int -> (Int -> Cubic) -> Cubics
generate n cubic = Cubics $
  Unboxed.create $ do
    array <- Mutable.unsafeNew (4 * n)
    let go i
          | i >= n = pure array
          | otherwise = case cubic i of
            Cubic a b c d -> do
              Mutable.unsafeWrite array (4 * i) a
              Mutable.unsafeWrite array (4 * i + 1) b
              Mutable.unsafeWrite array (4 * i + 2) c
              Mutable.unsafeWrite array (4 * i + 3) d
              go (i + 1)
    go 0
{-# INLINE generate #-}

-- | Count of cubics in a vector.
count :: Cubics -> Int
count (Cubics array) = Unboxed.length array `div` 4

-- | Cubic at index @i@, counted from 0. The index is not checked; it must be below the count.
at :: Cubics -> Int -> Cubic
at (Cubics array) i = Cubic (coefficient 0) (coefficient 1) (coefficient 2) (coefficient 3)
  where
    coefficient k = Unboxed.unsafeIndex array (4 * i + k)
{-# INLINE at #-}

-- | Condition at both ends of a spline.
data Boundary
  = -- | zero second derivatives at both ends
    Natural
  | -- | the given first derivatives with respect to the spline's parameter, at the start and at the
    -- end
    Clamped Double Double
  | -- | the same first and second derivatives at both ends; the last value must equal the first
    Periodic
  deriving stock (Eq, Show)

-- | Spline through @values@. @steps@ are the differences between the parameters of consecutive
-- values: one fewer than the values, and all above 0. A periodic spline needs at least three steps,
-- any other at least one. The result has a cubic for each step, with a local parameter from 0 to 1.
interpolate :: Boundary -> Unboxed.Vector Double -> Unboxed.Vector Double -> Cubics
interpolate boundary steps values = generate (Unboxed.length steps) cubic
  where
    second = secondDerivatives boundary steps values
    -- The names are h for the step, p and q for the values at its ends, and m and m' for the second
    -- derivatives at its ends.
    cubic i = Cubic p (q - p - h * h * (2 * m + m') / 6) (h * h * m / 2) (h * h * (m' - m) / 6)
      where
        h = Unboxed.unsafeIndex steps i
        p = Unboxed.unsafeIndex values i
        q = Unboxed.unsafeIndex values (i + 1)
        m = Unboxed.unsafeIndex second i
        m' = Unboxed.unsafeIndex second (i + 1)

-- | One equation of a tridiagonal system: the coefficients below, on and above the diagonal, and
-- the right-hand side.
data Row = Row Double Double Double Double

-- | Second derivatives M at all values. Let h be the steps and Δ the slopes from each value to the
-- next. The first derivative is continuous if
-- @h_{i−1}·M_{i−1} + 2·(h_{i−1} + h_i)·M_i + h_i·M_{i+1} = 6·(Δ_i − Δ_{i−1})@.
secondDerivatives ::
  Boundary ->
  Unboxed.Vector Double ->
  Unboxed.Vector Double ->
  Unboxed.Vector Double
secondDerivatives boundary steps values = case boundary of
  Natural ->
    Unboxed.concat
      [Unboxed.singleton 0, tridiagonal (n - 1) (\i -> inner (i + 1)), Unboxed.singleton 0]
  Clamped from to ->
    tridiagonal (n + 1) $ \i ->
      if i == 0
        then Row 0 (2 * step 0) (step 0) (6 * (rise 0 - from))
        else
          if i == n
            then Row (step (n - 1)) (2 * step (n - 1)) 0 (6 * (to - rise (n - 1)))
            else inner i
  Periodic ->
    let m =
          cyclic
            n
            (\i -> if i == 0 then row (step (n - 1)) (step 0) (rise (n - 1)) (rise 0) else inner i)
     in Unboxed.snoc m (Unboxed.unsafeIndex m 0)
  where
    n = Unboxed.length steps
    step = Unboxed.unsafeIndex steps
    rise i = (Unboxed.unsafeIndex values (i + 1) - Unboxed.unsafeIndex values i) / step i
    inner i = row (step (i - 1)) (step i) (rise (i - 1)) (rise i)
    row h h' slope slope' = Row h (2 * (h + h')) h' (6 * (slope' - slope))

-- | Solution of a tridiagonal system of @n@ equations; @row@ gives the equation with an index from
-- 0. Pivoting is not needed, because the matrix of a spline is diagonally dominant.
tridiagonal :: Int -> (Int -> Row) -> Unboxed.Vector Double
tridiagonal n row = Unboxed.create $ do
  superDiagonal <- Mutable.unsafeNew (max 0 n)
  solved <- Mutable.unsafeNew (max 0 n)
  eliminate superDiagonal solved 0 0 0
  pure solved
  where
    eliminate ::
      Mutable.MVector s Double ->
      Mutable.MVector s Double ->
      Int ->
      Double ->
      Double ->
      ST s ()
    eliminate superDiagonal solved i c' d'
      | i >= n = substitute superDiagonal solved (n - 1) 0
      | otherwise = case row i of
        Row a b c d -> do
          let pivot = b - a * c'
              c'' = c / pivot
              d'' = (d - a * d') / pivot
          Mutable.unsafeWrite superDiagonal i c''
          Mutable.unsafeWrite solved i d''
          eliminate superDiagonal solved (i + 1) c'' d''
    substitute :: Mutable.MVector s Double -> Mutable.MVector s Double -> Int -> Double -> ST s ()
    substitute superDiagonal solved i next
      | i < 0 = pure ()
      | otherwise = do
        c <- Mutable.unsafeRead superDiagonal i
        d <- Mutable.unsafeRead solved i
        let m = d - c * next
        Mutable.unsafeWrite solved i m
        substitute superDiagonal solved (i - 1) m
{-# INLINE tridiagonal #-}

-- | Solution of a cyclic tridiagonal system of @n@ equations: the first equation also contains the
-- last unknown, and the last equation the first unknown. The two elements in the corners of the
-- matrix are treated as a change of rank one (Sherman–Morrison).
cyclic :: Int -> (Int -> Row) -> Unboxed.Vector Double
cyclic n row = Unboxed.zipWith (\x z -> x - factor * z) plain corner
  where
    Row beta firstDiagonal _ _ = row 0
    Row _ _ alpha _ = row (n - 1)
    gamma = -firstDiagonal
    perturbed i (Row a b c d)
      | i == 0 = Row 0 (b - gamma) c d
      | i == n - 1 = Row a (b - alpha * beta / gamma) 0 d
      | otherwise = Row a b c d
    plain = tridiagonal n (\i -> perturbed i (row i))
    corner = tridiagonal n (\i -> perturbed i (column i (row i)))
    column i (Row a b c _) = Row a b c (if i == 0 then gamma else if i == n - 1 then alpha else 0)
    weighted v = Unboxed.head v + beta * Unboxed.last v / gamma
    factor = weighted plain / (1 + weighted corner)
{-# INLINE cyclic #-}

-- | Parabolas (Lagrange) through values 1–3, 3–5, and so on. @fractions@ has, for each parabola,
-- the local parameter from 0 to 1 of its middle value. The count of values is odd.
parabolas :: Vector Double -> Unboxed.Vector Double -> Cubics
parabolas fractions values =
  generate (Vector.length fractions) (\i -> parabola i (fractions Vector.! i))
  where
    parabola i f = Cubic p (first - f * second) second 0
      where
        p = values Unboxed.! (2 * i)
        q = values Unboxed.! (2 * i + 1)
        r = values Unboxed.! (2 * i + 2)
        first = (q - p) / f
        second = (r - q) / (1 - f) - first
