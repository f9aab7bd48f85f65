-- | Segments: the straight lines and circular arcs that contours and paths are made of.
module Geometry.Segment
  ( Segment (..),
    arc,
    fullCircle,
    length,
    at,
    startDirection,
    endDirection,
    directionAt,
    reverse,
    cutAt,
    spans,
    fraction,
    radius,
    bulge,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Carrier (Circle (Circle), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Prelude hiding (length, reverse)

-- | A straight line or an arc between two points. An arc's sweep is positive counter-clockwise and
-- at most a full turn; both its ends lie on the circle about its centre. The ends are kept as
-- points so that neighbours have exactly the same.
data Segment
  = Straight {start :: {-# UNPACK #-} Point, end :: {-# UNPACK #-} Point}
  | Arc
      { start :: {-# UNPACK #-} Point,
        end :: {-# UNPACK #-} Point,
        centre :: {-# UNPACK #-} Point,
        sweep :: Rad
      }
  deriving stock (Eq, Ord, Show)

-- | The arc about a centre from one point to another in a sense; less than a full turn.
arc :: Sense -> Point -> Point -> Point -> Segment
arc turn centre start end = Arc {start, end, centre, sweep}
  where
    Rad short = Vec.turn (Vec.to centre start) (Vec.to centre end)
    sweep = Rad $ case turn of
      CounterClockwise | short < 0 -> short + 2 * pi
      Clockwise | short > 0 -> short - 2 * pi
      _ -> short

-- | A circle walked once, from a point on it.
fullCircle :: Sense -> Circle -> Point -> Segment
fullCircle turn (Circle centre _) start =
  Arc {start, end = start, centre, sweep = Rad (Carrier.sense turn * 2 * pi)}

-- | The radius of an arc, from its start.
radius :: Point -> Point -> Mm
radius centre start = Vec.distance centre start

-- | The length along the segment.
length :: Segment -> Mm
length segment = case segment of
  Straight a b -> Vec.distance a b
  Arc {start, centre, sweep = Rad s} -> let Mm r = radius centre start in Mm (r * abs s)

-- | The point at a fraction of the length, from 0 to 1; exactly the ends there.
at :: Double -> Segment -> Point
at t segment
  | t <= 0 = start segment
  | t >= 1 = end segment
  | otherwise = case segment of
    Straight a b -> Vec.between t a b
    Arc {start = a, end = b, centre, sweep = Rad s}
      -- About a centre so far away a place would be as inexact as the centre is: the chord from the
      -- beginning to it is
      -- @2·r·sin(t·φ/2)@ long, and turned against the whole one by @(t − 1)·φ/2@.
      | s /= 0 && abs s < flat ->
        Vec.shift
          ( Vec.scale
              (sin (t * s / 2) / sin (s / 2))
              (Vec.rotate (Rad ((t - 1) * s / 2)) (Vec.to a b))
          )
          a
      | otherwise -> Vec.shift (Vec.rotate (Rad (t * s)) (Vec.to centre a)) centre

-- | Arcs of less, in radians, are almost lines: the radius is more than ten thousand times the
-- chord.
flat :: Double
flat = 1e-4

-- | The direction in which the segment sets out, of length 1. The segment has a length.
startDirection :: Segment -> Vec
startDirection segment = case segment of
  Straight a b -> Vec.unit (Vec.to a b)
  Arc {start, centre, sweep} -> forward sweep (Vec.to centre start)

-- | The direction in which the segment arrives, of length 1. The segment has a length.
endDirection :: Segment -> Vec
endDirection segment = case segment of
  Straight a b -> Vec.unit (Vec.to a b)
  Arc {end, centre, sweep} -> forward sweep (Vec.to centre end)

-- | The direction at a fraction of the length, of length 1. The segment has a length.
directionAt :: Double -> Segment -> Vec
directionAt t segment = case segment of
  Straight a b -> Vec.unit (Vec.to a b)
  Arc {centre, sweep} -> forward sweep (Vec.to centre (at t segment))

forward :: Rad -> Vec -> Vec
forward (Rad s) out = Vec.unit (Vec.scale (signum s) (Vec.left out))

-- | The same segment walked the other way.
reverse :: Segment -> Segment
reverse segment = case segment of
  Straight a b -> Straight b a
  Arc {start, end, centre, sweep = Rad s} ->
    Arc {start = end, end = start, centre, sweep = Rad (-s)}

-- | The segment in two at a fraction of its length between 0 and 1.
cutAt :: Double -> Segment -> (Segment, Segment)
cutAt t segment = (part (start segment) p t, part p (end segment) (1 - t))
  where
    p = at t segment
    part a b share = case segment of
      Straight _ _ -> Straight a b
      Arc {centre, sweep = Rad s} -> Arc {start = a, end = b, centre, sweep = Rad (s * share)}

-- | Whether the foot of a point falls on the segment rather than before or behind it: for an arc,
-- whether the point lies in the sector of the arc.
spans :: Segment -> Point -> Bool
spans segment p = let t = fraction segment p in t >= 0 && t <= 1

-- | Where on the segment a point's foot lies, as a fraction of the length. For an arc the result
-- lies in [0, full turn / sweep).
fraction :: Segment -> Point -> Double
fraction segment p = case segment of
  Straight a b -> let u = Vec.to a b in Vec.dot u (Vec.to a p) / Vec.dot u u
  Arc {start, centre, sweep = Rad s} ->
    let Rad t = Vec.turn (Vec.to centre start) (Vec.to centre p)
        along = signum s * t
     in (if along < 0 then along + 2 * pi else along) / abs s

-- | The largest distance between the segment and its chord, the sagitta @r·(1 − cos(φ/2))@.
bulge :: Segment -> Mm
bulge segment = case segment of
  Straight _ _ -> Mm 0
  Arc {start, centre, sweep = Rad s} ->
    let Mm r =
          radius centre start
     in Mm (2 * r * sin (s / 4) ^ (2 :: Int))
