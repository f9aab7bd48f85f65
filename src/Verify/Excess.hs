-- | Excess material. There are two kinds: points of an element that are too far from all motions on
-- the cutter's side, and motions along the contour that are too far from it.
--
-- A /job/ is a cut along a contour as the part demands it. The /reach/ of a job is the required
-- distance of the cutter's centre from the contour; its /allowance/ is the allowed deviation. The
-- cutter's side is the side of the contour on which the part requires the cutter to be. The
-- /bounding paths/ of a motion enclose its real path: one path, or two for an arc whose radii at
-- start and end differ (see "Control.Motion").
module Verify.Excess
  ( excesses,
    strayOf,
    isSurelyOnSide,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Data.Ord (comparing)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.Part qualified as Part
import Verify.Coverage (Gap (..))
import Verify.Coverage qualified as Coverage
import Verify.Edge (Edge (element, rank, shape))
import Verify.MillingJob (MillingJob (..))
import Verify.Motion (CutterMotion (number), pathList, paths)
import Verify.Proof (Witness (Witness))
import Verify.Proof qualified as Proof

-- | Excess on elements: by how much the element's points are further than the reach from every
-- motion in @index@. Each excess above the allowance is listed. An excess within the allowance is
-- listed only if it is larger than all earlier ones within the allowance. @bounds@ has for each
-- element, by its number from 0, an upper bound in mm of the distance of its points from the
-- motions.
excesses :: MillingJob -> PrimArray Double -> BoxTree CutterMotion -> [Edge] -> [Witness]
excesses job bounds index = go (Mm 0)
  where
    go least es = case es of
      [] -> []
      e : rest
        | isSurelyCovered job bounds index least e -> go least rest
        | otherwise -> case gapIn e least of
          Nothing -> go least rest
          Just gap ->
            let next = if size gap > allowance job then least else size gap
             in witness e gap : go next rest
    witness e Gap {size, location, members} =
      Witness
        { Proof.amount = size,
          Proof.frame =
            number (minimumBy (comparing (Coverage.distanceTo location . paths)) members),
          Proof.element = Part.origin (element e),
          Proof.location
        }
    gapIn e least =
      Coverage.largestGap
        (coverOf e)
        (Just (distanceBounds job index e))
        least
        (segmentOf e)
    segmentOf = Part.segment . element
    coverOf e =
      Coverage.Cover
        { Coverage.index,
          Coverage.pathsOf = paths,
          Coverage.isEligible = all (isOnSide job (segmentOf e)) . paths,
          Coverage.reach = reach job,
          Coverage.allowance = allowance job
        }

-- | True only if each point of an element has a motion within the reach plus @least@; fast bounds
-- decide this. False means that the exact comparison has to decide.
isSurelyCovered :: MillingJob -> PrimArray Double -> BoxTree CutterMotion -> Mm -> Edge -> Bool
isSurelyCovered job bounds index least e =
  PrimArray.indexPrimArray bounds (rank e) <= d - 2 * FastDistance.unsure
    || FastDistance.isCovered d snd (isEligible job e) (map withPaths near) (shape e)
  where
    far@(Mm d) = plus (reach job) least
    near = BoxTree.within (BoundingBox.inflate far (FastDistance.box (shape e))) index

-- | Bounds of the directed Hausdorff distance from an element to the motions on the cutter's side.
-- This is the largest distance of a point of the element from the motion nearest to that point. The
-- bounds are computed from the motions near the element: within about the reach plus the allowance.
distanceBounds :: MillingJob -> BoxTree CutterMotion -> Edge -> Coverage.DistanceBounds
distanceBounds job index e =
  Coverage.DistanceBounds {Coverage.atLeast = Mm (min d low), Coverage.atMost = Mm high}
  where
    far@(Mm d) = plus (reach job) (allowance job)
    around = BoundingBox.inflate far (BoundingBox.ofSegment (Part.segment (element e)))
    near = filter (isEligible job e) (map withPaths (BoxTree.within around index))
    (low, high) = FastDistance.range (map snd near) (shape e)

-- | Motion with its bounding paths.
withPaths :: CutterMotion -> (CutterMotion, [Segment])
withPaths m = (m, pathList m)

-- | Test that a motion, given with its bounding paths, is on the cutter's side of an element.
isEligible :: MillingJob -> Edge -> (CutterMotion, [Segment]) -> Bool
isEligible job e (m, bounding) =
  all (isSurelyOnSide job (shape e)) bounding
    || all (isOnSide job (Part.segment (element e))) (paths m)

-- | True only if a path lies wholly on the cutter's side of an element; fast bounds decide this.
-- False means that 'isOnSide' has to decide.
isSurelyOnSide :: MillingJob -> Segment -> Segment -> Bool
isSurelyOnSide job e path = case side job of
  Nothing -> True
  Just Carrier.LeftOf -> FastDistance.isLeftOf path e
  Just Carrier.RightOf -> FastDistance.isRightOf path e

-- | Test that a path is on the cutter's side of an element at the point where it is nearest to the
-- element. From the other side, the cutter would reach the element through the part. A path
-- whose distance from the element is at most the allowance of the job counts as well.
isOnSide :: MillingJob -> Segment -> Segment -> Bool
isOnSide job element path = case side job of
  Nothing -> True
  Just demanded -> isLeft == (demanded == Carrier.LeftOf) || d <= allowance job
  where
    Distance.ClosestPoint d p = Distance.segments path element
    isLeft = case element of
      Straight a b -> Vec.cross (Vec.to a b) (Vec.to a p) > 0
      Arc {start, centre, sweep = Rad s} ->
        (Vec.distance centre p < Segment.radius centre start) == (s > 0)

-- | Excess of a motion along the contour: by how much the motion is further from the contour than
-- the reach. Nothing if the excess is within the allowance. @near@ are the elements that the cutter
-- may touch during the motion; @bounding@ are the motion's bounding paths.
strayOf :: MillingJob -> CutterMotion -> [Edge] -> [Segment] -> Maybe Witness
strayOf job m near bounding
  | all isSurelyNear bounding = Nothing
  | otherwise = Proof.deepest (mapMaybe beyond (NonEmpty.toList (paths m)))
  where
    Mm d = plus (reach job) (allowance job)
    isSurelyNear path =
      any (FastDistance.isWithin (d - 2 * FastDistance.unsure) path . shape) near
        || FastDistance.isAccompanied d (map shape near) path
        || FastDistance.isCovered d (pure . shape) (const True) near path
    beyond path = witness <$> Coverage.largestGap cover Nothing (allowance job) path
    witness Gap {size, location, members} =
      Witness
        { Proof.amount = size,
          Proof.frame = number m,
          Proof.element =
            Part.origin
              (element (minimumBy (comparing (Distance.toPoint location . segmentOf)) members)),
          Proof.location
        }
    segmentOf = Part.segment . element
    cover =
      Coverage.Cover
        { Coverage.index = edges job,
          Coverage.pathsOf = (:| []) . segmentOf,
          Coverage.isEligible = const True,
          Coverage.reach = reach job,
          Coverage.allowance = allowance job
        }
