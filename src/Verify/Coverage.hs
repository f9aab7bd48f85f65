-- | Directed Hausdorff distance from one segment to a set of /members/. The segment is an element
-- and the members are motions, or the other way round. Each point of the segment has a distance
-- from its nearest member; the Hausdorff distance is the largest of these distances. It is exact
-- over the whole segment, to 'Tolerance.resolution'. The computation is fast even for a set of many
-- short members.
--
-- A segment is covered at a distance if each of its points has a member within that distance. The
-- Hausdorff distance is the smallest distance at which the segment is covered; bisection finds it.
-- The /gap/ of a segment is its Hausdorff distance minus the allowed distance, called the reach.
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
    -- | paths of a member; it covers a point at some distance if all its paths are within that
    -- distance of the point
    pathsOf :: a -> NonEmpty Segment,
    -- | true of the eligible members, the only ones that may cover the segment. For an element of a
    -- contour these are the motions on the cutter's side of the element
    isEligible :: a -> Bool,
    -- | allowed distance: a point with a member within this distance has no gap
    reach :: Mm,
    -- | first size that is tried in the search for the gap of a segment; usually no gap is larger
    allowance :: Mm
  }

-- | Lower and upper bound of the directed Hausdorff distance, known without an exact comparison.
data DistanceBounds = DistanceBounds {atLeast :: Mm, atMost :: Mm}

-- | Size of a gap in mm, the point of the segment with this gap, and the members near the segment.
data Gap a = Gap {size :: Mm, location :: Point, members :: [a]}

-- | Gap of a segment, if it is larger than @least@; otherwise Nothing. The gap may be larger by
-- 'Tolerance.resolution'. Nothing also if no member lies within the reach plus 'unlimited', because
-- the result has to name a member. A gap that is larger than 'unlimited' gets the size 'unlimited'.
-- @known@ are bounds of the Hausdorff distance; they save exact comparisons.
largestGap :: Cover a -> Maybe DistanceBounds -> Mm -> Segment -> Maybe (Gap a)
largestGap cover known least segment
  | isClosedBy least = Nothing
  | otherwise = case dropWhile (not . isClosedBy) sizes of
    [] -> gapOf cover segment unlimited
    enough : _ ->
      let (low, high) = BinarySearch.bisect Tolerance.resolution (not . isClosedBy) least enough
       in (\gap -> gap {size = low}) <$> gapOf cover segment high
  where
    isClosedBy m = case known of
      Just DistanceBounds {atMost} | plus (reach cover) m > plus atMost touching -> True
      Just DistanceBounds {atLeast} | plus (reach cover) m < minus atLeast touching -> False
      _ -> isCovered cover (plus (reach cover) m) segment
    sizes = takeWhile (< unlimited) (iterate (times 2) (max (times 2 least) (allowance cover)))

-- | Gap of a known size, with the point of the segment at which it is. Nothing if no member is near
-- the segment.
gapOf :: Cover a -> Segment -> Mm -> Maybe (Gap a)
gapOf cover segment size = case membersNear cover (plus (reach cover) size) segment of
  [] -> Nothing
  members -> Just Gap {size, location = locationIn members, members}
  where
    justBelow = minus (plus (reach cover) size) (times 2 Tolerance.resolution)
    locationIn members = case uncovered justBelow (map (pathsOf cover) members) segment of
      (a, b) : _ -> Segment.at ((a + b) / 2) segment
      [] -> Segment.start segment

-- | Largest size of a gap. A gap that is larger gets this size.
unlimited :: Mm
unlimited = Mm 1e7

-- | Uncertainty of a distance. Two circles may count as touching if their gap is at most this wide.
touching :: Mm
touching = times 3 Tolerance.coincident

-- | Members for which 'isEligible' is true and which are within a distance of a segment, and
-- perhaps some eligible ones that are further away.
membersNear :: Cover a -> Mm -> Segment -> [a]
membersNear cover distance segment =
  filter (isEligible cover) (filter mayReach (BoxTree.within around (index cover)))
  where
    around = BoundingBox.inflate distance (BoundingBox.ofSegment segment)
    -- No point of a segment is further from its middle than half of its length.
    mayReach a =
      distanceTo (Segment.at 0.5 segment) (pathsOf cover a)
        <= plus distance (times 0.5 (Segment.length segment))

-- | Test that each point of a segment has a member within a distance. If at most 'fewAtMost'
-- members are near the segment, all of them are examined together. Otherwise they are examined one
-- by one, from the start of the segment: the next is the member nearest to the point up to which
-- the segment is already covered.
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

-- | Distance from a point to that one of the paths which is furthest from the point.
distanceTo :: Point -> NonEmpty Segment -> Mm
distanceTo p = maximum . fmap (Distance.toPoint p)

-- | Parts of a segment that no member covers at the given distance. A part is given by its
-- beginning and end, as fractions of the segment's length from 0 to 1. A member is given by its
-- paths.
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

-- | Largest number of members that 'isCovered' examines together.
fewAtMost :: Int
fewAtMost = 30
