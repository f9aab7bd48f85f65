-- | Checks expressions: resolves names, infers types, and converts units.
--
-- A function that checks an expression yields a 'Deferred' term, and often also its type. Such a
-- term is complete only when inference knows all dimensions of the program. It takes these
-- dimensions, the solution of inference, as an argument, here @sol@. An unknown is a type or a
-- dimension that inference has yet to find. A deferred constraint is an operation or a call whose
-- type is found later, when inference knows more types.
module Checked.Expression
  ( TypingEnvironment (..),
    expect,
    infer,
    fit,
    operation,
    repetition,
    isBuiltin,
    spatialPoint,
    contourElement,
    listOf,
  )
where

import Base.Name (Name (..))
import Base.Quantity (LengthUnit)
import Base.Region (Located (..), Region (..))
import Checked.ArithmeticReport qualified as ArithmeticReport
import Checked.Builtin (ArgumentLabel, Form (..))
import Checked.Builtin qualified as Builtin
import Checked.Call
  ( Call (..),
    argumentValues,
    byLikeness,
    fitsCount,
    labelChanges,
    labelOf,
    nearestForm,
    placeholders,
    pointFixes,
    unlabelled,
    withLabels,
  )
import Checked.CallReport (unwrittenCall)
import Checked.Column qualified as Column
import Checked.Deferred (Deferred, resolveAll)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.ErrorFix (unwritten)
import Checked.ErrorFix qualified as ErrorFix
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Inference.Fast qualified as FastInference
import Checked.Inference.List qualified as List
import Checked.Inference.Literal (numberType, plainFactor, radians)
import Checked.Scheme
  ( Arithmetic (..),
    Binding (..),
    DeferredConstraint (..),
    OverloadedCall (OverloadedCall),
    Scheme,
  )
import Checked.Scheme qualified as Scheme
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (unless, void, when, zipWithM, zipWithM_)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust)
import Data.Text (Text)
import Surface.Keyword qualified as Keyword
import Surface.Syntax qualified as Surface
import Surface.Token (Numeral (..), Unit (..))

-- | The facts about a program that are needed to check its expressions.
data TypingEnvironment = TypingEnvironment
  { -- | the names that the program and the blocks around the expression define, even those that
    -- they define only below it, each with the region of its definition
    definitions :: Map Name Region,
    -- | true if "Checked.Inference.Fast" checks literals and calls on literals, false if full
    -- inference checks them
    isFast :: Bool,
    -- | the unit of numbers without a unit in the file at a region
    unitAt :: Region -> LengthUnit
  }

-- | The type of a term, and the checked term.
type Typed = (Type, Deferred Checked.Expr)

-- Expressions of a wanted type

-- | Checks an expression that must have the type @wanted@.
expect :: TypingEnvironment -> Type -> Surface.Expr -> Infer (Deferred Checked.Expr)
expect env wanted e = case (value e, wanted) of
  _ | isFast env, Just e' <- FastInference.literal (unitAt env) wanted e -> pure (const e')
  (Surface.Pair x y, Type.Spatial d) | Dimension.isKnown d -> pair env (region e) x y
  _ -> do
    (t, e') <- infer env e
    fit wanted e t
    pure e'

-- | Requires that the expression @e@, whose type is @t@, has the type @wanted@. Reports a
-- difference.
fit :: Type -> Surface.Expr -> Type -> Infer ()
fit wanted e t = do
  isReported <- radians wanted e
  unless isReported (equal (region e) wanted t)

-- | Requires that @t@, the type of the term at the region @at@, is the type @wanted@. Reports a
-- difference.
equal :: Region -> Type -> Type -> Infer ()
equal at wanted t = void (isEqual at wanted t)

-- | Requires that @t@, the type of the term at the region @at@, is the type @wanted@. If the types
-- differ, the difference is reported and the result is 'False'.
isEqual :: Region -> Type -> Type -> Infer Bool
isEqual at wanted t = do
  found <- Inference.resolved t
  wanted' <- Inference.resolved wanted
  elsewhere <- Inference.decidedElsewhere [(at, t, found), (at, wanted, wanted')]
  same <- Inference.unify at wanted t
  unless
    same
    ( Inference.mistakeOnce
        (map fst elsewhere)
        (Mismatch at wanted' found elsewhere unwritten)
    )
  pure same

-- | Checks an expression that must be a point of the plane or a point with a height.
spatialPoint :: TypingEnvironment -> Surface.Expr -> Infer (Deferred Checked.Expr)
spatialPoint env e = do
  (t, e') <- infer env e
  t' <- Inference.resolved t
  unless (t' == Type.SpacePoint) (equal (region e) Type.aPoint t)
  pure e'

-- | Checks an element of a contour. A circle needs a sense. A line, a point, a curve or a contour
-- must not have one.
contourElement ::
  TypingEnvironment ->
  Maybe (Located Surface.Sense) ->
  Surface.Expr ->
  Infer Typed
contourElement env sense e = case (sense, value e) of
  (Nothing, Surface.Pair _ _) -> (Type.aPoint,) <$> expect env Type.aPoint e
  _ -> do
    (t, e') <- Inference.wrongIfTainted $ do
      found <- fastCall env e
      case found of
        Just c -> pure (FastInference.resultType c, FastInference.checkedCall c)
        Nothing -> infer env e
    t' <- Inference.resolved t
    case (t', sense) of
      (Type.Circle, Nothing) -> Inference.mistake (SenseMissing (region e))
      (Type.Circle, Just _) -> pure ()
      (Type.Line, Nothing) -> pure ()
      (Type.Contour, Nothing) -> pure ()
      (Type.Curve _, Nothing) -> pure ()
      (Type.Curve _, Just w) -> Inference.mistake (SenseUnneeded (region w) t')
      (Type.Spatial _, Nothing) -> equal (region e) Type.aPoint t
      (Type.Line, Just w) -> Inference.mistake (SenseUnneeded (region w) t')
      (Type.Contour, Just w) -> Inference.mistake (SenseUnneeded (region w) t')
      (Type.Spatial _, Just w) -> Inference.mistake (SenseUnneeded (region w) t')
      (Type.Variable _, Just _) -> equal (region e) Type.Circle t
      (Type.Wrong, _) -> pure ()
      _ -> Inference.mistake (NotAnElement (region e) t' unwritten)
    pure (t, e')

-- | Checks a call by "Checked.Inference.Fast". 'Nothing' if that module leaves the call to full
-- inference, or if 'isFast' is false.
fastCall :: TypingEnvironment -> Surface.Expr -> Infer (Maybe FastInference.FastCall)
fastCall env e =
  if isFast env then FastInference.call (unitAt env) (expect env) e else pure Nothing

-- Expressions whose type is inferred

-- | Checks an expression whose type is not known in advance, and infers its type. A mistake in a
-- part of a call or an operation makes the whole of it wrong.
infer :: TypingEnvironment -> Surface.Expr -> Infer Typed
infer env e = case value e of
  Surface.Call _ _ -> Inference.wrongIfTainted (inferred env e)
  Surface.Negate _ -> Inference.wrongIfTainted (inferred env e)
  Surface.Binary {} -> Inference.wrongIfTainted (inferred env e)
  Surface.If {} -> Inference.wrongIfTainted (inferred env e)
  Surface.Each {} -> Inference.wrongIfTainted (inferred env e)
  _ -> inferred env e

inferred :: TypingEnvironment -> Surface.Expr -> Infer Typed
inferred env located@(Located at e) = case e of
  Surface.Literal (Numeral _ x) unit -> do
    (t, number) <- numberType (unitAt env at) x unit
    pure (t, Located at . Checked.Number . number)
  Surface.Variable name -> variable env at name
  Surface.Call name arguments -> do
    found <- fastCall env located
    case found of
      Nothing -> call env at name arguments
      Just c -> (,FastInference.checkedCall c) <$> FastInference.callType at c
  Surface.Negate inner -> do
    (t, inner') <- infer env inner
    result <- operation at Surface.Multiply (at, Type.number) (region inner, t)
    pure (result, \sol -> Located at (Checked.Negate (inner' sol)))
  Surface.Not inner -> do
    inner' <- expect env Type.Boolean inner
    pure (Type.Boolean, \sol -> Located at (Checked.Not (inner' sol)))
  Surface.Binary op l r -> binary env at op l r
  Surface.Range low high step -> range env at low high step
  Surface.If c a b -> do
    c' <- expect env Type.Boolean c
    (t, a') <- infer env a
    b' <- expect env t b
    pure (t, \sol -> Located at (Checked.If (c' sol) (a' sol) (b' sol)))
  Surface.Pair x y -> do
    xy <- pair' env x y
    d <- Inference.freshDimension
    pure (Type.Spatial d, Located at . xy)
  Surface.Triple x y z -> do
    x' <- expect env Type.len x
    y' <- expect env Type.len y
    z' <- expect env Type.len z
    pure (Type.SpacePoint, \sol -> Located at (Checked.Triple (x' sol) (y' sol) (z' sol)))
  Surface.List es -> listOf env at Nothing es
  Surface.Each inner counter list -> do
    (t, columns, list') <- repetition env counter list
    (result, inner') <-
      Column.inScope columns (Inference.withLocals [(counter, t)] (infer env inner))
    pure
      ( Type.ListOf result,
        \sol -> Located at (Checked.Each (inner' sol) (value counter) (list' sol))
      )

-- | Checks a list at the region @at@. All items have one type, which is @needed@ if it is given.
listOf :: TypingEnvironment -> Region -> Maybe Type -> [Surface.Expr] -> Infer Typed
listOf env at needed es = do
  checked <- mapM (infer env) es
  t <- maybe Inference.freshType pure needed
  isFlat <- List.areFlat at needed (zip (map region es) (map fst checked))
  when isFlat (zipWithM_ (\e (t', _) -> fit t e t') es checked)
  pure (Type.ListOf t, \sol -> Located at (Checked.List (resolveAll sol (map snd checked))))

-- | Checks two expressions that must be lengths, and makes a point or vector of them. @at@ is the
-- region of the pair.
pair :: TypingEnvironment -> Region -> Surface.Expr -> Surface.Expr -> Infer (Deferred Checked.Expr)
pair env at x y = (Located at .) <$> pair' env x y

pair' :: TypingEnvironment -> Surface.Expr -> Surface.Expr -> Infer (Deferred Checked.Expr_)
pair' env x y = do
  x' <- expect env Type.len x
  y' <- expect env Type.len y
  pure (\sol -> Checked.Pair (x' sol) (y' sol))

-- | Checks an operation with two operands. @at@ is the region of the whole operation.
binary ::
  TypingEnvironment ->
  Region ->
  Surface.Operator ->
  Surface.Expr ->
  Surface.Expr ->
  Infer Typed
binary env at op l r
  | op `elem` [Surface.And, Surface.Or] = do
    l' <- expect env Type.Boolean l
    r' <- expect env Type.Boolean r
    pure (Type.Boolean, \sol -> Located at (Checked.Binary op (l' sol) (r' sol)))
  | otherwise = do
    (lt, l') <- infer env l
    (rt, r') <- divisor env op l r
    when (op `elem` [Surface.Multiply, Surface.Divide]) (plainFactor op (l, lt) (r, rt))
    result <- operation at op (region l, lt) (region r, rt)
    pure (result, \sol -> Located at (Checked.Binary op (l' sol) (r' sol)))

-- | Checks the right operand of an operation. In @60 mm / min@ it is the name of a function, and
-- the report says how the unit is written.
divisor :: TypingEnvironment -> Surface.Operator -> Surface.Expr -> Surface.Expr -> Infer Typed
divisor env op l r = case (op, value l, value r) of
  (Surface.Divide, Surface.Literal n (Just unit), Surface.Variable name@(Name word))
    | unit `elem` [Millimetre, Metre, Inch],
      word /= "min",
      word `elem` ArithmeticReport.unitDivisors -> do
      known <- Inference.find name
      case known of
        Nothing ->
          wrongTerm
            (region r)
            (UnknownUnit (Region (start (region l)) (end (region r))) n unit word Nothing)
        Just _ -> infer env r
  (Surface.Divide, Surface.Literal _ (Just unit), Surface.Variable (Name "min"))
    | unit `elem` [Millimetre, Metre, Inch] ->
      wrongTerm (region r) (FunctionAsValue (region r) (Name "min") [] (Just (end (region l))))
  _ -> infer env r

-- | Adds the deferred constraint of an operation on two operands, and yields the type of the
-- result. An operand is given by its region and its type.
operation :: Region -> Surface.Operator -> (Region, Type) -> (Region, Type) -> Infer Type
operation arithmeticRegion operator left right = do
  outcome <- Inference.freshType
  Inference.require (Operation Arithmetic {arithmeticRegion, operator, left, right, outcome})
  pure outcome

-- | Checks a range of numbers, @low@ to @high@. Without a step it consists of plain numbers. With a
-- step its limits and the step may have any dimension, which must be the same for all of them.
range ::
  TypingEnvironment ->
  Region ->
  Surface.Expr ->
  Surface.Expr ->
  Maybe Surface.Expr ->
  Infer Typed
range env at low high step = do
  t <- maybe (pure Type.number) (const (Type.Quantity <$> Inference.freshDimension)) step
  low' <- expect env t low
  high' <- expect env t high
  step' <- traverse (expect env t) step
  pure
    ( Type.ListOf t,
      \sol -> Located at (Checked.Range (low' sol) (high' sol) (($ sol) <$> step'))
    )

-- | Checks the variable and the list or table of a repetition. The result is the type of the
-- variable, the columns of the table with their types, and the checked list or table. Over a table
-- the variable is the point of a row.
repetition ::
  TypingEnvironment ->
  Located Name ->
  Surface.Expr ->
  Infer (Type, [(Located Text, Type)], Deferred Checked.Expr)
repetition env counter@(Located _ (Name text)) list = do
  when
    (isBuiltin text)
    ( Inference.mistake
        (NameTaken (region counter) (value counter) unwritten [])
    )
  (found, list') <- infer env list
  rows <- Column.ofRows found
  case rows of
    Just columns -> pure (Type.aPoint, columns, list')
    Nothing -> do
      t <- Inference.freshType
      found' <- Inference.resolved found
      isList <- isEqual (region list) (Type.ListOf t) found
      pure (if isList && found' /= Type.Wrong then t else Type.Wrong, [], list')

-- | Tells if this is the name of a function or a constant of the language that a program cannot
-- give to something else.
isBuiltin :: Text -> Bool
isBuiltin text = isJust (Builtin.lookup text) && not (Builtin.mayBeHidden text)

-- Names

-- | Checks a name that is used as a value.
variable :: TypingEnvironment -> Region -> Name -> Infer Typed
variable env at name@(Name text) = do
  binding <- Inference.find name
  case binding of
    Just (Value definedAt t) -> local definedAt t
    Just (Local definedAt t) -> local definedAt t
    Just (Function definedAt parameters scheme) -> do
      Inference.mention at (Just definedAt) text (Inference.Callable parameters scheme)
      wrongTerm at (FunctionAsValue at name [Builtin.callText text parameters] Nothing)
    Just (Poisoned _) -> wrong at <$ Inference.taint
    Nothing -> case Builtin.lookup text of
      Just builtin -> do
        Inference.mention at Nothing text (Inference.Described (Builtin.description builtin))
        unknowns <- freshUnknowns
        case Builtin.forms unknowns builtin of
          [Form [] t] -> pure (t, const (Located at (Checked.Builtin builtin [])))
          _ -> wrongTerm at (FunctionAsValue at name (Builtin.formTexts builtin) Nothing)
      Nothing -> unknownName env undefinedName at name >>= wrongTerm at
  where
    undefinedName region' name' known = UndefinedName region' name' (filter isValueWord known) []
    -- Names of functions cannot stand for values, nor words that begin statements.
    isValueWord word = case Builtin.lookup word of
      Just builtin -> Builtin.isConstant builtin
      Nothing -> word `notElem` Keyword.statements
    local definedAt t = do
      Inference.mention at (Just definedAt) text (Inference.Valued t)
      pure (t, const (Located at (Checked.Variable name)))

-- | The error for a name that is not in scope. The name is defined only below, or is used in its
-- own definition, or is not defined at all. @notDefined@ makes the error for the last case.
unknownName ::
  TypingEnvironment -> (Region -> Name -> [Text] -> Error) -> Region -> Name -> Infer Error
unknownName env notDefined at name = do
  names <- Inference.namesInScope
  pure $ case Map.lookup name (definitions env) of
    Just definedAt
      | start definedAt > start at -> UsedBeforeDefinition at name definedAt Nothing
      | otherwise -> Recursive at name
    Nothing ->
      notDefined at name ([text | Name text <- names] <> Builtin.names <> Keyword.reservedWords)

-- | A term that takes the place of a term that is reported as wrong.
wrong :: Region -> Typed
wrong at = (Type.Wrong, const (Located at (Checked.Number 0)))

-- | Reports a mistake in a term, and yields a term that takes its place.
wrongTerm :: Region -> Error -> Infer Typed
wrongTerm at e = wrong at <$ Inference.mistake e

-- | New unknowns for the types in the forms of a built-in function, for one call of it.
freshUnknowns :: Infer Builtin.Fresh
freshUnknowns = do
  d <- Inference.freshDimension
  t <- Inference.freshType
  pure Builtin.Fresh {Builtin.dimension = d, Builtin.anything = t}

-- Calls

-- | Checks a call of a function of the program or of the language.
call :: TypingEnvironment -> Region -> Located Name -> NonEmpty Surface.Argument -> Infer Typed
call env at callee@(Located nameRegion name@(Name text)) arguments = do
  binding <- Inference.find name
  case binding of
    Just (Function definedAt parameters scheme) -> do
      Inference.mention nameRegion (Just definedAt) text (Inference.Callable parameters scheme)
      functionCall env this parameters scheme
    Just (Value before _) -> wrongCall env this (noFunction (Just before))
    Just (Local before _) -> wrongCall env this (noFunction (Just before))
    Just (Poisoned _) -> wrong at <$ (checkArguments env this *> Inference.taint)
    Nothing -> case Builtin.lookup text of
      Just builtin
        | Builtin.isConstant builtin -> wrongCall env this (noFunction Nothing)
        | otherwise -> do
          Inference.mention
            nameRegion
            Nothing
            text
            (Inference.Described (Builtin.description builtin))
          builtinCall env this builtin
      Nothing -> unknownName env undefinedFunction nameRegion name >>= wrongCall env this
  where
    undefinedFunction r n known =
      UndefinedFunction r n (filter (`fitsCount` length arguments) known)
    noFunction before = NotAFunction nameRegion name before (length arguments)
    this = Call {callRegion = at, callee, written = NonEmpty.toList arguments}

-- | Reports the mistake @e@ in a call. Also checks the arguments, so that mistakes in them are
-- reported, too.
wrongCall :: TypingEnvironment -> Call -> Error -> Infer Typed
wrongCall env c e = wrong (callRegion c) <$ (checkArguments env c *> Inference.mistake e)

-- | Checks the arguments of a call that is reported as wrong. They may have any types.
checkArguments :: TypingEnvironment -> Call -> Infer ()
checkArguments env c = mapM_ (infer env) (argumentValues c)

-- | Checks a call of a function of the program. @parameters@ are the names of its parameters, for
-- reports.
functionCall :: TypingEnvironment -> Call -> [Text] -> Scheme -> Infer Typed
functionCall env c parameters scheme = do
  (types, t, constraints) <- Inference.instantiate at scheme
  case unlabelled c of
    Just es
      | length es == length types -> do
        checked <- checkedArguments env c (Builtin.callText text parameters) types es
        constraints
        pure
          ( if all fst checked then t else Type.Wrong,
            \sol ->
              Located at (Checked.Apply name (NonEmpty.fromList (map (($ sol) . snd) checked)))
          )
    _ ->
      wrongCall
        env
        c
        ( ArgumentCount
            at
            name
            (zip parameters (map ErrorFix.placeholder types))
            (map region (argumentValues c))
            []
            []
            unwrittenCall
        )
  where
    at = callRegion c
    name@(Name text) = value (callee c)

-- | Checks a call of a function of the language. A form is one list of parameters with the type of
-- the result. A form fits the labels of the call if its parameters have these labels. If no form
-- fits them, the call is reported. If only one form fits them, the arguments are checked against it
-- at once; but if the call has no labels, this is done only for a function with a single form. In
-- all other cases the call becomes a deferred constraint.
builtinCall :: TypingEnvironment -> Call -> Checked.Builtin -> Infer Typed
builtinCall env c builtin = do
  unknowns <- freshUnknowns
  let forms = Builtin.forms unknowns builtin
      isOnlyForm = null (drop 1 forms)
  case (Builtin.labelled unknowns builtin labels, forms, unlabelled c) of
    ([], [form], Just es) -> do
      types <- mapM (infer env) es >>= mapM (Inference.resolved . fst)
      wrongTerm
        at
        ( ArgumentCount
            at
            (value (callee c))
            (placeholders form)
            (map region es)
            []
            (pointFixes (Builtin.name builtin) (zip (map region es) types) forms)
            unwrittenCall
        )
    ([], _, _) -> noSuchCall env c builtin forms
    ([form], _, _) | isOnlyForm || any (/= Builtin.NoLabel) labels -> do
      checked <-
        checkedArguments
          env
          c
          (Builtin.formText builtin form)
          (valueTypes form)
          (argumentValues c)
      pure
        ( if all fst checked then Builtin.result form else Type.Wrong,
          term (map snd checked)
        )
    _ -> do
      checked <- mapM (infer env) (argumentValues c)
      t <- overloadedCall c builtin labels (map fst checked)
      pure (t, term (map snd checked))
  where
    at = callRegion c
    labels = map labelOf (written c)
    term values sol =
      Located at (Checked.Builtin builtin (withLabels (written c) (map ($ sol) values)))

-- | Reports a call that has the labels of none of the given forms.
noSuchCall :: TypingEnvironment -> Call -> Checked.Builtin -> [Form] -> Infer Typed
noSuchCall env c builtin forms = do
  types <- mapM (infer env) (argumentValues c) >>= mapM (Inference.resolved . fst)
  let points types' =
        concat
          [ pointFixes (Builtin.name builtin) (zip (map region es) types') forms
            | Just es <- [unlabelled c]
          ]
      isFitting = and . zipWith Inference.isCompatible types . valueTypes
      nearest es = (map region es, nearestForm (length es) forms)
  wrongTerm
    (callRegion c)
    ( NoSuchCall
        (callRegion c)
        (Builtin.name builtin)
        (map (Builtin.formText builtin) (byLikeness types forms))
        (labelChanges c (filter isFitting forms))
        (nearest <$> unlabelled c)
        []
        (points types)
    )

-- | The types of the parameters of a form that take a value.
valueTypes :: Form -> [Type]
valueTypes form =
  [Builtin.type' p | p <- Builtin.parameters form, Builtin.label p /= Builtin.Rank]

-- | Adds the deferred constraint of a call of a function with several forms, and yields the type of
-- its result. @types@ are the types of the arguments that have a value.
overloadedCall :: Call -> Checked.Builtin -> [ArgumentLabel] -> [Type] -> Infer Type
overloadedCall c builtin labels types = do
  callType <- Inference.freshType
  Inference.require
    ( Overloaded
        OverloadedCall
          { Scheme.callRegion = callRegion c,
            Scheme.builtin,
            Scheme.labels,
            Scheme.arguments = zip (map region (argumentValues c)) types,
            Scheme.callType
          }
    )
  pure callType

-- | Checks the arguments @es@ of a call, whose parameters have the given types. A flag is false if
-- its argument has another type, which is then reported. If two arguments are in the wrong order,
-- this is reported, with the right order as the call @form@.
checkedArguments ::
  TypingEnvironment ->
  Call ->
  Text ->
  [Type] ->
  [Surface.Expr] ->
  Infer [(Bool, Deferred Checked.Expr)]
checkedArguments env c form types es = do
  checked <- mapM (infer env) es
  found <- mapM (Inference.resolved . fst) checked
  case Inference.exchanged found types of
    Just order -> do
      let given = zip (map region es) found
      elsewhere <- Inference.decidedElsewhere (zip3 (map region es) (map fst checked) found)
      Inference.mistake (Swapped (callRegion c) (value (callee c)) given form order elsewhere)
      pure [(False, e') | (_, e') <- checked]
    Nothing ->
      zipWithM
        argument'
        types
        (zip es checked)
  where
    argument' wanted (e, (t, e')) = do
      isReported <- radians wanted e
      if isReported then pure (False, e') else (,e') <$> isEqual (region e) wanted t
