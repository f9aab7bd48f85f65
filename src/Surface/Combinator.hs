{-# LANGUAGE ConstraintKinds #-}
{-# LANGUAGE FlexibleContexts #-}
{-# LANGUAGE FlexibleInstances #-}
{-# LANGUAGE RankNTypes #-}

-- | What the grammar is built from: tokens, names, brackets, blocks, and the way on after a
-- mistake.
--
-- There is one grammar and two readers of it: this module has the one that tells what is wrong and
-- goes on behind it; "Surface.Combinator.Fast" has the one that gives up.
module Surface.Combinator
  ( Parser,
    Grammar (..),
    ParserState (..),
    Consumed (..),
    Problem (..),
    run,

    -- * Tokens
    symbol,
    isSymbol,
    keyword,
    name,
    usedName,
    onThisLine,
    endOfLine,
    located,
    quoted,

    -- * Brackets
    parens,
    brackets,
    block,
    statementBlock,
    sepBy1,
    nested,
    maxNesting,

    -- * Recovery
    recovering,
    brokenStatement,
  )
where

import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Control.Monad (void, when)
import Control.Monad.State.Strict (State, get, lift, modify', runState)
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Surface.Error (Error, FoundText (..))
import Surface.Error qualified as Error
import Surface.Keyword qualified as Keyword
import Surface.Syntax (Expr, Statement, Statement_ (..))
import Surface.Token (Token (..), Token_ (..))
import Surface.Token qualified as Token
import Surface.TokenStream (Input (..))
import Text.Megaparsec (ErrorItem (..), MonadParsec, ParseError (..), ParsecT, (<?>))
import Text.Megaparsec qualified as Parsec

type Failure = ParseError Input Problem

-- | Failures with words of their own.
data Problem
  = UnclosedBlock Region Text
  | -- | a word that begins no statement
    NoStatement Text
  | -- | a keyword where a name is to be given
    NoName Text
  | -- | something behind a complete statement
    TextAfterStatement Token_
  | -- | something in a row of a table that is no cell
    NotInRow Token_
  | -- | something among the names of columns that is none
    NotInHeadings Token_
  | -- | a piece of which nothing says on which side of its curve it lies
    NoSide
  | -- | a statement in a block
    Misplaced Text
  | -- | brackets with more than three values
    ManyCoordinates Region
  | TooDeep
  deriving stock (Eq, Ord, Show)

-- | What the parser remembers: the failures that it recovered from, where the last token ended, and
-- how many brackets are open; how many blocks of statements the statement at hand stands in;
-- whether the rest is not read.
data ParserState = ParserState
  { failures :: [Failure],
    lastEnd :: Int,
    bracketDepth :: Int,
    blockDepth :: Int,
    hasGivenUp :: Bool
  }

-- | What is made of some tokens, no more than two brackets deep; how many they are, and those
-- behind them.
data Consumed a = Consumed a Int [Token]

-- | What the grammar is written in.
class MonadParsec Problem Input p => Grammar p where
  -- | A token that the function accepts; the label names what was expected.
  token :: Text -> (Token -> Maybe a) -> p a

  -- | As many as there are.
  zeroOrMore :: p a -> p [a]

  -- | What is made of a mistake in a parser.
  onFailure :: (ParseError Input Problem -> p a) -> p a -> p a

  -- | What is left to read.
  remaining :: p [Token]

  -- | What a function makes of the next tokens, if it knows them all, or else the other way, which
  -- would make the same of them. The reader that tells what is wrong goes this way always.
  fastPath :: ([Token] -> Maybe (Consumed Expr)) -> p Expr -> p Expr

  -- | Whether the next token is a word, so that what begins with a keyword may follow. The reader
  -- that tells what is wrong says so in any case: it names the keywords that were expected.
  isWordNext :: p Bool

  parserState :: p ParserState
  modifyState :: (ParserState -> ParserState) -> p ()

-- | A rule of the grammar, for either reader.
type Parser a = forall p. Grammar p => p a

-- | The reader that tells what is wrong.
type Explaining = ParsecT Problem Input (State ParserState)

instance Grammar (ParsecT Problem Input (State ParserState)) where
  token expected accept = do
    (t, a) <- Parsec.token (\t -> (t,) <$> accept t) Set.empty <?> Text.unpack expected
    lift (modify' (\m -> m {lastEnd = end (Token.place t)}))
    pure a
  zeroOrMore = Parsec.many
  onFailure blame p = Parsec.observing p >>= either blame pure
  remaining = (\(Input ts) -> ts) <$> Parsec.getInput
  fastPath _ p = p
  isWordNext = pure True
  parserState = lift get
  modifyState f = lift (modify' f)

-- | Run a parser over the tokens of a text that ends at an offset: the errors in order, and the
-- output if there is one.
run :: Explaining a -> Int -> [Token] -> ([Error], Maybe a)
run parser finish tokens = (map (fromFailure (Vector.fromList tokens) finish) inOrder, output)
  where
    (result, remembered) =
      runState
        (Parsec.runParserT parser "" (Input tokens))
        ParserState {failures = [], lastEnd = 0, bracketDepth = 0, blockDepth = 0, hasGivenUp = False}
    inOrder =
      sortOn Parsec.errorOffset ([f | not (hasGivenUp remembered), f <- final] <> failures remembered)
    (output, final) = case result of
      Right a -> (Just a, [])
      Left bundle -> (Nothing, NonEmpty.toList (Parsec.bundleErrors bundle))

-- Tokens

symbol :: Grammar p => Text -> p Region
symbol s = token ("‘" <> s <> "’") (\t -> if isSymbol s t then Just (Token.place t) else Nothing)
{-# INLINE symbol #-}

keyword :: Grammar p => Text -> p ()
keyword word = token ("‘" <> word <> "’") (\t -> if isWord word t then Just () else Nothing)
{-# INLINE keyword #-}

isSymbol :: Text -> Token -> Bool
isSymbol s t = case shape t of
  Symbol s' -> s' == s
  _ -> False

isWord :: Text -> Token -> Bool
isWord word t = case shape t of
  Word word' -> word' == word
  _ -> False

-- | A name that is to be given to something. A keyword in its place is a mistake of its own.
name :: Grammar p => p (Located Name)
name = do
  next <- remaining
  case next of
    Token {shape = Word word, newLine} : _
      | Keyword.isReserved word && not newLine ->
        Parsec.customFailure (NoName word)
    _ -> usedName
{-# INLINEABLE name #-}

-- | A name that is no keyword.
usedName :: Grammar p => p (Located Name)
usedName = token "a name" nameOf
  where
    nameOf t = case shape t of
      Word word | not (Keyword.isReserved word) -> Just (Located (Token.place t) (Name word))
      _ -> Nothing
{-# INLINEABLE usedName #-}

-- | Only if the next token stands on the line of the last one.
onThisLine :: Grammar p => p a -> p a
onThisLine p = do
  next <- remaining
  case next of
    t : _ | newLine t -> Parsec.empty
    _ -> p
{-# INLINEABLE onThisLine #-}

-- | Nothing more stands on this line, but for the end of the block.
endOfLine :: Grammar p => p ()
endOfLine = do
  next <- remaining
  inBlock <- (> 0) . blockDepth <$> parserState
  case next of
    t : _
      | not (newLine t) && not (inBlock && shape t == Symbol "}") ->
        Parsec.customFailure (TextAfterStatement (shape t))
    _ -> pure ()
{-# INLINEABLE endOfLine #-}

-- | With the region from the first to the last token.
located :: Grammar p => p a -> p (Located a)
located p = do
  input <- remaining
  x <- p
  ParserState {lastEnd} <- parserState
  let begin = case input of
        t : _ -> start (Token.place t)
        [] -> lastEnd
  pure (Located (Region begin (max begin lastEnd)) x)
{-# INLINE located #-}

quoted :: Name -> Text
quoted (Name text) = "‘" <> text <> "’"

-- Brackets

parens :: Grammar p => p a -> p a
parens = enclosed "(" ")"
{-# INLINEABLE parens #-}

brackets :: Grammar p => p a -> p a
brackets = enclosed "[" "]"
{-# INLINEABLE brackets #-}

enclosed :: Grammar p => Text -> Text -> p a -> p a
enclosed open close inside = do
  opened <- symbol open
  x <- onFailure (blame opened) (nested inside)
  ended <- lineEnds
  when ended (Parsec.customFailure (UnclosedBlock opened what))
  void (symbol close)
  pure x
  where
    what = quoted (Name open)
    -- What is missing where the statement or the line ends is the closing bracket.
    blame opened failure = do
      ended <- lineEnds
      case failure of
        TrivialError {} | ended -> Parsec.customFailure (UnclosedBlock opened what)
        _ -> Parsec.parseError failure
{-# INLINEABLE enclosed #-}

-- | Items in braces. An item that can not be read is skipped.
block :: Grammar p => Text -> (Maybe (Located Name) -> a) -> p a -> p [Located a]
block what broken one = do
  opened <- symbol "{"
  items <-
    zeroOrMore (inside *> recovering (located . brokenItem broken) (located (strayStatement *> one)))
  closing opened what "}"
  pure items
  where
    inside = do
      rest <- remaining
      case rest of
        [] -> Parsec.empty
        t : _ | shape t == Symbol "}" -> Parsec.empty
        t : _ | beginsStatement t && not (closesBlock rest) -> Parsec.empty
        _ -> pure ()
    -- A statement in a block whose closing brace follows further down.
    strayStatement = do
      next <- remaining
      case next of
        t@Token {shape = Word word} : _ | beginsStatement t -> Parsec.customFailure (Misplaced word)
        _ -> pure ()
{-# INLINEABLE block #-}

-- | Statements in braces.
statementBlock :: Grammar p => Text -> p Statement -> p [Statement]
statementBlock what one = do
  opened <- symbol "{"
  modifyState (\m -> m {blockDepth = blockDepth m + 1})
  statements <- nested (zeroOrMore (inside *> recovering brokenStatement one))
  modifyState (\m -> m {blockDepth = blockDepth m - 1})
  ended <- null <$> remaining
  when ended (Parsec.customFailure (UnclosedBlock opened what))
  void (symbol "}")
  pure statements
  where
    inside = do
      ts <- remaining
      case ts of
        [] -> Parsec.empty
        t : _ | shape t == Symbol "}" -> Parsec.empty
        _ -> pure ()
{-# INLINEABLE statementBlock #-}

-- | Whether the tokens hold a closing brace that belongs to a block which is open already.
closesBlock :: [Token] -> Bool
closesBlock = go (0 :: Int)
  where
    go open ts = case ts of
      [] -> False
      t : rest -> case shape t of
        Symbol "{" -> go (open + 1) rest
        Symbol "}" -> open == 0 || go (open - 1) rest
        _ -> go open rest

-- | The closing bracket. When the program or the statement ends before it, the opening one is
-- blamed.
closing :: Grammar p => Region -> Text -> Text -> p ()
closing opened what close = do
  ended <- atEnd
  when ended (Parsec.customFailure (UnclosedBlock opened what))
  void (symbol close)
{-# INLINEABLE closing #-}

-- | Whether something else than a closing bracket begins a new line, or nothing follows at all.
lineEnds :: Grammar p => p Bool
lineEnds = begins <$> remaining
  where
    begins ts = case ts of
      [] -> True
      t : _ -> newLine t && shape t `notElem` map Symbol [")", "]", "}"]
{-# INLINEABLE lineEnds #-}

-- | Whether the program or the statement ends here.
atEnd :: Grammar p => p Bool
atEnd = maybe True beginsStatement . listToMaybe <$> remaining
{-# INLINEABLE atEnd #-}

sepBy1 :: Grammar p => p a -> Text -> p (NonEmpty a)
sepBy1 p separator = (:|) <$> p <*> zeroOrMore (symbol separator *> p)
{-# INLINEABLE sepBy1 #-}

-- | One bracket deeper.
nested :: Grammar p => p a -> p a
nested p = do
  open <- bracketDepth <$> parserState
  when (open >= maxNesting) (Parsec.customFailure TooDeep)
  modifyState (\m -> m {bracketDepth = open + 1})
  a <- p
  modifyState (\m -> m {bracketDepth = open})
  pure a
{-# INLINEABLE nested #-}

-- | Expressions are not nested deeper.
maxNesting :: Int
maxNesting = 500

-- Recovery

-- | Run a parser. If it fails, keep the failure and let the other make something of the tokens that
-- were read up to there; at least one token is consumed either way.
recovering :: Grammar p => ([Token] -> p a) -> p a -> p a
recovering repair p = do
  begin <- Parsec.getOffset
  input <- remaining
  before <- parserState
  Parsec.withRecovery (again before begin input) p
  where
    again before begin input failure = do
      modifyState
        ( \m ->
            if hasGivenUp m
              then m
              else
                m
                  { failures = failure : failures m,
                    bracketDepth = bracketDepth before,
                    blockDepth = blockDepth before,
                    hasGivenUp = isTooDeep failure
                  }
        )
      -- What is nested too deep says nothing of what follows.
      enough <- hasGivenUp <$> parserState
      when enough (void (Parsec.takeWhileP Nothing (const True)))
      now <- Parsec.getOffset
      when (now == begin) (void Parsec.anySingle)
      after <- Parsec.getOffset
      repair (take (after - begin) input)
{-# INLINEABLE recovering #-}

isTooDeep :: Failure -> Bool
isTooDeep failure = case failure of
  FancyError _ problems -> Parsec.ErrorCustom TooDeep `Set.member` problems
  TrivialError {} -> False

-- | Skip to the line on which a statement begins; keep the statement's keyword, or what is spelt
-- like one, and the name that was to be defined.
brokenStatement :: Grammar p => [Token] -> p Statement
brokenStatement taken = do
  inBlock <- (> 0) . blockDepth <$> parserState
  more <- skipped inBlock (sum (map braces taken))
  pure
    ( Located
        (foldr (Region.merge . Token.place) (place' taken) taken)
        (uncurry Broken (meaning (taken <> more)))
    )
  where
    -- What is skipped; the brace that closes the block in which the statement stands is not.
    skipped :: Bool -> Int -> Parser [Token]
    skipped inBlock open = do
      rest <- remaining
      case rest of
        t : others
          | not
              ( beginsStatement t && not (inItsBlock open rest)
                  || opensBlock open t
                  || misspelt open t others
                  || inBlock && open <= 0 && shape t == Symbol "}"
              ) ->
            Parsec.anySingle *> ((t :) <$> skipped inBlock (open + braces t))
        _ -> pure []
    -- The block that belongs to the mistake, if it is closed further down: its statements make no
    -- sense alone, nor does its closing brace.
    inItsBlock open rest = open > 0 && withBlock && closesBlock rest
    withBlock = case map shape (take 1 taken) of
      [Word word] -> word `elem` "with" : Keyword.blocks
      _ -> False
    -- A block of statements, unless it stands in braces that belong to the mistake.
    opensBlock open t = case shape t of
      Word word -> newLine t && open <= 0 && word `elem` Keyword.blocks
      _ -> False
    -- Two words in a row on a new line are a misspelt statement rather than the rest of this one,
    -- but not in braces that belong to the mistake.
    misspelt open t others = case (shape t, others) of
      (Word word, next : _)
        | Word _ <- shape next ->
          open <= 0
            && newLine t
            && not (newLine next)
            && not (Keyword.isReserved word || Keyword.beginsItem word)
      _ -> False
    braces t = case shape t of
      Symbol "{" -> 1 :: Int
      Symbol "}" -> -1
      _ -> 0
    meaning ts = case map shape (take 2 ts) of
      [Word word, Word what]
        | not (Keyword.isReserved what) ->
          (spelt word, Just (Located (place' (drop 1 ts)) (Name what)))
      Word word : _ -> (spelt word, Nothing)
      _ -> (Nothing, Nothing)
    spelt word = case filter (== word) known <> Name.nearest word known of
      w : _ -> Just w
      [] -> Nothing
    known = Keyword.statements <> Keyword.softStatements
    place' ts = case ts of
      t : _ -> Token.place t
      [] -> Region 0 0
{-# INLINEABLE brokenStatement #-}

-- | Skip to the next line of the block that is in no braces of this item, or to the block's end. A
-- line that ends with a comma or an operator goes on. Tell the name that a definition in the wrong
-- place was to define.
brokenItem :: Grammar p => (Maybe (Located Name) -> a) -> [Token] -> p a
brokenItem broken taken = do
  next <- Parsec.optional (Parsec.lookAhead Parsec.anySingle)
  skip (sum (map opens taken)) False
  pure (broken (defined taken next))
  where
    defined ts next = case (map shape ts, next) of
      ([Word "let"], Just Token {shape = Word what, place}) -> Just (Located place (Name what))
      _ -> Nothing
    -- How many braces are open, and whether the last sign says that the item goes on.
    skip :: Int -> Bool -> Parser ()
    skip open goesOn = do
      next <- Parsec.optional (Parsec.lookAhead Parsec.anySingle)
      case next of
        Nothing -> pure ()
        Just t
          | beginsStatement t -> pure ()
          | shape t == Symbol "}" && open <= 0 -> pure ()
          | newLine t && open <= 0 && not goesOn -> pure ()
          | otherwise ->
            Parsec.anySingle
              *> skip
                (open + opens t)
                (shape t `elem` map Symbol [",", "(", "[", "{", "=", "+", "-", "*", "/"])
    opens t = case shape t of
      Symbol "{" -> 1
      Symbol "}" -> -1
      _ -> 0
{-# INLINEABLE brokenItem #-}

beginsStatement :: Token -> Bool
beginsStatement t = case shape t of
  Word word -> newLine t && word `elem` Keyword.statements
  _ -> False

-- Failures into errors

fromFailure :: Vector.Vector Token -> Int -> Failure -> Error
fromFailure ts finish failure = case failure of
  FancyError _ problems | Parsec.ErrorCustom problem : _ <- Set.toList problems -> case problem of
    UnclosedBlock opened what -> Error.Unclosed region opened what
    NoStatement word ->
      Error.UnknownStatement
        region
        word
        (Keyword.statements <> Keyword.softStatements <> Keyword.blocks)
    NoName word -> Error.Reserved region word
    TextAfterStatement shape' -> Error.Trailing region shape' neighbours
    NotInRow shape' -> Error.NotInRow region shape' neighbours
    NotInHeadings shape' -> Error.NotInHeadings region shape' neighbours
    NoSide -> Error.NoSide region found
    Misplaced word -> Error.Misplaced region word
    ManyCoordinates place -> Error.ManyCoordinates place
    TooDeep -> Error.TooDeep region maxNesting
  FancyError _ _ -> Error.Unexpected region found [] neighbours
  TrivialError _ _ expected ->
    Error.Unexpected region found (concatMap wanted (Set.toList expected)) neighbours
  where
    neighbours = (shape <$> ts Vector.!? (Parsec.errorOffset failure - 1), shape <$> touchingNext)
    touchingNext = case ts Vector.!? (Parsec.errorOffset failure + 1) of
      Just t | attached t -> Just t
      _ -> Nothing
    here = ts Vector.!? Parsec.errorOffset failure
    region = maybe (Region finish finish) Token.place here
    found = maybe FoundEnd (FoundToken . shape) here
    wanted expected' = case expected' of
      Label text -> [Text.pack (NonEmpty.toList text)]
      Parsec.Tokens _ -> []
      EndOfInput -> []
