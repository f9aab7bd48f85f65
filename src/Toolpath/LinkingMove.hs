-- | Linking moves: from the current position to the beginning of a pass, and from its end.
module Toolpath.LinkingMove
  ( Visit (..),
    withDepth,
    withoutDepth,
    straightMoves,
    rise,
    endPosition,
    keyword,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (..))
import Data.Maybe (fromMaybe)
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Milling (feed), SpacePoint (..), Stop)
import Part.Part qualified as Part
import Toolpath.Toolpath (Manner (Manner), Move (Move))
import Toolpath.Toolpath qualified as Toolpath

-- | One pass of a statement: the statement's first word, the milling parameters, flags for the
-- first and the last pass, and the position of the cutter before the pass.
data Visit = Visit
  { word :: Region,
    milling :: Milling,
    isFirst :: Bool,
    isLast :: Bool,
    from :: SpacePoint
  }

-- | The linking moves before and after a pass without depth, at the cutter's current height @z@.
-- The heights in the pair are those at the beginning and at the end of the pass.
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
    -- A blade is turned upright on the retract.
    upright stops = case stops of
      s : more
        | Nothing <- Part.level s,
          Just _ <- Part.gear milling ->
          s {Part.level = Just z} : more
      _ -> stops

-- | The linking moves before and after a pass with depth. At the clearance height the cutter
-- moves to the last approach point, or to the beginning of the pass, and plunges there. It
-- rises again at the first retract point, unless that point has its own height.
withDepth :: Visit -> Mm -> (Mm, Mm) -> Point -> Point -> ([Move], [Move])
withDepth Visit {word, milling, isFirst, isLast, from} clear (inZ, outZ) begin finish =
  ( up
      <> over
      <> down
      <> straightMoves
        (SpacePoint (plane above) inZ)
        [Part.Stop (Located word begin) (Just inZ) pace],
    leave <> lift <> rest
  )
  where
    pace = Part.At (feed milling)
    up = rise from clear word
    stops =
      [ s {Part.level = Just (fromMaybe clear (Part.level s))}
        | s <- (if isFirst then id else lastOf) (Part.approach milling)
      ]
    over =
      straightMoves
        (endPosition from up)
        (if null stops then [Part.Stop (Located word begin) (Just clear) Part.Rapid] else stops)
    above = endPosition (endPosition from up) over
    down = plunge word milling above inZ
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
    lastOf xs = take 1 (reverse xs)

-- | A move straight down to a height at the plunge feed; none at that height already.
plunge :: Region -> Milling -> SpacePoint -> Mm -> [Move]
plunge word milling (SpacePoint p z) target =
  [Move (Straight p p) (Manner (z, target) (Part.At feedDown) False) word False | z /= target]
  where
    feedDown = fromMaybe (feed milling) (Part.plunge milling)

-- | A rapid move straight up to a height, if the cutter is below it.
rise :: SpacePoint -> Mm -> Region -> [Move]
rise (SpacePoint p z) clear word =
  [Move (Straight p p) (Manner (z, clear) Part.Rapid False) word False | z < clear]

-- | Straight moves from stop to stop. A stop at the current position needs no move.
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

-- | The position after moves that begin at a position.
endPosition :: SpacePoint -> [Move] -> SpacePoint
endPosition from ms = case ms of
  [] -> from
  [m] -> SpacePoint (Segment.end (Toolpath.segment m)) (snd (Toolpath.heights m))
  _ : more -> endPosition from more

-- | The region of a statement's first word, which has @letters@ letters.
keyword :: Int -> Region -> Region
keyword letters r = r {end = start r + letters}
