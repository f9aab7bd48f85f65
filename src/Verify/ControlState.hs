-- | Judges the state of a modern control at each motion of a file: units, plane, modes, work
-- offset, tool and its length, spindle, coolant and path mode.
--
-- A value that a file does not set is the one that the program before has left, so it is wrong as
-- well. Commands that differ from those of the program, such as another tool or speed, are found by
-- the comparison of the frames ("Verify.FrameRule").
module Verify.ControlState
  ( StateDemand (..),
    findings,
    largestBlending,
  )
where

import Base.Quantity (Mm (..))
import Data.List (foldl')
import Data.Maybe (isJust, isNothing, mapMaybe)
import Data.Set qualified as Set
import Gcode.ModalState
import Gcode.Run (Action (..), Coordinate (..), Step (..), ToolPlace (..), Travel (..))
import Machine.ProgramForm (ProgramForm (..), XMeaning (..))
import Machine.ProgramForm qualified as ProgramForm
import Verify.ControlFault (ControlFault (..), ControlFinding (..), ControlMode (..))
import Verify.LatheMove (LatheDemand (..))
import Verify.LatheMove qualified as LatheMove

-- | State that a program asks for in all its cuts.
data StateDemand = StateDemand
  { -- | number of the work offset
    offset :: Int,
    -- | plane of x and y of the part
    cuttingPlane :: Plane,
    -- | height in picometres from which on the tool is above everything, in work coordinates;
    -- Nothing if only the retract height is
    level :: Maybe Int,
    -- | height in picometres from which on rapid moves pass over everything, if their axes may
    -- arrive one after the other; Nothing if they move along a straight line
    boxLevel :: Maybe Int,
    -- | true if the operator switches the spindle
    isByHand :: Bool,
    -- | true if the control has feeds for one turn of the spindle; the comparison of the frames
    -- then finds a wrong unit of a feed
    hasTurnFeeds :: Bool,
    -- | Nothing for a milling machine
    latheDemand :: Maybe LatheDemand,
    -- | coolant that runs if the program has switched it on
    runningCoolant :: Coolant,
    -- | largest deviation at corners, if the program has no contour whose tolerance bounds it
    mostBlending :: Maybe Mm,
    -- | numbers of the taps, and the pitches of their threads
    tapNumbers :: [Int],
    tapPitches :: [Mm]
  }
  deriving stock (Eq, Show)

-- | Faults of the actions of a file, the first of each kind and origin.
findings :: ProgramForm -> StateDemand -> [Step] -> [ControlFinding]
findings form demand = firstOfEach . concatMap (judged form demand)

-- | The first finding of each kind.
firstOfEach :: [ControlFinding] -> [ControlFinding]
firstOfEach = go Set.empty
  where
    go known list = case list of
      [] -> []
      f : more
        | key f `Set.member` known -> go known more
        | otherwise -> f : go (Set.insert (key f) known) more
    key f = (fault f, setAt f)

-- | Faults of one action.
judged :: ProgramForm -> StateDemand -> Step -> [ControlFinding]
judged form demand step = case action step of
  Travels travel ->
    toRetract travel
      <> (if isCut travel || isDescent travel then settled form demand step else [])
      <> (if isCut travel then cutState demand step travel else [])
      <> workingState demand step travel
  Changes at _ -> [ControlFinding (line step) Nothing LowChange | not (isClear demand at)]
  Dwells _ -> []
  Stops -> []
  StopsOnDemand -> []
  FileEnds ->
    [ ControlFinding (line step) (lineOf (spindle (state step))) SpindleLeftOn
      | not (isByHand demand),
        Just (SpindleTurning _) <- [valueOf (spindle (state step))]
    ]
  Ends -> []
  where
    isCut travel = mode travel /= RapidMode
    toRetract travel = case latheDemand demand of
      Just lathe -> map (ControlFinding (line step) Nothing) (LatheMove.faults lathe step travel)
      Nothing -> unsafeMoves demand step travel
    -- From the retract height, or from an unknown one, to a height in work coordinates.
    isDescent travel
      | isJust (latheDemand demand) = LatheMove.comesToWork travel
      | otherwise = comesDown travel
    comesDown travel = case (placeZ (from travel), placeZ (to travel)) of
      (At a, At b) -> maybe False (a >=) (level demand) && b < a
      (_, At b) -> maybe True (b <) (level demand)
      _ -> False

-- | Faults of the state in which the tool comes down: units, distances, offset, length.
settled :: ProgramForm -> StateDemand -> Step -> [ControlFinding]
settled form demand step =
  [finding (units m) UnitsUnknown | isNothing (valueOf (units m))]
    <> [finding (distances m) (ModeUnknown DistanceMode) | isNothing (valueOf (distances m))]
    <> [finding (diameters m) f | Just f <- [diameterFault demand (valueOf (diameters m))]]
    <> [ finding (compensates m) (ModeUnknown CompensationMode)
         | valueOf (compensates m) /= Just False
       ]
    <> [ finding (workOffset m) (WrongOffset (offset demand) (valueOf (workOffset m)))
         | valueOf (workOffset m) /= Just (offset demand)
       ]
    <> [ finding (toolLength m) f
         | ProgramForm.takesLengths (dialect form),
           Just f <- [lengthFault (valueOf (toolInSpindle m)) (valueOf (toolLength m))]
       ]
  where
    m = state step
    finding part = ControlFinding (line step) (lineOf part)

-- | Fault of the meaning of the words X. Nothing as an argument means that no line sets it.
diameterFault :: StateDemand -> Maybe Bool -> Maybe ControlFault
diameterFault demand areDiameters = case areDiameters of
  Nothing -> Just (ModeUnknown DiameterMode)
  Just found
    | found == wanted -> Nothing
    | found -> Just XInDiameters
    | otherwise -> Just XInRadii
  where
    wanted = (wordsOfX <$> latheDemand demand) == Just XDiameter

-- | Fault of the length that is taken for the tool in the spindle.
lengthFault :: Maybe Int -> Maybe ToolLength -> Maybe ControlFault
lengthFault tool taken = case taken of
  Nothing -> Just LengthNotTaken
  Just NoLength -> Just LengthOff
  Just LengthOfOther -> Just LengthOfToolBefore
  Just (LengthOf n)
    | Just n == tool -> Nothing
    | otherwise -> Just (LengthOfAnother n tool)

-- | Further faults of the state in which the tool cuts.
cutState :: StateDemand -> Step -> Travel -> [ControlFinding]
cutState demand step travel =
  (if isByHand demand then [] else spindleFindings)
    <> [finding (plane m) WrongPlane | valueOf (plane m) /= Just (cuttingPlane demand)]
    <> feedFindings
    <> tapFindings demand step
    <> [ finding (arcCentres m) (ModeUnknown ArcCentreMode)
         | isArc,
           isNothing (valueOf (arcCentres m))
       ]
  where
    m = state step
    finding part = ControlFinding (line step) (lineOf part)
    isArc = case mode travel of
      ArcMode _ -> True
      LinearMode -> False
      RapidMode -> False
      CycleMode _ -> False
    spindleFindings = case valueOf (spindle m) of
      Just (SpindleTurning _)
        | Just s <- valueOf (speed m), s > 0 -> speedFindings
        | otherwise -> [finding (speed m) NoSpeed]
      _ -> [finding (spindle m) SpindleOff]
    -- Machines without such a choice keep G97.
    speedFindings = case valueOf (speedMode m) of
      Nothing -> [finding (speedMode m) (ModeUnknown SpeedUnit) | isJust (latheDemand demand)]
      Just ConstantTurns -> []
      Just (ConstantCutting Nothing) -> [finding (speedMode m) NoSpeedLimit]
      Just (ConstantCutting (Just _)) ->
        [finding (speedUnits m) UnitsUnknown | isNothing (valueOf (speedUnits m))]
    feedFindings = case valueOf (feedMode m) of
      Nothing -> [finding (feedMode m) (ModeUnknown FeedUnit)]
      -- Without units no feed is known, but this is a finding of its own.
      Just PerMinute -> withoutFeed
      Just PerTurn
        | hasTurnFeeds demand -> withoutFeed
        | otherwise -> [finding (feedMode m) NotPerMinute]
      Just InverseTime -> [finding (feedMode m) NotPerMinute]
    withoutFeed =
      [ finding (feed m) NoFeed
        | isJust (valueOf (units m)),
          maybe True (<= 0) (valueOf (feed m))
      ]

-- | Faults of a cut with a tap: it needs a tapping cycle, and the pitch of a thread of the program.
tapFindings :: StateDemand -> Step -> [ControlFinding]
tapFindings demand step
  | valueOf (toolInSpindle m) `notElem` map Just (tapNumbers demand) = []
  | otherwise = case valueOf (motionMode m) of
    Just (CycleMode SynchronousCycle) ->
      [bad (OtherTapPitch p wanted) | p <- pitch, wanted : _ <- [others p]]
    Just (CycleMode TappingCycle) -> []
    _ -> [bad TapUnguided]
  where
    m = state step
    bad = ControlFinding (line step) Nothing
    pitch = [Mm (f / n) | Just f <- [valueOf (feed m)], Just n <- [valueOf (speed m)], n > 0]
    others (Mm p)
      | or [abs (p - q) <= 1.0e-6 | Mm q <- tapPitches demand] = []
      | otherwise = tapPitches demand

-- | Faults of the path mode and of the coolant at a motion in work coordinates, rapid moves
-- included.
workingState :: StateDemand -> Step -> Travel -> [ControlFinding]
workingState demand step travel
  | isWorking travel = pathFindings <> coolantFindings
  | otherwise = []
  where
    m = state step
    finding part = ControlFinding (line step) (lineOf part)
    pathFindings = case valueOf (pathMode m) of
      Nothing -> [finding (pathMode m) PathModeUnknown]
      Just ExactPath -> []
      Just (Blended Nothing) -> [finding (pathMode m) NoBound]
      Just (Blended (Just p))
        | Just most <- mostBlending demand,
          p > most ->
          [finding (pathMode m) (BoundTooLarge p most)]
        | otherwise -> []
    running = runningCoolant demand
    coolantFindings =
      [ finding (coolant m) (OtherCoolant running)
        | valueOf (coolant m) `notElem` [Nothing, Just CoolantOff, Just running]
      ]

-- | True for a motion that begins or ends at a known height in work coordinates.
isWorking :: Travel -> Bool
isWorking travel = any (isAt . placeZ) [from travel, to travel]

isAt :: Coordinate -> Bool
isAt c = case c of
  At _ -> True
  InMachine _ -> False
  Retracted -> False
  Anywhere -> False

-- | True for a height at which the tool is above everything.
isAbove :: StateDemand -> Coordinate -> Bool
isAbove demand z = case z of
  Retracted -> True
  At h -> maybe False (h >=) (level demand)
  InMachine _ -> False
  Anywhere -> False

-- | True for a place at which the tool may be changed: above everything, or on a lathe with x or z
-- at its retract position.
isClear :: StateDemand -> ToolPlace -> Bool
isClear demand at
  | isJust (latheDemand demand) = Retracted `elem` [placeX at, placeZ at]
  | otherwise = isAbove demand (placeZ at)

-- | Faults of a motion whose beginning or end is not in work coordinates: z has to move alone, and
-- x and y may move only at the retract height.
unsafeMoves :: StateDemand -> Step -> Travel -> [ControlFinding]
unsafeMoves demand step travel
  | isKnown (from travel) && isKnown (to travel) =
    [bad UnsafeMove | isOutside (from travel) /= isOutside (to travel), not isAloneZ]
      <> [bad BoxMove | mode travel == RapidMode, Just free <- [boxLevel demand], isBox free]
  | isAloneZ && isUnknown (placeZ (to travel)) = [bad UnknownHeight]
  | isAloneZ = [bad UnsafeDescent | comesDown && not (hasPlane (to travel))]
  | isAbove demand (placeZ (from travel)) && placeZ (from travel) == placeZ (to travel) = []
  | otherwise = [bad UnsafeMove]
  where
    bad = ControlFinding (line step) Nothing
    movesX = placeX (from travel) /= placeX (to travel)
    movesY = placeY (from travel) /= placeY (to travel)
    movesZ = placeZ (from travel) /= placeZ (to travel)
    isBox free = (movesX || movesY) && movesZ || movesX && movesY && isBelow free
    isBelow free = case placeZ (from travel) of
      At z -> z < free
      _ -> False
    -- A full circle ends where it begins.
    isAloneZ =
      isNothing (about travel)
        && placeX (from travel) == placeX (to travel)
        && placeY (from travel) == placeY (to travel)
    hasPlane p = isAt (placeX p) && isAt (placeY p)
    comesDown = case placeZ (to travel) of
      At z -> maybe True (z <) (level demand)
      Retracted -> False
      InMachine _ -> True
      Anywhere -> True
    isUnknown z = case z of
      At _ -> False
      Retracted -> False
      InMachine _ -> True
      Anywhere -> True
    isKnown p = hasPlane p && isAt (placeZ p)
    isOutside = isAbove demand . placeZ

-- | Largest deviation in mm that the control may make at corners in work coordinates.
largestBlending :: [Step] -> Mm
largestBlending = foldl' max (Mm 0) . mapMaybe bound
  where
    bound step = case (action step, valueOf (pathMode (state step))) of
      (Travels travel, Just (Blended (Just p))) | isWorking travel -> Just p
      _ -> Nothing
