-- | Where two ways cross exactly, from a place near by.
--
-- Curves cross first as the chains of arcs that stand for them, which are up to 'Tolerance.curve'
-- beside them. From there Newton's steps lead to the curves' own crossing: each goes to where the
-- tangents at both feet cross.
module Geometry.Curve.Intersection
  ( Foot,
    onLine,
    onCircle,
    onCurve,
    exactly,
  )
where

import Base.Quantity (Mm (..), times)
import Geometry.Carrier (Circle (..), Line)
import Geometry.Carrier qualified as Carrier
import Geometry.Curve (Curve)
import Geometry.Curve qualified as Curve
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | The place of a way that is nearest to a point, and its direction there, of length 1.
type Foot = Point -> (Point, Vec)

onLine :: Line -> Foot
onLine l p = (Carrier.foot l p, Carrier.direction l)

onCircle :: Circle -> Foot
onCircle (Circle c (Mm r)) p = (Vec.shift (Vec.scale r out) c, Vec.left out)
  where
    out = Vec.unit (Vec.to c p)

onCurve :: Curve -> Foot
onCurve c p = let u = Curve.nearest p c in (Curve.at c u, Curve.tangent c u)

-- | The crossing of two ways near a place that is beside each of them by no more than
-- 'Tolerance.curve'. Where the ways do not cross so near, one ends or both run along one another,
-- it is that place.
exactly :: Foot -> Foot -> Point -> Point
exactly footA footB place = go (8 :: Int) place
  where
    go left p
      | Vec.distance a b <= Tolerance.crossing = if Vec.distance place a <= nearby then a else place
      | left <= 0 || abs sine < slightest = place
      | otherwise = go (left - 1) (Vec.shift (Vec.scale (Vec.cross (Vec.to a b) v / sine) u) a)
      where
        (a, u) = footA p
        (b, v) = footB p
        sine = Vec.cross u v
        -- Where ways cross at an angle, so far are the crossings of what is beside them; where they
        -- bend, somewhat further.
        nearby = times (8 / abs sine) Tolerance.curve
    -- Ways that lean less, by this sine, run along one another.
    slightest = 1e-5
