-- | Checked terms that need the solution of type inference for the whole program.
--
-- Once the solution is known, every part of such a term is evaluated. A thunk in it would keep the
-- state of inference alive.
module Checked.Deferred
  ( Deferred,
    resolveAll,
    mapStrict,
  )
where

import Checked.Inference (Solution)

-- | A term that depends on the solution of type inference.
type Deferred a = Solution -> a

-- | Applies a list of terms to the solution, and evaluates each result to its outermost
-- constructor.
resolveAll :: Solution -> [Deferred a] -> [a]
resolveAll solution terms = let found = map ($ solution) terms in foldr seq found found

-- | Applies a function to an optional value, and evaluates the result to its outermost constructor.
mapStrict :: (a -> b) -> Maybe a -> Maybe b
mapStrict f thing = case thing of
  Nothing -> Nothing
  Just a -> Just $! f a
