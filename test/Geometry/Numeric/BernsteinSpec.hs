-- | Polynomials in Bernstein form against their definition.
module Geometry.Numeric.BernsteinSpec (spec) where

import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Numeric.Bernstein (Bernstein)
import Geometry.Numeric.Bernstein qualified as Bernstein
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  describe "polynomials in Bernstein form" $ do
    it
      "have the values of their definition (catches a step of de Casteljau's algorithm from the \
      \other end)"
      $ property $
        forAll ((,) <$> polynomial <*> choose (0, 1)) $ \(b, t) ->
          near 1e-12 (PowerSeries.value (Bernstein.series 0 b t)) (valueOf b t)
    it
      "a series of all powers gives the polynomial everywhere (catches a coefficient without its \
      \binomial factor)"
      $ property $
        forAll ((,,) <$> polynomial <*> choose (0, 1) <*> choose (0, 1)) $ \(b, t, u) ->
          let about = PowerSeries.coefficients (Bernstein.series (Bernstein.degree b + 2) b t)
              size = sum (zipWith (\c k -> abs c * abs (u - t) ^^ k) about [0 :: Int ..])
           in near
                (1e-13 * (10 + size))
                (sum (zipWith (\c k -> c * (u - t) ^^ k) about [0 :: Int ..]))
                (valueOf b u)
    it
      "the powers of a polynomial give its values (catches the binomial coefficient of another \
      \degree)"
      $ property $
        forAll ((,) <$> (polynomial `suchThat` ((<= 8) . Bernstein.degree)) <*> choose (0, 1)) $
          \(b, t) -> near 1e-10 (foldr (\c v -> c + t * v) 0 (Bernstein.powers b)) (valueOf b t)
    it "the part from a parameter on has its values (catches a part with the start of the whole)" $
      property $
        forAll ((,,) <$> polynomial <*> choose (0, 1) <*> choose (0, 1)) $ \(b, t, u) ->
          near 1e-12 (valueOf (Bernstein.from t b) u) (valueOf b (t + u * (1 - t)))
  where
    polynomial = do
      n <- choose (1, 21)
      Unboxed.fromList <$> vectorOf n (choose (-10, 10))

valueOf :: Bernstein -> Double -> Double
valueOf b t =
  sum
    [ c * fromIntegral (choices p i) * t ^ i * (1 - t) ^ (p - i)
      | (c, i) <- zip (Unboxed.toList b) [0 ..]
    ]
  where
    p = fromIntegral (Unboxed.length b - 1)
    choices :: Integer -> Integer -> Integer
    choices n k = product [n - k + 1 .. n] `div` product [1 .. k]

near :: Double -> Double -> Double -> Property
near slack a b = counterexample (show (a, b, a - b)) (abs (a - b) <= slack * 10)
