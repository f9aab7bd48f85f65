-- | Evaluates the settings that say how a statement goes down into the material, and the tabs that
-- it leaves.
module Part.Descent
  ( descentOf,
    tabsOf,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus, times)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Monad (when)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing)
import Data.Text (Text)
import Geometry.Tolerance qualified as Tolerance
import Part.DescentError (DescentMisfit (..))
import Part.Error (ValueFact (InDescent))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Measure (lengthOf, whole)
import Part.Parameter qualified as Parameter
import Part.Part

-- | The way down of a statement in the region @at@, along the contour @path@. @tool@ is Nothing if
-- a mistake in it is reported.
descentOf ::
  Environment -> Region -> Maybe Cutter -> Contour -> Checked.Settings -> Eval (Located Descent)
descentOf env at tool path settings = case Checked.descent settings of
  Nothing -> pure (Located at Plunging)
  Just (Located region form) -> do
    checkSetting region (wordOf form) tool settings
    Located region <$> case form of
      Checked.Ramp e -> do
        checkLead region "ramp" settings
        Ramping <$> slopeOf env e
      Checked.Helix p d -> do
        pitch <- lengthOf env Parameter.Pitch p
        diameter <- traverse (diameterOf env tool) d
        pure (Helical pitch diameter)
      Checked.Spiral -> do
        checkLead region "spiral" settings
        when (ends path == Open) (mistake (OpenSpiral region (value (contourName path))))
        case Checked.depth settings >>= snd of
          Just step -> Spiralling <$> lengthOf env Parameter.PassDepth step
          Nothing -> mistake (WithoutStep region)

-- | The first word of the setting of a descent.
wordOf :: Checked.DescentForm -> Text
wordOf form = case form of
  Checked.Ramp _ -> "ramp"
  Checked.Helix _ _ -> "helix"
  Checked.Spiral -> "spiral"

-- | The diameter of the path of the centre in a helix, which is at most that of the cutter.
diameterOf :: Environment -> Maybe Cutter -> Expr -> Eval Mm
diameterOf env tool e = do
  d <- lengthOf env Parameter.HelixDiameter e
  case times 2 . tipRadius <$> tool of
    Just cutter | d > cutter -> mistake (CoreStays (region e) d cutter)
    _ -> pure d

-- | The tabs of a statement, whose lowest pass is at the end of the list of heights.
tabsOf :: Environment -> Maybe Cutter -> [Mm] -> Checked.Settings -> Eval (Maybe (Located Tabs))
tabsOf env tool levels settings = case Checked.tabs settings of
  Nothing -> pure Nothing
  Just (Located region t) -> do
    checkSetting region "tabs" tool settings
    places <- case Checked.tabPlaces t of
      Checked.TabCount n -> Evenly <$> whole env Parameter.TabCount (1, 1000) n
      Checked.TabsAt ps -> NearPoints <$> traverse point ps
    width <- lengthOf env Parameter.TabWidth (Checked.tabWidth t)
    height <- lengthOf env Parameter.TabHeight (Checked.tabHeight t)
    sides <- maybe (pure usualSides) (slopeOf env) (Checked.tabAngle t)
    case (NonEmpty.nonEmpty levels, Checked.depth settings) of
      (Just heights, Just (depth, _))
        | lowest <- NonEmpty.last heights ->
          if plus lowest height >= Mm 0
            then
              mistake
                ( TabsTooHigh
                    (placeOf (Checked.tabHeight t))
                    height
                    (times (-1) lowest)
                    (placeOf depth)
                )
            else pure (Just (Located region (Tabs places width (plus lowest height) sides)))
      -- A mistake in the depth is already reported.
      _ -> pure Nothing
  where
    point e = Located (placeOf e) . Expression.point <$> Expression.evaluate env e
    placeOf (Located r _) = r

-- | The angle of the sides of tabs for which the program gives none.
usualSides :: Rad
usualSides = Rad (pi / 4)

-- | Evaluates an angle to the plane, above 0 and below a right angle.
slopeOf :: Environment -> Expr -> Eval Rad
slopeOf env e = do
  x <- Expression.number <$> Expression.evaluate env e
  if x > Tolerance.equal && x < pi / 2 - Tolerance.equal
    then pure (Rad x)
    else mistake (WrongSlope (region e) (Rad x))

-- | Fails if the statement lacks a depth, if the control compensates, or if the tool is a blade.
checkSetting :: Region -> Text -> Maybe Cutter -> Checked.Settings -> Eval ()
checkSetting at word tool settings = do
  when (isNothing (Checked.depth settings)) (mistake (WithoutDepth at word))
  case Checked.compensation settings of
    Just (Located there Checked.ByController) -> mistake (WithControl at word there)
    _ -> pure ()
  case kind <$> tool of
    Just (BladeCutter _) -> mistake (ForBlade at word)
    _ -> pure ()

-- | Fails if the statement has a lead-in.
checkLead :: Region -> Text -> Checked.Settings -> Eval ()
checkLead at word settings =
  mapM_ (mistake . WithLead at word . region . snd) (Checked.leadIn settings)

mistake :: DescentMisfit -> Eval a
mistake = Evaluation.mistake . InDescent
