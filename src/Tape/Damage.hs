-- | Damage: the reasons why a tape cannot be read, and their reports.
--
-- A damage holds positions and numbers. Only 'toReport' makes a text of them.
module Tape.Damage
  ( Damage (..),
    Reason (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame (Violation (..))
import Machine.Machine (CommandName (..), Content, FeedCode (..))
import Machine.Machine qualified as Machine
import Report.Report (Report (..), ReportPlace (..), report)
import Report.Report qualified as Report
import Tape.RowMeaning qualified as RowMeaning

-- | Damage of a tape: the first wrong row and its frame, both counted from 1, the content of its
-- word, and the reason. Rows outside of all frames have no frame, rows outside of words no content.
data Damage = Damage {row :: Int, frame :: Maybe Int, field :: Maybe Content, reason :: Reason}
  deriving stock (Eq, Show)

-- | Fault of a row, of a frame or of the tape.
data Reason
  = -- | The leader has a row with holes; the number is the length of the leader in rows.
    LeaderNotBlank Int
  | -- | The tape ends within its leader; the number is the length of the leader in rows.
    NoFrames Int
  | -- | Hole in the blank rows before a frame with an even number ('Machine.Machine.evenShift').
    ShiftNotBlank
  | -- | Hole in the blank rows after a frame.
    GapNotBlank
  | -- | The tape ends within a frame.
    CutOff
  | -- | The given symbols, which follow the last frame, are missing.
    MissingClosing Text
  | -- | Wrong number of blank rows at the end: the number found, the number expected.
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
  | -- | First symbol of the address of a word that is not allowed at this row.
    UnexpectedWord Char
  | -- | Digit that lacks the marker, a hole in the service track.
    MarkerMissing
  | -- | Hole in the service track of a row that must not have one.
    ServiceHole
  | -- | Number that lacks its sign.
    NoSign
  | -- | Number 0 with a minus.
    MinusZero
  | -- | Digit that is none of the four for the direction and the leading axis, see
    -- 'Machine.Machine.Priority'.
    NoPriority Int
  | -- | Wrong digit for the direction and the leading axis: the digit found, the digit expected.
    WrongPriority Int Int
  | -- | Wrong check sum: the sum, the modulus of which it has to be a multiple.
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
  | -- | Feed code in a rapid frame, or in a frame that does not move.
    FeedWithoutMotion Int
  | -- | Line or arc without a feed code.
    MotionWithoutFeed
  | -- | Feed code that is written although it is in force already.
    FeedRepeated Int
  | -- | Frame with neither a motion nor a command.
    NoContent
  | -- | Frame that breaks a rule of the machine.
    BrokenRule Violation
  | -- | Row that differs from the one that the machine would write, which the text describes.
    WrittenOtherwise Text
  | -- | The frames read differ from the frames that were punched.
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
    { message = explanation why
    }
  where
    position = case (n, c) of
      (Nothing, _) -> ""
      (Just k, Nothing) -> " (frame " <> Decimal.whole k <> ")"
      (Just k, Just w) -> " (frame " <> Decimal.whole k <> ", " <> Machine.contentName w <> ")"

-- | Sentences below the title of a report; none for a reason whose title says everything.
explanation :: Reason -> [Text]
explanation why = case why of
  NoFrames wanted -> ["A tape begins with " <> Decimal.whole wanted <> " blank rows." | wanted > 0]
  LeaderNotBlank wanted -> ["A tape begins with " <> Decimal.whole wanted <> " blank rows."]
  TrailerLength found wanted ->
    [ "Behind the last frame stand "
        <> Decimal.whole found
        <> " blank rows, and it should be "
        <> Decimal.whole wanted
        <> ": frames are missing, or the tape is torn."
    ]
  MissingClosing _ -> ["Frames are missing, or the tape is torn."]
  Misread ->
    [ "The machine's description lets frames be read in two ways. Look at what stands between \
      \words, and at words that may be left out."
    ]
  _ -> []

-- | Title of a report, without the row and the frame.
reasonText :: Reason -> Text
reasonText why = case why of
  LeaderNotBlank _ -> "the leader is not blank"
  NoFrames _ -> "the tape is empty or ends within its leader"
  ShiftNotBlank -> "a hole in the blank rows before an even frame"
  GapNotBlank -> "a hole in the gap behind the frame"
  CutOff -> "the tape ends within a frame"
  MissingClosing text -> "the tape ends without ‘" <> Text.intercalate " " (Text.lines text) <> "’"
  TrailerLength _ _ -> "the end of the tape is not as it should be"
  ForeignTrack -> "a hole outside the tracks of this tape"
  BadParity -> "the number of holes is odd"
  NoDigit tracks holes -> "the holes " <> binary tracks holes <> " are no digit"
  NotADigit c -> RowMeaning.shown c <> " stands where a digit belongs"
  NoSymbol tracks holes -> "the holes " <> binary tracks holes <> " are no symbol"
  Unexpected found wanted ->
    RowMeaning.shown found <> " stands where " <> RowMeaning.shown wanted <> " belongs"
  NotBlank -> "a hole in a row that has to be blank"
  Missing wanted -> RowMeaning.shown wanted <> " is missing"
  UnexpectedWord c ->
    "a word "
      <> RowMeaning.shown c
      <> " can not stand here: it is out of order, there already, or none of this machine"
  MarkerMissing -> "the frame marker is missing"
  ServiceHole -> "a hole in the service track where there must be none"
  NoSign -> "the number has no sign"
  MinusZero -> "a minus on zero"
  NoPriority d -> "the digit " <> Decimal.whole d <> " says no direction"
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
  MotionWithoutIncrement -> "a motion that moves nothing"
  IncrementWithoutMotion -> "the frame moves and does not say how"
  UnknownFeedCode s -> "the machine has no speed " <> Decimal.whole s
  FeedWithoutMotion s -> "the speed is " <> Decimal.whole s <> " but nothing moves at a speed"
  MotionWithoutFeed -> "the frame moves but has no speed"
  FeedRepeated s -> "the speed " <> Decimal.whole s <> " was said before"
  NoContent -> "the frame moves nothing and commands nothing"
  BrokenRule broken -> ruleText broken
  Misread -> "it is read as another than was punched"
  WrittenOtherwise wanted -> "the machine writes this otherwise: here belongs " <> wanted

-- | Title of a report about a broken rule, without the row and the frame.
ruleText :: Violation -> Text
ruleText broken = case broken of
  OverCapacity {} -> "the move is longer than a frame can say"
  BadCentre _ -> "the centre of the arc is none, or too far"
  NoSuchFeedCode _ (FeedCode s) ->
    "the machine has no speed " <> Decimal.whole s <> " for this motion"
  NoSuchMotion _ ->
    "the machine has no such motion: an arc that it can not go, or one that its distances \
    \contradict"
  UnknownCommand _ (CommandName o) -> "the machine has no such command " <> o
  EmptyFrame _ -> "the frame moves nothing and commands nothing"

-- | Holes as @tracks@ binary digits, the highest track first; 1 is a hole.
binary :: Int -> Word8 -> Text
binary tracks w =
  Text.pack [if w `div` (2 ^ k) `mod` 2 == 1 then '1' else '0' | k <- [tracks - 1, tracks - 2 .. 0]]
