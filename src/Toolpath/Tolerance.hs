-- | The tolerances of toolpaths: the smallest cutter that is suggested, and what a modern control
-- needs for cutter compensation.
--
-- A control rounds the program to its pulses, and then computes the offset. The tolerances keep the
-- rounded program away from what a control refuses or offsets differently; LinuxCNC's interpreter
-- is the model.
module Toolpath.Tolerance
  ( smallestCutter,

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

-- | The smallest radius of a cutter. A report does not suggest a smaller one.
smallestCutter :: Mm
smallestCutter = Mm 0.05

-- | The margin by which a length must exceed the cutter's radius so that it does so after rounding
-- to pulses.
controlMargin :: Mm
controlMargin = Mm 0.01

-- | The smallest radius of the arc on which the centre rolls along the inside of an arc. On a
-- smaller one, rounding to pulses may add more than 'controlTurn' to the sweep: of 1500 arcs of
-- 0.06 mm LinuxCNC refuses none, of those of 0.05 mm one.
controlArc :: Mm
controlArc = Mm 0.08

-- | The largest amount by which the sweep of the centre's arc may exceed the programmed one.
-- LinuxCNC refuses an arc that exceeds it by more.
controlTurn :: Rad
controlTurn = Rad 0.0254

-- | The largest rounding error of one end of a line relative to the other. Programs for controls
-- are mostly rounded to 0.001 mm.
controlRounding :: Mm
controlRounding = Mm 1.5e-3

-- | The smallest length of an element. Rounded to pulses, a shorter one might seem to turn towards
-- the cutter.
controlLength :: Mm
controlLength = Mm 0.05

-- | The largest angle of a corner that LinuxCNC treats as none, so that it joins the offsets
-- directly. A lead-in must turn by at least twice this angle.
controlBend :: Rad
controlBend = Rad 0.05

-- | The largest gouge of a control at a corner that it treats as none.
controlCut :: Mm
controlCut = Mm 2e-3
