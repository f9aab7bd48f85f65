-- | Checks assertions.
module Checked.Assertion
  ( check,
  )
where

import Base.Region (Region (..), region, value)
import Checked.Deferred (Deferred)
import Checked.Error (Error (..))
import Checked.Expression (TypingEnvironment, expect, infer, operation)
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Syntax qualified as Checked
import Checked.Type qualified as Type
import Surface.Syntax qualified as Surface

-- | Checks an assertion. It is an inequality, an equality with an optional tolerance, or another
-- expression that is true or false. @within@ is the tolerance, which only an equality may have.
check ::
  TypingEnvironment ->
  Surface.Expr ->
  Maybe Surface.Expr ->
  Infer (Deferred Checked.Assertion)
check env e within = case (value e, within) of
  (Surface.Binary Surface.Equal l r, _) -> do
    (t, l', r') <- compared Surface.Equal l r
    kind <- Inference.resolved t
    -- If the left operand is not a quantity, 'compared' has reported it, unless its type is still
    -- unknown. In both cases the tolerance is checked against the type 'Wrong'. This type accepts
    -- every tolerance, so that there is no report on the tolerance.
    let toleranceType = case kind of
          Type.Quantity _ -> t
          _ -> Type.Wrong
    within' <- traverse (expect env toleranceType) within
    d <- Type.dimensionOf <$> Inference.resolved t
    pure (\sol -> Checked.Agrees (sol d) (l' sol) (r' sol) (($ sol) <$> within'))
  (Surface.Binary op l r, Nothing) | op `elem` inequalities -> do
    (t, l', r') <- compared op l r
    d <- Type.dimensionOf <$> Inference.resolved t
    pure (\sol -> Checked.Compares (sol d) (region e) op (l' sol) (r' sol))
  (_, Just d) -> do
    Inference.mistake
      ( WithinWithoutEquality
          (region d)
          (Region (end (region e)) (end (region d)))
          (betweenOperands e)
      )
    (Checked.Holds .) . snd <$> infer env e
  (_, Nothing) -> (Checked.Holds .) <$> expect env Type.Boolean e
  where
    compared op l r = do
      (lt, l') <- infer env l
      (rt, r') <- infer env r
      _ <- operation (region e) op (region l, lt) (region r, rt)
      pure (lt, l', r')
    betweenOperands x = case value x of
      Surface.Binary op l r
        | op `elem` inequalities ->
          Just (Region (end (region l)) (start (region r)))
      _ -> Nothing
    inequalities =
      [Surface.Less, Surface.AtMost, Surface.Greater, Surface.AtLeast, Surface.Unequal]
