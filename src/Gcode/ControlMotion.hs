-- | Actions of a control by the lines of a file: motions, changes of the tool, pauses and ends.
--
-- Positions are whole picometres (10^-9 mm) along the axes of the control.
module Gcode.ControlMotion
  ( Step (..),
    Action (..),
    Travel (..),
    ToolPlace (..),
    Coordinate (..),
  )
where

import Base.Quantity (Seconds)
import Gcode.ModalState (ModalState, MotionMode)

-- | One action, with the state in which it happens.
data Step = Step
  { -- | number of the line, from 1
    line :: Int,
    state :: ModalState,
    action :: Action
  }
  deriving stock (Eq, Show)

data Action
  = Travels Travel
  | -- | the control takes the tool with this number, at a position; Nothing if no T word came
    -- before
    Changes ToolPlace (Maybe Int)
  | Dwells Seconds
  | -- | M0
    Stops
  | -- | M1
    StopsOnDemand
  | -- | the file ends without a word that ends the program
    FileEnds
  | -- | M2 or M30
    Ends
  deriving stock (Eq, Show)

-- | A motion.
data Travel = Travel
  { mode :: MotionMode,
    from :: ToolPlace,
    to :: ToolPlace,
    -- | centre of an arc in its plane, by the two axes of the plane in the order x y or z x
    about :: Maybe (Int, Int)
  }
  deriving stock (Eq, Show)

-- | Position of the tool, along the axes X, Y and Z of the control.
data ToolPlace = ToolPlace {placeX :: Coordinate, placeY :: Coordinate, placeZ :: Coordinate}
  deriving stock (Eq, Show)

-- | Position along one axis.
data Coordinate
  = -- | unknown: where the machine stands
    Anywhere
  | -- | in machine coordinates, in picometres; Nothing for the reference point. It is not known
    -- where this is in the work
    InMachine (Maybe Int)
  | -- | the retract height, above everything
    Retracted
  | -- | in work coordinates, in picometres
    At Int
  deriving stock (Eq, Show)
