-- | Reference distances for tests, in mm. They share no formula with "Geometry.Distance": they are
-- computed with the vectors and matrices of @linear@, and the distance from an arc by the angle
-- from the arc's middle.
module Geometry.Apart
  ( apart,
    away,
    vector,
  )
where

import Base.Quantity (Rad (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Linear (V2 (..), crossZ, distance, dot, quadrance, (!*), (*^), (^+^), (^-^))

-- | The distance from a segment to a point.
apart :: Segment -> Point -> Double
apart s point = case s of
  Straight start end ->
    let (a, b) = (vector start, vector end)
        chord = b ^-^ a
        t = max 0 (min 1 (dot chord (p ^-^ a) / quadrance chord))
     in distance p (a ^+^ (t *^ chord))
  Arc {start, end, centre, sweep = Rad sweep}
    | abs angle <= abs sweep / 2 -> abs (away centre point - away centre start)
    | otherwise -> min (away point start) (away point end)
    where
      c = vector centre
      middle = rotation (sweep / 2) !* (vector start ^-^ c)
      angle = atan2 (crossZ middle (p ^-^ c)) (dot middle (p ^-^ c))
  where
    p = vector point
    rotation a = V2 (V2 (cos a) (-(sin a))) (V2 (sin a) (cos a))

-- | The distance between two points.
away :: Point -> Point -> Double
away a b = distance (vector a) (vector b)

-- | The position vector of a point.
vector :: Point -> V2 Double
vector p = V2 (Vec.x p) (Vec.y p)
