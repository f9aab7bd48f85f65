-- | What a pass gives: warnings, errors, and its output as far as it could be made.
--
-- Independent errors accumulate (the applicative); a step that depends on
-- another's output runs only when there is one (the monad). An output beside
-- errors is the part that is sound, so later passes can find their own mistakes
-- in it; nothing is ever written from it.
module Base.Result
  ( Result (..),
    failed,
    failing,
    warned,
    fromEither,
    mapErrors,
    settled,
    thenSound,
  )
where

-- | Warnings, errors, and the output if there is one.
data Result w e a = Result {warnings :: [w], errors :: [e], output :: Maybe a}
  deriving stock (Eq, Show)

instance Functor (Result w e) where
  fmap f (Result ws es a) = Result ws es (fmap f a)

instance Applicative (Result w e) where
  pure a = Result [] [] (Just a)
  Result ws es f <*> Result ws' es' a = Result (ws <> ws') (es <> es') (f <*> a)

instance Monad (Result w e) where
  Result ws es a >>= f = case a of
    Nothing -> Result ws es Nothing
    Just x -> case f x of
      Result ws' es' b -> Result (ws <> ws') (es <> es') b

-- | No output, one error.
failed :: e -> Result w e a
failed e = Result [] [e] Nothing

-- | Errors beside an output that is still usable.
failing :: [e] -> a -> Result w e a
failing es a = Result [] es (Just a)

-- | A warning.
warned :: [w] -> Result w e ()
warned ws = Result ws [] (Just ())

-- | An answer that is either one error or an output.
fromEither :: Either e a -> Result w e a
fromEither = either failed pure

-- | Change what warnings and errors are.
mapErrors :: (w -> w') -> (e -> e') -> Result w e a -> Result w' e' a
mapErrors f g (Result ws es a) = Result (map f ws) (map g es) a

-- | The output only when there is no error.
settled :: Result w e a -> Maybe a
settled (Result _ es a) = if null es then a else Nothing

-- | Go on only when there is no error so far.
thenSound :: Result w e a -> (a -> Result w e b) -> Result w e b
thenSound r f = case settled r of
  Just _ -> r >>= f
  Nothing -> r {output = Nothing}
