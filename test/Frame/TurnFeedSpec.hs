-- | Feeds for one turn of the spindle as feeds per minute.
module Frame.TurnFeedSpec (spec) where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Pulses (..))
import Data.Maybe (fromMaybe)
import Frame.CommandState (CommandState (..), SpindleNumbers (..))
import Frame.CommandState qualified as CommandState
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Frame.TurnFeed qualified as TurnFeed
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (FeedCode (..), Machine, MachineName (..))
import Part.Part (Sense (..))
import Test.Hspec

spec :: Spec
spec = describe "feeds for one turn of the spindle" $ do
  it "are multiplied by the speed of the spindle" $
    feedsAt 10000 [turning (TurnNumber 800), along 2000] `shouldBe` [160]
  it "keep feeds per minute" $
    feedsAt 10000 [turning (TurnNumber 800), (along 2000) {feedCode = FeedCode 90}] `shouldBe` [90]
  it "follow a new speed" $
    feedsAt 10000 [turning (TurnNumber 800), along 2000, turning (TurnNumber 500), along 2000]
      `shouldBe` [160, 100]
  -- 100 m/min at a radius of 20 mm are 795.77 turns a minute.
  it "follow the radius at a constant cutting speed" $
    feedsAt 20000 [turning (SurfaceNumbers 100000 (Just 2500)), along 2000] `shouldBe` [159]
  it "have no more turns than the limit" $
    feedsAt 500 [turning (SurfaceNumbers 100000 (Just 2500)), along 2000] `shouldBe` [500]
  it "take the radius in the middle of a facing cut" $
    feedsAt
      40000
      [ turning (SurfaceNumbers 100000 (Just 2500)),
        (along 2000) {increment = Pulses3 0 (-40000) 0}
      ]
      `shouldBe` [159]
  it "have the lowest feed while the speed is not known" $
    feedsAt 10000 [along 2000] `shouldBe` [1]

-- | Codes of the moving frames, from a radius in pulses.
feedsAt :: Int -> [Frame] -> [Int]
feedsAt radius frames =
  [ n
    | f <- TurnFeed.perMinute lathe (Pulses3 0 (Pulses radius) 0) frames,
      Frame.isMoving f,
      FeedCode n <- [feedCode f]
  ]

-- | Straight cut along x with this code of a feed for one turn.
along :: Int -> Frame
along code =
  (Frame.commandFrame [])
    { motion = Linear,
      increment = Pulses3 (-1000) 0 0,
      feedCode = TurnCode code
    }

-- | Frame that starts the spindle.
turning :: SpindleNumbers -> Frame
turning speed =
  Frame.commandFrame
    (concat (CommandState.between lathe CommandState.initial started))
  where
    started = CommandState.initial {spindle = Just (Clockwise, speed)}

lathe :: Machine
lathe = fromMaybe (error "no lathe") (BuiltIn.find (MachineName "linuxcnc-lathe"))
