-- | Modal state of a modern control: everything that stays in force from line to line.
--
-- A control keeps most of its state from the program before. So at the beginning of a file every
-- part of the state is 'Unset', except what the control does not let a program choose.
module Gcode.ModalState
  ( ModalState (..),
    Modal (..),
    valueOf,
    lineOf,
    Units (..),
    Plane (..),
    Distances (..),
    FeedKind (..),
    MotionMode (..),
    CannedCycle (..),
    Spindle (..),
    SpeedMode (..),
    ToolLength (..),
    Coolant (..),
    PathMode (..),
    initial,
  )
where

import Base.Quantity (Mm)
import Geometry.Carrier (Sense)
import Machine.ProgramForm (Dialect (..))

-- | Part of the state. 'SetAt' has the number of the line that set it; 0 if the control does not
-- let a program choose it.
data Modal a = Unset | SetAt Int a
  deriving stock (Eq, Show)

-- | Value of a part of the state; Nothing if no line has set it.
valueOf :: Modal a -> Maybe a
valueOf part = case part of
  Unset -> Nothing
  SetAt _ a -> Just a

-- | Number of the line that set a part of the state; Nothing if no line has.
lineOf :: Modal a -> Maybe Int
lineOf part = case part of
  SetAt n _ | n > 0 -> Just n
  _ -> Nothing

data Units = Millimetres | Inches
  deriving stock (Eq, Show)

-- | Plane of arcs, by the letters of its axes.
data Plane = PlaneXY | PlaneZX | PlaneYZ
  deriving stock (Eq, Show)

-- | Meaning of positions, or of the centres of arcs.
data Distances = Absolute | Incremental
  deriving stock (Eq, Show)

data FeedKind = PerMinute | PerTurn | InverseTime
  deriving stock (Eq, Show)

-- | Kind of motion of a line with words of axes.
data MotionMode = RapidMode | LinearMode | ArcMode Sense | CycleMode CannedCycle
  deriving stock (Eq, Show)

-- | Canned cycle for holes.
data CannedCycle
  = -- | G81
    DrillingCycle
  | -- | G82
    DwellingCycle
  | -- | G83
    PeckingCycle
  | -- | G73
    ChipCycle
  | -- | G85
    ReamingCycle
  | -- | G84
    TappingCycle
  | -- | G33.1: tapping in step with the spindle
    SynchronousCycle
  deriving stock (Eq, Show, Enum, Bounded)

-- | Spindle: off, or turning in a sense.
data Spindle = SpindleStopped | SpindleTurning Sense
  deriving stock (Eq, Show)

-- | Meaning of the speed of the spindle: turns per minute (G97), or a constant cutting speed (G96)
-- with a limit of the turns per minute; Nothing without a limit.
data SpeedMode = ConstantTurns | ConstantCutting (Maybe Int)
  deriving stock (Eq, Show)

-- | Length of the tool that the control takes into account: none, or that of an entry of the tool
-- table. A change of the tool makes the length 'LengthOfOther': that of the tool before.
data ToolLength = NoLength | LengthOf Int | LengthOfOther
  deriving stock (Eq, Show)

-- | Coolant: off, mist (M7), flood (M8), or both.
data Coolant = CoolantOff | Mist | Flood | MistAndFlood
  deriving stock (Eq, Ord, Show)

-- | Path at corners: exact, or with a deviation of at most so many mm; Nothing if the deviation has
-- no bound.
data PathMode = ExactPath | Blended (Maybe Mm)
  deriving stock (Eq, Show)

-- | State of a control. A speed is in turns per minute or, at a constant cutting speed, in m per
-- minute. A feed is in mm per minute or per turn.
data ModalState = ModalState
  { motionMode :: Modal MotionMode,
    units :: Modal Units,
    plane :: Modal Plane,
    distances :: Modal Distances,
    arcCentres :: Modal Distances,
    feedMode :: Modal FeedKind,
    feed :: Modal Double,
    -- | number of the work offset, 54 to 59
    workOffset :: Modal Int,
    -- | number of the tool that the next change puts into the spindle
    selectedTool :: Modal Int,
    -- | number of the tool in the spindle
    toolInSpindle :: Modal Int,
    toolLength :: Modal ToolLength,
    spindle :: Modal Spindle,
    speed :: Modal Double,
    speedMode :: Modal SpeedMode,
    -- | units when the control took the speed; LinuxCNC keeps a cutting speed in them
    speedUnits :: Modal Units,
    coolant :: Modal Coolant,
    pathMode :: Modal PathMode,
    -- | true if canned cycles come back to the height R (G99), false if to the height before them
    -- (G98)
    returnsToPlane :: Modal Bool,
    -- | true if the words of X are diameters (G7), false if they are radii (G8)
    diameters :: Modal Bool,
    -- | true while the control computes the path of the cutter's centre (G41, G42)
    compensates :: Modal Bool
  }
  deriving stock (Eq, Show)

-- | State before the first line of a file.
initial :: Dialect -> ModalState
initial dialect =
  ModalState
    { motionMode = Unset,
      units = Unset,
      plane = Unset,
      distances = Unset,
      arcCentres = case dialect of
        LinuxCnc -> Unset
        Grbl -> fixed Incremental
        Marlin -> fixed Incremental
        Fanuc -> fixed Incremental,
      feedMode = if dialect == Marlin then fixed PerMinute else Unset,
      feed = Unset,
      workOffset = Unset,
      selectedTool = Unset,
      toolInSpindle = Unset,
      toolLength = Unset,
      spindle = Unset,
      speed = Unset,
      speedMode = ifFixed ConstantTurns,
      speedUnits = Unset,
      coolant = Unset,
      returnsToPlane = Unset,
      pathMode = ifFixed ExactPath,
      diameters = case dialect of
        LinuxCnc -> Unset
        Grbl -> fixed False
        Marlin -> fixed False
        Fanuc -> fixed False,
      compensates = ifFixed False
    }
  where
    fixed = SetAt 0
    -- LinuxCNC and Fanuc let a program choose.
    ifFixed a = case dialect of
      LinuxCnc -> Unset
      Fanuc -> Unset
      Grbl -> fixed a
      Marlin -> fixed a
