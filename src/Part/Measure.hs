-- | Evaluation of lengths, feeds and whole numbers, with checks of their limits.
module Part.Measure
  ( positive,
    lengthOf,
    notNegative,
    feedOf,
    whole,
  )
where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Located (..))
import Checked.Syntax (Expr)
import Control.Monad (when)
import Geometry.Tolerance qualified as Tolerance
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Parameter (LimitedQuantity, Range (FromTo), WholeNumber)
import Part.Parameter qualified as Parameter
import Part.Value qualified as Value

-- | A quantity above 0 and at most 'Tolerance.reach', made from its number by the function.
positive :: Environment -> LimitedQuantity -> (Double -> q) -> Expr -> Eval q
positive env parameter make e = do
  x <- Expression.number <$> Expression.evaluate env e
  if x <= 0
    then Evaluation.mistake (NotPositive (region e) parameter x)
    else make x <$ Value.within (region e) x

-- | A length above 0 and at most 'Tolerance.reach'.
lengthOf :: Environment -> LimitedQuantity -> Expr -> Eval Mm
lengthOf env parameter = positive env parameter Mm

-- | A length from 0 to 'Tolerance.reach'.
notNegative :: Environment -> LimitedQuantity -> Expr -> Eval Mm
notNegative env parameter e = do
  x <- Expression.number <$> Expression.evaluate env e
  when (x < 0) (Evaluation.mistake (Negative (region e) parameter x))
  Mm x <$ Value.within (region e) x

-- | A feed above 0, with the region of its expression.
feedOf :: Environment -> Expr -> Eval (Located Feed)
feedOf env e = Located (region e) <$> positive env Parameter.Feed Feed e

-- | A whole number from a lower to an upper limit, both included. Numbers within 'Tolerance.equal'
-- of a whole number are rounded to it.
whole :: Environment -> WholeNumber -> (Int, Int) -> Expr -> Eval Int
whole env what (low, high) e = do
  x <- Expression.number <$> Expression.evaluate env e
  let n = if abs x > 1e8 then -1 else round x :: Int
  when (abs (x - fromIntegral n) > Tolerance.equal || n < low || n > high) $
    Evaluation.mistake (NotWhole (region e) what (FromTo low high) x)
  pure n
