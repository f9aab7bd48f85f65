-- | Where a contour crosses or touches itself.
module Geometry.SelfIntersection
  ( selfCrossing,
    crossingOf,
  )
where

import Base.Quantity (Mm (..), Rad (..), times)
import Control.Monad (when)
import Control.Monad.ST (runST)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Data.Primitive.PrimArray (indexPrimArray, sizeofPrimArray)
import Data.STRef (modifySTRef', newSTRef, readSTRef)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Distance qualified as Distance
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.SegmentTree qualified as SegmentTree
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The first two segments, by number, that cross or touch elsewhere than where they are joined.
selfCrossing :: Polyarc -> Maybe (Int, Int, Point)
selfCrossing (Polyarc ends ss) = crossingOf id ends ss

-- | The same of anything with segments.
crossingOf :: (a -> Segment) -> Ends -> NonEmpty a -> Maybe (Int, Int, Point)
crossingOf get ends things = case concatMap found (beside <> closeBy ends whole) of
  [] -> Nothing
  ps -> Just (minimumBy (comparing (\(i, j, _) -> (i, j))) ps)
  where
    count = NonEmpty.length things
    whole = Vector.unfoldrN count next (NonEmpty.toList things)
    next left = case left of
      [] -> Nothing
      a : rest -> let s = get a in s `seq` Just (s, rest)
    -- Neighbours, which are joined.
    beside = alongside 0
    alongside i
      | i + 1 < count =
        if straightOn (whole Vector.! i) (whole Vector.! (i + 1))
          || lineBends (whole Vector.! i) (whole Vector.! (i + 1))
          then alongside (i + 1)
          else (i, i + 1) : alongside (i + 1)
      | otherwise = [(0, count - 1) | ends == Closed, count > 2]
    found (i, j)
      | closes && straightOn other s = []
      | not (BoundingBox.meets (BoundingBox.ofSegment s) (BoundingBox.ofSegment other)) = []
      | otherwise =
        [ (i, j, p)
          | p <-
              if null shared
                then Distance.crossings s other
                else
                  retraced s other
                    <> filter (\q -> not (any (Vec.near q) shared)) (Distance.crossings s other)
        ]
      where
        s = whole Vector.! i
        other = whole Vector.! j
        closes = j /= i + 1 && ends == Closed && i == 0 && j == count - 1
        -- Where the two are joined: behind the first, or where the contour closes.
        shared =
          [Segment.end s | j == i + 1] <> [Segment.start s | ends == Closed, i == 0, j == count - 1]

-- | Segments of a contour that are no neighbours and lie so near to one another that they may
-- touch, by number.
closeBy :: Ends -> Vector Segment -> [(Int, Int)]
closeBy ends whole
  | ClosedPolyarcs.walks chain == 0 = []
  | otherwise = runST $ do
    pairs <- newSTRef []
    SegmentTree.pairs boxes (pure True) $ \a b -> do
      let (i, j) = (number a, number b)
      when (i >= 0 && j > i + 1 && j < count && not (ends == Closed && i == 0 && j == count - 1)) $
        modifySTRef' pairs ((i, j) :)
    readSTRef pairs
  where
    (outline, numbers) = FlatPolyarc.fromSegments ends whole
    pieces = sizeofPrimArray numbers
    count = Vector.length whole
    chain = ClosedPolyarcs.fromOutlines 0 [outline]
    Mm margin = times 2 Tolerance.coincident
    boxes = SegmentTree.boxes margin chain
    -- A chain always closes; what closes an open contour is no segment of it.
    number k =
      let i =
            fromIntegral (indexPrimArray (ClosedPolyarcs.sources chain) k)
       in if i < pieces then indexPrimArray numbers i else -1

-- | Whether of two neighbours that hardly turn the one lies in a cone behind their joint and the
-- other before it.
straightOn :: Segment -> Segment -> Bool
straightOn a b =
  hardlyTurns a
    && hardlyTurns b
    && (let (u, v) = (arriving, setting) in abs (Vec.cross u v) <= steepness * Vec.dot u v)
  where
    -- Directions, not of length 1.
    arriving = case a of
      Straight p q -> Vec.to p q
      Arc {end, centre, sweep = Rad t} -> Vec.scale (signum t) (Vec.left (Vec.to centre end))
    setting = case b of
      Straight p q -> Vec.to p q
      Arc {start, centre, sweep = Rad t} -> Vec.scale (signum t) (Vec.left (Vec.to centre start))
    hardlyTurns s = case s of
      Straight _ _ -> True
      Arc {sweep = Rad t} -> abs t <= 1

-- | Whether two neighbours are lines, not too short for it to be certain, of which the other does
-- not turn back along the one: they meet at their joint alone.
lineBends :: Segment -> Segment -> Bool
lineBends a b = case (a, b) of
  (Straight p q, Straight _ r)
    | u <- Vec.to p q,
      v <- Vec.to q r ->
      long u && long v && abs (Vec.cross u v) > -(steepness * Vec.dot u v)
  _ -> False
  where
    long v = Vec.norm v > 100 * (let Mm least = Tolerance.coincident in least)

-- | Of the cones: the tangent of 0.1.
steepness :: Double
steepness = 0.10033467208545055

-- | A neighbour that runs back along the way it came meets it at its middle.
retraced :: Segment -> Segment -> [Point]
retraced s other = [middle | Distance.toPoint middle longer <= Tolerance.coincident]
  where
    (shorter, longer) = if Segment.length s <= Segment.length other then (s, other) else (other, s)
    middle = Segment.at 0.5 shorter
