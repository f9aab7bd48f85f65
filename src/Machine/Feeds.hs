-- | The feed codes of a machine, and how the machine slows down. The value of a code is the feed
-- that the code means.
module Machine.Feeds
  ( Feeds (..),
    FeedMeasure (..),
    FeedCodes (..),
    Rule (..),
    RapidCode (..),
    FeedCode (..),
    TurnFeeds (..),
    FeedChoice (..),

    -- * Braking
    Braking (..),
    BrakingForm (..),
  )
where

import Base.Quantity (Feed (..))
import Data.Map.Strict (Map)

-- | Number in the feed word of a frame. It means a feed.
data FeedCode
  = FeedCode Int
  | -- | feed for one turn of the spindle, in steps of 'TurnFeeds'
    TurnCode Int
  deriving stock (Eq, Ord, Show)

-- | Feeds for one turn of the spindle. The code of a feed is its count of steps.
data TurnFeeds = TurnFeeds
  { -- | size of a step in mm
    turnStep :: Double,
    -- | the lowest and the highest code
    lowestTurn :: Int,
    highestTurn :: Int
  }
  deriving stock (Eq, Show)

-- | Feed codes of a machine with their values, and the rules by which a code is chosen.
data Feeds = Feeds
  { feedMeasure :: FeedMeasure,
    codes :: FeedCodes,
    -- | value of the code 1 of 'Direct' codes, in the unit of 'FeedMeasure'; 1 if each code is its
    -- own value
    directStep :: Double,
    rule :: Rule,
    rapidFeed :: RapidCode,
    -- | Nothing for a machine whose feeds are per minute only
    turnFeeds :: Maybe TurnFeeds
  }
  deriving stock (Eq, Show)

-- | Unit in which the values of the feed codes are given.
data FeedMeasure
  = -- | mm/min along the path
    AlongPath
  | -- | pulses per second on the leading axis, which is the axis with most pulses in the frame
    LeadingAxis
  deriving stock (Eq, Show)

-- | Feed codes and their values, in the unit of 'FeedMeasure'.
data FeedCodes
  = -- | a value for each code
    Listed (Map FeedCode Double)
  | -- | Each code is its own value. The arguments are the lowest and the highest code.
    Direct Int Int
  deriving stock (Eq, Show)

-- | Rule that chooses the code for a feed that lies between the values of two codes.
data Rule
  = -- | the code of the largest value that does not exceed the feed
    NotAbove
  | -- | the code of the nearest value; if two are equally near, the lower code of a table, but the
    -- higher code of a 'Direct' range
    Nearest
  deriving stock (Eq, Show)

-- | Feed code of rapid moves. If the machine has a motion code for rapid moves, their frames do
-- not contain this feed code. It then serves only to find their speed, which is its value.
data RapidCode
  = -- | the code of the highest value
    Highest
  | -- | this code
    ByCode FeedCode
  deriving stock (Eq, Show)

-- | Result of the choice of a code for a feed. The values are in the unit of 'FeedMeasure'.
data FeedChoice
  = -- | the code, and its value
    Given FeedCode Double
  | -- | The feed is outside the range of the codes; the arguments are the lowest and the highest
    -- value.
    NoSuchFeed Double Double
  deriving stock (Eq, Show)

-- Braking -----------------------------------------------------------------------------------------

-- | Deceleration of a machine, and the means by which the machine slows down to a lower feed.
data Braking = Braking
  { -- | deceleration in mm/s²
    deceleration :: Double,
    brakingForm :: BrakingForm
  }
  deriving stock (Eq, Show)

-- | Means by which the machine slows down: the control, or the program on the tape.
data BrakingForm
  = -- | The control slows down by itself.
    ByControl
  | -- | Where the part program asks for braking, the tape has frames at the lowest feed.
    SlowFrames
  | -- | The control slows down in frames that the program marks with a
    -- 'Machine.FrameLayout.BrakingHole': the last frames before a lower feed, before the end of
    -- the program, and before the end of an element with braking. At the end of the program or of
    -- such an element, the control slows down to the feed in this field.
    BrakedFrames Feed
  deriving stock (Eq, Show)
