-- | Comparison of the feeds along a contour with those that the program asks for, on a tape with
-- other frames than planned.
--
-- A motion has the feed of an element that the cutter touches, at every point that is examined: a
-- little after its start and before its end, in its middle, and where it is nearest to the middle
-- of an element. Where the cutter touches several elements, as at a corner, each of their feeds is
-- allowed. Where it touches none, as on the way around a sharp corner, the feeds of all elements
-- are.
--
-- At the end of an element with @slow@, a machine that slows down by slow frames has to run at its
-- lowest feed for the length that it needs to slow down.
module Verify.ContourFeed
  ( findings,
  )
where

import Base.Quantity (Feed (..), Mm (..), minus, times, total)
import Base.Region (Located (..))
import Control.Motion (Motion)
import Control.Motion qualified as Control
import Data.IntMap.Strict qualified as IntMap
import Data.List (nub, tails)
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Frame.Frame qualified as Frame
import Geometry.Distance qualified as Distance
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Machine.Machine (BrakingForm (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Element)
import Part.Part qualified as Part
import Verify.Edge (Edge (element, rank, shape))
import Verify.Feed qualified as Feed
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob
import Verify.Motion (CutterMotion (segment))
import Verify.Proof (Finding)

-- | Motion along a contour: that of the cutter's centre, and that of the frame, before cutter
-- compensation.
type ContourMotion = (CutterMotion, Motion)

-- | Findings for feeds of the motions along a contour, which are in the order of the tape.
findings :: Machine -> MillingJob -> [ContourMotion] -> [Finding]
findings machine job motions
  | isUniform = Feed.atFeed machine demanded everywhere (map snd motions)
  | otherwise = concatMap ofMotion motions <> slowFindings machine job motions
  where
    demanded = Part.feed (milling job)
    everywhere = map Part.finish (MillingJob.elementsOf job)
    isUniform = all (\f -> null (Part.ownFeed f) && not (Part.slow f)) everywhere
    ofMotion (c, m) =
      take 1 (mapMaybe (wrongAmong . map Part.finish) (nub (map (touchedAt job c) (examined job c))))
      where
        wrongAmong finishes
          | null finishes = listToMaybe (Feed.atFeed machine demanded everywhere [m])
          | otherwise = allOf [Feed.atFeed machine (feedOf f) [plainly f] [m] | f <- finishes]
    feedOf f = fromMaybe demanded (Part.ownFeed f)
    plainly f = f {Part.ownFeed = Nothing}
    allOf ways = if any null ways then Nothing else listToMaybe (concat ways)

-- | Elements that the cutter touches at a fraction of a motion.
touchedAt :: MillingJob -> CutterMotion -> Double -> [Element]
touchedAt job c k = [element e | e <- near, rank e `elem` map fst (MillingJob.contacts job near p)]
  where
    p = Segment.at k (segment c)
    near = MillingJob.edgesAround job p

-- | Fractions of a motion at which the feed is compared. The margin at both ends, three times the
-- allowed deviation, is where rounding may move a joint between two elements.
examined :: MillingJob -> CutterMotion -> [Double]
examined job c
  | margin >= 0.5 = [0.5]
  | otherwise = [margin, 0.5, 1 - margin] <> filter isInside (map nearestToMiddle near)
  where
    Mm long = Segment.length (segment c)
    Mm deviation = allowance job
    margin = if long > 0 then 3 * deviation / long else 1
    near = MillingJob.edgesNear job c
    nearestToMiddle e = Distance.nearestFraction (Segment.at 0.5 (shape e)) (segment c)
    isInside k = k > margin && k < 1 - margin

-- | Findings for missing slow frames at the ends of elements. An element counts with the motions in
-- whose middle the cutter touches only this element. The last of them, or the motion after it, has
-- to be slow, and the slow ones have to be as long as the machine needs to slow down.
slowFindings :: Machine -> MillingJob -> [ContourMotion] -> [Finding]
slowFindings machine job motions = case Machine.brakingForm (Machine.braking machine) of
  SlowFrames -> concatMap ofElement (BoxTree.toList (edges job))
  ByControl -> []
  BrakedFrames _ -> []
  where
    ofElement e = case (Part.slow finish, IntMap.lookup (rank e) beside) of
      (True, Just pairs@((final, next) : _))
        | any isSlow (final : next),
          lengthOf (filter isSlow (next <> map fst pairs)) >= minus wanted margin ->
          []
        | otherwise -> [Feed.notSlow machine (region asked) (snd final)]
        where
          wanted = min (slowLength (value asked)) (lengthOf (map fst pairs))
      _ -> []
      where
        finish = Part.finish (element e)
        asked = fromMaybe (Part.feed (milling job)) (Part.ownFeed finish)
    -- For each element, its motions and the motion after each of them, the last motion first.
    beside =
      IntMap.fromListWith
        (<>)
        [ (i, [(m, take 1 later)])
          | m@(c, _) : later <- tails motions,
            [i] <- [map fst (MillingJob.contacts job (near c) (middle c))]
        ]
    near = MillingJob.edgesAround job . middle
    middle = Segment.at 0.5 . segment
    isSlow (_, m) = Frame.feedCode (Control.frame m) == fst (Machine.slowest machine)
    lengthOf = total . map (Segment.length . segment . fst)
    margin = times 3 (allowance job)
    slowLength (Feed v) =
      let perSecond = v / 60
       in Mm (perSecond * perSecond / (2 * Machine.deceleration (Machine.braking machine)))
