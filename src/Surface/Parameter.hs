-- | Values for the parameters of a program, which the user gives on the command line.
module Surface.Parameter
  ( assign,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..))
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.List (foldl')
import Data.Text (Text)
import Surface.Error (Error (..))
import Surface.Parser qualified as Parser
import Surface.Syntax
import Surface.Unlocated qualified as Unlocated

-- | Replaces the values of @param@ statements. Each pair in @values@ is the name of a parameter and
-- the text of its new expression. The last of several texts for one name counts. An unknown name
-- and a text with mistakes are errors and replace nothing. The new expression has the region of the
-- parameter's name, since the text of the expression is not part of the program.
assign :: [(Text, Text)] -> Program -> Result w Error Program
assign values program = foldl' (\before v -> before >>= assignOne v) (pure program) values

assignOne :: (Text, Text) -> Program -> Result w Error Program
assignOne (name, text) program =
  case [at | Located at (Name n) <- parameters, n == name] of
    [] -> Result.failing [NoSuchParam name [n | Located _ (Name n) <- parameters]] program
    at : _ -> case Parser.parseExpr text of
      Result {errors = [], output = Just e} ->
        let value = Unlocated.expressionAt at e
         in pure program {statements = map (withValue name value) (statements program)}
      Result {errors} -> Result.failing [BadAssignment at name text (length errors)] program
  where
    parameters = [n | Located _ (Param n _) <- statements program]

-- | The statement @s@ with the value @e@ if it defines the parameter @name@; otherwise unchanged.
withValue :: Text -> Expr -> Statement -> Statement
withValue name e s = case s of
  Located at (Param n@(Located _ (Name n')) _) | n' == name -> Located at (Param n e)
  _ -> s
