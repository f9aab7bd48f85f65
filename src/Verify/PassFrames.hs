-- | Numbers of the planned frames of each pass. Planned frames are those that the compiler made for
-- the program. If a pass has several cuts along parts of a contour, each cut counts as a pass here.
module Verify.PassFrames
  ( FrameRange (..),
    includes,
    framesOfPasses,
    framesOfCuts,
  )
where

import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Frame.Frame (FrameProgram)
import Frame.Frame qualified as Frame

-- | Range of the planned frames of a pass: the numbers of its first and of its last frame, counted
-- from 1.
data FrameRange = FrameRange Int Int

-- | Test that the frame with the number @n@ is in a range.
includes :: FrameRange -> Int -> Bool
includes (FrameRange a b) n = a <= n && n <= b

-- | Frames of each pass with its approach and its retract, by the number of the pass, from 0.
framesOfPasses :: FrameProgram -> IntMap FrameRange
framesOfPasses = rangesBy Frame.passNumber

-- | Frames of each pass without its linking moves, by the number of the pass, from 0.
framesOfCuts :: FrameProgram -> IntMap FrameRange
framesOfCuts = rangesBy cutOf
  where
    cutOf role = case role of
      Frame.Cutting n -> Just n
      _ -> Nothing

-- | Ranges of planned frames by key. A range extends from the first to the last frame with its key.
-- The function @key@ gives the key of a frame from its role, such as the number of the pass that
-- the frame cuts. Frames for which @key@ gives Nothing are in no range.
rangesBy :: (Frame.Role -> Maybe Int) -> FrameProgram -> IntMap FrameRange
rangesBy key program =
  IntMap.fromListWith
    hull
    [ (n, FrameRange k k)
      | (k, p) <- zip [1 ..] (Frame.plannedFrames program),
        Just n <- [key (Frame.role p)]
    ]
  where
    hull (FrameRange a b) (FrameRange c d) = FrameRange (min a c) (max b d)
