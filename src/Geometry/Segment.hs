-- | Segments: the straight lines and circular arcs of which polyarcs and toolpaths consist.
--
-- The module owns everything that concerns one segment: its construction from a centre or a bulge,
-- points and directions along it, its carrier, its reversal, division and offset. Distances and
-- intersections of two segments are in "Geometry.Distance".
--
-- The foot of a point @p@ on a segment is the point where the perpendicular from @p@ meets the
-- segment's carrier. On an arc's circle it lies in the direction of @p@ from the centre. The sector
-- of an arc is the region between the rays from its centre through its ends, on the side of the
-- arc.
module Geometry.Segment
  ( Segment (..),

    -- * Construction
    arc,
    fullCircle,
    arcOrCircle,
    fromBulge,

    -- * Measures
    length,
    radius,
    sagitta,
    bulge,
    carrier,

    -- * Along the segment
    at,
    startDirection,
    endDirection,
    directionAt,
    hasFootOf,
    isBehind,
    fraction,

    -- * Changed segments
    reverse,
    cutAt,
    between,
    offset,
    offsetRadius,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Carrier (Carrier (..), Circle (Circle), Line (Line), Sense (..), Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Prelude hiding (length, reverse)

-- | A straight line or an arc between two points. The sweep of an arc is positive
-- counter-clockwise, and its absolute value is at most 2π. Both ends of an arc lie on the circle
-- about its centre, but for rounding. They are kept as points so that neighbours share exactly the
-- same point.
data Segment
  = Straight {start :: {-# UNPACK #-} Point, end :: {-# UNPACK #-} Point}
  | Arc
      { start :: {-# UNPACK #-} Point,
        end :: {-# UNPACK #-} Point,
        centre :: {-# UNPACK #-} Point,
        sweep :: Rad
      }
  deriving stock (Eq, Ord, Show)

-- | The arc from @start@ to @end@ about @centre@ in the given sense. The absolute value of its
-- sweep is less than 2π. The sweep is 0 when both ends lie in the same direction from the centre.
arc :: Sense -> Point -> Point -> Point -> Segment
arc sense centre start end = Arc {start, end, centre, sweep}
  where
    sweep = Carrier.sweepInSense sense (Vec.signedAngle (Vec.to centre start) (Vec.to centre end))

-- | A full circle as an arc in the given sense that starts and ends at the point @start@ on it.
fullCircle :: Sense -> Circle -> Point -> Segment
fullCircle sense (Circle centre _) start =
  Arc {start, end = start, centre, sweep = Rad (Carrier.senseSign sense * 2 * pi)}

-- | The 'arc' from @start@ to @end@ about @centre@ in the given sense, or the full circle when both
-- ends are equal. A frame in which an arc ends where it starts means a full circle.
arcOrCircle :: Sense -> Point -> Point -> Point -> Segment
arcOrCircle sense centre start end
  | start == end = fullCircle sense (Circle centre (radius centre start)) start
  | otherwise = arc sense centre start end

-- | The segment from @start@ to @end@ with the bulge @b = tan(sweep/4)@: a line for 0, else an arc.
-- The arc's centre lies on the left normal of the chord at its midpoint. Its distance from this
-- midpoint is @(1 − b²)/(4·b)@ times the chord's length; when negative, the centre lies to the
-- right.
fromBulge :: Point -> Point -> Double -> Segment
fromBulge start end b
  | b == 0 = Straight start end
  | otherwise =
    Arc
      { start,
        end,
        centre = Vec.shift (Vec.scale ((1 - b * b) / (4 * b)) normal) midpoint,
        sweep = Rad (4 * atan b)
      }
  where
    normal = Vec.left (Vec.to start end)
    midpoint = Vec.interpolate 0.5 start end

-- | The radius of an arc, from its centre and its start.
radius :: Point -> Point -> Mm
radius centre start = Vec.distance centre start

-- | The length of the segment.
length :: Segment -> Mm
length segment = case segment of
  Straight a b -> Vec.distance a b
  Arc {start, centre, sweep = Rad s} -> let Mm r = radius centre start in Mm (r * abs s)

-- | The sagitta: the largest distance between the segment and its chord. It is 0 for a line and
-- @r·(1 − cos(φ/2))@ for an arc of radius r and sweep φ.
sagitta :: Segment -> Mm
sagitta segment = case segment of
  Straight _ _ -> Mm 0
  Arc {start, centre, sweep = Rad s} ->
    let Mm r = radius centre start in Mm (2 * r * sin (s / 4) ^ (2 :: Int))

-- | The bulge of the segment, @tan(sweep/4)@; 0 for a line.
bulge :: Segment -> Double
bulge segment = case segment of
  Straight _ _ -> 0
  Arc {sweep = Rad s} -> tan (s / 4)

-- | The line or circle on which the segment lies. Nothing for a line between equal points and for
-- an arc of radius 0.
carrier :: Segment -> Maybe Carrier
carrier segment = case segment of
  Straight a b -> if a == b then Nothing else Just (LineCarrier (Line a b))
  Arc {start, centre} ->
    let r = radius centre start
     in if r > Mm 0 then Just (CircleCarrier (Circle centre r)) else Nothing

-- | The point at the fraction @t@ of the segment's length. A fraction up to 0 gives exactly the
-- start, and one from 1 on exactly the end.
at :: Double -> Segment -> Point
at t segment
  | t <= 0 = start segment
  | t >= 1 = end segment
  | otherwise = case segment of
    Straight a b -> Vec.interpolate t a b
    Arc {start = a, end = b, centre, sweep = Rad s}
      | s /= 0 && abs s < flat -> onFlatArc a b s
      | otherwise -> Vec.shift (Vec.rotate (Rad (t * s)) (Vec.to centre a)) centre
  where
    -- The centre of a flat arc is distant and inexact, so the point is computed from the chord.
    -- With the sweep φ, the chord from the start to the point is @2·r·sin(t·φ/2)@ long. It is
    -- rotated by @(t − 1)·φ/2@ from the chord of the whole arc.
    onFlatArc a b s =
      let share = sin (t * s / 2) / sin (s / 2)
          chord = Vec.rotate (Rad ((t - 1) * s / 2)) (Vec.to a b)
       in Vec.shift (Vec.scale share chord) a

-- | The sweep in radians below which 'at' computes points of an arc from its chord. The radius of
-- such an arc is more than ten thousand times the chord.
flat :: Double
flat = 1e-4

-- | The direction of travel at the start, of length 1. The length of the segment must not be 0.
startDirection :: Segment -> Vec
startDirection segment = case segment of
  Straight a b -> Vec.unit (Vec.to a b)
  Arc {start, centre, sweep} -> tangent sweep (Vec.to centre start)

-- | The direction of travel at the end, of length 1. The length of the segment must not be 0.
endDirection :: Segment -> Vec
endDirection segment = case segment of
  Straight a b -> Vec.unit (Vec.to a b)
  Arc {end, centre, sweep} -> tangent sweep (Vec.to centre end)

-- | The direction of travel, of length 1, at the fraction @t@ of the segment's length. This length
-- must not be 0.
directionAt :: Double -> Segment -> Vec
directionAt t segment = case segment of
  Straight a b -> Vec.unit (Vec.to a b)
  Arc {centre, sweep} -> tangent sweep (Vec.to centre (at t segment))

-- | The direction of travel, of length 1, on an arc with the sweep @s@. The vector @out@ leads from
-- the arc's centre to the point of the arc.
tangent :: Rad -> Vec -> Vec
tangent (Rad s) out = Vec.unit (Vec.scale (signum s) (Vec.left out))

-- | True when the foot of the point @p@ lies on the segment, not before its start or after its end.
-- On an arc, this means that @p@ lies in the arc's sector.
hasFootOf :: Segment -> Point -> Bool
hasFootOf segment p = let t = fraction segment p in t >= 0 && t <= 1

-- | True when the point @p@ is beside the segment, that is, on one of its normals, and on the side
-- opposite to @side@.
isBehind :: Side -> Segment -> Point -> Bool
isBehind side segment p =
  t >= 0
    && t <= 1
    && Carrier.sideSign side * Vec.cross (directionAt t segment) (Vec.to (at t segment) p) < 0
  where
    t = fraction segment p

-- | The foot of the point @p@ as a fraction of the segment's length from its start. For a line it
-- is negative before the start and above 1 after the end; for an arc of sweep φ it lies in
-- [0, 2π/|φ|).
fraction :: Segment -> Point -> Double
fraction segment p = case segment of
  Straight a b -> let u = Vec.to a b in Vec.dot u (Vec.to a p) / Vec.dot u u
  Arc {start, centre, sweep = Rad s} ->
    let Rad t = Vec.signedAngle (Vec.to centre start) (Vec.to centre p)
        along = signum s * t
     in (if along < 0 then along + 2 * pi else along) / abs s

-- | The segment in the opposite direction, from its end to its start.
reverse :: Segment -> Segment
reverse segment = case segment of
  Straight a b -> Straight b a
  Arc {start, end, centre, sweep = Rad s} ->
    Arc {start = end, end = start, centre, sweep = Rad (-s)}

-- | The parts of the segment before and after the point at the fraction @t@ of its length. @t@ lies
-- between 0 and 1.
cutAt :: Double -> Segment -> (Segment, Segment)
cutAt t segment = (part (start segment) p t, part p (end segment) (1 - t))
  where
    p = at t segment
    part a b share = case segment of
      Straight _ _ -> Straight a b
      Arc {centre, sweep = Rad s} -> Arc {start = a, end = b, centre, sweep = Rad (s * share)}

-- | The part of a segment between two fractions of its length, of which the first is the smaller
-- one. An end of the segment is kept exactly.
between :: Double -> Double -> Segment -> Segment
between a b segment
  | a <= 0 && b >= 1 = segment
  | a <= 0 = fst (cutAt b segment)
  | b >= 1 = snd (cutAt a segment)
  | otherwise = snd (cutAt (a / b) (fst (cutAt b segment)))

-- | The segment moved sideways by the distance @d@ to the given side: the parallel line, or the
-- concentric arc. Nothing for a line of length 0, for an arc of radius 0, and for an arc whose
-- offset would have a radius of 0 or less.
offset :: Side -> Mm -> Segment -> Maybe Segment
offset side d@(Mm distance) segment = case segment of
  Straight a b
    | a == b -> Nothing
    | otherwise ->
      let v = Vec.scale (Carrier.sideSign side * distance) (Vec.left (Vec.unit (Vec.to a b)))
       in Just (Straight (Vec.shift v a) (Vec.shift v b))
  Arc {start, end, centre, sweep}
    | old <= 0 || new <= 0 -> Nothing
    | otherwise -> Just Arc {start = moved start, end = moved end, centre, sweep}
    where
      Mm old = radius centre start
      Mm new = offsetRadius side d sweep (Mm old)
      moved p = Vec.shift (Vec.scale (new / old) (Vec.to centre p)) centre

-- | The radius of the offset of an arc with the radius @r@ and the sweep @s@. The offset lies at
-- the distance @d@ to the given side of the arc. Its radius is @r − d@ if the centre lies on this
-- side, else @r + d@. The result is negative when @d@ is larger than @r@ on the side of the centre.
offsetRadius :: Side -> Mm -> Rad -> Mm -> Mm
offsetRadius side (Mm d) (Rad s) (Mm r)
  | signum s == Carrier.sideSign side = Mm (r - d)
  | otherwise = Mm (r + d)
