-- | Splits the text of a description into tokens.
--
-- The lexer never fails. It turns characters that form no token into a token for a mistake, which
-- the parser reports. An offset is the index of a character in the text, from 0.
module Machine.Lexer
  ( Token,
    Token_ (..),
    tokens,
    describe,
  )
where

import Base.Decimal (Leading (..))
import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region (..))
import Data.Char (chr, digitToInt, isAlpha, isAlphaNum, isDigit, isHexDigit, isSpace)
import Data.Foldable (find)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (quote)

-- | Token of a machine description, with its region.
type Token = Located Token_

-- | Tokens of a description; the last four constructors are mistakes.
data Token_
  = -- | word without quotation marks
    Name Text
  | -- | text in quotation marks, without them
    Text Text
  | -- | digits as written, and their value
    Numeral Text Double
  | -- | bracket, brace, @=@, operator of a formula, @..@ or @:@
    Sign Text
  | LineEnd
  | -- | character that no description contains
    Stray Char
  | -- | text without its closing quotation mark
    OpenText
  | -- | unknown escape sequence in a text
    BadEscape Text
  | -- | number with a letter right after it, or with too many digits
    BadNumber Text
  deriving stock (Eq, Show)

-- | Names a token in a report.
describe :: Token_ -> Text
describe t = case t of
  Name w -> quote w
  Text s -> "the text " <> quote s
  Numeral s _ -> "the number " <> s
  Sign s -> quote s
  LineEnd -> "the end of the line"
  Stray c -> "the character " <> quote (Text.singleton c)
  OpenText -> "a text without its closing quotation mark"
  BadEscape s -> quote s <> " in a text"
  BadNumber s -> quote s

-- | Lists all tokens of a text; the last one is always a 'LineEnd'. In a formula, which begins
-- after @=@, a minus is an operator and never part of a word.
tokens :: Text -> [Token]
tokens = tokensFrom False 0

-- | Lists the tokens of @rest@, the rest of a text; @at@ is the offset of its first character in
-- the text. @formula@ is true within a formula.
tokensFrom :: Bool -> Int -> Text -> [Token]
tokensFrom formula at rest = case Text.uncons rest of
  Nothing -> [Located (Region at at) LineEnd]
  Just (c, after)
    | isLineEnd c -> Located (Region at (at + 1)) LineEnd : tokensFrom False (at + 1) after
    | isSpace c -> tokensFrom formula (at + 1) after
    | "--" `Text.isPrefixOf` rest ->
      let size = Text.length (Text.takeWhile (not . isLineEnd) rest)
       in tokensFrom formula (at + size) (Text.drop size rest)
    | otherwise ->
      let (t, size) = token formula c rest
       in Located (Region at (at + size)) t :
          tokensFrom (formula || t == Sign "=") (at + size) (Text.drop size rest)

-- | Reads the first token of @rest@, and gives its length in characters. @formula@ is true within
-- a formula; @c@ is the first character of @rest@.
token :: Bool -> Char -> Text -> (Token_, Int)
token formula c rest
  | Just unit <- find (`Text.isPrefixOf` rest) ["mm/min", "mm/rev", "mm/s2", "rows/min", "rows/s"] =
    (Name unit, Text.length unit)
  | isAlpha c || c == '_' = let w = word formula rest in (Name w, Text.length w)
  | isDigit c = numeral rest
  | c == '"' = quoted (Text.drop 1 rest)
  | ".." `Text.isPrefixOf` rest = (Sign "..", 2)
  | c `elem` ("{}=:+-*/^()" :: String) = (Sign (Text.singleton c), 1)
  | otherwise = (Stray c, 1)

-- | Reads the word at the start of a text: letters, digits and underscores, with single minus
-- signs and points between them. In a formula a word has no minus signs and points.
word :: Bool -> Text -> Text
word formula rest = case Text.uncons rest' of
  Just (c, more)
    | not formula && c `elem` ("-." :: String) && Text.any isPart (Text.take 1 more) ->
      letters <> Text.singleton c <> word formula more
  _ -> letters
  where
    (letters, rest') = Text.span isPart rest

-- | Reads the number at the start of a text, and gives its length in characters. A letter right
-- after the number makes it a 'BadNumber'.
numeral :: Text -> (Token_, Int)
numeral rest
  | Text.any isPart (Text.take 1 remainder) = (BadNumber junk, Text.length junk)
  | otherwise = (maybe (BadNumber digits) (Numeral digits) parsed, consumed)
  where
    Leading {consumed, parsed, remainder} = Decimal.leading rest
    digits = Text.take consumed rest
    junk = digits <> Text.takeWhile (\c -> isPart c || c == '.') remainder

-- | Reads a text in quotation marks, and gives its length in characters with both marks. The
-- argument begins after the opening mark.
quoted :: Text -> (Token_, Int)
quoted = charactersOf "" 1
  where
    charactersOf done size rest = case Text.uncons rest of
      Just ('"', _) -> (Text (Text.pack (reverse done)), size + 1)
      Just ('\\', more) -> case escape more of
        Just (c, used) -> charactersOf (c : done) (size + 1 + used) (Text.drop used more)
        Nothing -> (BadEscape ("\\" <> Text.take 1 more), size + lineRest rest)
      Just (c, more) | not (isLineEnd c) -> charactersOf (c : done) (size + 1) more
      _ -> (OpenText, size)
    lineRest = Text.length . Text.takeWhile (not . isLineEnd)

-- | Decodes the escape sequence at the start of @rest@, which follows a backslash: the character
-- that it means, and its length in characters. 'Nothing' for an unknown sequence.
escape :: Text -> Maybe (Char, Int)
escape rest = case Text.uncons rest of
  Just ('n', _) -> Just ('\n', 1)
  Just ('r', _) -> Just ('\r', 1)
  Just ('t', _) -> Just ('\t', 1)
  Just ('"', _) -> Just ('"', 1)
  Just ('\\', _) -> Just ('\\', 1)
  Just ('u', more)
    | Text.length hex == 4 && Text.all isHexDigit hex ->
      Just (chr (Text.foldl' (\n d -> 16 * n + digitToInt d) 0 hex), 5)
    where
      hex = Text.take 4 more
  _ -> Nothing

isLineEnd :: Char -> Bool
isLineEnd c = c == '\n' || c == '\r'

-- | True for a letter, a digit or an underscore.
isPart :: Char -> Bool
isPart c = isAlphaNum c || c == '_'
