{-# LANGUAGE BangPatterns #-}

-- | Text into tokens and comments. Total: whatever is no token becomes one of the
-- broken shapes and is reported by the parser where it stands.
module Surface.Lexer
  ( tokens,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region (..))
import Data.Char (isAlpha, isAlphaNum, isAsciiLower, isAsciiUpper, isDigit, isSpace)
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

-- | All tokens of a text and all its comments, in order; the first character has the offset given. Each of the two is
-- read for itself, so that none of them waits in memory for the other.
tokens :: Int -> Text -> ([Token], [Located Text])
tokens begin text = (tokensFrom before text, if "--" `Text.isInfixOf` text then remarks [] before text else [])
  where
    before = Before {at = begin, fresh = True, touching = False, machine = False}

-- | The tokens, piece by piece: what nobody asks for is not read.
tokensFrom :: Before -> Text -> [Token]
tokensFrom before rest = case piece pieceSize [] [] before rest of
  Piece {ts, stopped, left} -> foldl (flip (:)) (if Text.null left then [] else tokensFrom stopped left) ts

-- | The comments behind some others, of which the last one comes first.
remarks :: [Located Text] -> Before -> Text -> [Located Text]
remarks found before rest = case piece pieceSize [] found before rest of
  Piece {cs, stopped, left} -> if Text.null left then reverse cs else remarks cs stopped left

-- | So many tokens are read at once.
pieceSize :: Int
pieceSize = 4096

-- | Some tokens and comments, the last ones first, and what is left of the text.
data Piece = Piece {ts :: [Token], cs :: [Located Text], stopped :: Before, left :: Text}

-- | Read so many tokens.
piece :: Int -> [Token] -> [Located Text] -> Before -> Text -> Piece
piece count ts cs before rest = case Text.uncons rest of
  Just (c, after)
    | count <= 0 -> Piece {ts, cs, stopped = before, left = rest}
    | isLineEnd c -> piece count ts cs Before {at = at before + 1, fresh = True, touching = False, machine = False} after
    | isBlank c -> piece count ts cs before {at = at before + 1, touching = False} after
    | c == '-' && begins (== '-') after ->
      let (comment, more) = Text.break isLineEnd rest
          region = Region (at before) (at before + Text.length comment)
          !remark = Located region comment
       in piece count ts (remark : cs) before {at = end region, touching = False} more
    | otherwise ->
      let (shape, size) = if machine before then machineName rest else token c rest
          region = Region (at before) (at before + size)
          next = Before {at = end region, fresh = False, touching = True, machine = fresh before && shape == Word "machine"}
          !found = Token {place = region, shape, newLine = fresh before, attached = touching before}
       in piece (count - 1) (found : ts) cs next (Text.drop size rest)
  Nothing -> Piece {ts, cs, stopped = before, left = rest}

-- | Whether a text begins with a character for which something holds.
begins :: (Char -> Bool) -> Text -> Bool
begins holds rest = maybe False (holds . fst) (Text.uncons rest)
{-# INLINE begins #-}

-- | The token at the beginning of a text, and its length.
token :: Char -> Text -> (Token_, Int)
token c rest
  | isDigit c = numeral rest
  | isWordStart c = let word = Text.takeWhile isWordPart rest in (Word word, Text.length word)
  | c == '"' = quoted rest
  | otherwise = case c of
    '(' -> (Symbol "(", 1)
    ')' -> (Symbol ")", 1)
    ',' -> (Symbol ",", 1)
    '-' -> (Symbol "-", 1)
    _
      | Text.take 2 rest `elem` ["..", "<=", ">=", "!="] -> (Symbol (Text.take 2 rest), 2)
      | c `elem` ("{}[]=+*/<>" :: String) -> (Symbol (Text.singleton c), 1)
      | otherwise -> (Stray c, 1)

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
    Just value -> case unit of
      Just (u, gap, length') -> (Number (Numeral digits value) (Just u), size + gap + length')
      Nothing -> (Number (Numeral digits value) Nothing, size)
    Nothing -> (BadNumber written, Text.length written)
  where
    (whole, afterWhole) = Text.span isDigit rest
    wholeSize = Text.length whole
    size = case Text.uncons afterWhole of
      Just ('.', more) | begins isDigit more -> wholeSize + 1 + Text.length (Text.takeWhile isDigit more)
      _ -> wholeSize
    digits = Text.take size rest
    after = Text.drop size rest
    unit = unitBehind after
    -- Letters or a further decimal point that touch the number and are no unit.
    extraPoint = size > wholeSize && begins (== '.') after && ".." /= Text.take 2 after
    junk = extraPoint || begins isWordPart after && maybe True (\(_, gap, _) -> gap > 0) unit
    written = Text.takeWhile (\c -> isWordPart c || c == '.') rest

-- | A unit at most some spaces away: the unit, the spaces before it, its length.
unitBehind :: Text -> Maybe (Unit, Int, Int)
unitBehind rest
  | begins isWordStart word = found <$> find fits longestFirst
  | otherwise = Nothing
  where
    (gap, word) = Text.span isBlankInLine rest
    fits (_, name, _) = maybe False (not . begins isWordPart) (Text.stripPrefix name word)
    found (unit, _, size) = (unit, Text.length gap, size)

-- | The units with their names and the lengths of these.
longestFirst :: [(Unit, Text, Int)]
longestFirst = sortOn (\(_, _, size) -> Down size) [(unit, unitName unit, Text.length (unitName unit)) | unit <- [minBound .. maxBound]]

isLineEnd :: Char -> Bool
isLineEnd c = c == '\n' || c == '\r'

-- | Most characters are those of ASCII, of which the answer is known without tables.
isBlank :: Char -> Bool
isBlank c = c == ' ' || (c < '!' || c > '~') && isSpace c

isBlankInLine :: Char -> Bool
isBlankInLine c = isBlank c && not (isLineEnd c)

isWordStart :: Char -> Bool
isWordStart c = isAsciiLower c || isAsciiUpper c || c == '_' || c > '~' && isAlpha c

isWordPart :: Char -> Bool
isWordPart c = isAsciiLower c || isAsciiUpper c || isDigit c || c == '_' || c > '~' && isAlphaNum c
