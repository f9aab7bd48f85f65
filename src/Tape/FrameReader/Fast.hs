{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Frames that walk no arc and command nothing, read in one go: most frames of a long tape are of
-- this kind.
--
-- What is read here is what "Tape.FrameReader" reads word by word. All that is not as it would be
-- written is left to it, and so is what to say of a fault.
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
import Tape.Layout (Layout, LayoutStep (..))
import Tape.Layout qualified as Layout
import Tape.ModalState (State (..))
import Tape.ModalState qualified as ModalState
import Tape.NumberReader (Figures (..))
import Tape.NumberReader qualified as NumberReader
import Tape.Symbol (Symbol)
import Tape.Symbol qualified as Symbol
import Prelude hiding (Read)

-- | The frame and the row behind it; or it is another kind of frame, or not as it would be written.
data Read = Read Frame Int | NotBare

-- | The frame that begins at a row.
readFrame :: Layout -> State -> ShortByteString -> Int -> Read
readFrame plan state rows begin
  | Layout.isPlain plan = go False (Layout.bareSteps plan) begin 0 (before plan state)
  | otherwise = NotBare
  where
    -- The words are numbered from 0.
    go behindWord todo !k !number !ns = case todo of
      [] -> made plan state ns k
      Fixed cs : more ->
        let next =
              Symbol.behind rows k cs
         in if next >= 0 then go False more next number ns else NotBare
      Checked _ : _ -> NotBare
      Worded w cs joined : more
        | at < 0 -> if presence w == Always then NotBare else go behindWord more k (number + 1) ns
        | Plain next n <- plainNumber plan (form w) rows at,
          next >= 0,
          isExpected w n ->
          go
            True
            more
            next
            (number + 1)
            (saying (content w) n ns {standing = standing ns `setBit` number})
        | otherwise -> NotBare
        where
          at = Layout.behindAddress rows k (if behindWord then joined else cs)
    -- What is known without the frame.
    isExpected w n = case content w of
      FrameNumber -> n == ordinal state `mod` 10 ^ digits (form w)
      Centre _ -> n == 0
      Command _ -> n == 0
      Motion _ -> True
      Along _ -> True
      FeedWord -> True

-- | Which words stand there, by bits, and what they say.
data Numbers = Numbers
  { standing :: Int,
    alongX :: Int,
    alongY :: Int,
    alongZ :: Int,
    motionCode :: Int,
    feedCode :: Int
  }

-- | What is true where no word says anything else: the cutter stays where it is, goes straight and
-- as fast as before.
before :: Layout -> State -> Numbers
before plan state =
  Numbers
    { standing = 0,
      alongX = x,
      alongY = y,
      alongZ = z,
      motionCode = maybe 0 (straight . snd) (Layout.motions plan),
      feedCode = -1
    }
  where
    Pulses3 (Pulses x) (Pulses y) (Pulses z) = case ModalState.measure (Layout.axes plan) of
      Increments -> 0
      Positions -> ModalState.signs (Layout.axes plan) * place state

saying :: Content -> Int -> Numbers -> Numbers
saying c n ns = case c of
  Along X -> ns {alongX = n}
  Along Y -> ns {alongY = n}
  Along Z -> ns {alongZ = n}
  Motion _ -> ns {motionCode = n}
  FeedWord -> ns {feedCode = n}
  FrameNumber -> ns
  Centre _ -> ns
  Command _ -> ns
{-# INLINE saying #-}

-- | The frame that moves as the words say, up to a row, if just these words would be written for
-- it.
made :: Layout -> State -> Numbers -> Int -> Read
made plan state ns end
  | moved /= 0,
    Just m <- motionOf plan (motionCode ns),
    code >= 0,
    f <-
      Frame
        { motion = m,
          increment = moved,
          centre = 0,
          speed = FeedCode code,
          braking = False,
          orders = []
        },
    areThese 0 f (Layout.bareWords plan),
    null (Frame.broken (Layout.machine plan) 1 f) =
    Read f end
  | otherwise = NotBare
  where
    axes = Layout.axes plan
    there =
      ModalState.signs axes * Pulses3 (Pulses (alongX ns)) (Pulses (alongY ns)) (Pulses (alongZ ns))
    moved = case ModalState.measure axes of
      Increments -> there
      Positions -> there - place state
    code = case motionOf plan (motionCode ns) of
      Just Rapid -> max 0 (feedCode ns)
      _
        | feedCode ns >= 0 -> feedCode ns
        | Layout.keepsFeed plan, Just (FeedCode n) <- feed state -> n
        | otherwise -> -1
    areThese :: Int -> Frame -> [Word'] -> Bool
    areThese number f ws = case ws of
      [] -> True
      w : more ->
        isJust (ModalState.number axes state f w) == testBit (standing ns) number
          && areThese (number + 1) f more

-- | A straight motion by its number; where no word says it all motions are straight.
motionOf :: Layout -> Int -> Maybe FrameMotion
motionOf plan code = case Layout.motions plan of
  Nothing -> Just Straightway
  Just (_, codes)
    | code == straight codes -> Just Straightway
    | Just code == rapid codes -> Just Rapid
    | otherwise -> Nothing

-- | The row behind a number, and the number; the row is below 0 if there is none, or if it would be
-- written otherwise.
data Plain = Plain Int Int

plainNumber :: Layout -> NumberForm -> ShortByteString -> Int -> Plain
plainNumber plan f rows begin = case sign f of
  Unsigned -> unsigned False begin
  MinusSign -> if here (Layout.minus plan) then unsigned True (begin + 1) else unsigned False begin
  EitherSign
    | here (Layout.minus plan) -> unsigned True (begin + 1)
    | here (Layout.plus plan) -> unsigned False (begin + 1)
    | otherwise -> none
  ServiceSign -> none
  Priority {} -> none
  where
    none = Plain (-1) 0
    here :: Symbol -> Bool
    here s = begin < Short.length rows && Short.index rows begin == Symbol.holes s
    unsigned minus from =
      case NumberReader.plainFigures plan rows (from + digits f - decimals f) from 0 of
        Figures at n
          | decimals f == 0 -> finished minus (at - from) at n
          | at < Short.length rows,
            Short.index rows at == Symbol.holes (Layout.point plan),
            Figures end m <- NumberReader.plainFigures plan rows (at + 1 + decimals f) (at + 1) n,
            end == at + 1 + decimals f ->
            finished minus (end - from - 1) end m
          | otherwise -> none
    finished minus places end n
      | Layout.isCount f places n && not (minus && n == 0) =
        Plain end (if minus then negate n else n)
      | otherwise = none
{-# INLINE plainNumber #-}
