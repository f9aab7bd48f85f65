-- | Proof of the pulses of a tape: random tapes on every controller, and runs with faults.
module Verify.FromPulsesSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Base.Result qualified as Result
import Compile (Compiled (..), Punched (..))
import Compile qualified
import Control.Monad (forM_)
import Data.List (sort)
import Data.Maybe (fromMaybe)
import Files (readText)
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Generate.Machine qualified as Generate
import Geometry.Carrier (Sense (..))
import Machine.Controller
  ( Controller (..),
    FrequencyLimits (..),
    IntegratorControl (driveLimits),
    InterpolationMethod (..),
    StepControl (stepLimits),
    makesPulses,
  )
import Machine.Machine (FeedCode (..), Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Machines (lkiUn, lkp01f, n55)
import Machines qualified
import Project.Job (Job (verification), Verification (..))
import Project.LoadedProgram qualified as LoadedProgram
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (ControllerRun (..), StopReason (..))
import Pulse.RunMeasure (FrequencyPeak (peakHz))
import Pulse.RunMeasure qualified as RunMeasure
import Pulse.Steps qualified as Steps
import Surface.Import qualified as Import
import System.Directory (listDirectory)
import System.FilePath (takeExtension, (</>))
import Tape.Punch qualified as Punch
import Test.Hspec
import Test.QuickCheck
import Verify.FromPulses qualified as FromPulses
import Verify.PulseProof (PulseFinding (..), PulseProof (pulseFindings))
import Verify.PulseProof qualified as PulseProof

spec :: Spec
spec = do
  describe "the pulses of a random tape are proven" $
    forM_ pulsing $ \machine ->
      it ("on " <> nameOf machine <> " (catches a promise that is too small)") $
        forAll (framesFor machine) $ \fs ->
          let proof = FromPulses.prove machine Controller.neutral 0 (Punch.write machine 0 fs)
           in fmap (filter (not . isStop) . pulseFindings) proof === Just []
  describe "a fault of a run is found" $
    forM_ [lkp01f, lkiUn, n55] $ \machine -> do
      let run = runOf machine (zigzag machine)
      it ("without it there is none, on " <> nameOf machine) $
        pulseFindings (proofOf machine run) `shouldBe` []
      it ("a pulse left out, on " <> nameOf machine <> " (catches ends that are not compared)") $
        conjoin
          [ counterexample (show n) (any isMiss (pulseFindings (proofOf machine (without n run))))
            | n <- [1, 70, 400, 3000]
          ]
      it
        ( "three pulses aside, and back at once, on "
            <> nameOf machine
            <> " (catches deviations that are compared at the end only)"
        )
        $ conjoin
          [ counterexample (show n) (any isOff (pulseFindings (proofOf machine (away n run))))
            | n <- [1, 70, 400, 3000]
          ]
      it
        ( "a clock that is 5 percent too fast, on "
            <> nameOf machine
            <> " (catches a feed that is not compared)"
        )
        $ pulseFindings (proofWith 1.05 machine run) `shouldSatisfy` any isFast
  it "a full circle that is left out is found (catches an arc of which only the end is compared)" $
    forM_ [m | m <- pulsing, null (Frame.violations m [circle m])] $ \machine -> do
      let run = runOf machine [circle machine]
      pulseFindings (proofOf machine run) `shouldBe` []
      pulseFindings (proofOf machine (stepless run)) `shouldSatisfy` any isOff
  it "an axis above its limit is found, and no other (catches limits that are not compared)" $
    forM_ [lkp01f, lkiUn, n55] $ \machine -> do
      let run = runOf machine (zigzag machine)
          findings limits =
            [ (k, peak)
              | finding <- pulseFindings (proofOf (limited limits machine) run),
                Just (k, peak) <- [aboveLimit finding]
            ]
          whole = PulseProof.total (proofOf machine run)
          check limit found =
            forM_ [0.5, 0.8, 0.98, 1.02] $ \share -> do
              let most = share * maximum (map peakHz found)
                  expected = [(k, p) | (k, p) <- zip [0 ..] found, peakHz p > 1.01 * most]
              findings (limit most) `shouldBe` expected
              null expected `shouldBe` share > 1
      check (\hz -> FrequencyLimits (Just hz) Nothing) (RunMeasure.peaks whole)
      check (FrequencyLimits Nothing . Just) (RunMeasure.largestJumps whole)
  it "an unreadable frame is a stop" $ do
    let tape = Punch.write n55 0 (zigzag n55)
    fmap pulseFindings (FromPulses.prove lkp01f Controller.neutral 0 tape)
      `shouldSatisfy` maybe False (any isStop)
  examples

-- | Examples on all machines whose controllers make pulses.
examples :: Spec
examples = describe "the pulses of the examples are proven" $ do
  names <- runIO (sort . filter ((== ".part") . takeExtension) <$> listDirectory "examples")
  forM_ names $ \name ->
    it name $ do
      let file = "examples" </> name
      text <- readText file
      loaded <- LoadedProgram.load (Import.byName (fmap Right . readText)) file text
      forM_ pulsing $ \machine ->
        forM_ (Result.ifSound (Compile.compile (unproven machine) loaded)) $ \made ->
          forM_ made $ \c -> do
            let outcome = Compile.provePulses c (tape (punched c))
            fmap (fmap pulseFindings . Result.output) outcome `shouldBe` Just (Just [])
  where
    unproven machine = (Machines.jobFor machine []) {verification = Unverified}

-- | Machines whose controllers make pulses.
pulsing :: [Machine]
pulsing = filter (maybe False makesPulses . Machine.controller) Machines.known

nameOf :: Machine -> String
nameOf machine = let MachineName n = Machine.name machine in show n

-- | Random frames whose increments have at most 600 pulses.
framesFor :: Machine -> Gen [Frame]
framesFor machine = do
  (_, fs) <- Generate.frames machine
  pure (filter isAllowed (map smaller fs))
  where
    isAllowed f = null (Frame.violations machine [f])
    smaller f =
      let (Pulses3 x y z, Pulses2 i j, Pulses2 a b) = (increment f, centre f, turn f)
          divisor = 1 + maximum (map abs [x, y, z, i, j, a, b]) `quot` 600
          small d = d `quot` divisor
       in f
            { increment = Pulses3 (small x) (small y) (small z),
              centre = Pulses2 (small i) (small j),
              turn = Pulses2 (small a) (small b)
            }

-- | Lines along and across the axes, and an arc if the machine has one.
zigzag :: Machine -> [Frame]
zigzag machine =
  [ line 2000 0,
    line 1500 (-900),
    line (-400) 3000
  ]
    <> [f | f <- [arc], null (Frame.violations machine [f])]
  where
    line x y =
      (Frame.commandFrame [])
        { motion = Linear,
          increment = Pulses3 (Pulses x) (Pulses y) 0,
          feedCode = lowFeed machine
        }
    arc =
      (line 1000 1000) {motion = Circular CounterClockwise, centre = Pulses2 0 (Pulses 1000)}

-- | A full circle.
circle :: Machine -> Frame
circle machine =
  (Frame.commandFrame [])
    { motion = Circular Clockwise,
      increment = 0,
      centre = Pulses2 0 (Pulses 100),
      feedCode = lowFeed machine
    }

-- | A feed of about 60 mm/min.
lowFeed :: Machine -> FeedCode
lowFeed machine =
  head
    [ code
      | code <- map FeedCode [0 .. 100],
        Just v <- [Machine.valueOf machine code],
        v >= 50,
        v <= 100
    ]

runOf :: Machine -> [Frame] -> ControllerRun
runOf machine fs = case Controller.run machine Controller.neutral 0 (Punch.write machine 0 fs) of
  Just run -> run
  Nothing -> Stopped 0 TapeEnds

proofOf :: Machine -> ControllerRun -> PulseProof
proofOf = proofWith 1

-- | Proof of a run whose ticks are those of a clock that is faster by a factor.
proofWith :: Double -> Machine -> ControllerRun -> PulseProof
proofWith factor machine run =
  FromPulses.proveRun
    machine
    (fromMaybe DifferentialAnalyser (FromPulses.methodOf machine))
    ticks
    run
    (RunMeasure.measure machine ticks run)
  where
    ticks = maybe 1 (round . (* factor) . fromIntegral) (Controller.ticksPerSecond machine)

-- Faults ------------------------------------------------------------------------------------------

-- | Run without its pulses of the given number, from 1.
without :: Int -> ControllerRun -> ControllerRun
without n = rewritten n (\_ more -> more)

-- | Run that leaves its path by three pulses after its pulses of the given number, and comes back.
away :: Int -> ControllerRun -> ControllerRun
away n = rewritten n (\stepped more -> stepped (out (out (out (back (back (back more)))))))
  where
    out = Stepped 0 aside
    back = Stepped 0 (Steps.together (Steps.towards 0 (-1)) (Steps.towards 1 (-1)))
    aside = Steps.together (Steps.towards 0 1) (Steps.towards 1 1)

-- | Run whose pulses of the given number are rewritten. The function gets them, without the rest of
-- the run, and the rest.
rewritten ::
  Int ->
  ((ControllerRun -> ControllerRun) -> ControllerRun -> ControllerRun) ->
  ControllerRun ->
  ControllerRun
rewritten n change run = case run of
  Stepped t steps more
    | n == 1 -> change (Stepped t steps) more
    | otherwise -> Stepped t steps (rewritten (n - 1) change more)
  FrameBegins s more -> FrameBegins s (rewritten n change more)
  FrameEnds t more -> FrameEnds t (rewritten n change more)
  Commanded t c k more -> Commanded t c k (rewritten n change more)
  JobDone j more -> JobDone j (rewritten n change more)
  Stopped _ _ -> run

-- | Machine with limits for its drives.
limited :: FrequencyLimits -> Machine -> Machine
limited limits machine = machine {Machine.controller = withLimits <$> Machine.controller machine}
  where
    withLimits control = case control of
      Stepping c -> Stepping c {stepLimits = limits}
      Integrating c -> Integrating c {driveLimits = limits}
      Planning c -> Planning c

aboveLimit :: PulseFinding -> Maybe (Int, FrequencyPeak)
aboveLimit finding = case finding of
  AxisTooFast k peak _ -> Just (k, peak)
  JumpTooLarge k peak _ -> Just (k, peak)
  _ -> Nothing

-- | Run without pulses.
stepless :: ControllerRun -> ControllerRun
stepless run = case run of
  Stepped _ _ more -> stepless more
  FrameBegins s more -> FrameBegins s (stepless more)
  FrameEnds t more -> FrameEnds t (stepless more)
  Commanded t c k more -> Commanded t c k (stepless more)
  JobDone j more -> JobDone j (stepless more)
  Stopped _ _ -> run

isMiss, isOff, isFast, isStop :: PulseFinding -> Bool
isMiss finding = case finding of
  EndMissed _ _ -> True
  _ -> False
isOff finding = case finding of
  OffMotion _ _ -> True
  _ -> False
isFast finding = case finding of
  FeedTooHigh _ _ -> True
  _ -> False
isStop finding = case finding of
  StopsEarly _ -> True
  _ -> False
