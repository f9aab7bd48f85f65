-- | Slowing down: what a machine does not do by itself, the frames have to say.
--
-- From a feed v down to v₂ a machine needs the way @(v² − v₂²) / 2a@. So at a distance s before a
-- lower feed v₂ it may go no faster than @√(v₂² + 2as)@; where the moves would, they are cut, and
-- from there up to the lower feed they slow down to it. A machine without a sign for that knows
-- only the slow stretch that a program asks for at the end of an element: of the way
-- @v² / 2a@ at the lowest code.
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
import Frame.Instruction (Drive (..), Instruction (..))
import Frame.Instruction qualified as Instruction
import Machine.Machine (Braking (..), BrakingForm (..), FeedMeasure (..), Machine)
import Machine.Machine qualified as Machine
import Part.Part (Pace (..))
import Toolpath.Toolpath (Move, pace)
import Toolpath.Toolpath qualified as Toolpath

-- | The tasks, cut where the cutter begins to slow down.
applied :: Machine -> [Instruction] -> [Instruction]
applied machine tasks = case brakingForm (Machine.braking machine) of
  ByControl -> tasks
  SlowFrames -> concatMap (slowed machine) tasks
  BrakedFrames least -> onTime machine least tasks

-- | The feed that a move gets; on machines whose codes do not say it, the one that is asked.
obtained :: Machine -> Move -> Double
obtained machine m = case pace m of
  Rapid -> let Feed v = FeedCode.rapid machine in v / 60
  At (Located _ asked) -> let Feed v = gets machine asked in v / 60

gets :: Machine -> Feed -> Feed
gets machine (Feed asked) = case Machine.feedMeasure (Machine.feeds machine) of
  LeadingAxis -> Feed asked
  AlongPath -> case Machine.choose machine asked of
    Machine.Given _ v -> Feed v
    Machine.NoSuchFeed low high -> Feed (max low (min high asked))

-- | A run that is to be slow at its end becomes two.
slowed :: Machine -> Instruction -> [Instruction]
slowed machine task = case task of
  Run {run = ms}
    | Toolpath.braked (NonEmpty.last ms),
      At _ <- pace (NonEmpty.head ms) ->
      let v = obtained machine (NonEmpty.head ms)
          (_, cut) =
            mapAccumR
              tail'
              (v * v / (2 * deceleration (Machine.braking machine)))
              (NonEmpty.toList ms)
       in regrouped task (concat cut)
  _ -> [task]
  where
    tail' left m
      | left <= 0 = (0, [(Asked, m)])
      | left >= way = (left - way, [(Lowest, m)])
      | otherwise =
        let (front, back) = Instruction.cutBefore left m in (0, [(Asked, front), (Lowest, back)])
      where
        Mm way = Instruction.wayOf m

-- | The moves of a task with their drives: a task for each drive.
regrouped :: Instruction -> [(Drive, Move)] -> [Instruction]
regrouped task parts = case task of
  Order _ _ -> [task]
  Run {} ->
    [ task {drive = fst (NonEmpty.head part), run = fmap snd part}
      | part <- NonEmpty.groupBy (\a b -> fst a == fst b) parts
    ]

-- Before every lower feed -------------------------------------------------------------------------

-- | What lies ahead of a place: the square of the fastest that is allowed there in (mm/s)², the
-- feed that is slowed down to, and the number of the stretch in which that is done, counted from
-- the end.
data Ahead = Ahead {square :: Double, target :: Double, stretch :: Int}

-- | How much of the end of a move slows down, in mm, and to what.
data Mark = Mark {before :: Double, to :: Double, within :: Int}

onTime :: Machine -> Feed -> [Instruction] -> [Instruction]
onTime machine least tasks = concatMap cut marked
  where
    Feed final = gets machine least
    v2 = final / 60
    (_, marked) = mapAccumR overTask Ahead {square = v2 * v2, target = v2, stretch = 0} tasks
    overTask ahead task = case task of
      Order _ _ -> (ahead, (task, []))
      Run {run = ms} ->
        let (ahead', marks) =
              mapAccumR (mark machine v2) ahead (atTheEnd ms)
         in (ahead', (task, marks))
    -- A stretch shorter than a pulse is not cut off a run.
    lengths = Map.fromListWith (+) [(within k, before k) | (_, marks) <- marked, (_, k) <- marks]
    Mm grain = Machine.pulse machine
    cut (task, marks) = case task of
      Order _ _ -> [task]
      Run {}
        | all isWhole marks -> regrouped task [(slowingTo k, m) | (m, k) <- marks]
        | otherwise -> regrouped task (concatMap parts marks)
    isWhole (m, k) = before k > 0 && before k >= (let Mm way = Instruction.wayOf m in way)
    slowingTo k = Slowing (Feed (60 * to k))
    parts (m, k)
      | before k <= 0 || Map.findWithDefault 0 (within k) lengths < grain = [(Asked, m)]
      | before k >= way = [(slowingTo k, m)]
      | otherwise =
        let (front, back) =
              Instruction.cutBefore (before k) m
         in [(Asked, front), (slowingTo k, back)]
      where
        Mm way = Instruction.wayOf m

-- | What slows down at its end does so once, however many arcs stand for it.
atTheEnd :: NonEmpty Move -> [Move]
atTheEnd ms = map Toolpath.unbraked (NonEmpty.init ms) <> [NonEmpty.last ms]

-- | How a move ends, given what lies ahead of it; and what that makes lie ahead of the move before.
mark :: Machine -> Double -> Ahead -> Move -> (Ahead, (Move, Mark))
mark machine slow behind m
  | way <= 0 = (ahead, (m, Mark 0 (target ahead) (stretch ahead)))
  | v * v <= square ahead = (fresh, (m, Mark 0 (target ahead) (stretch ahead)))
  | needed >= way =
    (ahead {square = square ahead + 2 * a * way}, (m, Mark way (target ahead) (stretch ahead)))
  | otherwise = (fresh, (m, Mark needed (target ahead) (stretch ahead)))
  where
    Mm way = Instruction.wayOf m
    v = obtained machine m
    a = deceleration (Machine.braking machine)
    needed = (v * v - square ahead) / (2 * a)
    fresh = Ahead {square = v * v, target = v, stretch = stretch ahead + 1}
    ahead
      | Toolpath.braked m && slow * slow < square behind =
        Ahead {square = slow * slow, target = slow, stretch = stretch behind + 1}
      | otherwise = behind
