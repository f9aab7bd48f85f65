{-# OPTIONS_GHC -O0 #-}

-- | Fixes and advice for tokens at which a program cannot be parsed.
module Surface.TokenFix
  ( unexpectedFixes,
    trailingFixes,
    statementFixes,
    closingFixes,
    coordinateFixes,
    misplacedFixes,
    sideFixes,
    isDecimalComma,
    isCallApart,
  )
where

import Base.Name qualified as Name
import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix (..))
import Report.Fix qualified as Fix
import Report.Report (quote)
import Surface.CharacterFix (powerFixes, unitMeant)
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..), describe)
import Surface.TokenContext (TokenContext (..), following, previous)

-- | True of a comma between two parts of a number, as in @1,5@.
isDecimalComma :: Token_ -> TokenContext -> Bool
isDecimalComma token around = case (token, previous around, following around) of
  (Symbol ",", Just Token {shape = Number _ Nothing}, Just next@Token {shape = Number _ _}) ->
    attached next
  _ -> False

-- | True of an opening bracket with a space between it and the name of a function.
isCallApart :: Token_ -> Region -> TokenContext -> Bool
isCallApart token region around = case (token, previous around) of
  (Symbol "(", Just t)
    | Word word <- shape t ->
      end (place t) < start region
        && not (Keyword.isReserved word || Keyword.beginsItem word)
        && word `notElem` soft
  _ -> False
  where
    soft = Text.words "cipher joggle depth step radius to by gear height diameter nose with"

-- Signs and words

-- | Fixes for a token in place of the expected ones, which @expected@ describes.
unexpectedFixes :: Region -> Token_ -> [Text] -> TokenContext -> [Fix]
unexpectedFixes region token expected around =
  firstFixes
    [ labelFixes token around,
      signFixes region token around,
      meant,
      equalsFixes region token words' around,
      bracketFixes,
      commaFixes token words' around,
      danglingFixes region around expected,
      missingWords region token words' around
    ]
  where
    words' =
      [ w | w <- map (Text.dropAround (`elem` ("‘’" :: String))) expected, quote w `elem` expected
      ]
    meant = case token of
      Word word ->
        [ Fix.exchange ("Write " <> quote w <> " instead of " <> quote word <> ".") region w
          | w <- take 1 (Name.lookAlike word words' <> Name.nearest word words')
        ]
      _ -> []
    bracketFixes = case (token, closingFor around) of
      (Symbol s, c : _)
        | s `elem` [")", "]"],
          s /= c,
          c `elem` words' ->
          [Fix.exchange ("Write " <> c <> " instead of " <> s <> ".") region c]
      (Symbol "}", cs@(_ : _)) -> [closed cs]
      _ -> []
    closed cs =
      Fix.insertion
        ("Close the bracket before this: " <> Text.concat cs)
        (maybe (start region) (end . place) (previous around))
        (Text.concat cs)

-- | Fix for a value before which a comma is expected.
commaFixes :: Token_ -> [Text] -> TokenContext -> [Fix]
commaFixes token words' around =
  [ Fix.insertion "Write a comma before this." (end (place t)) ","
    | "," `elem` words' && beginsValue token,
      Just t <- [previous around]
  ]

-- | Fixes for a sign = in place of the expected words.
equalsFixes :: Region -> Token_ -> [Text] -> TokenContext -> [Fix]
equalsFixes region token words' around
  | token /= Symbol "=" = []
  | words' == ["in"] = [Fix.exchange "Write in instead of =." region "in"]
  | t : _ <- after around, shape t `elem` map Word words' = leftOut
  | "closed" `elem` words' =
    [ Fix.proposed (Fix.exchange ("Write " <> w <> " instead of =.") region w)
      | w <- ["closed", "open"]
    ]
  | [t] <- before around, newLine t = leftOut
  | otherwise = []
  where
    leftOut = [Fix.removal "Leave the sign = out." region]

-- | The fixes of the first list that is not empty.
firstFixes :: [[Fix]] -> [Fix]
firstFixes = concat . take 1 . filter (not . null)

-- | Fixes for operators and commas after which nothing comes.
danglingFixes :: Region -> TokenContext -> [Text] -> [Fix]
danglingFixes _ around expected = case previous around of
  Just t
    | "a value" `elem` expected,
      Symbol s <- shape t,
      s `elem` [",", "+", "-", "*", "/"] ->
      [Fix.proposed (Fix.removal ("Leave the sign " <> s <> " out.") (place t))]
  _ -> []

-- | Proposals to write one of the expected words or signs before a token. They are made only for
-- words after which nothing else can be missing.
missingWords :: Region -> Token_ -> [Text] -> TokenContext -> [Fix]
missingWords region token words' around = case (filter isPossible words', token) of
  _
    | "mill" `elem` words',
      Number _ _ <- token ->
      [cutterFix region kind | kind <- ["mill", "drill"], kind `elem` words']
  ([w], _) | length words' == 1 -> [put w]
  (fitting, _) -> map (Fix.proposed . put) fitting
  where
    isPossible w
      | "cipher" `elem` words' && beginsValue token = w == "cipher"
      | "inside" `elem` words' && "on" `elem` words' = hasBlock
      | otherwise =
        w
          `elem` Text.words
            "closed open outside inside left right on round sharp compiler controller"
          || w == "off" && not (beginsValue token)
          || beginsValue token && w
          `elem` Text.words "at arc line in near cw ccw ="
          || isPlainValue && w
          `elem` ["diameter", "nose"]
    -- True if the block of settings begins at the token or after it.
    hasBlock = Symbol "{" `elem` take 1 (map shape (after around)) || token == Symbol "{"
    isLineEnd = all newLine (take 1 (after around))
    isPlainValue = case token of
      Number _ _ -> True
      Symbol "(" -> True
      _ -> False
    put w
      | hasBlock || isLineEnd,
        Word word <- token =
        Fix.exchange ("Write " <> w <> " instead of " <> word <> ".") region w
      | isLineStart around,
        Just t <- previous around =
        Fix.insertion (title' w) (end (place t)) (" " <> w)
      | otherwise = Fix.insertion (title' w) (start region) (w <> " ")
    title' w = "Write " <> w <> " here."

-- | Writes the cutter of a kind around the number of its diameter.
cutterFix :: Region -> Text -> Fix
cutterFix region kind =
  Fix.proposed $
    Fix.enclosure
      ("Write the cutter as " <> kind <> "(diameter …).")
      (kind <> "(diameter ")
      region
      ")"

-- | Fixes for a token after a complete statement on the same line.
trailingFixes :: Region -> Token_ -> TokenContext -> [Fix]
trailingFixes region token around =
  firstFixes [pointBrackets, signFixes region token around, others]
  where
    others = case (token, shape <$> previous around) of
      (Symbol s, _)
        | s `elem` [")", "]", "}"] -> [Fix.removal ("Remove the bracket " <> s <> ".") region]
      (Word word, Just (Number _ Nothing))
        | Just unit <- unitMeant word -> [unitFix region unit around]
      (Word word, _)
        | word `elem` (Keyword.statements <> Keyword.softStatements <> Keyword.blocks) ->
          [Fix.insertion "Begin a new line here." (start region) "\n"]
      (Word word, Just (Number _ _)) | not (Keyword.isReserved word) -> [times]
      (Symbol "(", Just (Number _ _)) -> [times]
      _ -> []
    times = Fix.proposed (Fix.insertion "Write the product with *." (start region) "* ")
    pointBrackets = case (token, reverse (before around)) of
      (Symbol ",", keyword : first : _)
        | Word word <- shape keyword,
          word `elem` ["from", "rapid", "move"],
          all (isCoordinate . shape) (drop 1 (reverse (before around)) <> after around) ->
          [ Fix.enclosure
              "Write the coordinates in brackets."
              "("
              ( Region
                  (start (place first))
                  (maximum (map (end . place) (before around <> after around)))
              )
              ")"
          ]
      _ -> []
    isCoordinate t = case t of
      Number _ _ -> True
      Symbol s -> s `elem` [",", "-"]
      _ -> False

-- | Writes a unit in the way of the language. A feed or a speed in words of Russian has a second
-- word after a slash.
unitFix :: Region -> Text -> TokenContext -> Fix
unitFix region unit around = case after around of
  slash : minute : _
    | shape slash == Symbol "/",
      shape minute `elem` map Word ["min", "мин", "minute", "minutes"] ->
      named
        (if unit == "rpm" then unit else unit <> "/min")
        (Region (start region) (end (place minute)))
  _ -> named unit region
  where
    named new r = Fix.exchange ("Write the unit as " <> new <> ".") r new

-- | Fixes for signs of other languages, and for commas.
signFixes :: Region -> Token_ -> TokenContext -> [Fix]
signFixes region token around = case (token, shape <$> previous around) of
  (Symbol ",", _)
    | isDecimalComma token around ->
      Fix.exchange "Write a decimal point." region "." : pairBrackets
  (Symbol ",", Just (Number _ _)) -> pairBrackets
  (Symbol ",", Just (Symbol ")")) -> [Fix.removal "Remove the comma." region]
  (Symbol "+", Just (Symbol "+")) -> []
  (Symbol "+", _) -> [Fix.removal "Remove the sign +." region]
  (Symbol "=", Just (Symbol "=")) -> [Fix.removal "Write one sign: a = b." region]
  (Symbol "*", Just (Symbol "*")) -> starPower
  (Symbol "/", Just (Symbol "/")) ->
    [Fix.exchange "Begin the comment with --." (Region (start region - 1) (end region)) "--"]
  (Symbol "(", _)
    | isCallApart token region around,
      Just t <- previous around ->
      [ Fix.removal
          "Write the bracket of a call right after the name."
          (Region (end (place t)) (start region))
      ]
  _ -> []
  where
    -- In a contour, two numbers are a point without its brackets.
    pairBrackets = case (reverse (before around), before around, after around) of
      (keyword : _, x : _, y : _)
        | shape keyword == Word "contour",
          Number _ _ <- shape y ->
          [ Fix.proposed
              ( Fix.enclosure
                  "Write the point in brackets."
                  "("
                  (Region (start (place x)) (end (place y)))
                  ")"
              )
          ]
      _ -> []
    starPower = case (before around, following around) of
      (star : base : _, Just count) ->
        powerFixes
          (Region (start (place star)) (end region))
          around {before = [base], after = [count]}
      _ -> []

-- | Fix for a misspelt word before an argument, such as @near@.
labelFixes :: Token_ -> TokenContext -> [Fix]
labelFixes token around = case before around of
  t : opening : _
    | Word word <- shape t,
      shape opening `elem` map Symbol ["(", ","],
      beginsValue token,
      w : _ <- Name.nearest word ["near", "left", "right", "inside", "outside", "within"] ->
      [Fix.exchange ("Write " <> quote w <> " instead of " <> quote word <> ".") (place t) w]
  _ -> []

-- | Tells if a token begins a value.
beginsValue :: Token_ -> Bool
beginsValue token = case token of
  Number _ _ -> True
  Word word -> not (Keyword.isReserved word)
  Symbol s -> s `elem` ["(", "["]
  _ -> False

-- | Fixes for a word that begins no statement.
statementFixes :: Region -> Text -> [Text] -> TokenContext -> [Fix]
statementFixes region word known around
  | word `elem` declaring =
    [Fix.exchange ("Write let instead of " <> quote word <> ".") region "let"]
  | w : _ <- Name.lookAlike word known <> Name.nearest word known = [put w]
  | Just w <- lookup word synonyms = [Fix.proposed (put w)]
  | otherwise = case map shape (after around) of
    Symbol "=" : _ -> [begin]
    Stray ':' : Symbol "=" : _ ->
      [ Fix.joined
          (title begin)
          (begin : [Fix.removal "" (place t) | t <- take 1 (after around)])
      ]
    Symbol "(" : rest | Symbol "=" : _ <- drop 1 (dropWhile (/= Symbol ")") rest) -> [begin]
    _ -> []
  where
    put w = Fix.exchange ("Write " <> quote w <> " instead of " <> quote word <> ".") region w
    begin =
      Fix.insertion
        ("Give the value its name with let: let " <> word <> " = …")
        (start region)
        "let "
    synonyms =
      [ ("cutter", "tool"),
        ("include", "import"),
        ("profile", "contour"),
        ("shape", "contour"),
        ("path", "contour"),
        ("goto", "move"),
        ("speed", "spindle cw")
      ]

-- | Words with which a value gets its name in other languages.
declaring :: [Text]
declaring =
  Text.words "var const def val auto int float double real number length angle point line circle"

-- Brackets

-- | The brackets that would close those that are open before a token, the innermost first.
closingFor :: TokenContext -> [Text]
closingFor around = go [] (reverse (before around))
  where
    go open tokens = case tokens of
      [] -> filter (/= "}") open
      t : rest -> case shape t of
        Symbol "(" -> go (")" : open) rest
        Symbol "[" -> go ("]" : open) rest
        Symbol "{" -> go [] rest
        Symbol s | s `elem` [")", "]", "}"] -> go (drop 1 open) rest
        _ -> go open rest

-- | Fixes that close the brackets which are open before a place.
closingFixes :: Region -> TokenContext -> [Fix]
closingFixes region around =
  [ Fix.insertion
      ("Close what is open before this: " <> Text.concat brackets)
      (maybe (start region) (end . place) (previous around))
      (Text.concat brackets)
    | not (null brackets)
  ]
  where
    brackets = closingFor around

-- | Fixes for brackets with too many values; @tokens@ are those of the brackets.
coordinateFixes :: Region -> [Token] -> [Fix]
coordinateFixes region tokens =
  [ Fix.proposed (Fix.joined "Write decimal points." [Fix.exchange "" (place t) "." | t <- decimal])
    | not (null decimal),
      count - length decimal `elem` [2, 3]
  ]
    <> [ Fix.proposed
           ( Fix.joined
               "Write a list, in square brackets."
               [ Fix.exchange "" (Region (start region) (start region + 1)) "[",
                 Fix.exchange "" (Region (end region - 1) (end region)) "]"
               ]
           )
       ]
  where
    commas =
      [ (a, t, b)
        | (a, t, b) <- zip3 tokens (drop 1 tokens) (drop 2 tokens),
          shape t == Symbol ","
      ]
    between = [(attached b, t) | (a, t, b) <- commas, isNumber a, isNumber b, attached t]
    isSpaced = not (all fst between)
    decimal
      | length between < length commas = [t | (True, t) <- between]
      | isSpaced = [t | (True, t) <- between]
      | otherwise = [t | (k, (_, t)) <- zip [0 :: Int ..] between, even k]
    count = length commas + 1
    isNumber t = case shape t of
      Number _ _ -> True
      _ -> False

-- | Fixes for a statement in the braces of another one, which begins at the offset @outer@.
misplacedFixes :: Region -> Text -> Maybe Int -> TokenContext -> [Fix]
misplacedFixes region word outer around = joinLines <> moveUp
  where
    joinLines = case previous around of
      Just t
        | word `elem` ["rapid", "feed"],
          shape t == Symbol ")" ->
          [ Fix.proposed
              ( Fix.exchange
                  ("Write " <> word <> " on the line of the point before it.")
                  (Region (end (place t)) (start region))
                  " "
              )
          ]
      _ -> []
    moveUp =
      [ Fix.proposed (Fix.move "Move it above the statement in whose braces it is." whole offset)
        | isBalanced (after around),
          Just offset <- [outer]
      ]
    whole = Region (start region) (maximum (end region : map (end . place) ofStatement))
    ofStatement = takeWhile ((/= Symbol "}") . shape) (after around)
    isBalanced ts = count "{" ts == 0
    count s = length . filter ((== Symbol s) . shape)

-- | Proposals for the missing side of a piece.
sideFixes :: Region -> Maybe Token_ -> TokenContext -> [Fix]
sideFixes region found around = case filter (isSide . shape) (after around) of
  [t]
    | Word side <- shape t ->
      [ Fix.joined
          ("Write " <> side <> " here, before " <> maybe "the rest" describe found <> ".")
          [Fix.insertion "" here (" " <> side), Fix.removal "" (place t)]
      ]
  _ -> [Fix.proposed (missing side) | side <- ["left", "right"]]
  where
    isSide token = token `elem` [Word "left", Word "right"]
    here = maybe (start region) (end . place) (previous around)
    missing side
      | found `elem` map (Just . Word) ["outside", "inside", "on"] =
        Fix.exchange ("Write " <> side <> ".") region side
      | otherwise = Fix.insertion ("Write " <> side <> ".") here (" " <> side)
