-- | Frames onto tape and tape into frames.
module Tape.Punch
  ( write,
    read,
    Damage (..),
    Cause (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Builder qualified as Builder
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame)
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Report.Report (Place (..), Report (..), report)
import Report.Report qualified as Report
import Tape.Layout (Fault (..), Reason (..))
import Tape.Layout qualified as Layout
import Tape.Tape (Tape (..))
import Prelude hiding (read)

-- | Punch frames that keep the invariants of the machine.
write :: Machine -> [Frame] -> Tape
write machine frames = Tape (LazyByteString.toStrict (Builder.toLazyByteString (blank <> body <> blank)))
  where
    blank = rowsOf (replicate (Machine.leader machine) 0)
    body = mconcat (zipWith (\n f -> rowsOf (shift machine n) <> rowsOf (Layout.frameRows machine f)) [1 ..] frames)
    rowsOf = foldMap Builder.word8
    shift m n = replicate (shiftRows m n) 0

-- | The blank rows before a frame, by its number from 1.
shiftRows :: Machine -> Int -> Int
shiftRows machine n = if even n then Machine.evenShift (Machine.layout machine) else 0

-- | Where a tape can not be read: the row from 1, the frame from 1 if it is in one, and why.
data Damage = Damage {row :: Int, frame :: Maybe Int, cause :: Cause}
  deriving stock (Eq, Show)

data Cause
  = -- | a hole in the leader, and how many rows it must have
    LeaderNotBlank Int
  | -- | a tape that ends within its leader
    NoFrames Int
  | -- | a hole in the blank rows before an even frame
    ShiftNotBlank
  | -- | the tape ends within a frame
    CutOff
  | -- | blank rows behind the last frame: as they are, as they must be
    TrailerLength Int Int
  | InFrame Fault
  deriving stock (Eq, Show)

-- | Read a tape. Frames lie on a fixed grid, counted from the end of the leader: a blank row is a digit 0.
read :: Machine -> Tape -> Either Damage [Frame]
read machine (Tape rows) = case ByteString.findIndex (/= 0) front of
  Just k -> Left (Damage (k + 1) Nothing (LeaderNotBlank leader))
  Nothing
    | ByteString.length front < leader -> Left (Damage (max 1 (ByteString.length front)) Nothing (NoFrames leader))
    | otherwise -> go 1 leader (ByteString.drop leader rows)
  where
    leader = Machine.leader machine
    front = ByteString.take leader rows
    size = Layout.rowsPerFrame (Machine.layout machine)
    go :: Int -> Int -> ByteString -> Either Damage [Frame]
    go n at rest
      | ByteString.all (== 0) rest =
        if ByteString.length rest == leader
          then Right []
          else Left (Damage (at + ByteString.length rest) Nothing (TrailerLength (ByteString.length rest) leader))
      | otherwise = do
        let shift = shiftRows machine n
            (before, behind) = ByteString.splitAt shift rest
            (mine, others) = ByteString.splitAt size behind
            begin = at + shift
        case ByteString.findIndex (/= 0) before of
          Just k -> Left (Damage (at + k + 1) (Just n) ShiftNotBlank)
          Nothing -> Right ()
        if ByteString.length mine < size then Left (Damage (begin + ByteString.length mine) (Just n) CutOff) else Right ()
        f <- either (\fault -> Left (Damage (begin + Layout.row fault) (Just n) (InFrame fault))) Right (Layout.readFrame machine (ByteString.unpack mine))
        (f :) <$> go (n + 1) (begin + size) others

-- | The words for a damaged tape.
toReport :: Damage -> Report
toReport (Damage row frame cause) =
  (report Report.Error "E0601" (InTape row) ("row " <> Decimal.whole row <> place <> ": " <> because))
    { message = explanation
    }
  where
    place = maybe "" (\n -> " (frame " <> Decimal.whole n <> fieldWord <> ")") frame
    fieldWord = case cause of
      InFrame fault -> maybe "" ((", " <>) . Machine.contentWord) (Layout.field fault)
      _ -> ""
    because = case cause of
      LeaderNotBlank _ -> "the leader is not blank"
      NoFrames _ -> "the tape is empty or ends within its leader"
      ShiftNotBlank -> "a hole in the blank rows before an even frame"
      CutOff -> "the tape ends within a frame"
      TrailerLength _ _ -> "the end of the tape is not as it should be"
      InFrame fault -> reasonWord (Layout.reason fault)
    explanation = case cause of
      NoFrames wanted -> ["A tape begins with " <> Decimal.whole wanted <> " blank rows."]
      LeaderNotBlank wanted -> ["A tape begins with " <> Decimal.whole wanted <> " blank rows."]
      TrailerLength found wanted ->
        [ "Behind the last frame stand " <> Decimal.whole found <> " blank rows, and it should be " <> Decimal.whole wanted
            <> ": frames are missing, or the tape is torn."
        ]
      _ -> []

reasonWord :: Reason -> Text
reasonWord reason = case reason of
  ForeignTrack -> "a hole outside the tracks of this tape"
  NoDigit holes -> "the holes " <> binary holes <> " are no digit"
  MarkerMissing -> "the frame marker is missing"
  ServiceHole -> "a hole in the service track where there must be none"
  MinusZero -> "a minus on zero"
  NotBlank -> "a hole in the gap behind the frame"
  UnknownSpeed s -> "the machine has no speed " <> Decimal.whole s
  SpeedWithoutMove s -> "the speed is " <> Decimal.whole s <> " but nothing moves"
  MoveWithoutSpeed -> "the frame moves but its speed is 0"
  IdleFrame -> "the frame moves nothing and commands nothing"
  where
    binary w = Text.pack [if w `div` (2 ^ k) `mod` 2 == 1 then '1' else '0' | k <- [3, 2, 1, 0 :: Int]]
