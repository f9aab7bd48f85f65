-- | Numbers as they are written, without a unit: what they may be beside other terms, and where they need no inference.
module Checked.Bare
  ( number,
    plainFactor,
  )
where

import Base.Region (Located (..))
import Checked.Dimension qualified as Dimension
import Checked.Infer (Infer)
import Checked.Infer qualified as Infer
import Checked.Piece (unitType)
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (void, when)
import Surface.Syntax qualified as Surface
import Surface.Token (Numeral (..))

-- | A number as it is written where a quantity is needed whose dimension is known, without a detour by unknowns; a
-- unit has to be one of it.
number :: Type -> Surface.Expr -> Maybe Checked.Expr
number wanted (Located at e) = case (e, wanted) of
  (Surface.Literal (Numeral _ x) Nothing, Type.Quantity d) | Dimension.isKnown d -> Just (Located at (Checked.Number (x * Dimension.defaultUnit d)))
  (Surface.Literal (Numeral _ x) (Just unit), Type.Quantity d) | (Type.Quantity own, factor) <- unitType unit, own == d -> Just (Located at (Checked.Number (x * factor)))
  (Surface.Negate inner, Type.Quantity _) -> Located at . Checked.Negate <$> number wanted inner
  _ -> Nothing

-- | A bare number beside something that has a dimension is a plain number: twice an angle is an angle. So is
-- one that divides. Beside a plain number it may be anything: @20 * k@ can be a length, @4 * 4@ an area.
plainFactor :: Surface.Operator -> (Surface.Expr, Type) -> (Surface.Expr, Type) -> Infer ()
plainFactor op (l, lt) (r, rt) = do
  lt' <- Infer.known lt
  rt' <- Infer.known rt
  when (isBare l && not (isBare r) && hasDimension rt') (void (Infer.unify (region l) Type.number lt))
  when (isBare r && not (isBare l) && (op == Surface.Divide || hasDimension lt')) (void (Infer.unify (region r) Type.number rt))
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
