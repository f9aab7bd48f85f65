-- | Files with random damage: bytes that are changed, dropped or doubled, lines that are exchanged,
-- numbers that are replaced, and ends that are cut off.
module Generate.Damage
  ( damaged,
  )
where

import Data.ByteString (ByteString)
import Data.ByteString.Char8 qualified as Bytes
import Data.Char (isDigit)
import Test.QuickCheck

-- | A file with one to three damages.
damaged :: ByteString -> Gen ByteString
damaged bytes = choose (1, 3 :: Int) >>= go bytes
  where
    go text n = if n == 0 then pure text else damage text >>= \t -> go t (n - 1)

damage :: ByteString -> Gen ByteString
damage text =
  frequency
    [ (1, byte),
      (1, cut),
      (1, Bytes.take <$> position <*> pure text),
      (1, exchanged),
      (6, replaced),
      (2, dropped),
      (1, repeated)
    ]
  where
    position = choose (0, Bytes.length text)
    byte = do
      (before, after) <- split
      c <- oneof [elements "\n\r <>\"&;-.eE0129%\NUL\255", arbitrary]
      pure (before <> Bytes.cons c (Bytes.drop 1 after))
    cut = do
      (before, after) <- split
      n <- choose (1, 40)
      pure (before <> Bytes.drop n after)
    split = (`Bytes.splitAt` text) <$> position
    exchanged = do
      let rows = Bytes.split '\n' text
          count = length rows
      i <- choose (0, count - 1)
      j <- choose (0, count - 1)
      pure (Bytes.intercalate "\n" [pick rows i j k row | (k, row) <- zip [0 ..] rows])
    pick rows i j k row
      | k == i = rows !! j
      | k == j = rows !! i
      | otherwise = row
    -- two or four lines are dropped, so that codes and values of a DXF file stay apart
    dropped = do
      let rows = Bytes.split '\n' text
      i <- choose (0, length rows - 1)
      n <- elements [2, 4]
      pure (Bytes.intercalate "\n" (take i rows <> drop (i + n) rows))
    -- the number at or after a random position is replaced by another one
    replaced = do
      (before, after) <- split
      let (blank, rest) = Bytes.break isDigit after
      number <- elements strange
      pure (before <> blank <> number <> Bytes.dropWhile isNumber rest)
    isNumber c = isDigit c || c `elem` (".eE+-" :: String)
    repeated = do
      (before, after) <- split
      n <- choose (1, 200)
      pure (before <> Bytes.take n after <> after)

-- | Numbers that a program has to expect in a damaged file.
strange :: [ByteString]
strange =
  [ "inf",
    "-inf",
    "nan",
    "1e999",
    "-1e999",
    "1e-999",
    "1e308",
    "0",
    "-0",
    "-1",
    "1",
    "999",
    "1000000",
    "2147483648",
    "-9223372036854775809",
    "99999999999999999999999999999999",
    "0.00000000000000000000000000000001",
    "1e9",
    "1,5",
    "0x10",
    ""
  ]
