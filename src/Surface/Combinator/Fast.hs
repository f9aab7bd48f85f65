{-# LANGUAGE BangPatterns #-}
{-# LANGUAGE MultiParamTypeClasses #-}
{-# LANGUAGE RankNTypes #-}
{-# LANGUAGE TypeFamilies #-}

-- | The fast parser, for programs without a mistake.
--
-- The parser is written in continuation-passing style and stops at the first mistake without a
-- report. For correct programs it gives the same output as the explaining parser of
-- "Surface.Combinator", which reports mistakes.
module Surface.Combinator.Fast
  ( FastParser,
    run,
    plainPair,
  )
where

import Base.Region (Located (..))
import Base.Region qualified as Region
import Control.Applicative (Alternative (..))
import Control.Monad (MonadPlus)
import Surface.Combinator
  ( Consumed (..),
    Grammar (..),
    ParserState (..),
    Problem,
    isSymbol,
    maxNesting,
  )
import Surface.Syntax (Expr, Expr_ (..))
import Surface.Token (Token)
import Surface.Token qualified as Token
import Surface.TokenStream (TokenStream (..))
import Text.Megaparsec (MonadParsec (..))
import Text.Megaparsec qualified as Parsec

-- | The state of the fast parser. An offset is the index of a character in the text, from 0.
data FastState = FastState
  { -- | the remaining tokens
    left :: [Token],
    -- | the number of tokens that may still be read
    room :: Int,
    -- | the offset of the end of the last token consumed
    ended :: Int,
    -- | the nesting depth of the next token, which "Surface.Combinator" defines
    open :: Int,
    -- | the number of statement blocks around the statement that is being parsed
    blocks :: Int
  }

-- | A parser with continuations for success and failure. The failure continuation gets the 'room'
-- at the mistake. If the parser began with the same room, it consumed no token, and an alternative
-- is tried.
newtype FastParser a = FastParser (forall r. FastState -> (a -> FastState -> r) -> (Int -> r) -> r)

-- | Runs a parser on at most @limit@ tokens. 'Nothing' if there are more tokens, or if the parser
-- fails.
run :: Int -> FastParser a -> [Token] -> Maybe a
run limit (FastParser p) ts =
  p
    FastState {left = ts, room = limit, ended = 0, open = 0, blocks = 0}
    (\a _ -> Just a)
    (const Nothing)

-- | A number that a failure continuation gets instead of the 'room' to forbid alternatives. It
-- differs from every room, so that no parser takes it for a failure without a consumed token.
final :: Int
final = minBound

-- Results are evaluated at once. Thunks would keep the tokens alive.
instance Functor FastParser where
  fmap f (FastParser p) = FastParser (\s ok no -> p s (\a s' -> let !b = f a in ok b s') no)
  {-# INLINE fmap #-}

instance Applicative FastParser where
  pure !a = FastParser (\s ok _ -> ok a s)
  {-# INLINE pure #-}
  FastParser p <*> FastParser q =
    FastParser (\s ok no -> p s (\f s' -> q s' (\a s'' -> let !b = f a in ok b s'') no) no)
  {-# INLINE (<*>) #-}
  FastParser p *> FastParser q = FastParser (\s ok no -> p s (\_ s' -> q s' ok no) no)
  {-# INLINE (*>) #-}
  FastParser p <* FastParser q = FastParser (\s ok no -> p s (\a s' -> q s' (\_ -> ok a) no) no)
  {-# INLINE (<*) #-}

instance Monad FastParser where
  FastParser p >>= f =
    FastParser (\s ok no -> p s (\a s' -> let FastParser q = f a in q s' ok no) no)
  {-# INLINE (>>=) #-}

instance Alternative FastParser where
  empty = FastParser (\s _ no -> no (room s))
  {-# INLINE empty #-}
  FastParser p <|> FastParser q =
    FastParser (\s ok no -> p s ok (\at -> if at == room s then q s ok no else no at))
  {-# INLINE (<|>) #-}

instance MonadPlus FastParser

instance MonadParsec Problem TokenStream FastParser where
  parseError _ = empty
  {-# INLINE parseError #-}
  label _ p = p
  {-# INLINE label #-}
  hidden p = p
  {-# INLINE hidden #-}
  try (FastParser p) =
    FastParser (\s ok no -> p s ok (\at -> no (if at == final then final else room s)))
  lookAhead (FastParser p) = FastParser (\s ok no -> p s (\a _ -> ok a s) no)
  {-# INLINE lookAhead #-}
  notFollowedBy (FastParser p) =
    FastParser
      (\s ok no -> p s (\_ _ -> no (room s)) (\at -> if at == final then no final else ok () s))
  withRecovery _ (FastParser p) = FastParser (\s ok no -> p s ok (\_ -> no final))
  {-# INLINE withRecovery #-}
  observing p = Right <$> p
  {-# INLINE observing #-}
  eof = FastParser (\s ok no -> if null (left s) then ok () s else no (room s))
  {-# INLINE eof #-}
  token accept _ = FastParser $ \s ok no -> case left s of
    t : rest | Just a <- accept t -> ok a s {left = rest, room = room s - 1}
    _ -> no (room s)
  {-# INLINE token #-}
  tokens fits wanted = FastParser $ \s ok no ->
    let (taken, rest) = splitAt (length wanted) (left s)
     in if fits wanted taken
          then ok taken s {left = rest, room = room s - length taken}
          else no (room s)
  takeWhileP _ holds =
    FastParser $ \s ok _ ->
      let (taken, rest) =
            span holds (left s)
       in ok taken s {left = rest, room = room s - length taken}
  takeWhile1P what holds =
    takeWhileP what holds >>= \taken -> if null taken then empty else pure taken
  takeP _ n = FastParser $ \s ok no ->
    let (taken, rest) = splitAt n (left s)
     in if length taken == max 0 n
          then ok taken s {left = rest, room = room s - length taken}
          else no (room s)
  getParserState = FastParser (\s ok _ -> ok (stateOf s) s)
  {-# INLINE getParserState #-}
  updateParserState f = FastParser $ \s ok _ ->
    let Parsec.State {Parsec.stateInput = TokenStream ts, Parsec.stateOffset} =
          f (stateOf s)
     in ok () s {left = ts, room = negate stateOffset}

-- | The state in megaparsec's form. Megaparsec needs an offset that grows by 1 with each token. The
-- field 'room', the number of tokens that may still be read, shrinks by 1 with each token. So the
-- offset is the negated 'room'.
stateOf :: FastState -> Parsec.State TokenStream Problem
stateOf s =
  Parsec.State
    { Parsec.stateInput = TokenStream (left s),
      Parsec.stateOffset = negate (room s),
      Parsec.statePosState = nowhere (left s),
      Parsec.stateParseErrors = []
    }
{-# INLINE stateOf #-}

instance Grammar FastParser where
  token _ accept = FastParser $ \s ok no -> case left s of
    t : rest
      | room s <= 0 -> no final
      | Just a <- accept t ->
        ok a s {left = rest, room = room s - 1, ended = Region.end (Token.place t)}
    _ -> no (room s)
  {-# INLINE token #-}
  zeroOrMore (FastParser p) =
    FastParser
      ( \s ok no ->
          let more as s' =
                p
                  s'
                  (\a -> more (a : as))
                  (\at -> if at == room s' then let !all' = reverse as in ok all' s' else no at)
           in more [] s
      )
  {-# INLINE zeroOrMore #-}
  onFailure _ p = p
  {-# INLINE onFailure #-}
  remaining = FastParser (\s ok _ -> ok (left s) s)
  {-# INLINE remaining #-}
  fastPath whole (FastParser p) = FastParser $ \s ok no -> case whole (left s) of
    Just (Consumed a count rest)
      | count <= room s && open s < maxNesting - 2 ->
        ok a s {left = rest, room = room s - count, ended = Region.end (Region.region a)}
    _ -> p s ok no
  {-# INLINE fastPath #-}
  isWordNext =
    FastParser
      ( \s ok _ ->
          ok (case left s of Token.Token {Token.shape = Token.Word _} : _ -> True; _ -> False) s
      )
  {-# INLINE isWordNext #-}
  parserState = FastParser (\s ok _ -> ok (grammarStateOf s) s)
  {-# INLINE parserState #-}
  modifyState f =
    FastParser
      ( \s ok _ ->
          let m =
                f (grammarStateOf s)
           in ok () s {ended = lastEnd m, open = bracketDepth m, blocks = blockDepth m}
      )
  {-# INLINE modifyState #-}

-- | The state in the form that the grammar uses. Without recovery there are no recorded failures.
grammarStateOf :: FastState -> ParserState
grammarStateOf s =
  ParserState
    { failures = [],
      lastEnd = ended s,
      bracketDepth = open s,
      blockDepth = blocks s,
      hasGivenUp = False
    }
{-# INLINE grammarStateOf #-}

-- | The position in the form that megaparsec requires. Lines and columns are not counted, so the
-- position is always the start of the text.
nowhere :: [Token] -> Parsec.PosState TokenStream
nowhere ts =
  Parsec.PosState
    { Parsec.pstateInput = TokenStream ts,
      Parsec.pstateOffset = 0,
      Parsec.pstateSourcePos = Parsec.initialPos "",
      Parsec.pstateTabWidth = Parsec.defaultTabWidth,
      Parsec.pstateLinePrefix = ""
    }

-- Points

-- | Parses a pair of numbers in parentheses; 'Nothing' for other tokens. Most points have this
-- form, so it is parsed without the slower combinators.
plainPair :: [Token] -> Maybe (Consumed Expr)
plainPair ts = case ts of
  opening : inside
    | isSymbol "(" opening,
      Just (Consumed x n (comma : afterComma)) <- plainNumber inside,
      isSymbol "," comma,
      Just (Consumed y m (closing : rest)) <- plainNumber afterComma,
      isSymbol ")" closing ->
      let region = Region.span (Token.place opening) (Token.place closing)
       in Just (Consumed (Located region (Pair x y)) (n + m + 3) rest)
  _ -> Nothing

-- | Parses a number with an optional minus and an optional unit; 'Nothing' for other tokens.
plainNumber :: [Token] -> Maybe (Consumed Expr)
plainNumber ts = case ts of
  Token.Token {Token.shape = Token.Number x unit, Token.place} : rest ->
    Just (Consumed (Located place (Literal x unit)) 1 rest)
  minus : Token.Token {Token.shape = Token.Number x unit, Token.place} : rest
    | isSymbol "-" minus ->
      let negated = Negate (Located place (Literal x unit))
       in Just (Consumed (Located (Region.span (Token.place minus) place) negated) 2 rest)
  _ -> Nothing
