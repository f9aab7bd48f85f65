-- | The numbers that a frame contains for each command of a program.
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

-- | Words for each command; empty if the tape cannot give the command.
data CommandWords = CommandWords
  { spindleClockwise :: [CommandWord],
    spindleCounterClockwise :: [CommandWord],
    spindleOff :: [CommandWord],
    coolantOn :: [CommandWord],
    coolantOff :: [CommandWord],
    toolChange :: [CommandWord],
    auxiliary :: [CommandWord],
    compensation :: Maybe CompensationCommands,
    -- | words of the last frames of a program, which contain nothing else; one list per frame
    finish :: [NonEmpty CommandWord]
  }
  deriving stock (Eq, Show)

-- | Number in the word or the service bits of a command.
data CommandWord = CommandWord {commandName :: CommandName, value :: CommandValue}
  deriving stock (Eq, Show)

-- | Source of a command's number.
data CommandValue
  = Fixed Int
  | -- | number that the program gives: of a tool, of an auxiliary command, or the spindle speed in
    -- revolutions per minute
    Argument
  | -- | Number of the step with the nearest spindle speed, in revolutions per minute. The lower
    -- step if two are equally near.
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
