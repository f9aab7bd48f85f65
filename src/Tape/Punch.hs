{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Writing a whole tape and reading it: leader, frames with the blank rows between them, trailer.
--
-- Reading refuses a tape that the machine would not have written, see "Tape.Damage". The rows of
-- one frame are written by "Tape.FrameWriter" and read by "Tape.FrameReader".
module Tape.Punch
  ( write,
    rows,
    read,
    readExpected,
    readPunched,
    Damage (..),
    Reason (..),
    toReport,
  )
where

import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses3)
import Control.Monad.ST (runST)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Short qualified as Short
import Data.ByteString.Short.Internal (ShortByteString (SBS))
import Data.Primitive.PrimArray (PrimArray (PrimArray))
import Data.Primitive.PrimArray qualified as Primitive
import Data.Text qualified as Text
import Frame.Frame (Frame)
import Machine.Machine (AxisMeasure (..), Machine, Medium (..), Spare (..))
import Machine.Machine qualified as Machine
import Tape.Damage (Damage (..), Reason (..), toReport)
import Tape.FrameReader qualified as FrameReader
import Tape.FrameWriter qualified as FrameWriter
import Tape.Layout (BlankRows (..), MarkedRow (..), PreparedLayout, RowKind (..))
import Tape.Layout qualified as Layout
import Tape.ModalState (State)
import Tape.ModalState qualified as ModalState
import Tape.NumberReader (RowFault (..))
import Tape.RowMeaning (Row)
import Tape.RowMeaning qualified as RowMeaning
import Tape.Symbol (Symbol)
import Tape.Symbol qualified as Symbol
import Tape.Tape (Tape (..))
import Prelude hiding (read)

-- Writing -----------------------------------------------------------------------------------------

-- | Tape of frames that keep the rules of the machine. The cutter begins at the given position.
write :: Machine -> Pulses3 -> [Frame] -> Tape
write machine start frames =
  Tape
    ( ByteString.concat
        ( holesOf (rowsBefore layout) :
          frameRows layout (ModalState.initial (ModalState.changesHeight frames) start) frames
            <> [holesOf (rowsAfter layout)]
        )
    )
  where
    layout = Layout.fromMachine machine
    holesOf = ByteString.pack . map holes

-- | Rows of the frames with the blank rows between them, in blocks. The rows are written to one
-- buffer, which is copied when it is full.
frameRows :: PreparedLayout -> State -> [Frame] -> [ByteString]
frameRows layout state frames =
  runST (Primitive.newPrimArray (blockSize + mostOfFrame) >>= go 0 state frames)
  where
    medium = Machine.medium (Layout.machine layout)
    mostOfFrame = evenShift medium + FrameWriter.mostRows layout + gap medium
    go used now todo buffer = case todo of
      [] -> (: []) <$> copied used buffer
      f : more
        | used >= blockSize -> (:) <$> copied used buffer <*> go 0 now todo buffer
        | otherwise -> do
          let put at h _ _ = Primitive.writePrimArray buffer at h >> (pure $! at + 1)
              blanks at n
                | n <= 0 = pure at
                | otherwise = (at + n) <$ Primitive.setPrimArray buffer at n 0
          begin <- blanks used (shiftCount medium (ModalState.ordinal now))
          end <- FrameWriter.foldRows put layout now f begin
          next <- blanks end (gap medium)
          go next (Layout.after layout now f) more buffer
    copied used buffer = do
      PrimArray filled <- Primitive.freezePrimArray buffer 0 used
      let !rows' = Short.fromShort (SBS filled)
      pure rows'

-- | Number of rows in a block of 'frameRows'.
blockSize :: Int
blockSize = 32768

-- | Rows of the tape that 'write' makes, each with its meaning.
rows :: Machine -> Pulses3 -> [Frame] -> [Row]
rows machine start frames =
  [RowMeaning.row layout n m | (n, marked) <- markedRows layout start frames, m <- marked]
  where
    layout = Layout.fromMachine machine

-- | Rows of a tape in groups: those of each frame with its number, and those at both ends.
markedRows :: PreparedLayout -> Pulses3 -> [Frame] -> [(Maybe Int, [MarkedRow])]
markedRows layout start frames =
  (Nothing, rowsBefore layout) :
  go (ModalState.initial (ModalState.changesHeight frames) start) frames
  where
    medium = Machine.medium (Layout.machine layout)
    go state todo = case todo of
      [] -> [(Nothing, rowsAfter layout)]
      f : more ->
        ( Just (ModalState.ordinal state),
          Layout.blanks Shift (shiftCount medium (ModalState.ordinal state))
            <> FrameWriter.frameRows layout state f
            <> Layout.blanks Gap (gap medium)
        ) :
        go (Layout.after layout state f) more

-- | Rows before the first frame: the leader and the opening symbols.
rowsBefore :: PreparedLayout -> [MarkedRow]
rowsBefore layout =
  Layout.blanks Leader (leader medium)
    <> map (Layout.constant Opening) (symbolsOf layout (opening medium))
  where
    medium = Machine.medium (Layout.machine layout)

-- | Rows after the last frame: the closing symbols and the trailer.
rowsAfter :: PreparedLayout -> [MarkedRow]
rowsAfter layout =
  map (Layout.constant Closing) (symbolsOf layout (closing medium))
    <> Layout.blanks Trailer (leader medium)
  where
    medium = Machine.medium (Layout.machine layout)

-- | Number of blank rows before the frame with the number @n@, from 1.
shiftCount :: Medium -> Int -> Int
shiftCount medium n = if even n then evenShift medium else 0

symbolsOf :: PreparedLayout -> Text.Text -> [Symbol]
symbolsOf layout = map (Symbol.symbol (Layout.symbols layout)) . Text.unpack

-- Reading -----------------------------------------------------------------------------------------

-- | Frames of a tape. The cutter begins at the given position.
--
-- On a medium where every row counts, each row has its place: a blank row may be a digit 0. On all
-- other media the rows that the code skips are removed first, and blank rows between frames are
-- skipped.
read :: Machine -> Pulses3 -> Tape -> Either Damage [Frame]
read machine start (Tape raw) = case firstFrameRow source of
  Left fault -> Left (damage source Nothing fault)
  -- Increments do not depend on the position, so the tape never has to give the height.
  Right begin | not (hasPositions source) -> readFrom source start begin False
  -- Only the frames show whether the first of them gives the height.
  Right begin -> case (readFrom source start begin True, readFrom source start begin False) of
    (Right frames, _) | ModalState.changesHeight frames -> Right frames
    (Left withHeight, Right frames) | ModalState.changesHeight frames -> Left withHeight
    (_, Right frames) -> Right frames
    (Left withHeight, Left without) ->
      Left (if row withHeight > row without then withHeight else without)
    (Right _, Left without) -> Left without
  where
    source = sourceOf (Layout.fromMachine machine) raw

-- | Frames of a tape that is expected to hold the given frames. If it does, these very frames are
-- the result, so they are not held in memory twice. Else the tape is read as by 'read'.
readExpected :: Machine -> Pulses3 -> [Frame] -> Tape -> Either Damage [Frame]
readExpected machine start expected tape
  | holds machine start expected tape = Right expected
  | otherwise = read machine start tape

-- | Frames of a tape that was punched from the given frames. Any other frames on it are a damage:
-- the description of the machine is ambiguous.
readPunched :: Machine -> Pulses3 -> [Frame] -> Tape -> Either Damage [Frame]
readPunched machine start punched tape
  | holds machine start punched tape = Right punched
  | otherwise =
    read machine start tape >>= \frames ->
      Left
        (Damage 1 (Just (1 + length (takeWhile id (zipWith (==) punched frames)))) Nothing Misread)

-- | True if reading a tape gives exactly the given frames. On a tape with positions these frames
-- show whether the first of them gives the height.
holds :: Machine -> Pulses3 -> [Frame] -> Tape -> Bool
holds machine start expected (Tape raw) = case firstFrameRow source of
  Left _ -> False
  Right begin ->
    areEqual
      expected
      ( framesFrom
          source
          begin
          (ModalState.initial (hasPositions source && ModalState.changesHeight expected) start)
      )
  where
    source = sourceOf (Layout.fromMachine machine) raw
    areEqual frames found = case (frames, found) of
      (f : fs, LazyList.Next g more) -> f == g && areEqual fs more
      ([], LazyList.End fault) -> null fault
      _ -> False

-- | Index of the first row of the first frame.
firstFrameRow :: Source -> Either RowFault Int
firstFrameRow source =
  afterLeader source >>= \at ->
    FrameReader.expect
      (layout source)
      (line source)
      at
      (symbolsOf (layout source) (opening (medium source)))

-- | True for a tape with absolute positions.
hasPositions :: Source -> Bool
hasPositions source = ModalState.measure (Layout.axes (layout source)) /= Increments

-- | All frames from a row on. Given are the position of the cutter, and whether the first frame
-- that moves gives the height.
readFrom :: Source -> Pulses3 -> Int -> Bool -> Either Damage [Frame]
readFrom source start begin givesHeight = case LazyList.end found of
  Just (n, fault) -> Left (damage source n fault)
  Nothing -> Right (LazyList.toList found)
  where
    found = framesFrom source begin (ModalState.initial givesHeight start)

-- | Damage of a row, with the number of its frame.
damage :: Source -> Maybe Int -> RowFault -> Damage
damage source n (RowFault at c why) = Damage (1 + tapeIndex source at) n c why

-- | Rows of a tape, prepared for reading.
data Source = Source
  { layout :: PreparedLayout,
    -- | all rows
    raw :: ByteString,
    -- | the rows that are left when the skipped ones are removed
    kept :: ByteString,
    -- | the same, for access to single rows
    line :: ShortByteString,
    -- | values of rows that are skipped
    skipped :: ByteString,
    -- | the medium; without its blank rows, if these are skipped
    medium :: Medium,
    -- | symbols after the last frame
    ending :: [Symbol]
  }

sourceOf :: PreparedLayout -> ByteString -> Source
sourceOf layout raw =
  Source
    { layout,
      raw,
      kept,
      line = Short.toShort kept,
      skipped,
      medium =
        if ByteString.elem 0 skipped then whole {leader = 0, gap = 0, evenShift = 0} else whole,
      ending = symbolsOf layout (closing whole)
    }
  where
    whole = Machine.medium (Layout.machine layout)
    skipped = case spare whole of
      Counted -> ByteString.empty
      Skipped -> ByteString.pack (Machine.skips (Machine.code (Layout.machine layout)))
    kept =
      if ByteString.any (`ByteString.elem` raw) skipped
        then ByteString.filter (`ByteString.notElem` skipped) raw
        else raw

-- | Index on the tape of a row, from its index among the kept rows.
tapeIndex :: Source -> Int -> Int
tapeIndex source at
  | ByteString.null (skipped source) = at
  | otherwise = go at 0
  where
    go k from =
      case ByteString.findIndex
        (`ByteString.notElem` skipped source)
        (ByteString.drop from (raw source)) of
        Nothing -> max 0 (ByteString.length (raw source) - 1)
        Just d -> if k <= 0 then from + d else go (k - 1 :: Int) (from + d + 1)

-- | Index of the row after the leader. Further blank rows before the opening symbols are skipped on
-- a medium that allows that. Without opening symbols they are not, because they could be the
-- trailer.
afterLeader :: Source -> Either RowFault Int
afterLeader source
  | ByteString.null (kept source)
      && (skippedBlanks < asked || not (Text.null (opening (medium source)))) =
    Left (RowFault 0 Nothing (NoFrames asked))
  | blankCount < ByteString.length front =
    Left (RowFault blankCount Nothing (LeaderNotBlank asked))
  | blankCount < wanted = Left (RowFault (max 0 (blankCount - 1)) Nothing (NoFrames asked))
  | skippedBlanks < asked = Left (RowFault 0 Nothing (LeaderNotBlank asked))
  | spare (medium source) == Skipped && not (Text.null (opening (medium source))) =
    Right (afterBlanks source wanted)
  | otherwise = Right wanted
  where
    wanted = leader (medium source)
    asked = leaderLength source
    front = ByteString.take wanted (kept source)
    blankCount = ByteString.length (ByteString.takeWhile (== 0) front)
    skippedBlanks =
      if skipsBlanks source
        then
          ByteString.count
            0
            (ByteString.takeWhile (`ByteString.elem` skipped source) (raw source))
        else asked

-- | Number of blank rows before the first frame, and after the last.
leaderLength :: Source -> Int
leaderLength source = leader (Machine.medium (Layout.machine (layout source)))

-- | True for a tape whose blank rows are skipped everywhere.
skipsBlanks :: Source -> Bool
skipsBlanks source = ByteString.elem 0 (skipped source)

-- | Index of the first row, from the given one on, that is not blank.
afterBlanks :: Source -> Int -> Int
afterBlanks source at =
  at + ByteString.length (ByteString.takeWhile (== 0) (ByteString.drop at (kept source)))

-- | Frames from a row on as a lazy list. It ends with the first fault and the number of its frame,
-- if there is a fault.
framesFrom :: Source -> Int -> State -> LazyList (Maybe (Maybe Int, RowFault)) Frame
framesFrom source = go
  where
    go !at !state = case endAt source at of
      Ended -> LazyList.End Nothing
      Torn fault -> wrong Nothing fault
      Continued -> case blankRows source ShiftNotBlank (shiftCount (medium source) n) at of
        Left fault -> wrong (Just n) fault
        Right begin ->
          case FrameReader.readFrame (layout source) state (line source) (frameBegin begin) of
            Left fault -> maybe (wrong (Just n) fault) (wrong Nothing) (tornAt source at)
            Right (f, next) -> case blankRows source GapNotBlank (gap (medium source)) next of
              Left fault -> wrong (Just n) fault
              Right afterGap ->
                let !state' = Layout.after (layout source) state f
                 in LazyList.Next f (go afterGap state')
      where
        n = ModalState.ordinal state
    wrong n fault = LazyList.End (Just (n, fault))
    frameBegin begin = case spare (medium source) of
      Counted -> begin
      Skipped -> afterBlanks source begin

-- | Index of the row after @n@ blank rows.
blankRows :: Source -> Reason -> Int -> Int -> Either RowFault Int
blankRows source why n at
  | n <= 0 = Right at
  | otherwise = case ByteString.findIndex (/= 0) found of
    Just k -> Left (RowFault (at + k) Nothing why)
    Nothing
      | ByteString.length found < n ->
        Left (RowFault (ByteString.length (kept source) - 1) Nothing CutOff)
      | otherwise -> Right (at + n)
  where
    found = ByteString.take n (ByteString.drop at (kept source))

-- The end of the tape -----------------------------------------------------------------------------

-- | State of the tape at a row where a frame can begin: properly ended, torn, or with further
-- frames.
data End = Ended | Torn RowFault | Continued

endAt :: Source -> Int -> End
endAt source at = case spare (medium source) of
  Counted
    | ByteString.length (kept source) - at == Text.length closer + leader (medium source),
      Just _ <- trailerAt source at ->
      Ended
    | at >= ByteString.length (kept source) -> torn
    | otherwise -> Continued
  Skipped -> case trailerAt source at of
    Nothing -> if afterBlanks source at >= ByteString.length (kept source) then torn else Continued
    Just found
      | trailerLength source found >= leaderLength source -> Ended
      | otherwise -> torn
  where
    closer = closing (medium source)
    torn = maybe Continued Torn (tornAt source at)

-- | Number of blank rows at the end of the tape, from the number of those that are kept.
trailerLength :: Source -> Int -> Int
trailerLength source found
  | skipsBlanks source =
    ByteString.count 0 (ByteString.takeWhileEnd (`ByteString.elem` skipped source) (raw source))
  | otherwise = found

-- | Number of blank rows after the closing symbols, if these and nothing else follow from a row on.
trailerAt :: Source -> Int -> Maybe Int
trailerAt source at = case FrameReader.expect (layout source) (line source) first cs of
  Right afterSymbols
    | ByteString.all (== 0) (ByteString.drop afterSymbols (kept source)) ->
      Just (ByteString.length (kept source) - afterSymbols)
  _ -> Nothing
  where
    cs = ending source
    first = case spare (medium source) of
      Counted -> at
      Skipped -> if null cs then at else afterBlanks source at

-- | Fault of a tape that ends at a row in another manner than it should; none if it does not end
-- there.
tornAt :: Source -> Int -> Maybe RowFault
tornAt source at = case trailerAt source at of
  Just found ->
    Just
      ( RowFault final Nothing (TrailerLength (trailerLength source found) (leaderLength source))
      )
  Nothing
    | afterBlanks source at >= ByteString.length (kept source) ->
      Just (RowFault final Nothing (MissingClosing (closing (medium source))))
    | otherwise -> Nothing
  where
    final = max 0 (ByteString.length (kept source) - 1)
