-- | Text into tokens and comments. Total: whatever is no token becomes one of the
-- broken shapes and is reported by the parser where it stands.
module Surface.Lexer
  ( tokens,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region (..))
import Data.Char (isAlpha, isAlphaNum, isDigit, isSpace)
import Data.Foldable (find)
import Data.List (sortOn)
import Data.Ord (Down (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Token (Numeral (Numeral), Token (..), Token_ (..), Unit, unitName)

-- | What the lexer knows between two tokens.
data Before = Before
  { at :: Int,
    -- | nothing stands on this line yet
    fresh :: Bool,
    -- | the last token ends right here
    touching :: Bool,
    -- | the last token was the keyword of a @machine@ statement
    machine :: Bool
  }

-- | All tokens of a text and all its comments, in order; the first character has the offset given.
tokens :: Int -> Text -> ([Token], [Located Text])
tokens begin = go Before {at = begin, fresh = True, touching = False, machine = False}

go :: Before -> Text -> ([Token], [Located Text])
go before rest = case Text.uncons rest of
  Nothing -> ([], [])
  Just (c, after)
    | isLineEnd c -> go before {at = at before + 1, fresh = True, touching = False, machine = False} after
    | isSpace c -> go before {at = at before + 1, touching = False} after
    | "--" `Text.isPrefixOf` rest ->
      let comment = Text.takeWhile (not . isLineEnd) rest
          region = Region (at before) (at before + Text.length comment)
          (ts, cs) = go before {at = end region, touching = False} (Text.drop (Text.length comment) rest)
       in (ts, Located region comment : cs)
    | otherwise ->
      let (shape, size) = if machine before then machineName rest else token c rest
          region = Region (at before) (at before + size)
          next = Before {at = end region, fresh = False, touching = True, machine = fresh before && shape == Word "machine"}
          (ts, cs) = go next (Text.drop size rest)
       in (Token {place = region, shape, newLine = fresh before, attached = touching before} : ts, cs)

-- | The token at the beginning of a text, and its length.
token :: Char -> Text -> (Token_, Int)
token c rest
  | isDigit c = numeral rest
  | isWordStart c = let word = Text.takeWhile isWordPart rest in (Word word, Text.length word)
  | c == '"' = quoted rest
  | Text.take 2 rest `elem` ["..", "<=", ">=", "!="] = (Symbol (Text.take 2 rest), 2)
  | c `elem` ("(){}[],=+-*/<>" :: String) = (Symbol (Text.singleton c), 1)
  | otherwise = (Stray c, 1)

-- | The name of a machine: letters, digits, @.@ and @-@; a quoted text is the name of a description file.
machineName :: Text -> (Token_, Int)
machineName rest
  | "\"" `Text.isPrefixOf` rest = quoted rest
  | Text.null name = maybe (Stray ' ', 1) (\(c, _) -> token c rest) (Text.uncons rest)
  | otherwise = (Word name, Text.length name)
  where
    name = fst (Text.breakOn "--" (Text.takeWhile (\c -> isAlphaNum c || c == '.' || c == '-') rest))

-- | A text in quotation marks, on one line.
quoted :: Text -> (Token_, Int)
quoted rest = case Text.uncons after of
  Just ('"', _) -> (Text inside, Text.length inside + 2)
  _ -> (OpenText, Text.length inside + 1)
  where
    (inside, after) = Text.break (\c -> c == '"' || isLineEnd c) (Text.drop 1 rest)

-- | A number with the unit that may stand behind it on its line.
numeral :: Text -> (Token_, Int)
numeral rest
  | junk = (BadNumber written, Text.length written)
  | otherwise = case Decimal.amount digits of
    Just value -> case unitBehind (Text.drop size rest) of
      Just (unit, gap, length') -> (Number (Numeral digits value) (Just unit), size + gap + length')
      Nothing -> (Number (Numeral digits value) Nothing, size)
    Nothing -> (BadNumber written, Text.length written)
  where
    whole = Text.takeWhile isDigit rest
    fraction = case Text.uncons (Text.drop (Text.length whole) rest) of
      Just ('.', more) | Text.any isDigit (Text.take 1 more) -> "." <> Text.takeWhile isDigit more
      _ -> ""
    digits = whole <> fraction
    size = Text.length digits
    -- Letters or a further decimal point that touch the number and are no unit.
    tailWord = Text.takeWhile isWordPart (Text.drop size rest)
    extraPoint = not (Text.null fraction) && ".." /= Text.take 2 (Text.drop size rest) && "." == Text.take 1 (Text.drop size rest)
    junk = extraPoint || not (Text.null tailWord) && maybe True (\(_, gap, _) -> gap > 0) (unitBehind (Text.drop size rest))
    written = Text.takeWhile (\c -> isWordPart c || c == '.') rest

-- | A unit at most some spaces away: the unit, the spaces before it, its length.
unitBehind :: Text -> Maybe (Unit, Int, Int)
unitBehind rest = found <$> find fits longestFirst
  where
    (gap, word) = Text.span (\c -> isSpace c && not (isLineEnd c)) rest
    fits unit =
      unitName unit `Text.isPrefixOf` word
        && not (Text.any isWordPart (Text.take 1 (Text.drop (Text.length (unitName unit)) word)))
    found unit = (unit, Text.length gap, Text.length (unitName unit))
    longestFirst = sortOn (Down . Text.length . unitName) [minBound .. maxBound]

isLineEnd :: Char -> Bool
isLineEnd c = c == '\n' || c == '\r'

isWordStart :: Char -> Bool
isWordStart c = isAlpha c || c == '_'

isWordPart :: Char -> Bool
isWordPart c = isAlphaNum c || c == '_'
