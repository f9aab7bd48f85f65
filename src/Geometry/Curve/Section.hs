-- | Sections: lines, parabolas and circular arcs y(x) through two rows of a table.
--
-- The deviation of a row is y of the section minus y of the row. The parabolas through two given
-- rows form a family with one parameter t, and so do the arcs; t is the number in 'SectionShape'.
-- At every x between the two rows, y rises with t (arcs) or falls with t (parabolas). Therefore the
-- largest absolute deviation is least for a certain t: the lowest and the highest deviation are
-- then equal in size and have opposite signs. An arc y(x) has no vertical tangent between its ends,
-- so its angle t has a largest absolute value. If no allowed angle makes both deviations equal in
-- size, one of the two extreme angles is best.
module Geometry.Curve.Section
  ( -- * Tables
    PointTable,
    table,
    rows,
    row,
    PointTableFault (..),

    -- * Sections
    Section (..),
    SectionShape (..),
    SectionKind (..),
    kind,
    height,
    deviationFrom,
    SectionFormula (..),
    formula,
    segment,

    -- * Construction
    parabola,
    best,
    bestWithin,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.Maybe (fromMaybe)
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Vector
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- Tables ----------------------------------------------------------------------------------------

-- | Table of at least two rows, as the lists of x and of y in mm. x rises throughout or falls
-- throughout.
data PointTable = PointTable {xs :: Vector Double, ys :: Vector Double}
  deriving stock (Eq, Show)

-- | Fault of a table. Rows are counted from 1.
data PointTableFault
  = -- | too few rows; the count of rows
    TooFewRows Int
  | -- | the number of the first row that breaks the order: its x equals that of the row before, or
    -- x turns back there
    OutOfOrder Int
  deriving stock (Eq, Show)

-- | Table of at least two points, if x rises strictly or falls strictly.
table :: [Point] -> Either PointTableFault PointTable
table points = case points of
  p : q : _ ->
    case [ k
           | (k, a, b) <- zip3 [2 ..] points (drop 1 points),
             not (isSameOrder (Vec.x p) (Vec.x q) (Vec.x a) (Vec.x b))
         ] of
      k : _ -> Left (OutOfOrder k)
      [] ->
        Right (PointTable (Vector.fromList (map Vec.x points)) (Vector.fromList (map Vec.y points)))
  _ -> Left (TooFewRows (length points))
  where
    isSameOrder a b c d = (b > a && d > c) || (b < a && d < c)

-- | Count of rows.
rows :: PointTable -> Int
rows t = Vector.length (xs t)

-- | Row with index @k@, counted from 0.
row :: PointTable -> Int -> Point
row t k = Vec.point (xs t Vector.! k) (ys t Vector.! k)

-- Sections --------------------------------------------------------------------------------------

-- | Section through two rows of the table.
data Section = Section
  { -- | number of the section's first row, counted from 1
    first :: Int,
    -- | number of the section's last row, counted from 1
    final :: Int,
    from :: Point,
    to :: Point,
    curve :: SectionShape,
    -- | largest absolute deviation in y, over the rows from first to last
    largestDeviation :: Mm
  }
  deriving stock (Eq, Show)

-- | Shape of a section between its ends.
data SectionShape
  = Line
  | -- | the coefficient a, in 1/mm, of @y = c + a·(x − x₁)·(x − x₂)@; the ends lie at x₁ and x₂,
    -- and c is the y, at x, of the chord between them
    Parabola Double
  | -- | the angle between chord and arc at the ends, half of the sweep; positive for an arc above
    -- its chord
    Arc Rad
  deriving stock (Eq, Show)

-- | Kinds of sections, the simplest first.
data SectionKind = LineKind | ParabolaKind | ArcKind
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | Kind of a shape.
kind :: SectionShape -> SectionKind
kind c = case c of
  Line -> LineKind
  Parabola _ -> ParabolaKind
  Arc _ -> ArcKind

-- | y in mm of section @p@ at an x (mm) between its ends.
height :: Section -> Double -> Double
height p x
  | x == Vec.x (from p) = Vec.y (from p)
  | x == Vec.x (to p) = Vec.y (to p)
  | otherwise = Vec.y (from p) + rise (chordOf (from p) (to p)) (curve p) (x - Vec.x (from p))

-- | Equation of a section, in the coordinates of the table.
data SectionFormula
  = -- | @y = a·x² + b·x + c@; a is 0 for a line and for an arc that is nearly straight
    Polynomial Double Double Double
  | -- | centre and radius
    Circle Point Mm
  deriving stock (Eq, Show)

-- | Equation of section @p@, from which the span of a part's curve is made.
formula :: Section -> SectionFormula
formula p = case curve p of
  Line -> polynomial 0
  Parabola a -> polynomial a
  Arc (Rad t)
    | isFlat t -> polynomial 0
    | otherwise -> let c = centre p t in Circle c (Vec.distance c (from p))
  where
    Chord w h = chordOf (from p) (to p)
    (x1, y1, x2) = (Vec.x (from p), Vec.y (from p), Vec.x (to p))
    polynomial a = let s = h / w in Polynomial a (s - a * (x1 + x2)) (y1 - s * x1 + a * x1 * x2)

-- | y of section @p@ minus y of point @q@, in mm, at the x of @q@.
deviationFrom :: Section -> Point -> Double
deviationFrom p q = height p (Vec.x q) - Vec.y q

-- | Parabola y(x) through three points, as the shape of a section from the first to the last.
parabola :: Point -> Point -> Point -> SectionShape
parabola a m b = Parabola ((up - x * h / w) / (x * (x - w)))
  where
    Chord w h = chordOf a b
    Chord x up = chordOf a m

-- | True if an arc is so flat that 'Tolerance.straight' takes it for a line. @t@ is the angle
-- between chord and arc in radians.
isFlat :: Double -> Bool
isFlat t = Rad (2 * abs t) <= Tolerance.straight

-- | Centre of the arc of section @p@. @t@ is the angle between chord and arc at the ends, in
-- radians and not 0.
centre :: Section -> Double -> Point
centre p t =
  Vec.shift
    (Vec.scale (-(sense / (2 * tan t))) (Vec.left (Vec.to (from p) (to p))))
    (Vec.interpolate 0.5 (from p) (to p))
  where
    Chord w _ = chordOf (from p) (to p)
    sense = signum w

-- | Section as a segment; Nothing for a parabola.
segment :: Section -> Maybe Segment
segment p = case curve p of
  Line -> Just (Straight (from p) (to p))
  Parabola _ -> Nothing
  Arc (Rad t)
    | isFlat t -> Just (Straight (from p) (to p))
    | otherwise ->
      Just
        ( Segment.arc
            (if (t > 0) == (Vec.x (to p) > Vec.x (from p)) then Clockwise else CounterClockwise)
            (centre p t)
            (from p)
            (to p)
        )

-- | Differences in x and in y, in mm, from the first end of a section to the last.
data Chord = Chord Double Double

-- | Chord from one point to another.
chordOf :: Point -> Point -> Chord
chordOf a b = Chord (Vec.x b - Vec.x a) (Vec.y b - Vec.y a)

-- | y of a section minus y of its first end, in mm. @x@ is measured from the first end, in mm and
-- with its sign.
rise :: Chord -> SectionShape -> Double -> Double
rise chord@(Chord w h) c x = case c of
  Line -> x * h / w
  Parabola a -> x * h / w + a * x * (x - w)
  Arc (Rad t) -> arcRise chord (tan t) x

-- | y of an arc minus y of its first end, in mm. @x@ is measured from the first end, in mm and with
-- its sign. @tangent@ is the tangent of the angle between chord and arc. The circles through (0, 0)
-- and (w, h) are @μ·(x·(x − w) + y·(y − h)) + x·h − y·w = 0@, where μ is @−tangent@ if w is
-- positive and @tangent@ if w is negative. The arc is the solution y that tends to the chord as μ
-- tends to 0.
arcRise :: Chord -> Double -> Double -> Double
arcRise (Chord w h) tangent x = 2 * q / (p + signum w * sqrt (max 0 (p * p - 4 * mu * q)))
  where
    mu = -(signum w * tangent)
    p = mu * h + w
    q = mu * x * (x - w) + x * h
{-# INLINE arcRise #-}

-- | Section of kind @k@ between the rows @i@ and @j@ (indices from 0) whose largest absolute
-- deviation is least. The result is this deviation in mm, taken over the rows between, and the
-- shape.
best :: PointTable -> SectionKind -> Int -> Int -> (Double, SectionShape)
best t k i j = let (worst, c, _) = bestWithin (1 / 0) Nothing t k i j in (worst, c)

-- | Section of kind @k@ between the rows @i@ and @j@ (indices from 0) whose largest absolute
-- deviation is least. The result is this deviation in mm, the shape, and the pair of rows that
-- determines the deviation. The pair has no meaning if there are no rows between.
--
-- The search ends once the deviation is known to exceed @limit@ (mm). Then the first result is a
-- lower bound of the deviation, and this bound exceeds the limit as well. The search starts with
-- the rows @initialPair@, if they are given. The pair that was found for a slightly shorter section
-- saves most of the work.
bestWithin ::
  Double ->
  Maybe (Int, Int) ->
  PointTable ->
  SectionKind ->
  Int ->
  Int ->
  (Double, SectionShape, Maybe (Int, Int))
bestWithin limit initialPair t@(PointTable xs ys) k i j = case k of
  LineKind
    | Just (p, r) <- initialPair,
      max (abs (relative Line p)) (abs (relative Line r)) > limit ->
      (max (abs (relative Line p)) (abs (relative Line r)), Line, initialPair)
    | otherwise ->
      let (p, low, r, high) =
            extremes i j (relative Line)
       in (max (-low) high, Line, Just (p, r))
  _ | j == i + 1 -> (0, case k of ArcKind -> Arc (Rad 0); _ -> Parabola 0, Nothing)
  ParabolaKind ->
    let q m = let x = across m in x * (x - w)
        deviation m = relative Line m
        (worst, s, rows') =
          minimax
            limit
            initialPair
            (\p r -> -((deviation p + deviation r) / (q p + q r)))
            (\a m -> deviation m + a * q m)
            i
            j
     in (worst, Parabola s, Just rows')
  ArcKind ->
    let steepest = pi / 2 - atan2 (abs h) (abs w)
        deviation a m = arcRise chord (tan a) (across m) - up m
        (worst, s, rows') =
          minimax
            limit
            initialPair
            (\p r -> root steepest (\a -> deviation a p + deviation a r))
            deviationOf
            i
            j
        deviationOf a = let tangent = tan a in \m -> arcRise chord tangent (across m) - up m
     in (worst, Arc (Rad s), Just rows')
  where
    chord@(Chord w h) = chordOf (row t i) (row t j)
    across m = Vector.unsafeIndex xs m - Vector.unsafeIndex xs i
    up m = Vector.unsafeIndex ys m - Vector.unsafeIndex ys i
    relative c m = rise chord c (across m) - up m

-- | Row with the lowest value and that value, then row with the highest value and that value. Only
-- the rows strictly between @i@ and @j@ (indices from 0) count. If there are none, both rows are
-- @i@ and both values 0.
extremes :: Int -> Int -> (Int -> Double) -> (Int, Double, Int, Double)
extremes i j value
  | j <= i + 1 = (i, 0, i, 0)
  | otherwise = let v = value (i + 1) in go (i + 2) (i + 1) v (i + 1) v
  where
    go m low vLow high vHigh
      | m >= j = (low, vLow, high, vHigh)
      | v < vLow = go (m + 1) m v high vHigh
      | v > vHigh = go (m + 1) low vLow m v
      | otherwise = go (m + 1) low vLow high vHigh
      where
        v = value m
{-# INLINE extremes #-}

-- | Minimax fit of the parameter t of a family of sections by single exchange (Remez). The result
-- is the least largest deviation in mm, the t for which it occurs, and the two rows that determine
-- it. Only the rows strictly between @i@ and @j@ (indices from 0) count. @limit@ is in mm.
-- @initialPair@ has the two rows of the first round; Nothing means the rows with the lowest and the
-- highest deviation for t = 0.
--
-- @balance@ gives the t for which two rows deviate equally to opposite sides. @deviation@ gives the
-- deviation of a row, in mm, for a t. At the optimum, two rows balance and no other row deviates
-- more. As long as another row deviates more, it replaces the row of the pair on the same side of
-- the curve. The balanced deviation rises with every exchange, so the iteration ends; it also ends
-- once this deviation exceeds the limit. It takes about four rounds, or one or two from a good
-- initial pair.
minimax ::
  Double ->
  Maybe (Int, Int) ->
  (Int -> Int -> Double) ->
  (Double -> Int -> Double) ->
  Int ->
  Int ->
  (Double, Double, (Int, Int))
minimax limit initialPair balance deviation i j =
  uncurry (go (-1) (1 / 0, 0, (i, i))) (fromMaybe (low0, high0) initialPair)
  where
    (low0, _, high0, _) = extremes i j (deviation 0)
    go lastLevel found one other
      | level > limit = (level, t, (low, high))
      | worst <= level * (1 + 1e-13) || level <= lastLevel = min found (worst, t, (low, high))
      | vHigh >= -vLow = go level (min found (worst, t, (low, high))) low high'
      | otherwise = go level (min found (worst, t, (low, high))) low' high
      where
        t = balance one other
        (low, high) = if deviation t one <= deviation t other then (one, other) else (other, one)
        level = max (abs (deviation t low)) (abs (deviation t high))
        (low', vLow, high', vHigh) = extremes i j (deviation t)
        worst = max (-vLow) vHigh
{-# INLINE minimax #-}

-- | Zero of the rising function @f@ between @−limit@ and @limit@, to nearly full precision, by the
-- Illinois variant of the false-position method. If @f@ has no sign change, the result is the end
-- of the range at which @f@ is nearer to 0. The Illinois rule halves the value of @f@ at an end of
-- the bracket that did not move, so that this end moves next.
root :: Double -> (Double -> Double) -> Double
root limit f
  | f (-limit) >= 0 = -limit
  | f limit <= 0 = limit
  | otherwise = go (100 :: Int) (-limit) (f (-limit)) limit (f limit)
  where
    go remaining low below high above
      | remaining <= 0 || not (low < t && t < high) || high - low < 1e-16 || v == 0 = t
      | v < 0 = raiseLow t v high above
      | otherwise = lowerHigh low below t v
      where
        t = low + (high - low) * (below / (below - above))
        v = f t
        raiseLow a va b vb =
          let u =
                a + (b - a) * (va / (va - vb))
           in if abs (u - a) < 1e-16 then u else go (remaining - 1) a va b (0.5 * vb)
        lowerHigh a va b vb =
          let u =
                a + (b - a) * (va / (va - vb))
           in if abs (b - u) < 1e-16 then u else go (remaining - 1) a (0.5 * va) b vb
{-# INLINE root #-}
