-- | Computations on a program's values: they may find mistakes, or depend on one that is reported
-- already, and they take a limited number of steps.
module Part.Eval
  ( Eval,
    run,
    mistake,
    mistakes,
    absent,
    gather,
    spend,
    mostSteps,
    inCall,
  )
where

import Base.Region (Region)
import Control.Monad (when)
import Data.Either (fromLeft)
import Part.Error (Error (..), Fact (..))

-- | What is done with some steps left.
newtype Eval a = Eval (Int -> Outcome a)

-- | The steps then left, and what was found; or the mistakes, none when they are reported already.
data Outcome a = Found Int a | Failed Int [Error]

instance Functor Eval where
  fmap f (Eval e) = Eval $ \left -> case e left of
    Found left' a -> Found left' (f a)
    Failed left' errors -> Failed left' errors
  {-# INLINE fmap #-}

instance Applicative Eval where
  pure a = Eval (`Found` a)
  {-# INLINE pure #-}
  Eval e <*> Eval e' = Eval $ \left -> case e left of
    Found left' f -> case e' left' of
      Found left'' a -> Found left'' (f a)
      Failed left'' errors -> Failed left'' errors
    Failed left' errors -> Failed left' errors
  {-# INLINE (<*>) #-}

instance Monad Eval where
  Eval e >>= f = Eval $ \left -> case e left of
    Found left' a -> let Eval e' = f a in e' left'
    Failed left' errors -> Failed left' errors
  {-# INLINE (>>=) #-}

-- | Run with so many steps; tell how many are left.
run :: Int -> Eval a -> (Either [Error] a, Int)
run fuel (Eval e) = case e fuel of
  Found left a -> (Right a, left)
  Failed left errors -> (Left errors, left)

mistake :: Fact -> Eval a
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
    tried (Eval e) = Eval $ \left -> case e left of
      Found left' a -> Found left' (Right a)
      Failed left' errors -> Found left' (Left errors)
{-# INLINEABLE gather #-}

-- | Take steps. When there are none left, that is reported once; below zero it is reported already.
spend :: Region -> Int -> Eval ()
spend region steps = do
  left <- Eval (\left -> Found left left)
  when (left < 0) absent
  if steps > left
    then leave (-1) *> mistake (TooMuchWork region mostSteps)
    else leave (left - steps)
  where
    leave left = Eval (const (Found left ()))

-- | A program may take so many steps.
mostSteps :: Int
mostSteps = 5000000

-- | Note through which call of a function a mistake came.
inCall :: Region -> Eval a -> Eval a
inCall region (Eval e) = Eval $ \left -> case e left of
  Found left' a -> Found left' a
  Failed left' errors -> Failed left' (map (\(Error fact calls) -> Error fact (calls <> [region])) errors)
