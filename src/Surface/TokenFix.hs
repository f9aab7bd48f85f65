{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Fixes and advice for tokens at which a program cannot be parsed.
module Surface.TokenFix
  ( unexpectedFixes,
    trailingFixes,
    statementFixes,
    closingFixes,
    closingRegion,
    braceFix,
    coordinateFixes,
    misplacedFixes,
    sideFixes,
    isDecimalComma,
    isCallApart,
    advice,
  )
where

import Base.Name qualified as Name
import Base.Region (Region (..))
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix (..))
import Report.Fix qualified as Fix
import Report.Report (quote)
import Surface.CharacterFix (powerFixes, unitMeant)
import Surface.Keyword qualified as Keyword
import Surface.StatementForm qualified as StatementForm
import Surface.Token (Token (..), Token_ (..), describe, scaledDigits, unitName)
import Surface.TokenContext (TokenContext (..), following, previous)
import Surface.WordMeaning (meaningsOf, statementMeant, typeWords)

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
        && word `notElem` soft <> Text.words "point points pt vector"
  _ -> False
  where
    soft =
      Text.words
        "cipher joggle depth step radius to by gear height diameter nose flutes stickout holder \
        \with"

-- Signs and words

-- | Suggests what the author meant by a misplaced token, judged by the tokens around it.
advice :: Token_ -> TokenContext -> [Text]
advice token around = case (token, shape <$> listToMaybe (before around)) of
  (Symbol ",", _)
    | isDecimalComma token around -> []
  (Symbol ",", _)
    | StatementForm.blockWord around == "contour" ->
      [ "The elements of a contour follow one another without commas, and a point is in brackets: \
        \(0, 0)."
      ]
  (Word word, _)
    | Just _ <- settingOfMotion token around ->
      ["The setting " <> word <> " belongs in the braces of mill, pocket, turn or drill."]
  (Symbol "*", Just (Symbol "*")) -> ["There are no powers: write x * x."]
  (Symbol "=", Just (Symbol "=")) -> []
  (Symbol "=", _)
    | StatementForm.blockWord around `elem` ["let", "param", "contour", ""] ->
      ["To give a name to a value, write: let name = value"]
  (Word word, Just (Number _ _))
    | not (Keyword.isReserved word || Keyword.beginsItem word),
      not (isLineStart around),
      null (meaningsOf word),
      Nothing <- unitMeant word ->
      [ "If "
          <> quote word
          <> " is a unit: the units are "
          <> Text.intercalate ", " (map unitName [minBound .. maxBound])
          <> "."
      ]
  _ -> []

-- | Fixes for a token in place of the expected ones, which @expected@ describes.
unexpectedFixes :: Region -> Token_ -> [Text] -> TokenContext -> [Fix]
unexpectedFixes region token expected around =
  firstFixes
    [ labelFixes token around,
      signFixes region token around,
      repairs around,
      meant,
      equalsFixes region token words' around,
      bracketFixes,
      commaFixes token words' around,
      danglingFixes token around expected,
      cutterFixes region token words',
      teethFixes region token expected,
      sizeFixes expected around
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
  | otherwise = []
  where
    leftOut = [Fix.removal "Leave the sign = out." region]

-- | The fixes of the first list that is not empty.
firstFixes :: [[Fix]] -> [Fix]
firstFixes = concat . take 1 . filter (not . null)

-- | Fixes for operators and commas after which nothing comes.
danglingFixes :: Token_ -> TokenContext -> [Text] -> [Fix]
danglingFixes token around expected = case previous around of
  Just t
    | "a value" `elem` expected,
      isLineStart around || token `elem` map Symbol [")", "]", "}"],
      Symbol s <- shape t,
      s `elem` [",", "+", "-", "*", "/"] ->
      [Fix.proposed (Fix.removal ("Leave the sign " <> s <> " out.") (place t))]
  _ -> []

-- | Proposals for a number in place of a cutter.
cutterFixes :: Region -> Token_ -> [Text] -> [Fix]
cutterFixes region token words' = case token of
  Number _ _ -> [cutterFix region kind | kind <- ["mill", "drill"], kind `elem` words']
  _ -> []

-- | Proposals for the size of a cutter in place of the cutter, at the end of a line.
sizeFixes :: [Text] -> TokenContext -> [Fix]
sizeFixes expected around = case previous around of
  Just Token {shape = Number _ _, place}
    | expected == ["a cutter"],
      StatementForm.blockWord around == "tool" ->
      [cutterFix place kind | kind <- ["mill", "drill"]]
  _ -> []

-- | Proposal for the pitch of a thread mill that has only a diameter.
teethFixes :: Region -> Token_ -> [Text] -> [Fix]
teethFixes region token expected =
  [ Fix.proposed $
      Fix.insertion "Write the pitch of its teeth, for example: , pitch 1 mm" (start region) written
    | token == Symbol ")",
      any ("threadmill" `Text.isInfixOf`) expected
  ]
  where
    written = ", pitch 1 mm"

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
trailingFixes region token around = case settingOfMotion token around of
  Just "plunge" ->
    [Fix.exchange "Write feed: plunge belongs to mill, pocket and drill." region "feed"]
  Just _ -> []
  Nothing ->
    firstFixes
      [partFixes token around, pointBrackets, newLines, signs, repairs around, others]
  where
    signs = signFixes region token around
    newLines = case token of
      Word word
        | word `elem` (Keyword.statements <> Keyword.softStatements <> Keyword.blocks) ->
          [Fix.insertion "Begin a new line here." (start region) "\n"]
      _ -> []
    others = case token of
      Symbol s
        | s `elem` [")", "]", "}"] -> [Fix.removal ("Remove the bracket " <> s <> ".") region]
      _ -> afterNumberFixes region token around
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

-- | Fix for a program with a name and a title, as other languages begin it.
partFixes :: Token_ -> TokenContext -> [Fix]
partFixes token around = case (token, reverse (before around)) of
  (Text _, keyword : _)
    | shape keyword == Word "program" ->
      [Fix.exchange "Write ‘part’ instead of ‘program’." (place keyword) "part"]
  _ -> []

-- | The word of a setting of other statements, such as @depth@, before a number in a motion.
settingOfMotion :: Token_ -> TokenContext -> Maybe Text
settingOfMotion token around = case (token, shape <$> following around) of
  (Word word, Just (Number _ _))
    | StatementForm.blockWord around `elem` ["rapid", "move"],
      word `elem` Text.words "plunge depth step peck allowance" ->
      Just word
  _ -> Nothing

-- | Fixes for a word or a bracket after a number: a unit, or a product without its sign.
afterNumberFixes :: Region -> Token_ -> TokenContext -> [Fix]
afterNumberFixes region token around = case (token, shape <$> previous around) of
  (Word word, Just (Number n Nothing))
    | Just sign <- lookup word signWords ->
      [ Fix.exchange
          ("Write the sign " <> sign <> " instead of " <> quote word <> ".")
          region
          sign
      ]
    | Just unit <- unitMeant word -> [unitFix region unit around]
    | Just (factor, unit) <- lookup (Text.toLower word) scaledUnits,
      Just t <- previous around ->
      let new = scaledDigits factor n <> " " <> unit
       in [Fix.exchange ("Write " <> new <> ".") (Region (start (place t)) (end region)) new]
  (Word "per", Just (Number _ (Just _)))
    | minute : _ <- after around,
      shape minute `elem` map Word ["min", "minute"],
      Just t <- previous around ->
      [ Fix.exchange
          "Write the unit as mm/min, without ‘per’."
          (Region (end (place t)) (end (place minute)))
          "/min"
      ]
  (Word word, Just (Number _ _)) | not (Keyword.isReserved word) -> [times]
  (Symbol "(", Just (Number _ _)) -> [times]
  _ -> []
  where
    signWords = [("x", "*"), ("X", "*"), ("х", "*"), ("times", "*"), ("div", "/"), ("plus", "+")]
    times = Fix.proposed (Fix.insertion "Write the product with *." (start region) "* ")

-- | Units that the language does not have, each with its size in one that it has.
scaledUnits :: [(Text, (Double, Text))]
scaledUnits =
  [ (word, size)
    | (words', size) <-
        [ ("um µm μm micron microns mkm мкм", (0.001, "mm")),
          ("nm", (0.000001, "mm")),
          ("thou mil mils", (0.001, "in")),
          ("ft foot feet", (12, "in")),
          ("gon", (0.9, "deg")),
          ("turn turns", (360, "deg")),
          ("hz rps", (60, "rpm"))
        ],
      word <- Text.words words'
  ]

-- | Writes a unit in the way of the language. A feed or a speed in words of Russian has a second
-- word after a slash.
unitFix :: Region -> Text -> TokenContext -> Fix
unitFix region unit around = case after around of
  slash : minute : _
    | shape slash `elem` [Symbol "/", Word "per", Word "a"],
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
  (Symbol "+", Just (Symbol "+")) -> []
  (Symbol "+", _) -> [Fix.removal "Remove the sign +." region]
  (Symbol "=", Just (Symbol "=")) -> [Fix.removal "Write one sign: a = b." region]
  (Symbol "*", Just (Symbol "*")) -> starPower
  (Symbol "/", _) -> commentFixes region around
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
      (keyword : _, x : own, y : _)
        | shape keyword == Word "contour",
          take 1 (map shape own) `notElem` map (pure . Word) linkWords,
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

-- | Fixes for one of the two strokes of a comment of another language.
commentFixes :: Region -> TokenContext -> [Fix]
commentFixes region around = case (shape <$> previous around, following around) of
  (Just (Symbol "/"), _) -> [begin (Region (start region - 1) (end region))]
  (_, Just t)
    | attached t && shape t == Symbol "/" -> [begin (Region (start region) (end (place t)))]
  _ -> []
  where
    begin both = Fix.exchange "Begin the comment with --." both "--"

-- | Words of an element of a contour that a number follows.
linkWords :: [Text]
linkWords = Text.words "fillet chamfer feed allowance bevel"

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
  | Just w <- statementMeant word, take 1 (map shape (after around)) /= [Symbol "="] = [put w]
  | otherwise = (<> repairs around) $ case map shape (after around) of
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

-- | Words with which a value gets its name in other languages.
declaring :: [Text]
declaring = typeWords <> Text.words "def length angle point line circle"

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
      ( if isLineStart around
          then "Write " <> Text.concat brackets <> " at the end of the line."
          else "Close what is open before this: " <> Text.concat brackets
      )
      (maybe (start region) (end . place) (previous around))
      (Text.concat brackets)
    | not (null brackets)
  ]
  where
    brackets = closingFor around

-- | The place where the brackets that are open before a region are to be closed: the end of the
-- line above it if it begins a line, or else the region itself.
closingRegion :: Region -> TokenContext -> Region
closingRegion region around = case previous around of
  Just t | isLineStart around -> Region (end (place t)) (end (place t))
  _ -> region

-- | The fix that closes the brace of a block before the statement at a region. It is a proposal if
-- other braces are in the block, because one of them may be the one that is missing.
braceFix :: Region -> TokenContext -> Fix
braceFix region around
  | isLineStart around && length braces == 1 = written
  | otherwise = Fix.proposed written
  where
    written = Fix.insertion "Write } on a line before this." (start region) "}\n"
    braces = filter ((== Symbol "{") . shape) (before around)

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
