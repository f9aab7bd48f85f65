-- | The parser: the syntax tree of a program from its text.
--
-- A text is parsed by the fast parser first. If the fast parser finds a mistake, the explaining
-- parser parses the text again and reports all mistakes. An offset is the index of a character,
-- from 0; the count goes on from one file of a program to the next.
module Surface.Parser
  ( parse,
    parseExplained,
    parseExpr,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (ReportPlace (..))
import Report.Report qualified as Report
import Surface.Combinator (run)
import Surface.CommentLine qualified as CommentLine
import Surface.Error (Error)
import Surface.Error qualified as Error
import Surface.FileUnit qualified as FileUnit
import Surface.Foreign (ForeignLine, ForeignText)
import Surface.Foreign qualified as Foreign
import Surface.Grammar qualified as Grammar
import Surface.Lexer qualified as Lexer
import Surface.Parser.Fast qualified as FastParser
import Surface.StatementRepair qualified as StatementRepair
import Surface.Syntax
import Surface.Token (Token (place, shape), Token_ (..))
import Surface.Token qualified as Token

-- | Parses a program whose text begins at the offset @begin@. The output holds all statements,
-- those with mistakes as broken nodes. There is no output if the text has more than 'maxTokens'
-- tokens.
parse :: Int -> Text -> Result w Error Program
parse begin text =
  maybe
    (parseExplained begin text)
    (Result [] [] . Just)
    (FastParser.parse maxTokens begin text)

-- | Parses a program by the explaining parser alone. Gives the same result as 'parse'; tests
-- compare the two results.
parseExplained :: Int -> Text -> Result w Error Program
parseExplained begin text = case drop maxTokens tokens of
  t : _ ->
    Result {warnings = [], errors = [Error.TooLong (Token.place t) maxTokens], output = Nothing}
  [] -> case Foreign.recognise begin text (Maybe.mapMaybe regionOf errors) of
    Nothing -> case CommentLine.find tokens (map fst (Maybe.mapMaybe Error.failureOf errors)) of
      Nothing ->
        Result
          { warnings = [],
            errors,
            output = Just (FileUnit.program begin (Maybe.fromMaybe [] parsed) comments)
          }
      Just found -> withoutBrackets begin text found
    Just found -> withoutForeign begin text found
  where
    (tokens, comments) = Lexer.tokens begin text
    (errors, parsed) = explained begin text tokens
    regionOf e = case Report.place (Error.toReport e) of
      InSource region -> Just region
      InTape _ -> Nothing
      InFile -> Nothing
      InCommandLine -> Nothing

-- | Parses a text without the lines of another language, for which there is one report. Each of
-- these lines becomes a broken statement.
withoutForeign :: Int -> Text -> ForeignText -> Result w Error Program
withoutForeign begin text found =
  Result
    { warnings = [],
      errors =
        Error.ForeignLines
          (Foreign.place (NonEmpty.head ls))
          (Foreign.language found)
          ls :
        errors,
      output =
        Just
          ( FileUnit.program
              begin
              (sortOn region (Maybe.fromMaybe [] parsed <> map broken (NonEmpty.toList ls)))
              comments
          )
    }
  where
    ls = Foreign.lines' found
    (tokens, comments) = Lexer.tokens begin (Foreign.blanked begin text found)
    (errors, parsed) = explained begin text tokens

-- | Parses a text without comments in round brackets, which are lines at regions.
withoutBrackets :: Int -> Text -> NonEmpty Region -> Result w Error Program
withoutBrackets begin text found = rest {errors = Error.merged (ownErrors <> errors rest)}
  where
    rest = parseExplained begin (foldl blank text found)
    ownErrors = [Error.BracketComment r (inner r) | r <- NonEmpty.toList found]
    inner (Region from to) =
      Text.strip (Text.take (to - from - 2) (Text.drop (from - begin + 1) text))
    blank t (Region from to) =
      let (kept, after) = Text.splitAt (from - begin) t
       in kept <> Text.replicate (to - from) " " <> Text.drop (to - from) after

-- | The errors of a program with the repairs of its statements, and the program. @text@ begins at
-- the offset @begin@ and has the given tokens.
explained :: Int -> Text -> [Token] -> ([Error], Maybe [Statement])
explained begin text tokens = (Error.merged (map (renaming . mended) errors), parsed)
  where
    (errors, parsed) = run Grammar.explainedProgram (begin + Text.length text) tokens
    mended = Error.withRepairs $ \region expected ->
      let (statement, index) = StatementRepair.statementAround tokens region
       in if null expected && map shape (take 1 statement) == [Word "table"]
            then StatementRepair.transposed statement
            else StatementRepair.repairs trial statement index expected
    renaming e = case e of
      Error.Reserved region word free mends
        | null mends ->
          Error.Reserved region word free (StatementRepair.renamed tokens region word free)
      _ -> e

-- | Parses the tokens of one statement. Gives the indices of the tokens at which parsing fails,
-- each with the expected tokens in words.
trial :: StatementRepair.Trial
trial tokens =
  [ (start failed `div` 2, expected)
    | Just (failed, expected) <- map Error.failureOf errors
  ]
  where
    -- The token with the index k has the region from 2 k to 2 k + 1.
    errors =
      fst
        ( run
            Grammar.explainedProgram
            (2 * length tokens)
            (zipWith (\k t -> t {place = Region (2 * k) (2 * k + 1)}) [0 ..] tokens)
        )

-- | Broken statement in place of a line of another language. It has the keyword and the name of the
-- statement that says the same.
broken :: ForeignLine -> Statement
broken l = Located (Foreign.place l) $ case Text.words (Foreign.translation l) of
  "let" : name : _ ->
    Broken
      (Just "let")
      (Just (Located (Foreign.place l) (Name (Text.takeWhile (/= '(') name))))
  keyword : _ -> Broken (Just keyword) Nothing
  [] -> Broken Nothing Nothing

-- | The largest number of tokens that a program may have.
maxTokens :: Int
maxTokens = 6000000

-- | Parses a text that is one expression, such as a value from the command line. The first
-- character of the text has the offset 0.
parseExpr :: Text -> Result w Error Expr
parseExpr text = Result {warnings = [], errors, output}
  where
    (errors, output) =
      run Grammar.explainedExpression (Text.length text) (fst (Lexer.tokens 0 text))
