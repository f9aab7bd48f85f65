-- | Instructions: the toolpath as a sequence of runs and commands, before anything is rounded.
--
-- A run is a sequence of moves along one line, arc or curve. An instruction is either a run with
-- its purpose, its tolerance and its feed, or the words of a command. "Frame.Braking" divides runs,
-- and "Frame.FromToolpath" makes frames of the instructions.
module Frame.Instruction
  ( Instruction (..),
    FeedMode (..),
    instructions,
    lengthOf,
    cutBeforeEnd,
  )
where

import Base.Quantity (Feed, Mm (..), minus)
import Base.Region (Located (..), Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Frame.ChordError (ChordTolerance (..))
import Frame.ChordError qualified as ChordError
import Frame.Command (Translation)
import Frame.Command qualified as Command
import Frame.Frame (Role (..))
import Frame.Rounding qualified as Rounding
import Geometry.Segment qualified as Segment
import Machine.Machine (Machine)
import Part.Part (Milling)
import Part.Part qualified as Part
import Toolpath.Toolpath (Block, Move (..), Sent, Toolpath, heights, pace)
import Toolpath.Toolpath qualified as Toolpath

-- | One instruction: a run of moves, or the words of a command.
data Instruction
  = -- | moves along one line, arc or curve
    Run
      { role :: Role,
        tolerance :: ChordTolerance,
        -- | radius of the cutter in mm
        cutterRadius :: Mm,
        feedMode :: FeedMode,
        run :: NonEmpty Move
      }
  | -- | words of a command, or the words that switch cutter compensation, and the region of the
    -- program that asks for them
    Words Region Translation

-- | The feed with which a run is made.
data FeedMode
  = -- | the feed that the program gives
    AsProgrammed
  | -- | the machine's lowest feed code, at the end of an element with braking
    LowestCode
  | -- | this feed at the end of the braking section, in frames that are marked as braking
    BrakingTo Feed
  deriving stock (Eq, Show)

-- | Instructions for a toolpath, in the order of the toolpath.
instructions :: Machine -> Toolpath -> [Instruction]
instructions machine path =
  concat (zipWith (ofBlock machine) (Toolpath.passNumbers blocks) blocks)
  where
    blocks = Toolpath.blocks path

-- | Instructions for the block @b@, which has the moves of one statement or of one of its passes.
-- The number of its pass is @n@, from 0.
ofBlock :: Machine -> Int -> Block -> [Instruction]
ofBlock machine n b = case b of
  Toolpath.Travelling radius _ ms -> straightRuns Linking radius ms
  Toolpath.Holing (Located _ d) ms -> straightRuns Drilling (Part.drillRadius d) ms
  Toolpath.Commanding c -> [Words (region c) (Command.translated machine c)]
  Toolpath.Cutting
    { Toolpath.job = Located region' job,
      Toolpath.approach,
      Toolpath.cut,
      Toolpath.retract,
      Toolpath.sent
    } ->
      fromMaybe
        ( concat
            [ milled machine (Approaching n) job approach,
              milled machine (Cutting n) job (NonEmpty.toList cut),
              milled machine (Retracting n) job retract
            ]
        )
        (compensated machine n (fromMaybe region' (Part.controlCompensation job)) job <$> sent)
  Toolpath.Clearing
    { Toolpath.pocket = Located _ p,
      Toolpath.approach,
      Toolpath.cleared,
      Toolpath.retract
    } ->
      let wall = Part.wall p
          job = wall {Part.tolerance = ChordError.betweenWalls (Part.tolerance wall)}
       in concat
            [ milled machine (Approaching n) job approach,
              concatMap (\m -> milled machine (roleInPocket n m) job [m]) (NonEmpty.toList cleared),
              milled machine (Retracting n) job retract
            ]

-- | Runs outside of milling, one for each move, with the cutter's radius in mm. All moves are
-- straight, so the chord error is 0.
straightRuns :: Role -> Mm -> [Move] -> [Instruction]
straightRuns r radius = map (Run r (Sagitta (Mm 0)) radius AsProgrammed . (:| []))

-- | Runs along the moves of a milling job, all with the role @r@.
milled :: Machine -> Role -> Milling -> [Move] -> [Instruction]
milled machine r job =
  map (\ms -> Run r (tolerance ms) (Part.radius job) AsProgrammed ms) . Toolpath.curveRuns
  where
    tolerance = ChordError.chordTolerance machine job

-- | Role of the move @m@ in the pocket that is pass @n@. Where material or an island lies between
-- two cuts, the cutter retracts with a rapid move and approaches again.
roleInPocket :: Int -> Move -> Role
roleInPocket n m
  | pace m == Part.Rapid = Retracting n
  | uncurry (/=) (heights m) = Approaching n
  | otherwise = Cutting n

-- | Instructions for pass @n@ with cutter compensation, for which the region @asked@ of the program
-- asks. The control gets the edge of the part in place of the toolpath, and the words that switch
-- compensation on and off. Every move of the edge is a run of its own, even along a curve. If the
-- machine has no such words, the instructions contain only the errors about them.
compensated :: Machine -> Int -> Region -> Milling -> Sent -> [Instruction]
compensated machine n asked job edge
  | null (Command.errors on) =
    concat
      [ milled machine (Approaching n) job (Toolpath.before edge),
        [Words asked on],
        single (Approaching n) (Toolpath.entry edge),
        concatMap (single (Cutting n)) (Toolpath.edge edge),
        [Words asked (Command.compensationOff machine)],
        single (Retracting n) (Toolpath.exit edge),
        milled machine (Retracting n) job (Toolpath.behind edge)
      ]
  | otherwise = [Words asked on]
  where
    on = Command.compensationOn machine asked (Toolpath.side edge) (Part.radius job)
    single r m = milled machine r job [m {continues = False}]

-- | Length of a move in space, in mm.
lengthOf :: Move -> Mm
lengthOf m = Mm (sqrt (l * l + h * h))
  where
    Mm l = Segment.length (segment m)
    Mm h = uncurry minus (heights m)

-- | The two parts of a move that is cut @distance@ mm before its end. The move has to be longer
-- than that.
cutBeforeEnd :: Double -> Move -> (Move, Move)
cutBeforeEnd distance m =
  ( Toolpath.withoutBraking (Toolpath.atHeights (fst (heights m), z) m) {segment = front},
    (Toolpath.atHeights (z, snd (heights m)) m) {segment = back}
  )
  where
    Mm l = lengthOf m
    share = 1 - distance / l
    (front, back) = Segment.cutAt share (segment m)
    z = Rounding.heightAt share m
