-- | What a contour walks on.
module Geometry.Walked
  ( Walked (..),
    ofSegment,
    within,
    alongLine,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.Box (Box)
import Geometry.Box qualified as Box
import Geometry.Polyarc (Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Shape (Circle (Circle), Line (Line), Turn (..))
import Geometry.Shape qualified as Shape
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

data Walked
  = OnLine {-# UNPACK #-} Line
  | OnCircle Turn {-# UNPACK #-} Circle
  | -- | a curve, as far as it goes
    OnCurve Polyarc
  | -- | a corner that the contour passes through
    AtPoint {-# UNPACK #-} Point
  deriving stock (Eq, Show)

-- | The line or the circle of a segment, walked its way.
ofSegment :: Segment -> Walked
ofSegment s = case s of
  Straight p q -> OnLine (Line p q)
  Arc {start, centre, sweep = Rad a} -> OnCircle (if a > 0 then CounterClockwise else Clockwise) (Circle centre (Segment.radius centre start))

-- | As much of a shape as can reach into a box, as segments.
within :: Box -> Walked -> NonEmpty Segment
within box walked = case walked of
  OnLine l ->
    let Box.Box left bottom right top = Box.inflate (Mm 1) box
        along p = let Mm s = alongLine l p in s
        marks = [along (Vec.point x y) | x <- [left, right], y <- [bottom, top]]
        place s = Vec.shift (Vec.scale s (Shape.direction l)) (Shape.from l)
     in Straight (place (minimum marks)) (place (maximum marks)) :| []
  OnCircle turn circle@(Circle c (Mm r)) -> Segment.fullCircle turn circle (Vec.shift (Vec.vec r 0) c) :| []
  OnCurve p -> Polyarc.segments p
  AtPoint p -> Straight p p :| []

-- | How far along a line the foot of a point lies.
alongLine :: Line -> Point -> Mm
alongLine l p = Mm (Vec.dot (Shape.direction l) (Vec.to (Shape.from l) p))
