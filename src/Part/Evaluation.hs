-- | The monad of evaluation. A computation yields a value or fails with mistakes. It fails without
-- a mistake if it depends on a mistake that is already reported. The number of its steps is
-- limited, so that every evaluation ends.
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

-- | A computation: a function of the number of steps that are left.
newtype Eval a = Eval (Int -> Outcome a)

-- | The outcome of a computation: the number of steps that are left, and the value or the mistakes.
-- There is no mistake if the cause is already reported.
data Outcome a = Found Int a | Failed Int [Error]

-- | A computation from a function of the number of steps. 'oneShot' promises GHC that the function
-- is called only once, so that GHC need not allocate a closure.
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

-- | Runs a computation that may take the given number of steps. Yields its result and the number of
-- steps that are left.
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

-- | Fails without a mistake, because the cause is already reported.
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
-- with the mistakes of all computations. Unlike 'gather', it needs no stack space for each item.
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

-- | Takes a number of steps. If too few steps are left, it fails with a mistake and sets their
-- number to −1. Every later call then fails without a mistake.
spend :: Region -> Int -> Eval ()
spend region wanted = steps $ \left -> case () of
  _
    | left < 0 -> Failed left []
    | wanted > left -> Failed (-1) [Error (TooMuchWork region mostSteps) []]
    | otherwise -> Found (left - wanted) ()

-- | How many steps the evaluation of a program may take.
mostSteps :: Int
mostSteps = 5000000

-- | Adds the region of a function call to the mistakes that occur in the call.
inCall :: Region -> Eval a -> Eval a
inCall region (Eval e) = steps $ \left -> case e left of
  Found left' a -> Found left' a
  Failed left' errors ->
    Failed left' (map (\(Error fact calls) -> Error fact (calls <> [region])) errors)
