-- | Distances by other means than the program's, for the judges of laws: from an arc by the angle
-- from its middle. In mm.
module Geometry.Apart
  ( apart,
    away,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The distance from a segment to a point, from an arc by the angle from its middle.
apart :: Segment -> Point -> Double
apart s p = case s of
  Straight a b ->
    let u = Vec.to a b
        t = max 0 (min 1 (Vec.dot u (Vec.to a p) / Vec.dot u u))
     in away p (Vec.between t a b)
  Arc {start, end, centre, sweep = Rad a}
    | abs off <= abs a / 2 -> abs (away centre p - away centre start)
    | otherwise -> min (away p start) (away p end)
    where
      middle = Vec.rotate (Rad (a / 2)) (Vec.to centre start)
      Rad off = Vec.turn middle (Vec.to centre p)

away :: Point -> Point -> Double
away a b = let Mm d = Vec.distance a b in d
