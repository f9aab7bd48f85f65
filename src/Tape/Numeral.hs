-- | Numbers on a tape, read.
module Tape.Numeral
  ( Fault (..),
    Numeral (..),
    numeral,
    begins,
    digit,
    blemish,
  )
where

import Data.Bits (shiftL)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Maybe (fromMaybe, isJust)
import Data.Word (Word8)
import Machine.Machine (Content, NumberForm (..), OrderName, Service (..), Sign (..))
import Machine.Machine qualified as Machine
import Tape.Damage (Reason (..))
import Tape.Plan (Plan)
import Tape.Plan qualified as Plan
import Tape.Symbol qualified as Symbol

-- | A row, counted from 0, that is not as it should be; the word that it is of; why.
data Fault = Fault Int (Maybe Content) Reason
  deriving stock (Eq, Show)

-- | A number with what the service track says beside it.
data Numeral = Numeral
  { -- | the row where it begins
    start :: Int,
    -- | the row behind it
    next :: Int,
    value :: Int,
    bits :: [(OrderName, Int)],
    brakes :: Bool,
    -- | what its symbols add to
    total :: Int
  }

-- | The number in a form that stands at a row.
numeral :: Plan -> Content -> NumberForm -> ByteString -> Int -> Either Fault Numeral
numeral plan c f rows begin = do
  Signed behind minus weight <- readSign plan c f rows begin
  let whole = digits f - decimals f
      zero = Digits {at = behind, amount = 0, negative = minus, told = [], slow = False, count = weight, services = service f}
  front <- figures plan c rows (if padded f then whole else min 1 whole) whole zero
  ds <- if decimals f > 0 then point plan c rows front >>= figures plan c rows (decimals f) (decimals f) else Right front
  if negative ds && amount ds == 0 && isPlain
    then Left (Fault behind (Just c) MinusZero)
    else
      Right
        Numeral
          { start = begin,
            next = at ds,
            value = if negative ds then negate (amount ds) else amount ds,
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
begins :: Plan -> NumberForm -> ByteString -> Int -> Bool
begins plan f rows k = digits f == 0 || k < ByteString.length rows && (isJust (Symbol.digitAt (Plan.symbols plan) w) || isSign)
  where
    w = ByteString.index rows k
    is c = w == Symbol.holes (Symbol.symbol (Plan.symbols plan) c)
    isSign = case sign f of
      Unsigned -> False
      ServiceSign -> False
      Priority {} -> False
      MinusSign -> is '-'
      EitherSign -> is '-' || is '+'

-- | What stands before the digits: the row behind it, whether it says minus, and what it counts.
data Signed = Signed Int Bool Int

readSign :: Plan -> Content -> NumberForm -> ByteString -> Int -> Either Fault Signed
readSign plan c f rows k = case sign f of
  Unsigned -> Right (Signed k False 0)
  ServiceSign -> Right (Signed k False 0)
  MinusSign -> Right (if here minus then behind minus True else Signed k False 0)
  EitherSign
    | here minus -> Right (behind minus True)
    | here plus -> Right (behind plus False)
    | k >= ByteString.length rows -> Left (cutOff c rows)
    | otherwise -> Left (Fault k (Just c) (fromMaybe NoSign (blemish plan (ByteString.index rows k))))
  Priority leadForth leadBack forth back -> do
    d <- digit plan (Just c) rows k
    let after isMinus = Right (Signed (k + 1) isMinus (Symbol.digitWeight (Plan.symbols plan) d))
    if d == leadBack || d == back
      then after True
      else if d == leadForth || d == forth then after False else Left (Fault k (Just c) (NoPriority d))
  where
    minus = Plan.minus plan
    plus = Plan.plus plan
    here s = k < ByteString.length rows && ByteString.index rows k == Symbol.holes s
    behind s isMinus = Signed (k + 1) isMinus (Symbol.weight s)
{-# INLINE readSign #-}

-- | The digits read so far.
data Digits = Digits
  { at :: Int,
    amount :: Int,
    negative :: Bool,
    told :: [(OrderName, Int)],
    slow :: Bool,
    count :: Int,
    -- | what the service track says at the next ones
    services :: [Service]
  }

-- | At least so many digits, and as many as there are up to a number.
figures :: Plan -> Content -> ByteString -> Int -> Int -> Digits -> Either Fault Digits
figures plan c rows least most ds
  | at now < at ds + least || at now < at ds + most && isDigit = Left (stopped plan c rows now)
  | otherwise = Right now
  where
    now = sound plan rows (at ds + most) ds
    isDigit = at now < ByteString.length rows && isJust (Symbol.digitAt (Plan.symbols plan) (ByteString.index rows (at now)))
{-# INLINE figures #-}

-- | The digits up to a row, as far as the service track says what it may beside them.
sound :: Plan -> ByteString -> Int -> Digits -> Digits
sound plan rows end ds
  | at ds < min end (ByteString.length rows), Just d <- Symbol.digitAt table w, isHeard = sound plan rows end heard {at = at ds + 1, amount = 10 * amount ds + d, count = count ds + Symbol.digitWeight table d, services = drop 1 (services ds)}
  | otherwise = ds
  where
    table = Plan.symbols plan
    w = ByteString.index rows (at ds)
    hole = Symbol.holeAt table w
    isHeard = case services ds of
      [] -> not hole
      NoHole : _ -> not hole
      Marker : _ -> hole
      MinusHole : _ -> True
      OrderBit _ _ : _ -> True
      BrakingHole : _ -> True
    heard = case services ds of
      MinusHole : _ | hole -> ds {negative = True}
      OrderBit o k : _ | hole -> ds {told = (o, 1 `shiftL` k) : told ds}
      BrakingHole : _ | hole -> ds {slow = True}
      _ -> ds

-- | Why the digits end.
stopped :: Plan -> Content -> ByteString -> Digits -> Fault
stopped plan c rows ds = case (digit plan (Just c) rows (at ds), services ds) of
  (Left fault, _) -> fault
  (Right _, Marker : _) -> Fault (at ds) (Just c) MarkerMissing
  (Right _, _) -> Fault (at ds) (Just c) ServiceHole

-- | The decimal point.
point :: Plan -> Content -> ByteString -> Digits -> Either Fault Digits
point plan c rows ds
  | at ds >= ByteString.length rows = Left (cutOff c rows)
  | w == Symbol.holes s = Right ds {at = at ds + 1, count = count ds + Symbol.weight s}
  | otherwise = Left (Fault (at ds) (Just c) (fromMaybe (Missing '.') (blemish plan w)))
  where
    w = ByteString.index rows (at ds)
    s = Plan.point plan
{-# INLINE point #-}

-- | The digit at a row.
digit :: Plan -> Maybe Content -> ByteString -> Int -> Either Fault Int
digit plan c rows k
  | k >= ByteString.length rows = Left (Fault (ByteString.length rows - 1) c CutOff)
  | otherwise = case Symbol.digitAt (Plan.symbols plan) w of
    Just d -> Right d
    Nothing -> Left (Fault k c why)
  where
    w = ByteString.index rows k
    why = case (blemish plan w, Symbol.symbolAt (Plan.symbols plan) w) of
      (Just reason, _) -> reason
      (Nothing, Just s) -> NotADigit s
      (Nothing, Nothing) -> NoDigit (Machine.tracks (Machine.medium (Plan.machine plan))) w

-- | What is wrong with a row whatever it should be.
blemish :: Plan -> Word8 -> Maybe Reason
blemish plan w
  | Symbol.isForeign (Plan.symbols plan) w = Just ForeignTrack
  | Symbol.isOdd (Plan.symbols plan) w = Just BadParity
  | otherwise = Nothing

cutOff :: Content -> ByteString -> Fault
cutOff c rows = Fault (ByteString.length rows - 1) (Just c) CutOff
