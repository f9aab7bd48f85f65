-- | The heading of a G-code file, which has no motions: the part, the tools, the work offset.
module Gcode.Heading
  ( FileHeading (..),
    fromToolpath,
    safeHeightOn,
    raised,
    aboveEverything,
    highest,
    clearances,
    highestClearance,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (LengthUnit, Mm (..), Pulses (..), degrees, times)
import Base.Region (Located (..))
import Control.Applicative ((<|>))
import Data.Containers.ListUtils (nubOrdOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Frame.CommandState qualified as CommandState
import Frame.Frame (FrameProgram (..))
import Frame.Frame qualified as Frame
import Gcode.HoleCycle (TapNeed (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Machine.ProgramForm (ProgramForm (..), Retract (..))
import Part.Part (Cutter, Milling)
import Part.Part qualified as Part
import Toolpath.Toolpath (Block, Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | Facts of a file besides its frames.
data FileHeading = FileHeading
  { partName :: Text,
    partTitle :: Text,
    -- | number of the work offset, 54 to 59
    workOffset :: Int,
    programNumber :: Maybe Int,
    -- | number of the tool that is in the spindle first
    firstTool :: Maybe Int,
    -- | the tools in the order of their use, each with its number and a description
    toolList :: [(Int, Text)],
    -- | numbers of the tools as the program changes them, without those that do nothing
    toolOrder :: [Int],
    -- | height in mm that is above everything, in work coordinates
    safeHeight :: Maybe Mm,
    -- | height in mm from which on rapid moves pass over everything
    freeHeight :: Mm,
    isSpindleByHand :: Bool,
    -- | tools by their numbers
    cutters :: Map Int Cutter,
    -- | numbers of the passes that turn the inside of the part
    insidePasses :: Set Int,
    -- | the turnings of the program
    turnings :: [Milling],
    -- | the taps, by the numbers of their blocks
    tapNeeds :: Map Int TapNeed
  }
  deriving stock (Eq, Show)

-- | Heading of the files of a toolpath.
fromToolpath :: Toolpath -> FileHeading
fromToolpath path =
  FileHeading
    { partName = maybe "" (\(Name n) -> n) (Toolpath.partName setup),
      partTitle = Toolpath.partTitle setup,
      workOffset = maybe 54 value (Toolpath.workOffset setup),
      programNumber = value <$> Toolpath.programNumber setup,
      firstTool,
      toolOrder = maybe id (:) firstTool (changesIn blocks),
      toolList = nubOrdOn fst (first <> changed),
      safeHeight = value <$> Toolpath.safeHeight setup,
      freeHeight = highestClearance path,
      isSpindleByHand = or [True | Part.SpindleByHand <- commands],
      cutters = Map.fromList (numbered <> [(n, c) | Part.ChangeTool n c <- commands]),
      insidePasses =
        Set.fromList
          [ n
            | (n, job) <- turned,
              isBelow job
          ],
      turnings = [job | (_, job) <- turned],
      tapNeeds = tapsOf blocks
    }
  where
    setup = Toolpath.setup path
    blocks = Toolpath.blocks path
    turned =
      [ (n, job)
        | (n, Toolpath.Cutting {Toolpath.job = Located _ job}) <-
            zip (Toolpath.passNumbers blocks) blocks,
          Part.work job == Part.Turned
      ]
    commands = [value c | Toolpath.Commanding c <- blocks]
    firstTool = value <$> Toolpath.firstToolNumber setup
    numbered = [(n, c) | Just n <- [firstTool], Just c <- [Toolpath.firstCutter setup]]
    unit = Toolpath.unit path
    first = [(n, cutterText unit c) | (n, c) <- numbered]
    changed = [(n, cutterText unit cutter) | Part.ChangeTool n cutter <- commands]

-- | Numbers of the tools that are changed to, in order. A tool that makes no move before the next
-- change is left out, as in the frames.
changesIn :: [Block] -> [Int]
changesIn blocks = case blocks of
  [] -> []
  Toolpath.Commanding (Located _ (Part.ChangeTool n _)) : more
    | isUsed more -> n : changesIn more
  _ : more -> changesIn more
  where
    isUsed more = case more of
      [] -> False
      Toolpath.Commanding (Located _ (Part.ChangeTool _ _)) : _ -> False
      Toolpath.Commanding (Located _ c) : rest -> CommandState.isEvent c || isUsed rest
      b : rest -> not (null (Toolpath.moves b)) || isUsed rest

-- | The taps of blocks, by the numbers of the blocks.
tapsOf :: [Block] -> Map Int TapNeed
tapsOf blocks =
  Map.fromList
    [ (n, TapNeed (Part.tapPitch t) (isJust (Part.floats t)))
      | (n, Toolpath.Holing (Located _ d) _) <- zip [0 ..] blocks,
        Part.Tapped t <- [Part.form d]
    ]

-- | Safe height in mm on a control that needs one: that of the program, or else that of the
-- description. Nothing on other controls, and if neither states one.
safeHeightOn :: ProgramForm -> FileHeading -> Maybe Mm
safeHeightOn form heading = case retract form of
  SafeHeight own -> safeHeight heading <|> own
  MachineHeight _ -> Nothing
  ReferencePoint -> Nothing

-- | Test that a turning cuts from below its profile, towards larger radii.
isBelow :: Milling -> Bool
isBelow job = case value (Part.side job) of
  Part.Inside -> True
  Part.Outside -> False
  Part.On -> False
  Part.LeftSide -> finish < begin
  Part.RightSide -> finish > begin
  where
    elements = Part.elements (Part.contour job)
    begin = Vec.x (Segment.start (Part.segment (NonEmpty.head elements)))
    finish = Vec.x (Segment.end (Part.segment (NonEmpty.last elements)))

-- | The heading with a safe height in whole pulses above all motions of the program. If the program
-- itself goes up to its safe height, this is one pulse more, so that no motion of the program is
-- taken for one above everything.
raised :: Machine -> ProgramForm -> FrameProgram -> FileHeading -> FileHeading
raised machine form program heading = case aboveEverything machine <$> safeHeightOn form heading of
  Nothing -> heading
  Just level ->
    let free = if highest program == level then level + 1 else level
     in heading {safeHeight = Just (Frame.height machine (Pulses3 0 0 free))}

-- | Height in pulses at a safe height in mm, or directly above it.
aboveEverything :: Machine -> Mm -> Pulses
aboveEverything machine (Mm z) = Pulses (ceiling (z / resolution - 1.0e-6))
  where
    Mm resolution = Machine.resolutionOf machine Machine.Z

-- | Highest position of a program in pulses.
highest :: FrameProgram -> Pulses
highest FrameProgram {start, plannedFrames} =
  maximum (map height (scanl (+) start (map (Frame.increment . Frame.frame) plannedFrames)))
  where
    height (Pulses3 _ _ z) = z

-- | Clearance heights of the machining statements.
clearances :: Toolpath -> [Mm]
clearances = concatMap heightsOf . Toolpath.blocks
  where
    heightsOf block = case block of
      Toolpath.Cutting {Toolpath.job = Located _ job} -> milling job
      Toolpath.Clearing {Toolpath.pocket = Located _ p} -> milling (Part.wall p)
      Toolpath.Holing (Located _ d) _ -> [Part.travelHeight d]
      Toolpath.Carved (Located _ c) _ _ -> [Part.carvingTravel c]
      Toolpath.Travelling {} -> []
      Toolpath.Commanding _ -> []
    milling job = maybe [] pure (Part.clearance job)

-- | Highest clearance height; infinite if no machining statement has one.
highestClearance :: Toolpath -> Mm
highestClearance path = case clearances path of
  [] -> Mm (1 / 0)
  heights -> maximum heights

-- | Description of a tool: its kind and its diameter, or the radius of its nose.
cutterText :: LengthUnit -> Cutter -> Text
cutterText unit cutter = case Part.kind cutter of
  Part.MillingCutter -> "mill, diameter " <> diameter <> bodyText
  Part.ConeCutter -> "cone, diameter " <> diameter
  Part.VBitCutter ->
    let across = inUnit (times 2 (Part.tipRadius cutter))
     in "V-bit, diameter " <> diameter <> ", tip " <> across <> bodyText
  Part.DovetailCutter -> "dovetail, diameter " <> diameter
  Part.BladeCutter _ -> "blade, diameter " <> diameter
  Part.DrillingCutter -> "drill, diameter " <> diameter <> bodyText
  Part.TappingCutter -> "tap, diameter " <> diameter <> bodyText
  Part.ThreadCutter pitch ->
    "thread mill, diameter " <> diameter <> ", pitch " <> inUnit pitch <> bodyText
  Part.TurningCutter -> "turning tool, nose radius " <> inUnit (Part.cutterRadius cutter) <> tip
  where
    tip = maybe "" (\n -> ", tip " <> Decimal.whole n) (Part.tip cutter)
    bodyText =
      maybe "" ((", flutes " <>) . inUnit) (Part.fluteLength (Part.body cutter))
        <> maybe "" ((", angle " <>) . inDegrees) (Part.pointAngle (Part.body cutter))
        <> maybe "" ((", stick-out " <>) . inUnit) (Part.stickOut (Part.body cutter))
    inDegrees a = Decimal.short 3 (degrees a) <> " deg"
    diameter = inUnit (times 2 (Part.cutterRadius cutter))
    inUnit = Decimal.inUnit unit
