-- | Sentences about a tape that comes from elsewhere: the first row in which it differs from the
-- tape that the compiler makes of the program, and the machines that can read it.
module Cli.ForeignTape
  ( sentences,
    withReaders,
  )
where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses3 (..))
import Compile (Compiled, Punched (..))
import Compile qualified
import Data.Bits (testBit)
import Data.ByteString qualified as ByteString
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame qualified as Frame
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Machine.TapeCode qualified as TapeCode
import Report.Report (Report (..))
import Tape.Punch qualified as Tape
import Tape.RowMeaning (Row (..))
import Tape.RowMeaning qualified as RowMeaning
import Tape.Tape (Tape (..))

-- | The sentences about the first row that differs: the row that is read and the one that the
-- program's own tape has there. Empty unless both tapes have the same number of rows.
sentences :: Compiled -> Tape -> [Text]
sentences compiled (Tape given) = case differing of
  n : more
    | ByteString.length given == ByteString.length own,
      planned : _ <- drop n rows ->
      [ "Row "
          <> Decimal.whole (n + 1)
          <> maybe "" (\k -> " (frame " <> Decimal.whole k <> ")") (frame planned)
          <> " has "
          <> holesText machine rows (ByteString.index given n)
          <> "; this program's own tape has "
          <> holesText machine rows (holes planned)
          <> " there: "
          <> meaning planned
          <> ".",
        case length more of
          0 -> "All other rows are the same."
          1 -> "One more row differs."
          k -> Decimal.whole k <> " more rows differ."
      ]
  _ -> []
  where
    machine = Compile.machine compiled
    Punched {program, tape = Tape own} = Compile.punched compiled
    rows = Tape.rows machine (Frame.start program) (map Frame.frame (Frame.plannedFrames program))
    differing =
      [ i
        | (i, a, b) <- zip3 [0 ..] (ByteString.unpack given) (ByteString.unpack own),
          a /= b
      ]

-- | The holes of a row as binary digits, the highest track first, with the symbol that they mean if
-- one of the rows @known@ has these holes.
holesText :: Machine -> [Row] -> Word8 -> Text
holesText machine known w =
  "the holes "
    <> Text.pack [if testBit w (k - 1) then '1' else '0' | k <- [count, count - 1 .. 1]]
    <> Text.concat (take 1 symbols)
  where
    count = TapeCode.tracks (Machine.medium machine)
    symbols =
      [" (" <> RowMeaning.shown c <> ")" | Row {holes, symbol = Just c} <- known, holes == w]

-- | Adds to a report on a tape, which the given machine cannot read, the names of the built-in
-- machines that can.
withReaders :: Machine -> Tape -> Report -> Report
withReaders machine given report = case readers of
  [] -> report
  first : more ->
    report
      { hints =
          [ Text.intercalate " and " readers
              <> (if null more then " reads" else " read")
              <> " this tape: write -t "
              <> first
              <> "."
          ]
            <> hints report
      }
  where
    readers =
      [ name
        | m <- BuiltIn.machines,
          let MachineName name = Machine.name m,
          Machine.name m /= Machine.name machine,
          Right (_ : _) <- [Tape.read m (Pulses3 0 0 0) given]
      ]
