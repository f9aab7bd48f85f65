-- | Reports of lines of G-code that are not understood.
module Gcode.FaultReport
  ( toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.Block (Fault (..), FaultReason (..))
import Report.Report (Report (hints, message), ReportPlace (..), report)
import Report.Report qualified as Report

-- | Report of a fault. @regionOf@ gives the region from a line and a column on.
toReport :: (Int -> Int -> Region) -> Fault -> Report
toReport regionOf (Fault n column reason) =
  (report Report.Error "E0603" (InSource (regionOf n column)) title) {message = why, hints}
  where
    (title, why, hints) = wordsOf reason

-- | Title, reasons and hints.
wordsOf :: FaultReason -> (Text, [Text], [Text])
wordsOf reason = case reason of
  StrayCharacter c ->
    ( "the character " <> quoted (Text.singleton c) <> " begins no word",
      ["Parameters, expressions and control flow are not read: the motions would be unknown."],
      []
    )
  NumberMissing c ->
    ("the letter " <> Text.singleton c <> " has no number", [], ["Write a number behind the letter."])
  NumberTooLong -> ("a number has too many digits", ["At most 8 before the point and 8 after it are read."], [])
  CommentOpen -> ("a comment has no end", [], ["Write ) at its end."])
  NoWords -> ("the file has no words", [], ["Copy the file again, or write it anew with partc compile."])
  UnknownWord w -> ("the control does not have the word " <> w, ["It would refuse the line, or pass over it."], [])
  UnprovenWord w ->
    ( "the proof does not know what " <> w <> " does",
      ["Its effect depends on settings of the control that are not in the file."],
      ["Write the motions without " <> w <> "."]
    )
  RepeatedWord w ->
    ("the word " <> w <> " contradicts another word of the line", ["The line has two words of the same group."], [])
  WordMissing w by -> (by <> " needs " <> w <> " in force or in its line", [], ["Write " <> w <> "."])
  UnusedWord w -> ("no other word of the line uses " <> w, [], [])
  BadNumber w -> ("the number of " <> w <> " is not a whole number", [], [])
  NoMotionMode -> ("the line has a position, but no line says how to move there", [], ["Write G0, G1, G2 or G3."])
  UnknownPosition c ->
    ( "the motion depends on where the machine stands along " <> Text.singleton c,
      ["No line before it gives this position."],
      ["Write G90 and a position before it."]
    )
  BadArc -> ("the centre of the arc is missing, or at one of its ends", [], ["Write I and J from its beginning to its centre."])
  LineTooLong most ->
    ("the line is too long", ["The control reads at most " <> Decimal.whole most <> " characters of a line."], [])
  BehindEnd -> ("a line behind the end of the program", ["The control does not read it."], ["Remove it."])
  where
    quoted w = "\8216" <> w <> "\8217"
