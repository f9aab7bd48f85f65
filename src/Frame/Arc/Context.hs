-- | Data for the rounding of arcs: the grid of a machine, the tolerances, and the arc between its
-- rounded ends. A grid point is a position in whole pulses. A step is a straight or circular motion
-- that becomes one frame.
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
    -- | size of a pulse in mm along x and along y
    pulseX :: Double,
    pulseY :: Double,
    -- | size in mm of the larger one of both pulses
    pulse :: Double,
    -- | largest number of pulses that the field of a centre holds
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

-- | Position in mm of a grid point.
gridPoint :: Grid -> Pulses2 -> Point
gridPoint grid (Pulses2 (Pulses x) (Pulses y)) =
  Vec.point (fromIntegral x * pulseX grid) (fromIntegral y * pulseY grid)

-- | Largest allowed distances in mm of the steps of an arc from the exact arc, rounding included.
-- A step that is an arc may have different radii at its beginning and at its end. The radius
-- between them depends on the control.
data ArcTolerance = ArcTolerance
  { -- | largest radial distance of a step that is an arc, if the control keeps the radius of the
    -- beginning, or changes it linearly to that of the end
    linearError :: Mm,
    -- | largest distance of any step towards the centre, even if the control jumps from the radius
    -- of the beginning to that of the end at any point
    inwards :: Mm,
    -- | largest distance of any step away from the centre, under the same condition as 'inwards'
    outwards :: Mm,
    -- | largest difference between the radii at the beginning and the end of a step; Nothing if
    -- only the control limits it
    radiusChange :: Maybe Mm
  }
  deriving stock (Eq, Show)

-- | Data that stay the same while an arc is rounded.
data ArcContext = ArcContext
  { grid :: Grid,
    tolerance :: ArcTolerance,
    -- | function that divides a segment into chords: it takes the rounded start of the segment, and
    -- returns the ends of the chords in pulses
    chordsOf :: Pulses3 -> Segment -> [Pulses3],
    -- | height of the arc in mm
    height :: Mm
  }

-- | Nearest grid point to a point in mm, at the height of the arc.
roundedPoint :: ArcContext -> Point -> Pulses3
roundedPoint context p = Rounding.rounded (machine (grid context)) (p, height context)

-- | Exact arc in mm with its ends rounded to grid points.
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

-- | A step: the position at its end in pulses. For an arc also the sense, and the centre in pulses
-- from the beginning of the step; Nothing for a straight step.
data ArcStep = ArcStep {target :: Pulses3, turnsAbout :: Maybe (Sense, Pulses2)}
  deriving stock (Eq, Show)
