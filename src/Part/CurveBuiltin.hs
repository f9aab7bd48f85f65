-- | What the functions of the language compute on tables and curves.
module Part.CurveBuiltin
  ( apply,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Region)
import Checked.Syntax (Builtin (..), Choice (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Geometry.Biarc qualified as Biarc
import Geometry.Box qualified as Box
import Geometry.Contour (Ends (..))
import Geometry.Curve qualified as Exact
import Geometry.Fit qualified as Fit
import Geometry.Piece qualified as Piece
import Geometry.Polyarc qualified as Polyarc
import Geometry.Shape (Turn (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Track qualified as Track
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.Walked (Walked (..))
import Geometry.Walked qualified as Walked
import Part.Curve (Curve (..), Fitting (..), Row (point, written), Table (..))
import Part.Curve qualified as Curve
import Part.Data
import Part.Error (Candidate (..), Fact (..), Trouble (..))
import Part.Eval (Eval)
import Part.Eval qualified as Eval

-- | The value of a function on tables or curves; nothing when it has no such form.
apply :: Region -> Builtin -> [Given] -> Maybe (Eval Value)
apply region builtin arguments = case (builtin, arguments) of
  (MakeSpline, [t]) -> Just (made t (Exact.spline Exact.Natural))
  (MakeSpline, [t, Plain (Quantity a), Plain (Quantity b)]) -> Just (made t (Exact.spline (Exact.Clamped (direction a) (direction b))))
  (ClosedSpline, [t]) -> Just (made t (Exact.spline Exact.Periodic))
  (Polyline, [t]) -> Just (made t Exact.polyline)
  (Parabola, [t]) -> Just (made t Exact.parabola)
  (Biarcs, [Plain (CurveValue c), Choosing UpTo (Quantity d)]) -> Just (positive d *> chain region (sconcat (Track.approximate (Mm d) (Curve.track (exact c)))))
  (Biarcs, [t]) -> Just (arcs t Open)
  (ClosedBiarcs, [t]) -> Just (arcs t Closed)
  (Fit, [t, Choosing UpTo (Quantity d)]) -> Just $ do
    positive d
    table <- tableOf t
    points <- ordered region table (Piece.table (pointsOf table))
    let chosen = Fit.fit (Piece.LineKind :| [Piece.ParabolaKind, Piece.ArcKind]) (Mm d) points
    pieced region table points chosen
  (Sections, [t, Plain (ListValue lists)]) -> Just $ do
    table <- tableOf t
    chosen <- traverse (traverse (whole region "the number of a row") . numbers) lists
    points <- ordered region table (Piece.table (pointsOf table))
    fitted region table (Fit.sections points chosen) >>= pieced region table points
  (RowsOf, [Plain (TableValue t), Plain (ListValue ns)]) -> Just $ do
    chosen <- traverse (whole region "the number of a row") [n | Quantity n <- ns]
    case filter (> Vector.length (rows t)) chosen of
      k : _ -> Eval.mistake (NoSuchItem region k (Vector.length (rows t)))
      [] -> let pick vs = Vector.fromList [vs Vector.! (k - 1) | k <- chosen] in pure (TableValue Table {rows = pick (rows t), columns = fmap (fmap pick) (columns t)})
  (PointAtX, Plain (CurveValue c) : Plain (Quantity x) : choice) -> Just $ case Exact.atX x (exact c) of
    [] -> Eval.mistake (NoAnswer region "point" "The curve does not come to this x.")
    us -> picked region "point" APoint id [place' c] (map (Exact.at (exact c)) us) choice >>= at
  (PointAlong, [Plain (CurveValue c), Plain (Quantity s)])
    | s < -slack || s > l + slack -> Just (Eval.mistake (NoAnswer region "point" ("The curve is " <> written l <> " long.")))
    | otherwise -> Just (at (Exact.at (exact c) (Exact.alongTo (exact c) (Mm s))))
    where
      Mm l = Exact.length (exact c)
  (LengthAlong, [Plain (CurveValue c), Plain (Spatial p)]) -> Just (let Mm s = place' c (place p) in pure (Quantity s))
  (LengthOf, [Plain (CurveValue c)]) -> Just (let Mm l = Exact.length (exact c) in pure (Quantity l))
  (StartOf, [Plain (CurveValue c)]) -> Just (at (Exact.start (exact c)))
  (EndOf, [Plain (CurveValue c)]) -> Just (at (Exact.end (exact c)))
  (TangentOf, [Plain (CurveValue c), Plain (Spatial p)]) -> Just (angled (Exact.tangent (exact c) (near c p)))
  (NormalOf, [Plain (CurveValue c), Plain (Spatial p)]) -> Just (angled (Exact.normal (exact c) (near c p)))
  (CurvatureOf, [Plain (CurveValue c), Plain (Spatial p)]) -> Just (finite region (Exact.curvature (exact c) (near c p)))
  (Foot, [Plain (Spatial p), Plain (CurveValue c)]) -> Just (at (Exact.at (exact c) (near c p)))
  (Distance, [Plain (Spatial p), Plain (CurveValue c)]) -> Just (distance p c)
  (Distance, [Plain (CurveValue c), Plain (Spatial p)]) -> Just (distance p c)
  (Intersection, Plain a : Plain b : choice) | Just (v, w) <- (,) <$> walkedOf a <*> walkedOf b -> Just (intersection region v w choice)
  _ -> Nothing
  where
    at = spatial region . offset
    direction a = Vec.polar (Mm 1) (Rad a)
    angled v = let Rad a = Vec.angle v in pure (Quantity a)
    near c p = Exact.nearest (place p) (exact c)
    place' c p = Exact.lengthTo (exact c) (Exact.nearest p (exact c))
    distance p c = let Mm d = Vec.distance (place p) (Exact.at (exact c) (near c p)) in finite region d
    Mm slack = Tolerance.coincident
    written l = Decimal.mm (Mm l)
    numbers v = case v of
      ListValue ns -> [n | Quantity n <- ns]
      _ -> []
    positive d
      | d > 0 = within region d
      | otherwise = Eval.mistake (NotPositive region "the tolerance of a curve" (Decimal.mm (Mm d)))
    tableOf t = case t of
      Plain (TableValue table) -> table <$ Eval.spend region (Vector.length (rows table))
      Plain (ListValue ps) -> Table {rows = Vector.fromList [Curve.Row region (place p) | Spatial p <- ps], columns = []} <$ Eval.spend region (length ps)
      _ -> Eval.absent
    made t make = do
      table <- tableOf t
      c <- either (flawed region table) pure (make (Vector.map point (rows table)))
      pure (CurveValue (Curve.curve (columns table) Nothing c))
    arcs t ends = do
      table <- tableOf t
      case NonEmpty.nonEmpty (pointsOf table) of
        Just ps@(_ :| _ : _) -> do
          _ <- either (flawed region table) pure (Exact.polyline (Vector.map point (rows table)))
          let segments = Biarc.through ends ps
          c <- either (flawed region table) pure (Exact.ofChain segments (Vector.map point (rows table)))
          pure (CurveValue (Curve.curve (columns table) Nothing c))
        _ -> flawed region table (Exact.TooFew 2)

-- | The points of a table.
pointsOf :: Table -> [Point]
pointsOf = map point . Vector.toList . rows

-- | A curve of arcs and lines.
chain :: Region -> NonEmpty Exact.Segment -> Eval Value
chain region segments = either (\_ -> Eval.mistake (NoLength region)) (pure . CurveValue . Curve.plain) (Exact.ofSegments segments)

-- | A curve of pieces, with what they miss.
pieced :: Region -> Table -> Piece.Table -> NonEmpty Piece.Piece -> Eval Value
pieced region table points chosen = do
  let (pieces', stations) = Curve.piecesOf (Vector.map point (rows table)) chosen
  c <- either (flawed region table) pure (Exact.ofPieces pieces' stations)
  pure (CurveValue (Curve.curve (columns table) (Just (Fitting chosen (Fit.deviations points chosen) (rows table))) c))

-- | What is wrong with the points of a curve, at the row where it shows.
flawed :: Region -> Table -> Exact.Flaw -> Eval a
flawed region table flaw = Eval.mistake $ case flaw of
  Exact.TooFew n -> NoCurve region Nothing (FewPoints (Vector.length (rows table)) n)
  Exact.Coincident k -> NoCurve region (rowAt table (k + 1)) (SamePoint (k + 1))
  Exact.EvenCount n -> NoCurve region Nothing (EvenPoints n)
  Exact.NotMonotone k -> NoCurve region (rowAt table (k + 1)) (Unordered (k + 1))
  Exact.Disordered k -> NoCurve region (rowAt table (k + 1)) (Unordered (k + 1))
  Exact.NoDirection -> NoLength region
  Exact.NoLength _ -> NoLength region
  Exact.Disjoint _ -> NoLength region
  Exact.DeepJoggle -> NoLength region
  Exact.LongJoggle _ _ -> NoLength region

-- | The same for a table whose x has to go on.
ordered :: Region -> Table -> Either Piece.Flaw a -> Eval a
ordered region table = either (Eval.mistake . fact) pure
  where
    fact flaw = case flaw of
      Piece.TooFewRows n -> NoCurve region Nothing (FewPoints n 2)
      Piece.OutOfOrder k -> NoCurve region (rowAt table k) (Unordered k)

-- | The same for pieces that are chosen by their rows.
fitted :: Region -> Table -> Either Fit.Flaw a -> Eval a
fitted region table = either (Eval.mistake . fact) pure
  where
    fact flaw = case flaw of
      Fit.NoSections -> NoCurve region Nothing (Split "There is no section.")
      Fit.WrongCount s n -> NoCurve region Nothing (SectionRows s n)
      Fit.NoSuchRow _ k -> NoSuchItem region k (Vector.length (rows table))
      Fit.RowsDoNotRise s -> NoCurve region Nothing (SectionOrder s)
      Fit.NotJoined s begins must -> NoCurve region Nothing (SectionJoint s begins must)
      Fit.EndsEarly final all' -> NoCurve region Nothing (SectionEnd final all')

rowAt :: Table -> Int -> Maybe Region
rowAt table k = written <$> rows table Vector.!? (k - 1)

-- | A line, a circle or a curve.
walkedOf :: Value -> Maybe Walked
walkedOf v = case v of
  LineValue l -> Just (OnLine l)
  CircleValue c -> Just (OnCircle CounterClockwise c)
  CurveValue c -> Just (OnCurve (laid c))
  _ -> Nothing

-- | The points that a curve has in common with something.
intersection :: Region -> Walked -> Walked -> [Given] -> Eval Value
intersection region a b choice = case Polyarc.meetings as bs of
  [] -> Eval.mistake (NothingCommon region a b (Polyarc.gap as bs))
  ps -> picked region "point" APoint id ways ps choice >>= spatial region . offset
  where
    as = Walked.within (extent b) a
    bs = Walked.within (extent a) b
    extent w = case w of
      OnCurve p -> foldl (\box s -> Box.union box (Box.ofSegment s)) (Box.ofPoints (Polyarc.start p) []) (Polyarc.segments p)
      _ -> Box.ofPoints (Vec.point 0 0) []
    -- First and last along the thing that is named first and has a beginning.
    ways = [way w | w <- [a, b], hasWay w]
    hasWay w = case w of
      OnCircle _ _ -> False
      _ -> True
    way w p = case w of
      OnCurve c -> Polyarc.station c p
      OnLine l -> Walked.alongLine l p
      _ -> Mm 0
