-- | Where the centres of circles can lie that touch something, and the points that two such lines have in common.
module Geometry.Locus
  ( Locus (..),
    common,
  )
where

import Geometry.Intersect (Meeting (..))
import Geometry.Intersect qualified as Intersect
import Geometry.Shape (Circle, Line)
import Geometry.Vec (Point)

data Locus = LineLocus Line | CircleLocus Circle
  deriving stock (Eq, Show)

-- | The points on both; none when they are the same.
common :: Locus -> Locus -> [Point]
common a b = case meeting of
  Apart _ -> []
  Same -> []
  Touching p -> [p]
  CrossingOnce p -> [p]
  Crossing p q -> [p, q]
  where
    meeting = case (a, b) of
      (LineLocus l, LineLocus m) -> Intersect.lines l m
      (LineLocus l, CircleLocus c) -> Intersect.lineCircle l c
      (CircleLocus c, LineLocus l) -> Intersect.lineCircle l c
      (CircleLocus c, CircleLocus d) -> Intersect.circles c d
