-- | The tokens of the source text for every line of a printed program.
--
-- The printer may add or drop some tokens of the source: parentheses, braces, @else@ and plus
-- signs. These tokens are called optional. Each printed token is matched with the next equal token
-- of the source. The formatter places comments and blank lines by these matches.
module Surface.SourceLine
  ( SourceLine (..),
    withSources,
    isClosing,
    isOpening,
  )
where

import Data.Text qualified as Text
import Surface.Alignment (AlignedLine)
import Surface.Alignment qualified as Alignment
import Surface.Lexer qualified as Lexer
import Surface.Token (Token (..), Token_ (..))

-- | A printed line, its tokens, and for each token its match in the source: 'Nothing' for a token
-- without a match.
data SourceLine = SourceLine {row :: AlignedLine, shapes :: [Token_], sources :: [Maybe Token]}
  deriving stock (Eq, Show)

-- | Matches the printed lines @rows@ with the tokens of their source.
withSources :: [Token] -> [AlignedLine] -> [SourceLine]
withSources source rows = distribute rows (zip printed (match source (map shape printed)))
  where
    printed = fst (Lexer.tokens 0 (Text.unlines (map Alignment.unaligned rows)))

-- | Distributes printed tokens to the lines that they are printed on. Each token comes with the
-- matching token of the source, 'Nothing' if there is none.
distribute :: [AlignedLine] -> [(Token, Maybe Token)] -> [SourceLine]
distribute rows tokens = case (rows, tokens) of
  (row : more, first : rest) ->
    let (own, others) = break (newLine . fst) rest
     in SourceLine
          { row,
            shapes = map (shape . fst) (first : own),
            sources = map snd (first : own)
          } :
        distribute more others
  _ -> []

-- | Matches each printed token with a token of the source. The search begins after the last matched
-- token of the source and ends at the first token that is not optional. A printed token without a
-- match uses up no source tokens, so later printed tokens can still match them.
match :: [Token] -> [Token_] -> [Maybe Token]
match source printed = case printed of
  [] -> []
  token : rest -> case break ((== token) . shape) candidates of
    (before, found : _) -> Just found : match (drop (length before + 1) source) rest
    _ -> Nothing : match source rest
    where
      candidates
        | isOptional token = takeWhile (isOptional . shape) source
        | otherwise =
          let (optional, required) = span (isOptional . shape) source
           in optional <> take 1 required

-- | Tells if a token is optional: the printer may add or drop it.
isOptional :: Token_ -> Bool
isOptional token = token `elem` Word "else" : map Symbol ["(", ")", "{", "}", "+"]

-- | Tells if a printed line begins with a closing bracket.
isClosing :: SourceLine -> Bool
isClosing line = take 1 (shapes line) `elem` map (pure . Symbol) [")", "]", "}"]

-- | Tells if a printed line opens a block: it ends with an opening brace.
isOpening :: SourceLine -> Bool
isOpening line = drop (length (shapes line) - 1) (shapes line) == [Symbol "{"]
