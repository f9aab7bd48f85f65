-- | What the functions of the language compute on tables and curves.
module Part.CurveBuiltin
  ( apply,
  )
where

import Base.Decimal qualified as Decimal
import Base.NumberTable qualified as NumberTable
import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Region)
import Checked.Syntax (Builtin (..), Selector (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Geometry.ArcFitting.Biarc qualified as Biarc
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
import Part.Curve (Fitting (..), PartCurve (..), PartTable (..))
import Part.Curve qualified as Curve
import Part.Error (Candidate (..), ListFault (..), Listing (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Tolerance qualified as Tolerance
import Part.Value

-- | The value of a function on tables or curves; nothing when it has no such form.
apply :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
apply region builtin arguments = case (builtin, arguments) of
  (MakeSpline, [t]) -> Just (made t (Exact.spline Exact.Natural))
  (MakeSpline, [t, Plain (Quantity a), Plain (Quantity b)]) ->
    Just (made t (Exact.spline (Exact.Clamped (direction a) (direction b))))
  (ClosedSpline, [t]) -> Just (made t (Exact.spline Exact.Periodic))
  (Polyline, [t]) -> Just (made t Exact.polyline)
  (Parabola, [t]) -> Just (made t Exact.parabola)
  (Biarcs, [Plain (CurveValue c), Choosing UpTo (Quantity d)]) ->
    Just
      ( positive d
          *> chain region (sconcat (ParametricFit.approximate (Mm d) (Curve.track (exact c))))
      )
  (Biarcs, [t]) -> Just (arcs t Open)
  (ClosedBiarcs, [t]) -> Just (arcs t Closed)
  (Fit, [t, Choosing UpTo (Quantity d)]) -> Just $ do
    positive d
    table <- tableOf t
    points <- ordered region table (Section.table (pointsOf table))
    let chosen =
          SectionFit.fit (Section.LineKind :| [Section.ParabolaKind, Section.ArcKind]) (Mm d) points
    pieced region table points chosen
  (Sections, [t, Plain (ListValue lists)]) -> Just $ do
    table <- tableOf t
    chosen <- traverse (traverse (rowNumber region table) . numbers) (Vector.toList lists)
    points <- ordered region table (Section.table (pointsOf table))
    fitted region table (SectionFit.sections points chosen) >>= pieced region table points
  (RowsOf, [Plain (TableValue t), Plain (ListValue ns)]) -> Just $ do
    chosen <- traverse (rowNumber region t) [n | Quantity n <- Vector.toList ns]
    pure (TableValue t {rows = NumberTable.picked (map (subtract 1) chosen) (rows t)})
  (PointsOf, [t@(Plain (TableValue _))]) ->
    Just (tableOf t >>= fmap (ListValue . Vector.fromList) . traverse at . pointsOf)
  (PointAtX, Plain (CurveValue c) : Plain (Quantity x) : choice) ->
    Just $ case Exact.atX x (exact c) of
      [] ->
        let (low, high) =
              Curve.abscissas (exact c)
         in Evaluation.mistake
              ( NoAnswer
                  region
                  "point"
                  ( "The curve runs from x = "
                      <> Decimal.mm low
                      <> " to x = "
                      <> Decimal.mm high
                      <> "."
                  )
              )
      us ->
        picked
          Tolerance.nearTie
          region
          "point"
          APoint
          id
          [place' c]
          (map (Exact.at (exact c)) us)
          choice
          >>= at
  (PointAlong, [Plain (CurveValue c), Plain (Quantity s)])
    | s < -slack || s > l + slack ->
      Just (Evaluation.mistake (NoAnswer region "point" ("The curve is " <> written l <> " long.")))
    | otherwise -> Just (at (Exact.at (exact c) (Exact.alongTo (exact c) (Mm s))))
    where
      Mm l = Exact.length (exact c)
  (LengthAlong, [Plain (CurveValue c), Plain (Spatial p)]) ->
    Just (let Mm s = place' c (place p) in pure (Quantity s))
  (LengthOf, [Plain (CurveValue c)]) ->
    Just (let Mm l = Exact.length (exact c) in pure (Quantity l))
  (StartOf, [Plain (CurveValue c)]) -> Just (at (Exact.start (exact c)))
  (EndOf, [Plain (CurveValue c)]) -> Just (at (Exact.end (exact c)))
  (TangentOf, [Plain (CurveValue c), Plain (Spatial p)]) ->
    Just (angled (Exact.tangent (exact c) (near c p)))
  (NormalOf, [Plain (CurveValue c), Plain (Spatial p)]) ->
    Just (angled (Exact.normal (exact c) (near c p)))
  (CurvatureOf, [Plain (CurveValue c), Plain (Spatial p)]) ->
    Just (finite region (Exact.curvature (exact c) (near c p)))
  (Foot, [Plain (Spatial p), Plain (CurveValue c)]) -> Just (at (Exact.at (exact c) (near c p)))
  (Distance, [Plain (Spatial p), Plain (CurveValue c)]) -> Just (distance p c)
  (Distance, [Plain (CurveValue c), Plain (Spatial p)]) -> Just (distance p c)
  (Intersection, Plain a : Plain b : choice)
    | Just (v, w) <- (,) <$> walkedOf a <*> walkedOf b ->
      Just (intersection region v w choice)
  _ -> Nothing
  where
    at = spatial region . offset
    direction a = Vec.polar (Mm 1) (Rad a)
    angled v = let Rad a = Vec.angle v in pure (Quantity a)
    near c p = Exact.nearest (place p) (exact c)
    place' c p = Exact.lengthTo (exact c) (Exact.nearest p (exact c))
    distance p c =
      let Mm d = Vec.distance (place p) (Exact.at (exact c) (near c p)) in finite region d
    Mm slack = Tolerance.coincident
    written l = Decimal.mm (Mm l)
    numbers v = case v of
      ListValue ns -> [n | Quantity n <- Vector.toList ns]
      _ -> []
    positive d
      | d > 0 = within region d
      | otherwise =
        Evaluation.mistake (NotPositive region "the tolerance of a curve" (Decimal.mm (Mm d)))
    tableOf t = case t of
      Plain (TableValue table) -> table <$ Evaluation.spend region (NumberTable.count (rows table))
      Plain (ListValue ps) ->
        PartTable
          { rows =
              NumberTable.fromList
                [(region, coordinates (place p)) | Spatial p <- Vector.toList ps],
            names = []
          }
          <$ Evaluation.spend region (Vector.length ps)
      _ -> Evaluation.absent
    coordinates p = PrimArray.primArrayFromListN 2 [Vec.x p, Vec.y p]
    made t make = do
      table <- tableOf t
      c <- either (flawed region table) pure (make (Curve.points table))
      pure (CurveValue (Curve.curve (Curve.columns table) Nothing c))
    arcs t ends = do
      table <- tableOf t
      let points = Curve.points table
      case NonEmpty.nonEmpty (Vector.toList points) of
        Just ps@(_ :| _ : _) -> do
          _ <- either (flawed region table) pure (Exact.polyline points)
          let segments = Biarc.through ends ps
          c <- either (flawed region table) pure (Exact.ofChain segments points)
          pure (CurveValue (Curve.curve (Curve.columns table) Nothing c))
        _ -> flawed region table (Exact.TooFew 2)

-- | The points of a table.
pointsOf :: PartTable -> [Point]
pointsOf = Vector.toList . Curve.points

-- | A curve of arcs and lines.
chain :: Region -> NonEmpty Exact.Segment -> Eval Value
chain region segments =
  either
    (\_ -> Evaluation.mistake (NoLength region))
    (pure . CurveValue . Curve.plain)
    (Exact.ofSegments segments)

-- | A curve of pieces, with what they miss.
pieced :: Region -> PartTable -> Section.PointTable -> NonEmpty Section.Section -> Eval Value
pieced region table points chosen = do
  let (pieces', stations) = Curve.piecesOf (Curve.points table) chosen
  c <- either (flawed region table) pure (Exact.ofPieces pieces' stations)
  pure
    ( CurveValue
        ( Curve.curve
            (Curve.columns table)
            (Just (Fitting chosen (SectionFit.deviations points chosen) (Curve.points table)))
            c
        )
    )

-- | What is wrong with the points of a curve, at the row where it shows.
flawed :: Region -> PartTable -> Exact.CurveFault -> Eval a
flawed region table flaw = Evaluation.mistake $ case flaw of
  -- Of a closed curve, the last point may be the first again.
  Exact.TooFew n
    | there >= n -> noCurve region table Nothing (FewDifferent (there - 1) n)
    | otherwise -> noCurve region table Nothing (FewPoints there n)
  Exact.Coincident k -> noCurve region table (rowAt table (k + 1)) (SamePoint (k + 1))
  Exact.EvenCount n -> noCurve region table Nothing (EvenPoints n)
  Exact.NotMonotone k -> noCurve region table (rowAt table (k + 1)) (Unordered (k + 1))
  Exact.Disordered k -> noCurve region table (rowAt table (k + 1)) (Unordered (k + 1))
  Exact.NoDirection -> NoLength region
  Exact.NoLength _ -> NoLength region
  Exact.Disjoint _ -> NoLength region
  Exact.DeepJoggle -> NoLength region
  Exact.LongJoggle _ _ -> NoLength region
  where
    there = NumberTable.count (rows table)

-- | The same for a table whose x has to go on.
ordered :: Region -> PartTable -> Either Section.PointTableFault a -> Eval a
ordered region table = either (Evaluation.mistake . fact) pure
  where
    fact flaw = case flaw of
      Section.TooFewRows n -> noCurve region table Nothing (FewPoints n 2)
      Section.OutOfOrder k -> noCurve region table (rowAt table k) (Unordered k)

-- | The same for pieces that are chosen by their rows.
fitted :: Region -> PartTable -> Either SectionFit.SectionFault a -> Eval a
fitted region table = either (Evaluation.mistake . fact) pure
  where
    fact flaw = case flaw of
      SectionFit.NoSections -> noCurve region table Nothing NoSection
      SectionFit.WrongCount s n -> noCurve region table Nothing (SectionRows s n)
      SectionFit.NoSuchRow _ k ->
        NoSuchRow region (listing region table) k (NumberTable.count (rows table))
      SectionFit.RowsDoNotRise s -> noCurve region table Nothing (SectionOrder s)
      SectionFit.NotJoined s begins must ->
        noCurve region table Nothing (SectionJoint s begins must)
      SectionFit.EndsEarly final all' -> noCurve region table Nothing (SectionEnd final all')

noCurve :: Region -> PartTable -> Maybe Region -> ListFault -> ValueFact
noCurve region table = NoCurve region (listing region table)

-- | The points of a list have no rows of their own: they stand where the call does.
listing :: Region -> PartTable -> Listing
listing region table = if rowAt table 1 == Just region then InList else InTable

-- | The number of a row that there is.
rowNumber :: Region -> PartTable -> Double -> Eval Int
rowNumber region table x
  | abs x > 1e7 || abs (x - fromIntegral n) > Tolerance.equal =
    Evaluation.mistake
      ( NotWhole
          region
          ("the number of a " <> (case listing region table of InTable -> "row"; InList -> "point"))
          ("from 1 to " <> Decimal.whole count)
          x
      )
  | n < 1 || n > count = Evaluation.mistake (NoSuchRow region (listing region table) n count)
  | otherwise = pure n
  where
    n = if abs x > 1e7 then 0 else round x :: Int
    count = NumberTable.count (rows table)

rowAt :: PartTable -> Int -> Maybe Region
rowAt table k
  | k >= 1 && k <= NumberTable.count (rows table) = Just (NumberTable.place (rows table) (k - 1))
  | otherwise = Nothing

-- | A line, a circle or a curve, and its exact places.
walkedOf :: Value -> Maybe (ElementCarrier, Foot)
walkedOf v = case v of
  LineValue l -> Just (OnLine l, Intersection.onLine l)
  CircleValue c -> Just (OnCircle CounterClockwise c, Intersection.onCircle c)
  CurveValue c -> Just (OnCurve (laid c), Intersection.onCurve (exact c))
  _ -> Nothing

-- | The points that a curve has in common with something.
intersection ::
  Region ->
  (ElementCarrier, Foot) ->
  (ElementCarrier, Foot) ->
  [Argument] ->
  Eval Value
intersection region (a, footA) (b, footB) choice = case MeasuredPolyarc.meetings as bs of
  [] -> Evaluation.mistake (NothingCommon region a b (MeasuredPolyarc.gap as bs))
  ps ->
    picked Tolerance.nearTie region "point" APoint id ways ps choice
      >>= spatial region . offset . Intersection.exactly footA footB
  where
    as = ElementCarrier.within (extent b) a
    bs = ElementCarrier.within (extent a) b
    extent w = case w of
      OnCurve p ->
        foldl
          (\box s -> BoundingBox.union box (BoundingBox.ofSegment s))
          (BoundingBox.ofPoints (MeasuredPolyarc.start p) [])
          (MeasuredPolyarc.segments p)
      _ -> BoundingBox.ofPoints (Vec.point 0 0) []
    -- First and last along the thing that is named first and has a beginning.
    ways = [way w | w <- [a, b], hasWay w]
    hasWay w = case w of
      OnCircle _ _ -> False
      _ -> True
    way w p = case w of
      OnCurve c -> MeasuredPolyarc.station c p
      OnLine l -> ElementCarrier.alongLine l p
      _ -> Mm 0
