-- | Search for one cut along a contour on the tape: the motions that go along the contour from its
-- start to its end, in the direction of travel.
--
-- The search looks for arrivals at the start of the cut. From each of them it follows the contact
-- point of the cutter along the contour. The first arrival from which the contact point comes to
-- the end is the cut.
module Verify.PassSearch
  ( FoundPass (..),
    motionsOf,
    find,
  )
where

import Base.Quantity (Mm (..))
import Control.Applicative ((<|>))
import Data.List (sortOn)
import Data.Maybe (maybeToList)
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Verify.ContactMeasure (Measure (..))
import Verify.ContactMeasure qualified as ContactMeasure
import Verify.Edge (Edge (long, shape))
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob
import Verify.MillingJob.Fast qualified as FastContact
import Verify.Motion (CutterMotion (number, segment))
import Verify.Motion qualified as Motion

-- | Motions of one cut on the tape.
data FoundPass
  = -- | The motion that arrives at the start, if it is known, and the motions along the contour.
    Complete [CutterMotion] [CutterMotion]
  | -- | The start is reached, but the contour is not followed to its end: the arrival, and the
    -- motions up to the next arrival at the end.
    Incomplete [CutterMotion] [CutterMotion]
  | -- | The start is not reached.
    Missing

-- | All motions of a cut: the arrival and those along the contour.
motionsOf :: FoundPass -> [CutterMotion]
motionsOf found = case found of
  Complete arrival along -> arrival <> along
  Incomplete arrival along -> arrival <> along
  Missing -> []

-- | Motion that arrives at the start of the cut, if there is one, and all motions after it.
type Arrival = ([CutterMotion], [CutterMotion])

-- | Find a cut among motions at its height. @at@ is the position of the cutter's centre before the
-- first motion, if it is already at this height. The contact points of a partial cut are not
-- followed, because partial cuts that almost touch seem to be one.
find :: MillingJob -> Maybe Point -> [CutterMotion] -> FoundPass
find job at motions = case (complete, filter (staysBeside job . snd) arrivals <> arrivals) of
  (found : _, _) -> found
  ([], (arrival, rest) : _) -> Incomplete arrival (untilExit job rest)
  ([], []) -> Missing
  where
    measure = ContactMeasure.measureOf job
    arrivals = arrivalsIn job at motions
    complete =
      [ Complete arrival (take count rest)
        | isResolved measure && not (isPartialCut job),
          (arrival, rest) <- arrivals,
          count <- maybeToList (countFollowing job measure rest)
      ]

-- | Arrivals at the start of a cut, in the order of the tape. The arriving motion is unknown if the
-- cutter was at the start already, or came from another height. A line that ends nearer to the
-- start than it begins is the last part of an approach that was divided for braking.
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

-- | Test that the cutter touches the contour in all motions up to the end of the cut. This excludes
-- a point where another contour ends, and from which the cutter leaves.
staysBeside :: MillingJob -> [CutterMotion] -> Bool
staysBeside job rest =
  not (null along) && and (zipWith touches along (MillingJob.edgesNearEach job along))
  where
    along = untilExit job rest
    touches m near = all (\k -> isTouched job near (Segment.at k (segment m))) (sampled m)
    -- A line may cut a corner, so only its end is tested.
    sampled m = case segment m of
      Straight _ _ -> [1]
      Arc {} -> Motion.samples m

-- | Test that the cutter with its centre at a point touches one of the elements.
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

-- | Test that two positions are equal to the allowance.
isNear :: MillingJob -> Point -> Point -> Bool
isNear job p q = Vec.distance p q <= allowance job

-- | Test that a motion ends at a position, to the allowance.
endsNear :: MillingJob -> Point -> CutterMotion -> Bool
endsNear job p = isNear job p . Segment.end . segment

-- | Test that a point is the end of the cut, to its tolerance.
isAtExit :: MillingJob -> Point -> Bool
isAtExit job p = Vec.distance (exit job) p <= exitTolerance job

-- | Test that a motion ends at the end of the cut.
endsAtExit :: MillingJob -> CutterMotion -> Bool
endsAtExit job = isAtExit job . Segment.end . segment

-- | Test that a motion is a full circle.
isFullCircle :: CutterMotion -> Bool
isFullCircle m = case segment m of
  Straight _ _ -> False
  Arc {start, end} -> start == end

-- | First motions whose frames follow one another on the tape without a gap. A gap in the list is a
-- motion at another height.
unbroken :: [CutterMotion] -> [CutterMotion]
unbroken motions = case motions of
  m : rest@(next : _) | number next <= number m + 1 -> m : unbroken rest
  m : _ -> [m]
  [] -> []

-- | Motions up to the next arrival at the end of the cut, and those that stay there.
untilExit :: MillingJob -> [CutterMotion] -> [CutterMotion]
untilExit job motions = leaving <> along <> takeWhile (endsAtExit job) (unbroken back)
  where
    (leaving, away) = span staysAtEntry motions
    (along, back) = break (endsAtExit job) away
    staysAtEntry m =
      endsNear job (entry job) m
        && not (isFullCircle m)
        && isNear job (entry job) (Segment.at 0.5 (segment m))

-- Following the contact point ---------------------------------------------------------------------

-- | Progress of the cutter along a contour: the number of motions, the arc length of the contact
-- point in mm, the position of the centre, the last motion if there is one.
data Progress = Progress
  { count :: Int,
    travelled :: Double,
    position :: Point,
    latest :: [CutterMotion]
  }

-- | Number of the motions that follow the contour to its end. Nothing if they leave the contour,
-- reverse on it, or stop before its end.
countFollowing :: MillingJob -> Measure -> [CutterMotion] -> Maybe Int
countFollowing job measure motions =
  follow job measure (Progress 0 0 (entry job) []) motions (MillingJob.edgesNearEach job motions)

-- | Follow the contact point through more motions. @near@ has the elements within reach of each
-- motion. The result is the number of motions up to the end of the cut, with those before.
follow :: MillingJob -> Measure -> Progress -> [CutterMotion] -> [[Edge]] -> Maybe Int
follow job measure progress motions near
  | hasArrived =
    -- If the cutter does not touch the elements between two contacts, the contour only comes close
    -- to its own end there. Then it is followed on, if that is possible.
    if areNeighbours job ahead then ended else onwards <|> ended
  | otherwise = onwards
  where
    ahead = contactsAhead job measure progress
    furthest = maximum (0 : map fst ahead)
    hasArrived =
      isAtExit job (position progress)
        && travelled progress + furthest >= contourLength measure - slack measure
    ended = Just (count progress + length (takeWhile staysAtExit later))
    later = drop (length (latest progress)) (unbroken (latest progress <> motions))
    staysAtExit m = endsAtExit job m && not (isFullCircle m)
    onwards = case (motions, near) of
      (m : rest, edges' : others)
        | Just travelled' <- afterMotion job measure edges' m (travelled progress) ->
          follow
            job
            measure
            Progress
              { count = count progress + 1,
                travelled = travelled',
                position = Segment.end (segment m),
                latest = [m]
              }
            rest
            others
      _ -> Nothing

-- | Arc length of the contact point after a motion; nothing if the cutter leaves the contour or
-- goes back on it.
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

-- | Sample of a motion, counted from 1, and the arc length of the contact point before it, in mm.
data Sample = Sample Int Double

-- | Smallest step along the contour to one of the contact points; ∞ if there is none.
smallestStep :: MillingJob -> Measure -> [Edge] -> Double -> Point -> Double
smallestStep job measure near arcLength p = FastContact.foldContacts job near p smaller (1 / 0)
  where
    smaller least _ s =
      let d = stepTo measure arcLength s
       in if d >= negate (slack measure) && abs d < abs least then d else least

-- | Contact points at the present position that are no further back than the slack allows, nearest
-- first. Each has its step along the contour, from the arc length so far, and the number of its
-- element.
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

-- | Test that each two successive contacts are on the same element or on neighbours.
areNeighbours :: MillingJob -> [(Double, Int)] -> Bool
areNeighbours job found =
  and
    ( zipWith
        (\(_, m) (_, n) -> abs (n - m) <= 1 || abs (n - m) == BoxTree.size (edges job) - 1)
        found
        (drop 1 found)
    )

-- | Signed step from one arc length to another, in mm. On a closed contour, the shorter of the two
-- ways round counts.
stepTo :: Measure -> Double -> Double -> Double
stepTo measure from to
  | isClosed measure =
    let turns = floor ((to - from) / contourLength measure + 0.5) :: Int
     in to - from - contourLength measure * fromIntegral turns
  | otherwise = to - from
