-- | Common tangents of circles, and tangents from a point to a circle.
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

-- | The common tangent from the first circle to the second, from tangent point to tangent point. At
-- each of these points, the line has the direction of travel along the circle in the circle's
-- sense. A circle of radius 0 is a point. Nothing when one circle lies inside the other, or when
-- circles of opposite senses overlap. Nothing also when the two tangent points coincide, so that
-- the line would have no length.
--
-- With signed radii ρ, positive counter-clockwise, the tangent's left normal n satisfies
-- @n·(c₂ − c₁) = ρ₂ − ρ₁@, and the tangent points are @cᵢ − ρᵢ·n@.
directed :: (Sense, Circle) -> (Sense, Circle) -> Maybe Line
directed (sense1, Circle c1 (Mm r1)) (sense2, Circle c2 (Mm r2))
  | d <= tolerance || d - abs (rho2 - rho1) <= 0 || len <= tolerance = Nothing
  | otherwise = Just (Line (touch c1 rho1) (touch c2 rho2))
  where
    Mm tolerance = Tolerance.coincident
    Mm d = Vec.distance c1 c2
    rho1 = Carrier.senseSign sense1 * r1
    rho2 = Carrier.senseSign sense2 * r2
    len = sqrt ((d - (rho2 - rho1)) * (d + (rho2 - rho1)))
    e = Vec.unit (Vec.to c1 c2)
    u = Vec.add (Vec.scale (len / d) e) (Vec.scale ((rho1 - rho2) / d) (Vec.left e))
    touch c rho = Vec.shift (Vec.scale (-rho) (Vec.left u)) c

-- | All common tangents from the circle @a@ to the circle @b@, at most four. Each entry has the
-- senses of @a@ and of @b@, and the line that 'directed' gives for these senses.
all :: Circle -> Circle -> [(Sense, Sense, Line)]
all a b =
  [ (sense1, sense2, line)
    | sense1 <- [minBound .. maxBound],
      sense2 <- [minBound .. maxBound],
      Just line <- [directed (sense1, a) (sense2, b)]
  ]
