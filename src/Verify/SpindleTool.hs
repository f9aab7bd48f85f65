-- | Radius of the cutter in the spindle, in each motion of a tape.
module Verify.SpindleTool
  ( Tools,
    plannedTools,
    toolCount,
    toolInFrame,
    Use (..),
    supposedTool,
  )
where

import Base.Quantity (Mm (..))
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Vector
import Frame.Frame (FrameProgram)
import Frame.Frame qualified as Frame

-- | Radii in mm, one for each of the program's own frames.
type Tools = Vector Double

-- | Radius of the cutter in each of the program's own frames.
plannedTools :: FrameProgram -> Tools
plannedTools program =
  Vector.fromList [r | p <- Frame.plannedFrames program, let Mm r = Frame.cutterRadius p]

-- | Number of the program's own frames.
toolCount :: Tools -> Int
toolCount = Vector.length

-- | Radius of the cutter in the program's frame with this number; 0 if the program has no such
-- frame.
toolInFrame :: Tools -> Int -> Mm
toolInFrame tools n = maybe (Mm 0) Mm (tools Vector.!? (n - 1))

-- | Frames of a pass, the first one and the last one, and the radius of its cutter.
data Use = Use Int Int Mm

-- | Radius in a frame of a tape with other frames than the program: that of the pass that contains
-- the frame, or the smaller one of the passes before and after it. If no pass was found on the
-- tape, it is the given radius.
supposedTool :: [Use] -> Mm -> Int -> Mm
supposedTool uses otherwiseRadius n =
  case ( [r | Use _ end r <- reverse uses, end < n],
         [r | Use begin _ r <- uses, begin > n],
         [r | Use begin end r <- uses, begin <= n, n <= end]
       ) of
    (_, _, r : _) -> r
    (before : _, after : _, []) -> min before after
    (before : _, [], []) -> before
    ([], after : _, []) -> after
    ([], [], []) -> otherwiseRadius
