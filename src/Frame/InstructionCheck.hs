{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | What stands against tasks before their frames are made, and what is to be told of them: they
-- are looked at one by one, in order.
module Frame.InstructionCheck
  ( InstructionContext,
    lookFrom,
    InstructionFindings,
    nothing,
    see,
    isBounded,
    feedless,
    boundless,
    unsure,
    mostFrames,
  )
where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Located (..), Region)
import Control.Applicative ((<|>))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe, mapMaybe, maybeToList)
import Frame.Chord (Allowed)
import Frame.Chord qualified as Chord
import Frame.Error (Error (..), Warning (..))
import Frame.Instruction (Drive (..), Instruction (..))
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
import Part.Part (Pace (..))
import Toolpath.Toolpath (Move (..), heights, pace)

-- | More frames than this are 38 km of tape.
mostFrames :: Int
mostFrames = 1000000

-- | What is the same for all tasks.
data InstructionContext = InstructionContext
  { machine :: Machine,
    -- | whether the feed of a frame does not depend on where it goes
    isAlongPath :: Bool,
    -- | whether heights stand on the tape, but nothing is known to move there
    areHeightsUnsure :: Bool,
    -- | the beginning of the path, if it lies too far away
    tooFar :: Maybe Error
  }

-- | On a machine, from a point and the place in the program that names it.
lookFrom :: Machine -> Region -> Point -> InstructionContext
lookFrom machine fromRegion fromPoint =
  InstructionContext
    { machine,
      isAlongPath = Machine.feedMeasure (Machine.feeds machine) == AlongPath,
      areHeightsUnsure = Machine.capacity machine Z > 0 && Z `notElem` Machine.driven machine,
      tooFar = beyond fromRegion fromPoint
    }

-- | What the tasks so far have shown, the latest first.
data InstructionFindings = InstructionFindings
  { -- | the pace that was looked at last
    lastPace :: Pace,
    -- | feeds along the path that no code gives, whatever the frames
    noCode :: [Error],
    -- | places that are too far away, at most one of a run
    distant :: [Error],
    -- | as many frames as can be counted without making them
    count :: Int,
    -- | where they become too many
    overlong :: Maybe Error,
    -- | the first move that changes the height unsurely
    rising :: Maybe Warning
  }

nothing :: InstructionFindings
nothing =
  InstructionFindings
    { lastPace = Rapid,
      noCode = [],
      distant = [],
      count = 0,
      overlong = Nothing,
      rising = Nothing
    }

-- | Whether the frames of all tasks so far can be made, and are not too many.
isBounded :: InstructionFindings -> Bool
isBounded seen = null (distant seen) && null (overlong seen)

feedless :: InstructionFindings -> [Error]
feedless = reverse . noCode

boundless :: InstructionFindings -> [Error]
boundless seen = reverse (distant seen) <> maybeToList (overlong seen)

unsure :: InstructionFindings -> [Warning]
unsure = maybeToList . rising

-- | Look at the next task, given where the chords of its run end; they are asked for only along a
-- curve on a machine that walks no arcs.
see ::
  InstructionContext ->
  Instruction ->
  [PathPosition] ->
  InstructionFindings ->
  InstructionFindings
see look task stops before = case task of
  Order _ _ -> before
  Run {drive, allowed, run} ->
    counted look allowed run stops (reached look run (risen look run (fed look drive run before)))

fed :: InstructionContext -> Drive -> NonEmpty Move -> InstructionFindings -> InstructionFindings
fed look drive moves before = case (drive, asked) of
  (Asked, At (Located region (Feed v)))
    | isAlongPath look && asked /= lastPace before -> case Machine.choose (machine look) v of
      Machine.NoSuchFeed low high ->
        before
          { lastPace = asked,
            noCode = FeedMissing region (Feed v) (Feed low) (Feed high) : noCode before
          }
      Machine.Given _ _ -> before {lastPace = asked}
  _ -> before
  where
    asked = pace (NonEmpty.head moves)

risen :: InstructionContext -> NonEmpty Move -> InstructionFindings -> InstructionFindings
risen look moves before
  | areHeightsUnsure look,
    Nothing <- rising before =
    before
      { rising =
          listToMaybe
            [HeightUnsure (origin m) | m <- NonEmpty.toList moves, uncurry (/=) (heights m)]
      }
  | otherwise = before

reached :: InstructionContext -> NonEmpty Move -> InstructionFindings -> InstructionFindings
reached look moves before
  | null (tooFar look) && all (isNear . segment) moves = before
  | otherwise =
    maybe
      before
      (\e -> before {distant = e : distant before})
      (listToMaybe (mapMaybe problem (NonEmpty.toList moves)))
  where
    problem m
      | null (tooFar look) && isNear (segment m) = Nothing
      | BoundingBox.BoundingBox l b r t <- BoundingBox.ofSegment (segment m) =
        beyond (origin m) (Vec.point l b) <|> beyond (origin m) (Vec.point r t) <|> tooFar look

-- | Whether a segment is surely within reach; of an arc its whole circle is looked at.
isNear :: Segment -> Bool
isNear s = case s of
  Straight a b -> isWithin 0 a && isWithin 0 b
  Arc {start = from, centre} -> let Mm r = Segment.radius centre from in isWithin r centre

-- | Whether a point is no further from the middle than the reach less so many mm, along both axes.
isWithin :: Double -> Point -> Bool
isWithin less p = max (abs (Vec.x p)) (abs (Vec.y p)) <= limit - less
  where
    Mm limit = Tolerance.reach

beyond :: Region -> Point -> Maybe Error
beyond region p = if isWithin 0 p then Nothing else Just (OutOfReach region p Tolerance.reach)

-- | More frames than a tape may have, as far as it can be seen without making them. Where the
-- machine walks arcs they are no more than the moves.
counted ::
  InstructionContext ->
  Allowed ->
  NonEmpty Move ->
  [PathPosition] ->
  InstructionFindings ->
  InstructionFindings
counted look allowed moves stops before = case overlong before of
  Just _ -> before
  Nothing
    | now > mostFrames ->
      before {overlong = Just (TooManyFrames (origin (NonEmpty.head moves)) mostFrames)}
    | otherwise -> before {count = now}
  where
    !now =
      count before + case Machine.arcs (machine look) of
        Arcs {} | Rounding.isLevel (machine look) moves -> 1
        _ ->
          Chord.frameCount
            (machine look)
            (Chord.rounding (machine look) allowed)
            moves
            (take (mostFrames + 1) stops)
