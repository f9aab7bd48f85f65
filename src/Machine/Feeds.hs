-- | The feed codes of a machine, and its braking.
module Machine.Feeds
  ( Feeds (..),
    FeedMeasure (..),
    FeedCodes (..),
    Rule (..),
    RapidCode (..),
    FeedCode (..),
    FeedChoice (..),

    -- * Braking
    Braking (..),
    BrakingForm (..),
  )
where

import Base.Quantity (Feed (..))
import Data.Map.Strict (Map)

-- | Number in the feed word of a frame.
newtype FeedCode = FeedCode Int
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | Feeds of a machine and the choice of their codes.
data Feeds = Feeds
  { feedMeasure :: FeedMeasure,
    codes :: FeedCodes,
    rule :: Rule,
    rapidFeed :: RapidCode
  }
  deriving stock (Eq, Show)

-- | Unit of the values of the codes.
data FeedMeasure
  = -- | mm/min along the path
    AlongPath
  | -- | pulses per second on the leading axis
    LeadingAxis
  deriving stock (Eq, Show)

-- | Codes and their values.
data FeedCodes
  = -- | a value for each code
    Listed (Map FeedCode Double)
  | -- | The code is the value. The arguments are the lowest and the highest code.
    Direct Int Int
  deriving stock (Eq, Show)

-- | Choice of the code for a feed between the values of two codes.
data Rule
  = -- | the code of the largest value that does not exceed the feed
    NotAbove
  | -- | the code of the nearest value; the lower code if two are equally near
    Nearest
  deriving stock (Eq, Show)

-- | Code of rapid moves.
data RapidCode
  = -- | the code of the highest value
    Highest
  | -- | this code
    ByCode FeedCode
  deriving stock (Eq, Show)

-- | Result of the choice of a code.
data FeedChoice
  = -- | the code, and its value
    Given FeedCode Double
  | -- | The feed is outside the range of the codes; the arguments are the lowest and the highest
    -- value.
    NoSuchFeed Double Double
  deriving stock (Eq, Show)

-- Braking -----------------------------------------------------------------------------------------

-- | Slowing down from one feed to a lower one.
data Braking = Braking
  { -- | deceleration in mm/s²
    deceleration :: Double,
    brakingForm :: BrakingForm
  }
  deriving stock (Eq, Show)

-- | The party that brakes, the control or the program on the tape.
data BrakingForm
  = -- | The control slows down by itself.
    ByControl
  | -- | The program slows down, in a frame at the lowest feed.
    SlowFrames
  | -- | The control slows down in frames that the program marks with a 'BrakingHole'. The program
    -- marks frames before every lower feed; before its end it brakes to this feed.
    BrakedFrames Feed
  deriving stock (Eq, Show)
