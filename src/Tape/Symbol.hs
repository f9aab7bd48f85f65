{-# OPTIONS_GHC -O2 #-}

-- | The rows of a code's symbols, as tables that writing and reading look up.
module Tape.Symbol
  ( Symbols (..),
    fromMachine,
    Symbol (..),
    symbol,
    digit,
    serviceDigit,
    digitWeight,
    digitAt,
    holeAt,
    isForeign,
    isOdd,
    symbolAt,
    behind,
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

data Symbols = Symbols
  { rowOf :: Map Char Word8,
    weightOf :: Map Char Int,
    -- | the symbols of whole rows
    nameOf :: Map Word8 Char,
    -- | the rows of the ten digits without a hole in the service track
    digitRows :: ShortByteString,
    -- | and with one
    serviceRows :: ShortByteString,
    -- | what the ten digits count
    digitWeights :: ShortByteString,
    -- | the digit of every row, the service track left out of account; 'noDigit' for a row that is
    -- none
    digitOf :: ShortByteString,
    -- | the bit of the service track, or none
    service :: Word8,
    -- | the bits beside the tape
    beside :: Word8,
    -- | whether a row must have an even number of holes
    parity :: Bool
  }

-- | A symbol, its row with the hole for parity, and what it counts in a sum.
data Symbol = Symbol {name :: Char, holes :: Word8, weight :: Int}

fromMachine :: Machine -> Symbols
fromMachine machine =
  Symbols
    { rowOf = rows,
      weightOf = Machine.weights code,
      nameOf = Map.fromList [(w, c) | (c, w) <- Map.toList rows],
      digitRows = Short.pack (map plain ciphers),
      serviceRows = Short.pack (map withHole ciphers),
      digitWeights =
        Short.pack [fromIntegral (Map.findWithDefault 0 c (Machine.weights code)) | c <- ciphers],
      digitOf = Short.pack [Map.findWithDefault noDigit w digits | w <- [minBound .. maxBound]],
      service = mask,
      beside = besideOf (Machine.medium machine),
      parity = isJust (Machine.evenTrack code)
    }
  where
    code = Machine.code machine
    mask = maybe 0 (\k -> setBit 0 (k - 1)) (Machine.serviceTrack code)
    rows = Map.map (completed code) (Machine.symbols code)
    bare c = Map.findWithDefault 0 c (Machine.symbols code)
    plain c = completed code (bare c .&. complement mask)
    withHole c = completed code (bare c .|. mask)
    ciphers = map intToDigit [0 .. 9]
    digits =
      Map.fromList
        [(w, d) | (d, c) <- zip [0 ..] ciphers, Map.member c rows, w <- [plain c, withHole c]]

-- | The bits of a row that are no tracks of the tape.
besideOf :: Medium -> Word8
besideOf medium = complement (fromIntegral ((1 `shiftL` Machine.tracks medium) - 1 :: Int))

-- | A row with the hole that makes their number even, where the code has a track for it.
completed :: TapeCode -> Word8 -> Word8
completed code w = case Machine.evenTrack code of
  Just k | odd (popCount w) -> w `xor` setBit 0 (k - 1)
  _ -> w

-- | No row of a digit.
noDigit :: Word8
noDigit = 10

-- | A symbol of a layout. A machine has rows for all symbols of its layout; one without is a blank
-- row.
symbol :: Symbols -> Char -> Symbol
symbol table c =
  Symbol
    { name = c,
      holes = Map.findWithDefault 0 c (rowOf table),
      weight = Map.findWithDefault 0 c (weightOf table)
    }

-- | The row of a digit, 0 to 9.
digit :: Symbols -> Int -> Word8
digit table = Short.index (digitRows table)

-- | The row of a digit with a hole in the service track.
serviceDigit :: Symbols -> Int -> Word8
serviceDigit table = Short.index (serviceRows table)

-- | What a digit, 0 to 9, counts in a sum.
digitWeight :: Symbols -> Int -> Int
digitWeight table = fromIntegral . Short.index (digitWeights table)

-- | The digit of a row, whatever the service track holds.
digitAt :: Symbols -> Word8 -> Maybe Int
digitAt table w =
  let d =
        Short.index (digitOf table) (fromIntegral w)
   in if d == noDigit then Nothing else Just (fromIntegral d)
{-# INLINE digitAt #-}

-- | Whether there is a hole in the service track.
holeAt :: Symbols -> Word8 -> Bool
holeAt table w = w .&. service table /= 0

-- | Whether there is a hole beside the tracks of the tape.
isForeign :: Symbols -> Word8 -> Bool
isForeign table w = w .&. beside table /= 0

-- | Whether the number of holes is odd and must not be.
isOdd :: Symbols -> Word8 -> Bool
isOdd table w = parity table && odd (popCount w)

-- | The symbol of a row; of a digit with a hole in the service track that digit.
symbolAt :: Symbols -> Word8 -> Maybe Char
symbolAt table w = case Map.lookup w (nameOf table) of
  Just c -> Just c
  Nothing -> intToDigit <$> digitAt table w

-- | The row behind symbols that stand at a row; below 0 where they do not.
behind :: ShortByteString -> Int -> [Symbol] -> Int
behind rows k cs = case cs of
  [] -> k
  c : more ->
    if k < Short.length rows && Short.index rows k == holes c then behind rows (k + 1) more else -1
