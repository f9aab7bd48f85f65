-- | All motions of a tape, and the selections of motions that the comparisons ask for: those at a
-- height, and those near a box.
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
import Verify.RimWork (RimWork)

-- | Motions of a tape on a machine.
data MotionSet = MotionSet
  { machine :: Machine,
    -- | true if the whole toolpath is at the height of its start; heights are then not compared
    isFlat :: Bool,
    -- | true if a surface is faced down to the top of the part, and all contours and pockets are
    -- below the top: then a motion at the top cuts none of them
    isTopFaced :: Bool,
    -- | true if the tape has exactly the planned frames, those that the compiler made
    isPlanned :: Bool,
    -- | radius of the cutter in a motion, in mm
    toolOf :: CutterMotion -> Mm,
    -- | works on cylinders that a motion may do
    rimWorksOf :: CutterMotion -> [RimWork],
    -- | all motions, in the order of the tape
    motions :: [CutterMotion],
    -- | all motions in which the cutter may touch a box, and perhaps others; in the order of the
    -- tape
    nearby :: BoundingBox -> [CutterMotion]
  }

-- | Motions of a set that are at the height @level@ ('isAtHeight'), in the order of the tape. All
-- motions if 'isFlat' is true.
atHeight :: MotionSet -> Mm -> [CutterMotion]
atHeight set level
  | isFlat set = motions set
  | otherwise = filter (isAtHeight (machine set) level) (motions set)

-- | Test that a motion runs at the height @level@, or goes vertically down to that height or up
-- from it.
isAtHeight :: Machine -> Mm -> CutterMotion -> Bool
isAtHeight m level motion =
  isSameHeight m level (fromHeight motion) && isSameHeight m level (toHeight motion)
    || Motion.isVertical motion
      && isSameHeight m level (min (fromHeight motion) (toHeight motion))

-- | Test that two heights in mm differ by no more than a pulse of the axis z.
isSameHeight :: Machine -> Mm -> Mm -> Bool
isSameHeight m (Mm z) (Mm h) = let Mm pulse = Machine.resolutionOf m Z in abs (z - h) <= pulse

-- | Test that a motion reaches down to the top of the part or below it. Above the top, nothing is
-- cut, and at a top that is faced no contour is.
isBelowTop :: MotionSet -> CutterMotion -> Bool
isBelowTop set m
  | isTopFaced set = lowest < Mm 0
  | otherwise = lowest <= Mm 0
  where
    lowest = min (fromHeight m) (toHeight m)
