-- | Values for the parameters of a program, which the user gives on the command line.
module Surface.Parameter
  ( assign,
    inAssignment,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..))
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.List (foldl')
import Data.Text (Text)
import Report.Report (Report (..), ReportPlace (..))
import Report.Report qualified as Report
import Surface.Error (Error (..))
import Surface.Error qualified as Error
import Surface.FileUnit qualified as FileUnit
import Surface.Parser qualified as Parser
import Surface.Syntax
import Surface.Unlocated qualified as Unlocated

-- | Replaces the values of @param@ statements. Each pair in @values@ is the name of a parameter and
-- the text of its new expression. The last of several texts for one name counts. An unknown name
-- and a text with mistakes are errors and replace nothing. The new expression has the region of the
-- parameter's name, since the text of the expression is not part of the program. Its numbers
-- without a unit are in the unit of the program's own file, even if an imported file has the
-- parameter.
assign :: [(Text, Text)] -> Program -> Result w Error Program
assign values program = foldl' (\before v -> before >>= assignOne v) (pure program) values

assignOne :: (Text, Text) -> Program -> Result w Error Program
assignOne (name, text) program =
  case [at | Located at (Name n) <- parameters, n == name] of
    [] -> Result.failing [NoSuchParam name [n | Located _ (Name n) <- parameters]] program
    at : _ -> case Parser.parseExpr text of
      Result {errors = [], output = Just e} ->
        let value = Unlocated.expressionAt at e
            assigned = program {statements = map (withValue name value) (statements program)}
         in pure (FileUnit.withUnit (FileUnit.ofProgram program) at assigned)
      Result {errors} -> Result.failing [BadAssignment at name text (length errors)] program
  where
    parameters = [n | Located _ (Param n _) <- statements program]

-- | The report of an error in a value that the command line gives to a parameter. Such a report
-- points at the name of the parameter in the program: its title then names the assignment, and its
-- fixes are left to the words, since the program is not wrong. Any other report is unchanged.
inAssignment :: [(Text, Text)] -> Program -> Report -> Report
inAssignment values program report = case reverse given of
  (name, text) : _ ->
    report
      { title = "--set " <> name <> "=" <> text <> ": " <> title report,
        label = if label report == "" then "the parameter" else label report,
        hints = Report.remedies report <> [Error.valueHint name],
        fixes = []
      }
  [] -> report
  where
    given =
      [ value
        | Located _ (Param (Located region (Name n)) _) <- statements program,
          place report == InSource region,
          code report /= definedTwice,
          value <- values,
          fst value == n
      ]
    -- This error is about the name of the parameter.
    definedTwice = "E0203"

-- | The statement @s@ with the value @e@ if it defines the parameter @name@; otherwise unchanged.
withValue :: Text -> Expr -> Statement -> Statement
withValue name e s = case s of
  Located at (Param n@(Located _ (Name n')) _) | n' == name -> Located at (Param n e)
  _ -> s
