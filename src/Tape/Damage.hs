-- | Damage: the reasons why a tape cannot be read, and their reports.
--
-- A frame is a block of ISO 6983, and a word is an address with its number. A motion code is the
-- number of a kind of motion, a feed code the number of a feed. A hole in the service track gives
-- the digit in its row an extra meaning. The check sum of a frame is the sum of the weights of its
-- symbols. The leading axis of a frame is the axis with the most pulses. A priority digit before
-- the number of an axis gives its direction, and says if the axis is the leading one.
--
-- A damage holds positions, numbers and symbols. Only 'toReport' makes sentences of them.
module Tape.Damage
  ( Damage (..),
    Reason (..),
    toReport,
    fault,
  )
where

import Base.Decimal qualified as Decimal
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame (Violation (..))
import Machine.Machine (CommandName (..), Content, codeNumber)
import Machine.Machine qualified as Machine
import Report.Report (Report (..), ReportPlace (..), report)
import Report.Report qualified as Report
import Tape.RowMeaning qualified as RowMeaning

-- | Damage of a tape: the first wrong row, the frame and the word that contain this row, and the
-- reason. @row@ and @frame@ are numbers from 1; @field@ is the 'Content' of the word. @frame@ is
-- 'Nothing' for a row outside of all frames, and @field@ is 'Nothing' for a row outside of all
-- words.
data Damage = Damage {row :: Int, frame :: Maybe Int, field :: Maybe Content, reason :: Reason}
  deriving stock (Eq, Show)

-- | Fault of a row, of a frame or of the whole tape.
data Reason
  = -- | The leader has a row with holes; the number is the length that the leader must have, in
    -- rows.
    LeaderNotBlank Int
  | -- | The tape ends within its leader; the number is the length that the leader must have, in
    -- rows.
    NoFrames Int
  | -- | Hole in the blank rows before a frame with an even number ('Machine.Machine.evenShift').
    ShiftNotBlank
  | -- | Hole in the blank rows after a frame.
    GapNotBlank
  | -- | The tape ends within a frame.
    CutOff
  | -- | The given closing symbols are missing after the last frame.
    MissingClosing Text
  | -- | Wrong count of blank rows at the end of the tape: the count found, the count expected.
    TrailerLength Int Int
  | -- | Hole outside of the tracks of the tape.
    ForeignTrack
  | -- | Odd number of holes, in a code with parity.
    BadParity
  | -- | No symbol of the code where a digit is expected: the number of tracks, the holes.
    NoDigit Int Word8
  | -- | The given symbol where a digit is expected.
    NotADigit Char
  | -- | No symbol of the code where a symbol is expected: the number of tracks, the holes.
    NoSymbol Int Word8
  | -- | Wrong symbol: the symbol found, the symbol expected.
    Unexpected Char Char
  | -- | Holes in a row that has to be blank.
    NotBlank
  | -- | Blank row where the given symbol is expected.
    Missing Char
  | -- | A word begins at a row at which it is not allowed; the argument is the first symbol of its
    -- address.
    UnexpectedWord Char
  | -- | Digit without the hole in the service track that it has in every frame.
    MarkerMissing
  | -- | Hole in the service track of a row in which this track must be blank.
    ServiceHole
  | -- | Number that lacks its sign.
    NoSign
  | -- | Number 0 with a minus.
    MinusZero
  | -- | The given digit is none of the four priority digits, see 'Machine.Machine.Priority'.
    NoPriority Int
  | -- | Wrong priority digit: the digit found, the digit expected.
    WrongPriority Int Int
  | -- | Wrong check sum of a frame: the sum found, and the number of which it has to be a multiple.
    WrongSum Int Int
  | -- | Wrong frame number: the number found, the number expected.
    WrongNumber Int Int
  | -- | Motion code that the machine does not have.
    UnknownMotion Int
  | -- | Motion code in a frame without an increment.
    MotionWithoutIncrement
  | -- | Increment in a frame without a motion code.
    IncrementWithoutMotion
  | -- | Feed code that the machine does not have.
    UnknownFeedCode Int
  | -- | The given feed code in a rapid frame, or in a frame that does not move.
    FeedWithoutMotion Int
  | -- | Line or arc without a feed code.
    MotionWithoutFeed
  | -- | The given feed code is written although it is in force already.
    FeedRepeated Int
  | -- | Frame with neither a motion nor a command.
    NoContent
  | -- | Frame that breaks a rule of the machine.
    BrokenRule Violation
  | -- | The row differs from the row that the machine would write. The text describes the latter.
    WrittenOtherwise Text
  | -- | The frames that are read from the tape differ from those that were punched on it.
    Misread
  deriving stock (Eq, Show)

-- | Report of a damaged tape.
toReport :: Damage -> Report
toReport (Damage at n c why) =
  ( report
      Report.Error
      "E0601"
      (InTape at)
      ("row " <> Decimal.whole at <> position <> ": " <> reasonText why)
  )
    { message = explanation why,
      hints = remedy why
    }
  where
    position = case (n, c) of
      (Nothing, _) -> ""
      (Just k, Nothing) -> " (frame " <> Decimal.whole k <> ")"
      (Just k, Just w) -> " (frame " <> Decimal.whole k <> ", " <> Machine.contentName w <> ")"

-- | The fault in a few words, without the row and the frame.
fault :: Damage -> Text
fault = reasonText . reason

-- | Sentences below the title of a report; the list is empty if the title says everything.
explanation :: Reason -> [Text]
explanation why = case why of
  NoFrames wanted -> ["A tape begins with " <> Decimal.whole wanted <> " blank rows." | wanted > 0]
  LeaderNotBlank wanted -> ["A tape begins with " <> Decimal.whole wanted <> " blank rows."]
  TrailerLength found wanted ->
    [ "After the last frame there are "
        <> Decimal.whole found
        <> " blank rows, and there should be "
        <> Decimal.whole wanted
        <> ": frames are missing, or the tape is torn."
    ]
  MissingClosing _ -> ["Frames are missing, or the tape is torn."]
  Misread ->
    [ "The machine's description lets frames be read in two ways. Look at what stands between \
      \words, and at words that may be left out."
    ]
  _ -> []

-- | Hints below a report.
remedy :: Reason -> [Text]
remedy why = case why of
  CutOff -> ["The file is cut off: copy it again, or punch it anew with partc compile."]
  Misread -> []
  _ ->
    [ "If the tape is for another machine, name that machine with -t. Otherwise copy the file \
      \again, or punch the tape anew with partc compile."
    ]

-- | Title of the report for a reason, without the row and the frame.
reasonText :: Reason -> Text
reasonText why = case why of
  LeaderNotBlank _ -> "the leader is not blank"
  NoFrames _ -> "the tape is empty or ends within its leader"
  ShiftNotBlank -> "there is a hole in the blank rows before an even frame"
  GapNotBlank -> "there is a hole in the gap after the frame"
  CutOff -> "the tape ends within a frame"
  MissingClosing text -> "the tape ends without ‘" <> Text.intercalate " " (Text.lines text) <> "’"
  TrailerLength _ _ -> "the end of the tape is not as it should be"
  ForeignTrack -> "there is a hole outside the tracks of this tape"
  BadParity -> "the number of holes is odd"
  NoDigit tracks holes -> "the holes " <> binary tracks holes <> " are not a digit"
  NotADigit c -> RowMeaning.shown c <> " is read where a digit belongs"
  NoSymbol tracks holes -> "the holes " <> binary tracks holes <> " are not a symbol of its code"
  Unexpected found wanted ->
    RowMeaning.shown found <> " is read where " <> RowMeaning.shown wanted <> " belongs"
  NotBlank -> "there is a hole in a row that has to be blank"
  Missing wanted -> RowMeaning.shown wanted <> " is missing"
  UnexpectedWord c ->
    "a word "
      <> RowMeaning.shown c
      <> " cannot stand here: it is out of order, is given twice, or the machine does not have it"
  MarkerMissing -> "the frame marker is missing"
  ServiceHole -> "there is a hole in the service track, where none may be"
  NoSign -> "the number has no sign"
  MinusZero -> "the number 0 has a minus sign"
  NoPriority d -> "the digit " <> Decimal.whole d <> " does not give a direction"
  WrongPriority found wanted ->
    "the digit for direction and leading axis is "
      <> Decimal.whole found
      <> " and should be "
      <> Decimal.whole wanted
  WrongSum total modulus ->
    "the frame adds to "
      <> Decimal.whole total
      <> ", which is no multiple of "
      <> Decimal.whole modulus
  WrongNumber found wanted ->
    "the frame is numbered " <> Decimal.whole found <> " and should be " <> Decimal.whole wanted
  UnknownMotion n -> "the machine has no motion " <> Decimal.whole n
  MotionWithoutIncrement -> "the frame has a motion code, but no increment"
  IncrementWithoutMotion -> "the frame has an increment, but no motion code"
  UnknownFeedCode s -> "the machine has no feed code " <> Decimal.whole s
  FeedWithoutMotion s ->
    "the feed code " <> Decimal.whole s <> " is given, but the frame does not move at a feed"
  MotionWithoutFeed -> "the frame moves, but has no feed code"
  FeedRepeated s ->
    "the feed code " <> Decimal.whole s <> " is given again, although it is in force"
  NoContent -> "the frame has neither a motion nor a command"
  BrokenRule broken -> ruleText broken
  Misread -> "it is read back as another frame than the one that was punched"
  WrittenOtherwise wanted -> "the machine would write this differently: " <> wanted

-- | Title of the report about a broken rule, without the row and the frame.
ruleText :: Violation -> Text
ruleText broken = case broken of
  OverCapacity {} -> "the move is longer than a frame can hold"
  TurnOverCapacity {} -> "the turn is longer than a frame can hold"
  BadCentre _ -> "the arc has no centre, or one that is too far away"
  NoSuchFeedCode _ code ->
    "the machine has no feed code " <> Decimal.whole (codeNumber code) <> " for this motion"
  NoSuchMotion _ ->
    "the machine has no such motion: it cannot run this arc, or the distances contradict it"
  UnknownCommand _ (CommandName o) -> "the machine has no command " <> o
  EmptyFrame _ -> "the frame has neither a motion nor a command"

-- | Holes as @tracks@ binary digits, the highest track first; 1 is a hole.
binary :: Int -> Word8 -> Text
binary tracks w =
  Text.pack [if w `div` (2 ^ k) `mod` 2 == 1 then '1' else '0' | k <- [tracks - 1, tracks - 2 .. 0]]
