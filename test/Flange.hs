-- | The flange of the Ural paper, compiled once for all tests, and the exact nodes of its drawing.
module Flange
  ( text,
    analysis,
    program,
    tape,
    proof,
    frames,
    expect,
    exactNodes,
  )
where

import Base.Result qualified as Result
import Compile (Analysis, Compiled)
import Compile qualified
import Data.ByteString qualified as ByteString
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import Frame.Frame (Frame, FrameProgram)
import Frame.Frame qualified as Frame
import Machines (lkp01f)
import Machines qualified
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import System.IO.Unsafe (unsafePerformIO)
import Tape.Tape (Tape)
import Verify.Proof (Proof)

-- | The program examples/flange.part.
text :: Text
text = Encoding.decodeUtf8 (unsafePerformIO (ByteString.readFile "examples/flange.part"))
{-# NOINLINE text #-}

-- | The flange's part and toolpath.
analysis :: Analysis
analysis = expect (Compile.analyse [] loaded)

loaded :: LoadedProgram
loaded = LoadedProgram.fromText "flange.part" text

-- | The flange's verified tape for lkp-01f.
compiled :: Compiled
compiled = case expect (Compile.compile (Machines.jobFor lkp01f []) loaded) of
  [one] -> one
  tapes -> error ("one machine has " <> show (length tapes) <> " tapes")

-- | The planned frames of the flange's tape for lkp-01f.
program :: FrameProgram
program = Compile.program (Compile.punched compiled)

-- | The flange's tape for lkp-01f.
tape :: Tape
tape = Compile.tape (Compile.punched compiled)

-- | The proof of that tape.
proof :: Maybe Proof
proof = Compile.proof compiled

-- | The frames of that tape.
frames :: [Frame]
frames = map Frame.frame (Frame.plannedFrames program)

-- | The output of a result that must have no errors.
expect :: Show e => Result.Result w e a -> a
expect r = case Result.ifSound r of
  Just a -> a
  Nothing -> error ("the flange has errors: " <> show (Result.errors r))

-- | The 18 nodes of the equidistant in mm, in the order of the paper. They were computed from the
-- drawing without partc, and are rounded to 0.0001 mm.
exactNodes :: [(Double, Double)]
exactNodes =
  [ (4.9343, 40.9132),
    (7.4339, 61.2915),
    (14.3993, 73.4239),
    (24.4448, 90.8232),
    (31.4691, 102.9216),
    (47.8674, 115.2755),
    (70.7326, 115.2755),
    (87.1309, 102.9216),
    (94.1552, 90.8232),
    (104.2007, 73.4239),
    (111.1661, 61.2915),
    (113.6657, 40.9132),
    (102.2331, 21.1113),
    (83.3352, 13.0869),
    (69.3455, 13.0529),
    (49.2545, 13.0529),
    (35.2648, 13.0869),
    (16.3669, 21.1113)
  ]
