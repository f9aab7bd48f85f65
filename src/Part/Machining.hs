-- | Evaluates machining statements (milling, turning, pockets, drilling, moves without cutting),
-- cutters and tolerances.
--
-- A function yields 'Nothing' if a setting that it needs has no value. Such a setting contains a
-- mistake that is already reported, so the statement is left out without a further report.
module Part.Machining
  ( Context (..),
    milling,
    millingOf,
    pocketing,
    pocketIn,
    checkPassCount,
    stopsOf,
    spacePoint,
    checkCutter,
    cutterOf,
    accuracyOf,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..), Rad (..), over, times)
import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Monad (when)
import Data.List qualified as List
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust)
import Data.Vector qualified as Vector
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.WindingNumber qualified as WindingNumber
import Part.Body qualified as Body
import Part.CarvingError (CarvingMistake (NoFlank, NotPointed))
import Part.ContourElement qualified as ContourElement
import Part.ContourError (ContourFault (OpenBegins))
import Part.CurveError (CurveMistake (SteepBevel))
import Part.CutFeed (CutFeed, SpindleRate)
import Part.Descent qualified as Descent
import Part.Error (CutterStatement (..), Error (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.HoleError (HoleMistake (..), ThreadMistake (..))
import Part.Measure (feedOf, lengthOf, notNegative, whole)
import Part.Parameter (Range (UpTo))
import Part.Parameter qualified as Parameter
import Part.Part
import Part.PlaneRegion (PlaneRegion (..))
import Part.PlaneRegion qualified as PlaneRegion
import Part.PocketCheck qualified as PocketCheck
import Part.PocketError (PocketMisfit (StepTooWide))
import Part.RegionBuiltin qualified as RegionBuiltin
import Part.RegionError (RegionMistake (EmptyRegion))
import Part.Value (Value (..))

-- | The names and the settings in force at a statement. A setting that the statement needs is
-- 'Nothing' only if a mistake in it is already reported.
data Context = Context
  { environment :: Environment,
    cutter :: Maybe Cutter,
    chordError :: Maybe (Located Accuracy),
    modalFeed :: Maybe (Located CutFeed),
    clearanceHeight :: Maybe Mm,
    modalSense :: Sense,
    -- | how fast the spindle turns
    modalRate :: SpindleRate,
    -- | the factor by which the transformations around the statement scale its contours
    scaledBy :: Double
  }

-- Milling and turning

-- | Evaluates the milling or turning of a contour, or the milling of a region. @at@ is the region
-- of the statement, and @e@ the expression of the contour. A region gives one milling for each of
-- its contours, those around holes first.
milling ::
  Context ->
  Work ->
  Region ->
  Expr ->
  Located Side ->
  Checked.Settings ->
  Eval (Maybe [Milling])
milling context work at e side settings = do
  v <- outlineOf (environment context) e
  case work of
    Milled -> checkCutter context at MillStatement
    Engraved -> checkCutter context at EngraveStatement
    Turned -> checkCutter context at TurnStatement
  case v of
    RegionValue r -> do
      when (null (PlaneRegion.parts r)) (Evaluation.mistake (InRegion (EmptyRegion (region e))))
      sequence
        <$> traverse
          (uncurry (millingOf context work at settings))
          ( [(c, beyond side) | p <- PlaneRegion.parts r, c <- PlaneRegion.holes p]
              <> [(PlaneRegion.outer p, side) | p <- PlaneRegion.parts r]
          )
    _ -> fmap pure <$> millingOf context work at settings (contourOf v) side

-- | Evaluates the milling or turning of one contour.
millingOf ::
  Context ->
  Work ->
  Region ->
  Checked.Settings ->
  Contour ->
  Located Side ->
  Eval (Maybe Milling)
millingOf context work at settings c side =
  assembled context work at side settings <$> passesOf context at c settings

-- | The side of a hole on which the cutter runs if it runs on this side of a region: outside of the
-- region is inside the hole.
beyond :: Located Side -> Located Side
beyond (Located at side) = Located at $ case side of
  Inside -> Outside
  Outside -> Inside
  other -> other

-- | The evaluated contour and settings of a milling or turning statement.
data Passes = Passes
  { path :: Contour,
    -- | the stops of the approach; 'Nothing' if a mistake in them is reported
    approachStops :: Maybe [Stop],
    -- | the stops of the retract; 'Nothing' if a mistake in them is reported
    retractStops :: Maybe [Stop],
    heights :: [Mm],
    plungeFeed :: Maybe (Located CutFeed),
    wayDown :: Located Descent,
    leftTabs :: Maybe (Located Tabs),
    -- | the lead-in and the lead-out: the form, and the length of the line or the radius of the arc
    leads :: (Maybe (LeadForm, Mm), Maybe (LeadForm, Mm)),
    -- | the allowance of each pass
    passAllowances :: NonEmpty Mm
  }

-- | Evaluates the settings of a milling or turning statement. @at@ is its region.
passesOf :: Context -> Region -> Contour -> Checked.Settings -> Eval Passes
passesOf context at contour settings = do
  approachStops <- stopsOf context (Checked.approach settings)
  retractStops <- stopsOf context (Checked.retract settings)
  path <- startedNear env contour (Checked.startNear settings)
  wayDown <- Descent.descentOf env at (cutter context) path settings
  heights <- maybe (pure []) (levelsOf env (value wayDown)) (Checked.depth settings)
  checkSteps context at (Checked.depth settings) heights
  leftTabs <- Descent.tabsOf env (cutter context) heights settings
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
        wayDown,
        leftTabs,
        leads = (leadIn, leadOut),
        passAllowances
      }
  where
    env = environment context
    lead (form, x) = (form,) <$> lengthOf env Parameter.Lead x

-- | Makes the milling or turning operation from the evaluated contour and settings @passes@. @at@
-- is the region of the statement. The result is 'Nothing' if a setting that the operation needs has
-- no value.
assembled ::
  Context -> Work -> Region -> Located Side -> Checked.Settings -> Passes -> Maybe Milling
assembled context work at side settings passes = do
  tool <- cutter context
  Located accuracy tolerance <- chordError context
  feed <- modalFeed context
  approach <- approachStops passes
  retract <- retractStops passes
  _ <- if null (heights passes) then Just (Mm 0) else clearanceHeight context
  Just
    Milling
      { contour = path passes,
        givesStart = isJust (Checked.startNear settings),
        work,
        side,
        radius = cutterRadius tool,
        gear = case kind tool of BladeCutter wheel -> Just wheel; _ -> Nothing,
        engraver = if kind tool == VBitCutter then Just tool else Nothing,
        tolerance,
        places = placesOf at tool accuracy settings,
        feed,
        approach,
        retract,
        levels = heights passes,
        clearance = clearanceHeight context,
        plunge = plungeFeed passes,
        descent = wayDown passes,
        materialTop = Mm 0,
        tabs = leftTabs passes,
        leadIn = fst (leads passes),
        leadOut = snd (leads passes),
        allowances = passAllowances passes,
        corners = Checked.corners settings,
        sense = Checked.sense settings,
        spindleSense = modalSense context,
        controlCompensation = case Checked.compensation settings of
          Just (Located asked Checked.ByController) -> Just asked
          Just (Located _ Checked.ByCompiler) -> Nothing
          Nothing -> Nothing,
        rest = maybe Refused (const Allowed) (Checked.restAllowed settings)
      }

-- | The places that a fix of a milling may change. @at@ is the region of the statement, @accuracy@
-- that of the tolerance.
placesOf :: Region -> Cutter -> Region -> Checked.Settings -> MillingPlaces
placesOf at tool accuracy settings =
  MillingPlaces
    { statement = at,
      toolSize = cutterSize tool,
      accuracy,
      depthAt = region . fst <$> Checked.depth settings,
      leadInSize = region . snd <$> Checked.leadIn settings,
      leadOutSize = region . snd <$> Checked.leadOut settings
    }

-- | Evaluates an outline: a contour or a region. A circle is the region inside it.
outlineOf :: Environment -> Expr -> Eval Value
outlineOf env e = do
  v <- Expression.evaluate env e
  case v of
    CircleValue _ -> RegionValue <$> RegionBuiltin.regionOf (region e) v
    _ -> pure v

contourOf :: Value -> Contour
contourOf v = case v of
  ContourValue c -> c
  _ -> bug "a value that is no contour where one was checked"

-- | The contour that the cutter follows. If the statement gives a point @near@, the start of the
-- contour is moved to the contour's nearest point to @near@. Fails if @near@ is given and the
-- contour is open.
startedNear :: Environment -> Contour -> Maybe (Located Expr) -> Eval Contour
startedNear env contour near = case near of
  Nothing -> pure contour
  Just (Located setting e) -> do
    p <- Expression.point <$> Expression.evaluate env e
    if ends contour == Open
      then
        let name = value (contourName contour)
         in Evaluation.mistake (InContour (OpenBegins setting name))
      else pure (ContourElement.startingNear p contour)

-- | The heights of the passes from the highest to the lowest, in mm and negative. The pair of
-- expressions gives @depth@, the depth of the lowest pass, and @most@, the largest stepdown. All
-- steps are equal. Without @most@ there is one pass, and so there is after a spiral, which goes
-- down to it.
levelsOf :: Environment -> Descent -> (Expr, Maybe Expr) -> Eval [Mm]
levelsOf env wayDown (depth, most) = do
  d <- lengthOf env Parameter.Depth depth
  stepdown <- traverse (lengthOf env Parameter.PassDepth) most
  let count = maybe 1 (\s -> max 1 (ceiling (over d s - Tolerance.equal))) stepdown :: Int
  when
    (count > 10000)
    ( Evaluation.mistake
        (NotWhole (region depth) Parameter.PassCount (UpTo 10000) (fromIntegral count))
    )
  pure $ case wayDown of
    Spiralling _ -> [times (-1) d]
    _ -> [times (negate (fromIntegral k / fromIntegral count)) d | k <- [1 .. count]]

-- | Fails if there are passes at several @heights@ and the cutter is widest at its tip. @at@ is the
-- region of the statement, and @depth@ the depth that the statement gives.
checkSteps :: Context -> Region -> Maybe (Expr, Maybe Expr) -> [Mm] -> Eval ()
checkSteps context at depth heights = case cutter context of
  Just c
    | kind c == DovetailCutter && length heights > 1 ->
      Evaluation.mistake (StepsUndercut (maybe at (region . fst) depth) (stepOf =<< depth))
  _ -> pure ()
  where
    stepOf (d, most) = (\m -> Region (end (region d)) (end (region m))) <$> most

-- Pockets

-- | Evaluates the clearing of a pocket: the inside of a closed contour, or a region, without its
-- islands. @at@ is the region of the statement, @e@ the expression of the outline, and @step@ that
-- of the stepover. A region gives one pocket for each of its parts.
pocketing ::
  Context ->
  Region ->
  Expr ->
  Expr ->
  Checked.Settings ->
  Eval (Maybe [Pocketing])
pocketing context at e step settings = do
  checkCutter context at PocketStatement
  v <- outlineOf env e
  islands <- concat <$> Evaluation.gather (map islandsOf (Checked.islands settings))
  case v of
    RegionValue (PlaneRegion parts) -> do
      when (null parts) (Evaluation.mistake (InRegion (EmptyRegion (region e))))
      let place k = [i | (i, j) <- zip islands (map (partAround parts) islands), j == k]
          pocket k p =
            pocketIn context at step settings (named e (PlaneRegion.outer p)) $
              map (named e) (PlaneRegion.holes p) <> place k
      sequence <$> traverse (uncurry pocket) (zip [0 ..] parts)
    _ -> fmap pure <$> pocketIn context at step settings (named e (contourOf v)) islands
  where
    env = environment context
    named i = PocketCheck.Named (region i)
    islandsOf i = do
      v <- Expression.evaluate env i
      pure $ case v of
        ListValue vs -> map (named i . islandOf i) (Vector.toList vs)
        _ -> [named i (islandOf i v)]
    islandOf i v = case v of
      CircleValue c -> RegionBuiltin.contourOfCircle (region i) c
      _ -> contourOf v

-- | The index of the part of a region in which an island lies; 0 if it lies in none.
partAround :: [PlaneRegion.RegionPart] -> PocketCheck.Named -> Int
partAround parts island =
  fromMaybe 0 (List.findIndex (\p -> polyarcOf (PlaneRegion.outer p) `encloses` begin) parts)
  where
    encloses = WindingNumber.encloses
    begin = Segment.start (segment (NonEmpty.head (elements (PocketCheck.contour island))))

-- | Evaluates the clearing of one pocket with this outline and these islands.
pocketIn ::
  Context ->
  Region ->
  Expr ->
  Checked.Settings ->
  PocketCheck.Named ->
  [PocketCheck.Named] ->
  Eval (Maybe Pocketing)
pocketIn context at step settings outline islands = do
  wall <-
    millingOf
      context
      Milled
      at
      settings
      (PocketCheck.contour outline)
      (Located (PocketCheck.mention outline) Inside)
  stepover <- lengthOf (environment context) Parameter.Stepover step
  Evaluation.spend at (sum [length (elements (PocketCheck.contour c)) | c <- outline : islands])
  checkPassCount (region step) (over (PocketCheck.halfWidth outline) stepover)
  let diameter = times 2 . cutterRadius <$> cutter context
      tooWide = [StepTooWide (region step) stepover d | Just d <- [diameter], stepover > d]
      contours' = map PocketCheck.contour islands
      pocket w = Pocketing {wall = w, islands = contours', stepover, extent = WholePocket}
  case PocketCheck.misfits diameter outline islands <> tooWide of
    [] -> pure (pocket <$> wall)
    found -> Evaluation.mistakes [Error (InPocket m) [] [] | m <- found]

-- | Fails if the estimated number of passes, @count@, exceeds 10 000. No real pocket needs more.
checkPassCount :: Region -> Double -> Eval ()
checkPassCount at count =
  when
    (count > 10000)
    (Evaluation.mistake (NotWhole at Parameter.PassCount (UpTo 10000) (fromIntegral rounded)))
  where
    rounded = ceiling (min 1e9 count) :: Int

-- Moves

-- | The ends of moves without cutting, each with its speed. 'Nothing' if a move needs the feed in
-- force and a mistake in this feed is already reported.
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

-- | Converts a value to a point in space. A point of the plane gets the height 0, the top of the
-- part.
spacePoint :: Value -> SpacePoint
spacePoint v = case v of
  SpaceValue p z -> SpacePoint p z
  _ -> SpacePoint (Expression.point v) (Mm 0)

-- Cutters and tolerances

-- | Fails if the kind of the tool in the spindle does not suit the statement.
checkCutter :: Context -> Region -> CutterStatement -> Eval ()
checkCutter context at statement = case cutter context of
  Just c | not (fits c (kind c)) -> Evaluation.mistake (WrongCutter at statement (kind c))
  _ -> pure ()
  where
    fits c cutterKind = case statement of
      MillStatement -> isMill cutterKind
      TurnStatement -> cutterKind == TurningCutter
      PocketStatement -> cutterKind == MillingCutter
      RestStatement -> cutterKind == MillingCutter
      FaceStatement -> cutterKind == MillingCutter
      EngraveStatement -> cutterKind `elem` [MillingCutter, ConeCutter, VBitCutter]
      -- A cone of the bevel 0 has no point.
      CarveStatement -> cutterKind `elem` [ConeCutter, VBitCutter] && isJust (pointAngle (body c))
      DrillStatement -> cutterKind `elem` [DrillingCutter, MillingCutter]
      HoleStatement work -> fitsHole work cutterKind

-- | True for the kinds of tools that make holes in this way.
fitsHole :: Checked.HoleWork -> CutterKind -> Bool
fitsHole work cutterKind = case work of
  Checked.Spotting -> cutterKind `elem` [DrillingCutter, ConeCutter, VBitCutter]
  Checked.Countersinking -> cutterKind `elem` [DrillingCutter, ConeCutter, VBitCutter]
  Checked.Reaming -> cutterKind == DrillingCutter
  Checked.Counterboring -> cutterKind == MillingCutter
  Checked.Boring -> cutterKind == MillingCutter
  Checked.Tapping -> cutterKind == TappingCutter
  Checked.Threading -> case cutterKind of
    ThreadCutter _ -> True
    _ -> False

-- | True for the kinds of cutters that mill contours with their flank.
isMill :: CutterKind -> Bool
isMill cutterKind = case cutterKind of
  MillingCutter -> True
  ConeCutter -> True
  DovetailCutter -> True
  BladeCutter _ -> True
  -- Its radius is that of its top.
  VBitCutter -> False
  DrillingCutter -> False
  TurningCutter -> False
  TappingCutter -> False
  ThreadCutter _ -> False

-- | Evaluates a tool. The result holds the radius at which the tool touches the part.
cutterOf :: Environment -> Checked.Cutter -> Eval Cutter
cutterOf env (Located _ c) = case c of
  Checked.MillCutter e sizes ->
    withBody sizes . sized MillingCutter e . times 0.5 =<< lengthOf env Parameter.CutterDiameter e
  Checked.DrillCutter e sizes ->
    withBody sizes . sized DrillingCutter e . times 0.5 =<< lengthOf env Parameter.DrillDiameter e
  Checked.TapCutter e sizes ->
    withBody sizes . sized TappingCutter e . times 0.5 =<< lengthOf env Parameter.TapDiameter e
  Checked.ThreadMillCutter e pitch sizes -> do
    r <- times 0.5 <$> lengthOf env Parameter.CutterDiameter e
    own <- lengthOf env Parameter.ThreadPitch pitch
    when (own > r) . Evaluation.mistake . InHole . InThread $
      PitchTooLong (region pitch) own (times 2 r)
    withBody sizes (sized (ThreadCutter own) e r)
  Checked.ConeCutter e lean h -> cone env e lean h
  Checked.VBitCutter angle narrow wide -> vBit env angle narrow wide
  Checked.BladeCutter e g -> do
    d <- lengthOf env Parameter.BladeDiameter e
    wheel <- lengthOf env Parameter.WheelDiameter g
    pure (sized (BladeCutter wheel) e (times 0.5 d))
  Checked.TurningCutter e tip' -> do
    x <- Expression.number <$> Expression.evaluate env e
    when (x < 0) (Evaluation.mistake (Negative (region e) Parameter.NoseRadius x))
    tip <- traverse (whole env Parameter.TipDirection (1, 9)) tip'
    pure (sized TurningCutter e (Mm x)) {tip}
  where
    sized kind' e r = Cutter kind' r (Just (region e)) Nothing r plainBody
    withBody sizes tool = (\b -> tool {body = b}) <$> Body.toolBody env sizes

-- | Evaluates a conical cutter from three expressions: the diameter 2R of its tip (@e@), the angle
-- μ between its flank and its axis (@lean@), and a height H (@h@). The flank touches the part at
-- the height H above the tip. The radius there is @a = R + H·tan μ@ (Kolsanova, section 3).
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
  let kind' = if mu < 0 then DovetailCutter else ConeCutter
      pointed = if mu > 0 then plainBody {pointAngle = Just (Rad (2 * mu))} else plainBody
  pure (Cutter kind' (Mm a) Nothing Nothing (Mm (d / 2)) pointed)

-- | Evaluates a V-bit from three expressions: the angle from flank to flank (@angle@), and the
-- diameters of its tip (@narrow@) and of the top of its flank (@wide@).
vBit :: Environment -> Expr -> Expr -> Expr -> Eval Cutter
vBit env angle narrow wide = do
  a <- Expression.number <$> Expression.evaluate env angle
  when
    (a <= 0 || a >= pi - Tolerance.equal)
    (Evaluation.mistake (InCarving (NoFlank (region angle) (Rad a))))
  across <- notNegative env Parameter.TipDiameter narrow
  top <- lengthOf env Parameter.CutterDiameter wide
  when (top <= across) . Evaluation.mistake . InCarving $
    NotPointed (region wide) top (region narrow, across)
  pure
    Cutter
      { kind = VBitCutter,
        cutterRadius = times 0.5 top,
        cutterSize = Nothing,
        tip = Nothing,
        tipRadius = times 0.5 across,
        body = plainBody {pointAngle = Just (Rad a)}
      }

-- | The allowed chord error that a @tolerance@ statement sets.
accuracyOf :: Environment -> Checked.Accuracy -> Eval (Located Accuracy)
accuracyOf env accuracy = case accuracy of
  Checked.Within e -> Located (region e) . OnPath <$> lengthOf env Parameter.Tolerance e
  Checked.Between a b -> do
    inside <- notNegative env Parameter.Tolerance a
    outside <- notNegative env Parameter.Tolerance b
    if inside <= Mm 0 && outside <= Mm 0
      then Evaluation.mistake (NotPositive (region b) Parameter.OneSidedTolerance 0)
      else pure (Located (Region.span (region a) (region b)) (Band inside outside))
