-- | The one place where the benchmark calls the kernel.
module Equidistant
  ( offset,
    outlines,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Carrier (Side (..))
import Geometry.FlatPolyarc (FlatPolyarc)
import Offset.Kernel (ReachableRegion)
import Offset.Kernel qualified as Kernel
import Offset.Loop qualified as Loop

-- | The offset of a closed counter-clockwise contour, outwards when the distance in mm is positive;
-- or why there is none. It is whole as soon as it is known which of both it is.
offset :: Double -> FlatPolyarc -> Either String ReachableRegion
offset distance source =
  either (Left . show) Right (Kernel.offset (Kernel.plain side (Mm (abs distance))) [source])
  where
    side = if distance > 0 then RightOf else LeftOf

-- | The loops of an offset, each by itself.
outlines :: ReachableRegion -> [FlatPolyarc]
outlines = Loop.outlines . Kernel.loops
