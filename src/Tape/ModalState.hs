{-# OPTIONS_GHC -O2 #-}

-- | What a layout remembers from frame to frame.
module Tape.ModalState
  ( State (..),
    first,
    rising,
    Axes (..),
    axes,
    along,
    number,
    isBare,
    standsBare,
    zeroCommands,
    after,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust)
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Machine.Machine
  ( Axis (..),
    AxisForm (..),
    AxisMeasure (..),
    CommandName,
    Content (..),
    FeedCode (..),
    Machine,
    MotionCodes (..),
    NumberForm (..),
    Presence (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine

data State = State
  { -- | of the next frame, from 1
    ordinal :: Int,
    -- | where the cutter stands, along the axes of the part
    place :: Pulses3,
    -- | the axes whose position the tape has not said yet
    unsaid :: [Axis],
    -- | the feed said last
    feed :: Maybe FeedCode
  }
  deriving stock (Eq, Show)

-- | Before the first frame: whether the tape has to do with heights, and where the cutter stands.
-- The first frame that moves says where it goes; its height only if that ever changes, since else
-- it is set by hand.
first :: Bool -> Pulses3 -> State
first rises start =
  State {ordinal = 1, place = start, unsaid = [X, Y] <> [Z | rises], feed = Nothing}

-- | Whether frames change the height.
rising :: [Frame] -> Bool
rising = any (\f -> let Pulses3 _ _ z = increment f in z /= 0)

-- | How the axes of the tape lie to those of the part.
data Axes = Axes
  { measure :: AxisMeasure,
    -- | 1, or −1 for an axis that points the other way
    signs :: Pulses3,
    -- | seen from the machine clockwise arcs of the part are counter-clockwise
    mirrored :: Bool
  }

axes :: Machine -> Axes
axes machine =
  Axes
    { measure = Machine.measure (Machine.layout machine),
      signs = Pulses3 (sign X) (sign Y) (sign Z),
      mirrored = Machine.isMirrored machine
    }
  where
    sign a =
      if or [reversed f | f <- NonEmpty.toList (Machine.axes machine), axis f == a] then -1 else 1

-- | The component along an axis.
along :: Axis -> Pulses3 -> Pulses
along a (Pulses3 x y z) = case a of
  X -> x
  Y -> y
  Z -> z

-- | The number that a word of a frame holds; nothing where the frame has no such word.
number :: Axes -> State -> Frame -> Word' -> Maybe Int
number system state frame word = case content word of
  FrameNumber ->
    standing (presence word /= InMotion || moving) (ordinal state `mod` 10 ^ digits (form word))
  Motion codes ->
    standing
      (presence word == Always || moving)
      (motionNumber (mirrored system) codes (motion frame))
  Along a ->
    standing (axisStands system state frame (presence word) a) (axisNumber system state frame a)
  Centre a -> standing (centreStands (presence word)) (centreNumber a)
  FeedWord -> standing (feedStands (presence word)) code
  Command o -> commandNumber (presence word) o
  where
    standing yes n = if yes then Just $! n else Nothing
    moving = Frame.isMoving frame
    FeedCode code = speed frame
    centreNumber a =
      let Pulses2 i j = centre frame; Pulses n = along a (signs system * Pulses3 i j 0) in n
    centreStands p = case p of
      Always -> True
      InMotion -> moving
      WhenNeeded -> isArc frame
      WhenChanged -> isArc frame
    feedStands p = case p of
      Always -> True
      InMotion -> moving
      WhenNeeded -> hasFeed frame
      WhenChanged -> hasFeed frame && feed state /= Just (speed frame)
    commandNumber p o = case p of
      Always -> Just (fromMaybe 0 (given o))
      InMotion -> if moving then Just (fromMaybe 0 (given o)) else given o
      WhenNeeded -> given o
      WhenChanged -> given o
    given :: CommandName -> Maybe Int
    given o = lookup o (orders frame)

-- | Whether a frame walks no arc and commands nothing.
isBare :: Frame -> Bool
isBare frame = null (orders frame) && not (isArc frame)

-- | Whether a word can stand in a frame that walks no arc and commands nothing. Another word has no
-- 'number' there.
standsBare :: Word' -> Bool
standsBare word = case content word of
  Centre _ -> standsAnyway
  Command _ -> standsAnyway
  FrameNumber -> True
  Motion _ -> True
  Along _ -> True
  FeedWord -> True
  where
    standsAnyway = case presence word of
      Always -> True
      InMotion -> True
      WhenNeeded -> False
      WhenChanged -> False

-- | Whether 0 in the word of a command is a command: where the word stands without one, 0 says that
-- there is none.
zeroCommands :: Word' -> Bool
zeroCommands word = case presence word of
  Always -> False
  InMotion -> False
  WhenNeeded -> True
  WhenChanged -> True

-- | Which number says a motion. A frame without motion that must say one says a straight move.
motionNumber :: Bool -> MotionCodes -> FrameMotion -> Int
motionNumber mirror codes m = case m of
  Still -> straight codes
  Straightway -> straight codes
  Rapid -> fromMaybe (straight codes) (rapid codes)
  Round turn
    | (turn == Clockwise) /= mirror -> fromMaybe (straight codes) (clockwise codes)
    | otherwise -> fromMaybe (straight codes) (counterClockwise codes)

isArc :: Frame -> Bool
isArc frame = case motion frame of
  Round _ -> True
  Still -> False
  Rapid -> False
  Straightway -> False

-- | Whether the frame moves at a feed.
hasFeed :: Frame -> Bool
hasFeed frame = case motion frame of
  Round _ -> True
  Straightway -> True
  Still -> False
  Rapid -> False

axisStands :: Axes -> State -> Frame -> Presence -> Axis -> Bool
axisStands system state frame p a = case p of
  Always -> True
  InMotion -> Frame.isMoving frame
  WhenNeeded -> needed
  WhenChanged -> needed
  where
    needed =
      Frame.isMoving frame
        && (along a (increment frame) /= 0 || measure system == Positions && a `elem` unsaid state)

axisNumber :: Axes -> State -> Frame -> Axis -> Int
axisNumber system state frame a = n
  where
    Pulses n = along a (signs system) * counted
    counted = case measure system of
      Increments -> along a (increment frame)
      Positions -> along a (place state) + along a (increment frame)

-- | After a frame with words.
after :: Axes -> [Word'] -> State -> Frame -> State
after system ws state frame =
  State
    { ordinal = ordinal state + 1,
      place = place state + increment frame,
      unsaid = case measure system of
        Increments -> unsaid state
        Positions -> filter (not . isSaid) (unsaid state),
      feed =
        if hasFeed frame && feed state /= Just (speed frame) then Just (speed frame) else feed state
    }
  where
    isSaid a = or [isJust (number system state frame w) | w <- ws, content w == Along a]
