-- | Contours: chains of segments, open or closed, each ending where the next begins.
module Geometry.Contour
  ( Contour (..),
    Ends (..),
    length,
    reverse,
    joints,
    chained,
    signedArea,
    selfCrossing,
  )
where

import Base.Quantity (Mm (..), Rad (..), total)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Geometry.Box qualified as Box
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Prelude hiding (length, reverse)

-- | Whether the last segment ends where the first begins.
data Ends = Open | Closed
  deriving stock (Eq, Show)

-- | Segments in the order of the walk.
data Contour = Contour {ends :: Ends, segments :: NonEmpty Segment}
  deriving stock (Eq, Show)

length :: Contour -> Mm
length = total . map Segment.length . NonEmpty.toList . segments

-- | The same contour walked the other way; a closed one begins at the same point.
reverse :: Contour -> Contour
reverse (Contour ends ss) = Contour ends (NonEmpty.reverse (fmap Segment.reverse ss))

-- | Neighbouring segments in order, with the number of the first from 0.
joints :: Contour -> [(Int, Segment, Segment)]
joints (Contour ends ss) = zip3 [0 ..] list (drop 1 list <> back)
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
      [a] -> [set (case ends of Open -> (get a) {start = from}; Closed -> closing (get a) {start = from}) a]
      a : more -> let s = (get a) {start = from}; a' = set s a in a' `seq` (a' : follow (end s) more)
    closing s = s {end = start (get first)}
{-# INLINE chained #-}

-- | The area that a closed contour encloses, in mm²; positive when it is walked counter-clockwise.
signedArea :: Contour -> Double
signedArea (Contour _ ss@(first :| _)) = sum (fmap part ss)
  where
    origin = Segment.start first
    part segment = triangle segment + sector segment
    triangle s = Vec.cross (Vec.to origin (Segment.start s)) (Vec.to origin (Segment.end s)) / 2
    -- The area between an arc and its chord.
    sector s = case s of
      Straight _ _ -> 0
      Arc {start, centre, sweep = Rad a} ->
        let v = Vec.to centre start in Vec.dot v v * (a - sin a) / 2

-- | The first two segments, by number, that cross or touch elsewhere than where they are joined.
selfCrossing :: Contour -> Maybe (Int, Int, Point)
selfCrossing (Contour ends ss) = case concatMap crossings (Box.pairs index) of
  [] -> Nothing
  found -> Just (minimumBy (comparing (\(i, j, _) -> (i, j))) found)
  where
    count = NonEmpty.length ss
    index = Box.index (Box.ofSegment . snd) (zip [0 ..] (NonEmpty.toList ss))
    crossings ((i, s), (j, other))
      | j == i + 1 && straightOn s other = []
      | closes && straightOn other s = []
      | otherwise = [(i, j, p) | p <- if null shared then Distance.crossings s other else retraced s other <> filter (\q -> not (any (Vec.near q) shared)) (Distance.crossings s other)]
      where
        closes = j /= i + 1 && ends == Closed && i == 0 && j == count - 1
        -- Where the two are joined: behind the first, or where the contour closes.
        shared = [Segment.end s | j == i + 1] <> [Segment.start s | ends == Closed, i == 0, j == count - 1]
    -- Of two neighbours that hardly turn, the one lies in a cone behind their joint and the other before it.
    straightOn a b = hardlyTurns a && hardlyTurns b && (let (u, v) = (arriving a, setting b) in abs (Vec.cross u v) <= tan 0.1 * Vec.dot u v)
    -- Directions, not of length 1.
    arriving a = case a of
      Straight p q -> Vec.to p q
      Arc {end, centre, sweep = Rad t} -> Vec.scale (signum t) (Vec.left (Vec.to centre end))
    setting a = case a of
      Straight p q -> Vec.to p q
      Arc {start, centre, sweep = Rad t} -> Vec.scale (signum t) (Vec.left (Vec.to centre start))
    hardlyTurns a = case a of
      Straight _ _ -> True
      Arc {sweep = Rad t} -> abs t <= 1
    -- A neighbour that runs back along the way it came meets it at its middle.
    retraced s other =
      let shorter = if Segment.length s <= Segment.length other then s else other
          longer = if Segment.length s <= Segment.length other then other else s
          middle = Segment.at 0.5 shorter
       in [middle | Distance.toPoint middle longer <= Tolerance.coincident]
