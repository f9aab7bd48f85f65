{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Simple frames, without arcs and commands, read in one go. Most frames of a long tape are
-- simple.
--
-- The result is always that of 'Tape.FrameReader.wordByWord'. Rows that differ in any respect from
-- those that would be written are left to that reader, and so are the reports about faults.
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
  | -- | a frame that is not simple, or that would be written with other rows
    NotSimple

-- | Frame that begins at row @begin@.
readFrame :: PreparedLayout -> State -> ShortByteString -> Int -> Read
readFrame layout state rows begin
  | Layout.isPlain layout =
    go False (Layout.simpleSteps layout) begin 0 (withoutWords layout state)
  | otherwise = NotSimple
  where
    -- The words are numbered from 0.
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
    -- Numbers that are known before the frame is.
    isExpected w n = case content w of
      FrameNumber -> n == ordinal state `mod` 10 ^ digits (form w)
      Centre _ -> n == 0
      Command _ -> n == 0
      Motion _ -> True
      Along _ -> True
      FeedWord -> True

-- | Words of a frame by the bits of their ordinals, and the numbers of the relevant ones.
data Numbers = Numbers
  { present :: Int,
    numberX :: Int,
    numberY :: Int,
    numberZ :: Int,
    motionNumber :: Int,
    -- | −1 if there is no feed word
    feedNumber :: Int
  }

-- | Numbers of a frame without words: the cutter stays in place, and the motion is straight.
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

withNumber :: Content -> Int -> Numbers -> Numbers
withNumber c n ns = case c of
  Along X -> ns {numberX = n}
  Along Y -> ns {numberY = n}
  Along Z -> ns {numberZ = n}
  Motion _ -> ns {motionNumber = n}
  FeedWord -> ns {feedNumber = n}
  FrameNumber -> ns
  Centre _ -> ns
  Command _ -> ns
{-# INLINE withNumber #-}

-- | Frame with these numbers that ends before row @end@, if exactly these words would be written
-- for it.
frameFrom :: PreparedLayout -> State -> Numbers -> Int -> Read
frameFrom layout state ns end
  | increment /= 0,
    Just m <- motionOf layout (motionNumber ns),
    code >= 0,
    f <-
      Frame
        { motion = m,
          increment,
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

-- | Straight or rapid motion of a number; on a machine without a word for it every motion is
-- straight.
motionOf :: PreparedLayout -> Int -> Maybe FrameMotion
motionOf layout code = case Layout.motionWord layout of
  Nothing -> Just Linear
  Just (_, codes)
    | code == straight codes -> Just Linear
    | Just code == rapid codes -> Just Rapid
    | otherwise -> Nothing

-- | Index of the row after a number, and the number. The index is −1 if there is no number, or if
-- it would be written with other rows.
data Number = Number Int Int

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
