-- | Terms that are known when the whole program has been looked at. Once they are, nothing of them
-- is put off: what is put off holds all that it was found by.
module Checked.Deferred
  ( Deferred,
    resolveAll,
    mapStrict,
  )
where

import Checked.Inference (Solution)

-- | By what the unknowns turned out to be.
type Deferred a = Solution -> a

-- | All of them.
resolveAll :: Solution -> [Deferred a] -> [a]
resolveAll solution laters = let found = map ($ solution) laters in foldr seq found found

-- | What there is, changed at once.
mapStrict :: (a -> b) -> Maybe a -> Maybe b
mapStrict f thing = case thing of
  Nothing -> Nothing
  Just a -> Just $! f a
