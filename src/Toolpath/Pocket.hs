-- | The toolpath of a pocket: loops at increasing distances from the walls, cut from the
-- innermost outwards, and the linking moves between them.
--
-- The cutter sweeps every point of the floor that it can reach. Take a point between two loops, and
-- the shortest line from that point to the nearest wall. On that line, the outer loop is at most
-- the stepover away. A stepover of at most the radius therefore leaves nothing, not even in the
-- middle, where the last loop shrinks to nothing. A wider stepover leaves residue, which detours
-- clear ("Toolpath.StepoverResidue"). A point nearer to a wall than the outermost loop is within
-- one radius of a position of the centre on that loop.
--
-- The loops are cut from the inside outwards, because the cutter then plunges where it has room. On
-- every later loop the remaining material lies on one side, and the walls are cut last.
--
-- A /loop/ is a closed path of the centre at one distance from the walls. A /detour/ leaves a loop,
-- clears residue, and returns to the loop. A /section/ is a part of the toolpath: a loop or a part
-- of one, a detour, or a linking move. A /region/ is a connected area in which the centre has at
-- least a given distance from the walls; loops bound it ("Toolpath.PocketTree").
module Toolpath.Pocket
  ( PocketRoom (..),
    Loop,
    PocketMove (..),
    clear,
    finishWalls,
    clearingDistances,
    finishingDistances,
    mostSegments,
    linked,
    startPoint,
    endPoint,
    segments,
    firstLoop,
  )
where

import Base.Quantity (Mm (..), minus, over, plus, times)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance
import Toolpath.PocketTree (Loop, PocketTree (..), Ring (..), RingSegment (..))
import Toolpath.PocketTree qualified as PocketTree

-- | A pocket to be cleared.
data PocketRoom = PocketRoom
  { -- | the outer contour and the islands
    walls :: NonEmpty Segment,
    -- | the loops at a given distance from the walls, inside the outer contour and outside the
    -- islands; the free space is on the left of each loop
    offsetBy :: Mm -> [Loop],
    -- | the loops at a given distance to the left of loops that 'offsetBy' gave; Nothing when they
    -- have to be computed from the walls
    insetOfLoops :: [Loop] -> Mm -> Maybe [Loop],
    -- | the cutter's radius
    radius :: Mm,
    -- | the allowance at the walls
    leaves :: Mm,
    -- | true if the cutter traverses every loop with the free space on its right
    isReversed :: Bool
  }

-- | A section of the toolpath. Each section begins where the previous one ends.
data PocketMove
  = -- | along a loop or a part of one; the distance is that of the loop from the walls
    AlongLoop Mm (NonEmpty Segment)
  | -- | a detour that clears stepover residue, nowhere nearer to the walls than the outermost loop
    Detour (NonEmpty Segment)
  | -- | straight to the next loop, with no wall between
    DirectLink Segment
  | -- | up, over and down again, because a wall lies between
    LiftedLink Point Point
  deriving stock (Eq, Show)

-- | The sections that clear a pocket with the stepover @step@, which is above 0 and at most the
-- cutter's diameter. @from@ is the cutter's plunge position; Nothing if the cutter plunges at the
-- beginning of the first loop. The result is empty when the cutter fits nowhere, and Nothing if the
-- loops have more than 'mostSegments'.
clear :: PocketRoom -> Mm -> Maybe Point -> Maybe [PocketMove]
clear room step from = loopsAt room from (takeWhile (<= deepest) (distancesBy room step))
  where
    -- An upper bound: no point of the pocket is further from the walls.
    deepest =
      plus step (halfOf (foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (walls room))))
    halfOf (BoundingBox l b r t) = Mm (min (r - l) (t - b) / 2)

-- | The sections that finish the walls of a pocket after it was cleared with the larger allowance
-- @before@. The distance between loops is at most the stepover @step@ and at most the radius.
-- @from@ is the cutter's plunge position; Nothing if the cutter plunges at the beginning of the
-- first loop. Nothing if the loops have more than 'mostSegments'.
finishWalls :: PocketRoom -> Mm -> Mm -> Maybe Point -> Maybe [PocketMove]
finishWalls room step before from = loopsAt room from (finishingDistances room step before)

-- | The distances from the walls of the loops that clear a pocket without detours, from the least
-- on, without end: the stepover @step@ apart, and at most the radius.
clearingDistances :: PocketRoom -> Mm -> [Mm]
clearingDistances room step = distancesBy room (min step (radius room))

-- | Distances from the walls that are @step@ apart, from the least on, without end.
distancesBy :: PocketRoom -> Mm -> [Mm]
distancesBy room step = [plus (nearest' room) (times (fromIntegral k) step) | k <- [0 :: Int ..]]

-- | The distances from the walls of the loops of 'finishWalls', from the least on.
finishingDistances :: PocketRoom -> Mm -> Mm -> [Mm]
finishingDistances room step before =
  [ plus (nearest' room) (times (fromIntegral k / fromIntegral count) more)
    | k <- [0 .. count - 1]
  ]
  where
    more = minus before (leaves room)
    count = max 1 (ceiling (over more (min step (radius room)) - Tolerance.equal)) :: Int

-- | The sections along the loops at increasing distances from the walls. @from@ is the cutter's
-- plunge position, as in 'clear'. Nothing if the loops have more than 'mostSegments'.
loopsAt :: PocketRoom -> Maybe Point -> [Mm] -> Maybe [PocketMove]
loopsAt room from distances =
  along room from
    <$> PocketTree.passTrees
      mostSegments
      (offsetBy room)
      (insetOfLoops room)
      (radius room)
      distances

-- | The largest number of segments that the loops of one pass of a pocket may have. A tape has no
-- more frames than this.
mostSegments :: Int
mostSegments = 1000000

-- | The least distance of the cutter's centre from the walls.
nearest' :: PocketRoom -> Mm
nearest' room = plus (radius room) (leaves room)

-- Linking moves

-- | The linking move between two points; empty if the points coincide. It is straight at the depth
-- of the pass if the cutter then keeps its distance from all walls. Otherwise the cutter is lifted
-- and crosses above them.
linked :: PocketRoom -> Point -> Point -> [PocketMove]
linked room = link
  where
    index = BoxTree.index BoundingBox.ofSegment (NonEmpty.toList (walls room))
    link p q
      | Vec.isNear p q = []
      | free (Straight p q) = [DirectLink (Straight p q)]
      | otherwise = [LiftedLink p q]
    free s =
      all
        (\w -> plus (distanceTo s w) Tolerance.clearance >= nearest' room)
        (BoxTree.within (BoundingBox.inflate (nearest' room) (BoundingBox.ofSegment s)) index)
    distanceTo s w = let ClosestPoint d _ = Distance.segments s w in d

-- Order of the loops

-- | The state while the order of the loops is chosen.
data Progress = Progress
  { -- | current position of the cutter; Nothing before the first loop, if no plunge position is
    -- given
    current :: Maybe Point,
    -- | sections so far, the last one first
    sections :: [PocketMove]
  }

-- | The sections of all loops with the linking moves between them. @from@ is the cutter's plunge
-- position; Nothing if the cutter plunges at the beginning of the first loop.
along :: PocketRoom -> Maybe Point -> [PocketTree] -> [PocketMove]
along room from trees = reverse (sections (visitAll Progress {current = from, sections = []} trees))
  where
    link = linked room
    visitAll progress regions = inTurn visit (entrance . innermost) progress regions
    visit progress tree = case (current inside, rings tree) of
      -- After the inner regions, the cutter continues on the nearest loop of this region, because
      -- no wall lies between the cutter and that loop.
      (Just p, rs) ->
        let (r, others) =
              takeOut (distanceFrom p) rs
         in inTurn enter entrance (enter inside r) others
      (Nothing, rs) -> inTurn enter entrance inside (NonEmpty.toList rs)
      where
        inside = visitAll progress (inner tree)
    enter progress r =
      let r' = maybe r (enteredNear r) (current progress)
          linking = maybe [] (`link` entrance r') (current progress)
       in Progress
            { current = Just (entrance r'),
              sections = reverse (linking <> roundOf (isReversed room) r') <> sections progress
            }

-- | Visits items one after the other. The next item is the one whose @position@ is nearest to the
-- cutter. But while more than @many@ items remain, or while the cutter has no position, it is the
-- first item of the list. @visit@ makes the progress after an item from the progress before it.
inTurn :: (Progress -> a -> Progress) -> (a -> Point) -> Progress -> [a] -> Progress
inTurn visit position progress things = case (things, current progress) of
  ([], _) -> progress
  (first : others, Just p)
    | null (drop many things) ->
      let (next, rest) =
            takeOut (Vec.distance p . position) (first :| others)
       in inTurn visit position (visit progress next) rest
  (first : others, _) -> inTurn visit position (visit progress first) others
  where
    many = 100

-- | The item with the least @measure@, and the other items in their order. Of several such items it
-- is the first one.
takeOut :: (a -> Mm) -> NonEmpty a -> (a, [a])
takeOut measure things = (chosen, [a | (i, a) <- numbered, i /= number])
  where
    numbered = zip [0 :: Int ..] (NonEmpty.toList things)
    (number, _, chosen) =
      minimumBy
        (comparing (\(_, m, _) -> m))
        (NonEmpty.zipWith (\i a -> (i, measure a, a)) (0 :| [1 ..]) things)

-- Loops

-- | The loop whose beginning is used as the position of a region when the next region is chosen. It
-- is the first loop of the innermost region that is found by taking the first inner region again
-- and again.
innermost :: PocketTree -> Ring
innermost tree = case inner tree of
  [] -> NonEmpty.head (rings tree)
  first : _ -> innermost first

-- | The point at which a loop begins and ends.
entrance :: Ring -> Point
entrance r = Segment.start (segment (NonEmpty.head (ringSegments r)))

-- | The distance of a loop from the point @p@.
distanceFrom :: Point -> Ring -> Mm
distanceFrom p r = minimum (fmap (Distance.toPoint p . segment) (ringSegments r))

-- | Rotates a loop so that it begins at the point of the loop that is nearest to @p@.
enteredNear :: Ring -> Point -> Ring
enteredNear r p = case NonEmpty.nonEmpty begun of
  Just ss -> r {ringSegments = ss}
  Nothing -> r
  where
    list = NonEmpty.toList (ringSegments r)
    (number, _) =
      minimumBy
        (comparing snd)
        (NonEmpty.zip (0 :| [1 ..]) (fmap (Distance.toPoint p . segment) (ringSegments r)))
    begun = case splitAt number list of
      (before, s : after)
        | Vec.isNear foot (Segment.end (segment s)) -> after <> before <> [s]
        | Vec.isNear foot (Segment.start (segment s)) -> s : after <> before
        | otherwise ->
          let (a, b) =
                Segment.cutAt (Segment.fraction (segment s) foot) (segment s)
           in s {segment = b} : after <> before <> [RingSegment {segment = a, detours = []}]
        where
          foot = snd (Distance.nearest p (segment s))
      (_, []) -> list

-- | The sections along a loop with its detours. If @isBackwards@ is true, the loop is traversed in
-- the opposite direction.
roundOf :: Bool -> Ring -> [PocketMove]
roundOf isBackwards r
  | isBackwards = map reverseSection (reverse parts)
  | otherwise = parts
  where
    parts = go [] (NonEmpty.toList (ringSegments r))
    go before ss = case ss of
      [] -> whole before
      RingSegment {segment = s, detours = []} : more -> go (s : before) more
      RingSegment {segment = s, detours = trips} : more ->
        whole (s : before) <> map Detour trips <> go [] more
    whole before =
      maybe [] (\some -> [AlongLoop (wallDistance r) some]) (NonEmpty.nonEmpty (reverse before))
    reverseSection section = case section of
      AlongLoop c ss -> AlongLoop c (NonEmpty.reverse (fmap Segment.reverse ss))
      Detour ss -> Detour (NonEmpty.reverse (fmap Segment.reverse ss))
      DirectLink s -> DirectLink (Segment.reverse s)
      LiftedLink p q -> LiftedLink q p

-- Sections

-- | The first point of a section.
startPoint :: PocketMove -> Point
startPoint section = case section of
  LiftedLink p _ -> p
  AlongLoop _ (s :| _) -> Segment.start s
  Detour (s :| _) -> Segment.start s
  DirectLink s -> Segment.start s

-- | The last point of a section.
endPoint :: PocketMove -> Point
endPoint section = case section of
  LiftedLink _ q -> q
  AlongLoop _ ss -> Segment.end (NonEmpty.last ss)
  Detour ss -> Segment.end (NonEmpty.last ss)
  DirectLink s -> Segment.end s

-- | The first loop among sections, without its detours. A line before the first loop counts as a
-- loop of its own; a lifted link is a line of length 0.
firstLoop :: NonEmpty PocketMove -> NonEmpty Segment
firstLoop (section :| more) = case section of
  AlongLoop _ ss -> loop ss more
  Detour ss -> ss
  DirectLink s -> s :| []
  LiftedLink p _ -> Straight p p :| []
  where
    loop done others = case others of
      AlongLoop _ ss : rest | isOpen done -> loop (done <> ss) rest
      Detour _ : rest | isOpen done -> loop done rest
      _ -> done
    isOpen done =
      not (Vec.isNear (Segment.start (NonEmpty.head done)) (Segment.end (NonEmpty.last done)))

-- | The segments along which a section cuts; none for a lifted link.
segments :: PocketMove -> [Segment]
segments section = case section of
  LiftedLink _ _ -> []
  AlongLoop _ ss -> NonEmpty.toList ss
  Detour ss -> NonEmpty.toList ss
  DirectLink s -> [s]
