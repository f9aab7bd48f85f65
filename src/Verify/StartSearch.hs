-- | Search for the start of a closed contour on a tape that does not begin the contour where the
-- compiler would. A pass along a closed contour is a /loop/: it ends where it begins.
module Verify.StartSearch
  ( OtherStart (..),
    find,
    differenceFrom,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.Containers.ListUtils (nubOrdOn)
import Data.Function (on)
import Data.List (minimumBy, sortOn)
import Data.List qualified as List
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Verify.Deviation (MillingPass (..))
import Verify.Edge (Edge (ownAllowance, shape))
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob
import Verify.Motion (CutterMotion)
import Verify.Motion qualified as Motion
import Verify.PassSearch qualified as PassSearch

-- | Start of a contour on a tape.
data OtherStart = OtherStart
  { -- | number of the milling statement in the order of execution, from 0
    statementNumber :: Int,
    -- | position of the cutter's centre at the start of the pass nearest to the contour
    position :: Point,
    -- | points of the contour; it may begin at the point nearest to one of them
    near :: [Point]
  }

-- | Start on the tape of the first statement whose contour does not begin at the planned start;
-- Nothing if there is no such statement. @isAtLevel@ tells whether a motion is at the height of a
-- pass. @passes@ are the planned passes along contours as they were found among @motions@.
find ::
  (MillingPass -> CutterMotion -> Bool) -> [CutterMotion] -> [MillingPass] -> Maybe OtherStart
find isAtLevel motions passes =
  listToMaybe (mapMaybe otherwiseBegun (NonEmpty.groupBy ((==) `on` passNumber) passes))
  where
    otherwiseBegun statement
      | MillingJob.isClosed (job pass),
        Just p <- start,
        not (isEntry p pass) =
        Just (OtherStart n p (startsAround (job pass) p))
      | otherwise = Nothing
      where
        n = passNumber (NonEmpty.head statement)
        pass = nearestPass statement
        start = listToMaybe (mapMaybe (startOfLoop (job pass)) (runsBeside (job pass) atLevel))
        atLevel =
          [ (isAtLevel pass m, m)
            | m <- dropWhile ((<= final) . Motion.number) motions,
              not (Motion.isVertical m)
          ]
        final = maximum (0 : map Motion.number (concatMap (PassSearch.motionsOf . found) before))
        before = takeWhile ((/= n) . passNumber) passes

-- | Distance in mm of the planned start from the start on the tape; Nothing if it is more than the
-- allowed deviation.
differenceFrom :: OtherStart -> [MillingPass] -> Maybe Mm
differenceFrom start passes = do
  own <- NonEmpty.nonEmpty (filter ((== statementNumber start) . passNumber) passes)
  let pass = nearestPass own
  if isEntry (position start) pass
    then Just (Vec.distance (position start) (entry (job pass)))
    else Nothing

-- | Pass of a statement that is nearest to the contour. At an inner corner, the start of a pass
-- depends on its allowance, so the other passes show the start less exactly.
nearestPass :: NonEmpty MillingPass -> MillingPass
nearestPass = minimumBy (comparing (reach . job))

-- | Test that a pass begins at a position, within the allowed deviation.
isEntry :: Point -> MillingPass -> Bool
isEntry p pass = Vec.distance p (entry (job pass)) <= allowance (job pass)

-- | Runs of motions that end where the cutter may touch the contour, at the height of a pass. Each
-- motion comes with True if it is at that height.
runsBeside :: MillingJob -> [(Bool, CutterMotion)] -> [NonEmpty CutterMotion]
runsBeside job motions =
  [fmap snd run | run <- NonEmpty.groupBy ((==) `on` fst) flagged, fst (NonEmpty.head run)]
  where
    flagged = [(isAtLevel && isBeside (endOf m), m) | (isAtLevel, m) <- motions]
    endOf = Segment.end . Motion.segment
    isBeside p = any ((<= MillingJob.contactLimit job) . fst) (nearestEdge job p)

-- | First position to which a run of motions comes back, and in which the cutter keeps the distance
-- of the pass.
startOfLoop :: MillingJob -> NonEmpty CutterMotion -> Maybe Point
startOfLoop job run = List.find (\p -> counts Map.! key p > (1 :: Int) && isAtReach p) ends
  where
    ends = Segment.start (Motion.segment (NonEmpty.head run)) : map endOf (NonEmpty.toList run)
    endOf = Segment.end . Motion.segment
    counts = Map.fromListWith (+) [(key p, 1) | p <- ends]
    key p = (Vec.x p, Vec.y p)
    isAtReach p = any (isTouched p) (MillingJob.edgesAround job p)
    isTouched p e =
      d >= minus wanted (allowance job) && d <= plus wanted (allowance job)
      where
        d = Distance.toPoint p (shape e)
        wanted = plus (reach job) (ownAllowance e)

-- | Points near which a contour may begin if the cutter's centre is at @p@: the ends of the
-- elements that the cutter touches there, those of the elements before and after them, and @p@
-- itself, the nearest end first. Rounding may hide which of them it is, and the cutter does not
-- reach the end of an element at an inner corner or in a part of the contour that it leaves out.
startsAround :: MillingJob -> Point -> [Point]
startsAround job p = sortOn (Vec.distance p) (nubOrdOn coordinates (concatMap ends beside)) <> [p]
  where
    coordinates q = (Vec.x q, Vec.y q)
    ends e = [Segment.start (shape e), Segment.end (shape e)]
    beside =
      [ e
        | q <- concatMap ends touched,
          e <- BoxTree.within (BoundingBox.ofPoints q []) (edges job),
          any (Vec.isNear q) (ends e)
      ]
    touched = filter isTouched around
    isTouched e = any (\(own, least) -> excess own e <= plus least (allowance job)) bounds
    bounds =
      [ (own, minimum (map (excess own) around))
        | not (null around),
          own <- [const (Mm 0), ownAllowance]
      ]
    excess own e = minus (Distance.toPoint p (shape e)) (own e)
    around = MillingJob.edgesAround job p

-- | Element nearest to a point, with its distance.
nearestEdge :: MillingJob -> Point -> Maybe (Mm, Edge)
nearestEdge job p = BoxTree.closest (Distance.toPoint p . shape) p (edges job)
