-- | Radius of the cutter that is in the spindle while a frame is executed. Planned frames are those
-- that the compiler made for the program.
module Verify.SpindleTool
  ( Tools,
    plannedTools,
    toolInFrame,
    toolsByCommands,
    plannedIndices,
    indicesByCommands,
    Use,
    useOf,
    supposedTool,
  )
where

import Base.Quantity (Mm (..))
import Data.IntMap.Strict qualified as IntMap
import Data.List (foldl', nub)
import Data.Maybe (catMaybes, fromMaybe, listToMaybe)
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Vector
import Frame.Frame (Frame, FrameProgram, PlannedFrame)
import Frame.Frame qualified as Frame
import Verify.Motion (CutterMotion (number))

-- | Radius of the cutter in mm, for each planned frame in order.
type Tools = Vector Double

-- | Radius of the cutter in each planned frame. A frame of commands has the cutter of the next
-- motion.
plannedTools :: FrameProgram -> Tools
plannedTools program = Vector.init (Vector.scanr' (\r next -> if r < 0 then next else r) 0 radii)
  where
    -- A negative number takes the place of the radius in a frame without motion.
    radii = Vector.fromList (map radiusIn (Frame.plannedFrames program))
    radiusIn p
      | Frame.isMoving (Frame.frame p) = let Mm r = Frame.cutterRadius p in r
      | otherwise = -1

-- | Radius of the cutter in the planned frame with the number @n@, counted from 1; 0 if there is no
-- such frame.
toolInFrame :: Tools -> Int -> Mm
toolInFrame tools n = maybe (Mm 0) Mm (tools Vector.!? (n - 1))

-- | Index of the tool in each planned frame ('Frame.toolIndex'). A frame of commands has the tool
-- of the next motion.
plannedIndices :: FrameProgram -> Vector Int
plannedIndices program =
  Vector.init (Vector.scanr' (\t next -> if t < 0 then next else t) 0 (Vector.fromList indices))
  where
    indices =
      [ if Frame.isMoving (Frame.frame p) then Frame.toolIndex p else -1
        | p <- Frame.plannedFrames program
      ]

-- | Radius of the cutter in each frame of a tape, by the number of the frame from 1. The first
-- frame with commands corresponds to the first such planned frame, the second to the second, and so
-- on. From one such frame to the next, the cutter stays the same. Where the program plans no
-- motion, it is the cutter of the motions before. Nothing if the cutter in the planned frames
-- changes elsewhere.
toolsByCommands :: FrameProgram -> [Frame] -> Maybe (Int -> Mm)
toolsByCommands = byCommands (Mm 0) Frame.cutterRadius

-- | Indices of the tools that may be in the spindle in each frame of a tape, found as
-- 'toolsByCommands' finds the radius. Where the program plans no motion, the tool may be that of
-- the motions before, or already that of the motions after.
indicesByCommands :: FrameProgram -> [Frame] -> Maybe (Int -> [Int])
indicesByCommands program frames = do
  before <- byCommands 0 Frame.toolIndex program frames
  Just (\n -> nub [before n, fromMaybe (before n) (after n)])
  where
    -- The tool of the first section with a motion from the section of the frame on.
    after n = IntMap.lookupLE n begins >>= listToMaybe . snd
    begins = IntMap.fromList (zip (1 : numbersOf frames) (suffixes (map indicesIn sections)))
    suffixes list = case list of
      [] -> repeat []
      _ : rest -> concat list : suffixes rest
    sections = divided (numbersOf (map Frame.frame planned)) planned
    planned = Frame.plannedFrames program
    indicesIn section = take 1 [Frame.toolIndex p | p <- section, Frame.isMoving (Frame.frame p)]

-- | Property of the tool in each frame of a tape, by the number of the frame from 1. @without@ is
-- the property if there is no tool, and @ofPlanned@ gives that of a planned frame.
byCommands :: Eq a => a -> (PlannedFrame -> a) -> FrameProgram -> [Frame] -> Maybe (Int -> a)
byCommands without ofPlanned program frames = do
  found <- traverse (only . filter (Frame.isMoving . Frame.frame)) plannedSections
  let kept = drop 1 (scanl fromMaybe (firstOf found) found)
      begins = IntMap.fromList (zip (1 : numbersOf frames) (kept <> repeat (last kept)))
  Just (\n -> maybe without snd (IntMap.lookupLE n begins))
  where
    firstOf found = fromMaybe without (listToMaybe (catMaybes found))
    planned = Frame.plannedFrames program
    plannedSections = divided (numbersOf (map Frame.frame planned)) planned
    only section = case nub (map ofPlanned section) of
      [] -> Just Nothing
      [r] -> Just (Just r)
      _ -> Nothing

-- | Numbers of the frames with commands after the first frame, counted from 1.
numbersOf :: [Frame] -> [Int]
numbersOf fs = [n | (n, f) <- zip [1 ..] fs, n > 1, not (null (Frame.commands f))]

-- | Sections of a list, each of which begins at one of the numbers, counted from 1.
divided :: [Int] -> [a] -> [[a]]
divided numbers = go (zipWith (-) numbers (1 : numbers))
  where
    go counts left = case counts of
      [] -> [left]
      n : more -> let (section, later) = splitAt n left in section : go more later

-- | Use of a cutter in a pass on the tape: the numbers of the first and the last frame, the radius.
data Use = Use Int Int Mm

-- | Use of a cutter in a pass: the numbers of the first and the last frame of the motions @pass@,
-- and the @radius@ of the cutter. Empty if there are no motions.
useOf :: Mm -> [CutterMotion] -> [Use]
useOf radius pass = case pass of
  [] -> []
  first : later -> [Use (number first) (number (foldl' (\_ m -> m) first later)) radius]

-- | Radius of the cutter in frame @n@ of a tape that has other frames than planned. @uses@
-- are the passes that were found, in the order of the tape. A frame in a pass has the cutter of the
-- pass. A frame between two passes has the smaller cutter of the two. A frame before the first pass
-- or after the last one has the cutter of that pass. If no pass was found, the result is
-- @otherwiseRadius@.
supposedTool :: [Use] -> Mm -> Int -> Mm
supposedTool uses otherwiseRadius n =
  case ( [r | Use _ end r <- reverse uses, end < n],
         [r | Use begin _ r <- uses, begin > n],
         [r | Use begin end r <- uses, begin <= n, n <= end]
       ) of
    (_, _, r : _) -> r
    (before : _, after : _, []) -> min before after
    (before : _, [], []) -> before
    ([], after : _, []) -> after
    ([], [], []) -> otherwiseRadius
