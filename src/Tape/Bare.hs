{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Frames that walk no arc and command nothing, read in one go: most frames of a long tape are of this kind.
--
-- What is read here is what "Tape.Reading" reads word by word. All that is not as it would be written is left to it, and so is what to
-- say of a fault.
module Tape.Bare
  ( Read (..),
    readFrame,
  )
where

import Base.Lattice (V3 (..))
import Base.Quantity (Pulses (..))
import Data.Bits (setBit, testBit)
import Data.ByteString.Short (ShortByteString)
import Data.ByteString.Short qualified as Short
import Data.Maybe (isJust)
import Frame.Frame (Frame (..), Motion (..))
import Frame.Frame qualified as Frame
import Machine.Machine (Axis (..), Content (..), FeedCode (..), Measure (..), MotionCodes (..), NumberForm (..), Presence (..), Sign (..), Word' (..))
import Tape.Numeral (Figures (..))
import Tape.Numeral qualified as Numeral
import Tape.Plan (Plan, Step (..))
import Tape.Plan qualified as Plan
import Tape.State (State (..))
import Tape.State qualified as State
import Tape.Symbol (Symbol)
import Tape.Symbol qualified as Symbol
import Prelude hiding (Read)

-- | The frame and the row behind it; or it is another kind of frame, or not as it would be written.
data Read = Read Frame Int | NotBare

-- | The frame that begins at a row.
readFrame :: Plan -> State -> ShortByteString -> Int -> Read
readFrame plan state rows begin
  | Plan.isPlain plan = go False (Plan.bareSteps plan) begin 0 (before plan state)
  | otherwise = NotBare
  where
    -- The words are numbered from 0.
    go behindWord todo !k !number !ns = case todo of
      [] -> made plan state ns k
      Fixed cs : more -> let next = Symbol.behind rows k cs in if next >= 0 then go False more next number ns else NotBare
      Checked _ : _ -> NotBare
      Worded w cs joined : more
        | at < 0 -> if presence w == Always then NotBare else go behindWord more k (number + 1) ns
        | Plain next n <- plainNumber plan (form w) rows at, next >= 0, isExpected w n -> go True more next (number + 1) (saying (content w) n ns {standing = standing ns `setBit` number})
        | otherwise -> NotBare
        where
          at = Plan.behindAddress rows k (if behindWord then joined else cs)
    -- What is known without the frame.
    isExpected w n = case content w of
      FrameNumber -> n == ordinal state `mod` 10 ^ digits (form w)
      Centre _ -> n == 0
      Command _ -> n == 0
      Motion _ -> True
      Along _ -> True
      FeedWord -> True

-- | Which words stand there, by bits, and what they say.
data Numbers = Numbers {standing :: Int, alongX :: Int, alongY :: Int, alongZ :: Int, motionCode :: Int, feedCode :: Int}

-- | What is true where no word says anything else: the cutter stays where it is, goes straight and as fast as before.
before :: Plan -> State -> Numbers
before plan state = Numbers {standing = 0, alongX = x, alongY = y, alongZ = z, motionCode = maybe 0 (straight . snd) (Plan.motions plan), feedCode = -1}
  where
    V3 (Pulses x) (Pulses y) (Pulses z) = case State.measure (Plan.axes plan) of
      Increments -> 0
      Positions -> State.signs (Plan.axes plan) * place state

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

-- | The frame that moves as the words say, up to a row, if just these words would be written for it.
made :: Plan -> State -> Numbers -> Int -> Read
made plan state ns end
  | moved /= 0,
    Just m <- motionOf plan (motionCode ns),
    code >= 0,
    f <- Frame {motion = m, increment = moved, centre = 0, speed = FeedCode code, braking = False, orders = []},
    areThese 0 f (Plan.bareWords plan),
    null (Frame.broken (Plan.machine plan) 1 f) =
    Read f end
  | otherwise = NotBare
  where
    axes = Plan.axes plan
    there = State.signs axes * V3 (Pulses (alongX ns)) (Pulses (alongY ns)) (Pulses (alongZ ns))
    moved = case State.measure axes of
      Increments -> there
      Positions -> there - place state
    code = case motionOf plan (motionCode ns) of
      Just Rapid -> max 0 (feedCode ns)
      _
        | feedCode ns >= 0 -> feedCode ns
        | Plan.keepsFeed plan, Just (FeedCode n) <- feed state -> n
        | otherwise -> -1
    areThese :: Int -> Frame -> [Word'] -> Bool
    areThese number f ws = case ws of
      [] -> True
      w : more -> isJust (State.number axes state f w) == testBit (standing ns) number && areThese (number + 1) f more

-- | A straight motion by its number; where no word says it all motions are straight.
motionOf :: Plan -> Int -> Maybe Motion
motionOf plan code = case Plan.motions plan of
  Nothing -> Just Straightway
  Just (_, codes)
    | code == straight codes -> Just Straightway
    | Just code == rapid codes -> Just Rapid
    | otherwise -> Nothing

-- | The row behind a number, and the number; the row is below 0 if there is none, or if it would be written otherwise.
data Plain = Plain Int Int

plainNumber :: Plan -> NumberForm -> ShortByteString -> Int -> Plain
plainNumber plan f rows begin = case sign f of
  Unsigned -> unsigned False begin
  MinusSign -> if here (Plan.minus plan) then unsigned True (begin + 1) else unsigned False begin
  EitherSign
    | here (Plan.minus plan) -> unsigned True (begin + 1)
    | here (Plan.plus plan) -> unsigned False (begin + 1)
    | otherwise -> none
  ServiceSign -> none
  Priority {} -> none
  where
    none = Plain (-1) 0
    here :: Symbol -> Bool
    here s = begin < Short.length rows && Short.index rows begin == Symbol.holes s
    unsigned minus from = case Numeral.plainFigures plan rows (from + digits f - decimals f) from 0 of
      Figures at n
        | decimals f == 0 -> finished minus (at - from) at n
        | at < Short.length rows, Short.index rows at == Symbol.holes (Plan.point plan), Figures end m <- Numeral.plainFigures plan rows (at + 1 + decimals f) (at + 1) n, end == at + 1 + decimals f -> finished minus (end - from - 1) end m
        | otherwise -> none
    finished minus places end n
      | Plan.isCount f places n && not (minus && n == 0) = Plain end (if minus then negate n else n)
      | otherwise = none
{-# INLINE plainNumber #-}
