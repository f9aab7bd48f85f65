-- | The tolerances of toolpaths: the smallest cutter that is suggested, the depth to which the arc
-- of a lead may cut into the part, what an exchange of links has to save, and what a modern control
-- needs for cutter compensation.
--
-- The program for a control is rounded to pulses, and the control computes the offset of the
-- rounded contour. With these tolerances the control refuses nothing in the rounded program, and
-- its offset has the same segments and corners as the exact one. The model of a control is
-- LinuxCNC's interpreter.
module Toolpath.Tolerance
  ( smallestCutter,
    alongTabs,
    arcIntrusion,
    wayShortened,
    sameNode,
    axisShare,
    contourShare,

    -- * Cutter compensation
    controlMargin,
    controlArc,
    controlTurn,
    controlRounding,
    controlLength,
    controlBend,
    controlCut,
  )
where

import Base.Quantity (Mm (..), Rad (..))

-- | The smallest radius of a cutter that a report suggests.
smallestCutter :: Mm
smallestCutter = Mm 0.05

-- | The largest distance from a path, beyond the allowance, of the middle of a tab on it.
alongTabs :: Mm
alongTabs = Mm 0.01

-- | The largest distance between ends of branches of a medial axis that are one node.
sameNode :: Mm
sameNode = Mm 1e-5

-- | The share of the tolerance of a V-carving that its path may deviate from the medial axis.
axisShare :: Double
axisShare = 0.25

-- | The share of the tolerance of a V-carving that its contours may deviate by when fewer arcs
-- replace those of curves.
contourShare :: Double
contourShare = 0.1

-- | The largest depth that an arc of an approach, a retract or a lead may cut into the part. It
-- allows for coordinates of the program that are rounded to a few thousandths of a millimetre.
arcIntrusion :: Mm
arcIntrusion = Mm 1e-3

-- | The length by which an exchange of two links has to shorten the way through holes. It lies far
-- below a pulse, and far above the rounding errors of the sums that are compared.
wayShortened :: Mm
wayShortened = Mm 1e-6

-- | The margin by which the first and the last straight move under compensation must exceed the
-- cutter's radius. With this margin they also exceed the radius after rounding to pulses.
controlMargin :: Mm
controlMargin = Mm 0.01

-- | The smallest radius of the arc that the centre makes inside a concave arc. If the radius is
-- smaller, rounding to pulses may add more than 'controlTurn' to the sweep. In a test with 1500
-- arcs of each radius, LinuxCNC refused no arc of 0.06 mm and one arc of 0.05 mm.
controlArc :: Mm
controlArc = Mm 0.08

-- | The largest amount by which the sweep of the centre's arc may exceed that of the programmed
-- arc. LinuxCNC refuses an arc with a larger one.
controlTurn :: Rad
controlTurn = Rad 0.0254

-- | The largest rounding error of one end of a line relative to the other. Programs for controls
-- are mostly rounded to 0.001 mm.
controlRounding :: Mm
controlRounding = Mm 1.5e-3

-- | The smallest length that an element may have if the control does the cutter compensation.
-- Rounding to pulses may rotate a shorter element so much that an inner corner arises, which the
-- control refuses.
controlLength :: Mm
controlLength = Mm 0.05

-- | The change of direction below which LinuxCNC ignores a corner and joins the offsets directly.
-- Between the approach and the first segment of the edge, the direction must change by at least
-- twice this angle.
controlBend :: Rad
controlBend = Rad 0.05

-- | The largest depth that a control may cut into the part at a corner that it ignores.
controlCut :: Mm
controlCut = Mm 2e-3
