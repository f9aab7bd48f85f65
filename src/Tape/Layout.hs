{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | One interpretation of a machine's layout. Here it writes: a frame becomes marks, rows with what
-- they mean, and both the tape and its picture are made of them. Reading follows the same steps.
module Tape.Layout
  ( -- * The layout, made ready
    Layout (..),
    LayoutStep (..),
    Address (..),
    fromMachine,

    -- * Rows with their meaning
    MarkedRow (..),
    RowMeaning (..),
    RowContent (..),
    BlankRows (..),
    frameMarks,
    foldRows,
    mostRows,
    wordsFor,
    isCount,
    behindAddress,
    blanks,
    constant,
    after,
  )
where

import Data.Bits (testBit)
import Data.ByteString.Short (ShortByteString)
import Data.ByteString.Short qualified as Short
import Data.Functor.Identity (runIdentity)
import Data.List (foldl', nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe)
import Data.Primitive.PrimArray (PrimArray)
import Data.Primitive.PrimArray qualified as Primitive
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame (Frame (..))
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

-- | A machine's layout with all that does not change from frame to frame.
data Layout = Layout
  { machine :: Machine,
    symbols :: Symbols,
    axes :: Axes,
    steps :: [LayoutStep],
    -- | those of a frame that walks no arc and commands nothing: most frames are of this kind, and
    -- most words do not stand there
    bareSteps :: [LayoutStep],
    -- | between two words
    between :: [Symbol],
    minus :: Symbol,
    plus :: Symbol,
    point :: Symbol,
    ws :: [Word'],
    -- | those that can stand in a frame that walks no arc and commands nothing
    bareWords :: [Word'],
    -- | the axes in the order of their words
    leaders :: [Axis],
    -- | the commands in the order of their words and bits, and whether 0 is a command of its own
    -- rather than none
    commands :: [(CommandName, Bool)],
    -- | the word of motions, if there is one
    motions :: Maybe (Word', MotionCodes),
    -- | whether a feed that is said holds on
    keepsFeed :: Bool,
    -- | whether frames have a check digit
    isChecked :: Bool,
    -- | whether a number and how many digits it has are all that can differ in a word, and a word
    -- of another kind of frame is not the last thing in it
    isPlain :: Bool
  }

data LayoutStep
  = Fixed [Symbol]
  | -- | a word, its address, and the same behind another word
    Worded Word' Address Address
  | Checked Int

-- | The symbols before a number; how many they are, and the row of the last one, by which most
-- addresses are told apart.
data Address = Spelled {spelled :: [Symbol], extent :: Int, final :: Word8}

-- | The row behind an address that stands at a row; below 0 where it does not. Its last symbol is
-- looked at first.
behindAddress :: ShortByteString -> Int -> Address -> Int
behindAddress rows k Spelled {spelled, extent, final}
  | extent == 0 = k
  | k + extent <= Short.length rows && Short.index rows (k + extent - 1) == final =
    Symbol.behind rows k spelled
  | otherwise = -1
{-# INLINE behindAddress #-}

fromMachine :: Machine -> Layout
fromMachine machine =
  Layout
    { machine,
      symbols,
      axes = ModalState.axes machine,
      steps,
      bareSteps = filter isBareStep steps,
      between,
      minus = Symbol.symbol symbols '-',
      plus = Symbol.symbol symbols '+',
      point = Symbol.symbol symbols '.',
      ws,
      bareWords = filter ModalState.standsBare ws,
      leaders = [a | w <- ws, Along a <- [content w]],
      commands = nub (concatMap commandsOf ws),
      motions = listToMaybe [(w, codes) | w <- ws, Motion codes <- [content w]],
      keepsFeed = or [presence w == WhenChanged | w <- ws, content w == FeedWord],
      isChecked,
      isPlain = not isChecked && endsSurely && all (plainForm . form) ws
    }
  where
    endsSurely = all isBareStep (takeWhile (not . standsAlways) (reverse steps))
    standsAlways s = case s of
      Fixed cs -> not (null cs)
      Worded w _ _ -> presence w == Always
      Checked _ -> True
    steps = map step (NonEmpty.toList (Machine.items (Machine.layout machine)))
    isChecked = not (null [() | Checked _ <- steps])
    between = text (Machine.separator (Machine.layout machine))
    symbols = Symbol.fromMachine machine
    ws = Machine.wordsOf machine
    text = map (Symbol.symbol symbols) . Text.unpack
    step item = case item of
      Literal t -> Fixed (text t)
      AWord w -> let cs = text (address w) in Worded w (addressOf cs) (addressOf (between <> cs))
      CheckDigit m -> Checked m
    isBareStep s = case s of
      Fixed _ -> True
      Worded w _ _ -> ModalState.standsBare w
      Checked _ -> True
    addressOf cs =
      Spelled {spelled = cs, extent = length cs, final = foldl' (\_ c -> Symbol.holes c) 0 cs}
    commandsOf w =
      [(o, ModalState.zeroCommands w) | Command o <- [content w]]
        <> [(o, False) | OrderBit o _ <- service (form w)]

-- | Whether a number of this form says nothing but itself.
plainForm :: NumberForm -> Bool
plainForm f = null (service f) && digits f < mostDigits && isPlainSign (sign f)
  where
    isPlainSign s = case s of
      Unsigned -> True
      ServiceSign -> False
      MinusSign -> True
      EitherSign -> True
      Priority {} -> False

-- | A row and what it is for.
data MarkedRow = MarkedRow {holes :: Word8, weight :: Int, sense :: RowMeaning}
  deriving stock (Eq, Show)

data RowMeaning
  = Blank BlankRows
  | -- | of the symbols before the first frame
    Opening Char
  | -- | of those behind the last
    Closing Char
  | Constant Char
  | Separator Char
  | CheckSymbol Int
  | -- | of a word that holds a number
    InWord Content Int RowContent
  deriving stock (Eq, Show)

-- | Rows without holes.
data BlankRows = Leader | Gap | Shift | Trailer
  deriving stock (Eq, Show)

-- | A row of a word.
data RowContent
  = Address Char
  | -- | direction and which axis leads
    Lead Int
  | SignSymbol Char
  | Point
  | -- | a digit, its place, the lowest 0, and what the service track says there
    Digit Int Int Service Bool
  deriving stock (Eq, Show)

-- | Blank rows.
blanks :: BlankRows -> Int -> [MarkedRow]
blanks stretch n = replicate n (MarkedRow 0 0 (Blank stretch))

-- | The marks of a frame without the gap behind it.
frameMarks :: Layout -> State -> Frame -> [MarkedRow]
frameMarks p state frame =
  reverse (runIdentity (foldRows (\marks h n s -> pure (MarkedRow h n s : marks)) p state frame []))

-- | The rows of a frame in order, each with what it counts and what it is for, onto what came
-- before them.
foldRows ::
  Monad m =>
  (r -> Word8 -> Int -> RowMeaning -> m r) ->
  Layout ->
  State ->
  Frame ->
  r ->
  m r
foldRows mark p state frame =
  foldBare mark (if isChecked p then counted p state frame else 0) p state frame
{-# INLINE foldRows #-}

-- | What the symbols of a frame add to, but for its check digit.
counted :: Layout -> State -> Frame -> Int
counted p state frame = runIdentity (foldBare count 0 p state frame 0)
  where
    count total _ n s =
      pure $! case s of
        CheckSymbol _ -> total
        _ -> total + n

-- | The same, given what the symbols of the frame add to.
foldBare ::
  Monad m =>
  (r -> Word8 -> Int -> RowMeaning -> m r) ->
  Int ->
  Layout ->
  State ->
  Frame ->
  r ->
  m r
foldBare mark total p state frame =
  go False (if ModalState.isBare frame then bareSteps p else steps p)
  where
    go behindWord todo before = case todo of
      [] -> pure before
      Fixed cs : more -> constants Constant cs before >>= go False more
      Checked m : more ->
        let d =
              checkDigit p m total
         in figure (CheckSymbol d) d before >>= go False more
      Worded w Spelled {spelled = cs} _ : more -> case ModalState.number (axes p) state frame w of
        Nothing -> go behindWord more before
        Just n -> do
          separated <- if behindWord then constants Separator (between p) before else pure before
          addressed <- constants (InWord (content w) n . Address) cs separated
          signed <- signOf w n addressed
          written <- numeral w n signed
          go True more written
    constants use cs !before = case cs of
      [] -> pure before
      Symbol.Symbol c h k : more -> mark before h k (use c) >>= constants use more
    figure use d before =
      mark before (Symbol.digit (symbols p) d) (Symbol.digitWeight (symbols p) d) use
    single use (Symbol.Symbol _ h k) before = mark before h k use
    signOf w n before = case sign (form w) of
      Unsigned -> pure before
      ServiceSign -> pure before
      MinusSign ->
        if n < 0
          then single (InWord (content w) n (SignSymbol '-')) (minus p) before
          else pure before
      EitherSign
        | n < 0 -> single (InWord (content w) n (SignSymbol '-')) (minus p) before
        | otherwise -> single (InWord (content w) n (SignSymbol '+')) (plus p) before
      Priority leadForth leadBack forth back ->
        lead
          w
          n
          ( if leads p frame (content w)
              then (if n < 0 then leadBack else leadForth)
              else (if n < 0 then back else forth)
          )
          before
    lead w n d = figure (InWord (content w) n (Lead d)) (d `mod` 10)
    numeral w n = case service f of
      [] -> plainFigures use (decimals f) (places - 1) left
      services -> figures use n (decimals f) (places - 1) services left
      where
        f = form w
        use = InWord (content w) n
        places = digitCount f (abs n)
        left = lowest places (abs n)
    pointAt use pointed k before =
      if k == pointed - 1 then single (use Point) (point p) before else pure before
    -- The digits of what is left from a place on.
    plainFigures use pointed k !left !before
      | k < 0 = pure before
      | otherwise = do
        let d = left `quot` power k
        ready <- pointAt use pointed k before
        behind <- figure (use (Digit d k NoHole False)) d ready
        plainFigures use pointed (k - 1) (left - d * power k) behind
    -- The same with a service track.
    figures use n pointed k !services !left !before
      | k < 0 = pure before
      | otherwise = do
        let d = left `quot` power k
            s = case services of
              [] -> NoHole
              now : _ -> now
            hole = punched frame n s
            !holes = if hole then Symbol.serviceDigit (symbols p) d else Symbol.digit (symbols p) d
        ready <- pointAt use pointed k before
        behind <- mark ready holes (Symbol.digitWeight (symbols p) d) (use (Digit d k s hole))
        figures use n pointed (k - 1) (drop 1 services) (left - d * power k) behind
{-# INLINE foldBare #-}

-- | The words that may stand in a frame.
wordsFor :: Layout -> Frame -> [Word']
wordsFor p frame = if ModalState.isBare frame then bareWords p else ws p

-- | No frame has more rows.
mostRows :: Layout -> Int
mostRows p = sum (map most (steps p))
  where
    most step = case step of
      Fixed cs -> length cs
      Checked _ -> 1
      -- A sign and a point.
      Worded w _ joined -> extent joined + 2 + max mostDigits (digits (form w))

-- | No number has more digits.
mostDigits :: Int
mostDigits = 19

-- | The powers of ten that a number can reach; beyond them one that no number does.
power :: Int -> Int
power k = if k < mostDigits then Primitive.indexPrimArray powers k else maxBound

powers :: PrimArray Int
powers = Primitive.primArrayFromList (take mostDigits (iterate (10 *) 1))

-- | How many digits a number has in a form.
digitCount :: NumberForm -> Int -> Int
digitCount f n
  | padded f = digits f
  | otherwise = go (min (digits f) (if decimals f > 0 then decimals f + 1 else 1))
  where
    go k = if k < mostDigits && power k <= n && n > 0 then go (k + 1) else k

-- | Whether it has so many, given that it has no more of them.
isCount :: NumberForm -> Int -> Int -> Bool
isCount f places n
  | padded f = places == digits f
  | otherwise = places == least || places > least && n >= power (places - 1)
  where
    least = min (digits f) (if decimals f > 0 then decimals f + 1 else 1)

-- | So many of the lowest digits of a number.
lowest :: Int -> Int -> Int
lowest places n = if n < power places then n else n `rem` power places

-- | A row that always is the same.
constant :: (Char -> RowMeaning) -> Symbol -> MarkedRow
constant use (Symbol.Symbol c h n) = MarkedRow h n (use c)

-- | The smallest digit that makes the sum a multiple.
checkDigit :: Layout -> Int -> Int -> Int
checkDigit p modulus total =
  case [d | d <- [0 .. 9], (total + Symbol.digitWeight (symbols p) d) `mod` max 1 modulus == 0] of
    d : _ -> d
    [] -> 0

-- | Whether a word is that of the axis with most pulses; of several of the first.
leads :: Layout -> Frame -> Content -> Bool
leads p frame c = case c of
  Along a -> take 1 [b | b <- leaders p, pulses b == most] == [a]
  _ -> True
  where
    pulses b = abs (ModalState.along b (increment frame))
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
after :: Layout -> State -> Frame -> State
after p = ModalState.after (axes p) (ws p)
