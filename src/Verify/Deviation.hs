-- | Comparison of a tape with one pass along a contour. It finds gouges, excess, a wrong side, and
-- a contour that is not followed from start to end. A gouge is a cut too deep into the part; excess
-- is material that remains where none is allowed. The requirements come from the part; the toolpath
-- only says which passes there are.
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
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Tolerance qualified as Tolerance
import Machine.Machine qualified as Machine
import Part.Break qualified as Break
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
import Verify.MillingJob qualified as MillingJob
import Verify.Motion (CutterMotion (number))
import Verify.Motion qualified as Motion
import Verify.MotionSet (MotionSet)
import Verify.MotionSet qualified as MotionSet
import Verify.PassSearch (FoundPass (..))
import Verify.PassSearch qualified as PassSearch
import Verify.PointedTool qualified as PointedTool
import Verify.Proof (ContourProof (ContourProof), Finding (Excess, Gouge, NotFollowed), Witness)
import Verify.Proof qualified as Proof
import Verify.Reachability qualified as Reachability
import Verify.RimWork qualified as RimWork
import Verify.WrongSide qualified as WrongSide

-- | Pass along a contour, or one of its cuts, with its motions on the tape. A pass around rest
-- material may have several cuts, each along a part of the contour. Any other pass is a single cut.
data MillingPass = MillingPass
  { job :: MillingJob,
    -- | number of the execution of the milling statement, from 0; all passes of one execution have
    -- the same number
    passNumber :: Int,
    -- | height of the cut; the top of the part is 0
    level :: Mm,
    found :: FoundPass
  }

-- | Allowed deviations into the part and away from it. Each is a chord error plus one pulse.
data Allowed = Allowed {allowedGouge :: Mm, allowedExcess :: Mm}

-- | Compare the motions of a tape with a cut along a contour. If @isFirst@ is true, the cut is the
-- first one of its statement. Then all motions near the contour are examined for gouges; otherwise
-- only those of the cut. Excess on the elements is examined once for all cuts of a pass, with the
-- first cut. For that cut, @onPass@ has the motions of all cuts of the pass. For later cuts it is
-- Nothing.
examine :: MotionSet -> Bool -> Maybe [CutterMotion] -> MillingPass -> (ContourProof, [Finding])
examine set isFirst onPass pass =
  (contourProof, if null findings then orderFindings set pass else findings)
  where
    MillingPass {job, level, found} = pass
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
    cutting = motionsOf set onPass pass
    missedBy = missedOn onPass pass allowedExcess bounds
    missed = if null cutting then [] else missedBy cutting
    -- A pass without motions cuts at most what the cutter touches at its start.
    isNeverCut = null cutting && any isTooMuch (missedBy [Motion.ofNoLength (entry job) level])
    -- No motion at this height comes near an element, or is on the cutter's side of one.
    isLeftOut = isMissing found && (not (any isTooMuch missed) || any (isOutOfReach job) tooMuch)
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
        <> [neverBegun pass | isNeverCut || isLeftOut]

-- | True of an excess of more than the cutter's diameter, for a cutter with a diameter.
isOutOfReach :: MillingJob -> Witness -> Bool
isOutOfReach job w = tool > Mm 0 && Proof.amount w > plus tool tool
  where
    tool = Part.radius (milling job)

-- | Finding for the @gouges@ that are deeper than @allowed@; empty if there are none. The finding
-- names the first such gouge of the list, and @deepest@.
gougeFindings :: Mm -> [Witness] -> Maybe Witness -> [Finding]
gougeFindings allowed gouges deepest =
  [ Gouge first worst allowed
    | Just worst <- [deepest],
      Proof.amount worst > allowed,
      first : _ <- [filter ((> allowed) . Proof.amount) gouges]
  ]

-- | Finding for an excess that is larger than @allowed@; empty if there is none. @tooMuch@ lists
-- each such excess. The finding names the first excess of this list, and @largest@.
excessFindings :: Mm -> [Witness] -> Maybe Witness -> [Finding]
excessFindings allowed tooMuch largest =
  [Excess first (fromMaybe first largest) allowed | first : _ <- [tooMuch]]

-- | Test that the motions of a pass are not on the tape.
isMissing :: FoundPass -> Bool
isMissing found = case found of
  Complete _ _ -> False
  Incomplete _ _ -> False
  Missing -> True

-- | Motions along the contour, without the motion that arrives at the start of the contour.
motionsAlong :: FoundPass -> [CutterMotion]
motionsAlong found = case found of
  Complete _ along -> along
  Incomplete _ along -> along
  Missing -> []

-- | Allowed deviations of a job. If the cutter runs on the contour and has no side, the larger of
-- the two chord errors is allowed in both directions.
allowedOf :: MotionSet -> MillingJob -> Allowed
allowedOf set job
  | isNothing (side job) = Allowed (plus larger pulse) (plus larger pulse)
  | otherwise = Allowed (plus inside pulse) (plus outside pulse)
  where
    (inside, outside) = allowedDeviation (Edge.isCurved (edges job)) (milling job)
    larger = max inside outside
    pulse = Machine.planeResolution (MotionSet.machine set)

-- | Allowed chord errors of a tape, into the part and away from it. @isCurved@ is true of a contour
-- with curves. The arcs that replace a curve may deviate from it by 'Tolerance.curve', so the
-- allowed errors of a contour with curves are smaller by 'Tolerance.curve'.
allowedDeviation :: Bool -> Milling -> (Mm, Mm)
allowedDeviation isCurved milling
  | isCurved = (less inside, less outside)
  | otherwise = (inside, outside)
  where
    (inside, outside) = Part.deviationLimits (Part.tolerance milling)
    less d = max (Mm 0) (minus d Tolerance.curve)

-- | Finding for a contour that is not followed from its start to its end, in the direction of
-- travel. While the cutter goes round an outer corner, the contact point does not move, and does
-- not show motions backwards. So single motions against the direction of travel are looked for as
-- well. This is not necessary if the tape has exactly the planned frames, those that the compiler
-- made, and they follow the whole contour.
orderFindings :: MotionSet -> MillingPass -> [Finding]
orderFindings set pass@MillingPass {job, found} = case found of
  Complete _ along -> if MotionSet.isPlanned set then [] else backward along
  Incomplete _ along
    | isUnfollowed job found -> [NotFollowed (statement job)]
    | otherwise -> backward along
  Missing -> [neverBegun pass]
  where
    backward along =
      [ NotFollowed (statement job)
        | let index = BoxTree.index Motion.box along,
          any runsBack along
            || not (MotionSet.isPlanned set) && any (isUnasked index) along
      ]
    isUnasked index m =
      WrongSide.repeats job index m
        || Part.corners (milling job) == Part.Sharp && WrongSide.strays job m
    runsBack = WrongSide.runsBack (MotionSet.machine set) job

-- | Finding that the tape never reaches the start of a pass.
neverBegun :: MillingPass -> Finding
neverBegun MillingPass {job, level} = Proof.NeverBegun (statement job) (entry job) level

-- | Test that a cut does not follow the contour to its end, as it would have to. If rest material
-- is allowed, a cut need not go along the whole contour.
isUnfollowed :: MillingJob -> FoundPass -> Bool
isUnfollowed job found = case found of
  Complete _ _ -> False
  Incomplete _ _ -> not (allowsRest job) && ContactMeasure.isMeasurable job
  Missing -> True

-- | Test that the statement allows rest material.
allowsRest :: MillingJob -> Bool
allowsRest job = Part.rest (milling job) == Part.Allowed

-- Gouge -------------------------------------------------------------------------------------------

-- | Motions that are examined for gouges. If @isFirst@ is true, they are all motions near the
-- contour, otherwise the motions @along@ it. Motions above the top of the part are left out. The
-- list is empty if the cutter runs on the contour.
motionsKeepingOut :: MotionSet -> Bool -> MillingJob -> [CutterMotion] -> [CutterMotion]
motionsKeepingOut set isFirst job along
  | isNothing (side job) = []
  | isFirst = filter (MotionSet.isBelowTop set) (MotionSet.nearby set box)
  | otherwise = filter (MotionSet.isBelowTop set) along
  where
    box = BoundingBox.inflate (maxReach job) (boxOf (milling job))

-- | Bounding box of the contour that is milled.
boxOf :: Milling -> BoundingBox
boxOf milling =
  foldr1
    BoundingBox.union
    (fmap (BoundingBox.ofSegment . Part.segment) (Part.elements (Part.contour milling)))

-- | Distance that a motion has to keep from the elements. The motions @along@ the contour keep the
-- reach of the job plus the allowances of the elements. Any other motion keeps the radius of its
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
              required = \e p ->
                plus (reach job) (Gouge.allowanceAt (side job) (roundingOf m) (edges job) e p)
            }
        else (RimWork.keepOut (MotionSet.rimWorksOf set m) (side job) tool) {searchRadius}
  where
    -- The bounding paths of an arc lie beside its real path by the difference of its radii.
    roundingOf m = plus pulse (Mm (FastDistance.uneven (Motion.segment m)))
    pulse = Machine.planeResolution (MotionSet.machine set)
    ownFrames = IntSet.fromDistinctAscList (ascending (map number along))
    largestAllowance = max (Mm 0) (Edge.largestAllowance (edges job))

-- | Numbers of a sorted list, each once.
ascending :: [Int] -> [Int]
ascending ns = case ns of
  a : b : more | a == b -> ascending (b : more)
  a : more -> a : ascending more
  [] -> []

-- | Gouges of a tool with radius 0; empty for any other tool. Such a tool gouges only by crossing
-- the contour, which 'PointedTool.gougeOf' finds. @allowed@ is the allowed depth; gouges within it
-- are listed as well.
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

-- | Motions that may cut the elements of a contour: those of all cuts of the pass, @onPass@. It is
-- Nothing for the later cuts of a pass: these are examined with the first one. If the contour is
-- not followed to its end, which is a finding of its own, all motions at the height of the pass
-- count.
motionsOf :: MotionSet -> Maybe [CutterMotion] -> MillingPass -> [CutterMotion]
motionsOf set onPass MillingPass {job, level, found}
  | isUnfollowed job found = MotionSet.atHeight set level
  | otherwise = fromMaybe (PassSearch.motionsOf found) onPass

-- | Excess that the motions @cutting@ leave on the elements of a contour; @allowed@ is the largest
-- allowed one. @onPass@ is as in 'motionsOf'. @bounds@ is the array that 'ContourScan.scan'
-- returns: for each element, by its number from 0, an upper bound in mm of the distance of its
-- points from the motions along the contour.
missedOn ::
  Maybe [CutterMotion] -> MillingPass -> Mm -> PrimArray Double -> [CutterMotion] -> [Witness]
missedOn onPass MillingPass {job} allowed bounds cutting
  | allowsRest job && isNothing onPass = []
  | otherwise =
    concat
      [ Excess.excesses
          job {reach = distance, allowance = allowed}
          bounds
          index
          (concatMap (\e -> if mayKeep distance e then touchable distance e else [e]) es)
        | (own, es) <- groups,
          let distance = plus (reach job) own
      ]
  where
    groups = byAllowance (BoxTree.toList (edges job))
    -- True of an element at which the cutter may leave material: of every element if the statement
    -- allows rest material, otherwise of those beside a break.
    mayKeep distance e =
      allowsRest job
        || or
          [ Break.besideBreak demanded distance breaks (Part.segment (element e))
            | Just demanded <- [side job]
          ]
    breaks = Break.breaksOf (Part.contour (milling job))
    -- Parts that the cutter can touch with its centre at this distance from the element.
    touchable = case side job of
      Nothing -> \_ e -> [e]
      Just demanded -> \distance e ->
        [ e {element = (element e) {Part.segment = s}, shape = s}
          | s <- Reachability.parts surroundings distance (Part.segment (element e))
        ]
        where
          surroundings =
            Reachability.surroundings
              (Part.ends (Part.contour (milling job)))
              demanded
              [ (plus (reach job) (Part.allowance (Part.finish e)), Part.segment e)
                | e <- MillingJob.elementsOf job
              ]
    index = BoxTree.indexFirst (length cutting) Motion.box cutting

-- | Elements in groups of equal allowance, each with that allowance.
byAllowance :: [Edge] -> [(Mm, [Edge])]
byAllowance es = case es of
  e : others | all ((== ownAllowance e) . ownAllowance) others -> [(ownAllowance e, es)]
  _ -> [(own, [e | e <- es, ownAllowance e == own]) | own <- nubOrd (map ownAllowance es)]
