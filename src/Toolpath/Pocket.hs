-- | The way of the cutter's centre in a pocket: loops at rising distances from the walls, cut from
-- the innermost outwards, and what leads from each to the next.
--
-- Every place of the floor that the cutter can reach is swept. A place at a distance between two
-- loops comes to the outer one straight towards its nearest wall, on a way no longer than the step;
-- so a step of no more than the radius leaves nothing, the middle included, where the last loop
-- shrinks to nothing. What a wider step leaves is cleared aside ("Toolpath.StepoverResidue"). A
-- place nearer to the wall than any centre comes to an admissible centre within the radius, across
-- the outermost loop.
--
-- Inside out, because the cutter then goes down where there is room about it, and what is still to
-- be cut lies on one side of every later pass, with the walls last.
module Toolpath.Pocket
  ( PocketRoom (..),
    Loop,
    PocketMove (..),
    clear,
    skim,
    linked,
    begins,
    finishes,
    segments,
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

-- | What is to be cleared.
data PocketRoom = PocketRoom
  { -- | the outline and the islands
    walls :: NonEmpty Segment,
    -- | the loops that bound what lies inside the outline, outside the islands, and no nearer to
    -- both than a distance; the free space is on their left
    offsetBy :: Mm -> [Loop],
    -- | the same of such loops, so much further in, if it is easier
    further :: [Loop] -> Mm -> Maybe [Loop],
    -- | of the cutter
    radius :: Mm,
    -- | what is left at the walls
    leaves :: Mm,
    -- | walk every loop with the free space on its right
    turned :: Bool
  }

-- | A part of the way. Each begins where the one before it ends.
data PocketMove
  = -- | along a loop, or a part of one, at its distance from the walls
    Round Mm (NonEmpty Segment)
  | -- | where the loops leave something; no nearer to the walls than the loops
    Aside (NonEmpty Segment)
  | -- | straight on to the next loop, with no wall in the way
    Across Segment
  | -- | up, over and down again: something is in the way
    Over Point Point
  deriving stock (Eq, Show)

-- | Clear a pocket with a step from pass to pass, from the place where the cutter goes down, if
-- that is known; nowhere when the cutter fits nowhere. The step is above zero and at most the
-- diameter.
clear :: PocketRoom -> Mm -> Maybe Point -> [PocketMove]
clear room step from =
  along
    room
    from
    ( PocketTree.nests
        (offsetBy room)
        (further room)
        (radius room)
        ( takeWhile
            (<= deepest)
            [plus (nearest' room) (times (fromIntegral k) step) | k <- [0 :: Int ..]]
        )
    )
  where
    -- No place of the pocket lies further from the walls.
    deepest =
      plus step (halfOf (foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (walls room))))
    halfOf (BoundingBox l b r t) = Mm (min (r - l) (t - b) / 2)

-- | Go along the walls once more, in a pocket that was cleared but for more at the walls: so much
-- was left then. Passes lie no more than the step and the radius apart.
skim :: PocketRoom -> Mm -> Mm -> Maybe Point -> [PocketMove]
skim room step before from =
  along
    room
    from
    ( PocketTree.nests
        (offsetBy room)
        (further room)
        (radius room)
        [ plus (nearest' room) (times (fromIntegral k / fromIntegral count) more)
          | k <- [0 .. count - 1]
        ]
    )
  where
    more = minus before (leaves room)
    count = max 1 (ceiling (over more (min step (radius room)) - Tolerance.equal)) :: Int

-- | The least distance of the cutter's centre from the walls.
nearest' :: PocketRoom -> Mm
nearest' room = plus (radius room) (leaves room)

-- Links

-- | What leads from a place to another: nothing, straight on, or over what is in the way.
linked :: PocketRoom -> Point -> Point -> [PocketMove]
linked room = link
  where
    index = BoxTree.index BoundingBox.ofSegment (NonEmpty.toList (walls room))
    link p q
      | Vec.near p q = []
      | free (Straight p q) = [Across (Straight p q)]
      | otherwise = [Over p q]
    free s =
      all
        (\w -> plus (distanceTo s w) Tolerance.clearance >= nearest' room)
        (BoxTree.within (BoundingBox.inflate (nearest' room) (BoundingBox.ofSegment s)) index)
    distanceTo s w = let ClosestPoint d _ = Distance.segments s w in d

-- The walk

-- | Where the cutter stands, and the legs up to there, the last one first.
data Walk = Walk {at :: Maybe Point, legs :: [PocketMove]}

-- | All loops of nests and what leads from each to the next. The cutter stands at a place, or
-- anywhere.
along :: PocketRoom -> Maybe Point -> [PocketTree] -> [PocketMove]
along room from nests = reverse (legs (visitAll Walk {at = from, legs = []} nests))
  where
    link = linked room
    visitAll walk ns = inTurn visit (entrance . innermost) walk ns
    visit walk n = case (at inside, rings n) of
      -- From a part within this one its nearest loop is the one that no wall can hide.
      (Just p, rs) ->
        let (r, others) =
              takeOut (apart p) rs
         in inTurn enter entrance (enter inside r) others
      (Nothing, rs) -> inTurn enter entrance inside (NonEmpty.toList rs)
      where
        inside = visitAll walk (inner n)
    enter walk r =
      let r' = maybe r (enteredNear r) (at walk)
          way = maybe [] (`link` entrance r') (at walk)
       in Walk
            { at = Just (entrance r'),
              legs = reverse (way <> roundOf (turned room) r') <> legs walk
            }

-- | One after the other, next the one whose place is nearest to where the cutter stands. Of very
-- many the next one in order, which is that of the walls.
inTurn :: (Walk -> a -> Walk) -> (a -> Point) -> Walk -> [a] -> Walk
inTurn visit place walk things = case (things, at walk) of
  ([], _) -> walk
  (first : others, Just p)
    | null (drop many things) ->
      let (next, rest) =
            takeOut (Vec.distance p . place) (first :| others)
       in inTurn visit place (visit walk next) rest
  (first : others, _) -> inTurn visit place (visit walk first) others
  where
    many = 100

-- | The first of those that are least by a measure, and the others.
takeOut :: (a -> Mm) -> NonEmpty a -> (a, [a])
takeOut measure things = (chosen, [a | (i, a) <- numbered, i /= number])
  where
    numbered = zip [0 :: Int ..] (NonEmpty.toList things)
    (number, _, chosen) =
      minimumBy
        (comparing (\(_, m, _) -> m))
        (NonEmpty.zipWith (\i a -> (i, measure a, a)) (0 :| [1 ..]) things)

-- Loops

-- | The loop that is cut first in a part.
innermost :: PocketTree -> Ring
innermost n = case inner n of
  [] -> NonEmpty.head (rings n)
  first : _ -> innermost first

-- | Where a loop is entered.
entrance :: Ring -> Point
entrance r = Segment.start (segment (NonEmpty.head (stretches r)))

-- | The distance of a loop from a point.
apart :: Point -> Ring -> Mm
apart p r = minimum (fmap (Distance.toPoint p . segment) (stretches r))

-- | A loop that begins where it comes nearest to a point.
enteredNear :: Ring -> Point -> Ring
enteredNear r p = case NonEmpty.nonEmpty begun of
  Just ss -> r {stretches = ss}
  Nothing -> r
  where
    list = NonEmpty.toList (stretches r)
    (number, _) =
      minimumBy
        (comparing snd)
        (NonEmpty.zip (0 :| [1 ..]) (fmap (Distance.toPoint p . segment) (stretches r)))
    begun = case splitAt number list of
      (before, s : behind)
        | Vec.near foot (Segment.end (segment s)) -> behind <> before <> [s]
        | Vec.near foot (Segment.start (segment s)) -> s : behind <> before
        | otherwise ->
          let (a, b) =
                Segment.cutAt (Segment.fraction (segment s) foot) (segment s)
           in s {segment = b} : behind <> before <> [RingSegment {segment = a, aside = []}]
        where
          foot = snd (Distance.nearest p (segment s))
      (_, []) -> list

-- | A loop with its trips aside.
roundOf :: Bool -> Ring -> [PocketMove]
roundOf isTurned r
  | isTurned = map turnedRound (reverse parts)
  | otherwise = parts
  where
    parts = go [] (NonEmpty.toList (stretches r))
    go before ss = case ss of
      [] -> whole before
      RingSegment {segment = s, aside = []} : more -> go (s : before) more
      RingSegment {segment = s, aside = trips} : more ->
        whole (s : before) <> map Aside trips <> go [] more
    whole before = maybe [] (\some -> [Round (away r) some]) (NonEmpty.nonEmpty (reverse before))
    turnedRound leg = case leg of
      Round c ss -> Round c (NonEmpty.reverse (fmap Segment.reverse ss))
      Aside ss -> Aside (NonEmpty.reverse (fmap Segment.reverse ss))
      Across s -> Across (Segment.reverse s)
      Over p q -> Over q p

-- Legs

-- | Where a leg begins.
begins :: PocketMove -> Point
begins leg = case leg of
  Over p _ -> p
  Round _ (s :| _) -> Segment.start s
  Aside (s :| _) -> Segment.start s
  Across s -> Segment.start s

-- | Where a leg ends.
finishes :: PocketMove -> Point
finishes leg = case leg of
  Over _ q -> q
  Round _ ss -> Segment.end (NonEmpty.last ss)
  Aside ss -> Segment.end (NonEmpty.last ss)
  Across s -> Segment.end s

-- | The segments along which a leg cuts.
segments :: PocketMove -> [Segment]
segments leg = case leg of
  Over _ _ -> []
  Round _ ss -> NonEmpty.toList ss
  Aside ss -> NonEmpty.toList ss
  Across s -> [s]
