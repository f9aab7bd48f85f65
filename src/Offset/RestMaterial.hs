-- | The material that stays beside a contour where a cutter does not get: its bounds.
module Offset.RestMaterial
  ( RestMaterial (..),
    standings,
  )
where

import Base.Quantity (Mm (..))
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Sense (..), Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Offset.Tolerance qualified as Tolerance
import Offset.TrimmedOffset (OffsetSegment (..), Origin (..), TrimmedOffset, leftward, numberOf)
import Offset.TrimmedOffset qualified as TrimmedOffset

-- | What stays at a place where the cutter is stopped.
data RestMaterial
  = -- | it lies within stretches of the contour and edges of the cutter, the last of which is the
    -- one at this place
    Within (NonEmpty Segment)
  | -- | it is the same as at another place, in the middle of which the centre stands there
    SameAs Point
  | -- | its bounds are not told
    Unbounded
  deriving stock (Eq, Show)

-- | What stays where ways are cut, by the numbers of the cuts: what the cutter touches there before
-- and behind, and where its centre is. From where it leaves the contour no way goes along that
-- until the cutter comes back to it, at the same place or, behind a passage, at another one; from
-- there its edge leads to where it leaves the contour there, and so on round the material.
standings ::
  Side ->
  Polyarc ->
  [TrimmedOffset] ->
  [(Origin, Origin, Point)] ->
  IntMap.IntMap RestMaterial
standings side contour ways cuts =
  IntMap.union
    alone
    ( IntMap.fromList
        [told | Just bounds <- map goneRound (IntMap.keys open), told <- materials side bounds]
    )
  where
    whole = Vector.fromList (NonEmpty.toList (segments contour))
    onWays =
      IntMap.fromListWith
        (<>)
        [(numberOf (origin p), [p]) | w <- ways, p <- NonEmpty.toList (TrimmedOffset.pieces w)]
    stretch = stretchBetween onWays (Polyarc.ends contour) whole
    numbered =
      [(k, touchedAt whole at o, touchedAt whole at o', at) | (k, (o, o', at)) <- zip [0 ..] cuts]
    alone =
      IntMap.fromList
        [ told
          | (k, a, b, at) <- numbered,
            not (isOn a b),
            Just s <- [stretch a b],
            told <- materials side (Vector.singleton (Bound s k at))
        ]
    isOn (Place i _) (Place j _) = i == j
    -- Where the cutter leaves the contour at the others, and its centre; where it arrives.
    open = IntMap.fromList [(k, (a, at)) | (k, a, _, at) <- numbered, IntMap.notMember k alone]
    arrivals = Map.fromList [(b, k) | (k, _, b, _) <- numbered, IntMap.notMember k alone]
    -- All that bounds the same material, if a cut is the first of its cuts; that one comes last.
    goneRound first = go IntSet.empty [] first
      where
        go seen found k = do
          (from, _) <- IntMap.lookup k open
          (to, next) <- nextArrival from
          s <- stretch from to
          (_, at) <- IntMap.lookup next open
          case compare next first of
            EQ -> Just (Vector.fromList (reverse (Bound s next at : found)))
            GT
              | IntSet.notMember next seen ->
                go (IntSet.insert next seen) (Bound s next at : found) next
            _ -> Nothing
    nextArrival from = case (Map.lookupGE from arrivals, Polyarc.ends contour) of
      (Nothing, Closed) -> Map.lookupMin arrivals
      (found, _) -> found

-- | A stretch of the contour that no way goes along, and the cut at its end: its number, and the
-- cutter's centre.
data Bound = Bound {along :: NonEmpty Segment, cut :: Int, centreAt :: Point}

-- | What lies between some stretches, each with the next one behind its cut; it is in several
-- pieces where edges of the cutter cross. Each is told at the cut before its first stretch.
materials :: Side -> Vector Bound -> [(Int, RestMaterial)]
materials side bounds = go IntSet.empty [0 .. Vector.length bounds - 1]
  where
    before i = bounds Vector.! ((i + Vector.length bounds - 1) `mod` Vector.length bounds)
    go told is = case is of
      [] -> []
      i : more
        | IntSet.notMember i told,
          Just (outline, others) <- outlineFrom side bounds i ->
          (cut (before i), Within outline) :
          [(cut (before o), SameAs (centreAt (before i))) | o <- others]
            <> go (IntSet.union (IntSet.fromList others) told) more
        | otherwise -> go told more

-- | Round what lies behind a stretch, and which other stretches bound it. Behind each stretch the
-- cutter's edge does, as far as the next one or another edge: seen along the walk, the centre is on
-- the cutter's side. What lies beyond the contour, where the cutter touches it from behind, does
-- not stay.
outlineFrom :: Side -> Vector Bound -> Int -> Maybe (NonEmpty Segment, [Int])
outlineFrom side bounds first = walked (4 * count) [] (stretchAt first) first (edges Vector.! first)
  where
    count = Vector.length bounds
    stretchAt i = along (bounds Vector.! i)
    behind i = if i + 1 == count then 0 else i + 1
    edges =
      Vector.generate
        count
        ( \i ->
            edge
              (centreAt (bounds Vector.! i))
              (Segment.end (NonEmpty.last (stretchAt i)))
              (Segment.start (NonEmpty.head (stretchAt (behind i))))
        )
    edge = Segment.arc (if side == LeftOf then Clockwise else CounterClockwise)
    -- On the edge of a number, of which so much is ahead, no more than so often.
    walked :: Int -> [Int] -> NonEmpty Segment -> Int -> Segment -> Maybe (NonEmpty Segment, [Int])
    walked left others done i rest
      | left <= 0 = Nothing
      | (t, j, u) : _ <- sortOn (\(t, _, _) -> t) (crossed i rest) =
        walked
          (left - 1)
          others
          (done <> (fst (Segment.cutAt t rest) :| []))
          j
          (snd (Segment.cutAt u (edges Vector.! j)))
      | behind i /= first =
        let j =
              behind i
         in walked
              (left - 1)
              (j : others)
              (done <> (rest :| []) <> stretchAt j)
              j
              (edges Vector.! j)
      | Polyarc.signedArea (Polyarc Closed (done <> (rest :| []))) * leftward side > 0 =
        Just (done <> (rest :| []), others)
      | otherwise = Nothing
    -- How far along it which other edge crosses it, and how far along that.
    crossed i rest =
      [ (t, j, u)
        | j <- [0 .. count - 1],
          j /= i,
          let other = edges Vector.! j,
          p <- Distance.crossings rest other,
          Just t <- [inside rest p],
          Just u <- [inside other p]
      ]
    -- Nearer to an end nothing crosses.
    inside e p =
      let t =
            Segment.fraction e p
          Mm l = Segment.length e
          Mm least = Tolerance.clearance
       in if t * l > least && (1 - t) * l > least then Just t else Nothing

-- | A place on a contour: the number of a segment, and a share of its length from 0 to 1.
data Place = Place Int Double
  deriving stock (Eq, Ord)

-- | Where a cutter with its centre at a point touches what a piece of its way belongs to.
touchedAt :: Vector Segment -> Point -> Origin -> Place
touchedAt whole at o = case o of
  Around i -> Place i 1
  Along i -> Place i (foot whole i at)

-- | The place of a segment next to a point, as a share of its length.
foot :: Vector Segment -> Int -> Point -> Double
foot whole i p =
  let s = whole Vector.! i in max 0 (min 1 (Segment.fraction s (snd (Distance.nearest p s))))

-- | The contour from one place to a later one; nothing when a way goes along what lies between,
-- when they are one point, or when an open contour ends between them.
stretchBetween ::
  IntMap.IntMap [OffsetSegment] ->
  Ends ->
  Vector Segment ->
  Place ->
  Place ->
  Maybe (NonEmpty Segment)
stretchBetween onWays ends whole (Place i from) (Place j to)
  | i == j && from < to =
    if any (\p -> passes i (> from) p && passes i (< to) p) (on i)
      then Nothing
      else
        Just
          ( fst
              ( Segment.cutAt
                  ((to - from) / (1 - from))
                  (snd (Segment.cutAt from (whole Vector.! i)))
              )
              :| []
          )
  | i == j || any (`IntMap.member` onWays) between || (ends == Open && j < i) = Nothing
  | any (passes i (> from)) (on i) || any (passes j (< to)) (on j) = Nothing
  | otherwise =
    NonEmpty.nonEmpty
      ( [snd (Segment.cutAt from (whole Vector.! i)) | from < 1]
          <> map (whole Vector.!) between
          <> [fst (Segment.cutAt to (whole Vector.! j)) | to > 0]
      )
  where
    n = Vector.length whole
    between = takeWhile (/= j) (drop 1 (take n (iterate (\k -> (k + 1) `mod` n) i)))
    on k = IntMap.findWithDefault [] k onWays
    passes k beyond p =
      beyond (case origin p of Around _ -> 1; Along _ -> foot whole k (Segment.at 0.5 (segment p)))
