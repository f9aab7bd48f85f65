{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Lines of a program that are comments in round brackets, as G-code has them.
module Surface.CommentLine
  ( find,
  )
where

import Base.Region (Region (..))
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..))

-- | Finds the lines that are comments in round brackets: their regions. @mistakes@ are the regions
-- at which the program cannot be parsed. 'Nothing' if none of them is in such a line.
find :: [Token] -> [Region] -> Maybe (NonEmpty Region)
find tokens mistakes
  | any (\r -> any (isIn r) mistakes) found = NonEmpty.nonEmpty found
  | otherwise = Nothing
  where
    ls = inLines tokens
    elsewhere = Set.fromList [w | l <- ls, not (isEnclosed l), Word w <- map shape l]
    found =
      [ Region (start (place (head l))) (end (place (last l)))
        | (depth, l) <- zip (scanl (+) 0 (map nesting ls)) ls,
          isEnclosed l,
          isText elsewhere depth (map shape (drop 1 (init l)))
      ]
    isIn r mistake = start r <= start mistake && start mistake < end r

-- | The change of the count of open brackets by some tokens.
nesting :: [Token] -> Int
nesting = sum . map (change . shape)

change :: Token_ -> Int
change t = case t of
  Symbol s
    | s `elem` ["(", "[", "{"] -> 1
    | s `elem` [")", "]", "}"] -> -1
  _ -> 0

-- | True of a line in a pair of round brackets.
isEnclosed :: [Token] -> Bool
isEnclosed l = case map shape l of
  opening@(Symbol "(") : rest@(_ : _ : _) ->
    last rest == Symbol ")"
      && all (> 0) (init (drop 1 (scanl (+) 0 (map change (opening : rest)))))
      && nesting l == 0
  _ -> False

-- | True if tokens in brackets are text and no value. In braces or in other brackets, one of their
-- words must be no keyword and occur nowhere else, because two names there may be a point without
-- its comma.
isText :: Set Text -> Int -> [Token_] -> Bool
isText elsewhere depth ts =
  not (null words') && isProse && (depth <= 0 || any isOwn words')
  where
    words' = [w | Word w <- ts]
    isOwn w = not (Set.member w elsewhere) && not (Keyword.isReserved w)
    isProse = length ts == 1 || any isBroken ts || or (zipWith isPair ts (drop 1 ts))
    isPair a b = isItem a && isItem b
    isBroken t = case t of
      Stray _ -> True
      BadNumber _ -> True
      _ -> False
    isItem t = case t of
      Word _ -> True
      Number _ _ -> True
      _ -> False

inLines :: [Token] -> [[Token]]
inLines ts = case ts of
  [] -> []
  t : rest -> let (same, more) = break newLine rest in (t : same) : inLines more
