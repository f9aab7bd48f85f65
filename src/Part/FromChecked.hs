-- | Evaluation: the checked program into the exact geometry of the part.
module Part.FromChecked
  ( evaluate,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.Quantity (Feed, Mm (..), Rad (..), over, times)
import Base.Region (Located (..), Region (Region))
import Base.Result (Result (..))
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Applicative ((<|>))
import Control.Monad (when)
import Data.List (foldl')
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Part.Builtin qualified as Builtin
import Part.ContourElement qualified as ContourElement
import Part.Curve (Fitting, PartCurve (..))
import Part.Error (Error (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment (..))
import Part.Expression qualified as Expression
import Part.Part hiding (spot)
import Part.Piece qualified as Piece
import Part.PocketCheck qualified as PocketCheck
import Part.PocketError (PocketMisfit (StepTooWide))
import Part.Transformation qualified as Transformation
import Part.Value (Value (..))
import Part.Value qualified as Value

-- | What is known between two statements. A setting without a value is missing because of a
-- mistake.
data State = State
  { environment :: Environment,
    -- | with which the program begins
    first' :: Maybe Cutter,
    cutter' :: Maybe Cutter,
    tolerance' :: Maybe Accuracy,
    feed' :: Maybe (Located Feed),
    clearance' :: Maybe Mm,
    spin' :: Sense,
    start' :: Maybe (Located SpacePoint),
    contours' :: [Contour],
    operations' :: [Operation],
    values' :: [(Region, Text)],
    fittings' :: [(Located Name, Fitting)],
    errors' :: [Error],
    fuel :: Int
  }

-- | Evaluate a program. What depends on a mistake is left out.
evaluate :: Checked.Program -> Result w Error Part
evaluate
  Checked.Program
    { Checked.name = called,
      Checked.title = titled,
      Checked.machine = wanted,
      Checked.statements = statements
    } =
    Result {warnings = [], errors = reverse (errors' final), output = Just part}
    where
      final = foldl' step begin statements
      begin =
        State
          { environment = Expression.empty,
            first' = Nothing,
            cutter' = Nothing,
            tolerance' = Nothing,
            feed' = Nothing,
            clearance' = Nothing,
            spin' = Clockwise,
            start' = Nothing,
            contours' = [],
            operations' = [],
            values' = [],
            fittings' = [],
            errors' = [],
            fuel = Evaluation.mostSteps
          }
      part =
        Part
          { name = called,
            title = titled,
            machine = wanted,
            start = start' final,
            firstCutter = first' final,
            contours = reverse (contours' final),
            operations = reverse (operations' final),
            fittings = reverse (fittings' final),
            readings = values' final
          }

step :: State -> Checked.Statement -> State
step state (Located at s) = case s of
  Checked.Tool c -> keep (cutter env c) (\c' -> state {first' = Just c', cutter' = Just c'})
  Checked.Feed e -> keep (ContourElement.feedOf env e) (\f -> state {feed' = Just f})
  Checked.Tolerance accuracy -> keep (accuracyOf env accuracy) (\t -> state {tolerance' = Just t})
  Checked.Clearance e ->
    keep (ContourElement.lengthOf env "the clearance height" e) (\z -> state {clearance' = Just z})
  Checked.From e -> keep (spot env e) (\p -> state {start' = Just (Located at p)})
  Checked.LetValue name d e -> keep (Expression.evaluate env e) (define name d)
  Checked.LetFunction name parameters body ->
    state
      { environment =
          env
            { functions = Map.insert name (locals env, parameters, body) (functions env),
              locals = Map.delete name (locals env)
            }
      }
  Checked.Table name columns ->
    keep (Piece.table env columns) (define name Dimension.none . TableValue)
  Checked.Piece name e ciphers side joggles ->
    keep
      (Expression.evaluate env e >>= \v -> Piece.piece env (curveOf v) ciphers side joggles)
      (define name Dimension.none . CurveValue)
  Checked.Contour name closure items ->
    keep (ContourElement.contour env name closure items) $ \c ->
      (define name Dimension.none (ContourValue c)) {contours' = c : contours' state}
  Checked.Assert assertion -> keep (assert at env assertion) (const state)
  Checked.Mill e side settings ->
    keep (milling state Milled at e side settings) (perform . maybe id ((:) . Mill . Located at))
  Checked.Pocket e step' settings ->
    keep (pocketing state at e step' settings) (perform . maybe id ((:) . Pocket . Located at))
  Checked.Turn e side settings ->
    keep (milling state Turned at e side settings) (perform . maybe id ((:) . Mill . Located at))
  Checked.Drill points depth settings ->
    keep (drilling state at points depth settings) (perform . maybe id ((:) . Drill . Located at))
  Checked.Travel stops ->
    keep (stopsOf state (NonEmpty.toList stops)) $ \ps -> case NonEmpty.nonEmpty =<< ps of
      Just some -> perform (Travel some :)
      Nothing -> state
  Checked.Change e c ->
    keep ((,) <$> whole env "the number of a tool" (1, 99) e <*> cutter env c) $ \(n, c') ->
      (perform (Command (Located at (ChangeTool n c')) :)) {cutter' = Just c'}
  Checked.Spindle Checked.Still -> perform (Command (Located at SpindleOff) :)
  Checked.Spindle (Checked.Spinning walk speed) ->
    keep
      ( traverse
          ( ContourElement.positive
              env
              "the speed of the spindle"
              (\x -> Decimal.short 4 x <> " rpm")
              id
          )
          speed
      )
      $ \speed' ->
        (perform (Command (Located at (SpindleOn walk speed')) :)) {spin' = walk}
  Checked.Coolant switch -> perform (Command (Located at (CoolantTo switch)) :)
  Checked.Auxiliary e ->
    keep
      (whole env "an auxiliary command" (1, 99) e)
      (\n -> perform (Command (Located at (Auxiliary n)) :))
  Checked.Repeat name list body ->
    blocked
      ( Expression.evaluate env list >>= \v ->
          Expression.items v <$ Evaluation.spend (region list) (length (Expression.items v))
      )
      $ \vs now ->
        foldl
          (\before v -> foldl step before {environment = Expression.bind name v env} body)
          now
          vs
  Checked.When e body others ->
    blocked
      (Expression.evaluate env e)
      (\v now -> foldl step now (if Expression.isTrue v then body else others))
  Checked.With e body -> blocked (Expression.evaluate env e) $ \v now ->
    let inside = foldl step now {operations' = []} body
     in inside
          { operations' =
              map (Transformation.operation (placement v)) (operations' inside)
                <> operations' state
          }
  where
    env = environment state
    define name d v =
      state
        { environment = bound name v,
          values' = (region name, Expression.written d v) : values' state,
          fittings' =
            [(name, f) | CurveValue PartCurve {fitting = Just f} <- [v]] <> fittings' state
        }
    bound name v =
      env
        { values = Map.insert (value name) v (values env),
          locals = Map.delete (value name) (locals env)
        }
    perform f = state {operations' = f (operations' state)}
    -- What was defined in a block is forgotten behind it.
    back after = after {environment = env}
    keep answer f = kept answer (\a left -> (f a) {fuel = left})
    -- A block goes on with the steps that are left, and takes its own.
    blocked answer f = kept answer (\a left -> back (f a state {fuel = left}))
    kept answer f =
      case Evaluation.run (fuel state) (Evaluation.spend at statementSteps *> answer) of
        (Left found, left) -> state {errors' = reverse found <> errors' state, fuel = left}
        (Right a, left) -> f a left

-- | What a statement costs besides its expressions.
statementSteps :: Int
statementSteps = 5

-- Values

placement :: Value -> Transformation
placement v = case v of
  PlacementValue s -> s
  _ -> bug "a value that is no transformation where one was checked"

curveOf :: Value -> PartCurve
curveOf v = case v of
  CurveValue c -> c
  _ -> bug "a value that is no curve where one was checked"

spot :: Environment -> Expr -> Eval SpacePoint
spot env e = spotOf <$> Expression.evaluate env e

spotOf :: Value -> SpacePoint
spotOf v = case v of
  SpaceValue p z -> SpacePoint p z
  _ -> SpacePoint (Expression.point v) (Mm 0)

-- | A whole number within limits.
whole :: Environment -> Text -> (Int, Int) -> Expr -> Eval Int
whole env what (low, high) e = do
  x <- Expression.number <$> Expression.evaluate env e
  let n = if abs x > 1e8 then -1 else round x :: Int
  when (abs (x - fromIntegral n) > Tolerance.equal || n < low || n > high) $
    Evaluation.mistake
      (NotWhole (region e) what ("from " <> Decimal.whole low <> " to " <> Decimal.whole high) x)
  pure n

accuracyOf :: Environment -> Checked.Accuracy -> Eval Accuracy
accuracyOf env accuracy = case accuracy of
  Checked.Within e -> OnPath <$> ContourElement.lengthOf env "the tolerance" e
  Checked.Between a b -> do
    inside <- notNegative a
    outside <- notNegative b
    if inside <= Mm 0 && outside <= Mm 0
      then Evaluation.mistake (NotPositive (region b) "the tolerance on one side at least" "0 mm")
      else pure (Band inside outside)
  where
    notNegative e = do
      x <- Expression.number <$> Expression.evaluate env e
      when (x < 0) (Evaluation.mistake (Negative (region e) "the tolerance" (Decimal.mm (Mm x))))
      Mm x <$ Value.within (region e) x

cutter :: Environment -> Checked.Cutter -> Eval Cutter
cutter env (Located _ c) = case c of
  Checked.MillCutter e ->
    Cutter MillingCutter . times 0.5 <$> ContourElement.lengthOf env "the cutter's diameter" e
  Checked.DrillCutter e ->
    Cutter DrillingCutter . times 0.5 <$> ContourElement.lengthOf env "the drill's diameter" e
  -- The flank of a cone touches what is H high at @a = R + H·tan μ@ from the axis (Kolsanova,
  -- section 3).
  Checked.ConeCutter e lean h -> do
    Mm d <- ContourElement.lengthOf env "the cutter's diameter" e
    mu <- Expression.number <$> Expression.evaluate env lean
    Mm height' <- ContourElement.lengthOf env "the height of the flank" h
    when (abs mu >= pi / 2 - 1e-6) (Evaluation.mistake (SteepBevel (region lean) Nothing (Rad mu)))
    let a = d / 2 + height' * tan mu
    when
      (a <= 0)
      ( Evaluation.mistake
          (NotPositive (region lean) "the radius of the cutter at this height" (Decimal.mm (Mm a)))
      )
    pure (Cutter (if mu < 0 then DovetailCutter else ConeCutter) (Mm a))
  Checked.BladeCutter e g -> do
    d <- ContourElement.lengthOf env "the blade's diameter" e
    wheel <- ContourElement.lengthOf env "the diameter of the wheel" g
    pure (Cutter (BladeCutter wheel) (times 0.5 d))
  Checked.TurningCutter e -> do
    x <- Expression.number <$> Expression.evaluate env e
    when
      (x < 0)
      (Evaluation.mistake (Negative (region e) "the radius of the nose" (Decimal.mm (Mm x))))
    pure (Cutter TurningCutter (Mm x))

-- | Compare what the program says has to hold.
assert :: Region -> Environment -> Checked.Assertion -> Eval ()
assert at env assertion = case assertion of
  Checked.Holds e -> do
    v <- Expression.evaluate env e
    if Expression.isTrue v then pure () else Evaluation.mistake (DoesNotHold (region e) [])
  Checked.Compares d whole' op l r -> do
    a <- Expression.evaluate env l
    b <- Expression.evaluate env r
    v <- Builtin.binary whole' op a b
    if Expression.isTrue v
      then pure ()
      else
        Evaluation.mistake
          ( DoesNotHold
              whole'
              [(region l, Expression.written d a), (region r, Expression.written d b)]
          )
  Checked.Agrees d l r within -> do
    a <- Expression.number <$> Expression.evaluate env l
    b <- Expression.number <$> Expression.evaluate env r
    slack <- maybe (pure assertSlack) (fmap Expression.number . Expression.evaluate env) within
    if abs (a - b) <= slack + Tolerance.equal
      then pure ()
      else
        Evaluation.mistake
          ( DoNotAgree
              at
              (region l, written d a)
              (region r, written d b)
              (written d (abs (a - b)))
              (written d slack)
          )
  where
    assertSlack = 1e-6
    written :: Dimension -> Double -> Text
    written d x = Expression.written d (Quantity x)

-- Machining

-- | Nothing when a setting is missing because of a mistake that is reported already.
milling ::
  State ->
  Work ->
  Region ->
  Expr ->
  Located Side ->
  Checked.Settings ->
  Eval (Maybe Milling)
milling state work at e side settings = do
  c <- Expression.evaluate env e
  mapM_
    ( case work of
        Milled ->
          rightCutter at "mill" "a mill" isMill
        Turned -> rightCutter at "turn" "a turning tool" (== TurningCutter)
    )
    (cutter' state)
  before <- stopsOf state (Checked.approach settings)
  after <- stopsOf state (Checked.retract settings)
  near <- traverse (fmap Expression.point . Expression.evaluate env) (Checked.startNear settings)
  case (c, Checked.startNear settings) of
    (ContourValue contour, Just place)
      | ends contour == Open ->
        Evaluation.mistake (OpenBegins (region place) (value (contourName contour)))
    _ -> pure ()
  levels <- maybe (pure []) (levelsOf env) (Checked.depth settings)
  mapM_
    ( \c' ->
        when
          (kind c' == DovetailCutter && length levels > 1)
          (Evaluation.mistake (StepsUndercut (maybe at (region . fst) (Checked.depth settings))))
    )
    (cutter' state)
  plunge <- traverse (ContourElement.feedOf env) (Checked.plunge settings)
  leadIn <- traverse lead (Checked.leadIn settings)
  leadOut <- traverse lead (Checked.leadOut settings)
  allowances <-
    maybe (pure (Mm 0 :| [])) (Evaluation.gather . fmap allowance) (Checked.allowances settings)
  pure $ do
    tool <- cutter' state
    tolerance <- tolerance' state
    feed <- feed' state
    approach <- before
    retract <- after
    -- Without a clearance height, which is reported, no way is right.
    _ <- if null levels then Just (Mm 0) else clearance' state
    case c of
      ContourValue contour ->
        Just
          Milling
            { contour =
                maybe
                  contour
                  ( \p ->
                      if ends contour == Closed
                        then ContourElement.startingNear p contour
                        else contour
                  )
                  near,
              work,
              side,
              radius = cutterRadius tool,
              gear = case kind tool of BladeCutter wheel -> Just wheel; _ -> Nothing,
              tolerance,
              feed,
              approach,
              retract,
              levels,
              clearance = clearance' state,
              plunge,
              leadIn,
              leadOut,
              allowances,
              corners = Checked.corners settings,
              sense = Checked.sense settings,
              spin = spin' state,
              byControl,
              rest = maybe Refused (const Allowed) (Checked.restAllowed settings)
            }
      _ -> bug "a value that is no contour where one was checked"
  where
    env = environment state
    byControl = case Checked.compensation settings of
      Just (Located asked Checked.ByController) -> Just asked
      Just (Located _ Checked.ByCompiler) -> Nothing
      Nothing -> Nothing
    lead (form, x) = (form,) <$> ContourElement.lengthOf env "the lead" x
    allowance x = do
      v <- Expression.number <$> Expression.evaluate env x
      when (v < 0) (Evaluation.mistake (Negative (region x) "the allowance" (Decimal.mm (Mm v))))
      Mm v <$ Value.within (region x) v

-- | A pocket: its outline milled inside, and islands. Nothing as for 'milling'.
pocketing :: State -> Region -> Expr -> Expr -> Checked.Settings -> Eval (Maybe Pocketing)
pocketing state at e step' settings = do
  mapM_ (rightCutter at "pocket" "a mill" (== MillingCutter)) (cutter' state)
  wall <- milling state Milled at e (Located (region e) Inside) settings
  outline' <- contourAt e <$> Expression.evaluate env e
  islands <-
    concat
      <$> Evaluation.gather
        (map (\i -> namedIn i <$> Expression.evaluate env i) (Checked.islands settings))
  apart <- ContourElement.lengthOf env "the step from pass to pass" step'
  Evaluation.spend at (sum [length (elements (PocketCheck.contour c)) | c <- outline' : islands])
  let count = over (PocketCheck.halfWidth outline') apart
  when
    (count > 10000)
    ( Evaluation.mistake
        ( NotWhole
            (region step')
            "the number of passes"
            "up to 10000"
            (fromIntegral (ceiling (min 1e9 count) :: Int))
        )
    )
  case [ Error (NoPocket m) []
         | m <-
             PocketCheck.misfits outline' islands
               <> [ StepTooWide (region step') apart d
                    | Just d <- [times 2 . cutterRadius <$> cutter' state],
                      apart > d
                  ]
       ] of
    [] ->
      pure ((\w -> Pocketing {wall = w, islands = map PocketCheck.contour islands, apart}) <$> wall)
    found -> Evaluation.mistakes found
  where
    env = environment state
    contourAt i v = case v of
      ContourValue c -> PocketCheck.Named (region i) c
      _ -> bug "a value that is no contour where one was checked"
    namedIn i v = case v of
      ListValue vs -> map (contourAt i) (Vector.toList vs)
      _ -> [contourAt i v]

-- | The heights of the passes: equal ones, none deeper than is asked.
levelsOf :: Environment -> (Expr, Maybe Expr) -> Eval [Mm]
levelsOf env (depth, most) = do
  d <- ContourElement.lengthOf env "the depth" depth
  step' <- traverse (ContourElement.lengthOf env "the depth of a pass") most
  let count = maybe 1 (\s -> max 1 (ceiling (over d s - Tolerance.equal))) step' :: Int
  when
    (count > 10000)
    ( Evaluation.mistake
        (NotWhole (region depth) "the number of passes" "up to 10000" (fromIntegral count))
    )
  pure [times (negate (fromIntegral k / fromIntegral count)) d | k <- [1 .. count]]

drilling :: State -> Region -> Expr -> Expr -> Checked.Settings -> Eval (Maybe Drilling)
drilling state at points depth settings = do
  v <- Expression.evaluate env points
  mapM_
    (rightCutter at "drill" "a drill or a mill" (`elem` [DrillingCutter, MillingCutter]))
    (cutter' state)
  Mm d <- ContourElement.lengthOf env "the depth" depth
  pecked <- traverse (ContourElement.lengthOf env "the depth of a peck") (Checked.peck settings)
  plunge <- traverse (ContourElement.feedOf env) (Checked.plunge settings)
  let places' = case v of
        ListValue vs -> Vector.length vs
        _ -> 1
      pecks = maybe 1 (\(Mm p) -> ceiling (min 1e9 (d / p) - Tolerance.equal)) pecked :: Int
  when
    (pecks > 1000)
    ( Evaluation.mistake
        (NotWhole (region depth) "the number of pecks" "up to 1000" (fromIntegral pecks))
    )
  Evaluation.spend at (places' * pecks)
  let places = case v of
        ListValue vs -> map Expression.point (Vector.toList vs)
        _ -> [Expression.point v]
  case NonEmpty.nonEmpty places of
    Nothing -> Evaluation.mistake (NothingToDrill (region points))
    Just some -> pure $ do
      tool <- cutter' state
      drillFeed <- plunge <|> feed' state
      clear <- clearance' state
      Just
        Drilling
          { holes = fmap (Located (region points)) some,
            drillRadius = cutterRadius tool,
            bottom = Mm (-d),
            clear,
            pecked,
            drillFeed
          }
  where
    env = environment state

-- | A statement needs a cutter of a kind, which is said in words.
rightCutter :: Region -> Text -> Text -> (CutterKind -> Bool) -> Cutter -> Eval ()
rightCutter at statement needed isRight c
  | isRight (kind c) = pure ()
  | otherwise = Evaluation.mistake (WrongCutter keyword statement needed there)
  where
    Region begin _ = at
    keyword = Region begin (begin + Text.length statement)
    there = case kind c of
      MillingCutter -> "a mill"
      ConeCutter -> "a cone"
      DovetailCutter -> "a cone"
      BladeCutter _ -> "a blade that swivels"
      DrillingCutter -> "a drill"
      TurningCutter -> "a turning tool"

-- | Whether a cutter cuts with its flank along a contour.
isMill :: CutterKind -> Bool
isMill cutterKind = case cutterKind of
  MillingCutter -> True
  ConeCutter -> True
  DovetailCutter -> True
  BladeCutter _ -> True
  DrillingCutter -> False
  TurningCutter -> False

stopsOf :: State -> [Checked.Stop] -> Eval (Maybe [Stop])
stopsOf state stops = fmap sequence (Evaluation.gather (map stop stops))
  where
    env = environment state
    stop (Checked.Stop p pace') = do
      v <- Expression.evaluate env p
      pace'' <- case pace' of
        Checked.Cutting -> pure (At <$> feed' state)
        Checked.Rapid -> pure (Just Rapid)
        Checked.AtFeed e -> Just . At <$> ContourElement.feedOf env e
      let SpacePoint place _ = spotOf v
          level = case v of
            SpaceValue _ z -> Just z
            _ -> Nothing
      pure (Stop (Located (region p) place) level <$> pace'')
