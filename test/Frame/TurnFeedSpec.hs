-- | Feeds for one turn of the spindle as feeds per minute.
module Frame.TurnFeedSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Pulses (..))
import Data.Maybe (fromMaybe)
import Frame.CommandState (CommandState (..), SpindleNumbers (..))
import Frame.CommandState qualified as CommandState
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Frame.TurnFeed qualified as TurnFeed
import Geometry.Carrier qualified as Carrier
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
  -- The limit is reached at a radius of 6.366 mm. The mean time of a turn from there to 0 is
  -- 1/2500 min, and from 40 mm to there proportional to the radius: 776.1 turns in the mean.
  it "take the time of a facing cut up to the limit" $
    feedsAt
      40000
      [ turning (SurfaceNumbers 100000 (Just 2500)),
        (along 2000) {increment = Pulses3 0 (-40000) 0}
      ]
      `shouldBe` [155]
  -- On a ball of radius 20 mm the distance from the axis is 20 sin t, so the mean time of a turn is
  -- 2/pi * (0.3240 / 2500 + 2 pi * 20 / 100000 * cos 0.3240) min: 1189.2 turns in the mean.
  it "take the time of an arc that ends at the axis" $
    feedsAt
      20000
      [ turning (SurfaceNumbers 100000 (Just 2500)),
        (along 2000)
          { motion = Circular Carrier.CounterClockwise,
            increment = Pulses3 (-20000) (-20000) 0,
            centre = Pulses2 0 (-20000)
          }
      ]
      `shouldBe` [238]
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
