-- | A lazy list with a value at its end, which tells how the production of the list ended.
--
-- A consumer that needs the value first forces the list once and then reads the items from memory.
-- An accumulator that is reversed at the end would need a second copy of them.
module Base.LazyList
  ( LazyList (..),
    prependReversed,
    toList,
    end,
  )
where

-- | An item and the rest of the list, or the value at the end.
data LazyList e a = Next a ~(LazyList e a) | End e

-- | A list with items before it, the last of which is given first.
prependReversed :: [a] -> LazyList e a -> LazyList e a
prependReversed latest list = case latest of
  [] -> list
  a : earlier -> prependReversed earlier (Next a list)

-- | The items in order.
toList :: LazyList e a -> [a]
toList list = case list of
  Next a more -> a : toList more
  End _ -> []

-- | The value at the end.
end :: LazyList e a -> e
end list = case list of
  Next _ more -> end more
  End e -> e
