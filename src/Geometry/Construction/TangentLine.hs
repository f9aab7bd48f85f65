-- | Common tangents of circles, and the lines from a point that touch a circle.
module Geometry.Construction.TangentLine
  ( directed,
    all,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Carrier (Circle (..), Line (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Prelude hiding (all)

-- | The common tangent that leaves the first circle and reaches the second in the directions in
-- which they are walked, from touching point to touching point. A circle of radius 0 is a point.
-- There is none when one circle lies in the other, or when circles walked in opposite senses
-- overlap.
--
-- With signed radii ρ (positive counter-clockwise) the tangent has the left normal n with
-- n·(c₂ − c₁) = ρ₂ − ρ₁, and touches at cᵢ − ρᵢ n.
directed :: (Sense, Circle) -> (Sense, Circle) -> Maybe Line
directed (t1, Circle c1 (Mm r1)) (t2, Circle c2 (Mm r2))
  | d <= tolerance || d - abs (rho2 - rho1) <= 0 || len <= tolerance = Nothing
  | otherwise = Just (Line (touch c1 rho1) (touch c2 rho2))
  where
    Mm tolerance = Tolerance.coincident
    Mm d = Vec.distance c1 c2
    rho1 = Carrier.sense t1 * r1
    rho2 = Carrier.sense t2 * r2
    len = sqrt ((d - (rho2 - rho1)) * (d + (rho2 - rho1)))
    e = Vec.unit (Vec.to c1 c2)
    u = Vec.add (Vec.scale (len / d) e) (Vec.scale ((rho1 - rho2) / d) (Vec.left e))
    touch c rho = Vec.shift (Vec.scale (-rho) (Vec.left u)) c

-- | All common tangents, at most four, with the senses of the circles that they join.
all :: Circle -> Circle -> [(Sense, Sense, Line)]
all a b =
  [ (t1, t2, line)
    | t1 <- [minBound .. maxBound],
      t2 <- [minBound .. maxBound],
      Just line <- [directed (t1, a) (t2, b)]
  ]
