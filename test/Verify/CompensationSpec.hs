-- | Proof of tapes with cutter compensation in the control: tapes of the compiler, and damaged
-- ones.
module Verify.CompensationSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Control.Compensation (CompensationError (..))
import Control.Compensation qualified as Compensation
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Frame.Frame (Frame (..), FrameProgram, PlannedFrame, Role (..))
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate qualified
import Generate.Arcs qualified as Arcs
import Generate.ByControl qualified as ByControl
import Generate.MachinedText qualified as MachinedText
import Geometry.Segment (Segment)
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandName (..))
import Machines (iso6983)
import Machines qualified
import Part.Part (Milling)
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck hiding (Fixed)
import Toolpath.Toolpath (Toolpath)
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..), Refusal (..))
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  it
    "random contours with leads are proven by the path of the centre that the control computes \
    \from the edge (catches a proof of the frames alone, an edge that starts at a wrong point)"
    $ property $
      forAll (tolerant =<< ByControl.cases) $ \job -> case made job of
        Nothing -> property Discard
        Just (path, program) -> findings path program (own program) === []
  describe "of random contours" $ do
    changes "the other side" $ \_ fs -> [[f {commands = map exchanged (commands f)} | f <- fs]]
    changes "a diameter of one unit more or less" $ \_ fs ->
      [ [f {commands = [(o, if switchesOn o then v + d else v) | (o, v) <- commands f]} | f <- fs]
        | d <- [1, -1]
      ]
    changes "a lost command that switches compensation on" $ \_ fs ->
      [[f {commands = filter (not . switchesOn . fst) (commands f)} | f <- fs]]
    changes "a lost release" $ \_ fs ->
      [map (without "release") fs]
    changes "a lost frame along the edge" $ \ps fs ->
      [take n fs <> drop (n + 1) fs | n <- cutting ps]
  it
    "a changed tape of a random contour is found if the control then cuts too deep or leaves too \
    \much (catches a proof of the programmed frames, a corner that is not compared)"
    $ property $
      withMaxSuccess 150 $
        forAll (tolerant =<< ByControl.cases) $ \job -> case made job of
          Nothing -> property Discard
          Just (path, program) -> forAll (Arcs.change (own program)) $ \(what, fs) ->
            let (moved, refusals) =
                  Compensation.run iso6983 (const (Mm 0)) (Frame.start program) fs
                centre = concatMap (NonEmpty.toList . Compensation.centrePath) moved
                Arcs.Deviation {Arcs.deepestGouge, Arcs.largestExcess} = deviation centre job
                found = findings path program fs
                gouges = deepestGouge > 0.022
                leaves = largestExcess > 0.022 + 0.01 / (2 * let Mm r = Part.radius job in r)
             in tabulate "change" [takeWhile (/= '(') what] $
                  classify (not gouges && not leaves) "within" $
                    counterexample
                      (show (what, deepestGouge, largestExcess, found))
                      -- The control does not run a tape that it refuses.
                      ( if null refusals
                          then
                            (not gouges || any isGouge found)
                              && (not leaves || any (\f -> isExcess f || isNeverBegun f) found)
                          else any isRefused found
                      )
  it
    "a wrong diameter on the tape is found if its effect is more than the tolerance (catches a \
    \proof with the diameter of the program)"
    $ property $
      forAll (tolerant =<< ByControl.cases) $ \job ->
        forAll (elements [60, -60]) $ \d -> case made job of
          Nothing -> property Discard
          Just (path, program) ->
            let found =
                  findings
                    path
                    program
                    [ f {commands = [(o, if switchesOn o then v + d else v) | (o, v) <- commands f]}
                      | f <- own program
                    ]
             in counterexample
                  (show found)
                  (any (\f -> if d > 0 then isExcessOrRefused f else isGouge f || isLost f) found)
  describe "programs" $
    mapM_
      programs
      ["lead-arc", "lead-arc-right", "corner", "open", "flange", "depth", "curve", "two-tools"]
  it
    "no tape along a random curve is refused by the control (catches frames that are not examined \
    \before the proof)"
    $ property $
      forAllBlind MachinedText.compensatedCurve $ \text ->
        let result =
              Compile.compile
                (Machines.jobFor iso6983 [])
                (LoadedProgram.fromText "p.part" text)
         in counterexample (Text.unpack text) $
              tabulate "outcome" [outcome result] $
                [ f
                  | Just made' <- [Result.output result],
                    Just proof <- map Compile.proof made',
                    f@(Refused _) <- Proof.findings proof
                ]
                  === []
  it "a lost release is refused by the control" $ do
    (path, program) <- compiled "flange"
    let unreleased = map (without "release") (own program)
        found = findings path program unreleased
    [n | Refused (NotCompensated (NotSwitchedOff n)) <- found]
      `shouldBe` [length (own program)]
  where
    outcome result = case Result.errors result of
      [] -> "taped"
      e : _ -> show (Report.code e)
    programs name = it (name <> " is proven") $ do
      (path, program) <- compiled name
      findings path program (own program) `shouldBe` []

-- | Law: none of the changed tapes is proven.
changes :: String -> ([PlannedFrame] -> [Frame] -> [[Frame]]) -> Spec
changes what change =
  it ("is found: " <> what) $
    property $
      forAll (tolerant =<< ByControl.cases) $ \job -> case made job of
        Nothing -> property Discard
        Just (path, program) ->
          conjoin
            [ counterexample (show fs) (findings path program fs /= [])
              | fs <- change (Frame.plannedFrames program) (own program),
                fs /= own program
            ]

-- | Frame without a command.
without :: Text -> Frame -> Frame
without name f = f {commands = filter ((/= CommandName name) . fst) (commands f)}

own :: FrameProgram -> [Frame]
own program = map Frame.frame (Frame.plannedFrames program)

-- | Numbers of the frames along the edge, from 0.
cutting :: [PlannedFrame] -> [Int]
cutting ps = [n | (n, p) <- zip [0 ..] ps, Cutting _ <- [Frame.role p]]

-- | Deviation of a path of the cutter's centre from the contour of a milling.
deviation :: [Segment] -> Milling -> Arcs.Deviation
deviation centre job =
  Arcs.pathDeviation centre (map Part.segment (NonEmpty.toList (Part.elements contour))) radius
  where
    Part.Milling {Part.contour, Part.radius = Mm radius} = job

-- | Command with the sides exchanged.
exchanged :: (CommandName, Int) -> (CommandName, Int)
exchanged (o, v)
  | o == CommandName "left" = (CommandName "right", v)
  | o == CommandName "right" = (CommandName "left", v)
  | otherwise = (o, v)

-- | Test that a command switches compensation on.
switchesOn :: CommandName -> Bool
switchesOn o = o == CommandName "left" || o == CommandName "right"

isExcess, isGouge, isRefused, isExcessOrRefused, isLost, isNeverBegun :: Finding -> Bool
isExcess f = case f of
  Excess {} -> True
  _ -> False
isGouge f = case f of
  Gouge {} -> True
  _ -> False
isRefused f = case f of
  Refused _ -> True
  _ -> False
isExcessOrRefused f = isExcess f || isRefused f || isLost f
isLost f = case f of
  NotFollowed _ -> True
  _ -> isNeverBegun f
-- A contour that is never begun has no excess.
isNeverBegun f = case f of
  NeverBegun {} -> True
  _ -> False

findings :: Toolpath -> FrameProgram -> [Frame] -> [Finding]
findings path program fs = Proof.findings (Verify.prove iso6983 path program fs)

-- | Milling with a tolerance.
tolerant :: (Generate.Case, Milling) -> Gen Milling
tolerant (_, job) = pure job {Part.tolerance = Part.OnPath (Mm 0.02)}

-- | Toolpath and frames of a milling with compensation. Nothing if the same milling without
-- compensation is not proven to a slightly smaller tolerance: linking moves that cut or graze the
-- part say nothing about the control.
made :: Milling -> Maybe (Toolpath, FrameProgram)
made job = do
  (uncompensated, frames) <-
    toolpathOf job {Part.controlCompensation = Nothing, Part.tolerance = Part.OnPath (Mm 0.015)}
  if null (findings uncompensated frames (own frames)) then toolpathOf job else Nothing
  where
    toolpathOf m = do
      from <- listToMaybe [p | Part.Stop (Located _ p) _ _ <- Part.approach m]
      path <- ByControl.path (Vec.shift (Vec.vec 7 5) from) m
      program <- Result.output (FromToolpath.quantise iso6983 path)
      Just (path, program)

-- | Toolpath and frames of one of the programs for cutter compensation.
compiled :: String -> IO (Toolpath, FrameProgram)
compiled name = do
  text <- readText ("test/programs/mill/good/compensation-" <> name <> ".part") :: IO Text
  case Result.ifSound
    ( Compile.analyse [] (LoadedProgram.fromText "p.part" text) `Result.thenSound` \a ->
        (,) (path a) . Compile.program <$> Compile.punch iso6983 (path a)
    ) of
    Just both -> pure both
    Nothing -> fail "the program has errors"
