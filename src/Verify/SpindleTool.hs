-- | Radius of the cutter that is in the spindle while a frame is executed. Planned frames are those
-- that the compiler made for the program.
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

-- | Radius of the cutter in mm, for each planned frame in order.
type Tools = Vector Double

-- | Radius of the cutter in each planned frame.
plannedTools :: FrameProgram -> Tools
plannedTools program =
  Vector.fromList [r | p <- Frame.plannedFrames program, let Mm r = Frame.cutterRadius p]

-- | Number of planned frames: 'Tools' has one radius for each of them.
toolCount :: Tools -> Int
toolCount = Vector.length

-- | Radius of the cutter in the planned frame with the number @n@, counted from 1; 0 if there is no
-- such frame.
toolInFrame :: Tools -> Int -> Mm
toolInFrame tools n = maybe (Mm 0) Mm (tools Vector.!? (n - 1))

-- | Use of a cutter in a pass on the tape: the numbers of the first and the last frame, the radius.
data Use = Use Int Int Mm

-- | Radius of the cutter in frame @n@ of a tape that has more or fewer frames than planned. @uses@
-- are the passes that were found, in the order of the tape. A frame in a pass has the cutter of the
-- pass. A frame between two passes has the smaller cutter of the two. A frame before the first pass
-- or after the last one has the cutter of that pass. If no pass was found, the result is
-- @otherwiseRadius@.
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
