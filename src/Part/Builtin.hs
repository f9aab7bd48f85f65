-- | What the functions of the language compute.
module Part.Builtin
  ( apply,
    binary,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..), degrees, minus, plus)
import Base.Region (Region)
import Checked.Syntax (Builtin (..), Operator (..), Selector (..))
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Vector qualified as Vector
import Geometry.Carrier (Circle (..), Line (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Construction.TangentCircle (Touched (..))
import Geometry.Construction.TangentCircle qualified as TangentCircle
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.ElementCarrier qualified as ElementCarrier
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.Curve qualified as Curve
import Part.CurveBuiltin qualified as CurveBuiltin
import Part.Error (Candidate (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Part (Contour (..), Element (..), backwards, outline)
import Part.Value

-- Operators

-- | An operation on two values; @and@ and @or@ are decided where they stand.
binary :: Region -> Operator -> Value -> Value -> Eval Value
binary region op l r = case (op, l, r) of
  (Add, Spatial a, Spatial b) -> spatial region (Vec.add a b)
  (Subtract, Spatial a, Spatial b) -> spatial region (Vec.add a (Vec.negate b))
  (Multiply, Quantity k, Spatial a) -> spatial region (Vec.scale k a)
  (Multiply, Spatial a, Quantity k) -> spatial region (Vec.scale k a)
  (Divide, Spatial _, Quantity 0) -> Evaluation.mistake (DivisionByZero region)
  (Divide, Spatial a, Quantity k) -> spatial region (Vec.scale (1 / k) a)
  (Add, Quantity a, Quantity b) -> finite region (a + b)
  (Subtract, Quantity a, Quantity b) -> finite region (a - b)
  (Multiply, Quantity a, Quantity b) -> finite region (a * b)
  (Divide, Quantity _, Quantity 0) -> Evaluation.mistake (DivisionByZero region)
  (Divide, Quantity a, Quantity b) -> finite region (a / b)
  (Less, Quantity a, Quantity b) -> truth (a < b && not (equal a b))
  (AtMost, Quantity a, Quantity b) -> truth (a < b || equal a b)
  (Greater, Quantity a, Quantity b) -> truth (a > b && not (equal a b))
  (AtLeast, Quantity a, Quantity b) -> truth (a > b || equal a b)
  (Equal, Quantity a, Quantity b) -> truth (equal a b)
  (Unequal, Quantity a, Quantity b) -> truth (not (equal a b))
  _ -> bug "an operation on values of other types"
  where
    truth = pure . TruthValue
    equal a b = abs (a - b) <= Tolerance.equal

-- Functions

-- | The value of a function for its arguments.
apply :: Region -> Builtin -> [Argument] -> Eval Value
apply region builtin arguments = case (builtin, arguments) of
  (Pi, []) -> pure (Quantity pi)
  (Truth, []) -> pure (TruthValue True)
  (Falsehood, []) -> pure (TruthValue False)
  (Polar, [Plain (Quantity r), Plain (Quantity a)]) -> spatial region (Vec.polar (Mm r) (Rad a))
  (Intersection, Plain a : Plain b : choice)
    | none isCurve [a, b] ->
      intersection region (curve a) (curve b) choice
  (CentreOf, [Plain (CircleValue c)]) -> at (centre c)
  (Midpoint, [Plain (Spatial p), Plain (Spatial q)]) -> at (Vec.between 0.5 (place p) (place q))
  (Foot, [Plain (Spatial p), Plain (LineValue l)]) -> at (Carrier.foot l (place p))
  (Tangency, [Plain (Spatial p), c]) ->
    at . to =<< tangentLine region "point of tangency" (APoint . to) (Plain (Spatial p)) c
  (Tangency, [Plain a, Plain b]) -> tangency region (curve a) (curve b)
  (PointOn, [Plain (CircleValue (Circle c r)), Plain (Quantity a)]) ->
    at (Vec.shift (Vec.polar r (Rad a)) c)
  (MakeLine, [Plain (Spatial p), Plain (Spatial q)])
    | Vec.near (place p) (place q) -> Evaluation.mistake (ZeroLine region (place p))
    | otherwise -> pure (LineValue (Line (place p) (place q)))
  (MakeLine, [Plain (Spatial p), Plain (Quantity a)]) ->
    pure (LineValue (ray (place p) (Vec.polar (Mm 1) (Rad a))))
  (MakeLine, [a, b]) -> LineValue <$> tangentLine region "line" ALine a b
  (Horizontal, [Plain (Quantity h)]) ->
    LineValue (ray (Vec.point 0 h) (Vec.vec 1 0)) <$ within region h
  (Vertical, [Plain (Quantity h)]) ->
    LineValue (ray (Vec.point h 0) (Vec.vec 0 1)) <$ within region h
  (Parallel, [Plain (LineValue l), Choosing ToLeft (Quantity d)]) ->
    LineValue (Carrier.parallelAt (Mm d) l) <$ within region d
  (Parallel, [Plain (LineValue l), Choosing ToRight (Quantity d)]) ->
    LineValue (Carrier.parallelAt (Mm (-d)) l) <$ within region d
  (Parallel, [Plain (LineValue l), Plain (Spatial p)]) ->
    pure (LineValue (Line (place p) (Vec.shift (Vec.to (from l) (to l)) (place p))))
  (Perpendicular, [Plain (LineValue l), Plain (Spatial p)]) ->
    pure (LineValue (ray (place p) (Vec.left (Carrier.direction l))))
  (MakeCircle, [Plain (Spatial c), Plain (Quantity r)]) -> circleOf (place c) r
  (MakeCircle, [Plain (Spatial c), Plain (LineValue l)]) ->
    let Mm d =
          Carrier.signedDistance l (place c)
     in circleOf (place c) (abs d)
  (MakeCircle, [Plain (Spatial p), Plain (Spatial q), Plain (Spatial s)]) ->
    maybe
      (Evaluation.mistake (OnOneLine region))
      (\(Circle c (Mm r)) -> circleOf c r)
      (TangentCircle.through (place p) (place q) (place s))
  (MakeCircle, Plain (Quantity r) : a : b : choice)
    | r <= 0 -> Evaluation.mistake (RadiusNotPositive region (Mm r))
    | otherwise -> do
      within region r
      found <-
        picked
          Tolerance.coincident
          region
          "circle"
          ACircle
          centre
          []
          [c | ta <- touched a, tb <- touched b, c <- TangentCircle.circles (Mm r) ta tb]
          choice
      circleOf (centre found) r
  (Concentric, [Plain (CircleValue (Circle c (Mm r))), Plain (Quantity d)]) -> circleOf c (r + d)
  (Distance, [Plain (Spatial p), Plain (Spatial q)]) -> measured (Vec.distance (place p) (place q))
  (Distance, [Plain (Spatial p), Plain (LineValue l)]) -> measured (apart l (place p))
  (Distance, [Plain (LineValue l), Plain (Spatial p)]) -> measured (apart l (place p))
  (Distance, [Plain (LineValue l), Plain (LineValue m)]) -> case Intersection.lines l m of
    Apart d -> measured d
    Same -> pure (Quantity 0)
    _ -> Evaluation.mistake (NoAnswer region "distance" "These lines are not parallel.")
  (DirectionOf, [Plain (LineValue l)]) -> angled (Vec.angle (Carrier.direction l))
  (DirectionOf, [Plain (Spatial v)])
    | Vec.norm v <= 0 ->
      Evaluation.mistake (NoAnswer region "direction" "The vector has no length.")
    | otherwise -> angled (Vec.angle v)
  (RadiusOf, [Plain (CircleValue (Circle _ r))]) -> measured r
  (LengthOf, [Plain (ContourValue c)]) -> measured (Polyarc.length (outline c))
  (LengthOf, [Plain (LineValue l)]) -> measured (Vec.distance (from l) (to l))
  (LengthOf, [Plain (Spatial v)]) -> measured (Mm (Vec.norm v))
  (XOf, [Plain (Spatial v)]) -> pure (Quantity (Vec.x (place v)))
  (YOf, [Plain (Spatial v)]) -> pure (Quantity (Vec.y (place v)))
  (Reversed, [Plain (LineValue l)]) -> pure (LineValue (Line (to l) (from l)))
  (Reversed, [Plain (CurveValue c)]) -> pure (CurveValue (Curve.reversed c))
  (Reversed, [Plain (ContourValue c)]) -> pure (ContourValue (backwards c))
  (Reversed, [Plain (ListValue vs)]) -> pure (ListValue (Vector.reverse vs))
  (Moved, ps) -> transformed region ps $ \case
    [Spatial v] -> pure (Transformation.translation v)
    _ -> wrong
  (Rotated, ps) -> transformed region ps $ \case
    [Quantity a] -> pure (Transformation.rotation (Rad a) (Vec.point 0 0))
    [Quantity a, Spatial p] -> pure (Transformation.rotation (Rad a) (place p))
    _ -> wrong
  (Mirrored, ps) -> transformed region ps $ \case
    [LineValue l] -> pure (Transformation.reflection l)
    _ -> wrong
  (Scaled, ps) -> transformed region ps $ \case
    [Quantity k] -> scaling k (Vec.point 0 0)
    [Quantity k, Spatial p] -> scaling k (place p)
    _ -> wrong
  (Row, [Plain (Spatial p), Plain (Spatial v), Plain (Quantity n)]) -> do
    count <- whole region "the number of points in a row" n
    Evaluation.spend region count
    points [Vec.shift (Vec.scale (fromIntegral k) v) (place p) | k <- [0 .. count - 1]]
  ( Grid,
    [ Plain (Spatial p),
      Plain (Spatial v),
      Plain (Quantity n),
      Plain (Spatial w),
      Plain (Quantity m)
      ]
    ) ->
      do
        count <- whole region "the number of points in a row" n
        rows <- whole region "the number of rows" m
        Evaluation.spend region (min 100000000 (count * rows))
        points
          [ Vec.shift
              (Vec.add (Vec.scale (fromIntegral k) v) (Vec.scale (fromIntegral j) w))
              (place p)
            | j <- [0 .. rows - 1],
              k <- [0 .. count - 1]
          ]
  (Around, [Plain (CircleValue c), Plain (Quantity n)]) -> around c n 0 Nothing
  (Around, [Plain (CircleValue c), Plain (Quantity n), Plain (Quantity a)]) -> around c n a Nothing
  (Around, [Plain (CircleValue c), Plain (Quantity n), Plain (Quantity a), Plain (Quantity b)]) ->
    around c n a (Just b)
  (Count, [Plain (ListValue vs)]) -> pure (Quantity (fromIntegral (Vector.length vs)))
  (ItemOf, [Plain (ListValue vs), Plain (Quantity n)]) -> do
    k <- whole region "the number of an item" n
    maybe (Evaluation.mistake (NoSuchItem region k (Vector.length vs))) pure (vs Vector.!? (k - 1))
  (Lift, [Plain (Spatial p), Plain (Quantity z)]) -> lifted region (place p) (Mm z)
  (Sin, [Plain (Quantity a)]) -> pure (Quantity (sin a))
  (Cos, [Plain (Quantity a)]) -> pure (Quantity (cos a))
  (Tan, [Plain (Quantity a)])
    | abs (cos a) < 1e-15 ->
      Evaluation.mistake
        ( OutOfRange
            region
            "tan"
            (Decimal.short 6 (degrees (Rad a)) <> " deg")
            "any angle but 90 deg, 270 deg, …"
        )
    | otherwise -> finite region (tan a)
  (Asin, [Plain (Quantity x)]) -> inverse "asin" asin x
  (Acos, [Plain (Quantity x)]) -> inverse "acos" acos x
  (Atan2, [Plain (Quantity 0), Plain (Quantity 0)]) ->
    Evaluation.mistake (OutOfRange region "atan2" "0 and 0" "two values that are not both 0")
  (Atan2, [Plain (Quantity y), Plain (Quantity x)]) -> pure (Quantity (atan2 y x))
  (Sqrt, [Plain (Quantity x)])
    | x < negate Tolerance.equal ->
      Evaluation.mistake (OutOfRange region "sqrt" (Decimal.short 9 x) "values from 0 upwards")
    | otherwise -> pure (Quantity (sqrt (max 0 x)))
  (Abs, [Plain (Quantity x)]) -> pure (Quantity (abs x))
  (Min, [Plain (Quantity a), Plain (Quantity b)]) -> pure (Quantity (min a b))
  (Max, [Plain (Quantity a), Plain (Quantity b)]) -> pure (Quantity (max a b))
  (Floor, [Plain (Quantity x)]) -> pure (Quantity (fromInteger (floor (x + Tolerance.equal))))
  _ -> fromMaybe wrong (CurveBuiltin.apply region builtin arguments)
  where
    none p = not . any p
    isCurve v = case v of
      CurveValue _ -> True
      _ -> False
    wrong = bug "a function applied to values of other types"
    at = spatial region . offset
    points ps = ListValue . Vector.fromList <$> traverse at ps
    measured (Mm d) = finite region d
    apart l p = let Mm d = Carrier.signedDistance l p in Mm (abs d)
    angled (Rad a) = pure (Quantity a)
    circleOf c r
      | r <= 0 = Evaluation.mistake (RadiusNotPositive region (Mm r))
      | otherwise = CircleValue (Circle c (Mm r)) <$ within region r
    scaling k p
      | k <= 0 =
        Evaluation.mistake (NotPositive region "the factor of a scaling" (Decimal.short 6 k))
      | otherwise = pure (Transformation.scaling k p)
    inverse name f x
      | abs x > 1 + Tolerance.equal =
        Evaluation.mistake (OutOfRange region name (Decimal.short 9 x) "values from −1 to 1")
      | otherwise = pure (Quantity (f (max (-1) (min 1 x))))
    -- Points on a circle: all round, or from one angle to another, both included.
    around (Circle c r) n a b = do
      count <- whole region "the number of points" n
      Evaluation.spend region count
      let step = case b of
            Nothing -> 2 * pi / fromIntegral count
            Just end -> if count == 1 then 0 else (end - a) / fromIntegral (count - 1)
      points [Vec.shift (Vec.polar r (Rad (a + fromIntegral k * step))) c | k <- [0 .. count - 1]]

-- | The line of a point and a direction.
ray :: Point -> Vec -> Line
ray p v = Line p (Vec.shift v p)

-- Choices

-- | A line or a circle as a curve.
curve :: Value -> ElementCarrier
curve v = case v of
  LineValue l -> OnLine l
  CircleValue c -> OnCircle CounterClockwise c
  _ -> bug "a value that is no curve where one was checked"

intersection :: Region -> ElementCarrier -> ElementCarrier -> [Argument] -> Eval Value
intersection region a b choice = case meeting of
  Apart gap -> Evaluation.mistake (NothingCommon region a b gap)
  Same -> Evaluation.mistake (SameThing region)
  Touching p -> chosen [p]
  CrossingOnce p -> chosen [p]
  Crossing p q -> chosen [p, q]
  where
    chosen ps =
      picked
        Tolerance.coincident
        region
        "point"
        APoint
        id
        [ElementCarrier.alongLine l | OnLine l <- [a, b]]
        ps
        choice
        >>= spatial region . offset
    meeting = case (a, b) of
      (OnLine l, OnLine m) -> Intersection.lines l m
      (OnLine l, OnCircle _ c) -> Intersection.lineCircle l c
      (OnCircle _ c, OnLine l) -> Intersection.lineCircle l c
      (OnCircle _ c, OnCircle _ d) -> Intersection.circles c d
      _ -> bug "an intersection of points"

-- | The point at which two curves touch.
tangency :: Region -> ElementCarrier -> ElementCarrier -> Eval Value
tangency region a b = case (a, b) of
  (OnLine l, OnCircle _ c) -> lineAt l c
  (OnCircle _ c, OnLine l) -> lineAt l c
  (OnCircle _ c, OnCircle _ d) -> case Intersection.circles c d of
    Touching p -> spatial region (offset p)
    Same -> Evaluation.mistake (SameThing region)
    _ -> Evaluation.mistake (NotTouching region (circleGap c d))
  _ -> bug "a tangency of other things than lines and circles"
  where
    lineAt l c@(Circle o (Mm r)) = case Intersection.lineCircle l c of
      Touching p -> spatial region (offset p)
      _ ->
        let Mm h =
              Carrier.signedDistance l o
         in Evaluation.mistake (NotTouching region (Mm (abs (abs h - r))))
    circleGap (Circle c (Mm r)) (Circle d (Mm s)) =
      let Mm gap = Vec.distance c d in Mm (min (abs (gap - r - s)) (abs (gap - abs (r - s))))

-- | The directed line that touches two circles, or goes through a point. The word before a circle
-- says on which side of the line it lies.
tangentLine :: Region -> Text -> (Line -> Candidate) -> Argument -> Argument -> Eval Line
tangentLine region what candidate a b =
  case TangentCircle.touchingLines (circleAt a) (circleAt b) of
    [one] -> pure one
    [] -> Evaluation.mistake (NoAnswer region what why)
    several -> Evaluation.mistake (Several region what (map candidate several))
  where
    circleAt g = case g of
      Plain (Spatial p) -> ([CounterClockwise, Clockwise], Circle (place p) (Mm 0))
      Plain (CircleValue c) -> ([CounterClockwise, Clockwise], c)
      Choosing ToLeft (CircleValue c) -> ([CounterClockwise], c)
      Choosing ToRight (CircleValue c) -> ([Clockwise], c)
      _ -> bug "a tangent to something else"
    why =
      let (_, Circle p r) = circleAt a
          (_, Circle q s) = circleAt b
          Mm d = Vec.distance p q
          Mm reach = plus r s
          Mm inside = minus (max r s) (min r s)
          Mm tolerance = Tolerance.coincident
          place' = if r == Mm 0 then p else q
       in case () of
            _
              | r == Mm 0 && s == Mm 0 -> "The points are the same."
              | (r == Mm 0 || s == Mm 0) && abs (reach - d) <= tolerance ->
                "The point "
                  <> Vec.written 4 place'
                  <> " lies on the circle; the line that touches it there is perpendicular to its \
                     \radius."
              | r == Mm 0 || s == Mm 0 ->
                "The point lies inside the circle, "
                  <> Decimal.mm (Mm (reach - d))
                  <> " from its edge."
              | d <= tolerance && inside <= tolerance -> "The circles are the same."
              | d <= inside -> "One circle lies inside the other."
              | otherwise -> "The circles overlap by " <> Decimal.mm (Mm (reach - d)) <> "."

-- | What a circle is to touch, with the word before it.
touched :: Argument -> [Touched]
touched g = case g of
  Plain (Spatial p) -> [Through (place p)]
  Plain (LineValue l) -> [LeftOf l, RightOf l]
  Choosing ToLeft (LineValue l) -> [LeftOf l]
  Choosing ToRight (LineValue l) -> [RightOf l]
  Plain (CircleValue c) -> [OutsideOf c, InsideOf c]
  Choosing Beyond (CircleValue c) -> [OutsideOf c]
  Choosing Within' (CircleValue c) -> [InsideOf c]
  _ -> bug "a circle that touches something else"

-- Transformations

-- | A transformation by itself, or of the thing that is the first argument.
transformed :: Region -> [Argument] -> ([Value] -> Eval Transformation) -> Eval Value
transformed region arguments make = case [v | Plain v <- arguments] of
  Quantity a : rest -> PlacementValue <$> make (Quantity a : rest)
  [only] -> PlacementValue <$> make [only]
  what : rest -> make rest >>= \s -> image region s what
  [] -> bug "a transformation without arguments"

-- | What becomes of a thing.
image :: Region -> Transformation -> Value -> Eval Value
image region s v = case v of
  Spatial p -> spatial region (offset (Transformation.point s (place p)))
  CircleValue c ->
    let d@(Circle o (Mm r)) =
          Transformation.circle s c
     in CircleValue d <$ (within region (Vec.norm (offset o)) *> within region r)
  LineValue l ->
    let m =
          Transformation.line s l
     in LineValue m <$ within region (Vec.norm (offset (from m)))
  ContourValue c -> do
    let d =
          c
            { elements =
                fmap
                  (\e -> e {segment = Transformation.segment s (segment e)})
                  (elements c),
              legs = []
            }
    mapM_ (within region . Vec.norm . offset . Segment.end . segment) (elements d)
    pure (ContourValue d)
  ListValue vs -> ListValue <$> traverse (image region s) vs
  CurveValue c ->
    let d =
          Curve.transformed s c
     in CurveValue d <$ mapM_ (within region . Vec.norm . offset) (Curve.ends d)
  _ -> bug "a transformation of something else"
