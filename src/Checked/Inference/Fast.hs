-- | A fast version of type inference for literals and for calls whose arguments are literals.
--
-- Most terms of a large program are numbers, points and calls on them. Their types are visible from
-- their syntax, so this module checks them without unknowns. (An unknown is a type or a dimension
-- that inference has yet to find.) It gives the same terms, types and errors as
-- "Checked.Expression" would by full inference. All other terms are left to that module.
module Checked.Inference.Fast
  ( literal,
    FastCall (..),
    call,
    callType,
  )
where

import Base.Name (Name (..))
import Base.Quantity (LengthUnit)
import Base.Region (Located (..), Region)
import Checked.Builtin (Form (..))
import Checked.Builtin qualified as Builtin
import Checked.Deferred (Deferred, resolveAll)
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (zipWithM)
import Data.List.NonEmpty qualified as NonEmpty
import Surface.Syntax qualified as Surface
import Surface.Token (Numeral (..))

-- | Checks a literal, or a pair of literals, that must have the type @wanted@. A literal without a
-- unit gets the default unit of the wanted dimension in its file; @unitAt@ gives the unit of the
-- file at a region. 'Nothing' if the term contains anything else, if the wanted dimension is
-- unknown, or if the unit does not fit it. The caller then uses full inference.
literal :: (Region -> LengthUnit) -> Type -> Surface.Expr -> Maybe Checked.Expr
literal unitAt wanted (Located at e) = case (e, wanted) of
  (Surface.Literal (Numeral _ x) Nothing, Type.Quantity d)
    | Dimension.isKnown d ->
      here (Checked.Number (x * Dimension.defaultUnit (unitAt at) d))
  (Surface.Literal (Numeral _ x) (Just unit), Type.Quantity d)
    | (Type.Quantity ofUnit, factor) <- Type.ofUnit unit,
      ofUnit == d ->
      here (Checked.Number (x * factor))
  (Surface.Negate inner, Type.Quantity _)
    | Just inner' <- literal unitAt wanted inner ->
      here (Checked.Negate inner')
  (Surface.Pair x y, Type.Spatial d)
    | Dimension.isKnown d,
      Just x' <- literal unitAt Type.len x,
      Just y' <- literal unitAt Type.len y ->
      here (Checked.Pair x' y')
  _ -> Nothing
  where
    -- Evaluated at once: a thunk would keep the syntax tree in memory.
    here found = Just $! Located at found

-- | A call that was checked without full inference.
data FastCall = FastCall
  { resultType :: Type,
    -- | true if the function has several forms (lists of parameters), of which this call uses one
    isOverloaded :: Bool,
    checkedCall :: Deferred Checked.Expr
  }

-- | Checks a call of a built-in function on literals and pairs. These arguments must fit exactly
-- one form (list of parameters) of the function. The form must not have labels, which are words
-- such as @near@, and its types must not contain unknowns. Otherwise the result is 'Nothing', and
-- the caller uses full inference. @expect@ checks the arguments if one of them is a pair with other
-- terms than literals. @unitAt@ gives the unit of the file at a region.
call ::
  (Region -> LengthUnit) ->
  (Type -> Surface.Expr -> Infer (Deferred Checked.Expr)) ->
  Surface.Expr ->
  Infer (Maybe FastCall)
call unitAt expect (Located at e) = case e of
  Surface.Call (Located nameRegion name@(Name text)) arguments
    | Just es <- traverse given (NonEmpty.toList arguments),
      Just shapes <- traverse shapeOf es,
      Just builtin <- Builtin.lookup text,
      [(form, True)] <-
        filter
          (and . zipWith fits shapes . map Builtin.type' . parameters . fst)
          (Builtin.unlabelled builtin (length es)) ->
      do
        -- A definition of the program hides the built-in function of the same name.
        binding <- Inference.find name
        case binding of
          Just _ -> pure Nothing
          Nothing -> do
            Inference.mention
              nameRegion
              Nothing
              text
              (Inference.Described (Builtin.description builtin))
            checkedCall <- onForm unitAt expect (Located at . Checked.Builtin builtin) form es
            pure
              ( Just
                  FastCall
                    { resultType = Builtin.result form,
                      isOverloaded = Builtin.isOverloaded builtin,
                      checkedCall
                    }
              )
  _ -> pure Nothing
  where
    given a = case a of
      Surface.Given x -> Just x
      Surface.Chosen _ _ -> Nothing
      Surface.Ranked _ -> Nothing

-- | Checks the arguments @es@ against a form, and lets @build@ make the call from them. If
-- 'literal' accepts all arguments, the call is made at once. Otherwise @expect@ checks all of them.
onForm ::
  (Region -> LengthUnit) ->
  (Type -> Surface.Expr -> Infer (Deferred Checked.Expr)) ->
  ([Checked.Argument] -> Checked.Expr) ->
  Form ->
  [Surface.Expr] ->
  Infer (Deferred Checked.Expr)
onForm unitAt expect build form es = case zipWithM literalArgument types es of
  Just literals -> let found = build literals in found `seq` pure (const found)
  Nothing ->
    (\es' sol -> build (resolveAll sol (map (Checked.Given .) es'))) <$> zipWithM expect types es
  where
    types = map Builtin.type' (parameters form)
    literalArgument wanted x = case literal unitAt wanted x of
      Just x' -> Just $! Checked.Given x'
      Nothing -> Nothing

-- | The facts about the type of a term that its syntax shows. The dimension of a quantity is that
-- of the literal's unit, or 'Nothing' if the literal has no unit. A pair is a point or a vector.
data Shape = Quantity (Maybe Dimension) | Pair

shapeOf :: Surface.Expr -> Maybe Shape
shapeOf (Located _ e) = case e of
  Surface.Literal _ unit -> Just (Quantity (Type.dimensionOf . fst . Type.ofUnit <$> unit))
  Surface.Negate inner | Just (Quantity d) <- shapeOf inner -> Just (Quantity d)
  Surface.Pair _ _ -> Just Pair
  _ -> Nothing

-- | Can a term of this shape have the type @t@?
fits :: Shape -> Type -> Bool
fits shape t = case (shape, t) of
  (_, Type.Variable _) -> True
  (Quantity (Just own), Type.Quantity d) -> own == d || not (Dimension.isKnown d)
  (Quantity Nothing, Type.Quantity _) -> True
  (Pair, Type.Spatial _) -> True
  _ -> False

-- | The type of a call that this module has checked. If the function has several forms, the type
-- records that the region @at@ of the call decided it. A later error can then point there.
callType :: Region -> FastCall -> Infer Type
callType at c
  | isOverloaded c = Inference.freshDecided at (resultType c)
  | otherwise = pure (resultType c)
