-- | From the toolpath to the frames of a machine.
--
-- A run is a sequence of moves along one line, arc or curve. A level run stays at one height. On
-- machines with circular interpolation a level run becomes lines and arcs, and chords where arcs
-- are not possible. So does a single arc that rises, on machines with helices ("Frame.Helix").
-- Every other run becomes chords within the tolerance.
--
-- Positions are rounded to whole pulses, moves are split to fit their fields, and every frame gets
-- its feed code, its braking mark and its commands. Requests that the machine cannot carry out are
-- refused or reported as warnings, see "Frame.Error".
--
-- A step is a motion of one frame, before the frame has its feed and its commands.
module Frame.FromToolpath
  ( quantise,
    chords,
    bandChords,
    chordCount,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), plus)
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Data.Containers.ListUtils (nubOrd)
import Data.List (foldl', mapAccumL, minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe, maybeToList)
import Data.Ord (comparing)
import Frame.Arc (ArcStep (..), ArcTolerance (..))
import Frame.Arc qualified as Arc
import Frame.ArcFitting (RunPart)
import Frame.ArcFitting qualified as ArcFitting
import Frame.Braking qualified as Braking
import Frame.ChordError (ChordTolerance (..), bandChords, chordCount, chords)
import Frame.ChordError qualified as ChordError
import Frame.Chording (Bounds)
import Frame.Command (Pending (..), Translation)
import Frame.Command qualified as Command
import Frame.Error (Error (..), Warning (..))
import Frame.FeedCode qualified as FeedCode
import Frame.Frame
  ( Frame (..),
    FrameMotion (Circular, Linear),
    FrameProgram (FrameProgram),
    PlannedFrame (PlannedFrame),
    Role (..),
  )
import Frame.Frame qualified as Frame
import Frame.FrameCheck qualified as FrameCheck
import Frame.Helix qualified as Helix
import Frame.HoleRule qualified as HoleRule
import Frame.Instruction (FeedMode (..), Instruction (..))
import Frame.Instruction qualified as Instruction
import Frame.InstructionCheck qualified as InstructionCheck
import Frame.Rounding (PathPosition)
import Frame.Rounding qualified as Rounding
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Pace (..), SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Move (..), Toolpath (Toolpath), heights)
import Toolpath.Toolpath qualified as Toolpath

-- | Frames of a toolpath, or the errors because of which there are none. If a point is out of reach
-- or "Frame.InstructionCheck" estimates too many frames, no more moves become frames. Warnings are
-- given only if there are frames.
quantise :: Machine -> Toolpath -> Result Warning Error FrameProgram
quantise
  machine
  given@Toolpath {Toolpath.start = Located startRegion (SpacePoint startPoint startHeight)} =
    -- These errors are evaluated before the frames are made. Otherwise they would keep the whole
    -- toolpath in memory.
    foldr seq () (tooCoarse <> tooMany <> untapped) `seq` case problemsOf made of
      [] -> Result warnings [] (Just (FrameProgram begin frames))
      -- No warnings: without frames, nothing runs otherwise than asked for.
      problems -> Result [] (map (atDepth path) problems) Nothing
    where
      path = HoleRule.adapted machine given
      begin = Rounding.rounded machine (startPoint, startHeight)
      context =
        Context
          { machine,
            grid = Arc.gridOf machine,
            instructionContext = InstructionCheck.contextOf machine startRegion startPoint,
            frameContext = FrameCheck.contextOf machine
          }
      -- The feeds of a tap mean nothing on a machine that cannot tap.
      problemsOf end' = if null untapped then errorsOf tooCoarse tooMany end' else nubOrd untapped
      making =
        framesOf
          context
          (initial startRegion begin)
          (Braking.applied machine (Instruction.instructions machine path))
      made = LazyList.end making
      frames = LazyList.toList making
      tooCoarse = mapMaybe (toleranceError machine) (Toolpath.blocks path)
      untapped = HoleRule.tapErrors machine path
      tooMany = contourErrors machine path
      startWarnings = startWarning machine startRegion (SpacePoint startPoint startHeight) begin
      warnings = nubOrd (startWarnings <> warningsOf made)

-- | The error of an axis z that the machine does not have, with the first depth that the program
-- gives, or else the move, as its place. All other errors stay as they are.
atDepth :: Toolpath -> Error -> Error
atDepth path e = case e of
  NoSuchAxis _ Machine.Z
    | depth : _ <- concatMap depthOf (Toolpath.blocks path) -> NoSuchAxis depth Machine.Z
  _ -> e
  where
    depthOf block = case block of
      Toolpath.Cutting {Toolpath.job = Located _ milling} -> depthIn milling
      Toolpath.Clearing {Toolpath.pocket = Located _ pocket} -> depthIn (Part.wall pocket)
      Toolpath.Carved (Located _ c) _ _ -> [Part.carvingDepthAt c]
      _ -> []
    depthIn = maybeToList . Part.depthAt . Part.places

-- | All errors, each once. @tooCoarse@ are the errors about too large tolerances, @tooMany@ is the
-- error about too many contours, and @made@ is the state after the last instruction.
errorsOf :: [Error] -> [Error] -> Making -> [Error]
errorsOf tooCoarse tooMany made =
  nubOrd
    ( tooCoarse
        <> InstructionCheck.feedErrors (instructionFindings made)
        <> bounds
        <> concatMap Command.errors (reverse (translations made))
        <> tooMany
        <> ofFrames
    )
  where
    bounds = InstructionCheck.boundErrors (instructionFindings made)
    ofFrames
      | null bounds = case tooManyFrom made of
        Just region -> [TooManyFrames region Frame.mostFrames]
        Nothing -> FrameCheck.errors (frameFindings made)
      | otherwise = []

-- | Warnings about frames and commands, from the state after the last instruction.
warningsOf :: Making -> [Warning]
warningsOf made =
  FrameCheck.warnings (frameFindings made)
    <> InstructionCheck.heightWarnings (instructionFindings made)
    <> commandWarnings made

-- | Warnings about commands, in the order of the program.
commandWarnings :: Making -> [Warning]
commandWarnings made = concatMap Command.warnings (reverse (translations made))

-- | Warning about the start, in mm, if it lies between two pulses. @begin@ is its rounded position;
-- @region@ is the part of the program that gives the point.
startWarning :: Machine -> Region -> SpacePoint -> Pulses3 -> [Warning]
startWarning machine region (SpacePoint asked z) begin =
  [StartRounded region asked given z | not (Vec.isNear given asked)]
  where
    given = Frame.position machine begin

-- Errors that need no frames ----------------------------------------------------------------------

-- | Error of a block whose tolerance is too large for its cutter. Nothing for every other block,
-- and for a block in which the cutter's centre follows the contour itself. A block has the moves of
-- one statement, or of one of its passes.
toleranceError :: Machine -> Toolpath.Block -> Maybe Error
toleranceError machine block = case block of
  Toolpath.Cutting {Toolpath.job = Located _ job} -> tooLarge job
  Toolpath.Clearing {Toolpath.pocket = Located _ p} -> tooLarge (Part.wall p)
  Toolpath.Travelling {} -> Nothing
  Toolpath.Holing _ _ -> Nothing
  Toolpath.Carved {} -> Nothing
  Toolpath.Commanding _ -> Nothing
  where
    tooLarge job
      | Toolpath.touchedRadius job > Mm 0
          && plus tolerance (Machine.planeResolution machine) >= Part.radius job =
        Just
          ( ToleranceTooLarge
              (region (Part.side job))
              tolerance
              (Part.radius job)
              (Part.accuracy (Part.places job))
          )
      | otherwise = Nothing
      where
        tolerance = uncurry max (Part.deviationLimits (Part.tolerance job))

-- | The error 'TooManyContours' if the machine does not allow so many contours; otherwise empty.
-- Each milling or pocket statement counts as one contour, however many passes it has.
contourErrors :: Machine -> Toolpath -> [Error]
contourErrors machine path = case Machine.mostContours (Machine.limits machine) of
  Nothing -> []
  Just most ->
    [TooManyContours region most | (_, region) <- take 1 (drop most (Map.toList contours))]
  where
    contours = Map.fromList (mapMaybe contourOf (Toolpath.blocks path))
    contourOf b = case b of
      Toolpath.Cutting {Toolpath.job, Toolpath.pass} ->
        Just (Toolpath.number pass, region (Part.side (value job)))
      Toolpath.Clearing {Toolpath.pocket, Toolpath.pass} ->
        Just (Toolpath.number pass, region (Part.side (Part.wall (value pocket))))
      Toolpath.Travelling {} -> Nothing
      Toolpath.Holing _ _ -> Nothing
      Toolpath.Carved {} -> Nothing
      Toolpath.Commanding _ -> Nothing

-- Making the frames -------------------------------------------------------------------------------

-- | Facts that are the same for all instructions and frames.
data Context = Context
  { machine :: Machine,
    grid :: Arc.Grid,
    instructionContext :: InstructionCheck.InstructionContext,
    frameContext :: FrameCheck.FrameContext
  }

-- | State after the instructions so far. It has no reference to these instructions, so they do not
-- stay in memory.
data Making = Making
  { -- | position of the cutter in pulses
    at :: Pulses3,
    -- | region of the part program that asks for the last move or command
    here :: Region,
    -- | commands that no frame holds yet
    pending :: Maybe Pending,
    -- | frames of the run or command that is being converted, the latest first
    latest :: [PlannedFrame],
    -- | words and reports of all commands so far, the latest first
    translations :: [Translation],
    -- | number of frames so far
    count :: Int,
    -- | text in the part program that asks for the first frame beyond the allowed number
    tooManyFrom :: Maybe Region,
    instructionFindings :: InstructionCheck.InstructionFindings,
    frameFindings :: FrameCheck.FrameFindings
  }

-- | State before the first instruction, with the region and the rounded position of the start.
initial :: Region -> Pulses3 -> Making
initial here at =
  Making
    { at,
      here,
      pending = Nothing,
      latest = [],
      translations = [],
      count = 0,
      tooManyFrom = Nothing,
      instructionFindings = InstructionCheck.noFindings,
      frameFindings = FrameCheck.noFindings
    }

-- | Frames of instructions as a lazy list, which ends with the final state. @made@ is the state
-- before the instructions.
framesOf :: Context -> Making -> [Instruction] -> LazyList Making PlannedFrame
framesOf context made instructions = case instructions of
  [] ->
    let final = ended context emptied
     in LazyList.prependReversed (latest final) (LazyList.End final)
  instruction : more ->
    let made' = next context emptied instruction
     in LazyList.prependReversed (latest made') (framesOf context made' more)
  where
    -- The list already has the frames of the instruction before.
    emptied = made {latest = []}

-- | Makes the frames of the next instruction. The words of commands wait for the frame of the next
-- move. After a point out of reach, or an estimate of too many frames, no more moves become frames.
next :: Context -> Making -> Instruction -> Making
next context@Context {machine, instructionContext} made instruction = case instruction of
  Words region translation ->
    let (full, pending') =
          Command.add machine region translation (pending made)
     in (foldl' (addCommands context) made full)
          { pending = pending',
            here = region,
            translations = translation : translations made
          }
  Run {run}
    | InstructionCheck.isBounded findings ->
      let final = NonEmpty.last run
          stepped =
            foldl'
              (addStep context instruction)
              made {instructionFindings = findings}
              (stepsOf context (at made) instruction chordEnds)
       in stepped
            { at = Rounding.rounded machine (Segment.end (segment final), snd (heights final)),
              here = origin final
            }
    | otherwise -> made {instructionFindings = findings}
  where
    -- The number of frames is checked here, before the frames are made.
    findings =
      InstructionCheck.check instructionContext instruction chordEnds (instructionFindings made)
    chordEnds = case instruction of
      Words _ _ -> []
      Run {tolerance, run} -> chordEndsOf machine tolerance run

-- | Adds the frames after the last move: one for the commands that are still pending, and the
-- frames that end every program of the machine.
ended :: Context -> Making -> Making
ended context@Context {machine} made =
  foldl'
    (addCommands context)
    (maybe made (addCommands context made) (pending made))
    [Pending {asked = here made, given} | given <- Command.finalFrames machine]

-- | Adds a frame that holds only commands.
addCommands :: Context -> Making -> Pending -> Making
addCommands context made Pending {asked, given} =
  addFrame
    context
    Rapid
    (at made)
    (PlannedFrame (Frame.commandFrame given) Commanding asked (Mm 0) 0)
    made

-- | Adds the frame of a step of the instruction, with the pending commands. A step without motion
-- has no frame.
addStep :: Context -> Instruction -> Making -> ArcStep -> Making
addStep context@Context {machine} instruction made step = case instruction of
  Words _ _ -> made
  Run {role, cutterRadius, toolIndex, feedMode, run = m :| _} ->
    case frameOf machine feedMode (Toolpath.pace m) (at made) step of
      Nothing -> made {at = target step}
      Just f ->
        let f' = maybe f (\p -> f {commands = given p}) (pending made)
         in addFrame
              context
              (if feedMode == AsProgrammed then Toolpath.pace m else Part.Rapid)
              (target step)
              (PlannedFrame f' role (origin m) cutterRadius toolIndex)
              made {pending = Nothing}

-- | Adds the frame @p@. @feed@ is its feed in the program. It is 'Part.Rapid' for a rapid move, for
-- commands, and where the compiler sets the feed. @end@ is the position at the end of the frame in
-- pulses.
addFrame :: Context -> Pace -> Pulses3 -> PlannedFrame -> Making -> Making
addFrame Context {frameContext} feed end p@(PlannedFrame _ _ asked _ _) made =
  made
    { at = end,
      latest = p : latest made,
      count = count made + 1,
      tooManyFrom =
        if count made == Frame.mostFrames
          then Just asked
          else tooManyFrom made,
      frameFindings = FrameCheck.check frameContext feed end p (frameFindings made)
    }

-- | Frame of a step from the position @begin@ in pulses. Nothing for a step without motion.
frameOf :: Machine -> FeedMode -> Pace -> Pulses3 -> ArcStep -> Maybe Frame
frameOf machine feedMode pace begin ArcStep {target, turnsAbout} = case turnsAbout of
  Nothing
    | increment == 0 -> Nothing
    | feedMode == AsProgrammed && pace == Rapid && Machine.hasRapidMotion machine ->
      Just (withoutFeed Frame.Rapid 0)
    | otherwise -> Just (withFeed (withoutFeed Linear 0))
  Just (sense, c) -> Just (withFeed (withoutFeed (Circular sense) c))
  where
    increment = target - begin
    withoutFeed motion centre =
      Frame
        { motion,
          increment,
          turn = 0,
          centre,
          feedCode = FeedCode 0,
          braking = False,
          commands = []
        }
    withFeed f = case (feedMode, pace) of
      (LowestCode, _) -> f {feedCode = fst (Machine.slowest machine)}
      (BrakingTo v, _) -> f {feedCode = FeedCode.nearestCode machine v f, braking = True}
      (AsProgrammed, Rapid) -> f {feedCode = Machine.rapidCode machine}
      (AsProgrammed, At (Located _ v)) -> f {feedCode = FeedCode.cutCode machine v f}

-- Steps of a run ----------------------------------------------------------------------------------

-- | Steps of an instruction from the position @begin@ in pulses. If the instruction is a run,
-- @chordEnds@ are the ends in mm of the run's chords.
stepsOf :: Context -> Pulses3 -> Instruction -> [PathPosition] -> [ArcStep]
stepsOf context@Context {machine} begin instruction chordEnds = case instruction of
  Words _ _ -> []
  Run {tolerance, run = m :| []}
    | Straight a b <- segment m,
      isForSegment tolerance ->
      map straightTo (Rounding.split machine begin ((a, fst (heights m)), (b, snd (heights m))))
  Run {tolerance, run} -> case Machine.arcs machine of
    Arcs {} | Rounding.isLevel machine run -> arcSteps context begin tolerance run
    Arcs {}
      | isForSegment tolerance && Helix.isHelix machine run,
        let m = NonEmpty.head run ->
        Helix.raised machine m (arcSteps context begin tolerance (levelled m :| []))
    _ -> map straightTo (chordSteps machine begin run chordEnds)
  where
    isForSegment tolerance = case tolerance of
      OnCurve _ -> False
      Sagitta _ -> True
      ArcBand _ _ -> True
    levelled m = let z = fst (heights m) in Toolpath.atHeights (z, z) m

-- | Straight step to a position in pulses.
straightTo :: Pulses3 -> ArcStep
straightTo target = ArcStep {target, turnsAbout = Nothing}

-- | Steps of a level run on a machine with arcs, from the position @begin@ in pulses.
arcSteps :: Context -> Pulses3 -> ChordTolerance -> NonEmpty Move -> [ArcStep]
arcSteps context@Context {machine} begin tolerance run = case tolerance of
  OnCurve bounds -> curveSteps context begin bounds run
  Sagitta y -> ofSegment (arcTolerance machine y y) {radiusChange = Nothing}
  ArcBand inwards outwards -> ofSegment (arcTolerance machine inwards outwards)
  where
    m = NonEmpty.head run
    ofSegment allowed =
      segmentSteps
        context
        allowed
        (ChordError.raisedToRounding machine tolerance)
        m
        begin
        (segment m)

-- | Tolerance for arcs in place of an exact segment whose sides have tolerances of their own.
-- @inwards@ and @outwards@ are the allowed chord errors towards the centre and away from it;
-- rounding adds up to one pulse to each.
--
-- If one of them is below a pulse, the joints with the neighbours count as well: at a joint, the
-- cutter comes nearer to the neighbour by the rounding of the joint and by the change of the radius
-- together. The rounding counts for at most half a diagonal of the grid: if its part along a smooth
-- neighbour is b, the circle of radius r leaves the neighbour's line by b²/(2r) there, and the part
-- across is at most √(p²/2 − b²), where p is the pulse. For r ≥ p/√2 the sum is at most p/√2.
arcTolerance :: Machine -> Mm -> Mm -> ArcTolerance
arcTolerance machine inwards outwards =
  ArcTolerance
    { linearError = pulse,
      inwards = plus pulse inwards,
      outwards = plus pulse outwards,
      radiusChange =
        if least < pulse then Just (ChordError.remainder machine (plus least pulse)) else Nothing
    }
  where
    pulse = Machine.planeResolution machine
    least = min inwards outwards

-- | Steps of a level run along a curve, from the position @begin@ in pulses. 'ArcFitting.divisions'
-- divides the run into arcs and chords in several ways. The result has the steps of the division
-- with the fewest steps.
curveSteps :: Context -> Pulses3 -> Bounds -> NonEmpty Move -> [ArcStep]
curveSteps context begin bounds run =
  minimumBy
    (comparing length)
    ( fmap
        (concat . snd . mapAccumL (partSteps context bounds (NonEmpty.head run)) begin)
        (ArcFitting.divisions (machine context) bounds run)
    )

-- | Position in pulses at the end of a part of a run, and the steps of the part. @begin@ is the
-- position at the beginning of the part. @m@ is any move of the run; it gives the height.
partSteps ::
  Context -> Bounds -> Move -> Pulses3 -> RunPart -> (Pulses3, [ArcStep])
partSteps context@Context {machine} bounds m begin part = case part of
  ArcFitting.Chords ms ->
    let ends = chordSteps machine begin ms (chordEndsOf machine (OnCurve bounds) ms)
     in (lastOr begin ends, map straightTo ends)
  ArcFitting.Arcs segments ->
    let allowance = ArcFitting.roundingAllowance machine bounds
        chordError = Sagitta (ChordError.remainder machine allowance)
        tolerance = ArcTolerance allowance allowance allowance Nothing
        ends = [Rounding.rounded machine (Segment.end s, level) | s <- NonEmpty.toList segments]
        parts =
          zipWith
            (segmentSteps context tolerance chordError m)
            (begin : ends)
            (NonEmpty.toList segments)
     in (lastOr begin ends, concat parts)
  where
    level = fst (heights m)
    lastOr p ps = fromMaybe p (listToMaybe (reverse ps))

-- | Steps along one segment, as arcs or as chords, from a position in pulses. @tolerance@ is the
-- allowed error of arcs, @chordError@ that of chords. The move @m@ gives the height.
segmentSteps ::
  Context -> ArcTolerance -> ChordTolerance -> Move -> Pulses3 -> Segment -> [ArcStep]
segmentSteps Context {machine, grid} tolerance chordError m =
  Arc.steps
    grid
    tolerance
    ( \at s ->
        let chord = m {segment = s} :| []
         in chordSteps
              machine
              at
              chord
              (ChordError.ends Frame.mostFrames machine chordError chord)
    )
    (fst (heights m))

-- | Ends in mm of the chords of a run, with their heights. A tolerance that is too small beside the
-- rounding to pulses is raised first, see 'ChordError.raisedToRounding'.
chordEndsOf :: Machine -> ChordTolerance -> NonEmpty Move -> [PathPosition]
chordEndsOf machine tolerance =
  ChordError.ends
    Frame.mostFrames
    machine
    (ChordError.raisedToRounding machine tolerance)

-- | Positions in pulses at the ends of the steps along the chords of a run. The first step begins
-- at the position @begin@ in pulses. @ends@ are the ends of the chords in mm.
chordSteps :: Machine -> Pulses3 -> NonEmpty Move -> [PathPosition] -> [Pulses3]
chordSteps machine begin run ends =
  concat
    ( zipWith
        (Rounding.split machine)
        (begin : map (Rounding.rounded machine) ends)
        (zip (first : ends) ends)
    )
  where
    m = NonEmpty.head run
    first = (Segment.start (segment m), fst (heights m))
