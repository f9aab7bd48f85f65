-- | Finds the first self-intersection of a polyarc, such as a contour of the part. A contour that
-- intersects itself is a mistake of the user, and the report names this point.
--
-- Neighbours are two consecutive segments, which join at a common end, their joint. For segments
-- that are not neighbours, the bounding-box tree of the offset kernel finds the pairs that may
-- meet. 'Distance.intersections' finds the points at which the segments of a pair do meet.
--
-- Offsets intersect themselves before they are trimmed, but that is no mistake of the user:
-- "Offset.SelfIntersection" finds those intersections.
module Geometry.SelfIntersection
  ( firstSelfIntersection,
    firstSelfIntersectionBy,
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
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Geometry.Polyarc (Ends (..), Polyarc (Polyarc))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The first self-intersection of a polyarc; nothing if it has none. The result has the indices,
-- from 0, of two segments that cross or touch elsewhere than at a common joint, and then the point
-- at which they do. If there are several such pairs, it is the one with the least first index, and
-- among equal first indices the one with the least second index.
firstSelfIntersection :: Polyarc -> Maybe (Int, Int, Point)
firstSelfIntersection (Polyarc ends ss) = firstSelfIntersectionBy id ends ss

-- | 'firstSelfIntersection' for a list of things, each of which contains a segment; @get@ reads it.
firstSelfIntersectionBy :: (a -> Segment) -> Ends -> NonEmpty a -> Maybe (Int, Int, Point)
firstSelfIntersectionBy get ends things =
  case concatMap found (neighbours chain <> closeBy chain) of
    [] -> Nothing
    ps -> Just (minimumBy (comparing (\(i, j, _) -> (i, j))) ps)
  where
    chain = Chain {ends, segments = Vector.unfoldrN (NonEmpty.length things) next list}
    list = NonEmpty.toList things
    next rest = case rest of
      [] -> Nothing
      a : more -> let s = get a in s `seq` Just (s, more)
    found (i, j) = [(i, j, p) | p <- crossingsOf chain i j]

-- | The segments of a polyarc in a vector, for access by index.
data Chain = Chain {ends :: Ends, segments :: Vector Segment}

-- | The number of segments of a chain.
count :: Chain -> Int
count = Vector.length . segments

-- | True when @i@ and @j@ are the indices of the first and the last segment of a closed polyarc.
-- These two segments join at the polyarc's start.
isClosingPair :: Chain -> Int -> Int -> Bool
isClosingPair chain i j = ends chain == Closed && i == 0 && j == count chain - 1

-- | The pairs of indices of neighbouring segments that may meet elsewhere than at their joint. A
-- quick test excludes most pairs that meet only at their joint. So the slower 'crossingsOf' need
-- not examine these pairs.
neighbours :: Chain -> [(Int, Int)]
neighbours chain = go 0
  where
    go i
      | i + 1 < count chain =
        let (s, next) = (segments chain Vector.! i, segments chain Vector.! (i + 1))
            meetOnce = goesStraightOn s next || meetAtCorner s next
         in if meetOnce then go (i + 1) else (i, i + 1) : go (i + 1)
      | otherwise = [(0, count chain - 1) | ends chain == Closed, count chain > 2]

-- | The points at which the segments with the indices @i@ and @j@ meet, other than their common
-- joints; @i@ is less than @j@.
crossingsOf :: Chain -> Int -> Int -> [Point]
crossingsOf chain i j
  | closes && goesStraightOn other s = []
  | not (BoundingBox.meets (BoundingBox.ofSegment s) (BoundingBox.ofSegment other)) = []
  | null joints = crossings
  | otherwise = retraced s other <> filter (\q -> not (any (Vec.isNear q) joints)) crossings
  where
    s = segments chain Vector.! i
    other = segments chain Vector.! j
    crossings = Distance.intersections s other
    closes = j /= i + 1 && isClosingPair chain i j
    joints = [Segment.end s | j == i + 1] <> [Segment.start s | isClosingPair chain i j]

-- | The indices of the pairs of segments that are not neighbours but may meet. The bounding boxes
-- of such a pair, enlarged by a small margin, overlap.
closeBy :: Chain -> [(Int, Int)]
closeBy chain
  | ClosedPolyarcs.loopCount loops == 0 = []
  | otherwise = runST $ do
    pairs <- newSTRef []
    SegmentBoxTree.pairs tree (pure True) $ \a b -> do
      let (i, j) = (number a, number b)
      when (i >= 0 && j > i + 1 && j < count chain && not (isClosingPair chain i j)) $
        modifySTRef' pairs ((i, j) :)
    readSTRef pairs
  where
    (flat, numbers) = FlatPolyarc.fromSegments (ends chain) (segments chain)
    loops = ClosedPolyarcs.fromFlatPolyarcs 0 [flat]
    Mm margin = times 2 Tolerance.coincident
    tree = SegmentBoxTree.build margin loops
    -- The index, in @chain@, of the segment that starts at the vertex @k@ of @loops@. It is −1 for
    -- the segment that closes an open polyarc, which @chain@ lacks.
    number k =
      let i = fromIntegral (indexPrimArray (ClosedPolyarcs.sources loops) k)
       in if i < sizeofPrimArray numbers then indexPrimArray numbers i else -1

-- | True when two neighbours sweep at most 1 radian each and their directions at the joint differ
-- by at most 0.1 radian. The first then lies in a cone before the joint and the second in the
-- opposite cone, so they meet only at the joint.
goesStraightOn :: Segment -> Segment -> Bool
goesStraightOn a b =
  sweepsLittle a && sweepsLittle b && abs (Vec.cross u v) <= steepness * Vec.dot u v
  where
    -- The lengths of these directions are arbitrary; only the angle between them matters.
    u = case a of
      Straight p q -> Vec.to p q
      Arc {end, centre, sweep = Rad t} -> Vec.scale (signum t) (Vec.left (Vec.to centre end))
    v = case b of
      Straight p q -> Vec.to p q
      Arc {start, centre, sweep = Rad t} -> Vec.scale (signum t) (Vec.left (Vec.to centre start))
    sweepsLittle s = case s of
      Straight _ _ -> True
      Arc {sweep = Rad t} -> abs t <= 1

-- | True when two neighbours are lines, each more than 100 times as long as 'Tolerance.coincident',
-- and the second line does not run back along the first. Such lines meet only at their joint.
meetAtCorner :: Segment -> Segment -> Bool
meetAtCorner a b = case (a, b) of
  (Straight p q, Straight _ r)
    | u <- Vec.to p q,
      v <- Vec.to q r ->
      isLong u && isLong v && abs (Vec.cross u v) > -(steepness * Vec.dot u v)
  _ -> False
  where
    isLong v = Vec.norm v > 100 * (let Mm least = Tolerance.coincident in least)

-- | The tangent of 0.1 rad. In 'goesStraightOn' it bounds the angle between two directions. In
-- 'meetAtCorner' it bounds the angle by which two directions differ from exactly opposite ones.
steepness :: Double
steepness = 0.10033467208545055

-- | The middle of the shorter of two neighbours, if it lies on the longer one. In this case one of
-- them runs back along the other, and the middle counts as a self-intersection.
retraced :: Segment -> Segment -> [Point]
retraced s other = [middle | Distance.toPoint middle longer <= Tolerance.coincident]
  where
    (shorter, longer) = if Segment.length s <= Segment.length other then (s, other) else (other, s)
    middle = Segment.at 0.5 shorter
