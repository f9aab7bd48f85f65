-- | Checks a surface program: resolves its names and infers its types.
--
-- Definitions are checked in the order of the text. Each of them can use only what is defined above
-- it, so that every program terminates. A statement with a mistake is left out of the output. The
-- name that such a statement defines is poisoned: statements that use it are left out without a
-- further report.
module Checked.FromSurface
  ( check,
    checkByInference,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Checked.Assertion qualified as Assertion
import Checked.CallError qualified as CallError
import Checked.Column qualified as Column
import Checked.Contour (item)
import Checked.Cutter (cutter)
import Checked.Deferred (Deferred, resolveAll)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.ErrorContext qualified as ErrorContext
import Checked.ErrorFix (unwritten)
import Checked.Expression
  ( TypingEnvironment (..),
    expect,
    fit,
    infer,
    isBuiltin,
    listOf,
    repetition,
    spatialPoint,
  )
import Checked.Feed (cutFeed)
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Lettering qualified as Lettering
import Checked.Piece qualified as Piece
import Checked.RequiredSetting qualified as RequiredSetting
import Checked.Scheme (Binding (..))
import Checked.Settings qualified as Settings
import Checked.Syntax (Program (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Applicative (liftA2, (<|>))
import Control.Monad (unless, when)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, listToMaybe)
import Data.Set qualified as Set
import Data.Text (Text)
import Font.TextOutline (LetterShape)
import Surface.FileUnit qualified as FileUnit
import Surface.HoleForm qualified as HoleForm
import Surface.Syntax (Statement)
import Surface.Syntax qualified as Surface
import Surface.SyntaxWalk qualified as SyntaxWalk

-- | Checks a program. The output contains all statements without mistakes.
check :: Surface.Program -> Result w Error Program
check = checkBy True

-- | Checks a program by full inference only, without the shortcuts of "Checked.Inference.Fast".
-- Tests compare the result with that of 'check', which must be the same.
checkByInference :: Surface.Program -> Result w Error Program
checkByInference = checkBy False

checkBy :: Bool -> Surface.Program -> Result w Error Program
checkBy isFast surface@Surface.Program {Surface.statements = written} =
  Result
    { warnings = [],
      errors =
        RequiredSetting.check written
          <> ErrorContext.complete
            written
            (CallError.inOrder mistakesOf written (filter (not . isExcused) found) <> radians),
      -- The geometry of an angle in the wrong unit would only make further errors.
      output = if null radians then Just program else Nothing
    }
  where
    (found, solution, checked, mentions) = inferred written
    inferred ss =
      Inference.run
        (catMaybes <$> mapM (statement (environment ss)) ss)
    environment ss =
      TypingEnvironment {definitions = definedIn ss, isFast, unitAt = FileUnit.unitAt surface}
    mistakesOf ss = let (errors, _, _, _) = inferred ss in errors
    -- The geometry of a name of the wrong type would only make further errors.
    suspects = CallError.suspects written found
    isLeftOut s = not (Set.null suspects) && CallError.isDoubtful written suspects (region s)
    radians = radiansIn written mentions
    -- A file that could not be imported may define any name, so unknown names are not reported.
    isExcused e = isImportBroken && isUndefinedName e
    isImportBroken = or [True | Located _ (Surface.Broken (Just "import") _) <- written]
    program =
      Program
        { name = listToMaybe [value n | Located _ (Surface.Part n _) <- written],
          title = listToMaybe [value t | Located _ (Surface.Part _ (Just t)) <- written],
          machine = listToMaybe [m | Located _ (Surface.Machine m) <- written],
          unit = FileUnit.ofProgram surface,
          statements = filter (not . isLeftOut) (map ($ solution) checked),
          mentions
        }

-- | The errors of numbers with pi and without units that become angles by the use of their names.
radiansIn :: [Statement] -> [Checked.Mention] -> [Error]
radiansIn written mentions =
  [ RadiansWithoutUnit (region e)
    | Located _ (Surface.LetValue n e) <- concatMap SyntaxWalk.statementsIn written,
      SyntaxWalk.isRadians e,
      or
        [ t == Type.angle
          | m <- mentions,
            Checked.place m == region n,
            Checked.OfValue t <- [Checked.typing m]
        ]
  ]

isUndefinedName :: Error -> Bool
isUndefinedName e = case e of
  UndefinedName {} -> True
  UndefinedFunction {} -> True
  _ -> False

-- | The names that the statements define, with the regions of their first definitions. Definitions
-- inside the blocks of the statements are left out.
definedIn :: [Statement] -> Map Name Region
definedIn statements =
  Map.fromListWith
    (\_ first -> first)
    [(value n, region n) | Located _ s <- statements, Just n <- [SyntaxWalk.definedName s]]

-- Statements

-- | Checks a statement. 'Nothing' if the statement has no counterpart in the checked program, such
-- as @part@, or if it contains a mistake. Mistakes inside its blocks do not count.
statement :: TypingEnvironment -> Statement -> Infer (Maybe (Deferred Checked.Statement))
statement env (Located at s) = case s of
  Surface.Part n _ -> Nothing <$ mentionDefinition n (Inference.Described "the name of the part")
  Surface.Units _ -> pure Nothing
  Surface.Machine _ -> pure Nothing
  Surface.Import _ -> pure Nothing
  Surface.Broken keyword n ->
    (if keyword == Just "change" then Just (located Checked.UnknownChange) else Nothing)
      <$ mapM_ (\n' -> Inference.define (value n') (Poisoned (region n'))) n
  Surface.LetValue n e -> done (valueDefinition n (infer env e))
  Surface.Param n e -> done (valueDefinition n (infer env e))
  Surface.LetFunction n parameters e -> done (functionDefinition env n parameters e)
  Surface.Contour n closure items -> done (contourDefinition env n closure items)
  Surface.Drawn {} -> pure Nothing
  Surface.DrawnText n _ text shapes -> done (letters env n text shapes)
  Surface.Table n written -> done (tableDefinition env n written)
  Surface.Curve n e -> done (valueDefinition n (curve env e))
  Surface.Piece n e ciphers side joggles -> done (pieceDefinition env n e ciphers side joggles)
  Surface.Repeat counter list body -> done (repeated env counter list body)
  Surface.When e body others -> do
    checked <- Inference.separately (expect env Type.Boolean e)
    body' <- block env body
    others' <- block env others
    let make e' sol = Checked.When (e' sol) (resolveAll sol body') (resolveAll sol others')
    done (pure (make <$> checked))
  Surface.With e body -> do
    checked <- Inference.separately (expect env Type.Transformation e)
    body' <- block env body
    done (pure ((\e' sol -> Checked.With (e' sol) (resolveAll sol body')) <$> checked))
  Surface.Tool number c ->
    one $
      (\number' c' sol -> Checked.Tool (($ sol) <$> number') (c' sol))
        <$> traverse (expect env Type.number) number
          <*> cutter env c
  Surface.Feed e -> one (fmap Checked.Feed <$> cutFeed env e)
  Surface.Tolerance accuracy -> one (fmap Checked.Tolerance <$> tolerance env accuracy)
  Surface.Clearance e -> one (fmap Checked.Clearance <$> expect env Type.len e)
  Surface.From e -> one (fmap Checked.From <$> spatialPoint env e)
  Surface.WorkOffset e -> one (fmap Checked.WorkOffset <$> expect env Type.number e)
  Surface.ProgramNumber e -> one (fmap Checked.ProgramNumber <$> expect env Type.number e)
  Surface.SafeHeight e -> one (fmap Checked.SafeHeight <$> expect env Type.len e)
  Surface.Stock e zs -> one (solid env Checked.Stock e zs)
  Surface.Avoid e zs -> one (solid env Checked.Avoid e zs)
  Surface.Assert e within -> one (fmap Checked.Assert <$> Assertion.check env e within)
  Surface.Mill e side options ->
    one (machining env Checked.Mill "mill" (outlined env e) side options)
  Surface.Turn e side options ->
    one (machining env Checked.Turn "turn" (expect env Type.Contour e) side options)
  Surface.Pocket e stepover own options -> done (pocketing env e stepover own options)
  Surface.RestOf e stepover options ->
    one (clearing env Checked.RestOf "rest" (expect env Type.Clearing e) stepover options)
  Surface.Face e stepover options ->
    one (clearing env Checked.Face "face" (outlined env e) stepover options)
  Surface.Engrave text options ->
    one (liftA2 Checked.Engrave <$> Lettering.check env text <*> settings "engrave" options)
  Surface.Vcarve e own options -> done (carving env e own options)
  Surface.Drill points depth options ->
    one $ do
      (columns, points') <- pointOrPoints env points
      depth' <- Column.inScope columns (expect env Type.len depth)
      o <- Settings.check env "drill" options
      pure (\sol -> Checked.Drill (points' sol) (depth' sol) (o sol))
  Surface.Hole work points sizes side options ->
    one $ do
      (columns, points') <- pointOrPoints env points
      sizes' <- traverse (holeSize env work columns) sizes
      o <- Settings.check env (HoleForm.word work) options
      pure (\sol -> Checked.Hole work (points' sol) (fmap (fmap ($ sol)) sizes') side (o sol))
  Surface.Travel motion stops ->
    one $
      (\ps sol -> Checked.Travel (fmap ($ sol) ps))
        <$> mapM (Settings.stop env . atPace motion) stops
  Surface.Change e c place ->
    fmap (<|> Just (located Checked.UnknownChange)) . one $
      (\e' c' place' sol -> Checked.Change (e' sol) (c' sol) (($ sol) <$> place'))
        <$> expect env Type.number e
          <*> cutter env c
          <*> traverse (spatialPoint env) place
  Surface.Spindle spin -> one (fmap Checked.Spindle <$> spindle env spin)
  Surface.Coolant switch -> one (pure (const (Checked.Coolant switch)))
  Surface.Auxiliary e -> one (fmap Checked.Auxiliary <$> expect env Type.number e)
  Surface.ProgramStop -> one (pure (const Checked.ProgramStop))
  Surface.OptionalStop -> one (pure (const Checked.OptionalStop))
  Surface.Dwell e -> one (fmap Checked.Dwell <$> expect env Type.number e)
  where
    done = fmap (fmap (Located at .))
    one = done . Inference.separately
    located s' = const (Located at s')
    settings = Settings.check env

-- | Checks the statements of a block. The names that they define are known only in this block.
block :: TypingEnvironment -> [Statement] -> Infer [Deferred Checked.Statement]
block env body = Inference.scoped (inBlock env body)

inBlock :: TypingEnvironment -> [Statement] -> Infer [Deferred Checked.Statement]
inBlock env body = catMaybes <$> mapM (statement inner) body
  where
    inner = env {definitions = Map.union (definedIn body) (definitions env)}

-- | Checks a @for@ statement, which repeats the block @body@ for each item of the list @list@. Its
-- variable @counter@ is poisoned if @list@ contains a mistake.
repeated ::
  TypingEnvironment ->
  Located Name ->
  Surface.Expr ->
  [Statement] ->
  Infer (Maybe (Deferred Checked.Statement_))
repeated env counter list body = do
  checked <- Inference.separately (repetition env counter list)
  let binding = maybe (Poisoned (region counter)) (\(t, _, _) -> Local (region counter) t) checked
  body' <- Column.inScope (maybe [] (\(_, columns, _) -> columns) checked) $ do
    Inference.define (value counter) binding
    mapM_ (mentionDefinition counter) (meaningOf binding)
    inBlock env body
  d <- maybe (pure Dimension.none) (\(t, _, _) -> Type.dimensionOf <$> Inference.resolved t) checked
  let make (_, _, list') sol = Checked.Repeat counter (sol d) (list' sol) (resolveAll sol body')
  pure (make <$> checked)

-- | Checks a statement that clears a pocket, and binds the name of the operation if it has one.
pocketing ::
  TypingEnvironment ->
  Surface.Expr ->
  Surface.Expr ->
  Maybe (Located Name) ->
  [Surface.Setting] ->
  Infer (Maybe (Deferred Checked.Statement_))
pocketing env e stepover own options = operation own inside
  where
    inside = clearing env make "pocket" (outlined env e) stepover options
    make e' stepover' = Checked.Pocket e' stepover' own

-- | Checks a V-carving, and binds its name if it has one.
carving ::
  TypingEnvironment ->
  Surface.Expr ->
  Maybe (Located Name) ->
  [Surface.Setting] ->
  Infer (Maybe (Deferred Checked.Statement_))
carving env e own options = operation own (liftA2 make <$> outlined env e <*> checked)
  where
    checked = Settings.check env "vcarve" options
    make e' = Checked.Vcarve e' own

-- | Checks an operation, and binds its name if it has one.
operation :: Maybe (Located Name) -> Infer (Deferred a) -> Infer (Maybe (Deferred a))
operation own inside = case own of
  Nothing -> Inference.separately inside
  Just name -> defining name (const (Value (region name) Type.Clearing)) inside

-- | Checks a statement that clears something with a stepover. @word@ is its first word, and @make@
-- makes it from what it clears, the stepover and the settings.
clearing ::
  TypingEnvironment ->
  (Checked.Expr -> Checked.Expr -> Checked.Settings -> a) ->
  Text ->
  Infer (Deferred Checked.Expr) ->
  Surface.Expr ->
  [Surface.Setting] ->
  Infer (Deferred a)
clearing env make word cleared stepover options =
  (\e' stepover' o sol -> make (e' sol) (stepover' sol) (o sol))
    <$> cleared
      <*> expect env Type.len stepover
      <*> Settings.check env word options

-- Definitions

-- | Checks the definition of a value, and binds its name. @inside@ checks the expression of the
-- value.
valueDefinition ::
  Located Name ->
  Infer (Type, Deferred Checked.Expr) ->
  Infer (Maybe (Deferred Checked.Statement_))
valueDefinition name inside = do
  checked <- defining name (Value (region name) . fst) inside
  d <- maybe (pure Dimension.none) (fmap Type.dimensionOf . Inference.resolved . fst) checked
  pure ((\(_, e) sol -> Checked.LetValue name (sol d) (e sol)) <$> checked)

-- | Checks the definition of a function, and binds its name.
functionDefinition ::
  TypingEnvironment ->
  Located Name ->
  NonEmpty (Located Name) ->
  Surface.Expr ->
  Infer (Maybe (Deferred Checked.Statement_))
functionDefinition env name parameters body = do
  checked <- defining name fst (function env name parameters body)
  let make (_, e) sol = Checked.LetFunction (value name) (fmap value parameters) (e sol)
  pure (make <$> checked)

-- | Checks a function, and generalises its type so that each call may use other types.
function ::
  TypingEnvironment ->
  Located Name ->
  NonEmpty (Located Name) ->
  Surface.Expr ->
  Infer (Binding, Deferred Checked.Expr)
function env name parameters body = do
  mapM_ reportBuiltin locals
  reportRepeated locals
  (scheme, body') <- Inference.generalise $ do
    types <- mapM (const Inference.freshType) locals
    (t, e) <- Inference.withLocals (zip locals types) (infer env body)
    pure (types, t, e)
  pure (Function (region name) [text | Located _ (Name text) <- locals] scheme, body')
  where
    locals = NonEmpty.toList parameters

-- | Reports every parameter name that an earlier parameter has. The report also points at that
-- earlier one.
reportRepeated :: [Located Name] -> Infer ()
reportRepeated names = case names of
  [] -> pure ()
  n : rest -> do
    mapM_
      (\again -> Inference.mistake (DefinedTwice (region again) (value n) (region n) unwritten []))
      (take 1 (filter ((== value n) . value) rest))
    reportRepeated rest

-- | Checks the definition of a contour, and binds its name.
contourDefinition ::
  TypingEnvironment ->
  Located Name ->
  Located Surface.Closure ->
  [Surface.Item] ->
  Infer (Maybe (Deferred Checked.Statement_))
contourDefinition env name closure items = do
  checked <- defining name (const (Value (region name) Type.Contour)) (mapM (item env) sound)
  pure ((\items' sol -> Checked.Contour name closure (resolveAll sol items')) <$> checked)
  where
    -- Beside a broken item, a number is a part of it, such as a coordinate without its brackets.
    sound = if any isBroken items then filter (not . isNumber) items else items
    isBroken (Located _ i) = case i of
      Surface.BrokenItem _ -> True
      _ -> False
    isNumber (Located _ i) = case i of
      Surface.Element _ (Located _ (Surface.Literal _ _)) _ _ -> True
      _ -> False

-- | Checks a text in a font, and binds the name of its region.
letters ::
  TypingEnvironment ->
  Located Name ->
  Surface.Lettering ->
  [LetterShape] ->
  Infer (Maybe (Deferred Checked.Statement_))
letters env name text shapes = do
  checked <-
    defining name (const (Value (region name) Type.PlaneRegion)) (Lettering.checkPlace env text)
  pure ((\place sol -> Checked.Letters name (place sol) shapes) <$> checked)

-- | Checks the definition of a table, and binds its name. The lines of a table from a file have
-- been read before this pass.
tableDefinition ::
  TypingEnvironment -> Located Name -> Surface.Lines -> Infer (Maybe (Deferred Checked.Statement_))
tableDefinition env name written = do
  checked <- defining name (Value (region name) . fst) (Piece.table env name tableLines)
  pure ((\(_, columns) sol -> Checked.Table name (columns sol)) <$> checked)
  where
    tableLines = case written of
      Surface.WrittenLines ls -> ls
      _ -> []

-- | Checks the definition of a piece, and binds its name. "Checked.Piece" defines this term.
pieceDefinition ::
  TypingEnvironment ->
  Located Name ->
  Surface.Expr ->
  [Surface.Cipher] ->
  Located Surface.Side ->
  [Surface.Joggle] ->
  Infer (Maybe (Deferred Checked.Statement_))
pieceDefinition env name e ciphers side joggles = do
  checked <- defining name (Value (region name) . fst) $ do
    (t, e') <- curve env e
    columns <- Column.ofCurve t
    ciphers' <- catMaybes <$> mapM (Piece.cipher env columns) ciphers
    joggles' <- mapM (Piece.joggle env) joggles
    pure (t, (e', ciphers', joggles'))
  let make (_, (e', ciphers', joggles')) sol =
        Checked.Piece name (e' sol) (resolveAll sol ciphers') side (resolveAll sol joggles')
  pure (make <$> checked)

-- | Checks an expression that must be a curve. Then solves all pending constraints, so that the
-- columns of the curve's table become known.
curve :: TypingEnvironment -> Surface.Expr -> Infer (Type, Deferred Checked.Expr)
curve env e = do
  t <- Type.Curve <$> Inference.freshType
  e' <- expect env t e
  Inference.settle
  pure (t, e')

-- | Runs @inside@, which checks a definition, and binds the name to the binding that @bindingOf@
-- makes of the result. If the name is bound already, the first binding remains. If the definition
-- contains a mistake, the name is poisoned, and the result is 'Nothing'.
defining :: Located Name -> (a -> Binding) -> Infer a -> Infer (Maybe a)
defining name bindingOf inside = do
  checked <- Inference.separately (reportTaken name *> inside)
  already <- Inference.find (value name)
  case already of
    -- A name with two definitions has no type, so that its uses are not reported too.
    Just (Local _ _) -> pure ()
    Just _ -> Inference.define (value name) (Poisoned (region name))
    Nothing -> do
      let binding = maybe (Poisoned (region name)) bindingOf checked
      Inference.define (value name) binding
      mapM_ (mentionDefinition name) (meaningOf binding)
  pure checked

-- | Reports a name that a definition above has already, or that belongs to the language. Does not
-- report the name of a variable of a surrounding @for@.
reportTaken :: Located Name -> Infer ()
reportTaken located@(Located at name) = do
  binding <- Inference.find name
  case binding of
    Just (Value before _) -> Inference.mistake (DefinedTwice at name before unwritten [])
    Just (Function before _ _) -> Inference.mistake (DefinedTwice at name before unwritten [])
    Just (Poisoned before) -> Inference.mistake (DefinedTwice at name before unwritten [])
    Just (Local _ _) -> pure ()
    Nothing -> pure ()
  reportBuiltin located

-- | Reports a name that belongs to the language.
reportBuiltin :: Located Name -> Infer ()
reportBuiltin (Located at name@(Name text)) =
  when (isBuiltin text) (Inference.mistake (NameTaken at name unwritten []))

-- | Records the mention of a name in its definition, for editors.
mentionDefinition :: Located Name -> Inference.Meaning -> Infer ()
mentionDefinition (Located at (Name text)) = Inference.mention at (Just at) text

-- | The meaning of a bound name for editors. 'Nothing' for a poisoned name, of which nothing is
-- known.
meaningOf :: Binding -> Maybe Inference.Meaning
meaningOf binding = case binding of
  Value _ t -> Just (Inference.Valued t)
  Local _ t -> Just (Inference.Valued t)
  Function _ parameters scheme -> Just (Inference.Callable parameters scheme)
  Poisoned _ -> Nothing

-- Settings, motions and commands

-- | Checks an expression that must be a point, a list of points or a table. The result has the
-- further columns of the table, with the types of their cells.
pointOrPoints ::
  TypingEnvironment -> Surface.Expr -> Infer ([(Located Text, Type)], Deferred Checked.Expr)
pointOrPoints env e = case value e of
  Surface.List es -> ([],) . snd <$> listOf env (region e) (Just Type.aPoint) es
  _ -> do
    (t, e') <- infer env e
    rows <- Column.ofRows t
    t' <- Inference.resolved t
    case (rows, t') of
      (Just _, _) -> pure ()
      (Nothing, Type.Spatial _) -> fit Type.aPoint e t
      (Nothing, Type.Circle) -> fit Type.aPoint e t
      (Nothing, _) -> fit (Type.ListOf Type.aPoint) e t
    pure (concat rows, e')

-- | Checks the outline of a machining statement or of a solid: a contour, a region or a circle.
outlined :: TypingEnvironment -> Surface.Expr -> Infer (Deferred Checked.Expr)
outlined env e = do
  (t, e') <- infer env e
  found <- Inference.resolved t
  unless (found `elem` [Type.PlaneRegion, Type.Circle]) (fit Type.Contour e t)
  pure e'

-- | Checks a machining statement. @keyword@ is its first word, @e@ the check of its contour, and
-- @options@ are the settings in its block. @make@ builds the checked statement.
machining ::
  TypingEnvironment ->
  (Checked.Expr -> Located Surface.Side -> Checked.Settings -> Checked.Statement_) ->
  Text ->
  Infer (Deferred Checked.Expr) ->
  Located Surface.Side ->
  [Surface.Setting] ->
  Infer (Deferred Checked.Statement_)
machining env make keyword e side options =
  (\e' o sol -> make (e' sol) side (o sol))
    <$> e
      <*> Settings.check env keyword options

-- | Gives a stop of a @rapid@ statement the rapid speed, unless the stop has a feed of its own. A
-- stop is the point at which a move without cutting ends.
atPace :: Surface.DefaultPace -> Surface.Stop -> Surface.Stop
atPace motion s = case (motion, Surface.pace s) of
  (Surface.RapidMotion, Surface.Cutting) -> s {Surface.pace = Surface.Rapid}
  _ -> s

-- | Checks a size of a hole. The depth may name the columns of the table of points, and so may the
-- diameter of a mouth that is made by a pointed tool.
holeSize ::
  TypingEnvironment ->
  Surface.HoleWork ->
  [(Located Text, Type)] ->
  (Surface.HoleSize, Surface.Expr) ->
  Infer (Surface.HoleSize, Deferred Checked.Expr)
holeSize env work columns (size, e) =
  (size,) <$> Column.inScope visible (expect env sizeType e)
  where
    sizeType = if size == Surface.HoleAngle then Type.angle else Type.len
    visible = if HoleForm.isByRow work size then columns else []

-- | Checks the region of a body and the heights of its bottom and of its top.
solid ::
  TypingEnvironment ->
  (Checked.Expr -> Maybe (Checked.Expr, Checked.Expr) -> a) ->
  Surface.Expr ->
  Maybe (Surface.Expr, Surface.Expr) ->
  Infer (Deferred a)
solid env make e zs =
  (\e' zs' sol -> make (e' sol) ((\(a, b) -> (a sol, b sol)) <$> zs'))
    <$> outlined env e
      <*> traverse (\(a, b) -> (,) <$> expect env Type.len a <*> expect env Type.len b) zs

tolerance :: TypingEnvironment -> Surface.Accuracy -> Infer (Deferred Checked.Accuracy)
tolerance env accuracy = case accuracy of
  Surface.Within e -> (Checked.Within .) <$> expect env Type.len e
  Surface.Between a b ->
    (\a' b' sol -> Checked.Between (a' sol) (b' sol))
      <$> expect env Type.len a <*> expect env Type.len b

spindle :: TypingEnvironment -> Surface.Spin -> Infer (Deferred Checked.Spin)
spindle env spin = case spin of
  Surface.SpindleStop -> pure (const Checked.SpindleStop)
  Surface.SpindleByHand -> pure (const Checked.SpindleByHand)
  Surface.Spinning sense (Just speed) (Just limit) -> do
    when (isBare speed) (Inference.mistake (CuttingSpeedWithoutUnit (region speed)))
    (\speed' limit' sol -> Checked.CuttingAt sense (speed' sol) (limit' sol))
      <$> expect env Type.feed speed <*> expect env Type.spindleSpeed limit
  Surface.Spinning _ (Just speed@(Located at (Surface.Literal _ (Just unit)))) Nothing
    | fst (Type.ofUnit unit) == Type.feed -> do
      Inference.mistake (CuttingSpeedWithoutLimit at)
      (\_ _ -> Checked.SpindleStop) <$> expect env Type.feed speed
  Surface.Spinning sense speed _ -> do
    speed' <- traverse (expect env Type.spindleSpeed) speed
    pure (\sol -> Checked.Spinning sense (($ sol) <$> speed'))
  where
    isBare e = case value e of
      Surface.Literal _ Nothing -> True
      _ -> False
