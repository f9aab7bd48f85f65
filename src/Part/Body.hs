-- | Evaluates solids and the bodies of tools.
module Part.Body
  ( solid,
    toolBody,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Monad (when)
import Data.Foldable (for_)
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Geometry.Tolerance qualified as Tolerance
import Part.BodyError (BodyMistake (..))
import Part.Error (ValueFact (InBody, InHole, InRegion))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.HoleError (HoleMistake (NoPoint))
import Part.Measure (lengthOf)
import Part.Parameter qualified as Parameter
import Part.Part (HolderCylinder (..), Solid (..), ToolBody (..))
import Part.PlaneRegion qualified as PlaneRegion
import Part.RegionBuiltin qualified as RegionBuiltin
import Part.RegionError (RegionMistake (EmptyRegion))
import Part.Value qualified as Value

-- | Evaluates the solid over a region, given by its expression, between the heights of its bottom
-- and of its top. Without them it has no ends: it reaches as far as any machine.
solid :: Environment -> Expr -> Maybe (Expr, Expr) -> Eval Solid
solid env e zs = do
  region' <- Expression.evaluate env e >>= RegionBuiltin.regionOf (region e)
  when (null (PlaneRegion.parts region')) (Evaluation.mistake (InRegion (EmptyRegion (region e))))
  (bottom, top) <- maybe (pure (minus (Mm 0) Tolerance.reach, Tolerance.reach)) heightsOf zs
  pure Solid {outlines = PlaneRegion.contoursOf region', lowest = bottom, highest = top}
  where
    heightsOf (from, to) = do
      bottom <- height from
      top <- height to
      when (top <= bottom) . Evaluation.mistake . InBody $
        NoHeight (region to) top (region from, bottom)
      pure (bottom, top)
    height z = do
      x <- Expression.number <$> Expression.evaluate env z
      Mm x <$ Value.within (region z) x

-- | Evaluates the body of a tool from the sizes that the program gives.
toolBody :: Environment -> [Checked.BodySize] -> Eval ToolBody
toolBody env sizes = do
  flutes <- single "flutes" Parameter.FluteLength [(at, e) | Located at (Checked.Flutes e) <- sizes]
  out <- single "stickout" Parameter.StickOut [(at, e) | Located at (Checked.StickOut e) <- sizes]
  for_ ((,) <$> flutes <*> out) $ \((at, f), (there, s)) ->
    when (f > s) (mistake (FlutesTooLong at f (there, s)))
  point <-
    traverse (angleOf env . snd)
      =<< once "angle" [(at, e) | Located at (Checked.PointAngle e) <- sizes]
  cylinders <- case (out, holders) of
    (_, []) -> pure []
    (Nothing, (at, _, _) : _) -> mistake (HolderWithoutStickOut at)
    (Just (_, s), _) -> stacked s holders
  pure
    ToolBody
      { fluteLength = snd <$> flutes,
        stickOut = snd <$> out,
        holder = cylinders,
        pointAngle = point
      }
  where
    holders = [(at, d, h) | Located at (Checked.HolderCylinder d h) <- sizes]
    single :: Text -> Parameter.LimitedQuantity -> [(Region, Expr)] -> Eval (Maybe (Region, Mm))
    single word parameter given =
      traverse (\(at, e) -> (,) at <$> lengthOf env parameter e) =<< once word given
    once :: Text -> [(Region, Expr)] -> Eval (Maybe (Region, Expr))
    once word given = case given of
      (first, _) : (at, _) : _ -> mistake (SizeTwice at word first)
      _ -> pure (listToMaybe given)
    stacked from given = case given of
      [] -> pure []
      (at, d, h) : more -> do
        diameter <- lengthOf env Parameter.HolderSize d
        tall <- traverse (lengthOf env Parameter.HolderSize) h
        when (null tall && not (null more)) (mistake (EndlessCylinder at))
        (HolderCylinder {holderRadius = times 0.5 diameter, aboveTip = from} :)
          <$> stacked (maybe from (plus from) tall) more
    mistake :: BodyMistake -> Eval a
    mistake = Evaluation.mistake . InBody

-- | Evaluates the angle of the point of a drill, above 0° and up to 180°.
angleOf :: Environment -> Expr -> Eval Rad
angleOf env e = do
  a <- Expression.number <$> Expression.evaluate env e
  if a > 0 && a <= pi + Tolerance.equal
    then pure (Rad a)
    else Evaluation.mistake (InHole (NoPoint (region e) (Rad a)))
