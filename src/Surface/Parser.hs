-- | Tokens into the syntax tree.
--
-- A mistake ends the statement or the item of a block in which it stands; reading
-- goes on at the next one, so that one run finds them all.
module Surface.Parser
  ( parse,
  )
where

import Base.Region (Located (..), span)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Control.Monad (void)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Surface.Combinator
import Surface.Error (Error)
import Surface.Lexer qualified as Lexer
import Surface.Syntax
import Surface.Token (Token (..), Token_ (..))
import Text.Megaparsec ((<?>), (<|>))
import Text.Megaparsec qualified as Parsec
import Prelude hiding (span)

-- | Read a program. The output holds all that could be read.
parse :: Text -> Result w Error Program
parse text = Result {warnings = [], errors, output = Just Program {statements = Maybe.fromMaybe [] read', comments}}
  where
    (tokens, comments) = Lexer.tokens text
    (errors, read') = run program text tokens

-- Statements

program :: Parser [Statement]
program = Parsec.manyTill (recovering brokenStatement statement) Parsec.eof

statement :: Parser Statement
statement = located (statement_ <* endOfLine)

statement_ :: Parser Statement_
statement_ = do
  begin <- Parsec.lookAhead Parsec.anySingle
  case shape begin of
    Word "part" -> keyword "part" *> (Part <$> name <*> Parsec.optional (onThisLine title))
    Word "machine" -> keyword "machine" *> (Machine <$> (onThisLine (located machine) <?> "the name of a machine"))
    Word "tool" -> keyword "tool" *> (Tool <$> cutter)
    Word "feed" -> keyword "feed" *> (Feed <$> expr)
    Word "tolerance" -> keyword "tolerance" *> (Tolerance <$> expr)
    Word "from" -> keyword "from" *> (From <$> expr)
    Word "let" -> keyword "let" *> definition
    Word "contour" -> keyword "contour" *> contour
    Word "mill" -> keyword "mill" *> mill
    Word "rapid" -> keyword "rapid" *> (Travel . fmap rapidly <$> stops)
    Word "move" -> keyword "move" *> (Travel <$> stops)
    Word word -> Parsec.customFailure (NoStatement word)
    _ -> Parsec.empty <?> "a statement"

-- | Every stop of a @rapid@ statement is reached in rapid unless it says otherwise.
rapidly :: Stop -> Stop
rapidly stop = case pace stop of
  Cutting -> stop {pace = Rapid}
  Rapid -> stop
  AtFeed _ -> stop

title :: Parser (Located Text)
title = located (token "a text" textOf)
  where
    textOf t = case shape t of
      Text x -> Just x
      _ -> Nothing

machine :: Parser MachineRef
machine = token "the name of a machine" machineOf
  where
    machineOf t = case shape t of
      Word x -> Just (Named x)
      Text x -> Just (Described x)
      _ -> Nothing

-- | @mill(diameter 20 mm)@
cutter :: Parser Expr
cutter = keyword "mill" *> parens (keyword "diameter" *> expr)

definition :: Parser Statement_
definition = do
  what <- name
  parameters <- Parsec.optional (touching *> parens (name `sepBy1` ","))
  void (symbol "=")
  body <- expr
  pure (maybe (LetValue what body) (\ps -> LetFunction what ps body) parameters)

contour :: Parser Statement_
contour = do
  what <- name
  closure <- (Closed <$ keyword "closed") <|> (Open <$ keyword "open")
  Contour what closure <$> block ("the contour " <> quoted (value what)) BrokenItem item

item :: Parser Item_
item = repetition <|> element

repetition :: Parser Item_
repetition = do
  keyword "for"
  variable <- name
  keyword "in" <?> "‘in’"
  list <- expr
  For variable list <$> block "the repetition" BrokenItem item

element :: Parser Item_
element = Element <$> Parsec.optional (located walk) <*> expr <*> Parsec.optional (located link)
  where
    walk = (Clockwise <$ keyword "cw") <|> (CounterClockwise <$ keyword "ccw")

link :: Parser Link_
link =
  (keyword "meet" *> (Meet <$> Parsec.optional (keyword "near" *> expr)))
    <|> (Smooth <$ keyword "smooth")
    <|> (Tangent <$ keyword "tangent")
    <|> (keyword "fillet" *> Parsec.optional (symbol "+") *> (Fillet <$> expr))
    <|> (keyword "chamfer" *> (Chamfer <$> expr))

mill :: Parser Statement_
mill = do
  what <- expr
  side <- located (Parsec.choice [s <$ keyword k | (k, s) <- sides])
  Mill what side <$> block "the block of ‘mill’" (const BrokenSetting) setting
  where
    sides = [("outside", Outside), ("inside", Inside), ("left", LeftSide), ("right", RightSide), ("on", On)]

setting :: Parser Setting_
setting = (keyword "approach" *> (Approach <$> stops)) <|> (keyword "retract" *> (Retract <$> stops))

stops :: Parser (NonEmpty Stop)
stops = stop `sepBy1` ","
  where
    stop = Stop <$> expr <*> (Maybe.fromMaybe Cutting <$> Parsec.optional (onThisLine pace'))
    pace' = (Rapid <$ keyword "rapid") <|> (AtFeed <$> (keyword "feed" *> expr))

-- Expressions

expr :: Parser Expr
expr = chain (operators [("+", Add), ("-", Subtract)]) product'

product' :: Parser Expr
product' = chain (operators [("*", Multiply), ("/", Divide)]) factor

operators :: [(Text, Operator)] -> Parser Operator
operators table = Parsec.hidden (Parsec.choice [op <$ symbol s | (s, op) <- table])

-- | Operands joined by operators, from left to right.
chain :: Parser Operator -> Parser Expr -> Parser Expr
chain operator operand = operand >>= more
  where
    more left = (operator >>= \op -> operand >>= \right -> more (join op left right)) <|> pure left
    join op left right = Located (span (Region.region left) (Region.region right)) (Binary op left right)

factor :: Parser Expr
factor = Parsec.hidden (located (Negate <$> (symbol "-" *> nested factor))) <|> primary

primary :: Parser Expr
primary = (number <|> variableOrCall <|> pairOrGroup <|> list) <?> "a value"
  where
    number = located (token "a number" numberOf)
    numberOf t = case shape t of
      Number x unit -> Just (Literal x unit)
      _ -> Nothing
    list = located (List <$> brackets (Parsec.option [] (NonEmpty.toList <$> (expr `sepBy1` ","))))

variableOrCall :: Parser Expr
variableOrCall = located $ do
  what <- usedName
  arguments <- Parsec.optional (touching *> parens (expr `sepBy1` ","))
  pure (maybe (Variable (value what)) (Call what) arguments)

-- | Only if a parenthesis follows without a space.
touching :: Parser ()
touching = Parsec.hidden (void (Parsec.lookAhead (Parsec.satisfy (\t -> attached t && shape t == Symbol "("))))

-- | @(a)@ is a, @(a, b)@ a point or a vector.
pairOrGroup :: Parser Expr
pairOrGroup = do
  Located region (first, second) <- located (parens ((,) <$> expr <*> Parsec.optional (symbol "," *> expr)))
  pure (maybe first (Located region . Pair first) second)
