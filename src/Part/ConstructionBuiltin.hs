-- | Constructions with points, lines and circles: intersections, perpendicular feet, tangents,
-- parallels, circles of a given radius, distances and directions.
--
-- 'apply' tries four functions in turn. Each of them computes one group of the constructions, and
-- yields 'Nothing' for all other functions and arguments. A figure is a point, a line or a circle.
module Part.ConstructionBuiltin
  ( apply,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..), Rad (..), minus, plus)
import Base.Region (Region)
import Checked.Syntax (Builtin (..), Selector (..))
import Data.Foldable (asum)
import Geometry.Carrier (Circle (..), Line (..), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Construction.Intersection (Intersection (..))
import Geometry.Construction.Intersection qualified as Intersection
import Geometry.Construction.TangentCircle (Touched (..))
import Geometry.Construction.TangentCircle qualified as TangentCircle
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.ElementCarrier qualified as ElementCarrier
import Geometry.Polyarc qualified as Polyarc
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.ConstructionError
  ( ConstructionFault (..),
    NoAnswer (..),
    Sought (..),
    TangentObstacle (..),
  )
import Part.Curve qualified as Curve
import Part.Error (ValueFact (..))
import Part.ErrorText (Candidate (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Part (polyarcOf, reversedContour)
import Part.Selection (Answers (..), answerPoints, picked)
import Part.Value

-- | Computes a construction. @region@ is the region of the call in the program, for reports.
-- 'Nothing' if @builtin@ with these arguments is not a construction.
apply :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
apply region builtin arguments =
  asum [f region builtin arguments | f <- [pointFunction, lineFunction, circleFunction, measure]]

-- | Computes a construction whose result is a point. 'Nothing' if the construction has another
-- result.
pointFunction :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
pointFunction region builtin arguments = case (builtin, arguments) of
  (Polar, [Plain (Quantity r), Plain (Quantity a)]) ->
    Just (spatial region (Vec.polar (Mm r) (Rad a)))
  (Intersection, Plain a : Plain b : choice)
    | not (any isCurve [a, b]) -> Just (intersection region (carrier a) (carrier b) choice)
  (CentreOf, [Plain (CircleValue c)]) -> at (centre c)
  (Midpoint, [Plain (Spatial p), Plain (Spatial q)]) ->
    at (Vec.interpolate 0.5 (fromOrigin p) (fromOrigin q))
  (Foot, [Plain (Spatial p), Plain (LineValue l)]) -> at (Carrier.foot l (fromOrigin p))
  (Tangency, [Plain (Spatial p), c]) ->
    Just
      ( spatial region . offset . to
          =<< tangentLine region SoughtTangency (APoint . to) (Plain (Spatial p)) c
      )
  (Tangency, [Plain a, Plain b]) -> Just (tangency region (carrier a) (carrier b))
  (PointOn, [Plain (CircleValue (Circle c r)), Plain (Quantity a)]) ->
    at (Vec.shift (Vec.polar r (Rad a)) c)
  (Lift, [Plain (Spatial p), Plain (Quantity z)]) -> Just (lifted region (fromOrigin p) (Mm z))
  _ -> Nothing
  where
    at = Just . spatial region . offset
    isCurve v = case v of
      CurveValue _ -> True
      _ -> False

-- | Computes a construction whose result is a line, or reverses a line, a curve or a contour.
-- 'Nothing' if the construction has another result.
lineFunction :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
lineFunction region builtin arguments = case (builtin, arguments) of
  (MakeLine, [Plain (Spatial p), Plain (Spatial q)])
    | Vec.isNear (fromOrigin p) (fromOrigin q) ->
      Just (Evaluation.mistake (ZeroLine region (fromOrigin p)))
    | otherwise -> line (Line (fromOrigin p) (fromOrigin q))
  (MakeLine, [Plain (Spatial p), Plain (Quantity a)]) ->
    line (ray (fromOrigin p) (Vec.polar (Mm 1) (Rad a)))
  (MakeLine, [a, b]) -> Just (LineValue <$> tangentLine region SoughtLine ALine a b)
  (Horizontal, [Plain (Quantity h)]) -> at h (ray (Vec.point 0 h) (Vec.vec 1 0))
  (Vertical, [Plain (Quantity h)]) -> at h (ray (Vec.point h 0) (Vec.vec 0 1))
  (Parallel, [Plain (LineValue l), Choosing ToLeft (Quantity d)]) ->
    at d (Carrier.parallelAt (Mm d) l)
  (Parallel, [Plain (LineValue l), Choosing ToRight (Quantity d)]) ->
    at d (Carrier.parallelAt (Mm (-d)) l)
  (Parallel, [Plain (LineValue l), Plain (Spatial p)]) ->
    line (ray (fromOrigin p) (Vec.to (from l) (to l)))
  (Perpendicular, [Plain (LineValue l), Plain (Spatial p)]) ->
    line (ray (fromOrigin p) (Vec.left (Carrier.direction l)))
  (Reversed, [Plain (LineValue l)]) -> line (Line (to l) (from l))
  (Reversed, [Plain (CurveValue c)]) -> Just (pure (CurveValue (Curve.reversed c)))
  (Reversed, [Plain (ContourValue c)]) -> Just (pure (ContourValue (reversedContour c)))
  _ -> Nothing
  where
    line = Just . pure . LineValue
    at distance l = Just (LineValue l <$ within region distance)

-- | Computes a construction whose result is a circle. 'Nothing' if the construction has another
-- result.
circleFunction :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
circleFunction region builtin arguments = case (builtin, arguments) of
  (MakeCircle, [Plain (Spatial c), Plain (Quantity r)]) -> Just (circleOf (Just 1) (fromOrigin c) r)
  (MakeCircle, [Plain (Spatial c), Plain (LineValue l)]) ->
    let Mm d = distanceFrom l (fromOrigin c) in Just (circleOf Nothing (fromOrigin c) d)
  (MakeCircle, [Plain (Spatial p), Plain (Spatial q), Plain (Spatial s)]) ->
    Just
      ( maybe
          (fault (OnOneLine region))
          (\(Circle c (Mm r)) -> circleOf Nothing c r)
          (TangentCircle.through (fromOrigin p) (fromOrigin q) (fromOrigin s))
      )
  (MakeCircle, Plain (Quantity r) : a : b : choice)
    | r <= 0 -> Just (Evaluation.mistake (RadiusNotPositive region (Mm r) (Just 0)))
    | otherwise -> Just $ do
      within region r
      found <- picked region (touchingCircles (Mm r) a b) choice
      circleOf Nothing (centre found) r
  (Concentric, [Plain (CircleValue (Circle c (Mm r))), Plain (Quantity d)]) ->
    Just (circleOf Nothing c (r + d))
  _ -> Nothing
  where
    -- @index@ is the index of the argument that gives the radius.
    circleOf index c r
      | r <= 0 = Evaluation.mistake (RadiusNotPositive region (Mm r) index)
      | otherwise = CircleValue (Circle c (Mm r)) <$ within region r

-- | All circles of radius @r@ that touch both figures @a@ and @b@. One of them is chosen by the
-- position of its centre. The word @left@, @right@, @inside@ or @outside@ before a figure restricts
-- the side on which the circle touches it.
touchingCircles :: Mm -> Argument -> Argument -> Answers Circle
touchingCircles r a b =
  Answers
    { sought = SoughtCircle,
      candidate = ACircle,
      keyPoint = centre,
      stations = [],
      tie = Tolerance.coincident,
      answers = [c | ta <- touched a, tb <- touched b, c <- TangentCircle.circles r ta tb]
    }

-- | Computes a function whose result is a distance, a direction, a length, a radius or a
-- coordinate. 'Nothing' for any other function.
measure :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
measure region builtin arguments = case (builtin, arguments) of
  (Distance, [Plain (Spatial p), Plain (Spatial q)]) ->
    measured (Vec.distance (fromOrigin p) (fromOrigin q))
  (Distance, [Plain (Spatial p), Plain (LineValue l)]) ->
    measured (distanceFrom l (fromOrigin p))
  (Distance, [Plain (LineValue l), Plain (Spatial p)]) ->
    measured (distanceFrom l (fromOrigin p))
  (Distance, [Plain (LineValue l), Plain (LineValue m)]) -> case Intersection.lines l m of
    Apart d -> measured d
    Same -> number 0
    _ -> Just (fault (NoAnswer region LinesNotParallel))
  (DirectionOf, [Plain (LineValue l)]) -> angled (Carrier.direction l)
  (DirectionOf, [Plain (Spatial v)])
    | Vec.norm v <= 0 -> Just (fault (NoAnswer region ZeroVector))
    | otherwise -> angled v
  (RadiusOf, [Plain (CircleValue (Circle _ r))]) -> measured r
  (LengthOf, [Plain (ContourValue c)]) -> measured (Polyarc.length (polyarcOf c))
  (LengthOf, [Plain (LineValue l)]) -> measured (Vec.distance (from l) (to l))
  (LengthOf, [Plain (Spatial v)]) -> measured (Mm (Vec.norm v))
  (XOf, [Plain (Spatial v)]) -> number (Vec.x (fromOrigin v))
  (YOf, [Plain (Spatial v)]) -> number (Vec.y (fromOrigin v))
  _ -> Nothing
  where
    number = Just . pure . Quantity
    measured (Mm d) = Just (finite region d)
    angled v = let Rad a = Vec.angle v in number a

fault :: ConstructionFault -> Eval a
fault = Evaluation.mistake . InConstruction

-- | The perpendicular distance between an infinite line and a point, never negative.
distanceFrom :: Line -> Point -> Mm
distanceFrom l p = let Mm d = Carrier.signedDistance l p in Mm (abs d)

-- | The line that begins at a point and has the direction of a vector.
ray :: Point -> Vec -> Line
ray p v = Line p (Vec.shift v p)

-- | The carrier of a line or of a circle. The sense of the circle is arbitrary: constructions
-- ignore it.
carrier :: Value -> ElementCarrier
carrier v = case v of
  LineValue l -> OnLine l
  CircleValue c -> OnCircle CounterClockwise c
  _ -> bug "a value that is no curve where one was checked"

-- | An intersection of two lines or circles. If there are two, the words in @choice@ (@near@,
-- @left@, …) choose one of them. Fails if there is none.
intersection :: Region -> ElementCarrier -> ElementCarrier -> [Argument] -> Eval Value
intersection region a b choice = case meeting of
  Apart gap -> fault (NothingCommon region a b gap)
  Same -> fault (SameThing region)
  Touching p -> chosen [p]
  CrossingOnce p -> chosen [p]
  Crossing p q -> chosen [p, q]
  where
    chosen ps = spatial region . offset =<< picked region (answersAmong ps) choice
    answersAmong = answerPoints Tolerance.coincident stationsOnLines
    stationsOnLines = [ElementCarrier.positionAlong l | OnLine l <- [a, b]]
    meeting = case (a, b) of
      (OnLine l, OnLine m) -> Intersection.lines l m
      (OnLine l, OnCircle _ c) -> Intersection.lineCircle l c
      (OnCircle _ c, OnLine l) -> Intersection.lineCircle l c
      (OnCircle _ c, OnCircle _ d) -> Intersection.circles c d
      _ -> bug "an intersection of points"

-- | The point at which two lines or circles touch each other. Fails if they do not touch.
tangency :: Region -> ElementCarrier -> ElementCarrier -> Eval Value
tangency region a b = case (a, b) of
  (OnLine l, OnCircle _ c) -> lineAt l c
  (OnCircle _ c, OnLine l) -> lineAt l c
  (OnCircle _ c, OnCircle _ d) -> case Intersection.circles c d of
    Touching p -> spatial region (offset p)
    Same -> fault (SameThing region)
    other -> fault (NotTouching region (circleGap c d) (Intersection.points other))
  _ -> bug "a tangency of other things than lines and circles"
  where
    lineAt l c@(Circle o (Mm r)) = case Intersection.lineCircle l c of
      Touching p -> spatial region (offset p)
      other ->
        let Mm h = distanceFrom l o
         in fault (NotTouching region (Mm (abs (h - r))) (Intersection.points other))
    circleGap (Circle c (Mm r)) (Circle d (Mm s)) =
      let Mm gap = Vec.distance c d in Mm (min (abs (gap - r - s)) (abs (gap - abs (r - s))))

-- | The line that begins at figure @a@ and ends at figure @b@. Each of them is a point on the line,
-- or a circle to which the line is tangent. The word @left@ or @right@ before a circle says on
-- which side of the line the circle lies. Fails unless there is exactly one such line. For reports,
-- @sought@ is the kind of result, and @candidate@ converts a line to an entry in the list of
-- answers.
tangentLine :: Region -> Sought -> (Line -> Candidate) -> Argument -> Argument -> Eval Line
tangentLine region sought candidate a b =
  case TangentCircle.tangentLines (sensesOf a, circleAt a) (sensesOf b, circleAt b) of
    [one] -> pure one
    [] -> fault (NoAnswer region (NoTangent sought (obstacle (circleAt a) (circleAt b))))
    several ->
      fault (SeveralTangents region sought [(candidate l, map (sideOf l) [a, b]) | l <- several])
  where
    circleAt argument = case argument of
      Plain (Spatial p) -> Circle (fromOrigin p) (Mm 0)
      Plain (CircleValue c) -> c
      Choosing ToLeft (CircleValue c) -> c
      Choosing ToRight (CircleValue c) -> c
      _ -> bug "a tangent to something else"
    sensesOf argument = case argument of
      Choosing ToLeft _ -> [CounterClockwise]
      Choosing ToRight _ -> [Clockwise]
      _ -> [CounterClockwise, Clockwise]
    -- The word before a circle that chooses the line @l@; 'Nothing' if the program writes it
    -- already.
    sideOf l argument = case argument of
      Plain (CircleValue (Circle c _)) -> Just (Carrier.signedDistance l c > Mm 0)
      _ -> Nothing

-- | The reason why no line is tangent to both circles. A circle of radius 0 represents a point.
obstacle :: Circle -> Circle -> TangentObstacle
obstacle (Circle p r) (Circle q s)
  | r == Mm 0 && s == Mm 0 = SamePoints
  | hasPoint && abs (reach - d) <= tolerance = PointOnCircle (if r == Mm 0 then p else q)
  | hasPoint = PointInside (Mm (reach - d))
  | d <= tolerance && inside <= tolerance = SameCircles
  | d <= inside = CircleInCircle
  | otherwise = CirclesOverlap (Mm (reach - d))
  where
    hasPoint = r == Mm 0 || s == Mm 0
    Mm d = Vec.distance p q
    Mm reach = plus r s
    Mm inside = minus (max r s) (min r s)
    Mm tolerance = Tolerance.coincident

-- | The contacts that a circle may have with a figure: on the left or the right of a line, outside
-- or inside of a circle, through a point. If the program writes a side before the figure, the list
-- has only the contact on that side.
touched :: Argument -> [Touched]
touched argument = case argument of
  Plain (Spatial p) -> [Through (fromOrigin p)]
  Plain (LineValue l) -> [LeftOf l, RightOf l]
  Choosing ToLeft (LineValue l) -> [LeftOf l]
  Choosing ToRight (LineValue l) -> [RightOf l]
  Plain (CircleValue c) -> [OutsideOf c, InsideOf c]
  Choosing ToOutside (CircleValue c) -> [OutsideOf c]
  Choosing ToInside (CircleValue c) -> [InsideOf c]
  _ -> bug "a circle that touches something else"
