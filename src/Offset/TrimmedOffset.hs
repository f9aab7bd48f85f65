-- | The ways that the centre of a cutter can go beside a contour, cut from the kernel's loops, each
-- piece with the segment of the contour that it belongs to.
module Offset.TrimmedOffset
  ( CornerStyle (..),
    radiusAt,
    leftward,
    OffsetSegment (..),
    Origin (..),
    numberOf,
    TrimmedOffset (..),
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
import Geometry.Carrier (Side (..))
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..), Polyarc (segments))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Offset.Kernel qualified as Kernel
import Offset.Loop qualified as Loop
import Offset.Tolerance qualified as Tolerance

-- | How the path goes round outer corners, and how much further than the radius it stays from each
-- segment.
data CornerStyle = CornerStyle
  { -- more than 120° stay round

    -- | straight on to where the two ways meet, instead of on an arc about the corner; corners that
    -- turn by
    sharp :: Bool,
    -- | by the number of the segment; not negative
    extra :: Int -> Mm
  }

-- | How far the centre stays from a segment.
radiusAt :: CornerStyle -> Mm -> Int -> Mm
radiusAt style radius i = plus radius (extra style i)

-- | +1 when the cutter is on the left.
leftward :: Side -> Double
leftward side = case side of
  LeftOf -> 1
  RightOf -> -1

-- | A segment of the equidistant, and what it belongs to.
data OffsetSegment = OffsetSegment {origin :: Origin, segment :: Segment}
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
data TrimmedOffset = TrimmedOffset
  { ends :: Ends,
    pieces :: NonEmpty OffsetSegment,
    -- | the segments of the contour that stop the cutter before and behind an open way; nothing
    -- where the contour ends
    stops :: (Maybe Int, Maybe Int)
  }
  deriving stock (Eq, Show)

-- | Whether the cutter reaches every segment: there is one way, and nothing but arcs that have
-- shrunk to a point is missing on it, nor does anything stop the cutter at the ends of an open
-- contour. Corners are not looked at.
reachesAll :: CornerStyle -> Side -> Mm -> Polyarc -> Bool
reachesAll style side radius contour = case asked style side radius contour of
  Just reach | isWhole reach -> True
  _ -> case along style side radius contour of
    [way] ->
      Polyarc.ends contour == ends way
        && inOrder (map (numberOf . origin) (NonEmpty.toList (pieces way)))
        && isOpenAtEnds way
    [] -> all shrunk (Vector.toList (Vector.indexed whole))
    _ -> False
  where
    whole = Vector.fromList (NonEmpty.toList (segments contour))
    -- Nothing of the raw equidistant was cut away.
    isWhole reach =
      let l =
            Kernel.loops reach
       in Loop.count l == 1
            && PrimArray.sizeofPrimArray (Loop.raws l)
              == PrimArray.sizeofPrimArray (ClosedPolyarcs.xs (Kernel.raw reach)) - 1
    inOrder numbers =
      and (zipWith (<=) numbers (drop 1 numbers))
        && all
          (\i -> shrunk (i, whole Vector.! i))
          ( IntSet.toList
              ( IntSet.difference
                  (IntSet.fromList [0 .. Vector.length whole - 1])
                  (IntSet.fromList numbers)
              )
          )
    -- Where the way begins or ends the contour does, but for arcs that have shrunk.
    isOpenAtEnds way =
      maybe True (< firstOf way) (fst (stops way)) && maybe True (> finalOf way) (snd (stops way))
    firstOf = numberOf . origin . NonEmpty.head . pieces
    finalOf = numberOf . origin . NonEmpty.last . pieces
    shrunk (i, s) = case s of
      Straight a b -> Vec.near a b
      Arc {start, centre} ->
        let Mm d =
              minus (Segment.radius centre start) (radiusAt style radius i)
         in Mm (abs d) <= Tolerance.clearance

-- | What the kernel says; nothing for a contour that crosses itself.
asked :: CornerStyle -> Side -> Mm -> Polyarc -> Maybe Kernel.ReachableRegion
asked style side radius contour = case Kernel.offset task [outline] of
  Right reach -> Just reach
  Left Kernel.Uncertain -> Crash.bug "an equidistant failed its certificate"
  Left (Kernel.Crossed _ _) -> Nothing
  Left Kernel.Misplaced -> Nothing
  where
    (outline, elements) = FlatPolyarc.fromContour contour
    plainly = all ((== Mm 0) . extra style) [0 .. NonEmpty.length (segments contour) - 1]
    task =
      Kernel.OffsetRequest
        { Kernel.side,
          Kernel.corners = if sharp style then Kernel.Sharp else Kernel.Round,
          Kernel.distance = radius,
          Kernel.extra =
            if plainly then Nothing else Just (extra style . PrimArray.indexPrimArray elements)
        }

-- | The ways, by the kernel.
along :: CornerStyle -> Side -> Mm -> Polyarc -> [TrimmedOffset]
along style side radius contour = case asked style side radius contour of
  Just reach ->
    sortOn
      (origin . NonEmpty.head . pieces)
      (concatMap (way reach) [0 .. Loop.count (Kernel.loops reach) - 1])
  Nothing -> []
  where
    elements = snd (FlatPolyarc.fromContour contour)
    numbers = PrimArray.sizeofPrimArray elements
    whole = Vector.fromList (NonEmpty.toList (segments contour))
    way reach k = joined (zipWith (piece reach whole elements) parts (drop 1 parts <> take 1 parts))
      where
        parts =
          [ PrimArray.indexPrimArray (Loop.starts l) k
            .. PrimArray.indexPrimArray (Loop.starts l) (k + 1)
              - 1
          ]
        l = Kernel.loops reach
    joined found = case Polyarc.ends contour of
      Closed -> [round' ps | Just ps <- [NonEmpty.nonEmpty (map snd found)]]
      -- The loop goes round the whole contour: here counts what lies on the side that was asked, up
      -- to the ends.
      Open -> case span own found of
        (_, []) -> [round' ps | Just ps <- [NonEmpty.nonEmpty (map snd found)]]
        (front, other : rest) -> runs other other (rest <> front)
    round' ps = TrimmedOffset {ends = Closed, pieces = rotated ps, stops = (Nothing, Nothing)}
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
    stretch before own' next =
      TrimmedOffset
        { ends = Open,
          pieces = merged (fmap snd own'),
          stops =
            ( stopAt (2 * numbers - 1) 0 before (NonEmpty.head own'),
              stopAt (numbers - 1) (numbers - 1) next (NonEmpty.last own')
            )
        }
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

-- | A segment of a loop as a piece, about the exact centre of what it stems from; and the number of
-- the segment of the outline.
piece ::
  Kernel.ReachableRegion ->
  Vector Segment ->
  PrimArray.PrimArray Int ->
  Int ->
  Int ->
  (Int, OffsetSegment)
piece reach whole elements k after = (number, OffsetSegment {origin, segment})
  where
    l = Kernel.loops reach
    raw = fromIntegral (PrimArray.indexPrimArray (Loop.raws l) k)
    number = fromIntegral (PrimArray.indexPrimArray (ClosedPolyarcs.sources (Kernel.raw reach)) raw)
    -- An open outline is walked there and back.
    element =
      PrimArray.indexPrimArray
        elements
        ( if number < PrimArray.sizeofPrimArray elements
            then number
            else 2 * PrimArray.sizeofPrimArray elements - 1 - number
        )
    isAround =
      ClosedPolyarcs.marked
        ClosedPolyarcs.around
        (PrimArray.indexPrimArray (ClosedPolyarcs.marks (Kernel.raw reach)) raw)
    origin = if isAround then Around element else Along element
    s = whole Vector.! element
    (a, b) = (vertex k, vertex after)
    vertex i =
      Vec.point (PrimArray.indexPrimArray (Loop.xs l) i) (PrimArray.indexPrimArray (Loop.ys l) i)
    g = PrimArray.indexPrimArray (Loop.bulges l) k
    segment
      | g == 0 = Straight a b
      | isAround = Arc {start = a, end = b, centre = Segment.end s, sweep = Rad (4 * atan g)}
      | otherwise = case s of
        Arc {centre} -> Arc {start = a, end = b, centre, sweep = Rad (4 * atan g)}
        Straight _ _ -> Straight a b

-- | Neighbouring pieces of the same arc as one.
merged :: NonEmpty OffsetSegment -> NonEmpty OffsetSegment
merged (p :| rest) = case rest of
  q : more
    | origin p == origin q,
      Arc {centre, start, sweep = Rad s} <- segment p,
      Arc {centre = c, end, sweep = Rad t} <- segment q,
      c == centre ->
      merged (p {segment = Arc {start, end, centre, sweep = Rad (s + t)}} :| more)
    | otherwise -> NonEmpty.cons p (merged (q :| more))
  [] -> p :| []
