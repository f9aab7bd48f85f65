{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Warnings about toolpaths with the texts of their reports, and the texts for tools and elements
-- that all reports of this folder share.
module Toolpath.WarningReport
  ( Warning (..),
    RestPosition (..),
    Tool (..),
    warningReport,
    cutter,
    largestFit,
    fittingSize,
    workVerb,
    shape,
    secondLabel,
    inDegrees,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), Rad (..), degrees, times)
import Base.Region (Located (..), Region)
import Base.Region qualified as Region
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element (..), MillingPlaces, SpacePoint (..), Work (..))
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportPlace (..), report)
import Report.Report qualified as Report
import Toolpath.CarvingFloor (Floor)
import Toolpath.CarvingReport qualified as CarvingReport
import Toolpath.Toolpath (CarvingRest)

-- | A cutter at work: the kind of work, the cutter's radius, the allowance that it leaves, and the
-- regions of the program that a fix may change.
data Tool = Tool {work :: Work, radius :: Mm, leaves :: Mm, places :: MillingPlaces}
  deriving stock (Eq, Show)

-- | Warnings about a toolpath that has no errors.
data Warning
  = -- | rest material on a contour: the statement, the cutter, the unreached parts
    LeavesRestMaterial Region Tool [RestPosition]
  | -- | a rapid move through the part, below its top: the region of the program that asks for the
    -- move, the move, the name of the contour inside which the move is
    RapidThroughPart Region Segment (Located Name)
  | -- | a rapid move into material that a pocket or a window still holds: the region of the program
    -- that asks for the move, the lowest point of the move, its height, the contour's name
    RapidIntoContent Region Point Mm (Located Name)
  | -- | a rapid move into a hole that is not drilled yet: the region of the move, its lowest point,
    -- its height there, the region of the hole
    RapidIntoHole Region Point Mm Region
  | -- | a tool change after which the program does not start the spindle: the statement that
    -- started it before, as the program would write it
    SpindleAtRest Region Text
  | -- | an operation that clears what a larger cutter has left, where that cutter has left nothing:
    -- the statement, and the statement of the larger cutter
    NothingLeft Region Region
  | -- | a V-carving that leaves material because its tip is too wide: the statement, what it leaves
    TipTooWide Region CarvingRest
  | -- | a V-carving whose floor stays
    FloorStays Floor
  deriving stock (Eq, Show)

-- | Rest material at a position that the cutter does not reach. The last field of 'InConcaveArc'
-- and 'Between' is the radius of the largest cutter that would reach the position; Nothing if none
-- would. That field is lazy, because only reports need it.
data RestPosition
  = -- | in a corner between two elements; the point is the corner
    InCorner Element Element Point
  | -- | in a concave arc of this radius
    InConcaveArc Element Mm ~(Maybe Mm)
  | -- | at the break of a contour behind an element; the point is the vertex, and the number the
    -- thickness of the material there
    AtBreak Element Point Mm
  | -- | between two elements; the point is the position of the centre at which the cutter touches
    -- both
    Between Element Element Point ~(Maybe Mm)
  deriving stock (Eq, Show)

-- | The text of a warning.
warningReport :: LengthUnit -> Warning -> Report
warningReport unit warning = case warning of
  LeavesRestMaterial region tool stays ->
    ( report
        Report.Warning
        "W0401"
        (InSource region)
        (cutter unit tool <> " leaves material at " <> positions (length stays))
    )
      { others = take 6 (distinct (concatMap labels stays)),
        message =
          map (restPositionText unit tool) (take shown stays)
            <> ["And at " <> positions (length stays - shown) <> " more." | length stays > shown],
        hints =
          if all isAtBreak stays
            then ["Take a smaller cutter, or let the distance change over a longer stretch."]
            else
              [ "Take a smaller cutter afterwards, or leave rest allowed out to have this refused."
              ]
      }
  TipTooWide region rest -> CarvingReport.allowed unit region rest
  FloorStays left -> CarvingReport.floorStays unit left
  RapidThroughPart region move (Located named contour) ->
    (report Report.Warning "W0402" (InSource region) "this rapid move goes through the part")
      { others = [Label named "inside this contour"],
        message =
          [ "It goes from "
              <> Vec.toText unit 3 (Segment.start move)
              <> " to "
              <> Vec.toText unit 3 (Segment.end move)
              <> " inside "
              <> text contour
              <> ", not above the top of the part. That it was cleared there is not known."
          ],
        hints = ["Lift the cutter first: a third coordinate is a height."]
      }
  RapidIntoContent region p z (Located named contour) ->
    rapidIntoMaterial
      unit
      region
      (SpacePoint p z)
      (Label named "not cleared down to there inside this contour")
      ("The inside of " <> text contour <> " is not cleared")
      "let the cutter plunge at a feed"
  RapidIntoHole region p z hole ->
    rapidIntoMaterial
      unit
      region
      (SpacePoint p z)
      (Label hole "not drilled yet")
      "The hole is not drilled"
      "let the drill go down at a feed"
  NothingLeft region rough ->
    (report Report.Warning "W0404" (InSource region) "there is no rest for this cutter to clear")
      { others = [Label rough "this pocket leaves no more than this cutter would"],
        message = ["So the statement makes no moves."],
        hints =
          [ "Leave it out, take a smaller cutter for it, or let the pocket leave more, for example \
            \allowance 0.3."
          ]
      }
  SpindleAtRest region spindle ->
    ( report
        Report.Warning
        "W0403"
        (InSource region)
        "after this tool change the spindle stands still"
    )
      { message = ["The spindle stops when its tool is changed, and nothing starts it again."],
        fixes =
          [ Fix.proposed
              ( Fix.insertion
                  ("Start it after the change: " <> spindle <> ".")
                  (Region.end region)
                  ("\n" <> spindle)
              )
          ]
      }
  where
    shown = 8
    isAtBreak s = case s of
      AtBreak {} -> True
      InCorner {} -> False
      InConcaveArc {} -> False
      Between {} -> False
    positions n = if n == 1 then "one place" else Decimal.whole n <> " places"
    distinct ls = case ls of
      [] -> []
      l : more -> l : distinct (filter (/= l) more)
    labels s = case s of
      InCorner a _ _ -> [Label (origin a) "in the corner behind this"]
      AtBreak a _ _ -> [Label (origin a) "where its distance begins or ends to change"]
      InConcaveArc a _ _ -> [Label (origin a) "in this hollow"]
      Between a b _ _ -> [Label (origin a) "beside this", Label (origin b) "beside this"]

-- | The warning about a rapid move into material. The arguments are the region of the program that
-- asks for the move, the point and the height in mm at which the move is in the material, the label
-- of the material, the sentence about it up to the height, and the rest of the hint.
rapidIntoMaterial :: LengthUnit -> Region -> SpacePoint -> Label -> Text -> Text -> Report
rapidIntoMaterial unit region (SpacePoint p z) material uncleared advice =
  (report Report.Warning "W0402" (InSource region) "this rapid move goes into material")
    { others = [material],
      message =
        [ "At "
            <> Vec.toText unit 3 p
            <> " it is at the height "
            <> Decimal.inUnit unit z
            <> ". "
            <> uncleared
            <> " down to there before."
        ],
      hints =
        [ "Stop above the material, and "
            <> advice
            <> ": move ("
            <> Text.intercalate ", " (map (Decimal.shortIn unit 3 . Mm) [Vec.x p, Vec.y p, height])
            <> ") feed and a number."
        ]
    }
  where
    Mm height = z

-- | The text for one position of rest material.
restPositionText :: LengthUnit -> Tool -> RestPosition -> Text
restPositionText unit tool s = case s of
  InCorner _ _ p -> "In the inner corner at " <> Vec.toText unit 3 p <> "."
  AtBreak _ p thick ->
    "At the break at "
      <> Vec.toText unit 3 p
      <> ", where the distance of a piece begins or ends to change. The material is "
      <> Decimal.inUnit unit thick
      <> " thick."
  InConcaveArc a old largest ->
    "In the concave radius of "
      <> Decimal.inUnit unit old
      <> " of "
      <> shape unit a
      <> ". "
      <> largestFit unit tool largest
  Between a b p largest ->
    "Between "
      <> shape unit a
      <> " and "
      <> shape unit b
      <> ", with the centre at "
      <> Vec.toText unit 3 p
      <> ". "
      <> largestFit unit tool largest

-- | The text for the size of a cutter with the radius @r@: the diameter for milling, the radius of
-- the nose for turning. It is rounded down to 0.001 mm or 0.0001 in, so that a cutter of this size
-- fits.
fittingSize :: LengthUnit -> Tool -> Mm -> Text
fittingSize unit tool r = case work tool of
  Turned -> down r
  _ -> down (times 2 r)
  where
    down x = Decimal.inUnit unit (Decimal.roundedDown unit x)

-- | The text for a cutter.
cutter :: LengthUnit -> Tool -> Text
cutter unit Tool {work, radius, leaves} =
  size <> (if leaves > Mm 0 then " that leaves " <> Decimal.inUnit unit leaves else "")
  where
    size = case work of
      Turned -> "a nose of radius " <> Decimal.inUnit unit radius
      _ -> "a cutter of diameter " <> Decimal.inUnit unit (times 2 radius)

-- | The verb for the kind of work.
workVerb :: Tool -> Text
workVerb tool = case work tool of
  Milled -> "milled"
  Engraved -> "engraved"
  Turned -> "turned"

-- | The text for an element: a line with its ends, an arc or a whole circle with its radius and
-- centre, or a curve.
shape :: LengthUnit -> Element -> Text
shape unit element = case segment element of
  Straight _ _ | ofCurve element -> "the curve"
  Arc {start, centre}
    | ofCurve element ->
      "the curve, here of radius " <> Decimal.inUnit unit (Segment.radius centre start)
  Straight a b -> "the line from " <> Vec.toText unit 3 a <> " to " <> Vec.toText unit 3 b
  Arc {start, centre, sweep = Rad s} ->
    "the "
      <> ( if abs s > 2 * pi - 1e-9
             then "circle"
             else (if s > 0 then "counter-clockwise" else "clockwise") <> " arc"
         )
      <> " of radius "
      <> Decimal.inUnit unit (Segment.radius centre start)
      <> " about "
      <> Vec.toText unit 3 centre

-- | The text, in degrees, for an angle in radians.
inDegrees :: Double -> Text
inDegrees a = Decimal.short 3 (degrees (Rad a)) <> " deg"

-- | The text for the largest cutter that fits. @largest@ is its radius, for a turning tool the
-- radius of the nose; 'Nothing' if no cutter fits.
largestFit :: LengthUnit -> Tool -> Maybe Mm -> Text
largestFit unit tool largest = case (work tool, largest) of
  (_, Nothing) -> "No cutter fits here, however small."
  (Turned, Just r) ->
    "The largest nose that fits has a radius of " <> fittingSize unit tool r
      <> "."
  (_, Just r) ->
    "The largest cutter that fits has a diameter of "
      <> fittingSize unit tool r
      <> "."

-- | The label of the second element; empty if both elements come from the same region.
secondLabel :: LengthUnit -> Element -> Element -> [Label]
secondLabel unit first second =
  [Label (origin second) (shape unit second) | origin second /= origin first]
