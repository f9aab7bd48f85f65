-- | Where the rows of a printed program come from in the text that was read.
--
-- The printed program has the tokens of the text but for brackets and words that may be there or
-- not, so its rows find their places by their tokens. Comments and blank lines follow by these
-- places.
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

-- | A row, and where its tokens stand in the text that was read; some may not stand there.
data SourceLine = SourceLine {row :: AlignedLine, shapes :: [Token_], sources :: [Maybe Token]}
  deriving stock (Eq, Show)

-- | Rows with the tokens that they come from.
withSources :: [Token] -> [AlignedLine] -> [SourceLine]
withSources source rows = dealt rows (zip printed (match source (map shape printed)))
  where
    printed = fst (Lexer.tokens 0 (Text.unlines (map Alignment.unaligned rows)))

-- | To each row its tokens.
dealt :: [AlignedLine] -> [(Token, Maybe Token)] -> [SourceLine]
dealt rows tokens = case (rows, tokens) of
  (row : more, first : rest) ->
    let (own, others) = break (newLine . fst) rest
     in SourceLine {row, shapes = map (shape . fst) (first : own), sources = map snd (first : own)} :
        dealt more others
  _ -> []

-- | For each printed token the one that it comes from.
match :: [Token] -> [Token_] -> [Maybe Token]
match source printed = case printed of
  [] -> []
  token : rest -> case break ((== token) . shape) reach of
    (before, found : _) -> Just found : match (drop (length before + 1) source) rest
    _ -> Nothing : match source rest
    where
      reach
        | optional token = takeWhile (optional . shape) source
        | otherwise = let (loose, firm) = span (optional . shape) source in loose <> take 1 firm

-- | Tokens that the printed program may have more or fewer of.
optional :: Token_ -> Bool
optional token = token `elem` Word "else" : map Symbol ["(", ")", "{", "}", "+"]

-- | Whether a row closes brackets that were opened above it.
isClosing :: SourceLine -> Bool
isClosing anchor = take 1 (shapes anchor) `elem` map (pure . Symbol) [")", "]", "}"]

-- | Whether a row opens a block.
isOpening :: SourceLine -> Bool
isOpening anchor = drop (length (shapes anchor) - 1) (shapes anchor) == [Symbol "{"]
