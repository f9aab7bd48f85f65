-- | Comparison of a tape with one pass of a pocket, by distances alone. It shows that no motion
-- cuts into the walls, and that no material remains that the cutter can reach.
--
-- Let A be the set of all positions of the cutter's centre in the pocket whose distance from the
-- walls is at least the cutter's radius plus the allowance that a pass leaves. The cutter reaches a
-- point if A has a position within the radius of that point. Two facts are shown about this pass
-- and the passes before it at its depth, together:
--
-- * Rim: each point of the border of A is within the allowed excess of a motion. So the walls are
--   cut wherever the cutter can touch them. A point outside of A that the cutter reaches, for
--   example near a corner, is at most the cutter's radius away from a point of this border. So it
--   is cleared as well.
-- * Floor: each point of A is within the radius, plus the allowed excess, of a motion; see
--   "Verify.PocketFloor".
module Verify.PocketDeviation
  ( PassMotions (..),
    examine,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Data.List (foldl', minimumBy, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing, mapMaybe, maybeToList)
import Data.Ord (comparing)
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine qualified as Machine
import Offset.Tolerance qualified as Tolerance
import Part.Part (Element)
import Part.Part qualified as Part
import Verify.Coverage (Cover (Cover), Gap (..))
import Verify.Coverage qualified as Coverage
import Verify.Deviation qualified as Deviation
import Verify.Gouge (KeepOut (searchRadius))
import Verify.Gouge qualified as Gouge
import Verify.Gouge.Fast qualified as FastGouge
import Verify.Motion (CutterMotion (number, segment))
import Verify.Motion qualified as Motion
import Verify.MotionSet (MotionSet)
import Verify.MotionSet qualified as MotionSet
import Verify.Pocket (ClearingPass (..), Pocket (..))
import Verify.Pocket qualified as Pocket
import Verify.PocketFloor qualified as PocketFloor
import Verify.PocketSense qualified as PocketSense
import Verify.Proof
  ( ContourProof (ContourProof),
    Finding (NotCleared),
    Witness (Witness),
  )
import Verify.Proof qualified as Proof
import Verify.RimWork qualified as RimWork

-- | Motions in the passes of pockets.
data PassMotions = PassMotions
  { -- | false if it is unknown which motions are in the passes; both tests are then a guess
    isKnown :: Bool,
    -- | test that a motion is in a pass
    clears :: ClearingPass -> CutterMotion -> Bool,
    -- | test that a motion is in a pass, or is one of the moves before and after it
    isIn :: ClearingPass -> CutterMotion -> Bool
  }

-- | Compare the tape with one pass of a pocket. If @isFirst@ is true, it is the first pass of the
-- pocket, and all motions near the pocket are examined for gouges. Otherwise only the motions of
-- the pass are.
examine :: MotionSet -> PassMotions -> Pocket -> Bool -> ClearingPass -> (ContourProof, [Finding])
examine set motions pocket isFirst pass
  | isSurface pocket = examineSurface set motions pocket pass
  | otherwise = examineWalls set motions pocket isFirst pass

-- | Compare the tape with one pass over a region that is faced: every point of the region has to be
-- within the cutter's radius of a motion of the pass. The contours of other statements are compared
-- with these motions there.
examineSurface :: MotionSet -> PassMotions -> Pocket -> ClearingPass -> (ContourProof, [Finding])
examineSurface set PassMotions {isKnown, isIn} pocket pass = (contourProof, findings)
  where
    (allowedGouge, allowedExcess) = allowedIn set pocket
    clearing = clearingMotions set (\p m -> not isKnown || isIn p m) pocket pass
    findings = floorFindings pocket pass (max allowedGouge allowedExcess) clearing
    contourProof =
      ContourProof
        { Proof.contour = Part.contourName (Part.contour (milling pocket)),
          Proof.gouge = Nothing,
          Proof.excess = Nothing,
          Proof.allowedGouge,
          Proof.allowedExcess
        }

-- | Compare the tape with one pass of a pocket whose walls stay. @isFirst@ is as in 'examine'.
examineWalls ::
  MotionSet -> PassMotions -> Pocket -> Bool -> ClearingPass -> (ContourProof, [Finding])
examineWalls set PassMotions {isKnown, clears, isIn} pocket isFirst pass = (contourProof, findings)
  where
    isInPass = isIn pass
    isClearing = clears pass
    (allowedGouge, allowedExcess) = allowedIn set pocket
    -- Gouges
    examined =
      filter
        (\m -> MotionSet.isBelowTop set m && (isFirst || isInPass m))
        (MotionSet.nearby set (BoundingBox.inflate (reach pass) (bounds pocket)))
    -- Linking moves only have to keep the distance of the final pass from the walls. On a tape with
    -- other frames than planned, they may also belong to the next statement.
    keepOut m
      | isClearing m = Gouge.constantKeepOut (reach pass)
      | MotionSet.isPlanned set && isInPass m =
        Gouge.constantKeepOut (minus (rimDistance pocket) Pocket.spareRoom)
      | otherwise =
        RimWork.keepOut (MotionSet.rimWorksOf set m) (Just (side pocket)) (MotionSet.toolOf set m)
    gouges = mapMaybe (\m -> Gouge.gougeOf (keepOut m) (walls pocket) m) examined
    deepest = deepestGouge keepOut pocket examined
    -- Excess
    clearing = clearingMotions set (\p m -> not isKnown || isIn p m) pocket pass
    withRim = Pocket.withRimOf pass pocket
    missed = unreached withRim allowedGouge allowedExcess (BoxTree.index Motion.box clearing)
    largest = Proof.deepest missed
    tooMuch = sortOn Proof.frame (filter ((> allowedExcess) . Proof.amount) missed)
    -- Result
    contourProof =
      ContourProof
        { Proof.contour = Part.contourName (Part.contour (milling pocket)),
          Proof.gouge = deepest,
          Proof.excess = largest,
          Proof.allowedGouge,
          Proof.allowedExcess
        }
    findings =
      Deviation.gougeFindings allowedGouge gouges deepest
        <> Deviation.excessFindings allowedExcess tooMuch largest
        <> (if null tooMuch then floorFindings withRim pass floorExcess clearing else [])
        <> PocketSense.againstSense
          (plus allowedGouge allowedExcess)
          withRim
          (filter isClearing examined)
    floorExcess = max allowedGouge allowedExcess

-- | Finding for a position on the floor that a pass leaves uncleared; empty if there is none. The
-- pocket has the rim of the pass. The floor is compared to the distance @allowed@, the larger one
-- of allowed gouge and allowed excess: motions that deviate into the wall deviate from the floor.
-- @clearing@ are the motions that clear it.
floorFindings :: Pocket -> ClearingPass -> Mm -> [CutterMotion] -> [Finding]
floorFindings pocket pass allowed clearing =
  [ NotCleared (statement pocket) (level pass) p
    | p <-
        maybeToList
          ( PocketFloor.unclearedPoint
              pocket
              (plus (Part.radius (milling pocket)) allowed)
              clearing
          )
  ]

-- | Allowed gouge and allowed excess of a pocket. The allowed gouge is the allowed chord error into
-- the part plus one pulse. The allowed excess is the allowed chord error away from the part plus
-- one pulse. It also includes 'Pocket.spareRoom', the extra distance of the rim from the walls.
allowedIn :: MotionSet -> Pocket -> (Mm, Mm)
allowedIn set pocket = (plus inside pulse, plus (plus outside pulse) Pocket.spareRoom)
  where
    pulse = Machine.planeResolution (MotionSet.machine set)
    (inside, outside) = Deviation.allowedDeviation isCurved (milling pocket)
    isCurved = any Part.continues (Part.elements (Part.contour (milling pocket)))

-- | Motions that have cleared the floor after a pass: the motions of this pass and of the passes
-- before it at its height, with a cutter at least as large as that of the pocket. @isIn@ tells
-- whether a motion is in a pass. If one of them starts in the bounding box of the pocket,
-- the motions whose distance from the box exceeds the box's diagonal are left out. The motion in
-- the box is nearer than they are to each point of the box.
clearingMotions ::
  MotionSet ->
  (ClearingPass -> CutterMotion -> Bool) ->
  Pocket ->
  ClearingPass ->
  [CutterMotion]
clearingMotions set isIn pocket pass
  | any (startsInBounds . segment) around = around
  | otherwise = filter isClearing (MotionSet.motions set)
  where
    around =
      filter
        isClearing
        (MotionSet.nearby set (BoundingBox.inflate (diagonal (bounds pocket)) (bounds pocket)))
    isClearing m =
      (MotionSet.isFlat set || MotionSet.isAtHeight (MotionSet.machine set) (level pass) m)
        && any (`isIn` m) passesUpToThis
        && MotionSet.toolOf set m >= Part.radius (milling pocket)
    passesUpToThis =
      [ p
        | p <- NonEmpty.toList (passes pocket),
          passIndex p <= passIndex pass,
          level p == level pass
      ]
    startsInBounds s =
      BoundingBox.meets (BoundingBox.ofPoints (Segment.start s) []) (bounds pocket)
    diagonal (BoundingBox left bottom right top) =
      Mm (Vec.norm (Vec.vec (right - left) (top - bottom)))

-- | Deepest gouge of some motions into the walls of a pocket; Nothing if there is none. @keepOut@
-- gives the distance that a motion has to keep from the walls.
deepestGouge :: (CutterMotion -> KeepOut) -> Pocket -> [CutterMotion] -> Maybe Witness
deepestGouge keepOut pocket = foldl' orDeeper Nothing
  where
    orDeeper best m
      | FastGouge.mayGougeDeeper (keepOut m) best m (Motion.pathList m) (near m) =
        maybe best (Just . Proof.deeper best) (Gouge.gougeOf (keepOut m) (walls pocket) m)
      | otherwise = best
    near m =
      BoxTree.within
        (BoundingBox.inflate (searchRadius (keepOut m)) (Motion.box m))
        (walls pocket)

-- | Curve that has to be cut: each of its points needs a motion within a distance. @reached@ is
-- this distance without the allowed excess.
data Demand = Demand {wall :: Element, reached :: Mm, curve :: Segment}

-- | Excess on the walls of a pocket, as far as the cutter can touch them: the largest distance of
-- the wall's points from the motions, minus the distance of the pocket's rim. A motion that
-- deviates into the wall leaves nothing there, so a point of the rim within the allowed gouge of a
-- motion only counts if the wall beside it is too far. Each excess above @allowance@, the allowed
-- excess, is listed. An excess within the allowance is listed only if it exceeds all earlier ones
-- within the allowance by the resolution of the search.
unreached :: Pocket -> Mm -> Mm -> BoxTree CutterMotion -> [Witness]
unreached pocket allowedGouge allowance motions =
  go (Mm 0) (concatMap (uncurry (demandsOf pocket allowedGouge allowance)) (rim pocket))
  where
    go least demands = case demands of
      [] -> []
      demand : rest
        | all (isNothing . gapIn demand known) (doubtful known demand) -> go least rest
        | otherwise -> case gapIn demand least (curve demand) of
          Nothing -> go least rest
          Just gap ->
            witness (wall demand) gap :
            go (if size gap > allowance then least else size gap) rest
        where
          known = max least (min allowance (plus least Tolerance.resolution))
    gapIn demand = Coverage.largestGap (coverOf demand) Nothing
    witness e Gap {size, location, members} =
      Witness
        { Proof.amount = size,
          Proof.frame =
            number (minimumBy (comparing (Coverage.distanceTo location . Motion.paths)) members),
          Proof.element = Part.origin e,
          Proof.location
        }
    -- The parts of a curve that may have a larger gap than @least@.
    doubtful least Demand {reached, curve} =
      let far@(Mm d) = plus reached least
       in FastDistance.doubtful
            d
            Motion.pathList
            (const True)
            (BoxTree.within (BoundingBox.inflate far (BoundingBox.ofSegment curve)) motions)
            curve
    coverOf Demand {reached} =
      Cover
        { Coverage.index = motions,
          Coverage.pathsOf = Motion.paths,
          Coverage.isEligible = const True,
          Coverage.reach = reached,
          Coverage.allowance = allowance
        }

-- | Demands of the segment @s@ of the rim of a pocket, beside the wall @e@. The rim itself is
-- compared if the tolerance into the wall is not the larger one.
demandsOf :: Pocket -> Mm -> Mm -> Element -> Segment -> [Demand]
demandsOf pocket allowedGouge allowance e s
  | allowedGouge <= allowance = [Demand e (Mm 0) s]
  | otherwise = case besideRim (rimDistance pocket) (Part.segment e) s of
    [] -> [Demand e (minus allowedGouge allowance) s]
    parts -> map (Demand e (rimDistance pocket)) parts

-- | Parts of a wall beside a segment of the rim that runs parallel to it at a distance, or round
-- one of its ends. There are two if the segment passes the point at which a circle begins. None if
-- the segment does not run parallel, as beside an arc too narrow for the cutter.
besideRim :: Mm -> Segment -> Segment -> [Segment]
besideRim distance wall s
  | any (isFar . (`Segment.at` s)) [0, 0.5, 1] || not isInStep = []
  | otherwise = case [Segment.between a b wall | (a, b) <- intervals, a < b] of
    [] -> [let p = Segment.at low wall in Straight p p]
    parts -> parts
  where
    isFar p =
      let Mm away = minus (Distance.toPoint p wall) distance in Mm (abs away) > Tolerance.clearance
    share k = Distance.nearestFraction (Segment.at k s) wall
    (low, high) = (min (share 0) (share 1), max (share 0) (share 1))
    middle = (low + high) / 2
    isAcross = share 0.5 < low || share 0.5 > high
    -- The foot of the middle lies in the middle between the feet of the ends.
    isInStep =
      let off = abs (share 0.5 - middle) - (if isAcross then 0.5 else 0)
       in times (abs off) (Segment.length wall) <= Tolerance.ignoredSlot
    intervals
      | isAcross = [(0, low), (high, 1)]
      | otherwise = [(low, high)]
