-- | Laws of the drawing of a dispatcher's timeline.
module Draw.TimelineSpec (spec) where

import Data.List (sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.Timeline qualified as Timeline
import Generate.RunFrames qualified as Generate
import Machine.Controller (Controller (..), IntegratorControl)
import Machine.Machine qualified as Machine
import Machines (n55)
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (JobRun (beganAt, endedAt))
import Pulse.JobTimeline (JobTimeline (..), TickRange (..), Tooth (..))
import Pulse.JobTimeline qualified as JobTimeline
import SvgText qualified
import Tape.Punch qualified as Punch
import Test.Hspec
import Test.QuickCheck
import Text.Read (readMaybe)

spec :: Spec
spec = describe "the drawing of a timeline" $ do
  it "has bars that never overlap (catches a bar that is drawn too long)" $
    forAllShow timelines rangeOf $ \found ->
      let svg = Timeline.plot n55 control "x" found
          bars = sort (concatMap (barsOf . (`SvgText.layer` svg)) ["cycles", "jobs"])
       in counterexample (show bars) $
            and (zipWith (\(_, e) (s, _) -> e <= s + 0.02) bars (drop 1 bars))
              .&&. length bars
                === length (cycles found) + length (begun found)
  it "lets U grow from 0 to its capacity, and stay while a job runs (catches a late booking)" $
    forAllShow timelines rangeOf $ \found ->
      conjoin
        [ counterexample (show corners) $
            map snd (take 1 corners) === [0]
              .&&. and (zipWith (<=) rising (drop 1 rising))
              .&&. maximum rising === 1
              .&&. all (isFlat corners) (filter (isWithin tooth) (begun found))
          | tooth <- teeth found,
            let corners = Timeline.contentCorners found tooth,
            let rising = map snd (init corners)
        ]
  it "of any tape is well-formed (catches texts that are taken as tags)" $
    forAllShow timelines rangeOf $ \found ->
      SvgText.isWellFormed (Timeline.plot n55 control "a & b <c>" found)

-- | Range of a timeline, to show it.
rangeOf :: JobTimeline -> String
rangeOf found = show (firstTick found, lastTick found)

-- | Jobs that begin within a timeline.
begun :: JobTimeline -> [JobRun]
begun found = filter ((< lastTick found) . beganAt) (jobRuns found)

-- | True if a job begins in a tooth.
isWithin :: Tooth -> JobRun -> Bool
isWithin tooth j = beganAt j >= emptyAt tooth && beganAt j < fullAt tooth

-- | True if the content stays the same while a job runs.
isFlat :: [(Double, Double)] -> JobRun -> Bool
isFlat corners j =
  or
    [ y == y'
      | ((x, y), (x', y')) <- zip corners (drop 1 corners),
        x == fromIntegral (beganAt j),
        x' == fromIntegral (endedAt j)
    ]

-- | Horizontal extents of the rectangles of a layer.
barsOf :: Text -> [(Double, Double)]
barsOf svg = [(x, x + w) | (x, w) <- zip (numbers "x") (numbers "width")]
  where
    numbers name = [v | t <- SvgText.attributes name svg, Just v <- [readNumber t]]
    readNumber t = readMaybe (Text.unpack t)

-- | Timelines of random frames, in a range with at least one overflow.
timelines :: Gen JobTimeline
timelines = do
  fs <- Generate.framesOf n55 4
  first <- choose (1, 4)
  case Controller.run n55 Controller.neutral 0 (Punch.write n55 0 fs) of
    Just run
      | Just found <- JobTimeline.collect n55 control (AtFeedMove (>= first)) run -> pure found
    _ -> timelines

control :: IntegratorControl
control = case Machine.controller n55 of
  Just (Integrating c) -> c
  _ -> error "n55 has no feed integrator"
