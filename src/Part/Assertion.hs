-- | Evaluation of the assertions of a program.
module Part.Assertion
  ( check,
    sizes,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Checked.Dimension (Dimension)
import Checked.Syntax (Argument (Given), Builtin (Distance, RadiusOf), Expr, Expr_ (Builtin))
import Checked.Syntax qualified as Checked
import Data.Text (Text)
import Geometry.Tolerance qualified as Tolerance
import Part.Builtin qualified as Builtin
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Part (AssertedSize (..))
import Part.Value (Value (..), fromOrigin)

-- | Evaluates an assertion and fails with a mistake if it does not hold. @at@ is the region of its
-- statement. In an equality the two numbers may differ by the tolerance that the program gives.
-- Without a tolerance they may differ by 10⁻⁶. They are compared in mm, radians and minutes, or as
-- plain numbers.
check :: Region -> Environment -> Checked.Assertion -> Eval ()
check at env assertion = case assertion of
  Checked.Holds e -> do
    v <- Expression.evaluate env e
    if Expression.isTrue v then pure () else Evaluation.mistake (DoesNotHold (region e) [])
  Checked.Compares d whole op l r -> do
    a <- Expression.evaluate env l
    b <- Expression.evaluate env r
    v <- Builtin.binary whole op a b
    let compared = [(region l, text d a), (region r, text d b)]
    if Expression.isTrue v then pure () else Evaluation.mistake (DoesNotHold whole compared)
  Checked.Agrees d l r within -> do
    a <- Expression.number <$> Expression.evaluate env l
    b <- Expression.number <$> Expression.evaluate env r
    slack <- maybe (pure 1e-6) (fmap Expression.number . Expression.evaluate env) within
    let left = (region l, written d a)
        right = (region r, written d b)
    if abs (a - b) <= slack + Tolerance.equal
      then pure ()
      else
        Evaluation.mistake
          (DoNotAgree at left right (written d (abs (a - b))) (written d slack))
  where
    written :: Dimension -> Double -> Text
    written d x = text d (Quantity x)
    text = Expression.written (Expression.textUnit env)

-- | Distances of points and radii of circles to which an equality gives values, one on each side at
-- most. The value is that of the other side.
sizes :: Environment -> Checked.Assertion -> Eval [AssertedSize]
sizes env assertion = case assertion of
  Checked.Agrees _ l r _ -> (<>) <$> sizeOf l r <*> sizeOf r l
  Checked.Compares {} -> pure []
  Checked.Holds _ -> pure []
  where
    sizeOf :: Expr -> Expr -> Eval [AssertedSize]
    sizeOf (Located _ e) other = case e of
      Builtin Distance [Given a, Given b] ->
        between <$> Expression.evaluate env a <*> Expression.evaluate env b <*> given other
      Builtin RadiusOf [Given c] -> radius <$> Expression.evaluate env c <*> given other
      _ -> pure []
    given other = Mm . Expression.number <$> Expression.evaluate env other
    between a b x = case (a, b) of
      (Spatial p, Spatial q) -> [AssertedDistance (fromOrigin p) (fromOrigin q) x]
      _ -> []
    radius c x = [AssertedRadius circle x | CircleValue circle <- [c]]
