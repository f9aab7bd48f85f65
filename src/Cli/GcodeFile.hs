-- | Files of G-code that come from elsewhere: how they are read, and the reports about them.
module Cli.GcodeFile
  ( GcodeFile (..),
    read,
    readAlone,
    tapeAlone,
    listing,
    reports,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region (Region), Source)
import Base.Region qualified as Region
import Compile (Compiled, Punched (..))
import Compile qualified
import Data.IntMap.Strict qualified as IntMap
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.TapeRows (RowRange (..))
import Frame.TurnFeed qualified as TurnFeed
import Gcode.Block (Fault (..))
import Gcode.FaultReport qualified as FaultReport
import Gcode.Heading qualified as Heading
import Gcode.Run qualified as Run
import Gcode.ToFrames (GcodeReading (..), ReadFrame (..))
import Gcode.ToFrames qualified as ToFrames
import Machine.Machine (Machine, ProgramForm)
import Report.Report (Label (..), Report (others, place), ReportPlace (..))
import Tape.Punch qualified as Tape
import Tape.Tape (Tape)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromGcode qualified as FromGcode
import Verify.Proof (Proof)
import Verify.Proof qualified as Proof
import Prelude hiding (read)

-- | A file: its name and its text.
data GcodeFile = GcodeFile {fileName :: Text, fileText :: Text}

-- | Reads the files that should be those of a program. The report of a line that is not understood
-- comes with its source.
read :: ProgramForm -> Compiled -> [GcodeFile] -> Either (Source, Report) GcodeReading
read form compiled gcode =
  case FromGcode.readTexts machine form heading planned (map fileText gcode) of
    Left fault@(Fault n _ _) ->
      let (_, file, before) = fileOfLine gcode n
          regionOf k = regionFrom (fileText file) 0 (k - before)
       in Left
            ( Region.fromText (fileName file) (fileText file),
              FaultReport.toReport regionOf fault
            )
    Right reading -> Right reading
  where
    machine = Compile.machine compiled
    heading = Heading.fromToolpath (Compile.toolpath compiled)
    planned = program (Compile.punched compiled)

-- | Reads a file without its program. The tool comes down where the file says, and from a position
-- of 0.
readAlone :: Machine -> ProgramForm -> GcodeFile -> Either (Source, Report) GcodeReading
readAlone machine form file = case Run.run form Nothing 1 (fileText file) of
  Left fault ->
    Left
      ( Region.fromText (fileName file) (fileText file),
        FaultReport.toReport (regionFrom (fileText file) 0) fault
      )
  Right steps -> Right (ToFrames.reading setting 0 steps)
  where
    setting =
      ToFrames.FileSetting
        { ToFrames.machine,
          ToFrames.level = Nothing,
          ToFrames.firstNumber = Nothing,
          ToFrames.tips = Map.empty,
          ToFrames.stops = [],
          ToFrames.commandPlaces = []
        }

-- | The tape that has the frames of a file alone, and what was read from the file. The file is read
-- without its program.
tapeAlone ::
  Machine -> ProgramForm -> GcodeFile -> Either (Source, Report) (Tape, GcodeReading)
tapeAlone machine form file = made <$> readAlone machine form file
  where
    made reading =
      (Tape.write machine 0 (TurnFeed.perMinute machine 0 (FromGcode.framesRead reading)), reading)

-- | Lines of a file in a range, each with its number and the frames that are read from it, and the
-- unit of the range with the count of these units in the file.
listing :: RowRange -> GcodeFile -> GcodeReading -> ([Text], (Text, Int))
listing range file reading =
  ( [ Text.justifyRight 6 ' ' (Decimal.whole n) <> "  " <> text <> frameWords text numbers
      | (n, text) <- zip [1 ..] (Text.lines (fileText file)),
        let numbers = IntMap.findWithDefault [] n frameNumbers,
        isInRange n numbers
    ],
    extent
  )
  where
    frameNumbers =
      IntMap.fromListWith
        (flip (<>))
        [(readFrom f, [k]) | (k, f) <- zip [1 :: Int ..] (readFrames reading)]
    isInRange n numbers = case range of
      Everything -> True
      Rows a b -> a <= n && n <= b
      Frames a b -> any (\k -> a <= k && k <= b) numbers
    extent = case range of
      Frames _ _ -> ("frame", length (readFrames reading))
      _ -> ("line", length (Text.lines (fileText file)))
    frameWords text numbers
      | null numbers = ""
      | otherwise =
        Text.replicate (max 2 (44 - Text.length text)) " "
          <> Text.intercalate ", " ["frame " <> Decimal.whole k | k <- numbers]

-- | File that contains a line, which is counted over all files: its index from 0, the file, and the
-- count of lines before it.
fileOfLine :: [GcodeFile] -> Int -> (Int, GcodeFile, Int)
fileOfLine gcode n = go 0 0 gcode
  where
    go k before list = case list of
      [] -> (k, GcodeFile "" "", before)
      [file] -> (k, file, before)
      file : more
        | n <= before + lineCount file -> (k, file, before)
        | otherwise -> go (k + 1) (before + lineCount file) more
    lineCount = length . Text.lines . fileText

-- | Reports of the proof of files, with the source that has the program and the files.
reports ::
  ProgramForm -> Compiled -> [GcodeFile] -> Source -> GcodeReading -> Proof -> (Source, [Report])
reports form compiled gcode source reading proof =
  ( foldl (\s f -> Region.addFile (fileName f) (fileText f) s) source gcode,
    zipWith
      withLine
      frames
      (Compile.gcodeReports unit (Compile.machine compiled) form lineRegion proof)
  )
  where
    unit = Toolpath.unit (Compile.toolpath compiled)
    bases = scanl (\at f -> at + Text.length (fileText f) + 1) (Region.nextOffset source) gcode
    lineRegion n =
      let (index, file, before) = fileOfLine gcode n
       in regionFrom (fileText file) (bases !! index) (n - before) 1
    frames =
      map (const Nothing) (Proof.controlFindings proof)
        <> map Proof.frameOf (Proof.findings proof)
    -- A report without a line of its own is about the end of the last file.
    withLine frame report = case FromGcode.lineOfFrame reading (fromMaybe lastFrame frame) of
      Just k -> atLine frame (lineRegion k) report
      Nothing -> maybe report (\k -> atLine Nothing (lineRegion k) report) lastLine
    lastLine = FromGcode.lineOfFrame reading lastFrame
    lastFrame = length (FromGcode.framesRead reading)

-- | Report with the region of a line: as its place, or beside a place in the program with the
-- number of the frame.
atLine :: Maybe Int -> Region -> Report -> Report
atLine frame region report = case (place report, frame) of
  (InFile, _) -> report {place = InSource region}
  (InSource _, Just n) ->
    report {others = others report <> [Label region ("frame " <> Decimal.whole n)]}
  _ -> report

-- | Region of a line from a column on, both counted from 1. The text begins at an offset.
regionFrom :: Text -> Int -> Int -> Int -> Region
regionFrom text base n column = Region (begin + min (column - 1) size) (begin + size)
  where
    before = take (n - 1) (Text.lines text)
    begin = base + sum (map ((+ 1) . Text.length) before)
    size = case drop (n - 1) (Text.lines text) of
      l : _ -> Text.length l
      [] -> 0
