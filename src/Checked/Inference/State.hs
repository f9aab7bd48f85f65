-- | The state of type inference: unknowns and decisions about them, names in scope, and errors. An
-- unknown is a type or a dimension that inference has yet to find; it is identified by a number. An
-- unknown is decided when it gets a value. A type is resolved when its decided unknowns are
-- replaced by their values.
--
-- Types are unified as in Hindley–Milner inference. Dimensions are unified as elements of a
-- commutative group ("Checked.Dimension"). This module solves equations only. "Checked.Inference"
-- solves deferred constraints.
--
-- A statement is tainted if it contains a mistake or uses a name whose definition contains one. It
-- is then left out of the checked program.
module Checked.Inference.State
  ( Infer,
    Solution,
    InferenceState (..),
    run,

    -- * Mistakes
    mistake,
    mistakeOnce,
    taint,
    wrongIfTainted,

    -- * Names
    find,
    define,
    scoped,
    withLocals,
    namesInScope,
    mention,

    -- * Unknowns
    freshNumber,
    freshType,
    freshDimension,
    freshDecided,
    monomorphic,
    resolved,
    resolve,
    resolveDimension,
    decidedElsewhere,

    -- * Equations
    unify,
    unifyDimensions,
    equate,
    isCompatible,
    exchanged,
  )
where

import Base.Name (Name (Name))
import Base.Name qualified as Name
import Base.Region (Located (..), Region)
import Base.Region qualified as Region
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.ErrorFix (unwritten)
import Checked.Scheme (Binding (..), DeferredConstraint, Meaning (..), Scheme (..))
import Checked.Syntax (Mention (..), MentionType (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Control.Monad (unless, when, zipWithM)
import Control.Monad.State.Strict (State, get, gets, modify', put, runState)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet (IntSet)
import Data.IntSet qualified as IntSet
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (listToMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text

-- | A computation of type inference.
type Infer = State InferenceState

-- | The final values of the unknown dimensions: a function that replaces the unknowns in a
-- dimension.
type Solution = Dimension -> Dimension

-- | The state between two steps of inference.
data InferenceState = InferenceState
  { -- | the number of the next new unknown
    nextUnknown :: Int,
    -- | the values of the decided unknowns, by their numbers
    decisions :: IntMap Decision,
    -- | the number of the first unknown of the function whose definition is being checked; unknowns
    -- with smaller numbers belong to outer definitions. It is 0 outside of functions
    firstOwn :: Int,
    -- | the numbers of the shared unknowns, which have the same value in all calls of a function;
    -- 'Checked.Inference.generalise' must not make them variables of the function's type
    shared :: IntSet,
    -- | constraints that are not solved yet, the newest first
    pending :: [DeferredConstraint],
    -- | the mentions of names, the newest first: the region of the mention, the region of the
    -- definition unless the name is built in, the name, and its meaning
    mentioned :: [(Region, Maybe Region, Text, Meaning)],
    -- | the mistakes, the newest first
    errors :: [Error],
    -- | true if the present statement contains a mistake or depends on one
    isTainted :: Bool,
    -- | the regions that 'mistakeOnce' has recorded as the causes of mistakes
    blamed :: Set Region,
    -- | the names in scope, with their meanings for inference
    scope :: Map Name Binding
  }

-- | The value of an unknown, and the region of the term that decided it.
data Decision = TypeAt Region Type | DimensionAt Region Dimension

-- | Runs an inference from the empty state. The result contains the errors in the order in which
-- they were found, the solution, the result of the inference, and the mentions of names.
run :: Infer a -> ([Error], Solution, a, [Mention])
run infer = case runState infer start of
  (a, final) ->
    ( reverse (errors final),
      resolveDimension (decisions final),
      a,
      map (described final) (mentioned final)
    )
  where
    described final (region, definition, word, meaning) =
      Mention
        { place = region,
          definition,
          word,
          meaning = describe final meaning,
          typing = typeOf final meaning
        }
    start =
      InferenceState
        { nextUnknown = 0,
          decisions = IntMap.empty,
          firstOwn = 0,
          shared = IntSet.empty,
          pending = [],
          mentioned = [],
          errors = [],
          isTainted = False,
          blamed = Set.empty,
          scope = Map.empty
        }

-- | The description of a meaning in words, as an editor shows it.
describe :: InferenceState -> Meaning -> Text
describe state meaning = case meaning of
  Valued t -> typeWords t
  Callable names scheme ->
    "a function of ("
      <> Text.intercalate ", " (zipWith parameter names (parameters scheme))
      <> ") giving "
      <> typeWords (result scheme)
  Described text -> text
  where
    typeWords t = Type.describe (resolve state t)
    parameter name t = name <> ": " <> typeWords t

-- | The resolved type of a meaning, in which every undecided unknown has the number 0.
typeOf :: InferenceState -> Meaning -> MentionType
typeOf state meaning = case meaning of
  Valued t -> OfValue (known t)
  Callable names Scheme {parameters, result} ->
    OfFunction (zip names (map known parameters)) (known result)
  Described _ -> Untyped
  where
    known = Type.substitute ofDimension (const (Variable 0)) . resolve state
    ofDimension d = if Dimension.isKnown d then d else Dimension.atom (Dimension.Unknown 0)

-- Mistakes

-- | Records a mistake and taints the present statement.
mistake :: Error -> Infer ()
mistake e = modify' (\s -> s {errors = e : errors s, isTainted = True})

-- | Records a mistake whose causes are at the given regions. If an earlier mistake has one of these
-- regions as a cause, the new mistake only follows from it. The statement is then tainted without a
-- further report.
mistakeOnce :: [Region] -> Error -> Infer ()
mistakeOnce regions e = do
  before <- gets blamed
  if any (`Set.member` before) regions then taint else mistake e
  modify' (\s -> s {blamed = foldr Set.insert (blamed s) regions})

-- | Marks the present statement as dependent on a mistake that is already reported.
taint :: Infer ()
taint = modify' (\s -> s {isTainted = True})

-- | Runs the inference of a term. The type is 'Wrong' if it contains a mistake or depends on one,
-- so that no report follows from it.
wrongIfTainted :: Infer (Type, a) -> Infer (Type, a)
wrongIfTainted infer = do
  before <- gets isTainted
  modify' (\s -> s {isTainted = False})
  (t, a) <- infer
  isWrong <- gets isTainted
  modify' (\s -> s {isTainted = before || isWrong})
  pure (if isWrong then Wrong else t, a)

-- Names

-- | Looks a name up in the present scope.
find :: Name -> Infer (Maybe Binding)
find name = gets (Map.lookup name . scope)

-- | All names of the present scope.
namesInScope :: Infer [Name]
namesInScope = gets (Map.keys . scope)

-- | Binds a name in the present scope; an earlier binding is hidden.
define :: Name -> Binding -> Infer ()
define name binding = modify' (\s -> s {scope = Map.insert name binding (scope s)})

-- | Runs an inference and then restores the scope. The names that the inference defines are
-- therefore known only in it.
scoped :: Infer a -> Infer a
scoped infer = do
  before <- gets scope
  a <- infer
  modify' (\s -> s {scope = before})
  pure a

-- | Runs an inference in which the given local names are in scope. They hide other names of the
-- same spelling.
withLocals :: [(Located Name, Type)] -> Infer a -> Infer a
withLocals locals infer = scoped (mapM_ defineLocal locals *> infer)
  where
    defineLocal (Located at name, t) =
      define name (Local at t) *> mention at (Just at) (Name.text name) (Valued t)

-- | Records a mention of the name @word@ at @region@, for editors. @definition@ is the region of
-- its definition, or 'Nothing' for a built-in name. Names that the program does not write there are
-- not recorded: hidden ones, and functions in the place of a drawing or of a text in a font.
mention :: Region -> Maybe Region -> Text -> Meaning -> Infer ()
mention region definition word meaning =
  when isWritten . modify' $
    (\s -> s {mentioned = (region, definition, word, meaning) : mentioned s})
  where
    isWritten =
      not (Name.isHidden (Name word)) && Region.end region - Region.start region == Text.length word

-- Unknowns

-- | A number that no unknown has yet.
freshNumber :: Infer Int
freshNumber = do
  s <- get
  put s {nextUnknown = nextUnknown s + 1}
  pure (nextUnknown s)

-- | A new unknown type.
freshType :: Infer Type
freshType = Variable <$> freshNumber

-- | A new unknown dimension.
freshDimension :: Infer Dimension
freshDimension = Dimension.atom . Dimension.Unknown <$> freshNumber

-- | A new unknown that is decided at once: its value is the type @t@. Reports of later mistakes can
-- point at @region@ as the region that decided this type.
freshDecided :: Region -> Type -> Infer Type
freshDecided region t = do
  n <- freshNumber
  decideAs n (TypeAt region t)
  pure (Variable n)

decideAs :: Int -> Decision -> Infer ()
decideAs n decision = modify' (\s -> s {decisions = IntMap.insert n decision (decisions s)})

-- | Makes the unknowns of a dimension 'shared': generalisation does not make them variables of a
-- function's type, so that they have the same value in all calls.
monomorphic :: Dimension -> Infer ()
monomorphic d =
  modify' (\s -> s {shared = IntSet.union (IntSet.fromList (Dimension.unknowns d)) (shared s)})

-- | The type @t@ in which all decided unknowns are replaced by their values.
resolved :: Type -> Infer Type
resolved t = gets (`resolve` t)

-- | The type @t@ in which all unknowns that are decided in @state@ are replaced by their values.
resolve :: InferenceState -> Type -> Type
resolve state t = Type.substitute (resolveDimension (decisions state)) unknown t
  where
    unknown n = case IntMap.lookup n (decisions state) of
      Just (TypeAt _ t') -> resolve state t'
      Just (DimensionAt _ _) -> Variable n
      Nothing -> Variable n

-- | The dimension @d@ in which all decided unknowns are replaced by their values.
resolveDimension :: IntMap Decision -> Dimension -> Dimension
resolveDimension decided d =
  case [(n, b) | n <- Dimension.unknowns d, Just (DimensionAt _ b) <- [IntMap.lookup n decided]] of
    [] -> d
    replacements ->
      resolveDimension decided (foldl (\d' (n, b) -> Dimension.substitute n b d') d replacements)

-- | The region that decided the first decided unknown in the type @t@. 'Nothing' if @t@ contains no
-- decided unknown, or is not a quantity, a point, a vector or an unknown. @t@ must not be resolved,
-- because a resolved type no longer contains decided unknowns.
decidedAt :: Type -> Infer (Maybe Region)
decidedAt t = gets (\s -> listToMaybe (ofType (decisions s) t))
  where
    ofType decided t' = case t' of
      Variable n -> case IntMap.lookup n decided of
        Just (TypeAt region t'') -> region : ofType decided t''
        Just (DimensionAt region _) -> [region]
        Nothing -> []
      Quantity d -> ofDimension decided d
      Spatial d -> ofDimension decided d
      _ -> []
    ofDimension decided d =
      concat
        [ case IntMap.lookup n decided of
            Just (DimensionAt region d') -> region : ofDimension decided d'
            Just (TypeAt region _) -> [region]
            Nothing -> []
          | n <- Dimension.unknowns d
        ]

-- | The regions at which the types of some terms were decided, each with the resolved type. A
-- report points at them in addition to the terms. A region that is the term's own is therefore left
-- out. A term is given by its region, its type before it is resolved, and its resolved type.
decidedElsewhere :: [(Region, Type, Type)] -> Infer [(Region, Type)]
decidedElsewhere terms = concat <$> traverse ofTerm terms
  where
    ofTerm (at, written, found) = do
      region <- decidedAt written
      pure [(r, found) | Just r <- [region], r /= at]

-- Equations

-- | Makes two types equal by deciding unknowns in them. @region@ is recorded as the region of these
-- decisions. 'False' if the types cannot become equal.
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
      | map (value . fst) cs == map (value . fst) ds ->
        and <$> zipWithM (\(_, c) (_, d) -> unify region c d) cs ds
    _ -> pure (a' == b')
  where
    -- If an unknown occurred in its own value, its type would be infinite.
    bind n t
      | n `elem` Type.variables t = pure False
      | otherwise = do
        decideAs n (TypeAt region t)
        share n (Type.variables t <> Type.dimensions t)
        pure True

-- | Makes two dimensions equal by deciding unknowns in them. @region@ is recorded as the region of
-- these decisions. 'False' if the dimensions cannot become equal.
unifyDimensions :: Region -> Dimension -> Dimension -> Infer Bool
unifyDimensions region a b = go (Dimension.times a (Dimension.power (-1) b))
  where
    go quotient = do
      quotient' <- gets (\s -> resolveDimension (decisions s) quotient)
      fresh <- freshNumber
      case Dimension.solve fresh quotient' of
        Dimension.Solved -> pure True
        Dimension.Impossible -> pure False
        Dimension.Replace n e -> do
          decideAs n (DimensionAt region e)
          share n (Dimension.unknowns e)
          go quotient'

-- | Makes the unknowns @others@, which occur in the value of the unknown @n@, 'shared' if @n@ is
-- shared or belongs to an outer definition.
share :: Int -> [Int] -> Infer ()
share n others = do
  s <- get
  when (n < firstOwn s || IntSet.member n (shared s)) $
    put s {shared = IntSet.union (IntSet.fromList others) (shared s)}

-- | Unifies the type @wanted@ that the context of a term requires with the type @found@ of the
-- term. Records a mistake if they cannot become equal.
equate :: Region -> Type -> Type -> Infer ()
equate region wanted found = do
  wanted' <- resolved wanted
  found' <- resolved found
  elsewhere <- decidedElsewhere [(region, wanted, wanted'), (region, found, found')]
  same <- unify region wanted found
  unless
    same
    ( mistakeOnce
        (region : map fst elsewhere)
        (Mismatch region wanted' found' elsewhere unwritten)
    )

-- | Can two types become equal when more unknowns are decided? A dimension that contains unknowns
-- counts as fitting every other dimension. Decides no unknowns itself.
isCompatible :: Type -> Type -> Bool
isCompatible found wanted = case (found, wanted) of
  _ | found `elem` [Wrong, wanted] || wanted == Wrong -> True
  (Variable _, _) -> True
  (_, Variable _) -> True
  (Quantity d, Quantity e) -> isCompatibleDimension d e
  (Spatial d, Spatial e) -> isCompatibleDimension d e
  (ListOf a, ListOf b) -> isCompatible a b
  (Table a, Table b) -> isCompatible a b
  (Curve a, Curve b) -> isCompatible a b
  _ -> False
  where
    isCompatibleDimension d e = d == e || not (Dimension.isKnown d) || not (Dimension.isKnown e)

-- | The indices of two terms in the wrong order, judged by the types that are found and wanted:
-- exchanged, all terms would fit. 'Nothing' if all fit as they are, if a type is 'Wrong', or if no
-- exchange helps.
exchanged :: [Type] -> [Type] -> Maybe (Int, Int)
exchanged found wanted
  | Wrong `elem` found || fits found = Nothing
  | otherwise =
    listToMaybe
      [ (i, j)
        | j <- [1 .. length found - 1],
          i <- [0 .. j - 1],
          fits (swapped i j)
      ]
  where
    fits ts = and (zipWith isCompatible ts wanted)
    swapped i j =
      [ found !! (if k == i then j else if k == j then i else k)
        | k <- [0 .. length found - 1]
      ]
