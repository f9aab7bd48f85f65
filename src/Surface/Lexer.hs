-- | The lexer: tokens and comments from a text.
--
-- The lexer never fails. Text that is not a token becomes a 'BadNumber', an 'OpenText' or a 'Stray'
-- character, which the parser reports. An offset is the index of a character, from 0; the count
-- goes on from one file of a program to the next.
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

-- | The state of the lexer between two tokens.
data LexerState = LexerState
  { -- | the offset of the next character
    at :: Int,
    -- | true before the first token of a line
    isLineStart :: Bool,
    -- | true if the last token ends at the offset @at@, without a space after it
    isTouching :: Bool,
    -- | true after the keyword of a @machine@ statement
    isMachineNext :: Bool
  }

-- | All tokens and all comments of a text in order. The first character has the offset @begin@.
-- Each of the two lists is made by its own pass over the text, so that neither keeps the other in
-- memory.
tokens :: Int -> Text -> ([Token], [Located Text])
tokens begin text =
  (tokensFrom before text, if "--" `Text.isInfixOf` text then commentsFrom [] before text else [])
  where
    before = LexerState {at = begin, isLineStart = True, isTouching = False, isMachineNext = False}

-- | The tokens of a text as a lazy list, read in chunks. @before@ is the state at the start of the
-- text.
tokensFrom :: LexerState -> Text -> [Token]
tokensFrom before rest = case chunk chunkSize [] [] before rest of
  Chunk {ts, stopped, left} ->
    foldl (flip (:)) (if Text.null left then [] else tokensFrom stopped left) ts

-- | The comments @found@, which are given in reverse order, followed by those of a text. @before@
-- is the state at the start of the text.
commentsFrom :: [Located Text] -> LexerState -> Text -> [Located Text]
commentsFrom found before rest = case chunk chunkSize [] found before rest of
  Chunk {cs, stopped, left} -> if Text.null left then reverse cs else commentsFrom cs stopped left

-- | The number of tokens in a chunk.
chunkSize :: Int
chunkSize = 512

-- | Tokens @ts@ and comments @cs@ in reverse order, the text @left@ after them, and the state
-- @stopped@ of the lexer at the start of that text.
data Chunk = Chunk {ts :: [Token], cs :: [Located Text], stopped :: LexerState, left :: Text}

-- | Reads at most @count@ tokens and the comments between them. Adds them to the tokens @ts@ and
-- the comments @cs@, which are in reverse order. @before@ is the state at the start of the text
-- @rest@.
chunk :: Int -> [Token] -> [Located Text] -> LexerState -> Text -> Chunk
chunk count ts cs before rest = case if count <= 0 then Nothing else Text.uncons rest of
  Just (c, after)
    | isLineEnd c ->
      let next =
            LexerState
              { at = at before + 1,
                isLineStart = True,
                isTouching = False,
                isMachineNext = False
              }
       in chunk count ts cs next after
    | isBlank c -> chunk count ts cs before {at = at before + 1, isTouching = False} after
    | c == '-' && begins (== '-') after ->
      let (text, more) = Text.break isLineEnd rest
          region = Region (at before) (at before + Text.length text)
          comment = Located region text
          next = before {at = end region, isTouching = False}
       in comment `seq` chunk count ts (comment : cs) next more
    | otherwise ->
      case if isMachineNext before then machineName rest else token c rest of
        First shape consumed more ->
          let region = Region (at before) (at before + consumed)
              next =
                LexerState
                  { at = end region,
                    isLineStart = False,
                    isTouching = True,
                    isMachineNext = isLineStart before && shape == Word "machine"
                  }
              found =
                Token
                  { place = region,
                    shape,
                    newLine = isLineStart before,
                    attached = isTouching before
                  }
           in found `seq` chunk (count - 1) (found : ts) cs next more
  Nothing -> Chunk {ts, cs, stopped = before, left = rest}

-- | Tells if a text begins with a character that satisfies @holds@.
begins :: (Char -> Bool) -> Text -> Bool
begins holds rest = maybe False (holds . fst) (Text.uncons rest)

-- | The first token of a text, its length in characters, and the text after it.
data First = First Token_ Int {-# UNPACK #-} Text

-- | Reads the first token of the text @rest@, whose first character is @c@.
token :: Char -> Text -> First
token c rest
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
        First (Symbol two) 2 (Text.drop 2 rest)
      | c `elem` ("{}[]=+*/<>" :: String) -> sign (Text.singleton c)
      | otherwise -> First (Stray c) 1 (Text.drop 1 rest)
  where
    sign s = First (Symbol s) 1 (Text.drop 1 rest)
    two = Text.take 2 rest

-- | Reads the name of a machine, which may contain @.@ and @-@, or the quoted name of a file with a
-- machine description.
machineName :: Text -> First
machineName rest
  | "\"" `Text.isPrefixOf` rest = quoted rest
  | Text.null name =
    maybe (First (Stray ' ') 1 rest) (\(c, _) -> token c rest) (Text.uncons rest)
  | otherwise = First (Word name) (Text.length name) (Text.drop (Text.length name) rest)
  where
    name =
      fst (Text.breakOn "--" (Text.takeWhile (\c -> isAlphaNum c || c == '.' || c == '-') rest))

-- | Reads a text in quotation marks. If the closing mark is not on the same line, the token is
-- 'OpenText'.
quoted :: Text -> First
quoted rest = case Text.uncons after of
  Just ('"', more) -> First (Text inside) (Text.length inside + 2) more
  _ -> First OpenText (Text.length inside + 1) after
  where
    (inside, after) = Text.break (\c -> c == '"' || isLineEnd c) (Text.drop 1 rest)

-- | Reads a number and an optional unit on the same line.
numeral :: Text -> First
numeral rest = case Decimal.leading rest of
  Leading {consumed, parsed, remainder} -> case (parsed, unitAfter remainder) of
    (Just x, unit) | not (isMalformed (Text.take consumed rest) remainder unit) -> case unit of
      Just (UnitAfter u gap width) ->
        First
          (Number (Numeral (Text.take consumed rest) x) (Just u))
          (consumed + gap + width)
          (Text.drop (gap + width) remainder)
      Nothing -> First (Number (Numeral (Text.take consumed rest) x) Nothing) consumed remainder
    _ ->
      let (written, more) = Text.span (\c -> isWordPart c || c == '.') rest
       in First (BadNumber written) (Text.length written) more
  where
    -- True for a second decimal point, and for letters that touch the number and are not a unit.
    isMalformed digits after unit = case Text.uncons after of
      Just ('.', more) -> Text.any (== '.') digits && not (begins (== '.') more)
      Just (c, _) -> isWordPart c && maybe True (\(UnitAfter _ gap _) -> gap > 0) unit
      Nothing -> False

-- | A unit after a number, the count of spaces before the unit, and the length of the unit in
-- characters.
data UnitAfter = UnitAfter Unit Int Int

-- | Reads a unit at the start of a text, after any number of spaces; 'Nothing' if there is none.
unitAfter :: Text -> Maybe UnitAfter
unitAfter = go 0
  where
    go gap text = case Text.uncons text of
      Just (c, more)
        | isBlankInLine c -> go (gap + 1) more
        | isWordStart c ->
          (\(unit, _, consumed) -> UnitAfter unit gap consumed) <$> find (fits text) longestFirst
      _ -> Nothing
    fits word (_, name, _) = maybe False (not . begins isWordPart) (Text.stripPrefix name word)

-- | The units with their names and the lengths of the names, the longest first.
longestFirst :: [(Unit, Text, Int)]
longestFirst =
  sortOn
    (\(_, _, consumed) -> Down consumed)
    [(unit, unitName unit, Text.length (unitName unit)) | unit <- [minBound .. maxBound]]

isLineEnd :: Char -> Bool
isLineEnd c = c == '\n' || c == '\r'

-- | Tells if a character is white space. ASCII characters, which are most, need no Unicode tables.
isBlank :: Char -> Bool
isBlank c = c == ' ' || (c < '!' || c > '~') && isSpace c

isBlankInLine :: Char -> Bool
isBlankInLine c = isBlank c && not (isLineEnd c)

isWordStart :: Char -> Bool
isWordStart c = isAsciiLower c || isAsciiUpper c || c == '_' || c > '~' && isAlpha c

isWordPart :: Char -> Bool
isWordPart c = isAsciiLower c || isAsciiUpper c || isDigit c || c == '_' || c > '~' && isAlphaNum c
