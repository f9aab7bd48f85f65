-- | The unknowns of a check and how they are found out: the state of type inference,
-- and the equations between types.
module Checked.Inference
  ( Infer,
    Solution,
    Meaning (..),
    run,

    -- * Mistakes
    mistake,
    mistakeOnce,
    taint,
    separately,

    -- * Names
    find,
    define,
    scoped,
    withLocals,
    namesInScope,

    -- * Unknowns
    freshType,
    freshDimension,
    monomorphic,
    resolved,
    decidedAs,
    decidedElsewhere,

    -- * Equations
    unify,

    -- * Functions
    generalise,
    instantiate,

    -- * What is decided later
    require,
    settle,

    -- * Names in the text
    mention,
  )
where

import Base.Name (Name)
import Base.Name qualified as Name
import Base.Region (Located (..), Region)
import Checked.Builtin (ArgumentLabel (..), Form, Fresh (..), label)
import Checked.Builtin qualified as Builtin
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.Scheme
  ( Arithmetic (..),
    Binding (..),
    Meaning (..),
    OverloadedCall (..),
    DeferredConstraint (..),
    Scheme (..),
  )
import Checked.Syntax (Mention (Mention), Operator (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Control.Monad (filterM, unless, void, when, zipWithM)
import Control.Monad.State.Strict (State, get, gets, modify', put, runState)
import Data.Containers.ListUtils (nubOrd)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet (IntSet)
import Data.IntSet qualified as IntSet
import Data.List (partition)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (listToMaybe, mapMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text

type Infer = State Memory

-- | What the unknown dimensions turned out to be.
type Solution = Dimension -> Dimension

data Memory = Memory
  { next :: Int,
    decisions :: IntMap Decision,
    -- | unknowns below this one belong to definitions outside the function at hand
    outside :: Int,
    -- | younger unknowns that must not be generalised
    shared :: IntSet,
    pending :: [DeferredConstraint],
    mentioned :: [(Region, Maybe Region, Text, Meaning)],
    found :: [Error],
    tainted :: Bool,
    -- | places that decided an unknown wrongly used elsewhere; each is reported once
    blamed :: Set Region,
    scope :: Map Name Binding
  }

-- | What an unknown is, and where that was decided.
data Decision = TypeAt Region Type | DimensionAt Region Dimension

-- | Run a check from the beginning: the errors in order, the solution, the output, and the names of
-- the text.
run :: Infer a -> ([Error], Solution, a, [Mention])
run infer = case runState infer start of
  (a, memory) ->
    ( reverse (found memory),
      resolveDimension (decisions memory),
      a,
      map (said memory) (mentioned memory)
    )
  where
    said memory (place', definition, word, meaning') =
      Mention place' definition word (inWords memory meaning')
    inWords memory meaning' = case meaning' of
      Valued t -> Type.describe (resolve memory t)
      Callable names scheme ->
        "a function of ("
          <> Text.intercalate
            ", "
            ( zipWith
                (\n t -> n <> ": " <> Type.describe (resolve memory t))
                names
                (parameters scheme)
            )
          <> ") giving "
          <> Type.describe (resolve memory (result scheme))
      Described text -> text
    start =
      Memory
        { next = 0,
          decisions = IntMap.empty,
          outside = 0,
          shared = IntSet.empty,
          pending = [],
          mentioned = [],
          found = [],
          tainted = False,
          blamed = Set.empty,
          scope = Map.empty
        }

-- | A name stands at a place; where it is defined, and what it means.
mention :: Region -> Maybe Region -> Text -> Meaning -> Infer ()
mention place' definition word meaning' =
  modify' (\m -> m {mentioned = (place', definition, word, meaning') : mentioned m})

-- Mistakes

-- | Record a mistake; the statement at hand is of no further use.
mistake :: Error -> Infer ()
mistake e = modify' (\m -> m {found = e : found m, tainted = True})

-- | Record a mistake for which the places were decisive, unless one of them is blamed already: then
-- the mistake is the same again.
mistakeOnce :: [Region] -> Error -> Infer ()
mistakeOnce places e = do
  before <- gets blamed
  if any (`Set.member` before) places then taint else mistake e
  modify' (\m -> m {blamed = foldr Set.insert (blamed m) places})

-- | The statement at hand depends on something that is wrong already.
taint :: Infer ()
taint = modify' (\m -> m {tainted = True})

-- | Check a statement; Nothing when it contains a mistake.
separately :: Infer a -> Infer (Maybe a)
separately infer = do
  before <- gets tainted
  modify' (\m -> m {tainted = False})
  a <- infer
  settle
  bad <- gets tainted
  modify' (\m -> m {tainted = before})
  pure (if bad then Nothing else Just a)

-- Names

find :: Name -> Infer (Maybe Binding)
find name = gets (Map.lookup name . scope)

namesInScope :: Infer [Name]
namesInScope = gets (Map.keys . scope)

define :: Name -> Binding -> Infer ()
define name entry = modify' (\m -> m {scope = Map.insert name entry (scope m)})

-- | What is defined inside is known only there.
scoped :: Infer a -> Infer a
scoped infer = do
  before <- gets scope
  a <- infer
  modify' (\m -> m {scope = before})
  pure a

-- | With names that are known only here.
withLocals :: [(Located Name, Type)] -> Infer a -> Infer a
withLocals locals infer =
  scoped
    ( mapM_
        ( \(Located at' name, t) ->
            define name (Local at' t) *> mention at' (Just at') (Name.text name) (Valued t)
        )
        locals
        *> infer
    )

-- Unknowns

freshNumber :: Infer Int
freshNumber = do
  m <- get
  put m {next = next m + 1}
  pure (next m)

freshType :: Infer Type
freshType = Variable <$> freshNumber

freshDimension :: Infer Dimension
freshDimension = Dimension.atom . Dimension.Unknown <$> freshNumber

-- | An unknown that is this type, as was decided at a place.
decidedAs :: Region -> Type -> Infer Type
decidedAs region t = do
  n <- freshNumber
  decideAs n (TypeAt region t)
  pure (Variable n)

decideAs :: Int -> Decision -> Infer ()
decideAs n decision = modify' (\m -> m {decisions = IntMap.insert n decision (decisions m)})

-- | The unknowns of a dimension have one value for all uses of the function at hand.
monomorphic :: Dimension -> Infer ()
monomorphic d =
  modify' (\m -> m {shared = IntSet.union (IntSet.fromList (Dimension.unknowns d)) (shared m)})

-- | As far as it is known.
resolved :: Type -> Infer Type
resolved t = gets (\m -> resolve m t)

knownDimension :: Dimension -> Infer Dimension
knownDimension d = gets (\m -> resolveDimension (decisions m) d)

resolve :: Memory -> Type -> Type
resolve m t = Type.substitute (resolveDimension (decisions m)) unknown t
  where
    unknown n = case IntMap.lookup n (decisions m) of
      Just (TypeAt _ t') -> resolve m t'
      Just (DimensionAt _ _) -> Variable n
      Nothing -> Variable n

resolveDimension :: IntMap Decision -> Dimension -> Dimension
resolveDimension known' d =
  case [(n, b) | n <- Dimension.unknowns d, Just (DimensionAt _ b) <- [IntMap.lookup n known']] of
    [] -> d
    replaced ->
      resolveDimension known' (foldl (\d' (n, b) -> Dimension.substitute n b d') d replaced)

-- | Where an unknown of the type, as it is written down, was decided.
decidedAt :: Type -> Infer (Maybe Region)
decidedAt t = gets (\m -> listToMaybe (places m t))
  where
    places m t' = case t' of
      Variable n -> case IntMap.lookup n (decisions m) of
        Just (TypeAt region t'') -> region : places m t''
        Just (DimensionAt region _) -> [region]
        Nothing -> []
      Quantity d -> ofDimension m d
      Spatial d -> ofDimension m d
      _ -> []
    ofDimension m d =
      concat
        [ case IntMap.lookup n (decisions m) of
            Just (DimensionAt region d') -> region : ofDimension m d'
            Just (TypeAt region _) -> [region]
            Nothing -> []
          | n <- Dimension.unknowns d
        ]

-- | Of some terms at their places, as they are written and as they are known: where else it was
-- decided what they are.
decidedElsewhere :: [(Region, Type, Type)] -> Infer [(Region, Type)]
decidedElsewhere terms = concat <$> traverse one terms
  where
    one (at, written, found') = do
      place' <- decidedAt written
      pure [(p, found') | Just p <- [place'], p /= at]

-- Equations

-- | Make two types equal at a place; False when they can not be.
unify :: Region -> Type -> Type -> Infer Bool
unify region a b = do
  a' <- resolved a
  b' <- resolved b
  case (a', b') of
    (Wrong, _) -> pure True
    (_, Wrong) -> pure True
    (Variable n, Variable k) | n == k -> pure True
    (Variable n, _) -> bind n b'
    (_, Variable k) -> bind k a'
    (Quantity d, Quantity e) -> unifyDimensions region d e
    (Spatial d, Spatial e) -> unifyDimensions region d e
    (ListOf c, ListOf d) -> unify region c d
    (Table c, Table d) -> unify region c d
    (Curve c, Curve d) -> unify region c d
    (Fields cs, Fields ds)
      | map fst cs == map fst ds -> and <$> zipWithM (\(_, c) (_, d) -> unify region c d) cs ds
    _ -> pure (a' == b')
  where
    bind n t
      | n `elem` Type.variables t = pure False
      | otherwise = do
        decideAs n (TypeAt region t)
        share n (Type.variables t <> Type.dimensions t)
        pure True

unifyDimensions :: Region -> Dimension -> Dimension -> Infer Bool
unifyDimensions region a b = go (Dimension.times a (Dimension.power (-1) b))
  where
    go d = do
      d' <- knownDimension d
      fresh <- freshNumber
      case Dimension.solve fresh d' of
        Dimension.Solved -> pure True
        Dimension.Impossible -> pure False
        Dimension.Replace n e -> do
          decideAs n (DimensionAt region e)
          share n (Dimension.unknowns e)
          go d'

-- | What an unknown from outside a function becomes is not the function's own.
share :: Int -> [Int] -> Infer ()
share n others = do
  m <- get
  when (n < outside m || IntSet.member n (shared m)) $
    put m {shared = IntSet.union (IntSet.fromList others) (shared m)}

-- Functions

-- | The scheme of a function whose parameters and result the action finds.
generalise :: Infer ([Type], Type, a) -> Infer (Scheme, a)
generalise infer = do
  before <- gets outside
  begin <- gets next
  modify' (\m -> m {outside = begin})
  (ps, r, a) <- infer
  deferred <- undecided
  ps' <- mapM resolved ps
  r' <- resolved r
  m <- get
  let inside = r' : ps' <> concatMap typesOf deferred
      mine =
        IntSet.fromList [n | t <- inside, n <- Type.variables t <> Type.dimensions t, n >= begin]
      kept =
        IntSet.fromList
          (concatMap (sharedNow m) (IntSet.toList (snd (IntSet.split (begin - 1) (shared m)))))
  put m {outside = before}
  pure (Scheme {quantified = IntSet.difference mine kept, parameters = ps', result = r', deferred}, a)
  where
    typesOf op = case op of
      Operation a -> [snd (left a), snd (right a), outcome a]
      Overloaded c -> chosen c : map snd (given c)
    sharedNow m n =
      Type.variables (resolve m (Variable n))
        <> Dimension.unknowns
          (resolveDimension (decisions m) (Dimension.atom (Dimension.Unknown n)))

-- | What stays open, each once. When there is too much, what is unknown is a quantity after all.
undecided :: Infer [DeferredConstraint]
undecided = do
  waiting <- decide >>= mapM asKnown
  once <- merged waiting
  if length once > mostOpen
    then [] <$ (modify' (\m -> m {pending = reverse once}) *> settle)
    else
      if length once < length waiting
        then modify' (\m -> m {pending = reverse once}) *> undecided
        else pure once
  where
    asKnown op = case op of
      Operation a -> do
        l <- traverse resolved (left a)
        r <- traverse resolved (right a)
        o <- resolved (outcome a)
        pure (Operation a {left = l, right = r, outcome = o})
      Overloaded c -> do
        arguments <- traverse (traverse resolved) (given c)
        o <- resolved (chosen c)
        pure (Overloaded c {given = arguments, chosen = o})
    -- Equal operations on equal operands have equal outcomes.
    merged ops = case ops of
      [] -> pure []
      op : rest -> do
        let (same, different) = partition (alike op) rest
        mapM_ (unify (placeOf op) (outcomeOf op) . outcomeOf) same
        (op :) <$> merged different
    alike a b = case (a, b) of
      (Operation o, Operation p) ->
        operator o == operator p && snd (left o) == snd (left p) && snd (right o) == snd (right p)
      (Overloaded c, Overloaded d) ->
        builtin c == builtin d && labels c == labels d && map snd (given c) == map snd (given d)
      (Operation _, Overloaded _) -> False
      (Overloaded _, Operation _) -> False
    placeOf op = case op of
      Operation a -> place a
      Overloaded c -> at c
    outcomeOf op = case op of
      Operation a -> outcome a
      Overloaded c -> chosen c

-- | A function leaves at most so many operations open.
mostOpen :: Int
mostOpen = 50

-- | The type of a function at one of its uses, and what decides the open operations of its body
-- once the arguments are known.
instantiate :: Region -> Scheme -> Infer ([Type], Type, Infer ())
instantiate use scheme = do
  renamed <- traverse (const freshNumber) (IntMap.fromSet id (quantified scheme))
  let type' = Type.substitute dimension (\n -> Variable (IntMap.findWithDefault n n renamed))
      dimension d = foldl (\d' n -> Dimension.substitute n (fresh n) d') d (Dimension.unknowns d)
      fresh n = Dimension.atom (Dimension.Unknown (IntMap.findWithDefault n n renamed))
      operation op = case op of
        Operation a ->
          Operation
            a
              { place = use,
                left = type' <$> left a,
                right = type' <$> right a,
                outcome = type' (outcome a)
              }
        Overloaded c ->
          Overloaded c {at = use, given = map (fmap type') (given c), chosen = type' (chosen c)}
  pure
    ( map type' (parameters scheme),
      type' (result scheme),
      mapM_ (require . operation) (deferred scheme)
    )

-- What is decided later

-- | Something has to make sense, now or when more is known.
require :: DeferredConstraint -> Infer ()
require p = do
  done <- attempt p
  unless done (modify' (\m -> m {pending = p : pending m}))

-- | Decide what waits as far as enough is known by now; the rest is returned, and waits no longer.
decide :: Infer [DeferredConstraint]
decide = do
  waiting <- gets pending
  if null waiting
    then pure []
    else do
      modify' (\m -> m {pending = []})
      left' <- filterM (fmap not . attempt) (reverse waiting)
      if length left' < length waiting
        then modify' (\m -> m {pending = reverse left'}) *> decide
        else pure left'

-- | Decide all that waits: what is still unknown is a quantity, and of several forms the first is
-- meant.
settle :: Infer ()
settle = do
  deferred <- decide
  case deferred of
    [] -> pure ()
    Operation first : _ -> do
      quantity (left first)
      quantity (right first)
      modify' (\m -> m {pending = reverse deferred}) *> settle
    Overloaded first : rest -> do
      remaining <- fitting first
      mapM_ (take' first) (take 1 remaining)
      modify' (\m -> m {pending = reverse rest}) *> settle
  where
    quantity (region, t) = do
      t' <- resolved t
      case t' of
        Variable _ -> do
          d <- freshDimension
          void (unify region t' (Quantity d))
        _ -> pure ()

-- | Decide something if enough is known; False when it has to wait.
attempt :: DeferredConstraint -> Infer Bool
attempt p = case p of
  Operation a -> operate a
  Overloaded c -> choose c

-- Functions of several forms

-- | Take the one form that fits a call.
choose :: OverloadedCall -> Infer Bool
choose c = do
  remaining <- fitting c
  arguments <- traverse (resolved . snd) (given c)
  case remaining of
    [] -> do
      unless (Wrong `elem` arguments) (misfit c arguments)
      taint
      True <$ settledAs (at c) (chosen c) Wrong
    [only] -> True <$ take' c only
    _ -> pure False

-- | Report a call that fits no form: the one argument that is wrong when there is a form with a
-- quantity for it where another quantity is given, else the whole call.
misfit :: OverloadedCall -> [Type] -> Infer ()
misfit c arguments = case mapMaybe near (alternatives c) of
  (region, wanted, written', found') : _ -> do
    places <- decidedElsewhere [(region, written', found')]
    mistakeOnce (map fst places) (Mismatch region wanted found' places)
  [] ->
    mistake
      ( NoForm
          (at c)
          (Builtin.name (builtin c))
          (zip (map fst (given c)) arguments)
          (nubOrd (map (Builtin.formText (builtin c)) (alternatives c <> related)))
      )
  where
    related =
      [ f
        | f <- Builtin.forms Fresh {dimension = Dimension.none, anything = Wrong} (builtin c),
          length (Builtin.parameters f) == length (labels c)
      ]
    near form =
      let wanted = wantedBy form
       in case [ (region, w, t, found')
                 | ((region, t), found', w) <- zip3 (given c) arguments wanted,
                   not (mayBe found' w)
               ] of
            [one@(_, w, _, found')] | alike found' w -> Just one
            _ -> Nothing
    alike a b = case (a, b) of
      (Quantity _, Quantity _) -> True
      (Spatial _, Spatial _) -> True
      _ -> False

-- | The types that a form wants, without its ranks.
wantedBy :: Form -> [Type]
wantedBy form = map Builtin.type' (filter ((/= Rank) . label) (Builtin.parameters form))

-- | Let a call mean a form.
take' :: OverloadedCall -> Form -> Infer ()
take' c form = do
  mapM_ (\((region, t), p) -> settledAs region p t) (zip (given c) (wantedBy form))
  settledAs (at c) (chosen c) (Builtin.result form)

-- | What was decided late has to be what its use took it for.
settledAs :: Region -> Type -> Type -> Infer ()
settledAs region wanted found' = do
  w <- resolved wanted
  f <- resolved found'
  places <- decidedElsewhere [(region, wanted, w), (region, found', f)]
  same <- unify region wanted found'
  unless same (mistakeOnce (region : map fst places) (Mismatch region w f places))

-- | The forms with the number and the words of a call's arguments. The unknowns of a form are its
-- own.
alternatives :: OverloadedCall -> [Form]
alternatives c =
  Builtin.labelled Fresh {dimension = Dimension.none, anything = Wrong} (builtin c) (labels c)

-- | The forms that the arguments fit as far as they are known.
fitting :: OverloadedCall -> Infer [Form]
fitting c = do
  arguments <- traverse (resolved . snd) (given c)
  fresh <- Fresh <$> freshDimension <*> freshType
  outcome' <- resolved (chosen c)
  let same = Builtin.labelled fresh (builtin c) (labels c)
      fits = [f | f <- same, and (zipWith mayBe arguments (wantedBy f))]
  -- The use of the result helps to choose, but is not what is wrong when nothing fits.
  pure (case filter (mayBe outcome' . Builtin.result) fits of [] -> fits; some -> some)

-- | Whether a type, as far as it is known, may turn out to be another.
mayBe :: Type -> Type -> Bool
mayBe found' wanted = case (found', wanted) of
  _ | found' `elem` [Wrong, wanted] || wanted == Wrong -> True
  (Variable _, _) -> True
  (_, Variable _) -> True
  (Quantity d, Quantity e) -> dimensionMayBe d e
  (Spatial d, Spatial e) -> dimensionMayBe d e
  (ListOf a, ListOf b) -> mayBe a b
  (Table a, Table b) -> mayBe a b
  (Curve a, Curve b) -> mayBe a b
  _ -> False
  where
    dimensionMayBe d e = d == e || not (Dimension.isKnown d) || not (Dimension.isKnown e)

-- Arithmetic

-- | Decide an operation if enough is known; False when it has to wait.
operate :: Arithmetic -> Infer Bool
operate a@(Arithmetic region op (leftRegion, left') (rightRegion, right') outcome') = do
  l <- resolved left'
  r <- resolved right'
  case (op, l, r) of
    (_, Wrong, _) -> result' Wrong
    (_, _, Wrong) -> result' Wrong
    _ | compares -> comparison l r
    (Add, Quantity d, Quantity e) -> sum' d e l r
    (Subtract, Quantity d, Quantity e) -> sum' d e l r
    (Add, Spatial d, Spatial e) -> result' (Spatial (Dimension.times d e))
    (Subtract, Spatial d, Spatial e) -> result' (Spatial (quotient d e))
    (Add, _, _) | Just again <- alike l r -> again
    (Subtract, _, _) | Just again <- alike l r -> again
    (Multiply, Quantity d, Quantity e) -> result' (Quantity (Dimension.times d e))
    (Multiply, Quantity _, Spatial _) -> scaled leftRegion l rightRegion r
    (Multiply, Spatial _, Quantity _) -> scaled rightRegion r leftRegion l
    (Multiply, Variable _, Spatial _) -> scaled leftRegion l rightRegion r
    (Multiply, Spatial _, Variable _) -> scaled rightRegion r leftRegion l
    (Divide, Quantity d, Quantity e) -> result' (Quantity (quotient d e))
    (Divide, Spatial _, Quantity _) -> scaled rightRegion r leftRegion l
    (Divide, Spatial _, Variable _) -> scaled rightRegion r leftRegion l
    (_, Variable _, Quantity _) -> pure False
    (_, Quantity _, Variable _) -> pure False
    (_, Variable _, Variable _) -> pure False
    (Add, _, _) -> disagree l r
    (Subtract, _, _) -> disagree l r
    (Multiply, _, _)
      -- A minus is a product with −1, whose place is the whole term.
      | leftRegion == region -> wrong (NoOperation region "a minus" [(rightRegion, r)])
      | otherwise -> wrong (NoOperation region "a product" [(leftRegion, l), (rightRegion, r)])
    (Divide, _, _) -> wrong (NoOperation region "a quotient" [(leftRegion, l), (rightRegion, r)])
    -- Comparisons are dealt with above; and, or are typed where they stand.
    _ -> result' Boolean
  where
    compares = op `elem` [Less, AtMost, Greater, AtLeast, Equal, Unequal]
    -- Only quantities of one kind can be compared.
    comparison l r = case (l, r) of
      (Variable _, Variable _) -> pure False
      _ -> do
        d <- freshDimension
        fine <- (&&) <$> unify leftRegion (Quantity d) l <*> unify rightRegion (Quantity d) r
        if fine then result' Boolean else disagree l r
    quotient d e = Dimension.times d (Dimension.power (-1) e)
    result' t = True <$ settledAs region outcome' t
    wrong e = mistakeOnce [region] e *> result' Wrong
    disagree l r = do
      places <- decidedElsewhere [(leftRegion, left', l), (rightRegion, right', r)]
      mistakeOnce
        (region : map fst places)
        (Disagree region op (leftRegion, l) (rightRegion, r) places)
      result' Wrong
    sum' d e l r = do
      same <- unifyDimensions region d e
      if same then result' (Quantity d) else disagree l r
    -- In a sum an unknown operand is of the other one's kind.
    alike l r = case (l, r) of
      (Variable _, Quantity d) -> Just (unify leftRegion l (Quantity d) *> operate a)
      (Quantity d, Variable _) -> Just (unify rightRegion r (Quantity d) *> operate a)
      (Variable _, Spatial _) -> Just (pair leftRegion l)
      (Spatial _, Variable _) -> Just (pair rightRegion r)
      _ -> Nothing
    pair at' t = do
      d <- freshDimension
      _ <- unify at' t (Spatial d)
      operate a
    -- A vector is stretched by a plain number.
    scaled numberRegion factor vectorRegion vector = do
      plain <- unify numberRegion factor Type.number
      free <- unify vectorRegion vector Type.aVector
      if plain && free
        then result' Type.aVector
        else
          wrong
            ( NoOperation
                region
                (if op == Divide then "a quotient" else "a product")
                [(leftRegion, left'), (rightRegion, right')]
            )
