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

-- | Unit of the values that codes give.
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
  = -- | code of the largest value that does not exceed the feed
    NotAbove
  | -- | code of the nearest value; the lower code if two are equally near
    Nearest
  deriving stock (Eq, Show)

-- | Code of rapid moves.
data RapidCode
  = -- | code of the highest value
    Highest
  | ByCode FeedCode
  deriving stock (Eq, Show)

-- | Result of the choice of a code.
data FeedChoice
  = -- | the code, and the value that it gives
    Given FeedCode Double
  | -- | The feed is out of range; the arguments are the lowest and the highest value.
    NoSuchFeed Double Double
  deriving stock (Eq, Show)

-- Braking -----------------------------------------------------------------------------------------

-- | Slowing down from a feed.
data Braking = Braking
  { -- | deceleration in mm/s²
    deceleration :: Double,
    brakingForm :: BrakingForm
  }
  deriving stock (Eq, Show)

-- | Part of the work that the program has to do.
data BrakingForm
  = -- | The control slows down by itself.
    ByControl
  | -- | The program slows down, in a frame at the lowest feed.
    SlowFrames
  | -- | The program marks frames before every lower feed with a 'BrakingHole'. At the end of the
    -- program it slows down to this feed.
    BrakedFrames Feed
  deriving stock (Eq, Show)
