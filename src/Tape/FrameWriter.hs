{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Writer of frames: makes the rows of a frame by the steps of a layout.
--
-- A frame is a block of ISO 6983, and a layout gives its symbols and words in order. A hole in the
-- service track gives the digit in its row an extra meaning, such as a minus or a bit of a command.
-- The leading axis of a frame is the axis with the most pulses.
--
-- Each row comes with its weight in the check sum and its meaning. The same code makes the tape,
-- which needs the holes only, and the picture of the tape, which explains every row. In 'foldRows',
-- 'foldSign', 'addDigit' and the like the last argument is the accumulator so far.
module Tape.FrameWriter
  ( frameRows,
    AddRow,
    foldRows,
    mostRows,
  )
where

import Data.Bits (testBit)
import Data.Functor.Identity (runIdentity)
import Data.Maybe (fromMaybe)
import Data.Word (Word8)
import Frame.Frame (Frame (..))
import Frame.Frame qualified as Frame
import Machine.Machine
  ( Content (..),
    NumberForm (..),
    Service (..),
    Sign (..),
    Word' (..),
  )
import Tape.Layout
  ( Address (..),
    LayoutStep (..),
    MarkedRow (MarkedRow),
    PreparedLayout (..),
    RowKind (..),
    WordRow (..),
  )
import Tape.Layout qualified as Layout
import Tape.ModalState (State)
import Tape.ModalState qualified as ModalState
import Tape.Symbol qualified as Symbol

-- | Rows of a frame without the blank rows after it. @state@ is the modal state before the frame.
frameRows :: PreparedLayout -> State -> Frame -> [MarkedRow]
frameRows layout state frame =
  reverse
    (runIdentity (foldRows (\rows h n m -> pure (MarkedRow h n m : rows)) layout state frame []))

-- | Function that adds a row to an accumulator. Its arguments are the accumulator, the holes of the
-- row, the weight of the row in the check sum, and the meaning of the row.
type AddRow m r = r -> Word8 -> Int -> RowKind -> m r

-- | Monadic left fold over the rows of a frame, from the first row to the last. @state@ is the
-- state before the frame; the last argument is the initial value of the accumulator.
foldRows ::
  Monad m =>
  AddRow m r ->
  PreparedLayout ->
  State ->
  Frame ->
  r ->
  m r
foldRows add layout state frame =
  foldWithSum
    add
    (if hasCheckDigit layout then checkSum layout state frame else 0)
    layout
    state
    frame
{-# INLINE foldRows #-}

-- | Sum of the weights of a frame without its check digit.
checkSum :: PreparedLayout -> State -> Frame -> Int
checkSum layout state frame = runIdentity (foldWithSum count 0 layout state frame 0)
  where
    count total _ n meaning =
      pure $! case meaning of
        CheckSymbol _ -> total
        _ -> total + n

-- | Monadic left fold over the rows of a frame, from the first row to the last. @total@ is the sum
-- of the weights of all symbols but the check digit. The check digit is chosen by this sum.
foldWithSum ::
  Monad m =>
  AddRow m r ->
  Int ->
  PreparedLayout ->
  State ->
  Frame ->
  r ->
  m r
foldWithSum add total layout state frame =
  go False (if ModalState.isSimple frame then simpleSteps layout else steps layout)
  where
    go followsWord todo before = case todo of
      [] -> pure before
      FixedStep cs : more -> constants Constant cs before >>= go False more
      CheckStep m : more ->
        let d = checkDigit layout m total
         in addDigit add layout (CheckSymbol d) d before >>= go False more
      WordStep w Address {spelling} _ : more ->
        case ModalState.number (axes layout) state frame w of
          Nothing -> go followsWord more before
          Just n -> do
            separated <-
              if followsWord then constants Separator (separator layout) before else pure before
            addressed <- constants (InWord (content w) n . AddressSymbol) spelling separated
            signed <- foldSign add layout frame w n addressed
            written <- foldDigits add layout frame w n signed
            go True more written
    constants meaning cs !before = case cs of
      [] -> pure before
      Symbol.Symbol c h k : more -> add before h k (meaning c) >>= constants meaning more
{-# INLINE foldWithSum #-}

-- | Adds the row of the digit @d@ (0 to 9) without a hole in the service track.
addDigit :: AddRow m r -> PreparedLayout -> RowKind -> Int -> r -> m r
addDigit add layout meaning d before =
  add before (Symbol.digit (symbols layout) d) (Symbol.digitWeight (symbols layout) d) meaning
{-# INLINE addDigit #-}

-- | Adds the sign of the number @n@ of the word @w@. In some forms this is a digit that gives the
-- direction of an axis, and says if the axis is the leading one. Adds nothing if the form has no
-- sign before the digits.
foldSign ::
  Monad m =>
  AddRow m r ->
  PreparedLayout ->
  Frame ->
  Word' ->
  Int ->
  r ->
  m r
foldSign add layout frame w n before = case sign (form w) of
  Unsigned -> pure before
  ServiceSign -> pure before
  MinusSign -> if n < 0 then signSymbol '-' (minus layout) else pure before
  EitherSign
    | n < 0 -> signSymbol '-' (minus layout)
    | otherwise -> signSymbol '+' (plus layout)
  Priority leadForth leadBack forth back ->
    priority
      ( if isLeading layout frame (content w)
          then (if n < 0 then leadBack else leadForth)
          else (if n < 0 then back else forth)
      )
  where
    signSymbol c (Symbol.Symbol _ h k) = add before h k (InWord (content w) n (SignSymbol c))
    priority d =
      addDigit add layout (InWord (content w) n (PriorityDigit d)) (d `mod` 10) before
{-# INLINE foldSign #-}

-- | Adds the digits of the number @n@ of the word @w@, with their decimal point and the holes in
-- the service track.
foldDigits ::
  Monad m =>
  AddRow m r ->
  PreparedLayout ->
  Frame ->
  Word' ->
  Int ->
  r ->
  m r
foldDigits add layout frame w n start = case service f of
  [] -> digitsFrom (const (NoHole, ())) ()
  services -> digitsFrom nextService services
  where
    f = form w
    count = Layout.digitCount f (abs n)
    -- @track@ describes the service track from the first digit on. @meaningAt@ splits such a
    -- description: it gives the meaning of a hole at the first digit, and the description from the
    -- second digit on. Inlining gives numbers without a service track a faster loop of their own.
    digitsFrom meaningAt track = go (count - 1) track (lowestDigits count (abs n)) start
      where
        -- Adds the digits of @left@, from the digit of 10^k down to the last one.
        go k services !left !before
          | k < 0 = pure before
          | otherwise = case meaningAt services of
            (s, more) -> do
              let d = left `quot` Layout.power k
                  isPunched = isServicePunched frame n s
                  !holes =
                    if isPunched
                      then Symbol.serviceDigit (symbols layout) d
                      else Symbol.digit (symbols layout) d
                  weight = Symbol.digitWeight (symbols layout) d
              ready <- addPoint add layout w n k before
              next <- add ready holes weight (InWord (content w) n (Digit d k s isPunched))
              go (k - 1) more (left - d * Layout.power k) next
    {-# INLINE digitsFrom #-}
    nextService services = case services of
      [] -> (NoHole, [])
      s : more -> (s, more)
{-# INLINE foldDigits #-}

-- | Adds the decimal point of the number @n@ of the word @w@ if the point comes directly before
-- digit @k@, counted from 0 at the last digit.
addPoint ::
  Monad m =>
  AddRow m r ->
  PreparedLayout ->
  Word' ->
  Int ->
  Int ->
  r ->
  m r
addPoint add layout w n k before
  | k == decimals (form w) - 1 =
    let Symbol.Symbol _ h weight = point layout
     in add before h weight (InWord (content w) n Point)
  | otherwise = pure before
{-# INLINE addPoint #-}

-- | Upper bound for the number of rows of a frame, by which the buffer of a tape is allocated.
mostRows :: PreparedLayout -> Int
mostRows layout = sum (map most (steps layout))
  where
    most step = case step of
      FixedStep cs -> length cs
      CheckStep _ -> 1
      -- The 2 counts one row for a sign and one row for a decimal point.
      WordStep w _ address -> extent address + 2 + max Layout.mostDigits (digits (form w))

-- | The last @count@ digits of a number @n@ ≥ 0, as a number.
lowestDigits :: Int -> Int -> Int
lowestDigits count n = if n < Layout.power count then n else n `rem` Layout.power count

-- | Smallest digit whose weight, added to the sum @total@ of all other weights in the frame, gives
-- a multiple of @modulus@; 0 if no digit does.
checkDigit :: PreparedLayout -> Int -> Int -> Int
checkDigit layout modulus total =
  case [d | d <- [0 .. 9], (total + weightOf d) `mod` max 1 modulus == 0] of
    d : _ -> d
    [] -> 0
  where
    weightOf = Symbol.digitWeight (symbols layout)

-- | True if @c@ is the content of the leading axis's word. If several axes have the most pulses,
-- the first in the layout leads. True also if @c@ is not of an axis, say for the centre of an arc.
isLeading :: PreparedLayout -> Frame -> Content -> Bool
isLeading layout frame c =
  c `notElem` axisOrder layout || take 1 [b | b <- axisOrder layout, pulses b == most] == [c]
  where
    pulses b = case b of
      Along a -> abs (ModalState.along a (increment frame))
      About a -> abs (Frame.turnAbout a frame)
      _ -> 0
    most = maximum (0 : map pulses (axisOrder layout))

-- | True if the service track gets a hole in the row of a digit of the number @n@; @s@ is the
-- meaning of a hole in this row.
isServicePunched :: Frame -> Int -> Service -> Bool
isServicePunched frame n s = case s of
  MinusHole -> n < 0
  CommandBit o k -> testBit (fromMaybe 0 (lookup o (commands frame))) k
  Marker -> True
  BrakingHole -> braking frame
  NoHole -> False
