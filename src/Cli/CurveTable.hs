-- | The tables of fitted curves (Tables 2–4 of the paper on the Ural-1 computer). A fitted curve
-- consists of sections: lines, parabolas and arcs that approximate the points of a table in the
-- program. The tables list the equations of the sections, and their deviations from the points.
-- Lengths are in mm.
module Cli.CurveTable
  ( fittings,
    lineEquation,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), millimetresIn)
import Base.Region (Located (..))
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Geometry.Curve.Section qualified as Section
import Geometry.Curve.SectionFit qualified as SectionFit
import Geometry.Vec qualified as Vec
import Part.Curve (Fitting (..))
import Part.Part (Part)
import Part.Part qualified as Part

-- | The two tables of each fitted curve of the part.
fittings :: Part -> [Text]
fittings part =
  map (uncurry (fitting (Part.unit part)) . \(Located _ name, f) -> (name, f)) (Part.fittings part)

-- | The table of sections and the table of deviations of the curve with the given name.
fitting :: LengthUnit -> Name -> Fitting -> Text
fitting unit (Name name) Fitting {sections, deviations, fittedPoints} =
  "Curve "
    <> name
    <> ": "
    <> counted (length sections) "section"
    <> " through "
    <> counted (Vector.length fittedPoints) "row"
    <> "\n\n"
    <> Table.columns
      [ToRight, ToRight, ToLeft, ToLeft, ToRight]
      ( ["section", "rows", "kind", "equation", "largest deviation"] :
        zipWith section [1 ..] (NonEmpty.toList sections)
      )
    <> "\n"
    <> Table.columns
      [ToRight, ToRight, ToRight, ToRight, ToRight]
      (["row", "x", "y", "section", "deviation"] : map row deviations)
  where
    section index p =
      [ Decimal.whole index,
        Decimal.whole (Section.first p) <> "–" <> Decimal.whole (Section.final p),
        kindWord p,
        equation unit p,
        fixed 4 (Section.largestDeviation p)
      ]
    kindWord p = case Section.kind (Section.curve p) of
      Section.LineKind -> "line"
      Section.ParabolaKind -> "parabola"
      Section.ArcKind -> "arc"
    row d =
      let p = fromMaybe (Vec.point 0 0) (fittedPoints Vector.!? (SectionFit.rowNumber d - 1))
       in [ Decimal.whole (SectionFit.rowNumber d),
            Decimal.shortIn unit 6 (Mm (Vec.x p)),
            Decimal.shortIn unit 6 (Mm (Vec.y p)),
            Decimal.whole (SectionFit.sectionNumber d),
            fixed 4 (SectionFit.signedDeviation d)
          ]
    fixed n x = Decimal.fixedIn unit n x

-- | The equation of a section: a polynomial y(x) for a line or a parabola, in which x and y are in
-- the unit, centre and radius for an arc. The counts of decimals are those of the paper.
equation :: LengthUnit -> Section.Section -> Text
equation unit p = case Section.formula p of
  Section.Polynomial 0 b c -> lineEquation unit b (Mm c)
  Section.Polynomial a b c ->
    "y = " <> Decimal.fixed 8 (a * size) <> " x² " <> signed 7 b <> " x " <> signed 6 (c / size)
  Section.Circle centre r ->
    "centre " <> Vec.toText unit 4 centre <> ", radius "
      <> Decimal.inUnit unit r
  where
    size = millimetresIn unit
    signed n x = (if x < 0 then "− " else "+ ") <> Decimal.fixed n (abs x)

-- | The equation of a line by its slope and its constant term. A constant term that is 0 to the
-- last decimal is left out, as in the paper's @y = 8,2x@.
lineEquation :: LengthUnit -> Double -> Mm -> Text
lineEquation unit slope (Mm constant)
  | Decimal.fixed 6 (abs term) == Decimal.fixed 6 0 = "y = " <> Decimal.fixed 7 slope <> " x"
  | otherwise =
    "y = "
      <> Decimal.fixed 7 slope
      <> (if term < 0 then " x − " else " x + ")
      <> Decimal.fixed 6 (abs term)
  where
    term = constant / millimetresIn unit

-- | A count with its noun, which gets the plural ending unless the count is 1.
counted :: Int -> Text -> Text
counted n thing = Decimal.whole n <> " " <> thing <> (if n == 1 then "" else Text.singleton 's')
