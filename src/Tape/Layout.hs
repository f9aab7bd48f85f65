{-# OPTIONS_GHC -O2 #-}

-- | Layout of a machine's frames, prepared for writing and reading.
--
-- "Tape.FrameWriter" and "Tape.FrameReader" follow the same steps of this layout. A simple frame
-- has neither an arc nor a command, and turns no rotary axis. Most frames are simple, so the layout
-- has a shorter list of steps and words for them.
--
-- A word is an address, which may be empty, and a number. A hole in the service track gives the
-- digit in its row an extra meaning ('Service'). In a layout with a check digit each symbol has a
-- weight. The sum of the weights in a frame is its check sum.
--
-- The module also owns the type of a row with its meaning, and the count of digits with which a
-- number is written. Indices of rows count from 0.
module Tape.Layout
  ( -- * The layout
    PreparedLayout (..),
    LayoutStep (..),
    Address (..),
    fromMachine,
    rowAfterAddress,
    wordsFor,
    after,

    -- * Rows with their meaning
    MarkedRow (..),
    RowKind (..),
    WordRow (..),
    BlankRows (..),
    blanks,
    constant,

    -- * Digits
    mostDigits,
    power,
    digitCount,
    isDigitCount,
  )
where

import Data.ByteString.Short (ShortByteString)
import Data.ByteString.Short qualified as Short
import Data.List (foldl', nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as Primitive
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame (Frame)
import Machine.Machine
  ( CommandName (..),
    Content (..),
    LayoutItem (..),
    Machine,
    MotionCodes,
    NumberForm (..),
    Presence (..),
    Service (..),
    Sign (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Tape.ModalState (Axes, State (..))
import Tape.ModalState qualified as ModalState
import Tape.Symbol (Symbol, Symbols)
import Tape.Symbol qualified as Symbol

-- | Layout of a machine's frames, with all facts that are the same for every frame.
data PreparedLayout = PreparedLayout
  { machine :: Machine,
    symbols :: Symbols,
    axes :: Axes,
    steps :: [LayoutStep],
    -- | the steps of a simple frame: 'steps' without the words of 'frameWords' that are not in
    -- 'simpleWords'
    simpleSteps :: [LayoutStep],
    -- | symbols between two words
    separator :: [Symbol],
    minus :: Symbol,
    plus :: Symbol,
    -- | decimal point
    point :: Symbol,
    -- | all words in their order on the tape
    frameWords :: [Word'],
    -- | the words that can occur in a simple frame. They include words of arcs, commands and rotary
    -- axes that every frame, or every frame that moves, contains; see 'ModalState.occursInSimple'.
    simpleWords :: [Word'],
    -- | contents of the words of axes, linear and rotary, in the order of the words
    axisOrder :: [Content],
    -- | commands in the order of their words and bits. The flag is true if the number 0 gives the
    -- command, and false if 0 means that the frame lacks the command.
    commandWords :: [(CommandName, Bool)],
    -- | word that says how the cutter moves, with its codes; 'Nothing' if frames have no such word
    motionWord :: Maybe (Word', MotionCodes),
    -- | true if the feed code is modal: it stays in force until another one is written
    isFeedModal :: Bool,
    -- | true if frames have a check digit
    hasCheckDigit :: Bool,
    -- | True in a plain layout: two frames with the same words (the same numbers with the same
    -- counts of digits) have the same rows. Then the readers compare words, which is faster than
    -- comparing rows. A layout with a check digit is not plain. A layout in which a frame may end
    -- with a word that simple frames never have is not plain either.
    isPlain :: Bool
  }

-- | Step of writing or reading a frame.
data LayoutStep
  = -- | symbols that every frame contains
    FixedStep [Symbol]
  | -- | A word with two forms of its address. The first is used where no word comes before; the
    -- second is used after another word and begins with the separator.
    WordStep Word' Address Address
  | -- | a check digit, with the modulus: the check sum has to be a multiple of it
    CheckStep Int

-- | Symbols before the number of a word, the count of these symbols, and the holes of the last
-- symbol (0 if there is none). The reader compares the last symbol first, because most addresses
-- differ there.
data Address = Address {spelling :: [Symbol], extent :: Int, lastHoles :: Word8}

-- | Compares the rows from index @k@ on with an address. Gives the index of the row after the
-- address, which is @k@ for an empty address, or −1 if a row differs or the rows end.
rowAfterAddress :: ShortByteString -> Int -> Address -> Int
rowAfterAddress rows k Address {spelling, extent, lastHoles}
  | extent == 0 = k
  | k + extent <= Short.length rows && Short.index rows (k + extent - 1) == lastHoles =
    Symbol.rowAfter rows k spelling
  | otherwise = -1
{-# INLINE rowAfterAddress #-}

-- | Prepared layout of a machine.
fromMachine :: Machine -> PreparedLayout
fromMachine machine =
  PreparedLayout
    { machine,
      symbols,
      axes = ModalState.axes machine,
      steps,
      simpleSteps = filter isSimpleStep steps,
      separator,
      minus = Symbol.symbol symbols '-',
      plus = Symbol.symbol symbols '+',
      point = Symbol.symbol symbols '.',
      frameWords,
      simpleWords = filter ModalState.occursInSimple frameWords,
      axisOrder = filter isOfAxis (map content frameWords),
      commandWords = nub (concatMap commandsOf frameWords),
      motionWord = listToMaybe [(w, codes) | w <- frameWords, Motion codes <- [content w]],
      isFeedModal = or [presence w == WhenChanged | w <- frameWords, content w == FeedWord],
      hasCheckDigit,
      isPlain = not hasCheckDigit && endsSurely && all (isPlainForm . form) frameWords
    }
  where
    symbols = Symbol.fromMachine machine
    separator = symbolsOf symbols (Machine.separator (Machine.layout machine))
    items = NonEmpty.toList (Machine.items (Machine.layout machine))
    steps = map (stepOf symbols separator) items
    frameWords = Machine.wordsOf machine
    hasCheckDigit = not (null [() | CheckStep _ <- steps])
    -- Looks at the words after the last step that gives rows in every frame. True if all of them
    -- can occur in a simple frame. A reader that follows 'simpleSteps' would not notice any other
    -- word at the end of a frame, and would take the frame for complete.
    endsSurely = all isSimpleStep (takeWhile (not . isAlwaysWritten) (reverse steps))

-- | True for the content of an axis's word.
isOfAxis :: Content -> Bool
isOfAxis c = case c of
  Along _ -> True
  About _ -> True
  FrameNumber -> False
  Motion _ -> False
  Centre _ -> False
  FeedWord -> False
  Command _ -> False

symbolsOf :: Symbols -> Text -> [Symbol]
symbolsOf symbols = map (Symbol.symbol symbols) . Text.unpack

-- | Step for an item of the layout; @separator@ has the symbols that come between two words.
stepOf :: Symbols -> [Symbol] -> LayoutItem -> LayoutStep
stepOf symbols separator item = case item of
  Literal t -> FixedStep (symbolsOf symbols t)
  AWord w ->
    let cs = symbolsOf symbols (address w)
     in WordStep w (addressOf cs) (addressOf (separator <> cs))
  CheckDigit m -> CheckStep m

addressOf :: [Symbol] -> Address
addressOf cs =
  Address
    { spelling = cs,
      extent = length cs,
      lastHoles = foldl' (\_ c -> Symbol.holes c) 0 cs
    }

-- | True for a step that can occur in a simple frame.
isSimpleStep :: LayoutStep -> Bool
isSimpleStep step = case step of
  FixedStep _ -> True
  WordStep w _ _ -> ModalState.occursInSimple w
  CheckStep _ -> True

-- | True for a step that gives at least one row in every frame.
isAlwaysWritten :: LayoutStep -> Bool
isAlwaysWritten step = case step of
  FixedStep cs -> not (null cs)
  WordStep w _ _ -> presence w == Always
  CheckStep _ -> True

-- | Commands that a word can give, by its number or by bits in its service track. The flag is true
-- if the number 0 gives the command, and false if 0 means that the frame lacks the command.
commandsOf :: Word' -> [(CommandName, Bool)]
commandsOf w =
  [(o, ModalState.isZeroCommand w) | Command o <- [content w]]
    <> [(o, False) | CommandBit o _ <- service (form w)]

-- | True for a form in which the number and its count of digits determine the rows. Such a form has
-- no sign or other hole in the service track, no priority digit, and fewer digits than
-- 'mostDigits'.
isPlainForm :: NumberForm -> Bool
isPlainForm f = null (service f) && digits f < mostDigits && isPlainSign (sign f)
  where
    isPlainSign s = case s of
      Unsigned -> True
      ServiceSign -> False
      MinusSign -> True
      EitherSign -> True
      Priority {} -> False

-- | Words that a frame can contain: 'simpleWords' for a simple frame, 'frameWords' for any other.
wordsFor :: PreparedLayout -> Frame -> [Word']
wordsFor layout frame =
  if ModalState.isSimple frame then simpleWords layout else frameWords layout

-- | Modal state after a frame, from the state before it.
after :: PreparedLayout -> State -> Frame -> State
after layout = ModalState.after (axes layout) (frameWords layout)

-- Rows with their meaning -------------------------------------------------------------------------

-- | Row with its weight in the check sum and its meaning.
data MarkedRow = MarkedRow {holes :: Word8, weight :: Int, kind :: RowKind}
  deriving stock (Eq, Show)

-- | Meaning of a row.
data RowKind
  = Blank BlankRows
  | -- | symbol between the leader and the first frame
    Opening Char
  | -- | symbol between the last frame and the trailer
    Closing Char
  | -- | symbol that every frame contains
    Constant Char
  | -- | symbol between two words
    Separator Char
  | -- | check digit, 0 to 9
    CheckSymbol Int
  | -- | row of a word: the content of the word, the number of the word, and the meaning of the row
    -- within the word
    InWord Content Int WordRow
  deriving stock (Eq, Show)

-- | Meaning of a blank row: its position on the tape.
data BlankRows
  = -- | before the first frame
    Leader
  | -- | after a frame
    Gap
  | -- | before a frame with an even number, see 'Machine.Machine.evenShift'
    Shift
  | -- | after the last frame
    Trailer
  deriving stock (Eq, Show)

-- | Meaning of a row within a word.
data WordRow
  = AddressSymbol Char
  | -- | digit, 0 to 9, that gives the direction of an axis and says if the axis is the one with the
    -- most pulses, see 'Machine.Machine.Priority'
    PriorityDigit Int
  | -- | plus or minus
    SignSymbol Char
  | -- | decimal point
    Point
  | -- | a digit: its value; its position, from 0 at the last digit, decimals included; the meaning
    -- of a hole in the service track of the row; true if the row has this hole
    Digit Int Int Service Bool
  deriving stock (Eq, Show)

-- | Blank rows, @n@ of them, that all have the meaning @purpose@.
blanks :: BlankRows -> Int -> [MarkedRow]
blanks purpose n = replicate n (MarkedRow 0 0 (Blank purpose))

-- | Row of a symbol. The 'kind' of the row is @meaning@ applied to the name of the symbol.
constant :: (Char -> RowKind) -> Symbol -> MarkedRow
constant meaning (Symbol.Symbol c h n) = MarkedRow h n (meaning c)

-- Digits ------------------------------------------------------------------------------------------

-- | Count of digits of the largest 'Int'. No number on a tape has more digits.
mostDigits :: Int
mostDigits = 19

-- | 10^@k@ for @k@ ≥ 0; 'maxBound' from @k@ = 19 on, where an 'Int' is too small.
power :: Int -> Int
power k = if k < mostDigits then Primitive.indexPrimArray powers k else maxBound

powers :: PrimArray Int
powers = Primitive.primArrayFromList (take mostDigits (iterate (10 *) 1))

-- | Count of digits with which a number @n@ ≥ 0 is written in the form @f@, decimals included.
digitCount :: NumberForm -> Int -> Int
digitCount f n
  | padded f = digits f
  | otherwise = go (leastDigits f)
  where
    go k = if k < mostDigits && power k <= n && n > 0 then go (k + 1) else k

-- | True if a number @n@ ≥ 0 is written with @count@ digits, that is @digitCount f n == count@. It
-- is cheaper than 'digitCount', but the caller must make sure that the number is below 10^count.
isDigitCount :: NumberForm -> Int -> Int -> Bool
isDigitCount f count n
  | padded f = count == digits f
  | otherwise = count == least || count > least && n >= power (count - 1)
  where
    least = leastDigits f

-- | Least count of digits in a form without padding: all decimals, and one digit before the point
-- if the form has such digits.
leastDigits :: NumberForm -> Int
leastDigits f = min (digits f) (if decimals f > 0 then decimals f + 1 else 1)
