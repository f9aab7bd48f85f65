-- | Infers the types of arithmetic and comparisons on quantities, points and vectors.
--
-- The functions yield 'True' if the operation is solved or reported as wrong. They yield 'False' if
-- too little is known of its operands; the operation then remains a deferred constraint. The
-- arguments @l@ and @r@ are the types of its operands, as far as inference has found them.
module Checked.Inference.Arithmetic
  ( solveArithmetic,
  )
where

import Base.Region (Region)
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..), UndefinedOperation (..))
import Checked.ErrorFix (unwritten)
import Checked.Inference.State
import Checked.Scheme (Arithmetic (..))
import Checked.Syntax (Operator (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type

-- | Solves an operation. 'False' if too little is known of its operands yet.
solveArithmetic :: Arithmetic -> Infer Bool
solveArithmetic a = do
  l <- resolved (snd (left a))
  r <- resolved (snd (right a))
  case (operator a, l, r) of
    (_, Wrong, _) -> solvedAs a Wrong
    (_, _, Wrong) -> solvedAs a Wrong
    (op, _, _) | isComparison op -> comparison a l r
    (Add, _, _) -> sumOrDifference a l r
    (Subtract, _, _) -> sumOrDifference a l r
    (Multiply, _, _) -> product' a l r
    (Divide, _, _) -> quotient a l r
    -- Only ‘and’ and ‘or’ remain, and "Checked.Expression" checks these without a constraint.
    _ -> solvedAs a Boolean

isComparison :: Operator -> Bool
isComparison op = op `elem` [Less, AtMost, Greater, AtLeast, Equal, Unequal]

-- | Solves a comparison. Its operands must be quantities of the same dimension.
comparison :: Arithmetic -> Type -> Type -> Infer Bool
comparison a l r = case (l, r) of
  (Variable _, Variable _) -> pure False
  _ -> do
    d <- freshDimension
    fits <-
      (&&)
        <$> unify (fst (left a)) (Quantity d) l
          <*> unify (fst (right a)) (Quantity d) r
    if fits then solvedAs a Boolean else disagree a l r

-- | Solves a sum or a difference. If one operand is unknown, it gets the kind of the other operand:
-- a quantity, or a point or vector.
sumOrDifference :: Arithmetic -> Type -> Type -> Infer Bool
sumOrDifference a l r = case (l, r) of
  (Quantity d, Quantity e) -> do
    same <- unifyDimensions (arithmeticRegion a) d e
    if same then solvedAs a (Quantity d) else disagree a l r
  (Spatial d, Spatial e)
    | operator a == Add -> solvedAs a (Spatial (Dimension.times d e))
    | otherwise -> solvedAs a (Spatial (ratio d e))
  (Variable _, Quantity d) -> unify (fst (left a)) l (Quantity d) *> solveArithmetic a
  (Quantity d, Variable _) -> unify (fst (right a)) r (Quantity d) *> solveArithmetic a
  (Variable _, Spatial _) -> spatial (fst (left a)) l
  (Spatial _, Variable _) -> spatial (fst (right a)) r
  (Variable _, Variable _) -> pure False
  _ -> disagree a l r
  where
    spatial region t = do
      d <- freshDimension
      _ <- unify region t (Spatial d)
      solveArithmetic a

-- | Solves a product: of two quantities, or of a plain number and a vector in either order.
product' :: Arithmetic -> Type -> Type -> Infer Bool
product' a l r = case (l, r) of
  (Quantity d, Quantity e) -> solvedAs a (Quantity (Dimension.times d e))
  (Quantity _, Spatial _) -> scaledVector a (leftRegion, l) (rightRegion, r)
  (Spatial _, Quantity _) -> scaledVector a (rightRegion, r) (leftRegion, l)
  (Variable _, Spatial _) -> scaledVector a (leftRegion, l) (rightRegion, r)
  (Spatial _, Variable _) -> scaledVector a (rightRegion, r) (leftRegion, l)
  (Variable _, Quantity _) -> pure False
  (Quantity _, Variable _) -> pure False
  (Variable _, Variable _) -> pure False
  _
    -- A minus sign is checked as a product of −1 and its operand. The factor −1 has the region of
    -- the whole term.
    | leftRegion == arithmeticRegion a ->
      undefinedFor a UndefinedNegation [(rightRegion, r)]
    | otherwise -> undefinedFor a UndefinedProduct [(leftRegion, l), (rightRegion, r)]
  where
    leftRegion = fst (left a)
    rightRegion = fst (right a)

-- | Solves a quotient: of two quantities, or of a vector and a plain number.
quotient :: Arithmetic -> Type -> Type -> Infer Bool
quotient a l r = case (l, r) of
  (Quantity d, Quantity e) -> solvedAs a (Quantity (ratio d e))
  (Spatial _, Quantity _) -> scaledVector a (rightRegion, r) (leftRegion, l)
  (Spatial _, Variable _) -> scaledVector a (rightRegion, r) (leftRegion, l)
  (Variable _, Quantity _) -> pure False
  (Quantity _, Variable _) -> pure False
  (Variable _, Variable _) -> pure False
  _ -> undefinedFor a UndefinedQuotient [(leftRegion, l), (rightRegion, r)]
  where
    leftRegion = fst (left a)
    rightRegion = fst (right a)

-- | Solves the product or quotient of a vector and a plain number. The first pair is the region and
-- the type of the number, the second pair those of the vector.
scaledVector :: Arithmetic -> (Region, Type) -> (Region, Type) -> Infer Bool
scaledVector a (numberRegion, factor) (vectorRegion, vector) = do
  isNumber <- unify numberRegion factor Type.number
  isVector <- unify vectorRegion vector Type.aVector
  if isNumber && isVector
    then solvedAs a Type.aVector
    else undefinedFor a operation [left a, right a]
  where
    operation = if operator a == Divide then UndefinedQuotient else UndefinedProduct

ratio :: Dimension -> Dimension -> Dimension
ratio d e = Dimension.times d (Dimension.power (-1) e)

-- | Solves an operation by the decision that its result has the type @t@. Yields 'True'.
solvedAs :: Arithmetic -> Type -> Infer Bool
solvedAs a t = True <$ equate (arithmeticRegion a) (outcome a) t

-- | Reports that an operation is not defined for the given operands. The result gets the type
-- 'Wrong', so that no further report follows.
undefinedFor :: Arithmetic -> UndefinedOperation -> [(Region, Type)] -> Infer Bool
undefinedFor a operation operands = do
  mistakeOnce [arithmeticRegion a] (NoOperation (arithmeticRegion a) operation operands)
  solvedAs a Wrong

-- | Reports that the types @l@ and @r@ of the operands do not fit a sum, a difference or a
-- comparison.
disagree :: Arithmetic -> Type -> Type -> Infer Bool
disagree a l r = do
  elsewhere <- decidedElsewhere [(leftRegion, leftType, l), (rightRegion, rightType, r)]
  mistakeOnce
    (arithmeticRegion a : map fst elsewhere)
    ( Disagree
        (arithmeticRegion a)
        (operator a)
        (leftRegion, l)
        (rightRegion, r)
        elsewhere
        (Just (unwritten, unwritten))
    )
  solvedAs a Wrong
  where
    (leftRegion, leftType) = left a
    (rightRegion, rightType) = right a
