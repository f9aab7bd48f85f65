-- | Search for one cut along a contour on the tape: the motions that go along the contour from its
-- start to its end, in the direction of travel.
--
-- An /arrival/ is a motion that ends at the start of the cut. From each arrival the search follows
-- the contact point along the contour; this is the point nearest to the cutter's centre. The cut
-- begins at the first arrival from which the contact point comes to the end of the contour. The
-- /slack/ is the uncertainty of the contact point's arc length ("Verify.ContactMeasure"): a step
-- back by at most the slack may be due to rounding. A /partial cut/ is one of several cuts of a
-- pass, none of which goes along the whole contour.
module Verify.PassSearch
  ( FoundPass (..),
    motionsOf,
    find,
  )
where

import Base.Quantity (Mm (..), plus, total)
import Control.Applicative ((<|>))
import Data.IntSet qualified as IntSet
import Data.List (dropWhileEnd, inits, sortOn, tails)
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe, maybeToList)
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Verify.ContactMeasure (Measure (..))
import Verify.ContactMeasure qualified as ContactMeasure
import Verify.Edge (Edge (long, ownAllowance, shape, startsAt))
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob
import Verify.MillingJob.Fast qualified as FastContact
import Verify.Motion (CutterMotion (number, segment))
import Verify.Motion qualified as Motion

-- | Motions of one cut on the tape.
data FoundPass
  = -- | The motion that arrives at the start, if it is known, and the motions along the contour.
    Complete [CutterMotion] [CutterMotion]
  | -- | The start is reached, but no motions are known to follow the contour from there to its end.
    -- This is the result for every partial cut. The first list has the motion that arrives at the
    -- start, if it is known. The second has the motions after it, up to the end of the cut; all of
    -- them if none ends there.
    Incomplete [CutterMotion] [CutterMotion]
  | -- | The start is not reached.
    Missing

-- | All motions of a cut: the arrival and the motions along the contour.
motionsOf :: FoundPass -> [CutterMotion]
motionsOf found = case found of
  Complete arrival along -> arrival <> along
  Incomplete arrival along -> arrival <> along
  Missing -> []

-- | Arrival at the start of a cut. The first list contains the motion that arrives there, or
-- nothing if this motion is unknown. The second list contains all later motions.
type Arrival = ([CutterMotion], [CutterMotion])

-- | Find a cut among the motions at its height. @at@ is the position of the cutter's centre before
-- the first motion; Nothing if the cutter is not yet at that height. The contact points of a
-- partial cut are not followed: if two partial cuts almost touch, contact points do not show where
-- one ends. A partial cut begins at the first arrival after which the cutter stays beside the
-- contour, or at the first arrival if there is no such one. If a closed contour begins in a slot as
-- wide as the cutter or at a step between allowances, the cut may first go there and back on the
-- same path.
find :: MillingJob -> Maybe Point -> [CutterMotion] -> FoundPass
find job at motions = case (complete, filter (staysBeside job . snd) arrivals <> arrivals) of
  (found : _, _) -> found
  ([], (arrival, rest) : _) -> Incomplete arrival (untilExit job rest)
  ([], []) -> Missing
  where
    measure = ContactMeasure.measureOf job
    arrivals = arrivalsIn job at motions
    -- A cut that ends before the first lift comes first, because a later statement may cut the same
    -- contour at the same height.
    complete = completeIn unbroken <> completeIn id
    completeIn part =
      [ Complete arrival (out <> take count rest)
        | isResolved measure && not (isPartialCut job),
          (before, later@(_, rest) : _) <- zip (inits arrivals) (tails arrivals),
          let (arrival, out) = firstArrival job before later,
          count <- maybeToList (countFollowing job measure (part rest))
      ]

-- | Arrival at which a cut begins that follows the contour after the arrival @chosen@, and the
-- motions from the one arrival to the other. It is the first of the arrivals @before@ from which
-- the cutter goes out and back to @chosen@ on the same path beside a closed contour; if there is
-- none, it is @chosen@ itself.
firstArrival :: MillingJob -> [Arrival] -> Arrival -> ([CutterMotion], [CutterMotion])
firstArrival job before chosen =
  fromMaybe (fst chosen, []) (listToMaybe (mapMaybe fromArrival before))
  where
    fromArrival (arrival, rest)
      | MillingJob.isClosed job,
        goThereAndBack job between,
        length (unbroken (between <> take 1 (snd chosen))) == length between + 1,
        length (besideFrom job between) == length between =
        Just (arrival, between)
      | otherwise = Nothing
      where
        between = take (length rest - length (snd chosen)) rest

-- | Arrivals at the start of a cut, in the order of the tape. The arriving motion is unknown if the
-- cutter was at the start already, or came from another height. A line that begins near the start
-- and ends still nearer belongs to the approach, which was divided for braking. The start then
-- counts as reached at the end of that line.
arrivalsIn :: MillingJob -> Maybe Point -> [CutterMotion] -> [Arrival]
arrivalsIn job at = go Nothing
  where
    go previous motions = case motions of
      [] ->
        [([m], []) | Just m <- [previous], endsNear job (entry job) m]
          <> [([], []) | Nothing <- [previous], Just p <- [at], isNear job (entry job) p]
      m : rest ->
        [ ([p | Just p <- [previous], endsNear job (entry job) p], motions)
          | isNear job (entry job) (Segment.start (segment m)),
            not (isArriving m)
        ]
          <> go (Just m) rest
    isArriving m = case segment m of
      Straight a b -> Vec.distance b (entry job) < Vec.distance a (entry job)
      Arc {} -> False

-- | Test that the cutter touches the contour in all motions up to the end of the cut. @rest@ are
-- the motions after an arrival. False, for example, if the cutter arrived here at the end of
-- another cut and now moves away.
staysBeside :: MillingJob -> [CutterMotion] -> Bool
staysBeside job rest = not (null along) && length (besideFrom job along) == length along
  where
    along = untilExit job rest

-- | First motions of a list, up to the first one in which the cutter does not touch the contour.
besideFrom :: MillingJob -> [CutterMotion] -> [CutterMotion]
besideFrom job motions =
  map fst (takeWhile (uncurry touches) (zip motions (MillingJob.edgesNearEach job motions)))
  where
    touches m near = all (\k -> isTouched job near (Segment.at k (segment m))) (sampled m)
    -- A line may cut a corner, so only its end is tested.
    sampled m = case segment m of
      Straight _ _ -> [1]
      Arc {} -> Motion.samples m

-- | Test that the cutter with its centre at @p@ touches one of the elements @near@.
isTouched :: MillingJob -> [Edge] -> Point -> Bool
isTouched job near p =
  any
    ( \e ->
        FastDistance.mayLieWithin limit (long e) (shape e) (Vec.x p) (Vec.y p)
          && FastDistance.distance (shape e) (Vec.x p) (Vec.y p) <= limit
    )
    near
  where
    Mm limit = MillingJob.contactLimit job

-- | Test that the distance of two positions is within the allowed deviation.
isNear :: MillingJob -> Point -> Point -> Bool
isNear job p q = Vec.distance p q <= allowance job

-- | Test that a motion ends at a position, within the allowed deviation.
endsNear :: MillingJob -> Point -> CutterMotion -> Bool
endsNear job p = isNear job p . Segment.end . segment

-- | Test that a point is the end of the cut, within 'exitTolerance'.
isAtExit :: MillingJob -> Point -> Bool
isAtExit job p = Vec.distance (exit job) p <= exitTolerance job

-- | Test that a motion ends at the end of the cut.
endsAtExit :: MillingJob -> CutterMotion -> Bool
endsAtExit job = isAtExit job . Segment.end . segment

-- | Test that a motion is a line that goes away from the end of the cut. Such a line near that end
-- belongs to the next link, which was divided.
isLeaving :: MillingJob -> CutterMotion -> Bool
isLeaving job m = case segment m of
  Straight a b -> Vec.distance b (exit job) > Vec.distance a (exit job)
  Arc {} -> False

-- | Test that a motion is a full circle.
isFullCircle :: CutterMotion -> Bool
isFullCircle m = case segment m of
  Straight _ _ -> False
  Arc {start, end} -> start == end

-- | First motions of a list, up to the first gap in the numbers of their frames. At a gap, the tape
-- has a motion at another height, which the list leaves out.
unbroken :: [CutterMotion] -> [CutterMotion]
unbroken motions = case motions of
  m : rest@(next : _) | number next <= number m + 1 -> m : unbroken rest
  m : _ -> [m]
  [] -> []

-- | Motions up to the first one that ends at the end of the cut, and the motions after it that stay
-- at that end. Motions that stay at the start of the cut are skipped in the search for the end,
-- because the start and the end of a closed contour may be the same point. In a slot as wide as the
-- cutter, the cutter may pass the end of the cut on its way. Beside an open contour, later motions
-- are therefore added, up to the last one that ends there, if the cutter touches the contour in all
-- of them. Beside a closed contour, the cut goes on if the motions so far lead out and back on the
-- same path. In a room hardly larger than the cutter, a cut may end where it starts. The cutter may
-- then leave the height after the motions that stay at the start; these are the whole cut.
untilExit :: MillingJob -> [CutterMotion] -> [CutterMotion]
untilExit job motions
  | isAtExit job (entry job) && leavesHeight = leaving
  | otherwise = leaving <> along <> staying <> again
  where
    leavesHeight = not (null leaving) && null (drop (length leaving) (unbroken motions))
    (leaving, away) = span staysAtEntry motions
    (along, back) = break (endsAtExit job) away
    (staying, later) = span staysAtExit (unbroken back)
    cut = along <> staying
    again
      | isPartialCut job || null later = []
      | MillingJob.isClosed job =
        if not (null cut) && goThereAndBack job cut then untilExit job later else []
      | otherwise = dropWhileEnd (not . endsAtExit job) (besideFrom job later)
    staysAtExit m = endsAtExit job m && not (isLeaving job m)
    staysAtEntry m =
      endsNear job (entry job) m
        && not (isFullCircle m)
        && isNear job (entry job) (Segment.at 0.5 (segment m))

-- | Test that motions lead out and back on the same path, within the allowed deviation: they
-- enclose an area of less than that deviation times their length.
goThereAndBack :: MillingJob -> [CutterMotion] -> Bool
goThereAndBack job motions = abs (sum (zipWith area points (drop 1 points))) <= deviation * long
  where
    Mm deviation = allowance job
    Mm long = total (map (Segment.length . segment) motions)
    points = entry job : concatMap (\m -> map (`Segment.at` segment m) (Motion.samples m)) motions
    area p q = Vec.cross (Vec.to (entry job) p) (Vec.to (entry job) q) / 2

-- Following the contact point ---------------------------------------------------------------------

-- | Progress of the cutter along a contour: the count of motions so far, the arc length in mm from
-- the start of the contour to the contact point, and the position of the centre.
data Progress = Progress
  { count :: Int,
    travelled :: Double,
    position :: Point
  }

-- | Number of motions, from the beginning of the list, that follow the contour to its end. Nothing
-- if the motions leave the contour, reverse on it, or stop before its end.
countFollowing :: MillingJob -> Measure -> [CutterMotion] -> Maybe Int
countFollowing job measure motions =
  follow job measure (Progress 0 0 (entry job)) motions (MillingJob.edgesNearEach job motions)

-- | Follow the contact point through the motions that remain. @near@ has, for each of them, the
-- elements that the cutter may touch. The result is the count of all motions up to the end of the
-- cut. Nothing if the motions leave the contour, reverse on it, or stop before its end.
follow :: MillingJob -> Measure -> Progress -> [CutterMotion] -> [[Edge]] -> Maybe Int
follow job measure progress motions near
  | hasArrived =
    -- Contacts on elements that are not neighbours may mean that an earlier part of the contour
    -- comes close to its end. The search then goes on. Only if it fails does the cut end here.
    if areNeighbours job ahead then ended else onwards <|> ended
  | otherwise = onwards
  where
    ahead = contactsAhead job measure progress
    furthest = maximum (0 : map fst ahead)
    hasArrived =
      isAtExit job (position progress)
        && travelled progress + furthest >= contourLength measure - slack measure
    ended = Just (count progress + length (takeWhile staysAtExit motions))
    staysAtExit m = endsAtExit job m && not (isFullCircle m) && not (isLeaving job m)
    onwards = case (motions, near) of
      (m : rest, edges' : others)
        | Just travelled' <- afterMotion job measure edges' m (travelled progress) ->
          follow
            job
            measure
            Progress
              { count = count progress + 1,
                travelled = travelled',
                position = Segment.end (segment m)
              }
            rest
            others
      _ -> Nothing

-- | Arc length in mm, from the start of the contour, of the contact point after the motion @m@. The
-- last argument is the arc length of the contact point before @m@. Nothing if the cutter leaves the
-- contour or goes back on it.
afterMotion :: MillingJob -> Measure -> [Edge] -> CutterMotion -> Double -> Maybe Double
afterMotion job measure near m = go . Sample 1
  where
    count = Motion.sampleCount m
    go :: Sample -> Maybe Double
    go (Sample k arcLength)
      | k > count = Just arcLength
      | isInfinite step = Nothing
      | otherwise = go (Sample (k + 1) (arcLength + step))
      where
        step = smallestStep job measure near arcLength (Segment.at (fraction k) (segment m))
    fraction k = fromIntegral k / fromIntegral count

-- | Sample point that is examined next. The first component is its number in the motion, from 1.
-- The second component is the arc length in mm, from the start of the contour, of the contact point
-- at the sample point before it.
data Sample = Sample Int Double

-- | Signed step in mm along the contour, from @arcLength@ to a contact point of a cutter with its
-- centre at @p@; negative for a step back. Steps back by more than the slack are ignored. Of the
-- other steps, the result is the one with the least absolute value; ∞ if there is none. The step is
-- 0 while the cutter stays within reach of its contact point on an element with an allowance of its
-- own ('stays').
smallestStep :: MillingJob -> Measure -> [Edge] -> Double -> Point -> Double
smallestStep job measure near arcLength p
  | any (stays job measure arcLength p) near = 0
  | otherwise = FastContact.foldContacts job near p smaller (1 / 0)
  where
    smaller least _ s =
      let d = stepTo measure arcLength s
       in if d >= negate (slack measure) && abs d < abs least then d else least

-- | Test that the contact point at @arcLength@ lies, within the slack, on the element @e@ with an
-- allowance of its own, and that the distance of the centre @p@ from this point is at most the one
-- that the cutter keeps from the element. The cutter then comes from this distance to the smaller
-- one of the next element. On the way, elements further along the contour may be nearer to it.
stays :: MillingJob -> Measure -> Double -> Point -> Edge -> Bool
stays job measure arcLength p e =
  ownAllowance e > Mm 0
    && abs (along - onElement) <= slack measure
    && Vec.distance p (Segment.at (onElement / long e) (shape e)) <= farthest
  where
    along = arcLength - startsAt e
    onElement = max 0 (min (long e) along)
    farthest = plus (plus (reach job) (ownAllowance e)) (allowance job)

-- | Contact points at the present position. Each is given by the signed step in mm along the
-- contour that leads to it from the contact point so far, and by the number of its element, from 0.
-- Steps back by more than the slack are left out. The list is sorted by the step.
contactsAhead :: MillingJob -> Measure -> Progress -> [(Double, Int)]
contactsAhead job measure progress =
  sortOn
    fst
    [ (d, n)
      | (n, s) <- MillingJob.contacts job (MillingJob.edgesAround job p) p,
        let d = stepTo measure (travelled progress) s,
        d >= negate (slack measure)
    ]
  where
    p = position progress

-- | Test that the elements of the contacts follow one another along the contour without a gap. On a
-- closed contour the first element follows the last one. The contacts are those of 'contactsAhead'.
areNeighbours :: MillingJob -> [(Double, Int)] -> Bool
areNeighbours job contacts
  | MillingJob.isClosed job = length gaps <= 1
  | otherwise = all (<= 1) (zipWith subtract ranks (drop 1 ranks))
  where
    ranks = IntSet.toAscList (IntSet.fromList (map snd contacts))
    gaps = filter (> 1) (zipWith subtract ranks (drop 1 ranks <> map (+ count) (take 1 ranks)))
    count = BoxTree.size (edges job)

-- | Signed step between two arc lengths, in mm. On a closed contour there are two steps, one in
-- each direction; the result is the shorter one.
stepTo :: Measure -> Double -> Double -> Double
stepTo measure from to
  | isClosed measure =
    let turns = floor ((to - from) / contourLength measure + 0.5) :: Int
     in to - from - contourLength measure * fromIntegral turns
  | otherwise = to - from
