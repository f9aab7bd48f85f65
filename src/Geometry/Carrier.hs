-- | The shapes that contours are walked on: lines and circles, with a sense.
module Geometry.Carrier
  ( Line (..),
    direction,
    signedDistance,
    foot,
    parallelAt,
    Circle (..),
    Sense (..),
    sense,
    Side (..),
  )
where

import Base.Quantity (Mm (..))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | The straight line through two different points, directed from the first to the second.
data Line = Line {from :: {-# UNPACK #-} Point, to :: {-# UNPACK #-} Point}
  deriving stock (Eq, Show)

-- | The direction of a line, of length 1.
direction :: Line -> Vec
direction l = Vec.unit (Vec.to (from l) (to l))

-- | How far a point lies to the left of a line; negative to the right.
signedDistance :: Line -> Point -> Mm
signedDistance l p = Mm (Vec.cross (direction l) (Vec.to (from l) p))

-- | The foot of the perpendicular from a point.
foot :: Line -> Point -> Point
foot l p = Vec.shift (Vec.scale (Vec.dot d (Vec.to (from l) p)) d) (from l)
  where
    d = direction l

-- | The line at a distance to the left; to the right when the distance is negative.
parallelAt :: Mm -> Line -> Line
parallelAt (Mm h) l = Line (Vec.shift offset (from l)) (Vec.shift offset (to l))
  where
    offset = Vec.scale h (Vec.left (direction l))

-- | A circle; its radius is positive.
data Circle = Circle {centre :: {-# UNPACK #-} Point, radius :: Mm}
  deriving stock (Eq, Ord, Show)

-- | The sense in which an arc is walked.
data Sense = Clockwise | CounterClockwise
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | +1 counter-clockwise, −1 clockwise: the side on which the centre lies, left positive.
sense :: Sense -> Double
sense t = case t of
  Clockwise -> -1
  CounterClockwise -> 1

-- | The left or the right of the direction of travel.
data Side = LeftOf | RightOf
  deriving stock (Eq, Show, Enum, Bounded)
