-- | Data for the rounding of arcs: the grid of a machine, the tolerances, and the arc between its
-- rounded ends.
module Frame.Arc.Context
  ( Grid (..),
    gridOf,
    gridPoint,
    ArcTolerance (..),
    ArcContext (..),
    roundedPoint,
    RoundedArc (..),
    ArcStep (..),
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Frame.Rounding qualified as Rounding
import Geometry.Carrier (Sense)
import Geometry.Segment (Segment)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (..), Machine)
import Machine.Machine qualified as Machine

-- | Grid of whole pulses in the plane of a machine.
data Grid = Grid
  { machine :: Machine,
    -- | resolution of the axes in mm
    pulseX :: Double,
    pulseY :: Double,
    -- | the coarser one of the two
    pulse :: Double,
    -- | largest number of pulses in the field of a centre
    largestCentre :: Pulses
  }

-- | Grid of a machine.
gridOf :: Machine -> Grid
gridOf machine =
  Grid {machine, pulseX, pulseY, pulse, largestCentre = Machine.centreCapacity machine}
  where
    Mm pulseX = Machine.resolutionOf machine X
    Mm pulseY = Machine.resolutionOf machine Y
    Mm pulse = Machine.planeResolution machine

-- | Grid point in mm.
gridPoint :: Grid -> Pulses2 -> Point
gridPoint grid (Pulses2 (Pulses x) (Pulses y)) =
  Vec.point (fromIntegral x * pulseX grid) (fromIntegral y * pulseY grid)

-- | Largest distances of the steps of an arc from the exact arc, rounding included.
data ArcTolerance = ArcTolerance
  { -- | for steps that are arcs: radially, if the control keeps the radius of the beginning or
    -- changes it linearly to that of the end
    linearError :: Mm,
    -- | for all steps, towards the centre, whether the control uses the radius of the beginning or
    -- of the end at a point
    inwards :: Mm,
    -- | like 'inwards', but away from the centre
    outwards :: Mm
  }
  deriving stock (Eq, Show)

-- | Conditions under which an arc is rounded.
data ArcContext = ArcContext
  { grid :: Grid,
    tolerance :: ArcTolerance,
    -- | ends of the chords of a segment, from the rounded position where it begins
    chordsOf :: Pulses3 -> Segment -> [Pulses3],
    -- | height of the arc
    height :: Mm
  }

-- | Nearest grid point, at the height of the arc.
roundedPoint :: ArcContext -> Point -> Pulses3
roundedPoint context p = Rounding.rounded (machine (grid context)) (p, height context)

-- | Exact arc with its rounded ends.
data RoundedArc = RoundedArc
  { -- | rounded start
    begin :: Pulses3,
    -- | rounded end
    finish :: Pulses3,
    -- | the exact arc
    exact :: Segment,
    -- | centre of the exact arc
    centre :: Point,
    -- | radius of the exact arc
    radius :: Mm,
    -- | sweep of the exact arc in radians, positive counter-clockwise
    sweep :: Double,
    -- | sense of the exact arc
    sense :: Sense
  }

-- | A straight or circular step: the position at its end; for an arc also its sense, and its centre
-- in pulses from the beginning of the step.
data ArcStep = ArcStep {target :: Pulses3, turnsAbout :: Maybe (Sense, Pulses2)}
  deriving stock (Eq, Show)
