-- | One interpretation of a frame's layout: it writes the rows of a frame and reads them back.
module Tape.Layout
  ( frameRows,
    rowsPerFrame,
    readFrame,
    Fault (..),
    Reason (..),
  )
where

import Base.Quantity (Pulses (..))
import Data.Bits (complement, setBit, shiftL, testBit, (.&.), (.|.))
import Data.List (elemIndex)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Word (Word8)
import Frame.Frame (Frame (..))
import Linear.V3 (V3 (..))
import Machine.Machine (Axis (..), Content (..), DigitCode (..), FeedCode (..), Field, Layout, Machine, Service (..))
import Machine.Machine qualified as Machine

-- | Why a row can not be read, and its number from 1 within the frame.
data Fault = Fault {row :: Int, field :: Maybe Content, reason :: Reason}
  deriving stock (Eq, Show)

data Reason
  = -- | a hole outside the tracks of the tape
    ForeignTrack
  | -- | holes that are no digit
    NoDigit Word8
  | MarkerMissing
  | -- | a hole in the service track where there is none
    ServiceHole
  | MinusZero
  | -- | a hole in a row that has to be blank
    NotBlank
  | -- | a feed code that the machine does not have
    UnknownSpeed Int
  | SpeedWithoutMove Int
  | MoveWithoutSpeed
  | -- | nothing moves and nothing is commanded
    IdleFrame
  deriving stock (Eq, Show)

-- | How many rows a frame takes, its gap included and the shift of even frames not.
rowsPerFrame :: Layout -> Int
rowsPerFrame layout = sum (map Machine.digits (Machine.fields layout)) + Machine.gap layout

-- | The rows of a frame that keeps the invariants.
frameRows :: Machine -> Frame -> [Word8]
frameRows machine frame = concatMap fieldRows (Machine.fields layout) <> replicate (Machine.gap layout) 0
  where
    layout = Machine.layout machine
    fieldRows f = zipWith (\digit service -> holes digit .|. mark (contentValue (Machine.content f) frame) service) (decimal f) (services f)
    decimal f = digitsOf (Machine.digits f) (abs (contentValue (Machine.content f) frame))
    holes digit = digitWords (Machine.code layout) !! digit
    mark v service = if punched v service then setBit 0 (serviceBit machine) else 0
    punched v service = case service of
      MinusHole -> v < 0
      AuxiliaryBit k -> testBit (auxiliary frame) k
      Marker -> True
      NoHole -> False

services :: Field -> [Service]
services = NonEmpty.toList . Machine.service

-- | The number in a field of a frame.
contentValue :: Content -> Frame -> Int
contentValue content (Frame (V3 (Pulses x) (Pulses y) (Pulses z)) (FeedCode s) _) = case content of
  Increment X -> x
  Increment Y -> y
  Increment Z -> z
  Speed -> s

-- | The decimal digits of a number, the high one first.
digitsOf :: Int -> Int -> [Int]
digitsOf count n = [n `div` 10 ^ k `mod` 10 | k <- [count - 1, count - 2 .. 0]]

-- | The service track is the last one.
serviceBit :: Machine -> Int
serviceBit machine = Machine.tracks machine - 1

-- | What the rows of a frame say so far.
data Reading = Reading {increments :: V3 Pulses, speedCode :: Int, command :: Int}

-- | Read the rows of one frame, its gap included; there are as many as the layout wants.
readFrame :: Machine -> [Word8] -> Either Fault Frame
readFrame machine rows = do
  (reading, rest) <- readFields (Reading 0 0 0) (zip [1 ..] rows) (Machine.fields layout)
  mapM_ blank rest
  consistent reading
  where
    layout = Machine.layout machine
    readFields reading numbered fields' = case fields' of
      [] -> Right (reading, numbered)
      f : more -> do
        let (mine, others) = splitAt (Machine.digits f) numbered
        reading' <- readField machine f mine reading
        readFields reading' others more
    blank (n, r) = if r == 0 then Right () else Left (Fault n Nothing NotBlank)
    consistent (Reading d s aux)
      | s /= 0 && d == 0 = Left (speedFault (SpeedWithoutMove s))
      | s == 0 && d /= 0 = Left (speedFault MoveWithoutSpeed)
      | d == 0 && aux == 0 = Left (speedFault IdleFrame)
      | s /= 0 && FeedCode s `notElem` map fst (NonEmpty.toList (Machine.feeds machine)) = Left (speedFault (UnknownSpeed s))
      | otherwise = Right Frame {increment = d, speed = FeedCode s, auxiliary = aux}
    speedFault = Fault (rowsPerFrame layout - Machine.gap layout) (Just Speed)

-- | Read the rows of one field into what is known of the frame.
readField :: Machine -> Field -> [(Int, Word8)] -> Reading -> Either Fault Reading
readField machine f rows reading = do
  digits <- traverse digit rows
  marks <- traverse mark (zip rows (services f))
  let n = foldl (\total d -> 10 * total + d) 0 digits
      minus = or [True | (MinusHole, True) <- marks]
      aux = sum [1 `shiftL` k | (AuxiliaryBit k, True) <- marks]
  if minus && n == 0
    then Left (at (take 1 rows) MinusZero)
    else Right (store (if minus then negate n else n) reading {command = command reading + aux})
  where
    bit = serviceBit machine
    at numbered reason = Fault (sum (map fst numbered)) (Just (Machine.content f)) reason
    digit r@(_, holes)
      | holes >= setBit 0 (bit + 1) = Left (at [r] ForeignTrack)
      | otherwise = case elemIndex (holes .&. complement (setBit 0 bit)) (digitWords (Machine.code (Machine.layout machine))) of
        Just d -> Right d
        Nothing -> Left (at [r] (NoDigit (holes .&. complement (setBit 0 bit))))
    mark (r@(_, holes), service) = case (service, testBit holes bit) of
      (Marker, False) -> Left (at [r] MarkerMissing)
      (NoHole, True) -> Left (at [r] ServiceHole)
      (_, hole) -> Right (service, hole)
    store n now = case Machine.content f of
      Increment axis -> now {increments = increments now + along axis (Pulses n)}
      Speed -> now {speedCode = n}
    along axis n = case axis of
      X -> V3 n 0 0
      Y -> V3 0 n 0
      Z -> V3 0 0 n
