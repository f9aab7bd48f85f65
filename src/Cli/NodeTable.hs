-- | The tables of the subcommand @report@, after the paper on the Ural-1 computer: the nodes of
-- every equidistant, lengths, times, and the length of the tape.
--
-- Coordinates and lengths are in mm, times in seconds. The cutter's centre follows the equidistant
-- of a contour, which is the contour's offset. The equidistant consists of sections: lines, arcs
-- and curves. A curve is one section, although arcs approximate it. Nodes are the points at which
-- sections join, numbered from 0. The 'Milling' of a pass is the statement that asks for the pass.
module Cli.NodeTable
  ( nodes,
  )
where

import Base.Decimal qualified as Decimal
import Base.LazyList qualified as LazyList
import Base.Name (Name (..))
import Base.Quantity (LengthUnit (..), Mm (..), Rad (..), Seconds (..), minus, over, times, total)
import Base.Region (Located (..), Source)
import Cli.CurveTable qualified as CurveTable
import Cli.ReferencePointTable qualified as ReferencePointTable
import Cli.RestMaterialTable qualified as RestMaterialTable
import Cli.StepTable qualified as StepTable
import Cli.StockTable qualified as StockTable
import Cli.TabTable qualified as TabTable
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Compile (Analysis (..), Punched (..))
import Data.Containers.ListUtils (nubOrd)
import Data.IntMap.Strict qualified as IntMap
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame qualified as Frame
import Frame.MoveTime (moveLength, moveTime, pathTime)
import Frame.SectionSteps (SectionSteps)
import Frame.SectionSteps qualified as SectionSteps
import Gcode.Writer qualified as Writer
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Part.Part (Carving, Drilling, Milling, Part, Pocketing)
import Part.Part qualified as Part
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (StopReason (..))
import Pulse.RunMeasure (RunTotal (..))
import Pulse.StopText qualified as StopText
import Tape.Tape qualified as Tape
import Toolpath.HoleOrder qualified as HoleOrder
import Toolpath.Toolpath (Block (..), Move (..), Pass (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | The tables of a part: curves, contours, pockets, holes, rest material, sums. Times are
-- computed with the feeds of the machine; without a machine, with those of the program. Without a
-- machine there is also no tape whose length could be listed. With the source of the program, the
-- reference points of pieces are listed, too.
nodes :: Maybe Source -> Maybe (Machine, Punched) -> Analysis -> Text
nodes source punched Analysis {part, path} =
  Text.intercalate
    "\n"
    ( [heading part]
        <> CurveTable.fittings part
        <> concatMap contourTables (cutsOf path)
        <> [pocketText unit machine job pass cleared | (job, pass, cleared) <- clearingsOf path]
        <> [carvingText unit machine c (NonEmpty.toList ms) | Carved c ms _ <- Toolpath.blocks path]
        <> holeTable unit (drillingsOf path)
        <> holeOrderTable unit (drillingsOf path)
        <> TabTable.tables path
        <> RestMaterialTable.tables path
        <> StockTable.tables unit machine path
        <> [summary unit punched path]
    )
  where
    machine = fst <$> punched
    unit = Part.unit part
    contourTables (n, job, pass, cut) =
      [contourTable unit machine job pass (NonEmpty.toList cut)]
        <> stepTable unit job pass (NonEmpty.toList cut) (IntMap.findWithDefault [] n allSteps)
        <> concat
          [ ReferencePointTable.tables text part job pass (passWord unit pass) cut
            | Just text <- [source]
          ]
    allSteps = maybe IntMap.empty (`SectionSteps.sectionSteps` path) machine

heading :: Part -> Text
heading part =
  "Part "
    <> maybe "" (\(Name n) -> n) (Part.name part)
    <> maybe "" (": " <>) (Part.title part)
    <> (case Part.unit part of Millimetres -> ""; Inches -> " (in)")
    <> "\n"

-- | The passes along contours: the number of the pass in 'Toolpath.passNumbers', the milling
-- statement, the pass, its moves.
cutsOf :: Toolpath -> [(Int, Located Milling, Pass, NonEmpty Move)]
cutsOf path =
  [ (n, job, pass, cut)
    | (n, Cutting {job, pass, cut}) <- zip (Toolpath.passNumbers blocks) blocks
  ]
  where
    blocks = Toolpath.blocks path

-- | The passes that clear pockets and surfaces: the operation, the pass, its moves.
clearingsOf :: Toolpath -> [(Located Pocketing, Pass, [Move])]
clearingsOf path =
  [ (pocket, pass, NonEmpty.toList cleared)
    | Clearing {pocket, pass, cleared} <- Toolpath.blocks path
  ]

-- Passes ------------------------------------------------------------------------------------------

-- | The table of one pass along a contour, one row for each section, beginning where the cutter
-- enters. The length and the time of the whole pass follow.
contourTable :: LengthUnit -> Maybe Machine -> Located Milling -> Pass -> [Move] -> Text
contourTable unit machine job pass cut =
  "Contour "
    <> nameOf job
    <> passWord unit pass
    <> ": nodes of the "
    <> sideWord job
    <> ", numbered from the entry\n\n"
    <> Table.columns
      (ToRight : ToLeft : replicate 8 ToRight)
      ( [ "section",
          "kind",
          "node",
          "x",
          "y",
          "centre x",
          "centre y",
          "radius",
          "length",
          "time s"
        ] :
        sectionRows unit machine (Part.ends (Part.contour (value job))) (Toolpath.curveRuns cut)
      )
    <> lengthAndTime unit machine cut

-- | The table of steps of one pass along a contour; the empty list if it has nothing to say.
-- @divided@ are the steps of the sections; empty without a machine, and if the control computes the
-- sections.
stepTable :: LengthUnit -> Located Milling -> Pass -> [Move] -> [SectionSteps] -> [Text]
stepTable unit job pass cut divided =
  [ (if null divided then "Equations and angles" else "Steps")
      <> " of the sections of "
      <> nameOf job
      <> passWord unit pass
      <> "\n\n"
      <> table
    | Just table <-
        [ StepTable.steps
            unit
            (zipWith3 stepSection [0 ..] sections (map Just divided <> repeat Nothing))
        ]
  ]
  where
    sections = Toolpath.curveRuns cut
    stepSection index section found =
      StepTable.StepSection
        { StepTable.name =
            sectionName (Part.ends (Part.contour (value job))) (length sections) index,
          StepTable.kind = kindWord section,
          StepTable.segment =
            if Toolpath.isCurve section then Nothing else Just (segment (NonEmpty.head section)),
          StepTable.divided = found
        }

-- | The count of moves, the length and the time of one pass in a pocket or over a surface.
pocketText :: LengthUnit -> Maybe Machine -> Located Pocketing -> Pass -> [Move] -> Text
pocketText unit machine pocket pass cleared =
  kind
    <> nameOf (Part.wall <$> pocket)
    <> passWord unit pass
    <> ": cleared in "
    <> Decimal.whole (length cleared)
    <> " moves\n"
    <> lengthAndTime unit machine cleared
  where
    kind = case Part.extent (value pocket) of
      Part.WholePocket -> "Pocket "
      Part.RestOfPocket _ -> "Rest of pocket "
      Part.FloorOfCarving -> "Floor of carving "
      Part.Surface _ -> "Surface "

-- | The count of moves, the length and the time of a V-carving.
carvingText :: LengthUnit -> Maybe Machine -> Located Carving -> [Move] -> Text
carvingText unit machine (Located _ c) ms =
  "Carving of "
    <> Text.intercalate ", " (nubOrd (map nameOfArea (NonEmpty.toList (Part.carvedAreas c))))
    <> ", at most "
    <> fixed3 unit (Part.carvingDepth c)
    <> " deep: "
    <> Decimal.whole (length ms)
    <> " moves\n"
    <> lengthAndTime unit machine ms
  where
    nameOfArea (outer, _) = let Name n = value (Part.contourName outer) in n

nameOf :: Located Milling -> Text
nameOf job = let Name n = value (Part.contourName (Part.contour (value job))) in n

-- | The words for the height of a pass and for the allowance that it leaves. Each is left out if
-- it is 0.
passWord :: LengthUnit -> Pass -> Text
passWord unit Pass {left, atHeight} =
  (if atHeight == Mm 0 then "" else " at z = " <> fixed3 unit atHeight)
    <> (if left == Mm 0 then "" else ", leaving " <> fixed3 unit left)

sideWord :: Located Milling -> Text
sideWord job = case value (Part.side (value job)) of
  Part.On -> "contour, milled on its line"
  Part.Outside -> "equidistant outside"
  Part.Inside -> "equidistant inside"
  Part.LeftSide -> "equidistant on the left"
  Part.RightSide -> "equidistant on the right"

lengthAndTime :: LengthUnit -> Maybe Machine -> [Move] -> Text
lengthAndTime unit machine moves =
  "\nlength "
    <> fixed3 unit (total (map moveLength moves))
    <> " "
    <> Decimal.unitText unit
    <> ", time "
    <> seconds (total (map (moveTime machine) moves))
    <> " s\n"

-- | One row for each section, with the coordinates of its first node. An open contour also has a
-- row for its last node; on a closed contour the last section ends at node 0.
sectionRows :: LengthUnit -> Maybe Machine -> Part.Ends -> [NonEmpty Move] -> [[Text]]
sectionRows unit machine ends sections =
  zipWith (sectionRow unit machine (length sections) ends) [0 ..] sections
    <> endRow unit ends sections

sectionRow :: LengthUnit -> Maybe Machine -> Int -> Part.Ends -> Int -> NonEmpty Move -> [Text]
sectionRow unit machine count ends index section =
  [ sectionName ends count index,
    kindWord section,
    Decimal.whole index
  ]
    <> coordinates unit begin
    <> centreAndRadius unit section
    <> [ fixed3 unit (total (map (Segment.length . segment) moves)),
         seconds (total (map (moveTime machine) moves))
       ]
  where
    begin = Segment.start (segment (NonEmpty.head section))
    moves = NonEmpty.toList section

-- | The name of the section with the number @index@ of @count@ sections: its two nodes.
sectionName :: Part.Ends -> Int -> Int -> Text
sectionName ends count index = Decimal.whole index <> "–" <> Decimal.whole next
  where
    next = case ends of
      Part.Closed -> (index + 1) `mod` count
      Part.Open -> index + 1

endRow :: LengthUnit -> Part.Ends -> [NonEmpty Move] -> [[Text]]
endRow unit ends sections = case (ends, reverse sections) of
  (Part.Open, final : _) ->
    let end = Segment.end (segment (NonEmpty.last final))
        index = Decimal.whole (length sections)
     in [["", "end", index] <> coordinates unit end <> ["", "", "", "", ""]]
  _ -> []

kindWord :: NonEmpty Move -> Text
kindWord section
  | Toolpath.isCurve section = "curve"
  | otherwise = case segment (NonEmpty.head section) of
    Straight _ _ -> "line"
    Arc {sweep = Rad a} -> if a > 0 then "arc ccw" else "arc cw"

centreAndRadius :: LengthUnit -> NonEmpty Move -> [Text]
centreAndRadius unit section = case segment (NonEmpty.head section) of
  Arc {start, centre}
    | not (Toolpath.isCurve section) ->
      coordinates unit centre <> [fixed3 unit (Segment.radius centre start)]
  _ -> ["", "", ""]

-- Holes and sums ----------------------------------------------------------------------------------

-- | The drilling statements, each with the position of the tool before it.
drillingsOf :: Toolpath -> [(Point, Drilling)]
drillingsOf path =
  [ (Segment.start (Toolpath.segment first), drilling)
    | Holing (Located _ drilling) (first : _) <- Toolpath.blocks path
  ]

-- | The table of all holes in the order of drilling; the empty list if there are no holes.
holeTable :: LengthUnit -> [(Point, Drilling)] -> [Text]
holeTable unit drillings =
  [ "Holes\n\n"
      <> Table.columns
        [ToRight, ToRight, ToRight, ToRight]
        ( ["x", "y", "diameter", "depth"] :
            [ [ fixed3 unit (Mm (Vec.x p)),
                fixed3 unit (Mm (Vec.y p)),
                fixed3 unit (times 2 mouth),
                fixed3 unit (times (-1) bottom)
              ]
              | (begin, d) <- drillings,
                Part.Hole (Located _ p) bottom mouth <- NonEmpty.toList (HoleOrder.ordered begin d)
            ]
        )
    | not (null drillings)
  ]

-- | The table of the statements that ask for a short way, with the lengths in the plane of the
-- rapid moves to all holes: in the order of the list, and in the order of drilling.
holeOrderTable :: LengthUnit -> [(Point, Drilling)] -> [Text]
holeOrderTable unit drillings =
  [ "Rapid moves to the holes\n\n"
      <> Table.columns
        [ToRight, ToRight, ToRight, ToRight, ToRight]
        (["holes", "in order of list", "shortest", "saved", "saved %"] : map row ways)
    | not (null ways)
  ]
  where
    ways =
      [ (length listed, HoleOrder.way begin listed, HoleOrder.way begin short)
        | (begin, d) <- drillings,
          Part.visits d == Part.Shortest,
          let listed = centres (Part.holes d)
              short = centres (HoleOrder.ordered begin d)
      ]
    centres holes = [p | Part.Hole (Located _ p) _ _ <- NonEmpty.toList holes]
    row (count, before, after) =
      [ Decimal.whole count,
        fixed3 unit before,
        fixed3 unit after,
        fixed3 unit (minus before after),
        Decimal.fixed 1 (if before > Mm 0 then 100 * over (minus before after) before else 0)
      ]

-- | The length of all linking moves, the length and the time of the whole toolpath, the time that
-- the controller takes, the count of frames, and the size of the tape. Moves for the drilling of
-- holes count as linking moves.
summary :: LengthUnit -> Maybe (Machine, Punched) -> Toolpath -> Text
summary unit punched path =
  Table.columns
    [ToLeft, ToRight, ToLeft]
    ( [ "linking moves" : measured (minus (lengthOf everything) (lengthOf cutting)),
        "total length of the path" : measured (lengthOf everything),
        ["total time", seconds (pathTime machine path), "s"]
      ]
        <> maybe [] (uncurry controllerRow) punched
        <> maybe [] (uncurry tapeRows) punched
    )
  where
    machine = fst <$> punched
    measured x = [fixed3 unit x, Decimal.unitText unit]
    everything = concatMap Toolpath.moves (Toolpath.blocks path)
    cutting =
      filter
        ((/= Part.Rapid) . Toolpath.pace)
        (concat [NonEmpty.toList ms | Carved _ ms _ <- Toolpath.blocks path])
        <> concatMap (\(_, _, _, cut) -> NonEmpty.toList cut) (cutsOf path)
        <> concatMap (\(_, _, cleared) -> cleared) (clearingsOf path)
    lengthOf = total . map moveLength

-- | The time that the model of the controller takes for the tape, with its ramps and its waits for
-- the reader. No row if the description of the machine has no controller.
controllerRow :: Machine -> Punched -> [[Text]]
controllerRow machine Punched {program, tape} =
  [ ["time of the controller"] <> timeOrStop (LazyList.end list) clock
    | Just list <- [Controller.measured machine console (Frame.start program) tape],
      Just clock <- [Controller.ticksPerSecond machine]
  ]
  where
    console = Controller.consoleFor machine (Frame.plannedFrames program)
    stopped whole = ["", "stops " <> StopText.stopText machine (stopReason whole)]
    timeOrStop whole clock = case stopReason whole of
      TooFast {} -> stopped whole
      FeedHeld _ -> stopped whole
      SwitchNotSet _ _ -> stopped whole
      NotCompensated _ _ -> stopped whole
      Unreadable _ -> stopped whole
      TapeEnds -> [Decimal.fixed 1 (fromIntegral (totalTicks whole) / fromIntegral clock), "s"]
      ProgramEnds -> [Decimal.fixed 1 (fromIntegral (totalTicks whole) / fromIntegral clock), "s"]

tapeRows :: Machine -> Punched -> [[Text]]
tapeRows machine Punched {program, tape, files} =
  [ ["frames", Decimal.whole (length (Frame.plannedFrames program)), ""],
    [ maybe "characters" (const "rows of tape") (Tape.metres machine tape),
      Decimal.whole
        ( if null files
            then Tape.rowCount tape
            else sum (map (Text.length . Writer.fileText) files)
        ),
      ""
    ]
  ]
    <> [["tape", Decimal.fixed 2 metres, "m"] | Just metres <- [Tape.metres machine tape]]
    <> [["time to punch it", seconds t, "s"] | Just t <- [Tape.punchingTime machine tape]]

-- Moves -------------------------------------------------------------------------------------------

-- | The two coordinates of a point, without their unit.
coordinates :: LengthUnit -> Point -> [Text]
coordinates unit p = [fixed3 unit (Mm (Vec.x p)), fixed3 unit (Mm (Vec.y p))]

-- | A length without its unit: three decimals in mm, four in inches.
fixed3 :: LengthUnit -> Mm -> Text
fixed3 unit x = Decimal.fixedIn unit 3 x

seconds :: Seconds -> Text
seconds (Seconds s) = Decimal.fixed 1 s
