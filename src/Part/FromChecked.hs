-- | Evaluates a checked program to the exact geometry of the part and its operations.
--
-- Statements are evaluated in order. A statement with a mistake is left out, and so is everything
-- that depends on it. The remaining statements give a part that later compiler passes can check.
module Part.FromChecked
  ( evaluate,
  )
where

import Base.Crash (bug)
import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Checked.Builtin qualified as Builtin
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Monad (mfilter)
import Data.List (foldl', sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isJust)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Vector qualified as Vector
import Geometry.Carrier (Circle (Circle))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Geometry
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Assertion qualified as Assertion
import Part.Body qualified as Body
import Part.BodyError (BodyMistake (SafeBelowSolid))
import Part.Carving qualified as Carving
import Part.ContourElement qualified as ContourElement
import Part.Curve (Fitting, PartCurve (..))
import Part.CutFeed (SpindleRate (..))
import Part.Engraving qualified as Engraving
import Part.Error (Error (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment (..), Turn)
import Part.Expression qualified as Expression
import Part.FaceMilling qualified as FaceMilling
import Part.HoleMachining qualified as HoleMachining
import Part.Lettering (KnownLetters)
import Part.Lettering qualified as Lettering
import Part.Machining (Context (..))
import Part.Machining qualified as Machining
import Part.Measure (feedOf, lengthOf, positive, secondsOf, whole)
import Part.Parameter qualified as Parameter
import Part.Part
import Part.Piece qualified as Piece
import Part.PlaneRegion qualified as PlaneRegion
import Part.RestMachining qualified as RestMachining
import Part.Transformation qualified as Transformation
import Part.Value (MachinedBefore (..), NamedOperation (..), Value (..))

-- | The state of evaluation between two statements. All lists are in reverse order.
data State = State
  { context :: Context,
    -- | the cutter that the program sets before its first tool change
    initialCutter :: Maybe Cutter,
    -- | the number of this cutter
    initialNumber :: Maybe (Located Int),
    offset' :: Maybe (Located Int),
    number' :: Maybe (Located Int),
    safe' :: Maybe (Located Mm),
    stock' :: Maybe (Located Solid),
    avoided' :: [Located Solid],
    -- | the highest clearance height so far
    highestClearance :: Maybe (Located Mm),
    start' :: Maybe (Located SpacePoint),
    contours' :: [Contour],
    -- | the letters of texts in fonts so far
    letters' :: KnownLetters,
    operations' :: [Operation],
    readings' :: [(Region, Text)],
    namedPoints' :: [(Located Name, Point)],
    fittings' :: [(Located Name, Fitting)],
    sizes' :: [AssertedSize],
    errors' :: [Error],
    -- | the number of evaluation steps that are left; a step is the unit of work in
    -- "Part.Evaluation"
    fuel :: Int
  }

-- | Evaluates a program. The output is always present, but lacks the statements with mistakes.
evaluate :: Checked.Program -> Result w Error Part
evaluate program =
  Result {warnings = [], errors = reverse (errors' final) <> lowSafeHeights, output = Just part}
  where
    lowSafeHeights = lowSafeHeight final
    final = foldl' step (initial (Checked.unit program)) (Checked.statements program)
    part =
      Part
        { name = Checked.name program,
          title = Checked.title program,
          machine = Checked.machine program,
          unit = Checked.unit program,
          start = start' final,
          firstCutter = initialCutter final,
          firstToolNumber = initialNumber final,
          workOffset = offset' final,
          programNumber = number' final,
          safeHeight = safe' final,
          stock = stock' final,
          avoided = reverse (avoided' final),
          contours = reverse (contours' final),
          operations = map (under (stock' final)) (reverse (operations' final)),
          fittings = reverse (fittings' final),
          assertedSizes = reverse (sizes' final),
          readings = readings' final,
          namedPoints = reverse (namedPoints' final)
        }

-- | An operation whose material begins at the top of the stock, if that is above the part.
under :: Maybe (Located Solid) -> Operation -> Operation
under stock operation = case (stock, operation) of
  (Just (Located _ s), Mill (Located r m)) -> Mill (Located r (m `from` s))
  (Just (Located _ s), Pocket (Located r p)) -> Pocket (Located r p {wall = wall p `from` s})
  _ -> operation
  where
    above s = max (Mm 0) (highest s)
    m `from` s = m {materialTop = above s}

-- | The errors of a safe height that is lower than a clearance height of the program, or than a
-- solid that the program avoids.
lowSafeHeight :: State -> [Error]
lowSafeHeight final =
  [ Error fault [] []
    | Just (Located at safe) <- [safe' final],
      fault <-
        [ SafeTooLow at safe (place, clearance)
          | Just (Located place clearance) <- [highestClearance final],
            safe < clearance
        ]
          <> [ InBody (SafeBelowSolid at safe there (highest s))
               | Located there s <- take 1 (sortOn (negate . top) (avoided' final)),
                 safe < highest s,
                 highest s < Tolerance.reach
             ]
  ]
  where
    top (Located _ s) = let Mm z = highest s in z

-- | The state before the first statement. @inUnit@ is the unit of lengths in texts of values.
initial :: LengthUnit -> State
initial inUnit =
  State
    { context =
        Context
          { environment = Expression.empty inUnit,
            cutter = Nothing,
            chordError = Nothing,
            modalFeed = Nothing,
            clearanceHeight = Nothing,
            modalSense = Clockwise,
            modalRate = NoRate,
            scaledBy = 1
          },
      initialCutter = Nothing,
      initialNumber = Nothing,
      offset' = Nothing,
      number' = Nothing,
      safe' = Nothing,
      stock' = Nothing,
      avoided' = [],
      highestClearance = Nothing,
      start' = Nothing,
      contours' = [],
      letters' = Map.empty,
      operations' = [],
      readings' = [],
      namedPoints' = [],
      fittings' = [],
      sizes' = [],
      errors' = [],
      fuel = Evaluation.mostSteps
    }

-- | Evaluates one statement.
step :: State -> Checked.Statement -> State
step state (Located at s) = case s of
  Checked.Tool n c ->
    keep ((,) <$> traverse (toolNumber env) n <*> Machining.cutterOf env c) $ \(n', c') ->
      (changed c') {initialCutter = Just c', initialNumber = n'}
  Checked.Feed e -> keep (feedOf env e) (\f -> set now {modalFeed = Just f})
  Checked.Tolerance accuracy ->
    keep (Machining.accuracyOf env accuracy) (\t -> set now {chordError = Just t})
  Checked.Clearance e ->
    keep (lengthOf env Parameter.ClearanceHeight e) (withClearance state . Located (region e))
  Checked.From e ->
    keep
      (Machining.spacePoint <$> Expression.evaluate env e)
      (\p -> state {start' = Just (Located at p)})
  Checked.WorkOffset e ->
    keep (whole env Parameter.WorkOffset (54, 59) e) $ \n ->
      state {offset' = Just (Located (region e) n)}
  Checked.ProgramNumber e ->
    keep (whole env Parameter.ProgramNumber (1, 9999) e) $ \n ->
      state {number' = Just (Located (region e) n)}
  Checked.SafeHeight e ->
    keep (lengthOf env Parameter.SafeHeight e) (\z -> state {safe' = Just (Located (region e) z)})
  Checked.Stock e zs ->
    keep (Body.solid env e zs) (\b -> state {stock' = Just (Located at b)})
  Checked.Avoid e zs ->
    keep (Body.solid env e zs) (\b -> state {avoided' = Located at b : avoided' state})
  Checked.LetValue name d e ->
    keep (named env name <$> Expression.evaluate env e) $ \v ->
      drawn env e v (define state name d v)
  Checked.LetFunction name parameters body -> defineFunction state name parameters body
  Checked.Table name columns ->
    keep (Piece.table env columns) (define state name Dimension.none . TableValue)
  Checked.Piece name e ciphers side joggles ->
    keep
      (Expression.evaluate env e >>= \v -> Piece.piece env (curveOf v) ciphers side joggles)
      (define state name Dimension.none . CurveValue)
  Checked.Contour name closure items ->
    keep (ContourElement.contour env name closure items) $ \c ->
      (define state name Dimension.none (ContourValue c)) {contours' = c : contours' state}
  Checked.Letters name place shapes ->
    keep (Lettering.evaluate env (letters' state) name place shapes) $ \(known, outlines, r) ->
      let defined = define state name Dimension.none (RegionValue r)
          drawn' = reverse (outlines <> PlaneRegion.contoursOf r)
       in defined {contours' = drawn' <> contours' state, letters' = known}
  Checked.Assert assertion ->
    keep
      (Assertion.check at env assertion *> Assertion.sizes env assertion)
      (\found -> state {sizes' = reverse found <> sizes' state})
  Checked.Mill e side settings ->
    keep (Machining.milling now Milled at e side settings) (eachPerformed Mill)
  Checked.Pocket e stepover own settings ->
    keep (Machining.pocketing now at e stepover settings) $ \found ->
      nameOperation
        at
        own
        (Pockets <$> mfilter (not . null) found)
        (eachPerformed Pocket found)
  Checked.RestOf e stepover settings ->
    keep (RestMachining.restOf now at e stepover settings) (eachPerformed Pocket)
  Checked.Face e stepover settings ->
    keep
      (FaceMilling.facing now (highest . value <$> stock' state) at e stepover settings)
      (eachPerformed Pocket)
  Checked.Engrave text settings ->
    keep (Engraving.engraving now at text settings) (eachPerformed Mill)
  Checked.Vcarve e own settings ->
    keep (Carving.carving now at e settings) $ \found ->
      nameOperation at own (Carved <$> found) (performed Carve found)
  Checked.Turn e side settings ->
    keep (Machining.milling now Turned at e side settings) (eachPerformed Mill)
  Checked.Drill points depth settings ->
    keep (HoleMachining.drilling now at points depth settings) (performed Drill)
  Checked.Hole work points sizes side settings ->
    keep (HoleMachining.holeWork now at work points (sizes, side) settings) (performed Drill)
  Checked.Travel stops ->
    keep
      (Machining.stopsOf now (NonEmpty.toList stops))
      (maybe state (perform . Travel) . (NonEmpty.nonEmpty =<<))
  Checked.Change e c place ->
    run
      withoutTool
      at
      ( (,,) <$> toolNumber env e
          <*> Machining.cutterOf env c
          <*> Machining.stopsOf now [Checked.Stop p Checked.Rapid | Just p <- [place]]
      )
      (\a left -> (toolChange state at a) {fuel = left})
  Checked.UnknownChange -> withoutTool
  Checked.Spindle Checked.SpindleStop -> (command SpindleOff) {context = now {modalRate = NoRate}}
  Checked.Spindle Checked.SpindleByHand ->
    (command SpindleByHand) {context = now {modalRate = NoRate}}
  Checked.Spindle (Checked.Spinning sense speed) ->
    keep (traverse (positive env Parameter.SpindleSpeed TurnsPerMinute) speed) $ \speed' ->
      let rate = fromMaybe NoRate speed'
       in (command (SpindleOn sense rate)) {context = now {modalSense = sense, modalRate = rate}}
  Checked.Spindle (Checked.CuttingAt sense speed limit) ->
    keep
      ( CuttingSpeed <$> positive env Parameter.CuttingSpeed id speed
          <*> positive env Parameter.SpindleSpeed id limit
      )
      ( \rate ->
          (command (SpindleOn sense rate)) {context = now {modalSense = sense, modalRate = rate}}
      )
  Checked.Coolant switch -> command (CoolantTo switch)
  Checked.Auxiliary e ->
    keep (whole env Parameter.AuxiliaryCommand (1, 99) e) (command . Auxiliary)
  Checked.ProgramStop -> command ProgramStop
  Checked.OptionalStop -> command OptionalStop
  Checked.Dwell e -> keep (secondsOf env e) (command . Dwell)
  Checked.Repeat name d list body -> within (turnsOf env list) (repeated name d body)
  Checked.When e body others ->
    within (Expression.evaluate env e) $ \v inside ->
      foldl step inside (if Expression.isTrue v then body else others)
  Checked.With e body -> within (Expression.evaluate env e) (transformed body . placement)
  where
    now = context state
    env = environment now
    set c = state {context = c}
    changed c = set now {cutter = Just c}
    -- The tool of a change with a mistake is unknown, so no statement after it is blamed for it.
    withoutTool = set now {cutter = Nothing}
    perform operation = state {operations' = operation : operations' state}
    performed make = maybe state (perform . make . Located at)
    eachPerformed make found =
      state {operations' = reverse (maybe [] (map (make . Located at)) found) <> operations' state}
    command = perform . Command . Located at
    keep answer f = run state at answer (\a left -> (f a) {fuel = left})
    within answer block =
      run state at answer (\a left -> leave state (block a state {fuel = left}))

-- Tools and heights

-- | Evaluates the number of a tool. The result keeps the region of the expression.
toolNumber :: Environment -> Expr -> Eval (Located Int)
toolNumber env e = Located (region e) <$> whole env Parameter.ToolNumber (1, 99) e

-- | The state after a tool change in the region @at@: the number of the tool, the tool, and the
-- stop at which it is changed, if the program gives one.
toolChange :: State -> Region -> (Located Int, Cutter, Maybe [Stop]) -> State
toolChange state at (Located there n, c, stops) =
  state
    { operations' = Command (Located at (ChangeTool n c)) : moves <> operations' state,
      context = (context state) {cutter = Just c},
      errors' = contradictions <> errors' state
    }
  where
    contradictions = [Error (NumberOfFirstTool there n first) [] [] | Just first <- [taken]]
    moves = [Travel some | Just some <- [NonEmpty.nonEmpty =<< stops]]
    -- The region of the number of the first tool, if it is the same number of another cutter.
    taken = case (initialNumber state, initialCutter state) of
      (Just (Located first m), Just before) | m == n && isOther before c -> Just first
      _ -> Nothing

-- | True for cutters of different kinds or sizes. The directions of the tips count if both are
-- given.
isOther :: Cutter -> Cutter -> Bool
isOther a b =
  kind a /= kind b
    || cutterRadius a /= cutterRadius b
    || tipRadius a /= tipRadius b
    || pointAngle (body a) /= pointAngle (body b)
    || or [m /= n | Just m <- [tip a], Just n <- [tip b]]

-- | The state after a clearance height.
withClearance :: State -> Located Mm -> State
withClearance state z =
  state
    { context = (context state) {clearanceHeight = Just (value z)},
      highestClearance = case highestClearance state of
        Just before | value before >= value z -> Just before
        _ -> Just z
    }

-- | Evaluates a statement. @at@ is its region, and @answer@ evaluates its expressions. @continue@
-- makes the next state from the result of @answer@ and the number of steps that are left. After a
-- mistake, the new state differs from @state@ only by more errors and fewer steps.
run :: State -> Region -> Eval a -> (a -> Int -> State) -> State
run state at answer continue =
  case Evaluation.run (fuel state) (Evaluation.spend at statementSteps *> answer) of
    (Left found, left) -> state {errors' = reverse found <> errors' state, fuel = left}
    (Right a, left) -> continue a left

-- | The number of steps that a statement takes in addition to the steps of its expressions.
statementSteps :: Int
statementSteps = 5

-- Definitions

-- | Binds a name to the value @v@, and keeps the text of the value for editors. @d@ is the
-- dimension of the numbers in @v@.
define :: State -> Located Name -> Dimension -> Value -> State
define state name d v =
  (withEnvironment state env')
    { readings' =
        [ (region name, Expression.written (Expression.textUnit env) d v)
          | not (Name.isHidden (value name))
        ]
          <> readings' state,
      fittings' =
        [(name, f) | CurveValue PartCurve {fitting = Just f} <- [v]] <> fittings' state,
      namedPoints' = [(name, p) | Just p <- [pointOf v]] <> namedPoints' state
    }
  where
    env = environment (context state)
    env' =
      env
        { values = Map.insert (value name) v (values env),
          locals = Map.delete (value name) (locals env)
        }

-- | Binds the name of a statement in the region @at@, if it has one, to what it machines. This is
-- 'Nothing' if a mistake is reported.
nameOperation :: Region -> Maybe (Located Name) -> Maybe MachinedBefore -> State -> State
nameOperation at own machined state = case (own, machined) of
  (Just name, Just before) ->
    define state name Dimension.none (OperationValue (NamedOperation at before False))
  _ -> state

-- | A value with its name on the contours that a function of the language has made. Such a contour
-- has the name of the function, unless the program has given this name to something else.
named :: Environment -> Located Name -> Value -> Value
named env name v = case v of
  ContourValue c -> ContourValue (renamed c)
  RegionValue r -> RegionValue (PlaneRegion.mapContours renamed r)
  _ -> v
  where
    renamed c = if isMade (value (contourName c)) then c {contourName = name} else c
    isMade own@(Name text) = isJust (Builtin.lookup text) && not (Map.member own (values env))

-- | Adds the contours of a region, so that it is drawn even if nothing mills it. Those of the
-- regions of which the expression @e@ makes it are no longer drawn.
drawn :: Environment -> Expr -> Value -> State -> State
drawn env e v state = case v of
  RegionValue r ->
    state
      { contours' =
          reverse (PlaneRegion.contoursOf r) <> filter (not . isOperand) (contours' state)
      }
  _ -> state
  where
    isOperand c = value (contourName c) `Set.member` operands
    operands = Set.fromList (filter isRegion (Checked.namesIn e))
    isRegion n = case Map.lookup n (values env) of
      Just (RegionValue _) -> True
      _ -> False

-- | The point that a value is, or the centre of the circle that it is.
pointOf :: Value -> Maybe Point
pointOf v = case v of
  Spatial offset -> Just (Vec.shift offset (Vec.point 0 0))
  SpaceValue p _ -> Just p
  CircleValue (Circle c _) -> Just c
  _ -> Nothing

-- | Binds a name to a function, together with the local names that its body may use.
defineFunction :: State -> Name -> NonEmpty Name -> Expr -> State
defineFunction state name parameters body =
  withEnvironment
    state
    env
      { functions = Map.insert name (locals env, parameters, body) (functions env),
        locals = Map.delete name (locals env)
      }
  where
    env = environment (context state)

withEnvironment :: State -> Environment -> State
withEnvironment state env = state {context = (context state) {environment = env}}

-- Blocks

-- | Ends a block. The result is the state @inside@, at the end of the block, but with the names of
-- the state @outside@, before the block.
leave :: State -> State -> State
leave outside inside = withEnvironment inside (environment (context outside))

-- | The turns of a statement that repeats its block. Every turn takes one step.
turnsOf :: Environment -> Expr -> Eval [Turn]
turnsOf env list = do
  turns <- Expression.evaluate env list >>= Expression.turnsOf (region list)
  turns <$ Evaluation.spend (region list) (length turns)

-- | Evaluates the block @body@ once for each of the @turns@, with the local name @name@ bound to
-- the value of this turn. Names that one repetition defines are unknown in the next one. @d@ is the
-- dimension of the numbers in the values.
repeated :: Located Name -> Dimension -> [Checked.Statement] -> [Turn] -> State -> State
repeated (Located at name) d body turns state = foldl once state turns
  where
    env = environment (context state)
    once before turn =
      let inside = Expression.bindTurn name turn env
       in foldl step (withEnvironment (kept (Expression.self turn) before) inside) body
    kept v before = before {readings' = (at, written v) : readings' before}
    written = Expression.written (Expression.textUnit env) d

-- | Evaluates the block @body@, and applies the transformation @placing@ to its operations.
transformed :: [Checked.Statement] -> Transformation -> State -> State
transformed body placing state =
  inside
    { operations' =
        map (Transformation.operation placing) (operations' inside) <> operations' state,
      avoided' =
        map (fmap (Transformation.solid placing)) (avoided' inside) <> avoided' state,
      context = (context inside) {scaledBy = scaledBy (context state)}
    }
  where
    inside = foldl step before {operations' = [], avoided' = []} body
    before = scaled (withEnvironment state outside)
    scaled s =
      s {context = (context s) {scaledBy = Geometry.factor placing * scaledBy (context s)}}
    outside = env {values = Map.map elsewhere (values env), locals = Map.map elsewhere (locals env)}
    env = environment (context state)

-- | A value inside a @with@: the operations in it are performed outside.
elsewhere :: Value -> Value
elsewhere v = case v of
  OperationValue o -> OperationValue o {isElsewhere = True}
  ListValue vs | holdsOperations v -> ListValue (Vector.map elsewhere vs)
  _ -> v
  where
    holdsOperations value' = case value' of
      OperationValue _ -> True
      ListValue vs -> any holdsOperations (vs Vector.!? 0)
      _ -> False

-- Values whose type the checker knows

placement :: Value -> Transformation
placement v = case v of
  PlacementValue s -> s
  _ -> bug "a value that is no transformation where one was checked"

curveOf :: Value -> PartCurve
curveOf v = case v of
  CurveValue c -> c
  _ -> bug "a value that is no curve where one was checked"
