-- | The paper's tables: the nodes of every equidistant, lengths, times, metres of tape.
module Cli.NodeTable
  ( nodes,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..), Seconds (..), minus, times, total, travelTime)
import Base.Region (Located (..))
import Cli.CurveTable qualified as CurveTable
import Cli.RestMaterialTable qualified as RestMaterialTable
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Compile (Analysis (..), Punched (..))
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.FeedCode qualified as FeedCode
import Frame.Frame qualified as Frame
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Pace (..))
import Part.Part qualified as Part
import Tape.Tape qualified as Tape
import Toolpath.Toolpath (Block (..), Move (..), Pass (..), heights, pace)
import Toolpath.Toolpath qualified as Toolpath

-- | The paper's tables for every milled contour, then times and tape.
nodes :: Maybe (Machine, Punched) -> Analysis -> Text
nodes punched Analysis {part, path} =
  Text.intercalate
    "\n"
    ( [heading]
        <> CurveTable.fittings part
        <> map milled cuttings
        <> map emptied clearings
        <> drilled
        <> RestMaterialTable.places path
        <> [summary]
    )
  where
    heading =
      "Part "
        <> maybe "" (\(Name n) -> n) (Part.name part)
        <> maybe "" (\t -> ": " <> t) (Part.title part)
        <> "\n"
    machine = fst <$> punched
    cuttings = [(job, pass, NonEmpty.toList cut) | Cutting {job, pass, cut} <- Toolpath.blocks path]
    clearings =
      [ (job, pass, NonEmpty.toList cleared)
        | Clearing {pocket = job, pass, cleared} <- Toolpath.blocks path
      ]
    emptied (job, pass, cleared) =
      "Pocket "
        <> contourName' (Part.wall <$> job)
        <> passWord pass
        <> ": cleared in "
        <> Decimal.whole (length cleared)
        <> " moves\n"
        <> sums cleared
    milled (job, pass, cut) =
      "Contour "
        <> contourName' job
        <> passWord pass
        <> ": nodes of the "
        <> pathWord job
        <> ", numbered from the entry\n\n"
        <> Table.columns
          [ToRight, ToLeft, ToRight, ToRight, ToRight, ToRight, ToRight, ToRight, ToRight, ToRight]
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
            sections (ends' job) (Toolpath.runs cut)
          )
        <> sums cut
    sums ms =
      "\nlength "
        <> fixed3 (lengthOf ms)
        <> " mm, time "
        <> seconds (total (map (timeOf machine) ms))
        <> " s\n"
    -- Which of several passes: the height, and what it leaves standing.
    passWord Pass {left, atHeight} =
      (if atHeight == Mm 0 then "" else " at z = " <> fixed3 atHeight)
        <> (if left == Mm 0 then "" else ", leaving " <> fixed3 left)
    ends' job = Part.ends (Part.contour (value job))
    contourName' job = let Name n = value (Part.contourName (Part.contour (value job))) in n
    pathWord job = case value (Part.side (value job)) of
      Part.On -> "contour, milled on its line"
      Part.Outside -> "equidistant outside"
      Part.Inside -> "equidistant inside"
      Part.LeftSide -> "equidistant on the left"
      Part.RightSide -> "equidistant on the right"
    -- The arcs of one curve are one section.
    sections ends runs = zipWith (section (length runs) ends) [0 ..] runs <> lastNode ends runs
    section count ends k run =
      let next = case ends of
            Part.Closed -> (k + 1) `mod` count
            Part.Open -> k + 1
          begin = Segment.start (segment (NonEmpty.head run))
          moves = NonEmpty.toList run
       in [ Decimal.whole k <> "–" <> Decimal.whole next,
            kind run,
            Decimal.whole k,
            fixed3 (Mm (Vec.x begin)),
            fixed3 (Mm (Vec.y begin))
          ]
            <> centreOf run
            <> [ fixed3 (total (map (Segment.length . segment) moves)),
                 seconds (total (map (timeOf machine) moves))
               ]
    lastNode ends runs = case (ends, reverse runs) of
      (Part.Open, final : _) ->
        let finish = Segment.end (segment (NonEmpty.last final))
         in [ [ "",
                "end",
                Decimal.whole (length runs),
                fixed3 (Mm (Vec.x finish)),
                fixed3 (Mm (Vec.y finish)),
                "",
                "",
                "",
                "",
                ""
              ]
            ]
      _ -> []
    drilled =
      [ "Holes\n\n"
          <> Table.columns
            [ToRight, ToRight, ToRight, ToRight]
            ( ["x", "y", "diameter", "depth"] :
                [ [ fixed3 (Mm (Vec.x p)),
                    fixed3 (Mm (Vec.y p)),
                    fixed3 (times 2 (Part.drillRadius d)),
                    fixed3 (times (-1) (Part.bottom d))
                  ]
                  | d <- holings,
                    Located _ p <- NonEmpty.toList (Part.holes d)
                ]
            )
        | not (null holings)
      ]
    holings = [d | Holing (Located _ d) _ <- Toolpath.blocks path]
    everything = concatMap Toolpath.moves (Toolpath.blocks path)
    summary =
      Table.columns
        [ToLeft, ToRight, ToLeft]
        ( [ [ "ways in, out and between",
              fixed3
                ( minus
                    (lengthOf everything)
                    ( lengthOf
                        ( concatMap (\(_, _, cut) -> cut) cuttings
                            <> concatMap (\(_, _, cleared) -> cleared) clearings
                        )
                    )
                ),
              "mm"
            ],
            ["total length of the path", fixed3 (lengthOf everything), "mm"],
            ["total time", seconds (total (map (timeOf machine) everything)), "s"]
          ]
            <> maybe [] tapeRows punched
        )
    lengthOf = total . map wayOf
    tapeRows (m, Punched {program, tape}) =
      [ ["frames", Decimal.whole (length (Frame.planned program)), ""],
        [ maybe "characters" (const "rows of tape") (Tape.metres m tape),
          Decimal.whole (Tape.rowCount tape),
          ""
        ]
      ]
        <> [["tape", Decimal.fixed 2 metres, "m"] | Just metres <- [Tape.metres m tape]]

kind :: NonEmpty Move -> Text
kind run
  | Toolpath.isCurve run = "curve"
  | otherwise = case segment (NonEmpty.head run) of
    Straight _ _ -> "line"
    Arc {sweep = Rad a} -> if a > 0 then "arc ccw" else "arc cw"

centreOf :: NonEmpty Move -> [Text]
centreOf run = case segment (NonEmpty.head run) of
  Arc {start, centre}
    | not (Toolpath.isCurve run) ->
      [fixed3 (Mm (Vec.x centre)), fixed3 (Mm (Vec.y centre)), fixed3 (Segment.radius centre start)]
  _ -> ["", "", ""]

-- | The time of a move at the feed that the machine gives, or at the one asked when there is no
-- machine. A rapid move takes no time where nothing says how fast it is: without a machine, and on
-- one whose control knows it by itself.
timeOf :: Maybe Machine -> Move -> Seconds
timeOf machine move = maybe (Seconds 0) (travelTime l) (feedOf (pace move))
  where
    l = wayOf move
    feedOf p = case (p, machine) of
      (Rapid, Nothing) -> Nothing
      (Rapid, Just m) -> if Machine.hasRapidMotion m then Nothing else Just (FeedCode.rapid m)
      (At (Located _ asked), Nothing) -> Just asked
      (At (Located _ asked), Just m) -> Just (FeedCode.about m asked)

-- | The length of a move, in the plane and in height.
wayOf :: Move -> Mm
wayOf move =
  let Mm l = Segment.length (segment move)
      (Mm a, Mm b) = heights move
   in Mm (sqrt (l * l + (b - a) * (b - a)))

fixed3 :: Mm -> Text
fixed3 (Mm x) = Decimal.fixed 3 x

seconds :: Seconds -> Text
seconds (Seconds s) = Decimal.fixed 1 s
