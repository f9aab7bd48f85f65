-- | Linking moves over the solids that a program avoids.
--
-- A rapid linking move that would enter such a solid goes straight up before, across above it, and
-- straight down after it. It passes over the solid at the clearance height above its top. The moves
-- of the statements @rapid@ and @move@ are those of the program and stay as they are.
module Toolpath.MoveOver
  ( overSolids,
  )
where

import Base.Quantity (Mm)
import Base.Region (Located (..))
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.Segment (Segment (Straight))
import Part.AvoidedSolid (AvoidedSolid)
import Part.AvoidedSolid qualified as AvoidedSolid
import Part.Part (Cutter, Solid)
import Part.Part qualified as Part
import Toolpath.Toolpath (Block (..), Move, Sent (..))
import Toolpath.Toolpath qualified as Toolpath

-- | The blocks with linking moves over the solids. Each block comes with the tool in the spindle.
overSolids :: [Located Solid] -> [(Maybe Cutter, Block)] -> [Block]
overSolids solids blocks
  | null solids = map snd blocks
  | otherwise = map (\(cutter, b) -> maybe b (over b) cutter) blocks
  where
    ready = map (AvoidedSolid.prepared . value) solids
    over b cutter = case b of
      Travelling {} -> b
      Commanding _ -> b
      Holing d ms -> Holing d (raised cutter (Just (Part.travelHeight (value d))) ms)
      Carved c (m :| more) rest ->
        -- The first move leads to the first point.
        case raised cutter (Just (Part.carvingTravel (value c))) (m : more) of
          m' : more' -> Carved c (m' :| more') rest
          [] -> b
      Cutting {job, approach, retract, sent} ->
        let up = raised cutter (Part.clearance (value job))
         in b {approach = up approach, retract = up retract, sent = sentOver up <$> sent}
      Clearing {pocket, approach, cleared, retract} ->
        let up = raised cutter (Part.clearance (Part.wall (value pocket)))
            m :| more = cleared
         in b {approach = up approach, cleared = m :| up more, retract = up retract}
    sentOver up s = s {before = up (before s), behind = up (behind s)}
    raised cutter clearance = case clearance of
      Nothing -> id
      Just c -> concatMap (raisedMove ready cutter c)

-- | A linking move over the solids, as one move or as three.
raisedMove :: [AvoidedSolid] -> Cutter -> Mm -> Move -> [Move]
raisedMove solids cutter clearance m = case Toolpath.segment m of
  Straight p q
    | Toolpath.pace m == Part.Rapid,
      p /= q,
      Just h <-
        AvoidedSolid.heightOver clearance solids cutter (Toolpath.segment m) (min from to) ->
      let high = max h from
       in [move (Straight p p) (from, high) | from /= high]
            <> [move (Straight p q) (high, high)]
            <> [move (Straight q q) (high, to) | high /= to]
  _ -> [m]
  where
    (from, to) = Toolpath.heights m
    move s zs = (Toolpath.atHeights zs m) {Toolpath.segment = s}
