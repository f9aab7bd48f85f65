-- | @stages KIND N MACHINE@: runs the stages of the compiler, from the text to the proof, in one
-- process. Prints the milliseconds of processor time of each, and then the peak memory in
-- kilobytes.
--
-- Each stage ends when a number that needs its whole output is known. A thunk counts in the stage
-- that evaluates it; so does garbage collection.
module Main (main) where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), total)
import Base.Region qualified as Region
import Base.Result qualified as Result
import Checked.FromSurface qualified as Checked
import Checked.Syntax qualified as Checked
import Compile qualified
import Control.Exception (evaluate)
import Data.Bifunctor (first)
import Data.Functor.Identity (runIdentity)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Frame.Frame (increment)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as Frame
import Geometry.Segment qualified as Segment
import Machine.Machine (Machine)
import Part.FromChecked qualified as Part
import Part.Part qualified as Part
import Programs (Written (..))
import Programs qualified
import Project.LoadedProgram qualified as LoadedProgram
import Project.MachineDescription qualified as MachineDescription
import Report.Report (Report)
import Report.Report qualified as Report
import Surface.Import qualified as Import
import Surface.Syntax qualified as Surface
import System.CPUTime (getCPUTime)
import System.Environment (getArgs)
import System.Exit (die)
import System.FilePath (takeFileName)
import System.Mem (performGC)
import Tape.Punch qualified as Tape
import Tape.Tape (Tape)
import Tape.Tape qualified as Tape
import Text.Read (readMaybe)
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Proof qualified as Proof

main :: IO ()
main = do
  arguments <- getArgs
  case arguments of
    [k, n, m]
      | Just kind <- readMaybe k,
        Just count <- readMaybe n,
        Right machine <- MachineDescription.find [] (Text.pack m) ->
        stages machine (Programs.written kind count)
    _ -> die "stages KIND N MACHINE"

stages :: Machine -> Written -> IO ()
stages machine Written {text, files} = do
  _ <- evaluate (sum (map Text.length (text : map snd files)))
  performGC
  surface <-
    stage
      "parse"
      (sum . map itemsOf . Surface.statements)
      ( pure
          ( reported
              ( LoadedProgram.surface
                  (runIdentity (LoadedProgram.load (Import.byName reader) "bench.part" text))
              )
          )
      )
  checked <-
    stage
      "check"
      (round . sum . map weight . Checked.statements)
      (pure (plain (Checked.check surface)))
  part <-
    stage
      "part"
      (sum . map (round . contourLength) . Part.contours)
      (pure (plain (Part.evaluate checked)))
  path <- stage "path" (round . pathLength) (pure (plain (Toolpath.toToolpath part)))
  program <-
    stage
      "frames"
      (sum . map (distance . increment . Frame.frame) . Frame.plannedFrames)
      (pure (plain (Frame.quantise machine path)))
  tape <-
    stage
      "tape"
      Tape.rowCount
      ( pure
          ( Right
              ( Tape.write
                  machine
                  (Frame.start program)
                  (map Frame.frame (Frame.plannedFrames program))
              )
          )
      )
  _ <- stage "verify" (length . show . Proof.findings) (pure (proof path program tape))
  status <- readFile "/proc/self/status"
  putStrLn
    ( unwords
        ( "memory" :
          concat [take 1 (drop 1 (words line)) | line <- lines status, take 6 line == "VmHWM:"]
        )
    )
  where
    reader there = pure (maybe (Left "no such file") Right (lookup (takeFileName there) files))
    proof :: Toolpath -> Frame.FrameProgram -> Tape -> Either Text Proof.Proof
    proof path program tape =
      readBack machine program tape >>= reported . Compile.prove machine path program

-- | The frames of a tape, which must be those of a program.
readBack :: Machine -> Frame.FrameProgram -> Tape -> Either Text [Frame.Frame]
readBack machine program tape =
  first
    (Report.title . Tape.toReport)
    ( Tape.readExpected
        machine
        (Frame.start program)
        (map Frame.frame (Frame.plannedFrames program))
        tape
    )

-- | Runs a stage and prints its time. The function computes a number for which the whole output
-- must be evaluated.
stage :: String -> (a -> Int) -> IO (Either Text a) -> IO a
stage title summary action = do
  begin <- getCPUTime
  result <- action
  case result of
    Left why ->
      Text.putStrLn ("failed " <> Text.pack title <> ": " <> why)
        >> die "a program of the benchmark has errors"
    Right value -> do
      _ <- evaluate (summary value)
      end <- getCPUTime
      putStrLn (title <> " " <> show (fromIntegral (end - begin) / 1e9 :: Double))
      pure value

reported :: Result.Result w Report a -> Either Text a
reported r = case (Result.errors r, Result.output r) of
  ([], Just a) -> Right a
  (e : _, _) -> Left (Report.title e)
  ([], Nothing) -> Left "no output"

plain :: Show e => Result.Result w e a -> Either Text a
plain r = case (Result.errors r, Result.output r) of
  ([], Just a) -> Right a
  (e : _, _) -> Left (Text.take 200 (Text.pack (show e)))
  ([], Nothing) -> Left "no output"

itemsOf :: Surface.Statement -> Int
itemsOf s = case Region.value s of
  Surface.Contour _ _ items ->
    sum
      [1 | Region.Located _ (Surface.Element _ e _ _) <- items, Region.start (Region.region e) >= 0]
  _ -> 1

weight :: Checked.Statement -> Double
weight s = case Region.value s of
  Checked.Contour _ _ items ->
    sum
      [ x + y
        | Region.Located
            _
            ( Checked.Element
                _
                ( Region.Located
                    _
                    ( Checked.Pair
                        (Region.Located _ (Checked.Number x))
                        (Region.Located _ (Checked.Number y))
                      )
                  )
                _
                _
              ) <-
            items
      ]
  _ -> 1

contourLength :: Part.Contour -> Double
contourLength c =
  let Mm l = total (map (Segment.length . Part.segment) (NonEmpty.toList (Part.elements c))) in l

pathLength :: Toolpath -> Double
pathLength p =
  let Mm l =
        total
          (map (Segment.length . Toolpath.segment) (concatMap Toolpath.moves (Toolpath.blocks p)))
   in l

distance :: Pulses3 -> Int
distance (Pulses3 (Pulses x) (Pulses y) (Pulses z)) = abs x + abs y + abs z
