-- | Laws of the samples of a run: they are what is measured, and cover all of its time.
module Pulse.RunSampleSpec
  ( spec,
  )
where

import Base.LazyList qualified as LazyList
import Data.List (sortOn)
import Data.Maybe (fromMaybe)
import Frame.Frame (Frame)
import Generate.RunFrames qualified as Generate
import Machine.Machine (Machine)
import Pulse.Controller qualified as Controller
import Pulse.RunMeasure (FrameMeasure)
import Pulse.RunMeasure qualified as Measure
import Pulse.RunSample (RunSample (..), SampleKind (..))
import Pulse.RunSample qualified as RunSample
import Pulse.Steps qualified as Steps
import Tape.Punch qualified as Punch
import Test.Hspec
import Test.QuickCheck hiding (within)

spec :: Spec
spec = describe "samples of a run" $ do
  it "have the feeds that are measured in their frames (catches the feed of another window)" $
    forAll Generate.runFrames $ \(machine, fs) ->
      let (found, measures) = both machine fs
       in conjoin
            [ counterexample (show (Measure.number m, Measure.feeds m, within m found)) $
                case (Measure.feeds m, map value (filter isFeed (within m found))) of
                  (Just (_, least, most), vs@(_ : _)) -> (minimum vs, maximum vs) === (least, most)
                  (Nothing, []) -> property True
                  _ -> property False
              | m <- measures
            ]
  it "cover every frame without a gap (catches a frame whose end has no sample)" $
    forAll Generate.runFrames $ \(machine, fs) ->
      let (found, measures) = both machine fs
       in conjoin
            [ counterexample (show (Measure.number m, name, ofKind)) $
                isChain (Measure.beginsAt m) (Measure.endsAt m) (sortOn from ofKind)
              | m <- measures,
                (name, isWanted) <-
                  ("feed", isFeed) : [(show k, isAxis k) | k <- [0 .. 4 :: Int]],
                let ofKind = filter isWanted (within m found)
            ]
  it "have frequencies that add up to the pulses (catches a frequency without its sign)" $
    forAll Generate.runFrames $ \(machine, fs) ->
      let (found, measures) = both machine fs
          clock = clockOf machine
          positions = map (Steps.toList . Measure.positionAfter) measures
       in conjoin
            [ counterexample (show (Measure.number m, k, made, sum')) (abs (sum' - made) <= 3)
              | (m, start, end) <- zip3 measures (replicate 5 0 : positions) positions,
                (k, a, b) <- zip3 [0 ..] start end,
                let made = fromIntegral (b - a) :: Double,
                let sum' =
                      sum
                        [ value s * fromIntegral (to s - from s) / fromIntegral clock
                          | s <- within m found,
                            isAxis k s
                        ]
            ]
  it "are those of the frames that are shown" $
    forAll Generate.runFrames $ \(machine, fs) ->
      let isShown n = n == 2 || n == 3
       in [ round (value s) :: Int
            | s <- samplesOf isShown machine fs,
              kind s == FrameNumber
          ]
            === filter isShown (map Measure.number (snd (both machine fs)))

-- | Samples and measures of frames.
both :: Machine -> [Frame] -> ([RunSample], [FrameMeasure])
both machine fs = (samplesOf (const True) machine fs, measures)
  where
    tape = Punch.write machine 0 fs
    measures = maybe [] LazyList.toList (Controller.measured machine Controller.neutral 0 tape)

samplesOf :: (Int -> Bool) -> Machine -> [Frame] -> [RunSample]
samplesOf isShown machine fs =
  maybe
    []
    (LazyList.toList . RunSample.samples machine (clockOf machine) isShown)
    (Controller.run machine Controller.neutral 0 (Punch.write machine 0 fs))

clockOf :: Machine -> Int
clockOf = fromMaybe 1 . Controller.ticksPerSecond

-- | Samples within the time of a frame.
within :: FrameMeasure -> [RunSample] -> [RunSample]
within m = filter (\s -> from s >= Measure.beginsAt m && to s <= Measure.endsAt m && from s < to s)

isFeed :: RunSample -> Bool
isFeed s = kind s `elem` [FeedMeasured, TurningMeasured]

isAxis :: Int -> RunSample -> Bool
isAxis k s = kind s == AxisFrequency k

-- | True if samples follow one another from a tick to another.
isChain :: Int -> Int -> [RunSample] -> Bool
isChain a b list = case list of
  [] -> a == b
  s : more -> from s == a && isChain (to s) b more
