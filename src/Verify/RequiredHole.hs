-- | Moves that the statements on holes ask for, as the manual describes them (docs/language.md,
-- "Drilling").
module Verify.RequiredHole
  ( holeLinks,
    slackOf,
  )
where

import Base.Quantity (Mm (..), minus, over, plus, times)
import Base.Region (Located (..))
import Control.Monad (guard)
import Data.Maybe (fromMaybe, isJust, isNothing)
import Geometry.Carrier (Circle (..), Sense (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (Z), Machine)
import Machine.Machine qualified as Machine
import Machine.ProgramForm qualified as ProgramForm
import Part.Part (Drilling, Hole, HoleForm (..), SpacePoint (..), ThreadHelix)
import Part.Part qualified as Part
import Verify.RequiredLink (RequiredLink (..))
import Verify.RequiredOrder qualified as RequiredOrder

-- | Moves of a statement on holes. The tool goes from hole to hole in rapid at the clearance
-- height, in the order of "Verify.RequiredOrder", makes each hole, and comes back to this height.
-- @begin@ is its position before the statement.
holeLinks :: Machine -> SpacePoint -> Located Drilling -> [RequiredLink]
holeLinks machine begin (Located statement drilling) =
  [RequiredLink (still at) (height begin, clear) Part.Rapid statement | height begin < clear]
    <> go (at, max clear (height begin)) (RequiredOrder.holesInOrder at drilling)
  where
    at = plane begin
    clear = Part.travelHeight drilling
    go _ [] = []
    go (from, z) (hole@(Part.Hole (Located region p) _ _) : more) =
      RequiredLink (Straight from first) (z, clear) Part.Rapid region :
      [RequiredLink s zs pace region | (s, zs, pace) <- made]
        <> go (final, clear) more
      where
        made = movesAt machine drilling hole
        first = case made of
          (s, _, _) : _ -> Segment.start s
          [] -> p
        final = case reverse made of
          (s, _, _) : _ -> Segment.end s
          [] -> p

-- | Largest distance of a motion from such a move, in the plane: a pulse, and on circles the
-- tolerance as well.
slackOf :: Machine -> Drilling -> Mm
slackOf machine drilling = case Part.runsOf drilling of
  Nothing -> Machine.planeResolution machine
  Just (_, tolerance) ->
    plus (uncurry max (Part.deviationLimits tolerance)) (Machine.planeResolution machine)

-- | Move at a hole: its path, its heights and its speed.
type HoleMove = (Segment, (Mm, Mm), Part.Pace)

still :: Point -> Segment
still p = Straight p p

-- | Moves at a hole, from the clearance height back to it.
movesAt :: Machine -> Drilling -> Hole -> [HoleMove]
movesAt machine d hole@(Part.Hole (Located _ p) bottom _) = case Part.form d of
  Plunged -> drilled machine d hole
  Reamed -> bothAtFeed
  Tapped _ -> bothAtFeed
  Bored c -> boredAt d c hole
  Threaded h -> threadedAt d h hole
  where
    feed = Part.At (Part.drillFeed d)
    clear = Part.travelHeight d
    bothAtFeed = [(still p, (clear, bottom), feed), (still p, (bottom, clear), feed)]

-- | In a hole the drill goes down at the feed of the statement, and rises in rapid to the clearance
-- height. With pecks it goes down in equal steps, none deeper than the peck. It returns in rapid to
-- 0.5 mm above the end of the step before, but not above the clearance height; with a chip break it
-- only rises by this much.
--
-- If the control has a cycle of its own for these pecks, they are those of the cycle: each is as
-- deep as the statement allows, in whole pulses, the first one from the clearance height; the last
-- one ends at the bottom. The drill returns as near as the cycle does.
drilled :: Machine -> Drilling -> Hole -> [HoleMove]
drilled machine d (Part.Hole (Located _ p) bottom _) =
  concat (zipWith3 peck [1 :: Int ..] (clear : map above ends) ends)
  where
    clear = Part.travelHeight d
    (ends, gap) = case (Part.peckDepth d, own) of
      (Nothing, _) -> ([bottom], Mm 0)
      (Just most, Nothing) ->
        let n = stepCount (minus (Mm 0) bottom) most
         in ([times (fromIntegral k / fromIntegral n) bottom | k <- [1 .. n]], Mm 0.5)
      (Just most, Just back) ->
        let n = max 1 (floor (over most unit + Tolerance.equal)) :: Int
            step = times (fromIntegral n) unit
            isLast z = z <= plus bottom (times Tolerance.equal unit)
         in (takeWhile (not . isLast) (drop 1 (iterate (`minus` step) clear)) <> [bottom], back)
    own = ownReturn machine d
    unit = Machine.resolutionOf machine Z
    count = length ends
    above z = min clear (plus z (fromMaybe gap (Part.chipRise d)))
    peck k from z =
      [(still p, (clear, from), Part.Rapid) | k > 1, isNothing (Part.chipRise d)]
        <> [(still p, (from, z), Part.At (Part.drillFeed d))]
        <> [(still p, (z, if stays then above z else clear), Part.Rapid)]
      where
        stays = k < count && isJust (Part.chipRise d)

-- | Height above the last step to which the control's own cycle returns; Nothing if it has none for
-- these pecks, and if its first step would end above the part.
ownReturn :: Machine -> Drilling -> Maybe Mm
ownReturn machine d = do
  cycles <- ProgramForm.cycles <$> Machine.programForm machine
  most <- Part.peckDepth d
  guard (most > Part.travelHeight d)
  case Part.chipRise d of
    Nothing -> ProgramForm.peckReturn cycles
    Just rise -> do
      back <- ProgramForm.chipReturn cycles
      let half = times 0.5 (Machine.resolutionOf machine Z)
      if rise >= minus back half && rise <= plus back half then Just back else Nothing

-- | Least number of equal steps down to a depth, none of them deeper than the peck; 10000 at most.
stepCount :: Mm -> Mm -> Int
stepCount deep peck = max 1 (min 10000 (ceiling (over deep peck - Tolerance.equal)))

-- | The cutter goes down east of the centre to the top of the part, then in a helix of whole turns,
-- none deeper than asked, and once around at the bottom. A counterbore begins with the largest
-- circle that leaves nothing in its middle; further circles follow outwards, none wider apart than
-- the cutter's radius. Where the middle is free, the cutter goes there in half a circle.
boredAt :: Drilling -> Part.Circling -> Hole -> [HoleMove]
boredAt d c (Part.Hole (Located _ p) bottom _) =
  [(still (east inner), (Part.travelHeight d, Mm 0), Part.At (Part.drillFeed d))]
    <> [(around inner, (part k, part (k + 1)), feed) | k <- [0 .. turns - 1]]
    <> [(around inner, (bottom, bottom), feed)]
    <> concat
      [ [ (Straight (east a) (east b), (bottom, bottom), feed),
          (around b, (bottom, bottom), feed)
        ]
        | (a, b) <- zip radii (drop 1 radii)
      ]
    <> [(Segment.arc sense middle (east outer) p, (bottom, bottom), feed) | isFree]
    <> [(still (if isFree then p else east outer), (bottom, Part.travelHeight d), Part.Rapid)]
  where
    feed = Part.At (Part.circleFeed c)
    sense = Part.circleSense c
    outer = minus (Part.boreRadius c) (Part.drillRadius d)
    count
      | Part.clearsFloor c =
        max 1 (ceiling (over outer (Part.drillRadius d) - Tolerance.equal))
      | otherwise = 1 :: Int
    radii = [times (fromIntegral k / fromIntegral count) outer | k <- [1 .. count]]
    inner = minimum (outer : radii)
    isFree = Part.clearsFloor c || outer <= plus (Part.drillRadius d) Tolerance.coincident
    turns = max 1 (ceiling (over (minus (Mm 0) bottom) (Part.turnDepth c) - Tolerance.equal)) :: Int
    part k = times (fromIntegral k / fromIntegral turns) bottom
    east (Mm x) = Vec.shift (Vec.vec x 0) p
    around r = Segment.fullCircle sense (Circle p r) (east r)
    middle = east (times 0.5 outer)

-- | The tool goes down at the centre of a hole, or east of a stud, and comes onto the helix in half
-- a circle. The helix has the least number of whole turns with which it ends at the top of the part
-- or above. Then half a circle leads back. All of them rise or fall by the pitch in a whole turn.
-- The lowest position is that of the depth.
threadedAt :: Drilling -> ThreadHelix -> Hole -> [HoleMove]
threadedAt d h (Part.Hole (Located _ p) bottom _) =
  [ (still away, (clear, z 0), Part.At (Part.drillFeed d)),
    (onto, (z 0, z 0.5), feed)
  ]
    <> [(around, (z (k + 0.5), z (k + 1.5)), feed) | k <- map fromIntegral [0 .. turns - 1]]
    <> [ (off, (z (whole + 0.5), z (whole + 1)), feed),
         (still away, (z (whole + 1), clear), Part.Rapid)
       ]
  where
    clear = Part.travelHeight d
    feed = Part.At (Part.helixFeed h)
    tool = Part.drillRadius d
    step = Part.pitch h
    depth = minus (Mm 0) bottom
    turns = max 1 (ceiling (over depth step - 0.5 - Tolerance.equal)) :: Int
    whole = fromIntegral turns :: Double
    -- Height after t turns.
    z t = plus bottom (times (if Part.rises h then t else whole + 1 - t) step)
    sense = Part.helixSense h
    radius = plus (Part.toothRadius h) (times (if Part.isInside h then -1 else 1) tool)
    east (Mm x) = Vec.shift (Vec.vec x 0) p
    touch = east radius
    (away, leadCentre, leadSense)
      | Part.isInside h = (p, east (times 0.5 radius), sense)
      | otherwise = (east (plus radius (times 2 tool)), east (plus radius tool), other)
    other = if sense == Clockwise then CounterClockwise else Clockwise
    around = Segment.fullCircle sense (Circle p radius) touch
    onto = Segment.arc leadSense leadCentre away touch
    off = Segment.arc leadSense leadCentre touch away
