-- | Statements that a program needs before a file for a lathe can be written, and the refusal of a
-- program for the other kind of machine.
module Gcode.LatheRequirement
  ( refusals,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Data.Maybe (isJust, isNothing, listToMaybe, maybeToList)
import Data.Text (Text)
import Machine.Machine (Machine, MachineName (..), ProgramForm (..))
import Machine.Machine qualified as Machine
import Part.Part (Cutter)
import Part.Part qualified as Part
import Report.Report (Label (Label), Report (hints, label, message, others), at)
import Toolpath.Toolpath (Block, Toolpath (..))
import Toolpath.Toolpath qualified as Toolpath

-- | Errors of a program for a lathe, or of a turned program for a machine that is none.
refusals :: Machine -> ProgramForm -> Toolpath -> [Report]
refusals machine form path
  | isJust (lathe form) = case listToMaybe (milled path) of
    Just region -> [cannotMill machine region]
    Nothing -> concatMap (toolFaults machine) (take 1 (untipped <> twice))
  | otherwise = map (cannotTurn machine) (take 1 (turned path))
  where
    tools = toolsOf path
    untipped = [NoTip region tool | (region, tool) <- tools, isNothing (Part.tip (snd tool))]
    twice =
      [ TwoTools region before tool
        | (k, (region, tool)) <- zip [0 ..] tools,
          (before, first) <- take 1 (filter ((== fst tool) . fst . snd) (take k tools)),
          isOther (snd first) (snd tool)
      ]
    isOther a b =
      (Part.kind a, Part.cutterRadius a, Part.tip a)
        /= (Part.kind b, Part.cutterRadius b, Part.tip b)

-- | Fault of a tool, which has a number and a cutter.
data ToolFault
  = -- | the program does not say which point the tool table measures
    NoTip Region (Int, Cutter)
  | -- | the number is that of another tool before
    TwoTools Region Region (Int, Cutter)

machineName :: Machine -> Text
machineName machine = let MachineName n = Machine.name machine in n

-- | Tools of a program in the order of their use, each with the region that puts it into use. A
-- first tool without a number has the number 0.
toolsOf :: Toolpath -> [(Region, (Int, Cutter))]
toolsOf path =
  [ (maybe (region (start path)) region number, (maybe 0 value number, cutter))
    | cutter <- maybeToList (Toolpath.firstCutter (setup path))
  ]
    <> [ (at', (n, cutter))
         | Toolpath.Commanding (Located at' (Part.ChangeTool n cutter)) <- blocks path
       ]
  where
    number = Toolpath.firstToolNumber (setup path)

-- | Regions of the statements that mill, drill or use a tool that does not turn.
milled :: Toolpath -> [Region]
milled path =
  concatMap ofBlock (blocks path)
    <> [region | (region, (_, cutter)) <- toolsOf path, Part.kind cutter /= Part.TurningCutter]
  where
    ofBlock :: Block -> [Region]
    ofBlock block = case block of
      Toolpath.Cutting {Toolpath.job = Located region job} ->
        [region | Part.work job /= Part.Turned]
      Toolpath.Clearing {Toolpath.pocket = Located region _} -> [region]
      Toolpath.Holing (Located region _) _ -> [region]
      Toolpath.Carved (Located region _) _ _ -> [region]
      Toolpath.Travelling {} -> []
      Toolpath.Commanding _ -> []

-- | Regions of the statements that turn or use a turning tool.
turned :: Toolpath -> [Region]
turned path =
  [ region
    | Toolpath.Cutting {Toolpath.job = Located region job} <- blocks path,
      Part.work job == Part.Turned
  ]
    <> [region | (region, (_, cutter)) <- toolsOf path, Part.kind cutter == Part.TurningCutter]

cannotMill :: Machine -> Region -> Report
cannotMill machine region =
  (at region "E0517" "a lathe does not mill")
    { message = [machineName machine <> " turns only. It has no z axis and no milling cutters."],
      hints =
        ["Compile for a milling machine, or write ‘turn’ with a tool ‘turn(nose 0.8 mm, tip 2)’."]
    }

cannotTurn :: Machine -> Region -> Report
cannotTurn machine region =
  (at region "E0517" "a milling machine does not turn")
    { message = [machineName machine <> " mills. Its words X and Y are not those of a lathe."],
      hints = ["Compile for a lathe, such as linuxcnc-lathe."]
    }

toolFaults :: Machine -> ToolFault -> [Report]
toolFaults machine fault = case fault of
  NoTip region (n, cutter) ->
    [ (at region "E0518" "the direction of the tip of this tool is not known")
        { message =
            [ "The file for "
                <> machineName machine
                <> " leads the point that the tool table measures, not the centre of the nose."
            ],
          hints =
            [ "Write the direction of the tip as the tool table has it: ‘"
                <> (if n > 0 then Decimal.whole n <> " " else "")
                <> "turn(nose "
                <> Decimal.mm (Part.cutterRadius cutter)
                <> ", tip "
                <> (if Part.cutterRadius cutter == Mm 0 then "9" else "2")
                <> ")’."
            ]
        }
    ]
  TwoTools region before (n, _) ->
    [ (at region "E0519" ("tool " <> Decimal.whole n <> " was another tool before"))
        { label = "another nose or tip",
          others = [Label before "this number is taken"],
          message = ["The tool table has one tool for each number."],
          hints = ["Give each tool a number of its own."]
        }
    ]
