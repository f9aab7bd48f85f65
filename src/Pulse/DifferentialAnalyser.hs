{-# OPTIONS_GHC -O2 #-}

-- | Digital differential analyser for straight lines.
--
-- In each cycle the leading axis, which is the axis with most pulses, makes one pulse. Every other
-- axis has a remainder, to which its pulses are added. If the remainder reaches the pulses of the
-- leading axis, the axis makes a pulse too, and the remainder loses that number. All remainders
-- start at half of it.
--
-- After n of N cycles, an axis with d pulses has made the whole number of pulses that is nearest
-- to n·d/N. So it is never further than half a pulse from the line, measured along the axis, and
-- the end is exact. Source: J. E. Bresenham, "Algorithm for computer control of a digital
-- plotter", IBM Systems Journal 4 (1965), in the form of a differential analyser. The numbers here
-- are twice those of the text, so that one half is a whole number.
module Pulse.DifferentialAnalyser
  ( DifferentialAnalyser,
    start,
    next,
    left,
  )
where

import Data.List (foldl')
import Pulse.Steps (Cycle (..), Pulses5 (..), Steps)
import Pulse.Steps qualified as Steps

-- | State of the analyser: the line, the count of cycles that are left, and the remainders.
data DifferentialAnalyser = DifferentialAnalyser Line Int Int Int Int Int Int

-- | Twice the pulses of each axis, all positive; twice the pulses of the leading axis; and the
-- pulse of each axis in its direction.
data Line = Line Int Int Int Int Int Int Steps Steps Steps Steps Steps

-- | DifferentialAnalyser at the start of a line with the given increments.
start :: Pulses5 -> DifferentialAnalyser
start (Pulses5 x y z a b) = DifferentialAnalyser line lead lead lead lead lead lead
  where
    lead = foldl' max 0 (map abs [x, y, z, a, b])
    line =
      Line
        (2 * abs x)
        (2 * abs y)
        (2 * abs z)
        (2 * abs a)
        (2 * abs b)
        (2 * lead)
        (Steps.towards 0 x)
        (Steps.towards 1 y)
        (Steps.towards 2 z)
        (Steps.towards 3 a)
        (Steps.towards 4 b)

-- | Next cycle. Each cycle has a pulse of the leading axis.
next :: DifferentialAnalyser -> Cycle DifferentialAnalyser
next (DifferentialAnalyser line@(Line dx dy dz da db whole sx sy sz sa sb) n rx ry rz ra rb)
  | n <= 0 = Finished
  | otherwise =
    Cycle
      ( pulse x sx `Steps.together` pulse y sy `Steps.together` pulse z sz
          `Steps.together` pulse a sa
          `Steps.together` pulse b sb
      )
      (DifferentialAnalyser line (n - 1) (rest x) (rest y) (rest z) (rest a) (rest b))
  where
    x = rx + dx
    y = ry + dy
    z = rz + dz
    a = ra + da
    b = rb + db
    pulse r s = if r >= whole then s else Steps.none
    rest r = if r >= whole then r - whole else r

-- | Count of cycles up to the end of the line.
left :: DifferentialAnalyser -> Int
left (DifferentialAnalyser _ n _ _ _ _ _) = n
