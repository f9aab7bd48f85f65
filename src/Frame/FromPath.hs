-- | From the path to frames for a machine without arcs: chords within the tolerance,
-- positions in whole pulses, moves split to fit their fields.
module Frame.FromPath
  ( quantise,
    chords,
    bandChords,
    chordCount,
  )
where

import Base.Quantity (Feed (..), Mm (..), Pulses (..), Rad (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Control.Applicative ((<|>))
import Data.Containers.ListUtils (nubOrd)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe, mapMaybe)
import Frame.Error (CommandKind (..), Error (..), Warning (..))
import Frame.Frame (Frame (..), Planned (Planned, frame), Program (Program), Role (..))
import Frame.Frame qualified as Frame
import Frame.Run qualified as Run
import Geometry.Box qualified as Box
import Geometry.Offset qualified as Offset
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Linear.V3 (V3 (..))
import Machine.Machine (Axis (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Command, Milling, Pace (..), Spot (..))
import Part.Part qualified as Part
import Path.FromPart qualified as Path
import Path.Path (Move (..), Path)
import Path.Path qualified as Path

-- | What becomes frames: a run of moves with its role and what is allowed to its chords, or a command.
data Task
  = Task
      { role :: Role,
        error' :: ChordError,
        tool :: Mm,
        run :: NonEmpty Move
      }
  | Order (Located Command)

-- | How far chords may be off.
data ChordError
  = -- | between points of the path
    Sagitta Mm
  | -- | so far towards the centre of an arc, and so far away from it
    BandOf Mm Mm
  | -- | along a curve
    Along Run.Bounds

-- | The frames of a path. Positions are rounded to whole pulses as absolute positions, and an increment is
-- the difference of two of them, so rounding never adds up.
quantise :: Machine -> Path -> Result Warning Error Program
quantise machine path = case problems of
  [] -> Result warnings [] (Just (Program begin planned))
  _ -> Result warnings problems Nothing
  where
    tasks = tasksOf machine path
    moves = [t | t@Task {} <- tasks]
    Located fromRegion (Spot fromPoint fromHeight) = Path.start path
    begin = rounded machine (fromPoint, fromHeight)
    planned = framesOf machine begin tasks
    warnings = nubOrd (startWarning <> mapMaybe feedWarning moves <> take 1 (mapMaybe heightWarning moves) <> byHand)
    startWarning =
      let at = Frame.position machine begin
       in [StartRounded fromRegion fromPoint at | not (Vec.near at fromPoint)]
    feedWarning task = case pace (NonEmpty.head (run task)) of
      Rapid -> Nothing
      At (Located region asked@(Feed f)) -> case Machine.chooseFeed machine asked of
        Machine.Given _ given@(Feed g) | abs (g - f) > feedSlack * f -> Just (FeedDiffers region asked given)
        _ -> Nothing
    heightWarning task = listToMaybe [HeightUnsure (origin m) | Z `notElem` Machine.driven machine, m <- NonEmpty.toList (run task), uncurry (/=) (heights m)]
    byHand = [ByHand region (kindOf c) | Order (Located region c) <- tasks, not (onTape c)]
    problems = nubOrd (mapMaybe toleranceProblem (Path.blocks path) <> mapMaybe feedProblem moves <> mapMaybe reachProblem moves <> mapMaybe commandProblem tasks <> tooLong)
    toleranceProblem block = case block of
      Path.Cutting {Path.job = Located _ job}
        | Path.touchedRadius job > Mm 0 && plus allowed (Machine.pulse machine) >= Part.radius job ->
          Just (ToleranceTooLarge (region (Part.side job)) allowed (Part.radius job))
        where
          allowed = uncurry max (Part.deepest (Part.tolerance job))
      _ -> Nothing
    commandProblem task = case task of
      Order (Located region (Part.Auxiliary n)) | n > Machine.auxiliaries machine -> Just (NoSuchCommand region n (Machine.auxiliaries machine))
      _ -> Nothing
    feedProblem task = case pace (NonEmpty.head (run task)) of
      Rapid -> Nothing
      At (Located region asked) -> case Machine.chooseFeed machine asked of
        Machine.NoSuchFeed low high -> Just (FeedMissing region asked low high)
        Machine.Given _ _ -> Nothing
    reachProblem task = listToMaybe (mapMaybe reachOf (NonEmpty.toList (run task)))
    reachOf m =
      let Box.Box l b r t = Box.ofSegment (segment m)
       in beyond (origin m) (Vec.point l b) <|> beyond (origin m) (Vec.point r t) <|> beyond fromRegion fromPoint
    beyond :: Region -> Point -> Maybe Error
    beyond region p = if max (abs (Vec.x p)) (abs (Vec.y p)) <= limit then Nothing else Just (OutOfReach region p Tolerance.reach)
    Mm limit = Tolerance.reach
    tooLong = case dropWhile ((<= mostFrames) . fst) (scanl (\(n, _) t -> (n + count t, Just t)) (0, Nothing) moves) of
      (_, Just t) : _ -> [TooManyFrames (origin (NonEmpty.head (run t))) mostFrames]
      _ -> []
    count task = frameCount machine (error' task) (run task)

-- | Whether a machine is told a command by its tape.
onTape :: Command -> Bool
onTape c = case c of
  Part.Auxiliary _ -> True
  Part.SpindleOn _ _ -> False
  Part.SpindleOff -> False
  Part.CoolantTo _ -> False
  Part.ChangeTool _ _ -> False

-- | What a command is about.
kindOf :: Command -> CommandKind
kindOf c = case c of
  Part.Auxiliary _ -> AuxiliaryCommand
  Part.SpindleOn _ _ -> SpindleCommand
  Part.SpindleOff -> SpindleCommand
  Part.CoolantTo _ -> CoolantCommand
  Part.ChangeTool _ _ -> ToolCommand

-- | A feed obtained that differs from the one asked by more than this share is worth a warning.
feedSlack :: Double
feedSlack = 0.1

-- | More frames than this are 38 km of tape.
mostFrames :: Int
mostFrames = 1000000

tasksOf :: Machine -> Path -> [Task]
tasksOf machine path = concatMap (braking machine) (concat (zipWith block numbers (Path.blocks path)))
  where
    -- How many passes along contours stand before each block.
    numbers = scanl (\n b -> case b of Path.Cutting {} -> n + 1; _ -> n) (0 :: Int) (Path.blocks path)
    straight r radius = map (Task r (Sagitta (Mm 0)) radius . (:| []))
    block n b = case b of
      Path.Travelling radius ms -> straight Travelling radius ms
      Path.Holing (Located _ d) ms -> straight Drilling (Part.drillRadius d) ms
      Path.Commanding c -> [Order c]
      Path.Cutting {Path.job = Located _ job, Path.approach = before, Path.cut = along, Path.retract = after} ->
        concat [led (Approaching n) job before, led (Cutting n) job (NonEmpty.toList along), led (Retracting n) job after]
    led r job = map (\ms -> Task r (allowedOn machine job ms) (Part.radius job) ms) . Path.runs

-- | What is allowed to the chords of a run.
allowedOn :: Machine -> Milling -> NonEmpty Move -> ChordError
allowedOn machine job ms
  | Path.isCurve ms = Along (curveBounds machine job)
  | otherwise = chordError job (segment (NonEmpty.head ms))

-- | How far a curve may lie from its chords: a chord that runs inside of the material has the curve on the cutter's
-- side. What the arcs are off from the curve is taken from it first. Heights are as exact as the chords, or to a pulse.
curveBounds :: Machine -> Milling -> Run.Bounds
curveBounds machine job = Run.Bounds {Run.left = l, Run.right = r, Run.rise = max pulse (min l r), Run.shortest = pulse}
  where
    pulse = Machine.pulse machine
    (l, r) = case (Part.tolerance job, Path.leadingSide job) of
      (Part.OnPath d, _) -> (less d, less d)
      (Part.Band a b, Right (Just Offset.LeftOf)) -> (less a, less b)
      (Part.Band a b, Right (Just Offset.RightOf)) -> (less b, less a)
      (Part.Band a b, _) -> let d = if a > Mm 0 && b > Mm 0 then min a b else max a b in (less d, less d)
    less d = max (Mm 0) (minus d Tolerance.curve)

-- | The chord error of a segment: on the side of the material its own, and on the other one.
chordError :: Milling -> Segment -> ChordError
chordError job s = case (Part.tolerance job, s) of
  (Part.OnPath d, _) -> Sagitta d
  (Part.Band a b, Straight _ _) -> Sagitta (max a b)
  (Part.Band a b, Arc {sweep = Rad angle}) -> case Path.leadingSide job of
    -- The centre of an arc lies on the left when it is walked counter-clockwise; the material lies on the
    -- side on which the cutter is not.
    Right (Just side)
      | (angle > 0) == (side == Offset.LeftOf) -> BandOf b a
      | otherwise -> BandOf a b
    _ -> Sagitta (if a > Mm 0 && b > Mm 0 then min a b else max a b)

-- | A run that slows down at its end becomes two: the last stretch, @L = v² / 2a@, runs at the lowest feed.
braking :: Machine -> Task -> [Task]
braking machine task = case task of
  Task {run = ms}
    | braked (NonEmpty.last ms),
      At (Located region asked) <- pace (NonEmpty.head ms),
      Machine.Given _ (Feed v) <- Machine.chooseFeed machine asked ->
      let slow = At (Located region (snd (Machine.slowest machine)))
          (front, tail') = cutBefore ((v / 60) ** 2 / (2 * Machine.deceleration machine)) (reverse (NonEmpty.toList ms))
       in [task {run = part} | Just part <- [NonEmpty.nonEmpty (reverse front)]]
            <> [task {run = fmap (\m -> m {pace = slow}) part} | Just part <- [NonEmpty.nonEmpty (reverse tail')]]
  _ -> [task]

-- | Moves, the last one first, cut so many mm before their end.
cutBefore :: Double -> [Move] -> ([Move], [Move])
cutBefore stretch ms = case ms of
  [] -> ([], [])
  m : before
    | stretch >= l -> (m :) <$> cutBefore (stretch - l) before
    | otherwise -> (m {segment = front, heights = (fst (heights m), z)} : before, [m {segment = tail', heights = (z, snd (heights m))}])
    where
      Mm l = Segment.length (segment m)
      (front, tail') = Segment.cutAt (1 - stretch / l) (segment m)
      z = heightAt (1 - stretch / l) m

-- | The height at a fraction of a move.
heightAt :: Double -> Move -> Mm
heightAt t m
  | t >= 1 = snd (heights m)
  | otherwise = plus (fst (heights m)) (times t (minus (snd (heights m)) (fst (heights m))))

-- | The nearest whole number of pulses; half a pulse goes up.
rounded :: Machine -> (Point, Mm) -> V3 Pulses
rounded machine (p, Mm z) = V3 (pulses (Vec.x p)) (pulses (Vec.y p)) (pulses z)
  where
    Mm step = Machine.pulse machine
    pulses x = Pulses (floor (x / step + 0.5))

-- | The frames of all tasks from a position. A command stands in the frame of the next move; before another
-- command, and behind the last move, in a frame of its own.
framesOf :: Machine -> V3 Pulses -> [Task] -> [Planned]
framesOf machine = go Nothing
  where
    go waiting begin tasks = case tasks of
      [] -> maybe [] (pure . alone) waiting
      Order c : rest -> case value c of
        Part.Auxiliary n -> maybe [] (pure . alone) waiting <> go (Just (n, region c)) begin rest
        _ -> go waiting begin rest
      task@Task {} : rest ->
        let mine = moveFrames machine begin task
            finish = let final = NonEmpty.last (run task) in rounded machine (Segment.end (segment final), snd (heights final))
         in case (waiting, mine) of
              (Just (n, _), p : more) -> p {frame = (frame p) {auxiliary = n}} : more <> go Nothing finish rest
              _ -> mine <> go waiting finish rest
    alone (n, region) = Planned Frame {increment = 0, speed = FeedCode 0, auxiliary = n} Commanding region (Mm 0)

-- | The frames of one run from where the last one ended.
moveFrames :: Machine -> V3 Pulses -> Task -> [Planned]
moveFrames machine begin task = case task of
  Order _ -> []
  Task {role, error', tool, run} -> filter ((/= 0) . increment . frame) (zipWith planned (begin : stops) stops)
    where
      m = NonEmpty.head run
      stops = concat (zipWith (split machine) (begin : map (rounded machine) points) (zip ((Segment.start (segment m), fst (heights m)) : points) points))
      points = chordPoints machine error' run
      planned a b = Planned Frame {increment = b - a, speed = speedOf machine (pace m), auxiliary = 0} role (origin m) tool

-- | The ends of the chords of a run with their heights.
chordPoints :: Machine -> ChordError -> NonEmpty Move -> [(Point, Mm)]
chordPoints machine allowed ms = case allowed of
  Sagitta y -> alone (chords machine y)
  BandOf toward away -> alone (bandChords machine toward away)
  Along bounds -> Run.chordEnds mostFrames bounds ms
  where
    m = NonEmpty.head ms
    alone chordsOf = let ends = chordsOf (segment m) in zip ends [heightAt (fromIntegral k / fromIntegral (length ends)) m | k <- [1 .. length ends]]

speedOf :: Machine -> Pace -> FeedCode
speedOf machine pace = case pace of
  Rapid -> Machine.rapidCode machine
  At (Located _ asked) -> case Machine.chooseFeed machine asked of
    Machine.Given code _ -> code
    Machine.NoSuchFeed _ _ -> Machine.rapidCode machine

-- | The stops of a straight move, given the position where it begins in pulses and its exact ends:
-- equal parts, each rounded by itself, as few as fit into the fields.
split :: Machine -> V3 Pulses -> ((Point, Mm), (Point, Mm)) -> [V3 Pulses]
split machine begin ((a, za), (b, zb)) = head' (filter fits (map parts [fewest ..]))
  where
    finish = rounded machine (b, zb)
    fewest = maximum (1 : [needed axis d | (axis, d) <- axes (finish - begin)])
    needed axis (Pulses d) = let Pulses c = Machine.capacity machine axis in if d == 0 then 1 else (abs d + c - 1) `div` c
    parts n = [rounded machine (Vec.between t a b, plus za (times t (minus zb za))) | k <- [1 .. n - 1], let { t = fromIntegral k / fromIntegral n }] <> [finish]
    fits stops = and [abs d <= Machine.capacity machine axis | step <- zipWith (-) stops (begin : stops), (axis, d) <- axes step]
    axes (V3 x y z) = [(axis, d) | (axis, d) <- [(X, x), (Y, y), (Z, z)], d /= 0]
    head' xs = case xs of
      x : _ -> x
      [] -> [finish]

-- | The ends of the chords of a segment, the last one its end: equal steps that stay within
-- the sagitta, @Δφ = 2·arccos(1 − y/R) = 4·arcsin √(y/2R)@ (Ural paper; R is the radius of the path),
-- none longer than a quarter turn.
chords :: Machine -> Mm -> Segment -> [Point]
chords machine sagitta segment = [Segment.at (fromIntegral k / fromIntegral n) segment | k <- [1 .. n]]
  where
    n = chordCount machine sagitta segment

-- | The ends of the chords of a segment within a band: so far towards the centre of an arc, so far away from
-- it. Between its ends, which lie on the arc, the corners lie on the outer edge of the band, @ρ = R + δ₂@, and
-- the chords touch its inner edge: @cos(Δφ/2) = (R − δ₁)/ρ@.
bandChords :: Machine -> Mm -> Mm -> Segment -> [Point]
bandChords machine toward away s = case s of
  Straight _ b -> [b]
  Arc {start = p, centre, sweep = Rad angle}
    | away <= Mm 0 -> chords machine toward s
    | 2 * leave >= abs angle && abs angle <= pi / 2 -> [Segment.end s]
    | otherwise -> [corner (first + fromIntegral k * step) | k <- [0 .. count]] <> [Segment.end s]
    where
      Mm r = Segment.radius centre p
      inner = max 0 (let Mm d = toward in r - d)
      outer = let Mm d = away in r + d
      -- From an end of the arc to where its chord touches the inner edge, and on to the outer one.
      leave = acos (inner / r)
      first' = min (pi / 4) (leave + acos (inner / outer))
      widest = max (2 * asin (min 1 (let Mm pulse = Machine.pulse machine in pulse / (2 * r)))) (min (pi / 2) (2 * acos (inner / outer)))
      count = max 0 (ceiling ((abs angle - 2 * first') / widest - 1e-9)) :: Int
      first = if count == 0 then abs angle / 2 else first'
      step = if count == 0 then 0 else (abs angle - 2 * first) / fromIntegral count
      corner a = Vec.shift (Vec.scale (outer / r) (Vec.rotate (Rad (signum angle * a)) (Vec.to centre p))) centre

-- | How many frames a run needs, or one less for each chord: its chords, each split to fit the fields of a frame.
-- Chords of a curve are counted as far as it matters.
frameCount :: Machine -> ChordError -> NonEmpty Move -> Int
frameCount machine allowed ms = case allowed of
  Sagitta y -> alone y
  BandOf a b -> alone (max a b)
  Along bounds ->
    let ends = map fst (take (mostFrames + 1) (Run.chordEnds mostFrames bounds ms))
     in sum (zipWith (\p q -> parts (let Mm d = Vec.distance p q in d)) (Segment.start only : ends) ends)
  where
    only = segment (NonEmpty.head ms)
    alone y = let n = chordCount machine y only; Mm l = Segment.length only in n * parts (l / fromIntegral n)
    parts l = max 1 (ceiling (l / (fromIntegral field * pulse)))
    Mm pulse = Machine.pulse machine
    Pulses field = max 1 (minimum [Machine.capacity machine axis | axis <- [X, Y]])

-- | How many chords a segment needs. Chords shorter than a pulse serve nobody.
chordCount :: Machine -> Mm -> Segment -> Int
chordCount machine (Mm y) segment = case segment of
  Straight _ _ -> 1
  Arc {start = p, centre, sweep = Rad angle} ->
    let Mm r = Segment.radius centre p
        step = min (pi / 2) (4 * asin (min 1 (sqrt (y / (2 * r)))))
        wanted = ceiling (abs angle / step - almost) :: Int
        Mm l = Segment.length segment
        Mm pulse = Machine.pulse machine
        sensible = ceiling (l / pulse)
     in max 1 (if step * r < pulse then sensible else wanted)
  where
    -- A step that fits a whole number of times is not to need one more for rounding.
    almost = 1e-9
