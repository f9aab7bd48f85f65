-- | The machining of a program in numbers: passes, lengths, times and frames of its statements.
module Query.Machining
  ( MachineSummary (..),
    StatementSummary (..),
    summary,
    statements,
  )
where

import Base.Quantity (Mm (..), Seconds (..), total)
import Base.Region (Located (..), Region)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Frame.Frame (FrameProgram)
import Frame.Frame qualified as Frame
import Frame.MoveTime (moveLength, moveTime)
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Toolpath.Toolpath (Block (..), Toolpath (..))
import Toolpath.Toolpath qualified as Toolpath

-- | A program on one machine: the name of the machine, the count of all frames, the time of all
-- moves, and the summaries of its machining statements.
data MachineSummary = MachineSummary
  { machine :: Text,
    frames :: Int,
    time :: Seconds,
    work :: [StatementSummary]
  }
  deriving stock (Eq, Show)

-- | A machining statement. If it is executed several times, each number is a sum.
data StatementSummary = StatementSummary
  { statement :: Region,
    -- | the count of passes; 0 for drilling
    passes :: Int,
    -- | the length of its moves, approach and retract included
    path :: Mm,
    -- | the time of these moves at the feeds of the machine, or of the program without a machine
    duration :: Seconds,
    -- | the count of frames of its passes; absent without a machine, and for drilling
    ownFrames :: Maybe Int
  }
  deriving stock (Eq, Show)

-- | The summary of a program on one machine, evaluated to the end, so that it keeps no frames in
-- memory.
summary :: Toolpath -> Machine -> FrameProgram -> MachineSummary
summary toolpath machine program =
  foldr
    seq
    MachineSummary
      { machine = name,
        frames = length planned,
        time = total (map (moveTime (Just machine)) (concatMap Toolpath.moves (blocks toolpath))),
        work
      }
    work
  where
    MachineName name = Machine.name machine
    planned = Frame.plannedFrames program
    counts =
      IntMap.fromListWith (+) [(n, 1) | f <- planned, Just n <- [Frame.passNumber (Frame.role f)]]
    work = statements (Just (machine, counts)) toolpath

-- | The summaries of the machining statements, in the order of the text. The frames of each pass,
-- counted by the number of the pass from 0, come with the machine.
statements :: Maybe (Machine, IntMap Int) -> Toolpath -> [StatementSummary]
statements made toolpath =
  Map.elems
    ( Map.fromListWith
        (flip plus)
        [ (statement s, s)
          | (block, number) <- zip (blocks toolpath) (Toolpath.passNumbers (blocks toolpath)),
            Just s <- [ofBlock made number block]
        ]
    )

-- | The summary of one block; Nothing if it is no machining. @number@ is the count of passes before
-- it.
ofBlock :: Maybe (Machine, IntMap Int) -> Int -> Block -> Maybe StatementSummary
ofBlock made number block = case block of
  Cutting {job = Located at _} -> Just (summed at 1)
  Clearing {pocket = Located at _} -> Just (summed at 1)
  Holing (Located at _) _ -> Just (summed at 0)
  Travelling {} -> Nothing
  Commanding _ -> Nothing
  where
    summed at passes =
      StatementSummary
        { statement = at,
          passes,
          path = total (map moveLength (Toolpath.moves block)),
          duration = total (map (moveTime (fst <$> made)) (Toolpath.moves block)),
          ownFrames =
            if passes == 0 then Nothing else IntMap.findWithDefault 0 number . snd <$> made
        }

-- | The sum of two summaries of one statement.
plus :: StatementSummary -> StatementSummary -> StatementSummary
plus a b =
  StatementSummary
    { statement = statement a,
      passes = passes a + passes b,
      path = total [path a, path b],
      duration = total [duration a, duration b],
      ownFrames = (+) <$> ownFrames a <*> ownFrames b
    }
