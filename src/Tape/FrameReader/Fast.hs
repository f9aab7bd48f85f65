{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Fast reader of simple frames, which have neither an arc nor a command, and turn no rotary axis.
-- Most frames of a long tape are simple. A frame is a block of ISO 6983; its layout gives its
-- symbols and words in order.
--
-- If this reader gives a frame, 'Tape.FrameReader.wordByWord' gives the same frame. The reader
-- gives 'NotSimple' for every other frame: one that is not simple, one with a fault, and one that
-- it cannot read, such as every frame of a layout that is not plain ('Layout.isPlain'). Then
-- 'Tape.FrameReader.wordByWord' reads the frame, or reports the fault. Rows have indices from 0.
module Tape.FrameReader.Fast
  ( Read (..),
    readFrame,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Pulses (..))
import Data.Bits (setBit, testBit)
import Data.ByteString.Short (ShortByteString)
import Data.ByteString.Short qualified as Short
import Data.Maybe (isJust)
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Machine.Machine
  ( Axis (..),
    AxisMeasure (..),
    Content (..),
    FeedCode (..),
    MotionCodes (..),
    NumberForm (..),
    Presence (..),
    RotaryAxis,
    Sign (..),
    Word' (..),
  )
import Tape.Layout (LayoutStep (..), PreparedLayout)
import Tape.Layout qualified as Layout
import Tape.ModalState (State (..))
import Tape.ModalState qualified as ModalState
import Tape.NumberReader (Figures (..))
import Tape.NumberReader qualified as NumberReader
import Tape.Symbol (Symbol)
import Tape.Symbol qualified as Symbol
import Prelude hiding (Read)

-- | Result of reading a frame.
data Read
  = -- | the frame and the index of the row after it
    Read Frame Int
  | -- | The frame is not simple, or has a fault, or this reader cannot read it.
    NotSimple

-- | Reads the frame that begins at row @begin@. @state@ is the modal state before the frame.
readFrame :: PreparedLayout -> State -> ShortByteString -> Int -> Read
readFrame layout state rows begin
  | Layout.isPlain layout =
    go False (Layout.simpleSteps layout) begin 0 (withoutWords layout state)
  | otherwise = NotSimple
  where
    -- The words of simple frames are numbered from 0, in the order of the layout.
    go followsWord todo !k !ordinalOfWord !ns = case todo of
      [] -> frameFrom layout state ns k
      FixedStep cs : more ->
        let next = Symbol.rowAfter rows k cs
         in if next >= 0 then go False more next ordinalOfWord ns else NotSimple
      CheckStep _ : _ -> NotSimple
      WordStep w cs joined : more
        | at < 0 ->
          if presence w == Always then NotSimple else go followsWord more k (ordinalOfWord + 1) ns
        | Number next n <- plainNumber layout (form w) rows at,
          next >= 0,
          isExpected w n ->
          go
            True
            more
            next
            (ordinalOfWord + 1)
            (withNumber (content w) n ns {present = present ns `setBit` ordinalOfWord})
        | otherwise -> NotSimple
        where
          at = Layout.rowAfterAddress rows k (if followsWord then joined else cs)
    -- True if the number @n@ of the word @w@ is possible in a simple frame. The frame number and
    -- the position of a rotary axis follow from the state; words of arcs and commands are 0 in a
    -- simple frame.
    isExpected w n = case content w of
      FrameNumber -> n == ordinal state `mod` 10 ^ digits (form w)
      Centre _ -> n == 0
      Command _ -> n == 0
      Motion _ -> True
      Along _ -> True
      About a -> Pulses n == stillNumber layout state a
      FeedWord -> True

-- | Number in the word of the rotary axis @a@ that means no turn: 0, or the present position.
stillNumber :: PreparedLayout -> State -> RotaryAxis -> Pulses
stillNumber layout state a = case ModalState.measure axes of
  Increments -> 0
  Positions -> ModalState.about a (ModalState.turnSigns axes * rotation state)
  where
    axes = Layout.axes layout

-- | Numbers of the words of a frame, as they are on the tape. The numbers of axes are pulses on the
-- machine's axes. For an axis without a word in the frame, the number is the one that means no
-- travel: 0, or the present position.
data Numbers = Numbers
  { -- | bit n is 1 if the frame contains word n of 'Layout.simpleWords', counted from 0
    present :: Int,
    numberX :: Int,
    numberY :: Int,
    numberZ :: Int,
    motionNumber :: Int,
    -- | feed code; −1 if the frame has no feed word
    feedNumber :: Int
  }

-- | Numbers of a frame without any word: no travel along any axis, the code of a straight line, no
-- feed. @state@ is the state before the frame.
withoutWords :: PreparedLayout -> State -> Numbers
withoutWords layout state =
  Numbers
    { present = 0,
      numberX = x,
      numberY = y,
      numberZ = z,
      motionNumber = maybe 0 (straight . snd) (Layout.motionWord layout),
      feedNumber = -1
    }
  where
    Pulses3 (Pulses x) (Pulses y) (Pulses z) = case ModalState.measure (Layout.axes layout) of
      Increments -> 0
      Positions -> ModalState.signs (Layout.axes layout) * position state

-- | Sets the number of the word with the content @c@ to @n@. Frame numbers, rotary axes, centres
-- and commands are not kept, because 'readFrame' has already compared them with the number that
-- they must have.
withNumber :: Content -> Int -> Numbers -> Numbers
withNumber c n ns = case c of
  Along X -> ns {numberX = n}
  Along Y -> ns {numberY = n}
  Along Z -> ns {numberZ = n}
  About _ -> ns
  Motion _ -> ns {motionNumber = n}
  FeedWord -> ns {feedNumber = n}
  FrameNumber -> ns
  Centre _ -> ns
  Command _ -> ns
{-# INLINE withNumber #-}

-- | Frame that the numbers @ns@ describe; @end@ is the index of the row after it. The result is
-- 'NotSimple' unless the frame keeps the rules of the machine, and the machine would write it with
-- exactly the words that were read.
frameFrom :: PreparedLayout -> State -> Numbers -> Int -> Read
frameFrom layout state ns end
  | increment /= 0,
    Just m <- motionOf layout (motionNumber ns),
    code >= 0,
    f <-
      Frame
        { motion = m,
          increment,
          turn = 0,
          centre = 0,
          feedCode = FeedCode code,
          braking = False,
          commands = []
        },
    areThese 0 f (Layout.simpleWords layout),
    null (Frame.frameViolations (Layout.machine layout) 1 f) =
    Read f end
  | otherwise = NotSimple
  where
    axes = Layout.axes layout
    given =
      ModalState.signs axes
        * Pulses3 (Pulses (numberX ns)) (Pulses (numberY ns)) (Pulses (numberZ ns))
    increment = case ModalState.measure axes of
      Increments -> given
      Positions -> given - position state
    code = case motionOf layout (motionNumber ns) of
      Just Rapid -> max 0 (feedNumber ns)
      _
        | feedNumber ns >= 0 -> feedNumber ns
        | Layout.isFeedModal layout, Just (FeedCode n) <- feed state -> n
        | otherwise -> -1
    areThese :: Int -> Frame -> [Word'] -> Bool
    areThese ordinalOfWord f ws = case ws of
      [] -> True
      w : more ->
        isJust (ModalState.number axes state f w) == testBit (present ns) ordinalOfWord
          && areThese (ordinalOfWord + 1) f more

-- | Motion that a code means: a line or a rapid move; 'Nothing' for all other codes. On a machine
-- without a motion word every motion is a line.
motionOf :: PreparedLayout -> Int -> Maybe FrameMotion
motionOf layout code = case Layout.motionWord layout of
  Nothing -> Just Linear
  Just (_, codes)
    | code == straight codes -> Just Linear
    | Just code == rapid codes -> Just Rapid
    | otherwise -> Nothing

-- | Index of the row after a number, and the number. The index is −1 if the rows are not those that
-- the machine would write for a number.
data Number = Number Int Int

-- | Reads a number that begins at row @begin@. Its form @f@ uses no service track, the track whose
-- holes give a digit an extra meaning.
plainNumber :: PreparedLayout -> NumberForm -> ShortByteString -> Int -> Number
plainNumber layout f rows begin = case sign f of
  Unsigned -> unsigned False begin
  MinusSign ->
    if isHere (Layout.minus layout) then unsigned True (begin + 1) else unsigned False begin
  EitherSign
    | isHere (Layout.minus layout) -> unsigned True (begin + 1)
    | isHere (Layout.plus layout) -> unsigned False (begin + 1)
    | otherwise -> none
  ServiceSign -> none
  Priority {} -> none
  where
    none = Number (-1) 0
    isHere :: Symbol -> Bool
    isHere s = begin < Short.length rows && Short.index rows begin == Symbol.holes s
    unsigned minus from =
      case NumberReader.plainFigures layout rows (from + digits f - decimals f) from 0 of
        Figures at n
          | decimals f == 0 -> finished minus (at - from) at n
          | at < Short.length rows,
            Short.index rows at == Symbol.holes (Layout.point layout),
            Figures end m <- NumberReader.plainFigures layout rows (at + 1 + decimals f) (at + 1) n,
            end == at + 1 + decimals f ->
            finished minus (end - from - 1) end m
          | otherwise -> none
    finished minus count end n
      | Layout.isDigitCount f count n && not (minus && n == 0) =
        Number end (if minus then negate n else n)
      | otherwise = none
{-# INLINE plainNumber #-}
