-- | The one place where the benchmark calls the kernel.
module Equidistant
  ( offset,
    outlines,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Offset.Kernel (Reach, Side (..))
import Geometry.Offset.Kernel qualified as Kernel
import Geometry.Offset.Loops qualified as Loops
import Geometry.Outline (Outline)

-- | The offset of a closed counter-clockwise contour, outwards when the distance in mm is positive; or why there is none. It is whole as
-- soon as it is known which of both it is.
offset :: Double -> Outline -> Either String Reach
offset distance source = either (Left . show) Right (Kernel.offset (Kernel.plain side (Mm (abs distance))) [source])
  where
    side = if distance > 0 then RightOf else LeftOf

-- | The loops of an offset, each by itself.
outlines :: Reach -> [Outline]
outlines = Loops.outlines . Kernel.loops
