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
  )
where

import Base.Quantity (Mm (..), Rad (..), total)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
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
-- sweep φ also contributes the region between arc and chord, with the area @r²·(φ − sin φ)/2@.
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
        let v = Vec.to centre start in Vec.dot v v * (a - sin a) / 2
{-# INLINE areaOf #-}
