-- | Contours: chains of segments, open or closed, each ending where the next begins.
module Geometry.Polyarc
  ( Polyarc (..),
    Ends (..),
    length,
    reverse,
    joints,
    chained,
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

-- | Whether the last segment ends where the first begins.
data Ends = Open | Closed
  deriving stock (Eq, Show)

-- | Segments in the order of the walk.
data Polyarc = Polyarc {ends :: Ends, segments :: NonEmpty Segment}
  deriving stock (Eq, Show)

length :: Polyarc -> Mm
length = total . map Segment.length . NonEmpty.toList . segments

-- | The same contour walked the other way; a closed one begins at the same point.
reverse :: Polyarc -> Polyarc
reverse (Polyarc ends ss) = Polyarc ends (NonEmpty.reverse (fmap Segment.reverse ss))

-- | Neighbouring segments in order, with the number of the first from 0.
joints :: Polyarc -> [(Int, Segment, Segment)]
joints (Polyarc ends ss) = zip3 [0 ..] list (drop 1 list <> back)
  where
    list = NonEmpty.toList ss
    back = case ends of
      Open -> []
      Closed -> [NonEmpty.head ss]

-- | Let each segment begin exactly where the one before it ends, and a closed contour end where it
-- begins. The gaps are rounding errors.
chained :: (a -> Segment) -> (Segment -> a -> a) -> Ends -> NonEmpty a -> NonEmpty a
chained get set ends (first :| rest) = case rest of
  [] -> (case ends of Open -> first; Closed -> set (closing (get first)) first) :| []
  _ -> first :| follow (end (get first)) rest
  where
    follow from things = case things of
      [] -> []
      [a] ->
        [ set
            (case ends of Open -> (get a) {start = from}; Closed -> closing (get a) {start = from})
            a
        ]
      a : more
        | isAt from (start (get a)) -> a : follow (end (get a)) more
        | otherwise ->
          let s =
                (get a) {start = from}
              a' = set s a
           in a' `seq` (a' : follow (end s) more)
    -- Zeros of either sign are equal, but not the same.
    isAt p q = p == q && Vec.x p /= 0 && Vec.y p /= 0
    closing s = s {end = start (get first)}
{-# INLINE chained #-}

-- | The area that a closed contour encloses, in mm²; positive when it is walked counter-clockwise.
signedArea :: Polyarc -> Double
signedArea (Polyarc _ ss) = areaOf id ss

-- | The same of anything with segments.
areaOf :: (a -> Segment) -> NonEmpty a -> Double
areaOf get (first :| others) = go 0 first others
  where
    go area a rest = case rest of
      [] -> area + part (get a)
      b : more -> let area' = area + part (get a) in area' `seq` go area' b more
    origin = Segment.start (get first)
    part segment = triangle segment + sector segment
    triangle s = Vec.cross (Vec.to origin (Segment.start s)) (Vec.to origin (Segment.end s)) / 2
    -- The area between an arc and its chord.
    sector s = case s of
      Straight _ _ -> 0
      Arc {start, centre, sweep = Rad a} ->
        let v = Vec.to centre start in Vec.dot v v * (a - sin a) / 2
{-# INLINE areaOf #-}
