{-# LANGUAGE BangPatterns #-}

-- | The toolpath beside a contour, made from the loops of the kernel.
--
-- Each segment of a loop is a part of the offset of one element or corner of the contour. The
-- vertices of the loop are exact to rounding. Some arcs, such as those over half a turn, are
-- several segments of the loop. Here these segments become one arc again. The coordinates of the
-- path come from the contour ("Offset.SourceOffset"): a vertex that agrees with an exact point of
-- the element's or corner's offset is replaced by this point. A vertex where the offsets of two
-- distant elements intersect keeps the kernel's coordinates.
--
-- The flat contour is the contour with arcs over half a turn divided into two. Its segments, the
-- elements of the contour, and the loops and their segments are numbered from 0. Two offsets occur
-- in many functions: @structure@ is the one that the kernel computed, @source@ the one whose
-- coordinates are wanted. They differ only for a cutter that just fits: then the radius of
-- @structure@ is smaller by 'Tolerance.clearance'.
--
-- Terms:
--
-- * The origin of a segment of a loop is the element or the corner of the contour from whose offset
--   the segment comes. The least origin is the one that comes first along the contour.
-- * A run is one segment of a loop, or several consecutive ones on one arc, all with one origin.
-- * A circuit is the runs once around a loop.
-- * A run is beside the contour if it lies on the cutter's side of the contour. All runs of a
--   closed contour do. An open contour also has runs on its opposite side and about its ends.
-- * A connecting line is a straight segment that joins the offsets of two elements at an inner
--   corner.
-- * A slight corner turns towards the cutter by so small an angle that it is no obstacle
--   ('Offset.SourceOffset.Corner').
module Offset.LoopPath
  ( LoopRegion (..),
    region,
    rawRegion,
    flatCount,
    Run (..),
    Circuit (..),
    circuit,
    rawCircuit,
    path,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (find, minimumBy)
import Data.Maybe (fromMaybe, isJust)
import Data.Ord (comparing)
import Data.Primitive.PrimArray (PrimArray, indexPrimArray, sizeofPrimArray)
import Data.Vector qualified as Vector
import Data.Word (Word8)
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Kernel qualified as Kernel
import Offset.Loop (OffsetLoops)
import Offset.Loop qualified as Loop
import Offset.SourceOffset
  ( Corner (..),
    CornerStyle (..),
    Cuts (..),
    OffsetSegment (OffsetSegment),
    OffsetSource (..),
    Origin (..),
    cornerArc,
    cornerAt,
    cornerPoints,
    cutsAt,
    distanceAt,
    movedElement,
    next,
    shortened,
  )
import Offset.Tolerance qualified as Tolerance

-- | A region of positions of the cutter's centre, given by the kernel's loops.
data LoopRegion = LoopRegion
  { -- | the kind of the contour: open or closed
    contourEnds :: Ends,
    -- | the loops that bound the region
    loops :: OffsetLoops,
    -- | the raw offset from which the loops were cut
    raw :: ClosedPolyarcs,
    -- | the number of the contour's element for each segment of the flat contour
    numbers :: PrimArray Int
  }

-- | The region that the cutter's centre can reach. Nothing for a contour that intersects itself,
-- and when the kernel cannot certify its answer: at a cusp, two elements may cross by less than
-- rounding permits to decide.
region :: OffsetSource -> Maybe LoopRegion
region source = case Kernel.offset (request source numbers) [flat] of
  Right found ->
    Just
      LoopRegion
        { contourEnds = ends source,
          loops = Kernel.loops found,
          raw = Kernel.raw found,
          numbers
        }
  Left Kernel.Uncertain -> Nothing
  Left (Kernel.SelfIntersecting _ _) -> Nothing
  Left Kernel.WrongNesting -> Nothing
  where
    (flat, numbers) = FlatPolyarc.fromSegments (ends source) (elements source)

-- | The whole raw offset as the only loop, untrimmed.
rawRegion :: OffsetSource -> LoopRegion
rawRegion source = LoopRegion {contourEnds = ends source, loops = Loop.untrimmed raw, raw, numbers}
  where
    raw = Kernel.rawOffset (request source numbers) [flat]
    (flat, numbers) = FlatPolyarc.fromSegments (ends source) (elements source)

-- | The number of segments of the flat contour.
flatCount :: LoopRegion -> Int
flatCount = sizeofPrimArray . numbers

-- | The request to the kernel. @numbers@ has the element's number for each segment of the flat
-- contour.
request :: OffsetSource -> PrimArray Int -> Kernel.OffsetRequest
request OffsetSource {style, side, radius, elements} numbers =
  Kernel.OffsetRequest
    { Kernel.side,
      Kernel.corners = if sharp style then Kernel.Sharp else Kernel.Round,
      Kernel.distance = radius,
      Kernel.extra =
        if all ((== Mm 0) . extra style) [0 .. Vector.length elements - 1]
          then Nothing
          else Just (extra style . indexPrimArray numbers)
    }

-- | A run: one segment of a loop, or consecutive segments on one arc.
data Run = Run
  { -- | origin of the run
    origin :: Origin,
    -- | number of the flat contour's segment from which the run's first segment comes. An open
    -- contour of @n@ segments is traversed there and back, so the numbers go up to @2n − 1@
    flat :: Int,
    -- | True when the run is the joint between the two halves of an arc over half a turn
    isInterior :: Bool,
    -- | True when the run is beside the contour
    isBeside :: Bool,
    -- | True when the run is a connecting line
    isConnecting :: Bool,
    -- | the point where the run begins
    from :: {-# UNPACK #-} Point,
    -- | the point where the run ends
    to :: {-# UNPACK #-} Point,
    -- | sweep in radians, positive counter-clockwise; 0 for a line
    turned :: Double
  }

-- | A circuit: @runs@ are its runs in order. The loop is closed, so the last run comes before the
-- first one again. @before@ is the origin of the last run that is not a connecting line.
data Circuit = Circuit {before :: Origin, runs :: [Run]}

-- | The circuit of loop @k@ of the region @r@. It begins with a run that is not beside the contour.
-- When there is none, it begins with the run of the least origin.
circuit :: LoopRegion -> Int -> Circuit
circuit r k = circuitFrom r a z (fromMaybe (leastStart r a z) beyond)
  where
    beyond = find (not . isBesideAt r) (if contourEnds r == Open then [a .. z - 1] else [])
    a = indexPrimArray (Loop.starts (loops r)) k
    z = indexPrimArray (Loop.starts (loops r)) (k + 1)

-- | The runs of a 'rawRegion' that are beside the contour, without connecting lines. Their path
-- passes all corners of the contour, as no part of the raw offset is trimmed.
rawCircuit :: LoopRegion -> Circuit
rawCircuit r
  | z == 0 = Circuit (Along 0) []
  | otherwise = full {runs = filter (not . isConnecting) (takeWhile isBeside (runs full))}
  where
    full = circuitFrom r 0 z 0
    z = if Loop.count (loops r) == 0 then 0 else indexPrimArray (Loop.starts (loops r)) 1

-- | The number of the segment with which the run of the least origin begins, in a loop with the
-- segments from @a@ to @z − 1@. Segment @a@ follows segment @z − 1@. So a run that contains segment
-- @a@ may begin before it, near the end of the loop. The search goes back from segment @a@ as long
-- as the number of the flat contour's segment does not increase. Thus a run along a full circle
-- begins with the circle's first half.
leastStart :: LoopRegion -> Int -> Int -> Int
leastStart r a z = if first == a then backwards a (z - 1) else first
  where
    !first = least (a + 1) a (originAt r a)
    !origin = originAt r first
    least !i !best !o
      | i >= z = best
      | o' < o = least (i + 1) i o'
      | otherwise = least (i + 1) best o
      where
        o' = originAt r i
    backwards !start !i
      | i > a && originAt r i == origin && flatAt r i <= flatAt r start = backwards i (i - 1)
      | otherwise = start

-- | The circuit of the loop with the segments from @a@ to @z − 1@. The first run is segment
-- @begin@.
circuitFrom :: LoopRegion -> Int -> Int -> Int -> Circuit
circuitFrom r a z begin = Circuit (earlier begin) (go begin (z - a))
  where
    earlier i
      | isConnectingAt r i', i' /= begin = earlier i'
      | otherwise = originAt r i'
      where
        i' = if i == a then z - 1 else i - 1
    go !i !left
      | left <= 0 = []
      | otherwise = run `seq` (run : go after (left - 1))
      where
        run = runAt r i after
        after = if i + 1 == z then a else i + 1

-- | The run of segment @i@ of a loop. @j@ is the number of the vertex where the segment ends.
runAt :: LoopRegion -> Int -> Int -> Run
runAt r i j =
  Run
    { origin = originAt r i,
      flat = flatAt r i,
      isInterior =
        (isAroundAt r i || isConnectingAt r i)
          && flatAt r i + 1 < flatCount r
          && indexPrimArray (numbers r) (flatAt r i) == indexPrimArray (numbers r) (flatAt r i + 1),
      isBeside = isBesideAt r i,
      isConnecting = isConnectingAt r i,
      from = vertex i,
      to = vertex j,
      turned = 4 * atan (indexPrimArray (Loop.bulges l) i)
    }
  where
    l = loops r
    vertex k = Vec.point (indexPrimArray (Loop.xs l) k) (indexPrimArray (Loop.ys l) k)

-- | The number of the raw offset's segment from which segment @i@ of a loop was cut.
rawAt :: LoopRegion -> Int -> Int
rawAt r i = fromIntegral (indexPrimArray (Loop.raws (loops r)) i)

-- | The marks of the raw offset's segment from which segment @i@ of a loop was cut.
markAt :: LoopRegion -> Int -> Word8
markAt r i = indexPrimArray (ClosedPolyarcs.marks (raw r)) (rawAt r i)

-- | True when segment @i@ of a loop goes round a corner, as an arc or a line.
isAroundAt :: LoopRegion -> Int -> Bool
isAroundAt r i = ClosedPolyarcs.hasMark ClosedPolyarcs.aroundMark (markAt r i)

-- | True when segment @i@ of a loop is a connecting line.
isConnectingAt :: LoopRegion -> Int -> Bool
isConnectingAt r i = ClosedPolyarcs.hasMark ClosedPolyarcs.connectingMark (markAt r i)

-- | The number of the flat contour's segment from which segment @i@ of a loop comes. For an open
-- contour of @n@ segments the numbers from @n@ on are those of the traversal back.
flatAt :: LoopRegion -> Int -> Int
flatAt r i = fromIntegral (indexPrimArray (ClosedPolyarcs.sources (raw r)) (rawAt r i))

-- | The origin of segment @i@ of a loop.
originAt :: LoopRegion -> Int -> Origin
originAt r i = if isAroundAt r i then Around element else Along element
  where
    k = flatAt r i
    n = sizeofPrimArray (numbers r)
    element = indexPrimArray (numbers r) (if k < n then k else 2 * n - 1 - k)

-- | True when segment @i@ of a loop is beside the contour. False on the traversal back along an
-- open contour, and on the arcs about its ends.
isBesideAt :: LoopRegion -> Int -> Bool
isBesideAt r i = contourEnds r == Closed || flatAt r i < (if isAroundAt r i then n - 1 else n)
  where
    n = sizeofPrimArray (numbers r)

-- | The segments of a path along runs. @previous@ is the origin of the run before the first one,
-- not counting connecting lines; it is Nothing for an open path. Where two segments join, their
-- ends may differ by up to 'Tolerance.coincident'.
path :: OffsetSource -> OffsetSource -> Maybe Origin -> [Run] -> [OffsetSegment]
path structure source previous runs = case joined structure runs of
  [] -> []
  first : rest -> go (previous >>= \o -> joint o first) first rest
    where
      go !before run others = case others of
        [] -> [segmentOf before run (if isJust previous then joint (origin run) first else Nothing)]
        r : more -> exact `seq` (exact : go after r more)
          where
            after = joint (origin run) r
            exact = segmentOf before run after
  where
    joint = jointBetween structure source
    segmentOf = exactSegment structure source

-- | The runs without the negligible ones. Consecutive runs along one arc are joined.
joined :: OffsetSource -> [Run] -> [Run]
joined structure = start
  where
    start runs = case runs of
      [] -> []
      p : more
        | isNegligible structure p -> start more
        | otherwise -> go p more
    go !p runs = case runs of
      [] -> [p]
      q : more
        | isNegligible structure q -> go p more
        | origin p == origin q && turned p /= 0 && turned q /= 0 ->
          go p {to = to q, turned = turned p + turned q} more
        | otherwise -> p : go q more

-- | True when a run is no part of the path: an arc about a corner that counts as smooth, or a short
-- line between the two halves of an arc or at an inner corner. The kernel makes such lines where
-- rounding hides an intersection.
isNegligible :: OffsetSource -> Run -> Bool
isNegligible structure run = case origin run of
  Around i -> turned run /= 0 && cornerAt structure i == Smooth || isInterior run && isShort
  Along _ -> (isConnecting run || isInterior run) && isShort
  where
    isShort = Vec.distance (from run) (to run) <= Tolerance.clearance

-- | The lengths to cut off two neighbouring segments of a path that join at a smooth or slight
-- corner. @p@ is the origin of the first segment, @run@ the run of the second one. The lengths are
-- those of the offset @source@. Nothing for all other neighbours, and when the kernel joined the
-- two segments far from the corner.
jointBetween :: OffsetSource -> OffsetSource -> Origin -> Run -> Maybe Cuts
jointBetween structure source p run = case (p, origin run) of
  (Along i, Along j)
    | j == next source i,
      not (isConnecting run) -> case cornerAt structure i of
      Smooth -> agreed i j
      Slight _ -> agreed i j
      Outer -> Nothing
      Blocked -> Nothing
      NoCorner -> Nothing
  _ -> Nothing
  where
    agreed i j
      | distance <= Mm (2 * (r * abs (tan (angle / 2)) + close)) = Just (cuts source)
      | otherwise = Nothing
      where
        cuts s = cutsAt s i (movedElement s i) (movedElement s j)
        Mm r = distanceAt structure i
        Mm close = Tolerance.coincident
        angle = indexPrimArray (turnings structure) i
        -- The distance in mm between the point where the kernel joined the two segments and the
        -- end of the first element's offset.
        distance = Vec.distance (from run) (Segment.end (movedElement structure i))

-- | The segment of a run, with the coordinates of @source@. @before@ has the lengths to cut off at
-- the joint with the segment before, and @after@ those at the joint with the segment after. If
-- @before@ is Nothing, the result begins where the run begins, with one exception. If this is where
-- the whole offset of the origin begins in @structure@, the result begins where the whole offset
-- begins in @source@. The same is true of @after@ and the end.
exactSegment :: OffsetSource -> OffsetSource -> Maybe Cuts -> Run -> Maybe Cuts -> OffsetSegment
exactSegment structure source before run after =
  OffsetSegment (origin run) $ case origin run of
    Along i
      | isConnecting run -> Straight (from run) (to run)
      | otherwise -> both (`movedElement` i)
    Around i
      | turned run /= 0 -> both (`cornerArc` i)
      | otherwise -> Straight (snapped i (from run)) (snapped i (to run))
  where
    -- When both offsets have one radius, the segment is computed once.
    both f =
      let exact = f source
          structural = if radius structure == radius source then exact else f structure
       in partOf before run after structural exact
    -- The exact point of the corner after element i that agrees with the vertex p, or p itself.
    snapped i p
      | Vec.isNear p nearest = snd pair
      | otherwise = p
      where
        pair@(nearest, _) = minimumBy (comparing (Vec.distance p . fst)) points
        points = zip (cornerPoints structure i) (cornerPoints source i)

-- | The part of an exact segment that a run covers. @structural@ is the whole segment in the offset
-- that the kernel computed; @exact@ is the same segment in the offset whose coordinates are wanted.
-- @before@ and @after@ have the lengths to cut off at the joints at its start and its end. Each is
-- Nothing where the segment joins no neighbour at a smooth or slight corner.
partOf :: Maybe Cuts -> Run -> Maybe Cuts -> Segment -> Segment -> Segment
partOf before run after structural exact
  | startsThere && endsThere = whole
  | otherwise = case exact of
    Arc {centre} | turned run /= 0 -> Arc {start, end, centre, sweep = sweepNear centre}
    _ -> Straight start end
  where
    startsThere = isJust before || Vec.isNear (from run) (Segment.start structural)
    endsThere = isJust after || Vec.isNear (to run) (Segment.end structural)
    whole
      | a + b > 0 && Mm (a + b) < Segment.length exact = shortened a b exact
      | otherwise = exact
    a = maybe 0 front before
    b = maybe 0 back after
    start = if startsThere then Segment.start whole else from run
    end = if endsThere then Segment.end whole else to run
    -- The sweep from start to end that is nearest to the run's sweep.
    sweepNear centre =
      let Rad least = Vec.signedAngle (Vec.to centre start) (Vec.to centre end)
       in Rad (least + 2 * pi * fromIntegral (round ((turned run - least) / (2 * pi)) :: Int))
