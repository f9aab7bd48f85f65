{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Changes of the tokens of a statement, of which its repair consists.
module Surface.TokenRepair
  ( RepairCandidate (..),
    TokenChange (..),
    changed,
    isSign,
    between,
  )
where

import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..))

-- | A guess: the changes of tokens, its cost, and the words that name it. A cheap guess is tried
-- before a dear one.
data RepairCandidate = RepairCandidate {changes :: [TokenChange], cost :: Int, words' :: Text}

-- | A change at the index of a token, from 0.
data TokenChange
  = -- | new tokens before the token with the index; at the end of a line if the flag is true
    Insert Int Bool [Token_]
  | -- | no token instead of one
    Delete Int
  | -- | other tokens, on a line of their own, instead of one
    Begin Int [Token_]
  | -- | other tokens instead of one
    Exchange Int [Token_]
  | -- | a copy of the tokens with the indices from the second to before the third, before the
    -- first; on a line of its own if the flag is true
    Copy Int Int Int Bool
  deriving stock (Eq, Ord, Show)

-- | The tokens after changes. A token that is written anew has an empty region.
changed :: [TokenChange] -> [Token] -> [Token]
changed cs ts = go (zip [0 ..] ts) Nothing False False
  where
    -- @begins@ and @isLoose@ tell if the tokens before the next one that are gone began its line,
    -- and if any are gone.
    go list before begins isLoose = case list of
      [] -> concatMap (added (length ts) before) cs
      (k, t) : rest ->
        let new = concatMap (added k before) cs
            isApart = null new || or [True | Insert n True _ <- cs, n == k] || any newLine new
            isFirst = begins || newLine t
            t' =
              t
                { newLine = isFirst && isApart,
                  attached = attached t && null new && not isLoose
                }
            kept = replacement k t'
            begin = if isApart then new else marked isFirst new
         in begin
              <> kept
              <> go rest (Just t) (null kept && newLine t') (isLoosened t kept)
    added k before c = case c of
      Insert n _ ns | n == k -> zipWith made (before : map (Just . made Nothing) ns) ns
      Copy n from to isLine
        | n == k ->
          marked isLine (map (\t -> t {newLine = False, attached = False}) (between from to ts))
      _ -> []
    marked isLine new = case new of
      [] -> []
      t : more -> t {newLine = isLine} : more
    replacement k t
      | or [True | Delete n <- cs, n == k] = []
      | ns : _ <- [ns | Begin n ns <- cs, n == k] = marked True (map (made Nothing) ns)
      | ns : _ <- [ns | Exchange n ns <- cs, n == k] = case map (made Nothing) ns of
        [] -> []
        n : more ->
          let isAlike = isSign (shape t) == isSign (shape n)
           in n {newLine = newLine t, attached = attached t && isAlike} : more
      | otherwise = [t]

-- | True if a token is gone, or a comma is in its place, so that a space follows.
isLoosened :: Token -> [Token] -> Bool
isLoosened t kept = all ((== Symbol ",") . shape) kept && shape t /= Symbol ","

-- | A token that is written anew after another one.
made :: Maybe Token -> Token_ -> Token
made before n = Token {place = Region 0 0, shape = n, newLine = False, attached = isTight}
  where
    isTight =
      n `elem` map Symbol [")", ",", "]"]
        || n == Symbol "(" && maybe False isFunction before
    -- A bracket follows a function or a cutter without a space.
    isFunction t = case shape t of
      Word w ->
        w `elem` ["mill", "drill", "turn", "cone", "vbit", "blade"]
          || not (Keyword.isReserved w || Keyword.beginsItem w)
            && w `notElem` Text.words "at step to by"
      _ -> False

-- | The items with the indices from the first to before the second.
between :: Int -> Int -> [a] -> [a]
between from to = take (to - from) . drop from

isSign :: Token_ -> Bool
isSign t = case t of
  Symbol s -> s `notElem` ["{", "}"]
  Stray _ -> True
  _ -> False
