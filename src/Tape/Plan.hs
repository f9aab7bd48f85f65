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
    foldFrame,
    blanks,
    constant,
    after,
  )
where

import Data.Bits (testBit)
import Data.List (foldl', nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe)
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame (Frame (..))
import Machine.Machine (Axis (..), Content (..), Item (..), Machine, MotionCodes, NumberForm (..), OrderName (..), Presence (..), Service (..), Sign (..), Word' (..))
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
    commands :: [(OrderName, Bool)],
    -- | the word of motions, if there is one
    motions :: Maybe (Word', MotionCodes),
    -- | whether a feed that is said holds on
    keepsFeed :: Bool,
    -- | whether frames have a check digit
    isChecked :: Bool
  }

data Step
  = Fixed [Symbol]
  | -- | a word, its address, and the same behind another word
    Worded Word' [Symbol] [Symbol]
  | Checked Int

fromMachine :: Machine -> Plan
fromMachine machine =
  Plan
    { machine,
      symbols,
      axes = State.axes machine,
      steps,
      between,
      ws,
      leaders = [a | w <- ws, Along a <- [content w]],
      commands = nub (concatMap commandsOf ws),
      motions = listToMaybe [(w, codes) | w <- ws, Motion codes <- [content w]],
      keepsFeed = or [presence w == WhenChanged | w <- ws, content w == FeedWord],
      isChecked = not (null [() | Checked _ <- steps])
    }
  where
    steps = map step (NonEmpty.toList (Machine.items (Machine.layout machine)))
    between = text (Machine.separator (Machine.layout machine))
    symbols = Symbol.fromMachine machine
    ws = Machine.wordsOf machine
    text = map (Symbol.symbol symbols) . Text.unpack
    step item = case item of
      Literal t -> Fixed (text t)
      AWord w -> let cs = text (address w) in Worded w cs (between <> cs)
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
  | isChecked p = map complete marks
  | otherwise = marks
  where
    marks = foldFrame (\h n s rest -> Mark h n s : rest) p state frame []
    total = foldl' (\n m -> n + weight m) 0 marks
    complete m = case sense m of
      CheckSymbol modulus -> let d = checkDigit p modulus total in Mark (Symbol.digit (symbols p) d) (Symbol.digitWeight (symbols p) d) (CheckSymbol d)
      _ -> m

-- | The rows of a frame, before something. A check digit is not known yet.
foldFrame :: (Word8 -> Int -> Sense -> r -> r) -> Plan -> State -> Frame -> r -> r
foldFrame mark p state frame = go False (steps p)
  where
    go behindWord todo end = case todo of
      [] -> end
      Fixed cs : more -> constants Constant cs (go False more end)
      Checked m : more -> mark 0 0 (CheckSymbol m) (go False more end)
      Worded w cs _ : more -> case State.number (axes p) state frame w of
        Nothing -> go behindWord more end
        Just n -> constants Separator (if behindWord then between p else []) (constants (InWord (content w) n . Address) cs (signMark w n (digitMarks w n (go True more end))))
    constants use cs end = case cs of
      [] -> end
      Symbol.Symbol c h k : more -> mark h k (use c) (constants use more end)
    signSymbol w n c end = let Symbol.Symbol _ h k = Symbol.symbol (symbols p) c in mark h k (InWord (content w) n (SignSymbol c)) end
    signMark w n end = case sign (form w) of
      Unsigned -> end
      ServiceSign -> end
      MinusSign -> if n < 0 then signSymbol w n '-' end else end
      EitherSign -> signSymbol w n (if n < 0 then '-' else '+') end
      Priority leadForth leadBack forth back
        | leads p frame (content w) -> lead w n (if n < 0 then leadBack else leadForth) end
        | otherwise -> lead w n (if n < 0 then back else forth) end
    lead w n d = mark (Symbol.digit (symbols p) (d `mod` 10)) (Symbol.digitWeight (symbols p) (d `mod` 10)) (InWord (content w) n (Lead d))
    digitMarks w n end =
      let f = form w
          count = digitCount f (abs n)
          emit k services ds = case ds of
            [] -> end
            d : rest ->
              let (s, others) = case services of
                    [] -> (NoHole, [])
                    now : later -> (now, later)
                  hole = punched frame n s
                  holes = if hole then Symbol.serviceDigit (symbols p) d else Symbol.digit (symbols p) d
                  behind = mark holes (Symbol.digitWeight (symbols p) d) (InWord (content w) n (Digit d k s hole)) (emit (k - 1) others rest)
               in if k == decimals f - 1 then let Symbol.Symbol _ h m = Symbol.symbol (symbols p) '.' in mark h m (InWord (content w) n Point) behind else behind
       in emit (count - 1) (service f) (digitsOf count (abs n) [])
{-# INLINE foldFrame #-}

-- | How many digits a number has in a form.
digitCount :: NumberForm -> Int -> Int
digitCount f n = max (if padded f then digits f else least) (if padded f then 0 else lengthOf n)
  where
    least = min (digits f) (if decimals f > 0 then decimals f + 1 else 1)
    lengthOf m = if m == 0 then 0 else 1 + lengthOf (m `quot` 10) :: Int

-- | So many digits of a number, before others.
digitsOf :: Int -> Int -> [Int] -> [Int]
digitsOf k m ds = if k <= 0 then ds else digitsOf (k - 1) (m `quot` 10) (m `rem` 10 : ds)

-- | A row that always is the same.
constant :: (Char -> Sense) -> Symbol -> Mark
constant use (Symbol.Symbol c h n) = Mark h n (use c)

-- | The smallest digit that makes the sum a multiple.
checkDigit :: Plan -> Int -> Int -> Int
checkDigit p modulus total = case [d | d <- [0 .. 9], (total + Symbol.digitWeight (symbols p) d) `mod` max 1 modulus == 0] of
  d : _ -> d
  [] -> 0

-- | Whether a word is that of the axis with most pulses; of several of the first.
leads :: Plan -> Frame -> Content -> Bool
leads p frame c = case c of
  Along a -> take 1 [b | b <- leaders p, pulses b == most] == [a]
  _ -> True
  where
    pulses b = abs (State.along b (increment frame))
    most = maximum (0 : map pulses (leaders p))

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
