-- | The tape's code and layout: written and read back, and damaged in every possible way.
module Tape.PunchSpec (spec) where

import Data.Bits (complementBit)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Either (isLeft)
import Data.Word (Word8)
import Flange qualified
import Frame.Frame (Frame (..))
import Generate qualified
import Linear.V3 (V3 (..))
import Machine.Code5121 (code5121)
import Machine.Lkp01f (lkp01f)
import Machine.Machine (DigitCode (..), FeedCode (..))
import Tape.Layout (Fault (Fault), Reason (..))
import Tape.Layout qualified as Layout
import Tape.Punch (Cause (..), Damage (..))
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it "the code 5121 is Table 6 of the paper, with 0000 for 0" $
    digitWords code5121 `shouldBe` [0x0, 0x1, 0x5, 0x6, 0x7, 0x8, 0x9, 0xA, 0xB, 0xF]
  it "a frame is punched hole by hole as the page of the machine says" $
    let Tape rows = Punch.write lkp01f [Frame (V3 (-1234) 56 (-7)) (FeedCode 5) 5]
     in ByteString.unpack rows `shouldBe` blank 25 <> [0x11, 0x15, 0x06, 0x17] <> [0x00, 0x00, 0x08, 0x09] <> [0x10, 0x00, 0x0A] <> [0x18] <> blank 3 <> blank 25
  it "two blank rows stand before every even frame" $
    let f = Frame (V3 1 0 0) (FeedCode 1) 0
        Tape rows = Punch.write lkp01f [f, f, f]
     in [k | (k, 0x11) <- zip [0 :: Int ..] (ByteString.unpack rows)] `shouldBe` [25 + 11, 25 + 15 + 2 + 11, 25 + 15 + 17 + 11]
  it "decode after encode gives the frames (catches a field that writer and reader see differently)" $
    property $
      forAll (Generate.frames lkp01f) $ \fs -> Punch.read lkp01f (Punch.write lkp01f fs) === Right fs
  describe "damage to the flange's tape" $ do
    it "every hole more or less is reported, or gives a frame that encodes to just that tape (catches a reader that guesses)" $
      let accepted = [(row, bit) | (row, bit, t) <- singleErrors Flange.tape, Right fs <- [Punch.read lkp01f t], Punch.write lkp01f fs /= t]
       in accepted `shouldBe` []
    it "a report names the row that was changed, or the speed's row of its frame" $
      let wrong = [(row, bit, d) | (row, bit, t) <- singleErrors Flange.tape, Left d <- [Punch.read lkp01f t], not (blames row d)]
       in wrong `shouldBe` []
    it "a lost marker, a hole in a gap, a digit that is none, a foreign track each have their reason" $ do
      reasonAt (firstFrame + 12) (`complementBit` 4) `shouldBe` Just MarkerMissing
      reasonAt (firstFrame + 14) (const 1) `shouldBe` Just NotBlank
      reasonAt (firstFrame + 6) (const 2) `shouldBe` Just (NoDigit 2)
      reasonAt (firstFrame + 6) (const 0x30) `shouldBe` Just ForeignTrack
      reasonAt (firstFrame + 1) (const 0x10) `shouldBe` Just MinusZero
      reasonAt (firstFrame + 7) (const 0x10) `shouldBe` Just ServiceHole
    it "a tape that is cut anywhere is reported (catches an end that is taken for granted)" $
      [k | k <- [0 .. ByteString.length flangeRows - 1], not (isLeft (Punch.read lkp01f (Tape (ByteString.take k flangeRows))))] `shouldBe` []
    it "a row lost or doubled anywhere but among blank rows is reported" $
      [ k
        | k <- [0 .. ByteString.length flangeRows - 1],
          ByteString.index flangeRows k /= 0,
          change <- [ByteString.take k flangeRows <> ByteString.drop (k + 1) flangeRows, ByteString.take (k + 1) flangeRows <> ByteString.drop k flangeRows],
          not (isLeft (Punch.read lkp01f (Tape change)))
      ]
        `shouldBe` []

flangeRows :: ByteString
flangeRows = let Tape rows = Flange.tape in rows

-- | Rows before the first frame.
firstFrame :: Int
firstFrame = 25

blank :: Int -> [Word8]
blank n = replicate n 0

-- | Every tape that differs in one hole, with its row from 1 and the bit.
singleErrors :: Tape -> [(Int, Int, Tape)]
singleErrors (Tape rows) = [(k + 1, bit, Tape (changed k (`complementBit` bit) rows)) | k <- [0 .. ByteString.length rows - 1], bit <- [0 .. 5]]

changed :: Int -> (Word8 -> Word8) -> ByteString -> ByteString
changed k f rows = case ByteString.splitAt k rows of
  (a, b) -> case ByteString.uncons b of
    Just (w, c) -> a <> ByteString.cons (f w) c
    Nothing -> rows

-- | The reason that is reported when a row, from 1, is changed.
reasonAt :: Int -> (Word8 -> Word8) -> Maybe Reason
reasonAt n f = case Punch.read lkp01f (Tape (changed (n - 1) f flangeRows)) of
  Left (Damage at _ (InFrame fault)) | at == n -> Just (Layout.reason fault)
  _ -> Nothing

-- | The row itself; the first row of the number for a minus; the speed's row where a frame's
-- fields no longer agree; the end of the tape for a hole in the trailer.
blames :: Int -> Damage -> Bool
blames changedRow (Damage at _ cause) = case cause of
  InFrame (Fault _ _ r) -> case r of
    SpeedWithoutMove _ -> at >= changedRow && at - changedRow < 12
    MoveWithoutSpeed -> at >= changedRow && at - changedRow < 12
    IdleFrame -> at >= changedRow && at - changedRow < 12
    MinusZero -> abs (at - changedRow) < 4
    _ -> at == changedRow || inTrailer
  CutOff -> inTrailer
  _ -> at == changedRow || inTrailer
  where
    inTrailer = changedRow > ByteString.length flangeRows - 25
