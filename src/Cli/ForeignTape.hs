-- | Reports on a tape that comes from elsewhere: damage of the tape, and findings of its proof.
--
-- A tape that is a text file, such as G-code, is shown by its lines, like a program. A punched tape
-- is described by its rows.
module Cli.ForeignTape
  ( TapeFile (..),
    damaged,
    otherDamaged,
    disproven,
  )
where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses3 (..))
import Base.Region (Region (Region), Source)
import Base.Region qualified as Region
import Cli.TapeDifference (isOneChange, isTextFile, lineAround, textOf, withDifference)
import Compile (Compiled, Punched (..))
import Compile qualified
import Data.ByteString qualified as ByteString
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Report.Report (Label (..), Report (..), ReportPlace (..))
import Report.Report qualified as Report
import Tape.Damage (Damage)
import Tape.Damage qualified as Damage
import Tape.Punch qualified as Tape
import Tape.RowMeaning (Row (..))
import Tape.Tape (Tape (..))
import Toolpath.Toolpath qualified as Toolpath
import Verify.Proof (Proof)
import Verify.Proof qualified as Proof

-- | A tape that is compared with a program: the name of its file, its rows, and the frames that are
-- read from it, or the damage because of which they cannot be read.
data TapeFile = TapeFile {fileName :: Text, rows :: Tape, contents :: ~(Either Damage [Frame])}

-- | The source and the report of damage to the tape in the file @name@. The report names the
-- built-in machines that can read the tape.
damaged :: Machine -> Text -> Tape -> Damage -> (Source, Report)
damaged machine name given damage
  | isTextFile machine = (Region.fromText name text, withReaders machine given (inText report))
  | otherwise = (Region.fromText name "", withReaders machine given report)
  where
    report = Tape.toReport damage
    text = textOf given
    inText r = case place r of
      InTape n
        | let at = max 1 (min n (Text.length text)) ->
          r {title = Damage.fault damage, place = InSource (Region (at - 1) at)}
      _ -> r

-- | The source and the report of damage to a tape that should be the one of a program. The report
-- also has the first difference from the program's own tape, unless the tape is one of another
-- machine.
otherDamaged :: Compiled -> TapeFile -> Damage -> (Source, Report)
otherDamaged compiled TapeFile {fileName, rows} damage =
  (source, if null (readersOf machine rows) then withDifference compiled 0 rows told else report)
  where
    machine = Compile.machine compiled
    told = if isCutOff then cutOff report else report
    Tape given = rows
    Tape own = tape (Compile.punched compiled)
    isCutOff = given `ByteString.isPrefixOf` own
    cutOff r = r {hints = ["Copy the file again, or punch the tape anew with partc compile."]}
    (source, report) = damaged machine fileName rows damage

-- | The source and the reports of the findings about a tape. The argument @source@ is the
-- program's source; the result contains the text of the tape as well, if it is a text file.
-- @frames@ are the frames that are read from the tape. The first report has the first difference
-- from the program's own tape.
disproven :: Compiled -> TapeFile -> [Frame] -> Source -> Proof -> (Source, [Report])
disproven compiled TapeFile {fileName, rows = given} frames source proof
  | isTextFile machine =
    ( Region.addFile fileName (textOf given) source,
      differing (zipWith withLine (Proof.findings proof) found)
    )
  | otherwise = (source, differing found)
  where
    machine = Compile.machine compiled
    found = Proof.toReports (Toolpath.unit (Compile.toolpath compiled)) machine proof
    base = Region.nextOffset source
    -- The findings that one change makes are one report, the first in the order of the tape.
    differing reports
      | isOneChange compiled given = case reports of
        first : more ->
          [withDifference compiled base given first {message = message first <> moreText more}]
        [] -> []
      | otherwise = case Report.sorted reports of
        first : more -> withDifference compiled base given first : more
        [] -> []
    moreText more = case length more of
      0 -> []
      1 -> ["The proof has one more finding of this change."]
      n -> ["The proof has " <> Decimal.whole n <> " more findings of this change."]
    withLine finding report =
      report
        { others =
            others report
              <> [ Label (lineAround base given at) ("frame " <> Decimal.whole n)
                   | Just n <- [Proof.frameOf finding],
                     at : _ <- [[i | (i, Row {frame = Just k}) <- zip [0 ..] written, k == n]]
                 ]
        }
    -- A tape may contain rows that the reader skips; then the lines of the frames are not known.
    written = case Tape.rows machine start frames of
      ours | Tape (ByteString.pack (map holes ours)) == given -> ours
      _ -> []
    start = Frame.start (program (Compile.punched compiled))

-- | The report on a tape that the given machine cannot read. It says for which built-in machines
-- the tape is, if any of them can read it.
withReaders :: Machine -> Tape -> Report -> Report
withReaders machine given report = case readersOf machine given of
  [] -> report
  readers@(first : _) ->
    report
      { title =
          "this is a tape of "
            <> Text.intercalate " or " readers
            <> ", and "
            <> own
            <> " cannot read it",
        message = [],
        hints = ["Write -t " <> first <> "."]
      }
  where
    MachineName own = Machine.name machine

-- | The names of the built-in machines, other than the given one, that can read the tape.
readersOf :: Machine -> Tape -> [Text]
readersOf machine given =
  [ name
    | m <- BuiltIn.machines,
      let MachineName name = Machine.name m,
      Machine.name m /= Machine.name machine,
      Right (_ : _) <- [Tape.read m (Pulses3 0 0 0) given]
  ]
