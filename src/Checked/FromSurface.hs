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
import Checked.Builtin (Form (..))
import Checked.Builtin qualified as Builtin
import Checked.Deferred (Deferred, mapStrict, resolveAll)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Literal qualified as Literal
import Checked.Piece (unitType)
import Checked.Piece qualified as Piece
import Checked.Scheme (Arithmetic (..), Binding (..), OverloadedCall (..), DeferredConstraint (..))
import Checked.Settings (settings)
import Checked.Settings qualified as Settings
import Checked.Syntax (Program (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Monad (unless, void, when, zipWithM)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, isJust, isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Keyword qualified as Keyword
import Surface.Syntax (Statement)
import Surface.Syntax qualified as Surface
import Surface.Token (Numeral (..))

-- | Check a program.
check :: Surface.Program -> Result w Error Program
check Surface.Program {Surface.statements = written} =
  Result
    { warnings = [],
      errors = settings written <> filter (not . (importing &&) . isUndefined) found,
      output = Just program
    }
  where
    defined = Map.fromListWith (\_ first -> first) (concatMap definition written)
    importing = or [True | Located _ (Surface.Broken (Just "import") _) <- written]
    (found, solution, checked, mentions) =
      Inference.run (catMaybes <$> mapM (statement defined) written)
    program =
      Program
        { name = firstOf [value n | Located _ (Surface.Part n _) <- written],
          title = firstOf [value t | Located _ (Surface.Part _ (Just t)) <- written],
          machine = firstOf [m | Located _ (Surface.Machine m) <- written],
          statements = map ($ solution) checked,
          mentions
        }
    firstOf xs = case xs of
      [] -> Nothing
      x : _ -> Just x

-- | Whether a name is not known: what could not be imported may have defined it.
isUndefined :: Error -> Bool
isUndefined e = case e of
  UndefinedName {} -> True
  _ -> False

-- | The name that a statement defines.
definition :: Statement -> [(Name, Region)]
definition (Located _ s) = case s of
  Surface.LetValue n _ -> [(value n, region n)]
  Surface.LetFunction n _ _ -> [(value n, region n)]
  Surface.Param n _ -> [(value n, region n)]
  Surface.Contour n _ _ -> [(value n, region n)]
  Surface.Table n _ -> [(value n, region n)]
  Surface.Curve n _ -> [(value n, region n)]
  Surface.Piece n _ _ _ _ -> [(value n, region n)]
  Surface.Broken _ (Just n) -> [(value n, region n)]
  _ -> []

-- Statements

-- | The names that the program defines somewhere, and where.
type Defined = Map Name Region

statement :: Defined -> Statement -> Infer (Maybe (Deferred Checked.Statement))
statement defined (Located at s) = case s of
  Surface.Part n _ ->
    Nothing
      <$ Inference.mention
        (region n)
        (Just (region n))
        (nameText n)
        (Inference.Described "the name of the part")
  Surface.Machine _ -> pure Nothing
  Surface.Import _ -> pure Nothing
  Surface.Broken _ name ->
    Nothing <$ mapM_ (\n -> Inference.define (value n) (Poisoned (region n))) name
  Surface.Tool c -> one Checked.Tool (cutter defined c)
  Surface.Feed e -> one Checked.Feed (expect defined Type.feed e)
  Surface.Tolerance accuracy -> one Checked.Tolerance $ case accuracy of
    Surface.Within e -> (Checked.Within .) <$> expect defined Type.len e
    Surface.Between a b ->
      (\a' b' sol -> Checked.Between (a' sol) (b' sol))
        <$> expect defined Type.len a <*> expect defined Type.len b
  Surface.Clearance e -> one Checked.Clearance (expect defined Type.len e)
  Surface.From e -> one Checked.From (spot defined e)
  Surface.LetValue name e -> binding name (infer defined e)
  Surface.Param name e -> binding name (infer defined e)
  Surface.LetFunction name parameters e -> do
    checked <- Inference.separately (unused name *> function defined name parameters e)
    defining name fst checked
    pure
      ( plain
          (\(_, e') sol -> Checked.LetFunction (value name) (fmap value parameters) (e' sol))
          checked
      )
  Surface.Contour name closure items -> do
    checked <- Inference.separately (unused name *> mapM (item defined) items)
    defining name (const (Value (region name) Type.Contour)) checked
    pure (plain (\items' sol -> Checked.Contour name closure (resolveAll sol items')) checked)
  Surface.Table name written -> do
    checked <-
      Inference.separately
        ( unused name
            *> Piece.table
              (checker defined)
              name
              (case written of Surface.WrittenLines ls -> ls; Surface.LinesOf _ -> [])
        )
    defining name (\(t, _) -> Value (region name) t) checked
    pure (plain (\(_, columns) sol -> Checked.Table name (columns sol)) checked)
  Surface.Curve name e -> binding name (curve defined e)
  Surface.Piece name e ciphers side joggles -> do
    checked <- Inference.separately (unused name *> piece defined e ciphers joggles)
    defining name (\(t, _) -> Value (region name) t) checked
    pure
      ( plain
          ( \(_, (e', ciphers', joggles')) sol ->
              Checked.Piece name (e' sol) (resolveAll sol ciphers') side (resolveAll sol joggles')
          )
          checked
      )
  Surface.Assert e within -> one Checked.Assert (assertion defined e within)
  Surface.Mill e side options -> machining Checked.Mill "mill" e side options
  Surface.Pocket e apart options ->
    one
      (\(c, step', o) -> Checked.Pocket c step' o)
      ( (\c step' o sol -> (c sol, step' sol, o sol))
          <$> expect defined Type.Contour e
            <*> expect defined Type.len apart
            <*> Settings.check (expect defined) (stop defined) "pocket" options
      )
  Surface.Turn e side options -> machining Checked.Turn "turn" e side options
  Surface.Drill points depth options ->
    one (\(p, d, o) -> Checked.Drill p d o) $ do
      points' <- places defined points
      depth' <- expect defined Type.len depth
      options' <- Settings.check (expect defined) (stop defined) "drill" options
      pure (\sol -> (points' sol, depth' sol, options' sol))
  Surface.Travel motion stops ->
    one Checked.Travel ((\ps sol -> fmap ($ sol) ps) <$> mapM (stop defined . paced motion) stops)
  Surface.Change e c ->
    one
      (uncurry Checked.Change)
      ((\n c' sol -> (n sol, c' sol)) <$> expect defined Type.number e <*> cutter defined c)
  Surface.Spindle spin -> one Checked.Spindle $ case spin of
    Surface.Still -> pure (const Checked.Still)
    Surface.Spinning sense speed -> do
      speed' <- traverse (expect defined Type.spindleSpeed) speed
      pure (\sol -> Checked.Spinning sense (($ sol) <$> speed'))
  Surface.Coolant switch -> one Checked.Coolant (pure (const switch))
  Surface.Auxiliary e -> one Checked.Auxiliary (expect defined Type.number e)
  Surface.Repeat counter list body -> do
    checked <- Inference.separately (repetition defined counter list)
    body' <-
      inBlock
        (maybe (Poisoned (region counter)) (Local (region counter) . fst) checked)
        (Just counter)
        body
    pure
      ( plain
          (\(_, list') sol -> Checked.Repeat (value counter) (list' sol) (resolveAll sol body'))
          checked
      )
  Surface.When e body others -> do
    checked <- Inference.separately (expect defined Type.Boolean e)
    body' <- block' body
    others' <- block' others
    pure (plain (\e' sol -> Checked.When (e' sol) (resolveAll sol body') (resolveAll sol others')) checked)
  Surface.With e body -> do
    checked <- Inference.separately (expect defined Type.Transformation e)
    body' <- block' body
    pure (plain (\e' sol -> Checked.With (e' sol) (resolveAll sol body')) checked)
  where
    plain f = fmap (\x sol -> Located at (f x sol))
    one make inside = plain (\x sol -> make (x sol)) <$> Inference.separately inside
    binding name inside = do
      checked <- Inference.separately (unused name *> inside)
      defining name (\(t, _) -> Value (region name) t) checked
      d <- maybe (pure Dimension.none) (fmap Type.dimensionOf . Inference.resolved . fst) checked
      pure (plain (\(_, e') sol -> Checked.LetValue name (sol d) (e' sol)) checked)
    machining make word e side options =
      one (\(c, o) -> make c side o) $ do
        e' <- expect defined Type.Contour e
        options' <- Settings.check (expect defined) (stop defined) word options
        pure (\sol -> (e' sol, options' sol))
    defining name entry checked = do
      already <- Inference.find (value name)
      case already of
        Just _ -> pure ()
        Nothing -> do
          let entry' = maybe (Poisoned (region name)) entry checked
          Inference.define (value name) entry'
          mapM_
            (Inference.mention (region name) (Just (region name)) (nameText name))
            (meaningOf entry')
    -- What is defined in a block is known only there.
    block' body = catMaybes <$> Inference.scoped (mapM (statement (inner body)) body)
    inBlock entry counter body = Inference.scoped $ do
      mapM_
        ( \n ->
            Inference.define (value n) entry
              *> mapM_
                (Inference.mention (region n) (Just (region n)) (nameText n))
                (meaningOf entry)
        )
        counter
      catMaybes <$> mapM (statement (inner body)) body
    inner body =
      Map.union (Map.fromListWith (\_ first -> first) (concatMap definition body)) defined

checker :: Defined -> Piece.Checker
checker defined = Piece.Checker (expect defined)

-- | A curve, of whatever table.
curve :: Defined -> Surface.Expr -> Infer (Type, Deferred Checked.Expr)
curve defined e = do
  t <- Type.Curve <$> Inference.freshType
  e' <- expect defined t e
  Inference.settle
  pure (t, e')

-- | A curve with its recalculations and joggles.
piece ::
  Defined ->
  Surface.Expr ->
  [Surface.Cipher] ->
  [Surface.Joggle] ->
  Infer (Type, (Deferred Checked.Expr, [Deferred Checked.Cipher], [Deferred Checked.Joggle]))
piece defined e ciphers joggles = do
  (t, e') <- curve defined e
  columns <- Piece.columnsOf t
  ciphers' <- catMaybes <$> mapM (Piece.cipher (checker defined) columns) ciphers
  joggles' <- mapM (Piece.joggle (checker defined)) joggles
  pure (t, (e', ciphers', joggles'))

-- | What a reader is told of a name.
meaningOf :: Binding -> Maybe Inference.Meaning
meaningOf entry = case entry of
  Value _ t -> Just (Inference.Valued t)
  Local _ t -> Just (Inference.Valued t)
  Function _ parameters scheme -> Just (Inference.Callable parameters scheme)
  Poisoned _ -> Nothing

-- | The stops of @rapid@ are reached in rapid unless they say otherwise.
paced :: Surface.DefaultPace -> Surface.Stop -> Surface.Stop
paced motion s = case (motion, Surface.pace s) of
  (Surface.RapidMotion, Surface.Cutting) -> s {Surface.pace = Surface.Rapid}
  _ -> s

cutter :: Defined -> Surface.Cutter -> Infer (Deferred Checked.Cutter)
cutter defined (Located at c) = fmap (Located at .) $ case c of
  Surface.MillCutter e -> (Checked.MillCutter .) <$> expect defined Type.len e
  Surface.DrillCutter e -> (Checked.DrillCutter .) <$> expect defined Type.len e
  Surface.TurningCutter e -> (Checked.TurningCutter .) <$> expect defined Type.len e
  Surface.ConeCutter d a h ->
    (\d' a' h' sol -> Checked.ConeCutter (d' sol) (a' sol) (h' sol))
      <$> expect defined Type.len d <*> expect defined Type.angle a <*> expect defined Type.len h
  Surface.BladeCutter d g ->
    (\d' g' sol -> Checked.BladeCutter (d' sol) (g' sol))
      <$> expect defined Type.len d <*> expect defined Type.len g

-- | Something that has to be true, or two quantities that have to be equal.
assertion :: Defined -> Surface.Expr -> Maybe Surface.Expr -> Infer (Deferred Checked.Assertion)
assertion defined e within = case (value e, within) of
  (Surface.Binary Surface.Equal l r, _) -> do
    (lt, l') <- infer defined l
    (rt, r') <- infer defined r
    _ <- operation (region e) Surface.Equal (region l, lt) (region r, rt)
    kind <- Inference.resolved lt
    -- Things that cannot be compared differ by nothing.
    within' <-
      traverse (expect defined (case kind of Type.Quantity _ -> lt; _ -> Type.Wrong)) within
    d <- Type.dimensionOf <$> Inference.resolved lt
    pure (\sol -> Checked.Agrees (sol d) (l' sol) (r' sol) (($ sol) <$> within'))
  (Surface.Binary op l r, Nothing)
    | op `elem` [Surface.Less, Surface.AtMost, Surface.Greater, Surface.AtLeast, Surface.Unequal] ->
      do
        (lt, l') <- infer defined l
        (rt, r') <- infer defined r
        _ <- operation (region e) op (region l, lt) (region r, rt)
        d <- Type.dimensionOf <$> Inference.resolved lt
        pure (\sol -> Checked.Compares (sol d) (region e) op (l' sol) (r' sol))
  (_, Just d) ->
    (\e' sol -> Checked.Holds (e' sol))
      <$> (Inference.mistake (WithinWithoutEquality (region d)) *> (snd <$> infer defined e))
  (_, Nothing) -> (\e' sol -> Checked.Holds (e' sol)) <$> expect defined Type.Boolean e

-- | A name that can be given.
unused :: Located Name -> Infer ()
unused (Located at name@(Name text)) = do
  already <- Inference.find name
  case already of
    Just (Value before _) -> Inference.mistake (DefinedTwice at name before)
    Just (Function before _ _) -> Inference.mistake (DefinedTwice at name before)
    Just (Poisoned before) -> Inference.mistake (DefinedTwice at name before)
    Just (Local _ _) -> pure ()
    Nothing -> pure ()
  when (isBuiltin text) (Inference.mistake (NameTaken at name))

function ::
  Defined ->
  Located Name ->
  NonEmpty (Located Name) ->
  Surface.Expr ->
  Infer (Binding, Deferred Checked.Expr)
function defined name parameters body = do
  mapM_
    (\(Located at n@(Name text)) -> when (isBuiltin text) (Inference.mistake (NameTaken at n)))
    parameters
  twice (NonEmpty.toList parameters)
  (scheme, body') <- Inference.generalise $ do
    ts <- mapM (const Inference.freshType) (NonEmpty.toList parameters)
    (t, e) <- Inference.withLocals (zip (NonEmpty.toList parameters) ts) (infer defined body)
    pure (ts, t, e)
  pure
    ( Function (region name) [text | Located _ (Name text) <- NonEmpty.toList parameters] scheme,
      body'
    )
  where
    twice ns = case ns of
      [] -> pure ()
      n : rest -> do
        mapM_
          (\again -> Inference.mistake (DefinedTwice (region again) (value n) (region n)))
          (take 1 (filter ((== value n) . value) rest))
        twice rest

isBuiltin :: Text -> Bool
isBuiltin = isJust . Builtin.lookup

nameText :: Located Name -> Text
nameText (Located _ (Name text)) = text

stop :: Defined -> Surface.Stop -> Infer (Deferred Checked.Stop)
stop defined (Surface.Stop p pace) = do
  p' <- spot defined p
  pace' <- case pace of
    Surface.Cutting -> pure (const Checked.Cutting)
    Surface.Rapid -> pure (const Checked.Rapid)
    Surface.AtFeed f -> (Checked.AtFeed .) <$> expect defined Type.feed f
  pure (\sol -> Checked.Stop (p' sol) (pace' sol))

-- | A point of the plane, or one with a height.
spot :: Defined -> Surface.Expr -> Infer (Deferred Checked.Expr)
spot defined e = do
  (t, e') <- infer defined e
  t' <- Inference.resolved t
  unless (t' == Type.SpacePoint) (equal (region e) Type.aPoint t)
  pure e'

-- | A list of points, or one point.
places :: Defined -> Surface.Expr -> Infer (Deferred Checked.Expr)
places defined e = do
  (t, e') <- infer defined e
  t' <- Inference.resolved t
  case t' of
    Type.Spatial _ -> equal (region e) Type.aPoint t
    _ -> equal (region e) (Type.ListOf Type.aPoint) t
  pure e'

-- | The variable and the list of a repetition.
repetition :: Defined -> Located Name -> Surface.Expr -> Infer (Type, Deferred Checked.Expr)
repetition defined counter list = do
  when
    (isBuiltin (nameText counter))
    (Inference.mistake (NameTaken (region counter) (value counter)))
  t <- Inference.freshType
  (found, list') <- infer defined list
  fine <- agrees (region list) (Type.ListOf t) found
  pure (if fine then t else Type.Wrong, list')

item :: Defined -> Surface.Item -> Infer (Deferred Checked.Item)
item defined (Located at i) = case i of
  Surface.BrokenItem name -> do
    mapM_ (\n -> Inference.define (value n) (Poisoned (region n))) name
    Inference.taint
    pure (const (Located at (Checked.For (Name "") (Located at (Checked.List [])) [])))
  Surface.For counter list items -> do
    (t, list') <- repetition defined counter list
    items' <- Inference.withLocals [(counter, t)] (mapM (item defined) items)
    pure (\sol -> Located at (Checked.For (value counter) (list' sol) (resolveAll sol items')))
  Surface.Choose e items others -> do
    e' <- expect defined Type.Boolean e
    items' <- mapM (item defined) items
    others' <- mapM (item defined) others
    pure (\sol -> Located at (Checked.Choose (e' sol) (resolveAll sol items') (resolveAll sol others')))
  Surface.Element walk e modifiers link -> do
    (t, e') <- walked defined walk e
    modifiers' <- if null modifiers then pure [] else Piece.columnsOf t >>= modified' modifiers
    link' <- traverse (linked defined) link
    pure
      ( \sol ->
          Located
            at
            ( Checked.Element
                (mapStrict value walk)
                (e' sol)
                (resolveAll sol modifiers')
                (mapStrict ($ sol) link')
            )
      )
  where
    modified' modifiers columns =
      mapM
        (modified defined columns)
        (if isNothing columns then filter (not . isBevel) modifiers else modifiers)

isBevel :: Surface.Modifier -> Bool
isBevel (Located _ m) = case m of
  Surface.Bevel _ -> True
  Surface.AtElementFeed _ -> False
  Surface.Slow -> False
  Surface.ElementAllowance _ -> False

-- | What is asked on an element with these columns, as far as they are known.
modified :: Defined -> Maybe [(Text, Type)] -> Surface.Modifier -> Infer (Deferred Checked.Modifier)
modified defined columns (Located at m) = fmap (Located at .) $ case m of
  Surface.AtElementFeed e -> (Checked.AtElementFeed .) <$> expect defined Type.feed e
  Surface.Slow -> pure (const Checked.Slow)
  Surface.ElementAllowance e -> (Checked.ElementAllowance .) <$> expect defined Type.len e
  Surface.Bevel e ->
    (Checked.Bevel .)
      <$> Piece.withColumns (region e) (concat columns) (expect defined Type.angle e)

-- | A circle with its sense, or a line, a point, a curve or a contour without one.
walked ::
  Defined ->
  Maybe (Located Surface.Sense) ->
  Surface.Expr ->
  Infer (Type, Deferred Checked.Expr)
walked defined walk e = case (walk, value e) of
  (Nothing, Surface.Pair _ _) -> (Type.aPoint,) <$> expect defined Type.aPoint e
  _ -> do
    plain <- Literal.call (expect defined) e
    inferred (maybe (infer defined e) (\c -> pure (Literal.answer c, Literal.checked c)) plain)
  where
    inferred found = do
      (t, e') <- found
      t' <- Inference.resolved t
      case (t', walk) of
        (Type.Circle, Nothing) -> Inference.mistake (SenseMissing (region e))
        (Type.Circle, Just _) -> pure ()
        (Type.Line, Nothing) -> pure ()
        (Type.Contour, Nothing) -> pure ()
        (Type.Curve _, Nothing) -> pure ()
        (Type.Curve _, Just w) -> Inference.mistake (SenseUnneeded (region w) t')
        (Type.Spatial _, Nothing) -> equal (region e) Type.aPoint t
        (Type.Line, Just w) -> Inference.mistake (SenseUnneeded (region w) t')
        (Type.Contour, Just w) -> Inference.mistake (SenseUnneeded (region w) t')
        (Type.Spatial _, Just w) -> Inference.mistake (SenseUnneeded (region w) t')
        (Type.Variable _, Just _) -> equal (region e) Type.Circle t
        (Type.Wrong, _) -> pure ()
        _ -> Inference.mistake (NotAnElement (region e) t')
      pure (t, e')

linked :: Defined -> Surface.Link -> Infer (Deferred Checked.Link)
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
expect :: Defined -> Type -> Surface.Expr -> Infer (Deferred Checked.Expr)
expect defined wanted e = case (value e, wanted) of
  _ | Just e' <- Literal.number wanted e -> pure (const e')
  (Surface.Pair x y, Type.Spatial d) | Dimension.isKnown d -> do
    x' <- expect defined Type.len x
    y' <- expect defined Type.len y
    pure (\sol -> Located (region e) (Checked.Pair (x' sol) (y' sol)))
  _ -> do
    (t, e') <- infer defined e
    equal (region e) wanted t
    pure e'

-- | The found type at a place has to be the wanted one.
equal :: Region -> Type -> Type -> Infer ()
equal at wanted t = void (agrees at wanted t)

-- | Whether the found type at a place is the wanted one; a mistake if not.
agrees :: Region -> Type -> Type -> Infer Bool
agrees at wanted t = do
  found <- Inference.resolved t
  wanted' <- Inference.resolved wanted
  settled <- Inference.decidedElsewhere [(at, t, found), (at, wanted, wanted')]
  same <- Inference.unify at wanted t
  unless same (Inference.mistakeOnce (map fst settled) (Mismatch at wanted' found settled))
  pure same

infer :: Defined -> Surface.Expr -> Infer (Type, Deferred Checked.Expr)
infer defined (Located at e) = case e of
  Surface.Literal (Numeral _ x) (Just unit) ->
    let (t, factor) = unitType unit in pure (t, const (Located at (Checked.Number (x * factor))))
  Surface.Literal (Numeral _ x) Nothing -> do
    d <- Inference.freshDimension
    -- A bare number means one thing everywhere; only nothing is nothing in every unit.
    unless (x == 0) (Inference.monomorphic d)
    pure (Type.Quantity d, \sol -> Located at (Checked.Number (x * Dimension.defaultUnit (sol d))))
  Surface.Variable name -> variable defined at name
  Surface.Call name arguments -> do
    plain <- Literal.call (expect defined) (Located at e)
    case plain of
      Nothing -> call defined at name arguments
      Just c ->
        (,Literal.checked c)
          <$> ( if Literal.overloaded c
                  then Inference.decidedAs at (Literal.answer c)
                  else pure (Literal.answer c)
              )
  Surface.Negate inner -> do
    (t, inner') <- infer defined inner
    result <- operation at Surface.Multiply (at, Type.number) (region inner, t)
    pure (result, \sol -> Located at (Checked.Negate (inner' sol)))
  Surface.Not inner -> do
    inner' <- expect defined Type.Boolean inner
    pure (Type.Boolean, \sol -> Located at (Checked.Not (inner' sol)))
  Surface.Binary op l r | op `elem` [Surface.And, Surface.Or] -> do
    l' <- expect defined Type.Boolean l
    r' <- expect defined Type.Boolean r
    pure (Type.Boolean, \sol -> Located at (Checked.Binary op (l' sol) (r' sol)))
  Surface.Binary op l r -> do
    (lt, l') <- infer defined l
    (rt, r') <- infer defined r
    when (op `elem` [Surface.Multiply, Surface.Divide]) (Literal.plainFactor op (l, lt) (r, rt))
    result <- operation at op (region l, lt) (region r, rt)
    pure (result, \sol -> Located at (Checked.Binary op (l' sol) (r' sol)))
  Surface.Range low high Nothing -> do
    low' <- expect defined Type.number low
    high' <- expect defined Type.number high
    pure
      (Type.ListOf Type.number, \sol -> Located at (Checked.Range (low' sol) (high' sol) Nothing))
  Surface.Range low high (Just step) -> do
    d <- Inference.freshDimension
    low' <- expect defined (Type.Quantity d) low
    high' <- expect defined (Type.Quantity d) high
    step' <- expect defined (Type.Quantity d) step
    pure
      ( Type.ListOf (Type.Quantity d),
        \sol -> Located at (Checked.Range (low' sol) (high' sol) (Just (step' sol)))
      )
  Surface.If c a b -> do
    c' <- expect defined Type.Boolean c
    (t, a') <- infer defined a
    b' <- expect defined t b
    pure (t, \sol -> Located at (Checked.If (c' sol) (a' sol) (b' sol)))
  Surface.Pair x y -> do
    x' <- expect defined Type.len x
    y' <- expect defined Type.len y
    d <- Inference.freshDimension
    pure (Type.Spatial d, \sol -> Located at (Checked.Pair (x' sol) (y' sol)))
  Surface.Triple x y z -> do
    x' <- expect defined Type.len x
    y' <- expect defined Type.len y
    z' <- expect defined Type.len z
    pure (Type.SpacePoint, \sol -> Located at (Checked.Triple (x' sol) (y' sol) (z' sol)))
  Surface.List es -> do
    t <- Inference.freshType
    es' <- mapM (expect defined t) es
    pure (Type.ListOf t, \sol -> Located at (Checked.List (resolveAll sol es')))
  Surface.Each inner counter list -> do
    (t, list') <- repetition defined counter list
    (result, inner') <- Inference.withLocals [(counter, t)] (infer defined inner)
    pure
      ( Type.ListOf result,
        \sol -> Located at (Checked.Each (inner' sol) (value counter) (list' sol))
      )

-- | The result of an operation.
operation :: Region -> Surface.Operator -> (Region, Type) -> (Region, Type) -> Infer Type
operation place operator left right = do
  outcome <- Inference.freshType
  Inference.require (Operation Arithmetic {place, operator, left, right, outcome})
  pure outcome

variable :: Defined -> Region -> Name -> Infer (Type, Deferred Checked.Expr)
variable defined at name@(Name text) = do
  entry <- Inference.find name
  case entry of
    Just (Value there t) ->
      (t, here (Checked.Variable name))
        <$ Inference.mention at (Just there) text (Inference.Valued t)
    Just (Local there t) ->
      (t, here (Checked.Variable name))
        <$ Inference.mention at (Just there) text (Inference.Valued t)
    Just (Function there parameters scheme) -> do
      Inference.mention at (Just there) text (Inference.Callable parameters scheme)
      wrong
        ( FunctionAsValue
            at
            name
            ["Write " <> text <> "(" <> Text.intercalate ", " parameters <> ")."]
        )
    Just (Poisoned _) -> nothing <$ Inference.taint
    Nothing -> case Builtin.lookup text of
      Just builtin -> do
        Inference.mention at Nothing text (Inference.Described (Builtin.description builtin))
        forms <- fresh builtin
        case forms of
          [Form [] t] -> pure (t, here (Checked.Builtin builtin []))
          _ -> wrong (FunctionAsValue at name (Builtin.formsHint builtin))
      Nothing -> unknown defined at name >>= wrong
  where
    here e _ = Located at e
    nothing = (Type.Wrong, here (Checked.Number 0))
    wrong e = nothing <$ Inference.mistake e

-- | The forms of a builtin with unknowns of their own.
fresh :: Checked.Builtin -> Infer [Form]
fresh builtin = (`Builtin.forms` builtin) <$> freshUnknowns

freshUnknowns :: Infer Builtin.Fresh
freshUnknowns = do
  d <- Inference.freshDimension
  t <- Inference.freshType
  pure Builtin.Fresh {Builtin.dimension = d, Builtin.anything = t}

-- | A name that means nothing here: it stands further down, it is being defined, or it is misspelt.
unknown :: Defined -> Region -> Name -> Infer Error
unknown defined at name = do
  names <- Inference.namesInScope
  pure $ case Map.lookup name defined of
    Just place
      | start place > start at -> UsedBeforeDefinition at name place
      | otherwise -> Recursive at name
    Nothing ->
      UndefinedName at name ([text | Name text <- names] <> Builtin.names <> Keyword.reservedWords)

call ::
  Defined ->
  Region ->
  Located Name ->
  NonEmpty Surface.Argument ->
  Infer (Type, Deferred Checked.Expr)
call defined at (Located place name@(Name text)) arguments = do
  entry <- Inference.find name
  case entry of
    Just (Function there parameters scheme) -> do
      Inference.mention place (Just there) text (Inference.Callable parameters scheme)
      (ts, t, operations) <- Inference.instantiate at scheme
      case plain of
        Just es
          | length es == length ts -> do
            checked <- zipWithM argument ts es
            operations
            pure
              ( if all fst checked then t else Type.Wrong,
                \sol ->
                  Located at (Checked.Apply name (NonEmpty.fromList (map (($ sol) . snd) checked)))
              )
        _ -> wrong (ArgumentCount at name parameters (length given))
    Just (Value before _) -> wrong (NotAFunction place name (Just before))
    Just (Local before _) -> wrong (NotAFunction place name (Just before))
    Just (Poisoned _) -> nothing <$ (otherArguments *> Inference.taint)
    Nothing -> case Builtin.lookup text of
      Just builtin
        | Builtin.isConstant builtin -> wrong (NotAFunction place name Nothing)
        | otherwise ->
          Inference.mention place Nothing text (Inference.Described (Builtin.description builtin))
            *> builtinCall builtin
      Nothing -> unknown defined place name >>= wrong
  where
    given = NonEmpty.toList arguments
    nothing = (Type.Wrong, const (Located at (Checked.Number 0)))
    -- The arguments, if no words stand before them.
    plain =
      sequence
        [ case a of
            Surface.Given e ->
              Just e
            Surface.Chosen _ _ -> Nothing
            Surface.Ranked _ -> Nothing
          | a <- given
        ]
    -- The arguments may contain mistakes of their own.
    otherArguments = mapM_ (infer defined) (concatMap valueOf given)
    wrong e = nothing <$ (otherArguments *> Inference.mistake e)
    argument wanted e = do
      (t, e') <- infer defined e
      fine <- agrees (region e) wanted t
      pure (fine, e')
    builtinCall builtin = do
      unknowns <- freshUnknowns
      let forms = Builtin.forms unknowns builtin
          isOnly = null (drop 1 forms)
      case Builtin.labelled unknowns builtin labels of
        []
          | Just es <- plain,
            [form] <- forms ->
            wrong (ArgumentCount at name (map Builtin.title (Builtin.parameters form)) (length es))
          | otherwise -> wrong (NoSuchCall at text (Builtin.formTexts builtin))
        [form] | isOnly || any (/= Builtin.NoLabel) labels -> do
          checked <-
            zipWithM
              argument
              ( map
                  Builtin.type'
                  (filter ((/= Builtin.Rank) . Builtin.label) (Builtin.parameters form))
              )
              (concatMap valueOf given)
          pure
            ( if all fst checked then Builtin.result form else Type.Wrong,
              \sol -> Located at (Checked.Builtin builtin (rebuilt (map (($ sol) . snd) checked)))
            )
        _ -> do
          checked <- mapM (infer defined) (concatMap valueOf given)
          chosen <- Inference.freshType
          Inference.require
            ( Overloaded
                OverloadedCall
                  { at,
                    builtin,
                    labels,
                    given = zip (map region (concatMap valueOf given)) (map fst checked),
                    chosen
                  }
            )
          pure
            ( chosen,
              \sol -> Located at (Checked.Builtin builtin (rebuilt (map (($ sol) . snd) checked)))
            )
    labels =
      [ case a of
          Surface.Given _ ->
            Builtin.NoLabel
          Surface.Chosen word _ -> Builtin.Word (value word)
          Surface.Ranked _ -> Builtin.Rank
        | a <- given
      ]
    -- The checked values with the words before them.
    rebuilt values = go given values
      where
        go as vs = case (as, vs) of
          (Surface.Given _ : more, v : rest) -> Checked.Given v : go more rest
          (Surface.Chosen word _ : more, v : rest) -> Checked.Chosen (value word) v : go more rest
          (Surface.Ranked rank : more, _) -> Checked.Ranked (value rank) : go more vs
          _ -> []

-- | The value of an argument; a rank has none.
valueOf :: Surface.Argument -> [Surface.Expr]
valueOf argument = case argument of
  Surface.Given e -> [e]
  Surface.Chosen _ e -> [e]
  Surface.Ranked _ -> []
