-- | Tokens into the syntax tree.
--
-- A mistake ends the statement or the item of a block in which it stands; reading
-- goes on at the next one, so that one run finds them all.
module Surface.Parser
  ( parse,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..), span)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Control.Monad (void, when)
import Control.Monad.State.Strict (State, get, lift, modify', runState)
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe qualified as Maybe
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Surface.Error (Error, Found (..))
import Surface.Error qualified as Error
import Surface.Keyword qualified as Keyword
import Surface.Lexer qualified as Lexer
import Surface.Stream (Input (..))
import Surface.Syntax
import Surface.Token (Token (..), Token_ (..))
import Surface.Token qualified as Token
import Text.Megaparsec (ErrorItem (..), ParseError (..), ParsecT, (<?>), (<|>))
import Text.Megaparsec qualified as Parsec
import Prelude hiding (span)

type Failure = ParseError Input Problem

-- | Failures with words of their own.
data Problem
  = UnclosedBlock Region Text
  | NoStatement Text
  | NoName Text
  deriving stock (Eq, Ord, Show)

-- | What the parser remembers: the failures that it recovered from, and where the last token ended.
data Memory = Memory {failures :: [Failure], lastEnd :: Int}

type Parser = ParsecT Problem Input (State Memory)

-- | Read a program. The output holds all that could be read.
parse :: Text -> Result w Error Program
parse text = Result {warnings = [], errors = map (fromFailure (Vector.fromList ts) (Text.length text)) inOrder, output = Just Program {statements, comments}}
  where
    (ts, comments) = Lexer.tokens text
    (result, memory) = runState (Parsec.runParserT program "" (Input ts)) Memory {failures = [], lastEnd = 0}
    inOrder = sortOn Parsec.errorOffset (final <> failures memory)
    (statements, final) = case result of
      Right ss -> (ss, [])
      Left bundle -> ([], NonEmpty.toList (Parsec.bundleErrors bundle))

-- Statements

program :: Parser [Statement]
program = Parsec.manyTill (recovering brokenStatement statement) Parsec.eof

statement :: Parser Statement
statement = located $ do
  begin <- Parsec.lookAhead Parsec.anySingle
  case shape begin of
    Word "part" -> keyword "part" *> (Part <$> name <*> Parsec.optional (onThisLine title))
    Word "machine" -> keyword "machine" *> (Machine <$> located machine)
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
  parameters <- Parsec.optional (parens (name `sepBy1` ","))
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
    <|> (keyword "fillet" *> (Fillet <$> sign <*> product'))
    <|> (keyword "chamfer" *> (Chamfer <$> expr))
  where
    sign = (Minus <$ symbol "-") <|> (Plus <$ symbol "+") <|> pure Plus

mill :: Parser Statement_
mill = do
  what <- expr
  side <- located (Parsec.choice [s <$ keyword k | (k, s) <- sides])
  Mill what side <$> block "the block of ‘mill’" BrokenSetting setting
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
factor = located (Negate <$> (symbol "-" *> factor)) <|> primary

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
  what <- name
  arguments <- Parsec.optional (touching *> parens (expr `sepBy1` ","))
  pure (maybe (Variable (value what)) (Call what) arguments)
  where
    touching = Parsec.hidden (Parsec.lookAhead (Parsec.satisfy (\t -> attached t && shape t == Symbol "(")))

-- | @(a)@ is a, @(a, b)@ a point or a vector.
pairOrGroup :: Parser Expr
pairOrGroup = do
  Located region (first, second) <- located (parens ((,) <$> expr <*> Parsec.optional (symbol "," *> expr)))
  pure (maybe first (Located region . Pair first) second)

-- Blocks and brackets

-- | Items in braces. An item that can not be read is skipped.
block :: Text -> a -> Parser a -> Parser [Located a]
block what broken one = do
  opened <- symbol "{"
  items <- Parsec.many (notAtEnd *> recovering (brokenItem broken) (located one))
  closing opened what "}"
  pure items
  where
    notAtEnd = Parsec.notFollowedBy (void (Parsec.satisfy (\t -> shape t == Symbol "}" || beginsStatement t)) <|> Parsec.eof)

parens :: Parser a -> Parser a
parens = enclosed "(" ")"

brackets :: Parser a -> Parser a
brackets = enclosed "[" "]"

enclosed :: Text -> Text -> Parser a -> Parser a
enclosed open close inside = do
  opened <- symbol open
  x <- inside
  closing opened (quoted (Name open)) close
  pure x

-- | The closing bracket. When the program or the statement ends before it, the opening one is blamed.
closing :: Region -> Text -> Text -> Parser ()
closing opened what close = do
  next <- Parsec.optional (Parsec.lookAhead Parsec.anySingle)
  when (maybe True beginsStatement next) (Parsec.customFailure (UnclosedBlock opened what))
  void (symbol close)

sepBy1 :: Parser a -> Text -> Parser (NonEmpty a)
sepBy1 p separator = (:|) <$> p <*> Parsec.many (symbol separator *> p)

-- Tokens

-- | A token that the function accepts; the label names what was expected.
token :: Text -> (Token -> Maybe a) -> Parser a
token expected accept = do
  (t, a) <- Parsec.token (\t -> (t,) <$> accept t) Set.empty <?> Text.unpack expected
  lift (modify' (\m -> m {lastEnd = end (Token.place t)}))
  pure a

symbol :: Text -> Parser Region
symbol s = token ("‘" <> s <> "’") (\t -> if shape t == Symbol s then Just (Token.place t) else Nothing)

keyword :: Text -> Parser ()
keyword word = token ("‘" <> word <> "’") (\t -> if shape t == Word word then Just () else Nothing)

-- | A name that is no keyword.
name :: Parser (Located Name)
name = located $ do
  next <- Parsec.optional (Parsec.lookAhead Parsec.anySingle)
  case fmap shape next of
    Just (Word word) | Keyword.isReserved word && not (maybe False beginsStatement next) -> Parsec.customFailure (NoName word)
    _ -> token "a name" nameOf
  where
    nameOf t = case shape t of
      Word word | not (Keyword.isReserved word) -> Just (Name word)
      _ -> Nothing

-- | Only if the next token stands on the line of the last one.
onThisLine :: Parser a -> Parser a
onThisLine p = Parsec.hidden (Parsec.notFollowedBy (Parsec.satisfy newLine)) *> p

-- | With the region from the first to the last token.
located :: Parser a -> Parser (Located a)
located p = do
  Input input <- Parsec.getInput
  x <- p
  Memory {lastEnd} <- lift get
  let begin = case input of
        t : _ -> start (Token.place t)
        [] -> lastEnd
  pure (Located (Region begin (max begin lastEnd)) x)

-- Recovery

-- | Run a parser. If it fails, keep the failure and let the other, which is given the tokens from
-- the beginning, make something of it; at least one token is consumed either way.
recovering :: ([Token] -> Parser a) -> Parser a -> Parser a
recovering repair p = do
  begin <- Parsec.getOffset
  Input input <- Parsec.getInput
  Parsec.withRecovery (again begin input) p
  where
    again begin input failure = do
      lift (modify' (\m -> m {failures = failure : failures m}))
      now <- Parsec.getOffset
      when (now == begin) (void Parsec.anySingle)
      repair input

-- | Skip to the line on which a statement begins; keep its first word and the name it was to define.
brokenStatement :: [Token] -> Parser Statement
brokenStatement input = located (Broken begun defined <$ Parsec.skipMany (Parsec.satisfy (not . beginsStatement)))
  where
    begun = case input of
      Token {shape = Word word} : _ -> Just word
      _ -> Nothing
    defined = case input of
      Token {shape = Word word} : Token {shape = Word what, place = region} : _
        | word `elem` ["let", "contour"] && not (Keyword.isReserved what) -> Just (Located region (Name what))
      _ -> Nothing

-- | Skip to the next line of the block, or to its end.
brokenItem :: a -> [Token] -> Parser (Located a)
brokenItem broken _ = located (broken <$ skip 0)
  where
    skip :: Int -> Parser ()
    skip depth = do
      next <- Parsec.optional (Parsec.lookAhead Parsec.anySingle)
      case next of
        Nothing -> pure ()
        Just t
          | beginsStatement t -> pure ()
          | shape t == Symbol "{" -> Parsec.anySingle *> skip (depth + 1)
          | shape t == Symbol "}" -> when (depth > 0) (Parsec.anySingle *> skip (depth - 1))
          | newLine t && depth == 0 -> pure ()
          | otherwise -> Parsec.anySingle *> skip depth

beginsStatement :: Token -> Bool
beginsStatement t = case shape t of
  Word word -> newLine t && word `elem` Keyword.statements
  _ -> False

-- Failures into errors

fromFailure :: Vector.Vector Token -> Int -> Failure -> Error
fromFailure ts size failure = case failure of
  FancyError _ problems | Parsec.ErrorCustom problem : _ <- Set.toList problems -> case problem of
    UnclosedBlock opened what -> Error.Unclosed region opened what
    NoStatement word -> Error.UnknownStatement region word Keyword.statements
    NoName word -> Error.Reserved region word
  FancyError _ _ -> Error.Unexpected region found []
  TrivialError _ _ expected -> Error.Unexpected region found (concatMap wanted (Set.toList expected))
  where
    here = ts Vector.!? Parsec.errorOffset failure
    region = maybe (Region size size) Token.place here
    found = maybe FoundEnd (FoundToken . shape) here
    wanted expected' = case expected' of
      Label text -> [Text.pack (NonEmpty.toList text)]
      Parsec.Tokens _ -> []
      EndOfInput -> []

quoted :: Name -> Text
quoted (Name text) = "‘" <> text <> "’"
