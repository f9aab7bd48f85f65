-- | Polyarcs: chains of segments, open or closed. Each segment starts where the previous one ends.
--
-- This is the basic representation, a list of segments. The contours of a part are passed on in
-- this form. Where a list is too slow, it is converted to one of three other representations.
-- "Geometry.MeasuredPolyarc" serves for positions by arc length. "Geometry.FlatPolyarc" is the
-- input and output of the offset kernel and of arc fitting. "Geometry.ClosedPolyarcs" serves for
-- the computation inside the kernel.
module Geometry.Polyarc
  ( Polyarc (..),
    Ends (..),
    length,
    reverse,
    neighbours,
    closeGaps,
    signedArea,
    areaOf,
    firstMoment,
  )
where

import Base.Quantity (Mm (..), Rad (..), total)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Prelude hiding (length, reverse)

-- | A polyarc is closed when its last segment ends where its first one starts; otherwise it is
-- open.
data Ends = Open | Closed
  deriving stock (Eq, Show)

-- | Segments in the direction of travel.
data Polyarc = Polyarc {ends :: Ends, segments :: NonEmpty Segment}
  deriving stock (Eq, Show)

-- | The length of a polyarc: the sum of its segments' lengths.
length :: Polyarc -> Mm
length = total . map Segment.length . NonEmpty.toList . segments

-- | The polyarc in the opposite direction. A closed one keeps its start point.
reverse :: Polyarc -> Polyarc
reverse (Polyarc ends ss) = Polyarc ends (NonEmpty.reverse (fmap Segment.reverse ss))

-- | All pairs of consecutive segments in order, each with the index of its first segment from 0.
-- For a closed polyarc the last pair is the last segment and the first.
neighbours :: Polyarc -> [(Int, Segment, Segment)]
neighbours (Polyarc ends ss) = zip3 [0 ..] list (drop 1 list <> closing)
  where
    list = NonEmpty.toList ss
    closing = case ends of
      Open -> []
      Closed -> [NonEmpty.head ss]

-- | Closes the gaps that rounding leaves between the segments of a polyarc. The polyarc is given as
-- a list of things that contain one segment each, such as the elements of a contour. @get@ reads
-- the segment of a thing, and @set@ replaces it.
--
-- Each segment is made to start exactly at the end of the previous one. The last segment of a
-- closed polyarc is made to end at the start of the first.
closeGaps :: (a -> Segment) -> (Segment -> a -> a) -> Ends -> NonEmpty a -> NonEmpty a
closeGaps get set ends (first :| rest) = case rest of
  [] -> (case ends of Open -> first; Closed -> set (closing (get first)) first) :| []
  _ -> first :| follow (end (get first)) rest
  where
    follow from things = case things of
      [] -> []
      [a] ->
        let s = (get a) {start = from}
         in [set (case ends of Open -> s; Closed -> closing s) a]
      a : more
        | isAt from (start (get a)) -> a : follow (end (get a)) more
        | otherwise ->
          let s = (get a) {start = from}
              a' = set s a
           in a' `seq` (a' : follow (end s) more)
    -- 0 and −0 are equal but print differently, so a point with a zero coordinate is always
    -- replaced.
    isAt p q = p == q && Vec.x p /= 0 && Vec.y p /= 0
    closing s = s {end = start (get first)}
{-# INLINE closeGaps #-}

-- | The area that a closed polyarc encloses, in mm²; positive when it is counter-clockwise.
signedArea :: Polyarc -> Double
signedArea (Polyarc _ ss) = areaOf id ss

-- | The area that a closed polyarc encloses, in mm²; positive when it is counter-clockwise. The
-- polyarc is given as a list of things that contain one segment each; @get@ reads the segment.
--
-- The area is a sum over the segments. Each contributes the signed area of a triangle: its corners
-- are the polyarc's start point and the segment's ends (shoelace formula). An arc of radius r and
-- sweep φ also contributes the region between arc and chord, with the area @r²·(φ − sin φ)/2@. For
-- a flat arc this loses digits, so the first terms of its power series take its place.
areaOf :: (a -> Segment) -> NonEmpty a -> Double
areaOf get (first :| others) = go 0 first others
  where
    go area a rest = case rest of
      [] -> area + part (get a)
      b : more -> let area' = area + part (get a) in area' `seq` go area' b more
    origin = Segment.start (get first)
    part segment = triangle segment + circularSegment segment
    triangle s = Vec.cross (Vec.to origin (Segment.start s)) (Vec.to origin (Segment.end s)) / 2
    circularSegment s = case s of
      Straight _ _ -> 0
      Arc {start, centre, sweep = Rad a} ->
        let v = Vec.to centre start
            beyond = if abs a < 1e-3 then a * a * a / 6 * (1 - a * a / 20) else a - sin a
         in Vec.dot v v * beyond / 2
{-# INLINE areaOf #-}

-- | The first moment of the area that a closed polyarc encloses, about the point @o@, in mm³: the
-- area times the vector from @o@ to the centre of gravity. It has the sign of 'signedArea'.
--
-- Each segment contributes a triangle with the corner @o@, and an arc also the region between
-- itself and its chord. The centre of gravity of this region lies @4·r·sin³(φ\/2) \/ 3·(φ − sin φ)@
-- from the arc's centre. Of a flat arc it lies two fifths of the sagitta from the chord, as in a
-- parabola, and the area is two thirds of chord times sagitta.
firstMoment :: Point -> Polyarc -> Vec
firstMoment o (Polyarc _ ss) = foldr (Vec.add . moment) (Vec.vec 0 0) (NonEmpty.toList ss)
  where
    moment s = Vec.add (triangle (start s) (end s)) (beyondChord s)
    triangle a b =
      let (u, v) = (Vec.to o a, Vec.to o b)
       in Vec.scale (Vec.cross u v / 6) (Vec.add u v)
    beyondChord s = case s of
      Straight _ _ -> Vec.vec 0 0
      Arc {start = a, end = b, centre, sweep = Rad w}
        | abs w < 1e-3 ->
          let chord = Vec.to a b
              out = Vec.scale (Segment.bulge s / 2) (Vec.negate (Vec.left chord))
              from = Vec.add (Vec.to o (Vec.interpolate 0.5 a b)) (Vec.scale 0.4 out)
           in Vec.scale (2 / 3 * Vec.cross out chord) from
        | otherwise ->
          let Mm r = Segment.radius centre a
              h = abs w / 2
              q = 4 * r * sin h ^ (3 :: Int) / (3 * (abs w - sin (abs w)))
              middle = Vec.rotate (Rad (w / 2)) (Vec.to centre a)
              from = Vec.add (Vec.to o centre) (Vec.scale (q / r) middle)
           in Vec.scale (r * r * (w - sin w) / 2) from
