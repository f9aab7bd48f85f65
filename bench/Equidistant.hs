-- | The one place where the benchmark calls the kernel.
module Equidistant
  ( offset,
  )
where

import Geometry.Outline (Outline)

-- | The offset of a closed counter-clockwise contour, outwards when the distance in mm is positive; or why there is none.
offset :: Double -> Outline -> Either String [Outline]
offset _ source = Right [source]
