{-# LANGUAGE BangPatterns #-}
{-# LANGUAGE MultiParamTypeClasses #-}
{-# LANGUAGE RankNTypes #-}
{-# LANGUAGE TypeFamilies #-}

-- | The reader for programs without a mistake: it goes straight through the tokens and gives up at
-- the first mistake, of which it says nothing. It gives what the one that explains would give
-- without errors.
module Surface.Combinator.Fast
  ( FastParser,
    run,
  )
where

import Base.Region qualified as Region
import Control.Applicative (Alternative (..))
import Control.Monad (MonadPlus)
import Surface.Combinator (Grammar (..), ParserState (..), Problem, Consumed (..), maxNesting)
import Surface.Token (Token)
import Surface.Token qualified as Token
import Surface.TokenStream (Input (..))
import Text.Megaparsec (MonadParsec (..))
import Text.Megaparsec qualified as Parsec

-- | What is left to read, how many tokens may still be read, where the last one ended, how many
-- brackets are open, and how many blocks of statements.
data Ahead = Ahead {left :: [Token], room :: Int, ended :: Int, open :: Int, blocks :: Int}

-- | How to go on with what was read; how to go on when it could not be read, by the room that was
-- left at the mistake: another way may be tried only where this one began.
newtype FastParser a = FastParser (forall r. Ahead -> (a -> Ahead -> r) -> (Int -> r) -> r)

-- | Run a parser over so many tokens at most; nothing when there are more, or a mistake.
run :: Int -> FastParser a -> [Token] -> Maybe a
run most (FastParser p) ts =
  p Ahead {left = ts, room = most, ended = 0, open = 0, blocks = 0} (\a _ -> Just a) (const Nothing)

-- | A mistake for which no other way may be tried.
final :: Int
final = minBound

-- What is read is computed at once: put off it would hold the tokens that it was read from.
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
  FastParser p >>= f = FastParser (\s ok no -> p s (\a s' -> let FastParser q = f a in q s' ok no) no)
  {-# INLINE (>>=) #-}

instance Alternative FastParser where
  empty = FastParser (\s _ no -> no (room s))
  {-# INLINE empty #-}
  FastParser p <|> FastParser q =
    FastParser (\s ok no -> p s ok (\at -> if at == room s then q s ok no else no at))
  {-# INLINE (<|>) #-}

instance MonadPlus FastParser

instance MonadParsec Problem Input FastParser where
  parseError _ = empty
  {-# INLINE parseError #-}
  label _ p = p
  {-# INLINE label #-}
  hidden p = p
  {-# INLINE hidden #-}
  try (FastParser p) = FastParser (\s ok no -> p s ok (\at -> no (if at == final then final else room s)))
  lookAhead (FastParser p) = FastParser (\s ok no -> p s (\a _ -> ok a s) no)
  {-# INLINE lookAhead #-}
  notFollowedBy (FastParser p) =
    FastParser (\s ok no -> p s (\_ _ -> no (room s)) (\at -> if at == final then no final else ok () s))
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
    let Parsec.State {Parsec.stateInput = Input ts, Parsec.stateOffset} =
          f (stateOf s)
     in ok () s {left = ts, room = negate stateOffset}

-- | The state as megaparsec has it.
stateOf :: Ahead -> Parsec.State Input Problem
stateOf s =
  Parsec.State
    { Parsec.stateInput = Input (left s),
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
  parserState = FastParser (\s ok _ -> ok (memoryOf s) s)
  {-# INLINE parserState #-}
  modifyState f =
    FastParser
      ( \s ok _ ->
          let m =
                f (memoryOf s)
           in ok () s {ended = lastEnd m, open = bracketDepth m, blocks = blockDepth m}
      )
  {-# INLINE modifyState #-}

memoryOf :: Ahead -> ParserState
memoryOf s =
  ParserState {failures = [], lastEnd = ended s, bracketDepth = open s, blockDepth = blocks s, hasGivenUp = False}
{-# INLINE memoryOf #-}

-- | Lines and columns, which are not counted here.
nowhere :: [Token] -> Parsec.PosState Input
nowhere ts =
  Parsec.PosState
    { Parsec.pstateInput = Input ts,
      Parsec.pstateOffset = 0,
      Parsec.pstateSourcePos = Parsec.initialPos "",
      Parsec.pstateTabWidth = Parsec.defaultTabWidth,
      Parsec.pstateLinePrefix = ""
    }
