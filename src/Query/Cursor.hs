-- | The position of the cursor in the structure of a text, found from the tokens alone, so that it
-- is known in a text that is broken or not finished.
--
-- The brackets that are open at the cursor form levels. The innermost level contains the cursor. A
-- level has the tokens of its present construct, such as a statement or the arguments of a call.
module Query.Cursor
  ( Cursor (..),
    Level (..),
    Opening (..),
    BoundName (..),
    at,
    visible,
    wantsOperand,
    isWord,
    wordsOf,
    segments,
  )
where

import Base.Region (Located (..), Region (..))
import Data.Char (isAlpha, isDigit)
import Data.List (find, foldl')
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.HoleForm qualified as HoleForm
import Surface.Keyword qualified as Keyword
import Surface.Lexer qualified as Lexer
import Surface.Token (Numeral (..), Token (..), Token_ (..))

-- | The position of a cursor.
data Cursor = Cursor
  { -- | the region of the word that is being typed; empty if there is none
    typed :: Region,
    -- | true if nothing but space precedes this word on its line
    isLineStart :: Bool,
    -- | true if a number directly precedes this word on its line
    isAfterNumber :: Bool,
    -- | the open levels, the innermost first
    levels :: NonEmpty Level,
    -- | the tokens after this word
    following :: [Token]
  }

-- | A level of open brackets.
data Level = Level
  { opening :: Opening,
    -- | the tokens of the present construct at this level, the newest first. Of the text in inner
    -- brackets only the brackets are kept
    heads :: [Token],
    -- | the names that the level defines before the present construct, the newest first
    bound :: [BoundName],
    -- | the name that the present construct defines, and the parameters of a function
    pending :: [BoundName],
    -- | the keywords of the constructs of this level, the newest first
    given :: [Text]
  }

-- | The opening of a level.
data Opening
  = File
  | -- | the brace of a block of statements
    Statements
  | -- | the brace of a contour, or of a block in it
    Items
  | -- | the brace of a machining statement with this keyword
    SettingsOf Text
  | TableLines
  | -- | the parenthesis of a call of the function with this name
    CallOf Text
  | -- | the parenthesis of a cutter of this kind
    CutterOf Text
  | -- | the parenthesis of a cipher with this digit
    CipherOf Text
  | -- | the parenthesis of the parameters in the definition of a function
    Parameters
  | Parenthesis
  | ListBracket
  deriving stock (Eq, Show)

-- | A name that is defined at this region.
data BoundName = BoundName {name :: Text, region :: Region}
  deriving stock (Eq, Show)

-- | The cursor at an offset of a text. 'Nothing' inside a comment or a text in quotation marks.
at :: Text -> Int -> Maybe Cursor
at text offset
  | any inComment comments || any inQuotes tokens = Nothing
  | otherwise =
    Just
      Cursor
        { typed,
          isLineStart = Text.all (`elem` (" \t" :: String)) (lineBefore (Text.take from text)),
          isAfterNumber,
          levels = foldl' step (level File [] :| []) (map unitless before),
          following = filter ((>= max offset (end typed)) . start . place) tokens
        }
  where
    (tokens, comments) = Lexer.tokens 0 text
    inComment (Located r _) = start r < offset && offset <= end r
    inQuotes t = case shape t of
      Text _ -> start (place t) < offset && offset < end (place t)
      OpenText -> start (place t) < offset && offset <= end (place t)
      _ -> False
    isAfterNumber = case unitStart text offset of
      Just (digitsEnd, _) -> any (isNumberAt digitsEnd) tokens
      Nothing -> False
    isNumberAt digitsEnd t = case shape t of
      Number _ _ -> start (place t) < digitsEnd && digitsEnd <= end (place t)
      _ -> False
    touched = find (\t -> isWordToken t && touches (place t)) tokens
    touches (Region a b) = a < offset && offset <= b
    typed@(Region from _) = case (isAfterNumber, unitStart text offset, touched) of
      (True, Just (_, begin), _) -> Region begin (max offset (begin + unitLength begin))
      (_, _, Just t) -> place t
      _ -> Region offset offset
    unitLength begin = Text.length (Text.takeWhile isUnitPart (Text.drop begin text))
    before = takeWhile ((< from) . start . place) tokens
    unitless t = case shape t of
      Number n (Just _) | isAfterNumber, end (place t) > from -> t {shape = Number n Nothing}
      _ -> t

-- | The offset after the number before the cursor and the offset at which its unit begins. Only
-- letters, a stroke and spaces lie between the number and the cursor.
unitStart :: Text -> Int -> Maybe (Int, Int)
unitStart text offset
  | Text.any isDigit (Text.takeEnd 1 number) = Just (Text.length number, begin)
  | otherwise = Nothing
  where
    line = Text.take offset text
    letters = Text.takeWhileEnd isUnitPart line
    begin = offset - Text.length letters
    number = Text.dropWhileEnd (== ' ') (Text.dropEnd (Text.length letters) line)

isUnitPart :: Char -> Bool
isUnitPart c = isAlpha c || c == '/'

isWordToken :: Token -> Bool
isWordToken t = case shape t of
  Word _ -> True
  _ -> False

lineBefore :: Text -> Text
lineBefore = Text.takeWhileEnd (`notElem` ("\n\r" :: String))

level :: Opening -> [BoundName] -> Level
level opening bound = Level {opening, heads = [], bound, pending = [], given = []}

-- Steps over tokens

-- | The levels after one more token.
step :: NonEmpty Level -> Token -> NonEmpty Level
step levels token = case shape token of
  Symbol s
    | s `elem` ["(", "{", "["] ->
      let parent :| outer = begun token levels
       in openedBy s token parent :| (pushed token parent : outer)
    | s == ")" -> closed token isRound levels
    | s == "]" -> closed token (== ListBracket) levels
    | s == "}" -> closed token isBraced levels
  _ -> let top :| outer = begun token levels in named token (top :| outer)

-- | The levels at the beginning of a token. A keyword at the start of a line ends open brackets and
-- begins a new construct.
begun :: Token -> NonEmpty Level -> NonEmpty Level
begun token levels@(top :| outer) = case (shape token, opening top) of
  (Word w, File) | newLine token, w `elem` leading -> renewed w top :| outer
  (Word w, Statements) | newLine token, w `elem` leading -> renewed w top :| outer
  (Word w, Items)
    | ends w ["feed"] -> again
    | w `elem` ["cw", "ccw", "for", "if"] -> renewed w top :| outer
  (Word w, SettingsOf _)
    | ends w [] -> again
    | Keyword.beginsItem w,
      w `notElem` ["cw", "ccw", "for", "if"],
      not (any wantsOperand (listToMaybe (heads top))) ->
      renewed w top :| outer
  (Word w, TableLines) | ends w [] -> again
  (Word w, Parameters) | ends w [] -> again
  (Word w, o) | isRound o || o == ListBracket, ends w ["feed", "from"] -> again
  _ -> levels
  where
    leading = Keyword.statements <> Keyword.softStatements <> Keyword.blocks
    ends w others = newLine token && w `elem` Keyword.statements && w `notElem` others
    again = case NonEmpty.nonEmpty outer of
      Just rest -> begun token rest
      Nothing -> levels

-- | A level at the beginning of a construct with this keyword.
renewed :: Text -> Level -> Level
renewed keyword l =
  l
    { heads = [],
      bound = take 1 (pending l) <> bound l,
      pending = [],
      given = keyword : given l
    }

pushed :: Token -> Level -> Level
pushed token l = l {heads = token : heads l}

-- | The levels after a token that is no bracket. Keeps the name that the token defines.
named :: Token -> NonEmpty Level -> NonEmpty Level
named token (top :| outer) = case (shape token, opening top, outer) of
  (Word w, Parameters, parent : more)
    | not (isWord token ["in"]) ->
      pushed token top :| (parent {pending = pending parent <> [BoundName w (place token)]} : more)
  (Word w, _, _)
    | [k] <- heads top,
      isWord k ["let", "param", "table", "curve", "piece", "contour"] ->
      pushed token top {pending = [BoundName w (place token)]} :| outer
  _ -> pushed token top :| outer

-- | The level that a bracket opens. @parent@ is the level that contains the bracket.
openedBy :: Text -> Token -> Level -> Level
openedBy bracket token parent = case bracket of
  "[" -> level ListBracket []
  "{" -> braced parent
  _ -> level (parenthesis token parent) []

braced :: Level -> Level
braced parent = case reverse (heads parent) of
  first : rest -> case shape first of
    Word "contour" -> level Items []
    Word "table" -> level TableLines []
    Word k
      | k `elem` machiningWords <> HoleForm.words' -> level (SettingsOf k) []
      | k == "for", n : _ <- rest, Word w <- shape n -> level inner [BoundName w (place n)]
    _ -> level inner []
  [] -> level inner []
  where
    inner = if opening parent == Items then Items else Statements
    machiningWords = ["mill", "turn", "pocket", "rest", "face", "engrave", "vcarve", "drill"]

parenthesis :: Token -> Level -> Opening
parenthesis token parent = case heads parent of
  before : earlier | attached token -> case shape before of
    Word w
      | [k] <- earlier, isWord k ["let"] -> Parameters
      | any (`isWord` ["tool", "change"]) (take 1 (reverse earlier)), w `elem` cutters -> CutterOf w
      | otherwise -> CallOf w
    Number n Nothing | any (`isWord` ["cipher"]) earlier -> CipherOf (digits n)
    _ -> Parenthesis
  _ -> Parenthesis
  where
    cutters = ["mill", "drill", "tap", "threadmill", "turn", "cone", "vbit", "blade"]

-- | The levels after a closing bracket. Levels inside the one that it closes are dropped. A bracket
-- that closes nothing is dropped.
closed :: Token -> (Opening -> Bool) -> NonEmpty Level -> NonEmpty Level
closed token fits levels = case NonEmpty.break (fits . opening) levels of
  (inner, _ : parent : outer)
    | not (any (isBraced . opening) inner) || isBraced' -> pushed token parent :| outer
  _ -> levels
  where
    isBraced' = fits Statements

isRound :: Opening -> Bool
isRound o = case o of
  CallOf _ -> True
  CutterOf _ -> True
  CipherOf _ -> True
  Parameters -> True
  Parenthesis -> True
  File -> False
  Statements -> False
  Items -> False
  SettingsOf _ -> False
  TableLines -> False
  ListBracket -> False

isBraced :: Opening -> Bool
isBraced o = not (isRound o) && o /= ListBracket && o /= File

-- Facts about tokens

-- | True if a token is one of these words.
isWord :: Token -> [Text] -> Bool
isWord t ws = case shape t of
  Word w -> w `elem` ws
  _ -> False

-- | The words among tokens, in order.
wordsOf :: [Token] -> [Text]
wordsOf ts = [w | t <- ts, Word w <- [shape t]]

-- | True if an operand has to come after this token.
wantsOperand :: Token -> Bool
wantsOperand t = case shape t of
  Symbol s -> s `notElem` [")", "]", "}"]
  Word w -> w `elem` ["and", "or", "not", "by"]
  _ -> False

-- | Tokens in the order of the text, divided at the commas.
segments :: [Token] -> [[Token]]
segments ts = case break isComma ts of
  (segment, _ : rest) -> segment : segments rest
  (segment, []) -> [segment]
  where
    isComma t = shape t == Symbol ","

-- Names

-- | The names of the text that are visible at the cursor, the innermost first.
visible :: Cursor -> [BoundName]
visible Cursor {levels, following} =
  eachNames (NonEmpty.toList levels) following
    <> concat [parametersOf l <> bound l | l <- NonEmpty.toList levels]
  where
    parametersOf l = if any isFunction (take 1 (reverse (heads l))) then drop 1 (pending l) else []
    isFunction t = isWord t ["let"]

-- | The names that the lists around the cursor bind after it, as in @[e for x in list]@.
eachNames :: [Level] -> [Token] -> [BoundName]
eachNames open tokens = case (open, tokens) of
  (l : outer, t : rest)
    | isBraced (opening l) || opening l == File -> []
    | shape t `elem` map Symbol [")", "]"] -> eachNames outer rest
    | shape t `elem` map Symbol ["(", "["] -> eachNames (level Parenthesis [] : open) rest
    | opening l == ListBracket,
      isWord t ["for"],
      n : _ <- rest,
      Word w <- shape n ->
      BoundName w (place n) : eachNames open rest
    | otherwise -> eachNames open rest
  _ -> []
