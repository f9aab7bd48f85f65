-- | The axes of a machine, and the arcs that its interpolator can make.
--
-- A linear axis moves the cutter along x, y or z. A rotary axis turns the part or the head.
module Machine.Axis
  ( -- * Linear axes
    Axis (..),
    AxisForm (..),
    Arcs (..),
    among,
    axisName,

    -- * Rotary axes
    RotaryAxis (..),
    RotaryForm (..),
    rotaryAmong,
    rotaryName,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (find)
import Data.Text (Text)

-- | Linear axis, with its name in ISO 841.
data Axis = X | Y | Z
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | Properties of one linear axis.
data AxisForm = AxisForm
  { axis :: Axis,
    -- | resolution: length of one pulse
    resolution :: Mm,
    -- | true if the positive direction of the machine is the negative one of the part
    reversed :: Bool,
    -- | true if the machine's axis changes its direction when the machine is set up for turning
    reversedOnLathe :: Bool,
    -- | true if the machine is known to move this axis. If false, frames may still have a word for
    -- the axis
    isDriven :: Bool
  }
  deriving stock (Eq, Show)

-- | Arcs that one frame can describe. All arcs turn in the plane of x and y.
data Arcs
  = NoArcs
  | -- | @quadrants@ is true if the arc of one frame, unless it is a full circle, has to lie within
    -- one quadrant. @fullCircle@ is true if one frame can describe a full circle. @rising@ is true
    -- if z may change along the arc, in proportion to its angle: the frame describes a helix.
    Arcs {quadrants :: Bool, fullCircle :: Bool, rising :: Bool}
  deriving stock (Eq, Show)

-- | Finds the properties of the axis @a@ in a list; 'Nothing' if the list lacks the axis.
among :: Axis -> [AxisForm] -> Maybe AxisForm
among a forms = case forms of
  [] -> Nothing
  f : others -> if axis f == a then Just f else among a others

-- | Name of an axis in reports and descriptions: @x@, @y@ or @z@.
axisName :: Axis -> Text
axisName a = case a of
  X -> "x"
  Y -> "y"
  Z -> "z"

-- | Rotary axis, with its name in ISO 841: 'A' turns about x, 'B' about y.
data RotaryAxis = A | B
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | Properties of one rotary axis.
data RotaryForm = RotaryForm
  { rotaryAxis :: RotaryAxis,
    -- | resolution: angle of one pulse
    pulseAngle :: Rad,
    -- | true if the positive sense of the machine is the negative one of the part
    turnsReversed :: Bool
  }
  deriving stock (Eq, Show)

-- | Finds the properties of the rotary axis @a@ in a list; 'Nothing' if the list lacks the axis.
rotaryAmong :: RotaryAxis -> [RotaryForm] -> Maybe RotaryForm
rotaryAmong a = find ((== a) . rotaryAxis)

-- | Name of a rotary axis in reports and descriptions: @a@ or @b@.
rotaryName :: RotaryAxis -> Text
rotaryName a = case a of
  A -> "a"
  B -> "b"
