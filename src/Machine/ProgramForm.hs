-- | The form of a whole program for a modern control: its words, and how a program begins, changes
-- the tool and ends. A machine without this form has no such control.
module Machine.ProgramForm
  ( ProgramForm (..),
    Dialect (..),
    Retract (..),
    RapidPath (..),
    Lathe (..),
    XMeaning (..),
    HoleCycles (..),
    PlainCycle (..),
    TapControl (..),
    noCycles,
    takesLengths,
    changesTools,
    hasPathMode,
  )
where

import Base.Quantity (LengthUnit, Mm, Seconds)
import Data.Text (Text)

-- | Form of the programs of a modern control.
data ProgramForm = ProgramForm
  { dialect :: Dialect,
    retract :: Retract,
    -- | time until the spindle turns at its speed; the control does not wait for it by itself
    spinUp :: Seconds,
    rapidPath :: RapidPath,
    -- | Nothing for a milling machine
    lathe :: Maybe Lathe,
    -- | largest count of characters in a line, without its end
    mostCharacters :: Int,
    -- | place of the tool change: x and y in machine coordinates, in mm; Nothing for a change where
    -- the tool is. The tool goes there at the retract height
    changePlace :: Maybe (Mm, Mm),
    cycles :: HoleCycles,
    -- | unit of the numbers in a file
    fileUnit :: LengthUnit,
    -- | step of the line numbers; Nothing for lines without numbers
    numberStep :: Maybe Int,
    -- | a remark for the head of each file; may be empty
    remark :: Text
  }
  deriving stock (Eq, Show)

-- | Family of controls that understand the same words. "Gcode.Dialect" lists the words.
data Dialect = LinuxCnc | Grbl | Marlin | Fanuc
  deriving stock (Eq, Show, Enum, Bounded)

-- | Height to which the tool goes before anything else, and how it gets there.
data Retract
  = -- | this height in machine coordinates, in mm, by G53
    MachineHeight Mm
  | -- | the reference point of z, by G28
    ReferencePoint
  | -- | the safe height of the program, in work coordinates: the control does not know where the
    -- machine stands. The height in mm serves programs that state none
    SafeHeight (Maybe Mm)
  deriving stock (Eq, Show)

-- | Path of a rapid move that moves several axes.
data RapidPath
  = -- | a straight line
    StraightPath
  | -- | any path in the box between the two ends: one axis may arrive before the other
    BoxPath
  deriving stock (Eq, Show)

-- | Words of a lathe: x of the part is written Z, and y, the radius, is written X.
data Lathe = Lathe
  { -- | position in machine coordinates, in mm from the axis of the spindle, at which the tool is
    -- outside of the work: the word X alone goes there. 'retract' is that of Z
    crossRetract :: Mm,
    meaningOfX :: XMeaning
  }
  deriving stock (Eq, Show)

-- | Meaning of the number of a word X on a lathe. The centres of arcs are radii in both cases.
data XMeaning
  = -- | the distance from the axis of the spindle (G8)
    XRadius
  | -- | twice the distance (G7)
    XDiameter
  deriving stock (Eq, Show)

-- | Canned cycles of the control for holes: one line makes a whole hole.
data HoleCycles = HoleCycles
  { plainCycles :: [PlainCycle],
    -- | height above the end of a peck at which the rapid move down to the next one ends (G83);
    -- Nothing if the control has no such cycle, or if the height depends on its settings
    peckReturn :: Maybe Mm,
    -- | rise after a peck that stays in the hole (G73); Nothing as for 'peckReturn'
    chipReturn :: Maybe Mm,
    tapControl :: Maybe TapControl
  }
  deriving stock (Eq, Show)

-- | Cycle whose moves depend on nothing outside of the file.
data PlainCycle
  = -- | G81
    DrillCycle
  | -- | G82, with a pause at the bottom
    DwellCycle
  | -- | G85, up at the feed
    ReamCycle
  deriving stock (Eq, Show, Enum, Bounded)

-- | Tapping by a control.
data TapControl
  = -- | in step with the spindle by G33.1; with a floating tap holder by G84
    SynchronousTap
  | -- | in step with the spindle by G84
    RigidTap
  | -- | by G84, with a floating tap holder only
    FloatingTap
  deriving stock (Eq, Show, Enum, Bounded)

-- | A control without canned cycles.
noCycles :: HoleCycles
noCycles = HoleCycles [] Nothing Nothing Nothing

-- | True if the control takes the length of a tool from its tool table (G43). Otherwise the
-- operator touches off each tool.
takesLengths :: Dialect -> Bool
takesLengths dialect = case dialect of
  LinuxCnc -> True
  Fanuc -> True
  Grbl -> False
  Marlin -> False

-- | True if the control changes tools (M6). Otherwise each tool has a file of its own.
changesTools :: Dialect -> Bool
changesTools = takesLengths

-- | True if the control may leave the path at corners, unless the program says how far.
hasPathMode :: Dialect -> Bool
hasPathMode dialect = case dialect of
  LinuxCnc -> True
  Fanuc -> True
  Grbl -> False
  Marlin -> False
