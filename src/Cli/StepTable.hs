-- | The table of steps in the subcommand @report@, after Table 6 of the paper on the Ural-1
-- computer, which is lost in our copy.
--
-- For each section of a contour the paper gives the number k of increments, the increment h of x on
-- a line, and the angle step Δφ of an arc. Before that it writes the equation of a line, and the
-- angles of an arc: φ at its beginning and φₖ at its end, seen from its centre. Lengths are in mm,
-- Δφ is in radians, φ in degrees and minutes.
module Cli.StepTable
  ( StepSection (..),
    steps,
    equation,
    degreesAndMinutes,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad (..), degrees)
import Cli.CurveTable qualified as CurveTable
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.Fixed (mod')
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.SectionSteps (SectionSteps (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A section for the table: its nodes, its kind, its segment, and its steps. A curve has no
-- segment. Without a machine there are no steps.
data StepSection = StepSection
  { name :: Text,
    kind :: Text,
    segment :: Maybe Segment,
    divided :: Maybe SectionSteps
  }
  deriving stock (Eq, Show)

-- | The table of the steps of a contour. Columns without a value are left out. Nothing if no column
-- has values.
steps :: LengthUnit -> [StepSection] -> Maybe Text
steps unit sections
  | null found = Nothing
  | otherwise =
    Just
      ( Table.columns
          (map align (named <> found))
          (map title (named <> found) : map (\s -> map (`cell` s) (named <> found)) sections)
      )
  where
    found = filter (\c -> not (all (Text.null . cell c) sections)) (columns unit)
    named = [StepColumn ToRight "section" name, StepColumn ToLeft "kind" kind]

-- | A column: its alignment, its heading, and the function that makes its cell for a section.
data StepColumn = StepColumn {align :: Align, title :: Text, cell :: StepSection -> Text}

-- | The columns of numbers and equations.
columns :: LengthUnit -> [StepColumn]
columns unit =
  [ StepColumn ToRight "k" (ofSteps countOf Decimal.whole),
    StepColumn ToRight "h" (ofSteps alongX (Decimal.fixedIn unit 3)),
    StepColumn ToRight "Δφ rad" (ofSteps angleOf (\(Rad a) -> Decimal.fixed 4 a)),
    StepColumn ToRight "φ" (ofSegment anglesOf (degreesAndMinutes . fst)),
    StepColumn ToRight "φₖ" (ofSegment anglesOf (degreesAndMinutes . snd)),
    StepColumn ToLeft "equation" (ofSegment equationOf id)
  ]
  where
    ofSteps get text s = maybe "" text (divided s >>= get)
    ofSegment get text s = maybe "" text (segment s >>= get)
    equationOf s = case s of
      Straight a b -> Just (equation unit a b)
      Arc {} -> Nothing
    countOf d = case d of
      LineSteps k _ -> Just k
      ArcSteps k _ -> Just k
      CurveSteps k -> Just k
      NoSteps -> Nothing
    alongX d = case d of
      LineSteps _ h -> Just h
      _ -> Nothing
    angleOf d = case d of
      ArcSteps _ a -> Just a
      _ -> Nothing

-- | The angles at the beginning and at the end of an arc, seen from its centre. The first is from
-- 0° to 360°; the second differs from it by the sweep of the arc.
anglesOf :: Segment -> Maybe (Rad, Rad)
anglesOf s = case s of
  Straight _ _ -> Nothing
  Arc {start, centre, sweep = Rad sweep} ->
    let Rad begin = Vec.angle (Vec.to centre start)
        first = begin `mod'` (2 * pi)
     in Just (Rad first, Rad (first + sweep))

-- | An angle in degrees and whole minutes, as in the paper: @172°30′@.
degreesAndMinutes :: Rad -> Text
degreesAndMinutes angle =
  (if minutes < 0 then "-" else "")
    <> Decimal.whole whole
    <> "°"
    <> Text.justifyRight 2 '0' (Decimal.whole rest)
    <> "′"
  where
    minutes = round (60 * degrees angle) :: Int
    (whole, rest) = abs minutes `divMod` 60

-- | The equation of the line through two points. A line whose x or y changes by less than half of
-- the last decimal of a coordinate in the tables is parallel to an axis.
equation :: LengthUnit -> Point -> Point -> Text
equation unit a b
  | abs dx < parallel = "x = " <> Decimal.fixedIn unit 3 (Mm (Vec.x a))
  | abs dy < parallel = "y = " <> Decimal.fixedIn unit 3 (Mm (Vec.y a))
  | otherwise = CurveTable.lineEquation unit slope (Mm (Vec.y a - slope * Vec.x a))
  where
    dx = Vec.x b - Vec.x a
    dy = Vec.y b - Vec.y a
    slope = dy / dx
    parallel = 0.0005
