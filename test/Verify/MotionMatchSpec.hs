-- | Tapes of parts with several operations: right ones are proven, and damaged ones are not.
module Verify.MotionMatchSpec (spec) where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Base.Region (Located (..))
import Base.Result (Result (..))
import Base.Result qualified as Result
import CaseCount (askedCount)
import Compile (Analysis (Analysis), Compiled (Compiled))
import Compile qualified
import Data.Foldable (for_)
import Data.IORef (atomicModifyIORef', newIORef)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isJust, isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import FixedSeed (fixed)
import Frame.Frame (Frame, FrameMotion (..), FrameProgram, PlannedFrame)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate.MachinedText qualified as MachinedText
import Generate.Operations qualified as Operations
import Generate.RightTape qualified as RightTape
import Generate.WrongTape qualified as WrongTape
import Geometry.Carrier (Sense)
import Geometry.Vec (Point)
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Machines qualified
import Part.ContourStart qualified as ContourStart
import Part.Part (Milling, Part)
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Project.Target qualified as Target
import Report.Report (Report)
import System.Environment (lookupEnv)
import System.Exit (ExitCode (..))
import Test.Hspec
import Test.Hspec.QuickCheck (modifyArgs)
import Test.QuickCheck
import Text.Printf (printf)
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof qualified as Proof
import Verify.TapePair (TapePair (TapePair))
import Verify.TapePair qualified as TapePair

-- | PARTC_TAPES sets another number of damaged tapes. The tapes are then random; without it, they
-- are always the same.
spec :: Spec
spec = do
  asked <- runIO (askedCount "PARTC_TAPES")
  modifyArgs (if isNothing asked then fixed else id) (laws (fromMaybe 5000 asked))

laws :: Int -> Spec
laws tapes = do
  it "parts with several operations are proven on every machine" $
    withMaxSuccess (max 200 (tapes `div` 20)) $
      forAllBlind operated $ \Operated {machine, path, program} ->
        counterexample (show (Machine.name machine)) $
          map show (Proof.findings (Verify.prove machine path program (own program))) === []
  it "tapes that cut the same in another way are proven" $
    withMaxSuccess (max 1000 (tapes `div` 10)) $
      -- The other parts change the tool without a command, so only their planned frames show it.
      forAllBlind byText $ \o ->
        forAllBlind (otherTape o) $ \(starts, frames) ->
          counterexample (Text.unpack (text o) <> show starts) $
            map show (foreignFindings o frames) === []
  folder <- runIO (lookupEnv "PARTC_WRITE_TAPES")
  count <- runIO (newIORef (0 :: Int))
  it "a tape with damage by more than the proof allows is not proven" $
    withMaxSuccess tapes $
      forAllWrong $ \Operated {machine, path, program} pair ->
        tabulate "damage" [TapePair.damage pair] $
          ioProperty $ do
            for_ folder $ \f -> do
              n <- atomicModifyIORef' count (\n -> (n + 1, n + 1))
              TapePair.write f (printf "%05d" n) pair
            let frames = map Frame.frame (TapePair.other pair)
            pure (not (Proof.isProven (Verify.prove machine path program frames)))
  it "a tape with a command elsewhere is not proven" $
    withMaxSuccess (max 300 (tapes `div` 20)) $
      forAllBlind commanded $ \o@Operated {machine, path, program} ->
        forAllBlind (WrongTape.withOtherCommands program) $ \(damage, planned) ->
          let frames = map Frame.frame planned
              begin = Frame.start program
              isWrong' = WrongTape.commandsApart machine (slackOf o) begin (own program) frames
           in TapePair.isReadBack machine begin frames && isWrong'
                ==> tabulate "damage" [damage]
                $ counterexample (difference o frames <> damage) $
                  not (Proof.isProven (Verify.prove machine path program frames))
  it "a tape with damage is wrong for a check that reads only the tapes" $
    withMaxSuccess 20 $
      forAllWrong $ \_ pair ->
        ioProperty $ do
          (code, out) <- TapePair.judged pair
          pure (counterexample out (code === ExitSuccess))
  it "a tape that cuts the same in other frames is not wrong for that check" $
    withMaxSuccess 5 $
      forAllBlind byText $ \o@Operated {machine, program} ->
        forAllBlind (RightTape.otherwiseDivided machine program) $ \frames ->
          TapePair.isReadBack machine (Frame.start program) frames ==> ioProperty $ do
            (code, out) <- TapePair.judged (pairOf o "none" (withOneCutter program frames))
            pure (counterexample out (code === ExitFailure 1))

-- | Property of the wrong tapes of random parts. Tapes that no reader accepts are left out.
forAllWrong :: Testable p => (Operated -> TapePair -> p) -> Property
forAllWrong holds =
  forAllBlind operated $ \o@Operated {machine, path, program} ->
    forAllBlind (WrongTape.damaged machine (`elem` clearingPasses path) program) $
      \(damage, changed) ->
        forAllBlind (oneof [pure changed, recounted program changed]) $ \planned ->
          let frames = map Frame.frame planned
           in isWrong o (map Frame.frame changed)
                && TapePair.isReadBack machine (Frame.start program) frames
                ==> counterexample
                  (difference o frames <> damage <> " on " <> show (Machine.name machine))
                $ holds o (pairOf o damage planned)
  where
    -- As many frames as planned must not hide a damage.
    recounted program = WrongTape.withFrameCount (length (Frame.plannedFrames program))

-- | The text of a program, and the first frames in which another tape differs from its own one.
difference :: Operated -> [Frame] -> String
difference o frames =
  Text.unpack (text o) <> unlines (map show (changedFrames (own (program o)) frames))

-- | Numbers of the first frames in which two tapes differ, with both frames. Nothing where a tape
-- has ended.
changedFrames :: [Frame] -> [Frame] -> [(Int, Maybe Frame, Maybe Frame)]
changedFrames own' other =
  take 5 [(n, a, b) | (n, a, b) <- zip3 [1 .. longer] (filled own') (filled other), a /= b]
  where
    longer = max (length own') (length other)
    filled frames = map Just frames <> repeat Nothing

-- | Frames with the cutter of a program that has only one.
withOneCutter :: FrameProgram -> [Frame] -> [PlannedFrame]
withOneCutter program frames = [p {Frame.frame = f} | p <- take 1 moving, f <- frames]
  where
    moving = filter (Frame.isMoving . Frame.frame) (Frame.plannedFrames program)

-- | A random part with its tape for a machine.
data Operated = Operated
  { -- | the program, or empty if the part was not made from a text
    text :: Text,
    part :: Part,
    machine :: Machine,
    path :: Toolpath,
    program :: FrameProgram
  }

-- | A part with several operations, or a part from a text with any statement.
operated :: Gen Operated
operated = frequency [(3, byOperations), (2, byText)]

byOperations, byText, commanded :: Gen Operated
byOperations = do
  part <- Operations.part
  machine <- elements [m | m <- Machines.known, Machine.name m /= MachineName "kontur-2p"]
  case Toolpath.toToolpath part of
    Result _ [] (Just path) -> maybe byOperations pure (taped "" part path machine)
    _ -> byOperations
byText = elements Machines.known >>= fromText MachinedText.program
commanded = elements machines >>= fromText MachinedText.commanded
  where
    machines = [m | m <- Machines.known, Machine.name m `notElem` map MachineName byHand]
    byHand = ["lki-fm", "lki-u", "lki-un"]

-- | A part from a random text for a machine. Texts without a tape are left out.
fromText :: (Machine -> Gen Text) -> Machine -> Gen Operated
fromText programFor machine = do
  text <- programFor machine
  case Result.ifSound (Compile.analyse [] (LoadedProgram.fromText "p.part" text)) of
    Just Analysis {Compile.part = part, Compile.path = path} ->
      maybe another pure (taped text part path (Target.setUpFor path machine))
    Nothing -> another
  where
    another = fromText programFor machine

-- | A part with its tape, unless the tape cannot be made or is long.
taped :: Text -> Part -> Toolpath -> Machine -> Maybe Operated
taped text part path machine
  | Just program <- Result.ifSound (FromToolpath.quantise machine path),
    frames <- Frame.plannedFrames program,
    not (null frames),
    null (drop 2000 frames) =
    Just Operated {text, part, machine, path, program}
  | otherwise = Nothing

-- | Other starts of contours, and a tape that cuts the same with these starts, with other chords,
-- and with lines divided and joined.
otherTape :: Operated -> Gen (Map Int Point, [Frame])
otherTape o@Operated {part, machine} = do
  finer <- RightTape.withOtherChords part
  starts <- oneof [pure Map.empty, RightTape.otherStarts part]
  punching <- elements [machine, RightTape.lineMachine machine]
  case otherProgram punching starts finer of
    Just other -> (starts,) <$> RightTape.otherwiseDivided machine other
    Nothing -> otherTape o
  where
    otherProgram punching starts finer = do
      moved <- ContourStart.moved starts finer
      path <- Result.ifSound (Toolpath.toToolpath moved)
      Result.ifSound (FromToolpath.quantise punching path)

-- | Findings for a tape that may come from elsewhere.
foreignFindings :: Operated -> [Frame] -> [Report]
foreignFindings Operated {part, machine, path} frames =
  case Result.ifSound (Compile.punch machine path) of
    Just punched ->
      Result.errors
        ( Compile.proveTape
            (Just part)
            Compiled
              { Compile.machine = machine,
                Compile.toolpath = path,
                Compile.punched = punched,
                Compile.proof = Nothing
              }
            frames
        )
    Nothing -> []

own :: FrameProgram -> [Frame]
own = map Frame.frame . Frame.plannedFrames

-- | The own tape of a part with another tape.
pairOf :: Operated -> String -> [PlannedFrame] -> TapePair
pairOf Operated {part, machine, path, program} damage other =
  TapePair
    { TapePair.machine = machine,
      TapePair.start = Frame.start program,
      TapePair.own = Frame.plannedFrames program,
      TapePair.other = other,
      TapePair.damage = damage,
      TapePair.kind = kind,
      TapePair.tolerance = largestTolerance part
    }
  where
    kind
      | Toolpath.isTurned path = "turn"
      | any (isJust . Part.gear) (millings part) = "blade"
      | otherwise = "mill"

-- | Test that a tape surely differs from its program by more than the proof allows: in its speeds
-- alone, or in its path. How a pocket is cleared is free.
isWrong :: Operated -> [Frame] -> Bool
isWrong o@Operated {machine, path, program} frames
  | map shape frames == map shape (own program) = frames /= own program
  | otherwise = away > slack && not (isInPocket path program frames)
  where
    shape f = (Frame.increment f, Frame.centre f, senseOf f)
    senseOf :: Frame -> Maybe Sense
    senseOf f = case Frame.motion f of
      Circular sense -> Just sense
      _ -> Nothing
    slack = slackOf o
    Mm zPulse = Machine.resolutionOf machine Machine.Z
    -- A height may differ by one pulse of the axis z.
    away =
      WrongTape.difference
        machine
        (slack / (2.1 * zPulse))
        (Frame.start program)
        (own program)
        frames

-- | Distance in mm by which a tape surely differs from what the proof allows. Both tapes may
-- deviate by the tolerance and one pulse.
slackOf :: Operated -> Double
slackOf Operated {part, machine} = 3 * (largest + pulse)
  where
    Mm pulse = Machine.planeResolution machine
    Mm largest = largestTolerance part

-- | The largest deviation in mm that an operation of the part allows.
largestTolerance :: Part -> Mm
largestTolerance part =
  maximum
    (Mm 0 : [uncurry max (Part.deviationLimits (Part.tolerance m)) | m <- millings part])

-- | The millings and turnings of a part, those of the walls of pockets included.
millings :: Part -> [Milling]
millings part = concatMap millingOf (Part.operations part)
  where
    millingOf o = case o of
      Part.Mill (Located _ m) -> [m]
      Part.Pocket (Located _ p) -> [Part.wall p]
      _ -> []

-- | Test that a tape differs from its program only in level motions of a pass that clears a pocket,
-- with its approach and its retract.
isInPocket :: Toolpath -> FrameProgram -> [Frame] -> Bool
isInPocket path program frames =
  all (isClearing . Frame.role) changed && all ((== Pulses 0) . rise) (window frames)
  where
    planned = Frame.plannedFrames program
    same = length (takeWhile id (zipWith (==) (own program) frames))
    sameEnd =
      min
        (min (length planned) (length frames) - same)
        (length (takeWhile id (zipWith (==) (reverse (own program)) (reverse frames))))
    window :: [a] -> [a]
    window fs = take (length fs - same - sameEnd) (drop same fs)
    -- An insertion belongs to the frame before it.
    changed = case window planned of
      [] -> take 1 (drop (same - 1) planned)
      some -> some
    rise f = let Pulses3 _ _ z = Frame.increment f in z
    isClearing = maybe False (`elem` clearingPasses path) . Frame.passNumber

-- | The numbers of the passes that clear pockets.
clearingPasses :: Toolpath -> [Int]
clearingPasses path =
  [n | (n, Toolpath.Clearing {}) <- zip (Toolpath.passNumbers blocks) blocks]
  where
    blocks = Toolpath.blocks path
