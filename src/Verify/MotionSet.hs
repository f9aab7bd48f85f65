-- | All motions of a tape, with the queries of the comparisons.
module Verify.MotionSet
  ( MotionSet (..),
    atHeight,
    isAtHeight,
    isSameHeight,
    isBelowTop,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Index.BoundingBox (BoundingBox)
import Machine.Machine (Axis (Z), Machine)
import Machine.Machine qualified as Machine
import Verify.Motion (CutterMotion (..))
import Verify.Motion qualified as Motion

-- | Motions of a tape on a machine.
data MotionSet = MotionSet
  { machine :: Machine,
    -- | the cutter stays at its first height, so heights are not compared
    isFlat :: Bool,
    -- | radius of the cutter in a motion, in mm
    toolOf :: CutterMotion -> Mm,
    -- | in the order of the tape
    motions :: [CutterMotion],
    -- | motions in which the cutter may touch a box, and perhaps more, in the order of the tape
    nearby :: BoundingBox -> [CutterMotion]
  }

-- | Motions at a height, in the order of the tape.
atHeight :: MotionSet -> Mm -> [CutterMotion]
atHeight set level
  | isFlat set = motions set
  | otherwise = filter (isAtHeight (machine set) level) (motions set)

-- | Test that a motion runs at a height, or goes vertically down to it or up from it.
isAtHeight :: Machine -> Mm -> CutterMotion -> Bool
isAtHeight m level motion =
  isSameHeight m level (fromHeight motion) && isSameHeight m level (toHeight motion)
    || Motion.isVertical motion
      && isSameHeight m level (min (fromHeight motion) (toHeight motion))

-- | Test that two heights differ by no more than a pulse.
isSameHeight :: Machine -> Mm -> Mm -> Bool
isSameHeight m (Mm z) (Mm h) = let Mm pulse = Machine.resolutionOf m Z in abs (z - h) <= pulse

-- | Test that a motion reaches down to the top of the part or below it. Above the top, nothing is
-- cut.
isBelowTop :: CutterMotion -> Bool
isBelowTop m = fromHeight m <= Mm 0 || toHeight m <= Mm 0
