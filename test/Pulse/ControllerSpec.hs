-- | Laws of whole runs: numbers of the sources, feeds, damaged tapes, cutter compensation, and the
-- times of a path planner.
module Pulse.ControllerSpec
  ( spec,
  )
where

import Base.Decimal qualified as Decimal
import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), Rad (..), Seconds (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import CaseCount (askedCount)
import Control.Motion qualified as Motion
import Data.ByteString qualified as ByteString
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, listToMaybe)
import Frame.Frame (Frame (..), FrameMotion (..), PlannedFrame (..), Role (..))
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate.ByControl qualified as ByControl
import Geometry.Carrier (Sense (..))
import Geometry.Distance qualified as Distance
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Controller
import Machine.Machine (CommandName (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Machines (iso6983, kontur3p, lkiU, lkp01f, n55, named)
import Part.Part qualified as Part
import Pulse.Controller (Console (..))
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (ControllerRun (..), StopReason (..))
import Pulse.ControllerRun qualified as ControllerRun
import Pulse.FrameCompensation (switchRadii)
import Pulse.FramePath (feedText, feedValue, roundedDown)
import Pulse.IntegratorFeed qualified as IntegratorFeed
import Pulse.RunMeasure (FrameMeasure, JobLoad (..), RunTotal (..))
import Pulse.RunMeasure qualified as Measure
import Pulse.Steps (Pulses5 (..))
import Pulse.Steps qualified as Steps
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "numbers of the sources" sources
  describe "feeds" feeds
  describe "the jobs of n55" jobWaits
  describe "damaged tapes" . damaged . fromMaybe 10000 =<< runIO (askedCount "PARTC_TAPES")
  describe "cutter compensation" compensation
  describe "a path planner" planner

-- Frames and measures -----------------------------------------------------------------------------

line :: Int -> Int -> Int -> Frame
line code x y =
  (Frame.commandFrame [])
    { motion = Linear,
      increment = Pulses3 (Pulses x) (Pulses y) 0,
      feedCode = FeedCode code
    }

-- | Arc from a start to an end, both relative to the centre.
arc :: Int -> Sense -> (Int, Int) -> (Int, Int) -> Frame
arc code sense (a, b) (c, d) =
  (line code (c - a) (d - b))
    { motion = Circular sense,
      centre = Pulses2 (Pulses (-a)) (Pulses (-b))
    }

measured :: Machine -> [Frame] -> ([FrameMeasure], RunTotal)
measured machine fs =
  case Controller.measured machine Controller.neutral 0 (Punch.write machine 0 fs) of
    Just list -> (LazyList.toList list, LazyList.end list)
    Nothing -> error "the machine has no controller"

seconds :: Machine -> Int -> Double
seconds machine t = fromIntegral t / fromIntegral (fromMaybe 1 (Controller.ticksPerSecond machine))

lasts :: Machine -> FrameMeasure -> Double
lasts machine m = seconds machine (Measure.endsAt m - Measure.beginsAt m)

-- | True if two numbers differ by less than the given share of the first.
isNear :: Double -> Double -> Double -> Bool
isNear share a b = abs (a - b) <= share * abs a

-- | The machine with another controller.
with :: (Controller -> Controller) -> Machine -> Machine
with change machine = machine {Machine.controller = change <$> Machine.controller machine}

-- | The machine without ramps and without jobs that change the feed.
withoutRamps :: Machine -> Machine
withoutRamps = with $ \case
  Stepping c -> Stepping c {ramp = Nothing}
  Integrating c -> Integrating c {jobs = filter (not . isAcceleration . request) (jobs c)}
  Planning c -> Planning c
  where
    isAcceleration r = case r of
      AtAcceleration _ -> True
      _ -> False

-- Numbers of the sources --------------------------------------------------------------------------

sources :: Spec
sources = do
  it "runs the leading axis of Контур at 900 Hz with П27, and at 33.4 Hz with П32" $ do
    let hz code =
          map (maximum . Measure.frequencies) (fst (measured kontur3p [line code 3000 1000]))
    hz 27 `shouldSatisfy` all (isNear 0.001 900)
    hz 32 `shouldSatisfy` all (isNear 0.001 33.4)
  it "takes 6.67 s for the first move of the shaft, 6000 steps with П27" $
    map (lasts kontur3p) (fst (measured kontur3p [line 27 0 6000]))
      `shouldSatisfy` all (isNear 0.0001 (6000 / 900))
  it "lets Контур read two frames before the first one begins" $ do
    let fs = [line 27 100 0, line 27 0 100, line 27 100 0]
        begins n =
          map
            (seconds kontur3p . Measure.beginsAt)
            (take 1 (fst (measured kontur3p (take n fs))))
        -- Leader, two frames of 11 rows each, and the three blank rows between them.
        rowsOfTwo = 25 + 11 + 3 + 11
    begins 3 `shouldSatisfy` all (isNear 0.001 (fromIntegral (rowsOfTwo :: Int) / 300))
    begins 3 `shouldBe` begins 2
    begins 1 `shouldSatisfy` all (< 0.13)
  it "stops Контур before a frame with a wrong check digit" $ do
    let Tape rows = Punch.write kontur3p 0 [line 27 100 0, line 27 0 100, line 27 200 0]
        -- A digit of the third frame is changed: 0200 becomes 0300.
        at = 25 + 2 * (11 + 3) + 4
        bad = ByteString.take at rows <> ByteString.pack [3] <> ByteString.drop (at + 1) rows
        list = Controller.measured kontur3p Controller.neutral 0 (Tape bad)
    fmap (map Measure.number . LazyList.toList) list `shouldBe` Just [1, 2]
    fmap (isUnreadable . stopReason . LazyList.end) list `shouldBe` Just True
  it "makes seven pulses of a seven" $
    map Measure.pulses (fst (measured lkp01f [line 5 7 0])) `shouldBe` [Pulses5 7 0 0 0 0]
  where
    isUnreadable why = case why of
      Unreadable _ -> True
      _ -> False

-- Feeds -------------------------------------------------------------------------------------------

feeds :: Spec
feeds = do
  it "of an axis that turns back jump by their sum (catches jumps without signs)" $
    map (take 1 . Measure.jumps) (fst (measured lkp01f [line 5 600 0, line 5 (-600) 0]))
      `shouldSatisfy` \case
        [[], [jump]] -> isNear 0.001 (2 * hertz) jump
          where
            hertz = fromMaybe 0 (Machine.valueOf lkp01f (FeedCode 5)) / 60 / pulseOfX
            Mm pulseOfX = Machine.resolutionOf lkp01f Machine.X
        _ -> False
  it "are within one percent on lines, outside of ramps (catches a wrong length or a wrong share)" $
    forAll ((,) <$> elements straightMachines <*> lineFrame) $ \(machine, (k, x, y)) ->
      let code = codeOf machine k
          asked = fromMaybe 0 (Machine.valueOf machine (FeedCode code))
       in conjoin
            [ counterexample (show (code, x, y, Measure.feeds m)) $
                case Measure.feeds m of
                  Nothing -> property False
                  Just (_, least, most) ->
                    conjoin [isEven machine asked x y least, isEven machine asked x y most]
              | m <- fst (measured (withoutRamps machine) [line code x y])
            ]
  it "that are too high are refused, with their unit" $ do
    let refusal machine f = case stopReason (snd (measured (slow machine) [f])) of
          TooFast n asked most -> Just (n, feedText asked, feedText most)
          _ -> Nothing
        slow = with $ \case
          Stepping c -> Stepping c {stepClock = 800}
          Integrating c -> Integrating c {clock = 1000}
          Planning c -> Planning c
        turning = (line 5000 0 0) {turn = Pulses2 90000 0}
    refusal kontur3p (line 27 3000 1000) `shouldBe` Just (1, "900 Hz", "800 Hz")
    refusal n55 (line 120 3000 0) `shouldBe` Just (1, "120 mm/min", "66.67 mm/min")
    refusal n55 turning `shouldBe` Just (1, "5000°/min", "6.67°/min")
  it "that are refused leave a largest feed that is not (catches a limit that is rounded up)" $
    forAll (oneof [longLine, wideArc]) $ \f ->
      let stop feed = stopReason (snd (measured n55 [f {feedCode = FeedCode feed}]))
       in case stop 9999 of
            TooFast _ _ most ->
              conjoin
                [ stop (floor (feedValue (roundedDown most))) === TapeEnds,
                  counterexample "a higher feed" (isTooFast (stop (floor (feedValue most) + 1)))
                ]
            why -> counterexample (show why) (property False)
  it "rise again after a wait for the reader (catches a feed that stays while the axes stand)" $ do
    let ramped = flip with lkiU $ \case
          Stepping c -> Stepping c {stepReader = Just (TapeReader 20 (Seconds 0) 1 Nothing)}
          other -> other
        tape = [line 30 30 0, line 30 2000 0]
    case fst (measured ramped tape) of
      [_, m] -> do
        Measure.waitedFor m `shouldSatisfy` (> 0)
        fmap (\(_, least, _) -> least) (Measure.feeds m)
          `shouldSatisfy` maybe False (< 0.9 * fromMaybe 0 (Machine.valueOf lkiU (FeedCode 30)))
      ms -> length ms `shouldBe` 2
  it "of n55 are within 2.5 percent on arcs of 2 mm and more (catches a wrong direction)" $
    forAll (arcFrame 200 3000) $ \(from, to, sense) ->
      forAll (choose (60, 1500)) $ \code ->
        feedsBetween (withoutRamps n55) (0.975, 1.025) code (arc code sense from to)
  it "of ЛКИ stay within the swing on arcs (catches a wrong mean)" $
    forAll (arcFrame 200 2000) $ \(from, to, sense) ->
      feedsBetween (withoutRamps lkiU) swing 20 (arc 20 sense from to)
  it "of ЛКИ stay within the swing on an arc whose last pulse goes back" $
    feedsBetween (withoutRamps lkiU) swing 20 (arc 20 Clockwise (78, -1111) (710, 859))
  it "rise by the acceleration (catches a ramp that is too steep)" $
    let m = head' (fst (measured lkiU [line 40 5000 0]))
        v = 1000 / 60 :: Double
        -- 100 mm with 5 mm/s²: the ramp takes 2v/a·v/2 mm, the rest runs at v.
        time = v / 5 + (100 - v * v / 10) / v
     in lasts lkiU m `shouldSatisfy` isNear 0.01 time
  where
    -- The swing of the feed is from 0.900 to 1.273. If the radii of an arc differ, its last pulse
    -- may go back: then this pulse and the one that it takes back are missing of the 64 of a
    -- window.
    swing = (0.900 * 62 / 64, 1.30)
    straightMachines = [lkp01f, kontur3p, lkiU, n55]
    head' list = case list of
      a : _ -> a
      [] -> error "no frame"
    codeOf machine k
      | machine == lkp01f = 1 + k `mod` 9
      | machine == kontur3p = 27 + k `mod` 6
      | machine == lkiU = k `mod` 41
      | otherwise = 30 + k
    lineFrame = do
      k <- choose (0, 2000)
      x <- choose (-3000, 3000)
      y <- choose (-3000, 3000)
      pure (k, x, if x == 0 && y == 0 then 1 else y)

-- | True if a measured feed is within one percent of the feed that is asked, or within two pulses
-- of a window.
isEven :: Machine -> Double -> Int -> Int -> Double -> Property
isEven machine asked x y v = counterexample (show (path, v)) (isNear share path v)
  where
    Mm pulse = Machine.resolutionOf machine Machine.X
    long = pulse * sqrt (fromIntegral (x * x + y * y))
    lead = fromIntegral (max (abs x) (abs y))
    inWindow = min lead (1 / (long / lead))
    share = max 0.01 (2 / inWindow)
    path = case Machine.feedMeasure (Machine.feeds machine) of
      Machine.AlongPath -> asked
      Machine.LeadingAxis -> asked * 60 * long / lead

-- | An arc between two radii in pulses: start, end and sense. Its radii agree within a pulse.
arcFrame :: Int -> Int -> Gen ((Int, Int), (Int, Int), Sense)
arcFrame least most = do
  r <- choose (fromIntegral least, fromIntegral most) :: Gen Double
  a <- choose (0, 2 * pi)
  b <- choose (0.5, 6)
  sense <- elements [Clockwise, CounterClockwise]
  let point w = (round (r * cos w), round (r * sin w))
  pure (point a, point (a + b), sense)

-- | Feeds in a frame, as shares of the feed that is asked, between two limits.
feedsBetween :: Machine -> (Double, Double) -> Int -> Frame -> Property
feedsBetween machine (low, high) code f =
  conjoin
    [ counterexample (show (Measure.feeds m, asked)) $
        maybe False (\(_, a, b) -> a >= low * asked && b <= high * asked) (Measure.feeds m)
      | m <- fst (measured machine [f])
    ]
  where
    asked = fromMaybe 0 (Machine.valueOf machine (FeedCode code))

-- Jobs --------------------------------------------------------------------------------------------

jobWaits :: Spec
jobWaits =
  it "wait no longer than their bounds (catches a job that is left out of a bound)" $
    forAll ((,) <$> elements [n55, crowded] <*> listOf1 (oneof [shortLine, roundFrame])) $
      \(machine, fs) ->
        let found = loads (snd (measured machine fs))
         in conjoin
              [ counterexample (show (jobName j, load, bound)) (longestWait load <= bound)
                | Just (Integrating c) <- [Machine.controller machine],
                  -- 600 mm/min along one axis are 1000 pulses a second.
                  (j, Just bound) <- IntegratorFeed.waitBounds c 1000,
                  Just load <- [Map.lookup (jobName j) found]
              ]
  where
    -- Six more jobs, which are all requested at the same ticks.
    crowded = flip with n55 $ \case
      Integrating c -> Integrating c {jobs = jobs c <> map periodic [1 .. 6]}
      other -> other
    periodic n =
      ControlJob
        { jobName = "periodic " <> Decimal.whole n,
          duration = 20,
          priority = 50 + n,
          request = Periodic (Seconds 0.05)
        }
    shortLine = do
      code <- choose (30, 600)
      x <- choose (-400, 400)
      y <- choose (1, 400)
      t <- elements [[], [(CommandName "T", 3)]]
      pure (line code x y) {commands = t}
    roundFrame = do
      (from, to, sense) <- arcFrame 20 400
      code <- choose (30, 600)
      pure (arc code sense from to)

-- Damaged tapes -----------------------------------------------------------------------------------

longLine :: Gen Frame
longLine = line 9999 <$> choose (-900, 900) <*> choose (1, 900)

-- | Arc of at least 2 mm radius.
wideArc :: Gen Frame
wideArc = (\(from, to, sense) -> arc 9999 sense from to) <$> arcFrame 200 3000

isTooFast :: StopReason -> Bool
isTooFast why = case why of
  TooFast {} -> True
  _ -> False

damaged :: Int -> Spec
damaged tapes = do
  it "show what the cutter then does, if the reader cannot see the damage" $ do
    -- The digit 7 of the first increment, 0070, becomes a 9 on a tape without a check digit.
    let Tape rows = Punch.write lkp01f 0 [line 5 70 20, line 5 0 10]
        at = 25 + 2
        bad = ByteString.take at rows <> ByteString.pack [15] <> ByteString.drop (at + 1) rows
        ends tape = map Measure.positionAfter . LazyList.toList <$> run tape
        run tape = Controller.measured lkp01f Controller.neutral 0 (Tape tape)
    ends rows `shouldBe` Just [Pulses5 70 20 0 0 0, Pulses5 70 30 0 0 0]
    ends bad `shouldBe` Just [Pulses5 90 20 0 0 0, Pulses5 90 30 0 0 0]
  it "never crash a controller, or make it run for ever (catches an endless frame)" $
    withMaxSuccess tapes $
      forAll ((,) <$> elements [lkp01f, kontur3p, lkiU, n55] <*> choose (0, 3)) $ \(machine, n) ->
        forAll (vectorOf (n + 1) (choose (0, 1000000))) $ \changes ->
          let Tape rows = Punch.write machine 0 (framesOf machine)
              bad = foldr (uncurry changed) rows (zip changes (map (`div` 7) changes))
              run = Controller.run machine Controller.neutral 0 (Tape bad)
           in maybe (property False) (isProgress 0 (40000000 :: Int)) run
  where
    changed at value rows =
      let k = at `mod` ByteString.length rows
       in ByteString.take k rows
            <> ByteString.singleton (fromIntegral value)
            <> ByteString.drop (k + 1) rows
    framesOf machine
      | machine == lkp01f = [line 5 70 20, line 5 3 (-41), line 9 (-8) 0]
      | machine == kontur3p = [line 27 70 20, line 28 3 (-41), line 27 (-8) 0]
      | otherwise =
        [line 30 70 20, arc 30 CounterClockwise (10, 0) (0, 10), line 30 (-8) 0]
    -- Ticks never fall, and the run ends within a count of events.
    isProgress t left run
      | left <= 0 = counterexample "too many events" (property False)
      | otherwise = case run of
        FrameBegins _ more -> isProgress t (left - 1) more
        Stepped t' _ more -> later t t' left more
        FrameEnds t' more -> later t t' left more
        Commanded _ _ _ more -> isProgress t (left - 1) more
        JobDone _ more -> isProgress t (left - 1) more
        Stopped _ _ -> property True
    later t t' left more
      | t' >= t = isProgress t' (left - 1) more
      | otherwise = counterexample "a tick before the one before" (property False)

-- Cutter compensation -----------------------------------------------------------------------------

compensation :: Spec
compensation = do
  it "stops before the frame that switches it on if the switch is not set" $ do
    let on = Frame.commandFrame [(CommandName "left", 0), (CommandName "switch", 3)]
    stopReason (snd (measured n55 [line 60 100 0, on, line 60 1000 0]))
      `shouldBe` SwitchNotSet 2 3

  it
    "follows the equidistant with the tape of the edge, from the first element to the last \
    \(catches a corner that is cut, a wrong side)"
    $ withMaxSuccess 60 $
      forAll ByControl.cases $ \(_, job) ->
        case (programFor job, programFor job {Part.controlCompensation = Nothing}) of
          (Just edge, Just equidistant) -> follows edge equidistant
          _ -> property Discard
  where
    programFor job = do
      from <- listToMaybe [p | Part.Stop (Located _ p) _ _ <- Part.approach job]
      path <- ByControl.path (Vec.shift (Vec.vec 7 5) from) job
      Result.output (FromToolpath.quantise n55 path)

-- | True if every pulse of the tape of the edge is near the motions of the equidistant's tape. The
-- ends of an offset are rounded to pulses up to three times, each time by √½ pulse at most, and
-- both interpolators may be half a pulse away. At a corner of the path this distance is divided by
-- the sine of half the angle between both sides. There, the rounded direction of a short element
-- also turns its offset: by a pulse over its length, at the distance of the radius.
follows :: Frame.FrameProgram -> Frame.FrameProgram -> Property
follows edge equidistant =
  counterexample (show (take 3 far)) (null far)
  where
    tape = Punch.write n55 (Frame.start edge) (map frame (Frame.plannedFrames edge))
    console = Console {correction = 1, radii = switchRadii n55 (Frame.plannedFrames edge)}
    run = Controller.run (withoutJobs n55) console (Frame.start edge) tape
    cutting = [n | (n, p) <- zip [1 ..] (Frame.plannedFrames edge), Cutting _ <- [role p]]
    positions = maybe [] (pulsesIn (`elem` cutting) (Frame.start edge)) run
    path =
      map
        (Motion.segment n55)
        (Motion.run (Frame.start equidistant) (map frame (Frame.plannedFrames equidistant)))
    far = [(p, d) | p <- positions, let d = minimum (map (away p) path), isFar p d]
    away p s = Distance.toPoint (Frame.position n55 p) s
    isFar p d = d > bound && and [d > wider || away p c > Mm (4 * w) | (c, wider@(Mm w)) <- corners]
    bound = Mm (0.01 * (3 * sqrt 0.5 + 2 * 0.5))
    corners =
      [ (Segment.Straight (Segment.end a) (Segment.end a), Mm (wide / max 0.01 (cos (angle / 2))))
        | (a, b) <- zip path (drop 1 path),
          let Rad angle = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
              Mm base = bound
              Mm shortest = min (Segment.length a) (Segment.length b)
              wide = base + 0.01 * radius / shortest
      ]
    radius = maximum (0 : [r | (_, Mm r) <- radii console])

-- | Positions after each pulse in the chosen frames.
pulsesIn :: (Int -> Bool) -> Pulses3 -> ControllerRun -> [Pulses3]
pulsesIn isChosen = go False
  where
    go chosen p run = case run of
      FrameBegins s more -> go (isChosen (ControllerRun.number s)) p more
      Stepped _ steps more ->
        let p' = p + moved steps in [p' | chosen] <> go chosen p' more
      FrameEnds _ more -> go chosen p more
      Commanded _ _ _ more -> go chosen p more
      JobDone _ more -> go chosen p more
      Stopped _ _ -> []
    moved s = Pulses3 (onAxis 0 s) (onAxis 1 s) (onAxis 2 s)
    onAxis k s = Pulses (Steps.onAxis k s)

-- | The machine without jobs of a dispatcher.
withoutJobs :: Machine -> Machine
withoutJobs = with $ \case
  Integrating c -> Integrating c {jobs = []}
  other -> other

planner :: Spec
planner = do
  it "takes L/v + v/a for one line" $
    timeOf ExactStop [line 600 10000 0] `shouldSatisfy` isNear 1e-5 (10 / 10 + 10 / 100)
  it "takes both times for a corner with an exact stop, and v/a less with blending" $ do
    let fs = [line 600 10000 0, line 600 0 5000]
        each l = l / 10 + 10 / 100
    timeOf ExactStop fs `shouldSatisfy` isNear 1e-5 (each 10 + each 5)
    timeOf Blending fs `shouldSatisfy` isNear 1e-5 (each 10 + each 5 - 10 / 100)
  it "takes the time of a dwell, in seconds or in milliseconds" $ do
    let waits name n =
          let control = named name
              dwell = Frame.commandFrame [(CommandName "dwell", n)]
              timeOf' fs = seconds control (totalTicks (snd (measured control fs)))
           in timeOf' [dwell, line 600 1000 0] - timeOf' [line 600 1000 0]
    waits "linuxcnc-mill" 2500 `shouldSatisfy` isNear 1e-5 2.5
    waits "fanuc" 2500 `shouldSatisfy` isNear 1e-5 2.5
  it "takes 2·√(L/a) for a line too short for its feed" $
    timeOf ExactStop [line 6000 100 0] `shouldSatisfy` isNear 1e-4 (2 * sqrt (0.1 / 100))
  it "runs a full circle at most at √(a·r/2)" $ do
    -- Two half circles of 5 mm with a = 100 mm/s².
    let half s = arc 6000 CounterClockwise (s * 5000, 0) (negate s * 5000, 0)
        v = sqrt (100 * 5 / 2) :: Double
        along = sqrt 0.75 * 100
        each = 5 * pi / v + v / along
    timeOf Blending [half 1, half (-1)] `shouldSatisfy` isNear 1e-4 (2 * each - v / along)
  where
    timeOf policy fs =
      let machine = with (const (Planning (PathControl 100 policy))) iso6983
       in seconds machine (totalTicks (snd (measured machine fs)))
