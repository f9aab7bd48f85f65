{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Fixes and advice for the lines of a table.
module Surface.RowFix
  ( rowFixes,
    rowAdvice,
    headingFixes,
    headingAdvice,
    separatorTitle,
  )
where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..), columnUnits, describe, unitName)
import Surface.TokenContext (TokenContext (..))
import Surface.TokenFix qualified as TokenFix

-- | Fixes for a token that begins no cell of a row.
rowFixes :: Region -> Token_ -> TokenContext -> [Fix]
rowFixes region token around = case token of
  Symbol ","
    | TokenFix.isDecimalComma token around ->
      [Fix.exchange "Write a decimal point." region ".", spaces]
    | otherwise -> [spaces]
  Stray _ -> [spaces]
  Symbol "+" | Just t <- next, attached t -> [Fix.removal "Remove the sign +." region]
  Symbol s
    | s `elem` ["*", "/", "-", "+"],
      Just a <- listToMaybe (before around),
      Just b <- next ->
      [inBrackets (Region.merge (place a) (place b))]
    | s == "(",
      Just a <- listToMaybe (before around),
      shape a == Symbol "-" ->
      [inBrackets (Region.merge (place a) (callRegion (after around)))]
  Word word
    | not (Keyword.isReserved word) ->
      [inBrackets (signed (callRegion (callArguments (after around))))]
  _ -> []
  where
    -- The region with the minus sign before it.
    signed r = case before around of
      t : _ | shape t == Symbol "-" -> Region.merge (place t) r
      _ -> r
    next = listToMaybe (after around)
    inBrackets r = Fix.enclosure "Write brackets around what is computed." "(" r ")"
    callArguments ts = case ts of
      t : _ | attached t && shape t == Symbol "(" -> ts
      _ -> []
    -- The region of the wrong token and of the tokens up to the bracket that closes them.
    callRegion ts = foldl Region.merge region (map place (upToClosing 0 ts))
    -- All wrong separators of the row at once.
    spaces =
      Fix.joined
        separated
        [ Fix.exchange "" r " "
          | r <- region : [place t | t <- after around, shape t == token]
        ]

-- | The title of the report of a sign that separates columns in other tables. 'Nothing' for other
-- tokens.
separatorTitle :: Token_ -> Maybe Text
separatorTitle token
  | token `elem` (Symbol "," : map Stray [';', '|']) =
    Just ("the columns of a table have spaces between them, not " <> describe token)
  | otherwise = Nothing

-- | The title of fixes that write spaces instead of other separators.
separated :: Text
separated = "Write spaces between the columns."

-- | The tokens up to the bracket that closes the first one, or a bracket that was open before. The
-- first argument is the count of brackets that are open.
upToClosing :: Int -> [Token] -> [Token]
upToClosing open ts = case ts of
  [] -> []
  t : rest -> case shape t of
    Symbol "(" -> t : upToClosing (open + 1) rest
    Symbol ")" -> if open <= 1 then [t] else t : upToClosing (open - 1) rest
    _ -> t : upToClosing open rest

-- | Suggests what to write instead of a token that begins no cell of a row.
rowAdvice :: Token_ -> TokenContext -> [Text]
rowAdvice token around = case token of
  Symbol "," -> [spaces]
  Stray _ -> [spaces]
  Symbol "+" | isTouched -> ["A positive number needs no sign."]
  Symbol _ -> []
  Word word | not (Keyword.isReserved word) -> []
  _ -> [spaces, "A value that is no plain number is in brackets: (2 * h)."]
  where
    spaces = "The values of a row follow one another with spaces between them: 0 40"
    isTouched = maybe False attached (listToMaybe (after around))

-- | Fixes for a token that begins no heading: removes all signs among the headings.
headingFixes :: Region -> Token_ -> TokenContext -> [Fix]
headingFixes region token around = case token of
  Word word
    | word `notElem` map unitName [minBound .. maxBound] ->
      [Fix.exchange ("Name it " <> word <> "1.") region (word <> "1")]
  _
    | isSign token ->
      [ Fix.joined
          separated
          [Fix.exchange "" r " " | r <- region : [place t | t <- after around, isSign (shape t)]]
      ]
  _ -> []
  where
    isSign t = t `elem` (map Symbol [",", "(", ")", "[", "]"] <> map Stray [';', '|'])

-- | Suggests what to write instead of a token that begins no heading of a table.
headingAdvice :: Token_ -> [Text]
headingAdvice token = case token of
  Symbol "/" -> [units]
  Symbol "," -> [names]
  Symbol _ -> [names, units]
  Word word
    | word `elem` map unitName [minBound .. maxBound] -> [units]
    | otherwise -> []
  _ -> [names, "In a row below them, what is no plain number is in brackets: (h)."]
  where
    names = "The line with the names of the columns has nothing else: x y mu deg H"
    units =
      "A column has one of the units "
        <> Text.intercalate ", " (map unitName columnUnits)
        <> ", or none."
