-- | Judges the state of a modern control at each motion of a file: units, plane, modes, work offset,
-- tool and its length, spindle and path mode.
--
-- What a file does not set is what the program before has left, so it is wrong as well. Commands
-- that differ from those of the program, such as another tool or speed, are found by the comparison
-- of the frames ("Verify.FrameRule").
module Verify.ControlState
  ( ControlFinding (..),
    ControlFault (..),
    StateDemand (..),
    findings,
    largestBlending,
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Base.Region (Region)
import Data.List (foldl')
import Data.Maybe (mapMaybe)
import Data.Set qualified as Set
import Data.Text (Text)
import Gcode.ModalState
import Gcode.Run (Action (..), Coordinate (..), Place (..), Step (..), Travel (..))
import Machine.ProgramForm (ProgramForm (..), Retract (..))
import Machine.ProgramForm qualified as ProgramForm
import Report.Report (Report (hints, label, message, others), ReportPlace (..), report)
import Report.Report qualified as Report

-- | State that a program asks for in all its cuts.
data StateDemand = StateDemand
  { -- | number of the work offset
    offset :: Int,
    -- | plane of x and y of the part
    cuttingPlane :: Plane,
    -- | height in picometres from which on the tool is above everything, in work coordinates;
    -- Nothing if only the retract height is
    level :: Maybe Int,
    -- | height in picometres from which on the motions of the file are not those of the program
    excursion :: Maybe Int,
    -- | height in picometres from which on rapid moves pass over everything, if their axes may arrive
    -- one after the other; Nothing if they move along a straight line
    boxLevel :: Maybe Int,
    -- | true if the operator switches the spindle
    isByHand :: Bool
  }
  deriving stock (Eq, Show)

-- | Fault of the state at a line, and the line that set the wrong value; Nothing if none did.
data ControlFinding = ControlFinding
  { atLine :: Int,
    setAt :: Maybe Int,
    fault :: ControlFault
  }
  deriving stock (Eq, Show)

data ControlFault
  = -- | the spindle is off, or no line says that it turns
    SpindleOff
  | -- | the spindle turns at a speed that no line sets
    SpeedUnknown
  | -- | the length of the tool is not taken
    LengthNotTaken
  | -- | the length is that of another tool: the number of the length, the number of the tool
    LengthOfAnother Int (Maybe Int)
  | -- | arcs are in another plane, or no line says in which
    WrongPlane
  | -- | no line sets the units
    UnitsUnknown
  | -- | a mode is not set, or set wrongly: its words
    WrongMode Text
  | -- | another work offset than the program's, or none: the one that the program asks for
    WrongOffset Int
  | -- | the control may leave the path by any distance
    NoBound
  | -- | no line sets the path mode
    PathModeUnknown
  | -- | x or y moves while the height is unknown, or together with z
    UnsafeMove
  | -- | a rapid move of several axes that may arrive one after the other, below the clearance height
    -- or together with z
    BoxMove
  | -- | z goes down to a position before x and y have theirs
    UnsafeDescent
  deriving stock (Eq, Ord, Show)

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
  Travels travel
    | isCut travel -> unsafeMoves demand step travel <> readiness <> cutting travel
    | isDescent travel -> unsafeMoves demand step travel <> readiness
    | otherwise -> unsafeMoves demand step travel
  _ -> []
  where
    readiness = settled form demand step
    cutting = cutState form demand step
    isCut travel = mode travel /= RapidMode
    -- From the retract height, or from an unknown one, to a height in work coordinates.
    isDescent travel = case (placeZ (from travel), placeZ (to travel)) of
      (At a, At b) -> maybe False (a >=) (level demand) && b < a
      (_, At b) -> maybe True (b <) (level demand)
      _ -> False

-- | What has to be settled before the tool comes down: units, distances, offset, length.
settled :: ProgramForm -> StateDemand -> Step -> [ControlFinding]
settled form demand step =
  [finding (units m) UnitsUnknown | valueOf (units m) == Nothing]
    <> [finding (distances m) (WrongMode "G90") | valueOf (distances m) == Nothing]
    <> [finding (diameters m) (WrongMode "G8") | valueOf (diameters m) /= Just False]
    <> [finding (compensates m) (WrongMode "G40") | valueOf (compensates m) /= Just False]
    <> [ finding (workOffset m) (WrongOffset (offset demand))
         | valueOf (workOffset m) /= Just (offset demand)
       ]
    <> lengthFindings
  where
    m = state step
    finding part = ControlFinding (line step) (lineOf part)
    lengthFindings
      | not (ProgramForm.takesLengths (dialect form)) = []
      | otherwise = case valueOf (toolLength m) of
        Just (LengthOf n)
          | Just n /= valueOf (toolInSpindle m) ->
            [finding (toolLength m) (LengthOfAnother n (valueOf (toolInSpindle m)))]
          | otherwise -> []
        _ -> [finding (toolLength m) LengthNotTaken]

-- | What a cut needs besides.
cutState :: ProgramForm -> StateDemand -> Step -> Travel -> [ControlFinding]
cutState _ demand step travel =
  spindleFindings
    <> [finding (plane m) WrongPlane | valueOf (plane m) /= Just (cuttingPlane demand)]
    <> [finding (feedMode m) (WrongMode "G94") | valueOf (feedMode m) /= Just PerMinute]
    <> [ finding (arcCentres m) (WrongMode "G91.1")
         | ArcMode _ <- [mode travel],
           valueOf (arcCentres m) == Nothing
       ]
    <> pathFindings
  where
    m = state step
    finding part = ControlFinding (line step) (lineOf part)
    spindleFindings
      | isByHand demand = []
      | otherwise = case valueOf (spindle m) of
        Just (SpindleTurning _)
          | Just s <- valueOf (speed m), s > 0 -> []
          | otherwise -> [finding (speed m) SpeedUnknown]
        _ -> [finding (spindle m) SpindleOff]
    pathFindings = case valueOf (pathMode m) of
      Nothing -> [finding (pathMode m) PathModeUnknown]
      Just (Blended Nothing) -> [finding (pathMode m) NoBound]
      _ -> []

-- | Faults of a rapid move whose beginning or end is not in work coordinates: z moves alone, and x
-- and y move only at the retract height.
unsafeMoves :: StateDemand -> Step -> Travel -> [ControlFinding]
unsafeMoves demand step travel
  | isKnown (from travel) && isKnown (to travel) =
    [bad UnsafeMove | isOutside (from travel) /= isOutside (to travel), not isAloneZ]
      <> [bad BoxMove | mode travel == RapidMode, Just free <- [boxLevel demand], isBox free]
  | isAloneZ = [bad UnsafeDescent | comesDown && not (hasPlane (to travel))]
  | isAbove (placeZ (from travel)) && placeZ (from travel) == placeZ (to travel) = []
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
    isAloneZ =
      placeX (from travel) == placeX (to travel) && placeY (from travel) == placeY (to travel)
    hasPlane p = isAt (placeX p) && isAt (placeY p)
    comesDown = case placeZ (to travel) of
      At z -> maybe True (z <) (level demand)
      Retracted -> False
      Anywhere -> True
    isAbove z = case z of
      Retracted -> True
      At h -> maybe False (h >=) (level demand)
      Anywhere -> False
    isKnown p = hasPlane p && isAt (placeZ p)
    isOutside p = case placeZ p of
      At h -> maybe False (h >=) (excursion demand)
      Retracted -> True
      Anywhere -> False
    isAt c = case c of
      At _ -> True
      Retracted -> False
      Anywhere -> False

-- | Largest deviation in mm that the control may make at corners of cuts.
largestBlending :: [Step] -> Mm
largestBlending = foldl' max (Mm 0) . mapMaybe bound
  where
    bound step = case (action step, valueOf (pathMode (state step))) of
      (Travels travel, Just (Blended (Just p))) | mode travel /= RapidMode -> Just p
      _ -> Nothing

-- | Report of a finding. @lineRegion@ gives the region of a line of the file.
toReport :: ProgramForm -> (Int -> Region) -> ControlFinding -> Report
toReport form lineRegion (ControlFinding n set' fault') =
  (report Report.Error code (InSource (lineRegion n)) title)
    { label = label',
      others = [Report.Label (lineRegion k) "set here" | Just k <- [set'], k /= n],
      message = [why],
      hints = [hint]
    }
  where
    (code, title, label', why, hint) = words'
    kept = "The control keeps what the program before has set."
    words' = case fault' of
      SpindleOff ->
        ( "E0723",
          "a cut begins, but the spindle does not turn",
          "this motion cuts",
          maybe "No line before it switches the spindle on." (const "The spindle is switched off before it.") set',
          "Write the speed and M3 or M4 before the cut, as in S8000 M3."
        )
      SpeedUnknown ->
        ( "E0724",
          "a cut begins, but no line sets the speed of the spindle",
          "this motion cuts",
          kept,
          "Write the speed before M3, as in S8000 M3."
        )
      LengthNotTaken ->
        ( "E0725",
          "the tool comes down or cuts before its length is taken",
          "",
          "The control takes into account no length, or that of the tool before.",
          "Write G43 H with the number of the tool after each M6."
        )
      LengthOfAnother h tool ->
        ( "E0726",
          "the tool comes down or cuts with the length of another tool",
          "",
          "The length is that of tool "
            <> Decimal.whole h
            <> maybe
              ", and no line says which tool is in the spindle."
              (\t -> ", and tool " <> Decimal.whole t <> " is in the spindle.")
              tool,
          "Write G43 H with the number of the tool in the spindle."
        )
      WrongPlane ->
        ( "E0727",
          "a cut in another plane than that of the part",
          "this motion cuts",
          maybe kept (const "The plane of arcs is that of other axes.") set',
          "Write G17 before the cut."
        )
      UnitsUnknown ->
        ( "E0728",
          "no line sets the units of the numbers",
          "",
          kept,
          "Write G21 for mm or G20 for inches before the first motion."
        )
      WrongMode word ->
        ( "E0729",
          "a motion in a wrong mode: " <> word <> " is not in force",
          "",
          maybe kept (const "Another mode was set before.") set',
          "Write " <> word <> " before the motion."
        )
      WrongOffset wanted ->
        ( "E0730",
          "a motion in another work offset than the program's",
          "",
          maybe kept (const "Another work offset was set before.") set',
          "Write G" <> Decimal.whole wanted <> " before the first motion, or state the work offset in the program."
        )
      NoBound ->
        ( "E0731",
          "a cut in a path mode that may leave the path by any distance",
          "this motion cuts",
          "G64 without P, or with P0, has no bound.",
          "Write G64 P with the largest deviation and Q0, or G61."
        )
      PathModeUnknown ->
        ( "E0731",
          "a cut, but no line sets the path mode",
          "this motion cuts",
          kept,
          "Write G64 P with the largest deviation and Q0, or G61."
        )
      UnsafeMove ->
        ( "E0732",
          "the tool moves sideways at an unknown height",
          "",
          "Whatever stands in its way is hit.",
          safeHint
        )
      BoxMove ->
        ( "E0734",
          "a rapid move whose axes may arrive one after the other",
          "",
          "This control does not move along a straight line in rapid.",
          "Move z alone, and x and y together only at the clearance height or above it."
        )
      UnsafeDescent ->
        ( "E0732",
          "the tool comes down at an unknown place",
          "",
          "No motion before it brings x and y to a position in work coordinates.",
          safeHint
        )
    safeHint = case retract form of
      MachineHeight (Mm h) ->
        "Move z alone first, by G53 G0 Z" <> Decimal.short 3 h <> ", then x and y, then z."
      ReferencePoint -> "Move z alone first, by G91 G28 Z0, then x and y, then z."
      SafeHeight -> "Move z alone first, up to the safe height of the program, then x and y, then z."
