{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | The rows of one frame read back, by the steps that wrote them.
--
-- What is read becomes a frame, and the frame is written again: rows that the layout would not have
-- written are faults, whatever they are.
module Tape.FrameReader
  ( RowFault (..),
    readFrame,
    wordByWord,
    expect,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Data.ByteString.Short (ShortByteString)
import Data.ByteString.Short qualified as Short
import Data.Functor.Identity (runIdentity)
import Data.List (find, foldl')
import Data.Maybe (fromMaybe, isJust)
import Data.Word (Word8)
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Machine.Machine
  ( Axis (..),
    AxisMeasure (..),
    Content (..),
    FeedCode (..),
    MotionCodes (..),
    NumberForm (..),
    Presence (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Tape.Damage (Reason (..))
import Tape.FrameReader.Fast qualified as FastFrameReader
import Tape.Layout
  ( Address (..),
    Layout,
    LayoutStep (..),
    MarkedRow (..),
    RowContent (..),
    RowMeaning (..),
  )
import Tape.Layout qualified as Layout
import Tape.ModalState (State (..))
import Tape.ModalState qualified as ModalState
import Tape.NumberReader (RowFault (..))
import Tape.NumberReader qualified as NumberReader
import Tape.RowMeaning qualified as RowMeaning
import Tape.Symbol (Symbol)
import Tape.Symbol qualified as Symbol

-- | What stands in a frame.
data Reading = Reading
  { -- | its words in order; no two of them say the same
    saids :: [Said],
    -- | what its commands are given, and those beside its numbers
    commands :: [(Machine.CommandName, Int)],
    braked :: Bool,
    -- | what the symbols add to, if frames have a check digit
    total :: Int,
    -- | the row of the check digit, and of what the sum has to be a multiple
    check :: Maybe (Int, Int)
  }

-- | A word, the row of its number, the number, and how many digits it has.
data Said = Said {word :: Word', at :: Int, number :: Int, places :: Int}

-- | The word that says something, if it was read.
said :: (Content -> Bool) -> Reading -> Maybe Said
said isIt reading = find (isIt . content . word) (saids reading)
{-# INLINE said #-}

isFrameNumber, isMotion, isFeed :: Content -> Bool
isFrameNumber c = case c of FrameNumber -> True; _ -> False
isMotion c = case c of Motion _ -> True; _ -> False
isFeed c = case c of FeedWord -> True; _ -> False

isAlong, isCentre :: Axis -> Content -> Bool
isAlong a c = case c of Along b -> a == b; _ -> False
isCentre a c = case c of Centre b -> a == b; _ -> False

-- | The frame that begins at a row, and the row behind it.
readFrame :: Layout -> State -> ShortByteString -> Int -> Either RowFault (Frame, Int)
readFrame plan state rows begin = case FastFrameReader.readFrame plan state rows begin of
  FastFrameReader.Read f end -> Right (f, end)
  FastFrameReader.NotBare -> wordByWord plan state rows begin

-- | The same, whatever the frame is.
wordByWord :: Layout -> State -> ShortByteString -> Int -> Either RowFault (Frame, Int)
wordByWord plan state rows begin = do
  (reading, end) <- readSteps plan rows begin
  case check reading of
    Just (k, modulus)
      | total reading `mod` max 1 modulus /= 0 ->
        Left (RowFault k Nothing (AddsTo (total reading) modulus))
    _ -> Right ()
  f <- frameOf plan state begin reading
  lawful plan begin reading f
  if not (isSpelled plan state reading f || isWritten plan state rows begin end f)
    then written plan rows begin end (Layout.frameMarks plan state f)
    else Right ()
  Right (f, end)

-- | The words of a frame in order.
readSteps :: Layout -> ShortByteString -> Int -> Either RowFault (Reading, Int)
readSteps plan rows = go False (Layout.steps plan) [] (Reading [] [] False 0 Nothing)
  where
    -- The words so far, the last one first; the rest of what is read rarely changes.
    go behindWord todo done !now !k = case lacking behindWord todo k of
      [] -> Right (now {saids = reverse done}, k)
      Fixed cs : more
        | next >= 0 -> go False more done (counting cs now) next
        | otherwise -> Left (mismatch plan Nothing rows k cs)
        where
          next = Symbol.behind rows k cs
      Checked modulus : more -> do
        d <- NumberReader.digit plan Nothing rows k
        go
          False
          more
          done
          ( now
              { total = total now + Symbol.digitWeight (Layout.symbols plan) d,
                check = Just (k, modulus)
              }
          )
          (k + 1)
      Worded w cs joined : more
        | stands -> do
          n <- NumberReader.numeral plan (content w) (form w) rows begin
          let s =
                Said
                  { word = w,
                    at = NumberReader.start n,
                    number = NumberReader.value n,
                    places = NumberReader.places n
                  }
          go True more (s : done) (beside w n (counting (spelled prefix) now)) (NumberReader.next n)
        | otherwise -> Left (mismatch plan (Just (content w)) rows k (spelled prefix))
        where
          prefix = if behindWord then joined else cs
          begin = Layout.behindAddress rows k prefix
          stands = isThere w cs begin
    isThere w cs begin =
      begin >= 0
        && (extent cs > 0 || presence w == Always || NumberReader.begins plan (form w) rows begin)
    -- Behind the words that a frame can do without, as far as they do not stand here.
    lacking behindWord todo k = case todo of
      Worded w cs joined : more
        | presence w /= Always
            && not
              (isThere w cs (Layout.behindAddress rows k (if behindWord then joined else cs))) ->
          lacking behindWord more k
      _ -> todo
    counting cs now
      | Layout.isChecked plan = now {total = foldl' (\n c -> n + Symbol.weight c) (total now) cs}
      | otherwise = now
    -- What a command is given; what the service track says beside a number, and what its digits
    -- add.
    beside w n now = case content w of
      Command o -> (counted n now) {commands = (o, NumberReader.value n) : commands (counted n now)}
      _ -> counted n now
    counted n now
      | null (NumberReader.bits n) && not (NumberReader.brakes n) && not (Layout.isChecked plan) =
        now
      | otherwise =
        now
          { commands = NumberReader.bits n <> commands now,
            braked = braked now || NumberReader.brakes n,
            total = total now + NumberReader.total n
          }

-- | The row behind symbols that have to stand here.
expect :: Layout -> ShortByteString -> Int -> [Symbol] -> Either RowFault Int
expect plan rows k cs =
  let next =
        Symbol.behind rows k cs
   in if next >= 0 then Right next else Left (mismatch plan Nothing rows k cs)

-- | The first of some symbols that does not stand where it should.
mismatch :: Layout -> Maybe Content -> ShortByteString -> Int -> [Symbol] -> RowFault
mismatch plan c rows k cs = case cs of
  [] -> RowFault k c NotBlank
  s : more
    | k >= Short.length rows -> RowFault (Short.length rows - 1) c CutOff
    | Short.index rows k == Symbol.holes s -> mismatch plan c rows (k + 1) more
    | otherwise -> RowFault k c (insteadOf plan (Short.index rows k) s)

-- | Why a row is not the symbol that it should be.
insteadOf :: Layout -> Word8 -> Symbol -> Reason
insteadOf plan w s = case NumberReader.blemish plan w of
  Just why -> why
  Nothing -> case Symbol.symbolAt (Layout.symbols plan) w of
    _ | w == 0 -> Missing (Symbol.name s)
    Nothing ->
      if Symbol.holes s == 0
        then NotBlank
        else NoSymbol (Machine.tracks (Machine.medium (Layout.machine plan))) w
    Just c
      | or [Symbol.name a == c | Worded _ Spelled {spelled = a : _} _ <- Layout.steps plan] ->
        WordOutOfPlace c
      | otherwise -> Unexpected c (Symbol.name s)

-- The frame ---------------------------------------------------------------------------------------

-- | A fault of a word, or of the frame as a whole.
faultOf :: Int -> Reading -> (Content -> Bool) -> Reason -> RowFault
faultOf begin reading isIt why = case said isIt reading of
  Just s -> RowFault (at s) (Just (content (word s))) why
  Nothing -> RowFault begin Nothing why

-- | The frame that the words make.
frameOf :: Layout -> State -> Int -> Reading -> Either RowFault Frame
frameOf plan state begin reading = do
  mapM_ (numbered state) (said isFrameNumber reading)
  let moved = Pulses3 (distance X) (distance Y) (distance Z)
      Pulses3 i j _ = ModalState.signs axes * Pulses3 (spoken X) (spoken Y) 0
  m <- motionOf plan begin reading moved
  code <- speedOf plan state begin reading m
  pure
    Frame
      { motion = m,
        increment = moved,
        centre = Pulses2 i j,
        speed = FeedCode code,
        braking = braked reading,
        orders =
          if null (commands reading)
            then []
            else
              [ (o, v)
                | (o, zero) <- Layout.commands plan,
                  let vs = [v' | (o', v') <- commands reading, o' == o],
                  not (null vs),
                  let v = sum vs,
                  v /= 0 || zero
              ]
      }
  where
    axes = Layout.axes plan
    spoken a = maybe 0 (Pulses . number) (said (isCentre a) reading)
    distance a = case said (isAlong a) reading of
      Nothing -> 0
      Just s ->
        let n = ModalState.along a (ModalState.signs axes) * Pulses (number s)
         in case ModalState.measure axes of
              Increments -> n
              Positions -> n - ModalState.along a (place state)

-- | Frames are counted.
numbered :: State -> Said -> Either RowFault ()
numbered state s
  | n /= number s = Left (RowFault (at s) (Just FrameNumber) (WrongNumber (number s) n))
  | otherwise = Right ()
  where
    n = ordinal state `mod` 10 ^ digits (form (word s))

motionOf :: Layout -> Int -> Reading -> Pulses3 -> Either RowFault FrameMotion
motionOf plan begin reading moved = case Layout.motions plan of
  Nothing -> Right (if moved == 0 then Still else Straightway)
  Just (w, codes) -> case said isMotion reading of
    Nothing
      | moved == 0 -> Right Still
      | otherwise -> Left (RowFault begin Nothing MoveWithoutMotion)
    Just s
      | number s == straight codes ->
        if presence w == Always && moved == 0 then Right Still else moving s Straightway
      | Just (number s) == rapid codes -> moving s Rapid
      | Just (number s) == clockwise codes -> Right (Round (turned Clockwise CounterClockwise))
      | Just (number s) == counterClockwise codes ->
        Right (Round (turned CounterClockwise Clockwise))
      | otherwise -> wrong s (UnknownMotion (number s))
    where
      wrong s why = Left (RowFault (at s) (Just (content w)) why)
      moving s m = if moved == 0 then wrong s MotionWithoutMove else Right m
  where
    turned a b = if ModalState.mirrored (Layout.axes plan) then b else a

speedOf :: Layout -> State -> Int -> Reading -> FrameMotion -> Either RowFault Int
speedOf plan state begin reading m = case (said isFeed reading, m) of
  (Nothing, Still) -> Right 0
  (Nothing, Rapid) -> Right 0
  (Nothing, _) -> case feed state of
    Just (FeedCode n) | changing -> Right n
    _ -> wrong MoveWithoutSpeed
  (Just s, Still) -> if number s == 0 then Right 0 else wrong (SpeedWithoutMove (number s))
  (Just s, Rapid) -> if number s == 0 then Right 0 else wrong (SpeedWithoutMove (number s))
  (Just s, _)
    | changing && feed state == Just (FeedCode (number s)) -> wrong (SpeedRepeated (number s))
    | isJust (Machine.valueOf (Layout.machine plan) (FeedCode (number s))) -> Right (number s)
    | number s == 0 -> wrong MoveWithoutSpeed
    | otherwise -> wrong (UnknownSpeed (number s))
  where
    changing = Layout.keepsFeed plan
    wrong why = Left (faultOf begin reading isFeed why)

-- | The frame keeps the rules of frames.
lawful :: Layout -> Int -> Reading -> Frame -> Either RowFault ()
lawful plan begin reading f
  | not (Frame.isMoving f) && null (orders f) = Left (faultOf begin reading isFeed IdleFrame)
  | otherwise = case Frame.broken (Layout.machine plan) 1 f of
    [] -> Right ()
    rule : _ -> Left (blame rule (Rule rule))
  where
    blame rule = case rule of
      Frame.OverCapacity _ a _ -> faultOf begin reading (isAlong a)
      Frame.BadCentre _ -> faultOf begin reading (isCentre X)
      Frame.NoSuchSpeed _ _ -> faultOf begin reading isFeed
      Frame.NoSuchMotion _ -> faultOf begin reading isMotion
      Frame.NoSuchOrder _ o -> faultOf begin reading (== Command o)
      Frame.Idle _ -> faultOf begin reading isFeed

-- | Whether each word stands where it would be written for a frame, with its number in as many
-- digits: then the rows are those that would be written, where a word has nothing else that could
-- differ.
isSpelled :: Layout -> State -> Reading -> Frame -> Bool
isSpelled plan state reading f = Layout.isPlain plan && go (Layout.wordsFor plan f) (saids reading)
  where
    -- Both are in the order of the layout.
    go ws read' = case ws of
      [] -> null read'
      w : more -> case ModalState.number (Layout.axes plan) state f w of
        Nothing -> go more read'
        Just n -> case read' of
          s : others ->
            content (word s) == content w
              && n == number s
              && Layout.isCount (form w) (places s) (abs n)
              && go more others
          [] -> False

-- | Whether the rows of a frame are those that would be written for it.
isWritten :: Layout -> State -> ShortByteString -> Int -> Int -> Frame -> Bool
isWritten plan state rows begin end f = runIdentity (Layout.foldRows same plan state f begin) == end
  where
    -- Behind a row that is another one there is none.
    same k h _ _ = pure (if k >= 0 && k < end && Short.index rows k == h then k + 1 else -1)

-- | The rows of a frame are those that its marks are. A check digit that would be another one
-- follows from the other rows: they are blamed first.
written :: Layout -> ShortByteString -> Int -> Int -> [MarkedRow] -> Either RowFault ()
written plan rows begin end = go begin (Right ())
  where
    go k before marks = case marks of
      [] ->
        if k == end
          then before
          else Left (RowFault (min k (end - 1)) Nothing (Otherwise "the end of the frame"))
      m : more
        | k >= end ->
          Left
            ( RowFault
                (max begin (end - 1))
                (wordOf m)
                (Otherwise (RowMeaning.meaning (RowMeaning.row plan Nothing m)))
            )
        | Short.index rows k == holes m -> go (k + 1) before more
        | CheckSymbol _ <- sense m -> go (k + 1) (Left (fault k m)) more
        | otherwise -> Left (fault k m)
    fault k m = RowFault k (wordOf m) (difference plan (Short.index rows k) m)

-- | The word that a mark is of.
wordOf :: MarkedRow -> Maybe Content
wordOf m = case sense m of
  InWord c _ _ -> Just c
  Blank _ -> Nothing
  Opening _ -> Nothing
  Closing _ -> Nothing
  Constant _ -> Nothing
  Separator _ -> Nothing
  CheckSymbol _ -> Nothing

-- | Why a row is not the one that should stand there.
difference :: Layout -> Word8 -> MarkedRow -> Reason
difference plan w m = fromMaybe specific (NumberReader.blemish plan w)
  where
    table = Layout.symbols plan
    wanted = RowMeaning.meaning (RowMeaning.row plan Nothing m)
    specific = case sense m of
      InWord _ _ (Digit d _ _ hole)
        | Symbol.digitAt table w == Just d -> if hole then MarkerMissing else ServiceHole
      InWord _ n (Lead d) | Just found <- Symbol.digitAt table w, n /= 0 -> WrongPriority found d
      Blank _ -> NotBlank
      _ -> Otherwise wanted
