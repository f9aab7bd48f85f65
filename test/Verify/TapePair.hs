-- | Pairs of tapes as files, for @scripts/wrong_tapes.py@: the tape that the compiler makes, and
-- another tape for the same part. The script judges from these files alone if the other tape is
-- wrong.
module Verify.TapePair
  ( TapePair (..),
    write,
    judged,
    isReadBack,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Command (inFolder)
import Data.Aeson (Value, encodeFile, object, (.=))
import Data.ByteString qualified as ByteString
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame, PlannedFrame)
import Frame.Frame qualified as Frame
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import System.Exit (ExitCode)
import System.FilePath ((</>))
import System.Process (readProcessWithExitCode)
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))

-- | Two tapes for one machine that begin at the same position.
data TapePair = TapePair
  { machine :: Machine,
    -- | the position of the cutter before both tapes, in pulses
    start :: Pulses3,
    -- | the frames that the compiler makes
    own :: [PlannedFrame],
    -- | the frames of the other tape, each with its cutter
    other :: [PlannedFrame],
    -- | the damage of the other tape
    damage :: String,
    -- | the kind of the tool: @mill@, @turn@ or @blade@
    kind :: Text,
    -- | the largest deviation that the part allows, in mm
    tolerance :: Mm
  }

-- | Writes a pair into a folder: both tapes, and what an operator would have to know beside them,
-- in files that begin with the given name.
write :: FilePath -> String -> TapePair -> IO ()
write folder name pair = do
  tapeFile ".own.tape" (own pair)
  tapeFile ".other.tape" (other pair)
  encodeFile (folder </> name <> ".json") (card pair)
  where
    tapeFile suffix frames =
      ByteString.writeFile
        (folder </> name <> suffix)
        (rowsOf (machine pair) (start pair) (map Frame.frame frames))

-- | Exit status and output of @scripts/wrong_tapes.py@ for a single pair. The status is 1 if the
-- script does not confirm that the other tape is wrong.
judged :: TapePair -> IO (ExitCode, String)
judged pair = inFolder $ \folder -> do
  write folder "pair" pair
  (code, out, err) <- readProcessWithExitCode "python3" ["scripts/wrong_tapes.py", folder] ""
  if null err then pure (code, out) else fail err

-- | The facts about a pair that are on neither tape. Lengths are in mm, positions in pulses.
card :: TapePair -> Value
card pair =
  object
    [ "machine" .= machineName,
      "damage" .= damage pair,
      "kind" .= kind pair,
      "start" .= [x, y, z],
      "pulse" .= map (mm . Machine.resolutionOf (machine pair)) [Machine.X, Machine.Y, Machine.Z],
      "reversed"
        .= [ Text.pack (show (Machine.axis f))
             | f <- NonEmpty.toList (Machine.axes (machine pair)),
               Machine.reversed f
           ],
      "tolerance" .= mm (tolerance pair),
      "cutters" .= object ["own" .= cutters (own pair), "other" .= cutters (other pair)]
    ]
  where
    MachineName machineName = Machine.name (machine pair)
    Pulses3 (Pulses x) (Pulses y) (Pulses z) = start pair

mm :: Mm -> Double
mm (Mm l) = l

-- | The cutters of a tape: for each the number of its first frame, from 1, and its radius in mm.
cutters :: [PlannedFrame] -> [(Int, Double)]
cutters frames =
  [ (n, mm radius)
    | (radius, before, n) <- zip3 radii (Nothing : map Just radii) numbers,
      Just radius /= before
  ]
  where
    moving = [(n, p) | (n, p) <- zip [1 ..] frames, Frame.isMoving (Frame.frame p)]
    radii = map (Frame.cutterRadius . snd) moving
    numbers = map fst moving

-- | Test that a tape with these frames is read back as the same frames. Frames that the machine
-- does not have, such as an increment with too many digits, are not.
isReadBack :: Machine -> Pulses3 -> [Frame] -> Bool
isReadBack machine begin frames =
  null (Frame.violations machine frames)
    && Punch.read machine begin (Tape (rowsOf machine begin frames)) == Right frames

rowsOf :: Machine -> Pulses3 -> [Frame] -> ByteString.ByteString
rowsOf machine begin frames = let Tape rows = Punch.write machine begin frames in rows
