-- | Values of the language while a program is evaluated, and the evaluation of expressions.
module Part.Expression
  ( Value (..),
    Environment (..),
    empty,
    bind,
    evaluate,
    number,
    point,
    isTrue,
    items,
    written,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.NumberTable qualified as NumberTable
import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Syntax (Argument (..), Expr, Expr_ (..), Operator (..))
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Vector qualified as Vector
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.Curve qualified as Exact
import Geometry.Polyarc qualified as Polyarc
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Builtin qualified as Builtin
import Part.Curve qualified as Curve
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Part (outline)
import Part.Value (Value (..))
import Part.Value qualified as Value

-- | The definitions so far. Names without a value depend on a mistake that is already reported.
data Environment = Environment
  { values :: Map Name Value,
    -- | with the local names where they were defined
    functions :: Map Name (Map Name Value, NonEmpty Name, Expr),
    locals :: Map Name Value
  }
  deriving stock (Show)

empty :: Environment
empty = Environment Map.empty Map.empty Map.empty

-- | With a name that is known only here.
bind :: Name -> Value -> Environment -> Environment
bind name v env = env {locals = Map.insert name v (locals env)}

-- | The value of an expression.
evaluate :: Environment -> Expr -> Eval Value
evaluate env (Located region e) =
  Evaluation.spend region 1 *> case e of
    Number x -> pure (Quantity x)
    Variable name ->
      maybe
        Evaluation.absent
        pure
        (firstOf (Map.lookup name (locals env)) (Map.lookup name (values env)))
    Apply name arguments -> case Map.lookup name (functions env) of
      Nothing -> Evaluation.absent
      Just (around, parameters, body) -> do
        vs <- traverse (evaluate env) arguments
        Evaluation.inCall
          region
          ( evaluate
              env
                { locals =
                    Map.union
                      (Map.fromList (zip (NonEmpty.toList parameters) (NonEmpty.toList vs)))
                      around
                }
              body
          )
    Builtin builtin arguments -> traverse argument arguments >>= Builtin.apply region builtin
    Negate inner -> evaluate env inner >>= Builtin.binary region Multiply (Quantity (-1))
    Not inner -> TruthValue . not . isTrue <$> evaluate env inner
    Binary And l r -> evaluate env l >>= \a -> if isTrue a then evaluate env r else pure a
    Binary Or l r -> evaluate env l >>= \a -> if isTrue a then pure a else evaluate env r
    Binary op l r -> do
      a <- evaluate env l
      b <- evaluate env r
      Builtin.binary region op a b
    Range low high step -> do
      a <- number <$> evaluate env low
      b <- number <$> evaluate env high
      by <- maybe (pure 1) (fmap number . evaluate env) step
      range a b by
    If c a b -> evaluate env c >>= \v -> evaluate env (if isTrue v then a else b)
    Pair x y -> do
      a <- numberOf x
      b <- numberOf y
      Value.spatial region (Vec.vec a b)
    Triple x y z -> do
      a <- number <$> evaluate env x
      b <- number <$> evaluate env y
      c <- number <$> evaluate env z
      Value.lifted region (Vec.point a b) (Mm c)
    List es -> ListValue . Vector.fromList <$> traverse (evaluate env) es
    Each inner name list -> do
      vs <- items <$> evaluate env list
      ListValue . Vector.fromList <$> traverse (\v -> evaluate (bind name v env) inner) vs
  where
    -- Most coordinates are numbers as they are written.
    numberOf x = case x of
      Located at (Number c) -> c <$ Evaluation.spend at 1
      _ -> number <$> evaluate env x
    firstOf a b = case a of
      Just _ -> a
      Nothing -> b
    argument a = case a of
      Given x -> Value.Plain <$> evaluate env x
      Chosen choice x -> Value.Choosing choice <$> evaluate env x
      Ranked rank -> pure (Value.Ranking rank)
    range a b by
      | by == 0 = Evaluation.mistake (StepOfZero region)
      | otherwise = do
        let count = floor ((b - a) / by + Tolerance.equal) + 1 :: Integer
        Evaluation.spend region (fromInteger (max 0 (min 100000000 count)))
        pure
          ( ListValue
              ( Vector.generate
                  (max 0 (fromInteger count))
                  (\k -> Quantity (a + fromIntegral k * by))
              )
          )

-- | A checked number.
number :: Value -> Double
number v = case v of
  Quantity x -> x
  _ -> bug "a value that is no number where a number was checked"

-- | A checked point.
point :: Value -> Point
point v = case v of
  Spatial p -> Value.place p
  _ -> bug "a value that is no point where a point was checked"

-- | A checked truth.
isTrue :: Value -> Bool
isTrue v = case v of
  TruthValue b -> b
  _ -> bug "a value that is neither true nor false where one was checked"

-- | The items of a checked list.
items :: Value -> [Value]
items v = case v of
  ListValue vs -> Vector.toList vs
  _ -> bug "a value that is no list where a list was checked"

-- | A value for a reader; the dimension is that of its quantities.
written :: Dimension -> Value -> Text
written dimension v = case v of
  Quantity x ->
    let unit = Dimension.unitWord dimension
     in Decimal.short 6 (x / Dimension.defaultUnit dimension)
          <> (if unit == "" then "" else " " <> unit)
  Spatial p -> Vec.written 4 (Value.place p)
  SpaceValue p (Mm z) -> Vec.written 4 p <> " at height " <> Decimal.mm (Mm z)
  TruthValue b -> if b then "true" else "false"
  CircleValue (Circle c r) -> "radius " <> Decimal.mm r <> " about " <> Vec.written 4 c
  LineValue (Line p q) -> "from " <> Vec.written 4 p <> " to " <> Vec.written 4 q
  ContourValue c -> "length " <> Decimal.mm (Polyarc.length (outline c))
  ListValue vs ->
    Decimal.whole (Vector.length vs) <> (if Vector.length vs == 1 then " item" else " items")
  PlacementValue _ -> ""
  TableValue t -> Decimal.whole (NumberTable.count (Curve.rows t)) <> " rows"
  CurveValue c -> "length " <> Decimal.mm (Exact.length (Curve.exact c))
