-- | Requirements of a file for a modern control that its program has to meet. Nothing in the file
-- may depend on what the program before has left in the control.
module Gcode.Requirement
  ( refusals,
  )
where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (LengthUnit (..), Mm (..), plus, times)
import Base.Region (Located (..), Region)
import Data.List (find, mapAccumL)
import Data.Maybe (isNothing, mapMaybe)
import Data.Text (Text)
import Frame.CommandState (CommandState)
import Frame.CommandState qualified as CommandState
import Frame.Frame (FrameProgram (FrameProgram), PlannedFrame (frame))
import Frame.Frame qualified as Frame
import Gcode.Heading (FileHeading (..))
import Gcode.Heading qualified as Heading
import Gcode.LatheRequirement qualified as LatheRequirement
import Gcode.Writer qualified as Writer
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine, MachineName (..), ProgramForm (..))
import Machine.Machine qualified as Machine
import Machine.ProgramForm (RapidPath (..), Retract (..))
import Machine.ProgramForm qualified as ProgramForm
import Part.Part (SpacePoint (..))
import Part.Part qualified as Part
import Report.Report (Label (Label), Report (hints, label, message, others), at)
import Toolpath.Toolpath (Block, Toolpath (..))
import Toolpath.Toolpath qualified as Toolpath

-- | Errors of a program for a machine with this form of programs.
refusals :: Machine -> ProgramForm -> FileHeading -> Toolpath -> FrameProgram -> [Report]
refusals machine form heading path program =
  spindleErrors machine heading path
    <> [withoutHeights machine path | isNothing (lathe form), isFlatMilling]
    <> lowStart machine path program
    <> toolErrors machine form heading path
    <> safeErrors machine form heading path program
    <> LatheRequirement.refusals machine form path
    <> [boxError machine path m | BoxPath <- [rapidPath form], m <- take 1 (boxMoves path)]
  where
    isFlatMilling = Toolpath.isFlat path && not (Toolpath.isTurned path)

machineName :: Machine -> Text
machineName machine = let MachineName n = Machine.name machine in n

-- | Error at the first cut for which the program does not say that the spindle turns, or how fast.
spindleErrors :: Machine -> FileHeading -> Toolpath -> [Report]
spindleErrors machine heading path
  | isSpindleByHand heading = []
  | otherwise = case mapMaybe notTurning (zip (statesAt (blocks path)) (blocks path)) of
    first : _ -> [first]
    [] -> []
  where
    notTurning (state, block) = case CommandState.spindle state of
      Nothing -> off <$> cutOf block
      Just (_, CommandState.NoNumber) -> slow <$> cutOf block
      Just (_, CommandState.TurnNumber n)
        | n > 0 -> Nothing
        | otherwise -> slow <$> cutOf block
      Just (_, CommandState.SurfaceNumbers v _)
        -- It is written in whole m/min or ft/min.
        | v > 500 -> Nothing
        | otherwise -> slow <$> cutOf block
    off region =
      (at region "E0511" "the spindle is off at this cut")
        { label = "this cuts",
          message =
            [ "On "
                <> machineName machine
                <> " the program starts the spindle. A cut with the spindle off breaks the tool."
            ],
          hints = ["Write ‘spindle cw 8000 rpm’ before it, with your speed.", byHand]
        }
    slow region =
      (at region "E0511" "the spindle has no speed at this cut")
        { label = "this cuts",
          message =
            [ "On "
                <> machineName machine
                <> " the program sets the speed. Without one, the control keeps the speed of the \
                   \program that it ran before."
            ],
          hints = ["Write the speed, as in ‘spindle cw 8000 rpm’.", byHand]
        }
    byHand = "Write ‘spindle manual’ if the spindle is switched by hand."

-- | State of tool, spindle and coolant in each block.
statesAt :: [Block] -> [CommandState]
statesAt = snd . mapAccumL step CommandState.initial
  where
    step state block = case block of
      Toolpath.Commanding (Located _ c) -> let new = CommandState.after state c in (new, new)
      _ -> (state, state)

-- | Region of the statement of a block that cuts; Nothing for a block of rapid moves and for a
-- command.
cutOf :: Block -> Maybe Region
cutOf block = case block of
  Toolpath.Cutting {Toolpath.job = Located region _} -> Just region
  Toolpath.Clearing {Toolpath.pocket = Located region _} -> Just region
  Toolpath.Holing (Located region _) _ -> Just region
  Toolpath.Carved (Located region _) _ _ -> Just region
  Toolpath.Travelling _ _ ms -> Toolpath.origin <$> find ((/= Part.Rapid) . Toolpath.pace) ms
  Toolpath.Commanding _ -> Nothing

-- | Error of a program that never changes the height.
withoutHeights :: Machine -> Toolpath -> Report
withoutHeights machine path =
  (at (region (start path)) "E0512" "the program has no heights")
    { message =
        [ "All its moves are at the height of its start. On "
            <> machineName machine
            <> " the program moves z, so the tool would cut from the first move on."
        ],
      hints =
        [ "Write ‘clearance "
            <> usual path (Mm 5)
            <> "’ before the machining, and ‘depth "
            <> usual path (Mm 8)
            <> "’ in each ‘mill’, with your heights."
        ]
    }

-- | A length for a hint, with its unit: in an inch program the same in tenths of an inch.
usual :: Toolpath -> Mm -> Text
usual path (Mm x) = case Toolpath.unit path of
  Millimetres -> Decimal.mm (Mm x)
  Inches -> Decimal.short 1 (x / 25.4) <> " in"

-- | Error of a program at whose start the tool would come down below the clearance height.
lowStart :: Machine -> Toolpath -> FrameProgram -> [Report]
lowStart machine path program = case Heading.clearances path of
  heights@(_ : _)
    | plus down (halfPulse machine) < maximum heights ->
      [ (at (region (start path)) "E0513" "the program begins below its clearance height")
          { label = "at the height " <> written down,
            message =
              [ "The tool comes down to this height first, and the moves from there may hit a \
                \clamp. The clearance height is "
                  <> written (maximum heights)
                  <> "."
              ],
            hints =
              ["Begin at this height, as in ‘from (0, 0, " <> written (maximum heights) <> ")’."]
          }
      ]
  _ -> []
  where
    down = Frame.height machine (landingOf program)
    written = Decimal.inUnit (Toolpath.unit path)

-- | Error of a program whose first tool has no number.
toolErrors :: Machine -> ProgramForm -> FileHeading -> Toolpath -> [Report]
toolErrors machine form heading path =
  [ (at (region (start path)) "E0514" "the first tool has no number")
      { message =
          [ if ProgramForm.changesTools (dialect form)
              then
                machineName machine
                  <> " takes the length of each tool from the tool table of the control, by the \
                     \number of the tool."
              else "Each tool has a file of its own, with the number of the tool in its name."
          ],
        hints =
          [ "Write the number before the tool, as in ‘tool 1 "
              <> maybe
                ("mill(diameter " <> usual path (Mm 8) <> ")")
                (const "turn(nose 0.8 mm, tip 2)")
                (lathe form)
              <> "’."
          ]
      }
    | ProgramForm.changesTools (dialect form) || not (null (toolOrder heading)),
      isNothing (firstTool heading)
  ]

-- | Error of a program without a safe height, on a control that needs one, or of a program that
-- goes higher.
safeErrors :: Machine -> ProgramForm -> FileHeading -> Toolpath -> FrameProgram -> [Report]
safeErrors machine form heading path program = case retract form of
  MachineHeight _ -> []
  ReferencePoint -> []
  SafeHeight _ -> case Heading.safeHeightOn form heading of
    Nothing -> [missing]
    Just safe
      | highest > plus safe (halfPulse machine) -> [tooLow safe]
      | otherwise -> []
  where
    missing =
      (at (region (start path)) "E0515" "the program has no safe height")
        { message =
            [ machineName machine
                <> " does not know where its z axis stands, so the tool first goes up to a height \
                   \above everything. The program has to give that height."
            ],
          hints =
            [ "Write ‘safe "
                <> usual path (Mm 40)
                <> "’ before the machining, with a height above all clamps."
            ]
        }
    tooLow safe =
      (at (region (start path)) "E0515" "the program goes above its safe height")
        { message =
            [ "The safe height is "
                <> written safe
                <> ", and the program goes up to "
                <> written highest
                <> "."
            ],
          hints = ["Write a higher ‘safe’, or let the program stay below it."]
        }
    highest = Frame.height machine (Pulses3 0 0 (Heading.highest program))
    written = Decimal.inUnit (Toolpath.unit path)

-- | Rapid move for which only the straight line is free: its region, and true if it comes down from
-- a start above the clearance height.
data BoxMove = BoxMove Region Bool

-- | Error of a rapid move whose axes arrive one after the other, where only the straight line is
-- free.
boxError :: Machine -> Toolpath -> BoxMove -> Report
boxError machine path (BoxMove asked comesDown)
  | comesDown =
    (wrong (region (start path)))
      { label = "above the clearance height",
        message =
          [ "The first move goes across and down at once, from the start at "
              <> written begin
              <> " to the clearance height of "
              <> written clear
              <> ".",
            reason
          ],
        others = [Label asked "this asks for the first move"],
        hints = ["Begin at the clearance height, as in ‘from (0, 0, " <> written clear <> ")’."]
      }
  | otherwise =
    (wrong asked) {message = [reason], hints = ["Divide it: z alone, then x alone, then y alone."]}
  where
    wrong place = at place "E0516" "the axes of this rapid move may arrive one after the other"
    SpacePoint _ begin = value (start path)
    clear = Heading.highestClearance path
    written = Decimal.inUnit (Toolpath.unit path)
    reason =
      machineName machine
        <> " does not move along a straight line in rapid, so the tool may hit a clamp or the \
           \part. Safe are moves of one axis alone, and of x and y together at the clearance \
           \height or above it."

-- | Rapid moves that change z together with x or y, or that change x and y below the clearance
-- height.
boxMoves :: Toolpath -> [BoxMove]
boxMoves path =
  [ BoxMove (Toolpath.origin m) (isFirst && isMachining block && before > max free behind)
    | (isFirst, (block, m)) <- zip (True : repeat False) moves,
      Toolpath.pace m == Part.Rapid,
      let (before, behind) = Toolpath.heights m
          from = Segment.start (Toolpath.segment m)
          to = Segment.end (Toolpath.segment m)
          movesX = Vec.x from /= Vec.x to
          movesY = Vec.y from /= Vec.y to,
      (movesX || movesY) && before /= behind || movesX && movesY && before < free
  ]
  where
    free = Heading.highestClearance path
    moves = [(block, m) | block <- blocks path, m <- Toolpath.moves block]
    isMachining block = case block of
      Toolpath.Travelling {} -> False
      _ -> True

-- | Half of a pulse along z: heights in pulses are rounded by so much at most.
halfPulse :: Machine -> Mm
halfPulse machine = times 0.5 (Machine.resolutionOf machine Machine.Z)

-- | Position in pulses at which the tool comes down first.
landingOf :: FrameProgram -> Pulses3
landingOf (FrameProgram begin planned) = Writer.landing begin (map frame planned)
