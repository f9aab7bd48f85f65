-- | The equidistant (offset) of a contour of lines and arcs: the path of the centre of a cutter
-- that rolls along one side of it.
--
-- The path is made from the certified loops of "Offset.Kernel". Its coordinates come from the
-- elements of the contour ("Offset.SourceOffset"). Where the cutter does not fit, 'styled' returns
-- the obstacle. There 'reachable' returns the paths that the cutter's centre can take, and the
-- parts of the contour that they leave out, with the rest material.
module Offset.Equidistant
  ( OffsetSegment (..),
    Origin (..),
    Obstacle (..),
    Cause (..),
    CornerStyle (..),
    equidistant,
    styled,
    TrimmedOffset (..),
    UnreachedPart (..),
    RestMaterial (..),
    reachable,
    reachableFitting,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Base.Quantity (Mm (..), Rad (..), minus, plus, times, total)
import Control.Applicative ((<|>))
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet (IntSet)
import Data.IntSet qualified as IntSet
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Set qualified as Set
import Data.Vector qualified as Vector
import Geometry.Carrier (Side)
import Geometry.Polyarc (Ends (..), Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Obstacle (Cause (..), Obstacle (..))
import Offset.Obstacle qualified as Obstacle
import Offset.RestMaterial (RestMaterial (..), Touching (..))
import Offset.RestMaterial qualified as RestMaterial
import Offset.SourceOffset
  ( CornerStyle (..),
    Cuts (..),
    OffsetSegment (..),
    OffsetSource (radius, style),
    Origin (..),
    distanceAt,
    elementCount,
    elements,
    movedElement,
    next,
    numberOf,
  )
import Offset.SourceOffset qualified as SourceOffset
import Offset.Tolerance qualified as Tolerance
import Offset.TrimmedOffset (TrimmedOffset (TrimmedOffset))
import Offset.TrimmedOffset qualified as TrimmedOffset

-- | The equidistant for a cutter's radius in mm, which is not negative, with arcs about outer
-- corners. Its segments are in the order of the contour.
equidistant :: Side -> Mm -> Polyarc -> Either Obstacle (NonEmpty OffsetSegment)
equidistant = styled CornerStyle {sharp = False, extra = const (Mm 0)}

-- | The equidistant for a cutter's radius in mm, with a style of corners and extra distances from
-- single elements.
styled :: CornerStyle -> Side -> Mm -> Polyarc -> Either Obstacle (NonEmpty OffsetSegment)
styled style side radius contour = case attempt source of
  Right path -> Right path
  Left cause -> Left Obstacle {cause, largest = largestFitting source}
  where
    source = SourceOffset.fromContour style side radius contour

-- | The equidistant, or the first reason why the cutter does not fit. Reasons at single elements
-- and corners come before collisions.
attempt :: OffsetSource -> Either Cause (NonEmpty OffsetSegment)
attempt source = case Obstacle.localCauses source of
  cause : _ -> Left cause
  []
    | radius source <= Mm 0 -> Right (connected source (pointed source))
    | Just path <- TrimmedOffset.whole source source <|> fitting ->
      case crevices source path of
        cause : _ -> Left cause
        [] -> Right (connected source path)
    | otherwise ->
      Left (Obstacle.collision source (connected source (TrimmedOffset.untrimmed source)))
  where
    -- In a slot as wide as the cutter the centre can move along a line, and the kernel finds no
    -- region. The kernel does find one for a slightly smaller cutter.
    smaller = source {radius = minus (radius source) Tolerance.clearance}
    fitting = if radius smaller > Mm 0 then TrimmedOffset.whole smaller source else Nothing

-- | The crevices beside a path, as reasons why the cutter does not fit. A cusp is a point at which
-- the contour turns back. A crevice is a cusp that the cutter cannot enter. There the path has no
-- arc about the vertex.
crevices :: OffsetSource -> [OffsetSegment] -> [Cause]
crevices source path = case filter (SourceOffset.isCusp source) [0 .. elementCount source - 1] of
  -- The path of a contour without cusps is not examined here, so it is never in memory as a whole.
  [] -> []
  cusps ->
    [ InnerCorner i (next source i) (Segment.end (elements source Vector.! i))
      | i <- cusps,
        IntSet.notMember i rounded
    ]
  where
    rounded = IntSet.fromList [i | OffsetSegment {origin = Around i} <- path]

-- | The path of a cutter with radius 0: the elements at their extra distances. Straight lines join
-- the elements where the distance changes.
pointed :: OffsetSource -> [OffsetSegment]
pointed source = concatMap along [0 .. elementCount source - 1]
  where
    along i =
      OffsetSegment (Along i) (shortened i (movedElement source i)) :
        [OffsetSegment (Around i) s | Just s <- [SourceOffset.cornerStep source i]]
    shortened i = SourceOffset.shortened (front (cutsAfter (previous i))) (back (cutsAfter i))
    previous i = if i == 0 then elementCount source - 1 else i - 1
    cutsAfter i =
      SourceOffset.cutsAt source i (movedElement source i) (movedElement source (next source i))

-- | The path without segments of length 0. Each segment of the result begins exactly where the one
-- before it ends. A cutter that just fits into an arc does not move there, so the segment is left
-- out. Beside a contour that consists of such arcs only, the path is one segment of length 0.
connected :: OffsetSource -> [OffsetSegment] -> NonEmpty OffsetSegment
connected source =
  maybe
    (OffsetSegment (Along 0) (movedElement source 0) :| [])
    (Polyarc.closeGaps segment (\s p -> p {segment = s}) (SourceOffset.ends source))
    . NonEmpty.nonEmpty
    . filter ((> Tolerance.coincident) . Segment.length . segment)

-- | The largest cutter radius in mm, below the requested one, that fits everywhere. Nothing when
-- not even a tiny cutter fits. The radius is found by bisection, since every cutter smaller than a
-- fitting one fits too.
largestFitting :: OffsetSource -> Maybe Mm
largestFitting source
  | fits smallest = Just (largestOf fits smallest (radius source))
  | otherwise = Nothing
  where
    smallest = times 10 Tolerance.clearance
    fits r = case attempt source {radius = r} of
      Right _ -> True
      Left _ -> False

-- | The largest radius for which @fits@ is True. @fits@ is True for the radius @low@ and False for
-- @high@.
largestOf :: (Mm -> Bool) -> Mm -> Mm -> Mm
largestOf fits low high = fst (BinarySearch.bisect Tolerance.resolution fits low high)

-- Reachable paths ---------------------------------------------------------------------------------

-- | A part of the contour that the cutter does not reach, because an obstacle stops the cutter
-- there.
data UnreachedPart = UnreachedPart
  { -- | the obstacle, with the radius of the largest cutter that it does not stop
    stop :: Obstacle,
    -- | the position of the cutter's centre when the obstacle stops the cutter
    cutterCentre :: Point,
    -- | the material that remains at this part of the contour
    restMaterial :: RestMaterial
  }
  deriving stock (Eq, Show)

-- | The paths that the cutter's centre can take beside a contour, in the contour's order, and the
-- parts of the contour that these paths leave out. The radius in mm is positive.
reachable :: CornerStyle -> Side -> Mm -> Polyarc -> ([TrimmedOffset], [UnreachedPart])
reachable style side radius contour =
  ( if sharp style then map (sharpened asked) paths else paths,
    zipWith rest [0 ..] gaps
  )
  where
    asked = SourceOffset.fromContour style side radius contour
    -- The paths are computed with round corners, because the cutter's centre then reaches more
    -- positions than with sharp ones.
    rolling = asked {style = style {sharp = False}}
    paths = TrimmedOffset.along rolling
    gaps = gapsOf rolling paths
    past = largestPast rolling (map reason gaps)
    material = RestMaterial.restMaterials side contour paths (map touching gaps)
    rest k gap =
      UnreachedPart
        { stop = Obstacle {cause = reason gap, largest = past k},
          cutterCentre = centreAt (touching gap),
          restMaterial = IntMap.findWithDefault Unbounded k material
        }

-- | A path with sharp corners in place of round ones. A corner stays round in four cases: its arc
-- is trimmed; it turns by more than 120°; its two elements have different distances; the cutter on
-- the two lines of the sharp corner would cut another element.
sharpened :: OffsetSource -> TrimmedOffset -> TrimmedOffset
sharpened source =
  \path -> path {TrimmedOffset.pieces = corner =<< TrimmedOffset.pieces path}
  where
    gouges = Obstacle.gouges source
    corner p = case (origin p, segment p) of
      (Around i, Arc {start, end})
        | Just (Straight from tip, Straight _ to) <- SourceOffset.sharpCorner source i,
          Vec.isNear from start,
          Vec.isNear to end,
          a <- p {segment = Straight start tip},
          b <- p {segment = Straight tip end},
          null (gouges [a, b]) ->
          a :| [b]
      _ -> p :| []

-- | The results of 'reachable', but the cutter also enters slots exactly as wide as itself. In such
-- a slot its centre can only move along a line, and the kernel finds no region. A cutter whose
-- radius is smaller by 'Tolerance.clearance' can enter them. When its paths are longer in total, by
-- more than 'Tolerance.ignoredSlot', the results are those of this smaller cutter.
reachableFitting :: CornerStyle -> Side -> Mm -> Polyarc -> ([TrimmedOffset], [UnreachedPart])
reachableFitting style side radius contour
  | less > Mm 0 && minus (lengthOf smaller) (lengthOf own) > Tolerance.ignoredSlot = smaller
  | otherwise = own
  where
    less = minus radius Tolerance.clearance
    own = reachable style side radius contour
    smaller = reachable style side less contour
    lengthOf (paths, _) =
      total
        [Segment.length (segment p) | w <- paths, p <- NonEmpty.toList (TrimmedOffset.pieces w)]

-- | A gap, at which a path leaves out a part of the contour: the reason, and what the cutter
-- touches there.
data Gap = Gap {reason :: Cause, touching :: Touching}

-- | The gaps of paths. A path has a gap where it continues from one element of the contour to
-- another one that does not follow it, and at every inner corner where two elements join directly.
-- An open path that begins or ends elsewhere than the contour has a gap there, too. An arc whose
-- offset is a point makes no gap.
gapsOf :: OffsetSource -> [TrimmedOffset] -> [Gap]
gapsOf source = concatMap gapsAlong
  where
    gapsAlong path =
      [ stopped (Along i) (origin first) front
        | not (isSpent source front [0 .. numberOf (origin first) - 1]),
          Just i <- [fst (TrimmedOffset.stops path)]
      ]
        <> concat (zipWith (gapBetween source) list (drop 1 list <> around))
        <> [ stopped (origin final) (Along j) back
             | not (isSpent source back [numberOf (origin final) + 1 .. elementCount source - 1]),
               Just j <- [snd (TrimmedOffset.stops path)]
           ]
      where
        list = NonEmpty.toList (TrimmedOffset.pieces path)
        around = [first | TrimmedOffset.ends path == Closed]
        first = NonEmpty.head (TrimmedOffset.pieces path)
        final = NonEmpty.last (TrimmedOffset.pieces path)
        (front, back) = (Segment.start (segment first), Segment.end (segment final))
    stopped o o' p = Gap (Collision (numberOf o) (numberOf o') p) (Touching o o' p)

-- | The gap between the consecutive segments @p@ and @q@ of a path; empty if there is none.
gapBetween :: OffsetSource -> OffsetSegment -> OffsetSegment -> [Gap]
gapBetween source p q =
  [Gap c (Touching (origin p) (origin q) joint) | c <- inTheWay]
  where
    joint = Segment.end (segment p)
    inTheWay = case (origin p, origin q) of
      (Around i, Along j) | j == next source i -> []
      (Around i, Around j) | j == i -> []
      (Along i, Around j) | j == i -> []
      (Along i, Along j)
        | j == next source i ->
          [InnerCorner i j (Segment.end (elements source Vector.! i)) | hasCorner i j]
        | tight <- next source i,
          j == next source tight,
          Just r <- radiusOf tight,
          minus (distanceAt source tight) r > Tolerance.clearance ->
          [Concave tight r]
        | tight <- next source i, j == next source tight, isSpent source joint [tight] -> []
      (Along i, Around j) | j == next source i, isSpent source joint [j] -> []
      (o, o') -> [Collision (numberOf o) (numberOf o') joint]
    radiusOf i = case elements source Vector.! i of
      Arc {start, centre} -> Just (Segment.radius centre start)
      Straight _ _ -> Nothing
    hasCorner i j =
      let Rad turned =
            Vec.signedAngle
              (Segment.endDirection (elements source Vector.! i))
              (Segment.startDirection (elements source Vector.! j))
          Rad smooth = Tolerance.smoothAngle
       in abs turned > smooth

-- | True when the cutter, with its centre at the point @p@, touches the elements @numbers@ along
-- their whole length, so that their absence from a path is no gap. The result is False when
-- @numbers@ is empty.
isSpent :: OffsetSource -> Point -> [Int] -> Bool
isSpent source p numbers =
  not (null numbers) && all (\i -> TrimmedOffset.touchesWhole source i p) numbers

-- | The radius in mm of the largest cutter, smaller than the requested one, that a cause does not
-- stop. The cause is given by its number from 0 in @causes@. Nothing when the cause stops even a
-- tiny cutter. The radius is found by bisection.
largestPast :: OffsetSource -> [Cause] -> Int -> Maybe Mm
largestPast source causes =
  \k -> if IntSet.member k passSmallest then Just (bisect k smallest asked everywhere) else Nothing
  where
    asked = radius source
    everywhere = halvings smallest asked
    passSmallest = passing smallest
    smallest = times 10 Tolerance.clearance
    bisect k low high Halving {middling, passed, below, above}
      | minus high low <= Tolerance.resolution = low
      | IntSet.member k passed = bisect k middling high above
      | otherwise = bisect k low middling below
    halvings low high =
      let middling = times 0.5 (plus low high)
       in Halving
            { middling,
              passed = passing middling,
              below = halvings low middling,
              above = halvings middling high
            }
    -- The numbers of the causes that do not stop a cutter of radius @r@. This cutter must also
    -- reach the elements of the cause.
    passing r =
      IntSet.fromDistinctAscList
        [ k
          | (k, c) <- zip [0 ..] causes,
            Just es <- [between c],
            Set.notMember es stopped,
            all (`IntSet.member` on) es
        ]
      where
        smaller = source {radius = r}
        found = TrimmedOffset.along smaller
        stopped =
          Set.fromList [es | g <- gapsOf smaller found, Just es <- [between (reason g)]]
        on =
          IntSet.fromList
            [numberOf (origin p) | w <- found, p <- NonEmpty.toList (TrimmedOffset.pieces w)]
    -- The elements of a cause, in ascending order. Nothing for an inner corner: not even a tiny
    -- cutter reaches into it.
    between c = case c of
      Concave i _ -> Just [i]
      Collision i j _ -> Just [min i j, max i j]
      InnerCorner {} -> Nothing

-- | A step of the bisection between two radii, as a lazy tree that all causes share, so that each
-- radius is examined at most once.
data Halving = Halving
  { -- | the mean of both radii, in mm
    middling :: Mm,
    -- | the numbers of the causes that do not stop a cutter of the radius 'middling'
    passed :: ~IntSet,
    -- | the next steps: between the smaller radius and 'middling', and between 'middling' and the
    -- larger radius
    below, above :: ~Halving
  }
