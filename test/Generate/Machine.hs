-- | Random machines within the limits of machine descriptions, and random frames for them.
--
-- A layout is readable only if every row of the tape has one meaning. So words that may be missing
-- have different first symbols. A number of unknown length is followed by something other than a
-- digit. If blank rows between frames are skipped, the first row of a frame has a hole.
module Generate.Machine (machine, frames) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), radians)
import Data.Bits (shiftL, (.|.))
import Data.Char (intToDigit, ord)
import Data.List (nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Machine.Machine hiding (braking, choose, commandWords)
import Machine.Machine qualified as Machine
import Test.QuickCheck

-- | A machine of any kind.
machine :: Gen Machine
machine = oneof [withFixedRows, lettered, printed]

-- | The properties of a machine that do not depend on the kind of its layout.
data Shared = Shared
  { used :: [Axis],
    turning :: [RotaryAxis],
    -- | the motion codes, if the layout has a word for them
    motions :: Maybe MotionCodes,
    arcKind :: Arcs,
    -- | axis words hold increments or positions
    how :: AxisMeasure,
    feedTable :: FeedCodes,
    -- | the number of digits of a feed code
    feedDigits :: Int,
    -- | a machine with these properties, whose layout and tape code are placeholders
    bottom :: Machine
  }

-- | Random properties that fit one another.
shared :: Gen Shared
shared = do
  used <- shuffle =<< elements [[X, Y], [X, Y, Z], [X], [Z, Y]]
  turning <- shuffle =<< elements [[], [], [A], [B], [A, B]]
  moving <- arbitrary
  codes <- shuffle [0 .. 9]
  quick <- arbitrary
  let arcsFit = X `elem` used && Y `elem` used
      motions = case codes of
        a : b : c : d : _
          | moving ->
            Just
              ( MotionCodes
                  (if quick then Just a else Nothing)
                  b
                  (if arcsFit then Just c else Nothing)
                  (if arcsFit then Just d else Nothing)
              )
        _ -> Nothing
  arcKind <-
    if moving && arcsFit
      then oneof [pure NoArcs, Arcs <$> arbitrary <*> arbitrary <*> arbitrary]
      else pure NoArcs
  how <- elements [Increments, Positions]
  feedDigits <- choose (1, 4)
  feedTable <- feedCodes feedDigits
  forms <-
    traverse
      ( \a ->
          AxisForm a . Mm <$> elements [0.001, 0.01, 0.02] <*> arbitrary <*> arbitrary <*> pure True
      )
      used
  rotary <-
    traverse
      (\a -> RotaryForm a . radians <$> elements [0.001, 0.01, 0.02] <*> arbitrary)
      turning
  let bottom = (blankMachine (NonEmpty.fromList forms) arcKind how feedTable) {rotaryAxes = rotary}
  pure Shared {used, turning, motions, arcKind, how, feedTable, feedDigits, bottom}

-- | A machine with the given properties, whose layout and tape code are placeholders.
blankMachine :: NonEmpty.NonEmpty AxisForm -> Arcs -> AxisMeasure -> FeedCodes -> Machine
blankMachine forms arcKind how feedTable =
  Machine
    { name = MachineName "random",
      title = "",
      medium =
        Medium
          { tracks = 8,
            pitch = Just (Mm 2.54),
            width = Nothing,
            punchRate = Nothing,
            suffix = "tape",
            leader = 0,
            gap = 0,
            evenShift = 0,
            spare = Counted,
            opening = "",
            closing = ""
          },
      code =
        TapeCode
          { codeName = "random",
            symbols = Map.empty,
            weights = Map.empty,
            evenTrack = Nothing,
            serviceTrack = Nothing,
            skips = []
          },
      axes = forms,
      rotaryAxes = [],
      arcs = arcKind,
      layout =
        Layout {items = NonEmpty.fromList [Literal "x"], measure = how, separator = ""},
      feeds = Feeds AlongPath feedTable 1 NotAbove Highest Nothing,
      Machine.braking = Braking 5 SlowFrames,
      Machine.commandWords = noCommandWords,
      limits = Limits Nothing,
      controller = Nothing,
      programForm = Nothing,
      describedValues = []
    }

-- | Feed codes for a word of @n@ digits: a range, a list, the values of a formula.
feedCodes :: Int -> Gen FeedCodes
feedCodes n = oneof [Direct 1 <$> choose (1, most), list, formula]
  where
    most = 10 ^ n - 1
    list = do
      k <- choose (1, 9)
      cs <- vectorOf k (choose (0, most))
      vs <- vectorOf k (choose (1, 1000))
      pure (Listed (Map.fromList (zip (map FeedCode cs) vs)))
    formula =
      pure
        ( Listed
            ( Map.fromList
                [(FeedCode c, 10 * 10 ** (fromIntegral c / 20)) | c <- [0 .. min most 40]]
            )
        )

-- Digits in fixed rows ----------------------------------------------------------------------------

-- | A machine whose frames all have the same words, without addresses. Holes in the service track
-- encode signs, commands and marks.
withFixedRows :: Gen Machine
withFixedRows = do
  s <- shared
  tracks <- choose (5, 8)
  spareTracks <- shuffle [5 .. tracks]
  evenTrack <- elements (Nothing : map Just (take 1 (drop 1 spareTracks)))
  tetrads <-
    frequency
      [ (1, pure [0 .. 9]),
        (1, pure [0x0, 0x1, 0x5, 0x6, 0x7, 0x8, 0x9, 0xA, 0xB, 0xF]),
        (2, take 10 <$> shuffle [0 .. 15])
      ]
  let serviceTrack = case spareTracks of
        k : _ -> k
        [] -> 5
      marker = 0x0F .|. (1 `shiftL` (serviceTrack - 1)) :: Word8
  marked <- arbitrary
  spare <- if marked then elements [Counted, Skipped] else pure Counted
  modulus <- elements [Nothing, Just 10, Just 9, Just 7, Just 2]
  front <- arbitrary
  ws <- fixedWords s
  let check = [CheckDigit m | Just m <- [modulus]]
      body = if front then check <> map AWord ws else map AWord ws <> check
  medium' <- mediumOf tracks spare (if marked then "*" else "")
  pure
    (bottom s)
      { medium = medium',
        code =
          TapeCode
            { codeName = "random",
              symbols = Map.fromList (('*', marker) : zip (map intToDigit [0 .. 9]) tetrads),
              weights = Map.fromList (zip (map intToDigit [0 .. 9]) [0 ..]),
              evenTrack,
              serviceTrack = Just serviceTrack,
              skips = []
            },
        layout =
          Layout
            { items = NonEmpty.fromList ([Literal "*" | marked] <> body),
              measure = how s,
              separator = ""
            }
      }

-- | The words of a layout without addresses, in random order.
fixedWords :: Shared -> Gen [Word']
fixedWords s = do
  axisDigits <- choose (2, 6)
  centreDigits <- choose (2, 6)
  numberDigits <- choose (0, 3)
  -- The axes whose words have the bits of a command: none, the first, or the first and the second.
  axesWithBits <- choose (0, 2)
  orderWord <- arbitrary
  axisWords <-
    traverse
      ( \a ->
          signed
            (Along a)
            axisDigits
            ( if a `elem` take axesWithBits (used s)
                then
                  [ CommandBit (CommandName "bits") (k - 1)
                    | k <- [axisDigits - 1, axisDigits - 2 .. 1]
                  ]
                else []
            )
      )
      (used s)
  turnWords <- traverse (\a -> signed (About a) axisDigits []) (turning s)
  centreWords <-
    traverse (\a -> signed (Centre a) centreDigits []) (if arcKind s == NoArcs then [] else [X, Y])
  mark <- elements [Marker, BrakingHole, NoHole]
  shuffle
    ( axisWords <> turnWords <> centreWords
        <> [plain FrameNumber numberDigits [] | numberDigits > 0]
        <> [plain (Motion m) 1 [] | Just m <- [motions s]]
        <> [plain FeedWord (feedDigits s) [mark]]
        <> [plain (Command (CommandName "word")) 2 [] | orderWord]
    )
  where
    plain c n sv = Word' "" c (form n Unsigned sv) Always
    signed c n sv = pure (Word' "" c (form n ServiceSign (MinusHole : sv)) Always)
    form n sg sv =
      NumberForm
        { digits = n,
          padded = True,
          decimals = 0,
          sign = sg,
          service = take n (sv <> repeat NoHole)
        }

-- | A tape with a count of tracks. The text is the mark that may occur before and after the frames.
mediumOf :: Int -> Spare -> Text -> Gen Medium
mediumOf tracks spare mark = do
  leader <- choose (0, 30)
  gap <- choose (0, 3)
  evenShift <- choose (0, 2)
  opening <- elements ["", mark, mark <> mark]
  closing <- elements ["", mark <> mark]
  width <- elements [Nothing, Just (Mm 17.5), Just (Mm 25.4)]
  punchRate <- elements [Nothing, Just 300, Just 62.5]
  pure
    Medium
      { tracks,
        pitch = Just (Mm 2.54),
        width,
        punchRate,
        suffix = "tape",
        leader,
        gap,
        evenShift,
        spare,
        opening,
        closing
      }

-- Letters -----------------------------------------------------------------------------------------

-- | A machine whose words have letters as addresses. Letters use one track more than digits. A
-- frame may end with an end-of-frame symbol and may have a check digit of any modulus.
lettered :: Gen Machine
lettered = do
  s <- shared
  tracks <- choose (5, 8)
  evenTrack <- if tracks > 5 then elements [Nothing, Just tracks] else pure Nothing
  letters <- shuffle "АБВГДЕЖИКЛМНПРС"
  modulus <- choose (2, 10)
  checked <- elements [0, 1, 2 :: Int]
  spare <- elements [Counted, Skipped]
  -- A frame with a mark at its beginning needs none at its end.
  ended <- if spare == Skipped then arbitrary else pure True
  let letterRows = zip letters (map (16 .|.) [0 .. 15])
      (begin, end, addresses) = case letters of
        a : b : more -> (Text.singleton a, Text.singleton b, map Text.singleton more)
        _ -> ("А", "Б", [])
      check k = [CheckDigit modulus | checked == k]
  ws <- addressed s addresses digitSigns
  medium' <- mediumOf tracks spare begin
  pure
    (bottom s)
      { medium = medium',
        code =
          TapeCode
            { codeName = "random",
              symbols = Map.fromList (zip (map intToDigit [0 .. 9]) [0 ..] <> letterRows),
              weights = Map.fromList (zip (map intToDigit [0 .. 9]) [0 ..] <> zip letters [0 ..]),
              evenTrack,
              serviceTrack = Nothing,
              skips = [0x1F | spare == Skipped, isNothing evenTrack]
            },
        layout =
          Layout
            { items =
                NonEmpty.fromList
                  ( [Literal begin | spare == Skipped]
                      <> check 1
                      <> map AWord ws
                      <> check 2
                      <> [Literal end | ended]
                  ),
              measure = how s,
              separator = ""
            }
      }
  where
    digitSigns = do
      ds <- shuffle [0 .. 9]
      pure $ case ds of
        a : b : c : d : _ -> Priority a b c d
        _ -> Priority 5 6 1 2

-- | Words with addresses, in random order. Some of them are present only in some frames.
addressed :: Shared -> [Text] -> Gen Sign -> Gen [Word']
addressed s addresses signs = do
  sg <- signs
  width <- choose (1, 6)
  decimal <- elements [0, min 3 (width - 1)]
  full <- arbitrary
  count <- choose (0, 3)
  let pad = full || simple sg
      axisForm' =
        NumberForm
          { digits = width,
            padded = pad,
            decimals = if simple sg then 0 else decimal,
            sign = sg,
            service = []
          }
      plain n = NumberForm {digits = n, padded = pad, decimals = 0, sign = Unsigned, service = []}
      contents =
        [(FrameNumber, plain 3) | count > 1] <> [(Motion m, plain 2) | Just m <- [motions s]]
          <> [(Along a, axisForm') | a <- used s]
          <> [(About a, axisForm') | a <- turning s]
          <> [(Centre a, axisForm') | arcKind s /= NoArcs, a <- [X, Y]]
          <> [(FeedWord, plain (feedDigits s))]
          <> take
            count
            [ (Command (CommandName "first"), plain 2),
              (Command (CommandName "second"), plain 1),
              (Command (CommandName "none"), (plain 0) {padded = True})
            ]
  shuffled <- shuffle contents
  traverse one (zip addresses shuffled)
  where
    simple sg = case sg of
      Priority {} -> True
      _ -> False
    one (a, (c, f)) = Word' a c f <$> presenceOf c
    presenceOf c = case c of
      FrameNumber -> pure Always
      Motion _ -> elements [Always, InMotion]
      Along _ -> elements [Always, InMotion, WhenNeeded]
      About _ -> elements [Always, InMotion, WhenNeeded]
      Centre _ -> elements [Always, InMotion, WhenNeeded]
      FeedWord -> elements [Always, InMotion, WhenNeeded, WhenChanged]
      Command (CommandName "none") -> pure WhenNeeded
      Command _ -> elements [Always, InMotion, WhenNeeded]

-- Text --------------------------------------------------------------------------------------------

-- | A machine whose frames are written in ASCII, with or without parity, on tape or as a text file.
printed :: Gen Machine
printed = do
  s <- shared
  parity <- arbitrary
  onTape <- arbitrary
  letters <- shuffle ['A' .. 'Z']
  double <- arbitrary
  between <- elements ["", " "]
  spare <- elements [Counted, Skipped]
  ws <-
    addressed
      s
      (map (\c -> if double then Text.pack [c, 'o'] else Text.singleton c) letters)
      (elements [MinusSign, EitherSign])
  tapeMedium <- mediumOf 8 spare "%\n"
  let medium' =
        if onTape
          then tapeMedium
          else tapeMedium {pitch = Nothing, leader = 0, gap = 0, evenShift = 0, spare = Counted}
  pure
    (bottom s)
      { medium = medium',
        code =
          TapeCode
            { codeName = "random",
              symbols = ascii,
              weights = Map.empty,
              evenTrack = if parity && onTape then Just 8 else Nothing,
              serviceTrack = Nothing,
              skips = if onTape && spare == Skipped then [0x00, 0xFF] else []
            },
        layout =
          Layout
            { items =
                NonEmpty.fromList
                  ([Literal "/" | spare == Skipped] <> map AWord ws <> [Literal "\n"]),
              measure = how s,
              separator = between
            }
      }

ascii :: Map Char Word8
ascii = Map.fromList [(c, fromIntegral (ord c)) | c <- '\n' : [' ' .. '~']]

-- Frames ------------------------------------------------------------------------------------------

-- | A position, and frames that the machine can execute from there.
frames :: Machine -> Gen (Pulses3, [Frame])
frames m = do
  n <- choose (0, 12)
  start <-
    let on a =
          Pulses <$> choose (negate (reach a), reach a)
     in Pulses3 <$> on X <*> on Y <*> on Z
  feeds' <- vectorOf 2 (feedOf m)
  (,) start <$> go n feeds' (Place start 0)
  where
    reach a = let Pulses c = capacity m a in c
    go :: Int -> [FeedCode] -> Place -> Gen [Frame]
    go n feeds' from
      | n <= 0 = pure []
      | otherwise = do
        f <- frame m feeds' from
        (f :) <$> go (n - 1) feeds' (placeAfter f from)

-- | Position of the cutter, and position of the rotary axes, in pulses.
data Place = Place {at :: Pulses3, rotated :: Pulses2}

placeAfter :: Frame -> Place -> Place
placeAfter f from = Place (at from + increment f) (rotated from + turn f)

-- | A feed code of a machine.
feedOf :: Machine -> Gen FeedCode
feedOf m = case codes (feeds m) of
  Direct a b -> FeedCode <$> choose (a, b)
  Listed table -> elements (Map.keys table)

-- | A frame that starts at a place and has one of the given feeds.
frame :: Machine -> [FeedCode] -> Place -> Gen Frame
frame m feeds' from = do
  f <-
    frequency
      ( [(6, straightway)]
          <> [(2, rapidly) | hasRapidMotion m]
          <> [(2, only) | not (null (orderNames m))]
          <> [(6, round') | arcs m /= NoArcs]
      )
  if null (Frame.violations m [f]) && fits f then pure f else frame m feeds' from
  where
    fits f =
      measure (layout m) == Increments
        || and
          [ abs p <= most
            | let Place p3 p2 = placeAfter f from,
              (most, p) <-
                zip
                  (map (capacity m) [X, Y, Z] <> map (turnCapacity m) [A, B])
                  (parts p3 <> turnParts p2)
          ]
    straightway = do
      (d, t) <- moveAndTurn m from
      base <- atFeed
      pure base {motion = Linear, increment = d, turn = t}
    rapidly = do
      (d, t) <- moveAndTurn m from
      given <- ordersOf m 3
      pure
        Frame
          { motion = Rapid,
            increment = d,
            turn = t,
            centre = 0,
            feedCode = FeedCode 0,
            braking = False,
            commands = given
          }
    only = Frame.commandFrame <$> ordersOf m 1
    round' = do
      base <- atFeed
      (sense, d, c) <- arc m (at from)
      pure base {motion = Circular sense, increment = d, centre = c}
    atFeed = frameAt m =<< elements feeds'

-- | A frame without increments at a feed, with random commands and braking.
frameAt :: Machine -> FeedCode -> Gen Frame
frameAt m speed' = do
  isSlow <-
    if null [() | w <- wordsOf m, BrakingHole <- service (form w)]
      then pure False
      else arbitrary
  given <- ordersOf m 3
  pure
    Frame
      { motion = Linear,
        increment = 0,
        turn = 0,
        centre = 0,
        feedCode = speed',
        braking = isSlow,
        commands = given
      }

parts :: Pulses3 -> [Pulses]
parts (Pulses3 x y z) = [x, y, z]

turnParts :: Pulses2 -> [Pulses]
turnParts (Pulses2 a b) = [a, b]

-- | The increment and the turn of a move from a place. Some moves turn nothing, and some do nothing
-- else.
moveAndTurn :: Machine -> Place -> Gen (Pulses3, Pulses2)
moveAndTurn m from = do
  d <- move m (at from)
  t <- turned m (rotated from)
  if null (rotaryAxes m)
    then pure (d, 0)
    else frequency [(3, pure (d, 0)), (3, pure (d, t)), (1, pure (0, t))]

-- | The increment of a move from a position, within the capacity of the words. The increment along
-- an axis may be 0, small, or as large as possible.
move :: Machine -> Pulses3 -> Gen Pulses3
move m (Pulses3 x y z) = Pulses3 <$> along X x <*> along Y y <*> along Z z
  where
    along a = component m (capacity m a)

-- | The turn of a move from a position of the rotary axes, in the same manner.
turned :: Machine -> Pulses2 -> Gen Pulses2
turned m (Pulses2 a b) = Pulses2 <$> about A a <*> about B b
  where
    about axis = component m (turnCapacity m axis)

-- | The pulses on one axis in a move from a position, if the axis's word can hold a given number.
component :: Machine -> Pulses -> Pulses -> Gen Pulses
component m (Pulses c) (Pulses here) =
  Pulses
    <$> frequency
      [ (2, pure 0),
        (1, elements [max low (-1), min high 1]),
        (4, choose (low, high)),
        (1, elements [low, high])
      ]
  where
    (low, high) = case measure (layout m) of
      Increments -> (-c, c)
      Positions -> (max (-c) (-c - here), min c (c - here))

-- | An arc from a position, within the capacity of the words: its sense, its increment, and its
-- centre relative to its start. It lies in one quadrant if the machine requires that.
arc :: Machine -> Pulses3 -> Gen (Sense, Pulses3, Pulses2)
arc m at = case arcs m of
  Arcs {quadrants = True} -> do
    (p, q) <- (,) <$> sign' <*> sign'
    (a, b) <- (,) <$> near <*> near
    (c, d) <- (,) <$> near <*> near
    let cross = p * q * (a * d - b * c)
    pure
      ( if cross > 0 then CounterClockwise else Clockwise,
        Pulses3 (Pulses (p * (c - a))) (Pulses (q * (d - b))) 0,
        Pulses2 (Pulses (negate (p * a))) (Pulses (negate (q * b)))
      )
  kind -> do
    sense <- elements [Clockwise, CounterClockwise]
    full <- arbitrary
    Pulses3 dx dy dz <- move m at
    let z = if kind `elem` [Arcs q f True | q <- [False, True], f <- [False, True]] then dz else 0
    (i, j) <- (,) <$> choose (negate reach, reach) <*> choose (negate reach, reach)
    pure (sense, if full then Pulses3 0 0 z else Pulses3 dx dy z, Pulses2 (Pulses i) (Pulses j))
  where
    Pulses reach = centreCapacity m
    sign' = elements [-1, 1]
    near = choose (0, max 1 (reach `div` 2))

-- | The commands of a machine in the order of its words.
orderNames :: Machine -> [CommandName]
orderNames m =
  nub . concat $
    [ [o | Command o <- [content w]] <> take 1 [o | CommandBit o _ <- service (form w)]
      | w <- wordsOf m
    ]

-- | Some commands, each with a probability of one in @odds@.
ordersOf :: Machine -> Int -> Gen [(CommandName, Int)]
ordersOf m odds = concat <$> traverse some (orderNames m)
  where
    some o = do
      yes <- choose (1, odds)
      v <- maybe (pure 0) (\most -> choose (0, most)) (commandCapacity m o)
      pure [(o, v) | yes == 1 && canEncode m o v]
