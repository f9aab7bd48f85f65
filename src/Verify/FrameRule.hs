-- | Two rules for the frames of a tape that do not depend on the shape of the part. The control has
-- to accept every frame, and the commands have to be those of the program.
module Verify.FrameRule
  ( refused,
    wrongCommands,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), minus, plus, times)
import Control.Motion (Motion (..))
import Control.Motion qualified as Control
import Data.List (nub)
import Frame.Frame (Frame, FrameMotion (..), FrameProgram)
import Frame.Frame qualified as Frame
import Geometry.Tolerance qualified as Tolerance
import Machine.Machine (CommandName, Machine)
import Machine.Machine qualified as Machine
import Verify.Proof (Finding (..), Refusal (..))
import Verify.TapeSummary (isNear)

-- Frames that a control refuses -------------------------------------------------------------------

-- | Findings for frames that the control refuses: frames that break a rule of the machine, and
-- impossible arcs. @begin@ is the position before the first frame, in pulses.
refused :: Machine -> Pulses3 -> [Frame] -> [Finding]
refused machine begin = go (Start 1 begin)
  where
    go :: Start -> [Frame] -> [Finding]
    go start@(Start n at) frames = case frames of
      [] -> []
      f : more -> case refusals machine n at f of
        [] -> go (startAfter f start) more
        reasons -> map Refused reasons <> go (startAfter f start) more

-- | Number of a frame, counted from 1, and the position at which it starts.
data Start = Start Int Pulses3

-- | Number and start position of the frame after @f@, from those of @f@.
startAfter :: Frame -> Start -> Start
startAfter f (Start n at) = Start (n + 1) (at + Frame.increment f)

-- | Reasons to refuse the frame @f@ with the number @n@, from 1, which starts at the position @at@.
refusals :: Machine -> Int -> Pulses3 -> Frame -> [Refusal]
refusals machine n at f =
  map ByRule (Frame.frameViolations machine n f) <> case Frame.motion f of
    Circular _ -> impossibleArc machine n at f
    NoMotion -> []
    Rapid -> []
    Linear -> []

-- | Reasons to refuse the arc of frame @n@, which starts at the position @at@. Its radii at start
-- and end may differ by two pulses at most. Its end must not be the centre. If start and end lie in
-- the same direction from the centre, they have to be the same point; the arc is a full circle.
impossibleArc :: Machine -> Int -> Pulses3 -> Frame -> [Refusal]
impossibleArc machine n at f =
  [ UnequalRadii n (minus b a)
    | Just (a, b) <- [Control.radii machine motion],
      max (minus a b) (minus b a) > plus largestDifference Tolerance.coincident
  ]
    <> [ NoSweep n
         | Frame.centre f /= 0,
           not (Control.isRound f) || isElsewhere && Control.endsInStartDirection f
       ]
  where
    isElsewhere = let Pulses3 x y _ = Frame.increment f in x /= 0 || y /= 0
    motion = Motion {number = n, from = at, to = at + Frame.increment f, frame = f}
    largestDifference = times 2 (Machine.planeResolution machine)

-- Commands ----------------------------------------------------------------------------------------

-- | Commands of a frame: the name of each and the number that is given with it.
type Commands = [(CommandName, Int)]

-- | Findings for frames whose commands differ from those of the planned frames. If @isAligned@ is
-- true, each frame ends where the planned frame of the same number ends, and they are compared
-- frame by frame. On any other tape, the first frame with commands is compared with the first such
-- planned frame, the second with the second, and so on. The positions at which the two frames of a
-- pair begin may differ by at most two pulses on each axis. @isSamePlace@ tells of a planned frame
-- and of a frame of the tape, both given by their numbers, whether the same motions come before
-- them.
wrongCommands :: Bool -> (Int -> Int -> Bool) -> FrameProgram -> [Frame] -> [Finding]
wrongCommands isAligned isSamePlace program frames =
  [ WrongCommand n name (lookup name found) (lookup name wanted)
    | (n, wanted, found) <- differences,
      name <- nub (map fst (wanted <> found)),
      lookup name wanted /= lookup name found
  ]
  where
    planned = map Frame.frame (Frame.plannedFrames program)
    commanded = map Frame.commands planned
    differences
      | isAligned = frameByFrame 1 commanded (map Frame.commands frames)
      | otherwise = inOrder isSamePlace (length frames) (positioned planned) (positioned frames)

-- | Frames with different commands. @n@ is the number of the first frame in both lists. @own@ has
-- the commands of the planned frames, @found@ those of the frames on the tape. Each entry of the
-- result has the number of the frame, the planned commands and those of the tape. A frame that only
-- one list has is compared with a frame without commands.
frameByFrame :: Int -> [Commands] -> [Commands] -> [(Int, Commands, Commands)]
frameByFrame n own found = case (own, found) of
  (a : as, b : bs) | a == b -> frameByFrame (n + 1) as bs
  (a : as, b : bs) -> (n, a, b) : frameByFrame (n + 1) as bs
  (_, []) -> zipWith (\k a -> (k, a, [])) [n ..] own
  ([], _) -> zipWith (\k b -> (k, [], b)) [n ..] found

-- | Frames with commands. Each entry has the number of the frame from 1, the position where the
-- frame begins, and its commands. Positions are in pulses from the start of the tape.
positioned :: [Frame] -> [(Int, Pulses3, Commands)]
positioned fs =
  [ (n, at, Frame.commands f)
    | (n, at, f) <- zip3 [1 ..] (scanl (+) 0 (map Frame.increment fs)) fs,
      not (null (Frame.commands f))
  ]

-- | Differences between the planned frames with commands and the frames with commands on the tape,
-- compared in pairs. An entry of both lists has the number of a frame from 1, the position in
-- pulses where the frame begins, and its commands. An entry of the result has the number of a frame
-- on the tape, the planned commands, and those of the tape. Frames that only one list has are
-- found if at most 'mostSkipped' of them follow one another. If the positions of a pair differ by
-- more than two pulses, or if 'isSamePlace' as in 'wrongCommands' is false for the pair, the
-- planned frame counts as one without commands. Planned commands that are missing at the end of the
-- tape get the number of their planned frame, but at least @frameCount@, the count of frames on the
-- tape.
inOrder ::
  (Int -> Int -> Bool) ->
  Int ->
  [(Int, Pulses3, Commands)] ->
  [(Int, Pulses3, Commands)] ->
  [(Int, Commands, Commands)]
inOrder isSamePlace frameCount = go
  where
    go own found = case (own, found) of
      (planned@(_, _, a) : as, read'@(n, _, b) : bs)
        | isSame planned read' -> go as bs
        | (gone, rest@(_ : _)) <- break (`isSame` read') (take mostSkipped own) ->
          [(n, c, []) | (_, _, c) <- gone] <> go (rest <> drop mostSkipped own) found
        | (more, rest@(_ : _)) <- break (isSame planned) (take mostSkipped found) ->
          [(m, [], c) | (m, _, c) <- more] <> go own (rest <> drop mostSkipped found)
        | isThere planned read' -> (n, a, b) : go as bs
        | otherwise -> (n, [], b) : go as bs
      (_, []) -> [(max k frameCount, a, []) | (k, _, a) <- own]
      ([], _) -> [(n, [], b) | (n, _, b) <- found]
    isSame x@(_, _, a) y@(_, _, b) = a == b && isThere x y
    isThere (k, p, _) (n, q, _) = isNear p q && isSamePlace k n

-- | Largest count of frames with commands that 'inOrder' passes over at once.
mostSkipped :: Int
mostSkipped = 6
