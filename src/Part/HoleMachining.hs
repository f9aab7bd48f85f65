-- | Evaluates the works on holes: drilling, spotting, reaming, countersinking, counterboring,
-- boring, tapping and threading.
--
-- A point of a tool with the angle A makes at the depth d below the top of the part a circle of the
-- radius r + d · tan(A\/2), where r is the radius of its tip: 0 for a drill.
module Part.HoleMachining
  ( drilling,
    holeWork,
    internalCore,
  )
where

import Base.Crash (bug)
import Base.NumberTable qualified as NumberTable
import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Checked.Syntax (Expr, HoleSize (..), HoleWork (..))
import Checked.Syntax qualified as Checked
import Control.Applicative ((<|>))
import Control.Monad (when)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isNothing)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Tolerance qualified as Tolerance
import Part.Curve qualified as Curve
import Part.CutFeed (CutFeed (..), SpindleRate (..))
import Part.CutterBody qualified as CutterBody
import Part.Error (CutterStatement (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.HoleError (HoleMistake (..), TapMistake (..), ThreadMistake (..))
import Part.Machining (Context (..), checkCutter)
import Part.Measure (feedOf, lengthOf, secondsOf)
import Part.Parameter (Range (UpTo))
import Part.Parameter qualified as Parameter
import Part.Part
import Part.Piece qualified as Piece
import Part.Value (Value (..))
import Part.WallDepth qualified as WallDepth
import Surface.HoleForm qualified as HoleForm

-- | Evaluates the drilling of one hole or several holes. @at@ is the region of the statement, and
-- @points@ is the expression of the point, the list of points or the table. With a table the depth
-- may name columns.
drilling ::
  Context ->
  Region ->
  Expr ->
  Expr ->
  Checked.Settings ->
  Eval (Maybe Drilling)
drilling context at points depth settings = do
  v <- Expression.evaluate env points
  checkCutter context at DrillStatement
  let radius' = maybe (Mm 0) cutterRadius (cutter context)
  found <- holesOf env points v [depth] (\row -> (,radius') <$> depthOf row depth)
  peckDepth <- traverse (lengthOf env Parameter.PeckDepth) (Checked.peck settings)
  plunge <- traverse (feedOf env) (Checked.plunge settings)
  chipRise <- chipRiseOf env settings
  bottomPause <- traverse (secondsOf env) (Checked.pause settings)
  let pecksOf h = maybe 1 (pecksIn (holeBottom h)) peckDepth
      most = maximum (0 : map pecksOf found)
  when
    (most > 1000)
    ( Evaluation.mistake
        (NotWhole (region depth) Parameter.PeckCount (UpTo 1000) (fromIntegral most))
    )
  checkOrdered points settings (length found)
  Evaluation.spend at (sum (map pecksOf found))
  case NonEmpty.nonEmpty found of
    Nothing -> Evaluation.mistake (NothingToDrill (region points))
    Just some -> pure $ do
      tool <- cutter context
      drillFeed <- plunge <|> modalFeed context
      travelHeight <- clearanceHeight context
      Just
        Drilling
          { holes = some,
            visits = Checked.visits settings,
            drillRadius = cutterRadius tool,
            drillSize = cutterSize tool,
            travelHeight,
            peckDepth,
            chipRise,
            bottomPause,
            form = Plunged,
            drillFeed
          }
  where
    env = environment context

-- | The number of pecks of at most a depth down to the height of a bottom.
pecksIn :: Mm -> Mm -> Int
pecksIn bottom p = ceiling (min 1e9 (-(over bottom p)) - Tolerance.equal)

-- | Evaluates the rise of a drill after a peck. Fails if there is a chip break without pecks.
chipRiseOf :: Environment -> Checked.Settings -> Eval (Maybe Mm)
chipRiseOf env settings = case Checked.chipBreak settings of
  Just (Located setting _)
    | isNothing (Checked.peck settings) ->
      Evaluation.mistake (InHole (BreakWithoutPeck setting))
  given -> traverse (lengthOf env Parameter.ChipRise . value) given

-- | The names by which a size of a hole is evaluated: those at the statement, or with them the
-- columns of a row of a table.
data RowScope = RowScope
  { rowNames :: Environment,
    -- | the expression of a size, at the place at which a mistake points: the row
    rowPlace :: Expr -> Expr,
    -- | the name of the depth in reports
    rowDepth :: Parameter.LimitedQuantity
  }

depthOf :: RowScope -> Expr -> Eval Mm
depthOf row e = lengthOf (rowNames row) (rowDepth row) (rowPlace row e)

-- | The holes at the value @v@ of the expression @points@. @measure@ gives the depth and the radius
-- at the top. If the expressions of the sizes name columns of a table, it is evaluated in each row,
-- and a mistake points at the row.
holesOf :: Environment -> Expr -> Value -> [Expr] -> (RowScope -> Eval (Mm, Mm)) -> Eval [Hole]
holesOf env points v sizes measure = case v of
  TableValue t -> do
    turns <- Expression.turnsOf (region points) v
    if any (Piece.mentions (Curve.names t)) sizes
      then Evaluation.gather (zipWith (inRow t) [0 ..] turns)
      else alike (map pointIn turns)
  ListValue vs -> alike (map Expression.point (Vector.toList vs))
  _ -> alike [Expression.point v]
  where
    alike ps = (\size -> map (`hole` size) ps) <$> measure (RowScope env id Parameter.Depth)
    inRow t k turn =
      hole (pointIn turn) <$> measure (RowScope (inTurn turn) (atRow t k) Parameter.HoleDepth)
    inTurn turn = Expression.withColumns (Expression.columns turn) env
    atRow t k e = e {region = NumberTable.regionOf (Curve.rows t) k}
    pointIn = Expression.point . Expression.self
    hole p (d, r) =
      Hole {holeCentre = Located (region points) p, holeBottom = times (-1) d, holeMouth = r}

-- | A work on holes as the program writes it: the work, the points, the sizes, the side of a
-- thread, and the settings.
data Written = Written
  { asked :: HoleWork,
    sizes :: [(HoleSize, Expr)],
    threadSide :: Maybe (Located Side),
    settings :: Checked.Settings,
    -- | the region of the keyword
    keyword :: Region
  }

-- | Evaluates a work on one hole or several holes. @at@ is the region of the statement, and
-- @points@ is the expression of the point, the list of points or the table.
holeWork ::
  Context ->
  Region ->
  HoleWork ->
  Expr ->
  ([(HoleSize, Expr)], Maybe (Located Side)) ->
  Checked.Settings ->
  Eval (Maybe Drilling)
holeWork context at work points (sizes, threadSide) settings = do
  v <- Expression.evaluate env points
  checkCutter context at (HoleStatement work)
  plunge <- traverse (feedOf env) (Checked.plunge settings)
  pause <- traverse (secondsOf env) (Checked.pause settings)
  made <- traverse (madeBy context written (points, v)) (cutter context)
  checkOrdered points settings (maybe 0 (length . fst) made)
  Evaluation.spend at (maybe 0 (\(found, m) -> sum (map (turnsOf m) found)) made)
  if isEmpty v || maybe False (null . fst) made
    then Evaluation.mistake (NothingToDrill (region points))
    else pure $ do
      tool <- cutter context
      (found, moves) <- made
      holes <- NonEmpty.nonEmpty found
      travelHeight <- clearanceHeight context
      drillFeed <- feedInto moves <|> plunge <|> modalFeed context
      Just
        Drilling
          { holes,
            visits = Checked.visits settings,
            drillRadius = cutterRadius tool,
            drillSize = cutterSize tool,
            travelHeight,
            peckDepth = Nothing,
            chipRise = Nothing,
            bottomPause = pause,
            form = moves,
            drillFeed
          }
  where
    env = environment context
    written = Written {asked = work, sizes, threadSide, settings, keyword}
    keyword = at {end = Region.start at + Text.length (HoleForm.word work)}
    feedInto m = case m of
      Tapped t -> Just (Located keyword (PerTurn (tapPitch t) NoRate))
      _ -> Nothing
    isEmpty v = case v of
      ListValue vs -> Vector.null vs
      _ -> False

-- | Fails if a statement orders more holes than the search for a short way takes.
checkOrdered :: Expr -> Checked.Settings -> Int -> Eval ()
checkOrdered points settings count =
  when
    (Checked.visits settings == Shortest && count > 10000)
    ( Evaluation.mistake
        (NotWhole (region points) Parameter.OrderedHoleCount (UpTo 10000) (fromIntegral count))
    )

-- | The number of turns of the helix of a hole; 1 without a helix.
turnsOf :: HoleForm -> Hole -> Int
turnsOf moves hole = case moves of
  Bored c -> turns (turnDepth c)
  Threaded h -> turns (pitch h)
  Plunged -> 1
  Reamed -> 1
  Tapped _ -> 1
  where
    turns step = max 1 (ceiling (over (times (-1) (holeBottom hole)) step))

-- | The holes that a tool makes, and the moves by which it makes each of them.
madeBy :: Context -> Written -> (Expr, Value) -> Cutter -> Eval ([Hole], HoleForm)
madeBy context w points tool = case asked w of
  Spotting -> do
    found <- case lookup HoleDiameter (sizes w) of
      Just e -> holes [e] (mouthIn e)
      Nothing -> holes [depth] (fmap (\d -> (d, mouthAt tool d)) . depthIn)
    pure (found, Plunged)
  Reaming -> (,Reamed) <$> holes [depth] (alike (cutterRadius tool))
  Countersinking -> do
    checkAngle env (sizeOf w HoleAngle) tool
    let across = sizeOf w HoleDiameter
    (,Plunged) <$> holes [across] (mouthIn across)
  Counterboring -> do
    turn <- traverse (lengthOf env Parameter.ThreadPitch) (Checked.turnPitch (settings w))
    circled True (fromMaybe (times 0.2 (cutterRadius tool)) turn)
  Boring -> do
    turn <- lengthOf env Parameter.ThreadPitch (sizeOf w HolePitch)
    circled False turn
  Tapping -> do
    found <- holes [depth] (alike (cutterRadius tool))
    pitch <- lengthOf env Parameter.ThreadPitch (sizeOf w HolePitch)
    (,) found . Tapped <$> tapped context w pitch
  Threading -> do
    d <- lengthOf env Parameter.HoleDiameter (sizeOf w HoleDiameter)
    found <- holes [depth] (alike (times 0.5 d))
    (,) found . Threaded <$> threaded context w tool d (deepest found)
  where
    env = environment context
    holes = uncurry (holesOf env) points
    depth = sizeOf w HoleDepth
    depthIn :: RowScope -> Eval Mm
    depthIn row = depthOf row depth
    alike r = fmap (,r) . depthIn
    mouthIn e row = do
      d <- lengthOf (rowNames row) Parameter.HoleDiameter (rowPlace row e)
      (,times 0.5 d) <$> depthOfMouth tool (region (rowPlace row e)) d
    circled clearsFloor turn = do
      d <- lengthOf env Parameter.HoleDiameter (sizeOf w HoleDiameter)
      found <- holes [depth] (alike (times 0.5 d))
      (,) found <$> bored context w tool clearsFloor (d, deepest found) turn

-- | Fails if the angle of a countersink, which the expression gives, is not that of the tool.
checkAngle :: Environment -> Expr -> Cutter -> Eval ()
checkAngle env e tool = do
  asked <- Expression.number <$> Expression.evaluate env e
  when
    (abs (asked - CutterBody.pointOf tool) > 1.0e-4)
    (mistake (OtherAngle (region e) (Rad asked) (Rad (CutterBody.pointOf tool))))

-- | The radius at the top of a hole that the point of a tool makes at this depth.
mouthAt :: Cutter -> Mm -> Mm
mouthAt tool (Mm d) =
  min (cutterRadius tool) (Mm (tipOf tool + d * tan (CutterBody.pointOf tool / 2)))

-- | The depth of the deepest hole.
deepest :: [Hole] -> Mm
deepest = foldr (max . times (-1) . holeBottom) (Mm 0)

-- | A size that the grammar demands.
sizeOf :: Written -> HoleSize -> Expr
sizeOf w size =
  fromMaybe (bug "a hole without a size that the grammar demands") (lookup size (sizes w))

-- | The depth at which the point of a tool makes a circle of this diameter at the top of the part.
depthOfMouth :: Cutter -> Region -> Mm -> Eval Mm
depthOfMouth tool at d
  | times 0.5 d > cutterRadius tool || d <= Mm (2 * tipOf tool) =
    mistake (BeyondPoint at d (Mm (2 * tipOf tool)) (times 2 (cutterRadius tool)))
  | otherwise =
    let Mm r = times 0.5 d
     in pure (Mm ((r - tipOf tool) / tan (CutterBody.pointOf tool / 2)))

-- | The radius in mm of the tip of a pointed tool: 0 for a drill.
tipOf :: Cutter -> Double
tipOf tool = case kind tool of
  ConeCutter -> let Mm r = tipRadius tool in r
  VBitCutter -> let Mm r = tipRadius tool in r
  _ -> 0

-- | The milling of cylinders with the diameter @d@, the deepest one down to @deep@, with turns of
-- at most @turn@. A mill of exactly their diameter goes straight down.
bored :: Context -> Written -> Cutter -> Bool -> (Mm, Mm) -> Mm -> Eval HoleForm
bored context w tool clearsFloor (d, deep) turn = do
  let r = times 0.5 d
      wider = minus r (cutterRadius tool)
      isPlunged = clearsFloor && abs' wider <= Tolerance.coincident
  when
    (not isPlunged && wider <= Tolerance.coincident)
    (mistake (NotWider (region across) d (times 2 (cutterRadius tool))))
  let turns = over deep turn
  when (turns > 10000) . Evaluation.mistake $
    NotWhole (region across) Parameter.TurnCount (UpTo 10000) (fromIntegral (round turns :: Int))
  (circleFeed, circleTolerance) <- runs context
  pure $
    if isPlunged
      then Plunged
      else
        Bored
          Circling
            { boreRadius = r,
              turnDepth = turn,
              clearsFloor,
              circleSense = insideSense context w,
              circleFeed,
              circleTolerance
            }
  where
    across = sizeOf w HoleDiameter
    abs' (Mm x) = Mm (abs x)

-- | The feed and the tolerance in force. Without one of them, a mistake is already reported.
runs :: Context -> Eval (Located CutFeed, Accuracy)
runs context = case (modalFeed context, chordError context) of
  (Just f, Just t) -> pure (f, value t)
  _ -> Evaluation.mistakes []

-- | The sense of circles on the inside of a hole, seen from above: climb milling unless the
-- statement asks for conventional milling.
insideSense :: Context -> Written -> Carrier.Sense
insideSense context w
  | climbs == (modalSense context == Clockwise) = Carrier.CounterClockwise
  | otherwise = Carrier.Clockwise
  where
    climbs = fmap value (Checked.sense (settings w)) /= Just Conventional

-- | The tapping of a thread: the spindle has to turn into it.
tapped :: Context -> Written -> Mm -> Eval TapStroke
tapped context w pitch = do
  case modalRate context of
    TurnsPerMinute _ -> pure ()
    _ -> threadMistake (InTap (TapWithoutSpeed (keyword w)))
  when (modalSense context /= inwards) . threadMistake . InTap $
    TapTurnsBack (keyword w) (modalSense context)
  pure
    TapStroke
      { tapSense = inwards,
        tapPitch = pitch,
        floats = Checked.floating (settings w)
      }
  where
    inwards = if isLeft w then CounterClockwise else Clockwise

-- | True for a left-hand thread.
isLeft :: Written -> Bool
isLeft w = Checked.hand (settings w) == Just LeftSide

-- | The milling of threads with the nominal diameter @d@, the deepest one down to @deep@.
--
-- The basic profile of ISO 68-1 has the height H = √3\/2 · P. Its inside thread reaches the nominal
-- diameter D, and the core before it has D − 2 · 5\/8 · H. The teeth of an outside thread reach
-- D − 2 · 17\/24 · H, with a rounded root.
threaded :: Context -> Written -> Cutter -> Mm -> Mm -> Eval ThreadHelix
threaded context w tool d deep = do
  pitch <- lengthOf env Parameter.ThreadPitch along
  case kind tool of
    ThreadCutter own
      | abs (over own pitch - 1) > 1.0e-6 -> threadMistake (OtherPitch (region along) pitch own)
    _ -> pure ()
  let core = internalCore d pitch
      root = minus (times 0.5 d) (WallDepth.threadDepth pitch)
      isInside = maybe True ((== Inside) . value) (threadSide w)
      sense = if isInside then insideSense context w else opposite (insideSense context w)
      mouth = times 0.5 d
  when (isInside && times 2 (cutterRadius tool) >= core) $
    threadMistake (CoreTooNarrow (region across) (times 2 (cutterRadius tool)) core)
  when (root <= Mm 0) (threadMistake (NoCoreLeft (region along) pitch d))
  when (over deep pitch > 10000) . Evaluation.mistake $
    NotWhole (region along) Parameter.TurnCount (UpTo 10000) (fromIntegral turnCount)
  (helixFeed, helixTolerance) <- runs context
  pure
    ThreadHelix
      { toothRadius = if isInside then mouth else root,
        pitch,
        isInside,
        helixSense = sense,
        rises = isLeft w /= (sense == Carrier.CounterClockwise),
        helixFeed,
        helixTolerance
      }
  where
    env = environment context
    across = sizeOf w HoleDiameter
    along = sizeOf w HolePitch
    turnCount = 10001 :: Int
    opposite s = case s of
      Carrier.Clockwise -> Carrier.CounterClockwise
      Carrier.CounterClockwise -> Carrier.Clockwise

-- | The diameter of the hole before an inside thread is cut: the nominal diameter of the thread
-- less 5\/4 of the height of its profile.
internalCore :: Mm -> Mm -> Mm
internalCore d pitch = plus d (times (-(5 / 4 * sqrt 0.75)) pitch)

mistake :: HoleMistake -> Eval a
mistake = Evaluation.mistake . InHole

threadMistake :: ThreadMistake -> Eval a
threadMistake = mistake . InThread
