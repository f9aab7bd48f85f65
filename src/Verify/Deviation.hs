-- | Comparison of a tape with one pass along a contour: gouge, excess and side, and the order of
-- travel. The toolpath only says which pass is meant.
module Verify.Deviation
  ( MillingPass (..),
    examine,
    gougeFindings,
    excessFindings,
    motionsAlong,
    allowedDeviation,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Data.Containers.ListUtils (nubOrd)
import Data.IntSet qualified as IntSet
import Data.List (sortOn)
import Data.Maybe (fromMaybe, isNothing, mapMaybe, maybeToList)
import Data.Primitive.PrimArray (PrimArray)
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Tolerance qualified as Tolerance
import Machine.Machine qualified as Machine
import Part.Part (Milling)
import Part.Part qualified as Part
import Verify.ContactMeasure qualified as ContactMeasure
import Verify.ContourScan (Scan (..))
import Verify.ContourScan qualified as ContourScan
import Verify.Edge (Edge (element, ownAllowance, shape))
import Verify.Edge qualified as Edge
import Verify.Excess qualified as Excess
import Verify.Gouge (KeepOut (..))
import Verify.Gouge qualified as Gouge
import Verify.MillingJob (MillingJob (..))
import Verify.Motion (CutterMotion (number))
import Verify.Motion qualified as Motion
import Verify.MotionSet (MotionSet)
import Verify.MotionSet qualified as MotionSet
import Verify.PassSearch (FoundPass (..))
import Verify.PassSearch qualified as PassSearch
import Verify.PointedTool qualified as PointedTool
import Verify.Proof (ContourProof (ContourProof), Finding (Excess, Gouge, NotFollowed), Witness)
import Verify.Proof qualified as Proof
import Verify.Reachability (KeptDistance (KeptDistance))
import Verify.Reachability qualified as Reachability

-- | Cut along a contour, and its motions on the tape.
data MillingPass = MillingPass
  { job :: MillingJob,
    -- | number of the milling statement as it is carried out, from 0
    passNumber :: Int,
    -- | height of the cut
    level :: Mm,
    found :: FoundPass
  }

-- | Allowed deviations into the material and out of it, with one pulse.
data Allowed = Allowed {allowedGouge :: Mm, allowedExcess :: Mm}

-- | Compare the tape with a contour. @isFirst@ is true of the first pass along the contour: then
-- all motions near it are examined for gouges, otherwise only those of the pass.
examine :: MotionSet -> Bool -> MillingPass -> (ContourProof, [Finding])
examine set isFirst pass = (contourProof, if null findings then orderFindings pass else findings)
  where
    MillingPass {job, found} = pass
    Allowed {allowedGouge, allowedExcess} = allowedOf set job
    along = motionsAlong found
    keepingOut = motionsKeepingOut set isFirst job along
    keepOut = keepOutOf set job along
    (scan, bounds) = ContourScan.scan job keepOut allowedExcess keepingOut along
    -- Gouges
    pierced = piercedBy job allowedGouge keepingOut
    gouges = mapMaybe (\m -> Gouge.gougeOf (keepOut m) (edges job) m) keepingOut <> pierced
    deepest = foldl (\best w -> Just (Proof.deeper best w)) (gouge scan) pierced
    -- Excess
    strayed = reverse (strays scan)
    missed = missedOn set isFirst pass allowedExcess bounds
    largest = Proof.deepest (missed <> strayed)
    isTooMuch w = Proof.amount w > allowedExcess
    tooMuch
      -- The tip of a pointed tool is at distance 0 where it crosses the contour. That distance does
      -- not show how much material remains, so no excess is reported then.
      | any ((> allowedGouge) . Proof.amount) pierced = []
      | otherwise = filter isTooMuch strayed <> sortOn Proof.frame (filter isTooMuch missed)
    -- Result
    contourProof =
      ContourProof
        { Proof.contour = Part.contourName (Part.contour (milling job)),
          Proof.gouge = deepest,
          Proof.excess = largest,
          Proof.allowedGouge,
          Proof.allowedExcess
        }
    findings =
      gougeFindings allowedGouge gouges deepest
        <> excessFindings allowedExcess tooMuch largest
        <> maybeToList (wrongSide scan)

-- | Finding for gouges deeper than allowed, if there are any. It has the first of them in the list,
-- and the deepest one.
gougeFindings :: Mm -> [Witness] -> Maybe Witness -> [Finding]
gougeFindings allowed gouges deepest =
  [ Gouge first worst allowed
    | Just worst <- [deepest],
      Proof.amount worst > allowed,
      first : _ <- [filter ((> allowed) . Proof.amount) gouges]
  ]

-- | Finding for an excess larger than allowed, if there is one. The list has all that are too
-- large; the finding has the first of them, and the largest one.
excessFindings :: Mm -> [Witness] -> Maybe Witness -> [Finding]
excessFindings allowed tooMuch largest =
  [Excess first (fromMaybe first largest) allowed | first : _ <- [tooMuch]]

-- | Motions along the contour, without the arrival at its start.
motionsAlong :: FoundPass -> [CutterMotion]
motionsAlong found = case found of
  Complete _ along -> along
  Incomplete _ along -> along
  Missing -> []

-- | Allowed deviations of a job. Without a side, for a cutter that runs on the contour, the larger
-- of the two allowed chord errors counts in both directions.
allowedOf :: MotionSet -> MillingJob -> Allowed
allowedOf set job
  | isNothing (side job) = Allowed (plus larger pulse) (plus larger pulse)
  | otherwise = Allowed (plus inside pulse) (plus outside pulse)
  where
    (inside, outside) = allowedDeviation (Edge.isCurved (edges job)) (milling job)
    larger = max inside outside
    pulse = Machine.planeResolution (MotionSet.machine set)

-- | Allowed chord errors of a tape in mm, into the material and out of it. The arcs that replace a
-- curve may deviate from it by 'Tolerance.curve'; on a curve, the allowed errors are smaller by
-- that.
allowedDeviation :: Bool -> Milling -> (Mm, Mm)
allowedDeviation isCurved milling
  | isCurved = (less inside, less outside)
  | otherwise = (inside, outside)
  where
    (inside, outside) = Part.deviationLimits (Part.tolerance milling)
    less d = max (Mm 0) (minus d Tolerance.curve)

-- | Finding for a contour that is not followed from its start to its end.
orderFindings :: MillingPass -> [Finding]
orderFindings MillingPass {job, found} = case found of
  Complete {} -> []
  -- A cut around rest material does not go along the whole contour.
  Incomplete {} ->
    [ NotFollowed (statement job)
      | ContactMeasure.isMeasurable job,
        not (allowsRest job)
    ]
  Missing -> [Proof.NeverBegun (statement job)]

-- | Test that the statement allows rest material.
allowsRest :: MillingJob -> Bool
allowsRest job = Part.rest (milling job) == Part.Allowed

-- Gouge -------------------------------------------------------------------------------------------

-- | Motions that are examined for gouges: none if the cutter runs on the contour.
motionsKeepingOut :: MotionSet -> Bool -> MillingJob -> [CutterMotion] -> [CutterMotion]
motionsKeepingOut set isFirst job along
  | isNothing (side job) = []
  | isFirst = filter MotionSet.isBelowTop (MotionSet.nearby set box)
  | otherwise = filter MotionSet.isBelowTop along
  where
    box = BoundingBox.inflate (maxReach job) (boxOf (milling job))

-- | Bounding box of the contour of a milling.
boxOf :: Milling -> BoundingBox
boxOf milling =
  foldr1
    BoundingBox.union
    (fmap (BoundingBox.ofSegment . Part.segment) (Part.elements (Part.contour milling)))

-- | Distance that a motion keeps from the elements. A motion along the contour keeps the distance
-- of the pass, with the allowances of the elements. Any other motion keeps the radius of its
-- cutter.
keepOutOf :: MotionSet -> MillingJob -> [CutterMotion] -> CutterMotion -> KeepOut
keepOutOf set job along = \m ->
  let tool = MotionSet.toolOf set m
      searchRadius = max (maxReach job) tool
   in if IntSet.member (number m) ownFrames
        then
          KeepOut
            { searchRadius,
              largest = plus (reach job) largestAllowance,
              required = \e p -> plus (reach job) (Gouge.allowanceAt pulse (edges job) e p)
            }
        else (Gouge.constantKeepOut tool) {searchRadius}
  where
    pulse = Machine.planeResolution (MotionSet.machine set)
    ownFrames = IntSet.fromDistinctAscList (ascending (map number along))
    largestAllowance = max (Mm 0) (Edge.largestAllowance (edges job))

-- | Sorted list of numbers without its repetitions.
ascending :: [Int] -> [Int]
ascending ns = case ns of
  a : b : more | a == b -> ascending (b : more)
  a : more -> a : ascending more
  [] -> []

-- | Gouges of a tool without radius, by an examination of their own: the distance of such a tool
-- from the contour shows none. Empty for a tool with a radius.
piercedBy :: MillingJob -> Mm -> [CutterMotion] -> [Witness]
piercedBy job allowed motions =
  [ w
    | Part.radius (milling job) <= Mm 0,
      Just demanded <- [side job],
      m <- motions,
      Just w <-
        [PointedTool.gougeOf demanded (Part.contour (milling job)) (edges job) allowed m]
  ]

-- Excess ------------------------------------------------------------------------------------------

-- | Excess on the elements of a contour. If rest material is allowed, all motions at the height of
-- the pass count. They are the same for all cuts of the pass, so only the first cut is examined.
-- The array has the upper bounds of the scan.
missedOn :: MotionSet -> Bool -> MillingPass -> Mm -> PrimArray Double -> [Witness]
missedOn set isFirst MillingPass {job, level, found} allowed bounds
  | allowsRest job && not isFirst = []
  | otherwise =
    concat
      [ Excess.excesses
          job {reach = distance, allowance = allowed}
          bounds
          index
          (if allowsRest job then concatMap (touchableParts job kept distance) es else es)
        | (own, es) <- groups,
          let distance = plus (reach job) own
      ]
  where
    groups = byAllowance (BoxTree.toList (edges job))
    -- Distances that the cutter's centre keeps from the elements.
    kept =
      [ KeptDistance
          (plus (reach job) own)
          (BoxTree.index BoundingBox.ofSegment (map (Part.segment . element) es))
        | (own, es) <- groups
      ]
    index = BoxTree.indexFirst (length cutting) Motion.box cutting
    cutting = case found of
      Complete {} | not (allowsRest job) -> PassSearch.motionsOf found
      _ -> MotionSet.atHeight set level

-- | Parts of an element that the cutter can touch at a distance, if rest material is allowed.
touchableParts :: MillingJob -> [KeptDistance] -> Mm -> Edge -> [Edge]
touchableParts job kept distance e = case (Part.rest (milling job), side job) of
  (Part.Allowed, Just demanded) ->
    [ e {element = (element e) {Part.segment = s}, shape = s}
      | s <- Reachability.parts demanded distance kept (Part.segment (element e))
    ]
  _ -> [e]

-- | Elements in groups of equal allowance.
byAllowance :: [Edge] -> [(Mm, [Edge])]
byAllowance es = case es of
  e : others | all ((== ownAllowance e) . ownAllowance) others -> [(ownAllowance e, es)]
  _ -> [(own, [e | e <- es, ownAllowance e == own]) | own <- nubOrd (map ownAllowance es)]
