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
import Base.Quantity (Feed (..), Mm (..), Pulses (..), plus)
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Control.Applicative ((<|>))
import Data.Containers.ListUtils (nubOrd)
import Data.List (mapAccumL, minimumBy, scanl')
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
import Frame.Frame (Frame (..), Motion (Round, Straightway), Planned (Planned, frame), Program (Program), Role (..))
import Frame.Frame qualified as Frame
import Frame.Order (Waiting (..))
import Frame.Order qualified as Order
import Frame.Pulses qualified as Pulses
import Frame.Task (Drive (..), Task (..))
import Frame.Task qualified as Task
import Geometry.Box qualified as Box
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), Axis (..), FeedCode (..), FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Pace (..), Spot (..))
import Part.Part qualified as Part
import Path.FromPart qualified as Path
import Path.Path (Move (..), Path)
import Path.Path qualified as Path

-- | A frame with the feed that the program asks there, if it is the program that does.
data Made = Made {planned :: Planned, asked :: Maybe (Located Feed)}

-- | The frames of a path. Positions are rounded to whole pulses as absolute positions, and an increment is
-- the difference of two of them, so rounding never adds up. What keeps the frames from being made at all, or from being few
-- enough, is looked for first.
quantise :: Machine -> Path -> Result Warning Error Program
quantise machine path = case nubOrd (early <> late) of
  [] -> Result warnings [] (Just (Program begin frames))
  problems -> Result (if null boundless then warnings else nubOrd (startWarning <> byHand)) problems Nothing
  where
    tasks = Braking.applied machine (Task.tasksOf machine path)
    moves = [t | t@Run {} <- tasks]
    commands = [told | Order _ told <- tasks]
    Located fromRegion (Spot fromPoint fromHeight) = Path.start path
    begin = Pulses.rounded machine (fromPoint, fromHeight)
    made = framesOf machine fromRegion begin tasks
    frames = map planned made
    warnings = nubOrd (startWarning <> feedWarnings machine made <> take 1 (mapMaybe heightWarning moves) <> byHand)
    startWarning =
      let at = Frame.position machine begin
       in [StartRounded fromRegion fromPoint at | not (Vec.near at fromPoint)]
    heightWarning task = listToMaybe [HeightUnsure (origin m) | Machine.capacity machine Z > 0, Z `notElem` Machine.driven machine, m <- NonEmpty.toList (run task), uncurry (/=) (heights m)]
    byHand = concatMap Order.warnings commands
    boundless = mapMaybe (reachProblem fromRegion fromPoint) moves <> tooLong machine moves
    early = mapMaybe (toleranceProblem machine) (Path.blocks path) <> mapMaybe (feedProblem machine) moves <> boundless <> concatMap Order.errors commands <> tooManyContours machine path
    late
      | null boundless = case drop mostFrames made of
        p : _ -> [TooManyFrames (Frame.origin (planned p)) mostFrames]
        [] -> frequencyProblems machine made <> placeProblems machine begin frames
      | otherwise = []

-- | More frames than this are 38 km of tape.
mostFrames :: Int
mostFrames = 1000000

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

-- | A feed along the path that no code gives, whatever the frames.
feedProblem :: Machine -> Task -> Maybe Error
feedProblem machine task = case (Machine.feedMeasure (Machine.feeds machine), task) of
  (AlongPath, Run {drive = Asked, run}) | At (Located region (Feed v)) <- pace (NonEmpty.head run) -> case Machine.choose machine v of
    Machine.NoSuchFeed low high -> Just (FeedMissing region (Feed v) (Feed low) (Feed high))
    Machine.Given _ _ -> Nothing
  _ -> Nothing

-- | Feeds for which the axis that leads in a frame finds no code; one for each feed of the program.
frequencyProblems :: Machine -> [Made] -> [Error]
frequencyProblems machine made = case Machine.feedMeasure (Machine.feeds machine) of
  AlongPath -> []
  LeadingAxis -> Map.elems (Map.fromListWith (\_ first -> first) [((region, v), e) | Made {planned, asked = Just (Located region v)} <- made, Just e <- [problem region v (frame planned)]])
  where
    problem region v f = case Feed.codeFor machine v f way of
      Machine.Given _ _ -> Nothing
      Machine.NoSuchFeed low high -> Just (FrequencyMissing region v (Feed.valueFor machine v f way) (low, Feed.alongAxis machine low) (high, Feed.alongAxis machine high))
      where
        way = Feed.wayOf machine f

-- | A feed obtained that differs from the one asked by more than this share is worth a warning.
feedSlack :: Double
feedSlack = 0.1

-- | One warning for each feed of the program that some frame does not meet, with all that its frames obtain.
feedWarnings :: Machine -> [Made] -> [Warning]
feedWarnings machine frames = [FeedDiffers region (Feed v) (Feed low) (Feed high) | ((region, Feed v), Range low high) <- Map.toList (ranges Map.empty frames), max (v - low) (high - v) > (feedSlack + Tolerance.equal) * v]
  where
    ranges found todo = case todo of
      [] -> found
      Made {asked = Nothing} : rest -> ranges found rest
      Made {asked = Just (Located region v)} : _ -> along found region v nothing Nothing todo
    -- Neighbours mostly ask the same; along the path the same code gives the same.
    along found region v range code todo = case todo of
      Made {planned, asked = Just (Located region' v')} : rest
        | region' == region && v' == v ->
          let f = frame planned
           in if alongPath && code == Just (speed f) then along found region v range code rest else along found region v (reaching range (obtained v f)) (Just (speed f)) rest
      _ -> ranges (if range == nothing then found else Map.insertWith reaching (region, v) range found) todo
    alongPath = Machine.feedMeasure (Machine.feeds machine) == AlongPath
    -- A feed that there is not is no matter of a warning.
    obtained v f =
      let way = Feed.wayOf machine f
       in case (Feed.codeFor machine v f way, Feed.given machine f way) of
            (Machine.Given _ _, Just (Feed g)) -> Range g g
            _ -> nothing

-- | From the lowest to the highest feed in mm/min.
data Range = Range Double Double
  deriving stock (Eq)

nothing :: Range
nothing = Range (1 / 0) (-(1 / 0))

reaching :: Range -> Range -> Range
reaching (Range a b) (Range c d) = Range (min a c) (max b d)

reachProblem :: Region -> Point -> Task -> Maybe Error
reachProblem fromRegion fromPoint task = case task of
  Order _ _ -> Nothing
  Run {run} -> listToMaybe (mapMaybe reachOf (NonEmpty.toList run))
  where
    reachOf m =
      let Box.Box l b r t = Box.ofSegment (segment m)
       in beyond (origin m) (Vec.point l b) <|> beyond (origin m) (Vec.point r t) <|> beyond fromRegion fromPoint
    beyond region p = if max (abs (Vec.x p)) (abs (Vec.y p)) <= limit then Nothing else Just (OutOfReach region p Tolerance.reach)
    Mm limit = Tolerance.reach

-- | More frames than a tape may have, as far as it can be seen without making them. Where the machine walks arcs they
-- are no more than the moves.
tooLong :: Machine -> [Task] -> [Error]
tooLong machine = go 0
  where
    go :: Int -> [Task] -> [Error]
    go n moves = case moves of
      [] -> []
      t : rest -> let now = n + count t in if now > mostFrames then [TooManyFrames (origin (NonEmpty.head (run t))) mostFrames] else go now rest
    count task = case Machine.arcs machine of
      Arcs {} | Pulses.isLevel machine (run task) -> 1
      _ -> Chord.frameCount mostFrames machine (Chord.rounding machine (allowed task)) (run task)

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

-- | Moves along axes that there are not, and positions that do not fit their fields; of each the first.
placeProblems :: Machine -> V3 -> [Planned] -> [Error]
placeProblems machine begin frames = take 1 missing <> take 1 beyond
  where
    missing = [NoSuchAxis (Frame.origin p) axis | not (null lacking), p <- frames, axis <- lacking, Pulses.component axis (increment (frame p)) /= 0]
    lacking = [axis | (axis, most) <- capacities, most == 0]
    beyond = case Machine.measure (Machine.layout machine) of
      Machine.Increments -> []
      Machine.Positions -> [BeyondField (Frame.origin p) axis (mm axis n) (mm axis most) | (p, at) <- zip frames (drop 1 places), (axis, most) <- fields, let n = Pulses.component axis at, abs n > most]
    places = scanl' (\at p -> at + increment (frame p)) begin frames
    fields = filter ((> 0) . snd) capacities
    capacities = [(axis, Machine.capacity machine axis) | axis <- [X, Y, Z]]
    mm axis (Pulses n) = let Mm grain = Machine.pulseOf machine axis in Mm (fromIntegral n * grain)

-- The frames --------------------------------------------------------------------------------------

-- | The frames of all tasks from a position. Commands stand in the frame of the next move, where they find room; behind
-- the last move in a frame of their own, and then what always ends a program.
framesOf :: Machine -> Region -> V3 -> [Task] -> [Made]
framesOf machine fromRegion = go Nothing fromRegion
  where
    go waiting here at tasks = case tasks of
      [] -> maybe [] (pure . alone) waiting <> ending here
      Order place told : rest ->
        let (now, waiting') = Order.add machine place (Order.numbers told) waiting
         in map alone now <> go waiting' place at rest
      task@Run {} : rest ->
        let mine = runFrames machine at task
            final = NonEmpty.last (run task)
            finish = Pulses.rounded machine (Segment.end (segment final), snd (heights final))
         in case (waiting, mine) of
              (Just w, first : more) -> ordered (given w) first : more <> go Nothing (origin final) finish rest
              _ -> mine <> go waiting (origin final) finish rest
    ordered orders m = let p = planned m in m {planned = p {frame = (frame p) {orders = orders}}}
    alone w = commanding (place w) (given w)
    commanding region orders = Made (Planned (Frame.still orders) Commanding region (Mm 0)) Nothing
    ending here = [commanding here orders | orders <- Order.atTheEnd machine]

-- | The frames of one run from where the last one ended.
runFrames :: Machine -> V3 -> Task -> [Made]
runFrames machine begin task = case task of
  Order _ _ -> []
  Run {role, tool, drive, run = m :| _} ->
    let asked = case (drive, pace m) of
          (Asked, At feed) -> Just feed
          _ -> Nothing
        go at steps = case steps of
          [] -> []
          s : rest -> case frameOf machine drive (pace m) at s of
            Just f -> Made (Planned f role (origin m) tool) asked : go (stop s) rest
            Nothing -> go (stop s) rest
     in go begin (stepsOf machine begin task)

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

-- | Where the frames of a run end and how they get there.
stepsOf :: Machine -> V3 -> Task -> [Step]
stepsOf machine begin task = case task of
  Order _ _ -> []
  Run {allowed, run} -> case Machine.arcs machine of
    Arcs {} | Pulses.isLevel machine run -> arcSteps machine begin allowed run
    _ -> [Step {stop, about = Nothing} | stop <- chordStops machine (Chord.rounding machine allowed) begin run]

-- | The steps of a run at one height on a machine that walks arcs. What the arcs along a curve are off is taken from what
-- their own steps may be off. Of several ways the one of fewest steps.
arcSteps :: Machine -> V3 -> Allowed -> NonEmpty Move -> [Step]
arcSteps machine begin allowed run = case allowed of
  Along bounds -> minimumBy (comparing length) (fmap (concat . snd . mapAccumL (partSteps bounds) begin) (Curve.ways machine bounds run))
  _ | Straight a b <- segment m -> map alone (Pulses.split machine begin ((a, level), (b, level)))
  Sagitta y -> steps (Arc.Room pulse (plus pulse y) (plus pulse y)) (Chord.rounding machine allowed) begin (segment m)
  BandOf inwards outwards -> steps (Arc.Room pulse (plus pulse inwards) (plus pulse outwards)) (Chord.rounding machine allowed) begin (segment m)
  where
    m = NonEmpty.head run
    level = fst (heights m)
    pulse = Machine.pulse machine
    steps room chordsOff = Arc.steps machine room (\at s -> chordStops machine chordsOff at (m {segment = s} :| [])) level
    partSteps bounds at part = case part of
      Curve.Chords ms -> let stops = chordStops machine (Chord.rounding machine allowed) at ms in (fromMaybe at (listToMaybe (reverse stops)), map alone stops)
      Curve.Arcs segments ->
        let left = Curve.remainder machine bounds
            ends = map (\s -> Pulses.rounded machine (Segment.end s, level)) (NonEmpty.toList segments)
            walked = zipWith (steps (Arc.Room left left left) (Sagitta (Chord.remainder machine left))) (at : ends) (NonEmpty.toList segments)
         in (fromMaybe at (listToMaybe (reverse ends)), concat walked)
    alone stop = Step {stop, about = Nothing}

-- | The stops of a run's chords.
chordStops :: Machine -> Allowed -> V3 -> NonEmpty Move -> [V3]
chordStops machine allowed begin run = concat (zipWith (Pulses.split machine) (begin : map (Pulses.rounded machine) points) (zip (first : points) points))
  where
    m = NonEmpty.head run
    first = (Segment.start (segment m), fst (heights m))
    points = Chord.ends mostFrames machine allowed run
