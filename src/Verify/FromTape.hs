-- | Proof of a tape: its frames are executed on the controller model, and the motions of the cutter
-- are compared with the part.
--
-- Three comparisons decide about a contour. Each is exact over whole motions and whole elements,
-- and none of them computes an offset of the contour:
--
-- * gouge: no motion comes nearer to a milled element than the cutter's radius;
-- * excess: each point of a milled element has a motion within the cutter's radius;
-- * band: between the start and the end of a contour, no motion is further from the contour than
--   the cutter's radius, and none is on the wrong side.
--
-- Each allows the tolerance and one pulse. Pockets, holes, the order of cuts, feeds, commands and
-- the last position are compared as well.
--
-- The motions are those along x, y and z. So a tape that turns a rotary axis is not compared, and
-- is never proven.
--
-- The /planned frames/ are those that the compiler made for the program. A tape with other frames
-- can be proven as well: the planned frames only show where on the tape a pass has to be, and which
-- cutter, feeds and commands it has.
module Verify.FromTape
  ( prove,
    proveFromAnyStart,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), times)
import Base.Region (Located (..))
import Control.Motion qualified as Control
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List (foldl', partition, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Frame.Frame (Frame (..), FrameProgram)
import Frame.Frame qualified as Frame
import Frame.Rounding qualified as Rounding
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.CutFeed qualified as CutFeed
import Part.Cutter (radiusAbove)
import Part.Part (SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.CarvingCheck qualified as CarvingCheck
import Verify.Collision qualified as Collision
import Verify.ContourFeed qualified as ContourFeed
import Verify.Deviation (MillingPass (..))
import Verify.Deviation qualified as Deviation
import Verify.Feed qualified as Feed
import Verify.ForeignCut qualified as ForeignCut
import Verify.FrameRule qualified as FrameRule
import Verify.HoleCheck qualified as HoleCheck
import Verify.Motion (CutterMotion (number, segment))
import Verify.Motion qualified as Motion
import Verify.MotionMatch (ClearingFrames (..))
import Verify.MotionMatch qualified as MotionMatch
import Verify.MotionSet (MotionSet (MotionSet))
import Verify.MotionSet qualified as MotionSet
import Verify.PassFrames (FrameRange (..))
import Verify.PassLocation qualified as PassLocation
import Verify.Pocket qualified as Pocket
import Verify.PocketDeviation (PassMotions (..))
import Verify.PocketDeviation qualified as PocketDeviation
import Verify.Proof (ContourProof, Finding (..), Proof (Proof), Refusal (NotCompensated))
import Verify.Proof qualified as Proof
import Verify.ProofSubject (ProofSubject (..))
import Verify.ProofSubject qualified as Subject
import Verify.RequiredMove qualified as RequiredMove
import Verify.RimWork qualified as RimWork
import Verify.SpindleCutter qualified as SpindleCutter
import Verify.StartSearch (OtherStart)
import Verify.StartSearch qualified as StartSearch
import Verify.TapeSummary qualified as TapeSummary

-- | Compare the frames of a tape with the part. The toolpath @path@ contains the part; @program@
-- has the start position and the planned frames.
prove :: Machine -> Toolpath -> FrameProgram -> [Frame] -> Proof
prove machine path program frames = proofOf False (Subject.subjectOf machine path program frames)

-- | Proof of a subject. @isRestarted@ is true if contours begin where the tape begins them. The
-- tape is not compared with the part if it turns a rotary axis.
proofOf :: Bool -> ProofSubject -> Proof
proofOf isRestarted subject = case TapeSummary.firstTurns (summary subject) of
  [] -> compared isRestarted subject
  turns -> summarized isRestarted subject [] [TurnsAxis n axis | (axis, n) <- turns]

-- | Proof that consists of the summary of a tape, proofs of contours and findings.
summarized :: Bool -> ProofSubject -> [ContourProof] -> [Finding] -> Proof
summarized isRestarted subject contourProofs findings =
  Proof
    { Proof.frames = TapeSummary.count (summary subject),
      Proof.contourProofs,
      Proof.closure = closureOf isRestarted subject,
      Proof.largestIncrement = TapeSummary.largestIncrement (summary subject),
      Proof.firstDifference = TapeSummary.firstDifference (summary subject),
      Proof.findings = sortOn Proof.tapeOrder findings,
      Proof.controlFindings = [],
      Proof.mayLeave = Mm 0
    }

-- | Proof by comparison of all motions with the part.
compared :: Bool -> ProofSubject -> Proof
compared isRestarted subject =
  summarized
    isRestarted
    subject
    (contourProofs <> pocketProofs)
    (found <> unmatched <> notClosed (closureOf isRestarted subject) deviations)
  where
    found = deviations <> otherFindings subject passes
    unmatched = if null found then sequenceFindings subject passes else []
    passes = Subject.locatedPasses subject
    set = motionSetOf subject passes
    (contourProofs, contourFindings) =
      unzip
        ( zipWith3
            (Deviation.examine set)
            (PassLocation.areFirst passes)
            (PassLocation.motionsOfPasses passes)
            passes
        )
    (pocketProofs, pocketFindings) =
      unzip
        [ PocketDeviation.examine set passMotions pocket isFirst pass
          | pocket <- pockets subject,
            (isFirst, pass) <- zip (True : repeat False) (NonEmpty.toList (Pocket.passes pocket))
        ]
    passMotions = passMotionsOf subject passes
    deviations = concat contourFindings <> concat pocketFindings

-- | Motions in the passes of the pockets. If the tape does not match what the program asks for, it
-- is refused. With as many frames as planned, the planned frames of a pass then show where its
-- allowance is cut.
passMotionsOf :: ProofSubject -> [MillingPass] -> PassMotions
passMotionsOf subject passes = case Subject.clearingFrames subject passes of
  Nothing
    | TapeSummary.count (summary subject) == length (Frame.plannedFrames (program subject)) ->
      PassMotions
        False
        (Subject.isInFrames (cutFrames subject))
        (Subject.isInFrames (passFrames subject))
    | otherwise -> PassMotions False (\_ _ -> False) (\_ _ -> False)
  Just ClearingFrames {MotionMatch.inPass, MotionMatch.withMoves} ->
    PassMotions True (Subject.isInFrames inPass) (Subject.isInFrames withMoves)

-- | Compare the frames of a tape with the part, as 'prove' does. A closed contour whose start the
-- program leaves open may begin anywhere on the tape. @replanned@ gives the toolpath and the
-- planned frames of the program if the contours of some statements begin near other points. The
-- keys are the numbers of the statements, in the order of execution from 0. It gives Nothing if the
-- program does not leave these starts open.
proveFromAnyStart ::
  (Map Int Point -> Maybe (Toolpath, FrameProgram)) ->
  Machine ->
  Toolpath ->
  FrameProgram ->
  [Frame] ->
  Proof
proveFromAnyStart replanned machine = go Map.empty
  where
    go starts path program frames
      | Proof.isProven proof = proof
      | Just start <- elsewhere,
        Map.notMember (StartSearch.statementNumber start) starts,
        (_, (starts', path', program')) : _ <-
          sortOn fst (mapMaybe (restarted start frames starts) (StartSearch.near start)) =
        go starts' path' program' frames
      | otherwise = proof
      where
        proof = proofOf (not (Map.null starts)) subject
        elsewhere = otherStart subject
        subject = Subject.subjectOf machine path program frames
    -- The program with this start, and how far it is from the start on the tape.
    restarted start frames starts p = do
      let starts' = Map.insert (StartSearch.statementNumber start) p starts
      (path, program) <- replanned starts'
      let passes = Subject.locatedPasses (Subject.subjectOf machine path program frames)
      away <- StartSearch.differenceFrom start passes
      pure (away, (starts', path, program))

-- | Start of the first contour that the tape does not begin where the toolpath does.
otherStart :: ProofSubject -> Maybe OtherStart
otherStart subject =
  StartSearch.find isAtLevel (motions subject) (Subject.locatedPasses subject)
  where
    isAtLevel pass m =
      Subject.isFlat subject || MotionSet.isAtHeight (machine subject) (level pass) m

-- | Motions of the tape for the comparisons. If only one contour or pocket is compared,
-- 'MotionSet.nearby' returns all motions: a bounding-box tree would cost more time than it saves.
motionSetOf :: ProofSubject -> [MillingPass] -> MotionSet
motionSetOf subject passes =
  MotionSet
    { MotionSet.machine = machine subject,
      MotionSet.isFlat = Subject.isFlat subject,
      MotionSet.isTopFaced,
      MotionSet.isPlanned = not (Subject.isDifferent subject),
      MotionSet.toolOf,
      MotionSet.rimWorksOf =
        RimWork.rimWorks (path subject) (map fst . cuttersOf . number),
      MotionSet.motions = motions subject,
      MotionSet.nearby
    }
  where
    isTopFaced = any ((== Mm 0) . fst) surfaceLevels && all (< Mm 0) otherLevels
    (surfaceLevels, pocketLevels) =
      partition
        snd
        [ (Pocket.level pass, Pocket.isSurface pocket)
          | pocket <- pockets subject,
            pass <- NonEmpty.toList (Pocket.passes pocket)
        ]
    otherLevels = map level passes <> map fst pocketLevels
    -- A V-bit is as wide as it is at the top of the part during the motion.
    toolOf m = case map snd (cuttersOf (number m)) of
      bits@(_ : _)
        | all ((== Part.VBitCutter) . Part.kind) bits ->
          let tip = min (Motion.fromHeight m) (Motion.toHeight m)
           in min (radiusIn m) (maximum (map (radiusAbove (times (-1) tip)) bits))
      _ -> radiusIn m
    cuttersOf = SpindleCutter.cuttersOf subject
    radiusIn = Subject.toolIn subject passes
    nearby box
      | isAskedOnce = motions subject
      | otherwise = BoxTree.within (BoundingBox.inflate largestTool box) (motionIndex subject)
    isAskedOnce = null (drop 1 queries)
    -- Calls of 'MotionSet.nearby': one for the first cut of each statement's execution, and one for
    -- each pocket.
    queries = [() | True <- PassLocation.areFirst passes] <> map (const ()) (pockets subject)
    largestTool = foldl' (\most m -> max most (toolOf m)) (Mm 0) (motions subject)

-- Findings ----------------------------------------------------------------------------------------

-- | Findings of all comparisons, without those of "Verify.Deviation", "Verify.PocketDeviation" and
-- 'notClosed'.
otherFindings :: ProofSubject -> [MillingPass] -> [Finding]
otherFindings subject@ProofSubject {machine, path, program, frames} passes =
  pocketOrder subject
    <> [OffPlane n | Subject.isFlat subject, Just n <- [TapeSummary.firstRisen (summary subject)]]
    <> HoleCheck.missingHoles machine path (motions subject)
    <> CarvingCheck.carvingFindings
      machine
      path
      program
      (Subject.isAligned subject)
      (map fst . SpindleCutter.cuttersOf subject . number)
      (motions subject)
    <> take 1 foreign'
    <> Collision.collisions subject (Subject.toolIn subject passes)
    <> feedFindings subject passes
    <> Feed.tooFast machine begin frames
    <> commandFindings subject (\_ _ -> True)
    <> FrameRule.refused machine begin frames
    <> map (Refused . NotCompensated) (compensationErrors subject)
  where
    begin = Frame.start program
    foreign'
      | Subject.isFlat subject || not (Subject.isDifferent subject) = []
      | otherwise =
        ForeignCut.foreignCuts machine path (plannedMotions subject) (motions subject)

-- | Findings for commands that differ from those of the planned frames. @isSamePlace@ is as in
-- 'FrameRule.wrongCommands'.
commandFindings :: ProofSubject -> (Int -> Int -> Bool) -> [Finding]
commandFindings subject@ProofSubject {program, frames} isSamePlace
  | Subject.isDifferent subject =
    FrameRule.wrongCommands (Subject.isAligned subject) isSamePlace program frames
  | otherwise = []

-- | Findings for commands that do not come at their place in the order of the motions.
displacedCommands :: ProofSubject -> [MillingPass] -> [Finding]
displacedCommands subject@ProofSubject {machine, path, program} passes =
  commandFindings subject isSamePlace
  where
    isSamePlace k n = case (IntMap.lookup k plannedPlaces, IntMap.lookup n places) of
      (Just a, Just b) -> a == b
      _ -> True
    places = placesOn subject passes
    plannedPlaces = placesOn planned (Subject.locatedPasses planned)
    planned =
      Subject.subjectOf machine path program (map Frame.frame (Frame.plannedFrames program))
    placesOn tape@ProofSubject {frames} found =
      MotionMatch.commandPlaces
        machine
        (Frame.start program)
        (Subject.requiredItems tape (map RequiredMove.alongContour found))
        [n | (n, f) <- zip [1 ..] frames, not (null (Frame.commands f))]
        (Control.run (Frame.start program) frames)

-- | Findings for motions, moves and commands that do not follow one another as the program asks. A
-- tape with another fault often has motions that the program does not ask for, too. So these
-- findings serve only if there is no other one.
sequenceFindings :: ProofSubject -> [MillingPass] -> [Finding]
sequenceFindings subject passes = case unmatchedMotions subject passes of
  [] -> displacedCommands subject passes
  findings -> findings

-- | Finding for the first motion that the program does not ask for at its place in the order, or
-- for the first move that is missing.
unmatchedMotions :: ProofSubject -> [MillingPass] -> [Finding]
unmatchedMotions subject@ProofSubject {machine, program, frames} passes =
  MotionMatch.mismatches
    machine
    begin
    (Subject.requiredItems subject (map RequiredMove.alongContour passes))
    (Control.run begin frames)
  where
    begin = Frame.start program

-- | Findings for pockets whose depths are not cut in order.
pocketOrder :: ProofSubject -> [Finding]
pocketOrder subject =
  [ NotInOrder (Pocket.statement pocket)
    | not (Subject.isFlat subject),
      (k, pocket) <- zip [0 ..] (pockets subject),
      not (Pocket.isInOrder (machine subject) pocket (motionsFor k))
  ]
  where
    motionsFor k
      | Subject.isAligned subject = IntMap.findWithDefault [] k byPocket
      | otherwise = motions subject
    byPocket = motionsByPocket subject

-- | Motions of the tape in the planned frames of each pocket, by the number of the pocket from 0.
motionsByPocket :: ProofSubject -> IntMap [CutterMotion]
motionsByPocket subject = foldr insert IntMap.empty (motions subject)
  where
    insert m known =
      maybe known (\k -> IntMap.insertWith (<>) k [m] known) (pocketAt (number m))
    -- Number of the pocket in whose planned frames the frame @n@ is.
    pocketAt n = case IntMap.lookupLE n pocketFrames of
      Just (_, (b, k)) | n <= b -> Just k
      _ -> Nothing
    -- Last frame and pocket number of each pass, by the pass's first frame.
    pocketFrames =
      IntMap.fromList
        [ (a, (b, k))
          | (k, pocket) <- zip [0 ..] (pockets subject),
            pass <- NonEmpty.toList (Pocket.passes pocket),
            Just (FrameRange a b) <-
              [IntMap.lookup (Pocket.passIndex pass) (passFrames subject)]
        ]

-- | Findings for feeds. A tape whose frames have the planned feeds has none. A tape with the
-- planned motions is compared with the planned frames, any other tape with the feeds that the
-- statements demand.
feedFindings :: ProofSubject -> [MillingPass] -> [Finding]
feedFindings subject@ProofSubject {program, frames} passes
  | not (Subject.isDifferent subject) || hasPlannedFeeds subject = []
  | Subject.isAligned subject && hasPlannedMotions = Feed.asPlanned program frames
  | otherwise =
    concatMap (contourFeeds subject) passes
      <> pocketFeeds subject passes
  where
    hasPlannedMotions = and (zipWith isSameMotion (Frame.plannedFrames program) frames)
    isSameMotion p f = increment (Frame.frame p) == increment f

-- | Test that each frame has the feed of the planned frame with the same number.
hasPlannedFeeds :: ProofSubject -> Bool
hasPlannedFeeds subject@ProofSubject {program, frames} =
  Subject.isAligned subject && null (Feed.asPlanned program frames)

-- | Findings for feeds along a contour. Vertical motions are left out, because they only occur at
-- the start and the end of the pass.
contourFeeds :: ProofSubject -> MillingPass -> [Finding]
contourFeeds subject pass =
  ContourFeed.findings (machine subject) (job pass) (zip along (programmed subject along))
  where
    along = filter (not . Motion.changesHeight) (Deviation.motionsAlong (found pass))

-- | Findings for feeds in the passes of pockets, without their linking moves. If the frames of the
-- passes are unknown, the linking moves are those that run where the program asks for them.
pocketFeeds :: ProofSubject -> [MillingPass] -> [Finding]
pocketFeeds subject passes = case Subject.clearingFrames subject passes of
  Just ClearingFrames {MotionMatch.inPass = framesOf} ->
    concat
      [ ofPass
          pocket
          [ m
            | m <- motions subject,
              Subject.isInFrames framesOf pass m,
              Subject.isAtDepth subject pass m
          ]
        | pocket <- pockets subject,
          pass <- NonEmpty.toList (Pocket.passes pocket)
      ]
  Nothing ->
    concat
      [ ofPass pocket (filter (not . isLinking pass) ms)
        | (pocket, pass, ms) <- Subject.pocketVisits subject
      ]
  where
    ofPass pocket =
      Feed.atFeed (machine subject) (Part.feed (Pocket.milling pocket)) (helixFeeds pocket)
        . programmed subject
        . filter (not . Motion.isVertical)
    isLinking pass m = any (isAlong (machine subject) (segment m)) (Pocket.linkingMoves pass)

-- | The plunge feed of a pocket that is entered by a helix, if it is no faster than the feed. The
-- last circle of the helix, at the depth of the pass, and the way from there have this feed.
helixFeeds :: Pocket.Pocket -> [Part.Finish]
helixFeeds pocket =
  [ Part.plainFinish {Part.ownFeed = Just down}
    | Located _ (Part.Helical _ _) <- [Part.descent milling],
      Just down@(Located _ plunge) <- [Part.plunge milling],
      Located _ feed <- [Part.feed milling],
      Just slower <- [CutFeed.perMinute plunge],
      Just faster <- [CutFeed.perMinute feed],
      slower <= faster
  ]
  where
    milling = Pocket.milling pocket

-- | Test that both ends of the segment @s@ are within two pulses of the linking move @move@.
isAlong :: Machine -> Segment -> Segment -> Bool
isAlong machine s move =
  all
    (\p -> Distance.toPoint p move <= times 2 (Machine.planeResolution machine))
    [Segment.start s, Segment.end s]

-- | Programmed motions, which are those before cutter compensation. They are the motions of the
-- frames to which the cutter's motions @ms@ belong. The frames are executed again instead of being
-- stored as motions, because few tapes need this.
programmed :: ProofSubject -> [CutterMotion] -> [Control.Motion]
programmed subject ms =
  filter
    (\m -> IntSet.member (Control.number m) numbers)
    (Control.run (Frame.start (program subject)) (frames subject))
  where
    numbers = IntSet.fromList (map number ms)

-- | Last position on the tape minus the rounded end of the toolpath, in pulses. If the toolpath
-- ends on a contour that begins where the tape begins it, its end is known to one pulse only,
-- because the start comes from a rounded position. A difference of one pulse then counts as 0.
closureOf :: Bool -> ProofSubject -> Pulses3
closureOf isRestarted subject
  | isRestarted && endsOnContour && isOnePulse = 0
  | otherwise = difference
  where
    difference =
      TapeSummary.endPosition (summary subject)
        - Rounding.rounded (machine subject) (plane end, height end)
    end = Toolpath.end (path subject)
    isOnePulse = let Pulses3 x y z = difference in abs x <= 1 && abs y <= 1 && z == 0
    moving = filter (not . null . Toolpath.moves) (Toolpath.blocks (path subject))
    endsOnContour = case reverse moving of
      Toolpath.Cutting {Toolpath.cut, Toolpath.retract} : _ ->
        plane end == Segment.end (Toolpath.segment (NonEmpty.last cut))
          && all (isVertical . Toolpath.segment) retract
      _ -> False
    isVertical s = Segment.start s == Segment.end s

-- | Finding for a wrong last position; @closure@ is the difference from the right one. Empty if
-- @deviations@ contains a finding that the cutter leaves a contour or a pocket, because the wrong
-- position is then a consequence.
notClosed :: Pulses3 -> [Finding] -> [Finding]
notClosed closure deviations =
  [NotClosed closure | closure /= 0, not (any Proof.isOffContour deviations)]
