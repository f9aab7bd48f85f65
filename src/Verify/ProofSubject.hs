-- | The subject of a proof: a tape, the program that it is compared with, and what all comparisons
-- have in common: the motions, the passes along contours, the frames of the passes of pockets, and
-- the cutters.
module Verify.ProofSubject
  ( ProofSubject (..),
    subjectOf,
    isAligned,
    isDifferent,
    isFlat,
    locatedPasses,
    isInFrames,
    clearingFrames,
    requiredItems,
    toolIn,
    pocketVisits,
    isAtDepth,
  )
where

import Base.Quantity (Mm (..))
import Control.Compensation qualified as Compensation
import Control.Motion qualified as Control
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust)
import Frame.Frame (Frame (..), FrameProgram)
import Frame.Frame qualified as Frame
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Machine.Machine (Machine)
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Deviation (MillingPass (..))
import Verify.LevelledMotion (Levelled (Levelled))
import Verify.LevelledMotion qualified as Levelled
import Verify.MillingJob (MillingJob (milling))
import Verify.Motion (CutterMotion (number, segment))
import Verify.Motion qualified as Motion
import Verify.MotionMatch (ClearingFrames (..))
import Verify.MotionMatch qualified as MotionMatch
import Verify.MotionSet qualified as MotionSet
import Verify.PassFrames (FrameRange (..))
import Verify.PassFrames qualified as PassFrames
import Verify.PassLocation (Guide (Guide))
import Verify.PassLocation qualified as PassLocation
import Verify.PassSearch qualified as PassSearch
import Verify.Pocket (ClearingPass, Pocket)
import Verify.Pocket qualified as Pocket
import Verify.RequiredMove (MotionGroup, RequiredItem)
import Verify.RequiredMove qualified as RequiredMove
import Verify.SpindleTool (Tools)
import Verify.SpindleTool qualified as SpindleTool
import Verify.Swivel qualified as Swivel
import Verify.Tab qualified as Tab
import Verify.TapeSummary (TapeSummary)
import Verify.TapeSummary qualified as TapeSummary

-- | Tape, the program that it is compared with, and values that are computed once for all
-- comparisons.
data ProofSubject = ProofSubject
  { machine :: Machine,
    path :: Toolpath,
    program :: FrameProgram,
    -- | frames of the tape
    frames :: [Frame],
    summary :: ~TapeSummary,
    -- | radius of the cutter in each planned frame
    tools :: ~Tools,
    -- | motions of the cutter's centre on the tape; those over tabs have the height of their pass
    motions :: ~[CutterMotion],
    -- | the same with their own heights over tabs
    unlevelledMotions :: ~[CutterMotion],
    -- | test that a motion of the tape swivels a blade as its pass demands
    isSwivelled :: CutterMotion -> Bool,
    -- | test that a motion of the tape goes over tabs as its pass demands
    isOverTabs :: CutterMotion -> Bool,
    -- | motions of the cutter's centre in the planned frames
    plannedMotions :: ~[CutterMotion],
    -- | bounding-box tree of the motions on the tape
    motionIndex :: ~(BoxTree CutterMotion),
    compensationErrors :: ~[Compensation.CompensationError],
    pockets :: ~[Pocket],
    -- | numbers of the planned frames of each pass, by the number of the pass, from 0
    passFrames :: ~(IntMap FrameRange),
    -- | the same without the frames of linking moves
    cutFrames :: ~(IntMap FrameRange)
  }

-- | Subject of a proof. The frames are executed lazily, so the list of the controller model's
-- motions is never in memory as a whole. Only the list of 'CutterMotion' stays in memory. A
-- 'CutterMotion' is much smaller than a motion of the model.
subjectOf :: Machine -> Toolpath -> FrameProgram -> [Frame] -> ProofSubject
subjectOf machine path program frames =
  ProofSubject
    { machine,
      path,
      program,
      frames,
      summary = TapeSummary.summarize (Frame.start program) (Frame.plannedFrames program) frames,
      tools,
      motions,
      unlevelledMotions = swivelled,
      isSwivelled,
      isOverTabs,
      plannedMotions =
        Levelled.motions
          ( overTabs
              ( Levelled.motions
                  (levelled (fst (run (map Frame.frame (Frame.plannedFrames program)))))
              )
          ),
      motionIndex = BoxTree.index Motion.box motions,
      compensationErrors,
      pockets = Pocket.pocketsOf (Toolpath.blocks path),
      passFrames = PassFrames.framesOfPasses program,
      cutFrames = PassFrames.framesOfCuts program
    }
  where
    tools = SpindleTool.plannedTools program
    Levelled swivelled isSwivelled = levelled centreMotions
    Levelled motions isOverTabs = overTabs swivelled
    levelled = Swivel.levelled machine path
    overTabs = Tab.levelled machine path
    (centreMotions, compensationErrors) = run frames
    run =
      Compensation.runWith
        (Motion.motionsOf machine)
        machine
        (SpindleTool.toolInFrame tools)
        (Frame.start program)

-- | Test that each frame of the tape ends where the planned frame of the same number ends. If so,
-- the callers compare each frame with that planned frame.
isAligned :: ProofSubject -> Bool
isAligned subject = TapeSummary.isAligned (summary subject)

-- | Test that the frames of the tape differ from the planned ones.
isDifferent :: ProofSubject -> Bool
isDifferent subject = isJust (TapeSummary.firstDifference (summary subject))

-- | Test that the whole toolpath is at the height of its start.
isFlat :: ProofSubject -> Bool
isFlat subject = Toolpath.isFlat (path subject)

-- Passes on the tape ------------------------------------------------------------------------------

-- | Passes along contours on the tape. If the frames of the tape are exactly the planned ones, each
-- pass is searched among its own frames only.
locatedPasses :: ProofSubject -> [MillingPass]
locatedPasses subject@ProofSubject {machine, path, program} =
  PassLocation.locate
    Guide
      { PassLocation.machine,
        PassLocation.isFlat = isFlat subject,
        PassLocation.isSwivelled = isSwivelled subject,
        PassLocation.isOverTabs = isOverTabs subject,
        PassLocation.lastFrameOf = (`IntMap.lookup` lastFrames),
        PassLocation.cutFramesOf =
          if isSingle || isDifferent subject
            then const Nothing
            else (`IntMap.lookup` cutFrames subject)
      }
    (Frame.position machine begin, Frame.height machine begin)
    (motions subject)
    (Toolpath.blocks path)
  where
    begin = Frame.start program
    lastFrames = (\(FrameRange _ b) -> b) <$> clearing
    clearing
      | isDifferent subject =
        maybe
          IntMap.empty
          MotionMatch.inPass
          (matchingFrames subject (RequiredMove.atLevels machine (isFlat subject) path))
      | otherwise = passFrames subject
    -- A single cut cannot be mistaken for another cut, so its planned frames are not needed.
    isSingle = null (drop 1 [() | Toolpath.Cutting {} <- Toolpath.blocks path])

-- | Test that a motion is in the frames of a pass of a pocket. @framesOf@ has the ranges of frames,
-- by the number of the pass.
isInFrames :: IntMap FrameRange -> ClearingPass -> CutterMotion -> Bool
isInFrames framesOf pass m =
  maybe False (`PassFrames.includes` number m) (IntMap.lookup (Pocket.passIndex pass) framesOf)

-- | Frames of each pass of each pocket. Nothing if the tape has other frames than planned, and its
-- motions do not match what the program asks for.
clearingFrames :: ProofSubject -> [MillingPass] -> Maybe ClearingFrames
clearingFrames subject passes
  | isDifferent subject = matchingFrames subject (map RequiredMove.alongContour passes)
  | otherwise =
    Just
      ClearingFrames
        { MotionMatch.inPass = cutFrames subject,
          MotionMatch.withMoves = passFrames subject
        }

-- | Frames of each pass of each pocket on a tape with other frames than planned. @along@ are the
-- groups of motions along contours. Nothing if the motions do not match what the program asks for,
-- or if there is no pocket.
matchingFrames :: ProofSubject -> [MotionGroup] -> Maybe ClearingFrames
matchingFrames subject along
  | null (pockets subject) = Nothing
  | otherwise =
    MotionMatch.clearingFrames
      (machine subject)
      begin
      (requiredItems subject along)
      (Control.run begin (frames subject))
  where
    begin = Frame.start (program subject)

-- | Moves and groups of motions that the program asks for, in order. @along@ are the groups of
-- motions along contours.
requiredItems :: ProofSubject -> [MotionGroup] -> [RequiredItem]
requiredItems subject along =
  RequiredMove.itemsOf
    (machine subject)
    (isFlat subject)
    along
    (pockets subject)
    (path subject)

-- | Radius of the cutter in a motion. If each frame ends where the planned frame of the same number
-- ends, it is the radius in that planned frame. Otherwise the commands that change the tool show it
-- ('SpindleTool.toolsByCommands'). Where no command shows it, 'SpindleTool.supposedTool' infers it
-- from the passes.
toolIn :: ProofSubject -> [MillingPass] -> CutterMotion -> Mm
toolIn subject passes
  | isAligned subject = SpindleTool.toolInFrame (tools subject) . number
  | Just radius <- SpindleTool.toolsByCommands (program subject) (frames subject) = radius . number
  | otherwise = SpindleTool.supposedTool uses smallest . number
  where
    uses = concatMap useAlong passes <> concatMap useIn (pocketVisits subject)
    useAlong pass = SpindleTool.useOf (radiusOf pass) (PassSearch.motionsOf (found pass))
    useIn (pocket, _, visit) = SpindleTool.useOf (Part.radius (Pocket.milling pocket)) visit
    radiusOf = Part.radius . milling . job
    smallest = if null passes then Mm 0 else minimum (map radiusOf passes)

-- | Motions in each pass of each pocket, found by their positions. An entry has the pocket, the
-- pass, and its motions. This serves for a tape on which the frames of the passes are unknown.
pocketVisits :: ProofSubject -> [(Pocket, ClearingPass, [CutterMotion])]
pocketVisits subject =
  [ ( pocket,
      pass,
      [ m
        | m <- BoxTree.within (Pocket.bounds pocket) (motionIndex subject),
          isAtDepth subject pass m,
          Pocket.contains pocket (Segment.at 0.5 (segment m))
      ]
    )
    | pocket <- pockets subject,
      pass <- NonEmpty.toList (Pocket.passes pocket)
  ]

-- | Test that a motion is at the height of a pass of a pocket.
isAtDepth :: ProofSubject -> ClearingPass -> CutterMotion -> Bool
isAtDepth subject pass m =
  isFlat subject || MotionSet.isAtHeight (machine subject) (Pocket.level pass) m
