-- | The result of a compiler pass: warnings, errors, and its output.
--
-- The errors of independent steps accumulate; such steps are combined by the applicative functor. A
-- step that needs the output of another step is combined with it by the monad, and runs only if
-- there is an output. A result with errors may have an output too: the part of the data that is
-- right. Later passes look for mistakes in it, but no tape is made of it. A result without errors
-- is called sound.
module Base.Result
  ( Result (..),
    failed,
    failing,
    warned,
    fromEither,
    mapErrors,
    ifSound,
    thenSound,
  )
where

-- | The result of a compiler pass: its warnings, its errors, and its output if there is one.
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

-- | A result with one error and without an output.
failed :: e -> Result w e a
failed e = Result [] [e] Nothing

-- | A result with errors and nevertheless an output, which later passes may use.
failing :: [e] -> a -> Result w e a
failing es a = Result [] es (Just a)

-- | A result that consists of warnings: it has no error, and its output is @()@.
warned :: [w] -> Result w e ()
warned ws = Result ws [] (Just ())

-- | The result with the output in @Right@, or with the one error in @Left@.
fromEither :: Either e a -> Result w e a
fromEither = either failed pure

-- | Applies one function to every warning of a result and another to every error.
mapErrors :: (w -> w') -> (e -> e') -> Result w e a -> Result w' e' a
mapErrors f g (Result ws es a) = Result (map f ws) (map g es) a

-- | The output of a result, or nothing if the result has an error. Warnings are allowed.
ifSound :: Result w e a -> Maybe a
ifSound (Result _ es a) = if null es then a else Nothing

-- | Runs the pass @f@ on the output of @r@ if @r@ is sound. Otherwise the result has the warnings
-- and errors of @r@ and no output.
thenSound :: Result w e a -> (a -> Result w e b) -> Result w e b
thenSound r f = case ifSound r of
  Just _ -> r >>= f
  Nothing -> r {output = Nothing}
