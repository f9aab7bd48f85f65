-- | What a contour walks on.
module Geometry.ElementCarrier
  ( ElementCarrier (..),
    ofSegment,
    within,
    alongLine,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.Carrier (Circle (Circle), Line (Line), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.MeasuredPolyarc (Polyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

data ElementCarrier
  = OnLine {-# UNPACK #-} Line
  | OnCircle Sense {-# UNPACK #-} Circle
  | -- | a curve, as far as it goes
    OnCurve Polyarc
  | -- | a corner that the contour passes through
    AtPoint {-# UNPACK #-} Point
  deriving stock (Eq, Show)

-- | The line or the circle of a segment, walked its way.
ofSegment :: Segment -> ElementCarrier
ofSegment s = case s of
  Straight p q -> OnLine (Line p q)
  Arc {start, centre, sweep = Rad a} ->
    OnCircle
      (if a > 0 then CounterClockwise else Clockwise)
      (Circle centre (Segment.radius centre start))

-- | As much of a shape as can reach into a box, as segments.
within :: BoundingBox -> ElementCarrier -> NonEmpty Segment
within box walked = case walked of
  OnLine l ->
    let BoundingBox.BoundingBox left bottom right top = BoundingBox.inflate (Mm 1) box
        along p = let Mm s = alongLine l p in s
        marks = [along (Vec.point x y) | x <- [left, right], y <- [bottom, top]]
        place s = Vec.shift (Vec.scale s (Carrier.direction l)) (Carrier.from l)
     in Straight (place (minimum marks)) (place (maximum marks)) :| []
  OnCircle turn circle@(Circle c (Mm r)) ->
    Segment.fullCircle turn circle (Vec.shift (Vec.vec r 0) c) :| []
  OnCurve p -> MeasuredPolyarc.segments p
  AtPoint p -> Straight p p :| []

-- | How far along a line the foot of a point lies.
alongLine :: Line -> Point -> Mm
alongLine l p = Mm (Vec.dot (Carrier.direction l) (Vec.to (Carrier.from l) p))
