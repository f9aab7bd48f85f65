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
    plain,
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
import Geometry.Index.SegmentTree (SegmentTree)
import Geometry.Index.SegmentTree qualified as SegmentTree
import Geometry.Polyarc (Ends (..))
import Geometry.Tolerance qualified as Tolerance
import Offset.Arrangement qualified as Arrangement
import Offset.Certificate qualified as Certificate
import Offset.Loop (OffsetLoops)
import Offset.Loop qualified as Loop
import Offset.RawOffset (Corners (..))
import Offset.RawOffset qualified as RawOffset
import Offset.SelfIntersection (SearchResult (..), SelfIntersections)
import Offset.SelfIntersection qualified as SelfIntersection
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
plain :: Side -> Mm -> OffsetRequest
plain side distance = OffsetRequest {side, corners = Round, distance, extra = Nothing}

-- | The loops, in the direction of travel of the source, and the raw offset of which they are
-- parts.
data ReachableRegion = ReachableRegion {loops :: OffsetLoops, raw :: ClosedPolyarcs}

data OffsetFault
  = -- | two segments of the source intersect; they are numbered through all contours
    Crossed Int Int
  | -- | a contour is nested in the others against its sense
    Misplaced
  | -- | no result passed its certificate
    Uncertain
  deriving stock (Eq, Show)

-- | The region that the cutter's centre can reach. The contours are all closed, or there is a
-- single open one.
offset :: OffsetRequest -> [FlatPolyarc] -> Either OffsetFault ReachableRegion
offset task outlines = do
  wanted <- first bothWays (wantedOf (rounding problem) (turn problem) open source sourceBoxes)
  let hopeful = filter (not . hopeless problem chain) [0 .. ClosedPolyarcs.walks chain - 1]
  if length hopeful == ClosedPolyarcs.walks chain
    then reachOf problem wanted raws sourceBoxes
    else reached problem wanted (ClosedPolyarcs.only hopeful chain)
  where
    open = isOpen outlines
    number = numberThere outlines
    bothWays fault = case fault of
      Crossed i j -> let (a, b) = (number i, number j) in Crossed (min a b) (max a b)
      Misplaced -> Misplaced
      Uncertain -> Uncertain
    (problem, chain) = problemOf task outlines
    raws@(_, source) = rawOf problem chain
    sourceBoxes = SegmentTree.boxes (rounding problem) source

-- | The raw offset before trimming. Here a contour may intersect itself.
rawOffset :: OffsetRequest -> [FlatPolyarc] -> ClosedPolyarcs
rawOffset task outlines = fst (rawOf problem chain)
  where
    (problem, chain) = problemOf task outlines

isOpen :: [FlatPolyarc] -> Bool
isOpen = any ((== Open) . FlatPolyarc.ends)

-- | The original number of a segment. An open contour is traversed forwards and then backwards,
-- so its segments have two numbers.
numberThere :: [FlatPolyarc] -> Int -> Int
numberThere outlines
  | isOpen outlines = \i -> if i >= count then 2 * count - 1 - i else i
  | otherwise = id
  where
    count = sum (map FlatPolyarc.size outlines)

-- | The parameters that all contours share, and the contours as flat arrays.
problemOf :: OffsetRequest -> [FlatPolyarc] -> (Problem, ClosedPolyarcs)
problemOf task outlines = (problem, chain)
  where
    turn = turnOf (side task)
    Mm d = distance task
    segmentCount = sum (map FlatPolyarc.size outlines)
    more i = case extra task of
      Nothing -> 0
      Just f -> let Mm e = f (there i) in e
    there = numberThere outlines
    largest = case extra task of
      Nothing -> d
      Just _ -> d + maximum (0 : map more [0 .. segmentCount - 1])
    tolerance = Tolerance.rounding * (ClosedPolyarcs.extent outlines + largest)
    chain =
      ClosedPolyarcs.fromOutlines
        tolerance
        (if isOpen outlines then map ClosedPolyarcs.twoSided outlines else outlines)
    problem =
      Problem
        { turn,
          rounding = tolerance,
          least = d,
          widest = largest,
          distances = \i -> d + more i,
          rawOf = if largest == 0 then still else raw
        }
    -- At the distance 0 no joints are needed.
    still c = let (_, marked) = raw c in (marked, marked)
    signed = case side task of
      LeftOf -> -1
      RightOf -> 1
    raw c = case extra task of
      Nothing ->
        RawOffset.raw
          tolerance
          Tolerance.tangential
          (corners task)
          False
          (const (signed * d))
          (const (signed * d))
          c
      Just _ ->
        RawOffset.raw
          tolerance
          Tolerance.tangential
          (corners task)
          True
          (\i -> signed * within c i)
          (\i -> signed * wanting c i)
          c
    -- Towards its centre an arc moves by its radius at most; a larger additional distance would
    -- leave its sector.
    within c i
      | asked > d && signed * indexPrimArray (ClosedPolyarcs.bulges c) i < 0 =
        min asked (max d (0.5 * ClosedPolyarcs.diameter c i))
      | otherwise = asked
      where
        asked = wanting c i
    wanting c i = d + more (fromIntegral (indexPrimArray (ClosedPolyarcs.sources c) i))

turnOf :: Side -> Sense
turnOf s = case s of
  LeftOf -> CounterClockwise
  RightOf -> Clockwise

-- | The parameters that all contours share: the sense in which the outer boundary of the
-- reachable region is traversed, the tolerance for rounding, the least, the largest and each
-- segment's distance (all in mm), and the function that makes the raw offset.
data Problem = Problem
  { turn :: Sense,
    rounding :: Double,
    least :: Double,
    widest :: Double,
    distances :: Int -> Double,
    rawOf :: ClosedPolyarcs -> (ClosedPolyarcs, ClosedPolyarcs)
  }

reached :: Problem -> Int -> ClosedPolyarcs -> Either OffsetFault ReachableRegion
reached problem wanted c =
  let raws@(_, source) =
        rawOf problem c
   in reachOf problem wanted raws (SegmentTree.boxes (rounding problem) source)

-- | The loops of a raw offset, given with its source and the source's bounding-box tree.
reachOf ::
  Problem ->
  Int ->
  (ClosedPolyarcs, ClosedPolyarcs) ->
  SegmentTree ->
  Either OffsetFault ReachableRegion
reachOf Problem {turn, rounding, least, widest, distances} wanted (rough, source) sourceBoxes =
  case maybe id (:) inGeneral decided of
    found : _ -> Right ReachableRegion {loops = found, raw = rough}
    [] -> Left Uncertain
  where
    inGeneral = case generalPosition of
      Nothing -> Nothing
      Just (bs, xs) -> Trimming.clip rounding wanted rough bs xs >>= certified
    generalPosition :: Maybe (SegmentTree, SelfIntersections)
    generalPosition =
      let bs = SegmentTree.boxes rounding rough
       in case SelfIntersection.find rounding rough bs of
            Unclear -> Nothing
            SearchResult xs -> Just (bs, xs)
    decided = mapMaybe byArrangement (take 5 (iterate (* 10) (100 * rounding)))
    byArrangement within = do
      a <- Arrangement.arrange within rough (SegmentTree.boxes within rough)
      Arrangement.loops turn wanted a >>= certified
    measure =
      Certificate.Clearance
        { Certificate.slack = 1e5 * rounding,
          Certificate.least = least,
          Certificate.largest = widest,
          Certificate.distance = distances,
          Certificate.turn = turn
        }
    -- When one cutter position covers the whole source except the tips of its corners, the winding
    -- numbers of unreachable positions equal those of reachable ones.
    certified answer
      | all sound loops' = Just found
      | ClosedPolyarcs.walks source == 1 && all (\k -> sound k || covering k) loops' =
        Just (Loop.only sound found)
      | otherwise = Nothing
      where
        found = Loop.only (not . flat) answer
        loops' = [0 .. Loop.count found - 1]
        sound = Certificate.clear measure source sourceBoxes found
        covering = Certificate.covers measure source found
        -- A tiny loop of few segments may be an artefact of rounding.
        flat k =
          Loop.size answer k <= 4
            && abs (FlatPolyarc.area (Loop.outline answer k)) <= rounding * rounding

-- | True when one of several contours bounds a region too small for the cutter. If a cutter
-- covers such a region completely, the winding number would count it as reachable; computed
-- separately, it gives no loop.
hopeless :: Problem -> ClosedPolyarcs -> Int -> Bool
hopeless problem c w = ClosedPolyarcs.walks c > 1 && outer && near && nothing
  where
    o = ClosedPolyarcs.closed c w
    area = FlatPolyarc.area o
    -- If every segment is at most d away from one point, the area seen from that point is at most
    -- d/2 times the total length of the segments.
    near = let Mm l = FlatPolyarc.length o in abs area <= 0.5 * widest problem * l * (1 + 1e-9)
    -- The winding number on the left of this contour if it were the only one.
    (outer, left) = case turn problem of
      CounterClockwise -> (area > 0, 1)
      Clockwise -> (area < 0, 0)
    nothing = case reached problem left (ClosedPolyarcs.only [w] c) of
      Right reach -> Loop.count (loops reach) == 0
      Left _ -> False

-- | The winding number of the reachable region as seen from the left of the source: 1 when the
-- outermost contour is counter-clockwise, else 0. Refuses a source that intersects itself or
-- whose contours are nested against their sense.
wantedOf :: Double -> Sense -> Bool -> ClosedPolyarcs -> SegmentTree -> Either OffsetFault Int
wantedOf tolerance turn open source bs
  | ClosedPolyarcs.walks source == 0 = Right unbounded
  | open =
    maybe (Right unbounded) (Left . uncurry crossed) (SelfIntersection.proper tolerance source bs)
  | otherwise = case SelfIntersection.find tolerance source bs of
    SearchResult xs
      | SelfIntersection.count xs > 0 -> Left (uncurry crossed (SelfIntersection.firstOf xs 0))
      | Just lefts <- traverse outside [0 .. ClosedPolyarcs.walks source - 1],
        wanted : others <- lefts ->
        if all (== wanted) others && (wanted == 0 || wanted == 1)
          then Right wanted
          else Left Misplaced
    _ -> fromArrangement (take 5 (iterate (* 10) (100 * tolerance)))
  where
    crossed i j = let (a, b) = (number i, number j) in Crossed (min a b) (max a b)
    number i = fromIntegral (indexPrimArray (ClosedPolyarcs.sources source) i)
    unbounded = case turn of
      CounterClockwise -> 0
      Clockwise -> 1
    outside w =
      let e = WindingNumber.extreme Leftmost source bs w
       in ( +
              ( if ClosedPolyarcs.walks source == 1
                  then 0
                  else
                    WindingNumber.at
                      source
                      bs
                      (WindingNumber.x e - 4 * tolerance)
                      (WindingNumber.y e)
              )
          )
            <$> WindingNumber.leftMore e
    fromArrangement withins =
      case mapMaybe
        (\within -> Arrangement.arrange within source (SegmentTree.boxes within source))
        withins of
        [] -> Left Uncertain
        a : _ -> case Arrangement.numbers a of
          (0, 0) -> Right unbounded
          (0, 1) -> Right 1
          (-1, 0) -> Right 0
          (_, high) ->
            Left
              ( maybe
                  Misplaced
                  (uncurry crossed)
                  (Arrangement.crossed (if high > 0 then (0, 1) else (-1, 0)) a)
              )
