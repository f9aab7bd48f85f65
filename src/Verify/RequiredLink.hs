-- | Approaches, retracts and leads as the part demands them (docs/language.md, "Stops", "Passes"
-- and "Depth"). The folder "Toolpath" computes the same moves by itself; nothing is imported from
-- there, so that the proof notices a toolpath with other moves.
module Verify.RequiredLink
  ( RequiredLink (..),
    Place (..),
    stopMoves,
    before,
    behind,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (..))
import Data.Maybe (fromMaybe, isNothing)
import Geometry.Carrier (Side (LeftOf))
import Geometry.Carrier qualified as Carrier
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.Part (Milling, Pace, SpacePoint (..), Stop)
import Part.Part qualified as Part
import Verify.Descent (Slope (Slope))
import Verify.Descent qualified as Descent

-- | Linking move of the cutter's centre: its path in the plane, its heights at the beginning and at
-- the end (the top of the part is 0), its speed, and the region of the program that asks for it.
data RequiredLink = RequiredLink
  { path :: Segment,
    between :: (Mm, Mm),
    pace :: Pace,
    origin :: Region
  }

-- | Place of a cut in its statement: the statement, the side of the cutter, the height of the cut,
-- and its position among the cuts.
data Place = Place
  { milling :: Milling,
    word :: Region,
    side :: Maybe Side,
    level :: Mm,
    -- | the point above which the way down begins; Nothing if the cutter goes straight down
    entry :: Maybe Point,
    -- | the way down, whose moves come before those to the cut; empty if they belong to the cut
    slopes :: [Slope],
    -- | true for the first and for the last cut of the statement
    isFirst :: Bool,
    isLast :: Bool
  }

-- | Straight moves from a position to each stop. At a stop without a height the cutter keeps its
-- height. There is no move to a stop at which the cutter already is.
stopMoves :: SpacePoint -> [Stop] -> [RequiredLink]
stopMoves at stops = case stops of
  [] -> []
  Part.Stop (Located region p) given pace : more
    | Vec.isNear p (plane at) && z == height at -> stopMoves at more
    | otherwise ->
      RequiredLink (Straight (plane at) p) (height at, z) pace region :
      stopMoves (SpacePoint p z) more
    where
      z = fromMaybe (height at) given

-- | Moves from the position @at@ to the beginning of a cut, with the lead-in. The cut begins at the
-- point @begin@, in the unit direction @ahead@, at the height @z@; this height differs from 'level'
-- only for a blade.
before :: Place -> SpacePoint -> (Point, Vec, Mm) -> [RequiredLink]
before place at (begin, ahead, z) = approach <> leadIn
  where
    m = milling place
    downPace = Part.At (fromMaybe (Part.feed m) (Part.plunge m))
    leadIn = map (leadMove place z) (leadOf place (Part.leadIn m) (-1) ahead begin)
    target = case leadIn of
      l : _ -> Segment.start (path l)
      [] -> begin
    final = Part.Stop (Located (word place) target) (Just z) (feedOf m)
    approach = case depthOf m of
      Nothing ->
        stopMoves at ([s | isFirst place || isOpen m, s <- Part.approach m] <> [final])
      Just clear ->
        let up = lift place at clear
            over = stopMoves (endOf at up) (atClearance clear place target)
            above = endOf (endOf at up) over
            down = vertical place above z downPace
         in case entry place of
              Nothing -> up <> over <> down <> stopMoves (SpacePoint (plane above) z) [final]
              Just p ->
                let stops =
                      [overPart clear s | s <- comingStops]
                        <> straightUp
                        <> [Part.Stop (Located (word place) p) (Just clear) Part.Rapid]
                    over' = stopMoves (endOf at up) stops
                    above' = endOf (endOf at up) over'
                    slope = map (slopeMove place downPace) (slopes place)
                 in up <> over'
                      <> vertical place above' (entryHeight place) downPace
                      <> slope
                      <> (if null slope then [] else stopMoves (endOf above' slope) [final])
    straightUp =
      [ p {Part.level = Just clear, Part.pace = Part.Rapid}
        | Just clear <- [depthOf m],
          p <- take 1 (reverse comingStops),
          maybe False (/= clear) (Part.level p)
      ]
    comingStops
      | isFirst place = Part.approach m
      | otherwise = take 1 (reverse (Part.approach m))

-- | The height at which the slope of a way down begins. Over a tab it is that of the tab.
entryHeight :: Place -> Mm
entryHeight place = case slopes place of
  s : _ -> fst (Descent.between s)
  [] -> Descent.highest (milling place) (level place)

-- | The move of a part of a way down.
slopeMove :: Place -> Pace -> Slope -> RequiredLink
slopeMove place pace (Slope s zs) = RequiredLink s zs pace (word place)

-- | Stops at which the cutter passes over the part before it goes down: all stops of the approach
-- before the first cut, and only the last one before the others. Without an approach it is the
-- beginning of the cut or of its lead-in, @target@.
atClearance :: Mm -> Place -> Point -> [Stop]
atClearance clear place target = case Part.approach (milling place) of
  [] -> [Part.Stop (Located (word place) target) (Just clear) Part.Rapid]
  stops -> map (overPart clear) (if isFirst place then stops else take 1 (reverse stops))

-- | Moves from the end of a cut, with the lead-out. The cut ends at the point @finish@, in the unit
-- direction @ahead@, at the height @z@.
behind :: Place -> (Point, Vec, Mm) -> [RequiredLink]
behind place (finish, ahead, z) = leadOut <> retract
  where
    m = milling place
    leadOut = map (leadMove place z) (leadOf place (Part.leadOut m) 1 ahead finish)
    at = endOf (SpacePoint finish z) leadOut
    retract = case (depthOf m, Part.retract m) of
      (Nothing, stops) ->
        let leave = [s | isLast place || isOpen m, s <- uprightFirst stops]
         in case stopMoves at leave of
              [] -> vertical place at (level place) (feedOf m)
              moves -> moves
      (Just clear, stops) ->
        let (atLevel, others) = case stops of
              s : more | isNothing (Part.level s) -> ([s {Part.level = Just z}], more)
              _ -> ([], stops)
            leave = stopMoves at atLevel
            up = lift place (endOf at leave) clear
            rest = [overPart clear s | isLast place, s <- others]
         in leave <> up <> stopMoves (endOf (endOf at leave) up) rest
    -- After the cut, a blade swivels back to its upright position.
    uprightFirst stops = case stops of
      s : more
        | isNothing (Part.level s),
          Just _ <- Part.gear m ->
          s {Part.level = Just (level place)} : more
      _ -> stops

-- | Move along a lead at the height @z@, at the feed of the statement.
leadMove :: Place -> Mm -> Segment -> RequiredLink
leadMove place z s = RequiredLink s (z, z) (feedOf (milling place)) (word place)

-- | Lead-in (@sense@ = -1) or lead-out (@sense@ = 1) at the end @p@ of a cut with the unit
-- direction @ahead@: a line in this direction, or a quarter of a circle that touches the cut and
-- curves away from the material.
leadOf :: Place -> Maybe (Part.LeadForm, Mm) -> Double -> Vec -> Point -> [Segment]
leadOf place asked sense ahead p = case asked of
  Nothing -> []
  Just (Part.LeadLine, Mm l) -> [directed (\q -> Straight q p) (Straight p) (along l p)]
  Just (Part.LeadArc, Mm r) ->
    let free = fromMaybe LeftOf (side place)
        centre = Carrier.beside free (Mm r) ahead p
        turn = Carrier.senseTowards free
     in [directed (\q -> Segment.arc turn centre q p) (Segment.arc turn centre p) (along r centre)]
  where
    along l = Vec.shift (Vec.scale (sense * l) ahead)
    directed onto off q = if sense < 0 then onto q else off q

-- | Clearance height of a milling with a depth; Nothing without a depth.
depthOf :: Milling -> Maybe Mm
depthOf m = if null (Part.levels m) then Nothing else Part.clearance m

isOpen :: Milling -> Bool
isOpen m = Part.ends (Part.contour m) == Part.Open

feedOf :: Milling -> Pace
feedOf = Part.At . Part.feed

-- | Stop at its own height, or else at the clearance height.
overPart :: Mm -> Stop -> Stop
overPart clear s = s {Part.level = Just (fromMaybe clear (Part.level s))}

-- | Rapid move straight up to the clearance height, if the cutter is below it.
lift :: Place -> SpacePoint -> Mm -> [RequiredLink]
lift place at clear = [l | height at < clear, l <- vertical place at clear Part.Rapid]

-- | Vertical move to a height; none if the cutter is there.
vertical :: Place -> SpacePoint -> Mm -> Pace -> [RequiredLink]
vertical place (SpacePoint p z) to pace =
  [RequiredLink (Straight p p) (z, to) pace (word place) | z /= to]

-- | Position at the end of moves that begin at @at@.
endOf :: SpacePoint -> [RequiredLink] -> SpacePoint
endOf = foldl (\_ l -> SpacePoint (Segment.end (path l)) (snd (between l)))
