-- | Recognises the lines of other languages: G-code, APT, C, Python and Basic.
module Surface.ForeignLine
  ( ForeignLanguage (..),
    Reading (..),
    readLines,
  )
where

import Data.Char (isAlpha, isAlphaNum, isAsciiUpper, isDigit, isLower, isSpace)
import Data.List (mapAccumL)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Keyword qualified as Keyword

-- | A language that is no part program.
data ForeignLanguage = GCode | Apt | C | Python | Basic
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | A line: not of the language, or of it, with the statements that say the same. They are empty if
-- there are none.
data Reading = Own | Other Text
  deriving stock (Eq, Show)

-- | Reads the lines of a text as lines of a language.
readLines :: ForeignLanguage -> [Text] -> [Reading]
readLines language ls = case language of
  GCode -> snd (mapAccumL gCode startOfTape ls)
  Apt -> map apt ls
  C -> snd (mapAccumL c 0 ls)
  Python -> snd (mapAccumL python Nothing ls)
  Basic -> map basic ls

-- G-code

-- | Modal state of G-code: the last coordinates as written, the number of the last motion, and the
-- speed of the spindle. The flag is true after G20 or G91, whose coordinates are not translated.
data Modal = Modal
  { x :: Maybe Text,
    y :: Maybe Text,
    z :: Maybe Text,
    motion :: Int,
    speed :: Maybe Text,
    isOdd :: Bool
  }

startOfTape :: Modal
startOfTape =
  Modal {x = Nothing, y = Nothing, z = Nothing, motion = 0, speed = Nothing, isOdd = False}

gCode :: Modal -> Text -> (Modal, Reading)
gCode modal line = case wordsOfFrame (Text.strip line) of
  Just ws
    | isFrame ws ->
      let modal' = foldl modalWord modal ws
       in (modal', Other (Text.intercalate "\n" (statements modal' ws)))
  _ -> (modal, if Text.strip line == "%" then Other "" else Own)
  where
    isFrame ws = case dropWhile ((`elem` ['N', 'O']) . fst) ws of
      [] -> not (null ws)
      (letter, _) : _ -> letter `elem` ("GMTSFXYZIJ" :: String)

-- | Letters and numbers of a frame, without its comments. 'Nothing' for a line with anything else.
wordsOfFrame :: Text -> Maybe [(Char, Text)]
wordsOfFrame line = case Text.uncons (withoutComments line) of
  Nothing -> Nothing
  Just _ -> go (if isSmall then Text.toUpper (withoutComments line) else withoutComments line)
  where
    -- In small letters, only a line that begins with g, m or n and a digit is G-code.
    isSmall = Text.unpack (Text.take 2 line) `elem` [[l, d] | l <- "gmn", d <- ['0' .. '9']]
    go text = case Text.uncons (Text.stripStart text) of
      Nothing -> Just []
      Just (letter, rest)
        | isAsciiUpper letter,
          (number, more) <- Text.span (\d -> isDigit d || d `elem` ("+-." :: String)) rest,
          Text.any isDigit number ->
          ((letter, Text.dropWhile (== '+') number) :) <$> go more
        | otherwise -> Nothing

-- | A frame without comments in parentheses or after a semicolon.
withoutComments :: Text -> Text
withoutComments line = Text.strip (go (Text.takeWhile (/= ';') line))
  where
    go text = case Text.breakOn "(" text of
      (kept, rest)
        | Text.null rest -> kept
        | otherwise -> kept <> go (Text.drop 1 (Text.dropWhile (/= ')') rest))

modalWord :: Modal -> (Char, Text) -> Modal
modalWord m (letter, number) = case (letter, code number) of
  ('X', _) -> m {x = Just (decimal number)}
  ('Y', _) -> m {y = Just (decimal number)}
  ('Z', _) -> m {z = Just (decimal number)}
  ('S', _) -> m {speed = Just (decimal number)}
  ('G', n)
    | n `elem` [0, 1, 2, 3] -> m {motion = n}
    | n `elem` [20, 91] -> m {isOdd = True}
  _ -> m

-- | Number of a G or M word; -1 for another number than a whole one.
code :: Text -> Int
code number = case reads (Text.unpack number) of
  [(n, "")] -> n
  _ -> -1

-- | A number as programs write it: with digits on both sides of its point.
decimal :: Text -> Text
decimal number = case Text.uncons number of
  Just ('-', rest) -> "-" <> decimal rest
  Just ('.', _) -> decimal ("0" <> number)
  _ -> fromMaybe number (Text.stripSuffix "." number)

statements :: Modal -> [(Char, Text)] -> [Text]
statements m ws = feed <> concatMap command ws <> moves
  where
    feed = ["feed " <> decimal f <> " mm/min" | ('F', f) <- ws]
    command (letter, number) = case (letter, code number) of
      ('M', 0) -> ["stop"]
      ('M', 1) -> ["optional stop"]
      ('M', 3) -> ["spindle cw" <> turns]
      ('M', 4) -> ["spindle ccw" <> turns]
      ('M', 5) -> ["spindle off"]
      ('M', 8) -> ["coolant on"]
      ('M', 9) -> ["coolant off"]
      ('O', n) | n >= 1 && n <= 9999 -> ["program " <> Text.pack (show n)]
      ('G', n) | n >= 54 && n <= 59 -> ["work " <> Text.pack (show n)]
      -- Without a decimal point, some controls take P for milliseconds.
      ('G', 4) -> ["dwell " <> decimal p <> " s" | ('P', p) <- ws, Text.any (== '.') p]
      _ -> []
    turns = maybe "" (\s -> " " <> s <> " rpm") (speed m)
    moves =
      [ (if motion m == 0 then "rapid " else "move ") <> point a b (z m)
        | any ((`elem` ['X', 'Y', 'Z']) . fst) ws,
          not (isOdd m),
          motion m `elem` [0, 1],
          Just a <- [x m],
          Just b <- [y m]
      ]

point :: Text -> Text -> Maybe Text -> Text
point a b height = "(" <> Text.intercalate ", " (a : b : maybe [] pure height) <> ")"

-- APT

apt :: Text -> Reading
apt line
  | Text.isPrefixOf "$$" stripped = Other ("-- " <> Text.drop 2 stripped)
  | major `elem` majorWords && (hasSlash || isAlone) =
    Other (maybe "" renamed (aptStatement major minor))
  | otherwise = Own
  where
    stripped = Text.strip line
    (left, right) = Text.breakOn "=" stripped
    (name, body)
      | Text.null right = ("", stripped)
      | otherwise = (Text.strip left, Text.strip (Text.drop 1 right))
    (major, rest) = Text.span isAsciiUpper body
    hasSlash = Text.isPrefixOf "/" (Text.stripStart rest)
    isAlone = Text.null name && (Text.null rest || Text.isPrefixOf " " rest)
    minor
      | hasSlash = map Text.strip (Text.splitOn "," (Text.drop 1 (Text.stripStart rest)))
      | otherwise = [Text.strip rest]
    renamed text = if Text.null name then text else "let " <> name <> " = " <> text

majorWords :: [Text]
majorWords =
  Text.words
    "POINT LINE CIRCLE VECTOR PATERN TABCYL GOLFT GORGT GOFWD GOBACK GOUP GODOWN GOTO GODLTA GO \
    \FROM CUTTER FEDRAT INTOL OUTTOL TOLER SPINDL COOLNT PARTNO MACHIN INDIRV INDIRP TLLFT TLRGT \
    \TLON TLONPS FINI STOP OPSTOP LOADTL CLPRNT NOPOST REMARK MACRO LOOPST LOOPND RAPID DELAY PSIS \
    \THICK ZSURF"

-- | The statement, or the value, for an APT statement: its major word and its minor words.
aptStatement :: Text -> [Text] -> Maybe Text
aptStatement major minor
  | major == "STOP" = Just "stop"
  | major == "OPSTOP" = Just "optional stop"
  | not (all isSimple minor || major == "PARTNO") = Nothing
  | otherwise = case (major, minor) of
    ("POINT", [a, b]) -> Just (point a b Nothing)
    ("POINT", [a, b, h]) | a /= "INTOF" -> Just (point a b (Just h))
    ("POINT", ["INTOF", a, b]) -> Just ("intersection(" <> a <> ", " <> b <> ")")
    ("LINE", [a, b]) -> Just ("line(" <> a <> ", " <> b <> ")")
    ("LINE", [a, b, e, f]) ->
      Just
        ( "line(" <> point a b Nothing
            <> ", "
            <> point e f Nothing
            <> ")"
        )
    ("CIRCLE", ["CENTER", p, "RADIUS", r]) -> Just ("circle(" <> p <> ", " <> r <> ")")
    ("CIRCLE", [a, b, r]) -> Just ("circle(" <> point a b Nothing <> ", " <> r <> ")")
    ("CUTTER", d : _) -> Just ("tool mill(diameter " <> d <> " mm)")
    ("FROM", ps) -> ("from " <>) <$> place ps
    ("GOTO", ps) -> ("move " <>) <$> place ps
    ("FEDRAT", f : _) -> Just ("feed " <> f <> " mm/min")
    (_, [t]) | major `elem` ["TOLER", "OUTTOL"] -> Just ("tolerance " <> t <> " mm")
    ("SPINDL", ["OFF"]) -> Just "spindle off"
    ("SPINDL", [s, "CLW"]) -> Just ("spindle cw " <> s <> " rpm")
    ("SPINDL", [s, "CCLW"]) -> Just ("spindle ccw " <> s <> " rpm")
    ("COOLNT", ["OFF"]) -> Just "coolant off"
    ("COOLNT", [_]) -> Just "coolant on"
    ("DELAY", [t]) -> Just ("dwell " <> t <> " s")
    ("PARTNO", ts) -> Just (partStatement (Text.intercalate ", " ts))
    _ -> Nothing
  where
    isSimple word =
      not (Text.null word)
        && Text.all (\s -> isAlphaNum s || s `elem` ("+-." :: String)) word
    place ps = case ps of
      [p] -> Just p
      [a, b] -> Just (point a b Nothing)
      [a, b, h] -> Just (point a b (Just h))
      _ -> Nothing

-- | The statement that names a part by the title of another language.
partStatement :: Text -> Text
partStatement title = "part " <> name <> " \"" <> Text.filter (/= '"') title <> "\""
  where
    word = Text.toLower (Text.takeWhile isAlphaNum title)
    name = case Text.uncons word of
      Just (first, _) | isAlpha first && not (Keyword.isReserved word) -> word
      _ -> "unnamed"

-- C

-- | Reads a line of C. @open@ is the count of its braces that are open before the line.
c :: Int -> Text -> (Int, Reading)
c open line
  | open > 0 && Text.isPrefixOf "}" stripped = (open - 1 + opened, Other "")
  | open > 0 && endsLikeC = (open + opened, Other "")
  | isC = (open + opened, Other (cStatement stripped))
  | otherwise = (open, Own)
  where
    stripped = Text.strip line
    opened = if Text.isSuffixOf "{" stripped then 1 else 0
    (first, rest) = Text.span isWordPart stripped
    endsLikeC = any (`Text.isSuffixOf` stripped) [";", "{"]
    isC =
      any (`Text.isPrefixOf` stripped) ["#include", "#define", "/*"]
        || first `elem` ["printf", "return"] && Text.isSuffixOf ";" stripped
        || first `elem` ["for", "while"] && Text.isPrefixOf "(" (Text.strip rest)
          && Text.any (== ';') rest
        || first `elem` typesOfC && endsLikeC && Text.any isAlpha rest

typesOfC :: [Text]
typesOfC = Text.words "int float double char void bool long short unsigned auto const var struct"

cStatement :: Text -> Text
cStatement line = case Text.breakOn "=" (Text.dropEnd 1 line) of
  (left, right)
    | Text.isSuffixOf ";" line,
      not (Text.null right),
      Just name <- lastWord left,
      Text.all isSimple right ->
      "let " <> name <> " = " <> Text.strip (Text.drop 1 right)
  _ -> ""
  where
    isSimple s = isAlphaNum s || isSpace s || s `elem` ("=+-*/.()_," :: String)
    lastWord left = case reverse (Text.words left) of
      name : _ : _ | Text.all isWordPart name -> Just name
      _ -> Nothing

-- Python

-- | Reads a line of Python. The first argument is the indentation of the block whose lines follow.
python :: Maybe Int -> Text -> (Maybe Int, Reading)
python blockAt line
  | Text.null stripped = (blockAt, Own)
  | Just outer <- blockAt, indentation > outer = (blockAt, Other "")
  | isPython =
    ( if Text.isSuffixOf ":" stripped then Just indentation else Nothing,
      Other (pythonStatement stripped)
    )
  | otherwise = (Nothing, Own)
  where
    stripped = Text.strip line
    indentation = Text.length (Text.takeWhile isSpace line)
    (first, rest) = Text.span isWordPart stripped
    next = Text.strip rest
    isPython =
      first `elem` ["def", "class", "while", "elif"] && Text.any (== ':') next
        || first == "for" && Text.isInfixOf "range(" next
        || first == "import" && maybe False (isLower . fst) (Text.uncons next)
        || first == "from" && Text.isInfixOf " import " next
        || first == "print" && Text.isPrefixOf "(" next
        || first == "return" && not (Text.isSuffixOf ";" next)

pythonStatement :: Text -> Text
pythonStatement line = case Text.stripPrefix "def " line of
  Just function
    | (heading, body) <- Text.breakOn "):" function,
      Just result <- Text.stripPrefix "return " (Text.strip (Text.drop 2 body)) ->
      "let " <> Text.strip heading <> ") = " <> result
  _ -> ""

-- Basic

basic :: Text -> Reading
basic line
  | not (Text.null number) && Text.isPrefixOf " " after
      && Text.toUpper first `elem` ("LET" : keywords) =
    Other (basicStatement (Text.toUpper first) rest)
  | Text.null number && first `elem` keywords = Other (basicStatement first rest)
  | otherwise = Own
  where
    (number, after) = Text.span isDigit (Text.strip line)
    (first, rest) = Text.span isAlpha (Text.strip after)
    keywords = Text.words "PRINT REM GOTO GOSUB RETURN DIM NEXT INPUT END FOR IF STOP DATA READ"

basicStatement :: Text -> Text -> Text
basicStatement first rest = case first of
  "LET" -> "let " <> Text.strip rest
  "REM" -> "-- " <> Text.strip rest
  _ -> ""

isWordPart :: Char -> Bool
isWordPart s = isAlphaNum s || s == '_'
