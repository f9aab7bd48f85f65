-- | A controller and its tape, as data. Machines are described in text files. No module depends on
-- the name of a machine, except @Sheet.ToSurface@: input sheets are compiled for one of them.
--
-- A tape is a sequence of rows; a 'TapeCode' gives the symbol of each row. A frame is a sequence
-- of symbols; a 'Layout' divides it into words, literal symbols and a check digit. Machines differ
-- in these data only: one has fixed fields on a tape of five tracks, another one words in ASCII.
--
-- This module defines the record 'Machine' and the queries over it. The types of its parts are
-- defined in the modules that it re-exports.
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
    RotaryAxis (..),
    RotaryForm (..),
    axisForm,
    rotaryForm,
    planeResolution,
    resolutionOf,
    drivenAxes,
    forTurning,
    inInches,
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
    turnCapacity,
    centreCapacity,
    commandCapacity,
    commandDecimals,
    dwellIn,
    canEncode,
    contentName,
    hasRapidMotion,

    -- * Feeds
    Feeds (..),
    FeedMeasure (..),
    FeedCodes (..),
    Rule (..),
    RapidCode (..),
    FeedCode (..),
    TurnFeeds (..),
    FeedChoice (..),
    choose,
    chooseTurn,
    codeNumber,
    hasFeedCode,
    forTurn,
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
    noCommandWords,

    -- * Limits
    Limits (..),

    -- * The controller
    Controller (..),

    -- * Programs for modern controls
    ProgramForm (..),

    -- * Provenance
    DescribedValue (..),
    Provenance (..),
  )
where

import Base.Quantity (LengthUnit (..), Mm (..), Pulses (..), Seconds (..), millimetresIn)
import Data.List (foldl', nub)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust)
import Data.Text (Text)
import Machine.Axis
  ( Arcs (..),
    Axis (..),
    AxisForm (..),
    RotaryAxis (..),
    RotaryForm (..),
    among,
    rotaryAmong,
  )
import Machine.Commands
  ( CommandValue (..),
    CommandWord (..),
    CommandWords (..),
    CompensationCommands (..),
    noCommandWords,
  )
import Machine.Controller (Controller (..))
import Machine.Feeds
  ( Braking (..),
    BrakingForm (..),
    FeedChoice (..),
    FeedCode (..),
    FeedCodes (..),
    FeedMeasure (..),
    Feeds (..),
    RapidCode (..),
    Rule (..),
    TurnFeeds (..),
  )
import Machine.FrameLayout
  ( AxisMeasure (..),
    CommandName (..),
    Content (..),
    Layout (..),
    LayoutItem (..),
    MotionCodes (..),
    NumberForm (..),
    Presence (..),
    Service (..),
    Sign (..),
    Word' (..),
    capacityOf,
    contentName,
  )
import Machine.ProgramForm (ProgramForm (..))
import Machine.TapeCode (Medium (..), Spare (..), TapeCode (..))

-- | Name by which a part program or a command line chooses a machine.
newtype MachineName = MachineName Text
  deriving newtype (Eq, Ord)
  deriving stock (Show)

-- | A controller with its tape and its axes.
data Machine = Machine
  { name :: MachineName,
    title :: Text,
    medium :: Medium,
    code :: TapeCode,
    -- | the linear axes
    axes :: NonEmpty AxisForm,
    -- | the rotary axes; empty for nearly all machines
    rotaryAxes :: [RotaryForm],
    arcs :: Arcs,
    layout :: Layout,
    feeds :: Feeds,
    braking :: Braking,
    commandWords :: CommandWords,
    limits :: Limits,
    -- | Nothing if the description does not say how the controller makes pulses
    controller :: Maybe Controller,
    -- | Nothing for a tape that consists of its frames only
    programForm :: Maybe ProgramForm,
    -- | all values of the description, for the list of their provenance
    describedValues :: [DescribedValue]
  }
  deriving stock (Eq, Show)

-- | Limits on the size of a program.
newtype Limits = Limits
  { -- | largest number of contours; 'Nothing' for no limit
    mostContours :: Maybe Int
  }
  deriving stock (Eq, Show)

-- | A sentence that says one value of the description, with the provenance of the value.
data DescribedValue = DescribedValue Provenance Text
  deriving stock (Eq, Show)

-- | Origin of a value.
data Provenance
  = -- | The historical source prints this value.
    Sourced
  | -- | The source prints another value, which contradicts the rest of the source.
    Corrected
  | -- | The source prints no value; this one was chosen for the compiler.
    Reconstructed
  deriving stock (Eq, Show)

-- The axes ----------------------------------------------------------------------------------------

-- | Properties of the axis @a@; 'Nothing' if the machine lacks the axis.
axisForm :: Machine -> Axis -> Maybe AxisForm
axisForm machine a = among a (NonEmpty.toList (axes machine))

-- | Properties of the rotary axis @a@; 'Nothing' if the machine lacks the axis.
rotaryForm :: Machine -> RotaryAxis -> Maybe RotaryForm
rotaryForm machine a = rotaryAmong a (rotaryAxes machine)

-- | Resolution in the plane of x and y: the larger of the two resolutions, in mm for one pulse.
-- For a machine with neither of these axes it is the resolution of z.
planeResolution :: Machine -> Mm
planeResolution machine = if inPlane > Mm 0 then inPlane else largestStep (const True)
  where
    inPlane = largestStep (/= Z)
    largestStep chosen =
      foldl' max (Mm 0) [resolution f | f <- NonEmpty.toList (axes machine), chosen (axis f)]

-- | Resolution of the axis @a@, in mm for one pulse; 'planeResolution' for an axis that the
-- machine lacks.
resolutionOf :: Machine -> Axis -> Mm
resolutionOf machine a = case axes machine of
  first :| others
    | axis first == a -> resolution first
    | otherwise -> maybe (planeResolution machine) resolution (among a others)

-- | Axes that the machine is known to move. A frame may have words for other axes too.
drivenAxes :: Machine -> [Axis]
drivenAxes machine = [axis f | f <- NonEmpty.toList (axes machine), isDriven f]

-- | The machine set up for turning: each axis whose 'reversedOnLathe' is true changes its
-- direction.
forTurning :: Machine -> Machine
forTurning machine =
  machine {axes = fmap (\f -> f {reversed = reversed f /= reversedOnLathe f}) (axes machine)}

-- | The machine with files in inches: a step of an axis is the last decimal in inches, of which
-- there is one more than in mm. A feed code counts tenths of in/min, a cutting speed is in ft/min,
-- and a feed for one turn has one decimal more. A machine whose tapes have no form of programs
-- stays as it is.
inInches :: Machine -> Machine
inInches machine = case programForm machine of
  Just written ->
    machine
      { programForm = Just written {fileUnit = Inches},
        axes = fmap inchAxis (axes machine),
        layout = (layout machine) {items = fmap inchItem (items (layout machine))},
        feeds = inchFeeds (feeds machine),
        commandWords = inFeet (commandWords machine)
      }
  Nothing -> machine
  where
    inchAxis f = f {resolution = inchStep (axis f)}
    inchStep a = case wordFor machine (Along a) of
      Just word -> Mm (millimetresIn Inches / 10 ^ (decimals (form word) + 1))
      Nothing -> resolutionOf machine a
    inchItem item = case item of
      AWord word
        | isLength (content word) || content word == FeedWord ->
          AWord word {form = (form word) {decimals = decimals (form word) + 1}}
      _ -> item
    isLength c = case c of
      Along _ -> True
      Centre _ -> True
      _ -> False

-- | Words for a constant cutting speed in ft\/min.
inFeet :: CommandWords -> CommandWords
inFeet table =
  table
    { surfaceClockwise = map footWord (surfaceClockwise table),
      surfaceCounterClockwise = map footWord (surfaceCounterClockwise table)
    }
  where
    footWord w = case value w of
      SurfaceSpeed _ -> w {value = SurfaceSpeed (12 * millimetresIn Inches)}
      _ -> w

-- | Feeds whose codes count tenths of in\/min and, for one turn, inches with one decimal more.
inchFeeds :: Feeds -> Feeds
inchFeeds f = case codes f of
  Direct a b ->
    f
      { codes = Direct (lowestOf a) (highestOf b),
        directStep = ratio,
        turnFeeds = inchTurns <$> turnFeeds f
      }
  Listed _ -> f
  where
    ratio = millimetresIn Inches / 10
    lowestOf n = max 1 (ceiling (fromIntegral n / ratio))
    highestOf n = floor (fromIntegral n / ratio)
    inchTurns t =
      TurnFeeds
        { turnStep = turnStep t * ratio,
          lowestTurn = lowestOf (lowestTurn t),
          highestTurn = highestOf (highestTurn t)
        }

-- | True if the machine's axes mirror the part, so that the left side of a contour is the right
-- side for the machine.
isMirrored :: Machine -> Bool
isMirrored machine = isReversed X /= isReversed Y
  where
    isReversed a = maybe False reversed (axisForm machine a)

-- The layout of a frame ---------------------------------------------------------------------------

-- | All words that a frame can contain, in their order on the tape.
wordsOf :: Machine -> [Word']
wordsOf machine = [w | AWord w <- NonEmpty.toList (items (layout machine))]

-- | First word of the layout with the content @wanted@; 'Nothing' if the layout has no such word.
wordFor :: Machine -> Content -> Maybe Word'
wordFor machine wanted = case items (layout machine) of
  first :| others -> firstWord wanted (first : others)

firstWord :: Content -> [LayoutItem] -> Maybe Word'
firstWord wanted ws = case ws of
  [] -> Nothing
  AWord w : _ | content w == wanted -> Just w
  _ : others -> firstWord wanted others

-- | Largest number of pulses that the word of the axis @a@ can hold; 0 if frames lack the word.
capacity :: Machine -> Axis -> Pulses
capacity machine a = maybe 0 (Pulses . capacityOf . form) (wordFor machine (Along a))

-- | Largest number of pulses that the word of the rotary axis @a@ can hold; 0 if frames lack the
-- word.
turnCapacity :: Machine -> RotaryAxis -> Pulses
turnCapacity machine a = maybe 0 (Pulses . capacityOf . form) (wordFor machine (About a))

-- | Largest number of pulses that each of the words for an arc's centre can hold; 0 if frames have
-- no such words.
centreCapacity :: Machine -> Pulses
centreCapacity machine = if least == maxBound then 0 else Pulses least
  where
    least = foldl' min maxBound capacities
    capacities = [capacityOf (form w) | w <- wordsOf machine, Centre _ <- [content w]]

-- | Largest number that a frame can give with a command; 'Nothing' if the layout has neither a
-- word nor bits for the command.
commandCapacity :: Machine -> CommandName -> Maybe Int
commandCapacity machine command =
  case ([form w | w <- wordsOf machine, Command c <- [content w], c == command], bits) of
    (f : _, _) -> Just (capacityOf f)
    ([], []) -> Nothing
    ([], ks) -> Just (sum (map (2 ^) ks))
  where
    -- A bit may have holes at several digits.
    bits = nub [k | w <- wordsOf machine, CommandBit c k <- service (form w), c == command]

-- | Count of digits after the decimal point in the word of a command; 0 without such a word.
commandDecimals :: Machine -> CommandName -> Int
commandDecimals machine command =
  maximum (0 : [decimals (form w) | w <- wordsOf machine, content w == Command command])

-- | Time for which the commands of a frame let the axes stand still.
dwellIn :: Machine -> [(CommandName, Int)] -> Seconds
dwellIn machine given =
  Seconds
    ( sum
        [ fromIntegral n / units / 10 ^ commandDecimals machine commandName
          | CommandWord {commandName, value} <- dwell (commandWords machine),
            Just units <- [unitsInSecond value],
            Just n <- [lookup commandName given]
        ]
    )
  where
    unitsInSecond v = case v of
      InSeconds -> Just 1
      InMilliseconds -> Just 1000
      _ -> Nothing

-- | True if a frame can give the command @command@ with the number @v@. Bits, and a word that is
-- also in frames without the command, are 0 if there is no command. Therefore a command with the
-- number 0 needs a word of its own, which only frames with this command contain.
canEncode :: Machine -> CommandName -> Int -> Bool
canEncode machine command v = case commandCapacity machine command of
  Nothing -> False
  Just most ->
    v <= most
      && ( v > 0
             || v == 0
               && or [isOptional (presence w) | w <- wordsOf machine, content w == Command command]
         )
  where
    isOptional p = case p of
      Always -> False
      InMotion -> False
      WhenNeeded -> True
      WhenChanged -> True

-- | True if a rapid move is a kind of motion with a code of its own. False if it is a line at the
-- feed of 'rapidCode'.
hasRapidMotion :: Machine -> Bool
hasRapidMotion machine = any hasRapidCode (items (layout machine))
  where
    hasRapidCode item = case item of
      AWord Word' {content = Motion MotionCodes {rapid = Just _}} -> True
      _ -> False

-- Feeds -------------------------------------------------------------------------------------------

-- | Chooses the code for the feed @wanted@, which is in the machine's 'FeedMeasure': mm/min or
-- pulses per second. The result is 'NoSuchFeed' if the feed is outside 'feedRange' by more than
-- 'feedTolerance'.
choose :: Machine -> Double -> FeedChoice
choose machine wanted
  | wanted < low - feedTolerance low || wanted > high + feedTolerance high = NoSuchFeed low high
  | otherwise = case codes f of
    Direct a b ->
      let n = max (max 1 a) (min b (rounded (rule f)))
       in Given (FeedCode n) (fromIntegral n * directStep f)
    Listed table -> let (c, v) = pick (Map.toList table) in Given c v
  where
    f = feeds machine
    (low, high) = feedRange machine
    rounded r = case r of
      NotAbove -> floor ((wanted + feedTolerance wanted) / directStep f)
      Nearest -> floor (wanted / directStep f + 0.5)
    pick table = case rule f of
      Nearest -> leastBy (\(c, v) -> (abs (v - wanted), c)) table
      NotAbove ->
        leastBy (\(c, v) -> (-v, c)) [e | e@(_, v) <- table, v <= wanted + feedTolerance wanted]
    leastBy key table = case table of
      [] -> (FeedCode 0, 0)
      e : es -> foldl (\best x -> if key x < key best then x else best) e es

-- | Chooses the code for a feed of @wanted@ mm for one turn of the spindle. Nothing on a machine
-- without such feeds. The values of 'NoSuchFeed' are in mm for one turn.
chooseTurn :: Machine -> Double -> Maybe FeedChoice
chooseTurn machine wanted = chosen <$> turnFeeds (feeds machine)
  where
    chosen TurnFeeds {turnStep, lowestTurn, highestTurn}
      | n < lowestTurn || n > highestTurn = NoSuchFeed (valueAt lowestTurn) (valueAt highestTurn)
      | otherwise = Given (TurnCode n) (valueAt n)
      where
        n = round (wanted / turnStep)
        valueAt k = fromIntegral k * turnStep

-- | Number of a feed code.
codeNumber :: FeedCode -> Int
codeNumber code' = case code' of
  FeedCode n -> n
  TurnCode n -> n

-- | Feed in mm for one turn of the spindle that a code means; Nothing for a feed per minute.
forTurn :: Machine -> FeedCode -> Maybe Double
forTurn machine code' = case (code', turnFeeds (feeds machine)) of
  (TurnCode n, Just t) -> Just (fromIntegral n * turnStep t)
  (TurnCode _, Nothing) -> Nothing
  (FeedCode _, _) -> Nothing

-- | True if the machine has a feed code.
hasFeedCode :: Machine -> FeedCode -> Bool
hasFeedCode machine code' = case code' of
  FeedCode _ -> isJust (valueOf machine code')
  TurnCode n -> case turnFeeds (feeds machine) of
    Just f -> lowestTurn f <= n && n <= highestTurn f
    Nothing -> False

-- | Largest difference from the feed @v@ at which another feed counts as equal: 1e-9 of @v@, but
-- at least 1e-9. Both are in the unit of the machine's 'FeedMeasure'.
feedTolerance :: Double -> Double
feedTolerance v = 1e-9 * max 1 (abs v)

-- | Feed that a code means, in the unit of the machine's 'FeedMeasure'; 'Nothing' for a code that
-- the machine lacks, and for one that means a feed for a turn of the spindle.
valueOf :: Machine -> FeedCode -> Maybe Double
valueOf machine c = case (codes (feeds machine), c) of
  (_, TurnCode _) -> Nothing
  (Listed table, FeedCode _) -> Map.lookup c table
  (Direct a b, FeedCode n)
    | a <= n && n <= b -> Just (fromIntegral n * directStep (feeds machine))
    | otherwise -> Nothing

-- | Lowest and highest feed that the machine's codes can mean, in the unit of its 'FeedMeasure';
-- both 0 for an empty table.
feedRange :: Machine -> (Double, Double)
feedRange machine = case codes (feeds machine) of
  Direct a b -> (valueAt a, valueAt b)
  Listed table -> case Map.elems table of
    [] -> (0, 0)
    vs -> (minimum vs, maximum vs)
  where
    valueAt n = fromIntegral n * directStep (feeds machine)

-- | Feed code of rapid moves. If the machine has a motion code for rapid moves, their frames do
-- not contain this feed code. It then serves only to find their speed, which is its value.
rapidCode :: Machine -> FeedCode
rapidCode machine = case rapidFeed (feeds machine) of
  ByCode c -> c
  Highest -> snd (extreme maximum machine)

-- | Code of the lowest feed, and this feed in the unit of the machine's 'FeedMeasure'.
slowest :: Machine -> (FeedCode, Double)
slowest machine = let (v, c) = extreme minimum machine in (c, v)

-- | The lowest or the highest feed, in the unit of the machine's 'FeedMeasure', with its code.
-- @select@ is 'minimum' or 'maximum'. For an empty table, feed and code are 0.
extreme :: ([(Double, FeedCode)] -> (Double, FeedCode)) -> Machine -> (Double, FeedCode)
extreme select machine = case codes (feeds machine) of
  Direct a b -> select [(fromIntegral n * directStep (feeds machine), FeedCode n) | n <- [a, b]]
  Listed table -> case [(v, c) | (c, v) <- Map.toList table] of
    [] -> (0, FeedCode 0)
    vs -> select vs
