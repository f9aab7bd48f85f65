-- | Evaluates expressions, and knows the names that expressions use.
--
-- The compiler pass before this one has checked the types. A value of an unexpected type is
-- therefore a bug of partc.
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
    Turn (..),
    turnsOf,
    bindTurn,
    withColumns,
    written,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.NumberTable qualified as NumberTable
import Base.Quantity (LengthUnit (..), Mm (..))
import Base.Region (Located (..), Region)
import Base.Region qualified as Region
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Syntax (Argument (..), Expr, Expr_ (..), Operator (..))
import Control.Applicative ((<|>))
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
import Part.Part (polyarcOf)
import Part.PlaneRegion qualified as PlaneRegion
import Part.Value (Value (..))
import Part.Value qualified as Value

-- | The names that the statements before the present one define. If a name has no value here, the
-- reason is a mistake that is already reported.
data Environment = Environment
  { values :: Map Name Value,
    -- | for each function: the local names that were in scope at its definition, its parameters,
    -- its body
    functions :: Map Name (Map Name Value, NonEmpty Name, Expr),
    -- | the parameters of functions and the variables of repetitions
    locals :: Map Name Value,
    -- | the unit of lengths in the texts of 'written'
    textUnit :: LengthUnit
  }
  deriving stock (Show)

-- | The environment at the start of a program whose reports are in a unit, without any names.
empty :: LengthUnit -> Environment
empty = Environment Map.empty Map.empty Map.empty

-- | Binds a local name.
bind :: Name -> Value -> Environment -> Environment
bind name v env = env {locals = Map.insert name v (locals env)}

-- | The value of an expression. Every node of the expression takes one step, the unit of work that
-- "Part.Evaluation" counts.
evaluate :: Environment -> Expr -> Eval Value
evaluate env (Located region e) =
  Evaluation.spend region 1 *> case e of
    Number x -> pure (Quantity x)
    Variable name ->
      maybe Evaluation.absent pure (Map.lookup name (locals env) <|> Map.lookup name (values env))
    Apply name arguments ->
      maybe Evaluation.absent (call env region arguments) (Map.lookup name (functions env))
    Builtin builtin arguments -> do
      found <- traverse argument arguments
      Evaluation.withArguments (regionsOf arguments) (Builtin.apply region builtin found)
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
      range region a b by
    If c a b -> evaluate env c >>= \v -> evaluate env (if isTrue v then a else b)
    Pair x y -> do
      a <- coordinate env x
      b <- coordinate env y
      Value.spatial region (Vec.vec a b)
    Triple x y z -> do
      a <- number <$> evaluate env x
      b <- number <$> evaluate env y
      c <- number <$> evaluate env z
      Value.lifted region (Vec.point a b) (Mm c)
    List es -> ListValue . Vector.fromList <$> traverse (evaluate env) es
    Each inner name list -> do
      turns <- evaluate env list >>= turnsOf (Region.region list)
      ListValue . Vector.fromList
        <$> traverse (\turn -> evaluate (bindTurn name turn env) inner) turns
  where
    argument a = case a of
      Given x -> Value.Plain <$> evaluate env x
      Chosen choice x -> Value.Choosing choice <$> evaluate env x
      Ranked rank -> pure (Value.Ranking rank)

-- | The regions of the arguments of a built-in function, without @first@ and @last@.
regionsOf :: [Argument] -> [Region]
regionsOf = concatMap regionOf
  where
    regionOf a = case a of
      Given (Located at _) -> [at]
      Chosen _ (Located at _) -> [at]
      Ranked _ -> []

-- | Calls a function of the program. The last argument is the function: the local names that were
-- in scope at its definition, its parameters, and its body. The body sees these names and the
-- values of @arguments@. @region@ is that of the call, for mistakes.
call ::
  Environment ->
  Region ->
  NonEmpty Expr ->
  (Map Name Value, NonEmpty Name, Expr) ->
  Eval Value
call env region arguments (definitionLocals, parameters, body) = do
  vs <- traverse (evaluate env) arguments
  let given = Map.fromList (zip (NonEmpty.toList parameters) (NonEmpty.toList vs))
  Evaluation.inCall region (evaluate env {locals = Map.union given definitionLocals} body)

-- | The number of a coordinate, in mm. Most coordinates are literals. The number of a literal is
-- taken directly, because a call of 'evaluate' is slower.
coordinate :: Environment -> Expr -> Eval Double
coordinate env x = case x of
  Located at (Number c) -> c <$ Evaluation.spend at 1
  _ -> number <$> evaluate env x

-- | The list of the numbers @a@, @a + by@, @a + 2·by@ and so on, up to @b@. It includes @b@ if a
-- step reaches it. The list is empty if the steps lead away from @b@. Fails if @by@ is 0.
range :: Region -> Double -> Double -> Double -> Eval Value
range region a b by
  | by == 0 = Evaluation.mistake (StepOfZero region)
  | otherwise = do
    let count = floor ((b - a) / by + Tolerance.equal) + 1 :: Integer
        item k = Quantity (a + fromIntegral k * by)
    Evaluation.spend region (fromInteger (max 0 (min 100000000 count)))
    pure (ListValue (Vector.generate (max 0 (fromInteger count)) item))

-- | Takes the number out of a value that the type checker knows to be a number.
number :: Value -> Double
number v = case v of
  Quantity x -> x
  _ -> bug "a value that is no number where a number was checked"

-- | Takes the point out of a value that the type checker knows to be a point of the plane.
point :: Value -> Point
point v = case v of
  Spatial p -> Value.fromOrigin p
  _ -> bug "a value that is no point where a point was checked"

-- | Takes the truth value out of a value that the type checker knows to be true or false.
isTrue :: Value -> Bool
isTrue v = case v of
  TruthValue b -> b
  _ -> bug "a value that is neither true nor false where one was checked"

-- | Takes the items out of a value that the type checker knows to be a list.
items :: Value -> [Value]
items v = case v of
  ListValue vs -> Vector.toList vs
  _ -> bug "a value that is no list where a list was checked"

-- | One turn of a repetition: the value of its variable, and those of the columns of a table. Over
-- a table the variable is the point of a row.
data Turn = Turn {self :: Value, columns :: [(Name, Double)]}

-- | The turns of a repetition over a value that the type checker knows to be a list or a table.
-- @region@ is that of the value, for mistakes.
turnsOf :: Region -> Value -> Eval [Turn]
turnsOf region v = case v of
  TableValue t -> traverse (uncurry (ofRow t)) (zip [0 ..] (Vector.toList (Curve.points t)))
  _ -> pure [Turn {self, columns = []} | self <- items v]
  where
    ofRow t k p = do
      self <- Value.spatial region (Value.offset p)
      pure Turn {self, columns = Curve.columnsAt t k}

-- | Binds the variable @name@ of a repetition and the columns to their values in one turn.
bindTurn :: Name -> Turn -> Environment -> Environment
bindTurn name turn env = bind name (self turn) (withColumns (columns turn) env)

-- | Binds the columns of a table's row to their values.
withColumns :: [(Name, Double)] -> Environment -> Environment
withColumns found env = foldl (\e (name, x) -> bind name (Quantity x) e) env found

-- | The text of a value, for editors and reports, in which lengths have the unit @inUnit@.
-- @dimension@ is that of the numbers in the value and decides the unit of a number. The text is
-- empty for a transformation.
written :: LengthUnit -> Dimension -> Value -> Text
written inUnit dimension v = case v of
  Quantity x -> numberText (x / Dimension.defaultUnit inUnit dimension) <> word
  Spatial p -> place (Value.fromOrigin p)
  SpaceValue p z -> place p <> " at height " <> Decimal.inUnit inUnit z
  TruthValue b -> if b then "true" else "false"
  CircleValue (Circle c r) -> "radius " <> Decimal.inUnit inUnit r <> " about " <> place c
  LineValue (Line p q) -> "from " <> place p <> " to " <> place q
  ContourValue c -> "length " <> Decimal.inUnit inUnit (Polyarc.length (polyarcOf c))
  RegionValue r -> "area " <> written inUnit area (Quantity (PlaneRegion.area r))
  ListValue vs ->
    Decimal.whole (Vector.length vs) <> (if Vector.length vs == 1 then " item" else " items")
  PlacementValue _ -> ""
  OperationValue _ -> ""
  TableValue t -> Decimal.whole (NumberTable.count (Curve.rows t)) <> " rows"
  CurveValue c -> "length " <> Decimal.inUnit inUnit (Exact.length (Curve.exact c))
  where
    area = Dimension.power 2 (Dimension.atom Dimension.Length)
    place = Vec.toText inUnit 4
    word = case Dimension.unitWord inUnit dimension of
      "" -> ""
      name -> " " <> name
    -- The smallest differences that count in mm need more decimals in inches.
    numberText x
      | Dimension.unitWord inUnit dimension == Dimension.unitWord Millimetres dimension =
        Decimal.short 6 x
      | Decimal.short 7 x == "0" = Decimal.short 9 x
      | otherwise = Decimal.short 7 x
