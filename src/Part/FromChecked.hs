-- | Evaluation: the checked program into the exact geometry of the part.
module Part.FromChecked
  ( evaluate,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.Quantity (Feed (..), Mm (..), times)
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Checked.Syntax (Expr, Item, Item_ (..), Walk)
import Checked.Syntax qualified as Checked
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Geometry.Shape (Walked (..))
import Geometry.Shape qualified as Shape
import Geometry.Vec (Point)
import Part.Chain (Link (..))
import Part.Chain qualified as Chain
import Part.Error (Error (..), Fact (..))
import Part.Part (Contour (..), Ends (..), Milling (..), Operation (..), Pace (..), Part (..), Stop (..))
import Part.Value (Environment (..), Value (..))
import Part.Value qualified as Value

-- | What is known between two statements. A setting without a value is missing because of a mistake.
data State = State
  { environment :: Environment,
    radius' :: Maybe Mm,
    tolerance' :: Maybe Mm,
    feed' :: Maybe (Located Feed),
    start' :: Maybe (Located Point),
    contours' :: [Contour],
    operations' :: [Operation],
    errors' :: [Error]
  }

-- | An evaluation that may find a mistake, or depend on one that is already reported.
type Answer a = Either Error (Maybe a)

-- | Evaluate a program. What depends on a mistake is left out.
evaluate :: Checked.Program -> Result w Error Part
evaluate program = Result {warnings = [], errors = reverse (errors' final), output = Just part}
  where
    final = foldl step begin (Checked.statements program)
    begin =
      State
        { environment = Value.empty,
          radius' = Nothing,
          tolerance' = Nothing,
          feed' = Nothing,
          start' = Nothing,
          contours' = [],
          operations' = [],
          errors' = []
        }
    part =
      Part
        { name = Checked.name program,
          title = Checked.title program,
          machine = Checked.machine program,
          start = start' final,
          contours = reverse (contours' final),
          operations = reverse (operations' final)
        }

step :: State -> Checked.Statement -> State
step state (Located region s) = case s of
  Checked.Tool e -> keep (positive env "the cutter's diameter" Decimal.mm Mm e) (\d -> state {radius' = Just (times 0.5 d)})
  Checked.Feed e -> keep (feedOf env e) (\f -> state {feed' = Just f})
  Checked.Tolerance e -> keep (positive env "the tolerance" Decimal.mm Mm e) (\t -> state {tolerance' = Just t})
  Checked.From e -> keep (pointOf env e) (\p -> state {start' = Just (Located region p)})
  Checked.LetValue name e -> keep (affordable env 1 e *> Value.evaluate env e) (define name)
  Checked.LetFunction name parameters body ->
    state {environment = env {functions = Map.insert name (parameters, body) (functions env), costs = Map.insert name (1 + Value.steps env body) (costs env)}}
  Checked.Contour name closure items ->
    keep (contourOf env name closure items) $ \c -> (define (value name) (ContourValue c)) {contours' = c : contours' state}
  Checked.Mill e side before after ->
    keep (milling state e side before after) (\m -> state {operations' = Mill (Located region m) : operations' state})
  Checked.Travel stops ->
    keep (stopsOf state (NonEmpty.toList stops)) $ \ps -> case NonEmpty.nonEmpty ps of
      Just some -> state {operations' = Travel some : operations' state}
      Nothing -> state
  where
    env = environment state
    define name v = state {environment = env {values = Map.insert name v (values env)}}
    keep answer f = case answer of
      Left e -> state {errors' = e : errors' state}
      Right Nothing -> state
      Right (Just a) -> f a

-- Steps

-- | Evaluations may not take more steps.
mostSteps :: Integer
mostSteps = 10000000

-- | Whether an expression can be evaluated so often.
affordable :: Environment -> Integer -> Expr -> Either Error ()
affordable env times' e
  | times' * Value.steps env e <= mostSteps = Right ()
  | otherwise = Left (Error (TooMuchWork (region e) mostSteps) [])

-- Settings

pointOf :: Environment -> Expr -> Answer Point
pointOf env e = affordable env 1 e *> (fmap Value.place <$> Value.evaluate env e)

-- | A quantity above zero; what it is and how it is written for the report.
positive :: Environment -> Text -> (q -> Text) -> (Double -> q) -> Expr -> Answer q
positive env what written make e = do
  affordable env 1 e
  v <- Value.evaluate env e
  case Value.double <$> v of
    Just x | x <= 0 -> Left (Error (NotPositive (region e) what (written (make x))) [])
    Just x -> Just (make x) <$ Value.within (region e) x
    Nothing -> Right Nothing

feedOf :: Environment -> Expr -> Answer (Located Feed)
feedOf env e = fmap (Located (region e)) <$> positive env "the feed" (\(Feed f) -> Decimal.short 4 f <> " mm/min") Feed e

-- Machining

milling :: State -> Expr -> Located Checked.Side -> [Checked.Stop] -> [Checked.Stop] -> Answer Milling
milling state e side before after = do
  c <- Value.evaluate (environment state) e
  before' <- stopsOf state before
  after' <- stopsOf state after
  pure $ case (c, radius' state, tolerance' state, feed' state) of
    (Just (ContourValue contour), Just radius, Just tolerance, Just feed) -> do
      approach <- before'
      retract <- after'
      Just Milling {contour, side, radius, tolerance, feed, approach, retract}
    _ -> Nothing

stopsOf :: State -> [Checked.Stop] -> Answer [Stop]
stopsOf state stops = sequence <$> traverse stop stops
  where
    env = environment state
    stop (Checked.Stop p pace') = do
      p' <- pointOf env p
      pace'' <- case pace' of
        Checked.Cutting -> Right (At <$> feed' state)
        Checked.Rapid -> Right (Just Rapid)
        Checked.AtFeed e -> fmap At <$> feedOf env e
      Right (Stop <$> (Located (region p) <$> p') <*> pace'')

-- Contours

contourOf :: Environment -> Located Name -> Checked.Closure -> [Item] -> Answer Contour
contourOf env name closure items = do
  walks <- walksOf env 1 items
  case walks of
    Nothing -> Right Nothing
    Just ws -> case NonEmpty.nonEmpty ws of
      Nothing -> Left (Error (EmptyContour (region name) (value name)) [])
      Just some -> case Chain.solve (region name) ends some of
        Left fact -> Left (Error fact [])
        Right elements -> Right (Just Contour {contourName = name, ends, elements})
  where
    ends = case closure of
      Checked.Open -> Open
      Checked.Closed -> Closed

-- | The elements of some items, which are evaluated so often in all.
walksOf :: Environment -> Integer -> [Item] -> Answer [Chain.Walk]
walksOf env times' items = fmap concat . sequence <$> traverse (itemOf env times') items

itemOf :: Environment -> Integer -> Item -> Answer [Chain.Walk]
itemOf env times' (Located _ i) = case i of
  For name list body -> do
    affordable env times' list
    v <- Value.evaluate env list
    case v of
      Nothing -> Right Nothing
      Just (ListValue vs) -> fmap concat . sequence <$> traverse (\x -> walksOf env {locals = Map.insert name x (locals env)} (times' * fromIntegral (length vs)) body) vs
      Just _ -> bug "a repetition over a value that is no list"
  Element walk e link -> do
    affordable env times' e
    shape <- fmap (walked walk) <$> Value.evaluate env e
    link' <- maybe (Right (Just Nothing)) (linkOf env) link
    Right ((\s l -> [Chain.Walk {Chain.place = region e, Chain.shape = s, Chain.link = l}]) <$> shape <*> link')

walked :: Maybe Walk -> Value -> Walked
walked walk v = case (v, walk) of
  (CircleValue c, Just Checked.Clockwise) -> OnCircle Shape.Clockwise c
  (CircleValue c, Just Checked.CounterClockwise) -> OnCircle Shape.CounterClockwise c
  (LineValue l, Nothing) -> OnLine l
  (Spatial _, Nothing) -> AtPoint (Value.place v)
  _ -> bug "an element that can not be walked"

linkOf :: Environment -> Checked.Link -> Answer (Maybe (Region, Link))
linkOf env (Located at l) = case l of
  Checked.Meet Nothing -> found (Right (Just (Meet Nothing)))
  Checked.Meet (Just p) -> found (fmap (Meet . Just) <$> pointOf env p)
  Checked.Smooth -> found (Right (Just Smooth))
  Checked.Tangent -> found (Right (Just Tangent))
  Checked.Fillet e -> found $ do
    v <- fmap Value.double <$> Value.evaluate env e
    case v of
      Just 0 -> Left (Error (NotPositive (region e) "the radius of a fillet" "0 mm") [])
      Just r -> Just (signed r) <$ Value.within (region e) r
      Nothing -> Right Nothing
  Checked.Chamfer e -> found (fmap Chamfer <$> positive env "the chamfer" Decimal.mm Mm e)
  where
    found answer = fmap (fmap (Just . (at,))) answer

-- | +R is walked clockwise, −R counter-clockwise (Kolsanova: links between pieces).
signed :: Double -> Link
signed r = Fillet (if r > 0 then Shape.Clockwise else Shape.CounterClockwise) (Mm (abs r))
