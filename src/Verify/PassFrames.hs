-- | Frames of each pass, as the program plans them.
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

-- | First and last of some frames, by their numbers.
data FrameRange = FrameRange Int Int

-- | Test that a frame is in a range.
includes :: FrameRange -> Int -> Bool
includes (FrameRange a b) n = a <= n && n <= b

-- | Frames of each pass with its approach and its retract, by the number of the pass.
framesOfPasses :: FrameProgram -> IntMap FrameRange
framesOfPasses = rangesBy Frame.passNumber

-- | Frames along the contour in each pass, by the number of the pass.
framesOfCuts :: FrameProgram -> IntMap FrameRange
framesOfCuts = rangesBy cutOf
  where
    cutOf role = case role of
      Frame.Cutting n -> Just n
      _ -> Nothing

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
