-- | Symbols of a tape code and their rows, as tables for writing and reading.
--
-- A code may have a parity track and a service track. A hole in the parity track makes the number
-- of holes in a row even. A hole in the service track gives a digit of a number an extra meaning,
-- such as a minus or a command, and does not change the digit. The check sum of a frame is the sum
-- of the weights of its symbols.
module Tape.Symbol
  ( Symbols (..),
    fromMachine,
    Symbol (..),
    symbol,
    digit,
    serviceDigit,
    digitWeight,
    digitAt,
    hasServiceHole,
    isOutsideTracks,
    isOdd,
    symbolAt,
    rowAfter,
  )
where

import Data.Bits (complement, popCount, setBit, shiftL, xor, (.&.), (.|.))
import Data.ByteString.Short (ShortByteString)
import Data.ByteString.Short qualified as Short
import Data.Char (intToDigit)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust)
import Data.Word (Word8)
import Machine.Machine (Machine, Medium, TapeCode)
import Machine.Machine qualified as Machine

-- | Tables of a tape code. A row is a byte, in which bit k−1 is the hole in track k.
data Symbols = Symbols
  { -- | row of each symbol, with its parity hole
    rowOf :: Map Char Word8,
    -- | weight of each symbol in a check sum; a missing symbol has the weight 0
    weightOf :: Map Char Int,
    -- | symbol of each row, the inverse of 'rowOf'
    nameOf :: Map Word8 Char,
    -- | rows of the digits 0 to 9 without a hole in the service track
    digitRows :: ShortByteString,
    -- | rows of the digits 0 to 9 with a hole in the service track
    serviceRows :: ShortByteString,
    -- | weights of the digits 0 to 9 in a check sum
    digitWeights :: ShortByteString,
    -- | digit of each of the 256 possible rows, with or without a hole in the service track;
    -- 'noDigit' for a row that is no digit
    digitOf :: ShortByteString,
    -- | byte in which only the bit of the service track is 1; 0 if the code has no such track
    service :: Word8,
    -- | byte in which the bits that belong to no track of the tape are 1
    outside :: Word8,
    -- | true if the number of holes in every row has to be even
    parity :: Bool
  }

-- | Symbol with its row (parity hole included) and its weight in a check sum.
data Symbol = Symbol {name :: Char, holes :: Word8, weight :: Int}

-- | Tables for the tape code of a machine.
fromMachine :: Machine -> Symbols
fromMachine machine =
  Symbols
    { rowOf = rows,
      weightOf = Machine.weights code,
      nameOf = Map.fromList [(w, c) | (c, w) <- Map.toList rows],
      digitRows = Short.pack (map withoutServiceHole digits),
      serviceRows = Short.pack (map withServiceHole digits),
      digitWeights =
        Short.pack [fromIntegral (Map.findWithDefault 0 c (Machine.weights code)) | c <- digits],
      digitOf = Short.pack [Map.findWithDefault noDigit w values | w <- [minBound .. maxBound]],
      service = serviceBit,
      outside = outsideMask (Machine.medium machine),
      parity = isJust (Machine.evenTrack code)
    }
  where
    code = Machine.code machine
    serviceBit = maybe 0 (\k -> setBit 0 (k - 1)) (Machine.serviceTrack code)
    rows = Map.map (withParity code) (Machine.symbols code)
    codeRow c = Map.findWithDefault 0 c (Machine.symbols code)
    withoutServiceHole c = withParity code (codeRow c .&. complement serviceBit)
    withServiceHole c = withParity code (codeRow c .|. serviceBit)
    digits = map intToDigit [0 .. 9]
    values =
      Map.fromList
        [ (w, d)
          | (d, c) <- zip [0 ..] digits,
            Map.member c rows,
            w <- [withoutServiceHole c, withServiceHole c]
        ]

-- | Byte in which the bits that belong to no track of the tape are 1.
outsideMask :: Medium -> Word8
outsideMask medium = complement (fromIntegral ((1 `shiftL` Machine.tracks medium) - 1 :: Int))

-- | Row @w@ with an even number of holes: if the number is odd, the parity track gets a hole or
-- loses it. The row is unchanged in a code without a parity track.
withParity :: TapeCode -> Word8 -> Word8
withParity code w = case Machine.evenTrack code of
  Just k | odd (popCount w) -> w `xor` setBit 0 (k - 1)
  _ -> w

-- | Value in 'digitOf' of a row that is no digit.
noDigit :: Word8
noDigit = 10

-- | Symbol with the name @c@. If the code has no row for @c@, the row is blank. This does not
-- happen in a checked machine description, which has rows for all symbols of its layout.
symbol :: Symbols -> Char -> Symbol
symbol table c =
  Symbol
    { name = c,
      holes = Map.findWithDefault 0 c (rowOf table),
      weight = Map.findWithDefault 0 c (weightOf table)
    }

-- | Row of a digit from 0 to 9, without a hole in the service track.
digit :: Symbols -> Int -> Word8
digit table = Short.index (digitRows table)

-- | Row of a digit from 0 to 9, with a hole in the service track.
serviceDigit :: Symbols -> Int -> Word8
serviceDigit table = Short.index (serviceRows table)

-- | Weight of a digit from 0 to 9 in a check sum.
digitWeight :: Symbols -> Int -> Int
digitWeight table = fromIntegral . Short.index (digitWeights table)

-- | Digit from 0 to 9 of the row @w@, with or without a hole in the service track; 'Nothing' if the
-- row is no digit.
digitAt :: Symbols -> Word8 -> Maybe Int
digitAt table w =
  let d = Short.index (digitOf table) (fromIntegral w)
   in if d == noDigit then Nothing else Just (fromIntegral d)
{-# INLINE digitAt #-}

-- | True for a row with a hole in the service track.
hasServiceHole :: Symbols -> Word8 -> Bool
hasServiceHole table w = w .&. service table /= 0

-- | True for a row with a hole outside of the tracks of the tape.
isOutsideTracks :: Symbols -> Word8 -> Bool
isOutsideTracks table w = w .&. outside table /= 0

-- | True for a row with an odd number of holes; always false in a code without a parity track.
isOdd :: Symbols -> Word8 -> Bool
isOdd table w = parity table && odd (popCount w)

-- | Symbol of the row @w@, for reports; 'Nothing' if the code has no symbol for it. A hole in the
-- service track of a digit is ignored.
symbolAt :: Symbols -> Word8 -> Maybe Char
symbolAt table w = case Map.lookup w (nameOf table) of
  Just c -> Just c
  Nothing -> intToDigit <$> digitAt table w

-- | Compares the rows from index @k@ (from 0) on with the symbols @cs@. Gives the index of the row
-- after the last symbol, or −1 if a row differs or the rows end.
rowAfter :: ShortByteString -> Int -> [Symbol] -> Int
rowAfter rows k cs = case cs of
  [] -> k
  c : more ->
    if k < Short.length rows && Short.index rows k == holes c
      then rowAfter rows (k + 1) more
      else -1
