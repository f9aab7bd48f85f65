-- | Damage: the reasons why a tape cannot be read, and their reports.
--
-- A damage holds its position and its facts; words appear only in 'toReport'.
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

-- | Damaged row from 1, the frame from 1 and the word if the row is in one, and the reason.
data Damage = Damage {row :: Int, frame :: Maybe Int, field :: Maybe Content, reason :: Reason}
  deriving stock (Eq, Show)

-- | Fault of a row, of a frame or of the tape.
data Reason
  = -- | a row in the leader is not blank; the leader has the given number of rows
    LeaderNotBlank Int
  | -- | the tape ends within its leader, which has the given number of rows
    NoFrames Int
  | -- | a hole in the blank rows before an even frame
    ShiftNotBlank
  | -- | a hole in the blank rows after a frame
    GapNotBlank
  | -- | the tape ends within a frame
    CutOff
  | -- | the given symbols after the last frame are missing
    MissingClosing Text
  | -- | wrong number of blank rows at the end: found, expected
    TrailerLength Int Int
  | -- | a hole outside of the tracks of the tape
    ForeignTrack
  | -- | an odd number of holes
    BadParity
  | -- | no digit: the number of tracks, the holes
    NoDigit Int Word8
  | -- | a symbol in the position of a digit
    NotADigit Char
  | -- | no symbol: the number of tracks, the holes
    NoSymbol Int Word8
  | -- | a wrong symbol: found, expected
    Unexpected Char Char
  | -- | holes in a row that has to be blank
    NotBlank
  | -- | a blank row in the position of a symbol
    Missing Char
  | -- | a word with this address cannot be here
    UnexpectedWord Char
  | -- | a digit without the marker in the service track
    MarkerMissing
  | -- | a hole in the service track where none is allowed
    ServiceHole
  | -- | a number without its sign
    NoSign
  | MinusZero
  | -- | a digit that gives neither direction, with or without the leading axis
    NoPriority Int
  | -- | a wrong digit for the direction and the leading axis: found, expected
    WrongPriority Int Int
  | -- | a wrong check sum: the sum, the number of which it has to be a multiple
    WrongSum Int Int
  | -- | a wrong frame number: found, expected
    WrongNumber Int Int
  | -- | a motion code that the machine does not have
    UnknownMotion Int
  | -- | a motion without an increment
    MotionWithoutIncrement
  | -- | an increment without a motion code
    IncrementWithoutMotion
  | -- | a feed code that the machine does not have
    UnknownFeedCode Int
  | -- | a feed code in a frame that takes none
    FeedWithoutMotion Int
  | -- | a motion at a feed, without a feed code
    MotionWithoutFeed
  | -- | a modal feed code that is in force already
    FeedRepeated Int
  | -- | neither a motion nor a command
    NoContent
  | -- | a rule for frames is broken
    BrokenRule Violation
  | -- | a row that the machine would write in another manner; the text describes the expected row
    WrittenOtherwise Text
  | -- | the frames on the tape are not those that were punched
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

-- | Sentences after the title of a report.
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

-- | Title of a report without the position.
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

-- | Title of a report about a broken rule.
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

-- | Holes as binary digits, from the highest track to the lowest.
binary :: Int -> Word8 -> Text
binary tracks w =
  Text.pack [if w `div` (2 ^ k) `mod` 2 == 1 then '1' else '0' | k <- [tracks - 1, tracks - 2 .. 0]]
