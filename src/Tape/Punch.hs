{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Writer and reader of whole tapes: leader, frames with the blank rows between them, trailer.
--
-- The reader refuses a tape that the machine would not have written, see "Tape.Damage". The rows of
-- a single frame belong to "Tape.FrameWriter" and "Tape.FrameReader". Indices of rows count from 0,
-- numbers of frames from 1.
--
-- The leader is the blank rows at the start of the tape, the trailer those at its end. Opening
-- symbols follow the leader, closing symbols precede the trailer. Blank rows before a frame with an
-- even number are a shift, blank rows after a frame are a gap.
--
-- Blank rows are 'Counted' or 'Skipped', as the machine description says ('Spare'). If they are
-- 'Skipped', the reader also skips the rows that the tape code lists, such as erased rows.
module Tape.Punch
  ( write,
    rows,
    read,
    readExpected,
    readPunched,
    TapeFrame (..),
    readInTurn,
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

-- | Tape of the given frames, which have to keep the rules of the machine, see
-- 'Frame.Frame.violations'. The cutter begins at the position @start@, in pulses.
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

-- | Rows of the frames with the blank rows between them, in blocks. All blocks are filled in one
-- buffer, which is copied when it is full, so the memory in use stays small. @state@ is the modal
-- state before the first frame.
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

-- | Least count of rows in a block of 'frameRows'; the last block may be shorter. Every block ends
-- at the end of a frame.
blockSize :: Int
blockSize = 32768

-- | Rows of the tape that 'write' makes, each with its meaning.
rows :: Machine -> Pulses3 -> [Frame] -> [Row]
rows machine start frames =
  [RowMeaning.row layout n m | (n, marked) <- markedRows layout start frames, m <- marked]
  where
    layout = Layout.fromMachine machine

-- | Rows of a tape in groups. Each frame is a group with the number of the frame. The rows before
-- the first frame and those after the last one are two groups without a number.
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

-- | Count of blank rows that the medium demands before the frame with the number @n@, from 1.
shiftCount :: Medium -> Int -> Int
shiftCount medium n = if even n then evenShift medium else 0

symbolsOf :: PreparedLayout -> Text.Text -> [Symbol]
symbolsOf layout = map (Symbol.symbol (Layout.symbols layout)) . Text.unpack

-- Reading -----------------------------------------------------------------------------------------

-- | Frames of a tape, or the first damage of the tape. The cutter begins at the position @start@,
-- in pulses.
--
-- If blank rows are 'Counted', every row matters, because a blank row may be the digit 0. If they
-- are 'Skipped', the reader first removes the rows that the tape code skips, and ignores blank rows
-- between frames.
read :: Machine -> Pulses3 -> Tape -> Either Damage [Frame]
read machine start (Tape raw) = case firstFrameRow source of
  Left fault -> Left (damage source Nothing fault)
  -- On a tape of increments no word gives an absolute height, so the tape is read only once.
  Right begin | not (hasPositions source) -> readFrom source start begin False
  -- The first frame that moves has a word for z if any frame of the tape changes the height. The
  -- reader knows this only after it has read all frames, so it reads them twice: with that word
  -- (True) and without it.
  Right begin -> case (readFrom source start begin True, readFrom source start begin False) of
    (Right frames, _) | ModalState.changesHeight frames -> Right frames
    (Left withHeight, Right frames) | ModalState.changesHeight frames -> Left withHeight
    (_, Right frames) -> Right frames
    (Left withHeight, Left without) ->
      Left (if row withHeight > row without then withHeight else without)
    (Right _, Left without) -> Left without
  where
    source = sourceOf (Layout.fromMachine machine) raw

-- | Frames of a tape on which the frames @expected@ are expected. If the tape has exactly these
-- frames, the result is @expected@ itself, so that memory does not hold the frames twice.
-- Otherwise it is the result of 'read'.
readExpected :: Machine -> Pulses3 -> [Frame] -> Tape -> Either Damage [Frame]
readExpected machine start expected tape
  | holds machine start expected tape = Right expected
  | otherwise = read machine start tape

-- | Frames of a tape that was punched from the frames @punched@. If the tape is read as other
-- frames, the result is the damage 'Misread': the description of the machine is ambiguous.
readPunched :: Machine -> Pulses3 -> [Frame] -> Tape -> Either Damage [Frame]
readPunched machine start punched tape
  | holds machine start punched tape = Right punched
  | otherwise =
    read machine start tape >>= \frames ->
      Left
        (Damage 1 (Just (1 + length (takeWhile id (zipWith (==) punched frames)))) Nothing Misread)

-- | Frame as a controller reads it from the tape.
data TapeFrame = TapeFrame
  { frameRead :: Frame,
    -- | count of rows from the end of the frame before to the end of this frame. For the first
    -- frame they begin with the tape, leader and opening symbols included.
    rowsRead :: Int,
    -- | for each of the last rows, up to the end of the frame: true for the last row of a word
    wordEnds :: ~[Bool]
  }

-- | Frames of a tape, read one after the other, as a controller does. The list ends with the first
-- damage; Nothing at the proper end of the tape. The cutter begins at the position @start@, in
-- pulses.
readInTurn :: Machine -> Pulses3 -> Tape -> LazyList (Maybe Damage) TapeFrame
readInTurn machine start (Tape raw) = case firstFrameRow source of
  Left fault -> LazyList.End (Just (damage source Nothing fault))
  Right begin ->
    go
      (RowCursor {keptRow = 0, rawRow = 0})
      (itemsFrom (,,) source begin (ModalState.initial givesHeight start))
  where
    source = sourceOf (Layout.fromMachine machine) raw
    -- On a tape of positions the whole tape decides whether the first frame gives the height.
    givesHeight =
      hasPositions source
        && either (const True) ModalState.changesHeight (read machine start (Tape raw))
    go !cursor list = case list of
      LazyList.End fault -> LazyList.End (uncurry (damage source) <$> fault)
      LazyList.Next (state, f, after) more ->
        let !cursor' = movedTo source after cursor
         in LazyList.Next
              TapeFrame
                { frameRead = f,
                  rowsRead = rawRow cursor' - rawRow cursor,
                  wordEnds = endsOfWords (FrameWriter.frameRows (layout source) state f)
                }
              (go cursor' more)

-- | For each row: true if the row belongs to a word and the next one does not belong to the same.
endsOfWords :: [MarkedRow] -> [Bool]
endsOfWords marked = zipWith isEnd marked (map Just (drop 1 marked) <> [Nothing])
  where
    isEnd m after = case kind m of
      InWord c _ _ -> maybe True (\n -> not (isIn c n)) after
      _ -> False
    isIn c m = case kind m of
      InWord d _ _ -> c == d
      _ -> False

-- | Row of the tape, counted without the rows that the tape code skips, and counted with them.
data RowCursor = RowCursor {keptRow :: Int, rawRow :: Int}

-- | Moves a cursor on to the row with the index @at@ in 'kept'.
movedTo :: Source -> Int -> RowCursor -> RowCursor
movedTo source at cursor
  | ByteString.null (skipped source) = RowCursor {keptRow = at, rawRow = at}
  | otherwise = go (keptRow cursor) (rawRow cursor)
  where
    go k r
      | k >= at || r >= ByteString.length (raw source) = RowCursor {keptRow = at, rawRow = r}
      | ByteString.elem (ByteString.index (raw source) r) (skipped source) = go k (r + 1)
      | otherwise = go (k + 1) (r + 1)

-- | True if reading a tape gives exactly the frames @expected@, without a fault.
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

-- | Index of the first row after the leader and the opening symbols, or a fault in these.
firstFrameRow :: Source -> Either RowFault Int
firstFrameRow source =
  afterLeader source >>= \at ->
    FrameReader.expect
      (layout source)
      (line source)
      at
      (symbolsOf (layout source) (opening (medium source)))

-- | True for a tape on which axis words give absolute positions, not increments.
hasPositions :: Source -> Bool
hasPositions source = ModalState.measure (Layout.axes (layout source)) /= Increments

-- | All frames from row @begin@ on, or the first damage. @start@ is the position of the cutter
-- before these frames, in pulses. @givesHeight@ is true if the first frame that moves has to give
-- the height.
readFrom :: Source -> Pulses3 -> Int -> Bool -> Either Damage [Frame]
readFrom source start begin givesHeight = case LazyList.end found of
  Just (n, fault) -> Left (damage source n fault)
  Nothing -> Right (LazyList.toList found)
  where
    found = framesFrom source begin (ModalState.initial givesHeight start)

-- | Damage that reports the fault of a row; @n@ is the number of the row's frame, 'Nothing' for a
-- row outside of all frames.
damage :: Source -> Maybe Int -> RowFault -> Damage
damage source n (RowFault at c why) = Damage (1 + tapeIndex source at) n c why

-- | Rows of a tape, prepared for reading.
data Source = Source
  { layout :: PreparedLayout,
    -- | all rows of the tape
    raw :: ByteString,
    -- | 'raw' without the rows in 'skipped'
    kept :: ByteString,
    -- | the rows of 'kept' in a type with fast access to single rows
    line :: ShortByteString,
    -- | the rows that the tape code skips, each once; empty if blank rows are 'Counted'
    skipped :: ByteString,
    -- | medium of the machine. If 'skipped' contains the blank row, 'kept' has no blank rows, and
    -- the medium's counts of them (leader, gap, shift) are set to 0.
    medium :: Medium,
    -- | closing symbols
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

-- | Converts the index of a row in 'kept' to the index of the row in 'raw', for reports.
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

-- | Index in 'kept' of the row after the leader. The result is a fault if the leader is too short
-- or has holes, or if no row remains for the opening symbols.
--
-- If blank rows are 'Skipped', additional blank rows before the opening symbols are ignored too.
-- Without opening symbols they are not ignored, because they could be the trailer.
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

-- | Count of blank rows that the medium demands in the leader. The trailer must have as many.
leaderLength :: Source -> Int
leaderLength source = leader (Machine.medium (Layout.machine (layout source)))

-- | True if the tape code skips blank rows, so that 'kept' contains none.
skipsBlanks :: Source -> Bool
skipsBlanks source = ByteString.elem 0 (skipped source)

-- | Index in 'kept' of the first row with holes at or after row @at@; the count of all rows in
-- 'kept' if there is none.
afterBlanks :: Source -> Int -> Int
afterBlanks source at =
  at + ByteString.length (ByteString.takeWhile (== 0) (ByteString.drop at (kept source)))

-- | Frames from a row on as a lazy list. The arguments are the index of the row, and the modal
-- state before the frame there.
--
-- The list ends with 'Nothing' at the proper end of the tape. Otherwise it ends with the first
-- fault and the number of the faulty frame; a fault outside of all frames has no number.
framesFrom :: Source -> Int -> State -> LazyList (Maybe (Maybe Int, RowFault)) Frame
framesFrom = itemsFrom (\_ f _ -> f)

-- | Variant of 'framesFrom' whose items are made by a function from the modal state before a frame,
-- the frame, and the index of the row after the frame.
itemsFrom ::
  (State -> Frame -> Int -> a) ->
  Source ->
  Int ->
  State ->
  LazyList (Maybe (Maybe Int, RowFault)) a
itemsFrom item source = go
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
                 in LazyList.Next (item state f next) (go afterGap state')
      where
        n = ModalState.ordinal state
    wrong n fault = LazyList.End (Just (n, fault))
    frameBegin begin = case spare (medium source) of
      Counted -> begin
      Skipped -> afterBlanks source begin

-- | Index of the row after the @n@ blank rows that begin at row @at@. If one of these rows has
-- holes, the result is a fault with the reason @why@.
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

-- | Rest of a tape, from a row at which a frame can begin.
data End
  = -- | closing symbols and trailer follow, and nothing else
    Ended
  | -- | no frame follows, and the end of the tape is wrong
    Torn RowFault
  | -- | another frame follows
    Continued

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

-- | Count of blank rows at the end of the tape. If the tape code skips blank rows, they are counted
-- in 'raw'; otherwise the result is @found@, their count in 'kept'.
trailerLength :: Source -> Int -> Int
trailerLength source found
  | skipsBlanks source =
    ByteString.count 0 (ByteString.takeWhileEnd (`ByteString.elem` skipped source) (raw source))
  | otherwise = found

-- | Count of blank rows in 'kept' after the closing symbols, if the closing symbols follow at row
-- @at@ and only blank rows follow after them. 'Nothing' if anything else follows.
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

-- | Fault of a tape on which no frame begins at row @at@: a trailer of a wrong length, or missing
-- closing symbols. 'Nothing' if other symbols than the closing ones follow there. Then the frame at
-- row @at@ is faulty.
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
