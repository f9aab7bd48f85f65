-- | Polynomials in Bernstein form: @Σ b_i·C(p, i)·t^i·(1 − t)^(p − i)@ with the degree p.
--
-- The coefficients b are those of a Bézier curve's control points. De Casteljau's algorithm
-- evaluates them by convex combinations. For a parameter from 0 to 1 its rounding error is at most
-- about @2·p·10⁻¹⁶@ of the largest coefficient. In powers of t it would grow like 3^p: the powers
-- have coefficients of both signs up to @C(p, i)·2^i@ times as large (Farin, "Curves and Surfaces
-- for CAGD", sections 4.2 and 5.1).
module Geometry.Numeric.Bernstein
  ( Bernstein,
    degree,
    series,
    powers,
    from,
  )
where

import Control.Monad (forM_)
import Control.Monad.ST (ST, runST)
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Unboxed
import Data.Vector.Unboxed.Mutable qualified as Mutable
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries

-- | Coefficients of a polynomial in Bernstein form, one more than its degree; at least one.
type Bernstein = Vector Double

-- | Degree as which the polynomial is written, from 0.
degree :: Bernstein -> Int
degree b = Unboxed.length b - 1

-- | Power series of a polynomial about the parameter @t@, up to the power @n@.
series :: Int -> Bernstein -> Double -> PowerSeries
series n b t = PowerSeries.fromVector n (taylor n b t)

-- | Coefficients of the powers of the parameter, from the constant on, up to the degree.
powers :: Bernstein -> [Double]
powers b = Unboxed.toList (taylor (degree b) b 0)

-- | Taylor coefficients about @t@, from the constant on, up to the power @n@ or the degree. After
-- p − k steps of de Casteljau's algorithm k + 1 numbers are left; coefficient k is their k-th
-- forward difference times @C(p, k)@.
taylor :: Int -> Bernstein -> Double -> Vector Double
taylor n b t = runST $ do
  left <- Unboxed.thaw b
  forM_ [p, p - 1 .. m + 1] (casteljau t left)
  found <- Mutable.new (m + 1)
  forM_ [m, m - 1 .. 0] $ \k -> do
    d <- difference left k
    Mutable.write found k (binomial p k * d)
    casteljau t left k
  Unboxed.unsafeFreeze found
  where
    p = degree b
    m = max 0 (min n p)

-- | One step of de Casteljau's algorithm at the parameter @t@: @k@ numbers take the place of the
-- first @k + 1@.
casteljau :: Double -> Mutable.MVector s Double -> Int -> ST s ()
casteljau t left k = go 0
  where
    go i
      | i >= k = pure ()
      | otherwise = do
        a <- Mutable.unsafeRead left i
        c <- Mutable.unsafeRead left (i + 1)
        Mutable.unsafeWrite left i ((1 - t) * a + t * c)
        go (i + 1)

-- | Forward difference of the order @k@ of the first @k + 1@ numbers:
-- @Σ (−1)^(k − j)·C(k, j)·b_j@.
difference :: Mutable.MVector s Double -> Int -> ST s Double
difference left k = go 0 (if even k then 1 else -1) 0
  where
    go j c acc
      | j > k = pure acc
      | otherwise = do
        v <- Mutable.unsafeRead left j
        go (j + 1) (-c * fromIntegral (k - j) / fromIntegral (j + 1)) (acc + c * v)

-- | Binomial coefficient @C(p, k)@, exact for the degrees in use.
binomial :: Int -> Int -> Double
binomial p k = go 1 1
  where
    go :: Int -> Double -> Double
    go j acc
      | j > k = acc
      | otherwise = go (j + 1) (acc * fromIntegral (p - k + j) / fromIntegral j)

-- | Polynomial on the part from the parameter @t@ to 1, with a new parameter from 0 to 1.
from :: Double -> Bernstein -> Bernstein
from t b = Unboxed.generate (p + 1) (\i -> PowerSeries.value (series 0 (Unboxed.drop i b) t))
  where
    p = degree b
