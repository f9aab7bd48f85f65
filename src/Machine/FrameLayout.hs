-- | The layout of a frame: its words, literal symbols and check digit, in order.
--
-- The writer and the reader of tapes both follow the layout. A fixed field is a word without an
-- address, which the reader recognizes by its position in the frame.
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
import Machine.Axis (Axis, RotaryAxis, axisName, rotaryName)

-- | Items of a frame in their order on the tape.
data Layout = Layout
  { items :: NonEmpty LayoutItem,
    measure :: AxisMeasure,
    -- | symbols between two words of a frame, if no literal symbol and no check digit is between
    -- them
    separator :: Text
  }
  deriving stock (Eq, Show)

-- | Meaning of the words of axes: increments from the start of the frame's motion to its end, or
-- absolute positions of the end. Centres of arcs are always relative to the start of the arc.
data AxisMeasure = Increments | Positions
  deriving stock (Eq, Show)

-- | One part of a frame.
data LayoutItem
  = -- | symbols that every frame contains at this position
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
  = -- | number of the frame, counted from 1; only its last digits if it has more digits than the
    -- word
    FrameNumber
  | -- | kind of motion, as one of these codes
    Motion MotionCodes
  | -- | increment or position of an axis, in pulses
    Along Axis
  | -- | increment or position of a rotary axis, in pulses
    About RotaryAxis
  | -- | centre of an arc along this axis, relative to the start of the arc, in pulses
    Centre Axis
  | -- | code of the feed
    FeedWord
  | -- | number that the frame gives with a command
    Command CommandName
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
    -- | true if the number is always written with 'digits' digits, with zeros at its beginning
    padded :: Bool,
    -- | number of digits after the decimal point; 0 if there is no point
    decimals :: Int,
    sign :: Sign,
    -- | for each digit, from the first one on, the meaning of a hole in the service track beside
    -- it; empty without a service track, or if the number is not padded. The service track is the
    -- track for such holes
    service :: [Service]
  }
  deriving stock (Eq, Show)

-- | Notation of a number's sign.
data Sign
  = -- | no sign; the number is never negative
    Unsigned
  | -- | a hole in the service track, 'MinusHole', for a negative number
    ServiceSign
  | -- | a minus before a negative number
    MinusSign
  | -- | plus or minus before every number
    EitherSign
  | -- | One of four digits before the number. The digit gives the sign of the number, and tells the
    -- leading axis, which is the one with most pulses in the frame, from the others. The arguments
    -- are the digits for: leading and positive, leading and negative, not leading and positive,
    -- not leading and negative. If several axes have most pulses, the first one in the layout
    -- leads. The word of a centre always has a digit of the leading axis.
    Priority Int Int Int Int
  deriving stock (Eq, Show)

-- | Meaning of a hole in the service track of one row.
data Service
  = -- | The number is negative.
    MinusHole
  | -- | The bit of a command's number with this index is 1; the lowest bit has index 0.
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
  | -- | in frames that need the content: for an axis, frames that move the axis; for a centre,
    -- arcs; for a command, frames that give the command. With absolute positions, the first frame
    -- that moves needs x and y, and also z if any frame of the tape moves z. The word of a rotary
    -- axis is only in frames that turn the axis.
    WhenNeeded
  | -- | for the feed: in frames with a line or an arc, if the feed code differs from that of the
    -- last such frame before
    WhenChanged
  deriving stock (Eq, Show)

-- | Name that a description gives to the word for a command, or to its bits in the service track.
newtype CommandName = CommandName Text
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | Names the content of a word in a report.
contentName :: Content -> Text
contentName c = case c of
  FrameNumber -> "frame number"
  Motion _ -> "kind of motion"
  Along a -> axisName a
  About a -> rotaryName a
  Centre a -> "centre " <> axisName a
  FeedWord -> "feed"
  Command (CommandName n) -> "command " <> n

-- | Largest number that a word with the form @f@ can hold, decimal point disregarded; at most
-- 10^17 − 1.
capacityOf :: NumberForm -> Int
capacityOf f = 10 ^ min 17 (digits f) - 1
