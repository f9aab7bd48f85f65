-- | Checks the settings in the block of a machining statement, and the stops of moves without
-- cutting. A stop is the point at which such a move ends.
--
-- The functions yield 'Deferred' terms, which are complete only when type inference has found all
-- dimensions of the program.
module Checked.Settings
  ( check,
    stop,
  )
where

import Base.Region (Located (..), Region (..))
import Checked.Deferred (Deferred)
import Checked.Error (Error (..))
import Checked.ErrorFix (unwritten)
import Checked.Expression (TypingEnvironment, expect, spatialPoint)
import Checked.Feed (cutFeed)
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Syntax (Settings (..), VisitOrder (..))
import Checked.Syntax qualified as Checked
import Checked.Type qualified as Type
import Control.Monad (unless)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Surface.Keyword qualified as Keyword
import Surface.Syntax qualified as Surface

-- | Checks the settings in the block of a statement; @statement@ is the keyword of this statement.
-- Each setting is allowed once, except @approach@ and @retract@. The stops of all @approach@
-- settings are joined in the order of the text, and so are those of all @retract@ settings.
check :: TypingEnvironment -> Text -> [Surface.Setting] -> Infer (Deferred Settings)
check env statement written = do
  mapM_ reportRepeated (zip (drop 1 (scanl (flip (:)) [] written)) written)
  changes <- mapM (setting env statement) written
  pure (\sol -> foldl (\settings change -> change sol settings) unset changes)

-- | Reports a setting that has occurred earlier in its block. The list @upToHere@ begins with the
-- setting itself. The earlier settings follow in reverse order.
reportRepeated :: ([Surface.Setting], Surface.Setting) -> Infer ()
reportRepeated (upToHere, Located at s) =
  case [ r
         | Located r other <- drop 1 upToHere,
           subject other == subject s,
           keyword s `notElem` ["approach", "retract", ""]
       ] of
    before : _ -> Inference.mistake (RepeatedSetting at (subject s) before)
    [] -> pure ()

-- | Checks one setting, and that the statement with the keyword @statement@ allows it. The result
-- adds this setting to the settings before it.
setting :: TypingEnvironment -> Text -> Surface.Setting -> Infer (Deferred (Settings -> Settings))
setting env statement (Located at s) = do
  unless
    (keyword s `elem` "" : own)
    (Inference.mistake (ForeignSetting at (keyword s) statement own))
  case s of
    Surface.Approach to ->
      (\ps sol o -> o {approach = approach o <> ps sol}) <$> stops env to
    Surface.Retract to ->
      (\ps sol o -> o {retract = retract o <> ps sol}) <$> stops env to
    Surface.Depth d most -> do
      d' <- len d
      most' <- traverse len most
      sequence_
        [ Inference.mistake (ForeignSetting stepdown "step" statement own)
          | statement == "vcarve",
            Just m <- [most],
            let stepdown = Region (end (region d)) (end (region m))
        ]
      pure (\sol o -> o {depth = Just (d' sol, ($ sol) <$> most')})
    Surface.LeadBy Surface.LeadIn form e ->
      (\e' sol o -> o {leadIn = Just (form, e' sol)}) <$> len e
    Surface.LeadBy Surface.LeadOut form e ->
      (\e' sol o -> o {leadOut = Just (form, e' sol)}) <$> len e
    Surface.Allowances es ->
      (\es' sol o -> o {allowances = Just (fmap ($ sol) es')}) <$> mapM len es
    Surface.CornerStyle style -> pure (\_ o -> o {corners = style})
    Surface.CutBy sense -> pure (\_ o -> o {sense = Just (Located at sense)})
    Surface.CompensationBy who -> pure (\_ o -> o {compensation = Just (Located at who)})
    Surface.StartNear e ->
      (\e' sol o -> o {startNear = Just (Located at (e' sol))}) <$> expect env Type.aPoint e
    Surface.Plunge e -> (\e' sol o -> o {plunge = Just (e' sol)}) <$> cutFeed env e
    Surface.Ramp e -> descentBy (fmap Checked.Ramp <$> expect env Type.angle e)
    Surface.Helix p d -> do
      p' <- len p
      d' <- traverse len d
      descentBy (pure (\sol -> Checked.Helix (p' sol) (($ sol) <$> d')))
    Surface.Spiral -> descentBy (pure (const Checked.Spiral))
    Surface.Tabs places w h a -> do
      places' <- tabPlaces env places
      w' <- len w
      h' <- len h
      a' <- traverse (expect env Type.angle) a
      pure $ \sol o ->
        o {tabs = Just (Located at (Checked.Tabs (places' sol) (w' sol) (h' sol) (($ sol) <$> a')))}
    Surface.Peck e -> (\e' sol o -> o {peck = Just (e' sol)}) <$> len e
    Surface.ShortestWay -> pure (\_ o -> o {visits = Shortest})
    Surface.ChipBreak e -> (\e' sol o -> o {chipBreak = Just (Located at (e' sol))}) <$> len e
    Surface.Pause e -> (\e' sol o -> o {pause = Just (e' sol)}) <$> expect env Type.number e
    Surface.TurnPitch e -> (\e' sol o -> o {turnPitch = Just (e' sol)}) <$> len e
    Surface.Hand side -> pure (\_ o -> o {hand = Just side})
    Surface.Floating -> pure (\_ o -> o {floating = Just at})
    Surface.Islands es ->
      (\es' sol o -> o {islands = map ($ sol) es'})
        <$> mapM (contourOrContours env) (NonEmpty.toList es)
    Surface.RestAllowed -> pure (\_ o -> o {restAllowed = Just at})
    Surface.Angle e -> (\e' sol o -> o {passAngle = Just (e' sol)}) <$> expect env Type.angle e
    Surface.BrokenSetting -> (\_ o -> o) <$ Inference.taint
  where
    own = Keyword.settingsOf statement
    len = expect env Type.len
    descentBy = fmap (\d sol o -> o {descent = Just (Located at (d sol))})

-- | Checks the number of tabs, or the points near which they are.
tabPlaces :: TypingEnvironment -> Surface.TabPlaces -> Infer (Deferred Checked.TabPlaces)
tabPlaces env places = case places of
  Surface.TabCount n -> (\n' sol -> Checked.TabCount (n' sol)) <$> expect env Type.number n
  Surface.TabsAt ps ->
    (\ps' sol -> Checked.TabsAt (fmap ($ sol) ps')) <$> mapM (expect env Type.aPoint) ps

stops :: TypingEnvironment -> NonEmpty Surface.Stop -> Infer (Deferred [Checked.Stop])
stops env to = (\ps sol -> map ($ sol) ps) <$> mapM (stop env) (NonEmpty.toList to)

-- | Checks a stop: the point at which the move ends, and the speed of the move.
stop :: TypingEnvironment -> Surface.Stop -> Infer (Deferred Checked.Stop)
stop env (Surface.Stop p pace) = do
  p' <- spatialPoint env p
  pace' <- case pace of
    Surface.Cutting -> pure (const Checked.Cutting)
    Surface.Rapid -> pure (const Checked.Rapid)
    Surface.AtFeed f -> (Checked.AtFeed .) <$> cutFeed env f
  pure (\sol -> Checked.Stop (p' sol) (pace' sol))

-- | Checks an expression that must be a contour, a circle, or a list of contours or of circles.
contourOrContours :: TypingEnvironment -> Surface.Expr -> Infer (Deferred Checked.Expr)
contourOrContours env e@(Located at _) = do
  t <- Inference.freshType
  e' <- expect env t e
  found <- Inference.resolved t
  let wanted = case found of
        Type.Circle -> Type.Circle
        Type.ListOf Type.Circle -> found
        Type.ListOf _ -> Type.ListOf Type.Contour
        _ -> Type.Contour
  elsewhere <- Inference.decidedElsewhere [(at, t, found)]
  same <- Inference.unify at wanted t
  unless same (Inference.mistake (Mismatch at wanted found elsewhere unwritten))
  pure e'

-- | The settings of a statement whose block is empty.
unset :: Settings
unset =
  Settings
    { approach = [],
      retract = [],
      depth = Nothing,
      leadIn = Nothing,
      leadOut = Nothing,
      allowances = Nothing,
      corners = Checked.Round,
      sense = Nothing,
      compensation = Nothing,
      startNear = Nothing,
      plunge = Nothing,
      descent = Nothing,
      tabs = Nothing,
      peck = Nothing,
      visits = AsListed,
      chipBreak = Nothing,
      pause = Nothing,
      turnPitch = Nothing,
      hand = Nothing,
      floating = Nothing,
      islands = [],
      restAllowed = Nothing,
      passAngle = Nothing
    }

-- | The words with which a setting begins. The text is empty for a setting that the parser has
-- reported as wrong.
keyword :: Surface.Setting_ -> Text
keyword s = case s of
  Surface.Approach _ -> "approach"
  Surface.Retract _ -> "retract"
  Surface.Depth _ _ -> "depth"
  Surface.LeadBy Surface.LeadIn _ _ -> "lead in"
  Surface.LeadBy Surface.LeadOut _ _ -> "lead out"
  Surface.Allowances _ -> "allowance"
  Surface.CornerStyle _ -> "corners"
  Surface.CutBy Surface.Climb -> "climb"
  Surface.CutBy Surface.Conventional -> "conventional"
  Surface.CompensationBy _ -> "compensation"
  Surface.StartNear _ -> "start near"
  Surface.Plunge _ -> "plunge"
  Surface.Ramp _ -> "ramp"
  Surface.Helix _ _ -> "helix"
  Surface.Spiral -> "spiral"
  Surface.Tabs (Surface.TabCount _) _ _ _ -> "tabs"
  Surface.Tabs (Surface.TabsAt _) _ _ _ -> "tab at"
  Surface.Peck _ -> "peck"
  Surface.ShortestWay -> "shortest"
  Surface.ChipBreak _ -> "chip break"
  Surface.Pause _ -> "dwell"
  Surface.TurnPitch _ -> "pitch"
  Surface.Hand _ -> "hand"
  Surface.Floating -> "floating"
  Surface.Islands _ -> "islands"
  Surface.RestAllowed -> "rest"
  Surface.Angle _ -> "angle"
  Surface.BrokenSetting -> ""

-- | The name of a setting in reports. Two settings of a block must not have the same name, unless
-- the name is @approach@, @retract@ or empty.
subject :: Surface.Setting_ -> Text
subject s = case s of
  Surface.CutBy _ -> "climb or conventional"
  Surface.Ramp _ -> "ramp, helix or spiral"
  Surface.Helix _ _ -> "ramp, helix or spiral"
  Surface.Spiral -> "ramp, helix or spiral"
  Surface.Tabs {} -> "tabs"
  _ -> keyword s
