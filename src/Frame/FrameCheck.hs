-- | Checks of finished frames: feeds that the machine does not have, feeds that differ from the
-- program's, axes that the machine lacks, positions that do not fit their fields. Frames are
-- checked one by one, in order.
module Frame.FrameCheck
  ( FrameContext,
    contextOf,
    FrameFindings,
    noFindings,
    check,
    errors,
    warnings,
  )
where

import Base.PulseVector (Pulses3)
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Base.Region (Located (Located), Region)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (maybeToList)
import Frame.Error (Error (..), Warning (..))
import Frame.FeedCode qualified as FeedCode
import Frame.Frame (Frame (..), PlannedFrame (frame))
import Frame.Frame qualified as Frame
import Frame.Rounding qualified as Rounding
import Geometry.Tolerance qualified as Tolerance
import Machine.Machine (Axis (..), FeedCode (..), FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.CutFeed qualified as CutFeed
import Part.Part (Pace (..))

-- | Facts about the machine that are the same for all frames.
data FrameContext = FrameContext
  { machine :: Machine,
    -- | True when a code gives the same feed along the path in every frame
    isAlongPath :: Bool,
    -- | axes that the machine does not have, that is, that have no field in its frames
    missingAxes :: [Axis],
    -- | largest positions in pulses that fit their fields, on a machine with absolute positions;
    -- empty on other machines
    largestPositions :: [(Axis, Pulses)]
  }

-- | Facts about @machine@ for the function 'check'.
contextOf :: Machine -> FrameContext
contextOf machine =
  FrameContext
    { machine,
      isAlongPath = Machine.feedMeasure (Machine.feeds machine) == AlongPath,
      missingAxes = [axis | (axis, most) <- capacities, most == 0],
      largestPositions = case Machine.measure (Machine.layout machine) of
        Machine.Increments -> []
        Machine.Positions -> filter ((> 0) . snd) capacities
    }
  where
    capacities = [(axis, Machine.capacity machine axis) | axis <- [X, Y, Z]]

-- | Findings in the frames that are checked so far: errors, and the feeds from which 'warnings' are
-- made.
data FrameFindings = FrameFindings
  { -- | range of the feeds that the frames get, for each feed of the program with its region
    obtained :: Map (Region, Feed) FeedRange,
    -- | the last feed that the program gave for a frame, and the code of this frame
    lastPace :: Pace,
    lastCode :: FeedCode,
    -- | for each feed of the program, the error of the first frame in which no code gives this
    -- feed. Empty on a machine whose codes mean feeds along the path. There a feed has a code in
    -- all frames or in none, so "Frame.InstructionCheck" reports a feed without a code
    withoutCode :: Map (Region, Feed) Error,
    -- | error of the first move along an axis that the machine does not have
    missingAxis :: Maybe Error,
    -- | error of the first position that does not fit its field
    outOfField :: Maybe Error
  }

-- | Lowest and highest feed in mm/min.
data FeedRange = FeedRange Double Double

-- | Findings before the first frame.
noFindings :: FrameFindings
noFindings =
  FrameFindings
    { obtained = Map.empty,
      lastPace = Rapid,
      lastCode = FeedCode 0,
      withoutCode = Map.empty,
      missingAxis = Nothing,
      outOfField = Nothing
    }

-- | Errors: the feeds without a code, then the first missing axis, then the first position that
-- does not fit.
errors :: FrameFindings -> [Error]
errors findings =
  Map.elems (withoutCode findings)
    <> maybeToList (missingAxis findings)
    <> maybeToList (outOfField findings)

-- | Share of the feed in the program by which the feed of a frame may differ without a warning.
feedSlack :: Double
feedSlack = 0.1

-- | One warning for each feed of the program for which some frame has a feed that differs by more
-- than 'feedSlack'. The warning has the range of the feeds obtained.
warnings :: FrameFindings -> [Warning]
warnings findings =
  [ FeedDiffers region (Feed v) (Feed low) (Feed high)
    | ((region, Feed v), FeedRange low high) <- Map.toList (obtained findings),
      max (v - low) (high - v) > (feedSlack + Tolerance.equal) * v
  ]

-- | Adds the findings in the next frame @p@. @asked@ is the feed of this frame in the program. It
-- is 'Rapid' for a rapid move, for commands, and where the compiler sets the feed. @at@ is the
-- position in pulses at the end of the frame.
check :: FrameContext -> Pace -> Pulses3 -> PlannedFrame -> FrameFindings -> FrameFindings
check context asked at p = checkPosition context at p . checkFeed context asked (frame p)

-- | Adds the finding in the feed of the frame @f@. @asked@ is its feed in the program.
checkFeed :: FrameContext -> Pace -> Frame -> FrameFindings -> FrameFindings
checkFeed context asked f before = case asked of
  Rapid -> before
  At (Located region v)
    -- When codes are feeds along the path, the same code gives the same feed, so nothing new can be
    -- found.
    | isAlongPath context && lastCode before == feedCode f && lastPace before == asked -> before
    | otherwise -> case (feedCode f, CutFeed.perMinute v) of
      -- The code of a feed for one turn has this feed.
      (TurnCode _, _) -> checked
      (FeedCode _, Nothing) -> checked
      (FeedCode _, Just feed) -> checkNewFeed context (region, feed) f checked
  where
    checked = before {lastPace = asked, lastCode = feedCode f}

-- | Adds the finding in the feed of the frame @f@. @v@ is the feed in the program, and @region@ the
-- text that asks for it.
checkNewFeed :: FrameContext -> (Region, Feed) -> Frame -> FrameFindings -> FrameFindings
checkNewFeed FrameContext {machine, isAlongPath} key@(region, v) f before =
  case (FeedCode.codeFor machine v f l, FeedCode.feedOf machine f l) of
    (Machine.Given _ _, Just (Feed g)) ->
      before {obtained = Map.insertWith united key (FeedRange g g) (obtained before)}
    (Machine.Given _ _, Nothing) -> before
    (Machine.NoSuchFeed low high, _)
      -- "Frame.InstructionCheck" has reported this feed already.
      | isAlongPath -> before
      | otherwise ->
        before
          { withoutCode =
              Map.insertWith furthest key (frequencyError low high) (withoutCode before)
          }
  where
    l = FeedCode.frameLength machine f
    frequencyError low high =
      FrequencyOutOfRange
        region
        v
        (FeedCode.codeValue machine v f l)
        (low, FeedCode.feedAlongAxis machine low)
        (high, FeedCode.feedAlongAxis machine high)

-- | The one of two errors of a feed that is further from the frequencies of the machine.
furthest :: Error -> Error -> Error
furthest new old = if distance new > distance old then new else old
  where
    distance e = case e of
      FrequencyOutOfRange _ _ needed (low, _) (high, _) -> max (needed / high) (low / needed)
      _ -> 0

-- | The smallest range that contains both ranges.
united :: FeedRange -> FeedRange -> FeedRange
united (FeedRange a b) (FeedRange c d) = FeedRange (min a c) (max b d)

-- | Adds the findings about the axes along which the frame @p@ moves, and about @at@, the position
-- in pulses at the end of this frame.
checkPosition :: FrameContext -> Pulses3 -> PlannedFrame -> FrameFindings -> FrameFindings
checkPosition FrameContext {machine, missingAxes, largestPositions} at p before
  | not (any isUsed missingAxes) && all isFitting largestPositions = before
  | otherwise =
    before
      { missingAxis =
          firstOf
            (missingAxis before)
            [NoSuchAxis region axis | axis <- missingAxes, isUsed axis],
        outOfField =
          firstOf
            (outOfField before)
            [ PositionOutOfField region axis (mm axis (Rounding.component axis at)) (mm axis most)
              | (axis, most) <- largestPositions,
                not (isFitting (axis, most))
            ]
      }
  where
    isUsed axis = Rounding.component axis (increment (frame p)) /= 0
    isFitting (axis, most) = abs (Rounding.component axis at) <= most
    region = Frame.origin p
    mm axis (Pulses n) =
      let Mm pulse = Machine.resolutionOf machine axis in Mm (fromIntegral n * pulse)
    firstOf known found = case (known, found) of
      (Nothing, e : _) -> Just e
      _ -> known
