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
import Control.Monad.Except (ExceptT, runExceptT, throwError, withExceptT)
import Control.Monad.State.Strict (State, get, lift, put, runState)
import Data.Either (fromLeft)
import Part.Error (Error (..), Fact (..))

-- | The mistakes found, none when they are reported already; the steps left.
type Eval = ExceptT [Error] (State Int)

-- | Run with so many steps; tell how many are left.
run :: Int -> Eval a -> (Either [Error] a, Int)
run fuel eval = runState (runExceptT eval) fuel

mistake :: Fact -> Eval a
mistake fact = throwError [Error fact []]

mistakes :: [Error] -> Eval a
mistakes = throwError

-- | What this depends on is missing because of a mistake that is reported already.
absent :: Eval a
absent = throwError []

-- | All of them, with the mistakes of all of them.
gather :: Traversable t => t (Eval a) -> Eval (t a)
gather evals = do
  results <- traverse (lift . runExceptT) evals
  case foldMap (fromLeft []) results of
    [] -> either (const absent) pure (sequence results)
    errors -> throwError errors

-- | Take steps. When there are none left, that is reported once; below zero it is reported already.
spend :: Region -> Int -> Eval ()
spend region steps = do
  left <- lift get
  when (left < 0) absent
  if steps > left
    then lift (put (-1)) *> mistake (TooMuchWork region mostSteps)
    else lift (put (left - steps))

-- | A program may take so many steps.
mostSteps :: Int
mostSteps = 5000000

-- | Note through which call of a function a mistake came.
inCall :: Region -> Eval a -> Eval a
inCall region = withExceptT (map (\(Error fact calls) -> Error fact (calls <> [region])))
