-- | Numbers as they are written, without a unit: what they may be beside other terms, and where
-- they need no inference.
module Checked.Literal
  ( number,
    plainFactor,
    Call (..),
    call,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..))
import Checked.Builtin (Form (..))
import Checked.Builtin qualified as Builtin
import Checked.Deferred (Deferred, resolveAll)
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Piece (unitType)
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (void, when, zipWithM)
import Data.List.NonEmpty qualified as NonEmpty
import Surface.Syntax qualified as Surface
import Surface.Token (Numeral (..))

-- | A number as it is written where a quantity is needed whose dimension is known, or a pair of
-- such, without a detour by unknowns; a unit has to be one of it.
number :: Type -> Surface.Expr -> Maybe Checked.Expr
number wanted (Located at e) = case (e, wanted) of
  (Surface.Literal (Numeral _ x) Nothing, Type.Quantity d)
    | Dimension.isKnown d ->
      here (Checked.Number (x * Dimension.defaultUnit d))
  (Surface.Literal (Numeral _ x) (Just unit), Type.Quantity d)
    | (Type.Quantity own, factor) <- unitType unit,
      own == d ->
      here (Checked.Number (x * factor))
  (Surface.Negate inner, Type.Quantity _)
    | Just inner' <- number wanted inner ->
      here (Checked.Negate inner')
  (Surface.Pair x y, Type.Spatial d)
    | Dimension.isKnown d,
      Just x' <- number Type.len x,
      Just y' <- number Type.len y ->
      here (Checked.Pair x' y')
  _ -> Nothing
  where
    -- At once: put off, it would hold what it is made of.
    here found = Just $! Located at found

-- | A bare number beside something that has a dimension is a plain number: twice an angle is an
-- angle. So is one that divides. Beside a plain number it may be anything: @20 * k@ can be a
-- length, @4 * 4@ an area.
plainFactor :: Surface.Operator -> (Surface.Expr, Type) -> (Surface.Expr, Type) -> Infer ()
plainFactor op (l, lt) (r, rt) = do
  lt' <- Inference.resolved lt
  rt' <- Inference.resolved rt
  when
    (isBare l && not (isBare r) && hasDimension rt')
    (void (Inference.unify (region l) Type.number lt))
  when
    (isBare r && not (isBare l) && (op == Surface.Divide || hasDimension lt'))
    (void (Inference.unify (region r) Type.number rt))
  where
    hasDimension t = case t of
      Type.Quantity d -> Dimension.isKnown d && d /= Dimension.none
      _ -> False

-- | Whether an expression consists of bare numbers.
isBare :: Surface.Expr -> Bool
isBare (Located _ e) = case e of
  Surface.Literal _ Nothing -> True
  Surface.Negate inner -> isBare inner
  Surface.Binary _ l r -> isBare l && isBare r
  _ -> False

-- | A call whose type is known at once; whether the function has other forms.
data Call = Call {answer :: Type, overloaded :: Bool, checked :: Deferred Checked.Expr}

-- | A call of a function of the language with numbers and pairs as they are written, if only one of
-- its forms takes such, without a detour by unknowns. Its values are checked by the function given.
call :: (Type -> Surface.Expr -> Infer (Deferred Checked.Expr)) -> Surface.Expr -> Infer (Maybe Call)
call expect (Located at e) = case e of
  Surface.Call (Located place name@(Name text)) arguments
    | Just es <- traverse given (NonEmpty.toList arguments),
      Just kinds <- traverse kindOf es,
      Just builtin <- Builtin.lookup text,
      [(form, True)] <-
        filter
          (and . zipWith fits kinds . map Builtin.type' . parameters . fst)
          (Builtin.unlabelled builtin (length es)) ->
      do
        entry <- Inference.find name
        case entry of
          Just _ -> pure Nothing
          Nothing -> do
            Inference.mention place Nothing text (Inference.Described (Builtin.description builtin))
            let types = map Builtin.type' (parameters form)
                whole = Located at . Checked.Builtin builtin
            checked <- case zipWithM plain types es of
              Just arguments' -> let found = whole arguments' in found `seq` pure (const found)
              Nothing ->
                (\es' sol -> whole (resolveAll sol (map (Checked.Given .) es')))
                  <$> zipWithM expect types es
            pure
              ( Just
                  Call
                    { answer = Builtin.result form,
                      overloaded = Builtin.isOverloaded builtin,
                      checked
                    }
              )
  _ -> pure Nothing
  where
    given a = case a of
      Surface.Given x -> Just x
      Surface.Chosen _ _ -> Nothing
      Surface.Ranked _ -> Nothing
    plain wanted x = case number wanted x of
      Just x' -> Just $! Checked.Given x'
      Nothing -> Nothing

-- | What is plain to see of an expression: it is a quantity, of this dimension if that is plain
-- too, or a pair.
data Kind = Quantity (Maybe Dimension) | Pair

kindOf :: Surface.Expr -> Maybe Kind
kindOf (Located _ e) = case e of
  Surface.Literal _ unit -> Just (Quantity (Type.dimensionOf . fst . unitType <$> unit))
  Surface.Negate inner | Just (Quantity d) <- kindOf inner -> Just (Quantity d)
  Surface.Pair _ _ -> Just Pair
  _ -> Nothing

-- | Whether such an expression may be of a type.
fits :: Kind -> Type -> Bool
fits kind t = case (kind, t) of
  (_, Type.Variable _) -> True
  (Quantity (Just own), Type.Quantity d) -> own == d || not (Dimension.isKnown d)
  (Quantity Nothing, Type.Quantity _) -> True
  (Pair, Type.Spatial _) -> True
  _ -> False
