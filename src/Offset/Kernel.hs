{-# OPTIONS_GHC -O2 #-}

-- | The offset kernel: it computes the boundary of all positions that a cutter's centre can reach
-- beside closed contours, or on one side of an open one.
--
-- The reachable region lies on the same side of every contour, left or right: inside an outer
-- contour and outside its islands, or outside all contours. The raw offset ("Offset.RawOffset")
-- moves the contours to that side and keeps all self-intersections. It deforms continuously as the
-- distance grows from 0. Therefore the raw offset has one known winding number at all reachable
-- positions (Chen and McMains, "Polygon offsetting by computing winding numbers", 2005). At other
-- positions the winding number is smaller if the region is on the left of the contours, larger if
-- it is on their right. The only exception is a position at which the cutter covers a whole pocket:
-- it can have the winding number of the reachable positions. The kernel discards such positions.
--
-- When the segments of the raw offset only cross each other between their ends (general position),
-- "Offset.Trimming" finds the region in a single traversal. If any segments touch or coincide,
-- "Offset.Arrangement" finds it: it first cuts all segments at the points that they have in common.
-- Every loop must pass the check of "Offset.Certificate" before it is returned; otherwise the
-- kernel answers 'Uncertain'.
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
import Geometry.Carrier (Sense (..), Side)
import Geometry.Carrier qualified as Carrier
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

-- | A request for an offset: the side, the form of the corners, and the distances.
data OffsetRequest = OffsetRequest
  { -- | the cutter's side of every contour: left or right in the contour's direction of travel
    side :: Side,
    corners :: Corners,
    -- | distance in mm of the cutter's centre from the contours; not negative
    distance :: Mm,
    -- | extra distance in mm from a segment, not negative, by the segment's number. Segments are
    -- numbered from 0 through all contours. Nothing when there are no extra distances
    extra :: Maybe (Int -> Mm)
  }

-- | A request for the same distance (mm) from all segments, with round corners.
roundOffset :: Side -> Mm -> OffsetRequest
roundOffset side distance = OffsetRequest {side, corners = Round, distance, extra = Nothing}

-- | The loops that bound the reachable region, and the raw offset from which they were cut. Both
-- have the contours' direction of travel.
data ReachableRegion = ReachableRegion {loops :: OffsetLoops, raw :: ClosedPolyarcs}

-- | A reason why there is no offset.
data OffsetFault
  = -- | two segments of the contours intersect; they are numbered from 0 through all contours
    SelfIntersecting Int Int
  | -- | the senses of the contours do not fit their nesting: outermost contours must have one
    -- sense, and islands the opposite one
    WrongNesting
  | -- | no computed result passed the check of "Offset.Certificate", or no arrangement of the
    -- contours had winding numbers that agree
    Uncertain
  deriving stock (Eq, Show)

-- | The region that the cutter's centre can reach, as the request describes it. The contours are
-- all closed, or there is a single open one.
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

-- | The raw offset before trimming. The contours may intersect themselves.
rawOffset :: OffsetRequest -> [FlatPolyarc] -> ClosedPolyarcs
rawOffset request contours = fst (rawOf problem chain)
  where
    (problem, chain) = problemOf request contours

-- | True when one of the contours is open.
isOpen :: [FlatPolyarc] -> Bool
isOpen = any ((== Open) . FlatPolyarc.ends)

-- | The number of a segment in the given contours, by the number that 'ClosedPolyarcs.sources' has
-- for it. The numbers differ only for an open contour. It is traversed forwards and then backwards,
-- so 'ClosedPolyarcs.sources' has two numbers for each of its segments.
originalNumber :: [FlatPolyarc] -> Int -> Int
originalNumber contours
  | isOpen contours = \i -> if i >= count then 2 * count - 1 - i else i
  | otherwise = id
  where
    count = sum (map FlatPolyarc.size contours)

-- | The parameters that the kernel derives from the request, and the contours as flat arrays.
problemOf :: OffsetRequest -> [FlatPolyarc] -> (Problem, ClosedPolyarcs)
problemOf request contours = (problem, chain)
  where
    Mm d = distance request
    segmentCount = sum (map FlatPolyarc.size contours)
    original = originalNumber contours
    more = additional request original
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
        { sense = Carrier.senseTowards (side request),
          rounding = tolerance,
          least = d,
          widest = largest,
          distances = \i -> d + more i,
          rawOf = if largest == 0 then unmoved else raw
        }
    raw = rawWith request tolerance original
    -- At the distance 0 the raw offset is the contours themselves, with their smooth joints marked.
    unmoved c = let (_, marked) = raw c in (marked, marked)

-- | The extra distance in mm of a segment for which 'ClosedPolyarcs.sources' has the number @i@.
-- @original@ turns this number into the segment's number in the given contours.
additional :: OffsetRequest -> (Int -> Int) -> Int -> Double
additional request original i = case extra request of
  Nothing -> 0
  Just f -> let Mm e = f (original i) in e

-- | The raw offset of the contours @c@ in flat arrays, and @c@ itself with its smooth joints
-- marked. @tolerance@ (mm) covers rounding. @original@ turns a number of 'ClosedPolyarcs.sources'
-- into the segment's number in the given contours.
rawWith ::
  OffsetRequest ->
  Double ->
  (Int -> Int) ->
  ClosedPolyarcs ->
  (ClosedPolyarcs, ClosedPolyarcs)
rawWith request tolerance original c = case extra request of
  Nothing -> rawAt False (const (signed * d)) (const (signed * d))
  Just _ -> rawAt True (\i -> signed * limited i) (\i -> signed * requested i)
  where
    Mm d = distance request
    signed = -Carrier.sideSign (side request)
    rawAt uneven at corner =
      RawOffset.raw tolerance Tolerance.tangential (corners request) uneven at corner c
    {-# INLINE rawAt #-}
    -- An extra distance does not move an arc past its centre. Past it, the arc would lie outside
    -- the sector between the radii to its ends.
    limited i
      | requestedDistance > d && signed * indexPrimArray (ClosedPolyarcs.bulges c) i < 0 =
        min requestedDistance (max d (0.5 * ClosedPolyarcs.diameter c i))
      | otherwise = requestedDistance
      where
        requestedDistance = requested i
    requested i =
      d + additional request original (fromIntegral (indexPrimArray (ClosedPolyarcs.sources c) i))

-- | The parameters that all contours of a request share. Distances are in mm.
data Problem = Problem
  { -- | the sense in which the outer boundary of the reachable region is traversed
    sense :: Sense,
    -- | the tolerance for rounding, in mm
    rounding :: Double,
    -- | the smallest distance, which the cutter's centre has to keep from every segment
    least :: Double,
    -- | the largest distance that the cutter's centre has to keep from a segment
    widest :: Double,
    -- | the distance that the cutter's centre has to keep from a segment, by the number that
    -- 'ClosedPolyarcs.sources' has for the segment
    distances :: Int -> Double,
    -- | the raw offset of contours, and the contours with their smooth joints marked
    rawOf :: ClosedPolyarcs -> (ClosedPolyarcs, ClosedPolyarcs)
  }

-- | The reachable region beside the contours @c@. @wanted@ is the winding number on the left of
-- every contour ('wantedNumber'). Computes the raw offset of @c@ first.
regionOfContours :: Problem -> Int -> ClosedPolyarcs -> Either OffsetFault ReachableRegion
regionOfContours problem wanted c =
  let raws@(_, source) =
        rawOf problem c
   in regionOf problem wanted raws (SegmentBoxTree.build (rounding problem) source)

-- | The reachable region. @wanted@ is the winding number on the left of every contour
-- ('wantedNumber'). @untrimmed@ is the raw offset, @source@ the contours from which it was made,
-- and @sourceBoxes@ the bounding-box tree of these contours.
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
    -- A loop that fails the check makes the answer invalid, with one exception. Where the cutter
    -- reaches every segment of a single contour at once, unreachable positions can have the winding
    -- number of the reachable ones. Loops around such positions are removed.
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

-- | True for a loop that may be an artefact of rounding: it has at most four segments, and its area
-- is at most the square of the tolerance (mm). @k@ is the number of the loop in @answer@.
isArtefact :: Double -> OffsetLoops -> Int -> Bool
isArtefact tolerance answer k =
  Loop.size answer k <= 4
    && abs (FlatPolyarc.area (Loop.polyarc answer k)) <= tolerance * tolerance

-- | True when contour @w@, one of several, is an outer contour and bounds a region too small for
-- the cutter: the offset of this contour alone has no loops. The kernel omits such a contour.
-- Otherwise a position at which the cutter covers the whole region could have the winding number of
-- the reachable positions.
isUnreachable :: Problem -> ClosedPolyarcs -> Int -> Bool
isUnreachable problem c w = ClosedPolyarcs.loopCount c > 1 && isOuter && isSmall && hasNoLoops
  where
    o = ClosedPolyarcs.toFlatPolyarc c w
    area = FlatPolyarc.area o
    -- If one point is at most @d@ mm away from every segment, the enclosed area is at most @d/2@
    -- times the total length of the segments. In a larger region no cutter position reaches every
    -- segment.
    isSmall = let Mm l = FlatPolyarc.length o in abs area <= 0.5 * widest problem * l * (1 + 1e-9)
    -- @left@ is the winding number on the left of this contour alone.
    (isOuter, left) = case sense problem of
      CounterClockwise -> (area > 0, 1)
      Clockwise -> (area < 0, 0)
    hasNoLoops = case regionOfContours problem left (ClosedPolyarcs.restrictTo [w] c) of
      Right region -> Loop.count (loops region) == 0
      Left _ -> False

-- | The winding number on the left of every contour, and so on the left of every loop of the
-- offset. It is 1 when the outermost contours are counter-clockwise, 0 when they are clockwise. An
-- open contour encloses nothing; its number is 0 for a cutter on the left, 1 for one on the right.
-- Reachable positions on the left of the loops have this number; reachable positions on their right
-- have one less. The function fails for contours that intersect or whose senses do not fit their
-- nesting. @tolerance@ (mm) covers rounding; @sense@ is that of the reachable region's outer
-- boundary; @open@ is True when the contour is open; @boxes@ is the bounding-box tree of the
-- contours @source@.
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

-- | The winding number on the left of every contour, found by an arrangement: 1 or 0. This serves
-- contours whose segments touch or coincide. @crossed@ makes the fault for the numbers of two
-- segments that intersect. @unbounded@ is the answer when the contours enclose nothing. The
-- tolerance (mm) covers rounding.
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
