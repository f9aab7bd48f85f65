{-# LANGUAGE ConstraintKinds #-}
{-# LANGUAGE FlexibleContexts #-}
{-# LANGUAGE FlexibleInstances #-}
{-# LANGUAGE RankNTypes #-}

-- | The combinators of the grammar: tokens, names, brackets, blocks, and recovery from mistakes.
--
-- One grammar has two parsers. The explaining parser of this module reports mistakes and recovers
-- from them. The fast parser of "Surface.Combinator.Fast" stops at the first mistake.
--
-- An enclosure is a part of a program between two brackets. A statement or an item that contains a
-- mistake is called broken. Recovery replaces it by a broken node of the syntax tree and continues
-- after it. The nesting depth of a token is the number of 'nested' parsers around it: one for each
-- pair of brackets, for example, and one for the operand of a minus. The offset of a failure is the
-- index of a token, all other offsets are indices of characters; both count from 0.
module Surface.Combinator
  ( Parser,
    Explaining,
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
    onSameLine,
    endOfLine,
    located,

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
import Data.Char (isAlphaNum)
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (quote)
import Surface.Error (Enclosure (..), Error)
import Surface.Failure (ParseFailure, Problem (..), maxNesting)
import Surface.Failure qualified as Failure
import Surface.Keyword qualified as Keyword
import Surface.Syntax (Expr, Statement, Statement_ (..))
import Surface.Token (Token (..), Token_ (..))
import Surface.Token qualified as Token
import Surface.TokenStream (TokenStream (..))
import Surface.WordMeaning (statementMeant, typeWords)
import Text.Megaparsec (MonadParsec, ParseError (..), ParsecT, (<?>))
import Text.Megaparsec qualified as Parsec

-- | The state of a parser besides the remaining tokens.
data ParserState = ParserState
  { -- | the failures that the parser recovered from, the newest first
    failures :: [ParseFailure],
    -- | the offset of the end of the last token consumed
    lastEnd :: Int,
    -- | the nesting depth of the next token
    bracketDepth :: Int,
    -- | the number of statement blocks around the statement that is being parsed
    blockDepth :: Int,
    -- | true after the failure 'TooDeep': the parser skips all further tokens without a report
    hasGivenUp :: Bool
  }

-- | A parsed value, the number of its tokens, and the tokens after them. The value may have at most
-- two levels of 'nested' parsers, because 'fastPath' relies on this.
data Consumed a = Consumed a Int [Token]

-- | The operations from which the grammar is built.
class MonadParsec Problem TokenStream p => Grammar p where
  -- | Consumes the next token if the function gives a value for this token, and fails otherwise.
  -- The text describes the expected token in reports.
  token :: Text -> (Token -> Maybe a) -> p a

  -- | Repeats a parser until it fails without consuming a token, and gives all results.
  zeroOrMore :: p a -> p [a]

  -- | Runs a parser. If it fails, runs the parser that the function makes from the failure. The
  -- fast parser ignores the function.
  onFailure :: (ParseFailure -> p a) -> p a -> p a

  -- | The tokens that are not consumed yet.
  remaining :: p [Token]

  -- | A faster way to run a rule: applies a function to the remaining tokens. A value of this
  -- function must be the one that the rule would give. The rule itself runs if there is no value or
  -- if a limit of tokens or nesting may be exceeded. The explaining parser always runs the rule.
  fastPath :: ([Token] -> Maybe (Consumed Expr)) -> p Expr -> p Expr

  -- | Tells if the next token is a word, so that a keyword is possible. The explaining parser
  -- always answers 'True', so that its reports name the expected keywords.
  isWordNext :: p Bool

  -- | The state of the parser.
  parserState :: p ParserState

  -- | Changes the state of the parser.
  modifyState :: (ParserState -> ParserState) -> p ()

-- | A rule of the grammar for both parsers.
type Parser a = forall p. Grammar p => p a

-- | The explaining parser, which reports mistakes and recovers from them.
type Explaining = ParsecT Problem TokenStream (State ParserState)

instance Grammar (ParsecT Problem TokenStream (State ParserState)) where
  token expected accept = do
    (t, a) <- Parsec.token (\t -> (t,) <$> accept t) Set.empty <?> Text.unpack expected
    lift (modify' (\m -> m {lastEnd = end (Token.place t)}))
    pure a
  zeroOrMore = Parsec.many
  onFailure replace p = Parsec.observing p >>= either replace pure
  remaining = (\(TokenStream ts) -> ts) <$> Parsec.getInput
  fastPath _ p = p
  isWordNext = pure True
  parserState = lift get
  modifyState f = lift (modify' f)

-- | Runs a parser on the tokens of a text that ends at offset @finish@. Gives the errors in the
-- order of the text, and the output; 'Nothing' if the parser failed without recovery.
run :: Explaining a -> Int -> [Token] -> ([Error], Maybe a)
run parser finish tokens = (Failure.toErrors tokens finish inOrder, output)
  where
    (result, remembered) =
      runState
        (Parsec.runParserT parser "" (TokenStream tokens))
        ParserState
          { failures = [],
            lastEnd = 0,
            bracketDepth = 0,
            blockDepth = 0,
            hasGivenUp = False
          }
    inOrder =
      sortOn
        Parsec.errorOffset
        ([f | not (hasGivenUp remembered), f <- final] <> failures remembered)
    (output, final) = case result of
      Right a -> (Just a, [])
      Left bundle -> (Nothing, NonEmpty.toList (Parsec.bundleErrors bundle))

-- The pragmas below let GHC specialise the combinators for the fast parser. Without them, the fast
-- parser would call every operation of 'Grammar' through a dictionary. Functions that only run
-- after a mistake need no pragma.

-- Tokens

-- | Parses the symbol @s@ and gives its region.
symbol :: Grammar p => Text -> p Region
symbol s = token (quote s) (\t -> if isSymbol s t then Just (Token.place t) else Nothing)
{-# INLINE symbol #-}

-- | Parses the keyword @word@.
keyword :: Grammar p => Text -> p ()
keyword word = token (quote word) (\t -> if isWord word t then Just () else Nothing)
{-# INLINE keyword #-}

-- | Tells if the token @t@ is the symbol @s@.
isSymbol :: Text -> Token -> Bool
isSymbol s t = case shape t of
  Symbol s' -> s' == s
  _ -> False

isWord :: Text -> Token -> Bool
isWord word t = case shape t of
  Word word' -> word' == word
  _ -> False

-- | Parses the name that a statement defines. If the next token is a reserved word on the same
-- line, the report names that word.
name :: Grammar p => p (Located Name)
name = do
  next <- remaining
  case next of
    Token {shape = Word word, newLine} : _
      | Keyword.isReserved word && not newLine ->
        Parsec.customFailure (NoName word)
    _ -> usedName
{-# INLINEABLE name #-}

-- | Parses a name that is not reserved.
usedName :: Grammar p => p (Located Name)
usedName = token "a name" nameOf
  where
    nameOf t = case shape t of
      Word word | not (Keyword.isReserved word) -> Just (Located (Token.place t) (Name word))
      _ -> Nothing
{-# INLINEABLE usedName #-}

-- | Runs a parser if the next token is on the same line as the last token consumed, else fails.
onThisLine :: Grammar p => p a -> p a
onThisLine p = do
  next <- remaining
  case next of
    t : _ | newLine t -> Parsec.empty
    _ -> p
{-# INLINEABLE onThisLine #-}

-- | Runs a parser for something that has to be on the line of the last token consumed. The text
-- describes it in the report of a line that ends before it.
onSameLine :: Grammar p => Text -> p a -> p a
onSameLine what p = do
  next <- remaining
  case next of
    t : _ | newLine t -> Parsec.customFailure (LineEnds what)
    _ -> p
{-# INLINEABLE onSameLine #-}

-- | Demands the end of the line or, in a block of statements, the closing brace of the block. The
-- brace is not consumed.
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

-- | Runs a parser and adds the region of the tokens that it consumed.
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

-- Brackets

-- | Runs a parser between an opening and a closing parenthesis.
parens :: Grammar p => p a -> p a
parens = enclosed "(" ")"
{-# INLINEABLE parens #-}

-- | Runs a parser between square brackets.
brackets :: Grammar p => p a -> p a
brackets = enclosed "[" "]"
{-# INLINEABLE brackets #-}

-- | Parses @inside@ between the brackets @open@ and @close@. If the line ends before the closing
-- bracket, the opening bracket is reported as unclosed.
enclosed :: Grammar p => Text -> Text -> p a -> p a
enclosed open close inside = do
  opened <- symbol open
  x <- onFailure (replaceFailure opened) (nested inside)
  ended <- isLineEnd
  when ended (Parsec.customFailure (UnclosedBlock opened (BracketOf open)))
  void (symbol close)
  pure x
  where
    replaceFailure opened failure = do
      ended <- isLineEnd
      case failure of
        TrivialError {} | ended -> Parsec.customFailure (UnclosedBlock opened (BracketOf open))
        _ -> Parsec.parseError failure
{-# INLINEABLE enclosed #-}

-- | Parses items in braces, each by @one@. Reports name the block by @what@. An item with a mistake
-- is skipped; @broken@ makes the node that replaces it. The argument of @broken@ is the name that
-- the item was to define, if there is one.
block :: Grammar p => Enclosure -> (Maybe (Located Name) -> a) -> p a -> p [Located a]
block what broken one = do
  opened <- symbol "{"
  items <-
    zeroOrMore
      (inside *> recovering (located . brokenItem broken) (located (strayStatement *> one)))
  closing opened what "}"
  pure items
  where
    -- Fails at the end of the items. If the closing brace is missing, a statement ends them.
    inside = do
      rest <- remaining
      case rest of
        [] -> Parsec.empty
        t : _ | shape t == Symbol "}" -> Parsec.empty
        t : _ | beginsStatement t && not (closesBlock rest) -> Parsec.empty
        _ -> pure ()
    -- Fails with 'Misplaced' if a statement begins where an item is expected.
    strayStatement = do
      next <- remaining
      case next of
        t@Token {shape = Word word} : _ | beginsStatement t -> Parsec.customFailure (Misplaced word)
        _ -> pure ()
{-# INLINEABLE block #-}

-- | Parses statements in braces, each by @one@. Reports name the block by @what@.
statementBlock :: Grammar p => Enclosure -> p Statement -> p [Statement]
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

-- | Tells if tokens contain the closing brace of a block that is already open.
closesBlock :: [Token] -> Bool
closesBlock = go (0 :: Int)
  where
    go open ts = case ts of
      [] -> False
      t : rest -> case shape t of
        Symbol "{" -> go (open + 1) rest
        Symbol "}" -> open == 0 || go (open - 1) rest
        _ -> go open rest

-- | Parses the closing bracket @close@ of the enclosure @what@. If the program or the statement
-- ends before it, the opening bracket, at the region @opened@, is reported as unclosed.
closing :: Grammar p => Region -> Enclosure -> Text -> p ()
closing opened what close = do
  ended <- atEnd
  when ended (Parsec.customFailure (UnclosedBlock opened what))
  void (symbol close)
{-# INLINEABLE closing #-}

-- | Tells if no token remains, or the next token begins a line and is not a closing bracket.
isLineEnd :: Grammar p => p Bool
isLineEnd = isEnd <$> remaining
  where
    isEnd ts = case ts of
      [] -> True
      t : _ -> newLine t && shape t `notElem` map Symbol [")", "]", "}"]
{-# INLINEABLE isLineEnd #-}

-- | Tells if no token remains, or the next token begins a statement. Inside a block of items, both
-- mean that the closing brace is missing.
atEnd :: Grammar p => p Bool
atEnd = maybe True beginsStatement . listToMaybe <$> remaining
{-# INLINEABLE atEnd #-}

-- | Parses one or more values by @p@, with the symbol @separator@ between them.
sepBy1 :: Grammar p => p a -> Text -> p (NonEmpty a)
sepBy1 p separator = (:|) <$> p <*> zeroOrMore (symbol separator *> p)
{-# INLINEABLE sepBy1 #-}

-- | Runs a parser for the inside of a bracket or for an operand, with a 'bracketDepth' that is
-- greater by one. Fails if the depth would exceed 'maxNesting'.
nested :: Grammar p => p a -> p a
nested p = do
  open <- bracketDepth <$> parserState
  when (open >= maxNesting) (Parsec.customFailure TooDeep)
  modifyState (\m -> m {bracketDepth = open + 1})
  a <- p
  modifyState (\m -> m {bracketDepth = open})
  pure a
{-# INLINEABLE nested #-}

-- Recovery

-- | Runs the parser @p@. If it fails, records the failure and calls @repair@ with the tokens that
-- @p@ consumed. If @p@ consumed none, the next token is skipped and given to @repair@. The parser
-- that @repair@ makes skips further tokens and gives a replacement for the result of @p@.
recovering :: Grammar p => ([Token] -> p a) -> p a -> p a
recovering repair p = do
  begin <- Parsec.getOffset
  input <- remaining
  before <- parserState
  Parsec.withRecovery (recover before begin input) p
  where
    recover before begin input failure = do
      modifyState (\m -> if hasGivenUp m then m else recorded before failure m)
      -- After brackets that are nested too deep, the whole rest of the text is skipped.
      isEnough <- hasGivenUp <$> parserState
      when isEnough (void (Parsec.takeWhileP Nothing (const True)))
      now <- Parsec.getOffset
      when (now == begin) (void Parsec.anySingle)
      after <- Parsec.getOffset
      repair (take (after - begin) input)
    recorded before failure m =
      m
        { failures = failure : failures m,
          bracketDepth = bracketDepth before,
          blockDepth = blockDepth before,
          hasGivenUp = isTooDeep failure
        }
{-# INLINEABLE recovering #-}

isTooDeep :: ParseFailure -> Bool
isTooDeep failure = case failure of
  FancyError _ problems -> Parsec.ErrorCustom TooDeep `Set.member` problems
  TrivialError {} -> False

-- | Skips the rest of a broken statement and makes its broken node. @taken@ has the statement's
-- tokens up to the mistake. The node has the name that the statement was to define, and its
-- keyword, or the keyword that its first word resembles.
brokenStatement :: Grammar p => [Token] -> p Statement
brokenStatement taken = do
  isInBlock <- (> 0) . blockDepth <$> parserState
  skipped <- skipStatement (beginsBlock taken) isInBlock (braceBalance taken)
  pure
    ( Located
        (foldr (Region.merge . Token.place) (firstRegion taken) taken)
        (uncurry Broken (keywordAndName (taken <> skipped)))
    )

-- | Skips the remaining tokens of a broken statement and gives them. @hasBlock@ tells if the
-- statement has a block of statements. @isInBlock@ tells if it is inside a block itself, whose
-- closing brace is then not skipped. @open@ is the count of the statement's braces that are still
-- open.
skipStatement :: Grammar p => Bool -> Bool -> Int -> p [Token]
skipStatement hasBlock isInBlock open = do
  rest <- remaining
  case rest of
    t : others
      | not (isStatementEnd hasBlock isInBlock open t others) ->
        Parsec.anySingle *> ((t :) <$> skipStatement hasBlock isInBlock (open + braceBalance [t]))
    _ -> pure []

-- | Tells if a broken statement ends before the token @t@; @others@ are the tokens after @t@.
-- @hasBlock@ tells if the statement has a block of statements, @isInBlock@ tells if it is inside
-- one. @open@ is the count of the statement's braces that are still open.
isStatementEnd :: Bool -> Bool -> Int -> Token -> [Token] -> Bool
isStatementEnd hasBlock isInBlock open t others =
  beginsStatement t && not isInOwnBlock
    || isBlockStatement
    || isSoftStatement
    || isMisspeltKeyword
    || isInBlock && open <= 0 && shape t == Symbol "}"
  where
    -- If the block of a broken @for@, @if@ or @with@ has a closing brace, the whole block is
    -- skipped, because its statements make no sense alone.
    isInOwnBlock = open > 0 && hasBlock && closesBlock (t : others)
    -- True if @t@ begins a line with @for@ or @if@ outside of the broken statement's braces.
    isBlockStatement = case shape t of
      Word word -> newLine t && open <= 0 && word `elem` Keyword.blocks
      _ -> False
    -- True if @t@ is a word such as @stop@ that begins a line, alone or before a number, a text or
    -- the @of@ of @rest of@, outside of the broken statement's braces.
    isSoftStatement = case shape t of
      Word word ->
        newLine t && open <= 0
          && word `elem` Keyword.softStatements
          && (isInBlock || not (closesBeforeStatement others))
          && maybe True isAfterSoft (listToMaybe others)
      _ -> False
    isAfterSoft next = case shape next of
      Number _ _ -> True
      BadNumber _ -> True
      Text _ -> True
      Word "of" -> True
      _ -> newLine next
    -- True if @t@ and the next token are two words at the start of a line outside of the broken
    -- statement's braces, and @t@ is no keyword. Such a line begins a misspelt statement.
    isMisspeltKeyword = case (shape t, others) of
      (Word word, next : _)
        | Word _ <- shape next ->
          open <= 0
            && newLine t
            && (isInBlock || not (closesBeforeStatement others))
            && not (newLine next)
            && not (Keyword.isReserved word || Keyword.beginsItem word)
      _ -> False

-- | Tells if a brace that closes nothing comes before the next statement, as in a block whose
-- opening brace is missing.
closesBeforeStatement :: [Token] -> Bool
closesBeforeStatement = closesBlock . takeWhile (not . beginsStatement)

-- | Tells if tokens begin a statement that has a block of statements.
beginsBlock :: [Token] -> Bool
beginsBlock ts = case map shape (take 1 ts) of
  [Word word] -> word `elem` "with" : Keyword.blocks
  _ -> False

-- | The number of opening braces minus the number of closing braces.
braceBalance :: [Token] -> Int
braceBalance = sum . map balance
  where
    balance t = case shape t of
      Symbol "{" -> 1
      Symbol "}" -> -1
      _ -> 0

-- | The keyword of a broken statement, with its spelling corrected, and the name that the statement
-- defines, judged by its first two tokens. 'Nothing' for each that cannot be found.
keywordAndName :: [Token] -> (Maybe Text, Maybe (Located Name))
keywordAndName ts = case map shape (take 1 ts) of
  [Word word] ->
    let keyword' = corrected word
     in (keyword', if keyword' `elem` map Just defining then listToMaybe names else Nothing)
  _ -> (Nothing, Nothing)
  where
    corrected word =
      listToMaybe
        ( filter (== word) known
            <> Name.nearest word known
            <> [w | Just meant <- [statementMeant word], w <- take 1 (Text.words meant)]
        )
    known = Keyword.statements <> Keyword.softStatements
    defining = Text.words "let param contour table curve piece"
    names =
      [ Located (Token.place t) (Name what)
        | t <- takeWhile ((`notElem` map Symbol ["=", "{"]) . shape) (take 3 (drop 1 ts)),
          Just what <- [nameOf (shape t)]
      ]
    nameOf token' = case token' of
      Word what | not (Keyword.isReserved what || what `elem` typeWords) -> Just what
      Text what | Text.all isAlphaNum what -> Just what
      _ -> Nothing

firstRegion :: [Token] -> Region
firstRegion ts = case ts of
  t : _ -> Token.place t
  [] -> Region 0 0

-- | Skips the rest of a broken item and makes its node by @broken@. @taken@ has the item's tokens
-- up to the mistake. The rest ends at the next line outside of the item's braces, at the end of the
-- block, or at a statement. A line after a comma or an operator belongs to the item. The argument
-- of @broken@ is the name that a misplaced @let@ was to define.
brokenItem :: Grammar p => (Maybe (Located Name) -> a) -> [Token] -> p a
brokenItem broken taken = do
  next <- Parsec.optional (Parsec.lookAhead Parsec.anySingle)
  skipItem (braceBalance taken) False
  pure $
    broken $ case (map shape taken, next) of
      ([Word "let"], Just Token {shape = Word what, place}) -> Just (Located place (Name what))
      _ -> Nothing

-- | Skips the remaining tokens of a broken item. @open@ is the count of the item's braces that are
-- still open. @isContinued@ tells if the last skipped token is a comma, an operator or an opening
-- bracket, so that the next line belongs to the item.
skipItem :: Grammar p => Int -> Bool -> p ()
skipItem open isContinued = do
  next <- Parsec.optional (Parsec.lookAhead Parsec.anySingle)
  case next of
    Nothing -> pure ()
    Just t
      | beginsStatement t -> pure ()
      | shape t == Symbol "}" && open <= 0 -> pure ()
      | newLine t && open <= 0 && not isContinued -> pure ()
      | otherwise -> Parsec.anySingle *> skipItem (open + braceBalance [t]) (isUnfinished t)
  where
    isUnfinished t = shape t `elem` map Symbol [",", "(", "[", "{", "=", "+", "-", "*", "/"]

-- | Tells if a token is one of 'Keyword.statements' and the first token on its line.
beginsStatement :: Token -> Bool
beginsStatement t = case shape t of
  Word word -> newLine t && word `elem` Keyword.statements
  _ -> False
