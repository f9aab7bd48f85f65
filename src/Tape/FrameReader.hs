{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | Reader of frames: makes a frame out of rows of the tape, by the same steps of a layout as the
-- writer.
--
-- A frame is a block of ISO 6983, and a layout gives its symbols and words in order. A hole in the
-- service track gives the digit in its row an extra meaning, such as a minus or a bit of a command.
-- In a layout with a check digit each symbol has a weight. The sum of the weights in a frame, the
-- check sum, has to be a multiple of a number given by the layout, the modulus.
--
-- 'readFrame' first tries "Tape.FrameReader.Fast", which reads only frames that have neither an arc
-- nor a command and turn no rotary axis. 'wordByWord' reads any frame: it reads the words and makes
-- a frame of them. Then it writes this frame again: a row that differs from the tape is a fault.
-- Indices of rows count from 0.
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
import Data.Containers.ListUtils (nubOrd)
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
    RotaryAxis (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Tape.Damage (Reason (..))
import Tape.FrameReader.Fast qualified as FastFrameReader
import Tape.FrameWriter qualified as FrameWriter
import Tape.Layout
  ( Address (..),
    LayoutStep (..),
    MarkedRow (..),
    PreparedLayout,
    RowKind (..),
    WordRow (..),
  )
import Tape.Layout qualified as Layout
import Tape.ModalState (State (..))
import Tape.ModalState qualified as ModalState
import Tape.NumberReader (RowFault (..), TapeNumber)
import Tape.NumberReader qualified as NumberReader
import Tape.RowMeaning qualified as RowMeaning
import Tape.Symbol (Symbol)
import Tape.Symbol qualified as Symbol

-- | Part of a frame that has been read so far.
data Reading = Reading
  { -- | the words in the order of the layout; no two of them have the same content
    readWords :: [ReadWord],
    -- | numbers of commands: one entry for each command word, and one for each hole in the service
    -- track that is a bit of a command. The entry of bit k has the number 2^k.
    commandNumbers :: [(Machine.CommandName, Int)],
    -- | true if a hole in the service track makes the control brake in this frame
    isBraking :: Bool,
    -- | sum of the weights of the symbols so far; stays 0 in a layout without a check digit
    total :: Int,
    -- | index of the check digit's row, and the modulus, of which @total@ has to be a multiple;
    -- 'Nothing' until the check digit is read
    check :: Maybe (Int, Int)
  }

-- | Word, the index of the row where its number begins, the number, and the count of the number's
-- digits, decimals included.
data ReadWord = ReadWord {word :: Word', at :: Int, number :: Int, places :: Int}

-- | First word of a frame whose content satisfies @isContent@.
wordWith :: (Content -> Bool) -> Reading -> Maybe ReadWord
wordWith isContent reading = find (isContent . content . word) (readWords reading)

isFrameNumber, isMotion, isFeed :: Content -> Bool
isFrameNumber c = case c of FrameNumber -> True; _ -> False
isMotion c = case c of Motion _ -> True; _ -> False
isFeed c = case c of FeedWord -> True; _ -> False

isAlong, isCentre :: Axis -> Content -> Bool
isAlong a c = case c of Along b -> a == b; _ -> False
isCentre a c = case c of Centre b -> a == b; _ -> False

isAbout :: RotaryAxis -> Content -> Bool
isAbout a c = case c of About b -> a == b; _ -> False

-- | Reads the frame that begins at row @begin@; @state@ is the modal state before the frame. Gives
-- the frame and the index of the row after it, or the first fault.
readFrame :: PreparedLayout -> State -> ShortByteString -> Int -> Either RowFault (Frame, Int)
readFrame layout state rows begin = case FastFrameReader.readFrame layout state rows begin of
  FastFrameReader.Read f end -> Right (f, end)
  FastFrameReader.NotSimple -> wordByWord layout state rows begin

-- | Reads the frame that begins at row @begin@ word by word, without "Tape.FrameReader.Fast".
-- @state@ is the modal state before the frame. Gives the frame and the index of the row after it,
-- or the first fault.
wordByWord :: PreparedLayout -> State -> ShortByteString -> Int -> Either RowFault (Frame, Int)
wordByWord layout state rows begin = do
  (reading, end) <- readSteps layout rows begin
  case check reading of
    Just (k, modulus)
      | total reading `mod` max 1 modulus /= 0 ->
        Left (RowFault k Nothing (WrongSum (total reading) modulus))
    _ -> Right ()
  f <- frameOf layout state begin reading
  checkRules layout begin reading f
  if not (hasSameWords layout state reading f || hasSameRows layout state rows begin end f)
    then compareRows layout rows begin end (FrameWriter.frameRows layout state f)
    else Right ()
  Right (f, end)

-- Reading the words -------------------------------------------------------------------------------

-- | Reads the words of a frame; the last argument is the index of the frame's first row. Gives the
-- words and the index of the row after the frame.
readSteps :: PreparedLayout -> ShortByteString -> Int -> Either RowFault (Reading, Int)
readSteps layout rows = go False (Layout.steps layout) [] (Reading [] [] False 0 Nothing)
  where
    -- @done@ has the words that have been read so far, the last one first. @now@ has everything
    -- else. So @now@ is not copied for every word.
    go followsWord todo done !now !k = case skipAbsent layout rows followsWord todo k of
      [] -> Right (now {readWords = reverse done}, k)
      FixedStep cs : more
        | next >= 0 -> go False more done (withSymbols layout cs now) next
        | otherwise -> Left (mismatch layout Nothing rows k cs)
        where
          next = Symbol.rowAfter rows k cs
      CheckStep modulus : more -> do
        d <- NumberReader.digit layout Nothing rows k
        go False more done (withCheckDigit layout k modulus d now) (k + 1)
      WordStep w cs joined : more
        | isPresent layout rows w prefix begin -> do
          n <- NumberReader.numeral layout (content w) (form w) rows begin
          let now' = withNumber layout w n (withSymbols layout (spelling prefix) now)
          go True more (readWordOf w n : done) now' (NumberReader.next n)
        | otherwise -> Left (mismatch layout (Just (content w)) rows k (spelling prefix))
        where
          prefix = if followsWord then joined else cs
          begin = Layout.rowAfterAddress rows k prefix

readWordOf :: Word' -> TapeNumber -> ReadWord
readWordOf w n =
  ReadWord
    { word = w,
      at = NumberReader.start n,
      number = NumberReader.value n,
      places = NumberReader.places n
    }

-- | True if the frame contains the word @w@ at the row to be read. @begin@ is the index of the row
-- after the address @cs@ of the word, or −1 if the rows to be read are not this address. An
-- optional word without an address is present if a number of its form can begin at row @begin@.
isPresent :: PreparedLayout -> ShortByteString -> Word' -> Address -> Int -> Bool
isPresent layout rows w cs begin =
  begin >= 0
    && ( extent cs > 0
           || presence w == Always
           || NumberReader.canBegin layout (form w) rows begin
       )

-- | Drops the optional words at the head of the steps @todo@ that are not present at row @k@.
-- @followsWord@ is true if a word comes directly before row @k@.
skipAbsent :: PreparedLayout -> ShortByteString -> Bool -> [LayoutStep] -> Int -> [LayoutStep]
skipAbsent layout rows followsWord todo k = case todo of
  WordStep w cs joined : more
    | presence w /= Always
        && not
          ( isPresent
              layout
              rows
              w
              cs
              (Layout.rowAfterAddress rows k (if followsWord then joined else cs))
          ) ->
      skipAbsent layout rows followsWord more k
  _ -> todo

-- | Adds the weights of the symbols @cs@ to the check sum.
withSymbols :: PreparedLayout -> [Symbol] -> Reading -> Reading
withSymbols layout cs now
  | Layout.hasCheckDigit layout =
    now {total = foldl' (\n c -> n + Symbol.weight c) (total now) cs}
  | otherwise = now

-- | Adds the weight of the check digit @d@ to the check sum. Notes the digit's row @k@ and the
-- number @modulus@, of which the sum has to be a multiple.
withCheckDigit :: PreparedLayout -> Int -> Int -> Int -> Reading -> Reading
withCheckDigit layout k modulus d now =
  now
    { total = total now + Symbol.digitWeight (Layout.symbols layout) d,
      check = Just (k, modulus)
    }

-- | Adds the number @n@ of the word @w@ to a reading: the weights of its symbols, and the meaning
-- of its holes in the service track. If @w@ is the word of a command, it also adds the command.
withNumber :: PreparedLayout -> Word' -> TapeNumber -> Reading -> Reading
withNumber layout w n now = case content w of
  Command o -> counted {commandNumbers = (o, NumberReader.value n) : commandNumbers counted}
  _ -> counted
  where
    counted
      | null (NumberReader.bits n)
          && not (NumberReader.brakes n)
          && not (Layout.hasCheckDigit layout) =
        now
      | otherwise =
        now
          { commandNumbers = NumberReader.bits n <> commandNumbers now,
            isBraking = isBraking now || NumberReader.brakes n,
            total = total now + NumberReader.total n
          }

-- | Compares the rows from @k@ on with the symbols @cs@. Gives the index of the row after the
-- symbols, or the fault of the first row that differs.
expect :: PreparedLayout -> ShortByteString -> Int -> [Symbol] -> Either RowFault Int
expect layout rows k cs =
  let next = Symbol.rowAfter rows k cs
   in if next >= 0 then Right next else Left (mismatch layout Nothing rows k cs)

-- | Fault of the first row from @k@ on that differs from the symbols @cs@. @c@ is the content of
-- the word to which the rows belong, 'Nothing' outside of words. If no row differs, the fault is
-- that the row after the symbols is not blank.
mismatch :: PreparedLayout -> Maybe Content -> ShortByteString -> Int -> [Symbol] -> RowFault
mismatch layout c rows k cs = case cs of
  [] -> RowFault k c NotBlank
  s : more
    | k >= Short.length rows -> RowFault (Short.length rows - 1) c CutOff
    | Short.index rows k == Symbol.holes s -> mismatch layout c rows (k + 1) more
    | otherwise -> RowFault k c (insteadOf layout (Short.index rows k) s)

-- | Reason why a row with the holes @w@ is not the symbol @s@.
insteadOf :: PreparedLayout -> Word8 -> Symbol -> Reason
insteadOf layout w s = case NumberReader.rowFault layout w of
  Just why -> why
  Nothing -> case Symbol.symbolAt (Layout.symbols layout) w of
    _ | w == 0 -> Missing (Symbol.name s)
    Nothing ->
      if Symbol.holes s == 0
        then NotBlank
        else NoSymbol (Machine.tracks (Machine.medium (Layout.machine layout))) w
    Just c
      | or [Symbol.name a == c | WordStep _ Address {spelling = a : _} _ <- Layout.steps layout] ->
        UnexpectedWord c
      | otherwise -> Unexpected c (Symbol.name s)

-- The frame ---------------------------------------------------------------------------------------

-- | Fault with the reason @why@ at the first word whose content satisfies @isContent@. If the frame
-- has no such word, the fault is at the frame's first row @begin@.
faultOf :: Int -> Reading -> (Content -> Bool) -> Reason -> RowFault
faultOf begin reading isContent why = case wordWith isContent reading of
  Just s -> RowFault (at s) (Just (content (word s))) why
  Nothing -> RowFault begin Nothing why

-- | Makes the frame that the words of a reading describe. @state@ is the state before the frame;
-- @begin@ is the frame's first row, for faults.
frameOf :: PreparedLayout -> State -> Int -> Reading -> Either RowFault Frame
frameOf layout state begin reading = do
  mapM_ (checkFrameNumber state) (wordWith isFrameNumber reading)
  let increment = Pulses3 (distance X) (distance Y) (distance Z)
      turn = Pulses2 (rotationAbout A) (rotationAbout B)
      Pulses3 i j _ = ModalState.signs axes * Pulses3 (centreNumber X) (centreNumber Y) 0
  m <- motionOf layout begin reading (increment == 0 && turn == 0)
  code <- feedCodeOf layout state begin reading m
  pure
    Frame
      { motion = m,
        increment,
        turn,
        centre = Pulses2 i j,
        feedCode = FeedCode code,
        braking = isBraking reading,
        commands = commandsOf layout reading
      }
  where
    axes = Layout.axes layout
    centreNumber a = maybe 0 (Pulses . number) (wordWith (isCentre a) reading)
    distance a = case wordWith (isAlong a) reading of
      Nothing -> 0
      Just s ->
        let n = ModalState.along a (ModalState.signs axes) * Pulses (number s)
         in case ModalState.measure axes of
              Increments -> n
              Positions -> n - ModalState.along a (position state)
    rotationAbout a = case wordWith (isAbout a) reading of
      Nothing -> 0
      Just s ->
        let n = ModalState.about a (ModalState.turnSigns axes) * Pulses (number s)
         in case ModalState.measure axes of
              Increments -> n
              Positions -> n - ModalState.about a (rotation state)

-- | Commands of a frame in the order of the layout, each with its number. The number of a command
-- that is written in bits is the sum of their values, each bit once. If a bit has holes at several
-- digits and only some of them are punched, the frame that is written again differs. A command
-- with the number 0 is left out if 0 means that the frame has no such command, see
-- 'ModalState.isZeroCommand'.
commandsOf :: PreparedLayout -> Reading -> [(Machine.CommandName, Int)]
commandsOf layout reading
  | null (commandNumbers reading) = []
  | otherwise =
    [ (o, v)
      | (o, isZeroCommand) <- Layout.commandWords layout,
        let vs = [v' | (o', v') <- commandNumbers reading, o' == o],
        not (null vs),
        let v = sum (nubOrd vs),
        v /= 0 || isZeroCommand
    ]

-- | Compares the number in the word @s@ with the number of the frame, which the state gives. The
-- word has only the last digits of a large number.
checkFrameNumber :: State -> ReadWord -> Either RowFault ()
checkFrameNumber state s
  | n /= number s = Left (RowFault (at s) (Just FrameNumber) (WrongNumber (number s) n))
  | otherwise = Right ()
  where
    n = ordinal state `mod` 10 ^ digits (form (word s))

-- | Motion of a frame. @isStill@ is true if its words move no axis.
motionOf :: PreparedLayout -> Int -> Reading -> Bool -> Either RowFault FrameMotion
motionOf layout begin reading isStill = case Layout.motionWord layout of
  Nothing -> Right (if isStill then NoMotion else Linear)
  Just (w, codes) -> case wordWith isMotion reading of
    Nothing
      | isStill -> Right NoMotion
      | otherwise -> Left (RowFault begin Nothing IncrementWithoutMotion)
    Just s
      | number s == straight codes ->
        if presence w == Always && isStill then Right NoMotion else moving s Linear
      | Just (number s) == rapid codes -> moving s Rapid
      | Just (number s) == clockwise codes ->
        Right (Circular (onMachine Clockwise CounterClockwise))
      | Just (number s) == counterClockwise codes ->
        Right (Circular (onMachine CounterClockwise Clockwise))
      | otherwise -> wrong s (UnknownMotion (number s))
    where
      wrong s why = Left (RowFault (at s) (Just (content w)) why)
      moving s m = if isStill then wrong s MotionWithoutIncrement else Right m
  where
    onMachine sense opposite =
      if ModalState.isMirrored (Layout.axes layout) then opposite else sense

feedCodeOf :: PreparedLayout -> State -> Int -> Reading -> FrameMotion -> Either RowFault Int
feedCodeOf layout state begin reading m = case (wordWith isFeed reading, m) of
  (Nothing, NoMotion) -> Right 0
  (Nothing, Rapid) -> Right 0
  (Nothing, _) -> case feed state of
    Just (FeedCode n) | isModal -> Right n
    _ -> wrong MotionWithoutFeed
  (Just s, NoMotion) -> if number s == 0 then Right 0 else wrong (FeedWithoutMotion (number s))
  (Just s, Rapid) -> if number s == 0 then Right 0 else wrong (FeedWithoutMotion (number s))
  (Just s, _)
    | isModal && feed state == Just (FeedCode (number s)) -> wrong (FeedRepeated (number s))
    | isJust (Machine.valueOf (Layout.machine layout) (FeedCode (number s))) -> Right (number s)
    | number s == 0 -> wrong MotionWithoutFeed
    | otherwise -> wrong (UnknownFeedCode (number s))
  where
    isModal = Layout.isFeedModal layout
    wrong why = Left (faultOf begin reading isFeed why)

-- | Checks that a frame moves or has a command, and that it keeps the rules of the machine, see
-- 'Frame.frameViolations'. @begin@ is the frame's first row, for faults.
checkRules :: PreparedLayout -> Int -> Reading -> Frame -> Either RowFault ()
checkRules layout begin reading f
  | not (Frame.isMoving f) && null (commands f) = Left (faultOf begin reading isFeed NoContent)
  | otherwise = case Frame.frameViolations (Layout.machine layout) 1 f of
    [] -> Right ()
    rule : _ -> Left (faultOf begin reading (blamed rule) (BrokenRule rule))
  where
    blamed rule = case rule of
      Frame.OverCapacity _ a _ -> isAlong a
      Frame.TurnOverCapacity _ a _ -> isAbout a
      Frame.BadCentre _ -> isCentre X
      Frame.NoSuchFeedCode _ _ -> isFeed
      Frame.NoSuchMotion _ -> isMotion
      Frame.UnknownCommand _ o -> (== Command o)
      Frame.EmptyFrame _ -> isFeed

-- Comparison with the frame as it would be written ------------------------------------------------

-- | True if the layout is plain ('Layout.isPlain'), and the machine would write the frame @f@ with
-- exactly the words that were read: the same numbers with the same counts of digits. Then the
-- machine would also write the rows that were read, so the rows need no comparison.
hasSameWords :: PreparedLayout -> State -> Reading -> Frame -> Bool
hasSameWords layout state reading f =
  Layout.isPlain layout && go (Layout.wordsFor layout f) (readWords reading)
  where
    -- Both lists are in the order of the layout.
    go ws found = case ws of
      [] -> null found
      w : more -> case ModalState.number (Layout.axes layout) state f w of
        Nothing -> go more found
        Just n -> case found of
          s : others ->
            content (word s) == content w
              && n == number s
              && Layout.isDigitCount (form w) (places s) (abs n)
              && go more others
          [] -> False

-- | True if the rows from @begin@ up to @end@, excluded, are those that the machine would write for
-- the frame @f@.
hasSameRows :: PreparedLayout -> State -> ShortByteString -> Int -> Int -> Frame -> Bool
hasSameRows layout state rows begin end f =
  runIdentity (FrameWriter.foldRows same layout state f begin) == end
  where
    -- The index @k@ becomes −1 at the first row that differs, and then stays −1.
    same k h _ _ = pure (if k >= 0 && k < end && Short.index rows k == h then k + 1 else -1)

-- | Compares the rows from @begin@ up to @end@, excluded, with the last argument, the rows that the
-- machine would write. Gives the fault of the first row that differs. A wrong check digit is
-- reported only if no other row is wrong, because other wrong rows make the check digit wrong too.
compareRows :: PreparedLayout -> ShortByteString -> Int -> Int -> [MarkedRow] -> Either RowFault ()
compareRows layout rows begin end = go begin (Right ())
  where
    go k before expected = case expected of
      [] ->
        if k == end
          then before
          else Left (RowFault (min k (end - 1)) Nothing (WrittenOtherwise "the end of the frame"))
      m : more
        | k >= end ->
          Left (RowFault (max begin (end - 1)) (wordOf m) (WrittenOtherwise (meaningOf m)))
        | Short.index rows k == holes m -> go (k + 1) before more
        | CheckSymbol _ <- kind m -> go (k + 1) (Left (fault k m)) more
        | otherwise -> Left (fault k m)
    fault k m = RowFault k (wordOf m) (difference layout (Short.index rows k) m)
    meaningOf m = RowMeaning.meaning (RowMeaning.row layout Nothing m)

-- | Content of the word that a row belongs to; 'Nothing' for a row outside of words.
wordOf :: MarkedRow -> Maybe Content
wordOf m = case kind m of
  InWord c _ _ -> Just c
  Blank _ -> Nothing
  Opening _ -> Nothing
  Closing _ -> Nothing
  Constant _ -> Nothing
  Separator _ -> Nothing
  CheckSymbol _ -> Nothing

-- | Reason why a row with the holes @w@ is not the expected row @m@.
difference :: PreparedLayout -> Word8 -> MarkedRow -> Reason
difference layout w m = fromMaybe specific (NumberReader.rowFault layout w)
  where
    table = Layout.symbols layout
    specific = case kind m of
      InWord _ _ (Digit d _ _ isPunched)
        | Symbol.digitAt table w == Just d -> if isPunched then MarkerMissing else ServiceHole
      InWord _ n (PriorityDigit d)
        | Just found <- Symbol.digitAt table w, n /= 0 -> WrongPriority found d
      Blank _ -> NotBlank
      _ -> WrittenOtherwise (RowMeaning.meaning (RowMeaning.row layout Nothing m))
