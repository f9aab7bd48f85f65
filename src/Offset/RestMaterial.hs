-- | The boundaries of the rest material beside a contour, which a cutter cannot reach.
--
-- A gap is a position on a path at which the cutter touches the contour at two points, and the path
-- leaves out the part of the contour between them. A stretch is a part of the contour that no path
-- touches. It begins where the cutter leaves the contour at a gap. It ends where the cutter touches
-- the contour again, at the same gap or at another one.
--
-- The boundary of the rest material consists of stretches and of edges of the cutter. An edge of
-- the cutter is an arc of its circumference at a gap. The boundary is followed from gap to gap
-- until it closes; the sequence of stretches met until then is called a cycle. Where two edges of
-- the cutter intersect, the boundary changes from one edge to the other.
module Offset.RestMaterial
  ( RestMaterial (..),
    Touching (..),
    restMaterials,
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
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Offset.SourceOffset (OffsetSegment (..), Origin (..), numberOf)
import Offset.Tolerance qualified as Tolerance
import Offset.TrimmedOffset (TrimmedOffset)
import Offset.TrimmedOffset qualified as TrimmedOffset

-- | The rest material at a gap.
data RestMaterial
  = -- | material inside a closed boundary of stretches of the contour and edges of the cutter; the
    -- last segment is the cutter's edge at this gap
    Within (NonEmpty Segment)
  | -- | the material that is listed at another gap, at which the cutter's centre is at this point
    SameAs Point
  | -- | material whose boundary was not found
    Unbounded
  deriving stock (Eq, Show)

-- | The cutter at a gap: the elements or corners of the contour that it touches before and after
-- the gap, and the position of its centre.
data Touching = Touching {before :: Origin, after :: Origin, centreAt :: Point}

-- | The rest material beside a contour, by the number of the gap. @side@ is the cutter's side of
-- the contour; @paths@ are the paths beside it. @gaps@ are their gaps, numbered from 0 in this
-- order. The result has no entry for a gap at material whose boundary was not found.
restMaterials :: Side -> Polyarc -> [TrimmedOffset] -> [Touching] -> IntMap.IntMap RestMaterial
restMaterials side contour paths gaps =
  IntMap.union
    alone
    ( IntMap.fromList
        [ found
          | Just bounds <- map (cycleFrom stretch nextArrival open) (IntMap.keys open),
            found <- materials side bounds
        ]
    )
  where
    elements = Vector.fromList (NonEmpty.toList (segments contour))
    onPaths =
      IntMap.fromListWith
        (<>)
        [(numberOf (origin p), [p]) | w <- paths, p <- NonEmpty.toList (TrimmedOffset.pieces w)]
    stretch = stretchBetween onPaths (Polyarc.ends contour) elements
    numbered =
      [ (k, touchedAt elements at (before g), touchedAt elements at (after g), at)
        | (k, g) <- zip [0 ..] gaps,
          let at = centreAt g
      ]
    -- The material at those gaps where one stretch and the cutter's edge at the gap enclose it.
    alone =
      IntMap.fromList
        [ found
          | (k, a, b, at) <- numbered,
            not (isSameElement a b),
            Just s <- [stretch a b],
            found <- materials side (Vector.singleton (Bound s k at))
        ]
    isSameElement (Position i _) (Position j _) = i == j
    -- The remaining gaps, by number: the position at which the cutter leaves the contour, and the
    -- position of the cutter's centre. @arrivals@ has the gap by the position at which the cutter
    -- touches the contour again.
    open = IntMap.fromList [(k, (a, at)) | (k, a, _, at) <- numbered, IntMap.notMember k alone]
    arrivals = Map.fromList [(b, k) | (k, _, b, _) <- numbered, IntMap.notMember k alone]
    nextArrival from = case (Map.lookupGE from arrivals, Polyarc.ends contour) of
      (Nothing, Closed) -> Map.lookupMin arrivals
      (found, _) -> found

-- | The cycle of stretches that begins at the gap with the number @first@. Its last stretch ends at
-- this gap. The result is Nothing when the stretches do not return to the gap. It is also Nothing
-- when they meet a gap with a number smaller than @first@, so that each cycle is found once.
--
-- @stretch@ gives the stretch between two positions on the contour. @nextArrival@ gives, for a
-- position on the contour, the next one at which the cutter touches the contour again after a gap,
-- and the number of this gap. @open@ has, for each gap, the position at which the cutter leaves the
-- contour, and the position of the cutter's centre.
cycleFrom ::
  (Position -> Position -> Maybe (NonEmpty Segment)) ->
  (Position -> Maybe (Position, Int)) ->
  IntMap.IntMap (Position, Point) ->
  Int ->
  Maybe (Vector Bound)
cycleFrom stretch nextArrival open first = go IntSet.empty [] first
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

-- | A stretch of the contour that no path touches, and the gap at its end: the gap's number, and
-- the position of the cutter's centre there.
data Bound = Bound {along :: NonEmpty Segment, gap :: Int, cutterAt :: Point}

-- | The rest materials of a cycle, each with the number of the gap at which it is listed. A cycle
-- has several materials when edges of the cutter intersect. Each material is listed with its
-- boundary at the gap before its first stretch. At the gaps before its other stretches it is listed
-- as 'SameAs'.
materials :: Side -> Vector Bound -> [(Int, RestMaterial)]
materials side bounds = go IntSet.empty [0 .. Vector.length bounds - 1]
  where
    previous i = bounds Vector.! ((i + Vector.length bounds - 1) `mod` Vector.length bounds)
    go done is = case is of
      [] -> []
      i : more
        | IntSet.notMember i done,
          Just (boundary, others) <- boundaryFrom side bounds i ->
          (gap (previous i), Within boundary) :
          [(gap (previous o), SameAs (cutterAt (previous i))) | o <- others]
            <> go (IntSet.union (IntSet.fromList others) done) more
        | otherwise -> go done more

-- | The boundary that begins with the stretch with index @first@ of a cycle, and the indices of the
-- other stretches in the boundary. After each stretch the boundary follows the cutter's edge to the
-- next stretch, or to the intersection with another edge. Nothing when the boundary does not close,
-- or when it encloses an area on the wrong side of the contour.
boundaryFrom :: Side -> Vector Bound -> Int -> Maybe (NonEmpty Segment, [Int])
boundaryFrom side bounds first =
  follow (4 * count) [] (stretchAt first) first (edges Vector.! first)
  where
    count = Vector.length bounds
    edges = cutterEdges side bounds
    stretchAt i = along (bounds Vector.! i)
    -- Follows the boundary along @rest@, the remaining part of edge @i@, for at most @steps@ steps.
    -- @done@ is the boundary so far, and @others@ are the stretches in it after the first.
    follow :: Int -> [Int] -> NonEmpty Segment -> Int -> Segment -> Maybe (NonEmpty Segment, [Int])
    follow steps others done i rest
      | steps <= 0 = Nothing
      | (t, j, u) : _ <- sortOn (\(t, _, _) -> t) (crossings edges i rest) =
        let (untilThere, _) = Segment.cutAt t rest
            (_, onwards) = Segment.cutAt u (edges Vector.! j)
         in follow (steps - 1) others (done <> (untilThere :| [])) j onwards
      | j <- following bounds i,
        j /= first =
        follow (steps - 1) (j : others) (closed <> stretchAt j) j (edges Vector.! j)
      | Polyarc.signedArea (Polyarc Closed closed) * Carrier.sideSign side > 0 =
        Just (closed, others)
      | otherwise = Nothing
      where
        closed = done <> (rest :| [])

-- | The index of the stretch after stretch @i@ in a cycle. The first one follows the last one.
following :: Vector Bound -> Int -> Int
following bounds i = if i + 1 == Vector.length bounds then 0 else i + 1

-- | The cutter's edge from the end of each stretch of a cycle to the start of the next stretch. The
-- material is on the cutter's side of the stretches, and outside the cutter's edge.
cutterEdges :: Side -> Vector Bound -> Vector Segment
cutterEdges side bounds = Vector.generate (Vector.length bounds) $ \i ->
  Segment.arc
    (Carrier.senseAwayFrom side)
    (cutterAt (bounds Vector.! i))
    (Segment.end (NonEmpty.last (along (bounds Vector.! i))))
    (Segment.start (NonEmpty.head (along (bounds Vector.! following bounds i))))

-- | The intersections of @rest@, the remaining part of edge @i@, with the other edges. Each result
-- has the position along @rest@, the index of the other edge, and the position along that edge.
-- Both positions are fractions of the length from 0 to 1.
crossings :: Vector Segment -> Int -> Segment -> [(Double, Int, Double)]
crossings edges i rest =
  [ (t, j, u)
    | j <- [0 .. Vector.length edges - 1],
      j /= i,
      let other = edges Vector.! j,
      p <- Distance.intersections rest other,
      Just t <- [inside rest p],
      Just u <- [inside other p]
  ]
  where
    -- The position of point @p@ along edge @e@, as a fraction. Nothing within the clearance of an
    -- end of the edge.
    inside e p =
      let t = Segment.fraction e p
          Mm l = Segment.length e
          Mm least = Tolerance.clearance
       in if t * l > least && (1 - t) * l > least then Just t else Nothing

-- | A position on a contour: the number of an element from 0, and a fraction of its length from 0
-- to 1.
data Position = Position Int Double
  deriving stock (Eq, Ord)

-- | The position at which a cutter with its centre at the point @at@ touches the element or corner
-- @o@.
touchedAt :: Vector Segment -> Point -> Origin -> Position
touchedAt elements at o = case o of
  Around i -> Position i 1
  Along i -> Position i (foot elements i at)

-- | The position on element @i@ that is nearest to the point @p@, as a fraction of the element's
-- length from 0 to 1.
foot :: Vector Segment -> Int -> Point -> Double
foot elements i p =
  let s = elements Vector.! i in max 0 (min 1 (Segment.fraction s (snd (Distance.nearest p s))))

-- | The stretch of a contour from the position @Position i from@ to the position @Position j to@.
-- @onPaths@ has the segments of the paths, by the number of their element or of the element before
-- their corner. The result is Nothing when a path touches the stretch, or when an open contour ends
-- between the positions. It is also Nothing when both positions are one point, or when they are on
-- one element in the opposite order.
stretchBetween ::
  IntMap.IntMap [OffsetSegment] ->
  Ends ->
  Vector Segment ->
  Position ->
  Position ->
  Maybe (NonEmpty Segment)
stretchBetween onPaths ends elements (Position i from) (Position j to)
  | i == j && from < to =
    if any (\p -> passes i (> from) p && passes i (< to) p) (on i)
      then Nothing
      else
        Just
          ( fst
              ( Segment.cutAt
                  ((to - from) / (1 - from))
                  (snd (Segment.cutAt from (elements Vector.! i)))
              )
              :| []
          )
  | i == j || any (`IntMap.member` onPaths) between || (ends == Open && j < i) = Nothing
  | any (passes i (> from)) (on i) || any (passes j (< to)) (on j) = Nothing
  | otherwise =
    NonEmpty.nonEmpty
      ( [snd (Segment.cutAt from (elements Vector.! i)) | from < 1]
          <> map (elements Vector.!) between
          <> [fst (Segment.cutAt to (elements Vector.! j)) | to > 0]
      )
  where
    n = Vector.length elements
    between = takeWhile (/= j) (drop 1 (take n (iterate (\k -> (k + 1) `mod` n) i)))
    on k = IntMap.findWithDefault [] k onPaths
    passes k isBeyond p = isBeyond $ case origin p of
      Around _ -> 1
      Along _ -> foot elements k (Segment.at 0.5 (segment p))
