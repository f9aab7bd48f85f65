{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Numbers read from the rows of a tape, in the form that the layout gives for their word.
module Tape.NumberReader
  ( RowFault (..),
    TapeNumber (..),
    numeral,
    canBegin,
    Figures (..),
    plainFigures,
    digit,
    rowFault,
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
import Tape.Layout (PreparedLayout)
import Tape.Layout qualified as Layout
import Tape.Symbol qualified as Symbol

-- | Faulty row: its index from 0, the word that it belongs to, and the reason.
data RowFault = RowFault Int (Maybe Content) Reason
  deriving stock (Eq, Show)

-- | Number with the holes of the service track beside it.
data TapeNumber = TapeNumber
  { -- | index of its first row
    start :: Int,
    -- | index of the row after it
    next :: Int,
    value :: Int,
    -- | number of its digits
    places :: Int,
    -- | command bits in the service track
    bits :: [(CommandName, Int)],
    -- | hole for braking in the service track
    brakes :: Bool,
    -- | sum of the weights of its symbols
    total :: Int
  }

-- | Number in the given form, from row @begin@ on.
numeral ::
  PreparedLayout ->
  Content ->
  NumberForm ->
  ShortByteString ->
  Int ->
  Either RowFault TapeNumber
numeral layout c f rows begin = do
  SignPart afterSign minus weight <- readSign layout c f rows begin
  let whole = digits f - decimals f
      zero =
        Digits
          { at = afterSign,
            amount = 0,
            negative = minus,
            commandBits = [],
            braking = False,
            weights = weight,
            services = service f
          }
  front <- figures layout c rows (if padded f then whole else min 1 whole) whole zero
  ds <-
    if decimals f > 0
      then point layout c rows front >>= figures layout c rows (decimals f) (decimals f)
      else Right front
  if negative ds && amount ds == 0 && refusesMinusZero
    then Left (RowFault afterSign (Just c) MinusZero)
    else
      Right
        TapeNumber
          { start = begin,
            next = at ds,
            value = if negative ds then negate (amount ds) else amount ds,
            places = at ds - afterSign - (if decimals f > 0 then 1 else 0),
            bits = commandBits ds,
            brakes = braking ds,
            total = weights ds
          }
  where
    -- A digit for the direction is compared later with the one that would be written.
    refusesMinusZero = case sign f of
      Priority {} -> False
      Unsigned -> True
      ServiceSign -> True
      MinusSign -> True
      EitherSign -> True

-- | True if a number in the given form can begin at row @k@.
canBegin :: PreparedLayout -> NumberForm -> ShortByteString -> Int -> Bool
canBegin layout f rows k =
  digits f == 0
    || k < Short.length rows && (isJust (Symbol.digitAt (Layout.symbols layout) w) || isSign)
  where
    w = Short.index rows k
    is c = w == Symbol.holes (Symbol.symbol (Layout.symbols layout) c)
    isSign = case sign f of
      Unsigned -> False
      ServiceSign -> False
      Priority {} -> False
      MinusSign -> is '-'
      EitherSign -> is '-' || is '+'

-- | Rows before the digits: the index of the row after them, true for a minus, and their weight.
data SignPart = SignPart Int Bool Int

readSign ::
  PreparedLayout ->
  Content ->
  NumberForm ->
  ShortByteString ->
  Int ->
  Either RowFault SignPart
readSign layout c f rows k = case sign f of
  Unsigned -> Right (SignPart k False 0)
  ServiceSign -> Right (SignPart k False 0)
  MinusSign -> Right (if isHere minus then afterSymbol minus True else SignPart k False 0)
  EitherSign
    | isHere minus -> Right (afterSymbol minus True)
    | isHere plus -> Right (afterSymbol plus False)
    | k >= Short.length rows -> Left (cutOff c rows)
    | otherwise ->
      Left (RowFault k (Just c) (fromMaybe NoSign (rowFault layout (Short.index rows k))))
  Priority leadForth leadBack forth back -> do
    d <- digit layout (Just c) rows k
    let afterDigit isMinus =
          Right (SignPart (k + 1) isMinus (Symbol.digitWeight (Layout.symbols layout) d))
    if d == leadBack || d == back
      then afterDigit True
      else
        if d == leadForth || d == forth
          then afterDigit False
          else Left (RowFault k (Just c) (NoPriority d))
  where
    minus = Layout.minus layout
    plus = Layout.plus layout
    isHere s = k < Short.length rows && Short.index rows k == Symbol.holes s
    afterSymbol s isMinus = SignPart (k + 1) isMinus (Symbol.weight s)
{-# INLINE readSign #-}

-- | State while the digits of a number are read.
data Digits = Digits
  { -- | index of the next row
    at :: Int,
    -- | value of the digits so far
    amount :: Int,
    negative :: Bool,
    commandBits :: [(CommandName, Int)],
    braking :: Bool,
    -- | sum of the weights so far
    weights :: Int,
    -- | use of the service track at the next digits
    services :: [Service]
  }

-- | Read at least @least@ digits and at most @most@. Fewer than @most@ are a fault if another digit
-- follows that cannot be read.
figures ::
  PreparedLayout ->
  Content ->
  ShortByteString ->
  Int ->
  Int ->
  Digits ->
  Either RowFault Digits
figures layout c rows least most ds
  | at now < at ds + least || at now < at ds + most && isDigit = Left (stopFault layout c rows now)
  | otherwise = Right now
  where
    now = digitsUpTo layout rows (at ds + most) ds
    isDigit =
      at now < Short.length rows
        && isJust (Symbol.digitAt (Layout.symbols layout) (Short.index rows (at now)))
{-# INLINE figures #-}

-- | Read digits up to row @end@, as long as the service track beside them has holes only where its
-- use allows them.
digitsUpTo :: PreparedLayout -> ShortByteString -> Int -> Digits -> Digits
digitsUpTo layout rows end ds
  | null (services ds),
    Figures k n <- plainFigures layout rows end (at ds) (amount ds) =
    ds
      { at = k,
        amount = n,
        weights =
          if Layout.hasCheckDigit layout then weights ds + sumBetween (at ds) k else weights ds
      }
  | otherwise = serviceDigits layout rows end ds
  where
    table = Layout.symbols layout
    sumBetween from to =
      sum
        [ Symbol.digitWeight table d
          | k <- [from .. to - 1],
            Just d <- [Symbol.digitAt table (Short.index rows k)]
        ]

-- | Read digits up to row @end@ with the service track beside them.
serviceDigits :: PreparedLayout -> ShortByteString -> Int -> Digits -> Digits
serviceDigits layout rows end ds =
  go (at ds) (amount ds) (negative ds) (commandBits ds) (braking ds) (weights ds) (services ds)
  where
    table = Layout.symbols layout
    limit = min end (Short.length rows)
    go k n minus set brakes weight track
      | k < limit,
        Just d <- Symbol.digitAt table (Short.index rows k) =
        let hole = Symbol.hasServiceHole table (Short.index rows k)
            more minus' set' brakes' =
              go (k + 1) (10 * n + d) minus' set' brakes' (weight + Symbol.digitWeight table d)
         in case track of
              [] -> if hole then reached else more minus set brakes []
              NoHole : rest -> if hole then reached else more minus set brakes rest
              Marker : rest -> if hole then more minus set brakes rest else reached
              MinusHole : rest -> more (minus || hole) set brakes rest
              CommandBit o b : rest ->
                more minus (if hole then (o, 1 `shiftL` b) : set else set) brakes rest
              BrakingHole : rest -> more minus set (brakes || hole) rest
      | otherwise = reached
      where
        reached =
          Digits
            { at = k,
              amount = n,
              negative = minus,
              commandBits = set,
              braking = brakes,
              weights = weight,
              services = track
            }

-- | Index of the row after some digits, and their value.
data Figures = Figures Int Int

-- | Digits without a hole in the service track, from a row on and up to row @end@. The value
-- continues that of the digits before them.
plainFigures :: PreparedLayout -> ShortByteString -> Int -> Int -> Int -> Figures
plainFigures layout rows end = go
  where
    table = Layout.symbols layout
    limit = min end (Short.length rows)
    go !k !n
      | k < limit,
        w <- Short.index rows k,
        Just d <- Symbol.digitAt table w,
        not (Symbol.hasServiceHole table w) =
        go (k + 1) (10 * n + d)
      | otherwise = Figures k n

-- | Reason why the digits end too early.
stopFault :: PreparedLayout -> Content -> ShortByteString -> Digits -> RowFault
stopFault layout c rows ds = case (digit layout (Just c) rows (at ds), services ds) of
  (Left fault, _) -> fault
  (Right _, Marker : _) -> RowFault (at ds) (Just c) MarkerMissing
  (Right _, _) -> RowFault (at ds) (Just c) ServiceHole

-- | Read the decimal point.
point :: PreparedLayout -> Content -> ShortByteString -> Digits -> Either RowFault Digits
point layout c rows ds
  | at ds >= Short.length rows = Left (cutOff c rows)
  | w == Symbol.holes s = Right ds {at = at ds + 1, weights = weights ds + Symbol.weight s}
  | otherwise = Left (RowFault (at ds) (Just c) (fromMaybe (Missing '.') (rowFault layout w)))
  where
    w = Short.index rows (at ds)
    s = Layout.point layout
{-# INLINE point #-}

-- | Digit at row @k@, with or without a hole in the service track.
digit :: PreparedLayout -> Maybe Content -> ShortByteString -> Int -> Either RowFault Int
digit layout c rows k
  | k >= Short.length rows = Left (RowFault (Short.length rows - 1) c CutOff)
  | otherwise = case Symbol.digitAt (Layout.symbols layout) w of
    Just d -> Right d
    Nothing -> Left (RowFault k c why)
  where
    w = Short.index rows k
    why = case (rowFault layout w, Symbol.symbolAt (Layout.symbols layout) w) of
      (Just reason, _) -> reason
      (Nothing, Just s) -> NotADigit s
      (Nothing, Nothing) -> NoDigit (Machine.tracks (Machine.medium (Layout.machine layout))) w

-- | Fault of a row that is wrong whatever it should be: a hole outside of the tracks, or wrong
-- parity.
rowFault :: PreparedLayout -> Word8 -> Maybe Reason
rowFault layout w
  | Symbol.isOutsideTracks (Layout.symbols layout) w = Just ForeignTrack
  | Symbol.isOdd (Layout.symbols layout) w = Just BadParity
  | otherwise = Nothing

cutOff :: Content -> ShortByteString -> RowFault
cutOff c rows = RowFault (Short.length rows - 1) (Just c) CutOff
