-- | Chains of straight lines and arcs that are walked as one thing: what stands for a curve.
--
-- A place on a chain is its distance from the beginning along the chain, in mm.
module Geometry.MeasuredPolyarc
  ( Polyarc,
    fromSegments,
    fromOutline,
    segments,
    count,
    start,
    end,
    length,
    isClosed,
    joints,
    at,
    directionAt,
    station,
    stretch,
    meetings,
    gap,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..), Rad (..), plus)
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
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Prelude hiding (length)

-- | Segments with a length, each of which ends where the next begins, and the places where they
-- begin.
data Polyarc = Polyarc {chain :: Vector Segment, stations :: ~(Unboxed.Vector Double)}
  deriving stock (Eq, Show)

fromSegments :: NonEmpty Segment -> Polyarc
fromSegments ss = ofChain (Vector.fromList (NonEmpty.toList ss))

ofChain :: Vector Segment -> Polyarc
ofChain chain =
  Polyarc
    { chain,
      stations =
        Unboxed.scanl'
          (+)
          0
          (Unboxed.convert (Vector.map (\g -> let Mm l = Segment.length g in l) chain))
    }

-- | An open outline with two vertices at least.
fromOutline :: FlatPolyarc -> Polyarc
fromOutline o = ofChain (Vector.unfoldrN (n - 1) segment (0, place 0))
  where
    n = FlatPolyarc.size o + 1
    place i =
      Vec.point
        (PrimArray.indexPrimArray (FlatPolyarc.xs o) i)
        (PrimArray.indexPrimArray (FlatPolyarc.ys o) i)
    -- Neighbours share their points.
    segment (i, p)
      | i + 1 >= n = Nothing
      | otherwise =
        let q = place (i + 1)
            s = bent p q (PrimArray.indexPrimArray (FlatPolyarc.bulges o) i)
         in s `seq` Just (s, (i + 1, q))

-- | A line, or the arc of a bulge.
bent :: Point -> Point -> Double -> Segment
bent p q b
  | b == 0 = Straight p q
  | otherwise =
    Arc
      { Segment.start = p,
        Segment.end = q,
        Segment.centre =
          Vec.shift
            (Vec.scale ((1 - b * b) / (4 * b)) (Vec.left (Vec.to p q)))
            (Vec.between 0.5 p q),
        Segment.sweep = Rad (4 * atan b)
      }

-- | In the order of the walk.
segments :: Polyarc -> NonEmpty Segment
segments p = Vector.head (chain p) :| drop 1 (Vector.toList (chain p))

-- | How many segments there are.
count :: Polyarc -> Int
count = Vector.length . chain

start :: Polyarc -> Point
start = Segment.start . Vector.head . chain

end :: Polyarc -> Point
end = Segment.end . Vector.last . chain

length :: Polyarc -> Mm
length = Mm . Unboxed.last . stations

-- | The places at which its segments begin, and its end; in mm.
joints :: Polyarc -> [Double]
joints = Unboxed.toList . stations

-- | Whether it ends where it begins.
isClosed :: Polyarc -> Bool
isClosed p = Vec.near (start p) (end p)

-- | The segment that holds a place, and the fraction of its length there.
locate :: Polyarc -> Mm -> (Int, Double)
locate p (Mm s) = (i, if l <= 0 then 0 else max 0 (min 1 ((s - stations p Unboxed.! i) / l)))
  where
    i = BinarySearch.lastBelow (Vector.length (chain p)) s (stations p)
    l = stations p Unboxed.! (i + 1) - stations p Unboxed.! i

-- | The point at a place; at the nearer end for a place outside.
at :: Polyarc -> Mm -> Point
at p s = let (i, t) = locate p s in Segment.at t (chain p Vector.! i)

-- | The direction of the walk at a place, of length 1.
directionAt :: Polyarc -> Mm -> Vec
directionAt p s = let (i, t) = locate p s in Segment.directionAt t (chain p Vector.! i)

-- | The place nearest to a point. Linear in the number of segments.
station :: Polyarc -> Point -> Mm
station p q = Mm (stations p Unboxed.! best + max 0 (min 1 along) * l)
  where
    best =
      fst
        ( minimumBy
            (comparing snd)
            [(i, Distance.toPoint q s) | (i, s) <- Vector.toList (Vector.indexed (chain p))]
        )
    s' = chain p Vector.! best
    Mm l = Segment.length s'
    along
      | Segment.spans s' q = Segment.fraction s' q
      | Vec.distance q (Segment.start s') <= Vec.distance q (Segment.end s') = 0
      | otherwise = 1

-- | The segments from one place to a later one. What is shorter than a point at either end is left
-- out.
stretch :: Polyarc -> Mm -> Mm -> [Segment]
stretch p a b =
  [ piece i
    | i <- [i1 .. i2],
      let Mm l = Segment.length (piece i),
      Mm l > Tolerance.coincident || i1 == i2 && l > 0
  ]
  where
    (i1, t1) = locate p a
    (i2, t2) = locate p b
    piece i =
      let s = chain p Vector.! i
          front = if i == i2 && t2 < 1 then fst (Segment.cutAt t2 s) else s
       in if i == i1 && t1 > 0
            then snd (Segment.cutAt (t1 / (if i == i2 && t2 < 1 then t2 else 1)) front)
            else front

-- | The points that two chains have in common, in the order of the first one. Chains that stand for
-- curves touch when they come as near as both are off; where they touch they may cross twice, and
-- that is one point.
meetings :: NonEmpty Segment -> NonEmpty Segment -> [Point]
meetings a b = case touching (crossings a b) of
  [] | closest <- nearest a b, distance closest <= slack -> [place closest]
  ps -> ps
  where
    slack = plus Tolerance.curve Tolerance.curve
    whole = fromSegments a
    touching ps = case ps of
      p : q : rest
        | toOther middle <= slack && Vec.distance p q < touch -> touching (middle : rest)
        where
          middle =
            at whole (let (Mm s, Mm t) = (station whole p, station whole q) in Mm ((s + t) / 2))
      p : rest -> p : touching rest
      [] -> []
    toOther p = minimum [Distance.toPoint p g | g <- NonEmpty.toList b]
    -- Curves that run along one another for longer do not just touch.
    touch = Mm 0.5

-- | The points where two chains cross, in the order of the first one.
crossings :: NonEmpty Segment -> NonEmpty Segment -> [Point]
crossings a b =
  apart
    (concatMap (\s -> concatMap (inOrder s . Distance.crossings s) (others s)) (NonEmpty.toList a))
  where
    index = BoundingBox.index BoundingBox.ofSegment (NonEmpty.toList b)
    others s =
      BoundingBox.within (BoundingBox.inflate Tolerance.coincident (BoundingBox.ofSegment s)) index
    inOrder s ps = map snd (nubOrd [(Segment.fraction s p, p) | p <- ps])
    -- Where segments join, both of them have the point; near such a place it may be twice with a
    -- small error.
    apart ps = case ps of
      [] -> []
      p : rest ->
        p :
        apart
          (filter (\q -> Vec.distance p q > plus Tolerance.coincident Tolerance.coincident) rest)

-- | The least distance of two chains.
gap :: NonEmpty Segment -> NonEmpty Segment -> Mm
gap a b = distance (nearest a b)

-- | Where two chains come nearest to one another.
nearest :: NonEmpty Segment -> NonEmpty Segment -> ClosestPoint
nearest a b =
  fromMaybe
    (Distance.segments (NonEmpty.head a) (NonEmpty.head b))
    (BoundingBox.closest Distance.segments distance (indexOf a) (indexOf b))
  where
    indexOf = BoundingBox.index BoundingBox.ofSegment . NonEmpty.toList
