-- | Faults of taps that a machine cannot drive.
module Frame.TapError
  ( TapFault (..),
    TapFeed (..),
    holdsFeed,
    speedNear,
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Region)
import Data.List (find)
import Data.Text (Text)
import Report.Report (Report (..), ReportPlace (..), report)
import Report.Report qualified as Report

-- | Reason why a machine cannot drive a tap.
data TapFault
  = -- | the machine has no cycle for it
    NoTapCycle
  | -- | the feed does not follow the spindle, so the tap needs a floating holder
    NeedsFloatingHolder
  | -- | the cycle turns clockwise on the way down
    OnlyRightHand
  | -- | the feed word cannot hold the feed that this pitch needs
    UnevenFeed TapFeed
  deriving stock (Eq, Ord, Show)

-- | Feed of a tap that the feed word cannot hold.
data TapFeed = TapFeed
  { tappedPitch :: Mm,
    -- | speed of the spindle in turns per minute
    tapSpeed :: Double,
    -- | smallest feed of the word, in mm per minute
    feedStep :: Double
  }
  deriving stock (Eq, Ord, Show)

-- | Test that the feed word holds the feed of a pitch at a speed of the spindle. It has to be
-- exact, because the feed of G84 gives the pitch.
holdsFeed :: TapFeed -> Bool
holdsFeed (TapFeed (Mm pitch) speed step) = abs (n - fromIntegral (round n :: Int)) < 1.0e-6
  where
    n = pitch * speed / step

-- | Whole speed nearest to the one of a fault for which the feed word holds the feed; of two, the
-- lower one. Nothing if there is none from half of the speed to its double.
speedNear :: TapFeed -> Maybe Int
speedNear fault = find fits (near (ceiling speed - 1) (floor speed + 1))
  where
    speed = tapSpeed fault
    fits n = holdsFeed fault {tapSpeed = fromIntegral n}
    near :: Int -> Int -> [Int]
    near low high
      | fromIntegral low < speed / 2 = [high .. floor (2 * speed)]
      | speed - fromIntegral low <= fromIntegral high - speed = low : near (low - 1) high
      | otherwise = high : near low (high + 1)

-- | Report of a tap in a region, for the machine with this name.
toReport :: LengthUnit -> Text -> Region -> TapFault -> Report
toReport unit machine region fault = case fault of
  NoTapCycle ->
    (tap (machine <> " cannot tap"))
      { message = ["Its axes do not follow the spindle, and it does not turn the spindle back."],
        hints = ["Mill the thread instead: thread at … diameter … pitch … depth … inside."]
      }
  NeedsFloatingHolder ->
    (tap (machine <> " taps with a floating holder only"))
      { message = ["Its feed does not follow the spindle."],
        hints = ["If the tap is in such a holder, write floating in the braces of tap."]
      }
  OnlyRightHand ->
    (tap (machine <> " taps right-hand threads only"))
      { message = ["Its cycle G84 turns the spindle clockwise on the way down."],
        hints = ["Mill the thread instead: thread at … { hand left }."]
      }
  UnevenFeed fault' ->
    (tap ("the feed word of " <> machine <> " cannot hold the feed of this tap"))
      { message =
          [ "The feed is the pitch, " <> Decimal.inUnit unit (tappedPitch fault')
              <> ", times the speed of the spindle. The word has "
              <> decimals (feedStep fault')
              <> ". Rounded, it would not give this pitch."
          ],
        hints = case speedNear fault' of
          Just n -> ["Choose another speed, for example " <> Decimal.whole n <> " rpm."]
          Nothing -> ["Choose a speed for which the product is a feed that the word can hold."]
      }
  where
    tap = report Report.Error "E0530" (InSource region)
    decimals step = case round (negate (logBase 10 step)) :: Int of
      n
        | n <= 0 -> "no decimals"
        | n == 1 -> "1 decimal"
        | otherwise -> Decimal.whole n <> " decimals"
