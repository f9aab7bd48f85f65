-- | Names and types: the surface program into the checked one.
--
-- Definitions are looked at in the order of the text and see only what stands above them, so
-- no program can run for ever. A statement with a mistake is left out of the output and
-- the name it defines is poisoned: what uses it is left out as well, without a report.
module Checked.FromSurface
  ( check,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Checked.Builtin (Signature (..))
import Checked.Builtin qualified as Builtin
import Checked.Dimension (Atom (..), Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..), Setting (..))
import Checked.Infer (Arithmetic (..), Entry (..), Infer, Solution)
import Checked.Infer qualified as Infer
import Checked.Syntax (Program (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (unless, void, when, zipWithM)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes)
import Data.Text (Text)
import Surface.Syntax (Statement)
import Surface.Syntax qualified as Surface
import Surface.Token (Unit (..))

-- | A term that is known when the whole program has been looked at.
type Later a = Solution -> a

-- | Check a program.
check :: Surface.Program -> Result w Error Program
check Surface.Program {Surface.statements = written} =
  Result {warnings = [], errors = settings written <> found, output = Just program}
  where
    defined = Map.fromListWith (\_ first -> first) (concatMap definition written)
    (found, solution, checked) = Infer.run (catMaybes <$> mapM (statement defined) written)
    program =
      Program
        { name = firstOf [value n | Located _ (Surface.Part n _) <- written],
          title = firstOf [value t | Located _ (Surface.Part _ (Just t)) <- written],
          machine = firstOf [m | Located _ (Surface.Machine m) <- written],
          statements = map ($ solution) checked
        }
    firstOf xs = case xs of
      [] -> Nothing
      x : _ -> Just x

-- | The name that a statement defines.
definition :: Statement -> [(Name, Region)]
definition (Located _ s) = case s of
  Surface.LetValue n _ -> [(value n, region n)]
  Surface.LetFunction n _ _ -> [(value n, region n)]
  Surface.Contour n _ _ -> [(value n, region n)]
  Surface.Broken _ (Just n) -> [(value n, region n)]
  Surface.Broken _ Nothing -> []
  Surface.Part _ _ -> []
  Surface.Machine _ -> []
  Surface.Tool _ -> []
  Surface.Feed _ -> []
  Surface.Tolerance _ -> []
  Surface.From _ -> []
  Surface.Mill {} -> []
  Surface.Travel _ -> []

-- Settings

-- | The statements that a program needs: the part's name first, the others once and before their use.
settings :: [Statement] -> [Error]
settings written = begins <> go Map.empty written
  where
    begins = case written of
      Located _ (Surface.Part _ _) : _ -> []
      Located _ (Surface.Broken (Just "part") _) : _ -> []
      Located at _ : _ -> [NoPart at {end = start at}]
      [] -> [NoPart (Region 0 0)]
    go seen statements = case statements of
      [] -> []
      Located at s : rest ->
        let (given, needed) = use s
            missing = maybe [] (\some -> [SettingsMissing at {end = start at + length' s} some]) (NonEmpty.nonEmpty (filter (not . (`Map.member` seen)) needed))
            twice = [SettingTwice at one before | Just one <- [given], one /= FeedSetting, Just before <- [Map.lookup one seen]]
            seen' = foldr (\one -> Map.insertWith (\_ old -> old) one at) seen (needed <> maybe [] pure given)
         in missing <> twice <> go seen' rest
    -- The keyword of the statement.
    length' s = case s of
      Surface.Travel _ -> 5
      _ -> 4
    use s = case s of
      Surface.Part _ _ -> (Just PartSetting, [])
      Surface.Machine _ -> (Just MachineSetting, [])
      Surface.Tool _ -> (Just ToolSetting, [])
      Surface.Feed _ -> (Just FeedSetting, [])
      Surface.Tolerance _ -> (Just ToleranceSetting, [])
      Surface.From _ -> (Just FromSetting, [])
      Surface.Mill {} -> (Nothing, [ToolSetting, FeedSetting, ToleranceSetting, FromSetting])
      Surface.Travel stops ->
        (Nothing, FromSetting : [FeedSetting | any ((== Surface.Cutting) . Surface.pace) (NonEmpty.toList stops)])
      Surface.LetValue _ _ -> (Nothing, [])
      Surface.LetFunction {} -> (Nothing, [])
      Surface.Contour {} -> (Nothing, [])
      Surface.Broken word _ -> (word >>= (`lookup` words'), [])
    words' =
      [ ("part", PartSetting),
        ("machine", MachineSetting),
        ("tool", ToolSetting),
        ("feed", FeedSetting),
        ("tolerance", ToleranceSetting),
        ("from", FromSetting)
      ]

-- Statements

-- | The names that the program defines somewhere, and where.
type Defined = Map Name Region

statement :: Defined -> Statement -> Infer (Maybe (Later Checked.Statement))
statement defined (Located at s) = case s of
  Surface.Part _ _ -> pure Nothing
  Surface.Machine _ -> pure Nothing
  Surface.Broken _ name -> Nothing <$ mapM_ (\n -> Infer.define (value n) (Poisoned (region n))) name
  Surface.Tool e -> plain (\e' sol -> Checked.Tool (e' sol)) <$> Infer.separately (expect defined Type.len e)
  Surface.Feed e -> plain (\e' sol -> Checked.Feed (e' sol)) <$> Infer.separately (expect defined Type.feed e)
  Surface.Tolerance e -> plain (\e' sol -> Checked.Tolerance (e' sol)) <$> Infer.separately (expect defined Type.len e)
  Surface.From e -> plain (\e' sol -> Checked.From (e' sol)) <$> Infer.separately (expect defined Type.aPoint e)
  Surface.LetValue name e -> do
    checked <- Infer.separately (unused name *> infer defined e)
    defining name (\(t, _) -> Value (region name) t) checked
    pure (plain (\(_, e') sol -> Checked.LetValue (value name) (e' sol)) checked)
  Surface.LetFunction name parameters e -> do
    checked <- Infer.separately (unused name *> function defined name parameters e)
    defining name fst checked
    pure (plain (\(_, e') sol -> Checked.LetFunction (value name) (fmap value parameters) (e' sol)) checked)
  Surface.Contour name closure items -> do
    checked <- Infer.separately (unused name *> mapM (item defined) items)
    defining name (const (Value (region name) Type.Contour)) checked
    pure (plain (\items' sol -> Checked.Contour name closure (map ($ sol) items')) checked)
  Surface.Mill e side options -> do
    checked <- Infer.separately $ do
      e' <- expect defined Type.Contour e
      options' <- mapM (setting defined) options
      pure (e', concatMap fst options', concatMap snd options')
    pure (plain (\(e', before, after) sol -> Checked.Mill (e' sol) side (map ($ sol) before) (map ($ sol) after)) checked)
  Surface.Travel stops ->
    plain (\stops' sol -> Checked.Travel (fmap ($ sol) stops')) <$> Infer.separately (mapM (stop defined) stops)
  where
    plain f = fmap (\x sol -> Located at (f x sol))
    defining name entry checked = do
      already <- Infer.find (value name)
      case already of
        Just _ -> pure ()
        Nothing -> Infer.define (value name) (maybe (Poisoned (region name)) entry checked)

-- | A name that can be given.
unused :: Located Name -> Infer ()
unused (Located at name@(Name text)) = do
  already <- Infer.find name
  case already of
    Just (Value before _) -> Infer.mistake (DefinedTwice at name before)
    Just (Function before _ _) -> Infer.mistake (DefinedTwice at name before)
    Just (Poisoned before) -> Infer.mistake (DefinedTwice at name before)
    Just (Local _) -> pure ()
    Nothing -> pure ()
  when (text `elem` Builtin.names) (Infer.mistake (NameTaken at name))

function :: Defined -> Located Name -> NonEmpty (Located Name) -> Surface.Expr -> Infer (Entry, Later Checked.Expr)
function defined name parameters body = do
  mapM_ (\(Located at n@(Name text)) -> when (text `elem` Builtin.names) (Infer.mistake (NameTaken at n))) parameters
  twice (NonEmpty.toList parameters)
  (scheme, body') <- Infer.generalising $ do
    ts <- mapM (const Infer.freshType) (NonEmpty.toList parameters)
    (t, e) <- Infer.withLocals (zip (map value (NonEmpty.toList parameters)) ts) (infer defined body)
    pure (ts, t, e)
  pure (Function (region name) [text | Located _ (Name text) <- NonEmpty.toList parameters] scheme, body')
  where
    twice ns = case ns of
      [] -> pure ()
      n : rest -> do
        mapM_ (\again -> Infer.mistake (DefinedTwice (region again) (value n) (region n))) (take 1 (filter ((== value n) . value) rest))
        twice rest

-- | Approach and retract points.
setting :: Defined -> Surface.Setting -> Infer ([Later Checked.Stop], [Later Checked.Stop])
setting defined (Located _ s) = case s of
  Surface.Approach stops -> (\ps -> (NonEmpty.toList ps, [])) <$> mapM (stop defined) stops
  Surface.Retract stops -> (\ps -> ([], NonEmpty.toList ps)) <$> mapM (stop defined) stops
  Surface.BrokenSetting -> ([], []) <$ Infer.taint

nameText :: Located Name -> Text
nameText (Located _ (Name text)) = text

stop :: Defined -> Surface.Stop -> Infer (Later Checked.Stop)
stop defined (Surface.Stop p pace) = do
  p' <- expect defined Type.aPoint p
  pace' <- case pace of
    Surface.Cutting -> pure (const Checked.Cutting)
    Surface.Rapid -> pure (const Checked.Rapid)
    Surface.AtFeed f -> (Checked.AtFeed .) <$> expect defined Type.feed f
  pure (\sol -> Checked.Stop (p' sol) (pace' sol))

item :: Defined -> Surface.Item -> Infer (Later Checked.Item)
item defined (Located at i) = case i of
  Surface.BrokenItem name -> do
    mapM_ (\n -> Infer.define (value n) (Poisoned (region n))) name
    Infer.taint
    pure (const (Located at (Checked.For (Name "") (Located at (Checked.List [])) [])))
  Surface.For counter list items -> do
    when (nameText counter `elem` Builtin.names) (Infer.mistake (NameTaken (region counter) (value counter)))
    t <- Infer.freshType
    list' <- expect defined (Type.ListOf t) list
    items' <- Infer.withLocals [(value counter, t)] (mapM (item defined) items)
    pure (\sol -> Located at (Checked.For (value counter) (list' sol) (map ($ sol) items')))
  Surface.Element walk e link -> do
    e' <- walked defined walk e
    link' <- traverse (linked defined) link
    pure (\sol -> Located at (Checked.Element (value <$> walk) (e' sol) (($ sol) <$> link')))

-- | A circle with its sense, or a line or a point without one.
walked :: Defined -> Maybe (Located Surface.Walk) -> Surface.Expr -> Infer (Later Checked.Expr)
walked defined walk e = do
  (t, e') <- infer defined e
  t' <- Infer.known t
  case (t', walk) of
    (Type.Circle, Nothing) -> Infer.mistake (SenseMissing (region e))
    (Type.Circle, Just _) -> pure ()
    (Type.Line, Nothing) -> pure ()
    (Type.Spatial _, Nothing) -> equal (region e) Type.aPoint t
    (Type.Line, Just w) -> Infer.mistake (SenseUnneeded (region w) t')
    (Type.Spatial _, Just w) -> Infer.mistake (SenseUnneeded (region w) t')
    (Type.Variable _, Just _) -> equal (region e) Type.Circle t
    (Type.Wrong, _) -> pure ()
    _ -> Infer.mistake (NotWalkable (region e) t')
  pure e'

linked :: Defined -> Surface.Link -> Infer (Later Checked.Link)
linked defined (Located at l) = fmap (Located at .) $ case l of
  Surface.Meet near -> do
    near' <- traverse (expect defined Type.aPoint) near
    pure (\sol -> Checked.Meet (($ sol) <$> near'))
  Surface.Smooth -> pure (const Checked.Smooth)
  Surface.Tangent -> pure (const Checked.Tangent)
  Surface.Fillet e -> (Checked.Fillet .) <$> expect defined Type.len e
  Surface.Chamfer e -> (Checked.Chamfer .) <$> expect defined Type.len e

-- Expressions

-- | An expression where a type is needed.
expect :: Defined -> Type -> Surface.Expr -> Infer (Later Checked.Expr)
expect defined wanted e = do
  (t, e') <- infer defined e
  equal (region e) wanted t
  pure e'

-- | The found type at a place has to be the wanted one.
equal :: Region -> Type -> Type -> Infer ()
equal at wanted t = void (agrees at wanted t)

-- | Whether the found type at a place is the wanted one; a mistake if not.
agrees :: Region -> Type -> Type -> Infer Bool
agrees at wanted t = do
  found <- Infer.known t
  wanted' <- Infer.known wanted
  places <- Infer.settledPlaces [(at, t, found), (at, wanted, wanted')]
  same <- Infer.unify at wanted t
  unless same (Infer.mistakeOnce (map fst places) (Mismatch at wanted' found places))
  pure same

infer :: Defined -> Surface.Expr -> Infer (Type, Later Checked.Expr)
infer defined (Located at e) = case e of
  Surface.Literal x (Just unit) ->
    let (t, factor) = unitType unit in pure (t, const (Located at (Checked.Number (x * factor))))
  Surface.Literal x Nothing -> do
    d <- Infer.freshDimension
    -- A bare number means one thing everywhere; only nothing is nothing in every unit.
    unless (x == 0) (Infer.monomorphic d)
    pure (Type.Quantity d, \sol -> Located at (Checked.Number (x * defaultUnit (sol d))))
  Surface.Variable name -> variable defined at name
  Surface.Call name arguments -> call defined at name arguments
  Surface.Negate inner -> do
    (t, inner') <- infer defined inner
    result <- Infer.freshType
    Infer.require Arithmetic {place = at, operator = Surface.Multiply, left = (at, Type.number), right = (region inner, t), outcome = result}
    pure (result, \sol -> Located at (Checked.Negate (inner' sol)))
  Surface.Binary op l r -> do
    (lt, l') <- infer defined l
    (rt, r') <- infer defined r
    result <- Infer.freshType
    Infer.require Arithmetic {place = at, operator = op, left = (region l, lt), right = (region r, rt), outcome = result}
    pure (result, \sol -> Located at (Checked.Binary op (l' sol) (r' sol)))
  Surface.Pair x y -> do
    x' <- expect defined Type.len x
    y' <- expect defined Type.len y
    d <- Infer.freshDimension
    pure (Type.Spatial d, \sol -> Located at (Checked.Pair (x' sol) (y' sol)))
  Surface.List es -> do
    t <- Infer.freshType
    es' <- mapM (expect defined t) es
    pure (Type.ListOf t, \sol -> Located at (Checked.List (map ($ sol) es')))

variable :: Defined -> Region -> Name -> Infer (Type, Later Checked.Expr)
variable defined at name@(Name text) = do
  entry <- Infer.find name
  case entry of
    Just (Value _ t) -> pure (t, here (Checked.Variable name))
    Just (Local t) -> pure (t, here (Checked.Variable name))
    Just (Function _ parameters _) -> wrong (FunctionAsValue at name parameters)
    Just (Poisoned _) -> nothing <$ Infer.taint
    Nothing -> do
      d <- Infer.freshDimension
      case Builtin.lookup text of
        Just (builtin, make) -> case make d of
          Signature [] t -> pure (t, here (Checked.Builtin builtin []))
          Signature parameters _ -> wrong (FunctionAsValue at name (map fst parameters))
        Nothing -> unknown defined at name >>= wrong
  where
    here e _ = Located at e
    nothing = (Type.Wrong, here (Checked.Number 0))
    wrong e = nothing <$ Infer.mistake e

-- | A name that means nothing here: it stands further down, it is being defined, or it is misspelt.
unknown :: Defined -> Region -> Name -> Infer Error
unknown defined at name = do
  names <- Infer.entries
  pure $ case Map.lookup name defined of
    Just place
      | start place > start at -> UsedBeforeDefinition at name place
      | otherwise -> Recursive at name
    Nothing -> UndefinedName at name ([text | Name text <- names] <> Builtin.names)

call :: Defined -> Region -> Located Name -> NonEmpty Surface.Expr -> Infer (Type, Later Checked.Expr)
call defined at (Located place name@(Name text)) arguments = do
  entry <- Infer.find name
  case entry of
    Just (Function _ parameters scheme) -> do
      (ts, t, operations) <- Infer.instantiate at scheme
      applied parameters ts t (\es -> Checked.Apply name (NonEmpty.fromList es)) <* operations
    Just (Value before _) -> wrong (NotAFunction place name (Just before))
    Just (Local _) -> wrong (NotAFunction place name Nothing)
    Just (Poisoned _) -> nothing <$ (otherArguments *> Infer.taint)
    Nothing -> do
      d <- Infer.freshDimension
      case Builtin.lookup text of
        Just (_, make) | null (parameters (make d)) -> wrong (NotAFunction place name Nothing)
        Just (builtin, make) ->
          let Signature ps t = make d in applied (map fst ps) (map snd ps) t (Checked.Builtin builtin)
        Nothing -> unknown defined place name >>= wrong
  where
    given = NonEmpty.toList arguments
    nothing = (Type.Wrong, const (Located at (Checked.Number 0)))
    -- The arguments may contain mistakes of their own.
    otherArguments = mapM_ (infer defined) given
    wrong e = nothing <$ (otherArguments *> Infer.mistake e)
    applied names ts t make
      | length ts /= length given = wrong (ArgumentCount at name names (length given))
      | otherwise = do
        checked <- zipWithM argument ts given
        pure (if all fst checked then t else Type.Wrong, \sol -> Located at (make (map (($ sol) . snd) checked)))
    argument wanted e = do
      (t, e') <- infer defined e
      fine <- agrees (region e) wanted t
      pure (fine, e')

-- Units

-- | What a unit measures, and its size in mm, radians and minutes.
unitType :: Unit -> (Type, Double)
unitType unit = case unit of
  Millimetre -> (Type.len, 1)
  Centimetre -> (Type.len, 10)
  Metre -> (Type.len, 1000)
  Inch -> (Type.len, 25.4)
  Degree -> (Type.angle, pi / 180)
  Radian -> (Type.angle, 1)
  MmPerMin -> (Type.feed, 1)
  MPerMin -> (Type.feed, 1000)
  InPerMin -> (Type.feed, 25.4)

-- | The size of a bare number of a dimension: lengths in mm, times in minutes, angles in degrees.
defaultUnit :: Dimension -> Double
defaultUnit d = (pi / 180) ^^ Dimension.exponent Angle d
