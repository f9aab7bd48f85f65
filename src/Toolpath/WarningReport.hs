{-# OPTIONS_GHC -O0 #-}

-- | Warnings about toolpaths with the texts of their reports, and texts for tools and shapes that
-- all reports of this folder share.
module Toolpath.WarningReport
  ( Warning (..),
    Stay (..),
    Tool (..),
    warningReport,
    cutter,
    fits,
    fitting,
    worked,
    shape,
    at,
    inDegrees,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..), degrees, times)
import Base.Region (Located (..), Region)
import Data.Text (Text)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element (..), Work (..))
import Report.Report (Label (..), Report (..), ReportCode, ReportPlace (..), report)
import Report.Report qualified as Report

-- | A cutter at work: the kind of work, its radius, and its allowance.
data Tool = Tool {work :: Work, radius :: Mm, leaves :: Mm}
  deriving stock (Eq, Show)

-- | Warnings about a toolpath that has no errors.
data Warning
  = -- | rest material on a contour: the statement, the cutter, the unreached parts
    Leaves Region Tool [Stay]
  | -- | a rapid move through the part, below its top: the stop, the move, the contour around it
    Through Region Segment (Located Name)
  | -- | a tool change after which the program does not start the spindle
    Standing Region
  deriving stock (Eq, Show)

-- | Rest material at a position the cutter does not reach. The radius of the largest cutter that
-- would reach it is lazy, because it is needed for reports only.
data Stay
  = -- | in a corner between two elements
    InCorner Element Element Point
  | -- | in a concave arc of this radius
    InHollow Element Mm ~(Maybe Mm)
  | -- | beyond the position of the centre at which the cutter touches two elements
    Between Element Element Point ~(Maybe Mm)
  deriving stock (Eq, Show)

-- | The text of a warning.
warningReport :: Warning -> Report
warningReport warning = case warning of
  Leaves region tool stays ->
    ( report
        Report.Warning
        "W0401"
        (InSource region)
        (cutter tool <> " leaves material at " <> positions (length stays))
    )
      { others = take 6 (distinct (concatMap labels stays)),
        message =
          map (restPositionText tool) (take shown stays)
            <> ["And at " <> positions (length stays - shown) <> " more." | length stays > shown],
        hints =
          ["Take a smaller cutter afterwards, or leave rest allowed out to have this refused."]
      }
  Through region move (Located named contour) ->
    (report Report.Warning "W0402" (InSource region) "this rapid move goes through the part")
      { others = [Label named "inside this contour"],
        message =
          [ "It goes from "
              <> Vec.written 3 (Segment.start move)
              <> " to "
              <> Vec.written 3 (Segment.end move)
              <> " inside "
              <> text contour
              <> ", not above the top of the part. That it was cleared there is not known."
          ],
        hints = ["Lift the cutter first: a third coordinate is a height."]
      }
  Standing region ->
    ( report
        Report.Warning
        "W0403"
        (InSource region)
        "behind this change nothing lets the spindle turn again"
    )
      { message =
          [ "A spindle stands while its tool is changed; what turned it before holds no \
            \longer."
          ],
        hints = ["Say it again behind the change, for example: spindle cw 800 rpm"]
      }
  where
    shown = 8
    positions n = if n == 1 then "one place" else Decimal.whole n <> " places"
    distinct ls = case ls of
      [] -> []
      l : more -> l : distinct (filter (/= l) more)
    labels s = case s of
      InCorner a _ _ -> [Label (origin a) "in the corner behind this"]
      InHollow a _ _ -> [Label (origin a) "in this hollow"]
      Between a b _ _ -> [Label (origin a) "beside this", Label (origin b) "beside this"]

-- | The text for one position of rest material.
restPositionText :: Tool -> Stay -> Text
restPositionText tool s = case s of
  InCorner _ _ p -> "In the inner corner at " <> Vec.written 3 p <> "."
  InHollow a old largest ->
    "In the concave radius of " <> Decimal.mm old <> " of " <> shape a <> ". " <> fits tool largest
  Between a b p largest ->
    "Between "
      <> shape a
      <> " and "
      <> shape b
      <> ", with the centre at "
      <> Vec.written 3 p
      <> ". "
      <> fits tool largest

-- | The diameter of a cutter, or the radius of a nose, for a radius that fits, rounded down to
-- 0.001 mm.
fitting :: Tool -> Mm -> Text
fitting tool r = case work tool of
  Milled -> down (times 2 r)
  Turned -> down r
  where
    down (Mm x) = Decimal.mm (Mm (fromInteger (floor (x * 1000)) / 1000))

-- | The text for a cutter.
cutter :: Tool -> Text
cutter Tool {work, radius, leaves} =
  size <> (if leaves > Mm 0 then " that leaves " <> Decimal.mm leaves else "")
  where
    size = case work of
      Milled -> "a cutter of diameter " <> Decimal.mm (times 2 radius)
      Turned -> "a nose of radius " <> Decimal.mm radius

-- | The verb for the kind of work.
worked :: Tool -> Text
worked tool = case work tool of
  Milled -> "milled"
  Turned -> "turned"

-- | The text for an element: its kind, its size, its points.
shape :: Element -> Text
shape element = case segment element of
  Straight _ _ | ofCurve element -> "the curve"
  Arc {start, centre}
    | ofCurve element ->
      "the curve, here of radius " <> Decimal.mm (Segment.radius centre start)
  Straight a b -> "the line from " <> Vec.written 3 a <> " to " <> Vec.written 3 b
  Arc {start, centre, sweep = Rad s} ->
    "the "
      <> (if s > 0 then "counter-clockwise" else "clockwise")
      <> " arc of radius "
      <> Decimal.mm (Segment.radius centre start)
      <> " about "
      <> Vec.written 3 centre

-- | An error report with a code and a title, at a region of the program.
at :: Region -> ReportCode -> Text -> Report
at region code = report Report.Error code (InSource region)

-- | The text for an angle given in radians.
inDegrees :: Double -> Text
inDegrees a = Decimal.short 3 (degrees (Rad a)) <> " deg"

-- | The text for the largest cutter that fits.
fits :: Tool -> Maybe Mm -> Text
fits tool largest = case (work tool, largest) of
  (_, Nothing) -> "No cutter fits here, however small."
  (Milled, Just r) -> "The largest cutter that fits has a diameter of " <> fitting tool r <> "."
  (Turned, Just r) -> "The largest nose that fits has a radius of " <> fitting tool r <> "."
