{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Candidates for the repair of a statement that are particular to one kind of statement, such as
-- two definitions on one line.
module Surface.LineRepair
  ( lists,
    others,
    modifiers,
    quotations,
  )
where

import Data.Char (isAlphaNum)
import Data.Text qualified as Text
import Report.Report (quote)
import Surface.FailureContext
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..), spelling, unitName)
import Surface.TokenRepair (RepairCandidate (..), TokenChange (..))

-- | Two definitions with a comma between them, and two tolerances; a name with a hyphen.
lists :: Failing -> Token -> [RepairCandidate]
lists f t = definitions f t <> measures f t <> names f t

-- | The second of two definitions on one line, on a line of its own.
definitions :: Failing -> Token -> [RepairCandidate]
definitions f t =
  [ RepairCandidate [Begin k [Word (firstWord f)]] 1 "Begin a new line with the second definition"
    | firstWord f `elem` ["let", "param"],
      shape t == Symbol ",",
      Just (Word _) <- [shape <$> at f (k + 1)],
      Just (Symbol "=") <- [shape <$> at f (k + 2)]
  ]
    <> [ RepairCandidate
           [Begin k [Word (firstWord f), shape t]]
           1
           "Begin a new line with the second definition"
         | firstWord f `elem` ["let", "param"],
           Word w <- [shape t],
           not (Keyword.isReserved w),
           Just (Symbol "=") <- [shape <$> at f (k + 1)]
       ]
  where
    k = index f

-- | A unit after its number, and the sides of two tolerances.
measures :: Failing -> Token -> [RepairCandidate]
measures f t =
  [ RepairCandidate
      (Exchange k [Number n (Just u)] : map Delete [k + 1 .. k + count])
      1
      "Write the unit after its number"
    | isValueWanted f,
      u <- [minBound .. maxBound],
      count <- [1, 3],
      unitName u == Text.concat (map (spelling . shape) (slice k (k + count) f)),
      Just (Number n Nothing) <- [shape <$> at f (k + count)]
  ]
    <> [ RepairCandidate
           [Insert (first + 1) False [Word "inside"], Exchange k [Word "outside"]]
           1
           "Write both tolerances with their sides"
         | firstWord f == "tolerance",
           shape t == Symbol ","
       ]
  where
    k = index f
    first = maximum (0 : take 1 (lineOf f))

-- | A name with a hyphen, and one in quotation marks.
names :: Failing -> Token -> [RepairCandidate]
names f t =
  [ RepairCandidate
      [Exchange (k - 1) [Word (a <> "_" <> b)], Exchange k [], Exchange (k + 1) []]
      2
      ("Write ‘_’ in the name instead of " <> quote (spelling (shape t)))
    | "=" `elem` wanted f || "closed" `elem` wanted f,
      shape t == Symbol "-",
      Just (Word a) <- [shape <$> at f (k - 1)],
      Just (Word b) <- [shape <$> at f (k + 1)]
  ]
    <> [ RepairCandidate [Exchange k [Word name]] 1 "Write the name without quotation marks"
         | isNameWanted f,
           Text name <- [shape t],
           not (Text.null name),
           Text.all (\c -> isAlphaNum c || c == '_') name
       ]
  where
    k = index f

-- | Signs of comparison of other languages, the name of a machine in two words, the side of a piece
-- before its ciphers, and a point in the row of a table.
others :: Failing -> Token -> [RepairCandidate]
others f t =
  machineNames f t
    <> [ RepairCandidate [Exchange (k - 1) [Symbol new], Exchange k []] 0 ("Write " <> quote new)
         | Just (Symbol before) <- [shape <$> at f (k - 1)],
           Just new <- [lookup (before, spelling (shape t)) comparisons]
       ]
    <> [ RepairCandidate
           [Insert (lineEnd f) True [Word side], Exchange (k - 1) []]
           1
           ("Write " <> quote side <> " at the end")
         | firstWord f == "piece",
           shape t == Word "cipher",
           Just (Word side) <- [shape <$> at f (k - 1)],
           side `elem` ["left", "right"]
       ]
    <> [ RepairCandidate
           [Exchange n [] | n <- lineOf f, Just x <- [at f n], shape x `elem` signs]
           0
           "Leave the brackets and commas out"
         | map shape (take 1 (tokens f)) == [Word "table"],
           shape t `elem` map Symbol [",", "("]
       ]
  where
    k = index f
    signs = map Symbol ["(", ")", ","]
    comparisons =
      [(("<", ">"), "!="), (("=", ">"), ">="), (("=", "<"), "<="), (("!", "="), "!=")]

-- | The name of a machine without a sign before it, and in one word.
machineNames :: Failing -> Token -> [RepairCandidate]
machineNames f t =
  [ RepairCandidate
      (Exchange k [Word name] : map Delete [k + 1 .. lineEnd f - 1])
      0
      "Leave ‘=’ out"
    | firstWord f == "machine",
      shape t == Symbol "=",
      let name = Text.concat (map (spelling . shape) (slice (k + 1) (lineEnd f) f)),
      not (Text.null name)
  ]
    <> [ RepairCandidate
           [Exchange (k - 1) [Word (a <> spelling (shape t))], Exchange k []]
           1
           "Write the name in one word"
         | firstWord f == "machine",
           Just (Word a) <- [shape <$> at f (k - 1)]
       ]
  where
    k = index f

-- | The modifiers of an element after its link, moved before it.
modifiers :: Failing -> Token -> [RepairCandidate]
modifiers f t =
  paces f t
    <> [ RepairCandidate
           (Copy from k to False : map Delete [k .. to - 1])
           1
           (moved to from)
         | shape t `elem` map Word ["slow", "feed", "allowance", "bevel"],
           from <-
             take
               1
               [ n
                 | n <- lineOf f,
                   n < k,
                   Just x <- [at f n],
                   shape x `elem` map Word ["fillet", "chamfer", "tangent", "smooth", "meet"]
               ],
           to <- [lineEnd f]
       ]
  where
    moved to from =
      "Write " <> quote (written (slice k to f)) <> " before " <> quote (written (slice from k f))
    k = index f

-- | The pace of a motion before its point, moved after it.
paces :: Failing -> Token -> [RepairCandidate]
paces f t =
  [ RepairCandidate
      [Insert (lineEnd f) True [Word "rapid"], Exchange k []]
      0
      "Write ‘rapid’ after the point"
    | isValueWanted f,
      shape t == Word "rapid",
      k + 1 < lineEnd f
  ]
  where
    k = index f

-- | The rest of the line as the title of the part, or the name of a file, in quotation marks.
quotations :: Failing -> Token -> [RepairCandidate]
quotations f t =
  [ RepairCandidate
      (Exchange k [Text title] : map Delete [k + 1 .. to - 1])
      2
      "Write the text in quotation marks"
    | first : _ <- [lineOf f],
      Just (Word word) <- [shape <$> at f first],
      word == "part" && k == first + 2 || word == "import" && k == first + 1,
      to <- [lineEnd f],
      let title = quoted (slice k to f)
  ]
  where
    k = index f
    quoted ts =
      Text.strip
        (Text.concat [(if attached x || x == t then "" else " ") <> spelling (shape x) | x <- ts])
