-- | From the path to frames for a machine without arcs: chords within the tolerance,
-- positions in whole pulses, moves split to fit their fields.
module Frame.FromPath
  ( quantise,
    chords,
    chordCount,
  )
where

import Base.Quantity (Feed (..), Mm (..), Pulses (..), Rad (..), plus)
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Control.Applicative ((<|>))
import Data.Containers.ListUtils (nubOrd)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Frame.Error (Error (..), Warning (..))
import Frame.Frame (Frame (..), Planned (Planned, frame), Program (Program), Role (..))
import Frame.Frame qualified as Frame
import Geometry.Box qualified as Box
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Linear.V3 (V3 (..))
import Machine.Machine (Axis (..), FeedCode, Machine)
import Machine.Machine qualified as Machine
import Part.Part (Pace (..))
import Part.Part qualified as Part
import Path.Path (Move (..), Path)
import Path.Path qualified as Path

-- | A move with its role and the chord error allowed on it.
data Task = Task {role :: Role, sagitta :: Mm, move :: Move}

-- | The frames of a path. Positions are rounded to whole pulses as absolute positions, and an increment is
-- the difference of two of them, so rounding never adds up.
quantise :: Machine -> Path -> Result Warning Error Program
quantise machine path = case problems of
  [] -> Result warnings [] (Just (Program begin planned))
  _ -> Result warnings problems Nothing
  where
    tasks = tasksOf path
    from = Path.start path
    begin = rounded machine (value from)
    planned = concat (zipWith (framesOf machine) (begin : map (rounded machine . Segment.end . segment . move) tasks) tasks)
    warnings = nubOrd (startWarning <> mapMaybe feedWarning tasks)
    startWarning =
      let at = Frame.position machine begin
       in [StartRounded (region from) (value from) at | not (Vec.near at (value from))]
    feedWarning task = case pace (move task) of
      Rapid -> Nothing
      At (Located region asked@(Feed f)) -> case Machine.chooseFeed machine asked of
        Machine.Given _ given@(Feed g) | abs (g - f) > feedSlack * f -> Just (FeedDiffers region asked given)
        _ -> Nothing
    problems = nubOrd (mapMaybe toleranceProblem (Path.blocks path) <> mapMaybe feedProblem tasks <> mapMaybe reachProblem tasks <> tooLong)
    toleranceProblem block = case block of
      Path.Cutting {Path.job = Located _ job}
        | value (Part.side job) /= Part.On && plus (Part.tolerance job) (Machine.pulse machine) >= Part.radius job ->
          Just (ToleranceTooLarge (region (Part.side job)) (Part.tolerance job) (Part.radius job))
      _ -> Nothing
    feedProblem task = case pace (move task) of
      Rapid -> Nothing
      At (Located region asked) -> case Machine.chooseFeed machine asked of
        Machine.NoSuchFeed low high -> Just (FeedMissing region asked low high)
        Machine.Given _ _ -> Nothing
    reachProblem task =
      let Box.Box l b r t = Box.ofSegment (segment (move task))
       in beyond (origin (move task)) (Vec.point l b) <|> beyond (origin (move task)) (Vec.point r t) <|> beyond (region from) (value from)
    beyond :: Region -> Point -> Maybe Error
    beyond region p = if max (abs (Vec.x p)) (abs (Vec.y p)) <= limit then Nothing else Just (OutOfReach region p Tolerance.reach)
    Mm limit = Tolerance.reach
    tooLong = case dropWhile ((<= mostFrames) . fst) (scanl (\(n, _) t -> (n + count t, Just t)) (0, Nothing) tasks) of
      (_, Just t) : _ -> [TooManyFrames (origin (move t)) mostFrames]
      _ -> []
    count task = frameCount machine (sagitta task) (segment (move task))

-- | A feed obtained that differs from the one asked by more than this share is worth a warning.
feedSlack :: Double
feedSlack = 0.1

-- | More frames than this are 38 km of tape.
mostFrames :: Int
mostFrames = 1000000

tasksOf :: Path -> [Task]
tasksOf path = concat (zipWith block numbers (Path.blocks path))
  where
    -- How many milling statements stand before each block.
    numbers = scanl (\n b -> case b of Path.Cutting {} -> n + 1; Path.Travelling _ -> n) (0 :: Int) (Path.blocks path)
    straight r = map (Task r (Mm 0))
    block n b = case b of
      Path.Travelling ms -> straight Travelling ms
      Path.Cutting job before along after ->
        straight (Approaching n) before
          <> map (Task (Cutting n) (Part.tolerance (value job))) (NonEmpty.toList along)
          <> straight (Retracting n) after

-- | The nearest whole number of pulses; half a pulse goes up.
rounded :: Machine -> Point -> V3 Pulses
rounded machine p = V3 (pulses (Vec.x p)) (pulses (Vec.y p)) 0
  where
    Mm step = Machine.pulse machine
    pulses x = Pulses (floor (x / step + 0.5))

-- | The frames of one move from where the last one ended.
framesOf :: Machine -> V3 Pulses -> Task -> [Planned]
framesOf machine begin task = filter ((/= 0) . increment . frame) (zipWith planned (begin : stops) stops)
  where
    stops = concat (zipWith (split machine) (begin : map (rounded machine) points) points')
    points = chords machine (sagitta task) (segment (move task))
    points' = zip (Segment.start (segment (move task)) : points) points
    planned a b =
      let f = Frame {increment = b - a, speed = speedOf machine (pace (move task)), auxiliary = 0}
       in Planned f (role task) (origin (move task))

speedOf :: Machine -> Pace -> FeedCode
speedOf machine pace = case pace of
  Rapid -> Machine.rapidCode machine
  At (Located _ asked) -> case Machine.chooseFeed machine asked of
    Machine.Given code _ -> code
    Machine.NoSuchFeed _ _ -> Machine.rapidCode machine

-- | The stops of a straight move, given the position where it begins in pulses and its exact ends:
-- equal parts, each rounded by itself, as few as fit into the fields.
split :: Machine -> V3 Pulses -> (Point, Point) -> [V3 Pulses]
split machine begin (a, b) = head' (filter fits (map parts [fewest ..]))
  where
    finish = rounded machine b
    fewest = maximum (1 : [needed axis d | (axis, d) <- axes (finish - begin)])
    needed axis (Pulses d) = let Pulses c = Machine.capacity machine axis in if d == 0 then 1 else (abs d + c - 1) `div` c
    parts n = [rounded machine (Vec.between (fromIntegral k / fromIntegral n) a b) | k <- [1 .. n - 1]] <> [finish]
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

-- | How many frames a segment needs, or one less for each chord: its chords, each split to fit the fields of a frame.
frameCount :: Machine -> Mm -> Segment -> Int
frameCount machine sagitta segment = n * max 1 (ceiling (l / fromIntegral n / (fromIntegral field * pulse)))
  where
    n = chordCount machine sagitta segment
    Mm l = Segment.length segment
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
