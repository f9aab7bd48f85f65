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
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Frame.Frame (FrameProgram, PlannedFrame, Role (Carving, Drilling))
import Frame.Frame qualified as Frame
import Frame.MoveTime (moveLength, moveTime, pathTime)
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
    -- | the count of frames of its moves; absent without a machine
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
        time = pathTime (Just machine) toolpath,
        work
      }
    work
  where
    MachineName name = Machine.name machine
    planned = Frame.plannedFrames program
    work = statements (Just (machine, frameCounts planned)) toolpath

-- | Counts of frames: those of each pass by the number of the pass, and those of each block of
-- drilling or carving by the number of the block. Both numbers are from 0.
data FrameCounts = FrameCounts {ofPasses :: IntMap Int, ofBlocks :: IntMap Int}

frameCounts :: [PlannedFrame] -> FrameCounts
frameCounts planned =
  FrameCounts
    { ofPasses = counted [n | f <- planned, Just n <- [Frame.passNumber (Frame.role f)]],
      ofBlocks = counted (mapMaybe (blockOf . Frame.role) planned)
    }
  where
    blockOf role = case role of
      Drilling n -> Just n
      Carving n -> Just n
      _ -> Nothing
    counted numbers = IntMap.fromListWith (+) [(n, 1) | n <- numbers]

-- | The summaries of the machining statements, in the order of the text. The counts of frames come
-- with the machine.
statements :: Maybe (Machine, FrameCounts) -> Toolpath -> [StatementSummary]
statements made toolpath =
  Map.elems
    ( Map.fromListWith
        (flip plus)
        [ (statement s, s)
          | (block, number, passNumber) <-
              zip3 (blocks toolpath) [0 ..] (Toolpath.passNumbers (blocks toolpath)),
            Just s <- [ofBlock made number passNumber block]
        ]
    )

-- | The summary of one block; Nothing if it is no machining. @number@ is the count of blocks before
-- it, and @passNumber@ the count of passes before it.
ofBlock :: Maybe (Machine, FrameCounts) -> Int -> Int -> Block -> Maybe StatementSummary
ofBlock made number passNumber block = case block of
  Cutting {job = Located at _} -> Just (summed at 1 (ofPass . snd <$> made))
  Clearing {pocket = Located at _} -> Just (summed at 1 (ofPass . snd <$> made))
  Holing (Located at _) _ -> Just (summed at 0 (ofBlockFrames . snd <$> made))
  Carved (Located at _) _ _ -> Just (summed at 1 (ofBlockFrames . snd <$> made))
  Travelling {} -> Nothing
  Commanding _ -> Nothing
  where
    ofPass = IntMap.findWithDefault 0 passNumber . ofPasses
    ofBlockFrames = IntMap.findWithDefault 0 number . ofBlocks
    summed at passes ownFrames =
      StatementSummary
        { statement = at,
          passes,
          path = total (map moveLength (Toolpath.moves block)),
          duration = total (map (moveTime (fst <$> made)) (Toolpath.moves block)),
          ownFrames
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
