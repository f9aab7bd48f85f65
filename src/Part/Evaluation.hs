-- | The monad of evaluation. A computation yields a value, or mistakes; it fails without a mistake
-- when it depends on one that is already reported. It takes a limited number of steps, so that
-- every evaluation ends.
module Part.Evaluation
  ( Eval,
    run,
    mistake,
    mistakes,
    absent,
    gather,
    collect,
    spend,
    mostSteps,
    inCall,
  )
where

import Base.Region (Region)
import Data.Either (fromLeft)
import GHC.Exts (oneShot)
import Part.Error (Error (..), ValueFact (..))

-- | A computation: a function of the steps left.
newtype Eval a = Eval (Int -> Outcome a)

-- | The steps left, and the value or the mistakes; no mistakes when they are already reported.
data Outcome a = Found Int a | Failed Int [Error]

-- | A computation from its function of steps. 'oneShot' promises GHC that the function is called
-- once, so that no closure is allocated for it.
steps :: (Int -> Outcome a) -> Eval a
steps f = Eval (oneShot f)

instance Functor Eval where
  fmap f (Eval e) = steps $ \left -> case e left of
    Found left' a -> Found left' (f a)
    Failed left' errors -> Failed left' errors
  b <$ e = fmap (const b) e

instance Applicative Eval where
  pure a = steps (`Found` a)
  e <*> e' = e >>= \f -> fmap f e'
  e *> e' = e >>= const e'

instance Monad Eval where
  Eval e >>= f = steps $ \left -> case e left of
    Found left' a -> let Eval e' = f a in e' left'
    Failed left' errors -> Failed left' errors

-- | Runs a computation with a number of steps; yields its result and the steps left.
run :: Int -> Eval a -> (Either [Error] a, Int)
run fuel (Eval e) = case e fuel of
  Found left a -> (Right a, left)
  Failed left errors -> (Left errors, left)

-- | Fails with one mistake.
mistake :: ValueFact -> Eval a
mistake fact = mistakes [Error fact []]

-- | Fails with these mistakes.
mistakes :: [Error] -> Eval a
mistakes errors = Eval (`Failed` errors)

-- | Fails because of a mistake that is already reported.
absent :: Eval a
absent = mistakes []

-- | Runs all computations, even after a failure, and fails with the mistakes of all of them.
gather :: Traversable t => t (Eval a) -> Eval (t a)
gather evals = do
  results <- traverse tried evals
  case foldMap (fromLeft []) results of
    [] -> either (const absent) pure (sequence results)
    errors -> mistakes errors
  where
    tried (Eval e) = steps $ \left -> case e left of
      Found left' a -> Found left' (Right a)
      Failed left' errors -> Found left' (Left errors)

-- | Runs a computation for each item, even after a failure, and concatenates the results. Fails
-- with the mistakes of all of them. Takes stack for none of the items, unlike 'gather'.
collect :: (a -> Eval [b]) -> [a] -> Eval [b]
collect find items = Eval (collecting [] items)
  where
    collecting found rest left = case rest of
      [] -> Found left (reverse found)
      a : more ->
        let Eval e = find a
         in case e left of
              Found left' bs -> collecting (foldl (flip (:)) found bs) more left'
              Failed left' errors -> failing [errors] more left'
    failing errors rest left = case rest of
      [] -> Failed left (concat (reverse errors))
      a : more ->
        let Eval e = find a
         in case e left of
              Found left' _ -> failing errors more left'
              Failed left' new -> failing (new : errors) more left'

-- | Takes a number of steps. Fails when too few are left: the first time with a mistake, and then,
-- with the count below 0, without one.
spend :: Region -> Int -> Eval ()
spend region wanted = steps $ \left -> case () of
  _
    | left < 0 -> Failed left []
    | wanted > left -> Failed (-1) [Error (TooMuchWork region mostSteps) []]
    | otherwise -> Found (left - wanted) ()

-- | The number of steps that a program may take.
mostSteps :: Int
mostSteps = 5000000

-- | Adds the region of a function call to the mistakes that occur in it.
inCall :: Region -> Eval a -> Eval a
inCall region (Eval e) = steps $ \left -> case e left of
  Found left' a -> Found left' a
  Failed left' errors ->
    Failed left' (map (\(Error fact calls) -> Error fact (calls <> [region])) errors)
