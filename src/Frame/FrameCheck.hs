{-# OPTIONS_GHC -O2 #-}

-- | What stands against frames, and what is to be told of them: they are looked at one by one, in
-- order.
module Frame.FrameCheck
  ( FrameContext,
    lookAt,
    FrameFindings,
    nothing,
    see,
    errors,
    warnings,
  )
where

import Base.PulseVector (Pulses3)
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Base.Region (Located (..), Region)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (maybeToList)
import Frame.Error (Error (..), Warning (..))
import Frame.FeedCode qualified as FeedCode
import Frame.Frame (Frame (..), Planned (frame))
import Frame.Frame qualified as Frame
import Frame.Rounding qualified as Rounding
import Geometry.Tolerance qualified as Tolerance
import Machine.Machine (Axis (..), FeedCode (..), FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Pace (..))

-- | What is the same for all frames.
data FrameContext = FrameContext
  { machine :: Machine,
    -- | whether a code gives the same feed in every frame
    isAlongPath :: Bool,
    -- | axes that there are not
    lacking :: [Axis],
    -- | the largest positions that fit their fields, where fields hold positions
    fields :: [(Axis, Pulses)]
  }

lookAt :: Machine -> FrameContext
lookAt machine =
  FrameContext
    { machine,
      isAlongPath = Machine.feedMeasure (Machine.feeds machine) == AlongPath,
      lacking = [axis | (axis, most) <- capacities, most == 0],
      fields = case Machine.measure (Machine.layout machine) of
        Machine.Increments -> []
        Machine.Positions -> filter ((> 0) . snd) capacities
    }
  where
    capacities = [(axis, Machine.capacity machine axis) | axis <- [X, Y, Z]]

-- | What the frames so far have shown.
data FrameFindings = FrameFindings
  { -- | what is obtained for each feed of the program
    obtained :: Map (Region, Feed) Range,
    -- | the feed that was asked last, and the code that it got
    lastPace :: Pace,
    lastCode :: FeedCode,
    -- | feeds of the program for which the axis that leads finds no code; of each the first
    noCode :: Map (Region, Feed) Error,
    -- | the first move along an axis that there is not
    missing :: Maybe Error,
    -- | the first position that does not fit its field
    beyond :: Maybe Error
  }

-- | From the lowest to the highest feed in mm/min.
data Range = Range Double Double

nothing :: FrameFindings
nothing =
  FrameFindings
    { obtained = Map.empty,
      lastPace = Rapid,
      lastCode = FeedCode 0,
      noCode = Map.empty,
      missing = Nothing,
      beyond = Nothing
    }

-- | Feeds without codes, then moves along axes that there are not, then positions that do not fit;
-- of each the first.
errors :: FrameFindings -> [Error]
errors seen = Map.elems (noCode seen) <> maybeToList (missing seen) <> maybeToList (beyond seen)

-- | A feed obtained that differs from the one asked by more than this share is worth a warning.
feedSlack :: Double
feedSlack = 0.1

-- | One warning for each feed of the program that some frame does not meet, with all that its
-- frames obtain.
warnings :: FrameFindings -> [Warning]
warnings seen =
  [ FeedDiffers region (Feed v) (Feed low) (Feed high)
    | ((region, Feed v), Range low high) <- Map.toList (obtained seen),
      max (v - low) (high - v) > (feedSlack + Tolerance.equal) * v
  ]

-- | Look at the next frame: how fast the program asks it to be, if it is the program that does, and
-- else rapid; where it ends; the frame.
see :: FrameContext -> Pace -> Pulses3 -> Planned -> FrameFindings -> FrameFindings
see look asked at p = placed look at p . fed look asked (frame p)

fed :: FrameContext -> Pace -> Frame -> FrameFindings -> FrameFindings
fed look asked f before = case asked of
  Rapid -> before
  At (Located region v)
    -- Along the path the same code gives the same.
    | isAlongPath look && lastCode before == speed f && lastPace before == asked -> before
    | otherwise -> fedAnew look (region, v) f before {lastPace = asked, lastCode = speed f}

fedAnew :: FrameContext -> (Region, Feed) -> Frame -> FrameFindings -> FrameFindings
fedAnew FrameContext {machine, isAlongPath} key@(region, v) f before =
  case (FeedCode.codeFor machine v f way, FeedCode.given machine f way) of
    (Machine.Given _ _, Just (Feed g)) ->
      before {obtained = Map.insertWith reaching key (Range g g) (obtained before)}
    (Machine.Given _ _, Nothing) -> before
    -- A feed that there is not is no matter of a warning.
    (Machine.NoSuchFeed low high, _)
      | isAlongPath -> before
      | otherwise ->
        before
          { noCode =
              Map.insertWith
                (\_ first -> first)
                key
                ( FrequencyMissing
                    region
                    v
                    (FeedCode.valueFor machine v f way)
                    (low, FeedCode.alongAxis machine low)
                    (high, FeedCode.alongAxis machine high)
                )
                (noCode before)
          }
  where
    way = FeedCode.wayOf machine f

reaching :: Range -> Range -> Range
reaching (Range a b) (Range c d) = Range (min a c) (max b d)

placed :: FrameContext -> Pulses3 -> Planned -> FrameFindings -> FrameFindings
placed FrameContext {machine, lacking, fields} at p before
  | not (any isMissing lacking) && all fits fields = before
  | otherwise =
    before
      { missing =
          firstOf
            (missing before)
            [NoSuchAxis place axis | axis <- lacking, isMissing axis],
        beyond =
          firstOf
            (beyond before)
            [ BeyondField place axis (mm axis (Rounding.component axis at)) (mm axis most)
              | (axis, most) <- fields,
                not (fits (axis, most))
            ]
      }
  where
    isMissing axis = Rounding.component axis (increment (frame p)) /= 0
    fits (axis, most) = abs (Rounding.component axis at) <= most
    place = Frame.origin p
    mm axis (Pulses n) = let Mm grain = Machine.pulseOf machine axis in Mm (fromIntegral n * grain)
    firstOf known found = case (known, found) of
      (Nothing, e : _) -> Just e
      _ -> known
