-- | The only module of the benchmark that calls the kernel.
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

-- | The offset of a closed counter-clockwise contour by a distance in mm, positive outwards; or the
-- reason why there is none. An evaluated @Right@ contains a completely evaluated offset.
offset :: Double -> FlatPolyarc -> Either String ReachableRegion
offset distance source =
  either (Left . show) Right (Kernel.offset (Kernel.roundOffset side (Mm (abs distance))) [source])
  where
    side = if distance > 0 then RightOf else LeftOf

-- | The loops of an offset.
outlines :: ReachableRegion -> [FlatPolyarc]
outlines = Loop.polyarcs . Kernel.loops
