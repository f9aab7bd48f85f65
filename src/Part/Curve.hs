-- | Tables and curves as values of a program.
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
    track,
    along,
    abscissas,
    piecesOf,
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
import Geometry.MeasuredPolyarc (Polyarc)
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Tolerance qualified as Tolerance

-- | Rows of x, y and the columns with these names, in mm, radians and minutes.
data PartTable = PartTable {rows :: NumberTable, names :: [Name]}
  deriving stock (Eq, Show)

-- | The points of a table in the order of its rows.
points :: PartTable -> Vector Point
points PartTable {rows} = Vector.unfoldrExactN (NumberTable.count rows) next 0
  where
    next k =
      let p =
            Vec.point (NumberTable.cell rows k 0) (NumberTable.cell rows k 1)
       in p `seq` (p, k + 1)

-- | The columns beside x and y.
columns :: PartTable -> [(Name, Vector Double)]
columns PartTable {rows, names} =
  [ (n, Vector.generate (NumberTable.count rows) (\k -> NumberTable.cell rows k i))
    | (i, n) <- zip [2 ..] names
  ]

-- | A curve as it is defined, exactly; the columns of its table; the pieces that were chosen for
-- it, if they were; and the chain of arcs within 'Tolerance.curve' that stands for it where it is
-- walked.
data PartCurve = PartCurve
  { exact :: Exact.Curve,
    fields :: [(Name, Vector Double)],
    fitting :: Maybe Fitting,
    laid :: ~Polyarc
  }
  deriving stock (Eq, Show)

-- | The pieces through a table, and by how much they miss its rows.
data Fitting = Fitting
  { pieces :: NonEmpty Section.Section,
    misses :: [SectionFit.Deviation],
    through :: Vector Point
  }
  deriving stock (Eq, Show)

-- | A curve with the columns of its table.
curve :: [(Name, Vector Double)] -> Maybe Fitting -> Exact.Curve -> PartCurve
curve fields fitting exact =
  PartCurve {exact, fields, fitting, laid = arcsAlong Tolerance.curve exact}

-- | Arcs and lines that stay within a distance of a curve; its own where it has no others and no
-- kinks between its corners.
arcsAlong :: Mm -> Exact.Curve -> Polyarc
arcsAlong tolerance exact =
  case (Exact.chain exact, Exact.cubics (times (0.5 * Tolerance.deviationShare) tolerance) exact) of
    (Just segments, _) -> MeasuredPolyarc.fromSegments (PolyarcFit.smoothed tolerance segments)
    (Nothing, Just (off, xs, ys)) ->
      MeasuredPolyarc.fromOutline (CubicFit.approximate (minus tolerance off) xs ys)
    (Nothing, Nothing) ->
      MeasuredPolyarc.fromSegments (sconcat (ParametricFit.approximate tolerance (track exact)))

-- | A curve without a table.
plain :: Exact.Curve -> PartCurve
plain = curve [] Nothing

track :: Exact.Curve -> ParametricCurve
track c =
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

-- | Where it begins and ends.
ends :: PartCurve -> [Point]
ends c = [Exact.start (exact c), Exact.end (exact c)]

-- | Walked the other way; the columns go with it.
reversed :: PartCurve -> PartCurve
reversed c =
  curve [(n, Exact.backwards (exact c) vs) | (n, vs) <- fields c] Nothing (Exact.reversed (exact c))

-- | The columns keep their values: they are dimensions of the part.
transformed :: Transformation -> PartCurve -> PartCurve
transformed s c = curve (fields c) Nothing (Exact.transformed s (exact c))

-- | Bevels for the rows of a curve's table, along the chain that stands for the curve: places on
-- the chain in mm and the angles there in radians, so near to one another that between them an
-- angle goes evenly, within 'Tolerance.bevel'.
along :: PartCurve -> Vector Double -> [(Double, Double)]
along c values = (0, at 0) : concat (zipWith between stations (drop 1 stations))
  where
    stations = MeasuredPolyarc.joints (laid c)
    column = Exact.column (exact c) values
    -- The chain and the curve differ in length by nothing that tells.
    at s = Exact.columnAt (exact c) column (Exact.alongTo (exact c) (Mm (s * whole / chain)))
    Mm whole = Exact.length (exact c)
    Mm chain = MeasuredPolyarc.length (laid c)
    -- In steps that rows cannot hide in.
    between a b =
      let count = max 1 (ceiling ((b - a) / stride)) :: Int
          marks = [a + (b - a) * fromIntegral k / fromIntegral count | k <- [0 .. count]]
       in concat (zipWith (\p q -> halved (12 :: Int) (p, at p) (q, at q)) marks (drop 1 marks))
    stride = max 0.1 (chain / (8 * fromIntegral (max 1 (Vector.length values))))
    halved tries (a, x) (b, y)
      | tries <= 0 || abs (z - (x + y) / 2) <= slack && abs (z' - (3 * x + y) / 4) <= slack =
        [(b, y)]
      | otherwise = halved (tries - 1) (a, x) (m, z) <> halved (tries - 1) (m, z) (b, y)
      where
        m = (a + b) / 2
        z = at m
        z' = at ((a + m) / 2)
    Rad slack = Tolerance.bevel

-- | The least and the greatest x that a curve comes to, by the chain of arcs that stands for it.
abscissas :: Exact.Curve -> (Mm, Mm)
abscissas c = (Mm (minimum xs), Mm (maximum xs))
  where
    chain = laid (plain c)
    xs =
      Vec.x (MeasuredPolyarc.start chain) :
      concatMap (map Vec.x . farthest) (NonEmpty.toList (MeasuredPolyarc.segments chain))
    farthest s = case s of
      Segment.Straight _ q -> [q]
      Segment.Arc {Segment.start = p, Segment.end = q, Segment.centre = m} ->
        let Mm r =
              Segment.radius m p
         in q : filter (Segment.spans s) [Vec.shift (Vec.vec d 0) m | d <- [r, -r]]

-- | Pieces as a curve, with the parameters of the rows on it.
piecesOf :: Vector Point -> NonEmpty Section.Section -> (NonEmpty SpanShape, Vector Double)
piecesOf rows chosen = (fmap piece chosen, Vector.imap station rows)
  where
    piece p = case (Section.formula p, Section.segment p) of
      (Section.Polynomial a b c, Nothing) ->
        Quadratic a b c (Vec.x (Section.from p)) (Vec.x (Section.to p))
      (_, Just s) -> case s of
        Segment.Straight a b -> Line a b
        Segment.Arc {} -> Circular s
      (Section.Circle _ _, Nothing) -> Line (Section.from p) (Section.to p)
    numbered = zip [0 :: Int ..] (NonEmpty.toList chosen)
    station k q = case [(i, p) | (i, p) <- numbered, k + 1 <= Section.final p] of
      (i, p) : _ -> fromIntegral i + share p q
      [] -> fromIntegral (length chosen)
    share p q
      | Vec.x q == Vec.x (Section.from p) = 0
      | Vec.x q == Vec.x (Section.to p) = 1
      | otherwise = case Section.segment p of
        Just s@Segment.Arc {} ->
          Segment.fraction s (Vec.point (Vec.x q) (Section.height p (Vec.x q)))
        _ -> (Vec.x q - Vec.x (Section.from p)) / (Vec.x (Section.to p) - Vec.x (Section.from p))
