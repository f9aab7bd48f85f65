-- | One interpretation of a machine's layout. Here it writes: a frame becomes marks, rows with what they mean, and both
-- the tape and its picture are made of them. Reading follows the same steps.
module Tape.Plan
  ( -- * The layout, made ready
    Plan (..),
    Step (..),
    fromMachine,

    -- * Rows with their meaning
    Mark (..),
    Sense (..),
    Piece (..),
    Stretch (..),
    frameMarks,
    blanks,
    constant,
    after,
  )
where

import Data.Bits (testBit)
import Data.List (foldl', nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame (Frame (..))
import Machine.Machine (Axis (..), Content (..), Item (..), Machine, NumberForm (..), OrderName (..), Service (..), Sign (..), Word' (..))
import Machine.Machine qualified as Machine
import Tape.State (Axes, State (..))
import Tape.State qualified as State
import Tape.Symbol (Symbol, Symbols)
import Tape.Symbol qualified as Symbol

-- | A machine's layout with all that does not change from frame to frame.
data Plan = Plan
  { machine :: Machine,
    symbols :: Symbols,
    axes :: Axes,
    steps :: [Step],
    -- | between two words
    between :: [Symbol],
    ws :: [Word'],
    -- | the axes in the order of their words
    leaders :: [Axis],
    -- | the commands in the order of their words and bits, and whether 0 is a command of its own rather than none
    commands :: [(OrderName, Bool)]
  }

data Step
  = Fixed [Symbol]
  | -- | a word and its address
    Worded Word' [Symbol]
  | Checked Int

fromMachine :: Machine -> Plan
fromMachine machine =
  Plan
    { machine,
      symbols,
      axes = State.axes machine,
      steps = map step (NonEmpty.toList (Machine.items (Machine.layout machine))),
      between = text (Machine.separator (Machine.layout machine)),
      ws,
      leaders = [a | w <- ws, Along a <- [content w]],
      commands = nub (concatMap commandsOf ws)
    }
  where
    symbols = Symbol.fromMachine machine
    ws = Machine.wordsOf machine
    text = map (Symbol.symbol symbols) . Text.unpack
    step item = case item of
      Literal t -> Fixed (text t)
      AWord w -> Worded w (text (address w))
      CheckDigit m -> Checked m
    commandsOf w = [(o, State.zeroCommands w) | Command o <- [content w]] <> [(o, False) | OrderBit o _ <- service (form w)]

-- | A row and what it is for.
data Mark = Mark {holes :: Word8, weight :: Int, sense :: Sense}
  deriving stock (Eq, Show)

data Sense
  = Blank Stretch
  | -- | of the symbols before the first frame
    Opening Char
  | -- | of those behind the last
    Closing Char
  | Constant Char
  | Separator Char
  | CheckSymbol Int
  | -- | of a word that holds a number
    InWord Content Int Piece
  deriving stock (Eq, Show)

-- | Rows without holes.
data Stretch = Leader | Gap | Shift | Trailer
  deriving stock (Eq, Show)

-- | A row of a word.
data Piece
  = Address Char
  | -- | direction and which axis leads
    Lead Int
  | SignSymbol Char
  | Point
  | -- | a digit, its place, the lowest 0, and what the service track says there
    Digit Int Int Service Bool
  deriving stock (Eq, Show)

-- | Blank rows.
blanks :: Stretch -> Int -> [Mark]
blanks stretch n = replicate n (Mark 0 0 (Blank stretch))

-- | The marks of a frame without the gap behind it.
frameMarks :: Plan -> State -> Frame -> [Mark]
frameMarks p state frame
  | null [() | Checked _ <- steps p] = marks
  | otherwise = map complete marks
  where
    marks = go False (steps p)
    go behindWord todo = case todo of
      [] -> []
      Fixed cs : more -> map (constant Constant) cs <> go False more
      Checked m : more -> Mark 0 0 (CheckSymbol m) : go False more
      Worded w cs : more -> case State.number (axes p) state frame w of
        Nothing -> go behindWord more
        Just n -> (if behindWord then map (constant Separator) (between p) else []) <> wordMarks p frame w cs n <> go True more
    total = foldl' (\n m -> n + weight m) 0 marks
    complete m = case sense m of
      CheckSymbol modulus -> let d = checkDigit p modulus total in Mark (Symbol.digit (symbols p) d) (Symbol.digitWeight (symbols p) d) (CheckSymbol d)
      _ -> m

-- | A row that always is the same.
constant :: (Char -> Sense) -> Symbol -> Mark
constant use (Symbol.Symbol c h n) = Mark h n (use c)

-- | The smallest digit that makes the sum a multiple.
checkDigit :: Plan -> Int -> Int -> Int
checkDigit p modulus total = case [d | d <- [0 .. 9], (total + Symbol.digitWeight (symbols p) d) `mod` max 1 modulus == 0] of
  d : _ -> d
  [] -> 0

-- | The rows of a word: its address, what stands before the digits, the digits.
wordMarks :: Plan -> Frame -> Word' -> [Symbol] -> Int -> [Mark]
wordMarks p frame w cs n = map (constant (inWord . Address)) cs <> signMarks <> digitMarks p frame w n
  where
    inWord = InWord (content w) n
    signSymbol c = constant (inWord . SignSymbol) (Symbol.symbol (symbols p) c)
    signMarks = case sign (form w) of
      Unsigned -> []
      ServiceSign -> []
      MinusSign -> [signSymbol '-' | n < 0]
      EitherSign -> [signSymbol (if n < 0 then '-' else '+')]
      Priority leadForth leadBack forth back
        | leads p frame (content w) -> [lead (if n < 0 then leadBack else leadForth)]
        | otherwise -> [lead (if n < 0 then back else forth)]
    lead d = Mark (Symbol.digit (symbols p) (d `mod` 10)) (Symbol.digitWeight (symbols p) (d `mod` 10)) (inWord (Lead d))

-- | Whether a word is that of the axis with most pulses; of several of the first.
leads :: Plan -> Frame -> Content -> Bool
leads p frame c = case c of
  Along a -> take 1 [b | b <- leaders p, pulses b == most] == [a]
  _ -> True
  where
    pulses b = abs (State.along b (increment frame))
    most = maximum (0 : map pulses (leaders p))

digitMarks :: Plan -> Frame -> Word' -> Int -> [Mark]
digitMarks p frame w n = emit (count - 1) (service f) (split count (abs n) [])
  where
    f = form w
    count = max (if padded f then digits f else least) (if padded f then 0 else lengthOf (abs n))
    least = min (digits f) (if decimals f > 0 then decimals f + 1 else 1)
    split k m ds = if k <= 0 then ds else split (k - 1 :: Int) (m `quot` 10) (m `rem` 10 : ds)
    emit k services ds = case ds of
      [] -> []
      d : rest ->
        let s = case services of
              [] -> NoHole
              now : _ -> now
            hole = punched frame n s
            holes = if hole then Symbol.serviceDigit (symbols p) d else Symbol.digit (symbols p) d
            mark = Mark holes (Symbol.digitWeight (symbols p) d) (InWord (content w) n (Digit d k s hole))
            tailMarks = mark : emit (k - 1) (drop 1 services) rest
         in if k == decimals f - 1 then constant (InWord (content w) n . const Point) (Symbol.symbol (symbols p) '.') : tailMarks else tailMarks
    lengthOf m = if m == 0 then 0 else 1 + lengthOf (m `quot` 10)

-- | Whether there is a hole in the service track beside a digit of a number.
punched :: Frame -> Int -> Service -> Bool
punched frame n s = case s of
  MinusHole -> n < 0
  OrderBit o k -> testBit (fromMaybe 0 (lookup o (orders frame))) k
  Marker -> True
  BrakingHole -> braking frame
  NoHole -> False

-- | After a frame.
after :: Plan -> State -> Frame -> State
after p = State.after (axes p) (ws p)
