-- | The carriers of a contour's elements.
--
-- An element lies on a line, on a circle with a sense, on a curve, or it is a single point. A
-- 'Geometry.Carrier.Carrier' does not suffice for elements, because its circles have no sense.
-- Fillets, chamfers and the other links between two elements depend on the direction of travel.
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
  | -- | a curve from its start to its end, as a chain of lines and arcs
    OnCurve MeasuredPolyarc
  | -- | a point through which the contour passes
    AtPoint {-# UNPACK #-} Point
  deriving stock (Eq, Show)

-- | The line or circle of a segment, with the segment's direction.
ofSegment :: Segment -> ElementCarrier
ofSegment s = case s of
  Straight p q -> OnLine (Line p q)
  Arc {start, centre, sweep} ->
    OnCircle (Carrier.senseOf sweep) (Circle centre (Segment.radius centre start))

-- | Segments of a carrier that contain all of the carrier's points inside a bounding box. A line
-- becomes a segment that ends outside of the box. Circles and curves are returned whole.
segmentsWithin :: BoundingBox -> ElementCarrier -> NonEmpty Segment
segmentsWithin box carrier = case carrier of
  OnLine l -> lineWithin box l :| []
  OnCircle sense circle@(Circle c (Mm r)) ->
    Segment.fullCircle sense circle (Vec.shift (Vec.vec r 0) c) :| []
  OnCurve p -> MeasuredPolyarc.segments p
  AtPoint p -> Straight p p :| []

-- | The segment of a line that contains the foot of every point of a bounding box. It thus contains
-- all points of the line inside the box. It is computed from a box that is larger by 1 mm on every
-- side, so that the ends of the segment lie outside of the given box.
lineWithin :: BoundingBox -> Line -> Segment
lineWithin box l = Straight (at (minimum corners)) (at (maximum corners))
  where
    BoundingBox left bottom right top = BoundingBox.inflate (Mm 1) box
    corners = [positionAlong l (Vec.point x y) | x <- [left, right], y <- [bottom, top]]
    at (Mm s) = Vec.shift (Vec.scale s (Carrier.direction l)) (Carrier.from l)

-- | The signed distance along the line @l@ from its first point to the foot of the perpendicular
-- from the point @p@; positive in the line's direction.
positionAlong :: Line -> Point -> Mm
positionAlong l p = Mm (Vec.dot (Carrier.direction l) (Vec.to (Carrier.from l) p))
