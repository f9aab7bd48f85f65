-- | Laws of tapes: what a machine's writer writes, its reader reads, and damage is found.
module Tape.PunchSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Base.Result qualified as Result
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Short qualified as Short
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, isNothing)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Word (Word8)
import Files (readText)
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Generate.Machine qualified as Generate
import Geometry.Carrier (Sense (..))
import Machine.FromText qualified as FromText
import Machine.Machine
  ( Arcs (..),
    AxisForm (..),
    AxisMeasure (..),
    CommandName (..),
    FeedCode (..),
    LayoutItem (..),
    Machine,
    Presence (..),
    RotaryForm (..),
    Spare (..),
  )
import Machine.Machine qualified as Machine
import Machines (iso6983, kontur2p, kontur3p, lkiU, lkiUn, lkp01f, n55)
import Report.Report qualified as Report
import Tape.FrameReader qualified as FrameReader
import Tape.FrameReader.Fast qualified as FastFrameReader
import Tape.FrameWriter qualified as FrameWriter
import Tape.Holes qualified as Holes
import Tape.Journey (journey, machines, start)
import Tape.Layout qualified as Layout
import Tape.ModalState qualified as ModalState
import Tape.Punch (Damage (..), Reason (..))
import Tape.Punch qualified as Punch
import Tape.RowMeaning qualified as RowMeaning
import Tape.Symbol qualified as Symbol
import Tape.Tape (Tape (..))
import Tape.Tape qualified as Tape
import Test.Hspec
import Test.QuickCheck hiding (label)

spec :: Spec
spec = do
  describe "random machines" randomMachineLaws
  describe "the codes of the machines" knownTapes
  describe "one hole changed" oneHole
  describe "damage" damage

randomMachineLaws :: Spec
randomMachineLaws = do
  it
    "a tape that was punched is read as its own frames or refused (catches a machine whose frames \
    \can be read in two ways)"
    $ do
      machine <- machineOf "test/machines/two-readings.machine"
      let readAgain fs =
            either
              (Left . Punch.reason)
              Right
              (Punch.readPunched machine 0 fs (Punch.write machine 0 fs))
      readAgain [straightAt60 1000 0, straightAt60 2000 1000]
        `shouldBe` Right [straightAt60 1000 0, straightAt60 2000 1000]
      readAgain [straightAt60 1000 0, straightAt60 2000 0, straightAt60 0 1000]
        `shouldBe` Left Punch.Misread
  it
    "frames may end with an optional word that most frames lack (catches a frame that is read only \
    \up to this word)"
    $ do
      machine <- machineOf "test/machines/no-end.machine"
      let fs =
            [ straightAt60 1000 0,
              (straightAt60 0 1000) {commands = [(CommandName "M", 8)]},
              straightAt60 1000 1000
            ]
      Punch.read machine 0 (Punch.write machine 0 fs) `shouldBe` Right fs
  it
    "decode after encode gives the frames (catches a word that writer and reader interpret \
    \differently)"
    $ checkCoverage . forAll Generate.machine $ \m -> forAll (Generate.frames m) $ \(at, fs) ->
      withCoverage m fs (Punch.read m at (Punch.write m at fs) === Right fs)
  it
    "a tape is read in the same way whatever frames are expected on it (catches a reader that \
    \returns the expected frames for a tape with others)"
    $ checkCoverage . forAll Generate.machine $ \m ->
      forAll (Generate.frames m) $ \(at, fs) ->
        forAll (expectedFor fs) $ \expected ->
          forAll (oneof [pure Nothing, Just <$> ((,) <$> choose (1, 200) <*> arbitrary)]) $
            \change ->
              let t =
                    Tape
                      ( maybe
                          id
                          (\(k, w) -> changed k (const w))
                          change
                          (rowsOf (Punch.write m at fs))
                      )
               in cover 20 (Punch.read m at t == Right expected) "the expected frames" $
                    cover 20 (Punch.read m at t /= Right expected) "other frames" $
                      Punch.readExpected m at expected t === Punch.read m at t
  it "rows with their meaning are the rows of the tape (catches a picture of another tape)" $
    forAll Generate.machine $ \m -> forAll (Generate.frames m) $ \(at, fs) ->
      ByteString.pack (map RowMeaning.holes (Punch.rows m at fs)) === rowsOf (Punch.write m at fs)
  it
    "one changed row is refused or gives frames that are written with these rows (catches a reader \
    \that guesses)"
    $ withMaxSuccess 5000 . forAll Generate.machine $ \m ->
      forAll (Generate.frames m) $ \(at, fs) ->
        let rows = rowsOf (Punch.write m at fs)
         in not (ByteString.null rows) ==> forAll (choose (0, ByteString.length rows - 1)) $ \k ->
              forAll (oneof [arbitrary, elements [0, 0xFF], elements (ByteString.unpack rows)]) $
                \w ->
                  let rows' = changed (k + 1) (const w) rows
                   in case Punch.read m at (Tape rows') of
                        Left d ->
                          counterexample
                            (show d)
                            (1 <= Punch.row d && Punch.row d <= ByteString.length rows)
                        Right fs' ->
                          withoutSkippedRows m (rowsOf (Punch.write m at fs'))
                            === withoutSkippedRows m rows'
  it
    "the fast reader and the reader word by word give the same frames (catches a shortcut with \
    \another result)"
    $ withMaxSuccess 1000 . checkCoverage . forAll Generate.machine $ \m ->
      forAll (Generate.frames m) $ \(at, fs) ->
        forAll (choose (0, 40)) $ \k ->
          forAll (oneof [arbitrary, elements [0, 0xFF], numberRow m]) $ \w ->
            let layout = Layout.fromMachine m
                states =
                  scanl
                    (Layout.after layout)
                    (ModalState.initial (ModalState.changesHeight fs) at)
                    fs
                rowsFor state f = map Layout.holes (FrameWriter.frameRows layout state f)
                readBoth state rows =
                  ( FastFrameReader.readFrame layout state (Short.pack rows) 0,
                    FrameReader.wordByWord layout state (Short.pack rows) 0
                  )
                -- A frame as the machine writes it: simple frames are read fast, all others not.
                isRead state f = case readBoth state (rowsFor state f) of
                  (FastFrameReader.Read g end, slowly) ->
                    Layout.isPlain layout && slowly == Right (g, end) && g == f
                  (FastFrameReader.NotSimple, _) ->
                    not (Layout.isPlain layout && ModalState.isSimple f && Frame.isMoving f)
                -- Any rows: if the fast reader gives a frame, it is the right one.
                isSame state rows = case readBoth state rows of
                  (FastFrameReader.Read g end, slowly) -> slowly == Right (g, end)
                  (FastFrameReader.NotSimple, _) -> True
                changedRow rows =
                  take (index rows) rows <> [w] <> drop (index rows + 1) rows
                index rows = k `mod` max 1 (length rows)
                -- The state in which no axis and no feed has been written yet.
                unwritten state =
                  (ModalState.initial (ModalState.changesHeight fs) (ModalState.position state))
                    { ModalState.ordinal =
                        ModalState.ordinal state
                    }
             in cover
                  20
                  ( Layout.isPlain layout
                      && any (\f -> ModalState.isSimple f && Frame.isMoving f) fs
                  )
                  "simple frames"
                  $ conjoin
                    [ counterexample
                        (show f)
                        ( isRead state f
                            && isSame state (changedRow (rowsFor state f))
                            && isSame state (rowsFor (unwritten state) f)
                        )
                      | (state, f) <- zip states fs
                    ]
  it
    "a minus before zero is refused by the fast reader and by the reader word by word (catches -0 \
    \that is read as 0)"
    $ do
      let layout = Layout.fromMachine iso6983
          state = ModalState.initial False start
          readBoth line =
            ( case FastFrameReader.readFrame layout state (textRows line) 0 of
                FastFrameReader.Read f _ -> Just (increment f)
                FastFrameReader.NotSimple -> Nothing,
              case FrameReader.wordByWord layout state (textRows line) 0 of
                Right (f, _) -> Right (increment f)
                Left (FrameReader.RowFault _ _ why) -> Left why
            )
          textRows = Short.toShort . Encoding.encodeUtf8
          toZero = Pulses3 (-500) 200 0
      readBoth "G1 X0.000 Y0.000 F60\n" `shouldBe` (Just toZero, Right toZero)
      readBoth "G1 X-0.000 Y0.000 F60\n" `shouldBe` (Nothing, Left MinusZero)
      readBoth "G1 X0.000 Y-0.000 F60\n" `shouldBe` (Nothing, Left MinusZero)
  it
    "an axis in the opposite direction negates its numbers and reverses the arcs (catches a sign \
    \that is forgotten)"
    $ forAll Generate.machine $ \m -> forAll (Generate.frames m) $ \(at, fs) ->
      let reversedX =
            m
              { Machine.axes =
                  fmap
                    (\f -> if axis f == Machine.X then f {reversed = not (reversed f)} else f)
                    (Machine.axes m)
              }
       in isJust (Machine.axisForm m Machine.X)
            ==> Punch.write reversedX (mirroredPosition at) (map mirroredFrame fs)
              === Punch.write m at fs

  it
    "a rotary axis in the opposite sense negates its numbers (catches a sign that is forgotten)"
    $ forAll (Generate.machine `suchThat` (not . null . Machine.rotaryAxes)) $ \m ->
      forAll (Generate.frames m) $ \(at, fs) ->
        let isFirst f = take 1 (Machine.rotaryAxes m) == [f]
            reversedFirst =
              m
                { Machine.rotaryAxes =
                    [ if isFirst f then f {turnsReversed = not (turnsReversed f)} else f
                      | f <- Machine.rotaryAxes m
                    ]
                }
            sign a = if or [rotaryAxis f == a | f <- Machine.rotaryAxes m, isFirst f] then -1 else 1
            turnedBack f = f {turn = turn f * Pulses2 (sign Machine.A) (sign Machine.B)}
         in Punch.write reversedFirst at (map turnedBack fs) === Punch.write m at fs

-- | Row of a digit, a sign or the decimal point, in the code of a machine.
numberRow :: Machine -> Gen Word8
numberRow m = elements [Symbol.holes (Symbol.symbol table c) | c <- "0123456789+-."]
  where
    table = Symbol.fromMachine m

-- | Rows without those that the reader skips.
withoutSkippedRows :: Machine -> ByteString -> ByteString
withoutSkippedRows m rows = case Machine.spare (Machine.medium m) of
  Counted -> rows
  Skipped -> ByteString.filter (`notElem` (0 : Machine.skips (Machine.code m))) rows

-- | Demands that random machines and frames have every feature often enough, in per cent.
withCoverage :: Testable p => Machine -> [Frame] -> p -> Property
withCoverage m fs =
  cover 20 (Machine.measure (Machine.layout m) == Positions) "positions"
    . cover 20 (Machine.measure (Machine.layout m) == Increments) "increments"
    . cover 20 (any reversed (NonEmpty.toList (Machine.axes m))) "reversed axes"
    . cover 5 (not (null [() | Frame {motion = Circular _} <- fs])) "arcs"
    . cover 1 (not (null [() | Frame {motion = Circular _, increment = 0} <- fs])) "full circles"
    . cover 3 (not (null [() | Arcs {Machine.quadrants = True} <- [Machine.arcs m]])) "quadrants"
    . cover 10 (not (null [() | Frame {motion = Rapid} <- fs])) "rapid moves"
    . cover 20 (not (all (null . commands) fs)) "commands"
    . cover 15 (any ((/= 0) . turn) fs) "turns"
    . cover 5 (any (\f -> turn f /= 0 && increment f == 0) fs) "turns alone"
    . cover 15 (any turnsReversed (Machine.rotaryAxes m)) "reversed rotary axes"
    . cover 1 (any Frame.braking fs) "braking"
    . cover
      20
      (not (null [() | CheckDigit _ <- NonEmpty.toList (Machine.items (Machine.layout m))]))
      "check digits"
    . cover 10 (isJust (Machine.evenTrack (Machine.code m))) "parity"
    . cover 20 (Machine.spare (Machine.medium m) == Skipped) "skipped blank rows"
    . cover 5 (isNothing (Machine.pitch (Machine.medium m))) "texts"
    . cover 5 (or [Machine.presence w == WhenChanged | w <- Machine.wordsOf m]) "modal feeds"

-- | Position mirrored in x = 0.
mirroredPosition :: Pulses3 -> Pulses3
mirroredPosition (Pulses3 x y z) = Pulses3 (negate x) y z

-- | Frame mirrored in x = 0: arcs change their sense.
mirroredFrame :: Frame -> Frame
mirroredFrame f =
  f
    { increment = mirroredPosition (increment f),
      centre = Pulses2 (negate i) j,
      motion = reversedMotion (motion f)
    }
  where
    Pulses2 i j = centre f
    reversedMotion m = case m of
      Circular Clockwise -> Circular CounterClockwise
      Circular CounterClockwise -> Circular Clockwise
      NoMotion -> NoMotion
      Rapid -> Rapid
      Linear -> Linear

-- | Straight frame with the feed code 60.
straightAt60 :: Pulses -> Pulses -> Frame
straightAt60 x y =
  (Frame.commandFrame []) {motion = Linear, increment = Pulses3 x y 0, feedCode = FeedCode 60}

-- | Machine of a description that has no errors.
machineOf :: FilePath -> IO Machine
machineOf file =
  readText file >>= maybe (fail "the description has errors") pure . Result.ifSound . FromText.read

knownTapes :: Spec
knownTapes = do
  it "5121: x, y, z and feed have 4, 4, 3 and 1 digits, signs and commands in the service track" $
    written lkp01f [straight (-1234) 56 (-7) 5 [(CommandName "aux", 5)]]
      `shouldBe` blank 25
        <> [0x11, 0x15, 0x06, 0x17]
        <> [0x00, 0x00, 0x08, 0x09]
        <> [0x10, 0x00, 0x0A]
        <> [0x18]
        <> blank 3
        <> blank 25
  it "5121: two blank rows precede every frame with an even number" $
    [k | (k, 0x11) <- zip [0 :: Int ..] (written lkp01f (replicate 3 (straight 1 0 0 1 [])))]
      `shouldBe` [25 + 11, 25 + 15 + 2 + 11, 25 + 15 + 17 + 11]
  it "ЛКИ-У: marker, motion, increments, centre, feed with the braking hole, check digit" $
    written lkiU [(straight 12 0 (-3) 40 []) {Frame.braking = True}]
      `shouldBe` blank 25
        <> [0x1F, 1]
        <> [0, 0, 0, 0, 1, 5]
        <> blank 6
        <> [0x10, 0, 0, 0, 0, 6]
        <> blank 12
        <> [0x17, 0]
        <> [0xF]
        <> blank 3
        <> blank 25
  it "БЦК-5: the frame that is printed in the source" $
    take
      14
      ( drop
          25
          (written kontur3p [(straight 0 6000 0 27 []) {commands = [(CommandName "spindle", 8)]}])
      )
      `shouldBe` [9, 18, 5, 6, 0, 0, 0, 21, 2, 7, 22, 0, 8, 16]
  it "ISO-7bit: X has holes 4 5 7 8, 3 has 1 2 5 6, + has 1 2 4 6" $
    [w | w <- written n55 [straight 3 0 0 60 []], w `elem` [0xD8, 0x33, 0x2B]]
      `shouldBe` [0xD8, 0x2B, 0x33]
  it "a text: positions in mm, each one when it changes and in the first frame that moves" $
    text
      iso6983
      (Pulses3 100 200 300)
      [ straight 5000 0 0 60 [],
        straight 0 (-200) 0 60 [],
        (straight 10 10 0 70 []) {motion = Circular Clockwise, centre = Pulses2 10 0},
        Frame.commandFrame [(CommandName "release", 0)]
      ]
      `shouldBe` [ "%",
                   "G21 G17 G90 G94 G40 G49 G80",
                   "G1 X5.100 Y0.200 F60",
                   "G1 Y0.000",
                   "G2 X5.110 Y0.010 I0.010 J0.000 F70",
                   "G40",
                   "%"
                 ]
  it "a tape has a length in metres, a text has none" $ do
    Tape.metres lkp01f (Tape (ByteString.replicate 1000 0)) `shouldBe` Just 2.54
    Tape.metres iso6983 (Tape (ByteString.replicate 1000 0)) `shouldBe` Nothing

-- | Frames that a reader may expect on a tape with the given frames: these, fewer, more, or others.
expectedFor :: [Frame] -> Gen [Frame]
expectedFor fs = do
  k <- choose (0, length fs)
  elements
    [ fs,
      fs,
      fs,
      take k fs,
      drop k fs,
      fs <> take 1 fs,
      [f {increment = increment f * sign k} | f <- fs]
    ]
  where
    sign k = if even k then Pulses3 1 1 0 else Pulses3 1 1 (-1)

oneHole :: Spec
oneHole = do
  it
    "is refused or gives frames that are written with this hole, on every machine (catches a \
    \reader that guesses)"
    $ [ (Machine.name m, place)
        | m <- machines,
          (place, t) <- Holes.changes m (tapeOf m),
          Right fs <- [Punch.read m start t],
          Punch.write m start fs /= t
      ]
      `shouldBe` []
  it
    "is refused wherever it is, on machines whose check digits have weights or whose rows have \
    \parity (catches two digits with the same weight)"
    $ [ (Machine.name m, Holes.unseen s)
        | m <- [kontur2p, kontur3p, n55],
          let s = Holes.share m start (journey m),
          Holes.found s /= Holes.tried s
      ]
      `shouldBe` []
  it
    "is refused on a tape with check digits if it is not in the service track (catches a check \
    \digit that is ignored)"
    $ [ (Machine.name m, row, track)
        | m <- [lkiU, lkiUn],
          (row, track) <- Holes.unseen (Holes.share m start (journey m)),
          track /= 5
      ]
      `shouldBe` []
  it
    "is reported in its frame or in the next one, which may depend on it (catches rows that are \
    \counted wrong)"
    $ [ (Machine.name m, place, d)
        | m <- machines,
          let lengths = frameRows m,
          (place@(row, _), t) <- Holes.changes m (tapeOf m),
          Left d <- [Punch.read m start t],
          Just n <- [frameAt lengths row],
          k <- [frameAt lengths (Punch.row d)],
          k /= Just n && k /= Just (n + 1)
      ]
      `shouldBe` []

-- | Frame of every row on the tape of a machine's journey.
frameRows :: Machine -> [Maybe Int]
frameRows m = map RowMeaning.frame (Punch.rows m start (journey m))

-- | Frame of a row, from 1.
frameAt :: [Maybe Int] -> Int -> Maybe Int
frameAt frames row = case drop (row - 1) frames of
  n : _ -> n
  [] -> Nothing

damage :: Spec
damage = do
  it
    "is reported on 5121: missing marker, hole in a gap, wrong digit, hole outside of the tracks, \
    \minus zero, missing feed"
    $ do
      let at = reasonAt lkp01f [straight 10 0 0 5 [], straight 1 2 3 5 []]
      at 37 (const 0x08) `shouldBe` Just MarkerMissing
      at 39 (const 1) `shouldBe` Just GapNotBlank
      at 31 (const 2) `shouldBe` Just (NoDigit 5 2)
      at 31 (const 0x30) `shouldBe` Just ForeignTrack
      at 31 (const 0x10) `shouldBe` Just ServiceHole
      at 30 (const 0x10) `shouldBe` Just MinusZero
      at 41 (const 1) `shouldBe` Just ShiftNotBlank
      at 37 (const 0x10) `shouldBe` Just MotionWithoutFeed
      at 28 (const 0) `shouldBe` Nothing
      at 3 (const 1) `shouldBe` Just (LeaderNotBlank 25)
  it "is reported on a tape with addresses: wrong check sum, wrong leading axis, wrong order" $ do
    let at = reasonAt kontur3p [straight 0 6000 0 27 []]
    at 26 (const 0) `shouldBe` Just (WrongSum 27 10)
    at 28 (const 6) `shouldBe` Just (WrongSum 31 10)
    faultOf kontur3p (blank 25 <> [4, 18, 1, 6, 0, 0, 0, 21, 2, 7, 16])
      `shouldBe` Just (WrongSum 27 10)
    faultOf kontur3p (blank 25 <> withCheckDigit [18, 1, 6, 0, 0, 0, 21, 2, 7, 16])
      `shouldBe` Just (WrongPriority 1 5)
    faultOf
      kontur3p
      (blank 25 <> withCheckDigit [18, 5, 6, 0, 0, 0, 17, 2, 1, 0, 0, 0, 21, 2, 7, 16])
      `shouldBe` Just (UnexpectedWord 'Е')
    faultOf kontur3p (blank 25 <> withCheckDigit [18, 5, 6, 0, 0, 0, 16])
      `shouldBe` Just MotionWithoutFeed
    faultOf kontur3p (blank 25 <> withCheckDigit [16]) `shouldBe` Just NoContent
  it
    "is reported in ISO-7bit: repeated feed, wrong frame number, unknown motion, wrong parity, \
    \missing sign"
    $ do
      faultLine "N001X+000001F0060" `shouldBe` Just IncrementWithoutMotion
      faultLine "N002G01X+000001F0060" `shouldBe` Just (WrongNumber 2 1)
      faultLine "N001G04X+000001F0060" `shouldBe` Just (UnknownMotion 4)
      faultLine "N001G01X+000001" `shouldBe` Just MotionWithoutFeed
      faultLine "N001G01X000001F0060" `shouldBe` Just NoSign
      faultLine "N001G01X-000000Y+000001F0060" `shouldBe` Just MinusZero
      faultLine "N001G01Y+000001X+000001F0060" `shouldBe` Just (UnexpectedWord 'X')
      faultLine "N001G01X+000001F0060\nN002G01X+000001F0060" `shouldBe` Just (FeedRepeated 60)
      faultLine "N001" `shouldBe` Just NoContent
      reasonAt n55 [straight 1 0 0 60 []] 30 (const 0x31) `shouldBe` Just BadParity
  it "is reported at the end: torn tape, trailer of a wrong length, missing closing symbols" $ do
    let rows = rowsOf (tapeOf lkp01f)
        lines' = rowsOf (tapeOf iso6983)
        reasonOf m = either (Just . Punch.reason) (const Nothing) . Punch.read m start . Tape
    reasonOf lkp01f (ByteString.take 60 rows) `shouldBe` Just CutOff
    reasonOf lkp01f (rows <> "\0") `shouldBe` Just (TrailerLength 26 25)
    reasonOf lkp01f "" `shouldBe` Just (NoFrames 25)
    reasonOf n55 "" `shouldBe` Just (NoFrames 25)
    either
      (\d -> Just (Punch.row d, Punch.reason d))
      (const Nothing)
      (Punch.read iso6983 start (Tape ""))
      `shouldBe` Just (1, NoFrames 0)
    reasonOf iso6983 (ByteString.take (ByteString.length lines' - 2) lines')
      `shouldBe` Just (MissingClosing "%\n")
  it "is not reported for blank and erased rows between frames, on media that skip them" $ do
    let spread m w = ByteString.concatMap (\r -> ByteString.pack [r, w]) (rowsOf (tapeOf m))
        (front, afterLeader) = ByteString.splitAt 25 (rowsOf (tapeOf lkiU))
    Punch.read n55 start (Tape (spread n55 0xFF)) `shouldBe` Right (journey n55)
    Punch.read n55 start (Tape (spread n55 0)) `shouldBe` Right (journey n55)
    Punch.read
      lkiU
      start
      (Tape (front <> ByteString.replicate 7 0 <> afterLeader <> ByteString.replicate 7 0))
      `shouldBe` Right (journey lkiU)
  it "is reported with its row, its frame and its word" $
    Report.title
      (Punch.toReport (Damage 31 (Just 1) (Just (Machine.Along Machine.Y)) (NoDigit 5 2)))
      `shouldBe` "row 31 (frame 1, y): the holes 00010 are not a digit"

-- | Frame with a check digit before it.
withCheckDigit :: [Word8] -> [Word8]
withCheckDigit ws =
  fromIntegral ((10 - sum (map ((`mod` 16) . fromIntegral) ws :: [Int]) `mod` 10) `mod` 10) : ws

-- | Reason why a tape with these rows before its trailer is refused.
faultOf :: Machine -> [Word8] -> Maybe Reason
faultOf m rows =
  either
    (Just . Punch.reason)
    (const Nothing)
    (Punch.read m start (Tape (ByteString.pack (rows <> blank 28))))

-- | Reason why a tape with these lines is refused.
faultLine :: Text.Text -> Maybe Reason
faultLine lines' =
  faultOf
    n55
    (blank 25 <> map even' (ByteString.unpack (Encoding.encodeUtf8 ("%\n" <> lines' <> "\n"))))
  where
    even' w =
      if odd (length [() | k <- [0 .. 6 :: Int], w `div` (2 ^ k) `mod` 2 == 1]) then w + 128 else w

-- | Straight frame with its increments in pulses, its feed code and its commands.
straight :: Int -> Int -> Int -> Int -> [(CommandName, Int)] -> Frame
straight x y z s given =
  Frame
    { motion = Linear,
      increment = Pulses3 (Pulses x) (Pulses y) (Pulses z),
      turn = 0,
      centre = 0,
      feedCode = FeedCode s,
      braking = False,
      commands = given
    }

-- | Tape of the machine's 'journey'.
tapeOf :: Machine -> Tape
tapeOf m = Punch.write m start (journey m)

rowsOf :: Tape -> ByteString
rowsOf (Tape rows) = rows

-- | Rows of the whole tape of some frames.
written :: Machine -> [Frame] -> [Word8]
written m fs = ByteString.unpack (rowsOf (Punch.write m start fs))

-- | Lines of the text of some frames, for a machine whose tape is a text.
text :: Machine -> Pulses3 -> [Frame] -> [Text.Text]
text m at fs = Text.lines (Encoding.decodeUtf8 (rowsOf (Punch.write m at fs)))

-- | @n@ blank rows.
blank :: Int -> [Word8]
blank n = replicate n 0

-- | Rows with row @n@, from 1, changed.
changed :: Int -> (Word8 -> Word8) -> ByteString -> ByteString
changed n f rows = case ByteString.splitAt (n - 1) rows of
  (a, b) -> case ByteString.uncons b of
    Just (w, c) -> a <> ByteString.cons (f w) c
    Nothing -> rows

-- | Reason why a tape with one changed row, counted from 1, is refused. The report has to name this
-- row; a wrong check sum or a missing feed may be reported at another one.
reasonAt :: Machine -> [Frame] -> Int -> (Word8 -> Word8) -> Maybe Reason
reasonAt m fs n f =
  case Punch.read m start (Tape (changed n f (rowsOf (Punch.write m start fs)))) of
    Left d | Punch.row d == n || isSum (Punch.reason d) -> Just (Punch.reason d)
    _ -> Nothing
  where
    isSum r = case r of
      WrongSum _ _ -> True
      MotionWithoutFeed -> True
      _ -> False
