-- | Evaluates lengths, feeds, times and whole numbers, and checks their limits. 'Tolerance.reach'
-- is the largest coordinate or radius that a program may use.
module Part.Measure
  ( positive,
    lengthOf,
    notNegative,
    feedOf,
    secondsOf,
    whole,
  )
where

import Base.Quantity (Feed (..), Mm (..), Seconds (..))
import Base.Region (Located (..))
import Checked.Syntax (CutFeedExpr (..), Expr)
import Control.Monad (when)
import Geometry.Tolerance qualified as Tolerance
import Part.CutFeed (CutFeed (..), SpindleRate (..))
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Parameter (LimitedQuantity, Range (FromTo), WholeNumber)
import Part.Parameter qualified as Parameter
import Part.Value qualified as Value

-- | Evaluates a quantity that must be above 0. For every unit, the number of the quantity must not
-- exceed the number of mm in 'Tolerance.reach'. @parameter@ names the quantity in mistakes, and
-- @make@ turns the number into the result.
positive :: Environment -> LimitedQuantity -> (Double -> q) -> Expr -> Eval q
positive env parameter make e = do
  x <- Expression.number <$> Expression.evaluate env e
  if x <= 0
    then Evaluation.mistake (NotPositive (region e) parameter x)
    else make x <$ Value.within (region e) x

-- | Evaluates a length that must be above 0 and at most 'Tolerance.reach'. @parameter@ names it in
-- mistakes.
lengthOf :: Environment -> LimitedQuantity -> Expr -> Eval Mm
lengthOf env parameter = positive env parameter Mm

-- | Evaluates a length that must be from 0 to 'Tolerance.reach'. @parameter@ names it in mistakes.
notNegative :: Environment -> LimitedQuantity -> Expr -> Eval Mm
notNegative env parameter e = do
  x <- Expression.number <$> Expression.evaluate env e
  when (x < 0) (Evaluation.mistake (Negative (region e) parameter x))
  Mm x <$ Value.within (region e) x

-- | Evaluates a feed, which must be above 0 and within the limit of 'positive'. The result keeps
-- the region of the feed. How fast the spindle turns is not known here.
feedOf :: Environment -> CutFeedExpr -> Eval (Located CutFeed)
feedOf env f = case f of
  ForMinute e -> Located (region e) <$> positive env Parameter.Feed (PerMinute . Feed) e
  ForTurn at e ->
    Located at <$> positive env Parameter.TurnFeed (\x -> PerTurn (Mm x) NoRate) e

-- | Evaluates the time of a dwell in seconds, which must be above 0 and at most one hour.
secondsOf :: Environment -> Expr -> Eval Seconds
secondsOf env e = do
  t <- positive env Parameter.DwellTime Seconds e
  if t > longest then Evaluation.mistake (DwellTooLong (region e) longest) else pure t
  where
    longest = Seconds 3600

-- | Evaluates a whole number from @low@ to @high@, both included. A number within 'Tolerance.equal'
-- of a whole number is rounded to it. @what@ names the number in mistakes.
whole :: Environment -> WholeNumber -> (Int, Int) -> Expr -> Eval Int
whole env what (low, high) e = do
  x <- Expression.number <$> Expression.evaluate env e
  let n = if abs x > 1e8 then -1 else round x :: Int
  when (abs (x - fromIntegral n) > Tolerance.equal || n < low || n > high) $
    Evaluation.mistake (NotWhole (region e) what (FromTo low high) x)
  pure n
