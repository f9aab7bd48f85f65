-- | Braking sections: frames that slow down before a lower feed, for machines that do not slow down
-- by themselves.
--
-- With the deceleration a, a machine needs the length @(v² − v₂²) / 2a@ to slow down from the feed
-- v to v₂. At the distance s before a lower feed v₂ it may run at @√(v₂² + 2as)@ at most. A faster
-- move is cut where it reaches this limit, and the frames from there to the lower feed are marked
-- as braking.
--
-- On a machine whose frames have no such mark, a move slows down by running at the lowest feed code
-- over its last part. This part has the length @v² / 2a@. The program asks for this at the ends of
-- elements.
--
-- An instruction is a run or the words of a command. A run is a sequence of moves along one line,
-- arc or curve.
module Frame.Braking
  ( applied,
  )
where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Located (..))
import Data.List (mapAccumR)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Frame.FeedCode qualified as FeedCode
import Frame.Instruction (FeedMode (..), Instruction (..))
import Frame.Instruction qualified as Instruction
import Machine.Machine (Braking (..), BrakingForm (..), FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.CutFeed qualified as CutFeed
import Part.Part (Pace (..))
import Toolpath.Toolpath (Move, pace)
import Toolpath.Toolpath qualified as Toolpath

-- | Instructions with braking in the form that the machine needs. Runs are cut where a braking
-- section begins.
applied :: Machine -> [Instruction] -> [Instruction]
applied machine instructions = case brakingForm (Machine.braking machine) of
  ByControl -> instructions
  SlowFrames -> concatMap (slowedAtEnd machine) instructions
  BrakedFrames least -> withBrakedFrames machine least instructions

-- | Feed in mm/s that the machine gives for a move: its rapid feed for a rapid move, otherwise the
-- 'nearestFeed' for the feed of the move.
obtained :: Machine -> Move -> Double
obtained machine m = case pace m of
  Rapid -> let Feed v = FeedCode.rapidFeed machine in v / 60
  At (Located _ asked) -> case CutFeed.perMinute asked of
    Just feed -> let Feed v = nearestFeed machine feed in v / 60
    Nothing -> snd (Machine.slowest machine) / 60

-- | Feed in mm/min that the machine gives for the feed @asked@, limited to the machine's range. If
-- the feed codes are frequencies of the leading axis, the feed depends on the direction of the
-- move. Then the result is @asked@ itself.
nearestFeed :: Machine -> Feed -> Feed
nearestFeed machine (Feed asked) = case Machine.feedMeasure (Machine.feeds machine) of
  LeadingAxis -> Feed asked
  AlongPath -> case Machine.choose machine asked of
    Machine.Given _ v -> Feed v
    Machine.NoSuchFeed low high -> Feed (max low (min high asked))

-- | The instruction, divided in two if the program asks for braking at its end. The first part has
-- the feed of the run, the second part the lowest feed code.
slowedAtEnd :: Machine -> Instruction -> [Instruction]
slowedAtEnd machine instruction = case instruction of
  Run {run = ms}
    | Toolpath.isBraked (NonEmpty.last ms),
      At _ <- pace (NonEmpty.head ms) ->
      let v = obtained machine (NonEmpty.head ms)
          slowLength = v * v / (2 * deceleration (Machine.braking machine))
          (_, parts) = mapAccumR slowEnd slowLength (NonEmpty.toList ms)
       in divided instruction (concat parts)
  _ -> [instruction]
  where
    -- Divides the move @m@. The moves of the run are taken from the last one backwards, and @left@
    -- is the length in mm that still has to be slow.
    slowEnd left m
      | left <= 0 = (0, [(AsProgrammed, m)])
      | left >= l = (left - l, [(LowestCode, m)])
      | otherwise =
        let (front, back) = Instruction.cutBeforeEnd left m
         in (0, [(AsProgrammed, front), (LowestCode, back)])
      where
        Mm l = Instruction.lengthOf m

-- | The run of an instruction divided into several instructions. Each of them has neighbouring
-- moves with the same feed mode. @parts@ has the moves of the run with their feed modes.
divided :: Instruction -> [(FeedMode, Move)] -> [Instruction]
divided instruction parts = case instruction of
  Words _ _ -> [instruction]
  Run {} ->
    [ instruction {feedMode = fst (NonEmpty.head part), run = fmap snd part}
      | part <- NonEmpty.groupBy (\a b -> fst a == fst b) parts
    ]

-- Frames that are marked as braking ---------------------------------------------------------------

-- | Limit of the feed at a point of the toolpath, set by the moves after this point.
data FeedLimit = FeedLimit
  { -- | square of the highest feed at this point, in (mm/s)²
    square :: Double,
    -- | lower feed in mm/s, at or after this point, that causes the limit; a faster move slows down
    -- to this feed
    target :: Double,
    -- | number of the braking section in which a move slows down to 'target'. The numbers begin
    -- with 0 at the end of the program and rise towards its beginning, not always by 1
    section :: Int
  }

-- | The part of a braking section that lies in one move, at the end of the move. @brakingLength@ is
-- the length of this part in mm, or 0 if the move does not brake. @to@ is the feed in mm/s at the
-- end of the section, and @within@ is the number of the section.
data BrakingEnd = BrakingEnd {brakingLength :: Double, to :: Double, within :: Int}

-- | Instructions with a braking section divided off before every lower feed. At the end of an
-- element with braking, and at the end of the program, the feed has to come down to @least@.
withBrakedFrames :: Machine -> Feed -> [Instruction] -> [Instruction]
withBrakedFrames machine least instructions = concatMap cut marked
  where
    Feed leastPerMinute = nearestFeed machine least
    v = leastPerMinute / 60
    (_, marked) =
      mapAccumR markRun FeedLimit {square = v * v, target = v, section = 0} instructions
    markRun limit instruction = case instruction of
      Words _ _ -> (limit, (instruction, []))
      Run {run = ms} ->
        let (limit', ends) = mapAccumR (mark machine v) limit (brakedAtEnd ms)
         in (limit', (instruction, ends))
    sectionLengths =
      Map.fromListWith (+) [(within e, brakingLength e) | (_, ends) <- marked, (_, e) <- ends]
    Mm pulse = Machine.planeResolution machine
    cut (instruction, ends) = case instruction of
      Words _ _ -> [instruction]
      Run {}
        | all isWhole ends -> divided instruction [(brakingTo e, m) | (m, e) <- ends]
        | otherwise -> divided instruction (concatMap parts ends)
    isWhole (m, e) =
      brakingLength e > 0 && brakingLength e >= (let Mm l = Instruction.lengthOf m in l)
    brakingTo e = BrakingTo (Feed (60 * to e))
    parts (m, e)
      | brakingLength e <= 0 || isTooShort e = [(AsProgrammed, m)]
      | brakingLength e >= l = [(brakingTo e, m)]
      | otherwise =
        let (front, back) = Instruction.cutBeforeEnd (brakingLength e) m
         in [(AsProgrammed, front), (brakingTo e, back)]
      where
        Mm l = Instruction.lengthOf m
    -- A section shorter than a pulse is not cut off a run, because its frame could have no motion.
    isTooShort e = Map.findWithDefault 0 (within e) sectionLengths < pulse

-- | The moves of a run. Only the last one keeps the request to brake at its end, because the moves
-- along a curve share one request.
brakedAtEnd :: NonEmpty Move -> [Move]
brakedAtEnd ms = map Toolpath.withoutBraking (NonEmpty.init ms) <> [NonEmpty.last ms]

-- | The feed limit at the start of the move @m@, and the move with the part of a braking section at
-- its end. @after@ is the feed limit at the end of the move. @slow@ is the feed in mm/s to which
-- the cutter brakes at the end of an element with braking.
mark :: Machine -> Double -> FeedLimit -> Move -> (FeedLimit, (Move, BrakingEnd))
mark machine slow after m
  | l <= 0 = (limit, (m, BrakingEnd 0 (target limit) (section limit)))
  | v * v <= square limit = (ownFeed, (m, BrakingEnd 0 (target limit) (section limit)))
  | needed >= l =
    ( limit {square = square limit + 2 * a * l},
      (m, BrakingEnd l (target limit) (section limit))
    )
  | otherwise = (ownFeed, (m, BrakingEnd needed (target limit) (section limit)))
  where
    Mm l = Instruction.lengthOf m
    v = obtained machine m
    a = deceleration (Machine.braking machine)
    needed = (v * v - square limit) / (2 * a)
    ownFeed = FeedLimit {square = v * v, target = v, section = section limit + 1}
    limit
      | Toolpath.isBraked m && slow * slow < square after =
        FeedLimit {square = slow * slow, target = slow, section = section after + 1}
      | otherwise = after
