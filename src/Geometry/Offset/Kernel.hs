{-# OPTIONS_GHC -O2 #-}

-- | The offset kernel: the boundary of all places where the centre of a cutter can stand beside closed contours, or on one
-- side of an open one.
--
-- The free places, where the centre may be as far as the contours go, lie on the same side of every contour: inside an
-- outline and outside the islands in it, or outside everything. The raw equidistant ("Geometry.Offset.Raw") is the contours
-- moved to that side, with all its self-crossings. Since it grows out of them without a jump, its winding number is that of
-- the free places wherever the cutter fits, and on one side of that everywhere else. So the answer is
-- decided by counting. In general position ("Geometry.Offset.Clip") that is one walk along the curve. Where segments meet at
-- their ends or lie along one another, "Geometry.Offset.Arrangement" cuts all of them first. Every answer is looked at once
-- more ("Geometry.Offset.Certificate") before it is given out.
module Geometry.Offset.Kernel
  ( Side (..),
    Corners (..),
    Task (..),
    Reach (..),
    Fault (..),
    offset,
    plain,
  )
where

import Base.Quantity (Mm (..))
import Data.Bifunctor (first)
import Data.Maybe (mapMaybe)
import Data.Primitive.PrimArray
import Geometry.Contour (Ends (..))
import Geometry.Offset.Arrangement qualified as Arrangement
import Geometry.Offset.Boxes (Boxes)
import Geometry.Offset.Boxes qualified as Boxes
import Geometry.Offset.Certificate qualified as Certificate
import Geometry.Offset.Chain (Chain)
import Geometry.Offset.Chain qualified as Chain
import Geometry.Offset.Clip qualified as Clip
import Geometry.Offset.Crossings (Crossings, Found (..))
import Geometry.Offset.Crossings qualified as Crossings
import Geometry.Offset.Loops (Loops)
import Geometry.Offset.Loops qualified as Loops
import Geometry.Offset.Raw (Corners (..))
import Geometry.Offset.Raw qualified as Raw
import Geometry.Offset.Winding (Outward (..))
import Geometry.Offset.Winding qualified as Winding
import Geometry.Outline (Outline)
import Geometry.Outline qualified as Outline
import Geometry.Shape (Turn (..))
import Geometry.Tolerance qualified as Tolerance

-- | The side of the walk on which the cutter stands.
data Side = LeftOf | RightOf
  deriving stock (Eq, Show, Enum, Bounded)

-- | What is asked: the side, the corners, the distance of the centre (not negative), and by how much more it stays from the
-- segments, by their numbers through all outlines.
data Task = Task {side :: Side, corners :: Corners, distance :: Mm, extra :: Maybe (Int -> Mm)}

-- | A distance on a side, with round corners.
plain :: Side -> Mm -> Task
plain side distance = Task {side, corners = Round, distance, extra = Nothing}

-- | The loops, walked in the direction of the source; and the raw equidistant that they are parts of.
data Reach = Reach {loops :: Loops, raw :: Chain}

data Fault
  = -- | two segments of the source cross, by their numbers through all outlines
    Crossed Int Int
  | -- | an outline does not lie inside or outside the others as its sense would have it
    Misplaced
  | -- | the answer failed its certificate
    Uncertain
  deriving stock (Eq, Show)

-- | What the cutter's centre can reach beside outlines that are all closed, or one that is open.
offset :: Task -> [Outline] -> Either Fault Reach
offset task outlines = do
  wanted <- first bothWays (wantedOf tolerance turn open source sourceBoxes)
  let hopeful = filter (not . hopeless problem chain) [0 .. Chain.walks chain - 1]
  if length hopeful == Chain.walks chain
    then reachOf problem wanted raws sourceBoxes
    else reached problem wanted (Chain.only hopeful chain)
  where
    open = any ((== Open) . Outline.ends) outlines
    turn = turnOf (side task)
    Mm d = distance task
    segmentCount = sum (map Outline.size outlines)
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
    tolerance = Tolerance.rounding * (Chain.extent outlines + largest)
    chain = Chain.fromOutlines tolerance (if open then map Chain.twoSided outlines else outlines)
    raws@(_, source) = raw chain
    sourceBoxes = Boxes.boxes tolerance source
    problem = Problem {turn, rounding = tolerance, widest = largest, distances = \i -> d + more i, rawOf = raw}
    signed = case side task of
      LeftOf -> -1
      RightOf -> 1
    raw c = case extra task of
      Nothing -> Raw.raw tolerance Tolerance.tangential (corners task) (const (signed * d)) c
      Just _ -> Raw.raw tolerance Tolerance.tangential (corners task) (\i -> signed * (d + more i)) c

turnOf :: Side -> Turn
turnOf s = case s of
  LeftOf -> CounterClockwise
  RightOf -> Clockwise

-- | What is asked of all walks: the way round the free places that an outline has, the tolerance of rounding, the largest
-- distance and that of every segment (in mm), and how the raw equidistant is made.
data Problem = Problem {turn :: Turn, rounding :: Double, widest :: Double, distances :: Int -> Double, rawOf :: Chain -> (Chain, Chain)}

reached :: Problem -> Int -> Chain -> Either Fault Reach
reached problem wanted c = let raws@(_, source) = rawOf problem c in reachOf problem wanted raws (Boxes.boxes (rounding problem) source)

-- | The loops from the raw equidistant, its source, and the boxes of that.
reachOf :: Problem -> Int -> (Chain, Chain) -> Boxes -> Either Fault Reach
reachOf Problem {turn, rounding, widest, distances} wanted (rough, source) sourceBoxes = case maybe id (:) inGeneral decided of
  found : _ -> Right Reach {loops = found, raw = rough}
  [] -> Left Uncertain
  where
    inGeneral = case generalPosition of
      Nothing -> Nothing
      Just (bs, xs) -> Clip.clip rounding wanted rough bs xs >>= certified
    generalPosition :: Maybe (Boxes, Crossings)
    generalPosition =
      let bs = Boxes.boxes rounding rough
       in case Crossings.find rounding rough bs of
            Unclear -> Nothing
            Found xs -> Just (bs, xs)
    decided = mapMaybe byArrangement (take 5 (iterate (* 10) (100 * rounding)))
    byArrangement within = do
      a <- Arrangement.arrange within rough (Boxes.boxes within rough)
      certified (Arrangement.loops turn wanted a)
    -- Where a cutter covers the whole source, but for the tips of its corners, the numbers are those of free places.
    certified found
      | all sound loops' = Just found
      | Chain.walks source == 1 && all (\k -> sound k || covering k) loops' = Just (Loops.only sound found)
      | otherwise = Nothing
      where
        loops' = [0 .. Loops.count found - 1]
        sound = Certificate.clear (1e5 * rounding) widest distances source sourceBoxes found
        covering = Certificate.covers (1e5 * rounding) distances source found

-- | Whether one of several walks goes round free places that are too small for the cutter. Where a cutter covers such a one
-- wholly, it would count as free; by itself it is recognised.
hopeless :: Problem -> Chain -> Int -> Bool
hopeless problem c w = Chain.walks c > 1 && outer && near && nothing
  where
    o = Chain.closed c w
    area = Outline.area o
    -- Of a place from which every segment is no further than d, the segments see an area of no more than d/2 times their length.
    near = let Mm l = Outline.length o in abs area <= 0.5 * widest problem * l * (1 + 1e-9)
    -- By itself it has this number on its left.
    (outer, left) = case turn problem of
      CounterClockwise -> (area > 0, 1)
      Clockwise -> (area < 0, 0)
    nothing = case reached problem left (Chain.only [w] c) of
      Right reach -> Loops.count (loops reach) == 0
      Left _ -> False

-- | The winding number on the left of the source that its free places have, or are next to: 1 when the outermost walk is
-- counter-clockwise, else 0. A source that crosses itself, or lies in itself the wrong way, is at fault.
wantedOf :: Double -> Turn -> Bool -> Chain -> Boxes -> Either Fault Int
wantedOf tolerance turn open source bs
  | Chain.walks source == 0 = Right unbounded
  | open = maybe (Right unbounded) (Left . uncurry crossed) (Crossings.proper tolerance source bs)
  | otherwise = case Crossings.find tolerance source bs of
    Found xs
      | Crossings.count xs > 0 -> Left (uncurry crossed (Crossings.firstOf xs 0))
      | Just lefts <- traverse outside [0 .. Chain.walks source - 1],
        wanted : others <- lefts ->
        if all (== wanted) others && (wanted == 0 || wanted == 1) then Right wanted else Left Misplaced
    _ -> fromArrangement (take 5 (iterate (* 10) (100 * tolerance)))
  where
    crossed i j = let (a, b) = (number i, number j) in Crossed (min a b) (max a b)
    number i = fromIntegral (indexPrimArray (Chain.sources source) i)
    unbounded = case turn of
      CounterClockwise -> 0
      Clockwise -> 1
    outside w =
      let e = Winding.extreme Leftmost source bs w
       in (+ (if Chain.walks source == 1 then 0 else Winding.at source bs (Winding.x e - 4 * tolerance) (Winding.y e))) <$> Winding.leftMore e
    fromArrangement withins = case mapMaybe (\within -> Arrangement.arrange within source (Boxes.boxes within source)) withins of
      [] -> Left Uncertain
      a : _ -> case Arrangement.numbers a of
        (0, 0) -> Right unbounded
        (0, 1) -> Right 1
        (-1, 0) -> Right 0
        (_, high) -> Left (maybe Misplaced (uncurry crossed) (Arrangement.crossed (if high > 0 then (0, 1) else (-1, 0)) a))
