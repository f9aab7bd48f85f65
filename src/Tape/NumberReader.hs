{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Numbers on a tape, read.
module Tape.NumberReader
  ( RowFault (..),
    TapeNumber (..),
    numeral,
    begins,
    Figures (..),
    plainFigures,
    digit,
    blemish,
  )
where

import Data.Bits (shiftL)
import Data.ByteString.Short (ShortByteString)
import Data.ByteString.Short qualified as Short
import Data.Maybe (fromMaybe, isJust)
import Data.Word (Word8)
import Machine.Machine (CommandName, Content, NumberForm (..), Service (..), Sign (..))
import Machine.Machine qualified as Machine
import Tape.Damage (Reason (..))
import Tape.Layout (Layout)
import Tape.Layout qualified as Layout
import Tape.Symbol qualified as Symbol

-- | A row, counted from 0, that is not as it should be; the word that it is of; why.
data RowFault = RowFault Int (Maybe Content) Reason
  deriving stock (Eq, Show)

-- | A number with what the service track says beside it.
data TapeNumber = TapeNumber
  { -- | the row where it begins
    start :: Int,
    -- | the row behind it
    next :: Int,
    value :: Int,
    -- | how many digits it has
    places :: Int,
    bits :: [(CommandName, Int)],
    brakes :: Bool,
    -- | what its symbols add to
    total :: Int
  }

-- | The number in a form that stands at a row.
numeral :: Layout -> Content -> NumberForm -> ShortByteString -> Int -> Either RowFault TapeNumber
numeral plan c f rows begin = do
  Signed behind minus weight <- readSign plan c f rows begin
  let whole = digits f - decimals f
      zero =
        Digits
          { at = behind,
            amount = 0,
            negative = minus,
            told = [],
            slow = False,
            count = weight,
            services = service f
          }
  front <- figures plan c rows (if padded f then whole else min 1 whole) whole zero
  ds <-
    if decimals f > 0
      then point plan c rows front >>= figures plan c rows (decimals f) (decimals f)
      else Right front
  if negative ds && amount ds == 0 && isPlain
    then Left (RowFault behind (Just c) MinusZero)
    else
      Right
        TapeNumber
          { start = begin,
            next = at ds,
            value = if negative ds then negate (amount ds) else amount ds,
            places = at ds - behind - (if decimals f > 0 then 1 else 0),
            bits = told ds,
            brakes = slow ds,
            total = count ds
          }
  where
    -- With a digit for direction a zero is judged by what should have been written.
    isPlain = case sign f of
      Priority {} -> False
      Unsigned -> True
      ServiceSign -> True
      MinusSign -> True
      EitherSign -> True

-- | Whether a number may begin at a row.
begins :: Layout -> NumberForm -> ShortByteString -> Int -> Bool
begins plan f rows k =
  digits f == 0
    || k < Short.length rows && (isJust (Symbol.digitAt (Layout.symbols plan) w) || isSign)
  where
    w = Short.index rows k
    is c = w == Symbol.holes (Symbol.symbol (Layout.symbols plan) c)
    isSign = case sign f of
      Unsigned -> False
      ServiceSign -> False
      Priority {} -> False
      MinusSign -> is '-'
      EitherSign -> is '-' || is '+'

-- | What stands before the digits: the row behind it, whether it says minus, and what it counts.
data Signed = Signed Int Bool Int

readSign :: Layout -> Content -> NumberForm -> ShortByteString -> Int -> Either RowFault Signed
readSign plan c f rows k = case sign f of
  Unsigned -> Right (Signed k False 0)
  ServiceSign -> Right (Signed k False 0)
  MinusSign -> Right (if here minus then behind minus True else Signed k False 0)
  EitherSign
    | here minus -> Right (behind minus True)
    | here plus -> Right (behind plus False)
    | k >= Short.length rows -> Left (cutOff c rows)
    | otherwise -> Left (RowFault k (Just c) (fromMaybe NoSign (blemish plan (Short.index rows k))))
  Priority leadForth leadBack forth back -> do
    d <- digit plan (Just c) rows k
    let after isMinus = Right (Signed (k + 1) isMinus (Symbol.digitWeight (Layout.symbols plan) d))
    if d == leadBack || d == back
      then after True
      else
        if d == leadForth || d == forth
          then after False
          else Left (RowFault k (Just c) (NoPriority d))
  where
    minus = Layout.minus plan
    plus = Layout.plus plan
    here s = k < Short.length rows && Short.index rows k == Symbol.holes s
    behind s isMinus = Signed (k + 1) isMinus (Symbol.weight s)
{-# INLINE readSign #-}

-- | The digits read so far.
data Digits = Digits
  { at :: Int,
    amount :: Int,
    negative :: Bool,
    told :: [(CommandName, Int)],
    slow :: Bool,
    count :: Int,
    -- | what the service track says at the next ones
    services :: [Service]
  }

-- | At least so many digits, and as many as there are up to a number.
figures :: Layout -> Content -> ShortByteString -> Int -> Int -> Digits -> Either RowFault Digits
figures plan c rows least most ds
  | at now < at ds + least || at now < at ds + most && isDigit = Left (stopped plan c rows now)
  | otherwise = Right now
  where
    now = sound plan rows (at ds + most) ds
    isDigit =
      at now < Short.length rows
        && isJust (Symbol.digitAt (Layout.symbols plan) (Short.index rows (at now)))
{-# INLINE figures #-}

-- | The digits up to a row, as far as the service track says what it may beside them.
sound :: Layout -> ShortByteString -> Int -> Digits -> Digits
sound plan rows end ds
  | null (services ds),
    Figures k n <- plainFigures plan rows end (at ds) (amount ds) =
    ds
      { at = k,
        amount = n,
        count = if Layout.isChecked plan then count ds + weights (at ds) k else count ds
      }
  | otherwise = go (at ds) (amount ds) (negative ds) (told ds) (slow ds) (count ds) (services ds)
  where
    weights from to =
      sum
        [ Symbol.digitWeight table d
          | k <- [from .. to - 1],
            Just d <- [Symbol.digitAt table (Short.index rows k)]
        ]
    table = Layout.symbols plan
    limit = min end (Short.length rows)
    go k n minus bits brakes weight track
      | k < limit,
        Just d <- Symbol.digitAt table (Short.index rows k) =
        let hole = Symbol.holeAt table (Short.index rows k)
            next minus' bits' brakes' =
              go (k + 1) (10 * n + d) minus' bits' brakes' (weight + Symbol.digitWeight table d)
         in case track of
              [] -> if hole then reached else next minus bits brakes []
              NoHole : more -> if hole then reached else next minus bits brakes more
              Marker : more -> if hole then next minus bits brakes more else reached
              MinusHole : more -> next (minus || hole) bits brakes more
              OrderBit o b : more ->
                next minus (if hole then (o, 1 `shiftL` b) : bits else bits) brakes more
              BrakingHole : more -> next minus bits (brakes || hole) more
      | otherwise = reached
      where
        reached =
          Digits
            { at = k,
              amount = n,
              negative = minus,
              told = bits,
              slow = brakes,
              count = weight,
              services = track
            }

-- | The row behind some digits, and their number.
data Figures = Figures Int Int

-- | The digits up to a row without a hole in the service track, from a row on and behind those of a
-- number.
plainFigures :: Layout -> ShortByteString -> Int -> Int -> Int -> Figures
plainFigures plan rows end = go
  where
    table = Layout.symbols plan
    limit = min end (Short.length rows)
    go !k !n
      | k < limit,
        w <- Short.index rows k,
        Just d <- Symbol.digitAt table w,
        not (Symbol.holeAt table w) =
        go (k + 1) (10 * n + d)
      | otherwise = Figures k n

-- | Why the digits end.
stopped :: Layout -> Content -> ShortByteString -> Digits -> RowFault
stopped plan c rows ds = case (digit plan (Just c) rows (at ds), services ds) of
  (Left fault, _) -> fault
  (Right _, Marker : _) -> RowFault (at ds) (Just c) MarkerMissing
  (Right _, _) -> RowFault (at ds) (Just c) ServiceHole

-- | The decimal point.
point :: Layout -> Content -> ShortByteString -> Digits -> Either RowFault Digits
point plan c rows ds
  | at ds >= Short.length rows = Left (cutOff c rows)
  | w == Symbol.holes s = Right ds {at = at ds + 1, count = count ds + Symbol.weight s}
  | otherwise = Left (RowFault (at ds) (Just c) (fromMaybe (Missing '.') (blemish plan w)))
  where
    w = Short.index rows (at ds)
    s = Layout.point plan
{-# INLINE point #-}

-- | The digit at a row.
digit :: Layout -> Maybe Content -> ShortByteString -> Int -> Either RowFault Int
digit plan c rows k
  | k >= Short.length rows = Left (RowFault (Short.length rows - 1) c CutOff)
  | otherwise = case Symbol.digitAt (Layout.symbols plan) w of
    Just d -> Right d
    Nothing -> Left (RowFault k c why)
  where
    w = Short.index rows k
    why = case (blemish plan w, Symbol.symbolAt (Layout.symbols plan) w) of
      (Just reason, _) -> reason
      (Nothing, Just s) -> NotADigit s
      (Nothing, Nothing) -> NoDigit (Machine.tracks (Machine.medium (Layout.machine plan))) w

-- | What is wrong with a row whatever it should be.
blemish :: Layout -> Word8 -> Maybe Reason
blemish plan w
  | Symbol.isForeign (Layout.symbols plan) w = Just ForeignTrack
  | Symbol.isOdd (Layout.symbols plan) w = Just BadParity
  | otherwise = Nothing

cutOff :: Content -> ShortByteString -> RowFault
cutOff c rows = RowFault (Short.length rows - 1) (Just c) CutOff
