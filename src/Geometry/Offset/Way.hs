-- | The ways that the centre of a cutter can go beside a contour, cut from the kernel's loops, each piece with the segment of
-- the contour that it belongs to.
module Geometry.Offset.Way
  ( Side (..),
    Style (..),
    radiusAt,
    leftward,
    Piece (..),
    Origin (..),
    numberOf,
    Way (..),
    along,
    reachesAll,
  )
where

import Base.Crash qualified as Crash
import Base.Quantity (Mm (..), Rad (..), minus, plus)
import Data.IntSet qualified as IntSet
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Ord (comparing)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Contour (Contour (segments), Ends (..))
import Geometry.Contour qualified as Contour
import Geometry.Offset.Chain qualified as Chain
import Geometry.Offset.Kernel (Side (..))
import Geometry.Offset.Kernel qualified as Kernel
import Geometry.Offset.Loops qualified as Loops
import Geometry.Outline qualified as Outline
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec

-- | How the path goes round outer corners, and how much further than the radius it stays from each segment.
data Style = Style
  { -- | straight on to where the two ways meet, instead of on an arc about the corner; corners that turn by
    -- more than 120° stay round
    sharp :: Bool,
    -- | by the number of the segment; not negative
    extra :: Int -> Mm
  }

-- | How far the centre stays from a segment.
radiusAt :: Style -> Mm -> Int -> Mm
radiusAt style radius i = plus radius (extra style i)

-- | +1 when the cutter is on the left.
leftward :: Side -> Double
leftward side = case side of
  LeftOf -> 1
  RightOf -> -1

-- | A segment of the equidistant, and what it belongs to.
data Piece = Piece {origin :: Origin, segment :: Segment}
  deriving stock (Eq, Show)

-- | A segment of the contour by its number from 0, or the corner behind it.
data Origin = Along Int | Around Int
  deriving stock (Eq, Show)

-- | In the order of the walk.
instance Ord Origin where
  compare = comparing $ \case
    Along i -> (i, False)
    Around i -> (i, True)

-- | The number of the segment that a piece belongs to, or behind which its corner is.
numberOf :: Origin -> Int
numberOf origin = case origin of
  Along i -> i
  Around i -> i

-- | A way that the centre can go without a gap, closed or from end to end.
data Way = Way
  { ends :: Ends,
    pieces :: NonEmpty Piece,
    -- | the segments of the contour that stop the cutter before and behind an open way; nothing where the contour ends
    stops :: (Maybe Int, Maybe Int)
  }
  deriving stock (Eq, Show)

-- | Whether the cutter reaches every segment: there is one way, and nothing but arcs that have shrunk to a point is missing on it, nor does
-- anything stop the cutter at the ends of an open contour. Corners are not looked at.
reachesAll :: Style -> Side -> Mm -> Contour -> Bool
reachesAll style side radius contour = case asked style side radius contour of
  Just reach | isWhole reach -> True
  _ -> case along style side radius contour of
    [way] -> Contour.ends contour == ends way && inOrder (map (numberOf . origin) (NonEmpty.toList (pieces way))) && isOpenAtEnds way
    [] -> all shrunk (Vector.toList (Vector.indexed whole))
    _ -> False
  where
    whole = Vector.fromList (NonEmpty.toList (segments contour))
    -- Nothing of the raw equidistant was cut away.
    isWhole reach = let l = Kernel.loops reach in Loops.count l == 1 && PrimArray.sizeofPrimArray (Loops.raws l) == PrimArray.sizeofPrimArray (Chain.xs (Kernel.raw reach)) - 1
    inOrder numbers = and (zipWith (<=) numbers (drop 1 numbers)) && all (\i -> shrunk (i, whole Vector.! i)) (IntSet.toList (IntSet.difference (IntSet.fromList [0 .. Vector.length whole - 1]) (IntSet.fromList numbers)))
    -- Where the way begins or ends the contour does, but for arcs that have shrunk.
    isOpenAtEnds way = maybe True (< firstOf way) (fst (stops way)) && maybe True (> finalOf way) (snd (stops way))
    firstOf = numberOf . origin . NonEmpty.head . pieces
    finalOf = numberOf . origin . NonEmpty.last . pieces
    shrunk (i, s) = case s of
      Straight a b -> Vec.near a b
      Arc {start, centre} -> let Mm d = minus (Segment.radius centre start) (radiusAt style radius i) in Mm (abs d) <= Tolerance.clearance

-- | What the kernel says; nothing for a contour that crosses itself.
asked :: Style -> Side -> Mm -> Contour -> Maybe Kernel.Reach
asked style side radius contour = case Kernel.offset task [outline] of
  Right reach -> Just reach
  Left Kernel.Uncertain -> Crash.bug "an equidistant failed its certificate"
  Left (Kernel.Crossed _ _) -> Nothing
  Left Kernel.Misplaced -> Nothing
  where
    (outline, elements) = Outline.fromContour contour
    plainly = all ((== Mm 0) . extra style) [0 .. NonEmpty.length (segments contour) - 1]
    task = Kernel.Task {Kernel.side, Kernel.corners = if sharp style then Kernel.Sharp else Kernel.Round, Kernel.distance = radius, Kernel.extra = if plainly then Nothing else Just (extra style . PrimArray.indexPrimArray elements)}

-- | The ways, by the kernel.
along :: Style -> Side -> Mm -> Contour -> [Way]
along style side radius contour = case asked style side radius contour of
  Just reach -> sortOn (origin . NonEmpty.head . pieces) (concatMap (way reach) [0 .. Loops.count (Kernel.loops reach) - 1])
  Nothing -> []
  where
    elements = snd (Outline.fromContour contour)
    numbers = PrimArray.sizeofPrimArray elements
    whole = Vector.fromList (NonEmpty.toList (segments contour))
    way reach k = joined (zipWith (piece reach whole elements) parts (drop 1 parts <> take 1 parts))
      where
        parts = [PrimArray.indexPrimArray (Loops.starts l) k .. PrimArray.indexPrimArray (Loops.starts l) (k + 1) - 1]
        l = Kernel.loops reach
    joined found = case Contour.ends contour of
      Closed -> [round' ps | Just ps <- [NonEmpty.nonEmpty (map snd found)]]
      -- The loop goes round the whole contour: here counts what lies on the side that was asked, up to the ends.
      Open -> case span own found of
        (_, []) -> [round' ps | Just ps <- [NonEmpty.nonEmpty (map snd found)]]
        (front, other : rest) -> runs other other (rest <> front)
    round' ps = Way {ends = Closed, pieces = rotated ps, stops = (Nothing, Nothing)}
    own (number, p) = case origin p of
      Along _ -> number < numbers
      Around _ -> number < numbers - 1
    -- The open ways of a loop, between what is before the rest of it and what is behind it.
    runs before behind found = case found of
      [] -> []
      p : rest
        | own p,
          (more, others) <- span own rest,
          next <- headOr behind others ->
          stretch before (p :| more) next : runs next behind (drop 1 others)
        | otherwise -> runs p behind rest
    stretch before own' next = Way {ends = Open, pieces = merged (fmap snd own'), stops = (stopAt (2 * numbers - 1) 0 before (NonEmpty.head own'), stopAt (numbers - 1) (numbers - 1) next (NonEmpty.last own'))}
    headOr other list = case list of
      a : _ -> a
      [] -> other
    -- What stops the cutter is not the way round the contour's own end, from the segment there.
    stopAt end number (k, other) (own', _) = case origin other of
      Around _ | k == end, own' == number -> Nothing
      o -> Just (numberOf o)
    -- Begin where the first segment begins that is on it.
    rotated ps = merged (fromMaybe ps (NonEmpty.nonEmpty (reverse lastRun <> reverse others)))
      where
        least = minimum (fmap origin ps)
        isLeast p = origin p == least
        (front, rest) = NonEmpty.break isLeast ps
        (lastRun, others) = span isLeast (reverse (rest <> front))

-- | A segment of a loop as a piece, about the exact centre of what it stems from; and the number of the segment of the outline.
piece :: Kernel.Reach -> Vector Segment -> PrimArray.PrimArray Int -> Int -> Int -> (Int, Piece)
piece reach whole elements k after = (number, Piece {origin, segment})
  where
    l = Kernel.loops reach
    raw = fromIntegral (PrimArray.indexPrimArray (Loops.raws l) k)
    number = fromIntegral (PrimArray.indexPrimArray (Chain.sources (Kernel.raw reach)) raw)
    -- An open outline is walked there and back.
    element = PrimArray.indexPrimArray elements (if number < PrimArray.sizeofPrimArray elements then number else 2 * PrimArray.sizeofPrimArray elements - 1 - number)
    isAround = Chain.marked Chain.around (PrimArray.indexPrimArray (Chain.marks (Kernel.raw reach)) raw)
    origin = if isAround then Around element else Along element
    s = whole Vector.! element
    (a, b) = (vertex k, vertex after)
    vertex i = Vec.point (PrimArray.indexPrimArray (Loops.xs l) i) (PrimArray.indexPrimArray (Loops.ys l) i)
    g = PrimArray.indexPrimArray (Loops.bulges l) k
    segment
      | g == 0 = Straight a b
      | isAround = Arc {start = a, end = b, centre = Segment.end s, sweep = Rad (4 * atan g)}
      | otherwise = case s of
        Arc {centre} -> Arc {start = a, end = b, centre, sweep = Rad (4 * atan g)}
        Straight _ _ -> Straight a b

-- | Neighbouring pieces of the same arc as one.
merged :: NonEmpty Piece -> NonEmpty Piece
merged (p :| rest) = case rest of
  q : more
    | origin p == origin q, Arc {centre, start, sweep = Rad s} <- segment p, Arc {centre = c, end, sweep = Rad t} <- segment q, c == centre -> merged (p {segment = Arc {start, end, centre, sweep = Rad (s + t)}} :| more)
    | otherwise -> NonEmpty.cons p (merged (q :| more))
  [] -> p :| []
