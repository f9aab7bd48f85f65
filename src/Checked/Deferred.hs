-- | Terms that are known when the whole program has been looked at. Once they are, nothing of them
-- is put off: what is put off holds all that it was found by.
module Checked.Deferred
  ( Later,
    solved,
    eagerly,
  )
where

import Checked.Inference (Solution)

-- | By what the unknowns turned out to be.
type Later a = Solution -> a

-- | All of them.
solved :: Solution -> [Later a] -> [a]
solved solution laters = let found = map ($ solution) laters in foldr seq found found

-- | What there is, changed at once.
eagerly :: (a -> b) -> Maybe a -> Maybe b
eagerly f thing = case thing of
  Nothing -> Nothing
  Just a -> Just $! f a
