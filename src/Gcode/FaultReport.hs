-- | Reports of lines of G-code that are not understood.
module Gcode.FaultReport
  ( toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Char (isPrint, ord)
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
    ("the character " <> quoted (Text.singleton c) <> " begins no word", [noExpressions], [])
  OtherMeaning c ->
    ( quoted (Text.singleton c) <> " means something else on this control",
      ["It would refuse the line, leave it out, or carry out what stands behind this character."],
      [ case c of
          '(' -> "Write the comment behind ‘;’."
          ';' -> "Write the comment in parentheses."
          '%' -> "Remove it."
          '/' -> "Remove it, or remove the line."
          _ -> "Write it as a capital letter."
      ]
    )
  RealTimeCharacter c ->
    ( "the control acts at once on the character " <> shown c,
      ["It does so in comments too: it may hold, stop, or change the feed."],
      ["Remove the character."]
    )
  LoneReturn ->
    ( "a carriage return is in the middle of the line",
      ["Some controls end the line here, and carry out what follows."],
      ["Write the file with the usual ends of lines."]
    )
  ActiveComment ->
    ( "the control carries out this comment",
      ["LinuxCNC runs Python behind ‘py’, and writes files behind ‘log’ and ‘probeopen’."],
      ["Remove the comment, or begin it with another word."]
    )
  PointMissing w ->
    ( w <> " has no point",
      ["Depending on its parameters, the control may take it for a thousandth."],
      ["Write " <> w <> "."]
    )
  NumberMissing c ->
    ( "the letter " <> Text.singleton c <> " has no number",
      [noExpressions],
      ["Write a number after the letter."]
    )
  NumberTooLong ->
    ( "a number has too many digits",
      ["At most 8 digits before the point are read, and 8 after it."],
      ["Round the number."]
    )
  CommentOpen -> ("a comment has no end", [], ["Write ) at its end."])
  NoWords ->
    ("the file has no words", [], ["Copy the file again, or write it anew with partc compile."])
  UnknownWord w ->
    ( "the control does not have the word " <> w,
      ["It would refuse the line, or ignore the word."],
      ["Check the word, and whether the file is for this machine."]
    )
  UnprovenWord w ->
    ( "the proof does not know what " <> w <> " does",
      ["The motions after it are not certain."],
      ["Write the motions without " <> w <> "."]
    )
  RepeatedWord w ->
    ( w <> " cannot stand beside another word of this line",
      ["A line has at most one word of each kind: one X, one motion, one plane."],
      ["Remove one of the two words, or write two lines."]
    )
  WordMissing w by ->
    ( by <> " needs the word " <> w,
      ["The control would refuse the line."],
      ["Write " <> w <> " in this line."]
    )
  BadCycle ->
    ( "this canned cycle goes nowhere",
      [ "The tool comes down to the height R, which is above the bottom Z of the hole and not \
        \above the tool, and each peck Q is above 0."
      ],
      ["Correct the words R, Z and Q."]
    )
  UnusedWord w ->
    ( "no word of this line uses " <> w,
      ["The control would refuse the line, or ignore the word."],
      ["Remove " <> w <> ", or write the word to which it belongs."]
    )
  NotWhole w -> ("the number of " <> w <> " is not whole", [], ["Write a whole number."])
  NegativeNumber w -> ("the number of " <> w <> " is negative", [], ["Write 0 or more."])
  NoMotionMode ->
    ( "no line says how to move to this position",
      ["G0 is a rapid move, G1 a straight cut, G2 and G3 are arcs."],
      ["Write one of these words in this line, or in a line before it."]
    )
  UnknownPosition c ->
    ( "this motion depends on where the machine stands along " <> Text.singleton c,
      ["No line before it gives this position."],
      ["Move to an absolute position (G90) first."]
    )
  BadArc -> badArc
  LineTooLong most ->
    ( "the line is too long",
      ["The control reads at most " <> Decimal.whole most <> " characters of a line."],
      ["Divide the line, or shorten its comment."]
    )
  BehindEnd ->
    ( "this line is after the end of the program",
      ["M2 or M30 ends the program. The control does not run what follows."],
      ["Remove the line, or end the program after it."]
    )
  where
    quoted w = "\8216" <> w <> "\8217"
    shown c = if isPrint c then quoted (Text.singleton c) else "number " <> Decimal.whole (ord c)

-- | Reason for a text that is no word.
noExpressions :: Text
noExpressions =
  "Only words such as X10.5, and comments, are read. Parameters, expressions and loops are not, \
  \because the motions would not be certain."

badArc :: (Text, [Text], [Text])
badArc =
  ( "the centre of this arc is missing, or not possible",
    [ "I and J lead from the beginning of the arc to its centre, which is at neither end. With R \
      \in place of I and J, the ends differ and are at most 2 R apart.",
      "After G18 the words are I and K, after G19 J and K."
    ],
    ["Write I and J from the beginning of the arc to its centre."]
  )
