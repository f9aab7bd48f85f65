-- | The regions of a text that an editor can fold: brackets over several lines, and comments. They
-- are found from the tokens alone, so that they are known in a broken text.
module Query.Folding
  ( Folding (..),
    foldings,
  )
where

import Base.Region (Located (..), Region (..), Source)
import Base.Region qualified as Region
import Data.Text qualified as Text
import Surface.Lexer qualified as Lexer
import Surface.Token (Token (..), Token_ (..))

-- | Lines that can be folded, from 0. The last line of brackets, which has the closing one, is not
-- among them.
data Folding = Folding {firstLine :: Int, lastLine :: Int, isComment :: Bool}
  deriving stock (Eq, Show)

-- | The foldings of the program's own text.
foldings :: Source -> [Folding]
foldings source =
  [ Folding {firstLine = a, lastLine = b - 1, isComment = False}
    | Region from to <- brackets [] tokens,
      let (a, b) = (lineOf from, lineOf to),
      b - 1 > a
  ]
    <> [ Folding {firstLine = a, lastLine = b, isComment = True}
         | (a, b) <- runs [lineOf (start r) | Located r _ <- comments, isAlone r],
           b > a
       ]
  where
    (tokens, comments) = Lexer.tokens 0 (Region.text source)
    lineOf at = Region.line (Region.position source at) - 1
    isAlone r = "--" `Text.isPrefixOf` Text.strip (Region.lineText source (start r))

-- | The regions of pairs of brackets, from the opening one to the closing one.
brackets :: [Int] -> [Token] -> [Region]
brackets open tokens = case tokens of
  [] -> []
  t : rest -> case (shape t, open) of
    (Symbol s, _) | s `elem` ["(", "[", "{"] -> brackets (start (place t) : open) rest
    (Symbol s, from : outer)
      | s `elem` [")", "]", "}"] -> Region from (start (place t)) : brackets outer rest
    _ -> brackets open rest

-- | Consecutive numbers as pairs of the first and the last one.
runs :: [Int] -> [(Int, Int)]
runs numbers = case numbers of
  [] -> []
  n : rest -> go n n rest
  where
    go a b ns = case ns of
      n : rest | n == b + 1 -> go a n rest
      _ -> (a, b) : runs ns
