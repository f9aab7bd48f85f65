-- | Directed Hausdorff distance from one segment to a set of others: from an element to the
-- motions, or from a motion to the elements. It is the distance of that point of the segment which
-- is furthest from all members of the set. It is exact over the whole segment, to
-- 'Tolerance.resolution', and fast if the set has many short members.
--
-- A segment is covered at a distance if each of its points has a member within that distance. The
-- Hausdorff distance is the smallest distance at which it is covered; bisection finds it. The /gap/
-- of a segment is its Hausdorff distance minus the distance that is allowed, the reach.
module Verify.Coverage
  ( Cover (..),
    DistanceBounds (..),
    Gap (..),
    largestGap,
    distanceTo,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..), minus, plus, times)
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Offset.Tolerance qualified as Tolerance

-- | Set of members that may cover a segment.
data Cover a = Cover
  { index :: BoxTree a,
    -- | paths of a member: a point is covered if all of them are within the distance
    pathsOf :: a -> NonEmpty Segment,
    -- | members that count
    isEligible :: a -> Bool,
    -- | distance at which a point is covered
    reach :: Mm,
    -- | allowed excess over the reach, with which the search for the largest gap begins
    allowance :: Mm
  }

-- | Bounds of the directed Hausdorff distance that are known without an exact comparison.
data DistanceBounds = DistanceBounds {atLeast :: Mm, atMost :: Mm}

-- | Size of a gap in mm, a point of the segment that has it, and the members near the segment.
data Gap a = Gap {size :: Mm, location :: Point, members :: [a]}

-- | Largest gap of a segment, if it is larger than @least@. A gap that is larger than 'unlimited'
-- gets that size.
largestGap :: Cover a -> Maybe DistanceBounds -> Mm -> Segment -> Maybe (Gap a)
largestGap cover known least segment
  | isClosedBy least = Nothing
  | otherwise = case dropWhile (not . isClosedBy) sizes of
    [] -> gapOf cover segment unlimited
    enough : _ ->
      gapOf
        cover
        segment
        (snd (BinarySearch.bisect Tolerance.resolution (not . isClosedBy) least enough))
  where
    isClosedBy m = case known of
      Just DistanceBounds {atMost} | plus (reach cover) m > plus atMost touching -> True
      Just DistanceBounds {atLeast} | plus (reach cover) m < minus atLeast touching -> False
      _ -> isCovered cover (plus (reach cover) m) segment
    sizes = takeWhile (< unlimited) (iterate (times 2) (max (times 2 least) (allowance cover)))

-- | Gap of a known size, with a point of the segment that has it. Nothing without members near the
-- segment.
gapOf :: Cover a -> Segment -> Mm -> Maybe (Gap a)
gapOf cover segment size = case membersNear cover (plus (reach cover) size) segment of
  [] -> Nothing
  members -> Just Gap {size, location = locationIn members, members}
  where
    justBelow = minus (plus (reach cover) size) (times 2 Tolerance.resolution)
    locationIn members = case uncovered justBelow (map (pathsOf cover) members) segment of
      (a, b) : _ -> Segment.at ((a + b) / 2) segment
      [] -> Segment.start segment

-- | Size of a gap that counts as infinite: nothing is cut there at all.
unlimited :: Mm
unlimited = Mm 1e7

-- | Two circles that miss one another by no more than this may count as touching.
touching :: Mm
touching = times 3 Tolerance.coincident

-- | Eligible members that have a point of a segment within a distance.
membersNear :: Cover a -> Mm -> Segment -> [a]
membersNear cover distance segment =
  filter (isEligible cover) (filter mayReach (BoxTree.within around (index cover)))
  where
    around = BoundingBox.inflate distance (BoundingBox.ofSegment segment)
    -- No point of a segment is further from its middle than half of its length.
    mayReach a =
      distanceTo (Segment.at 0.5 segment) (pathsOf cover a)
        <= plus distance (times 0.5 (Segment.length segment))

-- | Test that each point of a segment has a member within a distance. Many members are taken one
-- after the other: the member that is nearest to the end of the covered stretch covers the next
-- one.
isCovered :: Cover a -> Mm -> Segment -> Bool
isCovered cover distance segment
  | null (drop fewAtMost near) = together
  | otherwise = from 0
  where
    near = map (pathsOf cover) (membersNear cover distance segment)
    together = null (uncovered distance near segment)
    from t = case nearestAt t of
      Nothing -> False
      Just other -> case filter ((> t) . snd) (uncovered distance [pathsOf cover other] segment) of
        [] -> True
        (a, _) : _
          | a > t + Tolerance.negligibleShare -> from a
          -- The nearest member covers nothing after this point, but another one may do so.
          | otherwise ->
            maybe False (const together) (nearestAt (min 1 (t + Tolerance.negligibleShare)))
    nearestAt t =
      let p = Segment.at t segment
       in case BoxTree.closest (distanceFrom p) p (index cover) of
            Just (d, other) | d <= distance -> Just other
            _ -> Nothing
    distanceFrom p other =
      let d = distanceTo p (pathsOf cover other)
       in if d > distance || isEligible cover other then d else Mm (1 / 0)

-- | Distance from a point to the furthest of some paths.
distanceTo :: Point -> NonEmpty Segment -> Mm
distanceTo p = maximum . fmap (Distance.toPoint p)

-- | Stretches of a segment, as fractions of its length, at which no member has all of its paths
-- within a distance.
uncovered :: Mm -> [NonEmpty Segment] -> Segment -> [(Double, Double)]
uncovered distance members segment =
  foldl
    intersection
    (Distance.uncovered distance [s | s :| [] <- members] segment)
    [gaps paths | paths@(_ :| _ : _) <- members]
  where
    gaps paths =
      union
        (sort (concatMap (\s -> Distance.uncovered distance [s] segment) (NonEmpty.toList paths)))

-- | Intersection of two sets of intervals, each sorted and without overlaps.
intersection :: [(Double, Double)] -> [(Double, Double)] -> [(Double, Double)]
intersection as bs = case (as, bs) of
  ((a, b) : as', (c, d) : bs') ->
    [(max a c, min b d) | max a c < min b d]
      <> if b <= d then intersection as' bs else intersection as bs'
  _ -> []

-- | Union of intervals that are sorted by their beginnings.
union :: [(Double, Double)] -> [(Double, Double)]
union intervals = case intervals of
  (a, b) : (c, d) : rest | c <= b -> union ((a, max b d) : rest)
  s : rest -> s : union rest
  [] -> []

-- | Number of members up to which 'isCovered' takes all of them together.
fewAtMost :: Int
fewAtMost = 30
