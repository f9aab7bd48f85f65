module Preview.PlaybackSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..))
import Command (inFolder, partc)
import Control.Monad (forM_)
import Data.Aeson (FromJSON (parseJSON), Value (Null), decode, withObject, (.:))
import Data.Bits (shiftR, xor, (.&.))
import Data.ByteString qualified as ByteString
import Data.ByteString.Lazy.Char8 qualified as Lines
import Data.Containers.ListUtils (nubOrd)
import Data.List (foldl')
import Data.Maybe (mapMaybe)
import Data.Text qualified as Text
import Files (readText)
import Machine.Machine qualified as Machine
import Preview.Answer qualified as Answer
import Preview.Drawing qualified as Drawing
import Preview.Playback qualified as Playback
import Preview.PulseColumns qualified as PulseColumns
import Preview.TapeMeaning qualified as TapeMeaning
import Preview.TapeRun qualified as TapeRun
import System.FilePath ((</>))
import Tape.Tape (Tape (Tape))
import Test.Hspec

spec :: Spec
spec = do
  describe "the answer `pulses`" $
    forM_ ["lkp-01f", "lki-un", "n55", "kontur-2p"] $ \machine ->
      it ("has the pulses of `partc run` on " <> machine) $ do
        followed <- Answer.followedFile file
        run <- Answer.running (Text.pack machine) followed
        again <- Answer.running (Text.pack machine) followed
        let answer = Answer.decode (PulseColumns.container 1 run again)
            ticks = map round (Answer.reals "pulseTick" answer)
            sent = zip ticks (Answer.wholes "pulseSteps" answer)
        (_, printed, _) <- partc ["run", file, "-t", machine, "--pulses"]
        concatMap shown sent `shouldBe` lines printed
  describe "the answer `run`" $ do
    forM_ ["lkp-01f", "lki-un", "n55", "kontur-2p", "iso6983"] $ \machine ->
      it ("has the frames, the times and the feeds of `partc run` on " <> machine) $ do
        followed <- Answer.followedFile file
        run <- Answer.running (Text.pack machine) followed
        let answer = Answer.decode (Playback.runContainer followed run [])
            clock = Answer.member "clock" answer :: Double
            ticks = triples (Answer.reals "frameTick" answer)
        (_, printed, _) <- partc ["run", file, "-t", machine, "--json"]
        let frames = mapMaybe (decode . Lines.pack) (lines printed) :: [FrameLine]
        length (Answer.wholes "frameNumber" answer) `shouldBe` length frames
        map (\(a, b, _) -> (a / clock, b / clock)) ticks
          `shouldBe` map (\f -> (begins f, ends f)) frames
    it "joins the frames: each begins where the one before ends" $ do
      followed <- Answer.followedFile file
      run <- Answer.running "n55" followed
      let answer = Answer.decode (Playback.runContainer followed run [])
          motions = nines (Answer.reals "frame" answer)
          startOf m = (head m, m !! 1, m !! 7)
          endOf m = (m !! 2, m !! 3, m !! 8)
      map startOf (drop 1 motions) `shouldBe` map endOf (init motions)
    it "reaches with the pulses of each frame the end of the frame" $ do
      followed <- Answer.followedFile file
      run <- Answer.running "lki-un" followed
      let answer = Answer.decode (Playback.runContainer followed run [])
          pulses = Answer.decode (PulseColumns.container 1 run run)
          firsts = Answer.wholes "framePulse" pulses
          steps = Answer.wholes "pulseSteps" pulses
          Mm size = Machine.planeResolution (TapeRun.machine run)
      forM_ (zip3 (nines (Answer.reals "frame" answer)) firsts (drop 1 firsts)) $ \(m, a, b) -> do
        let (x, y) = foldl' moved (0, 0) (take (b - a) (drop a steps))
        (head m + size * fromIntegral x) `shouldBeNear` (m !! 2)
        (m !! 1 + size * fromIntegral y) `shouldBeNear` (m !! 3)
    it "gives each frame the line that asks for it" $ do
      followed <- Answer.followedFile file
      run <- Answer.running "n55" followed
      let answer = Answer.decode (Playback.runContainer followed run [])
          infos = fives (Answer.wholes "frameInfo" answer)
      take 4 [i !! 3 | i <- infos] `shouldBe` [26, 25, 19, 19]
      map head infos `shouldBe` [0, 1] <> replicate 18 2 <> [1, 0, 3]
    forM_ ["linuxcnc-mill", "iso6983"] $ \machine -> it ("has lines: " <> Text.unpack machine) $ do
      followed <- Answer.followedFile "examples/cnc/cover.part"
      run <- Answer.running machine followed
      let answer = Answer.decode (Playback.runContainer followed run [])
          text = Text.lines (Answer.member "text" answer)
          rows = pairs (Answer.wholes "frameRow" answer)
      length rows `shouldSatisfy` (> 10)
      forM_ rows $ \(a, b) -> do
        b `shouldBe` a + 1
        (text !! a) `shouldSatisfy` Text.any (`elem` ("GMTXYZIJ" :: String))
    it "gives the file that partc compile writes" $
      inFolder $ \folder -> do
        followed <- Answer.followedFile cover
        run <- Answer.running "linuxcnc-mill" followed
        let answer = Answer.decode (Playback.runContainer followed run [])
        _ <- partc ["compile", cover, "-t", "linuxcnc-mill", "-o", folder </> "cover.ngc"]
        written <- readText (folder </> "cover.ngc")
        (Answer.member "text" answer == written) `shouldBe` True
    it "gives each frame the tool that makes it" $ do
      followed <- Answer.followedFile cover
      run <- Answer.running "linuxcnc-mill" followed
      let answer = Answer.decode (Playback.runContainer followed run [])
          cuts = [(tool, line) | [2, tool, _, line, _] <- fives (Answer.wholes "frameInfo" answer)]
          drawn = Answer.decode (Drawing.container False followed)
          moves = [(tool, line) | [2, tool, _, line, _] <- fives (Answer.wholes "moveInfo" drawn)]
      nubOrd (map fst cuts) `shouldBe` [0, 1]
      [c | c <- nubOrd cuts, c `notElem` moves] `shouldBe` []
    it "says why a damaged tape stops" $ do
      followed <- Answer.followedFile file
      run <- Answer.running "n55" followed
      let Tape bytes = TapeRun.rows run
          damaged = run {TapeRun.rows = Tape (ByteString.map (xor 1) bytes)}
          answer = Answer.decode (Playback.runContainer followed damaged [])
      length (Answer.member "reports" answer :: [Value]) `shouldBe` 1
  describe "the answer `rows`" $
    it "gives every row of the tape a meaning" $ do
      followed <- Answer.followedFile file
      run <- Answer.running "n55" followed
      length (TapeMeaning.rowList run 0 500) `shouldBe` 500
      TapeMeaning.rowList run 750 800 `shouldSatisfy` ((== 3) . length)
      TapeMeaning.rowList run 0 1 `shouldNotBe` [Null]
  where
    file = "examples/flange.part"
    cover = "examples/cnc/cover.part"

shouldBeNear :: Double -> Double -> Expectation
shouldBeNear a b = abs (a - b) `shouldSatisfy` (< 1e-9)

-- | Times of a frame as `partc run --json` writes them.
data FrameLine = FrameLine {begins :: Double, ends :: Double}

instance FromJSON FrameLine where
  parseJSON = withObject "frame" (\o -> FrameLine <$> o .: "begins" <*> o .: "ends")

-- | Lines of `partc run --pulses` for a group of pulses.
shown :: (Int, Int) -> [String]
shown (tick, steps) =
  [ [axis, ' ', sign, ' '] <> show tick
    | (k, axis) <- zip [0 ..] "xyzab",
      (bit, sign) <- [(2 * k, '+'), (2 * k + 1, '-')],
      (steps `shiftR` bit) .&. 1 == 1
  ]

-- | Position in pulses along x and y after a group of pulses.
moved :: (Int, Int) -> Int -> (Int, Int)
moved (x, y) steps = (x + bit 0 - bit 1, y + bit 2 - bit 3)
  where
    bit k = (steps `shiftR` k) .&. 1

nines :: [a] -> [[a]]
nines = groupsOf 9

fives :: [a] -> [[a]]
fives = groupsOf 5

pairs :: [a] -> [(a, a)]
pairs list = [(a, b) | [a, b] <- groupsOf 2 list]

triples :: [a] -> [(a, a, a)]
triples list = [(a, b, c) | [a, b, c] <- groupsOf 3 list]

groupsOf :: Int -> [a] -> [[a]]
groupsOf n list = case splitAt n list of
  ([], _) -> []
  (group, more) -> group : groupsOf n more
