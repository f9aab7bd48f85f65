{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Candidates for the repair of a statement that change its brackets and braces, or move settings
-- into its braces and out of them.
module Surface.BracketRepair
  ( brackets,
    calls,
    intoBraces,
    broughtForward,
    stepUp,
    atLineEnd,
  )
where

import Data.Maybe (listToMaybe, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (quote)
import Surface.FailureContext
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..), spelling)
import Surface.TokenRepair (RepairCandidate (..), TokenChange (..), isSign)
import Surface.WordMeaning (meaningsOf)

-- | Brackets around two values at a comma, or around the values of a cutter.
brackets :: Failing -> Token -> [RepairCandidate]
brackets f t = pointBrackets f t <> cutterBrackets f <> roundBrackets f t

-- | Brackets around the coordinates of a point, or around a list of points.
pointBrackets :: Failing -> Token -> [RepairCandidate]
pointBrackets f t =
  [ RepairCandidate
      [Insert from False [Symbol "("], Insert to (to >= lineEnd f) [Symbol ")"]]
      1
      "Write the point in brackets"
    | shape t == Symbol ",",
      firstWord f `notElem` withoutPoints,
      firstWord f /= "drill" || maybe False (isNumber . shape) (at f (k - 1)),
      Just from <- [operandStart f k],
      to <- [operandEnd f (k + 1)],
      to > k + 1
  ]
    <> [ RepairCandidate
           [Insert (first + 2) False [Symbol "["], Insert depth False [Symbol "]"]]
           0
           "Write a list of points in square brackets"
         | firstWord f == "drill",
           shape t == Symbol ",",
           not (maybe False (isNumber . shape) (at f (k - 1))),
           depth <- take 1 [n | n <- lineOf f, n > k, (shape <$> at f n) == Just (Word "depth")]
       ]
  where
    k = index f
    first = maximum (0 : take 1 (lineOf f))
    withoutPoints = Text.words "tolerance feed let param spindle clearance mill pocket turn"
    isNumber token' = case token' of
      Number _ _ -> True
      _ -> False

-- | The brackets around the measures of a cutter, with its kind if that is missing.
cutterBrackets :: Failing -> [RepairCandidate]
cutterBrackets f =
  [ RepairCandidate
      (enclosed to (Symbol "(" : map Word more))
      (2 + length more)
      "Write the measure in brackets"
    | "(" `elem` wanted f,
      to <- [segmentEnd f k, lineEnd f],
      more <- [[], ["diameter"], ["nose"]]
  ]
    <> [ RepairCandidate
           (enclosed to (Word kind : Symbol "(" : more))
           (4 + length more)
           "Write the kind of the cutter"
         | "mill" `elem` wanted f,
           kind <- ["mill", "drill"],
           more <- [[], [Word "diameter"]],
           to <- [lineEnd f]
       ]
  where
    k = index f
    enclosed to begin = [Insert k False begin, Insert to (to >= lineEnd f) [Symbol ")"]]

-- | Round brackets instead of others.
roundBrackets :: Failing -> Token -> [RepairCandidate]
roundBrackets f t =
  [ RepairCandidate
      [Exchange k [Symbol "("], Exchange close [Symbol ")"]]
      1
      "Write round brackets"
    | shape t `elem` map Symbol ["{", "["],
      "(" `elem` wanted f || isValueWanted f,
      Just close <- [closingOf (tokens f) k]
  ]
  where
    k = index f

-- | The brackets of a call whose arguments have none, those of the parameters of a function, and
-- those of an index.
calls :: Failing -> Token -> [RepairCandidate]
calls f t =
  [ RepairCandidate
      ( [Insert k False [Symbol "("], Insert to (to >= lineEnd f) [Symbol ")"]]
          <> [Insert n False [Symbol ","] | n <- [k + 1 .. to - 1], isOperand n, isOperand (n - 1)]
      )
      1
      "Write the arguments in brackets"
    | Just (Word word) <- [shape <$> at f (k - 1)],
      not (Keyword.isReserved word),
      isOperand k,
      firstWord f `elem` ["let", "curve", "param"],
      Symbol "=" `elem` [shape x | n <- lineOf f, n < k, Just x <- [at f n]],
      to <- [segmentEnd f (k - 1)]
  ]
    <> [ RepairCandidate
           [Insert k False [Symbol "("], Insert equal False [Symbol ")"]]
           1
           "Write the parameters of a function in brackets"
         | firstWord f == "let",
           "=" `elem` wanted f,
           Word _ <- [shape t],
           equal : _ <- [[n | n <- lineOf f, n > k, (shape <$> at f n) == Just (Symbol "=")]],
           equal == k + 1
       ]
    <> itemOf f t
  where
    k = index f
    isOperand n = case shape <$> at f n of
      Just (Number _ _) -> True
      Just (Word w) -> not (Keyword.isReserved w)
      _ -> False

-- | The call of @item_of@ instead of an index in square brackets.
itemOf :: Failing -> Token -> [RepairCandidate]
itemOf f t =
  [ RepairCandidate
      [ Insert (k - 1) False [Word "item_of", Symbol "("],
        Exchange k [Symbol ","],
        Exchange close [Symbol ")"]
      ]
      1
      "Take the item of a list with item_of"
    | shape t == Symbol "[",
      attached t,
      Just (Word _) <- [shape <$> at f (k - 1)],
      Just close <- [closingOf (tokens f) k]
  ]
  where
    k = index f

-- | Settings on the line of the statement, moved into its braces.
intoBraces :: Failing -> [RepairCandidate]
intoBraces f =
  [ RepairCandidate
      (Copy (open + 1) k open True : map Delete [k .. open - 1])
      2
      ("Write " <> quote (written (slice k open f)) <> " in the braces")
    | Just open <- [listToMaybe [n | n <- lineOf f, n > k, (shape <$> at f n) == Just (Symbol "{")]]
  ]
    <> [ RepairCandidate
           [Insert k False [Symbol "{"], Insert (lineEnd f) True [Symbol "}"]]
           3
           "Write the settings in braces"
         | Symbol "{" `notElem` mapMaybe (fmap shape . at f) (lineOf f),
           k < lineEnd f
       ]
  where
    k = index f

-- | A word that is wanted and begins a line below, in the braces of the statement, moved out of
-- them with its value.
broughtForward :: Failing -> [RepairCandidate]
broughtForward f =
  [ RepairCandidate
      (Copy k from to False : map Delete [from .. to - 1])
      2
      ( "Write " <> quote (written (slice from to f))
          <> " before the braces"
      )
    | Just (Symbol "{") <- [shape <$> at f k],
      w <- wanted f,
      from <- take 1 [n | (n, t) <- zip [0 ..] (tokens f), n > k, shape t == Word w],
      to <- [segmentEnd f from],
      to > from + 1 || w `elem` ["outside", "inside", "on", "left", "right"]
  ]
    <> [ RepairCandidate
           (stepAt k from f : map Delete [from .. from + length value])
           1
           "Write the step before the braces"
         | "step" `elem` wanted f,
           Just (Symbol "{") <- [shape <$> at f k],
           from <-
             take
               1
               [ n
                 | (n, t) <- zip [0 ..] (tokens f),
                   newLine t,
                   Word w <- [shape t],
                   isSideways f w
               ],
           let value = takeWhile (not . newLine) (drop (from + 1) (tokens f)),
           not (null value)
       ]
  where
    k = index f

-- | A step on a line of its own, moved to the line of the depth, or that of a pocket before its
-- braces. It replaces a step that stands there.
stepUp :: Failing -> Token -> [RepairCandidate]
stepUp f t =
  [ RepairCandidate
      (stepAt (from + 2) k f : map Delete ([n | isOld, n <- [from + 2, from + 3]] <> [k .. to - 1]))
      1
      "Write the step on the line of the depth"
    | Word word <- [shape t],
      "step" `elem` (word : meaningsOf word),
      not (isSideways f word),
      to > k + 1,
      from <- take 1 (filter isDepth ([k - 1, k - 2 .. 0] <> [k .. length (tokens f) - 1])),
      let isOld = isStep (from + 2) && maybe True newLine (at f (from + 4)),
      isOld || maybe True newLine (at f (from + 2))
  ]
    <> [ RepairCandidate
           ( stepAt brace k f :
             map Delete ([n | isOld, n <- [brace - 2, brace - 1]] <> [k .. to - 1])
           )
           1
           "Write the step before the braces"
         | Word word <- [shape t],
           isSideways f word,
           to > k + 1,
           brace <- take 1 [n | (n, b) <- zip [0 ..] (tokens f), shape b == Symbol "{"],
           let isOld = isStep (brace - 2)
       ]
  where
    k = index f
    to = lineEnd f
    isStep n = (shape <$> at f n) == Just (Word "step")
    isDepth n = or [newLine d && shape d == Word "depth" | Just d <- [at f n]]

-- | The insertion of a step at an index. Its value is on the line of the word with the index @k@.
stepAt :: Int -> Int -> Failing -> TokenChange
stepAt n k f = Insert n isAtEnd (Word "step" : map shape (takeWhile (not . newLine) value))
  where
    value = drop (k + 1) (tokens f)
    isAtEnd = (shape <$> at f n) /= Just (Symbol "{")

-- | True of a word that means the distance between the passes of a pocket.
isSideways :: Failing -> Text -> Bool
isSideways f word =
  map shape (take 1 (tokens f)) == [Word "pocket"]
    && Text.toLower word `elem` Text.words "stepover step_over woc ae width_of_cut"

-- | Signs at the end of a line that ends too early, and the line without its last token.
atLineEnd :: Failing -> [RepairCandidate]
atLineEnd f =
  [ RepairCandidate
      [Insert k True [token w]]
      2
      ("Write " <> quote w <> " at the end of the line" <> remark w)
    | w <- wanted f,
      w == "allowed"
        || w `elem` ["on", "off"] && opening f == "coolant"
        || w `elem` ["cw", "ccw"] && opening f == "spindle"
        || w == "s" && opening f == "dwell"
        || w == "stop" && opening f == "optional"
        || w == "{" && Symbol "}" `elem` map shape (drop k (tokens f))
  ]
    <> [ RepairCandidate [Exchange (k - 1) []] 3 ("Leave " <> quote (spelling (shape t)) <> " out")
         | k > 0,
           Just t <- [at f (k - 1)],
           isSign (shape t)
       ]
  where
    k = index f
    remark w = if w == "ccw" then ", for left-hand cutters" else ""
