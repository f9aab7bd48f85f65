-- | Carriers: the directed line and the circle on which a segment lies.
--
-- The module also owns the two senses of an arc, the two sides of a direction of travel, and the
-- signs of both in formulas: positive is counter-clockwise and left.
module Geometry.Carrier
  ( Carrier (..),

    -- * Lines
    Line (..),
    direction,
    signedDistance,
    foot,
    parallelAt,

    -- * Circles
    Circle (..),

    -- * Senses
    Sense (..),
    senseSign,
    senseOf,
    sweepInSense,

    -- * Sides
    Side (..),
    sideSign,
    oppositeSide,
    senseTowards,
    senseAwayFrom,
    beside,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | The full line or circle on which a segment lies. It has no sense; the carrier of a contour's
-- element, which has one, is 'Geometry.ElementCarrier.ElementCarrier'.
data Carrier = LineCarrier Line | CircleCarrier Circle
  deriving stock (Eq, Show)

-- | The straight line through two different points, directed from the first to the second.
data Line = Line {from :: {-# UNPACK #-} Point, to :: {-# UNPACK #-} Point}
  deriving stock (Eq, Show)

-- | The direction of a line, of length 1.
direction :: Line -> Vec
direction l = Vec.unit (Vec.to (from l) (to l))

-- | The distance of a point from a line: positive on its left, negative on its right.
signedDistance :: Line -> Point -> Mm
signedDistance l p = Mm (Vec.cross (direction l) (Vec.to (from l) p))

-- | The foot of the perpendicular from a point to a line.
foot :: Line -> Point -> Point
foot l p = Vec.shift (Vec.scale (Vec.dot d (Vec.to (from l) p)) d) (from l)
  where
    d = direction l

-- | The parallel line at a distance to the left, or to the right when the distance is negative.
parallelAt :: Mm -> Line -> Line
parallelAt (Mm h) l = Line (Vec.shift offset (from l)) (Vec.shift offset (to l))
  where
    offset = Vec.scale h (Vec.left (direction l))

-- | A circle; its radius is positive.
data Circle = Circle {centre :: {-# UNPACK #-} Point, radius :: Mm}
  deriving stock (Eq, Ord, Show)

-- | The sense of an arc.
data Sense = Clockwise | CounterClockwise
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | The sign of a sense: +1 counter-clockwise, −1 clockwise. It is also the sign of the side on
-- which the centre lies.
senseSign :: Sense -> Double
senseSign t = case t of
  Clockwise -> -1
  CounterClockwise -> 1

-- | The sense of an arc by its sweep. A sweep of 0 counts as clockwise.
senseOf :: Rad -> Sense
senseOf (Rad sweep) = if sweep > 0 then CounterClockwise else Clockwise

-- | The sweep in a sense that leads to the same direction as an angle in [−π, π]. It lies in
-- [0, 2π) counter-clockwise and in (−2π, 0] clockwise.
sweepInSense :: Sense -> Rad -> Rad
sweepInSense t (Rad short) = Rad $ case t of
  CounterClockwise | short < 0 -> short + 2 * pi
  Clockwise | short > 0 -> short - 2 * pi
  _ -> short

-- | The left or the right of a direction of travel.
data Side = LeftOf | RightOf
  deriving stock (Eq, Show, Enum, Bounded)

-- | The sign of a side: +1 on the left, −1 on the right.
sideSign :: Side -> Double
sideSign side = case side of
  LeftOf -> 1
  RightOf -> -1

-- | The other side.
oppositeSide :: Side -> Side
oppositeSide side = case side of
  LeftOf -> RightOf
  RightOf -> LeftOf

-- | The sense of an arc whose centre lies on a side of it.
senseTowards :: Side -> Sense
senseTowards side = case side of
  LeftOf -> CounterClockwise
  RightOf -> Clockwise

-- | The sense of an arc whose centre lies on the other side: an offset on this side rounds a
-- corner in this sense.
senseAwayFrom :: Side -> Sense
senseAwayFrom = senseTowards . oppositeSide

-- | The point at a distance on a side of a point, across a direction of length 1.
beside :: Side -> Mm -> Vec -> Point -> Point
beside side (Mm d) forward = Vec.shift (Vec.scale (sideSign side * d) (Vec.left forward))
