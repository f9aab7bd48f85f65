-- | The paths that the centre of a cutter can take beside a contour, cut from the kernel's loops.
--
-- "Offset.Kernel" finds the parts of an offset that can be reached, and "Offset.LoopPath" makes
-- segments of its loops. This module makes paths of the segments, and decides whether a path leaves
-- out a part of the contour. A run is one segment of a loop, or several consecutive ones on one
-- arc; each comes from one element or corner of the contour, its origin. A stretch is a sequence of
-- consecutive runs on the cutter's side of an open contour. The runs before and after a stretch are
-- not on that side. A shrunk element is one that the cutter can reach without moving along it: an
-- arc into which the cutter just fits, or an element of length 0.
--
-- As in "Offset.LoopPath", @structure@ is the offset that the kernel computed, and @source@ the one
-- whose coordinates are wanted. The radius of @source@ may be a little larger. The flat contour is
-- the contour with arcs over half a turn divided into two.
module Offset.TrimmedOffset
  ( TrimmedOffset (..),
    along,
    whole,
    untrimmed,
    touchesWhole,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Control.Monad ((>=>))
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List (foldl', sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, isNothing, listToMaybe, mapMaybe)
import Data.Primitive.PrimArray (indexPrimArray, sizeofPrimArray)
import Data.Vector qualified as Vector
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
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

-- | A trimmed offset: a connected path of the cutter's centre.
data TrimmedOffset = TrimmedOffset
  { -- | the kind of the path: open or closed
    ends :: Ends,
    -- | the segments of the path in order, each starting exactly where the one before ends
    pieces :: NonEmpty OffsetSegment,
    -- | the elements of the contour, by number from 0, that stop the cutter at the start and at the
    -- end of an open path. Nothing at an end of the contour, and for a closed path
    stops :: (Maybe Int, Maybe Int)
  }
  deriving stock (Eq, Show)

-- | The paths beside a contour, in the contour's order; empty for a contour that intersects itself.
along :: OffsetSource -> [TrimmedOffset]
along source = maybe [] (map chained . pathsIn source source) (LoopPath.region source)

-- | The paths in a region, which the kernel computed for @structure@. Where two segments join,
-- their ends may differ by rounding. No path beside an open contour is shorter than
-- 'Tolerance.shortestPath'.
pathsIn :: OffsetSource -> OffsetSource -> LoopPath.LoopRegion -> [TrimmedOffset]
pathsIn structure source region =
  sortOn
    (beginning . NonEmpty.head . pieces)
    (concatMap (inLoop . LoopPath.circuit region) [0 .. Loop.count (LoopPath.loops region) - 1])
  where
    -- Several paths may begin beside the same element.
    beginning (OffsetSegment o s) =
      (o, Distance.nearestFraction (Segment.start s) (elements source Vector.! numberOf o))
    open = openPath structure source (LoopPath.flatCount region)
    free = withoutScreened source
    inLoop (Circuit before runs) = case runs of
      r : rest
        | not (isBeside r) -> mapMaybe (open >=> free) (stretches r rest)
      _ ->
        [ TrimmedOffset {ends = Closed, pieces = ps, stops = (Nothing, Nothing)}
          | Just ps <- [NonEmpty.nonEmpty (LoopPath.path structure source (Just before) runs)],
            SourceOffset.ends source == Closed || isLong (NonEmpty.toList ps)
        ]

-- | A path with exact joints: each segment starts where the one before ends.
chained :: TrimmedOffset -> TrimmedOffset
chained path =
  path {pieces = Polyarc.closeGaps segment (\s p -> p {segment = s}) (ends path) (pieces path)}

-- | The stretches of a loop beside an open contour. Each comes with the run before it and the run
-- after it. @first@ is the loop's first run, which does not lie on the cutter's side of the
-- contour; the second argument has all other runs.
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

-- | The open path along the stretch @runs@; Nothing when the path has no segments, or is shorter
-- than 'Tolerance.shortestPath'. @count@ is the number of segments of the flat contour. @before@
-- and @after@ are the runs before and after the stretch.
openPath :: OffsetSource -> OffsetSource -> Int -> (Run, NonEmpty Run, Run) -> Maybe TrimmedOffset
openPath structure source count (before, runs, after) =
  pathOf <$> NonEmpty.nonEmpty (if isLong found then found else [])
  where
    found = LoopPath.path structure source Nothing (NonEmpty.toList runs)
    pathOf ps =
      TrimmedOffset
        { ends = Open,
          pieces = ps,
          stops =
            ( stopAt (2 * count - 1) before (flat (NonEmpty.head runs) == 0),
              stopAt (count - 1) after (flat (NonEmpty.last runs) == count - 1)
            )
        }
    -- At an end of the contour itself, the run next to the stretch is the arc about this end, which
    -- stops nothing.
    stopAt end other endsThere = case LoopPath.origin other of
      Around _ | flat other == end, endsThere -> Nothing
      o -> Just (numberOf o)

-- | Test that the segments of a path are at least 'Tolerance.shortestPath' long together.
isLong :: [OffsetSegment] -> Bool
isLong = go (Mm 0)
  where
    go soFar path = case path of
      _ | soFar >= Tolerance.shortestPath -> True
      p : more -> go (plus soFar (Segment.length (segment p))) more
      [] -> False

-- | The part of an open path that is not screened; Nothing if it is shorter than
-- 'Tolerance.shortestPath'. The offset of an
-- element or a corner with an extra distance may extend beyond another element, behind the contour.
-- There it is /screened/: the cutter cannot touch the element or corner, because the other element
-- lies between. This occurs with different distances only. Screened segments at both ends of the
-- path are left out, with the connecting lines before and after them. Apply the function to the
-- source once, and the result to many paths.
withoutScreened :: OffsetSource -> TrimmedOffset -> Maybe TrimmedOffset
withoutScreened source
  | isUneven = \path ->
    if all (isNothing . screensAt) (pieces path) then Just path else freeOf path
  | otherwise = Just
  where
    isUneven = any ((/= distanceAt source 0) . distanceAt source) [1 .. elementCount source - 1]
    freeOf path = do
      (atStart, front) <- freeFrom screensAt (fst (stops path)) (NonEmpty.toList (pieces path))
      (atEnd, back) <- freeFrom screensAt (snd (stops path)) (map backwards (reverse front))
      kept <- NonEmpty.nonEmpty (map backwards (reverse (if isLong back then back else [])))
      Just path {pieces = kept, stops = (atStart, atEnd)}
    backwards p = p {segment = Segment.reverse (segment p)}
    screensAt = screens source

-- | The segments of a path without the screened ones at its start, and the element that stops the
-- cutter at the start of these segments; Nothing if all segments are screened. @screensAt@ is
-- 'screens', @stop@ the element that stops the cutter at the start of the whole path. The first
-- segment may be partly screened; bisection then finds the fraction at which its free part begins.
freeFrom ::
  (OffsetSegment -> Maybe (Double -> Maybe Int)) ->
  Maybe Int ->
  [OffsetSegment] ->
  Maybe (Maybe Int, [OffsetSegment])
freeFrom screensAt stop path = case span isConnecting path of
  (_, []) -> Nothing
  (connecting, p : rest) -> do
    screen <- screensAt p
    case span (isJust . screen) [(k + 0.5) / fineness | k <- [0 .. fineness - 1]] of
      ([], _) -> Just (stop, connecting <> (p : rest))
      (covered, []) -> freeFrom screensAt (screen (last covered)) (dropWhile isConnecting rest)
      (covered, k : _) ->
        let begin = bisected screen (last covered) k
         in Just
              ( screen (last covered),
                p {segment = Segment.between begin 1 (segment p)} : rest
              )
  where
    isConnecting = isNothing . screensAt
    fineness = 16
    bisected screen low high
      | high - low <= Tolerance.negligibleShare = high
      | isJust (screen middle) = bisected screen middle high
      | otherwise = bisected screen low middle
      where
        middle = (low + high) / 2

-- | For a segment of the offset of an element or a corner: the element, by its number from 0, that
-- screens the point at a fraction of the segment's length. It is Nothing if none does. Nothing for
-- the connecting line between two offsets. A point on the wrong side of its own element counts as
-- screened by this element.
screens :: OffsetSource -> OffsetSegment -> Maybe (Double -> Maybe Int)
screens source = \(OffsetSegment o s) -> case o of
  Along i
    | Mm gap <- minus (distanceAt source i) (Distance.toPoint (Segment.at 0.5 s) (element i)),
      Mm (abs gap) <= Tolerance.clearance ->
      Just $ \k ->
        let p = Segment.at k s
         in if Segment.isBehind (SourceOffset.side source) (element i) p
              then Just i
              else crossed (/= i) (Straight (snd (Distance.nearest p (element i))) p)
  -- A sharp corner is further from the vertex than an arc round it.
  Around i
    | tip <- Segment.end (element i),
      wide <- max (distanceAt source i) (distanceAt source (SourceOffset.next source i)),
      minus wide (Vec.distance (Segment.at 0.5 s) tip) <= Tolerance.clearance ->
      Just (\k -> crossed (const True) (Straight tip (Segment.at k s)))
  _ -> Nothing
  where
    element i = elements source Vector.! i
    -- One of the elements, by number, that cross a line, not at the line's start.
    crossed among line =
      listToMaybe
        [ j
          | (j, s) <- BoxTree.within (BoundingBox.ofSegment line) index,
            among j,
            q <- Distance.intersections line s,
            Vec.distance (Segment.start line) q > Tolerance.clearance
        ]
    index =
      BoxTree.index
        (BoundingBox.ofSegment . snd)
        (zip [0 ..] (Vector.toList (elements source)))

-- | The segments of the offset, when the cutter reaches every element of the contour; else Nothing.
-- The cutter reaches every element when three conditions are true: there is one path, it leaves out
-- only shrunk elements, and no other elements stop the cutter at the ends of an open contour. Inner
-- corners are not examined. The list is empty when all elements have shrunk.
whole :: OffsetSource -> OffsetSource -> Maybe [OffsetSegment]
whole structure source = case LoopPath.region structure of
  Just region -> case pathsIn structure source region of
    -- This case comes first, because the checks of the next one would keep the whole path in
    -- memory.
    path : _ | isUncut region -> Just (NonEmpty.toList (pieces path))
    [path]
      | SourceOffset.ends source == ends path,
        isInOrder structure path,
        isOpenAtEnds path ->
        Just (NonEmpty.toList (pieces path))
    [] -> nothingLeft
    _ -> Nothing
  Nothing -> nothingLeft
  where
    nothingLeft
      | all (hasShrunk structure) [0 .. elementCount structure - 1] = Just []
      | otherwise = Nothing
    -- True when only shrunk elements stop the cutter at the ends of the path: elements before its
    -- first one, or after its last one.
    isOpenAtEnds path =
      maybe True (< firstOf path) (fst (stops path))
        && maybe True (> finalOf path) (snd (stops path))
    firstOf = numberOf . origin . NonEmpty.head . pieces
    finalOf = numberOf . origin . NonEmpty.last . pieces

-- | True when trimming has removed no part of the raw offset: the segments of the raw offset are
-- those of the only loop, in the same order.
isUncut :: LoopPath.LoopRegion -> Bool
isUncut region =
  Loop.count loops == 1
    && count == sizeofPrimArray (ClosedPolyarcs.xs (LoopPath.raw region)) - 1
    && and [indexPrimArray (Loop.raws loops) i == fromIntegral i | i <- [0 .. count - 1]]
  where
    count = sizeofPrimArray (Loop.raws loops)
    loops = LoopPath.loops region

-- | True when the element numbers of a path's segments do not decrease, and every element along
-- which the path does not run is a shrunk one that the cutter reaches.
isInOrder :: OffsetSource -> TrimmedOffset -> Bool
isInOrder source path =
  and (zipWith (<=) numbers (drop 1 numbers))
    && all isReached (IntSet.toList (IntSet.difference everything found))
  where
    numbers = map (numberOf . origin) (NonEmpty.toList (pieces path))
    everything = IntSet.fromList [0 .. elementCount source - 1]
    found = IntSet.fromList [i | OffsetSegment (Along i) _ <- NonEmpty.toList (pieces path)]
    isReached i = case elements source Vector.! i of
      Straight a b -> Vec.isNear a b
      Arc {} -> any (touchesWhole source i) (pointsAt i)
    -- The ends of the path's segments at the place of an element along which it does not run.
    pointsAt i = case (IntMap.lookupGT i joints, ends path) of
      (Just (_, points), Open) -> points
      (Just (_, points), Closed) -> points <> final
      (Nothing, _) -> final
    Joints joints final = foldl' joined (Joints IntMap.empty []) (NonEmpty.toList (pieces path))
    joined (Joints known points) (OffsetSegment o s) = case o of
      Along i -> Joints (IntMap.insertWith (<>) i (Segment.start s : points) known) [Segment.end s]
      Around _ -> Joints known (Segment.end s : Segment.start s : points)

-- | The ends of a path's segments between the elements along which it runs, by the number of the
-- element after them, and the ends after the last element.
data Joints = Joints (IntMap [Point]) [Point]

-- | True when the cutter with its centre at the point @p@ touches all of element @i@: an arc about
-- @p@ whose radius is the offset's distance.
touchesWhole :: OffsetSource -> Int -> Point -> Bool
touchesWhole source i p = case elements source Vector.! i of
  Straight _ _ -> False
  Arc {centre} -> hasShrunk source i && Vec.distance p centre <= Tolerance.reachedCentre

-- | True of a shrunk element. An arc counts as shrunk when its radius is the offset's distance,
-- within 'Tolerance.clearance'; the side on which its centre lies is not examined.
hasShrunk :: OffsetSource -> Int -> Bool
hasShrunk source i = case elements source Vector.! i of
  Straight a b -> Vec.isNear a b
  Arc {start, centre} ->
    let Mm d = minus (Segment.radius centre start) (distanceAt source i)
     in Mm (abs d) <= Tolerance.clearance

-- | The raw offset on the cutter's side of the contour, untrimmed, without the connecting lines
-- ("Offset.LoopPath"). It passes all corners of the contour.
untrimmed :: OffsetSource -> [OffsetSegment]
untrimmed source = LoopPath.path source source previous runs
  where
    Circuit before runs = LoopPath.rawCircuit (LoopPath.rawRegion source)
    previous = if SourceOffset.ends source == Closed then Just before else Nothing
