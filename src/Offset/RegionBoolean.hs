-- | Boolean operations on regions that are bounded by lines and arcs.
--
-- A region is given by closed polyarcs that have it on their left and do not cross. So its winding
-- number is 1 inside and 0 outside. All polyarcs of all regions form one arrangement
-- ("Offset.Arrangement"), in which those of a region have the same weight. The weighted winding
-- number of a face then says which of the regions contain it, and the result is the boundary of the
-- faces that the operation keeps. Segments that touch or coincide are therefore decided as a whole,
-- around each node, and not pair by pair.
--
-- Lines stay lines and arcs keep their centres. Coordinates are in mm.
module Offset.RegionBoolean
  ( BooleanOperation (..),
    BooleanFault (..),
    ResultSegment (..),
    combine,
    oriented,
    nested,
  )
where

import Base.Quantity (Mm (..), Rad (..), total)
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (listToMaybe, mapMaybe)
import Data.Primitive.PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Offset.Arrangement (BoundaryEdge (alongSegment, begin, edgeBulge))
import Offset.Arrangement qualified as Arrangement
import Offset.Tolerance qualified as Tolerance

data BooleanOperation
  = -- | the points of at least one region
    Union
  | -- | the points of all regions
    Common
  | -- | the points of the first region that are in none of the others
    Difference
  deriving stock (Eq, Show, Enum, Bounded)

-- | A reason why an operation has no result.
data BooleanFault
  = -- | two segments of one polyarc cross; they are numbered from 0
    CrossesItself Int Int
  | -- | rounding decides: no tolerance gives winding numbers that agree
    Undecided
  deriving stock (Eq, Show)

-- | A segment of a result, a part of a segment of the operands.
data ResultSegment = ResultSegment
  { -- | the number of the operands' segment, from 0 through all polyarcs of all regions
    source :: Int,
    -- | false if the part runs against the direction of that segment
    isForward :: Bool,
    segment :: Segment
  }
  deriving stock (Eq, Show)

-- | The result of an operation: closed loops that have it on their left. No loop visits a point
-- twice.
combine :: BooleanOperation -> [[Polyarc]] -> Either BooleanFault [NonEmpty ResultSegment]
combine operation regions =
  maybe (Left Undecided) (Right . filter isWide . map loop) (firstJust attempt rounding)
  where
    loop = joined sources sourceOf
    -- Two lines that rounding has left apart enclose a sliver.
    isWide edges =
      let Mm l = total (map (Segment.length . segment) (NonEmpty.toList edges))
       in abs (Polyarc.areaOf segment edges) > sliver * rounding * l
    polyarcs = concat regions
    (flats, numbers) = unzip (map FlatPolyarc.fromPolyarc polyarcs)
    rounding = Tolerance.rounding * ClosedPolyarcs.largestCoordinate flats
    chain = ClosedPolyarcs.fromFlatPolyarcs rounding flats
    sources = Vector.fromList (concatMap (NonEmpty.toList . Polyarc.segments) polyarcs)
    firsts = scanl (+) 0 (map (NonEmpty.length . Polyarc.segments) polyarcs)
    -- The sources and the weights of the segments of the flat polyarcs.
    flatSources =
      primArrayFromList
        (concat (zipWith (\first ns -> map (+ first) (primArrayToList ns)) firsts numbers))
    flatWeights =
      primArrayFromList
        (concat (zipWith replicate (map FlatPolyarc.size flats) (concat regionWeights)))
    regionWeights = zipWith (\region w -> map (const w) region) regions weights
    (weights, isInside) = rule operation (length regions)
    flatOf i = fromIntegral (indexPrimArray (ClosedPolyarcs.sources chain) i)
    sourceOf = indexPrimArray flatSources . flatOf
    attempt t = do
      a <-
        Arrangement.arrangeWeighted
          (indexPrimArray flatWeights . flatOf)
          t
          chain
          (SegmentBoxTree.build t chain)
      Arrangement.boundary isInside a

-- | The width up to which a loop is a sliver, in units of the rounding error of a coordinate.
sliver :: Double
sliver = 50

-- | The first result, among the tolerances in mm that are tried one after the other. @rounding@ is
-- the largest error of a coordinate in mm. The last tolerance is 10⁻⁹ of the largest coordinate.
firstJust :: (Double -> Maybe a) -> Double -> Maybe a
firstJust attempt rounding = listToMaybe (mapMaybe attempt (take 6 (iterate (* 10) rounding)))

-- | The weights of @n@ regions, and the weighted winding numbers of the faces to keep.
rule :: BooleanOperation -> Int -> ([Int], Int -> Bool)
rule operation n = case operation of
  Union -> (replicate n 1, (>= 1))
  Common -> (replicate n 1, (>= n))
  -- The others weigh less than the first one even together.
  Difference -> (n : replicate (n - 1) 1, (== n))

-- | A loop in which edges along the same segment are one segment again. @sourceOf@ gives the source
-- of a segment of the arrangement.
joined :: Vector Segment -> (Int -> Int) -> NonEmpty BoundaryEdge -> NonEmpty ResultSegment
joined sources sourceOf loop = NonEmpty.zipWith part runs ends'
  where
    runs = NonEmpty.groupBy1 isSame (rotated loop)
    ends' = NonEmpty.fromList (NonEmpty.tail starts <> [NonEmpty.head starts])
    starts = fmap (pointOf . NonEmpty.head) runs
    isSame a b =
      sourceOf (alongSegment a) == sourceOf (alongSegment b)
        && Arrangement.isForward a == Arrangement.isForward b
    -- The loop from an edge on that begins a run.
    rotated edges =
      case span (isSame (NonEmpty.last edges)) (NonEmpty.toList edges) of
        (front, e : rest) -> e :| rest <> front
        (_, []) -> edges
    pointOf e = let (x, y) = begin e in Vec.point x y
    part run end =
      ResultSegment
        { source = k,
          isForward,
          segment = partOf whole (pointOf (NonEmpty.head run)) end sweep
        }
      where
        k = sourceOf (alongSegment (NonEmpty.head run))
        isForward = Arrangement.isForward (NonEmpty.head run)
        whole = (if isForward then id else Segment.reverse) (sources Vector.! k)
        sweep = sum (fmap (\e -> 4 * atan (edgeBulge e)) run)

-- | The part of a segment between two of its points, with the sweep in radians.
partOf :: Segment -> Point -> Point -> Double -> Segment
partOf whole from to sweep
  | Segment.start whole == from && Segment.end whole == to = whole
  | otherwise = case whole of
    Arc {centre}
      | from == to -> Arc {start = from, end = to, centre, sweep = Rad (signum sweep * 2 * pi)}
      | sweep /= 0 -> Arc {start = from, end = to, centre, sweep = Rad sweep}
    _ -> Straight from to

-- | A closed polyarc in the direction in which its inside is on its left; Nothing if it encloses
-- nothing.
oriented :: Polyarc -> Either BooleanFault (Maybe Polyarc)
oriented polyarc = case firstJust attempt rounding of
  Nothing -> Left Undecided
  Just a -> case Arrangement.windingNumbers a of
    (0, 0) -> Right Nothing
    (0, 1) -> Right (Just polyarc)
    (-1, 0) -> Right (Just (Polyarc.reverse polyarc))
    (_, high) -> Left (crossing (if high > 0 then (0, 1) else (-1, 0)) a)
  where
    (flat, numbers) = FlatPolyarc.fromPolyarc polyarc
    rounding = Tolerance.rounding * ClosedPolyarcs.largestCoordinate [flat]
    chain = ClosedPolyarcs.fromFlatPolyarcs rounding [flat]
    attempt t = Arrangement.arrange t chain (SegmentBoxTree.build t chain)
    number i =
      indexPrimArray numbers (fromIntegral (indexPrimArray (ClosedPolyarcs.sources chain) i))
    crossing allowed a = case Arrangement.intersectingSegments allowed a of
      Just (i, j) -> CrossesItself (min (number i) (number j)) (max (number i) (number j))
      Nothing -> Undecided

-- | Loops with the region on their left, as the connected parts of the region: each has its outer
-- loop and the loops around its holes. @get@ reads the segment of a loop's item.
nested :: (a -> Segment) -> [NonEmpty a] -> [(NonEmpty a, [NonEmpty a])]
nested get loops =
  [(outer, Map.findWithDefault [] k holesOf) | (k, outer, _, _) <- outers]
  where
    measured = [(loop, Polyarc.areaOf get loop) | loop <- loops]
    outers =
      [ (k, loop, polyarc, area)
        | (k, (loop, area)) <- zip [0 :: Int ..] measured,
          area > 0,
          let polyarc = Polyarc Closed (fmap get loop)
      ]
    smallestFirst =
      [ (k, polyarc, boxOf polyarc)
        | (k, _, polyarc, _) <- sortOn (\(_, _, _, area) -> area) outers
      ]
    boxOf =
      foldr1 BoundingBox.union . fmap BoundingBox.ofSegment . Polyarc.segments
    holesOf =
      Map.fromListWith
        (flip (<>))
        [ (k, [loop])
          | (loop, area) <- measured,
            area <= 0,
            let p = Segment.at 0.5 (get (NonEmpty.head loop)),
            k <- take 1 [k | (k, outer, box) <- smallestFirst, box `holds` p, outer `encloses` p]
        ]
    encloses = WindingNumber.encloses
    holds (BoundingBox left bottom right top) p =
      left <= Vec.x p && Vec.x p <= right && bottom <= Vec.y p && Vec.y p <= top
