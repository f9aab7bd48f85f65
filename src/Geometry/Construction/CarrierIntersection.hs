-- | Where the centres of circles can lie that touch something, and the points that two such lines
-- have in common.
module Geometry.Construction.CarrierIntersection
  ( Carrier (..),
    common,
  )
where

import Geometry.Carrier (Circle, Line)
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Vec (Point)

data Carrier = LineCarrier Line | CircleCarrier Circle
  deriving stock (Eq, Show)

-- | The points on both; none when they are the same.
common :: Carrier -> Carrier -> [Point]
common a b = case meeting of
  Apart _ -> []
  Same -> []
  Touching p -> [p]
  CrossingOnce p -> [p]
  Crossing p q -> [p, q]
  where
    meeting = case (a, b) of
      (LineCarrier l, LineCarrier m) -> Intersection.lines l m
      (LineCarrier l, CircleCarrier c) -> Intersection.lineCircle l c
      (CircleCarrier c, LineCarrier l) -> Intersection.lineCircle l c
      (CircleCarrier c, CircleCarrier d) -> Intersection.circles c d
