-- | The layout of a frame: its words, literal symbols and check digit, in order.
--
-- Writer and reader of tapes both follow the layout. A machine with fixed fields has words without
-- addresses.
module Machine.FrameLayout
  ( Layout (..),
    AxisMeasure (..),
    LayoutItem (..),
    Word' (..),
    Content (..),
    MotionCodes (..),
    NumberForm (..),
    Sign (..),
    Service (..),
    Presence (..),
    CommandName (..),
    contentName,
    capacityOf,
  )
where

import Data.List.NonEmpty (NonEmpty (..))
import Data.Text (Text)
import Machine.Axis (Axis, axisName)

-- | Items of a frame in their order on the tape.
data Layout = Layout
  { items :: NonEmpty LayoutItem,
    measure :: AxisMeasure,
    -- | symbols between two words
    separator :: Text
  }
  deriving stock (Eq, Show)

-- | Meaning of the words of axes: increments from the last point, or absolute positions. Centres of
-- arcs are always relative to the start of the arc.
data AxisMeasure = Increments | Positions
  deriving stock (Eq, Show)

-- | One part of a frame.
data LayoutItem
  = -- | symbols that every frame contains here
    Literal Text
  | AWord Word'
  | -- | digit that makes the sum of the weights of all symbols in the frame a multiple of this
    -- number
    CheckDigit Int
  deriving stock (Eq, Show)

-- | A word: an address and a number.
data Word' = Word'
  { -- | symbols before the number; empty for a fixed field
    address :: Text,
    content :: Content,
    form :: NumberForm,
    presence :: Presence
  }
  deriving stock (Eq, Show)

-- | Meaning of a word's number.
data Content
  = -- | number of the frame, from 1, modulo the capacity of the digits
    FrameNumber
  | Motion MotionCodes
  | Along Axis
  | -- | centre of an arc, relative to the start of the arc
    Centre Axis
  | FeedWord
  | Command CommandName
  deriving stock (Eq, Show)

-- | Codes of the kinds of motion; 'Nothing' for a kind that the machine lacks.
data MotionCodes = MotionCodes
  { rapid :: Maybe Int,
    straight :: Int,
    clockwise :: Maybe Int,
    counterClockwise :: Maybe Int
  }
  deriving stock (Eq, Show)

-- | Format of the number in a word.
data NumberForm = NumberForm
  { -- | number of digits, decimals included; a maximum if the number is not padded
    digits :: Int,
    -- | true if the number always has all its digits
    padded :: Bool,
    -- | number of digits after the decimal point; 0 if there is no point
    decimals :: Int,
    sign :: Sign,
    -- | meaning of the service track at each digit; empty without a service track
    service :: [Service]
  }
  deriving stock (Eq, Show)

-- | Notation of a number's sign.
data Sign
  = -- | no sign; the number is never negative
    Unsigned
  | -- | a hole in the service track, 'MinusHole'
    ServiceSign
  | -- | a minus before a negative number
    MinusSign
  | -- | plus or minus before every number
    EitherSign
  | -- | A digit before the number. It gives the direction, and says if this is the leading axis.
    -- The digits mean: leading forwards, leading backwards, following forwards, following
    -- backwards. Of several axes with most pulses, the first one leads.
    Priority Int Int Int Int
  deriving stock (Eq, Show)

-- | Meaning of a hole in the service track of one row.
data Service
  = -- | The number is negative.
    MinusHole
  | -- | Bit of a command's number, counted from the lowest.
    CommandBit CommandName Int
  | -- | The row always has a hole.
    Marker
  | -- | The machine slows down to the feed of this frame.
    BrakingHole
  | -- | The row never has a hole.
    NoHole
  deriving stock (Eq, Show)

-- | Condition under which a frame contains a word.
data Presence
  = -- | in every frame
    Always
  | -- | in frames that move
    InMotion
  | -- | Depends on the content. For an axis: in frames that move it, or before its position is
    -- known. For a centre: in arcs. For a command: in frames that give it.
    WhenNeeded
  | -- | for a feed: in frames that move at another feed than the last one
    WhenChanged
  deriving stock (Eq, Show)

-- | Name of the word or the service bits that hold a command.
newtype CommandName = CommandName Text
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | Names the content of a word in a report.
contentName :: Content -> Text
contentName c = case c of
  FrameNumber -> "frame number"
  Motion _ -> "kind of motion"
  Along a -> axisName a
  Centre a -> "centre " <> axisName a
  FeedWord -> "feed"
  Command (CommandName n) -> "command " <> n

-- | Largest number that fits the digits; at most 10^17 − 1.
capacityOf :: NumberForm -> Int
capacityOf f = 10 ^ min 17 (digits f) - 1
