-- | Laws of the numbers and texts of exported drawings.
module Export.CoordinateSpec (spec) where

import Data.Char (isDigit)
import Data.Text (Text)
import Data.Text qualified as Text
import Export.Coordinate qualified as Coordinate
import Export.DxfGroup qualified as DxfGroup
import Export.UniqueName qualified as UniqueName
import Numeric (readHex)
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "numbers and names of drawings" $ do
  it "are read back as the same number, without an exponent (catches a rounded number)" $
    forAll number $ \x ->
      let text = Text.unpack (Coordinate.text x)
       in counterexample text $
            read (dotted text) == x && all (\c -> isDigit c || c `elem` ("-." :: String)) text
  it "survive the code page of a DXF file (catches a code of fewer than four digits)" $
    forAll word $ \text ->
      let written = DxfGroup.escaped text
       in counterexample (Text.unpack written) $
            Text.all (< '\DEL') written && unescaped written == text
  it "are made different (catches a name that is given twice)" $
    forAll (listOf (elements ["a", "A", "b", "a-2", "A-2", "отверстие", "ОТВЕРСТИЕ"])) $ \names ->
      let made = UniqueName.distinguished ["b"] names
          folded = map Text.toCaseFold ("b" : made)
       in counterexample (show made) $
            length made == length names
              && and [a `Text.isPrefixOf` b | (a, b) <- zip names made]
              && distinct folded
  where
    -- Haskell reads a number with a point only if digits surround it.
    dotted text = if '.' `elem` text then text else text <> ".0"
    distinct names = and [a /= b | (k, a) <- zip [0 :: Int ..] names, b <- drop (k + 1) names]

-- | Coordinates of drawings: lengths up to 1 km, small ones, and numbers of many digits.
number :: Gen Double
number =
  oneof
    [ choose (-1e6, 1e6),
      (/ 1000) . fromIntegral <$> choose (-1000000, 1000000 :: Int),
      (*) <$> choose (-1, 1) <*> elements [1e-3, 1e-7, 1e-12],
      (*) <$> choose (-1, 1) <*> elements [1e15, 1e20],
      elements [0, 1, -1, 25.4, 1 / 3]
    ]

-- | Names in the letters of programs, and other characters.
word :: Gen Text
word = Text.pack <$> listOf (elements "aZ_09яЖё×é\\😀ſ")

-- | The text that a program reads from an escaped one.
unescaped :: Text -> Text
unescaped text = Text.pack (joined (units (Text.unpack text)))
  where
    units t = case t of
      '\\' : 'U' : '+' : a : b : c : d : more | [(n, "")] <- readHex [a, b, c, d] -> n : units more
      c : more -> fromEnum c : units more
      [] -> []
    joined us = case us of
      a : b : more
        | a >= 0xD800 && a < 0xDC00 ->
          toEnum (0x10000 + (a - 0xD800) * 0x400 + b - 0xDC00) : joined more
      a : more -> toEnum a : joined more
      [] -> []
