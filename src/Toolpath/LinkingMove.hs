-- | Linking moves: those from the current position to the beginning of a pass, and those that leave
-- the end of the pass. A pass begins with its lead-in and ends with its lead-out. A /stop/ is a
-- point to which the program asks the tool to move, with or without a height.
module Toolpath.LinkingMove
  ( Visit (..),
    withDepth,
    slopeMoves,
    withoutDepth,
    straightMoves,
    rise,
    endPosition,
    descentPace,
    keyword,
    pocketKeyword,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (..))
import Data.List.NonEmpty (NonEmpty)
import Data.Maybe (fromMaybe)
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Milling (feed), Pocketing, SpacePoint (..), Stop)
import Part.Part qualified as Part
import Toolpath.Descent (Way)
import Toolpath.Descent qualified as Descent
import Toolpath.Toolpath (Manner (Manner), Move (Move))
import Toolpath.Toolpath qualified as Toolpath

-- | The facts about one pass of a statement that determine the linking moves of the pass.
data Visit = Visit
  { -- | region of the statement's first word
    word :: Region,
    milling :: Milling,
    -- | true for the first pass of the statement; if the pass has several paths, for its first path
    isFirst :: Bool,
    -- | true for the last pass of the statement; if the pass has several paths, for its last path
    isLast :: Bool,
    -- | position of the cutter before the pass
    from :: SpacePoint
  }

-- | The linking moves before and after a pass of a statement without a depth. The height of the
-- pass is @z@. The pass goes from the point @begin@ to the point @finish@. @inZ@ and @outZ@ are the
-- heights of the z axis at these two points. They differ from @z@ for a blade only, because the z
-- axis does not lift a blade, but swivels it. Each pass along an open contour has the approach and
-- the retract of the program. On a closed contour only the first pass has the approach, and only
-- the last pass the retract.
withoutDepth :: Visit -> Mm -> (Mm, Mm) -> Point -> Point -> ([Move], [Move])
withoutDepth Visit {word, milling, isFirst, isLast, from} z (inZ, outZ) begin finish =
  ( before
      <> straightMoves (endPosition from before) [Part.Stop (Located word begin) (Just inZ) pace],
    after
      <> if null after
        then [Move (Straight finish finish) (Manner (outZ, z) pace False) word False | outZ /= z]
        else []
  )
  where
    pace = Part.At (feed milling)
    before = if isFirst || isOpen then straightMoves from (Part.approach milling) else []
    after =
      if isLast || isOpen
        then straightMoves (SpacePoint finish outZ) (upright (Part.retract milling))
        else []
    isOpen = Part.ends (Part.contour milling) == Part.Open
    -- On the first move of the retract, a blade swivels back to its upright position, unless the
    -- program gives a height for the end of that move.
    upright stops = case stops of
      s : more
        | Nothing <- Part.level s,
          Just _ <- Part.gear milling ->
          s {Part.level = Just z} : more
      _ -> stops

-- | The linking moves before and after a pass of a statement with a depth. The cutter moves to the
-- last stop of the approach, and plunges there. Without an approach it plunges at the beginning of
-- the pass. After the pass it moves to the first stop of the retract and rises there. If that stop
-- has a height, or the retract has no stop, the cutter rises at the end of the pass. The remaining
-- stops of the approach precede the first pass only, those of the retract follow the last pass
-- only. Stops without a height are at the clearance height @clear@. @begin@ and @finish@ are the
-- ends of the pass, @inZ@ and @outZ@ the heights of the z axis at these ends.
--
-- With a way down @way@, the cutter goes straight down where the way begins, to the height of its
-- beginning. The moves of the way are not in the result.
withDepth :: Visit -> Mm -> (Mm, Mm) -> Maybe Way -> Point -> Point -> ([Move], [Move])
withDepth visit@Visit {word, milling, isLast, from} clear (inZ, outZ) way begin finish =
  ( case way of
      Nothing ->
        up <> over <> down inZ
          <> straightMoves
            (SpacePoint (plane above) inZ)
            [Part.Stop (Located word begin) (Just inZ) pace]
      Just w -> up <> over <> down (Descent.entryHeight w),
    leave <> lift <> rest
  )
  where
    pace = Part.At (feed milling)
    up = rise from clear word
    over = straightMoves (endPosition from up) (stopsOver visit clear begin way)
    above = endPosition (endPosition from up) over
    down = plunge word milling above
    (firstRetract, otherRetracts) = case Part.retract milling of
      s : more | Nothing <- Part.level s -> ([s {Part.level = Just outZ}], more)
      stops' -> ([], stops')
    leave = straightMoves (SpacePoint finish outZ) firstRetract
    out = endPosition (SpacePoint finish outZ) leave
    lift = rise out clear word
    rest =
      if isLast
        then
          straightMoves
            (endPosition out lift)
            [s {Part.level = Just (fromMaybe clear (Part.level s))} | s <- otherRetracts]
        else []

-- | The stops before the cutter goes down, at the clearance height @clear@ if they have no height:
-- those of the approach, or the beginning @begin@ of the pass without an approach. The beginning of
-- a way down follows them, straight up from a lower stop.
stopsOver :: Visit -> Mm -> Point -> Maybe Way -> [Stop]
stopsOver Visit {word, milling, isFirst} clear begin way = case way of
  Nothing | not (null stops) -> stops
  Nothing -> [above begin]
  Just w -> stops <> straight <> [above (Descent.entry w)]
  where
    stops =
      [ s {Part.level = Just (fromMaybe clear (Part.level s))}
        | s <- (if isFirst then id else lastOf) (Part.approach milling)
      ]
    straight =
      [ s {Part.level = Just clear, Part.pace = Part.Rapid}
        | s <- lastOf stops,
          Part.level s /= Just clear
      ]
    above p = Part.Stop (Located word p) (Just clear) Part.Rapid
    lastOf xs = take 1 (reverse xs)

-- | A vertical move to the height @target@ at the plunge feed, or at the feed of the statement if
-- the program gives no plunge feed. Empty if the cutter is at that height.
plunge :: Region -> Milling -> SpacePoint -> Mm -> [Move]
plunge word milling (SpacePoint p z) target =
  [Move (Straight p p) (Manner (z, target) (descentPace milling) False) word False | z /= target]

-- | The moves of a way down, at the plunge feed, or at the feed of the statement without one.
slopeMoves :: Region -> Milling -> Way -> NonEmpty (Maybe (Mm, Mm), Move)
slopeMoves word milling way =
  fmap
    ( \s ->
        ( Descent.along s,
          Move (Descent.piece s) (Manner (Descent.heights s) (descentPace milling) False) word False
        )
    )
    (Descent.slope way)

-- | The speed of moves down into the material.
descentPace :: Milling -> Part.Pace
descentPace milling = Part.At (fromMaybe (feed milling) (Part.plunge milling))

-- | A rapid move straight up to the height @clear@; empty if the cutter is not below that height.
-- @word@ is the region of the program that asks for the move.
rise :: SpacePoint -> Mm -> Region -> [Move]
rise (SpacePoint p z) clear word =
  [Move (Straight p p) (Manner (z, clear) Part.Rapid False) word False | z < clear]

-- | Straight moves from the position @at@ to each stop in turn. At a stop without a height the tool
-- keeps its current height. A stop at the current position needs no move.
straightMoves :: SpacePoint -> [Stop] -> [Move]
straightMoves at stops = case stops of
  [] -> []
  Part.Stop (Located region p) level pace : rest
    | Vec.isNear (plane at) p && z == height at -> straightMoves at rest
    | otherwise ->
      Move (Straight (plane at) p) (Manner (height at, z) pace False) region False :
      straightMoves (SpacePoint p z) rest
    where
      z = fromMaybe (height at) level

-- | The position at the end of the last move; @from@ if there are no moves.
endPosition :: SpacePoint -> [Move] -> SpacePoint
endPosition from ms = case ms of
  [] -> from
  [m] -> SpacePoint (Segment.end (Toolpath.segment m)) (snd (Toolpath.heights m))
  _ : more -> endPosition from more

-- | The first word of a statement that clears a pocket.
pocketKeyword :: Located Pocketing -> Region
pocketKeyword (Located region p) = keyword letters region
  where
    letters = case Part.extent p of
      Part.WholePocket -> 6
      Part.RestOfPocket _ -> 4
      Part.FloorOfCarving -> 4
      Part.Surface _ -> 4

-- | Shortens the region of a statement to its first word, which has @letters@ letters.
keyword :: Int -> Region -> Region
keyword letters r = r {end = start r + letters}
