-- | Unshifted curves: consecutive spans, each of them a cubic in x and in y, an arc, or a Bézier
-- curve.
--
-- The parameter runs from 0 to the count of spans, by 1 over each span; it has no unit. The local
-- parameter of a span runs from 0 to 1. A shift moves the points of a curve along its normals; a
-- base is a curve without shifts. A base keeps the rows of the table from which it was made. A row
-- is a point of the table with its parameter on the curve. A column gives a number for each row and
-- is interpolated between the rows ("Geometry.Curve.Column").
module Geometry.Curve.BasisCurve
  ( BasisCurve (..),
    SpanList (..),
    spans,
    asSegments,
    CurveKind (..),
    EndCondition (..),
    Knot (..),
    CurveFault (..),
    polyline,
    spline,
    parabola,
    fromShapes,
    fromSegmentsAt,
    fromSegments,
    fromBeziers,
    count,
    arcLength,
    chords,
    fractions,
    CurvePosition (..),
    SpanPoint (..),
    spanPoint,
    spanPointAt,
    lengthTo,
    expansion,
    direction,
    degreeAt,
    reversed,
    inReverseOrder,
    lacksRepeatedStart,
    transformed,
  )
where

import Base.Quantity (Mm (..))
import Data.List (find)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, mapMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Data.Vector.Unboxed qualified as Unboxed
import Geometry.Curve.Bezier (Bezier)
import Geometry.Curve.Bezier qualified as Bezier
import Geometry.Curve.Span (Span (..), SpanShape)
import Geometry.Curve.Span qualified as Span
import Geometry.Curve.Spline (Cubics)
import Geometry.Curve.Spline qualified as Spline
import Geometry.Numeric.ArcLength (ArcLength)
import Geometry.Numeric.ArcLength qualified as ArcLength
import Geometry.Numeric.TaylorExpansion (Approach (..), TaylorExpansion)
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Linear.V2 (V2 (..))

-- | Base: an unshifted curve with the rows of its table.
data BasisCurve = BasisCurve
  { -- | interpolation by which the points became spans
    method :: CurveKind,
    -- | rows of the table in the curve's direction; evaluated on demand
    rows :: ~(Vector Knot),
    -- | at least one span
    spanList :: SpanList,
    -- | True if the base ends where it begins
    closed :: Bool,
    -- | arc length along the base as a function of its parameter; read through 'arcLength'
    lengthTable :: ~ArcLength
  }
  deriving stock (Eq, Show)

-- | Spans in order.
data SpanList
  = -- | the cubics in x and those in y, in mm; both have one cubic for each span
    Cubical Cubics Cubics
  | -- | spans of any kind, at least one of them not a pair of cubics
    Mixed (Vector Span)
  deriving stock (Eq, Show)

-- | Method by which the points of a curve became spans.
data CurveKind
  = -- | a straight line from each row to the next
    Polyline
  | -- | a cubic from each row to the next
    Spline EndCondition
  | -- | a parabola y(x) through rows 1–3, 3–5, and so on
    Parabola
  | -- | spans that were given one by one, not interpolated
    Joined
  deriving stock (Eq, Show)

-- | End condition of a spline.
data EndCondition
  = -- | zero curvature
    Natural
  | -- | the given directions at the start and at the end; their lengths do not matter
    Clamped Vec Vec
  | -- | the end continues into the beginning with equal first and second derivatives
    Periodic
  deriving stock (Eq, Show)

-- | Row of the table: a point with its parameter on the curve.
data Knot = Knot {at :: Double, knotPoint :: Point}
  deriving stock (Eq, Show)

-- | Reason why the given data do not describe a curve. Rows and spans are counted from 1.
data CurveFault
  = -- | too few points; at least this count is needed
    TooFew Int
  | -- | the row with this number and the next one coincide
    Coincident Int
  | -- | the count of points, which is even, so that the last parabola would have only two points
    EvenCount Int
  | -- | from the row with this number to the next one, x stays equal or reverses
    NotMonotone Int
  | -- | a direction at an end of a spline is a zero vector
    NoDirection
  | -- | the span with this number has no length
    NoLength Int
  | -- | the span with this number does not end where the next one begins
    Disjoint Int
  | -- | the row with this number; its parameter is not below that of the next row, or is not
    -- between 0 and the count of spans
    Disordered Int
  | -- | the radius of a joggle is not above half of its depth
    DeepJoggle
  | -- | the length that the two ramps of a joggle need, and the smaller length of the curve between
    -- the parameters at which the joggle begins and ends
    LongJoggle Mm Mm
  deriving stock (Eq, Show)

-- | Base with the given fields, to which the table of arc lengths is added.
makeBase :: CurveKind -> Bool -> Vector Knot -> SpanList -> BasisCurve
makeBase method closed rows spanList = base
  where
    base =
      BasisCurve
        { method,
          rows,
          spanList,
          closed,
          lengthTable = ArcLength.fromSpeed speed (map fromIntegral [0 .. count base])
        }
    speed u = let s = spanPoint After u base in speedAt base (number s) (local s)

-- | Speed in mm per unit of the parameter, in span @i@ (from 0) at the local parameter @t@.
speedAt :: BasisCurve -> Int -> Double -> Double
speedAt base i t = case spanList base of
  Cubical xs ys ->
    let a =
          Spline.rate (Spline.at xs i) t
        b = Spline.rate (Spline.at ys i) t
     in sqrt (a * a + b * b)
  Mixed parts -> Vec.norm (TaylorExpansion.velocity (Span.expansion 1 (parts Vector.! i) t))

-- | Spans of a base as a vector.
spans :: BasisCurve -> Vector Span
spans base = case spanList base of
  Cubical xs ys ->
    Vector.generate (Spline.count xs) (\i -> Polynomial (Spline.at xs i) (Spline.at ys i))
  Mixed parts -> parts

-- | Segments of a base that consists of lines and arcs only and has at least one arc. Nothing for
-- any other base. The base's spans join within a tolerance; the segments join exactly.
asSegments :: BasisCurve -> Maybe (NonEmpty Segment)
asSegments base = case spanList base of
  Cubical _ _ -> Nothing
  Mixed parts
    | all (isJust . Span.segment) parts ->
      NonEmpty.nonEmpty (chained Nothing (mapMaybe Span.segment (Vector.toList parts)))
    | otherwise -> Nothing
  where
    chained before ss = case ss of
      [] -> []
      s : rest -> let s' = maybe s (`from` s) before in s' : chained (Just (Segment.end s')) rest
    from p s
      | Segment.start s == p = s
      | otherwise = s {Segment.start = p}

-- | List of the given spans: 'Cubical' if all of them are polynomial, otherwise 'Mixed'.
toSpanList :: Vector Span -> SpanList
toSpanList parts = case traverse polynomial parts of
  Just both ->
    let part f =
          Spline.generate (Vector.length both) (\i -> f (both Vector.! i))
     in Cubical (part fst) (part snd)
  Nothing -> Mixed parts
  where
    polynomial s = case s of
      Polynomial a b -> Just (a, b)
      Round _ -> Nothing
      Controlled _ -> Nothing

-- | Polyline through the points. It is closed when the last point equals the first.
polyline :: Vector Point -> Either CurveFault BasisCurve
polyline points = do
  checkDistinct 2 points
  let cubicSpans = Cubical (lineCubics Vec.x) (lineCubics Vec.y)
  Right (makeBase Polyline (isLoop points) (rowsAtEnds points) cubicSpans)
  where
    lineCubics part =
      Spline.generate
        (Vector.length points - 1)
        (\i -> Spline.line (part (points Vector.! i)) (part (points Vector.! (i + 1))))
    {-# INLINE lineCubics #-}

-- | Cubic spline through the points. It has continuous second derivatives with respect to the
-- accumulated chord length, which is the sum of the distances between consecutive points. At a
-- clamped end, the first derivative with respect to this length is the unit vector of the given
-- direction. The last point of a periodic spline may repeat the first one or not.
spline :: EndCondition -> Vector Point -> Either CurveFault BasisCurve
spline ends points = case ends of
  Natural -> do
    checkDistinct 2 points
    Right
      ( makeBase
          (Spline ends)
          (isLoop points)
          (rowsAtEnds points)
          (cubics Spline.Natural Spline.Natural points)
      )
  Clamped from to
    | Vec.norm from <= Tolerance.parallel || Vec.norm to <= Tolerance.parallel -> Left NoDirection
    | otherwise -> do
      checkDistinct 2 points
      let f = Vec.unit from
          t = Vec.unit to
          derivatives part = Spline.Clamped (Vec.dot f part) (Vec.dot t part)
      Right
        ( makeBase
            (Spline (Clamped f t))
            (isLoop points)
            (rowsAtEnds points)
            (cubics (derivatives (Vec.vec 1 0)) (derivatives (Vec.vec 0 1)) points)
        )
  Periodic -> do
    let unrepeatedPoints = if isLoop points then Vector.init points else points
        looped = Vector.snoc unrepeatedPoints (Vector.head unrepeatedPoints)
    checkDistinct 3 unrepeatedPoints
    Right
      ( makeBase
          (Spline Periodic)
          True
          (rowsAtEnds points)
          (cubics Spline.Periodic Spline.Periodic looped)
      )

-- | Spans of a spline whose boundary conditions are @forX@ in x and @forY@ in y.
cubics :: Spline.Boundary -> Spline.Boundary -> Vector Point -> SpanList
cubics forX forY points = Cubical (through forX Vec.x) (through forY Vec.y)
  where
    steps = distances points
    through boundary part =
      Spline.interpolate boundary steps (Unboxed.convert (Vector.map part points))

-- | Distances between neighbouring points, in mm.
distances :: Vector Point -> Unboxed.Vector Double
distances points =
  Unboxed.convert
    (Vector.zipWith (\p q -> let Mm d = Vec.distance p q in d) points (Vector.drop 1 points))

-- | Distances between neighbouring rows, in mm. For a closed base whose last row is not a copy of
-- the first, the distance from the last row to the first is added.
chords :: BasisCurve -> Unboxed.Vector Double
chords base
  | closed base && not (isLoop points) = distances (Vector.snoc points (Vector.head points))
  | otherwise = distances points
  where
    points = Vector.map knotPoint (rows base)

-- | Local parameters, from 0 to 1, of the middle rows of a base of parabolas. There is one for each
-- parabola, which passes through three rows.
fractions :: BasisCurve -> Vector Double
fractions base =
  Vector.generate
    (count base)
    (\i -> maybe 0.5 (\row -> at row - fromIntegral i) (rows base Vector.!? (2 * i + 1)))

-- | Parabolas y(x) through points 1–3, 3–5, and so on, by Lagrange interpolation as in the paper on
-- the Ural-1 computer. Each span is one parabola, on which x is a linear function of the parameter.
-- Over the whole table, x must rise throughout or fall throughout.
parabola :: Vector Point -> Either CurveFault BasisCurve
parabola points
  | Vector.length points < 3 = Left (TooFew 3)
  | even (Vector.length points) = Left (EvenCount (Vector.length points))
  | otherwise = do
    checkDistinct 3 points
    maybe
      (Right ())
      (Left . NotMonotone . (+ 1))
      (Vector.findIndex (<= 0) (Vector.zipWith advance points (Vector.drop 1 points)))
    let middles = Vector.generate (Vector.length points `div` 2) middle
        row i p =
          Knot
            { at =
                if even i
                  then fromIntegral (i `div` 2)
                  else fromIntegral (i `div` 2) + middles Vector.! (i `div` 2),
              knotPoint = p
            }
        through part = Spline.parabolas middles (Unboxed.convert (Vector.map part points))
        across =
          Spline.generate (Vector.length middles) (\i -> Spline.line (x (2 * i)) (x (2 * i + 2)))
    Right (makeBase Parabola False (Vector.imap row points) (Cubical across (through Vec.y)))
  where
    x i = Vec.x (points Vector.! i)
    sense = signum (x 1 - x 0)
    -- Step in x from @p@ to @q@, positive in the sense of the first step, less the tolerance. It
    -- must be above 0: points with equal x do not lie on one parabola y(x), however far apart in y.
    advance p q = sense * (Vec.x q - Vec.x p) - (let Mm d = Tolerance.coincident in d)
    middle i = (x (2 * i + 1) - x (2 * i)) / (x (2 * i + 2) - x (2 * i))

-- | Base of consecutive spans of given shapes. The vector contains the parameters of the rows, in
-- ascending order.
fromShapes :: NonEmpty SpanShape -> Vector Double -> Either CurveFault BasisCurve
fromShapes = ofSpans . vector Span.fromShape

-- | Base of consecutive lines and arcs. The vector contains the parameters of the rows, in
-- ascending order.
fromSegmentsAt :: NonEmpty Segment -> Vector Double -> Either CurveFault BasisCurve
fromSegmentsAt = ofSpans . vector Span.fromSegment

-- | Base of consecutive spans. The rows have the given @parameters@. It is a fault if these are not
-- strictly ascending or lie outside of the curve. It is also a fault if a span has no length, or if
-- two consecutive spans do not join.
ofSpans :: Vector Span -> Vector Double -> Either CurveFault BasisCurve
ofSpans parts parameters = do
  checkJoined parts
  maybe (Right ()) (Left . Disordered) (find (not . ordered) [1 .. count'])
  Right
    base
      { rows =
          Vector.map
            ( \u ->
                Knot
                  { at = u,
                    knotPoint = TaylorExpansion.position (expansion 0 base (spanPoint After u base))
                  }
            )
            parameters
      }
  where
    base = chain Vector.empty parts
    n = fromIntegral (Vector.length parts)
    count' = Vector.length parameters
    ordered i =
      let u =
            parameters Vector.! (i - 1)
       in u >= 0 && u <= n && (i >= count' || parameters Vector.! i > u)

-- | Base of consecutive lines and arcs. Its rows are the starts of the segments, and the end of
-- the last one unless the base is closed.
fromSegments :: NonEmpty Segment -> Either CurveFault BasisCurve
fromSegments segments = do
  checkJoined parts
  Right
    base
      { rows =
          rowsAtEnds
            ( if closed base
                then starts
                else Vector.snoc starts (Segment.end (NonEmpty.last segments))
            )
      }
  where
    parts = vector Span.fromSegment segments
    base = chain Vector.empty parts
    starts = Vector.fromList (map Segment.start (NonEmpty.toList segments))

-- | Base of consecutive Bézier curves, without those that are points. Its rows are the ends of the
-- others; a closed base has only one row for its start and end.
fromBeziers :: [Bezier] -> Either CurveFault BasisCurve
fromBeziers curves = case NonEmpty.nonEmpty (filter (not . Bezier.isPoint) curves) of
  Nothing -> Left (NoLength 1)
  Just long -> do
    let parts = vector Span.fromBezier long
        base = chain Vector.empty parts
        starts = Vector.map (fst . Span.ends) parts
        (_, final) = Span.ends (Vector.last parts)
    checkJoined parts
    Right base {rows = rowsAtEnds (if closed base then starts else Vector.snoc starts final)}

-- | Vector of the results of a function on a list, each of them evaluated.
vector :: (a -> b) -> NonEmpty a -> Vector b
vector f list = Vector.unfoldrN (NonEmpty.length list) next (NonEmpty.toList list)
  where
    next as = case as of
      [] -> Nothing
      a : rest -> let b = f a in b `seq` Just (b, rest)

-- | Base of at least one span with the given rows. The caller has checked that the spans join.
chain :: Vector Knot -> Vector Span -> BasisCurve
chain rows parts = makeBase Joined (Vec.isNear first lastPoint) rows (toSpanList parts)
  where
    (first, _) = Span.ends (Vector.head parts)
    (_, lastPoint) = Span.ends (Vector.last parts)

-- | Checks that each span has a length and begins where the previous one ends. A span may end where
-- it begins, as a full circle does.
checkJoined :: Vector Span -> Either CurveFault ()
checkJoined parts
  | Just i <- find (Span.isPoint . span') [1 .. n] = Left (NoLength i)
  | Just i <-
      find
        (\i -> not (Vec.isNear (snd (Span.ends (span' i))) (fst (Span.ends (span' (i + 1))))))
        [1 .. n - 1] =
    Left (Disjoint i)
  | otherwise = Right ()
  where
    n = Vector.length parts
    span' i = parts Vector.! (i - 1)

-- | Checks that there are at least @needed@ points and that no two neighbours coincide.
checkDistinct :: Int -> Vector Point -> Either CurveFault ()
checkDistinct needed points
  | Vector.length points < needed = Left (TooFew needed)
  | otherwise =
    maybe
      (Right ())
      (Left . Coincident)
      ( find
          (\i -> Vec.isNear (points Vector.! (i - 1)) (points Vector.! i))
          [1 .. Vector.length points - 1]
      )

-- | True if there are at least three points and the last one coincides with the first.
isLoop :: Vector Point -> Bool
isLoop points = case (points Vector.!? 0, points Vector.!? (Vector.length points - 1)) of
  (Just p, Just q) -> Vector.length points > 2 && Vec.isNear p q
  _ -> False

-- | Rows with the given points. Row i, counted from 0, has the parameter i: it lies at the start of
-- span i, or at the end of the last span.
rowsAtEnds :: Vector Point -> Vector Knot
rowsAtEnds = Vector.imap (\i p -> Knot {at = fromIntegral i, knotPoint = p})

-- | Count of spans, which is also the parameter of the end.
count :: BasisCurve -> Int
count base = case spanList base of
  Cubical xs _ -> Spline.count xs
  Mixed parts -> Vector.length parts

-- | Arc length along the base as a function of its parameter.
arcLength :: BasisCurve -> ArcLength
arcLength = lengthTable

-- | Position on a curve. @approach@ is the side from which it is approached: from smaller
-- parameters ('Before') or from larger ones ('After'). The formulas that hold at the parameter
-- @home@, on this side of it, give the point at @parameter@. Both parameters are mostly equal. They
-- differ where a part of a curve is continued beyond a corner; then @home@ is that of the corner.
data CurvePosition = CurvePosition {parameter :: Double, home :: Double, approach :: Approach}
  deriving stock (Eq, Show)

-- | Point of a span: the index of the span, from 0, and the parameter within this span. It lies
-- from 0 to 1, or outside if the span is continued beyond its ends.
data SpanPoint = SpanPoint {number :: Int, local :: Double}
  deriving stock (Eq, Show)

-- | Point of a span with the parameter @u@ on the whole base. At a joint of two spans it lies in
-- the earlier span for 'Before' and in the later one for 'After'. A parameter outside of the base
-- gives the nearer end.
spanPoint :: Approach -> Double -> BasisCurve -> SpanPoint
spanPoint approach u base = spanPointAt CurvePosition {parameter, home = parameter, approach} base
  where
    parameter = max 0 (min (fromIntegral (count base)) u)

-- | Point of the span that contains the home of a position.
spanPointAt :: CurvePosition -> BasisCurve -> SpanPoint
spanPointAt CurvePosition {parameter, home, approach} base =
  SpanPoint {number, local = parameter - fromIntegral number}
  where
    number = case approach of
      After -> max 0 (min (count base - 1) (truncate (home + Tolerance.sameParameter)))
      Before -> max 0 (min (count base - 1) (ceiling (home - Tolerance.sameParameter) - 1))

-- | Arc length in mm from the start of a base to a point of a span. Beyond the ends of the span it
-- is that of the continued span.
lengthTo :: BasisCurve -> SpanPoint -> Double
lengthTo base SpanPoint {number, local}
  | inside == local = upTo
  | otherwise = upTo + ArcLength.integral (speedAt base number) inside local
  where
    inside = max 0 (min 1 local)
    Mm upTo = ArcLength.lengthAt (arcLength base) (fromIntegral number + inside)

-- | Taylor expansion of the point of a base, in mm, about the position @s@, up to the power @n@ of
-- the parameter.
expansion :: Int -> BasisCurve -> SpanPoint -> TaylorExpansion
expansion n base s = case spanList base of
  Cubical xs ys ->
    V2
      (Spline.series n (Spline.at xs (number s)) (local s))
      (Spline.series n (Spline.at ys (number s)) (local s))
  Mixed parts -> Span.expansion n (parts Vector.! number s) (local s)

-- | Direction of travel just before or just after a point of a span, of length 1, even where the
-- speed is 0. Nothing if the span is a point.
direction :: Approach -> BasisCurve -> SpanPoint -> Maybe Vec
direction approach base s = case spanList base of
  Cubical xs ys -> ofSpan (Polynomial (Spline.at xs (number s)) (Spline.at ys (number s)))
  Mixed parts -> ofSpan (parts Vector.! number s)
  where
    ofSpan part = Span.direction approach part (local s)

-- | Degree of the span that contains the point.
degreeAt :: BasisCurve -> SpanPoint -> Int
degreeAt base s = case spanList base of
  Cubical _ _ -> 3
  Mixed parts -> Span.degree (parts Vector.! number s)

-- | Base in the opposite direction.
reversed :: BasisCurve -> BasisCurve
reversed base =
  makeBase
    method'
    (closed base)
    (Vector.imap back (inReverseOrder base (rows base)))
    (mapSpans (Vector.map Span.reversed . Vector.reverse) base)
  where
    back i row =
      row {at = if i == 0 && lacksRepeatedStart base then 0 else fromIntegral (count base) - at row}
    method' = case method base of
      Spline (Clamped from to) -> Spline (Clamped (Vec.negate to) (Vec.negate from))
      Spline Natural -> Spline Natural
      Spline Periodic -> Spline Periodic
      Polyline -> Polyline
      Parabola -> Parabola
      Joined -> Joined

-- | Span list of a base after a function was applied to the vector of its spans.
mapSpans :: (Vector Span -> Vector Span) -> BasisCurve -> SpanList
mapSpans f base = toSpanList (f (spans base))

-- | Reorders values, one for each row of a base. They are given in the order of its rows; the
-- result has the order of the rows of the reversed base.
inReverseOrder :: BasisCurve -> Vector a -> Vector a
inReverseOrder base values
  | lacksRepeatedStart base = Vector.cons (Vector.head values) (Vector.reverse (Vector.tail values))
  | otherwise = Vector.reverse values

-- | True if the base is closed, its first row has the parameter 0, and no row at the end repeats
-- the first row.
lacksRepeatedStart :: BasisCurve -> Bool
lacksRepeatedStart base =
  case (rows base Vector.!? 0, rows base Vector.!? (Vector.length (rows base) - 1)) of
    (Just first, Just lastPoint) ->
      closed base && at first == 0 && at lastPoint < fromIntegral (count base)
    _ -> False

-- | Image of a base under a similarity, span by span.
transformed :: Transformation -> BasisCurve -> BasisCurve
transformed s base =
  makeBase
    method'
    (closed base)
    (Vector.map (\row -> row {knotPoint = Transformation.point s (knotPoint row)}) (rows base))
    (mapSpans (Vector.map (Span.transformed s)) base)
  where
    method' = case method base of
      Spline (Clamped from to) ->
        Spline (Clamped (Vec.unit (Span.image s from)) (Vec.unit (Span.image s to)))
      Spline Natural -> Spline Natural
      Spline Periodic -> Spline Periodic
      Polyline -> Polyline
      Parabola -> Parabola
      Joined -> Joined
