-- | Literals without units: the products in which they are plain numbers, and the numbers of
-- radians that would be taken for degrees.
module Checked.Inference.Literal
  ( numberType,
    plainFactor,
    radians,
  )
where

import Base.Quantity (LengthUnit)
import Base.Region (Located (..))
import Checked.Deferred (Deferred)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (unless, void, when)
import Surface.Syntax qualified as Surface
import Surface.SyntaxWalk qualified as SyntaxWalk
import Surface.Token (Unit)

-- | The type of a number of the program, and the number in the unit of checked programs, which may
-- depend on the solution of inference. If it has no unit, its dimension follows from its use, and
-- it is in the default unit of that dimension in a file with the unit @ofFile@.
numberType :: LengthUnit -> Double -> Maybe Unit -> Infer (Type, Deferred Double)
numberType ofFile x unit = case unit of
  Just u -> let (t, factor) = Type.ofUnit u in pure (t, const (x * factor))
  Nothing -> do
    d <- Inference.freshDimension
    -- A literal in the body of a function has the same unit in all calls of the function. The
    -- literal 0 needs none, because 0 is the same in every unit.
    unless (x == 0) (Inference.monomorphic d)
    pure (Type.Quantity d, \sol -> x * Dimension.defaultUnit ofFile (sol d))

-- | Decides that an operand of a product or a quotient is a plain number, if it consists of
-- literals without units and the other operand does not. A divisor of this kind is always a plain
-- number. A factor or a dividend is decided only if the other operand has a known dimension and is
-- not a plain number. So the 2 in @2 * a@ is a plain number if @a@ is an angle. But if @k@ is a
-- plain number, the 20 in @20 * k@ may have any dimension, for example that of a length.
plainFactor :: Surface.Operator -> (Surface.Expr, Type) -> (Surface.Expr, Type) -> Infer ()
plainFactor op (l, lt) (r, rt) = do
  lt' <- Inference.resolved lt
  rt' <- Inference.resolved rt
  when
    (hasNoUnit l && not (hasNoUnit r) && hasDimension rt')
    (void (Inference.unify (region l) Type.number lt))
  when
    (hasNoUnit r && not (hasNoUnit l) && (op == Surface.Divide || hasDimension lt'))
    (void (Inference.unify (region r) Type.number rt))
  where
    hasDimension t = case t of
      Type.Quantity d -> Dimension.isKnown d && d /= Dimension.none
      _ -> False

-- | True of an expression that consists only of literals without units.
hasNoUnit :: Surface.Expr -> Bool
hasNoUnit (Located _ e) = case e of
  Surface.Literal _ Nothing -> True
  Surface.Negate inner -> hasNoUnit inner
  Surface.Binary _ l r -> hasNoUnit l && hasNoUnit r
  _ -> False

-- | Reports a product of numbers without units and pi that is used as an angle: it is meant in
-- radians, but would be taken in degrees. The result is true if it was reported.
radians :: Type -> Surface.Expr -> Infer Bool
radians wanted e = do
  wanted' <- Inference.resolved wanted
  let isMeant = wanted' == Type.angle && SyntaxWalk.isRadians e
  when isMeant (Inference.mistake (RadiansWithoutUnit (region e)))
  pure isMeant
