-- | Files of G-code that come from elsewhere: how they are read, and the reports about them.
module Cli.GcodeFile
  ( GcodeFile (..),
    read,
    reports,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region (Region), Source)
import Base.Region qualified as Region
import Compile (Compiled, Punched (..))
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame qualified as Frame
import Gcode.FaultReport qualified as FaultReport
import Gcode.Heading qualified as Heading
import Gcode.ToFrames (Reading)
import Machine.Machine (ProgramForm)
import Report.Report (Label (..), Report (others))
import Verify.FromGcode qualified as FromGcode
import Verify.Proof (Proof)
import Verify.Proof qualified as Proof
import Prelude hiding (read)

-- | A file: its name and its text.
data GcodeFile = GcodeFile {fileName :: Text, fileText :: Text}

-- | Reads a file that should be the one of a program. The report of a line that is not understood
-- comes with its source.
read :: ProgramForm -> Compiled -> GcodeFile -> Either (Source, Report) Reading
read form compiled file = case FromGcode.readTexts machine form heading start [fileText file] of
  Left fault -> Left (source, FaultReport.toReport (regionFrom (fileText file) 0) fault)
  Right reading -> Right reading
  where
    machine = Compile.machine compiled
    heading = Heading.fromToolpath (Compile.toolpath compiled)
    start = Frame.start (program (Compile.punched compiled))
    source = Region.fromText (fileName file) (fileText file)

-- | Reports of the proof of a file, with the source that has the program and the file.
reports :: ProgramForm -> Compiled -> GcodeFile -> Source -> Reading -> Proof -> (Source, [Report])
reports form compiled file source reading proof =
  ( Region.addFile (fileName file) (fileText file) source,
    zipWith withLine places (Compile.gcodeReports (Compile.machine compiled) form lineRegion proof)
  )
  where
    base = Region.nextOffset source
    lineRegion n = regionFrom (fileText file) base n 1
    places = map (const Nothing) (Proof.controlFindings proof) <> map Proof.frameOf (Proof.findings proof)
    withLine place report = case place of
      Just n
        | Just k <- FromGcode.lineOfFrame reading n ->
          report {others = others report <> [Label (lineRegion k) ("frame " <> Decimal.whole n)]}
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
