{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | From the path to the frames of a machine: arcs where it walks them, else chords within the tolerance; positions in
-- whole pulses; moves split to fit their fields; feeds, braking and commands as the machine takes them.
module Frame.FromPath
  ( quantise,
    chords,
    bandChords,
    chordCount,
  )
where

import Base.Lattice (V3 (..))
import Base.Quantity (Mm (..), plus)
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Base.Series (Series)
import Base.Series qualified as Series
import Data.Containers.ListUtils (nubOrd)
import Data.List (foldl', mapAccumL, minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Frame.Arc (Step (..))
import Frame.Arc qualified as Arc
import Frame.Braking qualified as Braking
import Frame.Chord (Allowed (..), bandChords, chordCount, chords)
import Frame.Chord qualified as Chord
import Frame.Curve qualified as Curve
import Frame.Error (Error (..), Warning (..))
import Frame.Feed qualified as Feed
import Frame.Frame (Frame (..), Motion (Round, Straightway), Planned (Planned), Program (Program), Role (..))
import Frame.Frame qualified as Frame
import Frame.FrameCheck qualified as FrameCheck
import Frame.Order (Told, Waiting (..))
import Frame.Order qualified as Order
import Frame.Pulses (Place)
import Frame.Pulses qualified as Pulses
import Frame.Task (Drive (..), Task (..))
import Frame.Task qualified as Task
import Frame.TaskCheck qualified as TaskCheck
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Pace (..), Spot (..))
import Part.Part qualified as Part
import Path.FromPart qualified as Path
import Path.Path (Move (..), Path (Path), heights)
import Path.Path qualified as Path

-- | The frames of a path. Positions are rounded to whole pulses as absolute positions, and an increment is
-- the difference of two of them, so rounding never adds up. What keeps the frames from being made at all, or from being few
-- enough, is looked for before they are made.
quantise :: Machine -> Path -> Result Warning Error Program
quantise machine path@Path {Path.start = Located fromRegion (Spot fromPoint fromHeight)} =
  foldr seq () (tooCoarse <> tooMany) `seq` case nubOrd (early <> late) of
    [] -> Result warnings [] (Just (Program begin frames))
    problems -> Result (if null boundless then warnings else nubOrd (startWarning <> byHand)) problems Nothing
  where
    begin = Pulses.rounded machine (fromPoint, fromHeight)
    looks = Looks {machine, grid = Arc.gridOf machine, early = TaskCheck.lookFrom machine fromRegion fromPoint, late = FrameCheck.lookAt machine}
    making = framesOf looks (nothingFrom fromRegion begin) (Braking.applied machine (Task.tasksOf machine path))
    made = Series.end making
    frames = Series.toList making
    commands = reverse (told made)
    warnings = nubOrd (startWarning <> FrameCheck.warnings (seen made) <> TaskCheck.unsure (looked made) <> byHand)
    startWarning =
      let at' = Frame.position machine begin
       in [StartRounded fromRegion fromPoint at' | not (Vec.near at' fromPoint)]
    byHand = concatMap Order.warnings commands
    boundless = TaskCheck.boundless (looked made)
    -- Looked at before there are frames, so that the path is not held for them.
    tooCoarse = mapMaybe (toleranceProblem machine) (Path.blocks path)
    tooMany = tooManyContours machine path
    early = tooCoarse <> TaskCheck.feedless (looked made) <> boundless <> concatMap Order.errors commands <> tooMany
    late
      | null boundless = case overlong made of
        Just place -> [TooManyFrames place TaskCheck.mostFrames]
        Nothing -> FrameCheck.errors (seen made)
      | otherwise = []

-- What stands against it ---------------------------------------------------------------------------

toleranceProblem :: Machine -> Path.Block -> Maybe Error
toleranceProblem machine block = case block of
  Path.Cutting {Path.job = Located _ job} -> tooLarge job
  Path.Clearing {Path.pocket = Located _ p} -> tooLarge (Part.wall p)
  Path.Travelling _ _ -> Nothing
  Path.Holing _ _ -> Nothing
  Path.Commanding _ -> Nothing
  where
    tooLarge job
      | Path.touchedRadius job > Mm 0 && plus allowed (Machine.pulse machine) >= Part.radius job = Just (ToleranceTooLarge (region (Part.side job)) allowed (Part.radius job))
      | otherwise = Nothing
      where
        allowed = uncurry max (Part.deepest (Part.tolerance job))

-- | Machined contours, each counted once for all of its passes.
tooManyContours :: Machine -> Path -> [Error]
tooManyContours machine path = case Machine.mostContours (Machine.limits machine) of
  Nothing -> []
  Just most -> [TooManyContours region most | (_, region) <- take 1 (drop most (Map.toList contours))]
  where
    contours = Map.fromList (mapMaybe placeOf (Path.blocks path))
    placeOf b = case b of
      Path.Cutting {Path.job = job, Path.pass = pass} -> Just (Path.number pass, region (Part.side (value job)))
      Path.Clearing {Path.pocket = job, Path.pass = pass} -> Just (Path.number pass, region (Part.side (Part.wall (value job))))
      Path.Travelling _ _ -> Nothing
      Path.Holing _ _ -> Nothing
      Path.Commanding _ -> Nothing

-- The frames --------------------------------------------------------------------------------------

-- | What is the same for all tasks and frames.
data Looks = Looks {machine :: Machine, grid :: Arc.Grid, early :: TaskCheck.Look, late :: FrameCheck.Look}

-- | What has been made of the tasks so far. Each task is taken once, so that none is kept.
data Making = Making
  { -- | where the cutter stands, and the place in the program that brought it there
    at :: V3,
    here :: Region,
    -- | commands that no frame holds yet
    waiting :: Maybe Waiting,
    -- | the frames of the task at hand and all commands, the latest first
    latest :: [Planned],
    told :: [Told],
    -- | how many frames there are, and where they become too many
    count :: Int,
    overlong :: Maybe Region,
    looked :: TaskCheck.Seen,
    seen :: FrameCheck.Seen
  }

nothingFrom :: Region -> V3 -> Making
nothingFrom here at = Making {at, here, waiting = Nothing, latest = [], told = [], count = 0, overlong = Nothing, looked = TaskCheck.nothing, seen = FrameCheck.nothing}

-- | The frames of tasks, and what has been made at the end of them.
framesOf :: Looks -> Making -> [Task] -> Series Making Planned
framesOf looks !made tasks = case tasks of
  [] -> let final = ended looks placed in Series.behind (latest final) (Series.End final)
  task : more -> let made' = next looks placed task in Series.behind (latest made') (framesOf looks made' more)
  where
    -- The frames of the task before stand in the series.
    placed = made {latest = []}

-- | Make the frames of the next task. Commands stand in the frame of the next move, where they find room. Once the frames
-- cannot be made or are too many there are no more of them.
next :: Looks -> Making -> Task -> Making
next looks@Looks {machine, grid, early} made task = case task of
  Order place said ->
    let (now, waiting') = Order.add machine place (Order.numbers said) (waiting made)
     in (foldl' (commanding looks) made now) {waiting = waiting', here = place, told = said : told made}
  Run {run}
    | TaskCheck.isBounded looked' ->
      let final = NonEmpty.last run
          walked = foldl' (stepped looks task) made {looked = looked'} (stepsOf machine grid (at made) task stops)
       in walked {at = Pulses.rounded machine (Segment.end (segment final), snd (heights final)), here = origin final}
    | otherwise -> made {looked = looked'}
  where
    looked' = TaskCheck.see early task stops (looked made)
    -- They are counted before they become frames.
    stops = case task of
      Order _ _ -> []
      Run {allowed, run} -> chordStops machine allowed run

-- | Behind the last move commands stand in a frame of their own, and then comes what always ends a program.
ended :: Looks -> Making -> Making
ended looks@Looks {machine} made = foldl' (commanding looks) (maybe made (commanding looks made) (waiting made)) [Waiting {place = here made, given} | given <- Order.atTheEnd machine]

-- | A frame that only commands.
commanding :: Looks -> Making -> Waiting -> Making
commanding looks made Waiting {place, given} = put looks Rapid (at made) (Planned (Frame.still given) Commanding place (Mm 0)) made

-- | The frame of a step of a task, if it moves anything, with the commands that wait.
stepped :: Looks -> Task -> Making -> Step -> Making
stepped looks@Looks {machine} task made s = case task of
  Order _ _ -> made
  Run {role, tool, drive, run = m :| _} -> case frameOf machine drive (Path.pace m) (at made) s of
    Nothing -> made {at = stop s}
    Just f ->
      let f' = maybe f (\w -> f {orders = given w}) (waiting made)
       in put looks (if drive == Asked then Path.pace m else Part.Rapid) (stop s) (Planned f' role (origin m) tool) made {waiting = Nothing}

-- | A frame behind the others: how fast the program asks it to be, where it ends.
put :: Looks -> Pace -> V3 -> Planned -> Making -> Making
put Looks {late} asked stop !p made =
  made
    { at = stop,
      latest = p : latest made,
      count = count made + 1,
      overlong = if count made == TaskCheck.mostFrames then Just (Frame.origin p) else overlong made,
      seen = FrameCheck.see late asked stop p (seen made)
    }

-- | The frame of a step; none for one that moves nothing.
frameOf :: Machine -> Drive -> Pace -> V3 -> Step -> Maybe Frame
frameOf machine drive pace at Step {stop, about} = case about of
  Nothing
    | moved == 0 -> Nothing
    | drive == Asked && pace == Rapid && Machine.hasRapidMotion machine -> Just (bare Frame.Rapid 0)
    | otherwise -> Just (driven (bare Straightway 0))
  Just (turn, c) -> Just (driven (bare (Round turn) c))
  where
    moved = stop - at
    bare motion centre = Frame {motion, increment = moved, centre, speed = FeedCode 0, braking = False, orders = []}
    driven f = case (drive, pace) of
      (Lowest, _) -> f {speed = fst (Machine.slowest machine)}
      (Slowing v, _) -> f {speed = Feed.nearest machine v f, braking = True}
      (Asked, Rapid) -> f {speed = Machine.rapidCode machine}
      (Asked, At (Located _ v)) -> f {speed = Feed.nearest machine v f}

-- | Where the frames of a run end and how they get there, given where its chords end.
stepsOf :: Machine -> Arc.Grid -> V3 -> Task -> [Place] -> [Step]
stepsOf machine grid begin task stops = case task of
  Order _ _ -> []
  Run {allowed, run = m :| []}
    | Straight a b <- segment m, isByItself allowed -> map alone (Pulses.split machine begin ((a, fst (heights m)), (b, snd (heights m))))
  Run {allowed, run} -> case Machine.arcs machine of
    Arcs {} | Pulses.isLevel machine run -> arcSteps machine grid begin allowed run
    _ -> map alone (chordSteps machine begin run stops)
  where
    isByItself allowed = case allowed of
      Along _ -> False
      Sagitta _ -> True
      BandOf _ _ -> True

-- | A straight step.
alone :: V3 -> Step
alone stop = Step {stop, about = Nothing}

-- | The steps of a run at one height on a machine that walks arcs. What the arcs along a curve are off is taken from what
-- their own steps may be off. Of several ways the one of fewest steps.
arcSteps :: Machine -> Arc.Grid -> V3 -> Allowed -> NonEmpty Move -> [Step]
arcSteps machine grid begin allowed run = case allowed of
  Along bounds -> minimumBy (comparing length) (fmap (concat . snd . mapAccumL (partSteps bounds) begin) (Curve.ways machine bounds run))
  Sagitta y -> steps (Arc.Room pulse (plus pulse y) (plus pulse y)) (Chord.rounding machine allowed) begin (segment m)
  BandOf inwards outwards -> steps (Arc.Room pulse (plus pulse inwards) (plus pulse outwards)) (Chord.rounding machine allowed) begin (segment m)
  where
    m = NonEmpty.head run
    level = fst (heights m)
    pulse = Machine.pulse machine
    steps room chordsOff = Arc.steps grid room (\at s -> let chord = m {segment = s} :| [] in chordSteps machine at chord (Chord.ends TaskCheck.mostFrames machine chordsOff chord)) level
    partSteps bounds at part = case part of
      Curve.Chords ms -> let stops = chordSteps machine at ms (chordStops machine allowed ms) in (fromMaybe at (listToMaybe (reverse stops)), map alone stops)
      Curve.Arcs segments ->
        let left = Curve.remainder machine bounds
            ends = map (\s -> Pulses.rounded machine (Segment.end s, level)) (NonEmpty.toList segments)
            walked = zipWith (steps (Arc.Room left left left) (Sagitta (Chord.remainder machine left))) (at : ends) (NonEmpty.toList segments)
         in (fromMaybe at (listToMaybe (reverse ends)), concat walked)

-- | Where the chords of a run end, with their heights.
chordStops :: Machine -> Allowed -> NonEmpty Move -> [Place]
chordStops machine allowed = Chord.ends TaskCheck.mostFrames machine (Chord.rounding machine allowed)

-- | The ends of the steps along a run's chords from a position on.
chordSteps :: Machine -> V3 -> NonEmpty Move -> [Place] -> [V3]
chordSteps machine begin run stops = concat (zipWith (Pulses.split machine) (begin : map (Pulses.rounded machine) stops) (zip (first : stops) stops))
  where
    m = NonEmpty.head run
    first = (Segment.start (segment m), fst (heights m))
