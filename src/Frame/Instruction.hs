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
import Data.List (mapAccumL, zipWith4)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust, isNothing)
import Frame.ChordError (ChordTolerance (..))
import Frame.ChordError qualified as ChordError
import Frame.Command (Translation)
import Frame.Command qualified as Command
import Frame.CommandState (CommandState)
import Frame.CommandState qualified as CommandState
import Frame.Frame (Role (..))
import Frame.Passage (Walls)
import Frame.Passage qualified as Passage
import Frame.Rounding qualified as Rounding
import Geometry.Segment qualified as Segment
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Carving, Drilling, Milling)
import Part.Part qualified as Part
import Toolpath.DrillMove qualified as DrillMove
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
        -- | tool in the spindle: the count of tool changes before the run
        toolIndex :: Int,
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
instructions machine path = concat (arranged (zip blocks ofBlocks))
  where
    blocks = Toolpath.blocks path
    passNumbers = Toolpath.passNumbers blocks
    ofBlocks =
      zipWith
        (\t -> map (withTool t))
        (Toolpath.toolIndices blocks)
        (zipWith4 (ofBlock machine) [0 ..] passNumbers (wallsOf blocks) blocks)
    withTool t instruction = case instruction of
      Run {} -> instruction {toolIndex = t}
      Words _ _ -> instruction
    first = value <$> Toolpath.firstToolNumber (Toolpath.setup path)
    begin = CommandState.initial {CommandState.tool = first}
    arranged = case Machine.programForm machine of
      Just _ -> byState machine (begin, begin)
      Nothing -> map snd

-- | Instructions of the blocks with commands in one form: what has changed since the last move
-- ("Frame.CommandState"). @states@ are the states at the last move and now.
byState :: Machine -> (CommandState, CommandState) -> [(Block, [Instruction])] -> [[Instruction]]
byState machine states@(before, now) list = case list of
  [] -> []
  (Toolpath.Commanding c, made) : more
    | CommandState.isEvent (value c) ->
      (switched (region c) <> made) : byState machine (now, now) more
    | otherwise ->
      onlyReports made : byState machine (before, CommandState.after now (value c)) more
  (block, made) : more -> case Toolpath.moves block of
    [] -> made : byState machine states more
    m : _ -> (switched (Toolpath.origin m) <> made) : byState machine (leaving block, now) more
  where
    switched asked =
      [ Words asked (Command.Translation ws False [] [])
        | ws <- CommandState.between machine before now
      ]
    -- A tap comes out of its last hole with the spindle in the other sense.
    leaving block = case block of
      Toolpath.Holing (Located _ d) _ | Part.Tapped _ <- Part.form d -> CommandState.reversed now
      _ -> now
    onlyReports made = [Words r t {Command.numbers = []} | Words r t <- made]

-- | Walls beside the passes of a toolpath, for each block. The passes of a statement share them.
wallsOf :: [Block] -> [Walls]
wallsOf = snd . mapAccumL next (-1, Passage.walls [])
  where
    next (n, walls) b = case b of
      Toolpath.Cutting {Toolpath.job, Toolpath.pass} -> at pass [Part.contour (value job)]
      Toolpath.Clearing {Toolpath.pocket = Located _ p, Toolpath.pass} ->
        -- The cutter runs over the contours of a surface.
        at pass [c | isNothing (Part.surface p), c <- Part.contour (Part.wall p) : Part.islands p]
      _ -> ((n, walls), walls)
      where
        at pass contours
          | Toolpath.number pass == n = ((n, walls), walls)
          | otherwise = let new = Passage.walls contours in ((Toolpath.number pass, new), new)

-- | Instructions for the block @b@, which has the moves of one statement or of one of its passes.
-- The number of the block is @blockNumber@, and that of its pass is @n@, both from 0. @walls@ are
-- the walls beside the pass.
ofBlock :: Machine -> Int -> Int -> Walls -> Block -> [Instruction]
ofBlock machine blockNumber n walls b = case b of
  Toolpath.Travelling radius _ ms -> straightRuns Linking radius ms
  Toolpath.Holing d ms ->
    concat (zipWith (holing machine blockNumber d) (drop 1 (map Just ms) <> [Nothing]) ms)
  Toolpath.Carved (Located _ c) ms _ -> map (carved blockNumber c) (NonEmpty.toList ms)
  Toolpath.Commanding c -> [Words (region c) (Command.translated machine c)]
  Toolpath.Cutting
    { Toolpath.job = Located region' job,
      Toolpath.pass,
      Toolpath.approach,
      Toolpath.descent,
      Toolpath.cut,
      Toolpath.retract,
      Toolpath.sent
    } ->
      let along = milled machine job (Passage.tolerance machine job pass walls)
       in fromMaybe
            ( concat
                [ along (Approaching n) (approach <> descent),
                  along (Cutting n) (NonEmpty.toList cut),
                  along (Retracting n) retract
                ]
            )
            (compensated machine n (fromMaybe region' (Part.controlCompensation job)) job <$> sent)
  Toolpath.Clearing
    { Toolpath.pocket = Located _ p,
      Toolpath.pass,
      Toolpath.approach,
      Toolpath.cleared,
      Toolpath.retract
    } ->
      let wall = Part.wall p
          job = wall {Part.tolerance = ChordError.betweenWalls (Part.tolerance wall)}
          along = milled machine job (Passage.tolerance machine job pass walls)
       in concat
            [ along (Approaching n) approach,
              concatMap (\m -> along (roleInPocket n m) [m]) (NonEmpty.toList cleared),
              along (Retracting n) retract
            ]

-- | The run of a move of a drilling statement, which is block @n@, and the words of the commands
-- between it and the next move of the statement. The chords of circles keep the smaller limit of
-- the tolerance.
holing :: Machine -> Int -> Located Drilling -> Maybe Move -> Move -> [Instruction]
holing machine n (Located region d) = run
  where
    run following m =
      Run (Drilling n) (Sagitta limit) (Part.drillRadius d) 0 AsProgrammed (m :| []) :
        [ Words region (Command.translated machine (Located region c))
          | isJust following,
            c <- commandsAfter m
        ]
    commandsAfter = DrillMove.commandsAfter d
    limit = maybe (Mm 0) (uncurry min . Part.deviationLimits . snd) (Part.runsOf d)

-- | The run of a move of a V-carving, which is block @n@. The chords of arcs keep the smaller limit
-- of the tolerance. The radius is that of the tip: the proof compares the cone with the region that
-- is carved, and with other contours only the tip.
carved :: Int -> Carving -> Move -> Instruction
carved n c m = Run (Carving n) (Sagitta limit) (Part.carvingTip c) 0 AsProgrammed (m :| [])
  where
    limit = uncurry min (Part.deviationLimits (Part.carvingTolerance c))

-- | Runs outside of milling, one for each move, with the cutter's radius in mm, and with the tool
-- index 0. All moves are
-- straight, so the chord error is 0.
straightRuns :: Role -> Mm -> [Move] -> [Instruction]
straightRuns r radius = map (Run r (Sagitta (Mm 0)) radius 0 AsProgrammed . (:| []))

-- | Runs along the moves of a milling job, all with the role @r@. The function @limited@ may reduce
-- the chord tolerance of a run.
milled ::
  Machine ->
  Milling ->
  (NonEmpty Move -> ChordTolerance -> ChordTolerance) ->
  Role ->
  [Move] ->
  [Instruction]
milled machine job limited r =
  map (\ms -> Run r (limited ms (tolerance ms)) (Part.radius job) 0 AsProgrammed ms)
    . Toolpath.curveRuns
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
      [ along (Approaching n) (Toolpath.before edge),
        [Words asked on],
        single (Approaching n) (Toolpath.entry edge),
        concatMap (single (Cutting n)) (Toolpath.edge edge),
        [Words asked (Command.compensationOff machine)],
        single (Retracting n) (Toolpath.exit edge),
        along (Retracting n) (Toolpath.behind edge)
      ]
  | otherwise = [Words asked on]
  where
    on = Command.compensationOn machine asked (Toolpath.side edge) (Part.radius job)
    single r m = along r [m {continues = False}]
    along = milled machine job (const id)

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
