-- | Tables and curves as values of a program.
--
-- A curve is exact: it maps a parameter to a point. It consists of spans, each of which has one
-- formula. The parameter rises by 1 over each span. The segments of a contour are lines and arcs. A
-- contour that contains a curve therefore uses a polyarc of it: a chain of lines and arcs within
-- 'Tolerance.curve' of the curve. This module makes that polyarc, and keeps the columns of the
-- curve's table with the curve.
module Part.Curve
  ( PartTable (..),
    points,
    columns,
    columnsAt,
    PartCurve (..),
    Fitting (..),
    curve,
    plain,
    breakPoints,
    ends,
    reversed,
    transformed,
    alongPolyarc,
    xRange,
    spansOfSections,
  )
where

import Base.Name (Name)
import Base.NumberTable (NumberTable)
import Base.NumberTable qualified as NumberTable
import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.ArcFitting.CurveFit qualified as CurveFit
import Geometry.Curve (SpanShape (..))
import Geometry.Curve qualified as Exact
import Geometry.Curve.Section qualified as Section
import Geometry.Curve.SectionFit qualified as SectionFit
import Geometry.MeasuredPolyarc (MeasuredPolyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Tolerance qualified as Tolerance

-- | A table of the program. The columns of 'rows' are x and y in mm, and then one column for each
-- of the 'names'. Lengths in a column are in mm, angles in radians, times in minutes.
data PartTable = PartTable {rows :: NumberTable, names :: [Name]}
  deriving stock (Eq, Show)

-- | The points of a table in the order of its rows.
points :: PartTable -> Vector Point
points PartTable {rows} = Vector.unfoldrExactN (NumberTable.count rows) next 0
  where
    next k =
      let p = Vec.point (NumberTable.cell rows k 0) (NumberTable.cell rows k 1)
       in p `seq` (p, k + 1)

-- | The columns of a table besides x and y: the name of each column, and its value in every row.
columns :: PartTable -> [(Name, Vector Double)]
columns PartTable {rows, names} =
  [ (n, Vector.generate (NumberTable.count rows) (\k -> NumberTable.cell rows k i))
    | (i, n) <- zip [2 ..] names
  ]

-- | The further columns of a row, by the row's index from 0: the name of each column, and its value
-- in this row.
columnsAt :: PartTable -> Int -> [(Name, Double)]
columnsAt PartTable {rows, names} k = [(n, NumberTable.cell rows k i) | (i, n) <- zip [2 ..] names]

-- | A curve of a program: the exact curve and what belongs to it.
data PartCurve = PartCurve
  { exact :: Exact.Curve,
    -- | the columns besides x and y of the table from which the curve was made: the name of each
    -- column, and its value in every row
    tableColumns :: [(Name, Vector Double)],
    -- | the fit, if the curve consists of lines, parabolas and arcs fitted to a table
    fitting :: Maybe Fitting,
    -- | lines and arcs within 'Tolerance.curve' of the exact curve
    approximation :: ~MeasuredPolyarc
  }
  deriving stock (Eq, Show)

-- | The result of fitting sections (lines, parabolas and arcs) to the points of a table: the
-- sections, their deviations from the points, and the points.
data Fitting = Fitting
  { sections :: NonEmpty Section.Section,
    deviations :: [SectionFit.Deviation],
    fittedPoints :: Vector Point
  }
  deriving stock (Eq, Show)

-- | Makes a curve of the program. @tableColumns@ are the columns of its table besides x and y.
-- @fitting@ is present if the curve consists of fitted sections.
curve :: [(Name, Vector Double)] -> Maybe Fitting -> Exact.Curve -> PartCurve
curve tableColumns fitting exact =
  PartCurve {exact, tableColumns, fitting, approximation}
  where
    approximation = CurveFit.approximate Tolerance.curve exact

-- | A curve that has no table: without columns and without a fit.
plain :: Exact.Curve -> PartCurve
plain = curve [] Nothing

-- | The points at which the recalculations of a curve have made slight corners.
breakPoints :: PartCurve -> [Point]
breakPoints c = foldr seq found found
  where
    found = map (Exact.at (exact c)) (Exact.joinedCorners (exact c))

-- | The first and the last point of a curve.
ends :: PartCurve -> [Point]
ends c = [Exact.start (exact c), Exact.end (exact c)]

-- | The curve with the opposite direction. The values of its columns are reversed, so that each
-- value stays at its point.
reversed :: PartCurve -> PartCurve
reversed c =
  curve
    [(n, Exact.inReverseOrder (exact c) vs) | (n, vs) <- tableColumns c]
    Nothing
    (Exact.reversed (exact c))

-- | The image of the curve @c@ under the transformation @s@. The columns keep their values even if
-- @s@ scales the curve, because they are dimensions of the part.
transformed :: Transformation -> PartCurve -> PartCurve
transformed s c = curve (tableColumns c) Nothing (Exact.transformed s (exact c))

-- | The bevels along the polyarc of a curve, from their values in radians at the rows of the
-- curve's table. A pair of the result is a station (the arc length from the start in mm) and the
-- bevel there in radians. The stations rise. Between two stations the bevel is interpolated
-- linearly. Bisection makes the stations so close that the interpolated bevel is within
-- 'Tolerance.bevel' of the bevel of the exact curve. It compares both at two points of each step.
alongPolyarc :: PartCurve -> Vector Double -> [(Double, Double)]
alongPolyarc c values = (0, angleAt 0) : concat (zipWith sampled stations (drop 1 stations))
  where
    stations = MeasuredPolyarc.stations (approximation c)
    column = Exact.column (exact c) values
    -- The bevel at the station @s@ of the polyarc. The station is scaled by the ratio of both
    -- lengths, because the exact curve is a little longer or shorter than the polyarc.
    angleAt s =
      Exact.columnAt (exact c) column (Exact.parameterAtLength (exact c) (Mm (s * whole / total)))
    Mm whole = Exact.length (exact c)
    Mm total = MeasuredPolyarc.length (approximation c)
    -- The steps before bisection are at most 0.1 mm, or about an eighth of the mean distance
    -- between rows of the table if that is larger.
    sampled a b =
      let count = max 1 (ceiling ((b - a) / stride)) :: Int
          marks = [a + (b - a) * fromIntegral k / fromIntegral count | k <- [0 .. count]]
       in concat (zipWith (halved (12 :: Int)) (map point marks) (map point (drop 1 marks)))
    point s = (s, angleAt s)
    stride = max 0.1 (total / (8 * fromIntegral (max 1 (Vector.length values))))
    -- Bisects a step, at most 12 times, until linear interpolation is within @slack@ of the bevel
    -- at two tested points: the middle of the step, and the point a quarter of the step from its
    -- start.
    halved depth (a, x) (b, y)
      | depth <= 0 || abs (z - (x + y) / 2) <= slack && abs (z' - (3 * x + y) / 4) <= slack =
        [(b, y)]
      | otherwise = halved (depth - 1) (a, x) (m, z) <> halved (depth - 1) (m, z) (b, y)
      where
        m = (a + b) / 2
        z = angleAt m
        z' = angleAt ((a + m) / 2)
    Rad slack = Tolerance.bevel

-- | The least and the greatest x coordinate of a curve, computed from its polyarc.
xRange :: Exact.Curve -> (Mm, Mm)
xRange c = (Mm (minimum xs), Mm (maximum xs))
  where
    polyarc = approximation (plain c)
    xs =
      Vec.x (MeasuredPolyarc.start polyarc) :
      concatMap (map Vec.x . extremes) (NonEmpty.toList (MeasuredPolyarc.segments polyarc))
    extremes s = case s of
      Segment.Straight _ q -> [q]
      Segment.Arc {Segment.start = p, Segment.end = q, Segment.centre = m} ->
        let Mm r = Segment.radius m p
         in q : filter (Segment.hasFootOf s) [Vec.shift (Vec.vec d 0) m | d <- [r, -r]]

-- | Makes the spans of a curve, one from each section. The vector holds the curve's parameter at
-- each row of the table. This is the index, from 0, of the span that contains the row, plus the
-- fraction of this span that lies before the row.
spansOfSections :: Vector Point -> NonEmpty Section.Section -> (NonEmpty SpanShape, Vector Double)
spansOfSections rows sections = (fmap spanOf sections, Vector.imap parameter rows)
  where
    numbered = zip [0 :: Int ..] (NonEmpty.toList sections)
    parameter k q = case [(i, s) | (i, s) <- numbered, k + 1 <= Section.final s] of
      (i, s) : _ -> fromIntegral i + share s q
      [] -> fromIntegral (length sections)

-- | The span of a curve that has the shape of the section @s@.
spanOf :: Section.Section -> SpanShape
spanOf s = case (Section.formula s, Section.segment s) of
  (Section.Polynomial a b c, Nothing) ->
    Quadratic a b c (Vec.x (Section.from s)) (Vec.x (Section.to s))
  (_, Just segment) -> case segment of
    Segment.Straight a b -> Line a b
    Segment.Arc {} -> Circular segment
  (Section.Circle _ _, Nothing) -> Line (Section.from s) (Section.to s)

-- | The fraction, from 0 to 1, of the section @s@ that lies before the point @q@ of a row: a
-- fraction of the arc length on an arc, and otherwise of the width in x.
share :: Section.Section -> Point -> Double
share s q
  | Vec.x q == Vec.x (Section.from s) = 0
  | Vec.x q == Vec.x (Section.to s) = 1
  | otherwise = case Section.segment s of
    Just arc@Segment.Arc {} ->
      Segment.fraction arc (Vec.point (Vec.x q) (Section.height s (Vec.x q)))
    _ -> (Vec.x q - Vec.x (Section.from s)) / (Vec.x (Section.to s) - Vec.x (Section.from s))
