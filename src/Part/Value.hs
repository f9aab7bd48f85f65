-- | Values of the language while a program is evaluated.
module Part.Value
  ( Value (..),
    Environment (..),
    empty,
    evaluate,
    within,
    steps,
    double,
    place,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.Quantity (Mm (..), Rad (..), degrees)
import Base.Region (Located (..), Region)
import Checked.Syntax (Builtin (..), Expr, Expr_ (..), Operator (..))
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Geometry.Shape (Circle (..), Line (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.Error (Error (..), Fact (..))
import Part.Part (Contour)

-- | What a name can stand for. Numbers are in mm, radians and minutes.
data Value
  = Quantity Double
  | -- | a point or a vector
    Spatial Vec
  | CircleValue Circle
  | LineValue Line
  | ListValue [Value]
  | ContourValue Contour
  deriving stock (Eq, Show)

-- | The definitions so far. Names without a value depend on a mistake that is already reported.
data Environment = Environment
  { values :: Map Name Value,
    functions :: Map Name (NonEmpty Name, Expr),
    -- | how many steps a call of each function takes
    costs :: Map Name Integer,
    locals :: Map Name Value
  }

empty :: Environment
empty = Environment Map.empty Map.empty Map.empty Map.empty

-- | How many steps it takes to evaluate an expression. There is no recursion and no repetition in
-- expressions, so this is known beforehand.
steps :: Environment -> Expr -> Integer
steps env (Located _ e) = case e of
  Number _ -> 1
  Variable _ -> 1
  Apply name arguments -> Map.findWithDefault 1 name (costs env) + sum (fmap (steps env) arguments)
  Builtin _ arguments -> 1 + sum (map (steps env) arguments)
  Negate inner -> 1 + steps env inner
  Binary _ l r -> 1 + steps env l + steps env r
  Pair x y -> 1 + steps env x + steps env y
  List items -> 1 + sum (map (steps env) items)

-- | The value of an expression; Nothing when it depends on something that has none.
evaluate :: Environment -> Expr -> Either Error (Maybe Value)
evaluate env (Located region e) = case e of
  Number x -> Right (Just (Quantity x))
  Variable name -> Right (Map.lookup name (locals env) `orElse` Map.lookup name (values env))
  Apply name arguments -> case Map.lookup name (functions env) of
    Nothing -> Right Nothing
    Just (parameters, body) -> do
      vs <- traverse (evaluate env) arguments
      case sequence vs of
        Nothing -> Right Nothing
        Just given ->
          inCall region (evaluate env {locals = Map.fromList (zip (NonEmpty.toList parameters) (NonEmpty.toList given))} body)
  Builtin builtin arguments -> withAll arguments (fmap Just . apply region builtin)
  Negate inner -> withAll [inner] $ \vs -> Just <$> binary region Multiply (Quantity (-1)) (only vs)
  Binary op l r -> withAll [l, r] $ \case
    [a, b] -> Just <$> binary region op a b
    _ -> bug "an operator with other than two operands"
  Pair x y -> withAll [x, y] $ \vs -> case map double vs of
    [a, b] -> Just <$> spatial region (Vec.vec a b)
    _ -> bug "a pair of other than two"
  List items -> withAll items (Right . Just . ListValue)
  where
    withAll es f = do
      vs <- traverse (evaluate env) es
      maybe (Right Nothing) f (sequence vs)
    orElse a b = case a of
      Just _ -> a
      Nothing -> b
    only vs = case vs of
      [v] -> v
      _ -> bug "a negation of other than one value"

-- | Note through which call of a function an error came.
inCall :: Region -> Either Error a -> Either Error a
inCall region result = case result of
  Left (Error fact calls) -> Left (Error fact (calls <> [region]))
  Right a -> Right a

binary :: Region -> Operator -> Value -> Value -> Either Error Value
binary region op l r = case (op, l, r) of
  (Add, Spatial a, Spatial b) -> spatial region (Vec.add a b)
  (Subtract, Spatial a, Spatial b) -> spatial region (Vec.add a (Vec.negate b))
  (Multiply, Quantity k, Spatial a) -> spatial region (Vec.scale k a)
  (Multiply, Spatial a, Quantity k) -> spatial region (Vec.scale k a)
  (Divide, Spatial _, Quantity 0) -> zero
  (Divide, Spatial a, Quantity k) -> spatial region (Vec.scale (1 / k) a)
  (Add, Quantity a, Quantity b) -> number (a + b)
  (Subtract, Quantity a, Quantity b) -> number (a - b)
  (Multiply, Quantity a, Quantity b) -> number (a * b)
  (Divide, Quantity _, Quantity 0) -> zero
  (Divide, Quantity a, Quantity b) -> number (a / b)
  _ -> bug "an operation on values of other types"
  where
    zero = Left (Error (DivisionByZero region) [])
    number = finite region

-- | A point or vector that a machine reaches.
spatial :: Region -> Vec -> Either Error Value
spatial region v = Spatial v <$ within region (Vec.norm v)

-- | A length that a machine reaches.
within :: Region -> Double -> Either Error ()
within region x
  | abs x <= limit = Right ()
  | otherwise = Left (Error (OutOfReach region Tolerance.reach) [])
  where
    Mm limit = Tolerance.reach

-- | A number that can be held.
finite :: Region -> Double -> Either Error Value
finite region x
  | isNaN x || isInfinite x = Left (Error (TooLarge region) [])
  | otherwise = Right (Quantity x)

apply :: Region -> Builtin -> [Value] -> Either Error Value
apply region builtin arguments = case (builtin, arguments) of
  (Pi, []) -> Right (Quantity pi)
  (Polar, [Quantity r, Quantity a]) -> spatial region (Vec.polar (Mm r) (Rad a))
  (MakeCircle, [Spatial c, Quantity r])
    | r <= 0 -> failing (RadiusNotPositive region (Mm r))
    | otherwise -> CircleValue (Circle (point c) (Mm r)) <$ within region r
  (MakeLine, [Spatial p, Spatial q])
    | Vec.near (point p) (point q) -> failing (ZeroLine region (point p))
    | otherwise -> Right (LineValue (Line (point p) (point q)))
  (Distance, [Spatial p, Spatial q]) -> let Mm d = Vec.distance (point p) (point q) in finite region d
  (Sin, [Quantity a]) -> Right (Quantity (sin a))
  (Cos, [Quantity a]) -> Right (Quantity (cos a))
  (Tan, [Quantity a])
    | abs (cos a) < 1e-15 -> failing (OutOfRange region "tan" (Decimal.short 6 (degrees (Rad a)) <> " deg") "any angle but 90 deg, 270 deg, …")
    | otherwise -> finite region (tan a)
  (Asin, [Quantity x]) -> inverse "asin" asin x
  (Acos, [Quantity x]) -> inverse "acos" acos x
  (Atan2, [Quantity 0, Quantity 0]) -> failing (OutOfRange region "atan2" "0 and 0" "two values that are not both 0")
  (Atan2, [Quantity y, Quantity x]) -> Right (Quantity (atan2 y x))
  (Sqrt, [Quantity x])
    | x < 0 -> failing (OutOfRange region "sqrt" (Decimal.short 6 x) "values from 0 upwards")
    | otherwise -> Right (Quantity (sqrt x))
  (Abs, [Quantity x]) -> Right (Quantity (abs x))
  (Min, [Quantity a, Quantity b]) -> Right (Quantity (min a b))
  (Max, [Quantity a, Quantity b]) -> Right (Quantity (max a b))
  (Floor, [Quantity x]) -> Right (Quantity (fromInteger (floor x)))
  _ -> bug "a function applied to values of other types"
  where
    failing fact = Left (Error fact [])
    inverse name f x
      | abs x > 1 = failing (OutOfRange region name (Decimal.short 6 x) "values from −1 to 1")
      | otherwise = Right (Quantity (f x))

point :: Vec -> Point
point v = Vec.shift v (Vec.point 0 0)

-- | A checked number.
double :: Value -> Double
double v = case v of
  Quantity x -> x
  _ -> bug "a value that is no number where a number was checked"

-- | A checked point.
place :: Value -> Point
place v = case v of
  Spatial p -> point p
  _ -> bug "a value that is no point where a point was checked"
