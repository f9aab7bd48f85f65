-- | The carriers of a contour's elements.
--
-- An element lies on a line, on a circle with a sense, on a curve, or it is a single point. A
-- 'Geometry.Carrier.Carrier' does not suffice for elements: its circles have no sense, while
-- fillets and links depend on the direction of travel.
module Geometry.ElementCarrier
  ( ElementCarrier (..),
    ofSegment,
    segmentsWithin,
    positionAlong,
  )
where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.Carrier (Circle (Circle), Line (Line), Sense)
import Geometry.Carrier qualified as Carrier
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.MeasuredPolyarc (MeasuredPolyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The carrier of an element, with the direction of travel.
data ElementCarrier
  = OnLine {-# UNPACK #-} Line
  | OnCircle Sense {-# UNPACK #-} Circle
  | -- | a curve from its start to its end
    OnCurve MeasuredPolyarc
  | -- | a corner through which the contour passes
    AtPoint {-# UNPACK #-} Point
  deriving stock (Eq, Show)

-- | The directed line or circle of a segment.
ofSegment :: Segment -> ElementCarrier
ofSegment s = case s of
  Straight p q -> OnLine (Line p q)
  Arc {start, centre, sweep} ->
    OnCircle (Carrier.senseOf sweep) (Circle centre (Segment.radius centre start))

-- | Segments of the carrier that contain all of its points inside a bounding box. A line is cut
-- beyond the box; circles and curves are returned whole.
segmentsWithin :: BoundingBox -> ElementCarrier -> NonEmpty Segment
segmentsWithin box carrier = case carrier of
  OnLine l -> lineWithin box l :| []
  OnCircle sense circle@(Circle c (Mm r)) ->
    Segment.fullCircle sense circle (Vec.shift (Vec.vec r 0) c) :| []
  OnCurve p -> MeasuredPolyarc.segments p
  AtPoint p -> Straight p p :| []

-- | The projection onto a line of a bounding box with a margin of 1 mm.
lineWithin :: BoundingBox -> Line -> Segment
lineWithin box l = Straight (at (minimum corners)) (at (maximum corners))
  where
    BoundingBox left bottom right top = BoundingBox.inflate (Mm 1) box
    corners = [positionAlong l (Vec.point x y) | x <- [left, right], y <- [bottom, top]]
    at (Mm s) = Vec.shift (Vec.scale s (Carrier.direction l)) (Carrier.from l)

-- | The signed distance along a line from its first point to the foot of a point.
positionAlong :: Line -> Point -> Mm
positionAlong l p = Mm (Vec.dot (Carrier.direction l) (Vec.to (Carrier.from l) p))
