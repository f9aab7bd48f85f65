-- | A controller and its tape, as data. Nothing outside this folder knows any machine by name.
module Machine.Machine
  ( Machine (..),
    MachineName (..),
    FeedCode (..),

    -- * The layout of a frame
    Layout (..),
    Field (..),
    Content (..),
    Axis (..),
    Service (..),
    DigitCode (..),
    digits,
    capacity,
    contentWord,

    -- * Feeds
    rapidCode,
    slowest,
    auxiliaries,
    feedOf,
    chooseFeed,
    Choice (..),

    -- * What is known and how
    Fact (..),
    Mark (..),
  )
where

import Base.Quantity (Feed (..), Mm, Pulses (..))
import Data.List (find)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Word (Word8)

-- | The name by which a program chooses a machine.
newtype MachineName = MachineName Text
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | What stands in the feed field of a frame; 0 where nothing moves.
newtype FeedCode = FeedCode Int
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | A controller.
data Machine = Machine
  { name :: MachineName,
    title :: Text,
    -- | tracks of the tape
    tracks :: Int,
    -- | the way of one pulse
    pulse :: Mm,
    layout :: Layout,
    -- | codes in rising order of their feeds
    feeds :: NonEmpty (FeedCode, Feed),
    -- | the axes that the controller moves, by its source; a frame may have fields for others
    driven :: [Axis],
    -- | how fast it slows down, in mm/s²
    deceleration :: Double,
    -- | blank rows before the first and behind the last frame
    leader :: Int,
    -- | from row to row
    pitch :: Mm,
    facts :: [Fact]
  }
  deriving stock (Eq, Show)

-- | The rows of a frame, in order. Writer and reader both follow it.
data Layout = Layout
  { fields :: [Field],
    code :: DigitCode,
    -- | blank rows behind a frame
    gap :: Int,
    -- | further blank rows before every frame with an even number
    evenShift :: Int
  }
  deriving stock (Eq, Show)

-- | A number of the frame: one row a digit, the high digit first, and the service track's meaning in each row.
data Field = Field {content :: Content, service :: NonEmpty Service}
  deriving stock (Eq, Show)

data Content = Increment Axis | Speed
  deriving stock (Eq, Show)

data Axis = X | Y | Z
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | What a hole in the service track of a row says.
data Service
  = -- | the number is negative
    MinusHole
  | -- | a bit of the auxiliary command, counted from the lowest
    AuxiliaryBit Int
  | -- | the end of the frame: there always is a hole
    Marker
  | -- | there never is a hole
    NoHole
  deriving stock (Eq, Show)

-- | The holes of the digits 0 to 9 in the tracks below the service track, bit k−1 for track k.
data DigitCode = DigitCode {codeName :: Text, digitWords :: [Word8]}
  deriving stock (Eq, Show)

-- | What a field holds, in a word.
contentWord :: Content -> Text
contentWord content' = case content' of
  Increment X -> "x"
  Increment Y -> "y"
  Increment Z -> "z"
  Speed -> "speed"

-- | How many digits a field has.
digits :: Field -> Int
digits = NonEmpty.length . service

-- | The largest increment that the field of an axis holds; 0 for an axis without a field.
capacity :: Machine -> Axis -> Pulses
capacity machine axis = case find ((== Increment axis) . content) (fields (layout machine)) of
  Just field -> Pulses (10 ^ digits field - 1)
  Nothing -> 0

-- | The code for rapid moves: the highest.
rapidCode :: Machine -> FeedCode
rapidCode = fst . NonEmpty.last . feeds

-- | The code for the slowest moves.
slowest :: Machine -> (FeedCode, Feed)
slowest = NonEmpty.head . feeds

-- | The highest auxiliary command that a frame holds; 0 when it holds none.
auxiliaries :: Machine -> Int
auxiliaries machine = sum [2 ^ k | f <- fields (layout machine), AuxiliaryBit k <- NonEmpty.toList (service f)]

-- | The feed that a code means.
feedOf :: Machine -> FeedCode -> Maybe Feed
feedOf machine code' = lookup code' (NonEmpty.toList (feeds machine))

-- | What a machine makes of a feed that is asked for.
data Choice
  = -- | the code and the feed that it gives
    Given FeedCode Feed
  | -- | outside the table: its lowest and its highest feed
    NoSuchFeed Feed Feed
  deriving stock (Eq, Show)

-- | The largest feed of the table that does not exceed the one asked.
chooseFeed :: Machine -> Feed -> Choice
chooseFeed machine (Feed asked) = case reverse (NonEmpty.takeWhile notAbove (feeds machine)) of
  (code', f) : _ | asked <= highest + comparison -> Given code' f
  _ -> NoSuchFeed lowest (Feed highest)
  where
    notAbove (_, Feed f) = f <= asked + comparison
    lowest = snd (NonEmpty.head (feeds machine))
    Feed highest = snd (NonEmpty.last (feeds machine))
    -- Feeds that differ by no more are the same (mm/min).
    comparison = 1e-9

-- | A statement about the machine, and how it is known.
data Fact = Fact Mark Text
  deriving stock (Eq, Show)

data Mark
  = -- | printed in the source
    Sourced
  | -- | printed there, but the print contradicts itself
    Corrected
  | -- | the source is silent; chosen for this program
    Reconstructed
  deriving stock (Eq, Show)
