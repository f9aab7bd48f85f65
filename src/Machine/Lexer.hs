-- | The text of a description into tokens. Total: what is no token becomes a broken one, which the
-- parser reports.
module Machine.Lexer
  ( Token,
    Token_ (..),
    tokens,
    describe,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region (..))
import Data.Char (chr, digitToInt, isAlpha, isAlphaNum, isDigit, isHexDigit, isSpace)
import Data.Foldable (find)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (quote)

type Token = Located Token_

data Token_
  = Name Text
  | Text Text
  | -- | as it is written, and its value
    Numeral Text Double
  | -- | a bracket, a sign of a formula, @..@ or @:@
    Sign Text
  | LineEnd
  | -- | a character that has no place in a description
    Stray Char
  | -- | a text without its end
    OpenText
  | -- | a text with a backslash before what it cannot stand before
    BadEscape Text
  | BadNumber Text
  deriving stock (Eq, Show)

-- | What a token is called in a report.
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

-- | All tokens of a text, the end of its last line too. Behind @=@ a minus belongs to no word.
tokens :: Text -> [Token]
tokens = go False 0

go :: Bool -> Int -> Text -> [Token]
go formula at rest = case Text.uncons rest of
  Nothing -> [Located (Region at at) LineEnd]
  Just (c, after)
    | isLineEnd c -> Located (Region at (at + 1)) LineEnd : go False (at + 1) after
    | isSpace c -> go formula (at + 1) after
    | "--" `Text.isPrefixOf` rest ->
      let size =
            Text.length (Text.takeWhile (not . isLineEnd) rest)
       in go formula (at + size) (Text.drop size rest)
    | otherwise ->
      let (t, size) = token formula c rest
       in Located (Region at (at + size)) t :
          go (formula || t == Sign "=") (at + size) (Text.drop size rest)

-- | The token at the beginning of a text, and its length.
token :: Bool -> Char -> Text -> (Token_, Int)
token formula c rest
  | Just unit <- find (`Text.isPrefixOf` rest) ["mm/min", "mm/s2"] = (Name unit, Text.length unit)
  | isAlpha c || c == '_' = let w = word formula rest in (Name w, Text.length w)
  | isDigit c = numeral rest
  | c == '"' = quoted (Text.drop 1 rest)
  | ".." `Text.isPrefixOf` rest = (Sign "..", 2)
  | c `elem` ("{}=:+-*/^()" :: String) = (Sign (Text.singleton c), 1)
  | otherwise = (Stray c, 1)

-- | Letters and digits, with single minus signs and points between them.
word :: Bool -> Text -> Text
word formula rest = case Text.uncons behind of
  Just (c, more)
    | not formula && c `elem` ("-." :: String) && Text.any isPart (Text.take 1 more) ->
      piece <> Text.singleton c <> word formula more
  _ -> piece
  where
    (piece, behind) = Text.span isPart rest

numeral :: Text -> (Token_, Int)
numeral rest
  | Text.any isPart (Text.take 1 behind) = (BadNumber junk, Text.length junk)
  | otherwise = case Decimal.amount digits of
    Just v -> (Numeral digits v, Text.length digits)
    Nothing -> (BadNumber digits, Text.length digits)
  where
    whole = Text.takeWhile isDigit rest
    fraction = case Text.uncons (Text.drop (Text.length whole) rest) of
      Just ('.', more) | Text.any isDigit (Text.take 1 more) -> "." <> Text.takeWhile isDigit more
      _ -> ""
    digits = whole <> fraction
    behind = Text.drop (Text.length digits) rest
    junk = digits <> Text.takeWhile (\c -> isPart c || c == '.') behind

-- | A text behind its first quotation mark, and its length with both.
quoted :: Text -> (Token_, Int)
quoted = inside "" 1
  where
    inside done size rest = case Text.uncons rest of
      Just ('"', _) -> (Text (Text.pack (reverse done)), size + 1)
      Just ('\\', more) -> case escape more of
        Just (c, used) -> inside (c : done) (size + 1 + used) (Text.drop used more)
        Nothing -> (BadEscape ("\\" <> Text.take 1 more), size + lineRest rest)
      Just (c, more) | not (isLineEnd c) -> inside (c : done) (size + 1) more
      _ -> (OpenText, size)
    lineRest = Text.length . Text.takeWhile (not . isLineEnd)

-- | What stands behind a backslash: the character, and how many characters say so.
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

isPart :: Char -> Bool
isPart c = isAlphaNum c || c == '_'
