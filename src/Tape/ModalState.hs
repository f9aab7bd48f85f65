-- | Modal state: the values that stay in force from frame to frame. From the state and a frame,
-- 'number' computes the number of each word of the frame, for the writer and for the readers.
--
-- A frame is a block of ISO 6983. A /simple frame/ has neither an arc nor a command, and turns no
-- rotary axis. A pulse is the smallest step of an axis.
module Tape.ModalState
  ( State (..),
    initial,
    changesHeight,
    Axes (..),
    axes,
    along,
    about,
    number,
    isSimple,
    occursInSimple,
    isZeroCommand,
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
    RotaryAxis (..),
    RotaryForm (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine

-- | Modal state of a tape before a frame.
data State = State
  { -- | number of the next frame, from 1
    ordinal :: Int,
    -- | position of the cutter in pulses, along the axes of the part
    position :: Pulses3,
    -- | position of the rotary axes a and b in pulses; 0 before the first frame
    rotation :: Pulses2,
    -- | axes whose position the tape still has to give: the next frame that moves gives it, even if
    -- it is unchanged. Only tapes with absolute positions use this field.
    unwritten :: [Axis],
    -- | last feed code on the tape; 'Nothing' before the first one
    feed :: Maybe FeedCode
  }
  deriving stock (Eq, Show)

-- | State before the first frame. @changesZ@ is true if some frame of the tape changes the height;
-- @start@ is the position of the cutter in pulses.
--
-- On a tape with absolute positions the first frame that moves gives x and y, even if they are
-- unchanged. It also gives z if some frame changes the height. If no frame does, the operator sets
-- the height by hand. A position of a rotary axis is written only in frames that turn the axis.
initial :: Bool -> Pulses3 -> State
initial changesZ start =
  State
    { ordinal = 1,
      position = start,
      rotation = 0,
      unwritten = [X, Y] <> [Z | changesZ],
      feed = Nothing
    }

-- | True if one of the frames moves along z.
changesHeight :: [Frame] -> Bool
changesHeight = any (\f -> let Pulses3 _ _ z = increment f in z /= 0)

-- | Axes of the machine relative to those of the part.
data Axes = Axes
  { -- | meaning of the axis words: increments or absolute positions
    measure :: AxisMeasure,
    -- | for each axis, the factor from the part's axis to the machine's: 1 if both have the same
    -- direction, −1 if the machine's axis is reversed
    signs :: Pulses3,
    -- | the same factors for the rotary axes a and b
    turnSigns :: Pulses2,
    -- | true if clockwise arcs of the part are counter-clockwise on the machine
    isMirrored :: Bool
  }

-- | Axes of a machine relative to those of the part.
axes :: Machine -> Axes
axes machine =
  Axes
    { measure = Machine.measure (Machine.layout machine),
      signs = Pulses3 (sign X) (sign Y) (sign Z),
      turnSigns = Pulses2 (turnSign A) (turnSign B),
      isMirrored = Machine.isMirrored machine
    }
  where
    sign a =
      if or [reversed f | f <- NonEmpty.toList (Machine.axes machine), axis f == a] then -1 else 1
    turnSign a = if maybe False turnsReversed (Machine.rotaryForm machine a) then -1 else 1

-- | Component of a vector along an axis.
along :: Axis -> Pulses3 -> Pulses
along a (Pulses3 x y z) = case a of
  X -> x
  Y -> y
  Z -> z

-- | Component of a vector about a rotary axis.
about :: RotaryAxis -> Pulses2 -> Pulses
about axis (Pulses2 a b) = case axis of
  A -> a
  B -> b

-- | Number of a word in a frame. The content of the word decides which number it is: pulses on the
-- machine's axes, a code, the number of a command, or the frame number. 'Nothing' if the frame is
-- written without this word. @state@ is the modal state before the frame.
number :: Axes -> State -> Frame -> Word' -> Maybe Int
number system state frame word = case content word of
  FrameNumber ->
    present (presence word /= InMotion || moving) (ordinal state `mod` 10 ^ digits (form word))
  Motion codes ->
    present
      (presence word == Always || moving)
      (motionNumber (isMirrored system) codes (motion frame))
  Along a ->
    present (isAxisPresent system state frame (presence word) a) (axisNumber system state frame a)
  About a -> present (isTurnPresent frame (presence word) a) (turnNumber system state frame a)
  Centre a -> present (isCentrePresent (presence word)) (centreNumber a)
  FeedWord -> present (isFeedPresent (presence word)) code
  Command o -> commandNumber (presence word) o
  where
    present yes n = if yes then Just $! n else Nothing
    moving = Frame.isMoving frame
    code = Machine.codeNumber (feedCode frame)
    centreNumber a =
      let Pulses2 i j = centre frame; Pulses n = along a (signs system * Pulses3 i j 0) in n
    isCentrePresent p = case p of
      Always -> True
      InMotion -> moving
      WhenNeeded -> isArc frame
      WhenChanged -> isArc frame
    isFeedPresent p = case p of
      Always -> True
      InMotion -> moving
      WhenNeeded -> hasFeed frame
      WhenChanged -> hasFeed frame && feed state /= Just (feedCode frame)
    commandNumber p o = case p of
      Always -> Just (fromMaybe 0 (given o))
      InMotion -> if moving then Just (fromMaybe 0 (given o)) else given o
      WhenNeeded -> given o
      WhenChanged -> given o
    given :: CommandName -> Maybe Int
    given o = lookup o (commands frame)

-- | True for a simple frame. Most frames are simple, and there is a faster reader for them.
isSimple :: Frame -> Bool
isSimple frame = null (commands frame) && not (isArc frame) && turn frame == 0

-- | True for a word that can occur in a simple frame. For every other word 'number' gives 'Nothing'
-- in every simple frame.
occursInSimple :: Word' -> Bool
occursInSimple word = case content word of
  Centre _ -> occursAnyway
  Command _ -> occursAnyway
  About _ -> occursAnyway
  FrameNumber -> True
  Motion _ -> True
  Along _ -> True
  FeedWord -> True
  where
    occursAnyway = case presence word of
      Always -> True
      InMotion -> True
      WhenNeeded -> False
      WhenChanged -> False

-- | True for a command word in which the number 0 gives a command. False for a command word that is
-- in every frame, or in every frame that moves: there, 0 means that the frame has no such command.
isZeroCommand :: Word' -> Bool
isZeroCommand word = case presence word of
  Always -> False
  InMotion -> False
  WhenNeeded -> True
  WhenChanged -> True

-- | Code of a motion; @mirror@ is true if the machine's axes mirror the part ('isMirrored'). A
-- frame without motion gets the code of a straight line, because some machines have a motion word
-- in every frame.
motionNumber :: Bool -> MotionCodes -> FrameMotion -> Int
motionNumber mirror codes m = case m of
  NoMotion -> straight codes
  Linear -> straight codes
  Rapid -> fromMaybe (straight codes) (rapid codes)
  Circular sense
    | (sense == Clockwise) /= mirror -> fromMaybe (straight codes) (clockwise codes)
    | otherwise -> fromMaybe (straight codes) (counterClockwise codes)

isArc :: Frame -> Bool
isArc frame = case motion frame of
  Circular _ -> True
  NoMotion -> False
  Rapid -> False
  Linear -> False

-- | True for a frame that moves at a feed: a line or an arc, no rapid move.
hasFeed :: Frame -> Bool
hasFeed frame = case motion frame of
  Circular _ -> True
  Linear -> True
  NoMotion -> False
  Rapid -> False

isAxisPresent :: Axes -> State -> Frame -> Presence -> Axis -> Bool
isAxisPresent system state frame p a = case p of
  Always -> True
  InMotion -> Frame.isMoving frame
  WhenNeeded -> isNeeded
  WhenChanged -> isNeeded
  where
    isNeeded =
      Frame.isMoving frame
        && ( along a (increment frame) /= 0
               || measure system == Positions && a `elem` unwritten state
           )

axisNumber :: Axes -> State -> Frame -> Axis -> Int
axisNumber system state frame a = n
  where
    Pulses n = along a (signs system) * measured
    measured = case measure system of
      Increments -> along a (increment frame)
      Positions -> along a (position state) + along a (increment frame)

isTurnPresent :: Frame -> Presence -> RotaryAxis -> Bool
isTurnPresent frame p a = case p of
  Always -> True
  InMotion -> Frame.isMoving frame
  WhenNeeded -> isNeeded
  WhenChanged -> isNeeded
  where
    isNeeded = Frame.turnAbout a frame /= 0

turnNumber :: Axes -> State -> Frame -> RotaryAxis -> Int
turnNumber system state frame a = n
  where
    Pulses n = about a (turnSigns system) * measured
    measured = case measure system of
      Increments -> Frame.turnAbout a frame
      Positions -> about a (rotation state) + Frame.turnAbout a frame

-- | State after a frame, from the words @ws@ of the layout and the state before the frame.
after :: Axes -> [Word'] -> State -> Frame -> State
after system ws state frame =
  State
    { ordinal = ordinal state + 1,
      position = position state + increment frame,
      rotation = rotation state + turn frame,
      unwritten = case measure system of
        Increments -> unwritten state
        Positions -> filter (not . isWritten) (unwritten state),
      feed =
        if hasFeed frame && feed state /= Just (feedCode frame)
          then Just (feedCode frame)
          else feed state
    }
  where
    isWritten a = or [isJust (number system state frame w) | w <- ws, content w == Along a]
