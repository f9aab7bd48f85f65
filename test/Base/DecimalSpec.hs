-- | Laws of numbers that are written as text and parsed again.
module Base.DecimalSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit (..), Mm (..))
import Data.Char (isDigit)
import Data.Text qualified as Text
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck

spec :: Spec
spec = do
  describe "exact" $ do
    -- Catches an error in the last bit, of 'Decimal.exact' or of 'Decimal.parse'.
    prop "is parsed as the same number" $
      forAll anyNumber $ \x ->
        Decimal.parse (Text.dropWhile (== '-') (Decimal.exact x)) === Just (abs x)
    prop "has no exponent and no minus zero" $
      forAll anyNumber $ \x ->
        Text.all (\c -> isDigit c || c `elem` ("-." :: String)) (Decimal.exact x)
    it "is as short as possible" $
      map Decimal.exact [0, -0.0, 0.1, 59.3, -2.5, 1e-3, 100, 1 / 3]
        `shouldBe` ["0", "0", "0.1", "59.3", "-2.5", "0.001", "100", "0.3333333333333333"]
    it "rounds a number with more digits than a program allows" $
      (Decimal.parse (Decimal.exact 1e-30), Decimal.exact 5e-324) `shouldBe` (Just 1e-30, "0")
  describe "distinctIn" $ do
    it
      "has enough decimals to tell two lengths apart (catches the report that 3 mm do not fit into \
      \a radius of 3 mm)"
      $ [ Decimal.distinctIn Millimetres (Mm 3) (Mm x)
          | x <- [2.5, 3, 2.9999, 2.99999, 3.000004, 3 - 1e-12]
        ]
        `shouldBe` ["2.5 mm", "3 mm", "2.9999 mm", "2.99999 mm", "3.000004 mm", "3 mm"]
  describe "parse" $ do
    it "is the nearest double, whatever the number of digits" $
      map
        Decimal.parse
        [ "0.1",
          "0.3",
          "2.675",
          "9007199254740993",
          "0.30000000000000004",
          "123456789.123456789123456789"
        ]
        `shouldBe` map
          Just
          [0.1, 0.3, 2.675, 9007199254740992, 0.30000000000000004, 123456789.12345679]
    it "is nothing for what is no number" $
      map Decimal.parse ["", ".", ".5", "5.", "1.2.3", "1e3", "-1", "+1", "1,5", "٣"]
        `shouldBe` replicate 10 Nothing
  where
    anyNumber =
      oneof
        [ choose (-1000, 1000),
          (\m e -> fromIntegral (m :: Int) * 10 ^^ (e :: Int))
            <$> choose (-99999, 99999) <*> choose (-6, 6),
          (\m e -> m * 10 ^^ (e :: Int)) <$> choose (-1, 1) <*> choose (-12, 15)
        ] ::
        Gen Double
