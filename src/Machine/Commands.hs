-- | The numbers that frames contain for each command of a part program.
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

-- | Numbers that a frame contains for each command; an empty list if the tape cannot give the
-- command.
data CommandWords = CommandWords
  { spindleClockwise :: [CommandWord],
    spindleCounterClockwise :: [CommandWord],
    spindleOff :: [CommandWord],
    coolantOn :: [CommandWord],
    coolantOff :: [CommandWord],
    toolChange :: [CommandWord],
    auxiliary :: [CommandWord],
    compensation :: Maybe CompensationCommands,
    -- | numbers in the last frames of a program, one list for each frame; these frames contain
    -- nothing else
    finish :: [NonEmpty CommandWord]
  }
  deriving stock (Eq, Show)

-- | One number: the name of the word or the service bits that contain it, and its source.
data CommandWord = CommandWord {commandName :: CommandName, value :: CommandValue}
  deriving stock (Eq, Show)

-- | Source of a command's number.
data CommandValue
  = -- | this number
    Fixed Int
  | -- | The number that the program gives: of a tool, of an auxiliary command, or the spindle speed
    -- in revolutions per minute.
    Argument
  | -- | The number of the step whose spindle speed, in revolutions per minute, is nearest to the
    -- one that the program gives. If two steps are equally near, it is the lower number.
    Step (Map Int Double)
  | -- | diameter of the cutter, in mm
    Diameter
  deriving stock (Eq, Show)

-- | Commands for cutter compensation: left (G41), right (G42) and off (G40).
data CompensationCommands = CompensationCommands
  { compensateLeft :: CommandWord,
    compensateRight :: CommandWord,
    cancelCompensation :: CommandWord
  }
  deriving stock (Eq, Show)

-- | No word for any command.
noCommandWords :: CommandWords
noCommandWords = CommandWords [] [] [] [] [] [] [] Nothing []
