-- | Carriers: the directed line and the circle on which a segment lies.
--
-- The module also defines the two senses of an arc and the two sides of a direction of travel. In
-- formulas each sense and side has a sign: counter-clockwise and left are positive.
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
    oppositeSense,
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

-- | The full line or circle on which a segment lies. A circle has no sense here;
-- 'Geometry.ElementCarrier.ElementCarrier' is the carrier with a direction of travel.
data Carrier = LineCarrier Line | CircleCarrier Circle
  deriving stock (Eq, Show)

-- | The straight line through two different points, directed from the first to the second.
data Line = Line {from :: {-# UNPACK #-} Point, to :: {-# UNPACK #-} Point}
  deriving stock (Eq, Show)

-- | The direction of a line, of length 1.
direction :: Line -> Vec
direction l = Vec.unit (Vec.to (from l) (to l))

-- | The distance of the point @p@ from the line @l@: positive on the left of the line, negative on
-- its right.
signedDistance :: Line -> Point -> Mm
signedDistance l p = Mm (Vec.cross (direction l) (Vec.to (from l) p))

-- | The foot of the perpendicular from the point @p@ to the line @l@.
foot :: Line -> Point -> Point
foot l p = Vec.shift (Vec.scale (Vec.dot d (Vec.to (from l) p)) d) (from l)
  where
    d = direction l

-- | The parallel line at the distance @h@ to the left, or to the right when @h@ is negative.
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

-- | The sign of a sense: +1 counter-clockwise, −1 clockwise. It is also the 'sideSign' of the side
-- on which the centre of an arc in this sense lies.
senseSign :: Sense -> Double
senseSign t = case t of
  Clockwise -> -1
  CounterClockwise -> 1

-- | The sense of an arc by its sweep. A sweep of 0 counts as clockwise.
senseOf :: Rad -> Sense
senseOf (Rad sweep) = if sweep > 0 then CounterClockwise else Clockwise

-- | The opposite sense.
oppositeSense :: Sense -> Sense
oppositeSense t = case t of
  Clockwise -> CounterClockwise
  CounterClockwise -> Clockwise

-- | The sweep of an arc in a given sense. @short@ is the angle, in [−π, π], from the radius at the
-- arc's start to the radius at its end. The sweep is that angle, or differs from it by a full turn.
-- It lies in [0, 2π) counter-clockwise and in (−2π, 0] clockwise.
sweepInSense :: Sense -> Rad -> Rad
sweepInSense t (Rad short) = Rad $ case t of
  CounterClockwise | short < 0 -> short + 2 * pi
  Clockwise | short > 0 -> short - 2 * pi
  _ -> short

-- | A side of a direction of travel: left or right.
data Side = LeftOf | RightOf
  deriving stock (Eq, Show, Enum, Bounded)

-- | The sign of a side of a direction of travel: +1 on the left, −1 on the right.
sideSign :: Side -> Double
sideSign side = case side of
  LeftOf -> 1
  RightOf -> -1

-- | The opposite side.
oppositeSide :: Side -> Side
oppositeSide side = case side of
  LeftOf -> RightOf
  RightOf -> LeftOf

-- | The sense of an arc whose centre lies on the given side.
senseTowards :: Side -> Sense
senseTowards side = case side of
  LeftOf -> CounterClockwise
  RightOf -> Clockwise

-- | The sense of an arc whose centre lies on the side opposite to the given one. An offset to the
-- given side rounds corners in this sense.
senseAwayFrom :: Side -> Sense
senseAwayFrom = senseTowards . oppositeSide

-- | The point at the distance @d@ from a given point, on a side of the direction @forward@ and at a
-- right angle to it. @forward@ has the length 1.
beside :: Side -> Mm -> Vec -> Point -> Point
beside side (Mm d) forward = Vec.shift (Vec.scale (sideSign side * d) (Vec.left forward))
