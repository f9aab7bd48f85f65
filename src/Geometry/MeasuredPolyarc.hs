-- | Polyarcs with a table of arc lengths: the chains of lines and arcs that represent curves.
--
-- A position on such a polyarc is given by its station: the distance from the start along the
-- polyarc, in mm. The table and an array of segments give the point at a station in logarithmic
-- time. A "Geometry.Polyarc", which is a list, would take linear time.
--
-- The module also computes intersections and distances of two polyarcs that are given as lists of
-- segments.
module Geometry.MeasuredPolyarc
  ( MeasuredPolyarc,
    fromSegments,
    fromFlatPolyarc,
    segments,
    count,
    start,
    end,
    length,
    isClosed,
    stations,

    -- * Stations
    at,
    directionAt,
    nearestStation,
    segmentsBetween,

    -- * Two polyarcs
    intersections,
    leastDistance,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..), plus, times)
import Data.Containers.ListUtils (nubOrd)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Ord (comparing)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Prelude hiding (length)

-- | A chain of at least one segment, each of which starts where the previous one ends; and a table
-- of stations in mm. The table contains the stations at which the segments start, then the station
-- of the polyarc's end. The table is computed when it is first needed.
data MeasuredPolyarc = MeasuredPolyarc {chain :: Vector Segment, table :: ~(Unboxed.Vector Double)}
  deriving stock (Eq, Show)

-- | The measured polyarc that consists of the segments @ss@ in their order.
fromSegments :: NonEmpty Segment -> MeasuredPolyarc
fromSegments ss = fromVector (Vector.fromList (NonEmpty.toList ss))

-- | The polyarc of a vector of at least one segment.
fromVector :: Vector Segment -> MeasuredPolyarc
fromVector chain = MeasuredPolyarc {chain, table = Unboxed.scanl' (+) 0 lengths}
  where
    lengths = Unboxed.convert (Vector.map (\s -> let Mm l = Segment.length s in l) chain)

-- | The measured polyarc of the open 'FlatPolyarc' @flat@, which has at least two vertices.
-- Consecutive segments share their common point in memory.
fromFlatPolyarc :: FlatPolyarc -> MeasuredPolyarc
fromFlatPolyarc flat = fromVector (Vector.unfoldrN (n - 1) segment (0, vertex 0))
  where
    n = FlatPolyarc.size flat + 1
    vertex i =
      Vec.point
        (PrimArray.indexPrimArray (FlatPolyarc.xs flat) i)
        (PrimArray.indexPrimArray (FlatPolyarc.ys flat) i)
    segment (i, p)
      | i + 1 >= n = Nothing
      | otherwise =
        let q = vertex (i + 1)
            s = Segment.fromBulge p q (PrimArray.indexPrimArray (FlatPolyarc.bulges flat) i)
         in s `seq` Just (s, (i + 1, q))

-- | The segments of a measured polyarc in order.
segments :: MeasuredPolyarc -> NonEmpty Segment
segments p = Vector.head (chain p) :| drop 1 (Vector.toList (chain p))

-- | The number of segments of a measured polyarc.
count :: MeasuredPolyarc -> Int
count = Vector.length . chain

-- | The first point of a measured polyarc.
start :: MeasuredPolyarc -> Point
start = Segment.start . Vector.head . chain

-- | The last point of a measured polyarc.
end :: MeasuredPolyarc -> Point
end = Segment.end . Vector.last . chain

-- | The length of a measured polyarc: the sum of its segments' lengths.
length :: MeasuredPolyarc -> Mm
length = Mm . Unboxed.last . table

-- | The stations, in mm, at which the segments of a measured polyarc start; then the station of its
-- end.
stations :: MeasuredPolyarc -> [Double]
stations = Unboxed.toList . table

-- | True when a measured polyarc ends where it starts, to 'Tolerance.coincident'.
isClosed :: MeasuredPolyarc -> Bool
isClosed p = Vec.isNear (start p) (end p)

-- | The index, from 0, of the segment that contains the station @s@; and the fraction of this
-- segment's length, from 0 to 1, at which the station lies. A station outside of the polyarc counts
-- as the nearer end.
locate :: MeasuredPolyarc -> Mm -> (Int, Double)
locate p (Mm s) = (i, if l <= 0 then 0 else max 0 (min 1 ((s - table p Unboxed.! i) / l)))
  where
    i = BinarySearch.lastAtMost (Vector.length (chain p)) s (table p)
    l = table p Unboxed.! (i + 1) - table p Unboxed.! i

-- | The point at the station @s@. A station outside of the polyarc gives the nearer end.
at :: MeasuredPolyarc -> Mm -> Point
at p s = let (i, t) = locate p s in Segment.at t (chain p Vector.! i)

-- | The direction of travel at the station @s@, of length 1. A station outside of the polyarc gives
-- the direction at the nearer end.
directionAt :: MeasuredPolyarc -> Mm -> Vec
directionAt p s = let (i, t) = locate p s in Segment.directionAt t (chain p Vector.! i)

-- | The station of the polyarc's point that is nearest to the point @q@. The time is linear in the
-- number of segments.
nearestStation :: MeasuredPolyarc -> Point -> Mm
nearestStation p q = Mm (table p Unboxed.! best + Distance.nearestFraction q segment * l)
  where
    best = fst (minimumBy (comparing snd) distances)
    distances = [(i, Distance.toPoint q s) | (i, s) <- Vector.toList (Vector.indexed (chain p))]
    segment = chain p Vector.! best
    Mm l = Segment.length segment

-- | The segments from the station @a@ to the later station @b@; the first and the last are cut at
-- these stations. Segments no longer than 'Tolerance.coincident' are omitted. When both stations
-- lie on one segment, the part between them is omitted only if its length is 0.
segmentsBetween :: MeasuredPolyarc -> Mm -> Mm -> [Segment]
segmentsBetween p a b =
  [ part i
    | i <- [i1 .. i2],
      let Mm l = Segment.length (part i),
      Mm l > Tolerance.coincident || i1 == i2 && l > 0
  ]
  where
    (i1, t1) = locate p a
    (i2, t2) = locate p b
    part i =
      let s = chain p Vector.! i
          front = if i == i2 && t2 < 1 then fst (Segment.cutAt t2 s) else s
       in if i == i1 && t1 > 0
            then snd (Segment.cutAt (t1 / (if i == i2 && t2 < 1 then t2 else 1)) front)
            else front

-- | The intersections of the polyarcs @a@ and @b@, in order along @a@.
--
-- A polyarc that represents a curve deviates from it by up to 'Tolerance.curve'. Two polyarcs that
-- do not meet therefore count as touching if their distance is at most twice this tolerance. The
-- result is then the point of @a@ that is nearest to @b@.
--
-- Two successive crossings less than 0.5 mm apart may be one touch of the curves. The point of @a@
-- midway between these crossings along @a@ replaces them, if its distance from @b@ is at most twice
-- 'Tolerance.curve'.
intersections :: NonEmpty Segment -> NonEmpty Segment -> [Point]
intersections a b = case mergeTouching (crossings a b) of
  [] | closest <- nearest a b, distance closest <= slack -> [nearestPoint closest]
  ps -> ps
  where
    slack = plus Tolerance.curve Tolerance.curve
    whole = fromSegments a
    mergeTouching ps = case ps of
      p : q : rest
        | middle <- midway p q,
          toOther middle <= slack && Vec.distance p q < longestTouch ->
          mergeTouching (middle : rest)
      p : rest -> p : mergeTouching rest
      [] -> []
    midway p q = at whole (times 0.5 (plus (nearestStation whole p) (nearestStation whole q)))
    toOther p = minimum [Distance.toPoint p g | g <- NonEmpty.toList b]
    -- Curves that stay together over a longer distance overlap; they do not merely touch.
    longestTouch = Mm 0.5

-- | The points at which the polyarcs @a@ and @b@ cross or touch, in order along @a@.
crossings :: NonEmpty Segment -> NonEmpty Segment -> [Point]
crossings a b =
  distinct
    ( concatMap
        (\s -> concatMap (inOrder s . Distance.intersections s) (closeTo s))
        (NonEmpty.toList a)
    )
  where
    tree = BoxTree.index BoundingBox.ofSegment (NonEmpty.toList b)
    closeTo s =
      BoxTree.within (BoundingBox.inflate Tolerance.coincident (BoundingBox.ofSegment s)) tree
    inOrder s ps = map snd (nubOrd [(Segment.fraction s p, p) | p <- ps])
    -- At a joint of two segments, a crossing is found twice, with different rounding errors.
    distinct ps = case ps of
      [] -> []
      p : rest -> p : distinct (filter (\q -> Vec.distance p q > sameWithin) rest)
    sameWithin = plus Tolerance.coincident Tolerance.coincident

-- | The least distance between two polyarcs.
leastDistance :: NonEmpty Segment -> NonEmpty Segment -> Mm
leastDistance a b = distance (nearest a b)

-- | The least distance between the polyarcs @a@ and @b@, and the point of @a@ at which it occurs.
nearest :: NonEmpty Segment -> NonEmpty Segment -> ClosestPoint
nearest a b =
  fromMaybe
    (Distance.segments (NonEmpty.head a) (NonEmpty.head b))
    (BoxTree.closestPair Distance.segments distance (treeOf a) (treeOf b))
  where
    treeOf = BoxTree.index BoundingBox.ofSegment . NonEmpty.toList
