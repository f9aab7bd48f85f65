-- | Frames of the motions that are read from a G-code file, for the proof.
--
-- A frame needs its beginning and its end in work coordinates. While the tool is at the retract
-- height, or where it is not known, there are no frames; this is an /excursion/: the beginning of
-- the file, a change of the tool, the end. After an excursion the frames go on where the tool comes
-- down. If it comes down elsewhere than it left, a straight rapid frame joins both positions: the
-- way over the retract height serves for any rapid move above the part.
--
-- Commands are given in the frames as "Frame.CommandState" orders them.
module Gcode.ToFrames
  ( GcodeReading (..),
    FileSetting (..),
    ReadFrame (..),
    reading,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Base.Region (Located (Located), Region (Region))
import Control.Applicative ((<|>))
import Data.Bifunctor (first)
import Data.List (foldl')
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isJust, isNothing)
import Data.Text qualified as Text
import Frame.Command (Pending (..))
import Frame.Command qualified as Command
import Frame.CommandState (CommandState (..), SpindleNumbers (..))
import Frame.CommandState qualified as CommandState
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Gcode.ModalState
import Gcode.Run
import Geometry.Carrier qualified as Carrier
import Machine.Machine (Axis (..), Content (..), FeedCode (..), Machine, TurnFeeds (..))
import Machine.Machine qualified as Machine
import Part.Part (Sense (..))
import Part.Part qualified as Part

-- | Frames of a file, and all its actions.
data GcodeReading = GcodeReading
  { readFrames :: [ReadFrame],
    steps :: [Step],
    -- | largest distance in mm by which a frame may deviate from the motion in the file, because
    -- positions are rounded to pulses
    offGrid :: Mm
  }
  deriving stock (Eq, Show)

-- | A frame, and the number of the line that makes its motion or gives its commands.
data ReadFrame = ReadFrame {readFrame :: Frame, readFrom :: Int}
  deriving stock (Eq, Show)

-- | State of the conversion.
data Converting = Converting
  { -- | last known position in pulses
    here :: Pulses3,
    whereabouts :: Whereabouts,
    commanded :: CommandState,
    pending :: Maybe Pending,
    -- | line of the last start of the spindle for which the file has waited, or has cut without
    waitedFor :: Maybe Int,
    -- | the latest frame first
    made :: [ReadFrame],
    lost :: Double
  }

-- | State of an excursion.
data Whereabouts
  = -- | no excursion
    Working
  | -- | at the retract height, or at an unknown position
    Away
  | -- | has come down to a position, straight from above, by this step; the frames that lead there
    -- are made when the tool comes down no further
    Landing Pulses3 Step

-- | Facts about a program that are the same for all actions of its files.
data FileSetting = FileSetting
  { machine :: Machine,
    -- | height in pulses from which on the tool is above everything; Nothing if no height in work
    -- coordinates is
    level :: Maybe Pulses,
    -- | number of the tool that the program has loaded before its first frame
    firstNumber :: Maybe Int,
    -- | offset in pulses from the centre of each tool to the point that the control leads; 0 for
    -- tools that are not in the list
    tips :: Map Int Pulses3,
    -- | positions at the ends of the program's frames
    stops :: [Pulses3],
    -- | positions at which the program gives commands
    commandPlaces :: [Pulses3]
  }

-- | Frames of the actions of a file. @start@ is the position of the program before its first frame.
reading :: FileSetting -> Pulses3 -> [Step] -> GcodeReading
reading setting start list =
  GcodeReading
    { readFrames = reverse (made end),
      steps = list,
      offGrid = Mm (lost end)
    }
  where
    begin =
      Converting
        { here = start,
          whereabouts = Away,
          commanded = CommandState.initial {tool = firstNumber setting},
          pending = Nothing,
          waitedFor = Nothing,
          made = [],
          lost = 0
        }
    end = landed setting (foldl' (converted setting (inPulses (machine setting))) begin list)

-- | Converts one action. @pulsesAt@ is 'inPulses' of the machine.
converted ::
  FileSetting -> (ToolPlace -> Maybe (Pulses3, Double)) -> Converting -> Step -> Converting
converted setting@FileSetting {machine} pulsesAt c step = case action step of
  Travels travel -> travelled setting pulsesAt (cutting travel) step travel
  Changes _ _ -> onSite
  Dwells t
    | isStart, waitedFor c /= started -> c {waitedFor = started}
    | otherwise -> event (Part.Dwell t)
  Stops -> event Part.ProgramStop
  StopsOnDemand -> event Part.OptionalStop
  FileEnds -> onSite
  Ends ->
    foldl'
      (\c' ws -> addCommands (line step) ws (flushed (line step) c'))
      onSite
      (Command.finalFrames machine)
  where
    onSite = landed setting c
    -- The first dwell after a start of the spindle waits for the spindle, if nothing is cut before.
    cutting travel
      | mode travel /= RapidMode, isStart = c {waitedFor = started}
      | otherwise = c
    started = lineOf (Gcode.ModalState.spindle (state step))
    isStart = case valueOf (Gcode.ModalState.spindle (state step)) of
      Just (SpindleTurning _) -> True
      _ -> False
    event command =
      added
        machine
        step
        (Command.translated machine (Located (Region 0 0) command))
        (withCommands setting step onSite)

-- | Converts a motion.
travelled ::
  FileSetting ->
  (ToolPlace -> Maybe (Pulses3, Double)) ->
  Converting ->
  Step ->
  Travel ->
  Converting
travelled setting@FileSetting {machine, level} pulsesAt c step travel = case centreAt (to travel) of
  Nothing -> onSite {whereabouts = Away}
  Just (target, off)
    | maybe False (heightOf target >=) level -> onSite {whereabouts = Away}
    | isLower target -> coming setting step target (losing off c)
    | isStraight && isAway onSite || isNothing (centreAt (from travel)) ->
      coming setting step target (losing off onSite)
    | otherwise -> moved (losing off onSite) target
  where
    onSite = landed setting c
    isStraight = isNothing (about travel)
    isLower target = case whereabouts c of
      Landing p _ -> mode travel == RapidMode && isUnder p target
      Working -> False
      Away -> False
    moved c' target =
      let (f, off) = frameOf machine step (centred travel) (here c') target
       in addMotion (line step) (withCommands setting step (losing off c')) f
    tip = fromMaybe 0 (valueOf (toolInSpindle (state step)) >>= (`Map.lookup` tips setting))
    centreAt place = first (subtract tip) <$> pulsesAt place
    centred t = t {about = fmap (shiftedBy machine tip) (about t)}

-- | True at the retract height, or at an unknown position.
isAway :: Converting -> Bool
isAway c = case whereabouts c of
  Away -> True
  Working -> False
  Landing _ _ -> False

-- | Notes a distance of a position from its pulses.
losing :: Double -> Converting -> Converting
losing off c = c {lost = max (lost c) off}

-- | Lets the tool come down to a position. The frames are made at once if it comes down where it
-- left, or to a position of the program. Other files may stop in between on the way down.
coming :: FileSetting -> Step -> Pulses3 -> Converting -> Converting
coming setting step target c
  | x == x' && y == y' || any (isNear target) (stops setting) = landed setting landing
  | otherwise = landing
  where
    landing = c {whereabouts = Landing target step}
    (Pulses3 x y _, Pulses3 x' y' _) = (here c, target)

-- | True for positions at most two pulses apart along each axis.
isNear :: Pulses3 -> Pulses3 -> Bool
isNear p q = let Pulses3 dx dy dz = p - q in all ((<= 2) . abs) [dx, dy, dz]

-- | Makes the frames that lead to the position to which the tool has come down. Commands are given
-- where the program gives some; else behind the way up and before all other frames.
landed :: FileSetting -> Converting -> Converting
landed setting@FileSetting {machine} c = case whereabouts c of
  Landing target step ->
    let (up, others) = joining machine (here c) target
        add = flip (foldl' (addMotion (line step)))
        switched = withCommands setting step
        working = c {whereabouts = Working}
     in if any (isNear (here c)) (commandPlaces setting)
          then add (up <> others) (switched working)
          else add others (switched (add up working))
  Working -> c
  Away -> c

heightOf :: Pulses3 -> Pulses
heightOf (Pulses3 _ _ z) = z

-- | True if the second position is straight below the first one, or the same.
isUnder :: Pulses3 -> Pulses3 -> Bool
isUnder (Pulses3 x y z) (Pulses3 x' y' z') = x == x' && y == y' && z' <= z

-- | Centre of an arc in picometres, without an offset in pulses.
shiftedBy :: Machine -> Pulses3 -> (Int, Int) -> (Int, Int)
shiftedBy machine (Pulses3 dx dy _) (i, j) = (i - along X dx, j - along Y dy)
  where
    along axis (Pulses n) = n * pulseOf machine axis

-- | Adds the commands that lead to the state of a step.
withCommands :: FileSetting -> Step -> Converting -> Converting
withCommands FileSetting {machine} step c = foldl' add c {commanded = now} groups
  where
    now = stateOf (tool (commanded c)) (state step)
    groups = CommandState.between machine (commanded c) now
    add c' ws = added machine step (Command.Translation ws False [] []) c'

-- | Adds the words of a command.
added :: Machine -> Step -> Command.Translation -> Converting -> Converting
added machine step translation c =
  foldl' (\d p -> addCommands (line step) (given p) d) c {pending = pending'} full
  where
    (full, pending') = Command.add machine (Region 0 0) translation (pending c)

-- | State of tool, spindle and coolant. An unknown tool counts as the one before, and other unknown
-- parts count as off; "Verify.ControlState" finds them.
stateOf :: Maybe Int -> ModalState -> CommandState
stateOf before m =
  CommandState
    { tool = valueOf (toolInSpindle m) <|> before,
      CommandState.spindle = case valueOf (Gcode.ModalState.spindle m) of
        Just (SpindleTurning sense) -> Just (senseOf sense, speedOf m)
        _ -> Nothing,
      coolantRuns = valueOf (coolant m) `notElem` [Nothing, Just CoolantOff]
    }
  where
    senseOf sense = case sense of
      Carrier.Clockwise -> Clockwise
      Carrier.CounterClockwise -> CounterClockwise

-- | Speed of the spindle.
speedOf :: ModalState -> SpindleNumbers
speedOf m = case (valueOf (speed m), valueOf (speedMode m)) of
  (Nothing, _) -> NoNumber
  (Just v, Just (ConstantCutting limit)) -> SurfaceNumbers (v * perUnit) limit
  (Just v, _) -> TurnNumber (round v)
  where
    -- In inches a cutting speed is in feet per minute.
    perUnit = if valueOf (speedUnits m) == Just Inches then 304.8 else 1000 :: Double

-- | Adds a frame of commands.
addCommands :: Int -> [(Machine.CommandName, Int)] -> Converting -> Converting
addCommands n ws c = c {made = ReadFrame (Frame.commandFrame ws) n : made c}

-- | Adds a frame for the commands that no frame holds yet.
flushed :: Int -> Converting -> Converting
flushed n c = case pending c of
  Nothing -> c
  Just p -> addCommands n (given p) c {pending = Nothing}

-- | Adds a frame with motion, with the commands that no frame holds yet. A motion without pulses
-- has no frame.
addMotion :: Int -> Converting -> Frame -> Converting
addMotion n c f
  | Frame.isStill f && motion f `elem` [Linear, Rapid] = c
  | otherwise =
    c
      { here = here c + increment f,
        pending = Nothing,
        made = ReadFrame f {commands = maybe [] given (pending c)} n : made c
      }

-- | Rapid frames from one position to another: those that go straight up, and all others. One
-- straight frame leads from one position above the part to another; otherwise the frames show that
-- the tool goes up above the part and comes down again. On a lathe they go along x at the larger of
-- the two radii.
joining :: Machine -> Pulses3 -> Pulses3 -> ([Frame], [Frame])
joining machine a@(Pulses3 ax ay az) b@(Pulses3 bx by bz)
  | isJust (Machine.programForm machine >>= Machine.lathe) =
    ([], leading [a, Pulses3 ax outer az, Pulses3 bx outer bz, b])
  | (ax, ay) /= (bx, by) && min az bz >= 0 = ([], leading [a, b])
  | otherwise = (leading [a, Pulses3 ax ay top], leading [Pulses3 ax ay top, Pulses3 bx by top, b])
  where
    outer = max ay by
    top
      | (ax, ay) == (bx, by) = max az bz
      | otherwise = maximum [az, bz, 0]
    leading ps = [rapidFrame (q - p) | (p, q) <- zip ps (drop 1 ps), p /= q]
    rapidFrame d =
      (Frame.commandFrame []) {motion = Rapid, increment = d}

-- | Frame of a motion between two positions in pulses, and the distance by which it may deviate
-- from the motion because its centre is rounded to pulses. The far side of an arc deviates by twice
-- the distance of the centre.
frameOf :: Machine -> Step -> Travel -> Pulses3 -> Pulses3 -> (Frame, Double)
frameOf machine step travel begin target = case mode travel of
  RapidMode -> (plain {motion = Rapid}, 0)
  LinearMode -> (plain {motion = Linear, feedCode}, 0)
  ArcMode sense
    | Just c <- about travel,
      maybe True (== planeOf machine) (valueOf (plane (state step))),
      (centre, off) <- centreFrom c ->
      (plain {motion = Circular sense, feedCode, centre}, 2 * off)
    -- An arc in another plane is a finding of its own.
    | otherwise -> (plain {motion = Linear, feedCode}, 0)
  -- The moves of canned cycles are rapid moves and lines.
  CycleMode _ -> (plain {motion = Linear, feedCode}, 0)
  where
    plain = (Frame.commandFrame []) {increment = target - begin}
    feedCode = feedCodeOf machine (state step)
    centreFrom (i, j) =
      let Pulses3 x y _ = begin
          (cx, dx) = nearest (pulseOf machine X) i
          (cy, dy) = nearest (pulseOf machine Y) j
       in (Pulses2 (cx - x) (cy - y), sqrt (dx * dx + dy * dy))

-- | Feed code of the state.
feedCodeOf :: Machine -> ModalState -> FeedCode
feedCodeOf machine m = case (valueOf (feedMode m), Machine.turnFeeds (Machine.feeds machine)) of
  (Just PerTurn, Just f) -> TurnCode (maybe 0 (round . (/ turnStep f)) given')
  _ -> FeedCode (maybe 0 inSteps given')
  where
    given' = valueOf (Gcode.ModalState.feed m)
    inSteps v = round (v / Machine.directStep (Machine.feeds machine))

-- | Plane of the part's axes x and y, by the letters of the control.
planeOf :: Machine -> Plane
planeOf machine = case letterOf machine X of
  'Z' -> PlaneZX
  _ -> PlaneXY

-- | Position in pulses along the axes of the part, and its distance in mm from the position itself.
-- Nothing if a coordinate is not known. The axes of a machine are looked up once for all positions.
inPulses :: Machine -> ToolPlace -> Maybe (Pulses3, Double)
inPulses machine = \place -> do
  (x, dx) <- alongX place
  (y, dy) <- alongY place
  (z, dz) <- alongZ place
  pure (Pulses3 x y z, sqrt (dx * dx + dy * dy + dz * dz))
  where
    (alongX, alongY, alongZ) = (along X, along Y, along Z)
    along axis
      | isNothing (Machine.wordFor machine (Along axis)) = const (Just (0, 0))
      | otherwise =
        let (coordinate, pulse) = (coordinateBy (letterOf machine axis), pulseOf machine axis)
         in \place -> case coordinate place of
              At p -> Just (nearest pulse p)
              Retracted -> Nothing
              InMachine _ -> Nothing
              Anywhere -> Nothing
    coordinateBy c = case c of
      'X' -> placeX
      'Y' -> placeY
      _ -> placeZ

-- | Nearest pulse, for the size of pulses in picometres, and the distance from it in mm.
nearest :: Int -> Int -> (Pulses, Double)
nearest pulse p = (Pulses n, abs (picometres (p - n * pulse)))
  where
    n = (2 * p + pulse) `div` (2 * pulse)

-- | Size of a pulse of an axis in picometres.
pulseOf :: Machine -> Axis -> Int
pulseOf machine axis =
  let Mm resolution = Machine.resolutionOf machine axis
   in max 1 (round (resolution * 1.0e9))

-- | Letter of the words of an axis.
letterOf :: Machine -> Axis -> Char
letterOf machine axis = fromMaybe 'Z' $ do
  word <- Machine.wordFor machine (Along axis)
  fst <$> Text.uncons (Machine.address word)
