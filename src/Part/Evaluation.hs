-- | Computations on a program's values: they may find mistakes, or depend on one that is reported
-- already, and they take a limited number of steps.
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

-- | What is done with some steps left.
newtype Eval a = Eval (Int -> Outcome a)

-- | The steps then left, and what was found; or the mistakes, none when they are reported already.
data Outcome a = Found Int a | Failed Int [Error]

-- | One by its steps. It is run once, as the compiler is told: then it makes no function of it
-- first.
steps :: (Int -> Outcome a) -> Eval a
steps f = Eval (oneShot f)
{-# INLINE steps #-}

instance Functor Eval where
  fmap f (Eval e) = steps $ \left -> case e left of
    Found left' a -> Found left' (f a)
    Failed left' errors -> Failed left' errors
  {-# INLINE fmap #-}
  b <$ e = fmap (const b) e
  {-# INLINE (<$) #-}

instance Applicative Eval where
  pure a = steps (`Found` a)
  {-# INLINE pure #-}
  e <*> e' = e >>= \f -> fmap f e'
  {-# INLINE (<*>) #-}
  e *> e' = e >>= const e'
  {-# INLINE (*>) #-}

instance Monad Eval where
  Eval e >>= f = steps $ \left -> case e left of
    Found left' a -> let Eval e' = f a in e' left'
    Failed left' errors -> Failed left' errors
  {-# INLINE (>>=) #-}

-- | Run with so many steps; tell how many are left.
run :: Int -> Eval a -> (Either [Error] a, Int)
run fuel (Eval e) = case e fuel of
  Found left a -> (Right a, left)
  Failed left errors -> (Left errors, left)

mistake :: ValueFact -> Eval a
mistake fact = mistakes [Error fact []]

mistakes :: [Error] -> Eval a
mistakes errors = Eval (`Failed` errors)

-- | What this depends on is missing because of a mistake that is reported already.
absent :: Eval a
absent = mistakes []

-- | All of them, with the mistakes of all of them.
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
{-# INLINEABLE gather #-}

-- | What is found for each of some things, one behind the other, with the mistakes of all of them.
collect :: (a -> Eval [b]) -> [a] -> Eval [b]
collect find things = Eval (among [] things)
  where
    among found rest left = case rest of
      [] -> Found left (reverse found)
      a : more ->
        let Eval e = find a
         in case e left of
              Found left' bs -> among (foldl (flip (:)) found bs) more left'
              Failed left' errors -> without [errors] more left'
    without errors rest left = case rest of
      [] -> Failed left (concat (reverse errors))
      a : more ->
        let Eval e = find a
         in case e left of
              Found left' _ -> without errors more left'
              Failed left' new -> without (new : errors) more left'

-- | Take steps. When there are none left, that is reported once; below zero it is reported already.
spend :: Region -> Int -> Eval ()
spend region wanted = steps $ \left -> case () of
  _
    | left < 0 -> Failed left []
    | wanted > left -> Failed (-1) [Error (TooMuchWork region mostSteps) []]
    | otherwise -> Found (left - wanted) ()
{-# INLINE spend #-}

-- | A program may take so many steps.
mostSteps :: Int
mostSteps = 5000000

-- | Note through which call of a function a mistake came.
inCall :: Region -> Eval a -> Eval a
inCall region (Eval e) = steps $ \left -> case e left of
  Found left' a -> Found left' a
  Failed left' errors ->
    Failed left' (map (\(Error fact calls) -> Error fact (calls <> [region])) errors)
