{-# OPTIONS_GHC -O2 #-}

-- | The offset kernel: it computes the boundary of all positions that a cutter's centre can reach
-- beside closed contours, or on one side of an open one.
--
-- The reachable region lies on the same side of every contour: inside an outer contour and outside
-- its islands, or outside all contours. The raw offset ("Offset.RawOffset") moves the contours to
-- that side and keeps all self-intersections. It deforms continuously with the distance, so its
-- winding number is the wanted number exactly at the reachable positions, and always differs from
-- it in the same direction elsewhere. The reachable region is therefore found by winding numbers
-- (Chen and McMains, "Polygon offsetting by computing winding numbers", 2005).
--
-- In general position "Offset.Trimming" needs a single traversal of the raw offset. Where segments
-- touch or coincide, "Offset.Arrangement" first cuts all of them. Every loop must pass the check of
-- "Offset.Certificate" before it is returned. Otherwise the kernel refuses with 'Uncertain'.
module Offset.Kernel
  ( Corners (..),
    OffsetRequest (..),
    ReachableRegion (..),
    OffsetFault (..),
    offset,
    rawOffset,
    roundOffset,
  )
where

import Base.Quantity (Mm (..))
import Data.Bifunctor (first)
import Data.Maybe (mapMaybe)
import Data.Primitive.PrimArray
import Geometry.Carrier (Sense (..), Side (..))
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Index.SegmentBoxTree (SegmentBoxTree)
import Geometry.Index.SegmentBoxTree qualified as SegmentBoxTree
import Geometry.Polyarc (Ends (..))
import Offset.Arrangement qualified as Arrangement
import Offset.Certificate qualified as Certificate
import Offset.Loop (OffsetLoops)
import Offset.Loop qualified as Loop
import Offset.RawOffset (Corners (..))
import Offset.RawOffset qualified as RawOffset
import Offset.SelfIntersection (SearchResult (..), SelfIntersections)
import Offset.SelfIntersection qualified as SelfIntersection
import Offset.Tolerance qualified as Tolerance
import Offset.Trimming qualified as Trimming
import Offset.WindingNumber (Outward (..))
import Offset.WindingNumber qualified as WindingNumber

-- | A request: the side, the style of corners, the distance of the centre (mm, not negative), and
-- an additional distance for each segment. Segments are numbered through all contours.
data OffsetRequest = OffsetRequest
  { side :: Side,
    corners :: Corners,
    distance :: Mm,
    extra :: Maybe (Int -> Mm)
  }

-- | A request for one distance and round corners.
roundOffset :: Side -> Mm -> OffsetRequest
roundOffset side distance = OffsetRequest {side, corners = Round, distance, extra = Nothing}

-- | The loops, in the direction of travel of the source, and the raw offset of which they are
-- parts.
data ReachableRegion = ReachableRegion {loops :: OffsetLoops, raw :: ClosedPolyarcs}

data OffsetFault
  = -- | two segments of the source intersect; they are numbered through all contours
    SelfIntersecting Int Int
  | -- | a contour is nested in the others against its sense
    WrongNesting
  | -- | no result passed its certificate
    Uncertain
  deriving stock (Eq, Show)

-- | The region that the cutter's centre can reach. The contours are all closed, or there is a
-- single open one.
offset :: OffsetRequest -> [FlatPolyarc] -> Either OffsetFault ReachableRegion
offset request contours = do
  wanted <-
    first
      withOriginalNumbers
      (wantedNumber (rounding problem) (sense problem) open source sourceBoxes)
  let remaining =
        filter (not . isUnreachable problem chain) [0 .. ClosedPolyarcs.loopCount chain - 1]
  if length remaining == ClosedPolyarcs.loopCount chain
    then regionOf problem wanted raws sourceBoxes
    else regionOfContours problem wanted (ClosedPolyarcs.restrictTo remaining chain)
  where
    open = isOpen contours
    number = originalNumber contours
    withOriginalNumbers fault = case fault of
      SelfIntersecting i j ->
        let (a, b) =
              (number i, number j)
         in SelfIntersecting (min a b) (max a b)
      WrongNesting -> WrongNesting
      Uncertain -> Uncertain
    (problem, chain) = problemOf request contours
    raws@(_, source) = rawOf problem chain
    sourceBoxes = SegmentBoxTree.build (rounding problem) source

-- | The raw offset before trimming. Here a contour may intersect itself.
rawOffset :: OffsetRequest -> [FlatPolyarc] -> ClosedPolyarcs
rawOffset request contours = fst (rawOf problem chain)
  where
    (problem, chain) = problemOf request contours

-- | True when one of the contours is open.
isOpen :: [FlatPolyarc] -> Bool
isOpen = any ((== Open) . FlatPolyarc.ends)

-- | The original number of a segment. An open contour is traversed forwards and then backwards,
-- so its segments have two numbers.
originalNumber :: [FlatPolyarc] -> Int -> Int
originalNumber contours
  | isOpen contours = \i -> if i >= count then 2 * count - 1 - i else i
  | otherwise = id
  where
    count = sum (map FlatPolyarc.size contours)

-- | The parameters that all contours share, and the contours as flat arrays.
problemOf :: OffsetRequest -> [FlatPolyarc] -> (Problem, ClosedPolyarcs)
problemOf request contours = (problem, chain)
  where
    sense = senseOf (side request)
    Mm d = distance request
    segmentCount = sum (map FlatPolyarc.size contours)
    more i = case extra request of
      Nothing -> 0
      Just f -> let Mm e = f (original i) in e
    original = originalNumber contours
    largest = case extra request of
      Nothing -> d
      Just _ -> d + maximum (0 : map more [0 .. segmentCount - 1])
    tolerance = Tolerance.rounding * (ClosedPolyarcs.largestCoordinate contours + largest)
    chain =
      ClosedPolyarcs.fromFlatPolyarcs
        tolerance
        (if isOpen contours then map ClosedPolyarcs.twoSided contours else contours)
    problem =
      Problem
        { sense,
          rounding = tolerance,
          least = d,
          widest = largest,
          distances = \i -> d + more i,
          rawOf = if largest == 0 then unmoved else raw
        }
    -- At the distance 0 no joints are needed.
    unmoved c = let (_, marked) = raw c in (marked, marked)
    signed = case side request of
      LeftOf -> -1
      RightOf -> 1
    raw c = case extra request of
      Nothing ->
        RawOffset.raw
          tolerance
          Tolerance.tangential
          (corners request)
          False
          (const (signed * d))
          (const (signed * d))
          c
      Just _ ->
        RawOffset.raw
          tolerance
          Tolerance.tangential
          (corners request)
          True
          (\i -> signed * limited c i)
          (\i -> signed * requested c i)
          c
    -- Towards its centre an arc moves by its radius at most; a larger additional distance would
    -- leave its sector.
    limited c i
      | requestedDistance > d && signed * indexPrimArray (ClosedPolyarcs.bulges c) i < 0 =
        min requestedDistance (max d (0.5 * ClosedPolyarcs.diameter c i))
      | otherwise = requestedDistance
      where
        requestedDistance = requested c i
    requested c i = d + more (fromIntegral (indexPrimArray (ClosedPolyarcs.sources c) i))

-- | The sense of an outer contour whose reachable side is its left or right one.
senseOf :: Side -> Sense
senseOf s = case s of
  LeftOf -> CounterClockwise
  RightOf -> Clockwise

-- | The parameters that all contours share: the sense in which the outer boundary of the
-- reachable region is traversed, the tolerance for rounding, the least, the largest and each
-- segment's distance (all in mm), and the function that makes the raw offset.
data Problem = Problem
  { sense :: Sense,
    rounding :: Double,
    least :: Double,
    widest :: Double,
    distances :: Int -> Double,
    rawOf :: ClosedPolyarcs -> (ClosedPolyarcs, ClosedPolyarcs)
  }

-- | The reachable region of contours. Computes their raw offset first.
regionOfContours :: Problem -> Int -> ClosedPolyarcs -> Either OffsetFault ReachableRegion
regionOfContours problem wanted c =
  let raws@(_, source) =
        rawOf problem c
   in regionOf problem wanted raws (SegmentBoxTree.build (rounding problem) source)

-- | The loops of a raw offset, given with its source and the source's bounding-box tree.
regionOf ::
  Problem ->
  Int ->
  (ClosedPolyarcs, ClosedPolyarcs) ->
  SegmentBoxTree ->
  Either OffsetFault ReachableRegion
regionOf problem wanted (untrimmed, source) sourceBoxes =
  case maybe id (:) byTrimming byArrangements of
    found : _ -> Right ReachableRegion {loops = found, raw = untrimmed}
    [] -> Left Uncertain
  where
    Problem {sense, rounding, least, widest, distances} = problem
    byTrimming = case generalPosition of
      Nothing -> Nothing
      Just (boxes, xs) -> Trimming.trim rounding wanted untrimmed boxes xs >>= certified
    generalPosition :: Maybe (SegmentBoxTree, SelfIntersections)
    generalPosition =
      let boxes = SegmentBoxTree.build rounding untrimmed
       in case SelfIntersection.find rounding untrimmed boxes of
            NotGeneral -> Nothing
            SearchResult xs -> Just (boxes, xs)
    byArrangements = mapMaybe byArrangement (take 5 (iterate (* 10) (100 * rounding)))
    byArrangement tolerance = do
      a <- Arrangement.arrange tolerance untrimmed (SegmentBoxTree.build tolerance untrimmed)
      Arrangement.loops sense wanted a >>= certified
    measure =
      Certificate.Clearance
        { Certificate.slack = 1e5 * rounding,
          Certificate.leastDistance = least,
          Certificate.largestDistance = widest,
          Certificate.distance = distances,
          Certificate.sense = sense
        }
    -- When one cutter position covers the whole source except the tips of its corners, the winding
    -- numbers of unreachable positions equal those of reachable ones.
    certified answer
      | all isSound loops' = Just found
      | ClosedPolyarcs.loopCount source == 1 && all (\k -> isSound k || isCovering k) loops' =
        Just (Loop.filtered isSound found)
      | otherwise = Nothing
      where
        found = Loop.filtered (not . isArtefact rounding answer) answer
        loops' = [0 .. Loop.count found - 1]
        isSound = Certificate.isClear measure source sourceBoxes found
        isCovering = Certificate.coversSource measure source found

-- | True for a tiny loop of few segments, which may be an artefact of rounding (tolerance in mm).
isArtefact :: Double -> OffsetLoops -> Int -> Bool
isArtefact tolerance answer k =
  Loop.size answer k <= 4
    && abs (FlatPolyarc.area (Loop.polyarc answer k)) <= tolerance * tolerance

-- | True when one of several contours bounds a region too small for the cutter. If a cutter
-- covers such a region completely, the winding number would count it as reachable; computed
-- separately, it gives no loop.
isUnreachable :: Problem -> ClosedPolyarcs -> Int -> Bool
isUnreachable problem c w = ClosedPolyarcs.loopCount c > 1 && isOuter && isSmall && hasNoLoops
  where
    o = ClosedPolyarcs.toFlatPolyarc c w
    area = FlatPolyarc.area o
    -- If every segment is at most d away from one point, the area seen from that point is at most
    -- d/2 times the total length of the segments.
    isSmall = let Mm l = FlatPolyarc.length o in abs area <= 0.5 * widest problem * l * (1 + 1e-9)
    -- The winding number on the left of this contour if it were the only one.
    (isOuter, left) = case sense problem of
      CounterClockwise -> (area > 0, 1)
      Clockwise -> (area < 0, 0)
    hasNoLoops = case regionOfContours problem left (ClosedPolyarcs.restrictTo [w] c) of
      Right region -> Loop.count (loops region) == 0
      Left _ -> False

-- | The winding number of the reachable region as seen from the left of the source: 1 when the
-- outermost contour is counter-clockwise, else 0. Refuses a source that intersects itself or
-- whose contours are nested against their sense.
wantedNumber ::
  Double ->
  Sense ->
  Bool ->
  ClosedPolyarcs ->
  SegmentBoxTree ->
  Either OffsetFault Int
wantedNumber tolerance sense open source boxes
  | ClosedPolyarcs.loopCount source == 0 = Right unbounded
  | open =
    maybe
      (Right unbounded)
      (Left . uncurry crossed)
      (SelfIntersection.properCrossing tolerance source boxes)
  | otherwise = case SelfIntersection.find tolerance source boxes of
    SearchResult xs
      | SelfIntersection.count xs > 0 -> Left (uncurry crossed (SelfIntersection.segmentPair xs 0))
      | Just lefts <- traverse outside [0 .. ClosedPolyarcs.loopCount source - 1],
        wanted : others <- lefts ->
        if all (== wanted) others && (wanted == 0 || wanted == 1)
          then Right wanted
          else Left WrongNesting
    _ -> numberByArrangement crossed unbounded tolerance source
  where
    crossed i j = let (a, b) = (number i, number j) in SelfIntersecting (min a b) (max a b)
    number i = fromIntegral (indexPrimArray (ClosedPolyarcs.sources source) i)
    unbounded = case sense of
      CounterClockwise -> 0
      Clockwise -> 1
    outside w =
      let e = WindingNumber.extreme Leftmost source boxes w
       in ( +
              ( if ClosedPolyarcs.loopCount source == 1
                  then 0
                  else
                    WindingNumber.at
                      source
                      boxes
                      (WindingNumber.x e - 4 * tolerance)
                      (WindingNumber.y e)
              )
          )
            <$> WindingNumber.leftExcess e

-- | The same number from an arrangement, for a source in special position. The first argument makes
-- the fault of two segments that intersect; the second one is the number of an unbounded region.
numberByArrangement ::
  (Int -> Int -> OffsetFault) ->
  Int ->
  Double ->
  ClosedPolyarcs ->
  Either OffsetFault Int
numberByArrangement crossed unbounded tolerance source =
  case mapMaybe
    (\t -> Arrangement.arrange t source (SegmentBoxTree.build t source))
    (take 5 (iterate (* 10) (100 * tolerance))) of
    [] -> Left Uncertain
    a : _ -> case Arrangement.windingNumbers a of
      (0, 0) -> Right unbounded
      (0, 1) -> Right 1
      (-1, 0) -> Right 0
      (_, high) ->
        Left
          ( maybe
              WrongNesting
              (uncurry crossed)
              (Arrangement.intersectingSegments (if high > 0 then (0, 1) else (-1, 0)) a)
          )
