-- | Frames: what a controller is told, in whole pulses.
module Frame.Frame
  ( Frame (..),
    Planned (..),
    Role (..),
    Program (..),
    position,
    height,
    end,
    Broken (..),
    invariants,
  )
where

import Base.Quantity (Mm (..), Pulses (..))
import Base.Region (Region)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Linear.V3 (V3 (..))
import Machine.Machine (Axis (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine

-- | What stands on the tape: an increment of each axis, the feed code, the auxiliary command.
data Frame = Frame {increment :: V3 Pulses, speed :: FeedCode, auxiliary :: Int}
  deriving stock (Eq, Show)

-- | A frame with the reason for it.
data Planned = Planned
  { frame :: Frame,
    role :: Role,
    origin :: Region,
    -- | the radius of the cutter in the spindle
    tool :: Mm
  }
  deriving stock (Eq, Show)

-- | What a frame does. The number counts the passes along contours from 0.
data Role = Approaching Int | Cutting Int | Retracting Int | Travelling | Drilling | Commanding
  deriving stock (Eq, Show)

-- | The frames of a tape, and where the cutter stands before the first, in pulses from the zero of the part.
data Program = Program {start :: V3 Pulses, planned :: [Planned]}
  deriving stock (Eq, Show)

-- | A position in mm, in the plane.
position :: Machine -> V3 Pulses -> Point
position machine (V3 (Pulses x) (Pulses y) _) = Vec.point (fromIntegral x * p) (fromIntegral y * p)
  where
    Mm p = Machine.pulse machine

-- | The height of a position in mm.
height :: Machine -> V3 Pulses -> Mm
height machine (V3 _ _ (Pulses z)) = let Mm p = Machine.pulse machine in Mm (fromIntegral z * p)

-- | Where the cutter stands after the last frame.
end :: Program -> V3 Pulses
end program = start program + sum (map (increment . frame) (planned program))

-- | A rule that a frame breaks; the frame's number from 1.
data Broken
  = -- | an increment that its field does not hold
    OverCapacity Int Axis Pulses
  | -- | a feed code that the machine does not have, or none where the frame moves
    NoSuchSpeed Int FeedCode
  | -- | a frame that moves nothing and commands nothing
    Idle Int
  deriving stock (Eq, Show)

-- | The rules that every list of frames for a machine keeps; the ones that are broken.
invariants :: Machine -> [Frame] -> [Broken]
invariants machine = concat . zipWith rules [1 ..]
  where
    rules n f = concatMap (fieldOf n f) [X, Y, Z] <> speedOf n f <> [Idle n | still f && auxiliary f == 0]
    fieldOf n f axis = let d = component axis (increment f) in [OverCapacity n axis d | abs d > Machine.capacity machine axis]
    speedOf n f
      | still f = [NoSuchSpeed n (speed f) | speed f /= FeedCode 0]
      | otherwise = [NoSuchSpeed n (speed f) | speed f `notElem` map fst (NonEmpty.toList (Machine.feeds machine))]
    still f = increment f == 0
    component axis (V3 x y z) = case axis of
      X -> x
      Y -> y
      Z -> z
