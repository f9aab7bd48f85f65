-- | The fast parser, for programs without a mistake. "Surface.Parser" tries it first.
module Surface.Parser.Fast
  ( parse,
  )
where

import Data.Text (Text)
import Surface.Combinator.Fast qualified as FastCombinator
import Surface.FileUnit qualified as FileUnit
import Surface.Grammar qualified as Grammar
import Surface.Lexer qualified as Lexer
import Surface.Syntax

-- | Parses a program of at most @limit@ tokens whose text begins at the offset @begin@, the index
-- of its first character. 'Nothing' if the program has more tokens or a mistake.
--
-- The tokens are produced on demand and not kept. The function is never inlined, so that this stays
-- true. If it were inlined next to the call of the explaining parser, GHC would make the tokens
-- once for both parsers and keep all of them.
parse :: Int -> Int -> Text -> Maybe Program
parse limit begin text = case Lexer.tokens begin text of
  (tokens, comments) ->
    (\statements -> FileUnit.program begin statements comments)
      <$> FastCombinator.run limit Grammar.fastProgram tokens
{-# NOINLINE parse #-}
