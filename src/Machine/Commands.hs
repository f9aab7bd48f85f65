-- | The numbers that frames contain for each command of a part program. Such a number has a word
-- of its own, or bits: holes in the service track beside the digits of other words.
module Machine.Commands
  ( CommandWords (..),
    CommandWord (..),
    CommandValue (..),
    CompensationCommands (..),
    noCommandWords,
  )
where

import Data.List.NonEmpty (NonEmpty (..))
import Data.Map.Strict (Map)
import Machine.FrameLayout (CommandName)

-- | Numbers that a frame contains for each command. For a command that the tape cannot give, the
-- list is empty, or @compensation@ is 'Nothing'.
data CommandWords = CommandWords
  { spindleClockwise :: [CommandWord],
    spindleCounterClockwise :: [CommandWord],
    spindleOff :: [CommandWord],
    coolantOn :: [CommandWord],
    coolantOff :: [CommandWord],
    toolChange :: [CommandWord],
    auxiliary :: [CommandWord],
    programStop :: [CommandWord],
    optionalStop :: [CommandWord],
    dwell :: [CommandWord],
    -- | the spindle at a constant cutting speed
    surfaceClockwise :: [CommandWord],
    surfaceCounterClockwise :: [CommandWord],
    compensation :: Maybe CompensationCommands,
    -- | numbers in the last frames of a program, one list for each frame; these frames contain no
    -- move
    finish :: [NonEmpty CommandWord]
  }
  deriving stock (Eq, Show)

-- | One number in a frame: the name of the word or of the bits that contain the number, and the
-- source of the number.
data CommandWord = CommandWord {commandName :: CommandName, value :: CommandValue}
  deriving stock (Eq, Show)

-- | Source of the number of a command.
data CommandValue
  = -- | this number
    Fixed Int
  | -- | The number that the program gives: the number of a tool or of an auxiliary command, or the
    -- spindle speed in revolutions per minute.
    Argument
  | -- | The number of a step of the spindle: the table gives the speed of each step in revolutions
    -- per minute. The step nearest to the program's speed is taken. If two steps are equally near,
    -- the one with the lower number is taken.
    Step (Map Int Double)
  | -- | diameter of the cutter, in mm
    Diameter
  | -- | time of the dwell, in seconds
    InSeconds
  | -- | time of the dwell, in milliseconds
    InMilliseconds
  | -- | constant cutting speed; the field is the speed in mm\/min that the number 1 means
    SurfaceSpeed Double
  | -- | limit of the speed of the spindle at a constant cutting speed, in revolutions per minute
    SpeedLimit
  deriving stock (Eq, Show)

-- | Commands for cutter compensation: left (G41), right (G42) and off (G40).
data CompensationCommands = CompensationCommands
  { compensateLeft :: CommandWord,
    compensateRight :: CommandWord,
    cancelCompensation :: CommandWord,
    -- | number of the switch at which the operator sets the cutter's radius. The words of
    -- compensation then have a frame of their own. Nothing if the operator sets no radius
    radiusSwitch :: Maybe CommandWord
  }
  deriving stock (Eq, Show)

-- | The numbers of a machine whose tape cannot give any command.
noCommandWords :: CommandWords
noCommandWords = CommandWords [] [] [] [] [] [] [] [] [] [] [] [] Nothing []
