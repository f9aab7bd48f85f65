-- | Values for the parameters of a program that its user gives on the command line.
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

-- | Replaces the values of @param@ statements. Each value is a name and the text of an expression.
-- The last of several values for one name counts.
assign :: [(Text, Text)] -> Program -> Result w Error Program
assign values program = foldl' (\before v -> before >>= assignOne v) (pure program) values

assignOne :: (Text, Text) -> Program -> Result w Error Program
assignOne (name, text) program =
  case [at | Located at (Name n) <- parameters, n == name] of
    [] -> Result.failing [NoSuchParam name [n | Located _ (Name n) <- parameters]] program
    at : _ -> case Parser.parseExpr text of
      Result {errors = [], output = Just e} ->
        pure program {statements = map (withValue name (atRegion at e)) (statements program)}
      Result {errors} -> Result.failing [BadAssignment at name text (length errors)] program
  where
    parameters = [n | Located _ (Param n _) <- statements program]

-- | A statement with a new value if it is the parameter of the given name.
withValue :: Text -> Expr -> Statement -> Statement
withValue name e s = case s of
  Located at (Param n@(Located _ (Name n')) _) | n' == name -> Located at (Param n e)
  _ -> s

-- | An expression with all regions replaced by that of the parameter's name, since its own text is
-- not part of the program.
atRegion :: Region -> Expr -> Expr
atRegion at (Located _ e) = Located at $ case e of
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
    again = atRegion at

    argument a = case a of
      Given x -> Given (again x)
      Chosen (Located _ c) x -> Chosen (Located at c) (again x)
      Ranked (Located _ r) -> Ranked (Located at r)
