-- | Tables and curves as values of a program.
--
-- A curve is exact. A contour follows a polyarc within 'Tolerance.curve' of the curve instead. This
-- module makes that polyarc, and keeps the columns of the curve's table with the curve.
module Part.Curve
  ( PartTable (..),
    points,
    columns,
    PartCurve (..),
    Fitting (..),
    curve,
    plain,
    ends,
    reversed,
    transformed,
    parametric,
    alongPolyarc,
    xRange,
    spansOfSections,
  )
where

import Base.Name (Name)
import Base.NumberTable (NumberTable)
import Base.NumberTable qualified as NumberTable
import Base.Quantity (Mm (..), Rad (..), minus, times)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Semigroup (sconcat)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.ArcFitting.CubicFit qualified as CubicFit
import Geometry.ArcFitting.ParametricFit (ParametricCurve (..))
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.ArcFitting.PolyarcFit qualified as PolyarcFit
import Geometry.Curve (Approach (..), SpanShape (..))
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

-- | The numbers of a table: x and y in mm, and then one column for each name. Lengths in a column
-- are in mm, angles in radians, times in minutes.
data PartTable = PartTable {rows :: NumberTable, names :: [Name]}
  deriving stock (Eq, Show)

-- | The points of a table in the order of its rows.
points :: PartTable -> Vector Point
points PartTable {rows} = Vector.unfoldrExactN (NumberTable.count rows) next 0
  where
    next k =
      let p = Vec.point (NumberTable.cell rows k 0) (NumberTable.cell rows k 1)
       in p `seq` (p, k + 1)

-- | The columns after x and y, with their names.
columns :: PartTable -> [(Name, Vector Double)]
columns PartTable {rows, names} =
  [ (n, Vector.generate (NumberTable.count rows) (\k -> NumberTable.cell rows k i))
    | (i, n) <- zip [2 ..] names
  ]

-- | A curve of a program: the exact curve and what belongs to it.
data PartCurve = PartCurve
  { exact :: Exact.Curve,
    -- | the columns of the table that the curve was made from, with their names: a number for
    -- every row
    tableColumns :: [(Name, Vector Double)],
    -- | for a curve of sections, the fit to its table
    fitting :: Maybe Fitting,
    -- | lines and arcs within 'Tolerance.curve' of the exact curve
    approximation :: ~MeasuredPolyarc
  }
  deriving stock (Eq, Show)

-- | Sections fitted to the points of a table, their deviations from the points, and the points.
data Fitting = Fitting
  { sections :: NonEmpty Section.Section,
    deviations :: [SectionFit.Deviation],
    fittedPoints :: Vector Point
  }
  deriving stock (Eq, Show)

-- | A curve from the columns of its table, the fit of its sections if it has any, and the exact
-- curve.
curve :: [(Name, Vector Double)] -> Maybe Fitting -> Exact.Curve -> PartCurve
curve tableColumns fitting exact =
  PartCurve {exact, tableColumns, fitting, approximation = arcsAlong Tolerance.curve exact}

-- | Arcs and lines within a tolerance of a curve. A curve of arcs and lines keeps its arcs and
-- lines, with small kinks smoothed. A cubic spline is fitted by 'CubicFit', any other curve by
-- 'ParametricFit'.
arcsAlong :: Mm -> Exact.Curve -> MeasuredPolyarc
arcsAlong tolerance exact =
  case (Exact.toSegments exact, cubics) of
    (Just segments, _) -> MeasuredPolyarc.fromSegments (PolyarcFit.smoothed tolerance segments)
    (Nothing, Just (off, xs, ys)) ->
      MeasuredPolyarc.fromFlatPolyarc (CubicFit.approximate (minus tolerance off) xs ys)
    (Nothing, Nothing) ->
      MeasuredPolyarc.fromSegments (sconcat (fitted (parametric exact)))
  where
    fitted = ParametricFit.approximate tolerance
    cubics = Exact.cubics (times (0.5 * Tolerance.deviationShare) tolerance) exact

-- | A curve without columns and without a fit.
plain :: Exact.Curve -> PartCurve
plain = curve [] Nothing

-- | An exact curve as a function of its parameter, for 'ParametricFit'.
parametric :: Exact.Curve -> ParametricCurve
parametric c =
  ParametricCurve
    { place = Exact.at c,
      direction =
        \side ->
          Exact.tangentFrom
            (case side of ParametricFit.Arriving -> Before; ParametricFit.Leaving -> After)
            c,
      begin = 0,
      breaks = case drop 1 (Exact.breaks c) of
        [] -> Exact.domain c :| []
        u : us -> u :| us
    }

-- | The first and the last point of a curve.
ends :: PartCurve -> [Point]
ends c = [Exact.start (exact c), Exact.end (exact c)]

-- | A curve in the opposite direction. The rows of its columns are in reverse order, too.
reversed :: PartCurve -> PartCurve
reversed c =
  curve
    [(n, Exact.inReverseOrder (exact c) vs) | (n, vs) <- tableColumns c]
    Nothing
    (Exact.reversed (exact c))

-- | The image of a curve. The columns keep their values even when the curve is scaled, because they
-- are dimensions of the part.
transformed :: Transformation -> PartCurve -> PartCurve
transformed s c = curve (tableColumns c) Nothing (Exact.transformed s (exact c))

-- | The angles of a column along a curve's polyarc: pairs of a station in mm and an angle in
-- radians, in the order of the stations. Linear interpolation between two pairs is within
-- 'Tolerance.bevel' of the column.
alongPolyarc :: PartCurve -> Vector Double -> [(Double, Double)]
alongPolyarc c values = (0, angleAt 0) : concat (zipWith sampled stations (drop 1 stations))
  where
    stations = MeasuredPolyarc.stations (approximation c)
    column = Exact.column (exact c) values
    -- A station of the polyarc is scaled to the curve, whose length differs a little.
    angleAt s =
      Exact.columnAt (exact c) column (Exact.parameterAtLength (exact c) (Mm (s * whole / total)))
    Mm whole = Exact.length (exact c)
    Mm total = MeasuredPolyarc.length (approximation c)
    -- The first steps are small enough that none of them skips a row.
    sampled a b =
      let count = max 1 (ceiling ((b - a) / stride)) :: Int
          marks = [a + (b - a) * fromIntegral k / fromIntegral count | k <- [0 .. count]]
       in concat (zipWith (halved (12 :: Int)) (map point marks) (map point (drop 1 marks)))
    point s = (s, angleAt s)
    stride = max 0.1 (total / (8 * fromIntegral (max 1 (Vector.length values))))
    -- Bisects a step until linear interpolation is good enough at its half and at its quarter.
    halved depth (a, x) (b, y)
      | depth <= 0 || abs (z - (x + y) / 2) <= slack && abs (z' - (3 * x + y) / 4) <= slack =
        [(b, y)]
      | otherwise = halved (depth - 1) (a, x) (m, z) <> halved (depth - 1) (m, z) (b, y)
      where
        m = (a + b) / 2
        z = angleAt m
        z' = angleAt ((a + m) / 2)
    Rad slack = Tolerance.bevel

-- | The least and the greatest x coordinate of a curve, measured on its polyarc.
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

-- | The sections as spans of a curve, and the curve's parameter at each row of the table. The
-- parameter is the index of the span, from 0, plus the fraction of the span before the row.
spansOfSections :: Vector Point -> NonEmpty Section.Section -> (NonEmpty SpanShape, Vector Double)
spansOfSections rows sections = (fmap spanOf sections, Vector.imap parameter rows)
  where
    numbered = zip [0 :: Int ..] (NonEmpty.toList sections)
    parameter k q = case [(i, s) | (i, s) <- numbered, k + 1 <= Section.final s] of
      (i, s) : _ -> fromIntegral i + share s q
      [] -> fromIntegral (length sections)

-- | A section as a span of a curve.
spanOf :: Section.Section -> SpanShape
spanOf s = case (Section.formula s, Section.segment s) of
  (Section.Polynomial a b c, Nothing) ->
    Quadratic a b c (Vec.x (Section.from s)) (Vec.x (Section.to s))
  (_, Just segment) -> case segment of
    Segment.Straight a b -> Line a b
    Segment.Arc {} -> Circular segment
  (Section.Circle _ _, Nothing) -> Line (Section.from s) (Section.to s)

-- | The fraction of a section, from 0 to 1, that lies before the x of a row.
share :: Section.Section -> Point -> Double
share s q
  | Vec.x q == Vec.x (Section.from s) = 0
  | Vec.x q == Vec.x (Section.to s) = 1
  | otherwise = case Section.segment s of
    Just arc@Segment.Arc {} ->
      Segment.fraction arc (Vec.point (Vec.x q) (Section.height s (Vec.x q)))
    _ -> (Vec.x q - Vec.x (Section.from s)) / (Vec.x (Section.to s) - Vec.x (Section.from s))
