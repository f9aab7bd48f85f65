-- | Type inference with deferred constraints and polymorphic functions. An unknown is a type or a
-- dimension that inference has yet to find.
--
-- Equations between types are solved at once ("Checked.Inference.State"). Operations and overloaded
-- calls become constraints, which are solved when enough types are known. At the end of each
-- statement the remaining constraints are solved by default rules. The type of a function is
-- generalised to a scheme as in Hindley–Milner inference: unknowns of its body become variables,
-- for which each call has new unknowns. A shared unknown does not become a variable: it has the
-- same value in all calls. An unknown is decided when it gets a value.
module Checked.Inference
  ( Infer,
    Solution,
    Meaning (..),
    run,

    -- * Mistakes
    mistake,
    mistakeOnce,
    taint,
    wrongIfTainted,
    separately,

    -- * Names
    find,
    define,
    scoped,
    withLocals,
    namesInScope,
    mention,

    -- * Unknowns
    freshType,
    freshDimension,
    freshDecided,
    monomorphic,
    resolved,
    decidedElsewhere,

    -- * Equations
    unify,
    exchanged,
    isCompatible,

    -- * Functions
    generalise,
    instantiate,

    -- * Deferred constraints
    require,
    settle,
  )
where

import Base.Region (Region)
import Checked.Dimension qualified as Dimension
import Checked.Inference.Arithmetic (solveArithmetic)
import Checked.Inference.Overload (chooseFirst, solveCall)
import Checked.Inference.State
import Checked.Scheme
  ( Arithmetic (..),
    DeferredConstraint (..),
    Meaning (..),
    OverloadedCall (..),
    Scheme (..),
  )
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Control.Monad (filterM, unless, void)
import Control.Monad.State.Strict (get, gets, modify', put)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet qualified as IntSet
import Data.List (partition)

-- | Runs @infer@, which checks a statement or a part of it. Then solves all pending constraints.
-- 'Nothing' if this statement or part contains a mistake, or uses a name whose definition contains
-- one.
separately :: Infer a -> Infer (Maybe a)
separately infer = do
  before <- gets isTainted
  modify' (\s -> s {isTainted = False})
  a <- infer
  settle
  isWrong <- gets isTainted
  modify' (\s -> s {isTainted = before})
  pure (if isWrong then Nothing else Just a)

-- Functions

-- | Runs the inference of a function's definition, and generalises the type. @infer@ yields the
-- types of the parameters, the type of the result, and a value that is passed on. The unknowns of
-- the function become variables of the scheme, unless they are 'shared'. The constraints that are
-- still unsolved become part of the scheme, because the arguments of a call may solve them.
generalise :: Infer ([Type], Type, a) -> Infer (Scheme, a)
generalise infer = do
  outer <- gets firstOwn
  begin <- gets nextUnknown
  modify' (\s -> s {firstOwn = begin})
  (parameterTypes, resultType, a) <- infer
  deferred <- unsolved
  parameters <- mapM resolved parameterTypes
  result <- resolved resultType
  state <- get
  let types = result : parameters <> concatMap constraintTypes deferred
      own = [n | t <- types, n <- Type.variables t <> Type.dimensions t, n >= begin]
      ownShared = IntSet.toList (snd (IntSet.split (begin - 1) (shared state)))
      kept = IntSet.fromList (concatMap (unknownsIn state) ownShared)
      quantified = IntSet.difference (IntSet.fromList own) kept
  put state {firstOwn = outer}
  pure (Scheme {quantified, parameters, result, deferred}, a)

-- | The types of the operands or arguments of a constraint, and the type of its result.
constraintTypes :: DeferredConstraint -> [Type]
constraintTypes constraint = case constraint of
  Operation a -> [snd (left a), snd (right a), outcome a]
  Overloaded c -> callType c : map snd (arguments c)

-- | The numbers of the undecided unknowns in the present value of the unknown with the number @n@.
-- This unknown may be a type or a dimension.
unknownsIn :: InferenceState -> Int -> [Int]
unknownsIn state n =
  Type.variables (resolve state (Variable n))
    <> Dimension.unknowns
      (resolveDimension (decisions state) (Dimension.atom (Dimension.Unknown n)))

-- | Solves the pending constraints as far as possible, and merges equal ones among the remaining
-- constraints. The result is the list of constraints after merging. If it would be longer than
-- 'maxDeferred', all of them are solved by default rules instead, and the result is empty.
unsolved :: Infer [DeferredConstraint]
unsolved = do
  waiting <- solvePending >>= mapM resolvedConstraint
  merged <- mergeEqual waiting
  if length merged > maxDeferred
    then [] <$ (modify' (\s -> s {pending = reverse merged}) *> settle)
    else
      if length merged < length waiting
        then -- Merging decides types, which may solve further constraints.
          modify' (\s -> s {pending = reverse merged}) *> unsolved
        else pure merged

-- | The largest number of deferred constraints that the scheme of a function may contain.
maxDeferred :: Int
maxDeferred = 50

-- | A constraint in whose types the decided unknowns are replaced by their values.
resolvedConstraint :: DeferredConstraint -> Infer DeferredConstraint
resolvedConstraint constraint = case constraint of
  Operation a -> do
    l <- traverse resolved (left a)
    r <- traverse resolved (right a)
    o <- resolved (outcome a)
    pure (Operation a {left = l, right = r, outcome = o})
  Overloaded c -> do
    types <- traverse (traverse resolved) (arguments c)
    t <- resolved (callType c)
    pure (Overloaded c {arguments = types, callType = t})

-- | Merges operations that have the same operator and operand types. Also merges calls that have
-- the same function, labels and argument types. Unifies the types of the results of merged
-- constraints.
mergeEqual :: [DeferredConstraint] -> Infer [DeferredConstraint]
mergeEqual constraints = case constraints of
  [] -> pure []
  constraint : rest -> do
    let (same, different) = partition (isEqualTo constraint) rest
        (region, t) = constraintResult constraint
    mapM_ (unify region t . snd . constraintResult) same
    (constraint :) <$> mergeEqual different
  where
    isEqualTo a b = case (a, b) of
      (Operation o, Operation p) ->
        operator o == operator p && snd (left o) == snd (left p) && snd (right o) == snd (right p)
      (Overloaded c, Overloaded d) ->
        builtin c == builtin d
          && labels c == labels d
          && map snd (arguments c) == map snd (arguments d)
      (Operation _, Overloaded _) -> False
      (Overloaded _, Operation _) -> False

-- | The region of the operation or call of a constraint, and the type of its result.
constraintResult :: DeferredConstraint -> (Region, Type)
constraintResult constraint = case constraint of
  Operation a -> (arithmeticRegion a, outcome a)
  Overloaded c -> (callRegion c, callType c)

-- | Instantiates a scheme: replaces its variables by new unknowns, for a call at the region @use@.
-- The result contains the types of the parameters, the type of the call, and an action that adds
-- the constraints of the scheme. The caller checks the arguments before it runs this action.
instantiate :: Region -> Scheme -> Infer ([Type], Type, Infer ())
instantiate use scheme = do
  renamed <- traverse (const freshNumber) (IntMap.fromSet id (quantified scheme))
  let renumber n = IntMap.findWithDefault n n renamed
      freshAtom n = Dimension.atom (Dimension.Unknown (renumber n))
      inDimension d =
        foldl (\d' n -> Dimension.substitute n (freshAtom n) d') d (Dimension.unknowns d)
      inType = Type.substitute inDimension (Variable . renumber)
  pure
    ( map inType (parameters scheme),
      inType (result scheme),
      mapM_ (require . atUse use inType) (deferred scheme)
    )

-- | A constraint of a scheme as it applies to a call at the region @use@. The function @inType@
-- replaces the variables of the scheme by the new unknowns of the call.
atUse :: Region -> (Type -> Type) -> DeferredConstraint -> DeferredConstraint
atUse use inType constraint = case constraint of
  Operation a ->
    Operation
      a
        { arithmeticRegion = use,
          left = inType <$> left a,
          right = inType <$> right a,
          outcome = inType (outcome a)
        }
  Overloaded c ->
    Overloaded
      c
        { callRegion = use,
          arguments = map (fmap inType) (arguments c),
          callType = inType (callType c)
        }

-- Deferred constraints

-- | Adds a constraint. It is solved if enough is known, and is pending otherwise.
require :: DeferredConstraint -> Infer ()
require constraint = do
  isSolved <- solve constraint
  unless isSolved (modify' (\s -> s {pending = constraint : pending s}))

-- | Solves a constraint. 'False' if too little is known of its types yet.
solve :: DeferredConstraint -> Infer Bool
solve constraint = case constraint of
  Operation a -> solveArithmetic a
  Overloaded c -> solveCall c

-- | Solves pending constraints until no further one can be solved. Removes the constraints that
-- remain unsolved from the state, and yields them, the oldest first.
solvePending :: Infer [DeferredConstraint]
solvePending = do
  waiting <- gets pending
  if null waiting
    then pure []
    else do
      modify' (\s -> s {pending = []})
      rest <- filterM (fmap not . solve) (reverse waiting)
      if length rest < length waiting
        then modify' (\s -> s {pending = reverse rest}) *> solvePending
        else pure rest

-- | Solves all pending constraints, if necessary by default rules: an unknown operand becomes a
-- quantity, and an overloaded call gets the first form that fits.
settle :: Infer ()
settle = do
  waiting <- solvePending
  case waiting of
    [] -> pure ()
    Operation first : _ -> do
      defaultToQuantity (left first)
      defaultToQuantity (right first)
      modify' (\s -> s {pending = reverse waiting}) *> settle
    Overloaded first : rest -> do
      chooseFirst first
      modify' (\s -> s {pending = reverse rest}) *> settle

-- | Decides that an unknown type is a quantity, whose dimension remains unknown. Does nothing for a
-- type that is known.
defaultToQuantity :: (Region, Type) -> Infer ()
defaultToQuantity (region, t) = do
  t' <- resolved t
  case t' of
    Variable _ -> do
      d <- freshDimension
      void (unify region t' (Quantity d))
    _ -> pure ()
