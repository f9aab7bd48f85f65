{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Numbers read from the rows of a tape, in the form that the layout gives for their word.
--
-- Rows have indices from 0. A hole in the service track gives the digit in its row an extra
-- meaning, such as a minus or a bit of a command's number. In a layout with a check digit each
-- symbol has a weight, and the sum of the weights is checked at the end of the frame. The /content/
-- of a word is the meaning of its number, such as a motion or a feed ('Content').
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

-- | Faulty row: its index from 0, the content of its word if the row is in a word, and the reason.
data RowFault = RowFault Int (Maybe Content) Reason
  deriving stock (Eq, Show)

-- | Number on a tape, with the meaning of the holes in the service track beside its digits.
data TapeNumber = TapeNumber
  { -- | index of the number's first row
    start :: Int,
    -- | index of the row after the number
    next :: Int,
    value :: Int,
    -- | count of digits, decimals included
    places :: Int,
    -- | one entry for each hole that is a bit of a command's number: the command, and the value 2^k
    -- of bit k
    bits :: [(CommandName, Int)],
    -- | true if the service track has the hole that makes the control brake in this frame
    brakes :: Bool,
    -- | sum of the weights of the number's symbols; not used in a layout without a check digit
    total :: Int
  }

-- | Number of the form @f@ that begins at row @begin@. If the rows are no number of this form, the
-- result is a fault in a word with the content @c@.
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
    -- A priority digit before the number gives the sign ('Priority'), also that of 0. So a minus
    -- before 0 is no fault here. The reader of frames later compares the priority digit with the
    -- one that the machine would write.
    refusesMinusZero = case sign f of
      Priority {} -> False
      Unsigned -> True
      ServiceSign -> True
      MinusSign -> True
      EitherSign -> True

-- | True if a number of the form @f@ can begin at row @k@: the row is a digit, or a sign that the
-- form allows. Always true for a form without digits. By this test the reader of frames finds which
-- optional words are present.
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

-- | Sign before the digits of a number: the index of the row after the sign, true for a minus, and
-- the weight of the sign in the check sum. Without a sign: index of the first digit, false and 0.
data SignPart = SignPart Int Bool Int

-- | Sign of the number of the form @f@ that begins at row @k@. The absence of a sign is a fault
-- only if the form demands a plus, a minus or a priority digit before every number.
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

-- | Digits of a number that have been read so far, with the meaning of the holes beside them.
data Digits = Digits
  { -- | index of the next row to read
    at :: Int,
    -- | value of the digits so far, without sign and decimal point
    amount :: Int,
    -- | true if a minus has been read
    negative :: Bool,
    -- | command bits that have been read so far, as in 'bits'
    commandBits :: [(CommandName, Int)],
    -- | true if the hole for braking has been read
    braking :: Bool,
    -- | sum of the weights so far
    weights :: Int,
    -- | meaning of the service track at the digits that are not yet read
    services :: [Service]
  }

-- | Reads from @least@ to @most@ digits of a number, and adds them to @ds@. The result is a fault
-- if there are fewer than @least@ digits, or if a digit has a wrong hole in the service track or
-- lacks one.
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

-- | Reads digits from row @at ds@ up to row @end@, excluded, and adds them to @ds@. It stops at the
-- first row that is no digit, or that lacks a hole in the service track or has a wrong one.
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

-- | Reads digits up to row @end@, excluded, in a form that uses the service track. It stops at the
-- first row that is no digit, or that lacks a hole in the service track or has a wrong one.
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

-- | Index of the row after the last digit that was read, and the value of all digits of the number
-- up to that row.
data Figures = Figures Int Int

-- | Reads digits without a hole in the service track, up to row @end@, excluded. The last two
-- arguments are the index of the first row to read, and the value of the digits before that row.
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

-- | Fault of the row @at ds@, at which the digits of a number end too early.
stopFault :: PreparedLayout -> Content -> ShortByteString -> Digits -> RowFault
stopFault layout c rows ds = case (digit layout (Just c) rows (at ds), services ds) of
  (Left fault, _) -> fault
  (Right _, Marker : _) -> RowFault (at ds) (Just c) MarkerMissing
  (Right _, _) -> RowFault (at ds) (Just c) ServiceHole

-- | Reads the decimal point at row @at ds@, and adds its row and its weight to @ds@.
point :: PreparedLayout -> Content -> ShortByteString -> Digits -> Either RowFault Digits
point layout c rows ds
  | at ds >= Short.length rows = Left (cutOff c rows)
  | w == Symbol.holes s = Right ds {at = at ds + 1, weights = weights ds + Symbol.weight s}
  | otherwise = Left (RowFault (at ds) (Just c) (fromMaybe (Missing '.') (rowFault layout w)))
  where
    w = Short.index rows (at ds)
    s = Layout.point layout

-- | Digit from 0 to 9 at row @k@, with or without a hole in the service track; a fault if the row
-- is no digit. The fault names @c@, the content of the row's word, if the row is in a word.
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

-- | Reason why the row @w@ can be no symbol of this tape: it has a hole outside of the tracks, or
-- its parity is wrong. 'Nothing' for all other rows.
rowFault :: PreparedLayout -> Word8 -> Maybe Reason
rowFault layout w
  | Symbol.isOutsideTracks (Layout.symbols layout) w = Just ForeignTrack
  | Symbol.isOdd (Layout.symbols layout) w = Just BadParity
  | otherwise = Nothing

-- | Fault of a tape that ends within a word with the content @c@. The fault is at the last row.
cutOff :: Content -> ShortByteString -> RowFault
cutOff c rows = RowFault (Short.length rows - 1) (Just c) CutOff
