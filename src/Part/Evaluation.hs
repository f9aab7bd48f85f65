-- | The monad of evaluation. A computation yields a value, or it fails with mistakes. It fails
-- without a mistake if it needs a value that is missing because of a mistake already reported.
--
-- A step is the unit of work: one node of an expression, one row, one item of a list. The number of
-- steps is limited, so that every evaluation ends.
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
    withArguments,
  )
where

import Base.Region (Region)
import Data.Either (fromLeft)
import GHC.Exts (oneShot)
import Part.Error (Error (..), ValueFact (..))

-- | A computation, as a function of the number of steps that it may still take.
newtype Eval a = Eval (Int -> Outcome a)

-- | The outcome of a computation: the number of steps that are left, and either the value or the
-- mistakes. The list of mistakes is empty if the cause is already reported.
data Outcome a = Found Int a | Failed Int [Error]

-- | Makes a computation from its function. 'oneShot' promises GHC that this function is called only
-- once; GHC then need not allocate a closure.
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

-- | Runs a computation that may take @fuel@ steps. The number in the result is the number of steps
-- that are left.
run :: Int -> Eval a -> (Either [Error] a, Int)
run fuel (Eval e) = case e fuel of
  Found left a -> (Right a, left)
  Failed left errors -> (Left errors, left)

-- | Fails with one mistake.
mistake :: ValueFact -> Eval a
mistake fact = mistakes [Error fact [] []]

-- | Fails with several mistakes.
mistakes :: [Error] -> Eval a
mistakes errors = Eval (`Failed` errors)

-- | Fails without a mistake: the computation needs something that is missing because of a mistake
-- already reported.
absent :: Eval a
absent = mistakes []

-- | Runs all computations, even if some of them fail. If any failed, it fails with the mistakes of
-- all of them.
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

-- | Applies @find@ to each item, even if it fails for some of them, and concatenates the results.
-- If any computation failed, it fails with the mistakes of all of them. For long lists it replaces
-- 'gather', because it needs no stack space for each item.
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

-- | Takes @wanted@ steps. If fewer are left, it fails with a mistake at @region@ and sets the
-- number of steps to −1. Every later call then fails without a mistake, so that this mistake is
-- reported once.
spend :: Region -> Int -> Eval ()
spend region wanted = steps $ \left -> case () of
  _
    | left < 0 -> Failed left []
    | wanted > left -> Failed (-1) [Error (TooMuchWork region mostSteps) [] []]
    | otherwise -> Found (left - wanted) ()

-- | The number of steps that the evaluation of a program may take.
mostSteps :: Int
mostSteps = 5000000

-- | Adds the region of a function call to the mistakes that the computation of the call reports.
inCall :: Region -> Eval a -> Eval a
inCall region (Eval e) = steps $ \left -> case e left of
  Found left' a -> Found left' a
  Failed left' errors ->
    Failed left' (map (\m -> m {calls = calls m <> [region]}) errors)

-- | Adds the regions of the arguments of a built-in function to the mistakes that its computation
-- reports.
withArguments :: [Region] -> Eval a -> Eval a
withArguments regions (Eval e) = steps $ \left -> case e left of
  Found left' a -> Found left' a
  Failed left' errors -> Failed left' (map (\m -> m {arguments = regions}) errors)
