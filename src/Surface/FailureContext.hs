{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | A statement that cannot be parsed, and the places in it around the token at which parsing
-- fails.
module Surface.FailureContext
  ( Failing (..),
    at,
    slice,
    written,
    lineOf,
    lineEnd,
    firstWord,
    opening,
    segmentEnd,
    operandStart,
    operandEnd,
    closingOf,
    isSettingStart,
    isStatementStart,
    isWordText,
    token,
  )
where

import Data.Char (isAsciiLower)
import Data.List (findIndex)
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..), spelling)

-- | A statement that cannot be parsed: its tokens, the index of the token at which parsing fails,
-- and the words and signs that would be right there. The flags tell if a value and if a name
-- would be right.
data Failing = Failing
  { tokens :: [Token],
    index :: Int,
    wanted :: [Text],
    isValueWanted :: Bool,
    isNameWanted :: Bool
  }

at :: Failing -> Int -> Maybe Token
at f n = listToMaybe (drop n (tokens f))

slice :: Int -> Int -> Failing -> [Token]
slice from to f = take (to - from) (drop from (tokens f))

written :: [Token] -> Text
written ts = Text.unwords (map (spelling . shape) ts)

-- | The indices of the tokens on the line of the wrong token.
lineOf :: Failing -> [Int]
lineOf f = [first .. lineEnd f - 1]
  where
    first =
      maximum
        (0 : [n | (n, t) <- zip [0 ..] (take (index f + 1) (tokens f)), newLine t])

-- | The index after the last token on the line of the wrong token.
lineEnd :: Failing -> Int
lineEnd f =
  maybe (length (tokens f)) (+ (index f + 1)) (findIndex newLine (drop (index f + 1) (tokens f)))

-- | The word with which the line of the wrong token begins; empty if it begins with no word.
firstWord :: Failing -> Text
firstWord f = case shape <$> at f (maximum (0 : take 1 (lineOf f))) of
  Just (Word word) -> word
  _ -> ""

-- | The word with which the line before the wrong token begins.
opening :: Failing -> Text
opening f = case break newLine (reverse (take (index f) (tokens f))) of
  (_, t : _) | Word word <- shape t -> word
  _ -> ""

-- | The index after the word at an index and the value that follows it: the next keyword, comma,
-- brace or line ends it.
segmentEnd :: Failing -> Int -> Int
segmentEnd f from = go (0 :: Int) (from + 1)
  where
    go open n = case at f n of
      Nothing -> n
      Just t
        | newLine t -> n
        | otherwise -> case shape t of
          Symbol s
            | s `elem` ["(", "["] -> go (open + 1) (n + 1)
            | s `elem` [")", "]"] -> if open == 0 then n else go (open - 1) (n + 1)
            | s `elem` ["{", "}"] || s == "," && open == 0 -> n
          Word w | open == 0, isMarker w -> n
          _ -> go open (n + 1)
    isMarker w =
      Keyword.isReserved w || Keyword.beginsItem w
        || w `elem` ["depth", "step", "at", "to", "by", "cipher", "joggle", "radius"]

-- | The index of the first token of the value before an index.
operandStart :: Failing -> Int -> Maybe Int
operandStart f k = case at f (k - 1) of
  Just t
    | Number _ _ <- shape t -> Just (signed (k - 1))
    | Word w <- shape t, not (Keyword.isReserved w) -> Just (signed (k - 1))
  _ -> Nothing
  where
    signed n = case at f (n - 1) of
      Just t | shape t == Symbol "-" -> n - 1
      _ -> n

operandEnd :: Failing -> Int -> Int
operandEnd f k = case shape <$> at f k of
  Just (Symbol "-") -> k + 2
  Just (Number _ _) -> k + 1
  Just (Word w) | not (Keyword.isReserved w) -> k + 1
  _ -> k

-- | The index of the bracket that closes the one at an index.
closingOf :: [Token] -> Int -> Maybe Int
closingOf ts k = go (0 :: Int) (zip [k ..] (drop k ts))
  where
    go open list = case list of
      [] -> Nothing
      (n, t) : rest -> case shape t of
        Symbol s
          | s `elem` ["(", "[", "{"] -> go (open + 1) rest
          | s `elem` [")", "]", "}"] -> if open == 1 then Just n else go (open - 1) rest
        _ -> go open rest

-- | True if the first word of a setting would be right at the wrong token.
isSettingStart :: Failing -> Bool
isSettingStart f = any (`elem` wanted f) ["plunge", "peck", "retract"]

-- | True if the keyword of a statement would be right at the wrong token.
isStatementStart :: Failing -> Bool
isStatementStart f = "clearance" `elem` wanted f

isWordText :: Text -> Bool
isWordText w = maybe False (isAsciiLower . fst) (Text.uncons w)

-- | The token of a keyword or a sign.
token :: Text -> Token_
token w = if isWordText w then Word w else Symbol w
