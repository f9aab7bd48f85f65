{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Candidates for the repair of a statement: changes of its tokens near the one at which it cannot
-- be parsed.
--
-- A candidate is only a guess. "Surface.StatementRepair" keeps those with which the statement can
-- be parsed.
module Surface.RepairCandidate
  ( candidates,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (quote)
import Surface.BracketRepair (atLineEnd, brackets, broughtForward, calls, intoBraces, stepUp)
import Surface.FailureContext
import Surface.Keyword qualified as Keyword
import Surface.LineRepair (lists, modifiers, others, quotations)
import Surface.Token
  ( Numeral (..),
    Token (..),
    Token_ (..),
    Unit (Millimetre),
    scaledDigits,
    spelling,
    unitName,
  )
import Surface.TokenRepair (RepairCandidate (..), TokenChange (..), isSign)
import Surface.WordMeaning (fillers, meaningsOf, typeWords)

-- | The candidates at the wrong token.
candidates :: Failing -> [RepairCandidate]
candidates bare = case drop (index f) (tokens f) of
  t : _
    | newLine t ->
      atLineEnd f <> broughtForward f <> stepUp f t
        <> ( if isSettingStart f || isStatementStart f
               then exchanges f t <> removals f t <> moves f <> insertions f t
               else []
           )
    | otherwise ->
      exchanges f t <> removals f t <> moves f <> insertions f t <> brackets f t
        <> broughtForward f
        <> intoBraces f
        <> quotations f t
        <> lists f t
        <> calls f t
        <> modifiers f t
        <> others f t
  [] -> atLineEnd f
  where
    f = withOptional bare

-- | The words and signs that may follow, of which parsing says nothing, because the statement or
-- the setting is complete without them. The first words of other settings are right only at the
-- start of a line.
withOptional :: Failing -> Failing
withOptional f = case at f (index f) of
  Just t | not (newLine t) -> f {wanted = optional <> (if isSettingStart f then [] else wanted f)}
  _ -> f
  where
    optional = case shape <$> at f (maximum (0 : take 1 (lineOf f))) of
      Just (Word word) -> filter (`notElem` onLine) (fromMaybe [] (lookup word optionalWords))
      _ -> []
    onLine = [word | n <- lineOf f, n < index f, Just (Word word) <- [shape <$> at f n]]

-- | The words and signs that may follow a complete statement or setting, by its first word.
optionalWords :: [(Text, [Text])]
optionalWords =
  [ ("depth", ["step"]),
    ("allowance", [","]),
    ("islands", [","]),
    ("approach", [",", "rapid", "feed"]),
    ("retract", [",", "rapid", "feed"]),
    ("rapid", [","]),
    ("move", [","]),
    ("assert", ["within"]),
    ("change", ["at"])
  ]

-- | Other words or signs instead of the wrong token.
exchanges :: Failing -> Token -> [RepairCandidate]
exchanges f t = case shape t of
  Word word ->
    [ put 1 [Word w]
      | w <- take 1 (Name.lookAlike word keywords <> Name.nearest word keywords)
    ]
      <> [put 1 (map token (Text.words new)) | new <- meaningsOf word, new /= word, isFitting new]
      <> [put 1 (map Word parts) | parts <- [Text.splitOn "_" word], length parts == 2]
      <> [ put 4 [Word w]
           | not (Keyword.isReserved word),
             word `notElem` fillers,
             [w] <- [keywords],
             w /= "step"
         ]
      <> measures f t
      <> passes f word
      <> [ put 0 [Number Numeral {digits = "1", amount = 1} (Just u)]
           | isValueWanted f,
             u <- [minBound .. maxBound],
             unitName u == word
         ]
  Symbol s ->
    [put 1 [token new] | new <- wanted f, (s, new) `elem` signPairs]
      <> [put 1 [Symbol ".."] | s == ":"]
  Stray ':' -> [put 2 [Symbol ".."]]
  _ -> []
  where
    keywords = filter isWordText (wanted f)
    isFitting new
      | null keywords = not (isNameWanted f)
      | otherwise = new == ".." || take 1 (Text.words new) `elem` map pure keywords
    put c ns =
      RepairCandidate
        [Exchange (index f) ns]
        c
        ( "Write " <> quote (Text.unwords (map spelling ns)) <> " instead of "
            <> quote (spelling (shape t))
        )
    signPairs =
      [("=", "in"), ("(", "{"), ("[", "("), ("{", "("), ("]", ")"), ("}", ")")]
        <> [(":", "="), (")", "]")]

-- | A count of passes after a depth, where the depth of one pass is given.
passes :: Failing -> Text -> [RepairCandidate]
passes f word =
  [ RepairCandidate
      [Exchange k [Word "step"], Exchange (k + 1) [step]]
      1
      ("Write the depth of one pass, " <> spelling step)
    | word `elem` ["passes", "pass", "times", "cuts", "count", "number", "in"],
      "step" `elem` wanted f,
      Just (Number depth unit) <- [shape <$> at f (k - 1)],
      Just (Number count Nothing) <- [shape <$> at f (k + 1)],
      amount count >= 1,
      let step = Number (scaled (1 / amount count) depth) unit
  ]
  where
    k = index f

-- | A radius where the cutter has a diameter, and the reverse; the name of a thread.
measures :: Failing -> Token -> [RepairCandidate]
measures f t =
  [ RepairCandidate
      [Exchange k [Word w], Exchange (k + 1) [doubled]]
      0
      ("Write the " <> w <> ", " <> spelling doubled)
    | w <- filter isWordText (wanted f),
      Just factor <- [lookup (spelling (shape t), w) measureFactors],
      Just (Number n unit) <- [shape <$> at f (k + 1)],
      let doubled = Number (scaled factor n) unit
  ]
    <> threadSize f (spelling (shape t))
  where
    k = index f

-- | The diameter of a thread that is given by its name, such as M6.
threadSize :: Failing -> Text -> [RepairCandidate]
threadSize f word =
  [ RepairCandidate
      [Exchange (index f) [Word "diameter", size]]
      0
      ("Write ‘diameter " <> spelling size <> "’ instead of " <> quote word)
    | "diameter" `elem` wanted f,
      Just digits <- [Text.stripPrefix "M" word],
      Just amount <- [Decimal.parse digits],
      let size = Number Numeral {digits, amount} (Just Millimetre)
  ]

-- | The factor between two measures of a cutter.
measureFactors :: [((Text, Text), Double)]
measureFactors =
  [((r, "diameter"), 2) | r <- ["radius", "r", "R", "rad"]]
    <> [((d, "nose"), 0.5) | d <- ["diameter", "dia", "d", "D"]]

scaled :: Double -> Numeral -> Numeral
scaled factor n = Numeral {digits = scaledDigits factor n, amount = factor * amount n}

-- | The statement without the wrong token, or without all that are the same sign on its line.
removals :: Failing -> Token -> [RepairCandidate]
removals f t = case shape t of
  Word word
    | word `elem` fillers ->
      [RepairCandidate [Exchange k []] 2 ("Leave " <> quote word <> " out")]
  Text text
    | Just n <- Decimal.parse text,
      isValueWanted f ->
      [ RepairCandidate
          [Exchange k [Number Numeral {digits = text, amount = n} Nothing]]
          1
          "Write the number without quotation marks"
      ]
    | otherwise -> [RepairCandidate [Exchange k []] 4 "Leave the text out"]
  s
    | isSign s ->
      signs f t <> surplus f t <> (if s == Symbol "(" then fillerBefore f else [])
    | otherwise -> fillerBefore f <> beforeCutter f t <> foreignMeasure f t
  where
    k = index f

-- | The statement without a sign, without all such signs of its line, or without brackets.
signs :: Failing -> Token -> [RepairCandidate]
signs f t =
  [ RepairCandidate
      [Exchange k []]
      costOf
      ( if shape t == Symbol "-" && attached t
          then "Write two words, without ‘-’"
          else "Leave " <> quote (spelling (shape t)) <> " out"
      )
  ]
    <> [RepairCandidate (map (`Exchange` []) same) 2 "Leave the signs out" | length same > 1]
    <> [ RepairCandidate [Exchange k [], Exchange close []] 2 "Leave the brackets out"
         | shape t == Symbol "(",
           k > 0,
           Just close <- [closingOf (tokens f) k],
           Symbol "," `notElem` map shape (slice k close f)
       ]
    <> [ RepairCandidate [Exchange (k - 1) [], Exchange k []] 1 "Leave ‘->’ out"
         | shape t == Symbol ">",
           attached t,
           Just (Symbol "-") <- [shape <$> at f (k - 1)]
       ]
  where
    k = index f
    costOf
      | shape t == Symbol ">" = 4
      | shape t `elem` map Symbol ["(", "["], Just _ <- closingOf (tokens f) k = 6
      | otherwise = 1
    same = [n | n <- lineOf f, (shape <$> at f n) == Just (shape t)]

-- | The statement without what follows a complete list of arguments at a comma, or without the
-- second measure of a chamfer or a fillet.
surplus :: Failing -> Token -> [RepairCandidate]
surplus f t =
  [ RepairCandidate
      (map Delete [k .. close - 1])
      4
      ("Leave " <> quote (written (slice k close f)) <> " out")
    | ")" `elem` wanted f,
      shape t == Symbol ",",
      close <- take 1 [n | n <- lineOf f, n > k, (shape <$> at f n) == Just (Symbol ")")]
  ]
    <> [ RepairCandidate
           [Delete k, Delete (k + 1)]
           0
           ("Leave " <> quote (written (slice k (k + 2) f)) <> " out")
         | shape t == Symbol ",",
           Just link <- [shape <$> at f (k - 2)],
           link `elem` map Word ["chamfer", "fillet"],
           Just (Number _ _) <- [shape <$> at f (k + 1)]
       ]
  where
    k = index f

-- | The statement without the word before the wrong token, if that word says nothing.
fillerBefore :: Failing -> [RepairCandidate]
fillerBefore f =
  [ RepairCandidate [Exchange (k - 1) []] (costOf word) ("Leave " <> quote word <> " out")
    | Just t <- [at f (k - 1)],
      not (newLine t),
      Word word <- [shape t],
      word `elem` fillers || word `elem` typeWords,
      not (Keyword.isReserved word)
  ]
  where
    k = index f
    costOf word
      | word `elem` typeWords || word `elem` ["to", "at", "return"] = 1
      | (shape <$> at f (k - 2)) `elem` map (Just . Symbol) ["(", ","] = 0
      | otherwise = 3

-- | The cutter without a measure that it does not have.
foreignMeasure :: Failing -> Token -> [RepairCandidate]
foreignMeasure f t =
  [ RepairCandidate
      (map Delete [k - 1 .. to - 1])
      4
      ("Leave " <> quote (written (slice k to f)) <> " out")
    | all (`elem` wanted f) ["holder", "stickout"],
      (shape <$> at f (k - 1)) == Just (Symbol ","),
      Word _ <- [shape t],
      to <- [segmentEnd f k],
      to > k
  ]
  where
    k = index f

-- | The statement without a number or a name before the kind of a cutter.
beforeCutter :: Failing -> Token -> [RepairCandidate]
beforeCutter f t =
  [ RepairCandidate [Exchange k []] 3 ("Leave " <> quote (spelling (shape t)) <> " out")
    | "mill" `elem` wanted f,
      Just (Word next) <- [shape <$> at f (k + 1)],
      next `elem` wanted f
  ]
  where
    k = index f

-- | Words that come later on the line, moved to the wrong token.
moves :: Failing -> [RepairCandidate]
moves f =
  [ RepairCandidate
      (Copy k from to False : map Delete [from .. to - 1])
      (2 + (if to - from > 1 then 1 else 0))
      ("Write " <> quote (written (slice from to f)) <> " first")
    | from <- later,
      Just (Word w) <- [shape <$> at f from],
      w `elem` wanted f,
      to <- [from + 1, segmentEnd f from],
      to <= lineEnd f
  ]
    <> [ RepairCandidate
           (Copy k (k + 1) to False : map Delete [k + 1 .. to - 1])
           3
           ("Write " <> quote (written (slice (k + 1) to f)) <> " first")
         | isValueWanted f || isNameWanted f,
           Just (Word _) <- [shape <$> at f k],
           to <- [k + 2, segmentEnd f (k + 1)],
           to > k + 1,
           to <= lineEnd f
       ]
  where
    k = index f
    later = filter (> k) (lineOf f)

-- | A word or a sign that is wanted, before the wrong token.
insertions :: Failing -> Token -> [RepairCandidate]
insertions f t =
  [ RepairCandidate
      [Insert k False [token w]]
      (if isWordText w then 3 else 2)
      ("Write " <> quote w <> " before " <> quote (spelling (shape t)) <> remark w)
    | w <- wanted f,
      w `notElem` ["{", "}"],
      not (isSettingStart f) || (w, spelling (shape t)) `elem` settingWords || not (newLine t),
      not (isStatementStart f),
      -- The place of a tool change comes after the tool.
      w /= "at" || (shape <$> at f (k - 1)) /= Just (Word "change"),
      w /= "=" || Symbol "=" `notElem` [shape x | n <- lineOf f, n > k, Just x <- [at f n]]
  ]
    <> [ RepairCandidate
           [Insert k False [Number Numeral {digits = "2", amount = 2} Nothing]]
           5
           "Write the number of the tool"
         | isValueWanted f,
           Just (Word "change") <- [shape <$> at f (k - 1)]
       ]
  where
    k = index f
    remark w = if w == "ccw" && firstWord f == "spindle" then ", for left-hand cutters" else ""

-- | The first words of settings, each with a second one.
settingWords :: [(Text, Text)]
settingWords =
  [ ("lead", "in"),
    ("lead", "out"),
    ("start", "near"),
    ("corners", "round"),
    ("corners", "sharp"),
    ("compensation", "controller"),
    ("compensation", "compiler"),
    ("rest", "allowed")
  ]
