-- | A lazy list with a value at its end: the result of the computation that makes the list.
--
-- A consumer can first ask for the value at the end, which computes the whole list, and then read
-- the items from memory. The usual accumulation of items in reverse order would need twice the
-- memory while the list is reversed.
module Base.LazyList
  ( LazyList (..),
    prependReversed,
    toList,
    end,
  )
where

-- | An item and the rest of the list, which is computed on demand; or the value at the end.
data LazyList e a = Next a ~(LazyList e a) | End e

-- | Prepends items that are given in reverse order: the first item of @latest@ comes directly
-- before @list@.
prependReversed :: [a] -> LazyList e a -> LazyList e a
prependReversed latest list = case latest of
  [] -> list
  a : earlier -> prependReversed earlier (Next a list)

-- | The items of a lazy list, in order.
toList :: LazyList e a -> [a]
toList list = case list of
  Next a more -> a : toList more
  End _ -> []

-- | The value at the end of a lazy list.
end :: LazyList e a -> e
end list = case list of
  Next _ more -> end more
  End e -> e
