-- | Why a tape can not be read.
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
import Frame.Frame (Broken (..))
import Machine.Machine (CommandName (..), Content, FeedCode (..))
import Machine.Machine qualified as Machine
import Report.Report (Report (..), ReportPlace (..), report)
import Report.Report qualified as Report
import Tape.RowMeaning qualified as RowMeaning

-- | The row from 1, the frame from 1 if it is in one, the word if it is in one, and why.
data Damage = Damage {row :: Int, frame :: Maybe Int, field :: Maybe Content, reason :: Reason}
  deriving stock (Eq, Show)

data Reason
  = -- | a row that is not blank in the leader, which has so many
    LeaderNotBlank Int
  | -- | the tape ends within its leader, which has so many rows
    NoFrames Int
  | -- | a hole in the blank rows before an even frame
    ShiftNotBlank
  | -- | a hole in the blank rows behind a frame
    GapNotBlank
  | CutOff
  | -- | the symbols behind the last frame are missing
    NoClosing Text
  | -- | blank rows at the end: as they are, as they must be
    TrailerLength Int Int
  | -- | a hole outside the tracks of the tape
    ForeignTrack
  | -- | an odd number of holes
    BadParity
  | -- | holes that are no digit, in a tape with so many tracks
    NoDigit Int Word8
  | -- | a symbol where a digit belongs
    NotADigit Char
  | -- | holes that are no symbol
    NoSymbol Int Word8
  | -- | what stands there, what should
    Unexpected Char Char
  | -- | holes where there must be none
    NotBlank
  | -- | what should stand there
    Missing Char
  | -- | the word with this address can not stand there
    WordOutOfPlace Char
  | MarkerMissing
  | -- | a hole in the service track where there is none
    ServiceHole
  | -- | a number without its sign
    NoSign
  | MinusZero
  | -- | a digit that says neither direction nor which axis leads
    NoPriority Int
  | -- | what stands there, what should
    WrongPriority Int Int
  | -- | what the symbols of the frame add to, of what that should be a multiple
    AddsTo Int Int
  | -- | what stands there, what should
    WrongNumber Int Int
  | -- | no motion with this number
    UnknownMotion Int
  | -- | a motion that moves nothing
    MotionWithoutMove
  | MoveWithoutMotion
  | -- | a feed code that the machine does not have
    UnknownSpeed Int
  | SpeedWithoutMove Int
  | MoveWithoutSpeed
  | -- | the feed is the one said before
    SpeedRepeated Int
  | -- | nothing moves and nothing is commanded
    IdleFrame
  | -- | a rule that frames keep
    Rule Broken
  | -- | the machine would write the frame otherwise: what should stand there
    Otherwise Text
  | -- | what was punched as one frame is read as another
    Misread
  deriving stock (Eq, Show)

-- | The words for a damaged tape.
toReport :: Damage -> Report
toReport (Damage at n c why) =
  ( report
      Report.Error
      "E0601"
      (InTape at)
      ("row " <> Decimal.whole at <> place <> ": " <> reasonWord why)
  )
    { message = explanation why
    }
  where
    place = case (n, c) of
      (Nothing, _) -> ""
      (Just k, Nothing) -> " (frame " <> Decimal.whole k <> ")"
      (Just k, Just w) -> " (frame " <> Decimal.whole k <> ", " <> Machine.contentWord w <> ")"

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
  NoClosing _ -> ["Frames are missing, or the tape is torn."]
  Misread ->
    [ "The machine's description lets frames be read in two ways. Look at what stands between \
      \words, and at words that may be left out."
    ]
  _ -> []

reasonWord :: Reason -> Text
reasonWord why = case why of
  LeaderNotBlank _ -> "the leader is not blank"
  NoFrames _ -> "the tape is empty or ends within its leader"
  ShiftNotBlank -> "a hole in the blank rows before an even frame"
  GapNotBlank -> "a hole in the gap behind the frame"
  CutOff -> "the tape ends within a frame"
  NoClosing text -> "the tape ends without ‘" <> Text.intercalate " " (Text.lines text) <> "’"
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
  WordOutOfPlace c ->
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
  AddsTo total modulus ->
    "the frame adds to "
      <> Decimal.whole total
      <> ", which is no multiple of "
      <> Decimal.whole modulus
  WrongNumber found wanted ->
    "the frame is numbered " <> Decimal.whole found <> " and should be " <> Decimal.whole wanted
  UnknownMotion n -> "the machine has no motion " <> Decimal.whole n
  MotionWithoutMove -> "a motion that moves nothing"
  MoveWithoutMotion -> "the frame moves and does not say how"
  UnknownSpeed s -> "the machine has no speed " <> Decimal.whole s
  SpeedWithoutMove s -> "the speed is " <> Decimal.whole s <> " but nothing moves at a speed"
  MoveWithoutSpeed -> "the frame moves but has no speed"
  SpeedRepeated s -> "the speed " <> Decimal.whole s <> " was said before"
  IdleFrame -> "the frame moves nothing and commands nothing"
  Rule broken -> brokenWord broken
  Misread -> "it is read as another than was punched"
  Otherwise wanted -> "the machine writes this otherwise: here belongs " <> wanted

brokenWord :: Broken -> Text
brokenWord broken = case broken of
  OverCapacity {} -> "the move is longer than a frame can say"
  BadCentre _ -> "the centre of the arc is none, or too far"
  NoSuchSpeed _ (FeedCode s) -> "the machine has no speed " <> Decimal.whole s <> " for this motion"
  NoSuchMotion _ ->
    "the machine has no such motion: an arc that it can not go, or one that its distances \
    \contradict"
  NoSuchOrder _ (CommandName o) -> "the machine has no such command " <> o
  Idle _ -> "the frame moves nothing and commands nothing"

-- | Holes from the highest track to the lowest.
binary :: Int -> Word8 -> Text
binary tracks w =
  Text.pack [if w `div` (2 ^ k) `mod` 2 == 1 then '1' else '0' | k <- [tracks - 1, tracks - 2 .. 0]]
