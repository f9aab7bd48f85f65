-- | The point of a turning tool that the tool table of a control measures, as seen from the centre
-- of the nose.
--
-- The frames of a program lead the centre. A file for a lathe leads the measured point, which is at
-- a constant offset from the centre. The numbers of the directions are those of LinuxCNC ("Lathe
-- User Information"): 1 to 4 are the points at which the two tangents of the nose parallel to the
-- axes meet, 5 to 8 lie on the nose, and 9 is the centre.
module Gcode.ToolTip
  ( offset,
    rounding,
    direction,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), over)
import Data.Maybe (fromMaybe)
import Machine.Machine (Axis (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Cutter)
import Part.Part qualified as Part

-- | Offset of the measured point from the centre in pulses, rounded; 0 for a tool that has no tip.
offset :: Machine -> Cutter -> Pulses3
offset machine cutter = Pulses3 (along X dx) (along Y dy) 0
  where
    (dx, dy) = directionOf cutter
    along axis d = Pulses (round (fromIntegral d * inPulses machine axis cutter))

-- | Distance in mm by which the rounding of the offset shifts the whole path.
rounding :: Machine -> Cutter -> Mm
rounding machine cutter = Mm (sqrt (error' X dx + error' Y dy))
  where
    (dx, dy) = directionOf cutter
    error' axis d =
      let exact = fromIntegral d * inPulses machine axis cutter
          Mm pulse = Machine.resolutionOf machine axis
       in ((exact - fromIntegral (round exact :: Int)) * pulse) ^ (2 :: Int)

-- | Radius of the nose in pulses of an axis.
inPulses :: Machine -> Axis -> Cutter -> Double
inPulses machine axis cutter = over (Part.cutterRadius cutter) (Machine.resolutionOf machine axis)

directionOf :: Cutter -> (Int, Int)
directionOf cutter = direction (fromMaybe 9 (Part.tip cutter))

-- | Direction from the centre to the measured point: along x of the part, which is Z, and along y,
-- which is X.
direction :: Int -> (Int, Int)
direction tip = case tip of
  1 -> (1, -1)
  2 -> (-1, -1)
  3 -> (-1, 1)
  4 -> (1, 1)
  5 -> (1, 0)
  6 -> (0, -1)
  7 -> (-1, 0)
  8 -> (0, 1)
  _ -> (0, 0)
