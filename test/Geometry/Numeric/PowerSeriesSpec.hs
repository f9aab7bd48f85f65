-- | Power series against identities of functions.
module Geometry.Numeric.PowerSeriesSpec (spec) where

import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "power series" $ do
    it
      "a quotient times its divisor is the dividend (catches a term of the recurrence that is left \
      \out)"
      $ property $
        forAll ((,) <$> series <*> positive) $ \(a, b) ->
          PowerSeries.multiply (PowerSeries.divide a b) b `alike` a
    it
      "a product of powers is the power with the sum of the exponents (catches a weight without \
      \its α)"
      $ property $
        forAll ((,,) <$> positive <*> choose (-2, 2) <*> choose (-2, 2)) $ \(a, p, q) ->
          PowerSeries.multiply (PowerSeries.power p a) (PowerSeries.power q a)
            `alike` PowerSeries.power (p + q) a
    it "the square of a root is the series (catches a weight α·j − (k − j) with a wrong sign)" $
      property $
        forAll positive $ \a ->
          PowerSeries.multiply (PowerSeries.power 0.5 a) (PowerSeries.power 0.5 a) `alike` a
    it "sin² + cos² is 1 (catches a sign of the two recurrences)" $
      property $
        forAll series $ \a ->
          PowerSeries.add
            (PowerSeries.multiply (PowerSeries.sine a) (PowerSeries.sine a))
            (PowerSeries.multiply (PowerSeries.cosine a) (PowerSeries.cosine a))
            `alike` PowerSeries.constant (PowerSeries.order a) 1
    it
      "the derivative of a sine is the cosine times the inner derivative (catches a factor j that \
      \is left out)"
      $ property $
        forAll series $ \a ->
          PowerSeries.derivative (PowerSeries.sine a)
            `alike` PowerSeries.multiply (PowerSeries.cosine a) (PowerSeries.derivative a)
    it "the tangent has the derivative 1 + tan²" $
      property $
        forAll (PowerSeries.plusConstant 0 <$> series) $ \a ->
          abs (cos (PowerSeries.value a)) > 0.2
            ==> let t = PowerSeries.tangent a
                 in PowerSeries.derivative t
                      `alike` PowerSeries.multiply
                        (PowerSeries.plusConstant 1 (PowerSeries.multiply t t))
                        (PowerSeries.derivative a)
    it "the derivative of the integral is the series" $
      property $
        forAll ((,) <$> series <*> choose (-3, 3)) $ \(a, c) ->
          PowerSeries.derivative (PowerSeries.integral c a) `alike` a
            .&&. PowerSeries.value (PowerSeries.integral c a) === c
    it
      "a polynomial of a series has the values of the polynomial (catches coefficients in the \
      \wrong order)"
      $ property $
        forAll ((,) <$> series <*> vectorOf 4 (choose (-2, 2))) $ \(a, cs) ->
          let squares = PowerSeries.multiply a a
              byHand =
                foldr1
                  PowerSeries.add
                  ( zipWith
                      PowerSeries.scale
                      cs
                      [ PowerSeries.constant (PowerSeries.order a) 1,
                        a,
                        squares,
                        PowerSeries.multiply squares a
                      ]
                  )
           in PowerSeries.polynomial cs a `alike` byHand

series :: Gen PowerSeries
series = do
  n <- choose (1, 6)
  PowerSeries.fromList n <$> vectorOf (n + 1) (choose (-1.5, 1.5))

-- | A series with a positive value, as long as any other.
positive :: Gen PowerSeries
positive = PowerSeries.plusConstant 2.5 . PowerSeries.fromList 6 <$> vectorOf 7 (choose (-1, 1))

-- | Equal up to the lesser order, to 10⁻⁹.
alike :: PowerSeries -> PowerSeries -> Property
alike a b = conjoin (zipWith near (PowerSeries.coefficients a) (PowerSeries.coefficients b))
  where
    near p q = counterexample (show (a, b)) (abs (p - q) <= 1e-9 * (1 + abs p + abs q))
