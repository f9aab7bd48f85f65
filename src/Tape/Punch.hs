{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Frames onto tape and tape into frames: the leader, the frames with what stands between them,
-- the end.
module Tape.Punch
  ( write,
    rows,
    read,
    readBack,
    readOwn,
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
import Tape.Layout (BlankRows (..), Layout, MarkedRow (..), RowMeaning (..))
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

-- | Punch frames that keep the invariants of the machine, from where the cutter stands before the
-- first.
write :: Machine -> Pulses3 -> [Frame] -> Tape
write machine start frames =
  Tape
    ( ByteString.concat
        ( holesOf (opened plan) :
          punched plan (ModalState.first (ModalState.rising frames) start) frames
            <> [holesOf (closed plan)]
        )
    )
  where
    plan = Layout.fromMachine machine
    holesOf = ByteString.pack . map holes

-- | The rows of frames with what stands between them, in pieces: they are put into one buffer,
-- which is copied when it is full.
punched :: Layout -> State -> [Frame] -> [ByteString]
punched plan state frames = runST (Primitive.newPrimArray (piece + most) >>= go 0 state frames)
  where
    medium = Machine.medium (Layout.machine plan)
    most = evenShift medium + Layout.mostRows plan + gap medium
    go used now todo buffer = case todo of
      [] -> (: []) <$> taken used buffer
      f : more
        | used >= piece -> (:) <$> taken used buffer <*> go 0 now todo buffer
        | otherwise -> do
          let put at h _ _ = Primitive.writePrimArray buffer at h >> (pure $! at + 1)
              blanks at n
                | n <= 0 = pure at
                | otherwise = (at + n) <$ Primitive.setPrimArray buffer at n 0
          begin <- blanks used (shiftRows medium (ModalState.ordinal now))
          end <- Layout.foldRows put plan now f begin
          next <- blanks end (gap medium)
          go next (Layout.after plan now f) more buffer
    taken used buffer = do
      PrimArray filled <- Primitive.freezePrimArray buffer 0 used
      let !rows' = Short.fromShort (SBS filled)
      pure rows'

-- | So many rows are written at once.
piece :: Int
piece = 32768

-- | The rows of the same tape, each with what it means.
rows :: Machine -> Pulses3 -> [Frame] -> [Row]
rows machine start frames =
  [RowMeaning.row plan n m | (n, marks) <- stretches plan start frames, m <- marks]
  where
    plan = Layout.fromMachine machine

-- | The marks of a tape, those of each frame with its number.
stretches :: Layout -> Pulses3 -> [Frame] -> [(Maybe Int, [MarkedRow])]
stretches plan start frames =
  (Nothing, opened plan) : go (ModalState.first (ModalState.rising frames) start) frames
  where
    medium = Machine.medium (Layout.machine plan)
    go state todo = case todo of
      [] -> [(Nothing, closed plan)]
      f : more ->
        ( Just (ModalState.ordinal state),
          shift plan (ModalState.ordinal state)
            <> Layout.frameMarks plan state f
            <> Layout.blanks Gap (gap medium)
        ) :
        go (Layout.after plan state f) more

-- | What stands before the first frame.
opened :: Layout -> [MarkedRow]
opened plan =
  Layout.blanks Leader (leader medium)
    <> map (Layout.constant Opening) (symbolsOf plan (opening medium))
  where
    medium = Machine.medium (Layout.machine plan)

-- | What stands behind the last frame.
closed :: Layout -> [MarkedRow]
closed plan =
  map (Layout.constant Closing) (symbolsOf plan (closing medium))
    <> Layout.blanks Trailer (leader medium)
  where
    medium = Machine.medium (Layout.machine plan)

-- | What stands right before a frame, by its number from 1.
shift :: Layout -> Int -> [MarkedRow]
shift plan n = Layout.blanks Shift (shiftRows (Machine.medium (Layout.machine plan)) n)

-- | The blank rows before a frame, by its number from 1.
shiftRows :: Medium -> Int -> Int
shiftRows medium n = if even n then evenShift medium else 0

symbolsOf :: Layout -> Text.Text -> [Symbol]
symbolsOf plan = map (Symbol.symbol (Layout.symbols plan)) . Text.unpack

-- Reading -----------------------------------------------------------------------------------------

-- | Read a tape that begins where the cutter stands.
--
-- With a counted grid everything stands at its place: a blank row may be a digit 0. Otherwise rows
-- that the code passes over are left out first, and blank rows are passed over between frames.
read :: Machine -> Pulses3 -> Tape -> Either Damage [Frame]
read machine start (Tape raw) = case beginning source of
  Left fault -> Left (damage source Nothing fault)
  -- Increments do not tell where the cutter stands.
  Right behind | not (saysPlaces source) -> gathered source start behind False
  -- Only the frames tell whether the height has to be said.
  Right behind -> case (gathered source start behind True, gathered source start behind False) of
    (Right frames, _) | ModalState.rising frames -> Right frames
    (Left high, Right frames) | ModalState.rising frames -> Left high
    (_, Right frames) -> Right frames
    (Left high, Left low) -> Left (if row high > row low then high else low)
    (Right _, Left low) -> Left low
  where
    source = sourceOf (Layout.fromMachine machine) raw

-- | Read a tape on which some frames should stand. Where it has just these they are what is read:
-- they are not made a second time.
readBack :: Machine -> Pulses3 -> [Frame] -> Tape -> Either Damage [Frame]
readBack machine start wanted tape
  | holds machine start wanted tape = Right wanted
  | otherwise = read machine start tape

-- | Read a tape that was punched with these frames: anything else than them is a damage.
readOwn :: Machine -> Pulses3 -> [Frame] -> Tape -> Either Damage [Frame]
readOwn machine start wanted tape
  | holds machine start wanted tape = Right wanted
  | otherwise =
    read machine start tape >>= \frames ->
      Left
        (Damage 1 (Just (1 + length (takeWhile id (zipWith (==) wanted frames)))) Nothing Misread)

-- | Whether these frames are read from a tape. If it says where the cutter is, they tell whether it
-- says heights.
holds :: Machine -> Pulses3 -> [Frame] -> Tape -> Bool
holds machine start wanted (Tape raw) = case beginning source of
  Left _ -> False
  Right behind ->
    are
      wanted
      ( framesFrom
          source
          behind
          (ModalState.first (saysPlaces source && ModalState.rising wanted) start)
      )
  where
    source = sourceOf (Layout.fromMachine machine) raw
    are frames series = case (frames, series) of
      (f : fs, LazyList.Next g more) -> f == g && are fs more
      ([], LazyList.End wrong) -> null wrong
      _ -> False

-- | The row of the first frame.
beginning :: Source -> Either RowFault Int
beginning source =
  frontOf source >>= \at ->
    FrameReader.expect
      (plan source)
      (line source)
      at
      (symbolsOf (plan source) (opening (grid source)))

-- | Whether frames say where the cutter is, rather than how far it goes.
saysPlaces :: Source -> Bool
saysPlaces source = ModalState.measure (Layout.axes (plan source)) /= Increments

-- | The frames from a row on, where the cutter stands before them; whether they say heights.
gathered :: Source -> Pulses3 -> Int -> Bool -> Either Damage [Frame]
gathered source start behind rises = case LazyList.end series of
  Just (n, fault) -> Left (damage source n fault)
  Nothing -> Right (LazyList.toList series)
  where
    series = framesFrom source behind (ModalState.first rises start)

-- | What is wrong, in which frame if it is in one.
damage :: Source -> Maybe Int -> RowFault -> Damage
damage source n (RowFault at c why) = Damage (1 + origin source at) n c why

-- | The rows to be read.
data Source = Source
  { plan :: Layout,
    raw :: ByteString,
    -- | without those that are passed over
    kept :: ByteString,
    -- | the same, where one row at a time is looked at
    line :: ShortByteString,
    -- | those that are passed over
    skipped :: ByteString,
    -- | the medium, as far as blank rows are kept
    grid :: Medium,
    -- | the symbols behind the last frame
    ending :: [Symbol]
  }

sourceOf :: Layout -> ByteString -> Source
sourceOf plan raw =
  Source
    { plan,
      raw,
      kept,
      line = Short.toShort kept,
      skipped,
      grid,
      ending = symbolsOf plan (closing medium)
    }
  where
    medium = Machine.medium (Layout.machine plan)
    skipped = case spare medium of
      Counted -> ByteString.empty
      Skipped -> ByteString.pack (Machine.skips (Machine.code (Layout.machine plan)))
    kept =
      if ByteString.any (`ByteString.elem` raw) skipped
        then ByteString.filter (`ByteString.notElem` skipped) raw
        else raw
    grid = if ByteString.elem 0 skipped then medium {leader = 0, gap = 0, evenShift = 0} else medium

-- | The row of the tape for a row that is kept.
origin :: Source -> Int -> Int
origin source at
  | ByteString.null (skipped source) = at
  | otherwise = go at 0
  where
    go k from =
      case ByteString.findIndex
        (`ByteString.notElem` skipped source)
        (ByteString.drop from (raw source)) of
        Nothing -> max 0 (ByteString.length (raw source) - 1)
        Just d -> if k <= 0 then from + d else go (k - 1 :: Int) (from + d + 1)

-- | The row behind the leader. Further blank rows are passed over before the symbols at the
-- beginning; where there are none they may be the trailer.
frontOf :: Source -> Either RowFault Int
frontOf source
  | ByteString.null (kept source) && (passed < asked || not (Text.null (opening (grid source)))) =
    Left (RowFault 0 Nothing (NoFrames asked))
  | blankRun < ByteString.length front = Left (RowFault blankRun Nothing (LeaderNotBlank asked))
  | blankRun < wanted = Left (RowFault (max 0 (blankRun - 1)) Nothing (NoFrames asked))
  | passed < asked = Left (RowFault 0 Nothing (LeaderNotBlank asked))
  | spare (grid source) == Skipped && not (Text.null (opening (grid source))) =
    Right (blankFrom source wanted)
  | otherwise = Right wanted
  where
    wanted = leader (grid source)
    asked = leaderAsked source
    front = ByteString.take wanted (kept source)
    blankRun = ByteString.length (ByteString.takeWhile (== 0) front)
    passed =
      if skipsBlanks source
        then
          ByteString.count
            0
            (ByteString.takeWhile (`ByteString.elem` skipped source) (raw source))
        else asked

-- | The blank rows before the first frame and behind the last.
leaderAsked :: Source -> Int
leaderAsked source = leader (Machine.medium (Layout.machine (plan source)))

-- | Whether blank rows are passed over everywhere.
skipsBlanks :: Source -> Bool
skipsBlanks source = ByteString.elem 0 (skipped source)

-- | The first row from one on that is not blank.
blankFrom :: Source -> Int -> Int
blankFrom source at =
  at + ByteString.length (ByteString.takeWhile (== 0) (ByteString.drop at (kept source)))

-- | The frames from a row on, and behind them what is wrong with the tape, and in which frame, if
-- anything is.
framesFrom :: Source -> Int -> State -> LazyList (Maybe (Maybe Int, RowFault)) Frame
framesFrom source = go
  where
    p = plan source
    go !at !state = case endAt source at of
      Ended -> LazyList.End Nothing
      Torn fault -> wrong Nothing fault
      Onward -> case blankRows source ShiftNotBlank (shiftRows (grid source) n) at of
        Left fault -> wrong (Just n) fault
        Right begin -> case FrameReader.readFrame p state (line source) (firstFrom begin) of
          Left fault -> maybe (wrong (Just n) fault) (wrong Nothing) (tornAt source at)
          Right (f, next) -> case blankRows source GapNotBlank (gap (grid source)) next of
            Left fault -> wrong (Just n) fault
            Right behind ->
              let !state' =
                    Layout.after p state f
               in LazyList.Next f (go behind state')
      where
        n = ModalState.ordinal state
    wrong n fault = LazyList.End (Just (n, fault))
    firstFrom begin = case spare (grid source) of
      Counted -> begin
      Skipped -> blankFrom source begin

-- | The row behind blank ones.
blankRows :: Source -> Reason -> Int -> Int -> Either RowFault Int
blankRows source why n at
  | n <= 0 = Right at
  | otherwise = case ByteString.findIndex (/= 0) stretch of
    Just k -> Left (RowFault (at + k) Nothing why)
    Nothing
      | ByteString.length stretch < n ->
        Left (RowFault (ByteString.length (kept source) - 1) Nothing CutOff)
      | otherwise -> Right (at + n)
  where
    stretch = ByteString.take n (ByteString.drop at (kept source))

-- | Whether the tape ends where a frame may begin.
data End = Ended | Torn RowFault | Onward

endAt :: Source -> Int -> End
endAt source at = case spare (grid source) of
  Counted
    | ByteString.length (kept source) - at == Text.length closer + leader (grid source),
      Just _ <- tailAt source at ->
      Ended
    | at >= ByteString.length (kept source) -> torn
    | otherwise -> Onward
  Skipped -> case tailAt source at of
    Nothing -> if blankFrom source at >= ByteString.length (kept source) then torn else Onward
    Just found
      | blanksBehind source found >= leaderAsked source -> Ended
      | otherwise -> torn
  where
    closer = closing (grid source)
    torn = maybe Onward Torn (tornAt source at)

-- | The blank rows at the end of the tape, by those that are kept there.
blanksBehind :: Source -> Int -> Int
blanksBehind source found
  | skipsBlanks source =
    ByteString.count 0 (ByteString.takeWhileEnd (`ByteString.elem` skipped source) (raw source))
  | otherwise = found

-- | The blank rows behind the closing symbols, where these and nothing else stand at a row.
tailAt :: Source -> Int -> Maybe Int
tailAt source at = case FrameReader.expect (plan source) (line source) first cs of
  Right behind
    | ByteString.all (== 0) (ByteString.drop behind (kept source)) ->
      Just (ByteString.length (kept source) - behind)
  _ -> Nothing
  where
    cs = ending source
    first = case spare (grid source) of
      Counted -> at
      Skipped -> if null cs then at else blankFrom source at

-- | Why a tape ends other than it should, if it ends at a row.
tornAt :: Source -> Int -> Maybe RowFault
tornAt source at = case tailAt source at of
  Just found ->
    Just (RowFault final Nothing (TrailerLength (blanksBehind source found) (leaderAsked source)))
  Nothing
    | blankFrom source at >= ByteString.length (kept source) ->
      Just (RowFault final Nothing (NoClosing (closing (grid source))))
    | otherwise -> Nothing
  where
    final = max 0 (ByteString.length (kept source) - 1)
