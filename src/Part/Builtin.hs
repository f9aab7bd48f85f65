-- | Computes the operators of the language, and its functions of numbers, lists, patterns of points
-- (rows, grids and circles) and transformations. Constructions are in 'Part.ConstructionBuiltin',
-- functions of curves in 'Part.CurveBuiltin'.
--
-- A function of this module whose result is a 'Maybe' computes one group of the built-in functions.
-- It yields 'Nothing' for all others, and 'apply' then tries the next group.
module Part.Builtin
  ( apply,
    binary,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Region)
import Checked.Syntax (Builtin (..), Operator (..))
import Data.Foldable (asum)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Vector qualified as Vector
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ConstructionBuiltin qualified as ConstructionBuiltin
import Part.Curve qualified as Curve
import Part.CurveBuiltin qualified as CurveBuiltin
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Parameter (Domain (..))
import Part.Parameter qualified as Parameter
import Part.Part (Contour (..), Element (..), reversedContour)
import Part.PlaneRegion qualified as PlaneRegion
import Part.RegionBuiltin qualified as RegionBuiltin
import Part.Transformation qualified as PartTransformation
import Part.Value

-- Operators

-- | Applies an operator to its two operands. @region@ is that of the whole operation. @and@ and
-- @or@ are missing here, because 'Part.Expression.evaluate' may skip their second operand.
-- Comparisons treat numbers as equal if they differ by at most 'Tolerance.equal'.
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

-- | Calls a built-in function. @region@ is that of the call, for mistakes. The arguments fit one
-- form of the function, because the type checker has accepted the call.
apply :: Region -> Builtin -> [Argument] -> Eval Value
apply region builtin arguments =
  fromMaybe (bug "a function applied to values of other types") $
    asum
      [ numeric region builtin arguments,
        ofList region builtin arguments,
        RegionBuiltin.apply region builtin arguments,
        ConstructionBuiltin.apply region builtin arguments,
        transformation region builtin arguments,
        CurveBuiltin.apply region builtin arguments
      ]

-- | Computes a constant or a function of numbers. 'Nothing' if @builtin@ is another function.
numeric :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
numeric region builtin arguments = case (builtin, arguments) of
  (Pi, []) -> number pi
  (Truth, []) -> Just (pure (TruthValue True))
  (Falsehood, []) -> Just (pure (TruthValue False))
  (Sin, [Plain (Quantity a)]) -> number (sin a)
  (Cos, [Plain (Quantity a)]) -> number (cos a)
  (Tan, [Plain (Quantity a)])
    | abs (cos a) < 1e-15 -> outOfDomain (TangentAtPole (Rad a))
    | otherwise -> Just (finite region (tan a))
  (Asin, [Plain (Quantity x)]) -> inverse asin ArcSineOf x
  (Acos, [Plain (Quantity x)]) -> inverse acos ArcCosineOf x
  (Atan2, [Plain (Quantity 0), Plain (Quantity 0)]) -> outOfDomain ArcTangentOfZeros
  (Atan2, [Plain (Quantity y), Plain (Quantity x)]) -> number (atan2 y x)
  (Sqrt, [Plain (Quantity x)])
    | x < negate Tolerance.equal -> outOfDomain (RootOf x)
    | otherwise -> number (sqrt (max 0 x))
  (Abs, [Plain (Quantity x)]) -> number (abs x)
  (Min, [Plain (Quantity a), Plain (Quantity b)]) -> number (min a b)
  (Max, [Plain (Quantity a), Plain (Quantity b)]) -> number (max a b)
  (Floor, [Plain (Quantity x)]) -> number (fromInteger (floor (x + Tolerance.equal)))
  _ -> Nothing
  where
    number = Just . pure . Quantity
    outOfDomain = Just . Evaluation.mistake . OutOfDomain region
    inverse f domain x
      | abs x > 1 + Tolerance.equal = outOfDomain (domain x)
      | otherwise = number (f (max (-1) (min 1 x)))

-- Lists and patterns

-- | Computes a function of a list, or a pattern of points. 'Nothing' if @builtin@ is another
-- function.
ofList :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
ofList region builtin arguments = case (builtin, arguments) of
  (Count, [Plain (ListValue vs)]) ->
    Just (pure (Quantity (fromIntegral (Vector.length vs))))
  (ItemOf, [Plain (ListValue vs), Plain (Quantity n)]) -> Just $ do
    k <- whole region Parameter.ItemNumber n
    maybe (Evaluation.mistake (NoSuchItem region k (Vector.length vs))) pure (vs Vector.!? (k - 1))
  (Reversed, [Plain (ListValue vs)]) -> Just (pure (ListValue (Vector.reverse vs)))
  (Row, [Plain (Spatial p), Plain (Spatial v), Plain (Quantity n)]) -> Just $ do
    count <- whole region Parameter.RowPointCount n
    Evaluation.spend region count
    points region [Vec.shift (multiple k v) (fromOrigin p) | k <- [0 .. count - 1]]
  (Grid, [Plain (Spatial p), Plain (Spatial v), Plain (Quantity n), secondStep, secondCount])
    | (Plain (Spatial w), Plain (Quantity m)) <- (secondStep, secondCount) -> Just $ do
      count <- whole region Parameter.RowPointCount n
      rows <- whole region Parameter.RowCount m
      Evaluation.spend region (min 100000000 (count * rows))
      points
        region
        [ Vec.shift (Vec.add (multiple k v) (multiple j w)) (fromOrigin p)
          | j <- [0 .. rows - 1],
            k <- [0 .. count - 1]
        ]
  (Around, [Plain (CircleValue c), Plain (Quantity n)]) -> Just (around region c n 0 Nothing)
  (Around, [Plain (CircleValue c), Plain (Quantity n), Plain (Quantity a)]) ->
    Just (around region c n a Nothing)
  (Around, [Plain (CircleValue c), Plain (Quantity n), Plain (Quantity a), Plain (Quantity b)]) ->
    Just (around region c n a (Just b))
  _ -> Nothing
  where
    multiple :: Int -> Vec.Vec -> Vec.Vec
    multiple k = Vec.scale (fromIntegral k)

-- | Makes a list of points. Fails if a point is further than 'Tolerance.reach' from (0, 0).
points :: Region -> [Point] -> Eval Value
points region ps = ListValue . Vector.fromList <$> traverse (spatial region . offset) ps

-- | Makes a list of @n@ points at equal steps on a circle. The first point is at the angle @a@, in
-- radians from the x axis. If there is an angle @b@, the last point is at @b@; the points run
-- clockwise when @b@ is less than @a@. Without @b@ the steps divide the whole circle, and the
-- points run counter-clockwise.
around :: Region -> Circle -> Double -> Double -> Maybe Double -> Eval Value
around region (Circle c r) n a b = do
  count <- whole region Parameter.PointCount n
  Evaluation.spend region count
  let step = case b of
        Nothing -> 2 * pi / fromIntegral count
        Just end -> if count == 1 then 0 else (end - a) / fromIntegral (count - 1)
  points
    region
    [Vec.shift (Vec.polar r (Rad (a + fromIntegral k * step))) c | k <- [0 .. count - 1]]

-- Transformations

-- | Computes a function that transforms a value, or that makes a transformation. 'Nothing' if
-- @builtin@ is another function.
transformation :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
transformation region builtin arguments = case builtin of
  Moved -> Just . transformed region arguments $ \case
    [Spatial v] -> pure (Transformation.translation v)
    _ -> wrong
  Rotated -> Just . transformed region arguments $ \case
    [Quantity a] -> pure (Transformation.rotation (Rad a) (Vec.point 0 0))
    [Quantity a, Spatial p] -> pure (Transformation.rotation (Rad a) (fromOrigin p))
    _ -> wrong
  Mirrored -> Just . transformed region arguments $ \case
    [LineValue l] -> pure (Transformation.reflection l)
    _ -> wrong
  Scaled -> Just . transformed region arguments $ \case
    [Quantity k] -> scaling k (Vec.point 0 0)
    [Quantity k, Spatial p] -> scaling k (fromOrigin p)
    _ -> wrong
  _ -> Nothing
  where
    wrong = bug "a transformation with parameters of other types"
    scaling k p
      | k <= 0 = Evaluation.mistake (NotPositive region Parameter.ScalingFactor k)
      | otherwise = pure (Transformation.scaling k p)

-- | The image of the first argument under a transformation, which @make@ makes from the other
-- arguments. If the first argument is a number or the only argument, there is no value to
-- transform: @make@ gets all arguments, and the result is the transformation itself.
transformed :: Region -> [Argument] -> ([Value] -> Eval Transformation) -> Eval Value
transformed region arguments make = case [v | Plain v <- arguments] of
  Quantity a : rest -> PlacementValue <$> make (Quantity a : rest)
  [only] -> PlacementValue <$> make [only]
  original : rest -> make rest >>= \s -> image region s original
  [] -> bug "a transformation without arguments"

-- | Applies the transformation @s@ to the value @v@. @region@ is that of the call.
image :: Region -> Transformation -> Value -> Eval Value
image region s v = case v of
  Spatial p -> spatial region (offset (Transformation.point s (fromOrigin p)))
  CircleValue c ->
    let d@(Circle o (Mm r)) = Transformation.circle s c
     in CircleValue d <$ (reachable o *> within region r)
  LineValue l -> let m = Transformation.line s l in LineValue m <$ reachable (from m)
  ContourValue c ->
    ContourValue (moved c) <$ mapM_ (reachable . Segment.end . segment) (elements (moved c))
  RegionValue r -> do
    let -- A reflection turns the contours round.
        upright c = if Transformation.mirrors s then reversedContour (moved c) else moved c
        image' = PlaneRegion.mapContours upright r
    mapM_
      (reachable . Segment.end . segment)
      [e | c <- PlaneRegion.contoursOf image', e <- NonEmpty.toList (elements c)]
    pure (RegionValue image')
  ListValue vs -> ListValue <$> traverse (image region s) vs
  CurveValue c ->
    let d = Curve.transformed s c in CurveValue d <$ mapM_ reachable (Curve.ends d)
  _ -> bug "a transformation of something else"
  where
    moved = PartTransformation.image s
    reachable = within region . Vec.norm . offset
