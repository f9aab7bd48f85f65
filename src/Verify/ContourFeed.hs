-- | Comparison of the feeds along a contour with those that the program asks for, on a tape with
-- other frames than planned.
--
-- A motion has the feed of an element that the cutter may touch, at every point that is examined: a
-- little after its start and before its end, in its middle, and where it is nearest to the middle
-- of an element. At a corner, the feed of the statement is allowed, too.
--
-- At the end of an element with @slow@, a machine that slows down by slow frames has to run at its
-- lowest feed for the length that it needs to slow down.
module Verify.ContourFeed
  ( findings,
  )
where

import Base.Quantity (Feed (..), Mm (..), minus, plus, times, total)
import Base.Region (Located (..))
import Control.Motion (Motion)
import Control.Motion qualified as Control
import Data.List (nub, partition, tails)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isNothing)
import Frame.Frame qualified as Frame
import Geometry.Distance qualified as Distance
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (BrakingForm (..), Machine)
import Machine.Machine qualified as Machine
import Part.CutFeed qualified as CutFeed
import Part.Part (Element)
import Part.Part qualified as Part
import Verify.Edge (Edge (element, ownAllowance, shape))
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
findings machine job allMotions =
  Feed.atFeed machine (fromMaybe demanded (Part.plunge (milling job))) [] (map snd descending)
    <> findingsAtLevel machine job motions
  where
    demanded = Part.feed (milling job)
    -- The cutter goes down from a tab at the plunge feed.
    (descending, motions) = case Part.tabs (milling job) of
      Nothing -> ([], allMotions)
      Just _ -> partition (goesDown . snd) allMotions
    goesDown m = let (from, to) = Control.height machine m in to < from

-- | Findings for feeds of the motions along a contour that do not go down from a tab.
findingsAtLevel :: Machine -> MillingJob -> [ContourMotion] -> [Finding]
findingsAtLevel machine job motions
  | isUniform = Feed.atFeed machine demanded everywhere (map snd motions)
  | otherwise = concatMap ofMotion motions <> slowFindings machine job motions
  where
    demanded = Part.feed (milling job)
    everywhere = map Part.finish (MillingJob.elementsOf job)
    isUniform = all (\f -> null (Part.ownFeed f) && not (Part.slow f)) everywhere
    ofMotion (c, m) = take 1 (concatMap wrongAt (nub (map (contactAt job c) (examined job c))))
      where
        wrongAt Contact {isAtEnds, touchable}
          | null touchable = Feed.atFeed machine demanded everywhere [m]
          | any null ways = []
          | otherwise = concat ways
          where
            ways =
              [Feed.atFeed machine demanded [] [m] | isAtEnds]
                <> [ Feed.atFeed machine (feedOf f) [f {Part.ownFeed = Nothing}] [m]
                     | f <- map Part.finish touchable
                   ]
    feedOf f = fromMaybe demanded (Part.ownFeed f)

-- | Elements that the cutter may touch at a point of a motion: those within the largest distance
-- that its centre may have from an element.
data Contact = Contact
  { -- | true if the cutter touches elements only near their ends, as at a corner
    isAtEnds :: Bool,
    touchable :: [Element]
  }
  deriving stock (Eq)

-- | Contact of the cutter at a fraction of a motion, from 0 to 1.
contactAt :: MillingJob -> CutterMotion -> Double -> Contact
contactAt job c k =
  Contact (all isNearEnd (filter (isAtReach job p) near)) (map element near)
  where
    p = Segment.at k (segment c)
    near = filter isTouched (MillingJob.edgesAround job p)
    isTouched e = Distance.toPoint p (shape e) <= MillingJob.contactLimit job
    isNearEnd e =
      let share = Distance.nearestFraction p (shape e)
       in times (min share (1 - share)) (Segment.length (shape e)) <= margin job

-- | Test that the cutter's centre is at the distance from an element that it keeps beside it.
isAtReach :: MillingJob -> Point -> Edge -> Bool
isAtReach job p e = Mm (abs away) <= allowance job
  where
    Mm away = minus (Distance.toPoint p (shape e)) (plus (reach job) (ownAllowance e))

-- | Test that a motion, in its middle, runs beside an element and in its direction.
runsAlong :: MillingJob -> Edge -> CutterMotion -> Bool
runsAlong job e c =
  Segment.hasFootOf (shape e) p
    && isAtReach job p e
    && Vec.dot (Segment.directionAt 0.5 (segment c)) (Segment.directionAt foot (shape e)) > 0
  where
    p = Segment.at 0.5 (segment c)
    foot = Distance.nearestFraction p (shape e)

-- | Length in mm by which rounding may move a joint between two elements.
margin :: MillingJob -> Mm
margin job = times 3 (allowance job)

-- | Fractions of a motion at which the feed is compared. They are at least the 'margin' away from
-- both ends.
examined :: MillingJob -> CutterMotion -> [Double]
examined job c
  | first >= 0.5 = [0.5]
  | otherwise = [first, 0.5, 1 - first] <> filter isInside (map nearestToMiddle near)
  where
    Mm long = Segment.length (segment c)
    first = let Mm l = margin job in if long > 0 then l / long else 1
    near = MillingJob.edgesNear job c
    nearestToMiddle e = Distance.nearestFraction (Segment.at 0.5 (shape e)) (segment c)
    isInside k = k > first && k < 1 - first

-- | Findings for missing slow frames at the ends of elements, and for slow frames elsewhere. An
-- element counts with the motions in whose middle the cutter touches only this element, and with
-- those that run beside it from the last of them to the first motion along another element, in its
-- direction. At the end it has to be slow for the length that the machine needs to slow down, and
-- nowhere else; the 'margin' may be missing or too much.
slowFindings :: Machine -> MillingJob -> [ContourMotion] -> [Finding]
slowFindings machine job motions = case Machine.brakingForm (Machine.braking machine) of
  SlowFrames -> concatMap ofElement (BoxTree.toList (edges job))
  ByControl -> []
  BrakedFrames _ -> []
  where
    ofElement e = case (Part.slow finish, Map.lookup (Part.origin (element e), shape e) beside) of
      (True, Just ends@((final, after) : _)) ->
        let own = dropWhile (not . isSlow) (reverse (filter isBeside after)) <> map fst ends
            -- Lengths from the starts of these motions to the end of the last, which is first here.
            far = drop 1 (scanl plus (Mm 0) (map lengthOf own))
            long = maybe (Mm 0) slowLength (CutFeed.perMinute (value asked))
            needed = min long (total (map lengthOf own))
            (slowLast, needless) = partition ((<= plus long (margin job)) . snd) slows
            slows = [(m, l) | (m, l) <- zip own far, isSlow m]
         in [ Feed.notSlow machine (region asked) (snd final)
              | null needless,
                needed > margin job,
                total (map (lengthOf . fst) slowLast) < minus needed (margin job)
            ]
              <> take 1 (Feed.atFeed machine asked [] (map (snd . fst) (reverse needless)))
      _ -> []
      where
        finish = Part.finish (element e)
        asked = fromMaybe (Part.feed (milling job)) (Part.ownFeed finish)
        isBeside = runsAlong job e . fst
    -- For each element, its motions, and after each of them those along no single element. The last
    -- motion comes first.
    beside =
      Map.fromListWith
        (<>)
        [ (i, [(m, map fst (takeWhile (isNothing . snd) later))])
          | (m, Just i) : later <- tails (map (\m -> (m, alongOnly (fst m))) motions)
        ]
    alongOnly c = case contactAt job c 0.5 of
      Contact False [e] -> Just (Part.origin e, Part.segment e)
      _ -> Nothing
    isSlow (_, m) = Frame.feedCode (Control.frame m) == fst (Machine.slowest machine)
    lengthOf = Segment.length . segment . fst
    slowLength (Feed v) =
      let perSecond = v / 60
       in Mm (perSecond * perSecond / (2 * Machine.deceleration (Machine.braking machine)))
