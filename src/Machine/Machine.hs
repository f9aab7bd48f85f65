-- | A controller and its tape, as data. Nothing outside this folder knows any machine by name;
-- inside it they are text files.
--
-- A tape is a sequence of rows, and a 'TapeCode' says which symbol a row is. A frame is a sequence
-- of symbols, and a 'Layout' says which: words, each an address (none in a fixed format) and a
-- number; symbols that always stand there; a check digit. A five-track tape with digits in fixed
-- places, one with letters and one in ASCII differ in their data only.
module Machine.Machine
  ( Machine (..),
    MachineName (..),

    -- * The tape
    Medium (..),
    Spare (..),
    TapeCode (..),

    -- * The axes
    Axis (..),
    AxisForm (..),
    Arcs (..),
    axisForm,
    pulse,
    pulseOf,
    driven,
    forTurning,
    isMirrored,

    -- * The layout of a frame
    Layout (..),
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
    wordsOf,
    wordFor,
    capacity,
    centreCapacity,
    orderCapacity,
    orderDecimals,
    canOrder,
    contentWord,
    hasRapidMotion,

    -- * Feeds
    Feeds (..),
    FeedMeasure (..),
    FeedCodes (..),
    Rule (..),
    RapidCode (..),
    FeedCode (..),
    FeedChoice (..),
    choose,
    valueOf,
    rapidCode,
    slowest,
    feedRange,

    -- * Braking
    Braking (..),
    BrakingForm (..),

    -- * Commands
    CommandWords (..),
    CommandWord (..),
    CommandValue (..),
    CompensationCommands (..),
    noOrders,

    -- * Limits
    Limits (..),

    -- * What is known and how
    DescribedValue (..),
    Provenance (..),
  )
where

import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Data.List (foldl')
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Word (Word8)

-- | The name by which a program chooses a machine.
newtype MachineName = MachineName Text
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | A controller.
data Machine = Machine
  { name :: MachineName,
    title :: Text,
    medium :: Medium,
    code :: TapeCode,
    axes :: NonEmpty AxisForm,
    arcs :: Arcs,
    layout :: Layout,
    feeds :: Feeds,
    braking :: Braking,
    orders :: CommandWords,
    limits :: Limits,
    facts :: [DescribedValue]
  }
  deriving stock (Eq, Show)

-- The tape ----------------------------------------------------------------------------------------

-- | What is written on, and what stands on it besides frames.
data Medium = Medium
  { -- | 1 to 8; bit k−1 of a row is track k
    tracks :: Int,
    -- | from row to row; none for a text
    pitch :: Maybe Mm,
    -- | the ending of a file's name
    suffix :: Text,
    -- | blank rows before the first frame and behind the last
    leader :: Int,
    -- | blank rows behind every frame
    gap :: Int,
    -- | further blank rows before every frame with an even number, counted from 1
    evenShift :: Int,
    spare :: Spare,
    -- | symbols before the first frame, behind the leader
    opening :: Text,
    -- | symbols behind the last frame, before the trailer
    closing :: Text
  }
  deriving stock (Eq, Show)

-- | What a reader makes of blank rows between frames.
data Spare
  = -- | there are as many as the layout says
    Counted
  | -- they stand

    -- | there are at least as many as the layout says; rows that the code has for skipping are
    -- passed over wherever
    Skipped
  deriving stock (Eq, Show)

-- | The rows of the symbols.
data TapeCode = TapeCode
  { codeName :: Text,
    -- | the holes of each symbol, without those of the service track and of the parity track; no
    -- two alike
    symbols :: Map Char Word8,
    -- | what a symbol counts in the sum of a frame; others count 0
    weights :: Map Char Int,
    -- | this track, if there is one, makes the number of holes of every row even
    evenTrack :: Maybe Int,
    -- | the track that holds signs and marks beside the digits
    serviceTrack :: Maybe Int,
    -- | rows that a reader passes over: blank ones and erased ones
    skips :: [Word8]
  }
  deriving stock (Eq, Show)

-- The axes ----------------------------------------------------------------------------------------

data Axis = X | Y | Z
  deriving stock (Eq, Ord, Show, Enum, Bounded)

data AxisForm = AxisForm
  { axis :: Axis,
    -- | the way of one pulse
    step :: Mm,
    -- | the axis of the machine points against that of the part
    reversed :: Bool,
    -- | on a lathe it points the other way than it does else
    reversedOnLathe :: Bool,
    -- | whether the machine is known to move it; a frame may have a word for it all the same
    moves :: Bool
  }
  deriving stock (Eq, Show)

-- | The arcs that a frame can hold, in the plane of x and y.
data Arcs
  = NoArcs
  | -- | whether they end where they cross the axes through the centre, and whether one frame can
    -- hold a full circle
    Arcs {quadrants :: Bool, fullCircle :: Bool}
  deriving stock (Eq, Show)

axisForm :: Machine -> Axis -> Maybe AxisForm
axisForm machine a = formAmong a (NonEmpty.toList (axes machine))

formAmong :: Axis -> [AxisForm] -> Maybe AxisForm
formAmong a forms = case forms of
  [] -> Nothing
  f : others -> if axis f == a then Just f else formAmong a others

-- | The way of one pulse in the plane: of the coarser axis.
pulse :: Machine -> Mm
pulse machine = if inPlane > Mm 0 then inPlane else widest (const True)
  where
    inPlane = widest (/= Z)
    widest among = foldl' max (Mm 0) [step f | f <- NonEmpty.toList (axes machine), among (axis f)]

-- | The way of one pulse of an axis; for an axis that the machine lacks that of the plane.
pulseOf :: Machine -> Axis -> Mm
pulseOf machine a = case axes machine of
  first :| others
    | axis first == a -> step first
    | otherwise -> maybe (pulse machine) step (formAmong a others)

-- | The axes that the machine is known to move.
driven :: Machine -> [Axis]
driven machine = [axis f | f <- NonEmpty.toList (axes machine), moves f]

-- | The machine set up for turning: its axes as they point on a lathe.
forTurning :: Machine -> Machine
forTurning machine =
  machine {axes = fmap (\f -> f {reversed = reversed f /= reversedOnLathe f}) (axes machine)}

-- | Whether what is on the left in the part is on the right for the machine.
isMirrored :: Machine -> Bool
isMirrored machine = pointsBack X /= pointsBack Y
  where
    pointsBack a = maybe False reversed (axisForm machine a)

-- The layout of a frame ---------------------------------------------------------------------------

-- | The symbols of a frame in order. Writer and reader both follow it.
data Layout = Layout
  { items :: NonEmpty LayoutItem,
    measure :: AxisMeasure,
    -- | symbols between two words
    separator :: Text
  }
  deriving stock (Eq, Show)

-- | What the words of the axes say. Arc centres are always counted from the arc's beginning.
data AxisMeasure = Increments | Positions
  deriving stock (Eq, Show)

data LayoutItem
  = -- | these symbols always stand here
    Literal Text
  | AWord Word'
  | -- | a digit so that the weights of all symbols of the frame add to a multiple of this
    CheckDigit Int
  deriving stock (Eq, Show)

data Word' = Word'
  { -- | symbols before the number; empty where the place tells what it is
    address :: Text,
    content :: Content,
    form :: NumberForm,
    presence :: Presence
  }
  deriving stock (Eq, Show)

data Content
  = -- | the number of the frame from 1, modulo what the digits hold
    FrameNumber
  | Motion MotionCodes
  | Along Axis
  | -- | of an arc: from its beginning to its centre
    Centre Axis
  | FeedWord
  | Command CommandName
  deriving stock (Eq, Show)

-- | Which number says what a frame does; none where the machine does not know it.
data MotionCodes = MotionCodes
  { rapid :: Maybe Int,
    straight :: Int,
    clockwise :: Maybe Int,
    counterClockwise :: Maybe Int
  }
  deriving stock (Eq, Show)

data NumberForm = NumberForm
  { -- | digits, those behind the point included: exactly so many, or at most
    digits :: Int,
    padded :: Bool,
    -- | digits behind a decimal point; 0 for no point
    decimals :: Int,
    sign :: Sign,
    -- | what the service track says at each digit; empty without service track
    service :: [Service]
  }
  deriving stock (Eq, Show)

data Sign
  = -- | not below zero
    Unsigned
  | -- | the service track holds it
    ServiceSign
  | -- | a minus before a number below zero
    MinusSign
  | -- | plus or minus before every number
    EitherSign
  | -- leading forwards, leading backwards, following forwards, following backwards

    -- | a digit before the number says direction and which axis leads: the one with most pulses, of
    -- several the first;
    Priority Int Int Int Int
  deriving stock (Eq, Show)

-- | What a hole in the service track of a row says.
data Service
  = -- | the number is negative
    MinusHole
  | -- | a bit of a command, counted from the lowest
    OrderBit CommandName Int
  | -- | there always is a hole
    Marker
  | -- | the frame slows down to its feed
    BrakingHole
  | -- | there never is a hole
    NoHole
  deriving stock (Eq, Show)

-- | When a word stands in a frame.
data Presence
  = Always
  | -- | in frames that move
    InMotion
  | -- it is given

    -- | a word of an axis: where that moves, or its position was not said yet; of a centre: in
    -- arcs; of a command: where
    WhenNeeded
  | -- | a feed: in frames that move at a feed other than the one said last
    WhenChanged
  deriving stock (Eq, Show)

-- | The word or service bits that hold a command.
newtype CommandName = CommandName Text
  deriving newtype (Eq, Ord)
  deriving stock (Show)

wordsOf :: Machine -> [Word']
wordsOf machine = [w | AWord w <- NonEmpty.toList (items (layout machine))]

-- | The word with some content.
wordFor :: Machine -> Content -> Maybe Word'
wordFor machine wanted = case items (layout machine) of
  first :| others -> wordAmong wanted (first : others)

wordAmong :: Content -> [LayoutItem] -> Maybe Word'
wordAmong wanted ws = case ws of
  [] -> Nothing
  AWord w : _ | content w == wanted -> Just w
  _ : others -> wordAmong wanted others

-- | The largest number of pulses in the word of an axis; 0 for an axis without one.
capacity :: Machine -> Axis -> Pulses
capacity machine a = maybe 0 (Pulses . largest . form) (wordFor machine (Along a))

-- | The largest number in the words of an arc's centre.
centreCapacity :: Machine -> Pulses
centreCapacity machine = if least == maxBound then 0 else Pulses least
  where
    least = foldl' min maxBound [largest (form w) | w <- wordsOf machine, Centre _ <- [content w]]

largest :: NumberForm -> Int
largest f = 10 ^ min 17 (digits f) - 1

-- | The largest number of a command; none when a frame has no place for it.
orderCapacity :: Machine -> CommandName -> Maybe Int
orderCapacity machine order =
  case ([form w | w <- wordsOf machine, Command o <- [content w], o == order], bits) of
    (f : _, _) -> Just (largest f)
    ([], []) -> Nothing
    ([], ks) -> Just (sum (map (2 ^) ks))
  where
    bits = [k | w <- wordsOf machine, OrderBit o k <- service (form w), o == order]

-- | The digits behind the decimal point in the word of a command.
orderDecimals :: Machine -> CommandName -> Int
orderDecimals machine order =
  maximum (0 : [decimals (form w) | w <- wordsOf machine, content w == Command order])

-- | Whether a frame can hold this number of a command. Where the word or the bits stand in every
-- frame, 0 says that there is no command.
canOrder :: Machine -> CommandName -> Int -> Bool
canOrder machine order v = case orderCapacity machine order of
  Nothing -> False
  Just most ->
    v <= most
      && ( v > 0
             || v == 0
               && or [standsAlone (presence w) | w <- wordsOf machine, content w == Command order]
         )
  where
    standsAlone p = case p of
      Always -> False
      InMotion -> False
      WhenNeeded -> True
      WhenChanged -> True

-- | What a word holds, in words.
contentWord :: Content -> Text
contentWord c = case c of
  FrameNumber -> "frame number"
  Motion _ -> "kind of motion"
  Along a -> axisWord a
  Centre a -> "centre " <> axisWord a
  FeedWord -> "feed"
  Command (CommandName n) -> "command " <> n
  where
    axisWord a = case a of
      X -> "x"
      Y -> "y"
      Z -> "z"

-- | Whether rapid moves are a kind of motion rather than a feed.
hasRapidMotion :: Machine -> Bool
hasRapidMotion machine = any saysRapid (items (layout machine))
  where
    saysRapid item = case item of
      AWord Word' {content = Motion MotionCodes {rapid = Just _}} -> True
      _ -> False

-- Feeds -------------------------------------------------------------------------------------------

-- | What stands in the feed word of a frame.
newtype FeedCode = FeedCode Int
  deriving newtype (Eq, Ord)
  deriving stock (Show)

data Feeds = Feeds
  { feedMeasure :: FeedMeasure,
    codes :: FeedCodes,
    rule :: Rule,
    rapidFeed :: RapidCode
  }
  deriving stock (Eq, Show)

-- | What the values of the codes are.
data FeedMeasure
  = -- | mm/min along the path
    AlongPath
  | -- | pulses a second on the axis that moves by the most of them
    LeadingAxis
  deriving stock (Eq, Show)

data FeedCodes
  = -- | a value for each code
    Listed (Map FeedCode Double)
  | -- | the code is the value, from one to another
    Direct Int Int
  deriving stock (Eq, Show)

-- | Which code a feed gets that has none of its own.
data Rule
  = -- | that of the largest value that does not exceed it
    NotAbove
  | -- | that of the nearest value; of two the lower code
    Nearest
  deriving stock (Eq, Show)

data RapidCode
  = -- | the code of the highest value
    Highest
  | ByCode FeedCode
  deriving stock (Eq, Show)

-- | What a machine makes of a value that is asked for.
data FeedChoice
  = -- | the code, and the value that it gives
    Given FeedCode Double
  | -- | outside the codes: the lowest and the highest value
    NoSuchFeed Double Double
  deriving stock (Eq, Show)

-- | The code for a value in the machine's measure: mm/min or pulses a second. A value may lie
-- beyond the ends of the codes by the comparison's slack only.
choose :: Machine -> Double -> FeedChoice
choose machine asked
  | asked < low - sameFeed low || asked > high + sameFeed high = NoSuchFeed low high
  | otherwise = case codes f of
    Direct a b ->
      let n =
            max (max 1 a) (min b (nearestTo (rule f)))
       in Given (FeedCode n) (fromIntegral n)
    Listed table -> let (c, v) = pick (Map.toList table) in Given c v
  where
    f = feeds machine
    (low, high) = feedRange machine
    nearestTo r = case r of
      NotAbove -> floor (asked + sameFeed asked)
      Nearest -> floor (asked + 0.5)
    pick table = case rule f of
      Nearest -> least (\(c, v) -> (abs (v - asked), c)) table
      NotAbove -> least (\(c, v) -> (-v, c)) [e | e@(_, v) <- table, v <= asked + sameFeed asked]
    least key table = case table of
      [] -> (FeedCode 0, 0)
      e : es -> foldl (\best x -> if key x < key best then x else best) e es

-- | Values that differ by no more are the same.
sameFeed :: Double -> Double
sameFeed v = 1e-9 * max 1 (abs v)

-- | What a code means; nothing for one that the machine does not have.
valueOf :: Machine -> FeedCode -> Maybe Double
valueOf machine c@(FeedCode n) = case codes (feeds machine) of
  Listed table -> Map.lookup c table
  Direct a b -> if a <= n && n <= b then Just (fromIntegral n) else Nothing

-- | The lowest and the highest value of a machine's codes.
feedRange :: Machine -> (Double, Double)
feedRange machine = case codes (feeds machine) of
  Direct a b -> (fromIntegral a, fromIntegral b)
  Listed table -> case Map.elems table of
    [] -> (0, 0)
    vs -> (minimum vs, maximum vs)

-- | The code for rapid moves on a machine without a motion of their own for them.
rapidCode :: Machine -> FeedCode
rapidCode machine = case rapidFeed (feeds machine) of
  ByCode c -> c
  Highest -> snd (extreme maximum machine)

-- | The code of the lowest value, and the value.
slowest :: Machine -> (FeedCode, Double)
slowest machine = let (v, c) = extreme minimum machine in (c, v)

-- | The code with an extreme value.
extreme :: ([(Double, FeedCode)] -> (Double, FeedCode)) -> Machine -> (Double, FeedCode)
extreme which machine = case codes (feeds machine) of
  Direct a b -> which [(fromIntegral n, FeedCode n) | n <- [a, b]]
  Listed table -> case [(v, c) | (c, v) <- Map.toList table] of
    [] -> (0, FeedCode 0)
    vs -> which vs

-- Braking -----------------------------------------------------------------------------------------

-- | How a machine comes down from a feed.
data Braking = Braking
  { -- | in mm/s²
    deceleration :: Double,
    brakingForm :: BrakingForm
  }
  deriving stock (Eq, Show)

data BrakingForm
  = -- | by itself
    ByControl
  | -- | where the program says so, in a frame at the lowest feed
    SlowFrames
  | -- | before every lower feed, in frames with a hole of their own; at the end of the program down
    -- to this feed
    BrakedFrames Feed
  deriving stock (Eq, Show)

-- Commands ----------------------------------------------------------------------------------------

-- | The words for each command; none where the tape can not give it.
data CommandWords = CommandWords
  { spindleClockwise :: [CommandWord],
    spindleCounterClockwise :: [CommandWord],
    spindleOff :: [CommandWord],
    coolantOn :: [CommandWord],
    coolantOff :: [CommandWord],
    toolChange :: [CommandWord],
    auxiliary :: [CommandWord],
    compensation :: Maybe CompensationCommands,
    -- | frames of their own at the end of the program, in order
    finish :: [NonEmpty CommandWord]
  }
  deriving stock (Eq, Show)

-- | A number in the word or the bits of a command.
data CommandWord = CommandWord {order :: CommandName, value :: CommandValue}
  deriving stock (Eq, Show)

data CommandValue
  = Fixed Int
  | -- | the number that the program gives: of a tool, of an auxiliary command, turns a minute
    Argument
  | -- | the step whose value is nearest to the turns a minute that the program gives; of two the
    -- lower
    Step (Map Int Double)
  | -- | the cutter's diameter
    Diameter
  deriving stock (Eq, Show)

-- | How the control is told to keep the cutter beside the contour, and to stop that.
data CompensationCommands = CompensationCommands
  { keepLeft :: CommandWord,
    keepRight :: CommandWord,
    release :: CommandWord
  }
  deriving stock (Eq, Show)

noOrders :: CommandWords
noOrders = CommandWords [] [] [] [] [] [] [] Nothing []

-- Limits ------------------------------------------------------------------------------------------

newtype Limits = Limits
  { -- | the most contours of a program, if it is limited
    mostContours :: Maybe Int
  }
  deriving stock (Eq, Show)

-- | A statement about the machine, and how it is known.
data DescribedValue = DescribedValue Provenance Text
  deriving stock (Eq, Show)

data Provenance
  = -- | printed in the source
    Sourced
  | -- | printed there, but the print contradicts itself
    Corrected
  | -- | the source is silent; chosen for this program
    Reconstructed
  deriving stock (Eq, Show)
