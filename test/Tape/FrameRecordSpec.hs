-- | Records of frames: those that the sources print, and those of the built-in machines.
module Tape.FrameRecordSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Control.Monad (forM_)
import Data.Map.Strict qualified as Map
import Data.Maybe (isNothing, mapMaybe)
import Data.Text qualified as Text
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Generate.Machine qualified as Generate
import Geometry.Carrier (Sense (..))
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (CommandName (..), FeedCode (..), Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Machines (kontur2p, kontur3p, lkiFm, lkiU, lkiUn, lkp01f, n55)
import Tape.FrameRecord (RecordObstacle (..))
import Tape.FrameRecord qualified as FrameRecord
import Tape.Layout (RowKind (Blank))
import Tape.Punch qualified as Punch
import Tape.RowMeaning qualified as RowMeaning
import Tape.Symbol qualified as Symbol
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "the record of a frame" $ do
  it "is that of the NC course for the first frames of its shaft" $
    FrameRecord.records
      kontur3p
      0
      [ (moved 0 6000 27) {commands = [(CommandName "spindle", 8)]},
        moved (-4200) 0 32
      ]
      `shouldBe` ["9Д56000П27Ш08Н", "7Е64200П32Н"]
  -- The digits and the letters add to 1+6+3+0+0+0 + 2+1+1+5+0+0 + 5+3+2 + 0 = 29, so the check
  -- digit is 1.
  it "has the digits of the leading axis and of the following one (catches exchanged digits)" $
    FrameRecord.records kontur2p 0 [moved (-3000) 1500 32] `shouldBe` ["1Е63000Д11500П32Н"]
  it "has the words of ISO-7bit on the Н55-2Л, without the end of the line" $
    FrameRecord.records
      n55
      0
      [ (moved 0 2000 0) {motion = Rapid},
        moved 1637 111 60,
        (moved (-1144) 1980 60) {motion = Circular Clockwise, centre = Pulses2 742 1749},
        Frame.commandFrame [(CommandName "M", 2)]
      ]
      `shouldBe` [ "N001G00Y+002000",
                   "N002G01X+001637Y+000111F0060",
                   "N003G02X-001144Y+001980I+000742J+001749",
                   "N004M02"
                 ]
  it "exists on the machines whose words have letters" $
    [n | m <- BuiltIn.machines, let MachineName n = Machine.name m, isRecorded m]
      `shouldBe` ["iso6983", "kontur-2p", "kontur-3p", "n55"]
  it "does not exist where the place of a word gives its meaning" $
    map FrameRecord.obstacle [lkp01f, lkiFm, lkiU, lkiUn]
      `shouldBe` replicate 4 (Just NoAddress)
  it "does not exist for the files of modern controls" $
    forM_ ["grbl", "linuxcnc-mill", "fanuc"] $ \n ->
      fmap FrameRecord.obstacle (BuiltIn.find (MachineName n)) `shouldBe` Just (Just LinesOfFile)
  it
    "has a symbol for each row of the frame on the tape (catches a frame that begins in another \
    \state than on the tape)"
    $ property $
      forAll Generate.machine $ \m ->
        isRecorded m
          ==> forAll (Generate.frames m)
          $ \(start, fs) ->
            let rowOf = Symbol.rowOf (Symbol.fromMachine m)
                isLineEnd c = c == '\n' || c == '\r'
                rowsOf n =
                  [ RowMeaning.holes r
                    | r <- Punch.rows m start fs,
                      RowMeaning.frame r == Just n,
                      not (isBlank (RowMeaning.kind r)),
                      not (maybe False isLineEnd (RowMeaning.symbol r))
                  ]
                isBlank kind = case kind of
                  Blank _ -> True
                  _ -> False
             in map (mapMaybe (`Map.lookup` rowOf) . Text.unpack) (FrameRecord.records m start fs)
                  === map rowsOf [1 .. length fs]

-- | A straight frame with these increments and this feed code.
moved :: Int -> Int -> Int -> Frame
moved x y code =
  (Frame.commandFrame [])
    { motion = Linear,
      increment = Pulses3 (Pulses x) (Pulses y) 0,
      feedCode = FeedCode code
    }

isRecorded :: Machine -> Bool
isRecorded = isNothing . FrameRecord.obstacle
