-- | Groups, of which a DXF file consists: a code, which says what a value means, and the value.
-- Autodesk, "DXF Reference", lists the codes.
module Export.DxfGroup
  ( DxfGroup,
    Handle (..),
    word,
    name,
    integer,
    real,
    handle,
    place,
    render,
    escaped,
  )
where

import Base.Decimal qualified as Decimal
import Data.Char (isControl, ord)
import Data.Text (Text)
import Data.Text qualified as Text
import Export.Coordinate qualified as Coordinate
import Numeric (showHex)

-- | A code with the text of its value.
data DxfGroup = DxfGroup Int Text
  deriving stock (Eq, Show)

-- | The number by which the objects of a file refer to each other, above 0.
newtype Handle = Handle Int
  deriving newtype (Eq, Ord, Enum)
  deriving stock (Show)

-- | A group with a word of the format, in ASCII.
word :: Int -> Text -> DxfGroup
word = DxfGroup

-- | A group with a name or another text of the program.
name :: Int -> Text -> DxfGroup
name code = DxfGroup code . escaped

-- | A group with a whole number.
integer :: Int -> Int -> DxfGroup
integer code = DxfGroup code . Decimal.whole

-- | A group with a real number. It has a point, as in files of AutoCAD.
real :: Int -> Double -> DxfGroup
real code x = DxfGroup code (if Text.any (== '.') digits then digits else digits <> ".0")
  where
    digits = Coordinate.text x

-- | A group with a handle: the handle of an object itself, or that of another one.
handle :: Int -> Handle -> DxfGroup
handle code (Handle n) = DxfGroup code (Text.toUpper (Text.pack (showHex n "")))

-- | The groups of a point, by the code of its x: code + 10 is that of y, and code + 20 that of z.
place :: Int -> (Double, Double, Double) -> [DxfGroup]
place code (x, y, z) = [real code x, real (code + 10) y, real (code + 20) z]

-- | The text of groups: two lines for each, the code and the value.
render :: [DxfGroup] -> Text
render groups =
  Text.unlines (concat [[Text.justifyRight 3 ' ' (Decimal.whole c), v] | DxfGroup c v <- groups])

-- | A text in ASCII. Any other character is written as @\\U+@ and the four hexadecimal digits of
-- its UTF-16 unit, so that it does not depend on the code page of the file; so is a backslash. A
-- control character becomes a space.
escaped :: Text -> Text
escaped = Text.concatMap one
  where
    one c
      | isControl c = " "
      | ord c < 128 && c /= '\\' = Text.singleton c
      | ord c < 0x10000 = unit16 (ord c)
      | otherwise =
        let n = ord c - 0x10000
         in unit16 (0xD800 + n `div` 0x400) <> unit16 (0xDC00 + n `mod` 0x400)
    unit16 n = "\\U+" <> Text.toUpper (Text.justifyRight 4 '0' (Text.pack (showHex n "")))
