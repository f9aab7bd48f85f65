{-# OPTIONS_GHC -O2 #-}

-- | Layout of a machine's frames, prepared for writing and reading.
--
-- One description of a frame serves both directions: "Tape.FrameWriter" and "Tape.FrameReader"
-- follow the same steps. The module also owns the rows of a tape with their meaning, and the number
-- of digits that a number has in its form.
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
  ( Axis (..),
    CommandName (..),
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

-- | Layout of a machine, with everything that is the same for all of its frames.
data PreparedLayout = PreparedLayout
  { machine :: Machine,
    symbols :: Symbols,
    axes :: Axes,
    steps :: [LayoutStep],
    -- | steps of a simple frame (see 'ModalState.isSimple'), which has few of the words
    simpleSteps :: [LayoutStep],
    -- | symbols between two words
    separator :: [Symbol],
    minus :: Symbol,
    plus :: Symbol,
    point :: Symbol,
    frameWords :: [Word'],
    -- | words that can occur in a simple frame
    simpleWords :: [Word'],
    -- | axes in the order of their words
    axisOrder :: [Axis],
    -- | commands in the order of their words and bits, and whether 0 is a command of its own
    commandWords :: [(CommandName, Bool)],
    -- | word of the motion with its codes, if there is one
    motionWord :: Maybe (Word', MotionCodes),
    -- | the feed code is modal: it holds until it is written anew
    isFeedModal :: Bool,
    -- | frames have a check digit
    hasCheckDigit :: Bool,
    -- | frames can be compared word by word in place of row by row: words differ only in a number
    -- and its count of digits, and the last rows of a frame belong to a word of simple frames or
    -- are always written
    isPlain :: Bool
  }

-- | Step of writing or reading a frame.
data LayoutStep
  = -- | symbols that are always the same
    FixedStep [Symbol]
  | -- | a word, its address, and the address with the separator before it
    WordStep Word' Address Address
  | -- | a check digit, and the number of which the check sum has to be a multiple
    CheckStep Int

-- | Symbols before a number, their count, and the row of the last one. Most addresses differ in
-- their last row, so that is compared first.
data Address = Address {spelling :: [Symbol], extent :: Int, lastHoles :: Word8}

-- | Index of the row after an address, if its rows are those from index @k@ on; else −1.
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
      axisOrder = [a | w <- frameWords, Along a <- [content w]],
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
    -- Steps after the last one that is always written.
    endsSurely = all isSimpleStep (takeWhile (not . isAlwaysWritten) (reverse steps))

symbolsOf :: Symbols -> Text -> [Symbol]
symbolsOf symbols = map (Symbol.symbol symbols) . Text.unpack

-- | Step for an item of the layout; the separator is given.
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
isSimpleStep resolution = case resolution of
  FixedStep _ -> True
  WordStep w _ _ -> ModalState.occursInSimple w
  CheckStep _ -> True

-- | True for a step that gives at least one row in every frame.
isAlwaysWritten :: LayoutStep -> Bool
isAlwaysWritten resolution = case resolution of
  FixedStep cs -> not (null cs)
  WordStep w _ _ -> presence w == Always
  CheckStep _ -> True

-- | Commands that a word holds, and whether 0 is a command of its own in it.
commandsOf :: Word' -> [(CommandName, Bool)]
commandsOf w =
  [(o, ModalState.isZeroCommand w) | Command o <- [content w]]
    <> [(o, False) | CommandBit o _ <- service (form w)]

-- | True for a form whose rows hold nothing but the number.
isPlainForm :: NumberForm -> Bool
isPlainForm f = null (service f) && digits f < mostDigits && isPlainSign (sign f)
  where
    isPlainSign s = case s of
      Unsigned -> True
      ServiceSign -> False
      MinusSign -> True
      EitherSign -> True
      Priority {} -> False

-- | Words that can occur in a frame.
wordsFor :: PreparedLayout -> Frame -> [Word']
wordsFor layout frame =
  if ModalState.isSimple frame then simpleWords layout else frameWords layout

-- | State after a frame.
after :: PreparedLayout -> State -> Frame -> State
after layout = ModalState.after (axes layout) (frameWords layout)

-- Rows with their meaning -------------------------------------------------------------------------

-- | Row with its weight in the check sum and its meaning.
data MarkedRow = MarkedRow {holes :: Word8, weight :: Int, kind :: RowKind}
  deriving stock (Eq, Show)

-- | Purpose of a row.
data RowKind
  = Blank BlankRows
  | -- | symbol before the first frame
    Opening Char
  | -- | symbol after the last frame
    Closing Char
  | -- | symbol that every frame has
    Constant Char
  | Separator Char
  | CheckSymbol Int
  | -- | row of a word with its number
    InWord Content Int WordRow
  deriving stock (Eq, Show)

-- | Purpose of a blank row: before the first frame, after a frame, before an even frame, after the
-- last frame.
data BlankRows = Leader | Gap | Shift | Trailer
  deriving stock (Eq, Show)

-- | Purpose of a row within a word.
data WordRow
  = AddressSymbol Char
  | -- | digit for the direction, and for the leading axis
    PriorityDigit Int
  | SignSymbol Char
  | Point
  | -- | digit, its place from 0 for the lowest, the use of the service track there, and True for a
    -- hole in it
    Digit Int Int Service Bool
  deriving stock (Eq, Show)

-- | Blank rows.
blanks :: BlankRows -> Int -> [MarkedRow]
blanks purpose n = replicate n (MarkedRow 0 0 (Blank purpose))

-- | Row of a symbol.
constant :: (Char -> RowKind) -> Symbol -> MarkedRow
constant meaning (Symbol.Symbol c h n) = MarkedRow h n (meaning c)

-- Digits ------------------------------------------------------------------------------------------

-- | Largest number of digits that a number can have.
mostDigits :: Int
mostDigits = 19

-- | Power of ten; 'maxBound' from 10^19 on, which no number reaches.
power :: Int -> Int
power k = if k < mostDigits then Primitive.indexPrimArray powers k else maxBound

powers :: PrimArray Int
powers = Primitive.primArrayFromList (take mostDigits (iterate (10 *) 1))

-- | Number of digits of a non-negative number in a form.
digitCount :: NumberForm -> Int -> Int
digitCount f n
  | padded f = digits f
  | otherwise = go (leastDigits f)
  where
    go k = if k < mostDigits && power k <= n && n > 0 then go (k + 1) else k

-- | True if a non-negative number is written with @count@ digits. It must not have more of them.
isDigitCount :: NumberForm -> Int -> Int -> Bool
isDigitCount f count n
  | padded f = count == digits f
  | otherwise = count == least || count > least && n >= power (count - 1)
  where
    least = leastDigits f

-- | Least number of digits in a form without padding: one before the decimal point.
leastDigits :: NumberForm -> Int
leastDigits f = min (digits f) (if decimals f > 0 then decimals f + 1 else 1)
