-- | Checked terms that are complete only when type inference has found all dimensions of the
-- program.
--
-- When these are known, every part of such a term is evaluated. An unevaluated part would keep the
-- state of inference in memory.
module Checked.Deferred
  ( Deferred,
    resolveAll,
    mapStrict,
  )
where

import Checked.Inference (Solution)

-- | A term as a function of the solution: the final values of the dimensions that were unknown
-- during inference.
type Deferred a = Solution -> a

-- | Completes the terms with the solution, and evaluates each of them to its outermost constructor.
resolveAll :: Solution -> [Deferred a] -> [a]
resolveAll solution terms = let found = map ($ solution) terms in foldr seq found found

-- | Applies a function to the value, if there is one, and evaluates the result to its outermost
-- constructor.
mapStrict :: (a -> b) -> Maybe a -> Maybe b
mapStrict f thing = case thing of
  Nothing -> Nothing
  Just a -> Just $! f a
