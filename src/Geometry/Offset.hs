-- | The equidistant (offset) of a contour of lines and arcs: the path of the centre of a cutter
-- that rolls along one side of it.
--
-- Lines move along their normal, arcs change their radius, and about an outer corner the centre
-- walks on an arc of the cutter's radius (Ural paper: at a change of surface the centre
-- moves on a circle). Everything stays exact; nothing is trimmed. Where the cutter does not fit
-- (a concave radius below its own, an inner corner, two parts of the contour too near to
-- one another) there is no equidistant but an obstacle, with the largest cutter that does fit.
module Geometry.Offset
  ( Side (..),
    Piece (..),
    Origin (..),
    Obstacle (..),
    Cause (..),
    Style (..),
    equidistant,
    styled,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Geometry.Box qualified as Box
import Geometry.Contour (Contour (..))
import Geometry.Contour qualified as Contour
import Geometry.Distance (Nearest (..))
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Shape (Turn (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The side of the walk on which the cutter stands.
data Side = LeftOf | RightOf
  deriving stock (Eq, Show, Enum, Bounded)

-- | A segment of the equidistant, and what it belongs to.
data Piece = Piece {origin :: Origin, segment :: Segment}
  deriving stock (Eq, Show)

-- | A segment of the contour by its number from 0, or the corner behind it.
data Origin = Along Int | Around Int
  deriving stock (Eq, Show)

-- | Why a cutter does not fit, and the largest radius that does, if any does.
data Obstacle = Obstacle {cause :: Cause, largest :: Maybe Mm}
  deriving stock (Eq, Show)

data Cause
  = -- | a concave arc of this radius
    Concave Int Mm
  | -- | a corner towards the cutter, between two segments
    InnerCorner Int Int Point
  | -- | on its way along the first segment the cutter would cut the second; where its centre would be
    Collision Int Int Point
  deriving stock (Eq, Show)

-- | How the path goes round outer corners, and how much further than the radius it stays from each segment.
data Style = Style
  { -- | straight on to where the two ways meet, instead of on an arc about the corner; corners that turn by
    -- more than 120° stay round
    sharp :: Bool,
    -- | by the number of the segment; not negative
    extra :: Int -> Mm
  }

-- | The equidistant at a radius, in the order of the walk, on arcs round the corners. The radius is not negative.
equidistant :: Side -> Mm -> Contour -> Either Obstacle (NonEmpty Piece)
equidistant = styled Style {sharp = False, extra = const (Mm 0)}

-- | The equidistant in a style.
styled :: Style -> Side -> Mm -> Contour -> Either Obstacle (NonEmpty Piece)
styled style side radius contour = case attempt style side radius contour of
  Right pieces -> Right pieces
  Left cause -> Left Obstacle {cause, largest = largestFitting style side radius contour}

-- | The equidistant, or the first reason against it.
attempt :: Style -> Side -> Mm -> Contour -> Either Cause (NonEmpty Piece)
attempt style side radius contour = do
  pieces <- raw style side radius contour
  maybe (Right pieces) Left (collision style radius contour pieces)

-- | Segments and corners, each for itself.
raw :: Style -> Side -> Mm -> Contour -> Either Cause (NonEmpty Piece)
raw style side radius contour = do
  shifted <- traverse (\(i, s) -> along side (plus radius (extra style i)) i s) (NonEmpty.zip (0 :| [1 ..]) (segments contour))
  corners <- traverse (corner style side radius (NonEmpty.length shifted)) (Contour.joints contour)
  let bends = [(number, next, t) | (number, before, after) <- Contour.joints contour, let next = (number + 1) `mod` NonEmpty.length shifted, Just t <- [slightBend style side radius number next before after]]
  cut <- traverse (shortened bends) (NonEmpty.zip (0 :| [1 ..]) shifted)
  let pieces = concat (zipWith (:) (NonEmpty.toList cut) (corners <> [[]]))
      real = filter (\p -> Segment.length (segment p) > Tolerance.coincident) pieces
  -- A cutter that just fits into an arc stands still there; a contour of such arcs alone is one point.
  Right (maybe (NonEmpty.head shifted :| []) chained (NonEmpty.nonEmpty real))
  where
    chained = Contour.chained segment (\s p -> p {segment = s}) (Contour.ends contour)

-- | A corner towards the cutter that is too slight to leave more than 'Tolerance.slightRest' standing: by how much
-- the ways before and behind it are shortened, @r·tan(θ/2)@. Measured curves that are joined smoothly have such ones.
slightBend :: Style -> Side -> Mm -> Int -> Int -> Segment -> Segment -> Maybe Double
slightBend style side (Mm radius) number next before after
  | turned * leftward side > smooth && extra style number == extra style next && r * (1 / cos (turned / 2) - 1) <= rest = Just (r * tan (abs turned / 2))
  | otherwise = Nothing
  where
    Rad smooth = Tolerance.smoothAngle
    Rad turned = Vec.turn (Segment.endDirection before) (Segment.startDirection after)
    Mm rest = Tolerance.slightRest
    r = let Mm more = extra style number in radius + more

-- | A way without what lies beyond the slight bends at its ends.
shortened :: [(Int, Int, Double)] -> (Int, Piece) -> Either Cause Piece
shortened bends (i, piece)
  | front + back <= 0 = Right piece
  | front + back >= l = Left (case [(a, b) | (a, b, _) <- bends, a == i || b == i] of (a, b) : _ -> InnerCorner a b (Segment.end s); [] -> InnerCorner i i (Segment.end s))
  | otherwise = Right piece {segment = snd (Segment.cutAt (front / (l - back)) (fst (Segment.cutAt (1 - back / l) s)))}
  where
    s = segment piece
    Mm l = Segment.length s
    front = sum [t | (_, b, t) <- bends, b == i]
    back = sum [t | (a, _, t) <- bends, a == i]

-- | A segment moved to its side.
along :: Side -> Mm -> Int -> Segment -> Either Cause Piece
along side radius@(Mm r) number s = case s of
  Straight a b ->
    let n = Vec.scale (leftward side * r) (Vec.left (Vec.unit (Vec.to a b)))
     in Right (Piece (Along number) (Straight (Vec.shift n a) (Vec.shift n b)))
  Arc {start, end, centre, sweep = sweep@(Rad angle)}
    | towardsCentre && minus old radius < times (-1) Tolerance.coincident -> Left (Concave number old)
    | otherwise -> Right (Piece (Along number) Arc {start = moved start, end = moved end, centre, sweep})
    where
      old@(Mm before) = Segment.radius centre start
      towardsCentre = signum angle == leftward side
      after = if towardsCentre then max 0 (before - r) else before + r
      moved p = Vec.shift (Vec.scale (after / before) (Vec.to centre p)) centre

-- | +1 when the cutter is on the left.
leftward :: Side -> Double
leftward side = case side of
  LeftOf -> 1
  RightOf -> -1

-- | The way round the corner behind a segment, if there is one, and from one distance to another.
corner :: Style -> Side -> Mm -> Int -> (Int, Segment, Segment) -> Either Cause [Piece]
corner style side radius count (number, before, after)
  | abs turned <= smooth || radius <= Mm 0 = Right [Piece (Around number) (Straight p q) | r1 /= r2]
  | Just _ <- slightBend style side radius number next before after = Right []
  | turned * leftward side > 0 && pi - abs turned > smooth = Left (InnerCorner number next vertex)
  | sharp style && r1 == r2 && abs turned <= 2 * pi / 3 = Right [Piece (Around number) (Straight p tip), Piece (Around number) (Straight tip q)]
  | otherwise = Right (map (Piece (Around number)) ([Straight p wideP | r1 < wide] <> [Segment.arc sense vertex wideP wideQ] <> [Straight wideQ q | r2 < wide]))
  where
    next = (number + 1) `mod` count
    r1 = plus radius (extra style number)
    r2 = plus radius (extra style next)
    wide = max r1 r2
    p = from r1 before'
    q = from r2 after'
    wideP = from wide before'
    wideQ = from wide after'
    Rad smooth = Tolerance.smoothAngle
    before' = Segment.endDirection before
    after' = Segment.startDirection after
    Rad turned = Vec.turn before' after'
    vertex = Segment.end before
    from (Mm r) direction = Vec.shift (Vec.scale (leftward side * r) (Vec.left direction)) vertex
    -- Where the ways before and behind the corner meet.
    tip = let Mm r = wide in Vec.shift (Vec.scale (r * tan (abs turned / 2)) before') p
    sense = case side of
      LeftOf -> Clockwise
      RightOf -> CounterClockwise

-- | The worst place at which the cutter, on the equidistant, would cut the contour.
collision :: Style -> Mm -> Contour -> NonEmpty Piece -> Maybe Cause
collision style radius contour pieces
  | radius <= Mm 0 || null found = Nothing
  | otherwise = case minimumBy (comparing (\(d, _, _, _) -> d)) found of
    (_, i, j, p) -> Just (Collision i j p)
  where
    index = Box.index (Box.ofSegment . snd) (zip [0 ..] (NonEmpty.toList (segments contour)))
    found =
      [ (d, i, j, p)
        | Piece origin s <- NonEmpty.toList pieces,
          let i = numberOf origin,
          (j, other) <- Box.select (\box -> Box.meets (Box.inflate widest (Box.ofSegment s)) box && Box.atLeast (`Distance.toPoint` s) box < widest) index,
          let Nearest d p = Distance.segments s other,
          let tooNear more = plus d Tolerance.clearance < plus radius more,
          tooNear (extra style j) && tooNear (shared p d (snd (Distance.nearest p other)))
      ]
    -- What is left where segments join: no more than on any of them, and nothing of its own where a neighbour is nearer.
    shared p d foot
      | any (\(_, s) -> plus (Distance.toPoint p s) Tolerance.resolution < d) joined = Mm 0
      | otherwise = minimum (mostExtra : map (extra style . fst) joined)
      where
        joined = [(k, s) | (k, s) <- Box.within (Box.inflate Tolerance.coincident (Box.ofPoints foot [])) index, Distance.toPoint foot s <= Tolerance.coincident]
    mostExtra = maximum (fmap (extra style) (NonEmpty.fromList [0 .. NonEmpty.length (segments contour) - 1]))
    widest = plus radius mostExtra
    numberOf origin = case origin of
      Along i -> i
      Around i -> i

-- | The largest radius below the one asked that fits everywhere; a smaller cutter than one that fits
-- fits too, so halving finds it.
largestFitting :: Style -> Side -> Mm -> Contour -> Maybe Mm
largestFitting style side asked contour
  | fits smallest = Just (search smallest asked)
  | otherwise = Nothing
  where
    smallest = times 10 Tolerance.clearance
    fits r = case attempt style side r contour of
      Right _ -> True
      Left _ -> False
    search low high
      | minus high low <= Tolerance.resolution = low
      | fits middle = search middle high
      | otherwise = search low middle
      where
        middle = times 0.5 (plus low high)
