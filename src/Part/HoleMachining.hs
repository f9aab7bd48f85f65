-- | Evaluates the works on holes other than drilling: spotting, reaming, countersinking,
-- counterboring, boring, tapping and threading.
--
-- A point of a tool with the angle A makes at the depth d below the top of the part a circle of the
-- radius r + d · tan(A\/2), where r is the radius of its tip: 0 for a drill.
module Part.HoleMachining
  ( holeWork,
    internalCore,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Checked.Syntax (Expr, HoleSize (..), HoleWork (..))
import Checked.Syntax qualified as Checked
import Control.Applicative ((<|>))
import Control.Monad (when)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Tolerance qualified as Tolerance
import Part.CutFeed (CutFeed (..), SpindleRate (..))
import Part.CutterBody qualified as CutterBody
import Part.Error (CutterStatement (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression qualified as Expression
import Part.HoleError (HoleMistake (..), TapMistake (..), ThreadMistake (..))
import Part.Machining (Context (..), checkCutter)
import Part.Measure (feedOf, lengthOf, secondsOf)
import Part.Parameter (Range (UpTo))
import Part.Parameter qualified as Parameter
import Part.Part
import Part.Value (Value (..))
import Surface.HoleForm qualified as HoleForm

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

-- | Sizes and moves of the holes, which all of them share.
data Made = Made {deep :: Mm, mouth :: Mm, moves :: HoleForm}

-- | Evaluates a work on one hole or several holes. @at@ is the region of the statement, and
-- @points@ is the expression of the point or the list of points.
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
  made <- traverse (madeBy context written) (cutter context)
  ps <- case v of
    TableValue _ ->
      map (Expression.point . Expression.self) <$> Expression.turnsOf (region points) v
    ListValue vs -> pure (map Expression.point (Vector.toList vs))
    _ -> pure [Expression.point v]
  Evaluation.spend at (length ps * maybe 1 turnsOf made)
  case NonEmpty.nonEmpty ps of
    Nothing -> Evaluation.mistake (NothingToDrill (region points))
    Just some -> pure $ do
      tool <- cutter context
      Made {deep, mouth, moves} <- made
      travelHeight <- clearanceHeight context
      drillFeed <- feedInto moves <|> plunge <|> modalFeed context
      Just
        Drilling
          { holes = fmap (\p -> Hole (Located (region points) p) (times (-1) deep)) some,
            visits = Checked.visits settings,
            drillRadius = cutterRadius tool,
            mouthRadius = mouth,
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

-- | The number of turns of the helix of a hole; 1 without a helix.
turnsOf :: Made -> Int
turnsOf Made {deep, moves} = case moves of
  Bored c -> turns (turnDepth c)
  Threaded h -> turns (pitch h)
  Plunged -> 1
  Reamed -> 1
  Tapped _ -> 1
  where
    turns step = max 1 (ceiling (over deep step))

-- | The sizes and the moves of the holes that a tool makes.
madeBy :: Context -> Written -> Cutter -> Eval Made
madeBy context w tool = case asked w of
  Spotting
    | Just e <- lookup HoleDiameter (sizes w) -> do
      d <- lengthOf env Parameter.HoleDiameter e
      plunged <$> depthOfMouth tool (region e) d <*> pure (times 0.5 d)
    | otherwise -> do
      d <- depth
      let r = tipOf tool + wide d * tan (angle / 2)
      pure (plunged d (min (cutterRadius tool) (Mm r)))
  Reaming -> (\d -> Made {deep = d, mouth = cutterRadius tool, moves = Reamed}) <$> depth
  Countersinking -> do
    let e = sizeOf w HoleAngle
    Rad asked <- Rad . Expression.number <$> Expression.evaluate env e
    when
      (abs (asked - angle) > 1.0e-4)
      (mistake (OtherAngle (region e) (Rad asked) (Rad angle)))
    let across = sizeOf w HoleDiameter
    d <- lengthOf env Parameter.HoleDiameter across
    plunged <$> depthOfMouth tool (region across) d <*> pure (times 0.5 d)
  Counterboring -> do
    d <- depth
    turn <- traverse (lengthOf env Parameter.ThreadPitch) (Checked.turnPitch (settings w))
    bored context w tool True d (fromMaybe (times 0.2 (cutterRadius tool)) turn)
  Boring -> do
    d <- depth
    turn <- lengthOf env Parameter.ThreadPitch (sizeOf w HolePitch)
    bored context w tool False d turn
  Tapping -> do
    d <- depth
    pitch <- lengthOf env Parameter.ThreadPitch (sizeOf w HolePitch)
    tapping <- tapped context w pitch
    pure Made {deep = d, mouth = cutterRadius tool, moves = Tapped tapping}
  Threading -> threaded context w tool =<< depth
  where
    env = environment context
    depth = lengthOf env Parameter.Depth (sizeOf w HoleDepth)
    plunged d r = Made {deep = d, mouth = r, moves = Plunged}
    angle = CutterBody.pointOf tool
    wide (Mm d) = d

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
  _ -> 0

-- | The milling of a cylinder to the depth @deep@, with turns of at most @turn@. A mill of exactly
-- its diameter goes straight down.
bored :: Context -> Written -> Cutter -> Bool -> Mm -> Mm -> Eval Made
bored context w tool clearsFloor deep turn = do
  d <- lengthOf (environment context) Parameter.HoleDiameter across
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
  pure . Made deep r $
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

-- | The milling of a thread to the depth @deep@.
--
-- The basic profile of ISO 68-1 has the height H = √3\/2 · P. Its inside thread reaches the nominal
-- diameter D, and the core before it has D − 2 · 5\/8 · H. The teeth of an outside thread reach
-- D − 2 · 17\/24 · H, with a rounded root.
threaded :: Context -> Written -> Cutter -> Mm -> Eval Made
threaded context w tool deep = do
  d <- lengthOf env Parameter.HoleDiameter across
  pitch <- lengthOf env Parameter.ThreadPitch along
  case kind tool of
    ThreadCutter own
      | abs (over own pitch - 1) > 1.0e-6 -> threadMistake (OtherPitch (region along) pitch own)
    _ -> pure ()
  let core = internalCore d pitch
      root = minus (times 0.5 d) (times (17 / 24 * sqrt 0.75) pitch)
      isInside = maybe True ((== Inside) . value) (threadSide w)
      sense = if isInside then insideSense context w else opposite (insideSense context w)
      mouth = times 0.5 d
  when (isInside && times 2 (cutterRadius tool) >= core) $
    threadMistake (CoreTooNarrow (region across) (times 2 (cutterRadius tool)) core)
  when (root <= Mm 0) (threadMistake (NoCoreLeft (region along) pitch d))
  when (over deep pitch > 10000) . Evaluation.mistake $
    NotWhole (region along) Parameter.TurnCount (UpTo 10000) (fromIntegral turnCount)
  (helixFeed, helixTolerance) <- runs context
  pure . Made deep mouth $
    Threaded
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
