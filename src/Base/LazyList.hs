-- | A list that is made as it is asked for, and what there is to say behind the last of it.
--
-- Who wants to know first how it ends walks along it once; what is made on the way stays where it
-- is. To gather it in a list and to turn that round would take a second copy of everything.
module Base.LazyList
  ( LazyList (..),
    behind,
    toList,
    end,
  )
where

-- | What comes next, or what there is to say at the end.
data LazyList e a = Next a ~(LazyList e a) | End e

-- | A series behind some things, of which the last one is given first.
behind :: [a] -> LazyList e a -> LazyList e a
behind latest series = case latest of
  [] -> series
  a : before -> behind before (Next a series)

-- | What comes one after the other.
toList :: LazyList e a -> [a]
toList series = case series of
  Next a more -> a : toList more
  End _ -> []

-- | What there is to say behind the last.
end :: LazyList e a -> e
end series = case series of
  Next _ more -> end more
  End e -> e
