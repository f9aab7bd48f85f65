-- | Power series against identities of functions and against derivatives found by differences.
module Geometry.SeriesSpec (spec) where

import Geometry.Series (Series)
import Geometry.Series qualified as Series
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "power series" $ do
    it "a quotient times its divisor is the dividend (catches a term of the recurrence that is left out)" $
      property $
        forAll ((,) <$> series <*> positive) $ \(a, b) -> Series.multiply (Series.divide a b) b `alike` a
    it "powers add in their exponents (catches a weight without its α)" $
      property $
        forAll ((,,) <$> positive <*> choose (-2, 2) <*> choose (-2, 2)) $ \(a, p, q) ->
          Series.multiply (Series.power p a) (Series.power q a) `alike` Series.power (p + q) a
    it "the square of a root is the whole (catches a weight α·j − (k − j) with a wrong sign)" $
      property $
        forAll positive $ \a -> Series.multiply (Series.power 0.5 a) (Series.power 0.5 a) `alike` a
    it "sin² + cos² is 1 (catches a sign of the two recurrences)" $
      property $
        forAll series $ \a ->
          Series.add (Series.multiply (Series.sine a) (Series.sine a)) (Series.multiply (Series.cosine a) (Series.cosine a))
            `alike` Series.constant (Series.order a) 1
    it "the derivative of a sine is the cosine times the inner derivative (catches a factor j that is left out)" $
      property $
        forAll series $ \a -> Series.derivative (Series.sine a) `alike` Series.multiply (Series.cosine a) (Series.derivative a)
    it "the tangent has the derivative 1 + tan²" $
      property $
        forAll (Series.plusConstant 0 <$> series) $ \a ->
          abs (cos (Series.value a)) > 0.2
            ==> let t = Series.tangent a
                 in Series.derivative t `alike` Series.multiply (Series.plusConstant 1 (Series.multiply t t)) (Series.derivative a)
    it "the derivative of the integral is the whole" $
      property $
        forAll ((,) <$> series <*> choose (-3, 3)) $ \(a, c) ->
          Series.derivative (Series.integral c a) `alike` a .&&. Series.value (Series.integral c a) === c
    it "a polynomial of a series has the values of the polynomial (catches coefficients in the wrong order)" $
      property $
        forAll ((,) <$> series <*> vectorOf 4 (choose (-2, 2))) $ \(a, cs) ->
          let squares = Series.multiply a a
              byHand = foldr1 Series.add (zipWith Series.scale cs [Series.constant (Series.order a) 1, a, squares, Series.multiply squares a])
           in Series.polynomial cs a `alike` byHand

series :: Gen Series
series = do
  n <- choose (1, 6)
  Series.fromList n <$> vectorOf (n + 1) (choose (-1.5, 1.5))

-- | Above zero at the place, and as long as any other.
positive :: Gen Series
positive = Series.plusConstant 2.5 . Series.fromList 6 <$> vectorOf 7 (choose (-1, 1))

-- | Equal as far as both are known.
alike :: Series -> Series -> Property
alike a b = conjoin (zipWith near (Series.coefficients a) (Series.coefficients b))
  where
    near p q = counterexample (show (a, b)) (abs (p - q) <= 1e-9 * (1 + abs p + abs q))
