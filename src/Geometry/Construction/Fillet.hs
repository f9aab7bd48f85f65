-- | Fillets: arcs of a given radius and sense that lead from one walked element to another
-- and touch both in the direction of the walk.
module Geometry.Construction.Fillet
  ( Fillet (..),
    between,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Circle (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.CarrierIntersection (Carrier (..))
import Geometry.Construction.CarrierIntersection qualified as CarrierIntersection
import Geometry.Distance qualified as Distance
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.ElementCarrier qualified as ElementCarrier
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | An arc by its centre and its ends.
data Fillet = Fillet {middle :: Point, start :: Point, end :: Point}
  deriving stock (Eq, Show)

-- | All fillets of a radius and a sense: at most two between lines and circles.
between :: Mm -> Sense -> ElementCarrier -> ElementCarrier -> [Fillet]
between radius turn a b = case (a, b) of
  (OnCurve p, OnCurve q) ->
    apart
      [ f
        | (s, g) <- pairs p q,
          f <- simple (ElementCarrier.ofSegment s) (ElementCarrier.ofSegment g),
          start f `on` s,
          end f `on` g
      ]
  (OnCurve p, _) ->
    apart
      [ f
        | s <- NonEmpty.toList (MeasuredPolyarc.segments p),
          f <- simple (ElementCarrier.ofSegment s) b,
          start f `on` s
      ]
  (_, OnCurve q) ->
    apart
      [ f
        | g <- NonEmpty.toList (MeasuredPolyarc.segments q),
          f <- simple a (ElementCarrier.ofSegment g),
          end f `on` g
      ]
  _ -> simple a b
  where
    simple = ofPair radius turn
    on p s = Distance.toPoint p s <= Tolerance.coincident
    -- Segments near enough to be touched by one circle.
    pairs p q =
      let index =
            BoundingBox.index BoundingBox.ofSegment (NonEmpty.toList (MeasuredPolyarc.segments q))
       in [ (s, g)
            | s <- NonEmpty.toList (MeasuredPolyarc.segments p),
              g <-
                BoundingBox.within
                  (BoundingBox.inflate (plus radius radius) (BoundingBox.ofSegment s))
                  index
          ]
    -- A fillet that touches where two segments of a curve join is found from both.
    apart fs = case fs of
      [] -> []
      f : rest ->
        f : apart (filter (\g -> Vec.distance (middle f) (middle g) > Tolerance.sameFillet) rest)

-- | The fillets between two lines or circles.
ofPair :: Mm -> Sense -> ElementCarrier -> ElementCarrier -> [Fillet]
ofPair radius turn a b =
  [ Fillet {middle = c, start, end}
    | Just la <- [locus radius turn a],
      Just lb <- [locus radius turn b],
      c <- CarrierIntersection.common la lb,
      Just start <- [touch radius turn a c],
      Just end <- [touch radius turn b c]
  ]

-- | Where the centre of an arc can lie that touches an element in its direction.
locus :: Mm -> Sense -> ElementCarrier -> Maybe Carrier
locus radius@(Mm r) turn walked = case walked of
  OnLine l -> Just (LineCarrier (Carrier.parallelAt (Mm (Carrier.sense turn * r)) l))
  OnCircle t (Circle c rc)
    | t /= turn -> Just (CircleCarrier (Circle c (plus rc radius)))
    | gap <= Tolerance.coincident -> Nothing
    | otherwise -> Just (CircleCarrier (Circle c gap))
    where
      gap = max (minus rc radius) (minus radius rc)
  OnCurve _ -> Nothing
  AtPoint _ -> Nothing

-- | Where an arc about a centre touches the element.
touch :: Mm -> Sense -> ElementCarrier -> Point -> Maybe Point
touch radius turn walked c = case walked of
  OnLine l -> Just (Carrier.foot l c)
  OnCircle t (Circle o rc@(Mm r)) ->
    Just (Vec.shift (Vec.scale (side * r) (Vec.unit (Vec.to o c))) o)
    where
      -- The smaller circle lies inside; a fillet around the circle touches it on the far side.
      side = if t == turn && radius > rc then -1 else 1
  OnCurve _ -> Nothing
  AtPoint _ -> Nothing
