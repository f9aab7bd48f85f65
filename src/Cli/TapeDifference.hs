-- | The first difference of a tape from the tape that the compiler makes of the program: a line of
-- a text file, such as G-code, or a row of a punched tape.
module Cli.TapeDifference
  ( withDifference,
    isOneChange,
    isTextFile,
    textOf,
    lineAround,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region (Region, start))
import Compile (Compiled, Punched (..))
import Compile qualified
import Data.Bits (testBit)
import Data.ByteString qualified as ByteString
import Data.Maybe (isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Text
import Data.Word (Word8)
import Frame.Frame qualified as Frame
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Machine.TapeCode qualified as TapeCode
import Report.Report (Label (..), Report (..), ReportPlace (..))
import Tape.Punch qualified as Tape
import Tape.RowMeaning (Row (..))
import Tape.RowMeaning qualified as RowMeaning
import Tape.Tape (Tape (..))

-- | Test that the tapes of a machine are text files, which have lines, and not punched tapes.
isTextFile :: Machine -> Bool
isTextFile = isNothing . TapeCode.pitch . Machine.medium

-- | The text of a tape that is a text file. Each row is one character.
textOf :: Tape -> Text
textOf (Tape rows) = Text.decodeLatin1 rows

-- | The region of the line that contains the row @n@, from 0, of a tape. The text of the tape
-- begins at the offset @base@ of the source.
lineAround :: Int -> Tape -> Int -> Region
lineAround base tape n = Region (base + n - Text.length before) (base + n + Text.length after)
  where
    (left, right) = Text.splitAt n (textOf tape)
    before = Text.takeWhileEnd (/= '\n') left
    after = Text.takeWhile (/= '\n') right

-- | Adds the first difference between the given tape and the program's own to a report. The text of
-- the tape, if it is a text file, begins at the offset @base@ of the source. If such a text differs
-- from the program's own tape in a few lines only, the report points to the first of these lines.
withDifference :: Compiled -> Int -> Tape -> Report -> Report
withDifference compiled base given report
  | not (isTextFile machine) =
    report {message = message report <> firstRow machine planned given own}
  | given == own = report
  | isFew lines' && not (isOnTape (place report)) =
    pointedTo (firstLine base given lines') more report
  | otherwise = report {others = others report <> [firstLine base given lines'], message = more}
  where
    machine = Compile.machine compiled
    Punched {program, tape = own} = Compile.punched compiled
    planned =
      Tape.rows machine (Frame.start program) (map Frame.frame (Frame.plannedFrames program))
    lines' = changedLines (Text.lines (textOf given)) (Text.lines (textOf own))
    more = message report <> otherLines lines'
    isOnTape at = case at of
      InSource region -> start region >= base
      _ -> False

-- | Test that a tape is a text file, and differs from the program's own tape in a few lines only.
isOneChange :: Compiled -> Tape -> Bool
isOneChange compiled given =
  isTextFile (Compile.machine compiled)
    && given /= own
    && isFew (changedLines (Text.lines (textOf given)) (Text.lines (textOf own)))
  where
    Punched {tape = own} = Compile.punched compiled

-- | Moves the place of a report to a label. The former place becomes another mark.
pointedTo :: Label -> [Text] -> Report -> Report
pointedTo (Label at words') sentences report =
  report
    { place = InSource at,
      label = words',
      others = [Label region (label report) | InSource region <- [place report]] <> others report,
      message = sentences,
      hints =
        hints report <> ["Undo this change, or make it in the program and compile that again."]
    }

-- | Lines of a tape and of the program's own tape: the count of lines at the beginning that are the
-- same, the changed lines of both, and the count of lines at the end that are the same.
data ChangedLines = ChangedLines
  { linesBefore :: Int,
    found :: [Text],
    expected :: [Text],
    linesAfter :: Int
  }

-- | The lines in which two texts differ.
changedLines :: [Text] -> [Text] -> ChangedLines
changedLines given own =
  ChangedLines
    { linesBefore = before,
      found = take (length given - before - after) (drop before given),
      expected = take (length own - before - after) (drop before own),
      linesAfter = after
    }
  where
    before = sameLines given own
    after = sameLines (reverse (drop before given)) (reverse (drop before own))
    sameLines as bs = length (takeWhile id (zipWith (==) as bs))

-- | Test that a text was changed in one place, and not written anew.
isFew :: ChangedLines -> Bool
isFew ChangedLines {found, expected} = max (length found) (length expected) <= 5

-- | Label at the first changed line.
firstLine :: Int -> Tape -> ChangedLines -> Label
firstLine base given ChangedLines {linesBefore, found, expected} = Label line words'
  where
    (line, words') = case (found, expected) of
      ([], first : _) -> (at linesBefore, "this program's own tape has ‘" <> first <> "’ before it")
      (_ : _, first : _) -> (at linesBefore, "this program's own tape has ‘" <> first <> "’ here")
      (_, []) -> (at linesBefore, "this line is not on this program's own tape")
    at n = lineAround base given (sum (map ((+ 1) . Text.length) (take n texts)))
    texts = Text.lines (textOf given)

-- | Sentence about the other lines.
otherLines :: ChangedLines -> [Text]
otherLines ChangedLines {linesBefore, found, expected, linesAfter}
  | length found /= length expected =
    [ "It has "
        <> Decimal.whole (linesBefore + length found + linesAfter)
        <> " lines, and this program's own tape has "
        <> Decimal.whole (linesBefore + length expected + linesAfter)
        <> " lines."
    ]
  | otherwise = [same "line" (length (filter id (zipWith (/=) found expected)) - 1)]

-- | Sentences about the first row that differs from the program's own tape, whose rows are
-- @planned@. If both tapes have the same number of rows, they say what is read there and what the
-- own tape has. Empty if no row differs.
firstRow :: Machine -> [Row] -> Tape -> Tape -> [Text]
firstRow machine planned (Tape given) (Tape own) = case (differing, drop first planned) of
  ([], _) | isEqualLength -> []
  (_ : more, expected : _)
    | isEqualLength ->
      [ "Row "
          <> Decimal.whole (first + 1)
          <> frameText expected
          <> " has "
          <> holesText machine planned (ByteString.index given first)
          <> "; this program's own tape has "
          <> holesText machine planned (holes expected)
          <> " there: "
          <> meaning expected
          <> ".",
        same "row" (length more)
      ]
  ([], _)
    | first < ByteString.length own ->
      [ "All its rows are those of this program's own tape, which has "
          <> Decimal.whole (ByteString.length own)
          <> "."
      ]
  (_, next) ->
    [ "The first row that differs from this program's own tape is row "
        <> Decimal.whole (first + 1)
        <> Text.concat (map frameText (take 1 next))
        <> "."
    ]
  where
    isEqualLength = ByteString.length given == ByteString.length own
    first = case differing of
      n : _ -> n
      [] -> min (ByteString.length given) (ByteString.length own)
    frameText Row {frame} = maybe "" (\k -> " (frame " <> Decimal.whole k <> ")") frame
    differing =
      [ i
        | (i, a, b) <- zip3 [0 ..] (ByteString.unpack given) (ByteString.unpack own),
          a /= b
      ]

-- | Sentence that @count@ other rows or lines, which is the word @unit@, differ.
same :: Text -> Int -> Text
same unit count = case count of
  0 -> "All other " <> unit <> "s are the same."
  1 -> "One more " <> unit <> " differs."
  k -> Decimal.whole k <> " more " <> unit <> "s differ."

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
