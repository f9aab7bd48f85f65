{-# LANGUAGE BangPatterns #-}

-- | Text into tokens and comments. Total: whatever is no token becomes one of the
-- broken shapes and is reported by the parser where it stands.
module Surface.Lexer
  ( tokens,
  )
where

import Base.Decimal (Leading (..))
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

-- | All tokens of a text and all its comments, in order; the first character has the offset given.
-- Each of the two is read for itself, so that none of them waits in memory for the other.
tokens :: Int -> Text -> ([Token], [Located Text])
tokens begin text =
  (tokensFrom before text, if "--" `Text.isInfixOf` text then remarks [] before text else [])
  where
    before = Before {at = begin, fresh = True, touching = False, machine = False}

-- | The tokens, piece by piece: what nobody asks for is not read.
tokensFrom :: Before -> Text -> [Token]
tokensFrom before rest = case piece pieceSize [] [] before rest of
  Piece {ts, stopped, left} ->
    foldl (flip (:)) (if Text.null left then [] else tokensFrom stopped left) ts

-- | The comments behind some others, of which the last one comes first.
remarks :: [Located Text] -> Before -> Text -> [Located Text]
remarks found before rest = case piece pieceSize [] found before rest of
  Piece {cs, stopped, left} -> if Text.null left then reverse cs else remarks cs stopped left

-- | So many tokens are read at once.
pieceSize :: Int
pieceSize = 512

-- | Some tokens and comments, the last ones first, and what is left of the text.
data Piece = Piece {ts :: [Token], cs :: [Located Text], stopped :: Before, left :: Text}

-- | Read so many tokens.
piece :: Int -> [Token] -> [Located Text] -> Before -> Text -> Piece
piece !count ts cs before rest = case Text.uncons rest of
  Just (c, after)
    | count <= 0 -> Piece {ts, cs, stopped = before, left = rest}
    | isLineEnd c ->
      piece
        count
        ts
        cs
        Before {at = at before + 1, fresh = True, touching = False, machine = False}
        after
    | isBlank c -> piece count ts cs before {at = at before + 1, touching = False} after
    | c == '-' && begins (== '-') after ->
      let (comment, more) = Text.break isLineEnd rest
          region = Region (at before) (at before + Text.length comment)
          !remark = Located region comment
       in piece count ts (remark : cs) before {at = end region, touching = False} more
    | otherwise ->
      case if machine before then machineName rest else token c after rest of
        First shape size more ->
          let region = Region (at before) (at before + size)
              next =
                Before
                  { at = end region,
                    fresh = False,
                    touching = True,
                    machine = fresh before && shape == Word "machine"
                  }
              found =
                Token {place = region, shape, newLine = fresh before, attached = touching before}
           in found `seq` piece (count - 1) (found : ts) cs next more
  Nothing -> Piece {ts, cs, stopped = before, left = rest}

-- | Whether a text begins with a character for which something holds.
begins :: (Char -> Bool) -> Text -> Bool
begins holds rest = maybe False (holds . fst) (Text.uncons rest)
{-# INLINE begins #-}

-- | The token that a text begins with, its length, and the text behind it.
data First = First Token_ Int {-# UNPACK #-} Text

-- | The first token of a text, by its first character and what stands behind this.
token :: Char -> Text -> Text -> First
token c !after !rest
  | isDigit c = numeral rest
  | isWordStart c =
    let (word, more) = Text.span isWordPart rest in First (Word word) (Text.length word) more
  | otherwise = case c of
    '(' -> sign "("
    ')' -> sign ")"
    ',' -> sign ","
    '-' -> sign "-"
    '"' -> quoted rest
    _
      | c `elem` (".<>!" :: String),
        two `elem` ["..", "<=", ">=", "!="] ->
        First (Symbol two) 2 (Text.drop 1 after)
      | c `elem` ("{}[]=+*/<>" :: String) -> sign (Text.singleton c)
      | otherwise -> First (Stray c) 1 after
  where
    sign s = First (Symbol s) 1 after
    two = Text.take 2 rest

-- | The name of a machine: letters, digits, @.@ and @-@; a quoted text is the name of a description
-- file.
machineName :: Text -> First
machineName rest
  | "\"" `Text.isPrefixOf` rest = quoted rest
  | Text.null name =
    maybe (First (Stray ' ') 1 rest) (\(c, after) -> token c after rest) (Text.uncons rest)
  | otherwise = First (Word name) (Text.length name) (Text.drop (Text.length name) rest)
  where
    name =
      fst (Text.breakOn "--" (Text.takeWhile (\c -> isAlphaNum c || c == '.' || c == '-') rest))

-- | A text in quotation marks, on one line.
quoted :: Text -> First
quoted rest = case Text.uncons after of
  Just ('"', more) -> First (Text inside) (Text.length inside + 2) more
  _ -> First OpenText (Text.length inside + 1) after
  where
    (inside, after) = Text.break (\c -> c == '"' || isLineEnd c) (Text.drop 1 rest)

-- | A number with the unit that may stand behind it on its line.
numeral :: Text -> First
numeral rest = case Decimal.leading rest of
  Leading {size, worth, behind} -> case (worth, unitBehind behind) of
    (Just x, unit) | not (junk (Text.take size rest) behind unit) -> case unit of
      Just (Behind u before length') ->
        First
          (Number (Numeral (Text.take size rest) x) (Just u))
          (size + before + length')
          (Text.drop (before + length') behind)
      Nothing -> First (Number (Numeral (Text.take size rest) x) Nothing) size behind
    _ ->
      let (written, more) =
            Text.span (\c -> isWordPart c || c == '.') rest
       in First (BadNumber written) (Text.length written) more
  where
    -- Letters or a further decimal point that touch the number and are no unit.
    junk digits behind unit = case Text.uncons behind of
      Just ('.', more) -> Text.any (== '.') digits && not (begins (== '.') more)
      Just (c, _) -> isWordPart c && maybe True (\(Behind _ gap _) -> gap > 0) unit
      Nothing -> False

-- | A unit behind a number, the spaces before it, its length.
data Behind = Behind Unit Int Int

-- | A unit at most some spaces away.
unitBehind :: Text -> Maybe Behind
unitBehind = go 0
  where
    go gap text = case Text.uncons text of
      Just (c, more)
        | isBlankInLine c -> go (gap + 1) more
        | isWordStart c ->
          (\(unit, _, size) -> Behind unit gap size) <$> find (fits text) longestFirst
      _ -> Nothing
    fits word (_, name, _) = maybe False (not . begins isWordPart) (Text.stripPrefix name word)

-- | The units with their names and the lengths of these.
longestFirst :: [(Unit, Text, Int)]
longestFirst =
  sortOn
    (\(_, _, size) -> Down size)
    [(unit, unitName unit, Text.length (unitName unit)) | unit <- [minBound .. maxBound]]

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
