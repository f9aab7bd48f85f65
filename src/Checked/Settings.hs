-- | What has to stand somewhere: the settings that statements need before them, and those in the
-- braces of a machining statement.
module Checked.Settings
  ( settings,
    check,
  )
where

import Base.Region (Located (..), Region (..))
import Checked.Error (Error (..), RequiredSetting (..))
import Checked.Inference (Infer, Solution)
import Checked.Inference qualified as Inference
import Checked.Syntax (Settings (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Applicative ((<|>))
import Control.Monad (unless)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Keyword qualified as Keyword
import Surface.Syntax (Statement)
import Surface.Syntax qualified as Surface

-- | The statements that a program needs: the part's name first, the others once and before their
-- use.
settings :: [Statement] -> [Error]
settings written = begins <> go Map.empty (concatMap (flat False) written)
  where
    go seen ss = case ss of
      s : rest | (seen', errors) <- step seen s -> seen' `seq` (errors <> go seen' rest)
      [] -> []
    begins = case written of
      Located _ (Surface.Part _ _) : _ -> []
      Located _ (Surface.Broken (Just "part") _) : _ -> []
      Located at _ : _ -> [NoPart at {end = start at}]
      [] -> [NoPart (Region 0 0)]

-- | A statement and those in its blocks, each with whether it stands in a block.
flat :: Bool -> Statement -> [(Bool, Statement)]
flat inBlock s = case s of
  Located _ (Surface.Repeat _ _ body) -> concatMap (flat True) body
  Located _ (Surface.When _ body others) -> concatMap (flat True) (body <> others)
  Located _ (Surface.With _ body) -> concatMap (flat True) body
  _ -> [(inBlock, s)]

-- | From the places at which settings were first given, none for one that was missed before.
step ::
  Map RequiredSetting (Maybe Region) ->
  (Bool, Statement) ->
  (Map RequiredSetting (Maybe Region), [Error])
step seen (inBlock, Located at s) = (seen', misplaced <> missing <> twice)
  where
    Use {word, given, needed, global} = use s
    keyword = at {end = start at + word}
    misplaced = [NotInBlock keyword (firstWord s) | inBlock && global]
    missing =
      maybe
        []
        (\some -> [SettingsMissing keyword some])
        (NonEmpty.nonEmpty (filter (not . (`Map.member` seen)) needed))
    twice =
      [ SettingTwice at one before
        | Just one <- [given],
          one `notElem` [FeedSetting, ClearanceSetting],
          not (isChange s),
          null misplaced,
          Just (Just before) <- [Map.lookup one seen]
      ]
    seen' =
      Map.unionWith
        (<|>)
        seen
        (Map.fromList ([(one, Nothing) | one <- needed] <> [(one, Just at) | Just one <- [given]]))
    isChange statement' = case statement' of
      Surface.Change _ _ -> True
      Surface.Broken (Just "change") _ -> True
      _ -> False

-- | What a statement sets and what it needs: the length of its keyword; whether it holds for the
-- whole program.
data Use = Use
  { word :: Int,
    given :: Maybe RequiredSetting,
    needed :: [RequiredSetting],
    global :: Bool
  }

use :: Surface.Statement_ -> Use
use s = case s of
  Surface.Part _ _ -> setting PartSetting
  Surface.Machine _ -> setting MachineSetting
  Surface.Tool _ -> setting ToolSetting
  Surface.Tolerance _ -> setting ToleranceSetting
  Surface.From _ -> setting FromSetting
  Surface.Import _ -> plain {word = 6, global = True}
  Surface.Param _ _ -> plain {word = 5, global = True}
  Surface.Feed _ -> plain {given = Just FeedSetting}
  Surface.Clearance _ -> plain {given = Just ClearanceSetting}
  Surface.Change _ _ -> plain {given = Just ToolSetting}
  Surface.Mill _ _ options -> plain {needed = cutting <> [ClearanceSetting | goesDeep options]}
  Surface.Pocket _ _ options ->
    plain {word = 6, needed = cutting <> [ClearanceSetting | goesDeep options]}
  Surface.Turn {} -> plain {needed = cutting}
  Surface.Drill {} ->
    plain {word = 5, needed = [ToolSetting, FeedSetting, FromSetting, ClearanceSetting]}
  Surface.Travel motion stops ->
    plain
      { word = case motion of Surface.RapidMotion -> 5; Surface.FeedMotion -> 4,
        needed =
          FromSetting :
            [ FeedSetting
              | motion == Surface.FeedMotion,
                any ((== Surface.Cutting) . Surface.pace) (NonEmpty.toList stops)
            ]
      }
  Surface.Broken broken _ -> plain {given = broken >>= (`lookup` words')}
  _ -> plain
  where
    plain = Use {word = 4, given = Nothing, needed = [], global = False}
    setting one =
      Use {word = Text.length (firstWord s), given = Just one, needed = [], global = True}
    cutting = [ToolSetting, FeedSetting, ToleranceSetting, FromSetting]
    goesDeep options = or [True | Located _ (Surface.Depth _ _) <- options]
    words' =
      [ ("part", PartSetting),
        ("machine", MachineSetting),
        ("tool", ToolSetting),
        ("change", ToolSetting),
        ("feed", FeedSetting),
        ("tolerance", ToleranceSetting),
        ("clearance", ClearanceSetting),
        ("from", FromSetting)
      ]

firstWord :: Surface.Statement_ -> Text
firstWord s = case s of
  Surface.Part _ _ -> "part"
  Surface.Machine _ -> "machine"
  Surface.Tool _ -> "tool"
  Surface.Tolerance _ -> "tolerance"
  Surface.From _ -> "from"
  Surface.Import _ -> "import"
  Surface.Param _ _ -> "param"
  _ -> "this"

-- | Check what stands in the braces of a statement. The first function checks a value of a type,
-- the second a stop; the text is the statement's keyword.
check ::
  (Type -> Surface.Expr -> Infer (Solution -> Checked.Expr)) ->
  (Surface.Stop -> Infer (Solution -> Checked.Stop)) ->
  Text ->
  [Surface.Setting] ->
  Infer (Solution -> Settings)
check expect stop statement written = do
  mapM_ (uncurry twice) (zip (drop 1 (scanl (flip (:)) [] written)) written)
  foldl (\before after sol -> after sol (before sol)) (const none) <$> mapM one written
  where
    twice seen (Located at s) =
      case [ r
             | Located r other <- drop 1 seen,
               subject other == subject s,
               name s `notElem` ["approach", "retract", ""]
           ] of
        before : _ -> Inference.mistake (RepeatedSetting at (subject s) before)
        [] -> pure ()
    one (Located at s) = do
      unless
        (name s `elem` "" : Keyword.settingsOf statement)
        (Inference.mistake (ForeignSetting at (name s) statement (Keyword.settingsOf statement)))
      case s of
        Surface.Approach stops ->
          (\ps sol o -> o {approach = approach o <> map ($ sol) ps})
            <$> mapM stop (NonEmpty.toList stops)
        Surface.Retract stops ->
          (\ps sol o -> o {retract = retract o <> map ($ sol) ps})
            <$> mapM stop (NonEmpty.toList stops)
        Surface.Depth d most -> do
          d' <- expect Type.len d
          most' <- traverse (expect Type.len) most
          pure (\sol o -> o {depth = Just (d' sol, ($ sol) <$> most')})
        Surface.LeadBy Surface.LeadIn form e ->
          (\e' sol o -> o {leadIn = Just (form, e' sol)}) <$> expect Type.len e
        Surface.LeadBy Surface.LeadOut form e ->
          (\e' sol o -> o {leadOut = Just (form, e' sol)}) <$> expect Type.len e
        Surface.Allowances es ->
          (\es' sol o -> o {allowances = Just (fmap ($ sol) es')}) <$> mapM (expect Type.len) es
        Surface.CornerStyle style -> pure (\_ o -> o {corners = style})
        Surface.CutBy sense -> pure (\_ o -> o {sense = Just (Located at sense)})
        Surface.CompensationBy who -> pure (\_ o -> o {compensation = Just (Located at who)})
        Surface.StartNear e -> (\e' sol o -> o {startNear = Just (e' sol)}) <$> expect Type.aPoint e
        Surface.Plunge e -> (\e' sol o -> o {plunge = Just (e' sol)}) <$> expect Type.feed e
        Surface.Peck e -> (\e' sol o -> o {peck = Just (e' sol)}) <$> expect Type.len e
        Surface.Islands es ->
          (\es' sol o -> o {islands = map ($ sol) es'})
            <$> mapM (contours expect) (NonEmpty.toList es)
        Surface.RestAllowed -> pure (\_ o -> o {restAllowed = Just at})
        Surface.BrokenSetting -> (\_ o -> o) <$ Inference.taint

-- | A contour, or a list of contours.
contours ::
  (Type -> Surface.Expr -> Infer (Solution -> Checked.Expr)) ->
  Surface.Expr ->
  Infer (Solution -> Checked.Expr)
contours expect e@(Located at _) = do
  t <- Inference.freshType
  e' <- expect t e
  found <- Inference.resolved t
  let wanted = case found of
        Type.ListOf _ -> Type.ListOf Type.Contour
        _ -> Type.Contour
  settled <- Inference.decidedElsewhere [(at, t, found)]
  same <- Inference.unify at wanted t
  unless same (Inference.mistake (Mismatch at wanted found settled))
  pure e'

-- | Nothing set.
none :: Settings
none =
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
      peck = Nothing,
      islands = [],
      restAllowed = Nothing
    }

-- | How a setting begins.
name :: Surface.Setting_ -> Text
name s = case s of
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
  Surface.Peck _ -> "peck"
  Surface.Islands _ -> "islands"
  Surface.RestAllowed -> "rest"
  Surface.BrokenSetting -> ""

-- | What a setting is about: of one thing a statement is told once.
subject :: Surface.Setting_ -> Text
subject s = case s of
  Surface.CutBy _ -> "climb or conventional"
  _ -> name s
