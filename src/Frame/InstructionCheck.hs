-- | Checks of instructions before their frames are made: feeds without a code, points out of reach,
-- too many frames, moves in z where it is uncertain whether the machine can move in z. Instructions
-- are checked one by one, in order. An instruction is a run or the words of a command. A run is a
-- sequence of moves along one line, arc or curve.
module Frame.InstructionCheck
  ( InstructionContext,
    contextOf,
    InstructionFindings,
    noFindings,
    check,
    isBounded,
    feedErrors,
    boundErrors,
    heightWarnings,
  )
where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Located (..), Region)
import Control.Applicative ((<|>))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe, mapMaybe, maybeToList)
import Frame.ChordError (ChordTolerance)
import Frame.ChordError qualified as ChordError
import Frame.Error (Error (..), Warning (..))
import Frame.FeedCode qualified as FeedCode
import Frame.Frame (mostFrames)
import Frame.Helix qualified as Helix
import Frame.Instruction (FeedMode (..), Instruction (..))
import Frame.Rounding (PathPosition)
import Frame.Rounding qualified as Rounding
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..), Axis (..), FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.CutFeed qualified as CutFeed
import Part.Part (Pace (..))
import Toolpath.Toolpath (Move (..), heights, pace)

-- | Facts that are the same for all instructions.
data InstructionContext = InstructionContext
  { machine :: Machine,
    -- | True when the feed of a frame does not depend on the direction of the frame
    isAlongPath :: Bool,
    -- | True when the tape has a field for z, but the source of the machine description mentions no
    -- axis z
    isHeightUncertain :: Bool,
    -- | error for the start of the toolpath, if the start is out of reach
    startError :: Maybe Error
  }

-- | Facts for the function 'check': about @machine@, and about @start@, the start of the toolpath
-- in mm. @startRegion@ is the region of the program that gives this start.
contextOf :: Machine -> Region -> Point -> InstructionContext
contextOf machine startRegion start =
  InstructionContext
    { machine,
      isAlongPath = Machine.feedMeasure (Machine.feeds machine) == AlongPath,
      isHeightUncertain = Machine.capacity machine Z > 0 && Z `notElem` Machine.drivenAxes machine,
      startError = reachError startRegion start
    }

-- | Findings in the instructions that are checked so far; the lists have the latest first.
data InstructionFindings = InstructionFindings
  { -- | feed for which a code was looked up last; a run with the same feed needs no new look-up
    lastPace :: Pace,
    -- | errors about feeds along the path that no code gives
    withoutCode :: [Error],
    -- | errors about points out of reach, at most one for each run
    outOfReach :: [Error],
    -- | number of frames of all instructions so far, as estimated before the frames are made
    count :: Int,
    -- | error for the run with which the number of frames exceeds 'mostFrames'
    tooMany :: Maybe Error,
    -- | warning about the first move in z, if it is uncertain whether the machine can move in z
    uncertainHeight :: Maybe Warning
  }

-- | Findings before the first instruction.
noFindings :: InstructionFindings
noFindings =
  InstructionFindings
    { lastPace = Rapid,
      withoutCode = [],
      outOfReach = [],
      count = 0,
      tooMany = Nothing,
      uncertainHeight = Nothing
    }

-- | True when all points so far are in reach and the frames are not too many, so that the frames
-- can be made.
isBounded :: InstructionFindings -> Bool
isBounded findings = null (outOfReach findings) && null (tooMany findings)

-- | Errors about feeds without a code, in the order of the instructions.
feedErrors :: InstructionFindings -> [Error]
feedErrors = reverse . withoutCode

-- | Errors that keep the frames from being made: points out of reach in the order of the
-- instructions, then too many frames.
boundErrors :: InstructionFindings -> [Error]
boundErrors findings = reverse (outOfReach findings) <> maybeToList (tooMany findings)

-- | Warning about moves in z, if it is uncertain whether the machine can move in z; empty if there
-- are no such moves.
heightWarnings :: InstructionFindings -> [Warning]
heightWarnings = maybeToList . uncertainHeight

-- | Adds the findings in the next instruction. @chordEnds@ are the ends of the chords of its run;
-- they are evaluated only for a curve that cannot become arcs.
check ::
  InstructionContext ->
  Instruction ->
  [PathPosition] ->
  InstructionFindings ->
  InstructionFindings
check context instruction chordEnds before = case instruction of
  Words _ _ -> before
  Run {feedMode, tolerance, run} ->
    counted
      context
      tolerance
      run
      chordEnds
      (checkReach context run (checkHeights context run (checkFeed context feedMode run before)))

-- | Adds the error of a feed without a code, if the run @moves@ has such a feed.
checkFeed ::
  InstructionContext ->
  FeedMode ->
  NonEmpty Move ->
  InstructionFindings ->
  InstructionFindings
checkFeed context feedMode moves before = case (feedMode, asked) of
  (AsProgrammed, At (Located region v))
    | asked /= lastPace before ->
      before {lastPace = asked, withoutCode = faultOf region v <> withoutCode before}
  _ -> before
  where
    asked = pace (NonEmpty.head moves)
    faultOf region v = case (FeedCode.turnCode (machine context) v, CutFeed.perMinute v) of
      (Just (Machine.NoSuchFeed low high), _) -> [TurnFeedOutOfRange region (Mm low) (Mm high)]
      (Just (Machine.Given _ _), _) -> []
      (Nothing, Nothing) -> [TurnFeedUnknown region]
      (Nothing, Just (Feed f))
        | isAlongPath context,
          Machine.NoSuchFeed low high <- Machine.choose (machine context) f ->
          [FeedOutOfRange region (Feed f) (Feed low) (Feed high)]
        | otherwise -> []

-- | Adds a warning about the first move of the run @moves@ that changes the height, if it is
-- uncertain whether the machine can move in z. Only the first such run of a program has a warning.
checkHeights :: InstructionContext -> NonEmpty Move -> InstructionFindings -> InstructionFindings
checkHeights context moves before
  | isHeightUncertain context,
    Nothing <- uncertainHeight before =
    before
      { uncertainHeight =
          listToMaybe
            [HeightUncertain (origin m) | m <- NonEmpty.toList moves, uncurry (/=) (heights m)]
      }
  | otherwise = before

-- | Adds the error of the first move of the run @moves@ that is not within reach. The point in the
-- error is a corner of the move's bounding box. If the start of the toolpath is out of reach, but
-- the first move of the run is within reach, the error of the start is added.
checkReach :: InstructionContext -> NonEmpty Move -> InstructionFindings -> InstructionFindings
checkReach context moves before
  | null (startError context) && all (isSurelyInReach . segment) moves = before
  | otherwise =
    maybe
      before
      (\e -> before {outOfReach = e : outOfReach before})
      (listToMaybe (mapMaybe problem (NonEmpty.toList moves)))
  where
    problem m
      | null (startError context) && isSurelyInReach (segment m) = Nothing
      | BoundingBox.BoundingBox l b r t <- BoundingBox.ofSegment (segment m) =
        reachError (origin m) (Vec.point l b)
          <|> reachError (origin m) (Vec.point r t)
          <|> startError context

-- | True for a line with both ends within reach, and for an arc whose full circle is within reach.
-- Any other segment has to be tested by its bounding box.
isSurelyInReach :: Segment -> Bool
isSurelyInReach s = case s of
  Straight a b -> isInReach 0 a && isInReach 0 b
  Arc {start = from, centre} -> let Mm r = Segment.radius centre from in isInReach r centre

-- | True for a point whose coordinates have absolute values of at most 'Tolerance.reach' less
-- @margin@, in mm.
isInReach :: Double -> Point -> Bool
isInReach margin p = max (abs (Vec.x p)) (abs (Vec.y p)) <= limit - margin
  where
    Mm limit = Tolerance.reach

-- | The error of a point in mm that is out of reach; Nothing for a point within reach.
reachError :: Region -> Point -> Maybe Error
reachError region p =
  if isInReach 0 p then Nothing else Just (OutOfReach region p Tolerance.reach)

-- | Adds the number of frames of the run @moves@, without making them. On a machine with arcs a
-- level run, which stays at one height, counts as one frame, although it may need more.
counted ::
  InstructionContext ->
  ChordTolerance ->
  NonEmpty Move ->
  [PathPosition] ->
  InstructionFindings ->
  InstructionFindings
counted context tolerance moves chordEnds before = case tooMany before of
  Just _ -> before
  Nothing
    | now > mostFrames ->
      before {tooMany = Just (TooManyFrames (origin (NonEmpty.head moves)) mostFrames)}
    | otherwise -> before {count = now}
  where
    now =
      count before + case Machine.arcs (machine context) of
        Arcs {}
          | Rounding.isLevel (machine context) moves || Helix.isHelix (machine context) moves -> 1
        _ ->
          ChordError.frameCount
            (machine context)
            (ChordError.raisedToRounding (machine context) tolerance)
            moves
            (take (mostFrames + 1) chordEnds)
