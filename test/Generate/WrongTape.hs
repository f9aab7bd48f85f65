-- | Tapes with damage: frames in which something was left out, exchanged, shifted or replaced, as
-- if somebody had changed the positions of the tape with a text editor.
--
-- A tape is changed as a list of /stations/: the positions at the ends of the frames, with what the
-- frames say of the way there. All other positions stay, so that only the changed motions differ.
module Generate.WrongTape
  ( Damage (..),
    damages,
    damaged,
    withFrameCount,
    withOtherCommands,
    commandsApart,
    difference,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Control.Monad (mfilter)
import Control.Motion qualified as Control
import Data.Function (on)
import Data.List (groupBy)
import Data.Map.Strict qualified as Map
import Frame.Frame (Frame (..), FrameMotion (..), FrameProgram, PlannedFrame)
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Test.QuickCheck

-- | The end of a frame, in pulses, and the frame with its role. The centre of an arc is a position.
data Station = Station {at :: Pulses3, centreAt :: Pulses2, made :: PlannedFrame}

-- | A kind of damage.
data Damage = Damage {name :: String, change :: Machine -> [Station] -> Gen [Station]}

-- | The frames of a program as stations.
stationsOf :: FrameProgram -> [Station]
stationsOf program = zipWith3 station starts (drop 1 starts) planned
  where
    planned = Frame.plannedFrames program
    starts = scanl (+) (Frame.start program) (map (increment . Frame.frame) planned)
    station (Pulses3 x y _) end p =
      let Pulses2 i j = centre (Frame.frame p) in Station end (Pulses2 (x + i) (y + j)) p

-- | The frames through stations from a position.
framesThrough :: Pulses3 -> [Station] -> [PlannedFrame]
framesThrough begin stations =
  [ (made s) {Frame.frame = f}
    | (from, s) <- zip (begin : map at stations) stations,
      f <- frameTo from s
  ]

-- | The frame from a position to a station. None if it does not move any more, unless it has
-- commands.
frameTo :: Pulses3 -> Station -> [Frame]
frameTo from@(Pulses3 x y _) s
  | motion f == NoMotion = [f]
  | d == 0 && not isCircle = [Frame.commandFrame (commands f) | not (null (commands f))]
  | isCircle = [f {increment = d, centre = Pulses2 (i - x) (j - y)}]
  | otherwise = [f {increment = d}]
  where
    f = Frame.frame (made s)
    d = at s - from
    Pulses2 i j = centreAt s
    isCircle = case motion f of
      Circular _ -> True
      _ -> False

-- | A damaged tape of a program: the name of the damage, and the frames with their cutters.
-- @isClearing@ is true of the number of a pass that clears a pocket: its motions may come twice.
damaged :: Machine -> (Int -> Bool) -> FrameProgram -> Gen (String, [PlannedFrame])
damaged machine isClearing program = do
  d <- elements (damages isClearing)
  stations <- change d machine (stationsOf program)
  pure (name d, framesThrough (Frame.start program) stations)

-- | A tape that makes the same motions in @wanted@ frames, or in a count as near to it as possible.
-- Lines are divided in the middle, or two lines are joined that follow one another in the same
-- direction, at the same speed.
withFrameCount :: Int -> [PlannedFrame] -> Gen [PlannedFrame]
withFrameCount wanted frames = case compare (length frames) wanted of
  EQ -> pure frames
  LT -> changedAt [i | (i, p) <- zip [0 ..] frames, isLong p] divide
  GT -> changedAt [i | (i, (p, q)) <- zip [0 ..] (zip frames (drop 1 frames)), goesOn p q] join
  where
    changedAt places edit
      | null places = pure frames
      | otherwise = do
        i <- elements places
        withFrameCount wanted (take i frames <> edit (drop i frames))
    isLong p = isLine p && maximum (map abs (components p)) > 20
    isLine p = motion (Frame.frame p) == Linear && null (commands (Frame.frame p))
    goesOn p q =
      isLine p && isLine q && speed p == speed q && isSameDirection (components p) (components q)
    speed p = (feedCode (Frame.frame p), braking (Frame.frame p))
    isSameDirection u v =
      sum (zipWith (*) u v) > 0 && and [a * e == b * d | (a, d) <- zip u v, (b, e) <- zip u v]
    divide list = case list of
      p : more ->
        let half = Pulses3 (Pulses a) (Pulses b) (Pulses c)
            (a, b, c) = case map (`div` 2) (components p) of
              [x, y, z] -> (x, y, z)
              _ -> (0, 0, 0)
         in along half p : along (increment (Frame.frame p) - half) p : more
      [] -> []
    join list = case list of
      p : q : more -> along (increment (Frame.frame p) + increment (Frame.frame q)) p : more
      _ -> list
    along d p = p {Frame.frame = (Frame.frame p) {increment = d}}
    components p =
      let Pulses3 (Pulses a) (Pulses b) (Pulses c) = increment (Frame.frame p) in [a, b, c]

-- | A tape with the same motions, on which some commands are left out, repeated, moved to another
-- frame, or exchanged with those of another frame.
withOtherCommands :: FrameProgram -> Gen (String, [PlannedFrame])
withOtherCommands program = case [k | (k, p) <- zip [0 ..] frames, hasCommands p] of
  [] -> discard
  places -> do
    k <- elements places
    far <- choose (0, length frames)
    near <- choose (max 0 (k - 4), min (length frames) (k + 4))
    other <- elements places
    let given = commandsAt k
    elements
      [ ("a command left out", without k),
        ("a command repeated", inserted far given frames),
        ("a command in another place", moved k far given),
        ("a command some frames away", moved k near given),
        ("commands exchanged", setAt other given (setAt k (commandsAt other) frames))
      ]
  where
    frames = Frame.plannedFrames program
    hasCommands = not . null . commands . Frame.frame
    commandsAt k = concat [commands (Frame.frame p) | p <- take 1 (drop k frames)]
    without k = filter (isUsed . Frame.frame) (setAt k [] frames)
    isUsed f = Frame.isMoving f || not (null (commands f))
    setAt k given list =
      [ if n == k then p {Frame.frame = (Frame.frame p) {commands = given}} else p
        | (n, p) <- zip [0 ..] list
      ]
    moved k to given =
      let fewer = length frames - length (without k)
       in inserted (if to > k then to - fewer else to) given (without k)
    -- Some tapes can hold commands beside a motion, others in a frame of their own.
    inserted n given list = case splitAt n list of
      (a, p : b)
        | not (hasCommands p) && even n ->
          a <> [p {Frame.frame = (Frame.frame p) {commands = given}}] <> b
      (a, b) -> a <> [p {Frame.frame = Frame.commandFrame given} | p <- take 1 list] <> b

-- | Test that two tapes with the same motions surely have other commands: commands are missing or
-- repeated, or more than @slack@ mm of the path lie between the positions of a command.
commandsApart :: Machine -> Double -> Pulses3 -> [Frame] -> [Frame] -> Bool
commandsApart machine slack begin one other =
  Map.keys ones /= Map.keys others || or (Map.intersectionWith isApart ones others)
  where
    (ones, others) = (travelsTo one, travelsTo other)
    isApart as bs = length as /= length bs || or (zipWith (\a b -> abs (a - b) > slack) as bs)
    travelsTo frames =
      Map.fromListWith
        (flip (<>))
        [(show c, [at']) | (f, at') <- zip frames (travels frames), c <- commands f]
    -- Length of the path before each frame.
    travels frames = scanl (+) 0 (map lengthOf (motionsOf begin frames))
    motionsOf from frames = case frames of
      [] -> []
      f : more
        | Frame.isMoving f -> Control.run from [f] : motionsOf (from + increment f) more
        | otherwise -> [] : motionsOf from more
    lengthOf motions =
      sum [spaceLength m | m <- motions]
    spaceLength m =
      let Mm l = Control.travel machine m
          (Mm z, Mm z') = Control.height machine m
       in sqrt (l * l + (z' - z) * (z' - z))

-- Kinds of damage ---------------------------------------------------------------------------------

-- | All kinds of damage.
damages :: (Int -> Bool) -> [Damage]
damages isClearing =
  [ Damage "a motion left out" (onMoving (\_ a _ b -> pure (a <> b))),
    Damage "a vertical motion left out" (onSome isVertical (\_ a _ b -> pure (a <> b))),
    Damage "a lift left out" (onSome isLift (\_ a _ b -> pure (a <> b))),
    Damage "a plunge or peck left out" (onSome isPlunge (\_ a _ b -> pure (a <> b))),
    Damage "a linking move left out" (onSome isLink (\_ a _ b -> pure (a <> b))),
    Damage "two motions left out" (onMoving (\_ a _ b -> pure (a <> drop 1 b))),
    Damage
      "a motion made, undone and made again"
      (onSome (\_ s -> not (any (isClearing . fst) (passOf s))) doubledBack),
    Damage "two neighbouring motions exchanged" (onMoving exchanged),
    Damage "a run of motions reversed" reversedRun,
    Damage "a height that comes one motion late" (onMoving lateHeight),
    Damage "a position in the plane that comes one motion late" (onMoving latePlane),
    Damage "a height that comes one motion early" (onMoving earlyHeight),
    Damage "a position shifted" (onMoving (shifted 1)),
    Damage "a run of positions shifted" (onMoving (shifted 6)),
    Damage "all later positions shifted" (onMoving (shifted maxBound)),
    Damage "a motion lowered" (onMoving (raised (-1) 1)),
    Damage "a motion raised" (onMoving (raised 1 1)),
    Damage "a run of motions lowered" (onMoving (raised (-1) 6)),
    Damage "a run of motions raised" (onMoving (raised 1 6)),
    Damage "a run of motions tilted" (onMoving tilted),
    Damage "another feed" (onSome isAtFeed otherFeed),
    Damage "rapid in place of a feed" (onSome isAtFeed madeRapid),
    Damage "a feed in place of rapid" (onSome isRapid madeSlow),
    Damage "an arc made a line" (onSome isArc (\_ a s b -> pure (a <> [straight s] <> b))),
    Damage
      "an arc in the other direction"
      (onSome isArc (\_ a s b -> pure (a <> [turnedBack s] <> b))),
    Damage "a centre moved" (onSome isArc movedCentre),
    Damage "a motion replaced by another one" (onMoving replaced),
    Damage "a detour" (onMoving detour),
    Damage "x and y of a position exchanged" (onMoving swappedAxes),
    Damage "a run of positions mirrored" (onMoving mirroredRun),
    Damage "passes exchanged" (\_ s -> exchangedGroups passOf s),
    Damage
      "a pass along a contour repeated"
      (\_ s -> repeatedGroup (\w -> mfilter (not . isClearing . fst) (passOf w)) s),
    Damage "a pass left out" (\_ s -> leftOutGroup passOf s),
    Damage "holes exchanged" (\_ s -> exchangedGroups holeOf s),
    Damage "a hole repeated" (\_ s -> repeatedGroup holeOf s),
    Damage "a hole left out" (\_ s -> leftOutGroup holeOf s),
    Damage "two runs of motions exchanged" exchangedRuns
  ]

-- | A change of a tape on a machine.
type Change = Machine -> [Station] -> Gen [Station]

-- | A change at one station: it gets the stations before, the station, and those after it.
type Edit = Machine -> [Station] -> Station -> [Station] -> Gen [Station]

-- | A change of one station for which the test is true: it gets the stations before, the station
-- and those after it. Discards tapes without such a station.
onSome ::
  (Station -> Station -> Bool) ->
  Edit ->
  Change
onSome test with machine stations = case candidates of
  [] -> discard
  _ -> do
    k <- elements candidates
    case splitAt k stations of
      (a, s : b) -> with machine a s b
      _ -> discard
  where
    candidates =
      [k | (k, before, s) <- zip3 [1 ..] stations (drop 1 stations), isMoving s, test before s]

onMoving :: Edit -> Change
onMoving = onSome (\_ _ -> True)

isMoving :: Station -> Bool
isMoving = Frame.isMoving . Frame.frame . made

isVertical, isLift, isPlunge, isLink, isAtFeed, isRapid, isArc :: Station -> Station -> Bool
isVertical before s = plane before == plane s && heightOf before /= heightOf s
isLift before s = isVertical before s && heightOf before < heightOf s
isPlunge before s = isVertical before s && heightOf before > heightOf s
isLink _ s = case Frame.role (made s) of
  Frame.Approaching _ -> True
  Frame.Retracting _ -> True
  Frame.Linking -> True
  Frame.Drilling _ -> True
  Frame.Carving _ -> True
  Frame.Cutting _ -> False
  Frame.Commanding -> False
isAtFeed _ s = motionOf s /= Rapid
isRapid _ s = motionOf s == Rapid
isArc _ s = case motionOf s of
  Circular _ -> True
  _ -> False

motionOf :: Station -> FrameMotion
motionOf = motion . Frame.frame . made

plane :: Station -> (Pulses, Pulses)
plane s = let Pulses3 x y _ = at s in (x, y)

heightOf :: Station -> Pulses
heightOf s = let Pulses3 _ _ z = at s in z

withFrame :: (Frame -> Frame) -> Station -> Station
withFrame f s = s {made = (made s) {Frame.frame = f (Frame.frame (made s))}}

-- | A station moved with its centre.
movedBy :: Pulses3 -> Station -> Station
movedBy d@(Pulses3 dx dy _) s =
  let Pulses2 i j = centreAt s in s {at = at s + d, centreAt = Pulses2 (i + dx) (j + dy)}

doubledBack, exchanged, lateHeight, latePlane, earlyHeight, tilted :: Edit
doubledBack _ a s b = case reverse a of
  before : _ -> pure (a <> [s, straight s {at = at before}, s] <> b)
  [] -> discard
exchanged _ a s b = case b of
  next : more -> pure (a <> [next, s] <> more)
  [] -> discard
lateHeight _ a s b = case reverse a of
  before : _
    | heightOf before /= heightOf s ->
      pure (a <> [s {at = withHeight (heightOf before) s}] <> b)
  _ -> discard
latePlane _ a s b = case reverse a of
  before : _
    | plane before /= plane s,
      (x, y) <- plane before ->
      pure (a <> [s {at = Pulses3 x y (heightOf s)}] <> b)
  _ -> discard
earlyHeight _ a s b = case b of
  next : _ | heightOf next /= heightOf s -> pure (a <> [s {at = withHeight (heightOf next) s}] <> b)
  _ -> discard
tilted machine a s b = do
  n <- choose (2, 6)
  let (run, rest) = splitAt n (s : b)
  step <- zPulses machine 1
  let raise k = movedBy (Pulses3 0 0 (step * fromIntegral (k :: Int)))
  pure (a <> zipWith raise [1 ..] run <> rest)

withHeight :: Pulses -> Station -> Pulses3
withHeight z s = let (x, y) = plane s in Pulses3 x y z

-- | Shifts some stations in the plane by 0.3 to 30 mm.
shifted :: Int -> Edit
shifted n machine a s b = do
  d <- planePulses machine
  let (run, rest) = splitAt n (s : b)
  pure (a <> map (movedBy d) run <> rest)

raised :: Int -> Int -> Edit
raised sense n machine a s b = do
  d <- zPulses machine sense
  let (run, rest) = splitAt n (s : b)
  pure (a <> map (movedBy (Pulses3 0 0 d)) run <> rest)

-- | A random shift in the plane.
planePulses :: Machine -> Gen Pulses3
planePulses machine = do
  l <- oneof [choose (0.3, 2), choose (2, 30 :: Double)]
  angle <- choose (0, 2 * pi)
  let pulses axis v = let Mm p = Machine.resolutionOf machine axis in Pulses (round (v / p))
  pure (Pulses3 (pulses Machine.X (l * cos angle)) (pulses Machine.Y (l * sin angle)) 0)

-- | A random height in the given direction, in pulses.
zPulses :: Machine -> Int -> Gen Pulses
zPulses machine sense = do
  l <- oneof [choose (0.3, 2), choose (2, 10 :: Double)]
  let Mm p = Machine.resolutionOf machine Machine.Z
  pure (Pulses (sense * round (l / p)))

otherFeed, madeRapid, madeSlow, movedCentre, replaced, detour, swappedAxes, mirroredRun :: Edit
otherFeed machine a s b = do
  c <- elements codes
  pure (a <> [withFrame (\f -> f {feedCode = c}) s] <> b)
  where
    codes = case Machine.codes (Machine.feeds machine) of
      Machine.Listed table -> Map.keys table
      Machine.Direct low high -> map FeedCode [low, (low + high) `div` 2, high]
madeRapid machine a s b
  | Machine.hasRapidMotion machine =
    pure (a <> [withFrame rapid s] <> b)
  | otherwise =
    pure (a <> [withFrame (\f -> f {feedCode = Machine.rapidCode machine}) s] <> b)
  where
    rapid f = f {motion = Rapid, feedCode = FeedCode 0, centre = 0, braking = False}
madeSlow machine a s b =
  pure (a <> [withFrame slow s] <> b)
  where
    slow f = f {motion = Linear, feedCode = fst (Machine.slowest machine)}
movedCentre machine a s b = do
  Pulses3 dx dy _ <- planePulses machine
  let Pulses2 i j = centreAt s
  pure (a <> [s {centreAt = Pulses2 (i + dx) (j + dy)}] <> b)
replaced machine a s b = do
  d <- planePulses machine
  z <- zPulses machine 1
  sense <- elements [-1, 1]
  let Pulses3 x y _ = d
  pure (a <> [straight s {at = at s + Pulses3 (x * 3) (y * 3) (z * sense)}] <> b)
detour machine a s b = do
  d <- planePulses machine
  pure (a <> [straight s {at = at s + d}, s] <> b)
swappedAxes _ a s b = pure (a <> [straight s {at = Pulses3 y x (heightOf s)}] <> b)
  where
    (x, y) = plane s
mirroredRun _ a s b = do
  n <- choose (1, 5)
  let (run, rest) = splitAt n (s : b)
      (x0, _) = plane s
      mirror r = let (x, y) = plane r in straight r {at = Pulses3 (2 * x0 - x) y (heightOf r)}
  pure (a <> map mirror run <> rest)

-- | A station that a straight line leads to.
straight :: Station -> Station
straight s = case motionOf s of
  Circular _ -> withFrame (\f -> f {motion = Linear, centre = 0}) s
  _ -> s

-- | A station that the arc in the other direction leads to.
turnedBack :: Station -> Station
turnedBack = withFrame $ \f -> case motion f of
  Circular Clockwise -> f {motion = Circular CounterClockwise}
  Circular CounterClockwise -> f {motion = Circular Clockwise}
  _ -> f

-- | Two to six stations in the opposite order, with straight lines.
reversedRun :: Change
reversedRun = onMoving $ \_ a s b -> do
  n <- choose (2, 6)
  let (run, rest) = splitAt n (s : b)
  pure (a <> map straight (reverse run) <> rest)

-- | Two runs of stations that follow one another, exchanged.
exchangedRuns :: Change
exchangedRuns = onMoving $ \_ a s b -> do
  n <- choose (1, 8)
  k <- choose (1, 8)
  let (one, others) = splitAt n (s : b)
      (two, rest) = splitAt k others
  pure (a <> map straight two <> map straight one <> rest)

-- Groups ------------------------------------------------------------------------------------------

-- | The key that the stations of a group have in common; nothing for a station of no group.
type Key = Station -> Maybe (Int, Int)

-- | The pass of a station, from its role.
passOf :: Key
passOf s = (,0) <$> Frame.passNumber (Frame.role (made s))

-- | The position of the hole of a station.
holeOf :: Key
holeOf s = case Frame.role (made s) of
  Frame.Drilling _ -> let (Pulses x, Pulses y) = plane s in Just (x, y)
  _ -> Nothing

-- | The stations in runs with the same key.
groupsBy :: Key -> [Station] -> [[Station]]
groupsBy key = groupBy ((==) `on` key)

-- | Indices of the groups that have a key.
keyed :: Key -> [[Station]] -> [Int]
keyed key groups = [k | (k, s : _) <- zip [0 ..] groups, Just _ <- [key s]]

exchangedGroups, repeatedGroup, leftOutGroup :: Key -> [Station] -> Gen [Station]
exchangedGroups key stations = case keyed key groups of
  ks@(_ : _ : _) -> do
    i <- elements ks
    j <- elements (filter (/= i) ks)
    let place k
          | k == i = groups !! j
          | k == j = groups !! i
          | otherwise = groups !! k
    pure (concatMap place [0 .. length groups - 1])
  _ -> discard
  where
    groups = groupsBy key stations
repeatedGroup = changedGroup (\g -> g <> g)
leftOutGroup = changedGroup (const [])

-- | Stations in which one group with a key is changed.
changedGroup :: ([Station] -> [Station]) -> Key -> [Station] -> Gen [Station]
changedGroup changed key stations = case keyed key groups of
  [] -> discard
  ks -> do
    i <- elements ks
    pure (concat [if k == i then changed g else g | (k, g) <- zip [0 ..] groups])
  where
    groups = groupsBy key stations

-- The difference of two tapes ---------------------------------------------------------------------

-- | A lower bound in mm of the Fréchet distance of two tapes, over the motions that differ: the
-- discrete Fréchet distance of samples, minus the distance between neighbouring samples. A
-- difference of height counts by this factor.
difference :: Machine -> Double -> Pulses3 -> [Frame] -> [Frame] -> Double
difference machine zFactor begin one other =
  max 0 (frechet (sampled a) (sampled b) - spacing * max 1 zFactor)
  where
    ones = Control.run begin one
    others = Control.run begin other
    same = length (takeWhile id (zipWith isSame ones others))
    sameEnd =
      min
        (min (length ones) (length others) - same)
        (length (takeWhile id (zipWith isSame (reverse ones) (reverse others))))
    cut ms = take (length ms - same - sameEnd) (drop same ms)
    (a, b) = (cut ones, cut others)
    isSame m n = shapeOf m == shapeOf n
    shapeOf m =
      ( Control.from m,
        Control.to m,
        motion (Control.frame m) == Rapid,
        centre (Control.frame m),
        arcSense m
      )
    arcSense m = case motion (Control.frame m) of
      Circular s -> Just s
      _ -> Nothing
    startOf = [pointAt 0 m | m <- take 1 (drop same ones <> drop same others)]
    sampled ms = case startOf <> concatMap samples ms of
      [] -> [(0, 0, 0)]
      ps -> ps
    samples m =
      let Mm l = Control.travel machine m
          n = max 1 (ceiling (l / spacing)) :: Int
       in [pointAt (fromIntegral k / fromIntegral n) m | k <- [1 .. n]]
    pointAt k m =
      let p = Segment.at k (Control.segment machine m)
          (Mm z, Mm z') = Control.height machine m
       in (Vec.x p, Vec.y p, zFactor * (z + k * (z' - z)))
    -- Long differences are sampled more sparsely, so that the comparison does not take long.
    spacing = max 0.1 (sum [l | m <- a <> b, let { Mm l = Control.travel machine m }] / 400)

-- | The discrete Fréchet distance of two sequences of points (Eiter and Mannila, 1994).
frechet :: [(Double, Double, Double)] -> [(Double, Double, Double)] -> Double
frechet ps qs = last (foldl row (scanl1 max (map (far (head ps)) qs)) (drop 1 ps))
  where
    row before p = case (before, qs) of
      (b : _, q : _) -> go (max b (far p q)) before (drop 1 before) (drop 1 qs) p
      _ -> []
    go left olds news others p =
      left : case (olds, news, others) of
        (diagonal : _, above : _, q : more) ->
          go (max (far p q) (minimum [left, diagonal, above])) (drop 1 olds) (drop 1 news) more p
        _ -> []
    far (x, y, z) (u, v, w) = sqrt ((x - u) ^ two + (y - v) ^ two + (z - w) ^ two)
    two = 2 :: Int
