-- | Values from outside for the parameters of a program.
module Surface.Parameter
  ( assign,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.List (foldl')
import Data.Text (Text)
import Surface.Error (Error (..))
import Surface.Parser qualified as Parser
import Surface.Syntax

-- | Give @param@ statements other values: names, and values as they would stand in the program. The
-- later of two values for one name counts.
assign :: [(Text, Text)] -> Program -> Result w Error Program
assign values program = foldl' (\before v -> before >>= one v) (pure program) values
  where
    one (name, text) before =
      case [at | Located _ (Param (Located at (Name n)) _) <- statements before, n == name] of
        [] ->
          Result.failing
            [NoSuchParam name [n | Located _ (Param (Located _ (Name n)) _) <- statements program]]
            before
        at : _ -> case Parser.parseExpr text of
          Result {errors = [], output = Just e} ->
            pure before {statements = map (replaced name (placed at e)) (statements before)}
          Result {errors} -> Result.failing [BadAssignment at name text (length errors)] before
    replaced name e s = case s of
      Located at (Param n@(Located _ (Name n')) _) | n' == name -> Located at (Param n e)
      _ -> s

-- | An expression from outside stands where the parameter's name stands.
placed :: Region -> Expr -> Expr
placed at (Located _ e) = Located at $ case e of
  Literal _ _ -> e
  Variable _ -> e
  Call (Located _ n) arguments -> Call (Located at n) (fmap argument arguments)
  Negate a -> Negate (again a)
  Not a -> Not (again a)
  Binary op a b -> Binary op (again a) (again b)
  Range a b c -> Range (again a) (again b) (fmap again c)
  If a b c -> If (again a) (again b) (again c)
  Pair a b -> Pair (again a) (again b)
  Triple a b c -> Triple (again a) (again b) (again c)
  List es -> List (map again es)
  Each a (Located _ n) b -> Each (again a) (Located at n) (again b)
  where
    again = placed at
    argument a = case a of
      Given x -> Given (again x)
      Chosen (Located _ c) x -> Chosen (Located at c) (again x)
      Ranked (Located _ r) -> Ranked (Located at r)
