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
import Base.Quantity (LengthUnit (..), Mm (..), Rad (..), Seconds (..), minus, times, total)
import Base.Region (Located (..))
import Cli.CurveTable qualified as CurveTable
import Cli.RestMaterialTable qualified as RestMaterialTable
import Cli.StockTable qualified as StockTable
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Compile (Analysis (..), Punched (..))
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame qualified as Frame
import Frame.MoveTime (moveLength, moveTime, pathTime)
import Gcode.Writer qualified as Writer
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Part.Part (Drilling, Milling, Part)
import Part.Part qualified as Part
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (StopReason (..))
import Pulse.RunMeasure (RunTotal (..))
import Pulse.StopText qualified as StopText
import Tape.Tape qualified as Tape
import Toolpath.Toolpath (Block (..), Move (..), Pass (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | The tables of a part: curves, contours, pockets, holes, rest material, sums. Times are
-- computed with the feeds of the machine; without a machine, with those of the program. Without a
-- machine there is also no tape whose length could be listed.
nodes :: Maybe (Machine, Punched) -> Analysis -> Text
nodes punched Analysis {part, path} =
  Text.intercalate
    "\n"
    ( [heading part]
        <> CurveTable.fittings part
        <> [contourTable unit machine job pass cut | (job, pass, cut) <- cutsOf path]
        <> [pocketText unit machine job pass cleared | (job, pass, cleared) <- clearingsOf path]
        <> holeTable unit [drilling | Holing (Located _ drilling) _ <- Toolpath.blocks path]
        <> RestMaterialTable.tables path
        <> StockTable.tables unit machine path
        <> [summary unit punched path]
    )
  where
    machine = fst <$> punched
    unit = Part.unit part

heading :: Part -> Text
heading part =
  "Part "
    <> maybe "" (\(Name n) -> n) (Part.name part)
    <> maybe "" (": " <>) (Part.title part)
    <> (case Part.unit part of Millimetres -> ""; Inches -> " (in)")
    <> "\n"

-- | The passes along contours: the milling statement, the pass, its moves.
cutsOf :: Toolpath -> [(Located Milling, Pass, [Move])]
cutsOf path = [(job, pass, NonEmpty.toList cut) | Cutting {job, pass, cut} <- Toolpath.blocks path]

-- | The passes that clear pockets: the milling of the pocket's wall, the pass, its moves.
clearingsOf :: Toolpath -> [(Located Milling, Pass, [Move])]
clearingsOf path =
  [ (Part.wall <$> pocket, pass, NonEmpty.toList cleared)
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

-- | The count of moves, the length and the time of one pass in a pocket.
pocketText :: LengthUnit -> Maybe Machine -> Located Milling -> Pass -> [Move] -> Text
pocketText unit machine wall pass cleared =
  "Pocket "
    <> nameOf wall
    <> passWord unit pass
    <> ": cleared in "
    <> Decimal.whole (length cleared)
    <> " moves\n"
    <> lengthAndTime unit machine cleared

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
  [ Decimal.whole index <> "–" <> Decimal.whole next,
    kindWord section,
    Decimal.whole index
  ]
    <> coordinates unit begin
    <> centreAndRadius unit section
    <> [ fixed3 unit (total (map (Segment.length . segment) moves)),
         seconds (total (map (moveTime machine) moves))
       ]
  where
    next = case ends of
      Part.Closed -> (index + 1) `mod` count
      Part.Open -> index + 1
    begin = Segment.start (segment (NonEmpty.head section))
    moves = NonEmpty.toList section

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

-- | The table of all holes; the empty list if there are no holes.
holeTable :: LengthUnit -> [Drilling] -> [Text]
holeTable unit drillings =
  [ "Holes\n\n"
      <> Table.columns
        [ToRight, ToRight, ToRight, ToRight]
        ( ["x", "y", "diameter", "depth"] :
            [ [ fixed3 unit (Mm (Vec.x p)),
                fixed3 unit (Mm (Vec.y p)),
                fixed3 unit (times 2 (Part.drillRadius d)),
                fixed3 unit (times (-1) (Part.bottom d))
              ]
              | d <- drillings,
                Located _ p <- NonEmpty.toList (Part.holes d)
            ]
        )
    | not (null drillings)
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
    cutting = concat [moves | (_, _, moves) <- cutsOf path <> clearingsOf path]
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
