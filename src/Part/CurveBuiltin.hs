-- | Functions of tables and curves: splines, polylines, parabolas, biarcs and fitted sections;
-- Bézier curves, B-splines and parts of ellipses; points, directions, lengths and intersections of
-- curves.
--
-- 'apply' tries five functions in turn. Each of them computes one group of the built-in functions,
-- and yields 'Nothing' for all other functions and arguments. The polyarc of a curve is a chain of
-- lines and arcs within 'Tolerance.curve' of it. A section is one line, parabola or arc between two
-- rows of a table. A biarc consists of two arcs with a common tangent at their joint.
module Part.CurveBuiltin
  ( apply,
  )
where

import Base.NumberTable qualified as NumberTable
import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Region)
import Checked.Syntax (Builtin (..), Selector (..))
import Data.Foldable (asum)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Geometry.ArcFitting.Biarc qualified as Biarc
import Geometry.ArcFitting.CurveFit qualified as CurveFit
import Geometry.ArcFitting.ParametricFit qualified as ParametricFit
import Geometry.Carrier (Sense (..))
import Geometry.Curve qualified as Exact
import Geometry.Curve.Intersection (Foot)
import Geometry.Curve.Intersection qualified as Intersection
import Geometry.Curve.Section qualified as Section
import Geometry.Curve.SectionFit qualified as SectionFit
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.ElementCarrier qualified as ElementCarrier
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Polyarc (Ends (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ConstructionError (ConstructionFault (..), NoAnswer (..))
import Part.ContourError (ContourFault (NoLength))
import Part.Curve (Fitting (..), PartCurve (..), PartTable (..))
import Part.Curve qualified as Curve
import Part.CurveError (ControlPointFault (..), CurveMistake (..), ListFault (..), Listing (..))
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Parameter (Range (FromTo))
import Part.Parameter qualified as Parameter
import Part.RegionError (RegionMistake (NoSuchShape))
import Part.Selection (answerPoints, picked)
import Part.Shape (ShapeFault (WrongSweep))
import Part.Tolerance qualified as Tolerance
import Part.Value

-- | Computes a function of tables or curves. @region@ is the region of the call in the program, for
-- reports. 'Nothing' if @builtin@ with these arguments is another function.
apply :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
apply region builtin arguments =
  asum
    [ f region builtin arguments
      | f <- [newCurve, controlledCurve, tableFunction, pointFunction, measure]
    ]

-- Tables and new curves

-- | Computes a function that makes a new curve from points or from another curve.
-- 'Nothing' for any other function.
newCurve :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
newCurve region builtin arguments = case (builtin, arguments) of
  (MakeSpline, [t]) -> Just (curveThrough t (Exact.spline Exact.Natural))
  (MakeSpline, [t, Plain (Quantity a), Plain (Quantity b)]) ->
    Just (curveThrough t (Exact.spline (Exact.Clamped (direction a) (direction b))))
  (ClosedSpline, [t]) -> Just (curveThrough t (Exact.spline Exact.Periodic))
  (Polyline, [t]) -> Just (curveThrough t Exact.polyline)
  (Parabola, [t]) -> Just (curveThrough t Exact.parabola)
  (Biarcs, [Plain (CurveValue c), Choosing WithinTolerance (Quantity d)]) -> Just $ do
    toleranceOf region d
    ofSegments region (sconcat (ParametricFit.approximate (Mm d) (CurveFit.parametric (exact c))))
  (Biarcs, [t]) -> Just (biarcs region t Open)
  (ClosedBiarcs, [t]) -> Just (biarcs region t Closed)
  (Fit, [t, Choosing WithinTolerance (Quantity d)]) -> Just $ do
    toleranceOf region d
    table <- tableOf region t
    points <- ordered region table (Section.table (pointsOf table))
    let kinds = Section.LineKind :| [Section.ParabolaKind, Section.ArcKind]
    ofSections region table points (SectionFit.fit kinds (Mm d) points)
  (Sections, [t, Plain (ListValue lists)]) -> Just $ do
    table <- tableOf region t
    chosen <- traverse (traverse (rowNumber region table) . numbers) (Vector.toList lists)
    points <- ordered region table (Section.table (pointsOf table))
    sections <- fitted region table (SectionFit.sections points chosen)
    ofSections region table points sections
  _ -> Nothing
  where
    direction a = Vec.polar (Mm 1) (Rad a)
    numbers v = case v of
      ListValue ns -> [n | Quantity n <- Vector.toList ns]
      _ -> []
    curveThrough t make = do
      table <- tableOf region t
      c <- either (faulty region table) pure (make (Curve.points table))
      pure (CurveValue (Curve.curve (Curve.columns table) Nothing c))

-- | Computes a function that makes a curve by control points, or a part of an ellipse. 'Nothing'
-- for any other function.
controlledCurve :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
controlledCurve region builtin arguments = case (builtin, arguments) of
  (MakeBezier, t : ws) -> Just (bezier region t ws)
  (MakeBSpline, Plain (Quantity p) : t : Plain (ListValue us) : ws) ->
    Just (bspline region p t (Vector.toList us) ws)
  ( MakeEllipse,
    [ Plain (Spatial o),
      Plain (Quantity a),
      Plain (Quantity b),
      Plain (Quantity turn),
      Plain (Quantity from),
      Plain (Quantity to)
      ]
    ) -> Just $ do
      mapM_ sizeOf [a, b]
      if abs (to - from) > 2 * pi + Tolerance.equal
        then noPart (to - from)
        else
          either
            (const (noPart (to - from)))
            (pure . CurveValue . Curve.plain)
            (Exact.ellipse (fromOrigin o) (Mm a) (Mm b) (Rad turn) (Rad from) (Rad to))
  _ -> Nothing
  where
    sizeOf x
      | x <= 0 = Evaluation.mistake (NotPositive region Parameter.ShapeSize x)
      | otherwise = within region x
    noPart = Evaluation.mistake . InRegion . NoSuchShape region . WrongSweep . Rad

-- | A Bézier curve by the points of a table or a list, and perhaps a list of weights.
bezier :: Region -> Argument -> [Argument] -> Eval Value
bezier region t ws = do
  table <- tableOf region t
  let points = Curve.points table
      most = Tolerance.largestDegree + 1
  if Vector.length points > most
    then wrongControls region (ManyControls (Vector.length points) most)
    else
      weightsOf region (Vector.length points) ws
        >>= controlled region table . Exact.bezier points

-- | A B-spline of the degree @p@ with the given knots, by the points of a table or a list, and
-- perhaps a list of weights.
bspline :: Region -> Double -> Argument -> [Value] -> [Argument] -> Eval Value
bspline region p t us ws
  | abs (p - fromIntegral degree) > Tolerance.equal || degree < 1 || degree > most =
    Evaluation.mistake (NotWhole region Parameter.CurveDegree (FromTo 1 most) p)
  | otherwise = do
    table <- tableOf region t
    let points = Curve.points table
    -- The conversion to Bézier curves takes some time for each point.
    Evaluation.spend region (degree * Vector.length points)
    case Exact.knotVector degree (Vector.length points) [u | Quantity u <- us] of
      Left (Exact.FewControlPoints _) -> faulty region table (Exact.TooFew (degree + 1))
      Left fault -> wrongControls region (WrongKnots fault)
      Right knots ->
        weightsOf region (Vector.length points) ws
          >>= controlled region table . Exact.bspline knots points
  where
    degree = if abs p > 1e7 then 0 else round p :: Int
    most = Tolerance.largestDegree

-- | The weights of @count@ control points: those of the list, if there is one.
weightsOf :: Region -> Int -> [Argument] -> Eval (Maybe Exact.Weights)
weightsOf region count arguments = case arguments of
  [Plain (ListValue ws)] ->
    either
      (wrongControls region . WrongWeights count)
      (pure . Just)
      (Exact.weightsFor count [w | Quantity w <- Vector.toList ws])
  _ -> pure Nothing

-- | The curve by the control points of a table. Fails if it has no length, because all the points
-- coincide.
controlled :: Region -> PartTable -> Either Exact.CurveFault Exact.Curve -> Eval Value
controlled region table found = case found of
  Right c -> pure (CurveValue (Curve.plain c))
  Left (Exact.NoLength _) -> wrongControls region OnePoint
  Left fault -> faulty region table fault

wrongControls :: Region -> ControlPointFault -> Eval a
wrongControls region = Evaluation.mistake . InCurve . BadControls region

-- | Fails if the tolerance @d@ of a curve, in mm, is not above 0 or is larger than
-- 'Tolerance.reach'.
toleranceOf :: Region -> Double -> Eval ()
toleranceOf region d
  | d > 0 = within region d
  | otherwise = Evaluation.mistake (NotPositive region Parameter.CurveTolerance d)

-- | Computes a function that selects rows of a table, or that makes a list of a table's points.
-- 'Nothing' for any other function.
tableFunction :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
tableFunction region builtin arguments = case (builtin, arguments) of
  (RowsOf, [Plain (TableValue t), Plain (ListValue ns)]) -> Just $ do
    chosen <- traverse (rowNumber region t) [n | Quantity n <- Vector.toList ns]
    pure (TableValue t {rows = NumberTable.selectRows (map (subtract 1) chosen) (rows t)})
  (PointsOf, [t@(Plain (TableValue _))]) -> Just $ do
    table <- tableOf region t
    ListValue . Vector.fromList <$> traverse (spatial region . offset) (pointsOf table)
  _ -> Nothing

-- | The argument as a table; a list of points becomes a table without further columns. Takes one
-- evaluation step for every row.
tableOf :: Region -> Argument -> Eval PartTable
tableOf region t = case t of
  Plain (TableValue table) -> table <$ Evaluation.spend region (NumberTable.count (rows table))
  Plain (ListValue ps) -> listTable ps <$ Evaluation.spend region (Vector.length ps)
  _ -> Evaluation.absent
  where
    listTable ps =
      PartTable
        { rows =
            NumberTable.fromList
              [(region, coordinates (fromOrigin p)) | Spatial p <- Vector.toList ps],
          names = []
        }
    coordinates p = PrimArray.primArrayFromListN 2 [Vec.x p, Vec.y p]

-- | The curve of biarcs through the points of a table or a list. @ends@ says if the curve is
-- closed.
biarcs :: Region -> Argument -> Ends -> Eval Value
biarcs region t ends = do
  table <- tableOf region t
  let points = Curve.points table
  case NonEmpty.nonEmpty (Vector.toList points) of
    Just ps@(_ :| _ : _) -> do
      -- The polyline is not used: making it checks that the points are not coincident.
      _ <- either (faulty region table) pure (Exact.polyline points)
      c <- either (faulty region table) pure (Exact.fromSegmentsAt (Biarc.through ends ps) points)
      pure (CurveValue (Curve.curve (Curve.columns table) Nothing c))
    _ -> faulty region table (Exact.TooFew 2)

pointsOf :: PartTable -> [Point]
pointsOf = Vector.toList . Curve.points

-- | The curve that consists of the given arcs and lines. Fails if it has no length.
ofSegments :: Region -> NonEmpty Exact.Segment -> Eval Value
ofSegments region segments =
  either
    (\_ -> Evaluation.mistake (InContour (NoLength region)))
    (pure . CurveValue . Curve.plain)
    (Exact.fromSegments segments)

-- | The curve that consists of the given sections, which were fitted to @points@. The curve keeps
-- their deviations from these points.
ofSections :: Region -> PartTable -> Section.PointTable -> NonEmpty Section.Section -> Eval Value
ofSections region table points sections = do
  let (spans, parameters) = Curve.spansOfSections (Curve.points table) sections
      fitting = Fitting sections (SectionFit.deviations points sections) (Curve.points table)
  c <- either (faulty region table) pure (Exact.fromShapes spans parameters)
  pure (CurveValue (Curve.curve (Curve.columns table) (Just fitting) c))

-- | Fails with the mistake that the points of the table make no curve. The report points at the row
-- that @fault@ names.
faulty :: Region -> PartTable -> Exact.CurveFault -> Eval a
faulty region table fault = Evaluation.mistake $ case fault of
  -- The curve needs @n@ different points. A table with @n@ rows or more can lack them only if the
  -- curve is closed. Then the table's last row repeats the first row, and does not count.
  Exact.TooFew n
    | count >= n -> badPoints region table Nothing (FewDifferent (count - 1) n)
    | otherwise -> badPoints region table Nothing (FewPoints count n)
  Exact.Coincident k ->
    badPoints
      region
      table
      (rowAt table (k + 1))
      (SamePoint (k + 1) (rowAt table k /= rowAt table (k + 1)))
  Exact.EvenCount n -> badPoints region table Nothing (EvenPoints n)
  Exact.NotMonotone k -> badPoints region table (rowAt table (k + 1)) (Unordered (k + 1))
  Exact.Disordered k -> badPoints region table (rowAt table (k + 1)) (Unordered (k + 1))
  Exact.NoDirection -> noLength
  Exact.NoLength _ -> noLength
  Exact.Disjoint _ -> noLength
  Exact.DeepJoggle -> noLength
  Exact.LongJoggle _ _ -> noLength
  where
    count = NumberTable.count (rows table)
    noLength = InContour (NoLength region)

-- | Returns the result in 'Right'. For a fault in 'Left' it fails with a mistake: the table has too
-- few rows, or its x coordinates neither rise throughout nor fall throughout.
ordered :: Region -> PartTable -> Either Section.PointTableFault a -> Eval a
ordered region table = either (Evaluation.mistake . fact) pure
  where
    fact fault = case fault of
      Section.TooFewRows n -> badPoints region table Nothing (FewPoints n 2)
      Section.OutOfOrder k -> badPoints region table (rowAt table k) (Unordered k)

-- | Returns the result in 'Right'. For a fault in 'Left' it fails with a mistake: the sections that
-- the program lists do not cover the rows of the table, one section after the other.
fitted :: Region -> PartTable -> Either SectionFit.SectionFault a -> Eval a
fitted region table = either (Evaluation.mistake . fact) pure
  where
    fact fault = case fault of
      SectionFit.NoSections -> badPoints region table Nothing NoSection
      SectionFit.WrongCount s n -> badPoints region table Nothing (SectionRows s n)
      SectionFit.NoSuchRow _ k -> noSuchRow region table k
      SectionFit.RowsDoNotRise s -> badPoints region table Nothing (SectionOrder s)
      SectionFit.NotJoined s begins needed ->
        badPoints region table Nothing (SectionJoint s begins needed)
      SectionFit.EndsEarly end count -> badPoints region table Nothing (SectionEnd end count)

-- | The mistake that points make no curve. @row@ is the region of the row that shows this; without
-- it, the report points at the call.
badPoints :: Region -> PartTable -> Maybe Region -> ListFault -> ValueFact
badPoints region table row fault =
  InCurve (BadPoints region (listing region table) row fault)

-- | The mistake that row @n@, counted from 1, does not exist in the table.
noSuchRow :: Region -> PartTable -> Int -> ValueFact
noSuchRow region table n =
  InCurve (NoSuchRow region (listing region table) n (NumberTable.count (rows table)))

-- | The source of the rows: a table of the program, or a list of points that 'tableOf' has
-- converted to a table. All rows of a converted list have the region of the call.
listing :: Region -> PartTable -> Listing
listing region table = if rowAt table 1 == Just region then InList else InTable

-- | Converts the number @x@ to the number of a row, counted from 1. Fails if @x@ is not whole or if
-- the table has no such row.
rowNumber :: Region -> PartTable -> Double -> Eval Int
rowNumber region table x
  | abs x > 1e7 || abs (x - fromIntegral n) > Tolerance.equal =
    Evaluation.mistake (NotWhole region numberOf (FromTo 1 count) x)
  | n < 1 || n > count = Evaluation.mistake (noSuchRow region table n)
  | otherwise = pure n
  where
    n = if abs x > 1e7 then 0 else round x :: Int
    count = NumberTable.count (rows table)
    numberOf = case listing region table of
      InTable -> Parameter.TableRowNumber
      InList -> Parameter.ListPointNumber

-- | The region of row @k@, counted from 1. 'Nothing' if the table has no such row.
rowAt :: PartTable -> Int -> Maybe Region
rowAt table k
  | k >= 1 && k <= NumberTable.count (rows table) = Just (NumberTable.regionOf (rows table) (k - 1))
  | otherwise = Nothing

-- Points and measures of a curve

-- | Computes a function whose result is a point of a curve. 'Nothing' for any other function.
pointFunction :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
pointFunction region builtin arguments = case (builtin, arguments) of
  (PointAtX, Plain (CurveValue c) : Plain (Quantity x) : choice) ->
    Just (pointAtX region c x choice)
  (PointAlong, [Plain (CurveValue c), Plain (Quantity s)]) -> Just (pointAlong region c s)
  (StartOf, [Plain (CurveValue c)]) -> at (Exact.start (exact c))
  (EndOf, [Plain (CurveValue c)]) -> at (Exact.end (exact c))
  (Foot, [Plain (Spatial p), Plain (CurveValue c)]) -> at (footOf c (fromOrigin p))
  (Intersection, Plain a : Plain b : choice)
    | Just (v, w) <- (,) <$> exactly a <*> exactly b -> Just (intersection region v w choice)
  _ -> Nothing
  where
    at = Just . spatial region . offset

-- | A point of the curve @c@ with the coordinate @x@, in mm. If there are several, the words in
-- @choice@ (@near@, @first@, …) choose one of them.
pointAtX :: Region -> PartCurve -> Double -> [Argument] -> Eval Value
pointAtX region c x choice = case Exact.atX x (exact c) of
  [] -> Evaluation.mistake (InConstruction (NoAnswer region (uncurry OutsideCurve range)))
  parameters ->
    picked
      region
      (answerPoints Tolerance.nearTie [lengthTo c] (map (Exact.at (exact c)) parameters))
      choice
      >>= spatial region . offset
  where
    range = Curve.xRange (exact c)

-- | The point of the curve @c@ at the arc length @s@ in mm from its start. Fails if @s@ is negative
-- or exceeds the length.
pointAlong :: Region -> PartCurve -> Double -> Eval Value
pointAlong region c s
  | s < -slack || s > whole' + slack =
    Evaluation.mistake (InConstruction (NoAnswer region (BeyondLength (Mm whole'))))
  | otherwise =
    spatial region (offset (Exact.at (exact c) (Exact.parameterAtLength (exact c) (Mm s))))
  where
    Mm whole' = Exact.length (exact c)
    Mm slack = Tolerance.coincident

-- | Computes a function whose result is a length, distance, angle or curvature of a curve.
-- 'Nothing' for any other function.
measure :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
measure region builtin arguments = case (builtin, arguments) of
  (LengthAlong, [Plain (CurveValue c), Plain (Spatial p)]) ->
    length' (lengthTo c (fromOrigin p))
  (LengthOf, [Plain (CurveValue c)]) -> length' (Exact.length (exact c))
  (TangentOf, [Plain (CurveValue c), Plain (Spatial p)]) ->
    angled (Exact.tangent (exact c) (nearest c p))
  (NormalOf, [Plain (CurveValue c), Plain (Spatial p)]) ->
    angled (Exact.normal (exact c) (nearest c p))
  (CurvatureOf, [Plain (CurveValue c), Plain (Spatial p)]) ->
    Just (finite region (Exact.curvature (exact c) (nearest c p)))
  (Distance, [Plain (Spatial p), Plain (CurveValue c)]) -> distance p c
  (Distance, [Plain (CurveValue c), Plain (Spatial p)]) -> distance p c
  _ -> Nothing
  where
    length' (Mm l) = Just (pure (Quantity l))
    angled v = let Rad a = Vec.angle v in Just (pure (Quantity a))
    nearest c p = Exact.nearest (fromOrigin p) (exact c)
    distance p c =
      let Mm d = Vec.distance (fromOrigin p) (footOf c (fromOrigin p)) in Just (finite region d)

-- | The point of the curve @c@ that is nearest to @p@.
footOf :: PartCurve -> Point -> Point
footOf c p = Exact.at (exact c) (Exact.nearest p (exact c))

-- | The arc length from the start of the curve @c@ to its point that is nearest to @p@.
lengthTo :: PartCurve -> Point -> Mm
lengthTo c p = Exact.lengthAt (exact c) (Exact.nearest p (exact c))

-- Intersections

-- | The carrier of a line, a circle or a curve, and its foot function. The carrier of a curve is
-- its polyarc. The foot function yields the point of the exact figure that is nearest to a given
-- point. 'Intersection.refine' uses it to move an approximate intersection onto the exact figure.
-- 'Nothing' for a value of another kind.
exactly :: Value -> Maybe (ElementCarrier, Foot)
exactly v = case v of
  LineValue l -> Just (OnLine l, Intersection.onLine l)
  CircleValue c -> Just (OnCircle CounterClockwise c, Intersection.onCircle c)
  CurveValue c -> Just (OnCurve (approximation c), Intersection.onCurve (exact c))
  _ -> Nothing

-- | An intersection of a curve with a line, a circle or another curve. If there are several, the
-- words in @choice@ choose one of them. The polyarcs of the curves give approximate points, and the
-- functions @footA@ and @footB@ refine the chosen one.
intersection ::
  Region ->
  (ElementCarrier, Foot) ->
  (ElementCarrier, Foot) ->
  [Argument] ->
  Eval Value
intersection region (a, footA) (b, footB) choice = case MeasuredPolyarc.intersections as bs of
  [] ->
    Evaluation.mistake
      (InConstruction (NothingCommon region a b (MeasuredPolyarc.leastDistance as bs)))
  ps ->
    picked region (answerPoints Tolerance.nearTie (concatMap stationOn [a, b]) ps) choice
      >>= spatial region . offset . Intersection.refine footA footB
  where
    as = ElementCarrier.segmentsWithin (extent b) a
    bs = ElementCarrier.segmentsWithin (extent a) b
    extent carrier = case carrier of
      OnCurve p ->
        foldl
          (\box s -> BoundingBox.union box (BoundingBox.ofSegment s))
          (BoundingBox.ofPoints (MeasuredPolyarc.start p) [])
          (MeasuredPolyarc.segments p)
      _ -> BoundingBox.ofPoints (Vec.point 0 0) []

-- | The function that gives the position of a point along a carrier, in mm; the words @first@ and
-- @last@ choose among several points by it. The list has one function. It is empty for a circle,
-- which has no start.
stationOn :: ElementCarrier -> [Point -> Mm]
stationOn carrier = case carrier of
  OnCurve c -> [MeasuredPolyarc.nearestStation c]
  OnLine l -> [ElementCarrier.positionAlong l]
  OnCircle _ _ -> []
  AtPoint _ -> [const (Mm 0)]
