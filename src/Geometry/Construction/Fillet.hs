-- | Fillets: arcs of a given radius and sense (clockwise or counter-clockwise) that lead from one
-- element's carrier to another. A carrier is the line, the circle, the curve or the point on which
-- an element lies, with a direction of travel. At each end, a fillet has the direction of travel of
-- the carrier that it touches there.
module Geometry.Construction.Fillet
  ( Fillet (..),
    between,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Carrier (..), Circle (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Distance qualified as Distance
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.ElementCarrier qualified as ElementCarrier
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.MeasuredPolyarc (MeasuredPolyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment)
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A fillet by its centre (@middle@) and its ends. It starts on the first of two carriers and ends
-- on the second.
data Fillet = Fillet {middle :: Point, start :: Point, end :: Point}
  deriving stock (Eq, Show)

-- | All fillets of a radius and sense from the carrier @a@ to the carrier @b@. Between lines and
-- circles there are at most two; from or to a point there is none. A curve is treated segment by
-- segment: a fillet to the carrier of a segment counts only if it touches that segment.
between :: Mm -> Sense -> ElementCarrier -> ElementCarrier -> [Fillet]
between radius sense a b = case (a, b) of
  (OnCurve p, OnCurve q) ->
    distinct
      [ f
        | (s, g) <- closePairs radius p q,
          f <- fillets (ElementCarrier.ofSegment s) (ElementCarrier.ofSegment g),
          start f `isOn` s,
          end f `isOn` g
      ]
  (OnCurve p, _) ->
    distinct
      [f | s <- segmentsOf p, f <- fillets (ElementCarrier.ofSegment s) b, start f `isOn` s]
  (_, OnCurve q) ->
    distinct [f | g <- segmentsOf q, f <- fillets a (ElementCarrier.ofSegment g), end f `isOn` g]
  _ -> fillets a b
  where
    fillets = ofPair radius sense
    isOn p s = Distance.toPoint p s <= Tolerance.coincident

-- | The segments of a curve.
segmentsOf :: MeasuredPolyarc -> [Segment]
segmentsOf = NonEmpty.toList . MeasuredPolyarc.segments

-- | The pairs of a segment of @p@ and one of @q@ that may be close enough for one circle of the
-- radius to touch both. For the other pairs no fillet need be computed.
closePairs :: Mm -> MeasuredPolyarc -> MeasuredPolyarc -> [(Segment, Segment)]
closePairs radius p q = [(s, g) | s <- segmentsOf p, g <- BoxTree.within (around s) tree]
  where
    tree = BoxTree.index BoundingBox.ofSegment (segmentsOf q)
    around s = BoundingBox.inflate (plus radius radius) (BoundingBox.ofSegment s)

-- | The fillets without duplicates. A fillet that touches a curve at a joint of two segments is
-- found twice, once from each segment.
distinct :: [Fillet] -> [Fillet]
distinct fillets = case fillets of
  [] -> []
  f : rest -> f : distinct (filter (differs f) rest)
  where
    differs f g = Vec.distance (middle f) (middle g) > Tolerance.sameFillet

-- | The fillets of a radius and sense from the line or circle @a@ to the line or circle @b@.
ofPair :: Mm -> Sense -> ElementCarrier -> ElementCarrier -> [Fillet]
ofPair radius sense a b =
  [ Fillet {middle = c, start, end}
    | Just locusA <- [locus radius sense a],
      Just locusB <- [locus radius sense b],
      c <- Intersection.common locusA locusB,
      Just start <- [touch radius sense a c],
      Just end <- [touch radius sense b c]
  ]

-- | The line or circle that contains the centres of all arcs of a radius and sense that are tangent
-- to a carrier in its direction of travel. Nothing for a curve or a point, and for a circle of the
-- same sense and radius.
locus :: Mm -> Sense -> ElementCarrier -> Maybe Carrier
locus radius@(Mm r) sense carrier = case carrier of
  OnLine l -> Just (LineCarrier (Carrier.parallelAt (Mm (Carrier.senseSign sense * r)) l))
  OnCircle t (Circle c rc)
    | t /= sense -> Just (CircleCarrier (Circle c (plus rc radius)))
    | gap <= Tolerance.coincident -> Nothing
    | otherwise -> Just (CircleCarrier (Circle c gap))
    where
      gap = max (minus rc radius) (minus radius rc)
  OnCurve _ -> Nothing
  AtPoint _ -> Nothing

-- | The point at which an arc about the centre @c@ touches a carrier. Nothing for a curve or a
-- point.
touch :: Mm -> Sense -> ElementCarrier -> Point -> Maybe Point
touch radius sense carrier c = case carrier of
  OnLine l -> Just (Carrier.foot l c)
  OnCircle t (Circle o rc@(Mm r)) ->
    Just (Vec.shift (Vec.scale (side * r) (Vec.unit (Vec.to o c))) o)
    where
      -- With equal senses, either the fillet's circle lies inside the carrier's circle or the
      -- reverse. If the fillet is larger, the carrier's centre @o@ lies between the fillet's centre
      -- and the point of contact.
      side = if t == sense && radius > rc then -1 else 1
  OnCurve _ -> Nothing
  AtPoint _ -> Nothing
