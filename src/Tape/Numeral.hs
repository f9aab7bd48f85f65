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
  (minus, first) <- readSign plan c f rows begin
  let zero = Digits {at = fst first, amount = 0, negative = minus, told = [], slow = False, count = snd first, services = service f}
      whole = digits f - decimals f
  front <- if padded f then exactly plan c rows whole zero else upTo plan c rows whole zero
  ds <-
    if decimals f > 0
      then do
        behind <- point plan c rows front
        exactly plan c rows (decimals f) behind
      else Right front
  if negative ds && amount ds == 0 && isPlain
    then Left (Fault (at zero) (Just c) MinusZero)
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

-- | What stands before the digits: whether it says minus, the row behind it, and what it counts.
readSign :: Plan -> Content -> NumberForm -> ByteString -> Int -> Either Fault (Bool, (Int, Int))
readSign plan c f rows k = case sign f of
  Unsigned -> Right (False, (k, 0))
  ServiceSign -> Right (False, (k, 0))
  MinusSign -> if here minus then Right (True, behind minus) else Right (False, (k, 0))
  EitherSign
    | here minus -> Right (True, behind minus)
    | here plus -> Right (False, behind plus)
    | k >= ByteString.length rows -> Left (cutOff c rows)
    | otherwise -> Left (Fault k (Just c) (fromMaybe NoSign (blemish plan (ByteString.index rows k))))
  Priority leadForth leadBack forth back -> do
    d <- digit plan (Just c) rows k
    let after = (k + 1, Symbol.digitWeight (Plan.symbols plan) d)
    if d == leadBack || d == back
      then Right (True, after)
      else if d == leadForth || d == forth then Right (False, after) else Left (Fault k (Just c) (NoPriority d))
  where
    minus = Symbol.symbol (Plan.symbols plan) '-'
    plus = Symbol.symbol (Plan.symbols plan) '+'
    here s = k < ByteString.length rows && ByteString.index rows k == Symbol.holes s
    behind s = (k + 1, Symbol.weight s)

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

-- | So many digits.
exactly :: Plan -> Content -> ByteString -> Int -> Digits -> Either Fault Digits
exactly plan c rows n ds
  | n <= 0 = Right ds
  | isBare plan ds, let done = bareDigits plan rows n ds, at done == at ds + n = Right done
  | otherwise = do
    d <- digit plan (Just c) rows (at ds)
    served <- noted plan c (ByteString.index rows (at ds)) ds
    exactly plan c rows (n - 1) served {at = at ds + 1, amount = 10 * amount ds + d, count = count ds + Symbol.digitWeight (Plan.symbols plan) d, services = drop 1 (services ds)}

-- | At least one digit, and as many as there are up to a number.
upTo :: Plan -> Content -> ByteString -> Int -> Digits -> Either Fault Digits
upTo plan c rows n ds
  | n <= 0 = Right ds
  | isBare plan ds, let done = bareDigits plan rows n ds, at done > at ds = Right done
  | otherwise = do
    one <- exactly plan c rows 1 ds
    if at one < ByteString.length rows && isJust (Symbol.digitAt (Plan.symbols plan) (ByteString.index rows (at one)))
      then upTo plan c rows (n - 1) one
      else Right one

-- | Whether nothing can stand beside the digits.
isBare :: Plan -> Digits -> Bool
isBare plan ds = null (services ds) && Symbol.service (Plan.symbols plan) == 0

-- | The digits up to a number of them, as many as there are.
bareDigits :: Plan -> ByteString -> Int -> Digits -> Digits
bareDigits plan rows n ds = go (at ds) (amount ds) (count ds)
  where
    end = min (at ds + n) (ByteString.length rows)
    table = Plan.symbols plan
    go k m w
      | k < end, Just d <- Symbol.digitAt table (ByteString.index rows k) = go (k + 1) (10 * m + d) (w + Symbol.digitWeight table d)
      | otherwise = ds {at = k, amount = m, count = w}

-- | The decimal point.
point :: Plan -> Content -> ByteString -> Digits -> Either Fault Digits
point plan c rows ds
  | at ds >= ByteString.length rows = Left (cutOff c rows)
  | w == Symbol.holes s = Right ds {at = at ds + 1, count = count ds + Symbol.weight s}
  | otherwise = Left (Fault (at ds) (Just c) (fromMaybe (Missing '.') (blemish plan w)))
  where
    w = ByteString.index rows (at ds)
    s = Symbol.symbol (Plan.symbols plan) '.'

-- | What the service track says beside a digit.
noted :: Plan -> Content -> Word8 -> Digits -> Either Fault Digits
noted plan c w ds = case services ds of
  [] -> if hole then Left (Fault (at ds) (Just c) ServiceHole) else Right ds
  s : _ -> case s of
    NoHole -> if hole then Left (Fault (at ds) (Just c) ServiceHole) else Right ds
    Marker -> if hole then Right ds else Left (Fault (at ds) (Just c) MarkerMissing)
    MinusHole -> Right (if hole then ds {negative = True} else ds)
    OrderBit o k -> Right (if hole then ds {told = (o, 1 `shiftL` k) : told ds} else ds)
    BrakingHole -> Right (if hole then ds {slow = True} else ds)
  where
    hole = Symbol.holeAt (Plan.symbols plan) w

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
