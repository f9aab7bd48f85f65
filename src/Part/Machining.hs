-- | Evaluation of machining statements (milling, turning, pockets, drilling, moves without cutting)
-- and of cutters and tolerances.
--
-- A function yields nothing when a setting has no value because of a mistake that is already
-- reported.
module Part.Machining
  ( Context (..),
    milling,
    pocketing,
    drilling,
    stopsOf,
    spacePoint,
    cutterOf,
    accuracyOf,
  )
where

import Base.Crash (bug)
import Base.Quantity (Feed, Mm (..), Rad (..), over, times)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Applicative ((<|>))
import Control.Monad (when)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector qualified as Vector
import Geometry.Tolerance qualified as Tolerance
import Part.ContourElement qualified as ContourElement
import Part.ContourError (ContourFault (OpenBegins))
import Part.CurveError (CurveMistake (SteepBevel))
import Part.Error (CutterStatement (..), Error (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Measure (feedOf, lengthOf, notNegative)
import Part.Parameter (Range (UpTo))
import Part.Parameter qualified as Parameter
import Part.Part
import Part.PocketCheck qualified as PocketCheck
import Part.PocketError (PocketMisfit (StepTooWide))
import Part.Value (Value (..))

-- | The names and the settings that are in force at a statement. A setting that the statement needs
-- has no value only after a mistake.
data Context = Context
  { environment :: Environment,
    cutter :: Maybe Cutter,
    chordError :: Maybe Accuracy,
    modalFeed :: Maybe (Located Feed),
    clearanceHeight :: Maybe Mm,
    modalSense :: Sense
  }

-- Milling and turning

-- | The milling or turning of a contour, from the region, the contour, the side and the settings of
-- its statement.
milling ::
  Context ->
  Work ->
  Region ->
  Expr ->
  Located Side ->
  Checked.Settings ->
  Eval (Maybe Milling)
milling context work at e side settings = do
  v <- Expression.evaluate (environment context) e
  case work of
    Milled -> checkCutter context at MillStatement
    Turned -> checkCutter context at TurnStatement
  passes <- passesOf context at (contourOf v) settings
  pure (assembled context work side settings passes)

-- | The evaluated contour and settings of a milling or turning.
data Passes = Passes
  { path :: Contour,
    -- | the approach; nothing after a mistake
    approachStops :: Maybe [Stop],
    -- | the retract; nothing after a mistake
    retractStops :: Maybe [Stop],
    heights :: [Mm],
    plungeFeed :: Maybe (Located Feed),
    -- | the lead-in and the lead-out
    leads :: (Maybe (LeadForm, Mm), Maybe (LeadForm, Mm)),
    -- | the allowances of the passes
    passAllowances :: NonEmpty Mm
  }

-- | Evaluates the settings of a milling or turning.
passesOf :: Context -> Region -> Contour -> Checked.Settings -> Eval Passes
passesOf context at contour settings = do
  approachStops <- stopsOf context (Checked.approach settings)
  retractStops <- stopsOf context (Checked.retract settings)
  path <- startedNear env contour (Checked.startNear settings)
  heights <- maybe (pure []) (levelsOf env) (Checked.depth settings)
  checkSteps context (maybe at (region . fst) (Checked.depth settings)) heights
  plungeFeed <- traverse (feedOf env) (Checked.plunge settings)
  leadIn <- traverse lead (Checked.leadIn settings)
  leadOut <- traverse lead (Checked.leadOut settings)
  passAllowances <-
    maybe
      (pure (Mm 0 :| []))
      (Evaluation.gather . fmap (notNegative env Parameter.Allowance))
      (Checked.allowances settings)
  pure
    Passes
      { path,
        approachStops,
        retractStops,
        heights,
        plungeFeed,
        leads = (leadIn, leadOut),
        passAllowances
      }
  where
    env = environment context
    lead (form, x) = (form,) <$> lengthOf env Parameter.Lead x

-- | Puts a milling or turning together. Nothing if a setting that it needs has no value.
assembled :: Context -> Work -> Located Side -> Checked.Settings -> Passes -> Maybe Milling
assembled context work side settings passes = do
  tool <- cutter context
  tolerance <- chordError context
  feed <- modalFeed context
  approach <- approachStops passes
  retract <- retractStops passes
  _ <- if null (heights passes) then Just (Mm 0) else clearanceHeight context
  Just
    Milling
      { contour = path passes,
        work,
        side,
        radius = cutterRadius tool,
        gear = case kind tool of BladeCutter wheel -> Just wheel; _ -> Nothing,
        tolerance,
        feed,
        approach,
        retract,
        levels = heights passes,
        clearance = clearanceHeight context,
        plunge = plungeFeed passes,
        leadIn = fst (leads passes),
        leadOut = snd (leads passes),
        allowances = passAllowances passes,
        corners = Checked.corners settings,
        sense = Checked.sense settings,
        spindleSense = modalSense context,
        controlCompensation = case Checked.compensation settings of
          Just (Located at Checked.ByController) -> Just at
          Just (Located _ Checked.ByCompiler) -> Nothing
          Nothing -> Nothing,
        rest = maybe Refused (const Allowed) (Checked.restAllowed settings)
      }

contourOf :: Value -> Contour
contourOf v = case v of
  ContourValue c -> c
  _ -> bug "a value that is no contour where one was checked"

-- | The contour, beginning near the point that the statement gives, if it gives one. Fails for an
-- open contour.
startedNear :: Environment -> Contour -> Maybe Expr -> Eval Contour
startedNear env contour near = case near of
  Nothing -> pure contour
  Just e -> do
    p <- Expression.point <$> Expression.evaluate env e
    if ends contour == Open
      then
        let name = value (contourName contour)
         in Evaluation.mistake (InContour (OpenBegins (region e) name))
      else pure (ContourElement.startingNear p contour)

-- | The heights of the passes, from the highest to the lowest, from the depth and the stepdown of
-- the statement. The steps are equal and at most the stepdown. Without a stepdown there is one
-- pass.
levelsOf :: Environment -> (Expr, Maybe Expr) -> Eval [Mm]
levelsOf env (depth, most) = do
  d <- lengthOf env Parameter.Depth depth
  stepdown <- traverse (lengthOf env Parameter.PassDepth) most
  let count = maybe 1 (\s -> max 1 (ceiling (over d s - Tolerance.equal))) stepdown :: Int
  when
    (count > 10000)
    ( Evaluation.mistake
        (NotWhole (region depth) Parameter.PassCount (UpTo 10000) (fromIntegral count))
    )
  pure [times (negate (fromIntegral k / fromIntegral count)) d | k <- [1 .. count]]

-- | Fails if a cutter that is widest at its tip would make passes at several heights.
checkSteps :: Context -> Region -> [Mm] -> Eval ()
checkSteps context at heights = case cutter context of
  Just c
    | kind c == DovetailCutter && length heights > 1 -> Evaluation.mistake (StepsUndercut at)
  _ -> pure ()

-- Pockets

-- | The clearing of the inside of a closed contour around islands, from the region, the outline,
-- the stepover and the settings of its statement.
pocketing ::
  Context ->
  Region ->
  Expr ->
  Expr ->
  Checked.Settings ->
  Eval (Maybe Pocketing)
pocketing context at e step settings = do
  checkCutter context at PocketStatement
  wall <- milling context Milled at e (Located (region e) Inside) settings
  outline' <- named e . contourOf <$> Expression.evaluate env e
  islands <- concat <$> Evaluation.gather (map islandsOf (Checked.islands settings))
  stepover <- lengthOf env Parameter.Stepover step
  Evaluation.spend at (sum [length (elements (PocketCheck.contour c)) | c <- outline' : islands])
  checkPassCount (region step) (over (PocketCheck.halfWidth outline') stepover)
  let diameter = times 2 . cutterRadius <$> cutter context
      tooWide = [StepTooWide (region step) stepover d | Just d <- [diameter], stepover > d]
      contours' = map PocketCheck.contour islands
      pocket w = Pocketing {wall = w, islands = contours', stepover}
  case PocketCheck.misfits outline' islands <> tooWide of
    [] -> pure (pocket <$> wall)
    found -> Evaluation.mistakes [Error (InPocket m) [] | m <- found]
  where
    env = environment context
    named i = PocketCheck.Named (region i)
    islandsOf i = do
      v <- Expression.evaluate env i
      pure $ case v of
        ListValue vs -> map (named i . contourOf) (Vector.toList vs)
        _ -> [named i (contourOf v)]

-- | Fails for more than 10 000 passes, which no pocket needs.
checkPassCount :: Region -> Double -> Eval ()
checkPassCount at count =
  when
    (count > 10000)
    (Evaluation.mistake (NotWhole at Parameter.PassCount (UpTo 10000) (fromIntegral rounded)))
  where
    rounded = ceiling (min 1e9 count) :: Int

-- Drilling

-- | The drilling of a point or a list of points, from the region, the points, the depth and the
-- settings of its statement.
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
  d <- lengthOf env Parameter.Depth depth
  peckDepth <- traverse (lengthOf env Parameter.PeckDepth) (Checked.peck settings)
  plunge <- traverse (feedOf env) (Checked.plunge settings)
  let values = case v of
        ListValue vs -> Vector.toList vs
        _ -> [v]
      pecks = maybe 1 (\p -> ceiling (min 1e9 (over d p) - Tolerance.equal)) peckDepth :: Int
  when
    (pecks > 1000)
    ( Evaluation.mistake
        (NotWhole (region depth) Parameter.PeckCount (UpTo 1000) (fromIntegral pecks))
    )
  Evaluation.spend at (length values * pecks)
  case NonEmpty.nonEmpty (map Expression.point values) of
    Nothing -> Evaluation.mistake (NothingToDrill (region points))
    Just some -> pure $ do
      tool <- cutter context
      drillFeed <- plunge <|> modalFeed context
      travelHeight <- clearanceHeight context
      Just
        Drilling
          { holes = fmap (Located (region points)) some,
            drillRadius = cutterRadius tool,
            bottom = times (-1) d,
            travelHeight,
            peckDepth,
            drillFeed
          }
  where
    env = environment context

-- Moves

-- | The ends of moves without cutting, each with its speed. Nothing if a move needs the feed in
-- force and there is none.
stopsOf :: Context -> [Checked.Stop] -> Eval (Maybe [Stop])
stopsOf context stops = fmap sequence (Evaluation.gather (map stop stops))
  where
    env = environment context
    stop (Checked.Stop p checkedPace) = do
      v <- Expression.evaluate env p
      pace <- case checkedPace of
        Checked.Cutting -> pure (At <$> modalFeed context)
        Checked.Rapid -> pure (Just Rapid)
        Checked.AtFeed e -> Just . At <$> feedOf env e
      let SpacePoint target _ = spacePoint v
          level = case v of
            SpaceValue _ z -> Just z
            _ -> Nothing
      pure (Stop (Located (region p) target) level <$> pace)

-- | A point in space from a point with or without a height. Without a height it is at height 0.
spacePoint :: Value -> SpacePoint
spacePoint v = case v of
  SpaceValue p z -> SpacePoint p z
  _ -> SpacePoint (Expression.point v) (Mm 0)

-- Cutters and tolerances

-- | Fails if the statement cannot be done with the cutter in the spindle.
checkCutter :: Context -> Region -> CutterStatement -> Eval ()
checkCutter context at statement = case cutter context of
  Just c | not (fits (kind c)) -> Evaluation.mistake (WrongCutter at statement (kind c))
  _ -> pure ()
  where
    fits cutterKind = case statement of
      MillStatement -> isMill cutterKind
      TurnStatement -> cutterKind == TurningCutter
      PocketStatement -> cutterKind == MillingCutter
      DrillStatement -> cutterKind `elem` [DrillingCutter, MillingCutter]

-- | Does a cutter of this kind mill contours with its flank?
isMill :: CutterKind -> Bool
isMill cutterKind = case cutterKind of
  MillingCutter -> True
  ConeCutter -> True
  DovetailCutter -> True
  BladeCutter _ -> True
  DrillingCutter -> False
  TurningCutter -> False

-- | A cutter, with its radius where it touches the part.
cutterOf :: Environment -> Checked.Cutter -> Eval Cutter
cutterOf env (Located _ c) = case c of
  Checked.MillCutter e ->
    Cutter MillingCutter . times 0.5 <$> lengthOf env Parameter.CutterDiameter e
  Checked.DrillCutter e ->
    Cutter DrillingCutter . times 0.5 <$> lengthOf env Parameter.DrillDiameter e
  Checked.ConeCutter e lean h -> cone env e lean h
  Checked.BladeCutter e g -> do
    d <- lengthOf env Parameter.BladeDiameter e
    wheel <- lengthOf env Parameter.WheelDiameter g
    pure (Cutter (BladeCutter wheel) (times 0.5 d))
  Checked.TurningCutter e -> do
    x <- Expression.number <$> Expression.evaluate env e
    when (x < 0) (Evaluation.mistake (Negative (region e) Parameter.NoseRadius x))
    pure (Cutter TurningCutter (Mm x))

-- | A conical cutter, from its diameter 2R at the tip, its bevel μ and the height H at which its
-- flank touches the part. Its radius there is @a = R + H·tan μ@ (Kolsanova, section 3).
cone :: Environment -> Expr -> Expr -> Expr -> Eval Cutter
cone env e lean h = do
  Mm d <- lengthOf env Parameter.CutterDiameter e
  mu <- Expression.number <$> Expression.evaluate env lean
  Mm flank <- lengthOf env Parameter.FlankHeight h
  when
    (abs mu >= pi / 2 - 1e-6)
    (Evaluation.mistake (InCurve (SteepBevel (region lean) Nothing (Rad mu))))
  let a = d / 2 + flank * tan mu
  when (a <= 0) (Evaluation.mistake (NotPositive (region lean) Parameter.RadiusAtHeight a))
  pure (Cutter (if mu < 0 then DovetailCutter else ConeCutter) (Mm a))

-- | The allowed chord error that a tolerance statement sets.
accuracyOf :: Environment -> Checked.Accuracy -> Eval Accuracy
accuracyOf env accuracy = case accuracy of
  Checked.Within e -> OnPath <$> lengthOf env Parameter.Tolerance e
  Checked.Between a b -> do
    inside <- notNegative env Parameter.Tolerance a
    outside <- notNegative env Parameter.Tolerance b
    if inside <= Mm 0 && outside <= Mm 0
      then Evaluation.mistake (NotPositive (region b) Parameter.OneSidedTolerance 0)
      else pure (Band inside outside)
