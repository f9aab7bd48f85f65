-- | Laws of the drawing of feed and frequencies.
module Draw.SpeedPlotSpec (spec) where

import Base.LazyList qualified as LazyList
import Cli.RunTable qualified as RunTable
import Data.ByteString qualified as ByteString
import Data.List (isSubsequenceOf)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.SpeedPlot qualified as SpeedPlot
import Draw.TimeColumn (TimeColumns)
import Generate.RunFrames qualified as Generate
import Machine.Machine (Machine)
import Machines (lkiU, n55)
import Pulse.Controller qualified as Controller
import Pulse.RunMeasure qualified as Measure
import SvgText qualified
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "the drawing of a run" $ do
  it "has the feeds that are measured (catches a mean in place of the highest feed)" $
    forAll ((,) lkiU <$> Generate.framesOf lkiU 4) $ \(machine, fs) ->
      let tape = Punch.write machine 0 fs
          measures =
            maybe [] LazyList.toList (Controller.measured machine Controller.neutral 0 tape)
          feeds = [(least, most) | Just (_, least, most) <- map Measure.feeds measures]
       in fmap SpeedPlot.feedRange (columnsOf (const True) machine tape)
            === Just (Just (minimum (map fst feeds), maximum (map snd feeds)))
  it "numbers every frame once if there is room, and no other" $ do
    tape <- Tape <$> ByteString.readFile "examples/cone.n55.tape"
    numbersOf (drawn (\n -> n >= 3 && n <= 12) n55 tape)
      `shouldBe` map (Text.pack . show) [3 .. 12 :: Int]
  it "numbers frames in their order, the first one always (catches numbers without room)" $
    forAll (Generate.framesOf n55 40) $ \fs ->
      let numbers = numbersOf (drawn (const True) n55 (Punch.write n55 0 fs))
          whole = map (Text.pack . show) [1 .. length fs]
       in counterexample (show numbers) $
            take 1 numbers == ["1"] && numbers `isSubsequenceOf` whole
  it "does not grow with the tape (catches columns without end)" $
    withMaxSuccess 3 . forAll (Generate.framesOf n55 20) $ \fs ->
      let size k = Text.length (drawn (const True) n55 (tapeOf (concat (replicate k fs))))
          tapeOf = Punch.write n55 0
       in counterexample (show (size 1, size 50)) (size 1 < 700000 && size 50 < 700000)
  it "is well-formed whatever the name of the tape is (catches a name that is taken as tags)" $
    forAll Generate.runFrames $ \(machine, fs) ->
      SvgText.isWellFormed (drawn (const True) machine (Punch.write machine 0 fs))
  where
    numbersOf = filter (/= "frame") . SvgText.texts . SvgText.layer "frames"

-- | Columns of a tape; Nothing if the machine makes no pulses.
columnsOf :: (Int -> Bool) -> Machine -> Tape -> Maybe TimeColumns
columnsOf isShown machine tape =
  fst . SpeedPlot.columns machine (clockOf machine) isShown
    <$> Controller.run machine Controller.neutral 0 tape

-- | Drawing of a tape.
drawn :: (Int -> Bool) -> Machine -> Tape -> Text
drawn isShown machine tape =
  maybe
    ""
    (SpeedPlot.plot machine (RunTable.axisNames machine) (clockOf machine) "a & b <c>")
    (columnsOf isShown machine tape)

clockOf :: Machine -> Int
clockOf = fromMaybe 1 . Controller.ticksPerSecond
