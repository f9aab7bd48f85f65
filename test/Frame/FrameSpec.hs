-- | The rules for frames that turn rotary axes.
module Frame.FrameSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Frame.Frame (Frame (..), FrameMotion (..), Violation (..))
import Frame.Frame qualified as Frame
import Generate.Machine qualified as Generate
import Geometry.Carrier (Sense (..))
import Machine.Machine (FeedCode (..), RotaryAxis (..))
import Machine.Machine qualified as Machine
import Machines (iso6983, lkp01f, n55)
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "turns" $ do
  it
    "a frame that turns keeps the rules only as a line or a rapid move (catches an arc that turns, \
    \a turn without motion)"
    $ checkCoverage . forAll Generate.machine $ \m -> forAll (Generate.frames m) $ \(_, fs) ->
      forAll (elements [Pulses2 1 0, Pulses2 0 (-1)]) $ \t ->
        let still = [f | f <- fs, turn f == 0, motion f `notElem` [Linear, Rapid]]
         in cover 5 (any isArc still) "arcs" $
              cover 20 (not (all isArc still)) "commands" $
                conjoin
                  [ counterexample
                      (show f)
                      (NoSuchMotion 1 `elem` Frame.frameViolations m 1 f {turn = t})
                    | f <- still
                  ]
  it "a line and a rapid move may turn only, or move and turn at once" $ do
    map violationsOn55 [line {turn = Pulses2 5 (-7)}, line {increment = Pulses3 1 2 3, turn = 9}]
      `shouldBe` [[], []]
    violationsOn55 line {motion = Rapid, feedCode = FeedCode 0, turn = 1} `shouldBe` []
    violationsOn55 line `shouldBe` [NoSuchMotion 1]
  it "a turn has to fit its word, on an axis of the machine" $ do
    violationsOn55 line {turn = Pulses2 999999 (-1000000)}
      `shouldBe` [TurnOverCapacity 1 B (-1000000)]
    [Frame.frameViolations m 1 line {turn = Pulses2 1 0, feedCode = code} | (m, code) <- others]
      `shouldBe` [[TurnOverCapacity 1 A 1], [TurnOverCapacity 1 A 1]]
    map (Machine.turnCapacity n55) [A, B] `shouldBe` [Pulses 999999, Pulses 999999]
    map (Machine.turnCapacity lkp01f) [A, B] `shouldBe` [0, 0]
  where
    violationsOn55 = Frame.frameViolations n55 1
    others = [(lkp01f, FeedCode 5), (iso6983, FeedCode 60)]
    isArc f = motion f `elem` [Circular Clockwise, Circular CounterClockwise]

-- | Line of no length at 60 mm/min.
line :: Frame
line = (Frame.commandFrame []) {motion = Linear, feedCode = FeedCode 60}
