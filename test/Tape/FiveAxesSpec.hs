-- | Tapes for n55 that turn its rotary axes: the example, and lines with mistakes.
module Tape.FiveAxesSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (LengthUnit (..), Mm (..))
import Base.Region qualified as Region
import Cli.FrameTable qualified as FrameTable
import Data.Bits (popCount)
import Data.ByteString qualified as ByteString
import Data.Either (fromRight)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Frame.Frame
  ( Frame (..),
    FrameMotion (..),
    FrameProgram (..),
    PlannedFrame (..),
    Role (..),
    Violation (NoSuchMotion),
  )
import Frame.Frame qualified as Frame
import Machine.Machine (FeedCode (..))
import Machines (lkp01f, n55)
import Tape.Punch (Reason (..))
import Tape.Punch qualified as Punch
import Tape.RowMeaning qualified as RowMeaning
import Tape.Tape (Tape (..))
import Test.Hspec

spec :: Spec
spec = do
  describe "examples/cone.n55.tape" $ do
    tape <- runIO (Tape <$> ByteString.readFile "examples/cone.n55.tape")
    let frames = fromRight [] (Punch.read n55 0 tape)
    it "has the five increments of frame 5 (catches an axis that is lost)" $
      [(motion f, increment f, turn f, feedCode f) | f <- take 1 (drop 4 frames)]
        `shouldBe` [(Linear, Pulses3 948 (-442) (-50), Pulses2 (-592) (-1268), FeedCode 120)]
    it "ends where it begins, on all five axes" $
      (length frames, sum (map increment frames), sum (map turn frames)) `shouldBe` (14, 0, 0)
    it "is punched from its frames, row by row" $
      Punch.write n55 0 frames `shouldBe` tape
    it "has rows for a and b with their meaning" $
      [ RowMeaning.meaning r
        | r <- Punch.rows n55 0 frames,
          RowMeaning.frame r == Just 3,
          Text.take 1 (RowMeaning.meaning r) `elem` ["a", "b"],
          not ("always" `Text.isPrefixOf` RowMeaning.meaning r)
      ]
        `shouldBe` [ "a, address ‘A’",
                     "a, minus",
                     "a hundred thousands 0",
                     "a ten thousands 0",
                     "a thousands 6",
                     "a hundreds 9",
                     "a tens 2",
                     "a units 3",
                     "b, address ‘B’",
                     "b, plus",
                     "b hundred thousands 0",
                     "b ten thousands 0",
                     "b thousands 4",
                     "b hundreds 0",
                     "b tens 2",
                     "b units 0"
                   ]
    it "has columns for a and b in the table of its frames" $
      map Text.words (take 6 (Text.lines (FrameTable.decoded n55 frames)))
        `shouldSatisfy` \rows ->
          take 1 rows == [Text.words "frame motion dx dy dz da db speed mm/min S M"]
            && drop 5 rows == [Text.words "5 line 948 -442 -50 -592 -1268 120 120"]
  it "tables and JSON name a and b only where they belong (catches columns of other machines)" $ do
    let json machine = FrameTable.framesJson machine source (planned [moved])
        table machine = Text.words (FrameTable.frames Millimetres machine source (planned [moved]))
    ("\"turn\":{\"a\":0,\"b\":0}" `Text.isInfixOf` json n55) `shouldBe` True
    ("turn" `Text.isInfixOf` json lkp01f) `shouldBe` False
    [w | machine <- [n55, lkp01f], w <- table machine, w `elem` ["da", "db"]] `shouldBe` []
    ( "da"
        `elem` Text.words
          (FrameTable.frames Millimetres n55 source (planned [moved {turn = Pulses2 1 0}]))
      )
      `shouldBe` True
  it "a line with a wrong turn is refused, with its reason (catches a reader that guesses)" $ do
    reasonOf "N001A+000001F0060" `shouldBe` Just IncrementWithoutMotion
    reasonOf "N001G01A+000000F0060" `shouldBe` Just MotionWithoutIncrement
    reasonOf "N001G01B+000001A+000001F0060" `shouldBe` Just (UnexpectedWord 'A')
    reasonOf "N001G01A+000001X+000001F0060" `shouldBe` Just (UnexpectedWord 'X')
    reasonOf "N001G01X+000001A+000000F0060"
      `shouldBe` Just (WrittenOtherwise "feed, address ‘F’")
    reasonOf "N001G01A-000000F0060" `shouldBe` Just MinusZero
    reasonOf "N001G01A000001F0060" `shouldBe` Just NoSign
    reasonOf "N001G02X+000100Y+000100A+000001I+000100J+000000F0060"
      `shouldBe` Just (BrokenRule (NoSuchMotion 1))
    reasonOf "N001G00A+000001" `shouldBe` Nothing
    reasonOf "N001G01Z-000001A+000001B-000001F0060M08" `shouldBe` Nothing
  where
    source = Region.fromText "p.part" "part p\n"
    moved =
      (Frame.commandFrame [])
        { motion = Linear,
          increment = Pulses3 1 2 0,
          feedCode = FeedCode 5
        }
    planned fs =
      FrameProgram
        0
        [ PlannedFrame
            { frame = f,
              role = Linking,
              origin = Region.Region 0 0,
              cutterRadius = Mm 0,
              toolIndex = 0
            }
          | f <- fs
        ]

-- | Reason why a tape for n55 with this line is refused.
reasonOf :: Text -> Maybe Reason
reasonOf line =
  either
    (Just . Punch.reason)
    (const Nothing)
    (Punch.read n55 0 (Tape (blank <> rows <> blank)))
  where
    blank = ByteString.replicate 25 0
    rows = ByteString.map even' (Encoding.encodeUtf8 ("%\n" <> line <> "\n"))
    even' w = if odd (popCount w) then w + 128 else w
