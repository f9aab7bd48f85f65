-- | The paths that the centre of a cutter can take beside a contour, cut from the kernel's loops.
--
-- "Offset.Kernel" says which parts of an offset can be reached, "Offset.LoopPath" makes segments of
-- its loops. This module puts the segments into paths, and says whether a path misses nothing.
module Offset.TrimmedOffset
  ( TrimmedOffset (..),
    along,
    whole,
    untrimmed,
  )
where

import Base.Quantity (Mm (..), minus)
import Data.IntSet qualified as IntSet
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Data.Primitive.PrimArray (indexPrimArray, sizeofPrimArray)
import Data.Vector qualified as Vector
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Offset.Loop qualified as Loop
import Offset.LoopPath (Circuit (Circuit), Run (flat, isBeside))
import Offset.LoopPath qualified as LoopPath
import Offset.SourceOffset
  ( OffsetSegment (..),
    OffsetSource,
    Origin (..),
    distanceAt,
    elementCount,
    elements,
    numberOf,
  )
import Offset.SourceOffset qualified as SourceOffset
import Offset.Tolerance qualified as Tolerance

-- | A path of the centre without a gap, closed or from end to end.
data TrimmedOffset = TrimmedOffset
  { ends :: Ends,
    pieces :: NonEmpty OffsetSegment,
    -- | the elements of the contour that stop the cutter before and after an open path; nothing
    -- where the contour ends
    stops :: (Maybe Int, Maybe Int)
  }
  deriving stock (Eq, Show)

-- | The paths beside a contour, in its order. A contour that intersects itself has none.
along :: OffsetSource -> [TrimmedOffset]
along source = maybe [] (pathsIn source source) (LoopPath.region source)

-- | The paths in a region, with the coordinates of a source; the first request is the one that the
-- kernel answered.
pathsIn :: OffsetSource -> OffsetSource -> LoopPath.LoopRegion -> [TrimmedOffset]
pathsIn structure source region =
  sortOn
    (origin . NonEmpty.head . pieces)
    (concatMap (inLoop . LoopPath.circuit region) [0 .. Loop.count (LoopPath.loops region) - 1])
  where
    open = openPath structure source (LoopPath.flatCount region)
    inLoop (Circuit before runs) = case runs of
      r : rest
        | not (isBeside r) -> mapMaybe open (stretches r rest)
      _ ->
        [ TrimmedOffset {ends = Closed, pieces = chained Closed ps, stops = (Nothing, Nothing)}
          | Just ps <- [NonEmpty.nonEmpty (LoopPath.path structure source (Just before) runs)]
        ]

-- | Let each piece begin exactly at the end of the one before it.
chained :: Ends -> NonEmpty OffsetSegment -> NonEmpty OffsetSegment
chained = Polyarc.closeGaps segment (\s p -> p {segment = s})

-- | The runs of a loop that are beside an open contour, stretch by stretch, each with the run
-- before it and the one after it. The first run is not beside the contour.
stretches :: Run -> [Run] -> [(Run, NonEmpty Run, Run)]
stretches first = go first
  where
    go before found = case found of
      [] -> []
      r : rest
        | isBeside r,
          (more, others) <- span isBeside rest,
          after <- case others of
            o : _ -> o
            [] -> first ->
          (before, r :| more, after) : go after (drop 1 others)
        | otherwise -> go r rest

-- | The open path along a stretch, given the number of segments of the flat contour.
openPath :: OffsetSource -> OffsetSource -> Int -> (Run, NonEmpty Run, Run) -> Maybe TrimmedOffset
openPath structure source count (before, runs, after) =
  pathOf <$> NonEmpty.nonEmpty (LoopPath.path structure source Nothing (NonEmpty.toList runs))
  where
    pathOf ps =
      TrimmedOffset
        { ends = Open,
          pieces = chained Open ps,
          stops =
            ( stopAt (2 * count - 1) before (flat (NonEmpty.head runs) == 0),
              stopAt (count - 1) after (flat (NonEmpty.last runs) == count - 1)
            )
        }
    -- The arc about the contour's own end, next to the element that ends there, stops nothing.
    stopAt end other endsThere = case LoopPath.origin other of
      Around _ | flat other == end, endsThere -> Nothing
      o -> Just (numberOf o)

-- | The pieces along a contour that the cutter reaches everywhere: there is one path,
-- it misses nothing but arcs that have shrunk to a point, and nothing stops the cutter at the ends
-- of an open contour. Corners are not looked at. It is empty when all elements are such arcs. The
-- coordinates are those of the source; the kernel is asked about the structure.
whole :: OffsetSource -> OffsetSource -> Maybe [OffsetSegment]
whole structure source = case LoopPath.region structure of
  Just region -> case pathsIn structure source region of
    -- The check whether there is one path only would keep it in memory.
    path : _ | isUncut region -> Just (NonEmpty.toList (pieces path))
    [path]
      | SourceOffset.ends source == ends path,
        isInOrder structure (map (numberOf . origin) (NonEmpty.toList (pieces path))),
        isOpenAtEnds path ->
        Just (NonEmpty.toList (pieces path))
    [] -> nothingLeft
    _ -> Nothing
  Nothing -> nothingLeft
  where
    nothingLeft
      | all (hasShrunk structure) [0 .. elementCount structure - 1] = Just []
      | otherwise = Nothing
    -- The path begins or ends where the contour does, but for arcs that have shrunk.
    isOpenAtEnds path =
      maybe True (< firstOf path) (fst (stops path))
        && maybe True (> finalOf path) (snd (stops path))
    firstOf = numberOf . origin . NonEmpty.head . pieces
    finalOf = numberOf . origin . NonEmpty.last . pieces

-- | Nothing of the raw offset was cut away: its segments are the loop, in order.
isUncut :: LoopPath.LoopRegion -> Bool
isUncut region =
  Loop.count loops == 1
    && count == sizeofPrimArray (ClosedPolyarcs.xs (LoopPath.raw region)) - 1
    && and [indexPrimArray (Loop.raws loops) i == fromIntegral i | i <- [0 .. count - 1]]
  where
    count = sizeofPrimArray (Loop.raws loops)
    loops = LoopPath.loops region

-- | The numbers do not decrease, and elements without a number have shrunk to a point.
isInOrder :: OffsetSource -> [Int] -> Bool
isInOrder source numbers =
  and (zipWith (<=) numbers (drop 1 numbers))
    && all (hasShrunk source) (IntSet.toList (IntSet.difference everything found))
  where
    everything = IntSet.fromList [0 .. elementCount source - 1]
    found = IntSet.fromList numbers

-- | An element whose offset is a point.
hasShrunk :: OffsetSource -> Int -> Bool
hasShrunk source i = case elements source Vector.! i of
  Straight a b -> Vec.isNear a b
  Arc {start, centre} ->
    let Mm d = minus (Segment.radius centre start) (distanceAt source i)
     in Mm (abs d) <= Tolerance.clearance

-- | The offset before anything is cut away, of a contour at whose corners the cutter passes.
untrimmed :: OffsetSource -> [OffsetSegment]
untrimmed source = LoopPath.path source source previous runs
  where
    Circuit before runs = LoopPath.rawCircuit (LoopPath.rawRegion source)
    previous = if SourceOffset.ends source == Closed then Just before else Nothing
