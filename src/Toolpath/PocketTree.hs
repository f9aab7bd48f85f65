-- | The loops of a pocket as a tree. A node is a /region/: a connected area in which the cutter's
-- centre has at least a given distance from the walls. The children of a node are the regions
-- inside that region, at the next larger distance. Here a /pass/ consists of all loops at one
-- distance. A /detour/ is a path from a loop and back to it, which clears residue between two
-- passes ("Toolpath.StepoverResidue").
module Toolpath.PocketTree
  ( Loop,
    PocketTree (..),
    Ring (..),
    RingSegment (..),
    passTrees,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.List (partition, sort, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Ord (Down (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (Closed), Polyarc (Polyarc))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Toolpath.StepoverResidue qualified as StepoverResidue

-- | A closed chain of segments with the free space on their left.
type Loop = NonEmpty Segment

-- | One region of a pocket, with the regions inside it.
data PocketTree = PocketTree
  { -- | loops that bound the region: the outer one, and those round islands
    rings :: NonEmpty Ring,
    -- | regions inside this region, at the next larger distance from the walls. Residue that
    -- no detour clears has a loop, and so a region, of its own
    inner :: [PocketTree]
  }

-- | A loop with its detours. @wallDistance@ is the distance of the loop from the walls.
data Ring = Ring {wallDistance :: Mm, ringSegments :: NonEmpty RingSegment}

-- | A segment of a loop, and the detours that begin and end at the end of the segment.
data RingSegment = RingSegment {segment :: Segment, detours :: [NonEmpty Segment]}

-- | The trees of the passes at the increasing @distances@ from the walls, up to the first distance
-- without loops. @offsetBy@ gives the loops at a distance from the walls. @further@ gives the loops
-- at a distance inside other loops, or Nothing when they have to be computed from the walls. Where
-- two distances differ by more than the cutter's @radius@, detours clear the residue between the
-- passes. Inside the pass at the last distance of the list, nothing is cleared. The result is
-- Nothing if all loops together have more than @most@ segments.
passTrees ::
  Int ->
  (Mm -> [Loop]) ->
  ([Loop] -> Mm -> Maybe [Loop]) ->
  Mm ->
  [Mm] ->
  Maybe [PocketTree]
passTrees most offsetBy further radius distances = case distances of
  [] -> Just []
  c : more -> from most c (offsetBy c) Map.empty more
  where
    from left c loops trips more
      | remaining < 0 = Nothing
      | otherwise = case (loops, more) of
        ([], _) -> Just []
        (_, []) -> Just (grouped c loops trips [])
        (_, next : others) -> do
          let loops' = inwards c loops (minus next c)
              residue = residueOf c loops next loops'
          inside <- from remaining next loops' (StepoverResidue.detours residue) others
          Just
            ( grouped
                c
                loops
                trips
                (inside <> map (leaf (plus c radius)) (StepoverResidue.isolated residue))
            )
      where
        remaining = left - sum (map NonEmpty.length loops)
    inwards c loops d = fromMaybe (offsetBy (plus c d)) (further loops d)
    residueOf c loops next loops'
      | minus next c <= plus radius Tolerance.coincident = StepoverResidue.none
      | otherwise =
        StepoverResidue.between radius (minus (minus next c) radius) (inwards c loops radius) loops'
    leaf c loop = PocketTree {rings = ring c Map.empty (0, loop) :| [], inner = []}

-- | The ring of @loop@, which has the number @n@ among the loops of its pass, from 0. @trips@ has
-- the detours of the pass. Their key is the number of a loop and, from 0, the number of the segment
-- at whose end the detours begin.
ring :: Mm -> Map (Int, Int) [NonEmpty Segment] -> (Int, Loop) -> Ring
ring wallDistance trips (n, loop) =
  Ring
    { wallDistance,
      ringSegments =
        NonEmpty.zipWith
          (\i s -> RingSegment s (Map.findWithDefault [] (n, i) trips))
          (0 :| [1 ..])
          loop
    }

-- | The regions at one distance @c@ from the walls. The @loops@ at that distance are grouped by the
-- regions that they bound. The regions @inside@, at the next distance, become children of the
-- regions that contain them. @trips@ has the detours from the @loops@, with the keys as in 'ring'.
grouped :: Mm -> [Loop] -> Map (Int, Int) [NonEmpty Segment] -> [PocketTree] -> [PocketTree]
grouped c loops trips inside = mapMaybe part (Map.toList members)
  where
    numbered = zip [0 ..] loops
    index =
      BoxTree.index
        (BoundingBox.ofSegment . snd)
        [(n, s) | (n, loop) <- numbered, s <- NonEmpty.toList loop]
    (outers, holes) = partition (isOuter . snd) numbered
    -- For the number of each loop, the number of the outer loop of the same region. Take a
    -- horizontal ray to the right from the rightmost point of a loop round an island. The ray
    -- crosses the region, and then meets another loop that bounds the region. That loop extends
    -- further to the right, so it was processed earlier: loops are processed from right to left.
    outer =
      foldl
        around
        (Map.fromList [(n, n) | (n, _) <- outers])
        (sortOn (Down . Vec.x . rightmost . snd) holes)
    around known (n, loop) =
      Map.insert n (maybe n (`among` known) (firstHit index (Just n) (rightmost loop))) known
    among n = fromMaybe n . Map.lookup n
    outerOf n = among n outer
    isOuter loop = Polyarc.signedArea (Polyarc Closed loop) > 0
    members = gathered [(outerOf n, (n, loop)) | (n, loop) <- numbered]
    innerOf =
      gathered
        [(maybe 0 outerOf (firstHit index Nothing (beginning tree)), tree) | tree <- inside]
    part (n, found) =
      ( \some ->
          PocketTree {rings = fmap (ring c trips) some, inner = Map.findWithDefault [] n innerOf}
      )
        <$> NonEmpty.nonEmpty found

-- | The values of each key, in their order.
gathered :: Ord k => [(k, a)] -> Map k [a]
gathered pairs = reverse <$> Map.fromListWith (<>) [(k, [a]) | (k, a) <- pairs]

-- | The first point of a region's first ring.
beginning :: PocketTree -> Point
beginning tree = Segment.start (segment (NonEmpty.head (ringSegments (NonEmpty.head (rings tree)))))

-- | The rightmost point of a loop.
rightmost :: Loop -> Point
rightmost loop =
  foldl
    (\p q -> if Vec.x q > Vec.x p then q else p)
    (start (NonEmpty.head loop))
    (concatMap points loop)
  where
    points s = case s of
      Straight a _ -> [a]
      Arc {start = a, centre} ->
        let Mm r = Segment.radius centre a
            furthest = Vec.shift (Vec.vec r 0) centre
         in a : [furthest | Segment.hasFootOf s furthest]

-- | The number of the first loop that a horizontal ray from the point @p@ to the right meets;
-- Nothing if it meets none. The loop with the number @own@ is ignored.
firstHit :: BoxTree (Int, Segment) -> Maybe Int -> Point -> Maybe Int
firstHit index own p = fst . snd <$> BoxTree.leastBy leftmost hit index
  where
    leftmost box
      | right box >= Vec.x p && bottom box <= Vec.y p + slack && top box >= Vec.y p - slack =
        Just (left box - slack)
      | otherwise = Nothing
    hit (n, s) = if Just n == own then Nothing else listToMaybe (sort (crossings p s))
    Mm slack = Tolerance.coincident

-- | The x coordinates, in mm, where a horizontal ray from the point @p@ to the right meets the
-- segment @s@, the ends of @s@ included.
crossings :: Point -> Segment -> [Double]
crossings p s = filter (>= Vec.x p) $ case s of
  Straight a b
    | Vec.y a == Vec.y b -> if Vec.y a == Vec.y p then [Vec.x a, Vec.x b] else []
    | min (Vec.y a) (Vec.y b) <= Vec.y p && Vec.y p <= max (Vec.y a) (Vec.y b) ->
      [Vec.x a + (Vec.x b - Vec.x a) * (Vec.y p - Vec.y a) / (Vec.y b - Vec.y a)]
    | otherwise -> []
  Arc {start = a, centre} ->
    let Mm r = Segment.radius centre a
        h = Vec.y p - Vec.y centre
        w = sqrt (max 0 (r * r - h * h))
     in [ x
          | x <- [Vec.x centre - w, Vec.x centre + w],
            Distance.toPoint (Vec.point x (Vec.y p)) s <= Tolerance.coincident
        ]
