-- | Straight lines of an interpolator by evaluation functions: one axis makes a pulse at a time.
--
-- Pulse k of an axis with d pulses, counted from 0, is due at the fraction (2k + 1)\/(2d) of the
-- line, which is where the line is half a pulse away. The axis whose pulse is due first makes it.
-- Which of two axes this is, is the sign of an evaluation function: with i and j pulses made, it
-- is (2i + 1)·e − (2j + 1)·d for axes with d and e pulses. If both are due at once, the first in
-- the order x, y, z, a, b is taken.
--
-- While no pulse is due, every axis is at most half a pulse from the line, measured along the
-- axis. Pulses that are due at once are made one after the other. So the distance from the line is
-- at most half the square root of the count of axes that move: √½ in a plane, √¾ in space. The
-- last pulse of each axis is due before the end, and the end is exact. Source of the method: the
-- evaluation function of Soviet interpolators; this form of it is reconstructed.
module Pulse.EvaluationLine
  ( EvaluationLine,
    start,
    next,
    left,
  )
where

import Pulse.Steps (Cycle (..), Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps

-- | State: the line, the count of pulses that are left, and 2k + 1 for each axis, where k is the
-- count of pulses that the axis has made.
data EvaluationLine = EvaluationLine Line Int Int Int Int Int Int

-- | Pulses of each axis, all positive, and the pulse of each axis in its direction.
data Line = Line Int Int Int Int Int Steps Steps Steps Steps Steps

-- | Interpolator at the start of a line with the given increments.
start :: Pulses5 -> EvaluationLine
start (Pulses5 x y z a b) = EvaluationLine line (sum (map abs [x, y, z, a, b])) 1 1 1 1 1
  where
    line =
      Line
        (abs x)
        (abs y)
        (abs z)
        (abs a)
        (abs b)
        (Steps.towards 0 x)
        (Steps.towards 1 y)
        (Steps.towards 2 z)
        (Steps.towards 3 a)
        (Steps.towards 4 b)

-- | Next pulse.
next :: EvaluationLine -> Cycle EvaluationLine
next (EvaluationLine line@(Line dx dy dz da db sx sy sz sa sb) n x y z a b)
  | n <= 0 = Finished
  | isFirst x dx y dy && isFirst x dx z dz && isFirst x dx a da && isFirst x dx b db =
    Cycle sx (EvaluationLine line (n - 1) (x + 2) y z a b)
  | isFirst y dy z dz && isFirst y dy a da && isFirst y dy b db =
    Cycle sy (EvaluationLine line (n - 1) x (y + 2) z a b)
  | isFirst z dz a da && isFirst z dz b db =
    Cycle sz (EvaluationLine line (n - 1) x y (z + 2) a b)
  | isFirst a da b db = Cycle sa (EvaluationLine line (n - 1) x y z (a + 2) b)
  | otherwise = Cycle sb (EvaluationLine line (n - 1) x y z a (b + 2))
  where
    -- An axis without pulses is never first: its pulse would be due at infinity.
    isFirst i d j e = d > 0 && i * e <= j * d

-- | Count of pulses up to the end of the line.
left :: EvaluationLine -> Int
left (EvaluationLine _ n _ _ _ _ _) = n
