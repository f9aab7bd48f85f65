-- | Fillets: arcs of a given radius and sense that lead from one walked element to another
-- and touch both in the direction of the walk.
module Geometry.Fillet
  ( Fillet (..),
    between,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Box qualified as Box
import Geometry.Distance qualified as Distance
import Geometry.Locus (Locus (..))
import Geometry.Locus qualified as Locus
import Geometry.Polyarc qualified as Polyarc
import Geometry.Shape (Circle (..), Turn (..))
import Geometry.Shape qualified as Shape
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.Walked (Walked (..))
import Geometry.Walked qualified as Walked

-- | An arc by its centre and its ends.
data Fillet = Fillet {middle :: Point, start :: Point, end :: Point}
  deriving stock (Eq, Show)

-- | All fillets of a radius and a sense: at most two between lines and circles.
between :: Mm -> Turn -> Walked -> Walked -> [Fillet]
between radius turn a b = case (a, b) of
  (OnCurve p, OnCurve q) -> apart [f | (s, g) <- pairs p q, f <- simple (Walked.ofSegment s) (Walked.ofSegment g), start f `on` s, end f `on` g]
  (OnCurve p, _) -> apart [f | s <- NonEmpty.toList (Polyarc.segments p), f <- simple (Walked.ofSegment s) b, start f `on` s]
  (_, OnCurve q) -> apart [f | g <- NonEmpty.toList (Polyarc.segments q), f <- simple a (Walked.ofSegment g), end f `on` g]
  _ -> simple a b
  where
    simple = ofPair radius turn
    on p s = Distance.toPoint p s <= Tolerance.coincident
    -- Segments near enough to be touched by one circle.
    pairs p q =
      let index = Box.index Box.ofSegment (NonEmpty.toList (Polyarc.segments q))
       in [(s, g) | s <- NonEmpty.toList (Polyarc.segments p), g <- Box.within (Box.inflate (plus radius radius) (Box.ofSegment s)) index]
    -- A fillet that touches where two segments of a curve join is found from both.
    apart fs = case fs of
      [] -> []
      f : rest -> f : apart (filter (\g -> Vec.distance (middle f) (middle g) > Tolerance.sameFillet) rest)

-- | The fillets between two lines or circles.
ofPair :: Mm -> Turn -> Walked -> Walked -> [Fillet]
ofPair radius turn a b =
  [ Fillet {middle = c, start, end}
    | Just la <- [locus radius turn a],
      Just lb <- [locus radius turn b],
      c <- Locus.common la lb,
      Just start <- [touch radius turn a c],
      Just end <- [touch radius turn b c]
  ]

-- | Where the centre of an arc can lie that touches an element in its direction.
locus :: Mm -> Turn -> Walked -> Maybe Locus
locus radius@(Mm r) turn walked = case walked of
  OnLine l -> Just (LineLocus (Shape.parallelAt (Mm (Shape.sense turn * r)) l))
  OnCircle t (Circle c rc)
    | t /= turn -> Just (CircleLocus (Circle c (plus rc radius)))
    | gap <= Tolerance.coincident -> Nothing
    | otherwise -> Just (CircleLocus (Circle c gap))
    where
      gap = max (minus rc radius) (minus radius rc)
  OnCurve _ -> Nothing
  AtPoint _ -> Nothing

-- | Where an arc about a centre touches the element.
touch :: Mm -> Turn -> Walked -> Point -> Maybe Point
touch radius turn walked c = case walked of
  OnLine l -> Just (Shape.foot l c)
  OnCircle t (Circle o rc@(Mm r)) -> Just (Vec.shift (Vec.scale (side * r) (Vec.unit (Vec.to o c))) o)
    where
      -- The smaller circle lies inside; a fillet around the circle touches it on the far side.
      side = if t == turn && radius > rc then -1 else 1
  OnCurve _ -> Nothing
  AtPoint _ -> Nothing
