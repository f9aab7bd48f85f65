{-# OPTIONS_GHC -O2 #-}

-- | The offset kernel: the boundary of all places where the centre of a cutter can stand beside
-- closed contours, or on one side of an open one.
--
-- The free places, where the centre may be as far as the contours go, lie on the same side of every
-- contour: inside an outline and outside the islands in it, or outside everything. The raw
-- equidistant ("Offset.RawOffset") is the contours moved to that side, with all its self-crossings.
-- Since it grows out of them without a jump, its winding number is that of the free places wherever
-- the cutter fits, and on one side of that everywhere else. So the answer is decided by counting.
-- In general position ("Offset.Trimming") that is one walk along the curve. Where segments meet at
-- their ends or lie along one another, "Offset.Arrangement" cuts all of them first. Every answer is
-- looked at once more ("Offset.Certificate") before it is given out.
module Offset.Kernel
  ( Corners (..),
    OffsetRequest (..),
    ReachableRegion (..),
    OffsetFault (..),
    offset,
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

-- | What is asked: the side, the corners, the distance of the centre (not negative), and by how
-- much more it stays from the segments, by their numbers through all outlines.
data OffsetRequest = OffsetRequest
  { side :: Side,
    corners :: Corners,
    distance :: Mm,
    extra :: Maybe (Int -> Mm)
  }

-- | A distance on a side, with round corners.
plain :: Side -> Mm -> OffsetRequest
plain side distance = OffsetRequest {side, corners = Round, distance, extra = Nothing}

-- | The loops, walked in the direction of the source; and the raw equidistant that they are parts
-- of.
data ReachableRegion = ReachableRegion {loops :: OffsetLoops, raw :: ClosedPolyarcs}

data OffsetFault
  = -- | two segments of the source cross, by their numbers through all outlines
    Crossed Int Int
  | -- | an outline does not lie inside or outside the others as its sense would have it
    Misplaced
  | -- | the answer failed its certificate
    Uncertain
  deriving stock (Eq, Show)

-- | What the cutter's centre can reach beside outlines that are all closed, or one that is open.
offset :: OffsetRequest -> [FlatPolyarc] -> Either OffsetFault ReachableRegion
offset task outlines = do
  wanted <- first bothWays (wantedOf tolerance turn open source sourceBoxes)
  let hopeful = filter (not . hopeless problem chain) [0 .. ClosedPolyarcs.walks chain - 1]
  if length hopeful == ClosedPolyarcs.walks chain
    then reachOf problem wanted raws sourceBoxes
    else reached problem wanted (ClosedPolyarcs.only hopeful chain)
  where
    open = any ((== Open) . FlatPolyarc.ends) outlines
    turn = turnOf (side task)
    Mm d = distance task
    segmentCount = sum (map FlatPolyarc.size outlines)
    more i = case extra task of
      Nothing -> 0
      Just f -> let Mm e = f (number i) in e
    -- An open outline is walked there and back.
    number i = if open && i >= segmentCount then 2 * segmentCount - 1 - i else i
    bothWays fault = case fault of
      Crossed i j -> let (a, b) = (number i, number j) in Crossed (min a b) (max a b)
      Misplaced -> Misplaced
      Uncertain -> Uncertain
    largest = case extra task of
      Nothing -> d
      Just _ -> d + maximum (0 : map more [0 .. segmentCount - 1])
    tolerance = Tolerance.rounding * (ClosedPolyarcs.extent outlines + largest)
    chain =
      ClosedPolyarcs.fromOutlines
        tolerance
        (if open then map ClosedPolyarcs.twoSided outlines else outlines)
    raws@(_, source) = rawOf problem chain
    sourceBoxes = SegmentTree.boxes tolerance source
    problem =
      Problem
        { turn,
          rounding = tolerance,
          least = d,
          widest = largest,
          distances = \i -> d + more i,
          rawOf = if largest == 0 then still else raw
        }
    -- At no distance there is nothing to join.
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
    -- More than its radius towards its centre fills an arc's sector and no more.
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

-- | What is asked of all walks: the way round the free places that an outline has, the tolerance of
-- rounding, the least and the largest distance and that of every segment (in mm), and how the raw
-- equidistant is made.
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

-- | The loops from the raw equidistant, its source, and the boxes of that.
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
    -- Where a cutter covers the whole source, but for the tips of its corners, the numbers are
    -- those of free places.
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
        -- A loop of few segments may be there by rounding alone.
        flat k =
          Loop.size answer k <= 4
            && abs (FlatPolyarc.area (Loop.outline answer k)) <= rounding * rounding

-- | Whether one of several walks goes round free places that are too small for the cutter. Where a
-- cutter covers such a one wholly, it would count as free; by itself it is recognised.
hopeless :: Problem -> ClosedPolyarcs -> Int -> Bool
hopeless problem c w = ClosedPolyarcs.walks c > 1 && outer && near && nothing
  where
    o = ClosedPolyarcs.closed c w
    area = FlatPolyarc.area o
    -- Of a place from which every segment is no further than d, the segments see an area of no more
    -- than d/2 times their length.
    near = let Mm l = FlatPolyarc.length o in abs area <= 0.5 * widest problem * l * (1 + 1e-9)
    -- By itself it has this number on its left.
    (outer, left) = case turn problem of
      CounterClockwise -> (area > 0, 1)
      Clockwise -> (area < 0, 0)
    nothing = case reached problem left (ClosedPolyarcs.only [w] c) of
      Right reach -> Loop.count (loops reach) == 0
      Left _ -> False

-- | The winding number on the left of the source that its free places have, or are next to: 1 when
-- the outermost walk is counter-clockwise, else 0. A source that crosses itself, or lies in itself
-- the wrong way, is at fault.
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
