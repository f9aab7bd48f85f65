{-# LANGUAGE BangPatterns #-}

-- | The toolpath from the loops of the kernel.
--
-- A loop lists segments with the elements of the contour that they are offsets of. Its vertices are
-- exact to rounding, and arcs over half a turn or cut in between are several segments of it. Here
-- each run of segments of one element becomes one segment again, and its coordinates come from the
-- element ("Offset.SourceOffset"): a vertex that agrees with an exact point of the element's offset
-- is replaced by this point. A vertex where the offsets of two distant elements intersect keeps the
-- kernel's coordinates.
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

import Base.Crash qualified as Crash
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

-- | Loops of the kernel, the raw offset that they are parts of, and the number of the element for
-- each segment of the flat contour.
data LoopRegion = LoopRegion
  { contourEnds :: Ends,
    loops :: OffsetLoops,
    raw :: ClosedPolyarcs,
    numbers :: PrimArray Int
  }

-- | The region that the cutter's centre can reach; nothing for a contour that intersects itself.
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
  Left Kernel.Uncertain -> Crash.bug "an equidistant failed its certificate"
  Left (Kernel.SelfIntersecting _ _) -> Nothing
  Left Kernel.WrongNesting -> Nothing
  where
    (flat, numbers) = FlatPolyarc.fromSegments (ends source) (elements source)

-- | The raw offset, before any of it is cut away, as one loop.
rawRegion :: OffsetSource -> LoopRegion
rawRegion source = LoopRegion {contourEnds = ends source, loops = Loop.untrimmed raw, raw, numbers}
  where
    raw = Kernel.rawOffset (request source numbers) [flat]
    (flat, numbers) = FlatPolyarc.fromSegments (ends source) (elements source)

-- | The number of segments of the flat contour, in which arcs over half a turn are two segments.
flatCount :: LoopRegion -> Int
flatCount = sizeofPrimArray . numbers

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

-- | A segment of a loop, or consecutive segments of one arc.
data Run = Run
  { origin :: Origin,
    -- | index of its first segment in the flat contour, in which an open contour is traversed
    -- forwards and then backwards
    flat :: Int,
    -- | joins both halves of an arc over half a turn
    isInterior :: Bool,
    -- | on the asked side of an open contour; all runs beside a closed one
    isBeside :: Bool,
    -- | joins the offsets of two elements at an inner corner, and is an offset of none
    isConnecting :: Bool,
    from :: {-# UNPACK #-} Point,
    to :: {-# UNPACK #-} Point,
    -- | signed sweep in radians; 0 for a line
    turned :: Double
  }

-- | The runs of a loop in order, and the origin of the run before the first one.
data Circuit = Circuit {before :: Origin, runs :: [Run]}

-- | The runs of a loop, by the loop's number. They begin with a run that is not beside the contour
-- or, when there is none, with the one of the least origin.
circuit :: LoopRegion -> Int -> Circuit
circuit r k = circuitFrom r a z (fromMaybe (leastStart r a z) beyond)
  where
    beyond = find (not . isBesideAt r) (if contourEnds r == Open then [a .. z - 1] else [])
    a = indexPrimArray (Loop.starts (loops r)) k
    z = indexPrimArray (Loop.starts (loops r)) (k + 1)

-- | The runs of the raw offset of a contour at whose corners the cutter passes.
rawCircuit :: LoopRegion -> Circuit
rawCircuit r
  | z == 0 = Circuit (Along 0) []
  | otherwise = full {runs = filter (not . isConnecting) (takeWhile isBeside (runs full))}
  where
    full = circuitFrom r 0 z 0
    z = if Loop.count (loops r) == 0 then 0 else indexPrimArray (Loop.starts (loops r)) 1

-- | The first segment of the run with the least origin, among those from @a@ to before @z@. A run
-- around the end of the numbers begins before it, unless it is a full circle.
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

-- | The runs once around the segments from @a@ to before @z@, beginning at one of them.
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
      | otherwise = runAt r i after : go after (left - 1)
      where
        after = if i + 1 == z then a else i + 1

-- | The run of one segment of a loop, which ends at a vertex.
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

-- | The number of the segment of the raw offset that a segment of a loop is a part of.
rawAt :: LoopRegion -> Int -> Int
rawAt r i = fromIntegral (indexPrimArray (Loop.raws (loops r)) i)

markAt :: LoopRegion -> Int -> Word8
markAt r i = indexPrimArray (ClosedPolyarcs.marks (raw r)) (rawAt r i)

isAroundAt :: LoopRegion -> Int -> Bool
isAroundAt r i = ClosedPolyarcs.hasMark ClosedPolyarcs.aroundMark (markAt r i)

isConnectingAt :: LoopRegion -> Int -> Bool
isConnectingAt r i = ClosedPolyarcs.hasMark ClosedPolyarcs.connectingMark (markAt r i)

-- | The number of the segment of the flat contour. An open contour is traversed there and back.
flatAt :: LoopRegion -> Int -> Int
flatAt r i = fromIntegral (indexPrimArray (ClosedPolyarcs.sources (raw r)) (rawAt r i))

originAt :: LoopRegion -> Int -> Origin
originAt r i = if isAroundAt r i then Around element else Along element
  where
    k = flatAt r i
    n = sizeofPrimArray (numbers r)
    element = indexPrimArray (numbers r) (if k < n then k else 2 * n - 1 - k)

-- | Excludes the way back along an open contour, and the arcs about its ends.
isBesideAt :: LoopRegion -> Int -> Bool
isBesideAt r i = contourEnds r == Closed || flatAt r i < (if isAroundAt r i then n - 1 else n)
  where
    n = sizeofPrimArray (numbers r)

-- | The segments of a path along runs. The structure is the request that the kernel answered: its
-- radius may be smaller than that of the source by 'Tolerance.clearance', for a cutter that just
-- fits. The first segment follows a run of the given origin when the path is closed. Segments are
-- not chained yet: neighbours may differ by 'Tolerance.coincident' where they join.
path :: OffsetSource -> OffsetSource -> Maybe Origin -> [Run] -> [OffsetSegment]
path structure source previous runs = case joined (filter (not . isNegligible structure) runs) of
  [] -> []
  first : rest -> go (previous >>= \o -> joint o first) first rest
    where
      go cuts run others = segmentOf (front <$> cuts) run (back <$> cuts') : more
        where
          (cuts', more) = case others of
            [] -> (if isJust previous then joint (origin run) first else Nothing, [])
            r : rs -> let c = joint (origin run) r in (c, go c r rs)
  where
    joint = jointBetween structure source
    segmentOf = exactSegment structure source

-- | Makes one run of consecutive runs along one arc.
joined :: [Run] -> [Run]
joined runs = case runs of
  p : q : more
    | origin p == origin q && turned p /= 0 && turned q /= 0 ->
      joined (p {to = to q, turned = turned p + turned q} : more)
    | otherwise -> p : joined (q : more)
  _ -> runs

-- | What the kernel leaves at a corner that counts as smooth, between both halves of an arc, or at
-- a slight inner corner where an intersection is lost in rounding.
isNegligible :: OffsetSource -> Run -> Bool
isNegligible structure run = case origin run of
  Around i -> turned run /= 0 && cornerAt structure i == Smooth || isInterior run && isShort
  Along _ -> (isConnecting run || isInterior run) && isShort
  where
    isShort = Vec.distance (from run) (to run) <= Tolerance.clearance

-- | The cuts of two neighbouring elements that join at a smooth or slight corner; nothing for other
-- neighbours, and where the kernel found another intersection of both.
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
        -- The element's own end is near enough to where it is cut.
        distance = Vec.distance (from run) (Segment.end (movedElement structure i))

-- | The segment of a run. Its ends are cut by the given lengths, or are the ends of the exact
-- offset, or, where these are not the run's, its own.
exactSegment :: OffsetSource -> OffsetSource -> Maybe Double -> Run -> Maybe Double -> OffsetSegment
exactSegment structure source front run back = OffsetSegment (origin run) $ case origin run of
  Along i
    | isConnecting run -> Straight (from run) (to run)
    | otherwise -> both (`movedElement` i)
  Around i
    | turned run /= 0 -> both (`cornerArc` i)
    | otherwise -> Straight (snapped i (from run)) (snapped i (to run))
  where
    -- Mostly both are one, and the segment is needed once only.
    both f =
      let exact = f source
          structural = if radius structure == radius source then exact else f structure
       in partOf front run back structural exact
    -- The exact point of the corner that is closest to a vertex.
    snapped i p
      | Vec.isNear p nearest = snd pair
      | otherwise = p
      where
        pair@(nearest, _) = minimumBy (comparing (Vec.distance p . fst)) points
        points = zip (cornerPoints structure i) (cornerPoints source i)

-- | The part of an exact segment that a run covers, given the one of the structure.
partOf :: Maybe Double -> Run -> Maybe Double -> Segment -> Segment -> Segment
partOf front run back structural exact
  | startsThere && endsThere = whole
  | otherwise = case exact of
    Arc {centre} | turned run /= 0 -> Arc {start, end, centre, sweep = sweepNear centre}
    _ -> Straight start end
  where
    startsThere = isJust front || Vec.isNear (from run) (Segment.start structural)
    endsThere = isJust back || Vec.isNear (to run) (Segment.end structural)
    whole
      | Mm (a + b) < Segment.length exact = shortened a b exact
      | otherwise = exact
    a = fromMaybe 0 front
    b = fromMaybe 0 back
    start = if startsThere then Segment.start whole else from run
    end = if endsThere then Segment.end whole else to run
    -- The sweep between both ends that is nearest to the run's.
    sweepNear centre =
      let Rad least = Vec.signedAngle (Vec.to centre start) (Vec.to centre end)
       in Rad (least + 2 * pi * fromIntegral (round ((turned run - least) / (2 * pi)) :: Int))
