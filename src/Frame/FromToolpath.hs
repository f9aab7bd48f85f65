{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | From the path to the frames of a machine: arcs where it walks them, else chords within the
-- tolerance; positions in whole pulses; moves split to fit their fields; feeds, braking and
-- commands as the machine takes them.
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
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Frame.Arc (ArcStep (..))
import Frame.Arc qualified as Arc
import Frame.ArcFitting qualified as ArcFitting
import Frame.Braking qualified as Braking
import Frame.Chord (Allowed (..), bandChords, chordCount, chords)
import Frame.Chord qualified as Chord
import Frame.Command (Told, Waiting (..))
import Frame.Command qualified as Command
import Frame.Error (Error (..), Warning (..))
import Frame.FeedCode qualified as FeedCode
import Frame.Frame
  ( Frame (..),
    FrameMotion (Round, Straightway),
    FrameProgram (FrameProgram),
    Planned (Planned),
    Role (..),
  )
import Frame.Frame qualified as Frame
import Frame.FrameCheck qualified as FrameCheck
import Frame.Instruction (Drive (..), Instruction (..))
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

-- | The frames of a path. Positions are rounded to whole pulses as absolute positions, and an
-- increment is the difference of two of them, so rounding never adds up. What keeps the frames from
-- being made at all, or from being few enough, is looked for before they are made.
quantise :: Machine -> Toolpath -> Result Warning Error FrameProgram
quantise
  machine
  path@Toolpath {Toolpath.start = Located fromRegion (SpacePoint fromPoint fromHeight)} =
    foldr seq () (tooCoarse <> tooMany) `seq` case nubOrd (early <> late) of
      [] -> Result warnings [] (Just (FrameProgram begin frames))
      problems ->
        Result
          (if null boundless then warnings else nubOrd (startWarning <> byHand))
          problems
          Nothing
    where
      begin = Rounding.rounded machine (fromPoint, fromHeight)
      looks =
        Looks
          { machine,
            grid = Arc.gridOf machine,
            early = InstructionCheck.lookFrom machine fromRegion fromPoint,
            late = FrameCheck.lookAt machine
          }
      making =
        framesOf
          looks
          (nothingFrom fromRegion begin)
          (Braking.applied machine (Instruction.tasksOf machine path))
      made = LazyList.end making
      frames = LazyList.toList making
      commands = reverse (told made)
      warnings =
        nubOrd
          ( startWarning
              <> FrameCheck.warnings (seen made)
              <> InstructionCheck.unsure (looked made)
              <> byHand
          )
      startWarning =
        let at' = Frame.position machine begin
         in [StartRounded fromRegion fromPoint at' | not (Vec.near at' fromPoint)]
      byHand = concatMap Command.warnings commands
      boundless = InstructionCheck.boundless (looked made)
      -- Looked at before there are frames, so that the path is not held for them.
      tooCoarse = mapMaybe (toleranceProblem machine) (Toolpath.blocks path)
      tooMany = tooManyContours machine path
      early =
        tooCoarse
          <> InstructionCheck.feedless (looked made)
          <> boundless
          <> concatMap Command.errors commands
          <> tooMany
      late
        | null boundless = case overlong made of
          Just place -> [TooManyFrames place InstructionCheck.mostFrames]
          Nothing -> FrameCheck.errors (seen made)
        | otherwise = []

-- What stands against it --------------------------------------------------------------------------

toleranceProblem :: Machine -> Toolpath.Block -> Maybe Error
toleranceProblem machine block = case block of
  Toolpath.Cutting {Toolpath.job = Located _ job} -> tooLarge job
  Toolpath.Clearing {Toolpath.pocket = Located _ p} -> tooLarge (Part.wall p)
  Toolpath.Travelling _ _ -> Nothing
  Toolpath.Holing _ _ -> Nothing
  Toolpath.Commanding _ -> Nothing
  where
    tooLarge job
      | Toolpath.touchedRadius job > Mm 0
          && plus allowed (Machine.pulse machine) >= Part.radius job =
        Just (ToleranceTooLarge (region (Part.side job)) allowed (Part.radius job))
      | otherwise = Nothing
      where
        allowed = uncurry max (Part.deepest (Part.tolerance job))

-- | Machined contours, each counted once for all of its passes.
tooManyContours :: Machine -> Toolpath -> [Error]
tooManyContours machine path = case Machine.mostContours (Machine.limits machine) of
  Nothing -> []
  Just most ->
    [TooManyContours region most | (_, region) <- take 1 (drop most (Map.toList contours))]
  where
    contours = Map.fromList (mapMaybe placeOf (Toolpath.blocks path))
    placeOf b = case b of
      Toolpath.Cutting {Toolpath.job = job, Toolpath.pass = pass} ->
        Just (Toolpath.number pass, region (Part.side (value job)))
      Toolpath.Clearing {Toolpath.pocket = job, Toolpath.pass = pass} ->
        Just (Toolpath.number pass, region (Part.side (Part.wall (value job))))
      Toolpath.Travelling _ _ -> Nothing
      Toolpath.Holing _ _ -> Nothing
      Toolpath.Commanding _ -> Nothing

-- The frames --------------------------------------------------------------------------------------

-- | What is the same for all tasks and frames.
data Looks = Looks
  { machine :: Machine,
    grid :: Arc.Grid,
    early :: InstructionCheck.InstructionContext,
    late :: FrameCheck.FrameContext
  }

-- | What has been made of the tasks so far. Each task is taken once, so that none is kept.
data Making = Making
  { -- | where the cutter stands, and the place in the program that brought it there
    at :: Pulses3,
    here :: Region,
    -- | commands that no frame holds yet
    waiting :: Maybe Waiting,
    -- | the frames of the task at hand and all commands, the latest first
    latest :: [Planned],
    told :: [Told],
    -- | how many frames there are, and where they become too many
    count :: Int,
    overlong :: Maybe Region,
    looked :: InstructionCheck.InstructionFindings,
    seen :: FrameCheck.FrameFindings
  }

nothingFrom :: Region -> Pulses3 -> Making
nothingFrom here at =
  Making
    { at,
      here,
      waiting = Nothing,
      latest = [],
      told = [],
      count = 0,
      overlong = Nothing,
      looked = InstructionCheck.nothing,
      seen = FrameCheck.nothing
    }

-- | The frames of tasks, and what has been made at the end of them.
framesOf :: Looks -> Making -> [Instruction] -> LazyList Making Planned
framesOf looks !made tasks = case tasks of
  [] -> let final = ended looks placed in LazyList.behind (latest final) (LazyList.End final)
  task : more ->
    let made' =
          next looks placed task
     in LazyList.behind (latest made') (framesOf looks made' more)
  where
    -- The frames of the task before stand in the series.
    placed = made {latest = []}

-- | Make the frames of the next task. Commands stand in the frame of the next move, where they find
-- room. Once the frames cannot be made or are too many there are no more of them.
next :: Looks -> Making -> Instruction -> Making
next looks@Looks {machine, grid, early} made task = case task of
  Order place said ->
    let (now, waiting') = Command.add machine place (Command.numbers said) (waiting made)
     in (foldl' (commanding looks) made now)
          { waiting = waiting',
            here = place,
            told = said : told made
          }
  Run {run}
    | InstructionCheck.isBounded looked' ->
      let final = NonEmpty.last run
          walked =
            foldl'
              (stepped looks task)
              made {looked = looked'}
              (stepsOf machine grid (at made) task stops)
       in walked
            { at = Rounding.rounded machine (Segment.end (segment final), snd (heights final)),
              here = origin final
            }
    | otherwise -> made {looked = looked'}
  where
    looked' = InstructionCheck.see early task stops (looked made)
    -- They are counted before they become frames.
    stops = case task of
      Order _ _ -> []
      Run {allowed, run} -> chordStops machine allowed run

-- | Behind the last move commands stand in a frame of their own, and then comes what always ends a
-- program.
ended :: Looks -> Making -> Making
ended looks@Looks {machine} made =
  foldl'
    (commanding looks)
    (maybe made (commanding looks made) (waiting made))
    [Waiting {place = here made, given} | given <- Command.atTheEnd machine]

-- | A frame that only commands.
commanding :: Looks -> Making -> Waiting -> Making
commanding looks made Waiting {place, given} =
  put looks Rapid (at made) (Planned (Frame.still given) Commanding place (Mm 0)) made

-- | The frame of a step of a task, if it moves anything, with the commands that wait.
stepped :: Looks -> Instruction -> Making -> ArcStep -> Making
stepped looks@Looks {machine} task made s = case task of
  Order _ _ -> made
  Run {role, tool, drive, run = m :| _} ->
    case frameOf machine drive (Toolpath.pace m) (at made) s of
      Nothing -> made {at = stop s}
      Just f ->
        let f' = maybe f (\w -> f {orders = given w}) (waiting made)
         in put
              looks
              (if drive == Asked then Toolpath.pace m else Part.Rapid)
              (stop s)
              (Planned f' role (origin m) tool)
              made {waiting = Nothing}

-- | A frame behind the others: how fast the program asks it to be, where it ends.
put :: Looks -> Pace -> Pulses3 -> Planned -> Making -> Making
put Looks {late} asked stop !p made =
  made
    { at = stop,
      latest = p : latest made,
      count = count made + 1,
      overlong =
        if count made == InstructionCheck.mostFrames then Just (Frame.origin p) else overlong made,
      seen = FrameCheck.see late asked stop p (seen made)
    }

-- | The frame of a step; none for one that moves nothing.
frameOf :: Machine -> Drive -> Pace -> Pulses3 -> ArcStep -> Maybe Frame
frameOf machine drive pace at ArcStep {stop, about} = case about of
  Nothing
    | moved == 0 -> Nothing
    | drive == Asked && pace == Rapid && Machine.hasRapidMotion machine -> Just (bare Frame.Rapid 0)
    | otherwise -> Just (driven (bare Straightway 0))
  Just (turn, c) -> Just (driven (bare (Round turn) c))
  where
    moved = stop - at
    bare motion centre =
      Frame {motion, increment = moved, centre, speed = FeedCode 0, braking = False, orders = []}
    driven f = case (drive, pace) of
      (Lowest, _) -> f {speed = fst (Machine.slowest machine)}
      (Slowing v, _) -> f {speed = FeedCode.nearest machine v f, braking = True}
      (Asked, Rapid) -> f {speed = Machine.rapidCode machine}
      (Asked, At (Located _ v)) -> f {speed = FeedCode.nearest machine v f}

-- | Where the frames of a run end and how they get there, given where its chords end.
stepsOf :: Machine -> Arc.Grid -> Pulses3 -> Instruction -> [PathPosition] -> [ArcStep]
stepsOf machine grid begin task stops = case task of
  Order _ _ -> []
  Run {allowed, run = m :| []}
    | Straight a b <- segment m,
      isByItself allowed ->
      map alone (Rounding.split machine begin ((a, fst (heights m)), (b, snd (heights m))))
  Run {allowed, run} -> case Machine.arcs machine of
    Arcs {} | Rounding.isLevel machine run -> arcSteps machine grid begin allowed run
    _ -> map alone (chordSteps machine begin run stops)
  where
    isByItself allowed = case allowed of
      Along _ -> False
      Sagitta _ -> True
      BandOf _ _ -> True

-- | A straight step.
alone :: Pulses3 -> ArcStep
alone stop = ArcStep {stop, about = Nothing}

-- | The steps of a run at one height on a machine that walks arcs. What the arcs along a curve are
-- off is taken from what their own steps may be off. Of several ways the one of fewest steps.
arcSteps :: Machine -> Arc.Grid -> Pulses3 -> Allowed -> NonEmpty Move -> [ArcStep]
arcSteps machine grid begin allowed run = case allowed of
  Along bounds ->
    minimumBy
      (comparing length)
      ( fmap
          (concat . snd . mapAccumL (partSteps bounds) begin)
          (ArcFitting.ways machine bounds run)
      )
  Sagitta y ->
    steps
      (Arc.ArcTolerance pulse (plus pulse y) (plus pulse y))
      (Chord.rounding machine allowed)
      begin
      (segment m)
  BandOf inwards outwards ->
    steps
      (Arc.ArcTolerance pulse (plus pulse inwards) (plus pulse outwards))
      (Chord.rounding machine allowed)
      begin
      (segment m)
  where
    m = NonEmpty.head run
    level = fst (heights m)
    pulse = Machine.pulse machine
    steps room chordsOff =
      Arc.steps
        grid
        room
        ( \at s ->
            let chord =
                  m {segment = s} :| []
             in chordSteps
                  machine
                  at
                  chord
                  (Chord.ends InstructionCheck.mostFrames machine chordsOff chord)
        )
        level
    partSteps bounds at part = case part of
      ArcFitting.Chords ms ->
        let stops =
              chordSteps machine at ms (chordStops machine allowed ms)
         in (fromMaybe at (listToMaybe (reverse stops)), map alone stops)
      ArcFitting.Arcs segments ->
        let left = ArcFitting.remainder machine bounds
            ends =
              map (\s -> Rounding.rounded machine (Segment.end s, level)) (NonEmpty.toList segments)
            walked =
              zipWith
                (steps (Arc.ArcTolerance left left left) (Sagitta (Chord.remainder machine left)))
                (at : ends)
                (NonEmpty.toList segments)
         in (fromMaybe at (listToMaybe (reverse ends)), concat walked)

-- | Where the chords of a run end, with their heights.
chordStops :: Machine -> Allowed -> NonEmpty Move -> [PathPosition]
chordStops machine allowed =
  Chord.ends InstructionCheck.mostFrames machine (Chord.rounding machine allowed)

-- | The ends of the steps along a run's chords from a position on.
chordSteps :: Machine -> Pulses3 -> NonEmpty Move -> [PathPosition] -> [Pulses3]
chordSteps machine begin run stops =
  concat
    ( zipWith
        (Rounding.split machine)
        (begin : map (Rounding.rounded machine) stops)
        (zip (first : stops) stops)
    )
  where
    m = NonEmpty.head run
    first = (Segment.start (segment m), fst (heights m))
