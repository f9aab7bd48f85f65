-- | Frames of the motions that are read from a G-code file, for the proof.
--
-- A frame needs its beginning and its end in work coordinates. While the tool is at the retract
-- height, or where it is not known, there are no frames; this is an /excursion/: the beginning of
-- the file, a change of the tool, the end. After an excursion the frames go on where the tool comes
-- down. If it comes down elsewhere than it left, rapid frames join both positions.
--
-- Commands are given in the frames as "Frame.CommandState" orders them.
module Gcode.ToFrames
  ( GcodeReading (..),
    ReadFrame (..),
    FirstTool (..),
    reading,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Base.Region (Located (Located), Region (Region))
import Data.Bifunctor (first)
import Data.List (foldl')
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isJust, isNothing)
import Data.Text qualified as Text
import Frame.Command (Pending (..))
import Frame.Command qualified as Command
import Frame.CommandState (CommandState (..))
import Frame.CommandState qualified as CommandState
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Gcode.ModalState
import Gcode.Run
import Geometry.Carrier qualified as Carrier
import Machine.Machine (Axis (..), Content (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Sense (..))
import Part.Part qualified as Part

-- | Frames of a file, and all its actions.
data GcodeReading = GcodeReading
  { readFrames :: [ReadFrame],
    steps :: [Step],
    -- | largest distance in mm, along one axis, of a position in the file from the nearest pulse
    offGrid :: Mm
  }
  deriving stock (Eq, Show)

-- | A frame, and the number of the line that makes its motion or gives its commands.
data ReadFrame = ReadFrame {readFrame :: Frame, readFrom :: Int}
  deriving stock (Eq, Show)

-- | Number of the tool that the program has loaded before the file, and for each tool the offset in
-- pulses from its centre to the point that the control leads; 0 for tools that are not in the list.
data FirstTool = FirstTool {firstNumber :: Maybe Int, tipsOfTools :: Map Int Pulses3}

-- | State of the conversion.
data Converting = Converting
  { -- | last known position in pulses
    here :: Pulses3,
    -- | true during an excursion
    isAway :: Bool,
    commanded :: CommandState,
    pending :: Maybe Pending,
    -- | line of the last start of the spindle for which the file has waited, or has cut without
    waitedFor :: Maybe Int,
    -- | the latest frame first
    made :: [ReadFrame],
    -- | offset in pulses of the point that the control leads from the centre of each tool
    tips :: Map Int Pulses3,
    lost :: Double
  }

-- | Frames of the actions of a file. @level@ is the height in pulses from which on the tool is
-- above everything; Nothing if no height in work coordinates is. @start@ is the position of the
-- program before its first frame.
reading :: Machine -> Maybe Pulses -> FirstTool -> Pulses3 -> [Step] -> GcodeReading
reading machine level FirstTool {firstNumber, tipsOfTools} start list =
  GcodeReading
    { readFrames = reverse (made end),
      steps = list,
      offGrid = Mm (lost end)
    }
  where
    begin =
      Converting
        { here = start,
          isAway = True,
          commanded = CommandState.initial {tool = firstNumber},
          pending = Nothing,
          waitedFor = Nothing,
          made = [],
          tips = tipsOfTools,
          lost = 0
        }
    end = foldl' (converted machine level) begin list

-- | Converts one action.
converted :: Machine -> Maybe Pulses -> Converting -> Step -> Converting
converted machine level c step = case action step of
  Travels travel -> travelled machine level (withCommands machine step) (cutting travel) step travel
  Changes _ _ -> c
  Dwells t
    | isStart, waitedFor c /= started -> c {waitedFor = started}
    | otherwise -> event (Part.Dwell t)
  Stops -> event Part.ProgramStop
  StopsOnDemand -> event Part.OptionalStop
  Ends ->
    foldl'
      (\c' ws -> addCommands (line step) ws (flushed (line step) c'))
      c
      (Command.finalFrames machine)
  where
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
        (withCommands machine step c)

-- | Converts a motion. @switched@ adds the commands that the state of the motion shows.
travelled ::
  Machine ->
  Maybe Pulses ->
  (Converting -> Converting) ->
  Converting ->
  Step ->
  Travel ->
  Converting
travelled machine level switched c step travel = case centreAt (to travel) of
  Just (target, off)
    | maybe False (height target >=) level -> c {isAway = True}
    | isAway c || isNothing (centreAt (from travel)) ->
      let c' = switched c {isAway = False, lost = max (lost c) off}
       in foldl' (addMotion (line step)) c' (joining machine (here c') target)
    | otherwise ->
      addMotion
        (line step)
        (switched c {lost = max (lost c) off})
        (frameOf machine step (centred travel) (here c) target)
  Nothing -> c {isAway = True}
  where
    height (Pulses3 _ _ z) = z
    tip = fromMaybe 0 (valueOf (toolInSpindle (state step)) >>= (`Map.lookup` tips c))
    centreAt place = first (subtract tip) <$> inPulses machine place
    centred t = t {about = fmap (shiftedBy machine tip) (about t)}

-- | Centre of an arc in picometres, without an offset in pulses.
shiftedBy :: Machine -> Pulses3 -> (Int, Int) -> (Int, Int)
shiftedBy machine (Pulses3 dx dy _) (i, j) = (i - along X dx, j - along Y dy)
  where
    along axis (Pulses n) = n * pulseOf machine axis

-- | Adds the commands that lead to the state of a step.
withCommands :: Machine -> Step -> Converting -> Converting
withCommands machine step c = foldl' add c {commanded = now} groups
  where
    now = stateOf (state step)
    groups = CommandState.between machine (commanded c) now
    add c' ws = added machine step (Command.Translation ws False [] []) c'

-- | Adds the words of a command.
added :: Machine -> Step -> Command.Translation -> Converting -> Converting
added machine step translation c =
  foldl' (\d p -> addCommands (line step) (given p) d) c {pending = pending'} full
  where
    (full, pending') = Command.add machine (Region 0 0) translation (pending c)

-- | State of tool, spindle and coolant. Unknown parts count as off; "Verify.ControlState" finds
-- them.
stateOf :: ModalState -> CommandState
stateOf m =
  CommandState
    { tool = valueOf (toolInSpindle m),
      CommandState.spindle = case valueOf (Gcode.ModalState.spindle m) of
        Just (SpindleTurning sense) -> Just (senseOf sense, round <$> valueOf (speed m))
        _ -> Nothing,
      coolantRuns = valueOf (coolant m) `notElem` [Nothing, Just CoolantOff]
    }
  where
    senseOf sense = case sense of
      Carrier.Clockwise -> Clockwise
      Carrier.CounterClockwise -> CounterClockwise

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

-- | Rapid frames from one position to another: at the higher of the two heights; on a lathe at the
-- larger of the two radii.
joining :: Machine -> Pulses3 -> Pulses3 -> [Frame]
joining machine a@(Pulses3 ax ay az) b@(Pulses3 bx by bz)
  | isJust (Machine.programForm machine >>= Machine.lathe) =
    map rapidFrame (differences [a, Pulses3 ax outer az, Pulses3 bx outer bz, b])
  | otherwise = map rapidFrame (differences [a, Pulses3 ax ay top, Pulses3 bx by top, b])
  where
    outer = max ay by
    top = max az bz
    differences ps = [q - p | (p, q) <- zip ps (drop 1 ps), p /= q]
    rapidFrame d =
      (Frame.commandFrame []) {motion = Rapid, increment = d}

-- | Frame of a motion between two positions in pulses.
frameOf :: Machine -> Step -> Travel -> Pulses3 -> Pulses3 -> Frame
frameOf machine step travel begin target = case mode travel of
  RapidMode -> plain {motion = Rapid}
  LinearMode -> plain {motion = Linear, feedCode}
  ArcMode sense
    | Just c <- about travel,
      maybe True (== planeOf machine) (valueOf (plane (state step))) ->
      plain {motion = Circular sense, feedCode, centre = centreFrom c}
    -- An arc in another plane is a finding of its own.
    | otherwise -> plain {motion = Linear, feedCode}
  where
    plain = (Frame.commandFrame []) {increment = target - begin}
    feedCode = FeedCode (maybe 0 inSteps (valueOf (Gcode.ModalState.feed (state step))))
    inSteps v = round (v / Machine.directStep (Machine.feeds machine))
    centreFrom (i, j) =
      let Pulses3 x y _ = begin
          (cx, _) = nearest machine X i
          (cy, _) = nearest machine Y j
       in Pulses2 (cx - x) (cy - y)

-- | Plane of the part's axes x and y, by the letters of the control.
planeOf :: Machine -> Plane
planeOf machine = case letterOf machine X of
  'Z' -> PlaneZX
  _ -> PlaneXY

-- | Position in pulses along the axes of the part, and the largest distance in mm of a coordinate
-- from its pulse. Nothing if a coordinate is not known.
inPulses :: Machine -> ToolPlace -> Maybe (Pulses3, Double)
inPulses machine place = do
  (x, dx) <- along X
  (y, dy) <- along Y
  (z, dz) <- along Z
  pure (Pulses3 x y z, maximum [dx, dy, dz])
  where
    along axis
      | isNothing (Machine.wordFor machine (Along axis)) = Just (0, 0)
      | otherwise = case coordinate (letterOf machine axis) of
        At p -> Just (nearest machine axis p)
        Retracted -> Nothing
        Anywhere -> Nothing
    coordinate c = case c of
      'X' -> placeX place
      'Y' -> placeY place
      _ -> placeZ place

-- | Nearest pulse of an axis, and the distance from it in mm.
nearest :: Machine -> Axis -> Int -> (Pulses, Double)
nearest machine axis p = (Pulses n, abs (picometres (p - n * pulse)))
  where
    pulse = pulseOf machine axis
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
